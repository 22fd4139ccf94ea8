"""Erasing: a person for good, and what has been among the deleted attempts too long."""

from __future__ import annotations

import errno
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Final, NamedTuple

from app.core.messages import sentence
from app.session.audit import note
from app.session.errors import SessionError
from app.session.header import TRASH
from app.session.index import Index
from app.session.journal import Journal, carry_out, removal
from app.session.people import People
from app.session.sidecar import read_kept, sidecar
from app.session.store import beside, records

UNDO_DAYS: Final = 30
"""What was deleted can be brought back for so long at least."""


class Erased(NamedTuple):
    """What became of the records of somebody who was erased.

    Attributes:
        deleted: how many went.
        anonymous: how many stay as nobody's.
    """

    deleted: int
    anonymous: int


def erase_person(
    pseudonym: str, folder: Path, delete_records: bool, people: People | None = None
) -> Erased:
    """Erase a person for good; return what became of the records.

    Name, PIN, groups and comments go. Records of attempts made signed in hold a random key only:
    they go too, or stay as nobody's. One made without signing in names nobody who is known here.

    Raises:
        PeopleError: if there is no such student.
        DatabaseError, SessionError: if something cannot be read or written.
    """
    people = people or People()
    person = people.find(pseudonym)
    index = Index(folder)
    index.refresh()
    own = {one.id for one in index.attempts([person.key])}
    trash = records(folder / TRASH)
    own |= {path.stem for path in trash if read_kept(path).summary.student == person.key}
    ids, there = sorted(own), (*records(folder), *trash)
    files = [file for path in there if path.stem in own for file in beside(path)]
    note("student erased", [person.key], people.folder)
    if delete_records:
        people.forget_keys([person.key], ids, ids, files)
        index.refresh()
        return Erased(len(ids), 0)
    people.forget_keys([person.key], ids, anonymous=True)
    return Erased(0, len(ids))


def finish_erasing(folder: Path, people: People) -> int:
    """Delete records of erased persons that are left; return how many."""
    gone = people.erased_attempts()
    places = (folder, folder / TRASH) if gone else ()
    left = [path for place in places for path in records(place) if path.stem in gone]
    _remove(folder, left)
    return len(left)


def empty_trash(folder: Path, days: float = UNDO_DAYS, now: float | None = None) -> list[str]:
    """Delete for good what was deleted more than so many days ago; return the ids.

    Raises:
        SessionError: if something cannot be deleted.
    """
    now = time.time() if now is None else now
    old = [path for path in records(folder / TRASH) if now - deleted_at(path) > days * 86400.0]
    _remove(folder, old)
    return [path.stem for path in old]


def deleted_at(path: Path) -> float:
    """Return when a record in the trash was deleted [s since 1970]."""
    beside = sidecar(path)
    return beside.stat().st_mtime if beside.exists() else path.stat().st_ctime


# --- inside ---------------------------------------------------------------------------------------
def _remove(folder: Path, paths: Sequence[Path]) -> None:
    """Delete records with what stands beside them, as one step.

    On a full disk, where that cannot be planned, one file after the other.
    """
    steps = [removal(file) for path in paths for file in beside(path)]
    if not steps:
        return
    try:
        with Journal(folder, steps):
            return
    except SessionError as error:
        cause = error.__cause__
        if not isinstance(cause, OSError) or cause.errno not in (errno.ENOSPC, errno.EDQUOT):
            raise
    try:
        carry_out(steps)
    except OSError as error:
        raise SessionError(
            sentence("cannot delete: {error_strerror}", error_strerror=error.strerror or error)
        ) from error
