"""The robot: the firmware's host port as a program behind a terminal, with the arms let free."""

from __future__ import annotations

import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from tests.twin.part import ROOT, ProcessPart, ahead

sys.path.append(str(ROOT / "tests" / "firmware"))
from firmware_rig import built

HAND, STIFF, ASIDE = "hold 0.3", 3.0, 2.0
"""A hand that gives way slowly [N m s/rad]; how it pulls [N m/rad], and how far aside [deg]."""


@dataclass
class Watch:
    """What the motors gave: when there was something last [s], and the most [A]."""

    last: float = 0.0
    most: float = 0.0


class Robot(ProcessPart):
    """A board of the laboratory's pantograph; each start is another power-up at the stops."""

    def __init__(self, folder: Path) -> None:
        super().__init__("robot", folder / "robot.log")
        self.path = folder / "board"
        self._program, self._line = built("host", "icube"), threading.Lock()

    def command(self) -> list[str]:
        return [*ahead("chrt", "-r", "10"), str(self._program), str(self.path)]

    def start(self) -> None:
        self.path.unlink(missing_ok=True)  # of one that was killed
        super().start()
        assert self.hear() == str(self.path)

    def stop(self) -> None:
        if self._process is None:
            return
        try:
            self.go_on()
            self.say("quit")
            self._process.wait(5)
            self._gone()
        except (OSError, subprocess.TimeoutExpired):
            super().stop()

    def order(self, text: str) -> str:
        """Give an order; return what it says before its `ok`."""
        with self._line:
            self.say(text)
            answer = self.hear()
        assert answer.endswith("ok"), f"the board said {answer!r} to {text!r}"
        return answer.removesuffix("ok").strip()

    def torques(self) -> list[float]:
        """Return the currents of its motors [A]."""
        return [float(word) for word in self.order("torques").split()]

    def pull(self) -> None:
        """Have the hand lean the needle off its path and keep it there: the motors push back."""
        for order in (f"turn {ASIDE} {-ASIDE}", f"{HAND} {STIFF}"):
            self.order(order)

    def freeze(self) -> None:
        """Let its main program hang; its timer goes on."""
        self.order("freeze 1")

    def give_way(self) -> None:
        """Have the hand only slow the needle down again."""
        self.order(HAND)

    @contextmanager
    def watched(self, after: float = 0.3) -> Iterator[Watch]:
        """Look at its motors twice a millisecond meanwhile, and for a while [s] after it."""
        watch, over = Watch(), threading.Event()

        def look() -> None:
            while not over.is_set():
                size = max(map(abs, self.torques()))
                watch.most, now = max(watch.most, size), time.monotonic()
                watch.last = now if size > 0.0 else watch.last
                time.sleep(0.0005)

        thread = threading.Thread(target=look)
        thread.start()
        try:
            yield watch
            time.sleep(after)
        finally:
            over.set()
            thread.join()
