"""Changes of several files that happen as one, whatever ends the program in between.

A journal is a file in `.journal` inside the folder that it is about. Each of its lines is a plan:
what is to be done with the files, in an order and in words that may be carried out twice. The last
whole line holds. It is carried out when the journal ends, and, where the program was ended first,
by the next program that looks at the folder (`settle`). So a change first plans to clear away what
it prepares, prepares, plans to put all of it into its place, and ends. While its program lives it
holds the journal (a lock, or, where the file system has none, the process in its name).
"""

from __future__ import annotations

import hashlib
import json
import os
import sqlite3
import time
from collections.abc import Sequence
from contextlib import closing, suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from types import TracebackType
from typing import Final

from app.core.descriptors import hold_alone
from app.core.files import BINARY, remove, replace, step, sync, write_atomically
from app.core.messages import sentence
from app.core.temporary import hidden, name_of_process, process_has_gone, tells_processes
from app.session.errors import SessionError

FOLDER: Final = ".journal"

_PATIENCE: Final = 10.0
"""So long a program waits for another one that changes the folder [s]."""

_OLD: Final = 3600.0
"""A journal is left over after so long [s] where neither locks nor processes tell."""

Step = tuple[str, ...]
"""`move` or `database` and two paths, `remove` and a path, or `seal` with record, digest, file and
its text."""


@dataclass(frozen=True, slots=True)
class JournalPlan:
    """What is to be done.

    Attributes:
        steps: in their order.
        database: whose transaction decides, empty where none does: only if it holds `stamp` the
            steps are carried out, else those of `otherwise`.
        stamp: name of a setting that the transaction writes.
        otherwise: see above.
    """

    steps: Sequence[Sequence[str]] = ()
    database: str = ""
    stamp: str = ""
    otherwise: Sequence[Sequence[str]] = ()


_swept: set[Path] = set()
"""Folders in which this program has looked for what others left."""


def move(source: Path, target: Path) -> Step:
    """JournalPlan to give a file another name; one that has gone has been moved already."""
    return "move", str(source.absolute()), str(target.absolute())


def move_database(source: Path, target: Path) -> Step:
    """JournalPlan to put an SQLite file in the place of another, whose logs go with it."""
    return "database", str(source.absolute()), str(target.absolute())


def removal(path: Path) -> Step:
    """JournalPlan to delete a file or folder; one that has gone was deleted already."""
    return "remove", str(path.absolute())


def sealing(record: Path, digest: str, target: Path, text: str) -> Step:
    """JournalPlan to write a text once a record is whole, which its SHA-256 tells; else never."""
    return "seal", str(record.absolute()), digest, str(target.absolute()), text


class Journal:
    """One change, as a context; see above.

    Args:
        folder: that it is about.
        plan: what is done if nothing else is planned.
        alone: wait for other programs that change the folder alone, and let them wait.

    Raises:
        SessionError: if it cannot be written, or a plan cannot be carried out. What is planned is
            then tried again by the next program that looks.
    """

    def __init__(self, folder: Path, plan: Sequence[Step] = (), alone: bool = False) -> None:
        self._alone, self._lock = alone, -1
        self._folder, self._plan = folder, JournalPlan(tuple(plan))
        self._path, self._fd = folder, -1

    def __enter__(self) -> Journal:
        """Open it and write the first plan."""
        if self._alone:
            self._wait()
        settle(self._folder)
        try:
            while self._fd < 0:
                self._open()
            self._write(self._plan)
        except OSError as error:
            self._close()
            with suppress(OSError):
                self._path.unlink(missing_ok=True)
                self._path.parent.rmdir()
            raise SessionError(
                sentence(
                    "cannot write in {folder}: {error_strerror}; nothing was changed",
                    folder=self._folder,
                    error_strerror=error.strerror or error,
                )
            ) from error
        return self

    def plan(self, steps: Sequence[Step]) -> None:
        """JournalPlan something else from now on: when this returns it stands on the disk.

        Raises:
            OSError: if it cannot be written; the plan before holds.
        """
        self._write(JournalPlan(tuple(steps)))

    def plan_with(
        self, database: Path, stamp: str, steps: Sequence[Step], otherwise: Sequence[Step] = ()
    ) -> None:
        """JournalPlan what happens if a transaction that is about to end is committed, or is not.

        Args:
            database: whose transaction.
            stamp: a setting that it writes and nobody else.
            steps: what is done if it was committed.
            otherwise: what is done if it was not.

        Raises:
            OSError: as `plan`.
        """
        where = str(database.absolute())
        self._write(JournalPlan(tuple(steps), where, stamp, tuple(otherwise)))

    def _write(self, plan: JournalPlan) -> None:
        line = json.dumps(asdict(plan)).encode() + b"\n"
        step("plan", self._path)
        if os.write(self._fd, line) != len(line):
            raise OSError(28, os.strerror(28), str(self._path))
        os.fsync(self._fd)
        self._plan = plan

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Carry out what is planned, also after an exception."""
        try:
            _follow(self._plan)
            fd, self._fd = self._fd, -1
            _end(self._path, fd)
        except OSError as problem:
            if error is None:
                raise SessionError(
                    sentence(
                        "cannot change {problem_filename}: "
                        "{problem_strerror}; it is tried again at the next start",
                        problem_filename=problem.filename or self._folder,
                        problem_strerror=problem.strerror or problem,
                    )
                ) from problem
        finally:
            self._close()

    def _open(self) -> None:
        place = self._folder / FOLDER
        place.mkdir(parents=True, exist_ok=True)
        self._path = place / f"plan.{name_of_process()}"
        flags = os.O_CREAT | os.O_EXCL | os.O_RDWR | os.O_APPEND | BINARY
        with suppress(FileNotFoundError):  # the empty folder was cleared away meanwhile
            step("open", self._path)
            fd = os.open(self._path, flags, 0o600)
            if hold_alone(fd) is False or not os.fstat(fd).st_nlink:
                os.close(fd)  # another program took it for one that was left
            else:
                self._fd = fd
                sync(place)
                sync(self._folder)  # in which the place of journals may be new

    def _wait(self) -> None:
        """Hold the folder alone, where it can be locked."""
        with suppress(OSError):  # no folder yet, or a system that opens none
            self._folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            self._lock = os.open(self._folder, os.O_RDONLY)
        end = time.monotonic() + _PATIENCE
        while self._lock >= 0 and hold_alone(self._lock) is False:
            if time.monotonic() > end:
                self._close()
                raise SessionError(
                    sentence(
                        "another program has been changing {folder} for {patience:g} s: "
                        "wait until it is done, then try again",
                        folder=self._folder,
                        patience=_PATIENCE,
                    )
                )
            time.sleep(0.01)

    def _close(self) -> None:
        for fd in (self._fd, self._lock):
            if fd >= 0:
                os.close(fd)
        self._fd = self._lock = -1


def settle(folder: Path, names: Sequence[str] | None = None) -> None:
    """Carry out what programs that ended had planned here, and sweep what they left; no raise.

    A folder that cannot be written stays as it is.

    Args:
        folder: that plans are about.
        names: that `hidden` has just given there; they are read without.
    """
    left: list[Path] = []
    with suppress(OSError):
        left = sorted((folder / FOLDER).iterdir())
    for path in left:
        with suppress(OSError):
            _settle(path)
    with suppress(OSError):
        (folder / FOLDER).rmdir()
    if folder not in _swept and not (folder / FOLDER).exists():  # no plan needs what lies there
        _swept.add(folder)
        for name in filter(process_has_gone, hidden(folder) if names is None else names):
            with suppress(OSError):
                remove(folder / name)


def carry_out(steps: Sequence[Sequence[str]]) -> None:
    """Do what is planned; what is done already is passed over.

    Raises:
        OSError: if something cannot be done.
    """
    touched: set[Path] = set()
    for what, *args in steps:
        first = Path(args[0])
        if what == "remove":
            remove(first)
        elif what in ("move", "database") and os.path.lexists(first):
            target = Path(args[1])
            if what == "database":
                for end in ("-wal", "-shm", "-journal"):
                    remove(target.with_name(target.name + end))
            target.parent.mkdir(parents=True, exist_ok=True)
            replace(first, target)
            touched |= {first.parent, target.parent}
        elif what == "seal" and _digest(first) == args[1] and not Path(args[2]).exists():
            write_atomically(Path(args[2]), args[3])
            touched.add(first.parent)
    for folder in touched:
        with suppress(OSError):
            sync(folder)


def _settle(path: Path) -> None:
    fd = os.open(path, os.O_RDWR)
    try:
        alone = hold_alone(fd)
        if alone is None:
            old = not tells_processes() and time.time() - path.stat().st_mtime > _OLD
            alone = old or process_has_gone(path.name)
        if not alone:
            return
        if os.fstat(fd).st_nlink:  # else another program has just settled it
            _follow(_last_plan(path))
            mine, fd = fd, -1
            _end(path, mine)
    finally:
        if fd >= 0:
            os.close(fd)


def _last_plan(path: Path) -> JournalPlan:
    for line in reversed(path.read_bytes().split(b"\n")[:-1]):
        with suppress(ValueError, TypeError):
            return JournalPlan(**json.loads(line))
    return JournalPlan()


def _follow(plan: JournalPlan) -> None:
    """Carry out a plan, as its transaction ended."""
    done = not plan.database or _is_stamped(Path(plan.database), plan.stamp)
    carry_out(plan.steps if done else plan.otherwise)


def _is_stamped(database: Path, stamp: str) -> bool:
    if not database.exists():
        return False
    try:
        with closing(sqlite3.connect(database, timeout=10.0)) as connection:
            wanted = "SELECT 1 FROM settings WHERE name = ?"
            return connection.execute(wanted, (stamp,)).fetchone() is not None
    except sqlite3.OperationalError as error:  # another program has it: later
        raise OSError(error.sqlite_errorcode, str(error), str(database)) from error
    except sqlite3.DatabaseError:
        return False  # damaged, and nothing in it says so


def _end(path: Path, fd: int) -> None:
    """Delete a journal that is open and held until then, and close it."""
    step("end", path)
    try:
        if os.name == "posix":
            path.unlink(missing_ok=True)
    finally:
        os.close(fd)
    path.unlink(missing_ok=True)  # elsewhere nobody deletes what is open
    with suppress(OSError):
        path.parent.rmdir()


def _digest(path: Path) -> str:
    try:
        with path.open("rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError:
        return ""
