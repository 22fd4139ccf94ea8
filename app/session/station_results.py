"""A station's own results: its attempts in their order, and its signed remarks on attempts.

Each remark (comment, void mark, release) is signed with this station's counter, which is higher
than that of every remark that it knows. So of two remarks the one whose station knew the other is
the later one; where neither knew the other, counter, station and text decide, in this order. No
clock is asked. Attempts of this station get numbers in the order in which it began them; once given
a number stays.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from app.core.progress import Progress
from app.scoring.conditions import Conditions
from app.session.header import TRASH
from app.session.machine import FINAL
from app.session.people import NOTHING_SAID, People, Remarks, tables
from app.session.school_tables import COUNTED, SIGNED_REMARKS, TOMBSTONES, Tombstone
from app.session.sidecar import read_kept
from app.session.signature import Signed, read_signature
from app.session.station import StationKey, signature_holds
from app.session.stations import KnownStation, put_setting
from app.session.store import SUFFIX, records

if TYPE_CHECKING:
    from sqlalchemy import Connection

COUNTER: Final = "counter"
"""Setting that holds the counter of this station."""

REMARK: Final = "remark"
"""Purpose of the signatures of remarks."""

FIELDS: Final = ("comment", "void", "released")

_LARGEST: Final = 1 << 53


class SignedRemark(NamedTuple):
    """One thing that was said of an attempt.

    Attributes:
        attempt: its id.
        kind: `comment`, `void` or `released`.
        value: the text; of a release `1`; empty where it was taken back.
        student: whom the record names: nothing is left of it once they are erased.
        station: id of who said it.
        counter: of that station then.
        public: key that signed it.
        signature: of all but the key.
    """

    attempt: str
    kind: str
    value: str
    student: str
    station: str
    counter: int
    public: str
    signature: str

    def document(self) -> dict[str, Any]:
        """Return what is signed."""
        document = self._asdict()
        return {name: document[name] for name in self._fields[:6]}

    def order(self) -> tuple[int, str, str]:
        """Return what decides which of two remarks is the later one."""
        return self.counter, self.station, self.value

    def holds(self, known: Mapping[str, KnownStation]) -> bool:
        """Return whether a known station that is not revoked has signed it."""
        one = known.get(self.public)
        right = one is not None and one.station == self.station and not one.revoked
        return right and signature_holds(self.public, REMARK, self.document(), self.signature)

    @classmethod
    def of(cls, document: Mapping[str, Any]) -> SignedRemark:
        """Read one that travelled.

        Raises:
            ValueError, LookupError, TypeError: if it is none.
        """
        one = cls(*(document[name] for name in cls._fields))
        texts = all(isinstance(value, str) for value in (*one[:5], *one[6:]))
        whole = isinstance(one.counter, int) and 0 < one.counter < _LARGEST
        if not (texts and whole and one.kind in FIELDS):
            raise ValueError(one.kind)
        return one


class CountedAttempt(NamedTuple):
    """An attempt in the order of its station.

    Attributes:
        attempt: its id.
        station: id of the station that signed it.
        number: its place there, from 1.
        record: SHA-256 of the record.
        student: whom it names.
        exercise: id.
        version: of the exercise.
        uses: whether a person began it, so that it uses up one of a course's attempts.
    """

    attempt: str
    station: str
    number: int
    record: str
    student: str
    exercise: str
    version: int
    uses: bool

    @classmethod
    def of(cls, document: Mapping[str, Any]) -> CountedAttempt:
        """Read one that travelled.

        Raises:
            ValueError, LookupError, TypeError: if it is none.
        """
        one = cls(*(document[name] for name in cls._fields))
        texts = (one.attempt, one.station, one.record, one.student, one.exercise)
        right = all(isinstance(value, str) for value in texts) and isinstance(one.uses, bool)
        if not (right and isinstance(one.number, int) and 0 < one.number < _LARGEST):
            raise ValueError(one.attempt)
        return one if isinstance(one.version, int) else one._replace(version=0)


def sign_and_number(folder: Path, people: People, key: StationKey, progress: Progress) -> None:
    """Sign what was said here, and number the attempts of this station, since the last time.

    Args:
        folder: of the records.
        people: of this station.
        key: of this station.
        progress: reports, and may cancel; nothing has changed then.

    Raises:
        DatabaseError, SessionError: if something cannot be read or written.
    """
    with people.database.read() as connection:
        numbered = counted_attempts(connection)
    fresh = _unnumbered(folder, numbered, key, progress)
    with people.database.write() as connection:
        numbered = counted_attempts(connection)
        last = max(
            (one.number for one in numbered.values() if one.station == key.station), default=0
        )
        for one in fresh:
            if one.attempt not in numbered:
                last += 1
                numbered[one.attempt] = one._replace(number=last)
                values = numbered[one.attempt]._asdict()
                connection.execute(tables()[COUNTED].insert(), values)
        _sign(connection, folder, numbered, key)
        _add_tombstones(connection, folder, numbered)


def counted_attempts(connection: Connection) -> dict[str, CountedAttempt]:
    """Return the attempts that have a number, by id."""
    from sqlalchemy import select

    rows = connection.execute(select(tables()[COUNTED]))
    return {row.attempt: CountedAttempt(*row)._replace(uses=bool(row.uses)) for row in rows}


def signed_remarks(connection: Connection) -> dict[tuple[str, str], SignedRemark]:
    """Return the latest signed remarks, by attempt and field."""
    from sqlalchemy import select

    rows = connection.execute(select(tables()[SIGNED_REMARKS]))
    return {(row.attempt, row.kind): SignedRemark(*row) for row in rows}


def tombstones(connection: Connection) -> list[Tombstone]:
    """Return the tombstones that are known."""
    from sqlalchemy import select

    rows = connection.execute(select(tables()[TOMBSTONES]))
    return [Tombstone(row.digest, row.salt, bool(row.anonymous)) for row in rows]


def put_remarks(connection: Connection, rows: Iterable[SignedRemark]) -> None:
    """Keep signed remarks as the latest of their attempts, and let them be what is said."""
    from sqlalchemy.dialects.sqlite import insert

    said, remarks, rows = tables()[SIGNED_REMARKS], tables()["remarks"], list(rows)
    if rows:
        put = insert(said)
        newer = {name: put.excluded[name] for name in SignedRemark._fields}
        put = put.on_conflict_do_update(["attempt", "kind"], set_=newer)
        connection.execute(put, [one._asdict() for one in rows])
    for one in rows:
        value = {one.kind: one.value == "1" if one.kind == "released" else one.value}
        blank = {"comment": "", "void": "", "released": False} | value
        put = insert(remarks).values(attempt=one.attempt, **blank)
        connection.execute(put.on_conflict_do_update(["attempt"], set_=value))


def counter_of(connection: Connection) -> int:
    """Return the counter of this station: no remark that it knows has a higher one."""
    from sqlalchemy import func, select

    settings = tables()["settings"].c
    wanted = select(settings.value).where(settings.name == COUNTER)
    kept = connection.execute(wanted).scalar() or "0"
    most = connection.execute(select(func.max(tables()[SIGNED_REMARKS].c.counter))).scalar() or 0
    return max(int(kept) if str(kept).isdecimal() else 0, int(most))


# --- inside ---------------------------------------------------------------------------------------
def _unnumbered(
    folder: Path, numbered: Mapping[str, CountedAttempt], key: StationKey, progress: Progress
) -> list[CountedAttempt]:
    """Return the finished attempts of this station that have no number, in their order."""
    rows = []
    new = [path for path in records(folder) if path.stem not in numbered]
    for place, path in enumerate(new):
        progress.report(place / len(new), path.stem)
        document, check = read_signature(path, key)
        if check.verdict is not Signed.VERIFIED or document["station"] != key.station:
            continue
        summary = read_kept(path).summary
        if summary.state not in {state.value for state in FINAL}:
            continue
        known = summary.conditions or Conditions(summary.exercise_id)
        row = CountedAttempt(
            path.stem,
            key.station,
            0,
            str(document["record"]),
            str(document["shown"].get("student", "")),
            summary.exercise_id,
            known.version,
            known.by_person,
        )
        rows.append((summary.started, row))
    return [row for _, row in sorted(rows)]


def _sign(
    connection: Connection, folder: Path, numbered: Mapping[str, CountedAttempt], key: StationKey
) -> None:
    """Sign what is said here and is not what was signed last."""
    from sqlalchemy import select

    latest, counter = signed_remarks(connection), counter_of(connection) + 1
    rows = connection.execute(select(tables()["remarks"]))
    now = {row.attempt: Remarks(row.comment, row.void, row.released) for row in rows}
    fresh = []
    for attempt, remarks in now.items():
        student = None
        for what in FIELDS:
            value = _value(remarks, what)
            signed = latest.get((attempt, what))
            if value == (signed.value if signed else _value(NOTHING_SAID, what)):
                continue
            student = student or _student(folder, attempt, numbered)
            if student is None:
                break  # of a record that is not here: nobody could erase it
            one = SignedRemark(attempt, what, value, student, key.station, counter, key.public, "")
            fresh.append(one._replace(signature=key.sign(REMARK, one.document())))
    if fresh:
        put_remarks(connection, fresh)
        put_setting(connection, COUNTER, str(counter))


def _add_tombstones(
    connection: Connection, folder: Path, numbered: Mapping[str, CountedAttempt]
) -> None:
    """Make tombstones of who was erased before there were any."""
    from sqlalchemy import select

    known = tombstones(connection)
    keys = connection.execute(select(tables()["erased"].c.key)).scalars().all()
    new = [key for key in keys if not any(stone.is_of(key) for stone in known)]
    if not new:
        return
    there = {one.student for one in numbered.values()}
    every = (*records(folder), *records(folder / TRASH))
    there |= {read_kept(path).summary.student for path in every if path.stem not in numbered}
    for key in new:  # whose records are here were kept as nobody's
        stone = Tombstone.over(key, key in there)
        connection.execute(tables()[TOMBSTONES].insert(), stone._asdict())


def _value(remarks: Remarks, what: str) -> str:
    value = getattr(remarks, what)
    return ("1" if value else "") if isinstance(value, bool) else str(value)


def _student(folder: Path, attempt: str, numbered: Mapping[str, CountedAttempt]) -> str | None:
    """Return whom an attempt names; None where its record is not here."""
    if attempt in numbered:
        return numbered[attempt].student
    for place in (folder, folder / TRASH):
        path = place / f"{attempt}{SUFFIX}"
        if path.is_file():
            return read_kept(path).summary.student
    return None
