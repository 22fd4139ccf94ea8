"""The trainer as a part: its program, and all that it has said."""

from __future__ import annotations

import json
import os
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from tests.twin.part import BrokenRuleError, ProcessPart, ahead, module
from tests.twin.robot import Robot


class TrainerPart(ProcessPart):
    """The trainer's program; what it asks to be done at the board is done here.

    Args:
        folder: of everything.
        robot: at whose terminal it looks.
        nodes: folder of the cameras' nodes.
        scene: file of what stands before them.
        ports: of OpenIGTLink and rosbridge.
        student: key of the person who practises.
        seed: of the hand.
    """

    def __init__(
        self,
        folder: Path,
        robot: Robot,
        nodes: Path,
        scene: Path,
        ports: tuple[int, int],
        student: str,
        seed: int,
    ) -> None:
        super().__init__("trainer", folder / "trainer.log")
        self.folder, self._robot = folder, robot
        self._words = (folder, robot.path, nodes, scene, *ports, student, seed)
        self.said: list[dict] = []
        self._changed = threading.Condition()
        self._reader: threading.Thread | None = None
        self.board = threading.Lock()  # one at a time speaks with the board

    def command(self) -> list[str]:
        return [*ahead("nice", "-n", "-5"), *module("station", *self._words)]

    def environment(self) -> dict[str, str]:
        return home(self.folder)

    def start(self) -> None:
        super().start()
        began = time.monotonic()
        stdout = self._process.stdout
        self._reader = threading.Thread(target=self._read, args=(stdout,), daemon=True)
        self._reader.start()
        self.await_kind("ready", began, 180.0)

    def stop(self) -> None:
        if self._process is None:
            return
        try:
            self.go_on()
            self.say("quit")
            self._process.wait(20)
            self._gone()
        except Exception:
            super().stop()

    def _gone(self) -> None:
        self._process.wait()
        self._reader.join(10.0)  # its last words
        super()._gone()

    def _read(self, stdout) -> None:
        with (self.folder / "said.jsonl").open("a", buffering=1) as log:
            for line in stdout:
                log.write(line)
                try:
                    one = json.loads(line)
                except ValueError:
                    continue
                if one["kind"] == "ask":
                    threading.Thread(target=self._do, args=(one["order"],), daemon=True).start()
                with self._changed:
                    self.said.append(one)
                    self._changed.notify_all()

    def _do(self, order: str) -> None:
        """Do at the board what the program asks for, as a person would."""
        with suppress(OSError, AttributeError, AssertionError), self.board:  # or there is no board
            self._robot.order(order)
        with suppress(OSError, AttributeError):
            self.say("done")

    # --- what it has said -------------------------------------------------------------------------
    def find(self, wanted: Callable[[dict], bool], since: float, seconds: float, what: str) -> dict:
        """Return the first that it says after a moment which is wanted.

        Raises:
            BrokenRuleError: if it does not come.
        """
        end = time.monotonic() + seconds

        def match() -> dict | None:
            return next((one for one in self.said if one["t"] >= since and wanted(one)), None)

        with self._changed:
            while (one := match()) is None:
                left = end - time.monotonic()
                if left <= 0.0:
                    raise BrokenRuleError(f"{what} has not come within {seconds:g} s")
                self._changed.wait(min(left, 1.0))
        return one

    def await_kind(self, kind: str, since: float, seconds: float) -> dict:
        return self.find(lambda one: one["kind"] == kind, since, seconds, f"the trainer's {kind!r}")

    def quiet(self, since: float) -> tuple[float, float]:
        """Return how long after a moment the loop had torque [s], and how much before it [N·m]."""
        asked = time.monotonic()
        self.say(f"quiet {since!r}")
        one = self.await_kind("quiet", asked, 10.0)
        return one["last"], one["before"]


def home(folder: Path) -> dict[str, str]:
    """Return the environment of the program in this laboratory."""
    own = {
        "ACUS_DATA": folder / "data", "ACUS_SETTINGS": folder / "settings",
        "ACUS_SESSIONS": folder / "sessions", "PYTHONWARNINGS": "ignore",
        "ACUS_LRS_PASSWORD": "none", "LANG": "C.UTF-8",
    }  # fmt: skip
    return os.environ | {name: str(value) for name, value in own.items()}
