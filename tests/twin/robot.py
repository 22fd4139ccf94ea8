"""The robot: the firmware's host port as a program behind a terminal, with the arms let free."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

from tests.twin.part import ROOT, ProcessPart, ahead

sys.path.append(str(ROOT / "tests" / "firmware"))
from firmware_rig import built


HAND, STIFF, ASIDE = "hold 0.3", 3.0, 2.0
"""A hand that gives way slowly [N m s/rad]; how it pulls [N m/rad], and how far aside [deg]."""


class Robot(ProcessPart):
    """A board of the laboratory's pantograph; each start is another power-up at the stops."""

    def __init__(self, folder: Path) -> None:
        super().__init__("robot", folder / "robot.log")
        self.path = folder / "board"
        self._program = built("host", "icube")

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
        self.say(text)
        answer = self.hear()
        assert answer.endswith("ok"), f"the board said {answer!r} to {text!r}"
        return answer.removesuffix("ok").strip()

    def torques(self) -> list[float]:
        """Return the currents of its motors [A]."""
        return [float(word) for word in self.order("torques").split()]

    def pull(self) -> None:
        """Have the hand lean the needle off its path and keep it there, so that it is pushed back."""
        for order in (f"turn {ASIDE} {-ASIDE}", f"{HAND} {STIFF}"):
            self.order(order)

    def give_way(self) -> None:
        """Have the hand only slow the needle down again."""
        self.order(HAND)

    def silent_after(self, moment: float, patience: float = 2.0) -> float:
        """Return how long after a moment [s] its motors gave something last."""
        last = moment
        while time.monotonic() < moment + patience:
            asked = time.monotonic()
            if any(self.torques()):
                last = time.monotonic()
            elif asked - last > 0.1:
                break
            time.sleep(0.0005)
        return last - moment
