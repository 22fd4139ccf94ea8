"""The school's store, in SQLite or PostgreSQL: packets in the order in which they came.

Whoever writes holds it alone until the transaction ends, so that no place in the order becomes
visible after a later one. Each statement has a time limit of its own: a network that stalls is cut.
"""

from __future__ import annotations

import os
import socket
import threading
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from app.core.extras import not_installed
from app.core.files import step
from app.core.messages import sentence
from app.session.database import lockable
from app.session.school_store.errors import StoreError, UnreachableStoreError, named_errors
from app.session.school_store.objects import Objects
from app.session.school_store.packet import ATTEMPT, COURSE, REMARKS, STATION, Packet, PacketRow
from app.session.school_store.tables import BEGIN, chained, packets, upgrade

if TYPE_CHECKING:
    from sqlalchemy import Connection, Engine

_LOCK: Final = 0x41435553
"""Number of PostgreSQL's advisory lock: "ACUS"."""

_MANY: Final = 500
"""So many values stand in one statement."""


class ReadPlace(NamedTuple):
    """How far a station has read: the place of a packet, and the chain value there."""

    seq: int = 0
    chain: str = BEGIN


class SchoolStore:
    """A store by its URL; `open` connects, `close` lets go of it.

    Args:
        url: of SQLAlchemy, such as `postgresql+psycopg://user:password@host/acus`, or
            `sqlite:////mnt/school/acus.sqlite`.
        objects: where packets' files lie, by fsspec; in the database itself without.
        seconds: that one answer may take.
    """

    def __init__(self, url: str, objects: Objects | None = None, seconds: float = 10.0) -> None:
        self._url, self._objects, self._seconds = url, objects, seconds

    @cached_property
    def name(self) -> str:
        """Return the URL without its password.

        Raises:
            StoreError: if it is no URL of a store.
        """
        from sqlalchemy import make_url
        from sqlalchemy.exc import ArgumentError

        try:
            url = make_url(self._url)
        except ArgumentError as error:
            raise StoreError(_no_url(self._url.partition("://")[0])) from error
        if url.get_backend_name() not in ("sqlite", "postgresql") or (
            url.get_backend_name() == "sqlite" and not url.database
        ):
            raise StoreError(_no_url(url.render_as_string()))
        return url.render_as_string(hide_password=True)

    @property
    def _file(self) -> Path | None:
        """Return its file; None of a server."""
        from sqlalchemy import make_url

        url = make_url(self._url)
        return Path(str(url.database)) if url.get_backend_name() == "sqlite" else None

    def open(self, make: bool = True) -> None:
        """Connect, and bring the tables up to date; again it changes nothing.

        Args:
            make: the tables where there are none. A share that is not mounted is an empty folder:
                who only exchanges makes no store of his own there.

        Raises:
            UnreachableStoreError: if it does not answer in time, or is not there.
            StoreError: naming the store, if it refuses, is of a newer version or none.
        """
        if not make and (path := self._file) is not None and not path.exists():
            raise UnreachableStoreError(
                sentence(
                    "the school's store {name} is not there: look whether its share is mounted; "
                    "this station goes on and tries again",
                    name=self.name,
                )
            )
        with self._writing() as connection:
            upgrade(connection, self.name, make)

    def close(self) -> None:
        """Let go of it; idempotent."""
        if "_engine" in self.__dict__:
            self._engine.dispose()
            del self.__dict__["_engine"]

    def own(self, station: str) -> dict[tuple[str, str], str]:
        """Return the marks of what a station has put there, by kind and item.

        Attempts that were taken out since are among them: they are not put there again.
        """
        from sqlalchemy import or_, select

        t = packets().c
        there = or_(t.gone.is_(False), t.kind == ATTEMPT)
        wanted = select(t.kind, t.item, t.mark).where(t.station == station, there).order_by(t.seq)
        with self._reading() as connection:
            return {(kind, item): mark for kind, item, mark in connection.execute(wanted)}

    def put(self, new: Sequence[Packet]) -> int:
        """Add packets, all or none; return how many were not there.

        One that is there with the same mark is passed over: an answer may have been lost. Of
        stations, remarks and courses the one before loses its data.

        Raises:
            StoreError: as `open`.
        """
        from sqlalchemy import select, update

        if self._objects is not None:
            for packet in new:
                self._objects.put(packet.digest, packet.data)
        t, added, replaced = packets().c, 0, []
        with self._writing() as connection:
            last = select(t.chain).order_by(t.seq.desc()).limit(1)
            chain = connection.execute(last).scalar() or BEGIN
            for packet in new:
                same = (t.station == packet.station, t.kind == packet.kind, t.item == packet.item)
                wanted = select(t.seq, t.mark, t.gone, t.digest).where(*same)
                there = list(connection.execute(wanted))
                live = packet.kind == ATTEMPT
                if any(row.mark == packet.mark and (live or not row.gone) for row in there):
                    continue
                chain = chained(chain, packet.digest)
                values = {
                    "digest": packet.digest,
                    "chain": chain,
                    "station": packet.station,
                    "kind": packet.kind,
                    "item": packet.item,
                    "student": packet.student,
                    "mark": packet.mark,
                    "size": len(packet.data),
                    "gone": False,
                    "data": packet.data if self._objects is None else None,
                }
                old = [row for row in there if not row.gone]
                if old and packet.kind in (REMARKS, COURSE, STATION):
                    seqs = [row.seq for row in old]
                    blank = update(packets()).where(t.seq.in_(seqs))
                    connection.execute(blank.values(gone=True, data=None))
                    replaced += [row.digest for row in old]
                connection.execute(packets().insert(), values)
                added += 1
        self._discard(replaced)
        return added

    def after(self, place: ReadPlace) -> tuple[list[PacketRow], ReadPlace]:
        """Return what came after a place, and the place to go on from.

        Where the store is not what it was at that place, such as one that was put back from an
        older backup, everything that it has is returned.
        """
        from sqlalchemy import select

        t = packets().c
        columns = [getattr(t, name) for name in PacketRow._fields]
        with self._reading() as connection:
            chain = connection.execute(select(t.chain).where(t.seq == place.seq)).scalar()
            begin = place.seq if chain == place.chain else 0
            wanted = select(*columns).where(t.seq > begin, t.gone.is_(False)).order_by(t.seq)
            rows = [PacketRow(*row) for row in connection.execute(wanted)]
            last = select(t.seq, t.chain).order_by(t.seq.desc()).limit(1)
            head = connection.execute(last).first()
        return rows, ReadPlace(*head) if head else ReadPlace()

    def at(self, seqs: Iterable[int]) -> list[PacketRow]:
        """Return packets by their places, of those that are still there."""
        from sqlalchemy import select

        t, rows = packets().c, []
        columns = [getattr(t, name) for name in PacketRow._fields]
        with self._reading() as connection:
            for some in _parts(sorted(seqs)):
                wanted = select(*columns).where(t.seq.in_(some), t.gone.is_(False))
                rows += [PacketRow(*row) for row in connection.execute(wanted)]
        return rows

    def data(self, rows: Sequence[PacketRow]) -> dict[int, bytes]:
        """Return the files of packets by place; of those that were taken out meanwhile nothing.

        Raises:
            StoreError: as `open`, or if objects are missing.
        """
        from sqlalchemy import select

        t = packets().c
        there: dict[int, bytes] = {}
        with self._reading() as connection:
            for some in _parts([row.seq for row in rows]):
                wanted = select(t.seq, t.digest, t.data).where(t.seq.in_(some), t.gone.is_(False))
                for seq, digest, data in list(connection.execute(wanted)):
                    if data is None and self._objects is None:
                        raise StoreError(
                            sentence(
                                "the files of the school's store {name} lie elsewhere: give "
                                "--objects as on the other stations",
                                name=self.name,
                            )
                        )
                    if data is None and self._objects is not None:
                        data = self._objects.get(digest)
                    there[seq] = bytes(data)
        return there

    def courses(self) -> list[PacketRow]:
        """Return the courses that stations give."""
        from sqlalchemy import select

        t = packets().c
        columns = [getattr(t, name) for name in PacketRow._fields]
        wanted = select(*columns).where(t.kind == COURSE, t.gone.is_(False))
        with self._reading() as connection:
            return [PacketRow(*row) for row in connection.execute(wanted)]

    def students(self) -> set[str]:
        """Return the keys of all students of whom something is there."""
        from sqlalchemy import select

        t = packets().c
        wanted = select(t.student).where(t.gone.is_(False), t.student != "").distinct()
        with self._reading() as connection:
            return set(connection.execute(wanted).scalars())

    def take_out(
        self, deleted: Iterable[str] = (), anonymous: Iterable[str] = (), seqs: Iterable[int] = ()
    ) -> int:
        """Let nothing stay of who was erased; return how many packets lost their data.

        Args:
            deleted: keys of students of whom everything goes.
            anonymous: keys of those whose attempts stay, as nobody's: what was said of them goes.
            seqs: places of packets that name one of them.
        """
        from sqlalchemy import select, update

        t = packets().c
        gone: list[str] = []
        with self._writing() as connection:
            for column, values, more in (
                (t.student, sorted(deleted), ()),
                (t.student, sorted(anonymous), (t.kind == REMARKS,)),
                (t.seq, sorted(seqs), ()),
            ):
                for some in _parts(values):
                    which = (column.in_(some), t.gone.is_(False), *more)
                    gone += connection.execute(select(t.digest).where(*which)).scalars().all()
                    blank = update(packets()).where(*which)
                    connection.execute(blank.values(gone=True, data=None))
                if column is t.student and values:  # nor whom the rows were about
                    of_them = update(packets()).where(t.student.in_(values), t.gone.is_(True))
                    connection.execute(of_them.where(t.kind == REMARKS).values(item=""))
                    connection.execute(of_them.values(student=""))
        self._discard(gone)
        return len(gone)

    # --- inside -----------------------------------------------------------------------------------
    def _discard(self, digests: Iterable[str]) -> None:
        if self._objects is not None:
            for digest in digests:
                self._objects.remove(digest)

    @contextmanager
    def _reading(self) -> Iterator[Connection]:
        with self._errors(), self._engine.connect() as connection:
            yield connection

    @contextmanager
    def _writing(self) -> Iterator[Connection]:
        """Write in one transaction, alone among all stations."""
        with self._errors(), self._engine.connect() as connection:
            if connection.dialect.name == "sqlite":
                connection.exec_driver_sql("ROLLBACK")
                connection.exec_driver_sql("BEGIN IMMEDIATE")
            else:
                connection.exec_driver_sql(f"SELECT pg_advisory_xact_lock({_LOCK})")
            yield connection
            step("commit", Path("school store"))
            with _time_limit(connection.connection.driver_connection, self._seconds):
                connection.commit()

    @contextmanager
    def _errors(self) -> Iterator[None]:
        with named_errors(self.name, self._seconds):
            yield

    @cached_property
    def _engine(self) -> Engine:
        from sqlalchemy import create_engine, event, make_url
        from sqlalchemy.pool import NullPool

        url = make_url(self._url)
        arguments: dict[str, Any]
        sqlite = url.get_backend_name() == "sqlite"
        if not sqlite:  # whichever way it is written: by the one driver that the extra brings
            url = url.set(drivername="postgresql+psycopg")
        if sqlite:
            _check_folder(Path(str(url.database)), self.name)
            arguments = {"timeout": self._seconds}
        else:
            milliseconds = round(1000.0 * self._seconds)
            arguments = {
                "connect_timeout": max(2, round(self._seconds)),
                "options": f"-c statement_timeout={milliseconds} -c lock_timeout={milliseconds}"
                f" -c idle_in_transaction_session_timeout={milliseconds}",
                "tcp_user_timeout": milliseconds,
                "application_name": "acus",
            }
        try:
            pool = {"poolclass": NullPool} if sqlite else {"pool_size": 1, "max_overflow": 0}
            engine = create_engine(url, connect_args=arguments, **pool)
        except ImportError as error:
            raise not_installed(StoreError, "psycopg", "school") from error
        if sqlite:
            event.listen(engine, "connect", _by_hand)
            event.listen(engine, "begin", _begin)
            return engine
        limits: dict[int, Any] = {}

        def begin(connection: Any, *_: Any) -> None:
            limit = _time_limit(connection.connection.driver_connection, self._seconds)
            limit.__enter__()
            limits[id(connection)] = limit

        def end(connection: Any, *_: Any) -> None:
            if (limit := limits.pop(id(connection), None)) is not None:
                limit.__exit__(None, None, None)

        event.listen(engine, "before_cursor_execute", begin)
        event.listen(engine, "after_cursor_execute", end)
        event.listen(engine, "handle_error", lambda context: end(context.connection))
        return engine


def _by_hand(connection: Any, _: Any) -> None:
    """Let transactions of SQLite begin where they are told to."""
    connection.isolation_level = None


def _begin(connection: Any) -> None:
    connection.exec_driver_sql("BEGIN")


@contextmanager
def _time_limit(connection: Any, seconds: float) -> Iterator[None]:
    """Cut a connection that does not answer: where it stalls no limit of the server is heard."""
    if not hasattr(connection, "fileno"):
        yield  # a file
        return
    handle = os.dup(connection.fileno())

    def cut() -> None:
        with suppress(OSError):
            line = socket.socket(fileno=os.dup(handle))
            line.shutdown(socket.SHUT_RDWR)
            line.close()

    timer = threading.Timer(1.5 * seconds, cut)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
        timer.join()
        os.close(handle)


def _check_folder(path: Path, name: str) -> None:
    if not path.parent.is_dir():
        raise StoreError(
            sentence(
                "there is no folder {folder} for the school's store: make it, or look whether the "
                "share is there",
                folder=path.parent,
            )
        )
    if not lockable(path.parent):
        raise StoreError(
            sentence(
                "the school's store {name} lies where files cannot be locked, so that two stations "
                "would break it: put it into PostgreSQL, or on a share with locks",
                name=name,
            )
        )


def _parts(values: Sequence[Any]) -> Iterator[Sequence[Any]]:
    for begin in range(0, len(values), _MANY):
        yield values[begin : begin + _MANY]


def _no_url(text: str) -> str:
    return sentence(
        "{url!r} is no URL of a school's store: give "
        "postgresql+psycopg://user:password@host/name, or sqlite:////folder/file.sqlite",
        url=text[:80],
    )
