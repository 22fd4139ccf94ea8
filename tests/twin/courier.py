"""What goes out after each attempt: DICOM objects to the archive, statements to the university.

By the program's own commands, one after the other, again until each has done it.
"""

from __future__ import annotations

import json
import subprocess
import sys
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path

import pydicom

from tests.twin.part import ROOT
from tests.twin.trainer_part import home

PAUSE = 1.0


def acus(folder: Path, *words: object) -> tuple[bool, str, dict]:
    """Run a command of the program; return whether it did it, what it said, its facts."""
    command = [sys.executable, "-m", "app", *map(str, words), "--json"]
    done = subprocess.run(
        command, capture_output=True, text=True, cwd=ROOT, env=home(folder), check=False
    )
    try:
        facts = json.loads(done.stdout)["facts"]
    except ValueError:
        facts = {}
    return done.returncode == 0, " ".join(done.stderr.split()), facts


@dataclass(frozen=True)
class Sending:
    """One command: when it began and ended, to whom, whether it did it, what it said."""

    began: float
    ended: float
    to: str
    done: bool
    words: str


@dataclass
class Courier:
    """Sends to each in a thread of its own.

    Args:
        folder: of the laboratory.
        to: names of whom there is: `archive`, `university`.
    """

    folder: Path
    to: frozenset[str]
    sendings: list[Sending] = field(default_factory=list)
    objects: dict[str, list[str]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._waiting: dict[str, list[str]] = {name: [] for name in self.to}
        self.ended: list[str] = []
        self._moved = time.monotonic()
        self._over = threading.Event()
        self._threads = [
            threading.Thread(target=self._run, args=(name,), daemon=True) for name in self.to
        ]

    def start(self) -> None:
        for one in self._threads:
            one.start()

    def take(self, number: str) -> None:
        """Have an attempt told."""
        self.ended.append(number)
        for waiting in self._waiting.values():
            waiting.append(number)

    def send_again(self, to: str) -> None:
        """Have the newest attempt sent once more: who has it keeps one."""
        if not self._waiting[to] and self.ended:
            self._waiting[to].append(self.ended[-1])

    def finish(self, seconds: float) -> bool:
        """Wait until nothing waits, or no command has done its work for so long, then end.

        Returns:
            Whether nothing is left.
        """
        begun = time.monotonic()
        while any(self._waiting.values()):
            if time.monotonic() > max(begun, self._moved) + seconds:
                break
            time.sleep(0.1)
        self._over.set()
        for one in self._threads:
            one.join(60.0)
        return not any(self._waiting.values())

    def find(self, to: str, done: bool, since: float, seconds: float) -> Sending | None:
        """Return the first sending that ended after a moment, and did it or did not."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for one in list(self.sendings):
                if one.to == to and one.done is done and one.ended >= since and one.began >= since:
                    return one
            time.sleep(0.05)
        return None

    def _run(self, name: str) -> None:
        waiting = self._waiting[name]
        while not self._over.wait(PAUSE):
            if (some := list(waiting)) and getattr(self, f"_{name}")(some):
                del waiting[: len(some)]

    def _note(self, to: str, *words: object) -> bool:
        began = time.monotonic()
        done, said, _ = acus(self.folder, *words)
        self.sendings.append(Sending(began, time.monotonic(), to, done, said))
        self._moved = time.monotonic() if done else self._moved
        return done

    def _archive(self, numbers: list[str]) -> bool:
        for number in numbers:
            place = self.folder / "objects" / number
            if number not in self.objects:
                done, said, facts = acus(self.folder, "session", "export", number, "--dicom", place)
                if not done:
                    now = time.monotonic()
                    self.sendings.append(Sending(now, now, "archive", False, said))
                    return False
                self._moved = time.monotonic()
                self.objects[number] = [
                    str(pydicom.dcmread(one, stop_before_pixels=True).SOPInstanceUID)
                    for one in facts["files"]
                ]
            if not self._note("archive", "pacs", "send", place):
                return False
        return True

    def _university(self, numbers: list[str]) -> bool:
        return self._note("university", "results", "send")
