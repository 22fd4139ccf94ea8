"""Tries of PINs and passwords: compared under the delay that wrong ones have earned.

They are compared one after the other, and whom nobody knows costs the same work and words. Where
the file of the tries cannot be written, the program that runs counts them for itself.
"""

from __future__ import annotations

import secrets
import threading
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from hashlib import blake2b
from typing import TYPE_CHECKING, Final

from app.core.messages import sentence
from app.session.database import Database, DatabaseError
from app.session.errors import PeopleError

if TYPE_CHECKING:
    from sqlalchemy import Connection, Table

INSTRUCTOR: Final = "the instructor"
"""The account of the password."""
NO_SIGN_IN: Final = sentence("pseudonym or PIN is wrong")

_FREE_TRIES: Final = 3
_FIRST_DELAY, _LONGEST_DELAY = 5.0, 300.0
_STRANGER: Final = "nobody "
"""Begins the accounts of whom nobody knows; keys of students begin otherwise."""
_STRANGERS: Final = 256

_wrong_here: dict[tuple[object, str], tuple[int, float]] = {}
"""Wrong tries and time of the last one [s], by file and account: of this program alone, where the
file cannot be written. The file's own count of earlier ones holds as well."""
_counting = threading.Lock()


class WrongPasswordError(PeopleError):
    """A PIN or password is wrong, or it is too early for another try."""


@dataclass(frozen=True, slots=True)
class Tries:
    """Counts the tries of every account.

    Attributes:
        database: that holds them.
        table: `account`, `wrong` and `last`.
        clock: wall-clock time [s].
    """

    database: Database
    table: Table
    clock: Callable[[], float]

    def compare(self, account: str, known: str, given: str) -> str:
        """Compare under the delay that wrong tries have earned.

        All of it is one transaction, so that of many tries at one moment no more are compared than
        one after the other would be, and right ones at one moment keep nobody out. A file that
        cannot be written (a full disk, a folder that can only be read) keeps nobody out either.

        Args:
            account: whose tries these are.
            known: the hash; an empty one matches nothing, and takes as long.
            given: what was typed.

        Returns:
            Why wrong tries are not kept; empty if they are.

        Raises:
            WrongPasswordError: with how long to wait for the next try.
        """
        why = ""
        try:
            early, count, right = self._compared_in_file(account, known, given)
        except DatabaseError as error:
            if not error.unwritable:
                raise
            early, count, right = self._compared_here(account, known, given)
            why = sentence("{error}; until then wrong tries are not kept", error=error)
        if early > 0.0:
            raise WrongPasswordError(
                sentence("too many wrong tries: wait {early:.0f} s, then try again", early=early)
            )
        if right:
            return why
        wait = _delay(count)
        more = (
            sentence(": wait {wait:.0f} s before the next try", wait=wait)
            if wait
            else ": try again"
        )
        what = sentence("the password is wrong") if account == INSTRUCTOR else NO_SIGN_IN
        raise WrongPasswordError(what + more)

    def _compared_in_file(self, account: str, known: str, given: str) -> tuple[float, int, bool]:
        """Compare and count in the file: seconds too early, wrong tries, whether it is right."""
        from sqlalchemy import insert, select

        table, now = self.table, self.clock()
        with self.database.write() as connection:
            row = connection.execute(select(table).where(table.c.account == account)).first()
            count, last = (row.wrong, row.last) if row is not None else (0, now)
            early = _delay(count) - abs(now - last) if row is not None else 0.0
            right = early <= 0.0 and matches(known, given)
            if early <= 0.0:
                connection.execute(table.delete().where(table.c.account == account))
            if early <= 0.0 and not right:
                new = {"account": account, "wrong": count + 1, "last": now}
                connection.execute(insert(table), new)
                _forget_strangers(connection, table)
        return early, count + 1, right

    def _compared_here(self, account: str, known: str, given: str) -> tuple[float, int, bool]:
        """Compare and count in this program alone; else as `_compared_in_file`."""
        from sqlalchemy import select

        table, now, key = self.table, self.clock(), (self.database.path, account)
        with self.database.read() as connection:
            row = connection.execute(select(table).where(table.c.account == account)).first()
        with _counting:
            kept = (row.wrong, row.last) if row is not None else (0, None)
            count, last = _wrong_here.get(key, kept)
            early = 0.0 if last is None else _delay(count) - abs(now - last)
            right = early <= 0.0 and matches(known, given)
            if early <= 0.0:
                _wrong_here[key] = (0 if right else count + 1, now)
        return early, count + 1, right


def hashed_secret(secret: str) -> str:
    """Hash with Argon2id: 19 MiB, 2 passes (the least that OWASP recommends), some 30 ms."""
    from argon2 import PasswordHasher

    return PasswordHasher(time_cost=2, memory_cost=19456, parallelism=1).hash(secret)


def matches(known: str, given: str) -> bool:
    """Return whether what was given has this hash; it takes as long where there is none to
    compare.
    """
    from argon2 import PasswordHasher
    from argon2.exceptions import InvalidHashError, VerificationError

    nobodys = _nobodys_hash()
    try:
        return PasswordHasher().verify(known or nobodys, given) and bool(known)
    except (VerificationError, InvalidHashError, UnicodeError):
        return False


@cache
def _nobodys_hash() -> str:
    """Return the hash of what nobody knows."""
    return hashed_secret(secrets.token_hex(16))


def stranger(pseudonym: str) -> str:
    """Return the account that counts tries for whom nobody knows: a digest, as it may be a name."""
    typed = pseudonym.strip().casefold().encode("utf-8", "surrogatepass")
    return _STRANGER + blake2b(typed, digest_size=16).hexdigest()


def _forget_strangers(connection: Connection, table: Table) -> None:
    """Keep the tries of the newest few whom nobody knows: anybody can type any name."""
    from sqlalchemy import select

    theirs = table.c.account.like(f"{_STRANGER}%")
    newest = select(table.c.account).where(theirs).order_by(table.c.last.desc())
    kept = newest.limit(_STRANGERS)
    connection.execute(table.delete().where(theirs & table.c.account.not_in(kept)))


def _delay(failures: int) -> float:
    """Seconds to wait after so many wrong tries: 5 after the third, then doubled, at most 300."""
    if failures < _FREE_TRIES:
        return 0.0
    return min(_LONGEST_DELAY, _FIRST_DELAY * 2.0 ** min(failures - _FREE_TRIES, 20))
