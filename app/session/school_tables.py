"""Tables of what several stations bring together, beside those of people; see `gathering`."""

from __future__ import annotations

import hashlib
import secrets
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from app.session.database import number, words

if TYPE_CHECKING:
    from sqlalchemy import MetaData

STATIONS: Final = "stations"
SIGNED_REMARKS: Final = "signed_remarks"
TOMBSTONES: Final = "tombstones"
COUNTED: Final = "counted"
EXCESS: Final = "excess"

SCHOOL: Final = (STATIONS, SIGNED_REMARKS, TOMBSTONES, COUNTED, EXCESS)
"""Names of the tables; lists of people before version 3 have none of them."""

NUMBERS: Final = ("counter", "revoked", "anonymous", "number", "version", "uses", "attempts")
"""Columns of theirs that hold numbers; the others hold text."""


class Tombstone(NamedTuple):
    """What is left of an erased person: nothing that names anybody.

    Attributes:
        digest: SHA-256 of salt and key, hexadecimal.
        salt: random, hexadecimal.
        anonymous: whether the records stayed, as nobody's.
    """

    digest: str
    salt: str
    anonymous: bool

    @classmethod
    def over(cls, key: str, anonymous: bool) -> Tombstone:
        """Return one for a person's key, with a salt of its own."""
        salt = secrets.token_hex(16)
        return cls(_digest(salt, key), salt, anonymous)

    def is_of(self, key: str) -> bool:
        """Return whether it is that of the person with this key."""
        return self.digest == _digest(self.salt, key)


class ErasedKeys:
    """Tombstones to be asked about keys, each answer computed once.

    Args:
        tombstones: all that are known.
    """

    def __init__(self, tombstones: Iterable[Tombstone]) -> None:
        self._every = tuple(tombstones)
        self._known: dict[str, str] = {}

    def of(self, key: str) -> str:
        """Return `deleted` or `kept` for an erased person's key; empty for anybody else's.

        Where stations differ, records that one of them deleted are deleted.
        """
        if key not in self._known:
            kinds = {one.anonymous for one in self._every if one.is_of(key)} if key else set()
            self._known[key] = "" if not kinds else "deleted" if False in kinds else "kept"
        return self._known[key]


def add_tables(known: MetaData) -> None:
    """Define the tables: known stations, signed remarks, tombstones, attempts in their order."""
    from sqlalchemy import Boolean, Column, Table

    def text(name: str, **options: Any) -> Column[str]:
        return Column(name, words(), nullable=False, **options)

    def whole(name: str) -> Column[int]:
        return Column(name, number(whole=True), nullable=False)

    def flag(name: str) -> Column[bool]:
        return Column(name, Boolean, nullable=False)

    public = text("public", primary_key=True)
    named = (text("station"), text("name"), whole("counter"), flag("revoked"), text("seal"))
    Table(STATIONS, known, public, *named)
    place = (text("attempt", primary_key=True), text("kind", primary_key=True))
    signed = (text("station"), whole("counter"), text("public"), text("signature"))
    Table(SIGNED_REMARKS, known, *place, text("value"), text("student"), *signed)
    Table(TOMBSTONES, known, text("digest", primary_key=True), text("salt"), flag("anonymous"))
    attempt = text("attempt", primary_key=True)
    order = (text("station"), whole("number"), text("record"), text("student"))
    Table(COUNTED, known, attempt, *order, text("exercise"), whole("version"), flag("uses"))
    Table(EXCESS, known, text("attempt", primary_key=True), text("course"), whole("attempts"))


def _digest(salt: str, key: str) -> str:
    return hashlib.sha256(f"acus tombstone\0{salt}\0{key}".encode()).hexdigest()
