"""Somebody before the real window: eyes that read where things are, hands that send X events."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import ImageGrab

ROOT = Path(__file__).resolve().parents[2]

BY_HAND = [
    pytest.mark.display,
    pytest.mark.timeout(1200),
    pytest.mark.skipif(not os.environ.get("ACUS_BY_HAND"), reason="takes the mouse: make by-hand"),
    pytest.mark.skipif(not os.environ.get("DISPLAY"), reason="no X server (DISPLAY is not set)"),
    pytest.mark.skipif(shutil.which("xdotool") is None, reason="xdotool is not installed"),
]
"""Marks of a test that takes mouse and keyboard."""


class User:
    """Eyes and hands: reads where things are, and sends X events."""

    def __init__(self, report: Path, process: subprocess.Popen[bytes]) -> None:
        self._report, self._process = report, process
        self.clicks = 0

    def see(self) -> dict[str, Any]:
        """What the window shows now."""
        assert self._process.poll() is None, "the window is gone"
        return json.loads(self._report.read_text()) if self._report.exists() else {"page": ""}

    def wait(self, until: Callable[[dict[str, Any]], Any], what: str, patience: float) -> Any:
        """Look until something is there; returns it."""
        end = time.monotonic() + patience
        while time.monotonic() < end:
            if answer := until(self.see()):
                return answer
            time.sleep(0.1)
        raise AssertionError(f"{what}: not within {patience:g} s; the window shows {self.see()}")

    def find(self, words: str, kind: str = "", whole: bool = False) -> list[dict[str, Any]]:
        """Everything on top that can be clicked or typed into and has these words."""
        return [
            one
            for one in self.see().get("things", ())
            if (one["words"] == words if whole else words in one["words"])
            and kind in ("", one["kind"])
        ]

    def press(
        self,
        words: str,
        kind: str = "",
        place: int = 0,
        patience: float = 15.0,
        whole: bool = False,
    ) -> None:
        """Click what has these words, as soon as it is there."""
        end = time.monotonic() + patience
        while time.monotonic() < end:
            found = self.find(words, kind, whole)
            if len(found) > place:
                self.click(found[place]["at"])
                self.clicks += 1
                return
            time.sleep(0.2)
        there = [(one["kind"], one["words"]) for one in self.see().get("things", ())]
        raise AssertionError(f"nothing says {words!r}; there are {there}")

    def menu(self, menu: str, entry: str) -> None:
        """Choose an entry of a menu of the window."""
        self.press(menu, "entry", whole=True)
        self.press(entry, "entry")

    def write(self, words: str, text: str, kind: str = "field") -> None:
        """Type into the field that has these words beside it, over what stands there."""
        self.press(words, kind)
        self.do("key", "ctrl+a")
        self.do("type", "--delay", 12, text)
        time.sleep(0.3)

    def choose_file(self, path: Path) -> None:
        """Type a path into the file dialog that is open."""
        self.wait(lambda seen: any(t["kind"] == "field" for t in seen["things"]), "dialog", 10)
        self.do("key", "ctrl+a")
        self.do("type", "--delay", 8, str(path))
        time.sleep(0.6)
        if not self.find("", "button"):  # what begins so is offered: that popup takes the keys
            self.do("key", "Escape")
            time.sleep(0.3)
        self.key("Return")

    def click(self, place: list[float]) -> None:
        """Click there."""
        self.do("mousemove", *place, "sleep", 0.15, "click", 1)
        time.sleep(0.3)

    def drag(self, start: list[float], step: np.ndarray, parts: int = 12) -> None:
        """Press, move in small steps, release."""
        self.do("mousemove", *start, "sleep", 0.1, "mousedown", 1)
        for share in np.linspace(0.0, 1.0, parts + 1)[1:]:
            self.do("mousemove", *(np.asarray(start) + share * step), "sleep", 0.03)
        self.do("mouseup", 1)
        time.sleep(0.4)

    def wheel(self, notches: int) -> None:
        """Turn the wheel away from oneself, a notch at a time."""
        for _ in range(notches):
            self.do("click", 4, "sleep", 0.02)

    def key(self, *keys: str) -> None:
        """Press and release keys."""
        self.do("key", *keys)
        time.sleep(0.3)

    def keep_picture(self, name: str) -> None:
        """Keep the screen as it is now, if `ACUS_BY_HAND_PICTURES` names a folder."""
        folder = os.environ.get("ACUS_BY_HAND_PICTURES")
        if folder:
            screen = ImageGrab.grab(xdisplay=os.environ["DISPLAY"])
            screen.save(Path(folder) / f"{name}.png")

    @staticmethod
    def do(command: str, *arguments: object) -> None:
        """Send events through the X server."""
        texts = [f"{a:.0f}" if isinstance(a, np.floating) else str(a) for a in arguments]
        subprocess.run(["xdotool", command, *texts], check=True, capture_output=True)


@contextmanager
def somebody(folder: Path) -> Iterator[User]:
    """Start the window with its data, settings and sessions in a folder of its own; close it."""
    report = folder / "window.json"
    folders = {"ACUS_SESSIONS": folder / "sessions", "ACUS_DATA": folder, "ACUS_SETTINGS": folder}
    environment = os.environ | {name: str(path) for name, path in folders.items()}
    environment.pop("QT_QPA_PLATFORM", None)
    command = [sys.executable, "-m", "tests.display.window_under_test", str(report)]
    process = subprocess.Popen(command, cwd=ROOT, env=environment)
    try:
        yield User(report, process)
    finally:
        process.terminate()
        process.wait(20)
