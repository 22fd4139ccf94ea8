"""The index of attempts: an SQLite file beside the records, which it can be made of at any time.

The records are the truth. A list asks `refresh` first: what has come, gone or changed since the
last look is read, all else is taken as it is; `rebuild` forgets all and reads every record. Both
end with the same rows. One listing of the folder tells what came, went or was put in the place of
another (names and inodes); size and time tell what was written where it lies. They are asked for of
attempts that have no end and of `LOOKED_AT` others, drawn by chance where there are more. A program
that is killed in between leaves whole rows only, and the next look reads what is missing. Where the
folder cannot be written the index is kept in memory.

Nothing is believed of a row that this station has not sealed (a keyed MAC over all of it): its
record is read instead. Where a station seals, an attempt counts if its signature is verified or the
instructor has admitted it.
"""

from __future__ import annotations

import hashlib
import hmac
import os
import secrets
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import chain, islice
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from app.core.messages import sentence
from app.core.progress import Progress
from app.session.admission import admissions
from app.session.database import BUSY_SECONDS, Database, DatabaseError, lockable
from app.session.errors import SessionNotFoundError
from app.session.index_pages import PAGE, IndexPage, IndexPages, attempts_of, dissolve
from app.session.index_records import Listing, listing, mark_of, rows_of
from app.session.indexed import Attempts, Texts
from app.session.indexed import Indexed as Indexed
from app.session.people import People
from app.session.sealed_rows import (
    MARK,
    SEALED,
    STARTED,
    UNDER,
    Row,
    Sealer,
    attempts_table,
    seals_table,
)
from app.session.sidecar import fresh_kept, read_kept
from app.session.station import StationKey, seals_here, this_station
from app.session.stations import mark_of_stations
from app.session.store import settled
from app.session.summary import UNFINISHED

if TYPE_CHECKING:
    from sqlalchemy import Connection

INDEX: Final = "index.sqlite"
"""Name of the file in the folder of the records."""

_VERSION: Final = 4
_AT_ONCE: Final = 100
"""Rows that are written in one transaction."""

LOOKED_AT: Final = 1024
"""Of so many records at most a look asks for size and time, those without an end apart."""


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
        self._pages, self._loose_rows = IndexPages(this_station()), 0

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
        there, known = listing(self.folder), self._known(key)
        changed, gone = [], []
        if there != known:
            changed = sorted(name for name, inodes in there.items() if known.get(name) != inodes)
            gone = [name for name in known if name not in there]
        changed += self._written(there, known, key)
        read, station = 0, mark_of_stations(key)
        for begin in range(0, max(len(changed), len(gone)) + 1, _AT_ONCE):
            rows: list[dict[str, Any]] = []
            for name in changed[begin : begin + _AT_ONCE]:
                progress.report((begin + len(rows)) / len(changed), name)
                mark = mark_of(self.folder, name, there, station)
                rows += rows_of(self.folder, name, mark, read_kept, key) if mark else []
            if rows or gone[begin : begin + _AT_ONCE]:
                self._put(rows, gone[begin : begin + _AT_ONCE])
            read += len(rows)
        if changed or gone:
            known = self._known(key)
        self._turn_pages()
        return Refreshed(read, len(gone), len(known))

    def rebuild(self, progress: Progress | None = None) -> Refreshed:
        """Make the index anew from the records, whatever it and their summaries say.

        Until all are read the old one stands; a file that is no index is replaced. Raises as
        `refresh`.
        """
        settled(self.folder)
        progress, key = progress or Progress(), this_station()
        there, station = listing(self.folder), mark_of_stations(key)
        rows: list[dict[str, Any]] = []
        for number, name in enumerate(sorted(there)):
            progress.report(number / len(there), name)
            mark = mark_of(self.folder, name, there, station)
            rows += rows_of(self.folder, name, mark, fresh_kept, key) if mark else []
        try:
            gone = len(set(self._known(key)) - set(there))
            self._put(rows, None)
        except DatabaseError as error:
            if error.newer or error.busy or error.unwritable:
                raise
            self.database.discard()
            gone = 0
            self._put(rows, None)
        self._known(key)
        self._turn_pages()
        return Refreshed(len(rows), gone, len(rows))

    def attempts(self, students: Sequence[str] | None = None) -> Attempts:
        """Return what is in the index, oldest first; only that of some students if asked.

        Rows that this station has not sealed are read anew from their records.

        Raises:
            DatabaseError: if it cannot be read, or what the instructor has admitted cannot.
        """
        key, admitted = this_station(), admissions()
        # a key that somebody took away: what is unsigned counts no more than before
        seals = seals_here() or bool(People().wrapped_key())
        with self.database.read() as connection:
            pages, loose = self._look(connection, key), self._loose(connection)
        rows, odd = _sealed(loose, key)
        rows += self._mend(odd, key) if odd else []
        found = attempts_of([*pages.sound.values(), IndexPage.of(rows)], _no_texts, seals, admitted)
        found = replace(found, texts=self._texts(found.ids))
        return found if students is None else found.of_students(students)

    def problems_of(self, path: Path) -> list[str]:
        """Say in which values the row of a record is not what the record gives; changes nothing.

        A row that is merely not up to date, or not there, has no problems.

        Raises:
            DatabaseError: if the index cannot be read.
        """
        key = this_station()
        there = listing(self.folder)
        with self.database.read() as connection:
            found = next(iter(_rows_in(connection, [path.stem])), None)
        if found is None or found[MARK] != mark_of(
            self.folder, path.stem, there, mark_of_stations(key)
        ):
            return []
        row = dict(zip(SEALED, found, strict=False))
        right = next(iter(self._rows_of([path.stem], there, key)), None)
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
    def _look(self, connection: Connection, key: StationKey | None) -> IndexPages:
        if self._pages.key != key:
            self._pages = IndexPages(key)
        self._pages.look(connection)
        return self._pages

    def _loose(self, connection: Connection) -> list[Row]:
        """Return the rows that are in no page, or in one that this station has not sealed."""
        pages = self._pages
        broken = ",".join(map(str, pages.broken))
        odd = "page >= ''"  # texts and bytes, which SQLite sorts after all numbers
        wanted = f"SELECT id FROM seals WHERE page IS NULL OR {odd} OR page IN ({broken})"
        ids = [str(row[0]) for row in connection.exec_driver_sql(wanted)]
        every = list(dict.fromkeys(ids + pages.let_go(ids)))
        self._loose_rows = len(every)
        return _rows_in(connection, every)

    def _known(self, key: StationKey | None) -> Listing:
        """Return inodes by attempt, of those that were judged as this station judges now."""
        station = mark_of_stations(key)
        with self.database.read() as connection:
            pages, loose = self._look(connection, key), self._loose(connection)
        known: Listing = {}
        for page in (*pages.sound.values(), IndexPage.of([row[:-1] for row in loose])):
            inodes = (page.numbers[name].tolist() for name in ("inode", "signed_inode"))
            known.update(zip(page.texts["id"], zip(*inodes, strict=True), strict=True))
            judged_by = page.coded["station"]
            if judged_by.texts != (station,):
                other = np.flatnonzero(judged_by.within({station: 1}) < 0)
                known.update((page.texts["id"][k], (-1, -1)) for k in other.tolist())
        return known

    def _written(self, there: Listing, known: Listing, key: StationKey | None) -> list[str]:
        """Return attempts that were written where they lie: of those that have no end, and some."""
        names = list(there)
        begin = secrets.randbelow(len(names)) if len(names) > LOOKED_AT else 0
        some = islice(chain(names[begin:], names), min(LOOKED_AT, len(names)))
        with self.database.read() as connection:
            endless = "SELECT id FROM attempts WHERE state = ?"
            rows = connection.exec_driver_sql(endless, (UNFINISHED,))
            asked = dict.fromkeys(chain(some, (str(row[0]) for row in rows)))
            same = [name for name in asked if name in there and known.get(name) == there[name]]
            marks = {str(row[0]): tuple(row[1:]) for row in _marks_in(connection, same)}
        station = mark_of_stations(key)
        of = {name: mark_of(self.folder, name, there, station) for name in same}
        return [name for name, mark in of.items() if mark is not None and marks.get(name) != mark]

    def _turn_pages(self) -> None:
        """Put loose rows into pages once there are enough, and where that can be."""
        key = this_station()
        if self._loose_rows < PAGE:
            return
        with suppress(DatabaseError), self.database.write() as connection:
            self._look(connection, key)
            rows, _ = _sealed(self._loose(connection), key)
            dissolve(connection, (), self._pages.broken)
            self._pages.put(connection, rows)

    def _texts(self, ids: Sequence[str]) -> Texts:
        """Return what reads the texts of attempts, some neighbours at a time."""

        @lru_cache(maxsize=4)
        def neighbours(number: int) -> dict[str, tuple[str, str]]:
            some, key = ids[number * PAGE : (number + 1) * PAGE], this_station()
            with self.database.read() as connection:
                rows, _ = _sealed(_rows_in(connection, some), key)
            odd = set(some) - {row[0] for row in rows}
            rows += self._mend(sorted(odd), key) if odd else []
            return {row[0]: (row[UNDER], row[UNDER + 1]) for row in rows}

        def read(place: int) -> tuple[str, str]:
            found = neighbours(place // PAGE).get(ids[place])
            if found is None:
                raise SessionNotFoundError(
                    sentence("the attempt {id} has gone meanwhile: look again", id=ids[place])
                )
            return found

        return read

    def _mend(self, names: Sequence[str], key: StationKey | None) -> list[Row]:
        """Read records anew, and write their rows where the index can be written."""
        there = listing(self.folder)
        rows = self._rows_of(names, there, key)
        with suppress(DatabaseError):
            self._put(rows, [name for name in names if name not in there])
        return [tuple(row[name] for name in SEALED) for row in rows]

    def _rows_of(
        self, names: Sequence[str], there: Listing, key: StationKey | None
    ) -> list[dict[str, Any]]:
        """Return the rows of records; none of one that has gone or is under way."""
        station = mark_of_stations(key)
        marks = {name: mark_of(self.folder, name, there, station) for name in names}
        return [
            row
            for name, mark in marks.items()
            if mark is not None
            for row in rows_of(self.folder, name, mark, read_kept, key)
        ]

    def _put(self, rows: Sequence[Mapping[str, Any]], gone: Sequence[str] | None) -> None:
        """Write rows and take those out that have gone; None takes out all others."""
        from sqlalchemy import delete
        from sqlalchemy.dialects.sqlite import insert

        seal_of = Sealer(this_station())
        sealed = [
            dict(row) | {"seal": seal_of(tuple(row[name] for name in SEALED)), "page": None}
            for row in rows
        ]
        ids = [str(row["id"]) for row in rows]
        with self.database.write() as connection:
            if gone is None:
                connection.exec_driver_sql("DELETE FROM pages")
            for begin in range(0, len(ids) + len(gone or ()), _AT_ONCE):
                both = [*ids, *(gone or ())][begin : begin + _AT_ONCE]
                dissolve(connection, both, self._pages.numbers_of(both))
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


def _rows_in(connection: Connection, ids: Sequence[str]) -> list[Row]:
    """Return rows as they stand: what a seal is over, and the seal at last.

    Digest of the record and seal are None where there is none.
    """
    from sqlalchemy import select

    table, seals = attempts_table(), seals_table()
    columns = [*table.columns, seals.c.record, seals.c.seal]
    wanted, found = select(*columns).outerjoin(seals, table.c.id == seals.c.id), []
    for begin in range(0, len(ids), PAGE):
        some = wanted.where(table.c.id.in_(ids[begin : begin + PAGE]))
        found += [tuple(row) for row in connection.execute(some)]
    return sorted(found, key=lambda row: (row[STARTED], row[0]))


def _marks_in(connection: Connection, ids: Sequence[str]) -> Iterator[Row]:
    """Return id and mark of rows as they stand."""
    names = ", ".join(("id", *SEALED[MARK]))
    for begin in range(0, len(ids), PAGE):
        some = tuple(ids[begin : begin + PAGE])
        held = ",".join("?" * len(some))
        wanted = f"SELECT {names} FROM attempts WHERE id IN ({held})"
        yield from map(tuple, connection.exec_driver_sql(wanted, some))


def _sealed(rows: Sequence[Row], key: StationKey | None) -> tuple[list[Row], list[str]]:
    """Return the rows that this station has sealed, without the seal, and the ids of the others."""
    good, odd, seal_of = [], [], Sealer(key)
    for row in rows:
        if hmac.compare_digest(str(row[-1]).encode(), seal_of(row[:-1]).encode()):
            good.append(row[:-1])
        else:
            odd.append(str(row[0]))
    return good, odd


def _no_texts(place: int) -> tuple[str, str]:
    raise LookupError(place)
