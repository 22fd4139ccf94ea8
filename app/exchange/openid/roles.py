"""Who somebody is by the provider, and which role its groups allow at most."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any


class StationRole(StrEnum):
    """What somebody may be at a station; each has all that the one before has."""

    STUDENT = "student"
    INSTRUCTOR = "instructor"
    TECHNICIAN = "technician"

    @property
    def rank(self) -> int:
        """Return its place, from 0."""
        return list(StationRole).index(self)


@dataclass(frozen=True, slots=True)
class HospitalIdentity:
    """Somebody as the provider knows him, for the moment of a sign-in; kept nowhere.

    Attributes:
        issuer: the provider.
        subject: what it calls him (`sub`); in no message, no log and no file.
        allowed: the most that his groups allow.
    """

    issuer: str
    subject: str = field(repr=False)
    allowed: StationRole = StationRole.STUDENT


def role_by_groups(
    claims: Mapping[str, Any], claim: str, groups: Mapping[StationRole, Sequence[str]]
) -> StationRole:
    """Return what the groups of a token allow: the least of the roles that they are mapped to.

    Who is in no group that is mapped is a student. So a group that somebody was given by mistake,
    or that everybody is in, opens nothing.

    Args:
        claims: of the token.
        claim: that holds the groups: a name, or a path of names with dots between them.
        groups: that each role is mapped to.
    """
    held = set(_values(claims, claim))
    mapped = [role for role in StationRole if held & set(groups.get(role, ()))]
    return mapped[0] if mapped else StationRole.STUDENT


def _values(claims: Mapping[str, Any], claim: str) -> list[str]:
    """Return the values of a claim, which is a text or a list of texts; nothing else is taken."""
    value: Any = claims.get(claim)
    if value is None:
        value = claims
        for name in claim.split("."):
            value = value.get(name) if isinstance(value, Mapping) else None
    some = value if isinstance(value, list) else [value]
    return [text for text in some if isinstance(text, str) and text]
