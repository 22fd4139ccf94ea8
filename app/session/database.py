"""SQLite files that several programs may use at once: opened, checked, read and written.

Write-ahead logging lets readers go on while one program writes; a writer waits up to
`BUSY_SECONDS` for another one. Whatever is written is one transaction: whole, or not at all, also
when the program is killed in the middle of it. SQLAlchemy is imported when a file is opened.
"""

from __future__ import annotations

import os
import shutil
import sqlite3
import tempfile
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager, suppress
from functools import cache, cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from app.core.descriptors import has_locks
from app.core.files import step
from app.core.messages import sentence
from app.session.errors import SessionError

if TYPE_CHECKING:
    from sqlalchemy import Connection, Engine, MetaData

BUSY_SECONDS: Final = 10.0
"""So long a program waits for another one that writes [s]."""

_ROOM: Final = 1 << 16
"""Bytes that SQLite's log and its index of that log need at the least."""


_READ_ONLY: Final = "can only be read: give this user the right to write there"
_FULL: Final = "cannot be written, the disk is full: make room, nothing is lost"
_NO_LOCKS: Final = "cannot be locked or written where it lies: put it on a disk of this computer"
_MENDED: Final = (
    "is damaged: `acus store rebuild` makes the index anew, people come back from a backup"
    " (`acus store restore`)"
)


_NO_FOLDER: Final = "cannot be opened: look whether its folder exists and may be written"


class DatabaseError(SessionError):
    """A database is locked, full, read-only, damaged or of a newer version; says what to do."""

    @property
    def damaged(self) -> bool:
        """Return whether the file is no database, or a broken one."""
        return _MENDED in str(self)

    @property
    def unwritable(self) -> bool:
        """Return whether the file cannot be written: no right, no room, or a disk without locks."""
        return any(text in str(self) for text in (_READ_ONLY, _FULL, _NO_LOCKS, _NO_FOLDER))

    @property
    def busy(self) -> bool:
        """Return whether another program has it."""
        return "in use by another program" in str(self)

    @property
    def newer(self) -> bool:
        """Return whether a newer version of Acus has written it."""
        return "newer version of Acus" in str(self)


class Database:
    """One SQLite file with its tables, made when it is first used.

    Args:
        path: the file; None keeps everything in memory.
        tables: gives those of SQLAlchemy, made where they are missing.
        version: of the tables; a file of a later one is left alone.
        what: it holds, for messages, such as "index".
        busy: seconds to wait for another program.
        disposable: what it holds can be made anew: tables that are not these are thrown away.
    """

    def __init__(
        self,
        path: Path | None,
        tables: Callable[[], MetaData],
        version: int,
        what: str,
        busy: float = BUSY_SECONDS,
        disposable: bool = False,
    ) -> None:
        self._disposable = disposable
        self.path, self._tables, self._version = path, tables, version
        self._what, self._busy = what, busy

    @contextmanager
    def read(self) -> Iterator[Connection]:
        """Read: all of it as it stood at one moment.

        Raises:
            DatabaseError: if it cannot be read.
        """
        with self._errors(), self._reading() as connection:
            yield connection

    @contextmanager
    def write(self) -> Iterator[Connection]:
        """Write in one transaction, alone among all programs; an exception takes it all back.

        Raises:
            DatabaseError: if it cannot be written.
        """
        if self._why_read_only:
            raise self._error(self._why_read_only)
        with self._errors(), self._engine.connect() as connection:
            connection.exec_driver_sql("ROLLBACK")
            connection.exec_driver_sql("BEGIN IMMEDIATE")
            yield connection
            if self.path is not None:
                step("commit", self.path)
            connection.commit()

    def close(self) -> None:
        """Let go of the file; idempotent."""
        if "_engine" in self.__dict__:
            self._engine.dispose()
            del self.__dict__["_engine"]

    def shrink(self) -> None:
        """Let nothing that was deleted be left over in the files.

        Raises:
            DatabaseError: if they cannot be written.
        """
        with self._errors(), self._engine.connect() as connection:
            connection.exec_driver_sql("ROLLBACK")
            connection.exec_driver_sql("VACUUM")
            connection.exec_driver_sql("PRAGMA wal_checkpoint(TRUNCATE)")

    def discard(self) -> None:
        """Delete the file: of what can be made anew only.

        Raises:
            DatabaseError: if it cannot be deleted.
        """
        self.close()
        if self.path is not None:
            try:
                for end in ("", "-wal", "-shm"):
                    self.path.with_name(self.path.name + end).unlink(missing_ok=True)
            except OSError as error:
                raise self._error(
                    sentence(
                        "cannot be deleted: {error_strerror}",
                        error_strerror=error.strerror or error,
                    )
                ) from error

    @property
    def _why_read_only(self) -> str:
        """Say why a file that is there can only be read; empty if it can be written."""
        if self.path is None or self._disposable or not self.path.exists():
            return ""
        if not (os.access(self.path, os.W_OK) and os.access(self.path.parent, os.W_OK)):
            return _READ_ONLY
        return "" if lockable(self.path.parent) else _NO_LOCKS

    @contextmanager
    def _reading(self) -> Iterator[Connection]:
        """Connect to read: to the file, or to a copy in memory where the file needs writing."""
        from sqlalchemy.exc import DatabaseError as Refused

        if self.path is None or not self._why_read_only:
            try:
                connection = self._engine.connect()
            except Refused as error:
                full = _reason(str(error.orig), self._busy) in (_FULL, _NO_LOCKS, _NO_FOLDER)
                if not full or self.path is None or not self.path.exists() or self._disposable:
                    raise
            else:
                with connection:
                    yield connection
                return
        with self._copied(self.path).connect() as connection:
            yield connection

    def _copied(self, path: Path) -> Engine:
        """Return an engine on a copy of a file as it is now, in memory."""
        from sqlalchemy import create_engine
        from sqlalchemy.pool import StaticPool

        taken = copied_to_memory(path)
        engine = create_engine("sqlite://", poolclass=StaticPool, creator=lambda: taken)
        with engine.connect() as connection:
            self._check_version(connection)
            self._tables().create_all(connection)
            connection.commit()
        return engine

    def _check_version(self, connection: Connection) -> int:
        found = int(connection.exec_driver_sql("PRAGMA user_version").scalar() or 0)
        if found > self._version:
            raise self._error(
                sentence(
                    "was written by a newer version of Acus (form {found_version}, this one knows "
                    "{known_version}): use that version",
                    found_version=found,
                    known_version=self._version,
                )
            )
        return found

    @cached_property
    def _engine(self) -> Engine:
        from sqlalchemy import create_engine, event
        from sqlalchemy.pool import NullPool, StaticPool

        if self.path is not None:
            self.path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        engine = create_engine(
            "sqlite://" if self.path is None else f"sqlite:///{self.path}",
            poolclass=StaticPool if self.path is None else NullPool,
            connect_args={"timeout": self._busy, "check_same_thread": False},
        )
        event.listen(engine, "connect", self._prepare)
        event.listen(engine, "begin", _begin)
        with engine.connect() as connection:
            found = self._check_version(connection)
        if found < self._version or (self._disposable and not self._ours(engine)):
            with engine.connect() as connection:
                connection.exec_driver_sql("ROLLBACK")
                connection.exec_driver_sql("BEGIN IMMEDIATE")
                if self._disposable:
                    _drop_all(connection)
                self._tables().create_all(connection)
                connection.exec_driver_sql(f"PRAGMA user_version = {self._version}")
                connection.commit()
        return engine

    def _ours(self, engine: Engine) -> bool:
        """Return whether the file holds the tables that it should, and nothing else."""
        from sqlalchemy import create_engine

        with engine.connect() as connection:
            there = schema_of(connection)
        memory = create_engine("sqlite://")
        self._tables().create_all(memory)
        with memory.connect() as connection:
            return there == schema_of(connection)

    def _prepare(self, connection: Any, _: object) -> None:
        connection.text_factory = _as_text  # of a file that may hold anything
        connection.isolation_level = None  # transactions begin where `_begin` and `write` say so
        connection.execute(f"PRAGMA busy_timeout = {round(1e3 * self._busy)}")
        if self.path is not None:
            with suppress(sqlite3.OperationalError):  # a folder that can only be read
                connection.execute("PRAGMA journal_mode = WAL")
        connection.execute("PRAGMA synchronous = FULL")
        connection.execute("PRAGMA secure_delete = ON")

    def _full(self) -> bool:
        """Return whether the disk has no room for what stands beside a database while it is
        used.
        """
        try:
            return self.path is not None and shutil.disk_usage(self.path.parent).free < _ROOM
        except OSError:
            return False

    @contextmanager
    def _errors(self) -> Iterator[None]:
        """Say in one line what SQLite says of the file."""
        from sqlalchemy.exc import DatabaseError as Refused

        try:
            yield
        except Refused as error:
            raise self._error(_reason(str(error.orig), self._busy)) from error
        except (sqlite3.DatabaseError, UnicodeError, OSError) as error:
            raise self._error(_reason(str(error), self._busy)) from error

    def _error(self, reason: str) -> DatabaseError:
        if reason == _NO_LOCKS and self._full():  # SQLite says the same of both
            reason = _FULL
        return DatabaseError(
            sentence(
                "the {database_name} {path} {reason}",
                database_name=self._what,
                path=self.path or "in memory",
                reason=reason,
            )
        )


@cache
def words() -> Any:
    """Return the type of a column of text that reads as text whatever a file holds there.

    SQLite keeps any value in any column: bytes are read as UTF-8 with what is none of it replaced,
    numbers as they are printed. Nothing stays nothing.
    """
    from sqlalchemy import String, TypeDecorator

    class Words(TypeDecorator[str]):
        impl, cache_ok = String, True

        def process_result_value(self, value: Any, dialect: object) -> str | None:
            return _as_text(value) if isinstance(value, bytes) else value and str(value)

    return Words()


@cache
def number(whole: bool) -> Any:
    """Return the type of a column of numbers, whole ones or any: what is none reads as 0."""
    from sqlalchemy import BigInteger, Float, TypeDecorator

    class Number(TypeDecorator[float]):
        impl, cache_ok = BigInteger if whole else Float, True

        def process_result_value(self, value: Any, dialect: object) -> float | None:
            return value if value is None or isinstance(value, int | float) else 0

    return Number()


def _as_text(data: bytes) -> str:
    return data.decode("utf-8", "replace")


def copied_to_memory(path: Path) -> sqlite3.Connection:
    """Copy a database into memory without writing or locking anything beside it.

    Raises:
        sqlite3.DatabaseError, OSError: if it cannot be read.
    """
    taken = sqlite3.connect(":memory:", check_same_thread=False)
    taken.text_factory = _as_text
    log = path.with_name(f"{path.name}-wal")
    with tempfile.TemporaryDirectory() as place:  # for this user only
        mine = Path(place) / path.name
        shutil.copyfile(path, mine)
        if log.exists() and log.stat().st_size:  # what is not in the file yet
            shutil.copyfile(log, mine.with_name(log.name))
        alone = "?vfs=unix-none" if os.name == "posix" else ""  # nobody else has this copy
        with closing(sqlite3.connect(mine.as_uri() + alone, uri=True)) as source:
            source.execute("PRAGMA locking_mode = EXCLUSIVE")  # its log needs no shared memory
            source.backup(taken)
    return taken


@cache
def lockable(folder: Path) -> bool:
    """Return whether files in a folder can be locked; looked at once."""
    return has_locks(folder)


def schema_of(connection: Connection) -> set[tuple[str, ...]]:
    """Return all that a database defines: kind, name, and the columns of tables.

    Tables of SQLite's own are left out.
    """
    found = connection.exec_driver_sql("SELECT type, name, tbl_name FROM sqlite_master")
    items = [tuple(map(str, row)) for row in found if not str(row[1]).startswith("sqlite_")]
    columns = {
        (kind, name, *map(str, column))
        for kind, name, _ in items
        if kind == "table"
        for column in connection.exec_driver_sql("SELECT * FROM pragma_table_info(?)", (name,))
    }
    return {*items, *columns}


def _drop_all(connection: Connection) -> None:
    """Throw away all that a database defines."""
    for kind in ("trigger", "view", "table"):
        found = connection.exec_driver_sql("SELECT name FROM sqlite_master WHERE type = ?", (kind,))
        for (name,) in list(found):
            if not str(name).startswith("sqlite_"):
                quoted = str(name).replace('"', '""')
                connection.exec_driver_sql(f'DROP {kind} IF EXISTS "{quoted}"')


def _begin(connection: Any) -> None:
    connection.exec_driver_sql("BEGIN")


def _reason(text: str, busy: float) -> str:
    reasons = {
        "database is locked": f"is in use by another program for {busy:g} s: close it, try again",
        "readonly": _READ_ONLY,
        "disk is full": _FULL,
        "locking protocol": _NO_LOCKS,
        "disk I/O error": _NO_LOCKS,
        "not a database": _MENDED,
        "malformed": _MENDED,
        "unable to open": _NO_FOLDER,
    }
    return next((said for key, said in reasons.items() if key in text), f"cannot be used: {text}")
