"""What other programs call a student: user name, e-mail address, ID number.

They are as personal as names, and stand in the same file, under the student's key and the kind
(`p-0123456789ab email`); so they go with the name, whatever erases, restores or leaves it out.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from typing import Final


class Account(StrEnum):
    """Kind of identifier, by Moodle's names of its fields."""

    USERNAME = "username"
    EMAIL = "email"
    IDNUMBER = "idnumber"


_KINDS: Final = frozenset(kind.value for kind in Account)


def entry_of(key: str, kind: str) -> str:
    """Return under which entry of the file of names a student's identifier stands."""
    return f"{key} {kind}"


def owner_of(entry: str) -> str:
    """Return the key of the student whose name or identifier an entry holds."""
    return entry.partition(" ")[0]


def accounts_in(names: Mapping[str, str]) -> dict[str, dict[Account, str]]:
    """Return the identifiers of each student, by key, that a file of names holds."""
    result: dict[str, dict[Account, str]] = {}
    for entry, value in names.items():
        key, _, kind = entry.partition(" ")
        if kind in _KINDS:
            result.setdefault(key, {})[Account(kind)] = value
    return result
