"""The folder of recorded attempts: list, find, delete to a trash folder and bring back."""

import os
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Final

from app.core.messages import sentence
from app.core.paths import sessions
from app.core.temporary import hidden
from app.session.admission import Admission, admissions, with_admission
from app.session.audit import note
from app.session.calibration_flag import CalibrationFlags
from app.session.database import DatabaseError
from app.session.errors import SessionError, SessionNotFoundError
from app.session.header import TRASH as TRASH
from app.session.journal import Journal, move, settle
from app.session.mcap_file import remove_strays
from app.session.people import people_folder
from app.session.sidecar import Cached, fresh_kept, read_kept, sidecar, under_way
from app.session.signature import judged, signature_file
from app.session.station import this_station
from app.session.summary import Summary

SUFFIX: Final = ".mcap"

_cleared: set[Path] = set()
"""Folders in which this program has looked for what others left."""


def list_sessions(folder: Path) -> list[Summary]:
    """All sessions, newest first; unreadable files are in the list, with the reason.

    A folder that does not exist holds none. Those made with a calibration of the cameras that was
    later found bad say so among their problems, and each says what its signature says.

    Raises:
        SessionError: if the folder cannot be read.
    """
    return _sorted(folder, read_kept)


def computed(folder: Path, names: Sequence[str] = ()) -> list[Summary]:
    """Return summaries that are computed from their records, for exports.

    Args:
        folder: of the records.
        names: ids, or their beginnings, in the order asked for; none for all, newest first.

    Raises:
        SessionNotFoundError: if one is not there.
        SessionError: if the folder cannot be read.
    """
    if not names:
        return _sorted(folder, fresh_kept)
    return _listed([find(folder, name) for name in names], fresh_kept)


def verdict_of(path: Path) -> str:
    """Return what lists say of a record: `verified`, `altered`, `unsigned` or `admitted`."""
    return _listed([path], read_kept)[0].signature


def find(folder: Path, session_id: str) -> Path:
    """Return the record of a session; the beginning of an id is enough if only one fits.

    Raises:
        SessionNotFoundError: if none or several fit; names none, for not everybody may see them.
    """
    names = {path.stem: path for path in records(folder)}
    alike = [name for name in names if name.startswith(session_id)]
    fitting = [session_id] if session_id in names else alike
    if len(fitting) == 1 and session_id:
        return names[fitting[0]]
    many = fitting and session_id
    what = sentence("fits several sessions") if many else sentence("is no session")
    raise SessionNotFoundError(
        sentence(
            "{session_id!r} {trouble} in {folder}: `acus session list` says which there are",
            session_id=session_id,
            trouble=what,
            folder=folder,
        )
    )


def located(name: str, chosen: Path | None) -> tuple[Path, str]:
    """Return the folder of a record, and what `find` knows it by there.

    Args:
        name: id of a session, or its beginning; or the path of its record, of the folder that holds
            no other, or of a folder whose `sessions` does, as a demonstration leaves one.
        chosen: folder of the records; None for this user's, or where `name` is a path.

    Raises:
        SessionError: if the chosen one is no folder, or cannot be read.
        SessionNotFoundError: if a folder holds no record, or several.
    """
    path = Path(name)
    if chosen is not None or not name or not path.exists():
        return records_folder(chosen), name
    if path.is_file():
        return records_folder(path.parent), path.stem if path.suffix == SUFFIX else path.name
    place = path / "sessions" if (path / "sessions").is_dir() else path
    there = records(place)
    if len(there) == 1:
        return records_folder(place), there[0].stem
    raise SessionNotFoundError(
        sentence(
            "{folder} holds {count} records: give the file of one of them",
            folder=place,
            count=len(there),
        )
    )


def delete(folder: Path, session_id: str) -> Path:
    """Move a session to the trash folder; `restore` undoes it.

    Raises:
        SessionNotFoundError: if there is no such session.
        SessionError: if it is under way, or cannot be moved.
    """
    settled(folder)
    path = find(folder, session_id)
    if under_way(path):
        raise SessionError(
            sentence(
                "{path_stem} is being recorded: end its attempt first, or wait 10 s",
                path_stem=path.stem,
            )
        )
    with suppress(OSError):
        os.utime(sidecar(path))  # its time tells from now on when the record was deleted
    note("attempt deleted", [path.stem])
    return _move(path, folder / TRASH, folder)


def restore(folder: Path, session_id: str) -> Path:
    """Bring a deleted session back.

    Raises:
        SessionNotFoundError: if the trash does not hold it.
        SessionError: if it cannot be moved.
    """
    settled(folder)
    path = find(folder / TRASH, session_id)
    note("attempt brought back", [path.stem])
    return _move(path, folder, folder)


def _sorted(folder: Path, kept_of: Callable[[Path], Cached]) -> list[Summary]:
    settled(folder.parent if folder.name == TRASH else folder)
    summaries = _listed(records(folder), kept_of)
    return sorted(summaries, key=lambda summary: (summary.started, summary.id), reverse=True)


def _listed(paths: Sequence[Path], kept_of: Callable[[Path], Cached]) -> list[Summary]:
    """Return summaries with what their signatures, or the instructor, say of them."""
    flags, key = CalibrationFlags.read(), this_station()
    admitted, summaries = _admitted(), []
    for path in paths:
        kept = kept_of(path)
        summary = flags.flagged(judged(path, kept, key))
        verdict = with_admission(summary.signature, kept.sha256, admitted.get(path.stem))
        summaries.append(replace(summary, signature=verdict))
    return summaries


def _admitted() -> dict[str, Admission]:
    """Return what was admitted; nothing where that cannot be read: lists go on."""
    try:
        return admissions()
    except DatabaseError:
        return {}


def records_folder(chosen: Path | None) -> Path:
    """Return the folder of the records: the one that was chosen, else this user's.

    Raises:
        SessionError: if the chosen one is no folder.
    """
    if chosen is None:
        return settled(sessions())
    if not chosen.is_dir():
        raise SessionError(
            sentence(
                "{chosen} is not a folder: give the folder that holds the records", chosen=chosen
            )
        )
    return settled(chosen)


def records(folder: Path) -> list[Path]:
    """Return the files of all records in a folder, by name; none where there is no such folder.

    Raises:
        SessionError: if the folder cannot be read.
    """
    try:
        return sorted(path for path in folder.iterdir() if path.suffix == SUFFIX and path.is_file())
    except FileNotFoundError:
        return []
    except OSError as error:
        raise unreadable_folder(folder, error) from error


def unreadable_folder(folder: Path, error: OSError) -> SessionError:
    """Return what is said of a folder that cannot be read."""
    return SessionError(
        sentence(
            "cannot read the folder {folder}: {error_strerror}",
            folder=folder,
            error_strerror=error.strerror or error,
        )
    )


def beside(path: Path) -> tuple[Path, ...]:
    """Return what belongs to a record: the files beside it, and itself at last."""
    return sidecar(path), signature_file(path), path


def settled(folder: Path) -> Path:
    """Return a folder of records after whatever killed programs left there was put in order."""
    settle(people_folder())  # first: a restore is planned there
    names = hidden(folder) if folder not in _cleared else None  # once for both: it may be long
    settle(folder, names)
    if names is not None:
        _cleared.add(folder)
        remove_strays(folder, names)
    return folder


def _move(path: Path, to: Path, folder: Path) -> Path:
    """Move a record with what stands beside it as one step of the folder of the records."""
    target = to / path.name
    if target.exists():
        raise SessionError(sentence("{target} exists already: move it away first", target=target))
    with Journal(folder) as journal:
        steps = [move(a, b) for a, b in zip(beside(path), beside(target), strict=True)]
        try:
            journal.plan(steps)
        except OSError as error:
            why = error.strerror or error
            raise SessionError(
                sentence("cannot move {path} to {to}: {reason}", path=path, to=to, reason=why)
            ) from error
    return target
