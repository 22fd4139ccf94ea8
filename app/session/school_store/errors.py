"""What can go wrong with the school's store, in words that say what to do."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from app.core.messages import sentence
from app.session.errors import SessionError


class StoreError(SessionError):
    """The school's store refuses something, or holds what cannot be used."""


class UnreachableStoreError(StoreError):
    """The school's store does not answer: this station goes on, and tries again later."""


_FULL: Final = ("53100", "disk is full", "No space left")
_DENIED: Final = ("42501", "3F000", "25006", "readonly database", "permission denied")
_LOGIN: Final = ("28P01", "28000", "password authentication failed", "no password supplied")
_NO_DATABASE: Final = ("3D000",)
_NOWHERE: Final = re.compile('database ".*" does not exist')
_SLOW: Final = ("57014", "canceling statement", "database is locked")
_NOT_OURS: Final = ("not a database", "malformed", "no such table", "42P01")


@contextmanager
def named_errors(name: str, seconds: float) -> Iterator[None]:
    """Turn what a database says into a message that names the store and says what to do.

    Args:
        name: of the store, without its password.
        seconds: that an answer may take.

    Raises:
        UnreachableStoreError: if it does not answer in time.
        StoreError: if it refuses.
    """
    from sqlalchemy.exc import SQLAlchemyError

    try:
        yield
    except SQLAlchemyError as error:
        raise _error(error, name, seconds) from error


def _error(error: Exception, name: str, seconds: float) -> StoreError:
    origin = getattr(error, "orig", None)
    text = f"{getattr(origin, 'sqlstate', '') or ''} {origin or error}"
    if any(each in text for each in _FULL):
        return StoreError(
            sentence(
                "the school's store {name} has no room left: its administrator makes some; nothing "
                "is lost, it is sent once there is",
                name=name,
            )
        )
    if any(each in text for each in _DENIED):
        return StoreError(
            sentence(
                "the school's store {name} may only be read by this user: its administrator gives "
                "the right to write; nothing is lost, it is sent then",
                name=name,
            )
        )
    if any(each in text for each in _LOGIN):
        return StoreError(
            sentence(
                "the school's store {name} does not know this user and password: give those of its "
                "administrator in the URL",
                name=name,
            )
        )
    if any(each in text for each in _NO_DATABASE) or _NOWHERE.search(text):
        return StoreError(
            sentence(
                "there is no such database at {name}: its administrator makes it (`createdb`)",
                name=name,
            )
        )
    if any(each in text for each in _SLOW):
        return UnreachableStoreError(
            sentence(
                "the school's store {name} takes longer than {seconds:g} s: this station goes on "
                "and tries again",
                name=name,
                seconds=seconds,
            )
        )
    if any(each in text for each in _NOT_OURS):
        return StoreError(
            sentence(
                "{name} is no school's store, or a damaged one: give the URL of an empty database, "
                "or bring it back from its backup",
                name=name,
            )
        )
    return UnreachableStoreError(
        sentence(
            "the school's store {name} does not answer: nothing is lost, this station goes on and "
            "tries again; if it stays so, its administrator starts it ({reason})",
            name=name,
            reason=str(origin or error).strip().splitlines()[0][:200],
        )
    )
