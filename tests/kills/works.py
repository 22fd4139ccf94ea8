"""What the programs do that are killed, and how: at a step of the file layer, or at any moment."""

from __future__ import annotations

import json
import os
import random
import shutil
import signal
import sys
import time
import traceback
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from itertools import count, cycle
from pathlib import Path
from typing import Any

from app.commands import build
from app.core.errors import AcusError
from app.core.files import watched
from app.session import store
from app.session.archive import backup, empty_trash, erase_person, restore_backup
from app.session.people import People
from app.session.roster import RosterLine
from tests.kills.home import Home, attempt, faults, state

Work = Callable[[Home, str], object]


def started() -> None:
    """Run what a start of the program runs, in this process's home."""
    out = os.dup(1)
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    for command in ("session list", "store status"):
        build()(args=command.split(), prog_name="acus", standalone_mode=False)
    sys.stdout.flush()
    os.dup2(out, 1)


def _first_of(folder: Path) -> str:
    return min(path.stem for path in store.records(folder))


def _record(home: Home, _: str) -> object:
    return attempt(home, People().find("Ada").key)


def _roster(home: Home, _: str) -> object:
    return People().take_roster([RosterLine("Dora", "Dirac", "1933"), RosterLine("Ada", "A. L.")])


def _restore(home: Home, recovery: str) -> object:
    return restore_backup(home.out / "first.acusbackup", home.folder, recovery)


WORKS: dict[str, Work] = {
    "delete": lambda home, _: store.delete(home.folder, _first_of(home.folder)),
    "bring back": lambda home, _: store.restore(home.folder, _first_of(home.folder / store.TRASH)),
    "first restore": _restore,
    "restore": _restore,
    "restore with people": lambda home, recovery: restore_backup(
        home.out / "first.acusbackup", home.folder, recovery, replace_people=True
    ),
    "backup": lambda home, _: backup(home.out / "second.acusbackup", home.folder),
    "erase": lambda home, _: erase_person("Ada", home.folder, delete_records=True),
    "empty the trash": lambda home, _: empty_trash(home.folder, now=time.time() + 4e6),
    "roster": _roster,
    "attempt": _record,
}


@dataclass
class Trial:
    """Homes to copy, and a place for the copies.

    Attributes:
        home: with everything in it.
        empty: with a backup only.
        recovery: the recovery key.
        scratch: for copies.
    """

    home: Home
    empty: Home
    recovery: str
    scratch: Path

    def copy_for(self, work: str, name: str) -> Home:
        """Copy the home that a work begins in; for a restore two records and a signature lack."""
        source = self.empty if work == "first restore" else self.home
        home = source.copied(self.scratch / name)
        if work.startswith("restore"):
            for path in (home.folder / store.TRASH).glob("*"):
                path.unlink()
        return home

    def steps(self, work: str) -> tuple[int, dict[str, Any], dict[str, Any]]:
        """Return how many steps a work has, and what is kept before and after it."""
        home = self.copy_for(work, "counted")
        before = asked(lambda: (home.enter(), state())[1])
        after = asked(lambda: _counted(home, work, self.recovery))
        shutil.rmtree(home.root)
        return after.pop("steps"), before, after


def _counted(home: Home, work: str, recovery: str) -> dict[str, Any]:
    home.enter()
    steps = []
    with watched(lambda what, path: steps.append((what, path.name))):
        WORKS[work](home, recovery)
    return state() | {"steps": len(steps)}


def killed_at(home: Home, work: str, recovery: str, at: int) -> bool:
    """Do a work in a process that is killed before one of its steps; whether it came to that."""

    def program() -> None:
        home.enter()
        numbers = count()

        def watch(what: str, path: Path) -> None:
            if next(numbers) == at:
                os.kill(os.getpid(), signal.SIGKILL)

        with watched(watch):
            WORKS[work](home, recovery)

    return _ended_by(program) == -signal.SIGKILL


def killed_after(home: Home, works: list[str], recovery: str, seconds: float) -> bool:
    """Do works in a process that is killed after a while; whether it came to that."""

    def program() -> None:
        home.enter()
        for work in cycle(works):
            with suppress(AcusError, ValueError):  # the student was erased, the trash is empty
                WORKS[work](home, recovery)

    return _ended_by(program, seconds) == -signal.SIGKILL


def next_start(home: Home) -> dict[str, Any]:
    """Start the program as anybody would, and return what it finds then.

    `faults` is what is wrong; the rest is what is kept.
    """

    def program() -> dict[str, Any]:
        home.enter()
        started()
        return {"faults": faults(home)} | state()

    return asked(program)


def asked(question: Callable[[], Any]) -> Any:
    """Ask a question in a process of its own; return the answer."""
    reads, writes = os.pipe()
    pid = os.fork()
    if pid == 0:
        code = 1
        try:
            answer = json.dumps(question()).encode()
            os.close(reads)
            with os.fdopen(writes, "wb") as stream:
                stream.write(answer)
            code = 0
        except BaseException:
            traceback.print_exc()
        os._exit(code)
    os.close(writes)
    with os.fdopen(reads, "rb") as stream:
        answer = stream.read()
    _, status = os.waitpid(pid, 0)
    if status:
        raise RuntimeError("the program that was asked has failed")
    return json.loads(answer)


def _ended_by(program: Callable[[], object], seconds: float | None = None) -> int:
    """Run a program in a process of its own; return its exit code, or minus the signal."""
    pid = os.fork()
    if pid == 0:
        code = 1
        try:
            program()
            code = 0
        except BaseException:
            traceback.print_exc()
        os._exit(code)
    if seconds is not None:
        time.sleep(seconds)
        os.kill(pid, signal.SIGKILL)
    _, status = os.waitpid(pid, 0)
    return os.waitstatus_to_exitcode(status)


def mixed(rng: random.Random) -> list[str]:
    """Draw what a program does until it is killed."""
    return ["attempt", *rng.choices([w for w in WORKS if w != "first restore"], k=3)]


__all__ = ["WORKS", "Trial", "killed_after", "killed_at", "mixed", "next_start", "started"]
