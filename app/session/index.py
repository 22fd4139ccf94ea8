"""The index of attempts: an SQLite file beside the records, which it can be made of at any time.

The records are the truth. A list asks `refresh` first: what has come, gone or changed since the
last look (by size and time of record and signature) is read, all else is taken as it is; `rebuild`
forgets all and reads every record. Both end with the same rows. A program that is killed in between
leaves whole rows only, and the next look reads what is missing. Where the folder cannot be written
the index is kept in memory.

Nothing is believed of a row that this station has not sealed (a keyed MAC over all of it): its
record is read instead. Where a station seals, an attempt counts if its signature is verified or the
instructor has admitted it.
"""

from __future__ import annotations

import hashlib
import hmac
import json
import os
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from functools import cached_property, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from app.core.json_values import finite
from app.core.messages import sentence
from app.core.progress import Progress
from app.scoring.conditions import Conditions, DeviceKind
from app.session.admission import Admission, admissions, with_admission
from app.session.database import BUSY_SECONDS, Database, DatabaseError, lockable
from app.session.people import People
from app.session.sealed_rows import (
    SEALED,
    STARTED,
    STUDENT,
    VERDICT,
    Row,
    Sealer,
    attempts_table,
    seals_table,
)
from app.session.sidecar import Cached, fresh_kept, read_kept
from app.session.signature import Signed, judged, signature_file, vouched_for
from app.session.station import StationKey, seals_here, this_station
from app.session.stations import mark_of_stations
from app.session.store import SUFFIX, records, settled
from app.session.summary import UNFINISHED, Summary

if TYPE_CHECKING:
    pass

INDEX: Final = "index.sqlite"
"""Name of the file in the folder of the records."""

_VERSION: Final = 3
_AT_ONCE: Final = 100
"""Rows that are written in one transaction."""

_STILL_WRITTEN: Final = 10.0
"""An unfinished record that changed within this time [s] is under way and comes in later."""


@dataclass(frozen=True)
class Indexed:
    """One attempt in the index.

    Attributes:
        id: of the attempt.
        started: ISO 8601, UTC.
        student: as the record names who did it.
        exercise: id.
        version: of the exercise.
        state: `ended`, `aborted`, `unfinished` or `broken`.
        duration: [s].
        total: points; None where it was not scored, is void or was altered after it was signed.
        passed: whether the score passes; None without one.
        verdict: of the signature.
        counts: whether it counts for a person: scored, by a person, not emulated, no
            drill, and it `stands`.
        under: what the score was made under, as text; empty where nothing is known.
        document: the summary as `Summary.document` gives it, as text.
        stands: whether this station vouches for it: verified, admitted by the instructor, or not
            altered where no station seals. What does not stand neither passes nor counts.
    """

    id: str
    started: str
    student: str
    exercise: str
    version: int
    state: str
    duration: float
    total: float | None
    passed: bool | None
    verdict: str
    counts: bool
    under: str
    document: str
    stands: bool = field(default=True, compare=False)

    @cached_property
    def summary(self) -> Summary:
        """The attempt as lists show it."""
        summary = Summary.of(json.loads(self.document), self.id)
        return replace(summary, signature=self.verdict)

    @cached_property
    def conditions(self) -> Conditions:
        """Return what the score was made under."""
        return _conditions_of(self.under) if self.under else Conditions(self.exercise)

    @property
    def time(self) -> datetime:
        """Return when it began; the beginning of 1970 where the record does not say."""
        try:
            found = datetime.fromisoformat(self.started)
        except ValueError:
            return datetime.fromtimestamp(0.0, UTC)
        return found if found.tzinfo else found.replace(tzinfo=UTC)


@lru_cache(maxsize=4096)
def _conditions_of(under: str) -> Conditions:
    """Read conditions from their text; most attempts of a group were made under the same."""
    return Conditions.of(json.loads(under))


@dataclass(frozen=True, slots=True)
class Refreshed:
    """What a look at the folder changed.

    Attributes:
        read: records that were read into the index.
        gone: rows whose record has gone.
        total: rows now.
        mended: rows that were not what this station had written, of those that were read.
    """

    read: int
    gone: int
    total: int
    mended: int = 0


def totals_of(folder: Path, student: str, exercise: str, version: int) -> list[float | None]:
    """Return the scores of a student's attempts at a version of an exercise, oldest first.

    Those that are nobody's and void ones are left out; one without a score is None.

    Args:
        folder: of the records.
        student: as the records name who did it.
        exercise: id.
        version: of the exercise.

    Raises:
        DatabaseError: if the index cannot be read.
    """
    index, remarks = Index(folder), People().remarks()
    index.refresh()
    return [
        one.total
        for one in index.attempts([student])
        if (one.exercise, one.version) == (exercise, version)
        and one.state in ("ended", "aborted", "unfinished")
        and one.conditions.by_person
        and (one.stands or one.state == UNFINISHED)
        and (one.id not in remarks or not remarks[one.id].uncounted)
    ]


Mark = tuple[int, int, int, str]
"""Size and time of a record, time of its signature, and the station whose key judged that, with
the stations that it knew."""


class Index:
    """The index of one folder of records.

    Args:
        folder: of the records; one that does not exist holds none.
        busy: seconds to wait for another program that writes.
    """

    def __init__(self, folder: Path, busy: float = BUSY_SECONDS) -> None:
        self.folder = folder
        path = folder / INDEX
        writable = os.access(path if path.exists() else folder, os.W_OK)
        usable = writable and os.access(folder, os.W_OK) and lockable(folder)
        where = path if usable else None
        self._busy = busy
        self.database = self._opened(where)

    def _opened(self, path: Path | None) -> Database:
        tables = lambda: attempts_table().metadata  # noqa: E731
        return Database(path, tables, _VERSION, "index", self._busy, disposable=True)

    @property
    def path(self) -> Path | None:
        """The file; None where the index is kept in memory."""
        return self.database.path

    def refresh(self, progress: Progress | None = None) -> Refreshed:
        """Bring the index up to date with the folder.

        Where its file cannot be written it goes on in memory.

        Raises:
            DatabaseError: if it cannot be read or written.
            SessionError: if the folder cannot be read.
            Cancelled: if that was asked for; what was read by then stays.
        """
        settled(self.folder)
        try:
            return self._refresh(progress or Progress())
        except DatabaseError as error:
            if not error.unwritable or self.path is None:
                raise
        self.database.close()
        self.database = self._opened(None)
        return self._refresh(progress or Progress())

    def _refresh(self, progress: Progress) -> Refreshed:
        key = this_station()
        there, known = self._there(key), self._known()
        changed = [name for name, mark in there.items() if known.get(name) != mark]
        gone = [name for name in known if name not in there]
        read = 0
        for begin in range(0, len(changed) + 1, _AT_ONCE):
            rows: list[dict[str, Any]] = []
            for name in changed[begin : begin + _AT_ONCE]:
                progress.report((begin + len(rows)) / len(changed), name)
                rows += _rows(self.folder, name, there[name], read_kept, key)
            if rows or (gone and begin == 0):
                self._put(rows, gone if begin == 0 else ())
            read += len(rows)
        return Refreshed(read, len(gone), len(self._known()))

    def rebuild(self, progress: Progress | None = None) -> Refreshed:
        """Make the index anew from the records, whatever it and their summaries say.

        Until all are read the old one stands; a file that is no index is replaced. Raises as
        `refresh`.
        """
        settled(self.folder)
        progress, key = progress or Progress(), this_station()
        there = self._there(key)
        rows: list[dict[str, Any]] = []
        for number, (name, mark) in enumerate(there.items()):
            progress.report(number / len(there), name)
            rows += _rows(self.folder, name, mark, fresh_kept, key)
        try:
            gone = len(set(self._known()) - set(there))
            self._put(rows, None)
        except DatabaseError as error:
            if error.newer or error.busy or error.unwritable:
                raise
            self.database.discard()
            gone = 0
            self._put(rows, None)
        return Refreshed(len(rows), gone, len(rows))

    def attempts(self, students: Sequence[str] | None = None) -> list[Indexed]:
        """Return what is in the index, oldest first; only that of some students if asked.

        Rows that this station has not sealed are read anew from their records.

        Raises:
            DatabaseError: if it cannot be read, or what the instructor has admitted cannot.
        """
        key, admitted = this_station(), admissions()
        # a key that somebody took away: what is unsigned counts no more than before
        seals = seals_here() or bool(People().wrapped_key())
        rows, odd = self._sealed_rows(key)
        if odd:
            rows += self._mend(odd, key)
            rows.sort(key=lambda row: (row[STARTED], row[0]))
        asked = None if students is None else set(students)
        return [
            _indexed(row, seals, admitted.get(row[0]))
            for row in rows
            if asked is None or row[STUDENT] in asked
        ]

    def problems_of(self, path: Path) -> list[str]:
        """Say in which values the row of a record is not what the record gives; changes nothing.

        A row that is merely not up to date, or not there, has no problems.

        Raises:
            DatabaseError: if the index cannot be read.
        """
        key = this_station()
        mark = self._there(key).get(path.stem)
        found = next((row for row in self._rows_as_they_are() if row[0] == path.stem), None)
        if mark is None or found is None or found[1:5] != mark:
            return []
        row = dict(zip(SEALED, found, strict=False))
        right = next(iter(_rows(self.folder, path.stem, mark, read_kept, key)), None)
        if right is None:
            return []
        other = [name for name in SEALED if row[name] != right[name] and name != "record"]
        told: list[str] = [
            sentence(
                "{name}: {row!r} in the index, {right!r} by the record",
                name=name,
                row=row[name],
                right=right[name],
            )
            for name in other
            if name not in ("document", "under")
        ]
        if not told and (other or found[-1] != Sealer(key)(found[:-1])):
            told = [sentence("its row was not written by this station")]
        return told

    def content(self) -> str:
        """Return a digest of all rows: the same for two indexes that say the same."""
        from sqlalchemy import select

        table = attempts_table()
        digest = hashlib.sha256()
        with self.database.read() as connection:
            for row in connection.execute(select(table).order_by(table.c.id)):
                digest.update(repr(tuple(row)).encode())
        return digest.hexdigest()

    # --- inside -----------------------------------------------------------------------------------
    def _rows_as_they_are(self) -> list[Row]:
        """Return all rows as they stand, oldest first: what a seal is over, and the seal at last.

        Digest of the record and seal are None where there is none.
        """
        from sqlalchemy import select

        table, seals = attempts_table(), seals_table()
        columns = [*table.columns, seals.c.record, seals.c.seal]
        wanted = select(*columns).outerjoin(seals, table.c.id == seals.c.id)
        with self.database.read() as connection:
            found = connection.execute(wanted.order_by(table.c.started, table.c.id))
            return [tuple(row) for row in found]

    def _sealed_rows(self, key: StationKey | None) -> tuple[list[Row], list[str]]:
        """Return the rows that this station has sealed, and the ids of the others."""
        rows, odd, seal_of = [], [], Sealer(key)
        for row in self._rows_as_they_are():
            if hmac.compare_digest(str(row[-1]).encode(), seal_of(row[:-1]).encode()):
                rows.append(row)
            else:
                odd.append(str(row[0]))
        return rows, odd

    def _mend(self, names: Sequence[str], key: StationKey | None) -> list[Row]:
        """Read records anew, and write their rows where the index can be written."""
        there, rows = self._there(key), []
        for name in names:
            if name in there:
                rows += _rows(self.folder, name, there[name], read_kept, key)
        with suppress(DatabaseError):
            self._put(rows, [name for name in names if name not in there])
        return [tuple(row[name] for name in SEALED) for row in rows]

    def _there(self, key: StationKey | None) -> dict[str, Mark]:
        """Return the marks of the records in the folder now."""
        station, marks = mark_of_stations(key), {}
        for path in records(self.folder):
            try:
                stat = path.stat()
            except OSError:
                continue  # it has gone meanwhile
            try:
                signed = signature_file(path).stat().st_mtime_ns
            except OSError:
                signed = 0
            marks[path.stem] = (stat.st_size, stat.st_mtime_ns, signed, station)
        return marks

    def _known(self) -> dict[str, Mark]:
        from sqlalchemy import select

        c = attempts_table().c
        wanted = select(c.id, c.size, c.modified_ns, c.signed_ns, c.station)
        with self.database.read() as connection:
            return {row[0]: (row[1], row[2], row[3], row[4]) for row in connection.execute(wanted)}

    def _put(self, rows: Sequence[Mapping[str, Any]], gone: Sequence[str] | None) -> None:
        """Write rows and take those out that have gone; None takes out all others."""
        from sqlalchemy import delete
        from sqlalchemy.dialects.sqlite import insert

        seal_of = Sealer(this_station())
        sealed = [
            dict(row) | {"seal": seal_of(tuple(row[name] for name in SEALED))} for row in rows
        ]
        with self.database.write() as connection:
            for table in (attempts_table(), seals_table()):
                if gone is None:
                    connection.execute(delete(table))
                for begin in range(0, len(gone or ()), _AT_ONCE):
                    some = (gone or ())[begin : begin + _AT_ONCE]
                    connection.execute(delete(table).where(table.c.id.in_(some)))
                if sealed:
                    put, names = insert(table), [column.name for column in table.columns]
                    new = {name: put.excluded[name] for name in names}
                    part = [{name: row[name] for name in names} for row in sealed]
                    connection.execute(put.on_conflict_do_update(["id"], set_=new), part)


def _rows(
    folder: Path,
    name: str,
    mark: Mark,
    kept_of: Callable[[Path], Cached],
    key: StationKey | None,
) -> list[dict[str, Any]]:
    """Return the row of a record; none of one that is under way."""
    path = folder / f"{name}{SUFFIX}"
    kept = kept_of(path)
    summary = judged(path, kept, key)
    if summary.state == UNFINISHED and time.time() - mark[1] * 1e-9 < _STILL_WRITTEN:
        return []
    score, known = summary.score or {}, summary.conditions
    total = None if score.get("total") is None else float(score["total"])
    person = known is not None and known.by_person and known.kind is not DeviceKind.EMULATED
    person = person and not (known is not None and known.drill)
    return [
        {
            "id": name,
            "size": mark[0],
            "modified_ns": mark[1],
            "signed_ns": mark[2],
            "station": mark[3],
            "started": summary.started,
            "student": summary.student,
            "exercise": summary.exercise_id,
            "version": known.version if known is not None else 0,
            "state": summary.state,
            "duration": float(summary.duration),
            "total": total,
            "passed": score.get("passed") if total is not None else None,
            "verdict": summary.signature,
            "counts": person and total is not None and not score.get("void_reason"),
            "under": "" if known is None else json.dumps(finite(known.document()), sort_keys=True),
            "document": json.dumps(summary.document(), sort_keys=True, ensure_ascii=False),
            "record": kept.sha256,
        }
    ]


def _indexed(row: Row, seals: bool, admitted: Admission | None) -> Indexed:
    """Return an attempt with what this station says of it now."""
    verdict, record = row[VERDICT], row[len(SEALED) - 1]
    if admitted is not None:
        verdict = with_admission(verdict, record, admitted)
    stands = vouched_for(verdict) if seals else verdict != Signed.ALTERED
    values = row[STARTED : len(SEALED) - 1]
    found = Indexed(*(row[0], *values, stands))
    if not stands:
        return replace(found, counts=False, passed=None)
    return found if verdict == row[VERDICT] else replace(found, verdict=verdict)
