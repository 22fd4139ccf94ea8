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
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Any, Final

from app.core.descriptors import hold_alone
from app.core.files import remove, replace, step, sweep, sync, write_atomically
from app.core.temporary import name_of_process, process_has_gone
from app.session.errors import SessionError

FOLDER: Final = ".journal"

Step = tuple[str, ...]
"""`move` and two paths, `remove` and a path, or `seal` with record, digest, file and its text."""

_swept: set[Path] = set()
"""Folders in which this program has looked for what others left."""


def move(source: Path, target: Path) -> Step:
    """Plan to give a file another name; one that has gone has been moved already."""
    return "move", str(source.absolute()), str(target.absolute())


def removal(path: Path) -> Step:
    """Plan to delete a file or folder; one that has gone was deleted already."""
    return "remove", str(path.absolute())


def sealing(record: Path, digest: str, target: Path, text: str) -> Step:
    """Plan to write a text once a record is whole, which its SHA-256 tells; else never."""
    return "seal", str(record.absolute()), digest, str(target.absolute()), text


class Journal:
    """One change, as a context; see above.

    Args:
        folder: that it is about.
        plan: what is done if nothing else is planned.

    Raises:
        SessionError: if it cannot be written, or a plan cannot be carried out. What is planned is
            then tried again by the next program that looks.
    """

    def __init__(self, folder: Path, plan: Sequence[Step] = ()) -> None:
        self._folder, self._plan = folder, tuple(plan)
        self._path, self._fd = folder, -1

    def __enter__(self) -> Journal:
        """Open it and write the first plan."""
        settle(self._folder)
        try:
            while self._fd < 0:
                self._open()
            self.plan(self._plan)
        except OSError as error:
            self._close()
            with suppress(OSError):
                self._path.unlink(missing_ok=True)
                self._path.parent.rmdir()
            raise SessionError(
                f"cannot write in {self._folder}: {error.strerror or error}; nothing was changed"
            ) from error
        return self

    def plan(self, steps: Sequence[Step]) -> None:
        """Plan something else from now on: when this returns it stands on the disk.

        Raises:
            OSError: if it cannot be written; the plan before holds.
        """
        line = json.dumps(steps).encode() + b"\n"
        step("plan", self._path)
        if os.write(self._fd, line) != len(line):
            raise OSError(28, os.strerror(28), str(self._path))
        os.fsync(self._fd)
        self._plan = tuple(steps)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Carry out what is planned, also after an exception."""
        try:
            carry_out(self._plan)
            _end(self._path)
        except OSError as problem:
            if error is None:
                raise SessionError(
                    f"cannot change {problem.filename or self._folder}: "
                    f"{problem.strerror or problem}; it is tried again at the next start"
                ) from problem
        finally:
            self._close()

    def _open(self) -> None:
        place = self._folder / FOLDER
        place.mkdir(parents=True, exist_ok=True)
        self._path = place / f"plan.{name_of_process()}"
        flags = os.O_CREAT | os.O_EXCL | os.O_RDWR | os.O_APPEND
        with suppress(FileNotFoundError):  # the empty folder was cleared away meanwhile
            step("open", self._path)
            fd = os.open(self._path, flags, 0o600)
            if hold_alone(fd) is False or not os.fstat(fd).st_nlink:
                os.close(fd)  # another program took it for one that was left
            else:
                self._fd = fd
                sync(place)

    def _close(self) -> None:
        if self._fd >= 0:
            os.close(self._fd)
            self._fd = -1


def settle(folder: Path) -> None:
    """Carry out what programs that ended had planned here, and sweep what they left; no raise.

    A folder that cannot be written stays as it is.
    """
    if folder not in _swept and sweep(folder) >= 0:
        _swept.add(folder)
    try:
        left = sorted((folder / FOLDER).iterdir())
    except OSError:
        return
    for path in left:
        with suppress(OSError):
            _settle(path)
    with suppress(OSError):
        (folder / FOLDER).rmdir()


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
        elif what == "move" and os.path.lexists(first):
            target = Path(args[1])
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
        if alone is False or (alone is None and not process_has_gone(path.name)):
            return
        if os.fstat(fd).st_nlink:  # else another program has just settled it
            carry_out(_last_plan(path))
            _end(path)
    finally:
        os.close(fd)


def _last_plan(path: Path) -> list[Any]:
    for line in reversed(path.read_bytes().split(b"\n")[:-1]):
        with suppress(ValueError):
            found = json.loads(line)
            return list(found)
    return []


def _end(path: Path) -> None:
    step("end", path)
    path.unlink(missing_ok=True)
    with suppress(OSError):
        path.parent.rmdir()


def _digest(path: Path) -> str:
    try:
        with path.open("rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError:
        return ""
