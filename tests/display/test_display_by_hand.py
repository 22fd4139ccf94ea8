"""One insertion by hand: the real window, driven with mouse and keyboard through the X server.

Run by `make by-hand`, on an X server of its own: it takes the mouse.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.imaging.scan_order import Seen
from app.session.control_scan import scans_of
from app.session.recording import read_recording
from app.session.store import list_sessions

ROOT = Path(__file__).resolve().parents[2]

pytestmark = [
    pytest.mark.display,
    pytest.mark.timeout(600),
    pytest.mark.skipif(not os.environ.get("ACUS_BY_HAND"), reason="takes the mouse: make by-hand"),
    pytest.mark.skipif(not os.environ.get("DISPLAY"), reason="no X server (DISPLAY is not set)"),
    pytest.mark.skipif(shutil.which("xdotool") is None, reason="xdotool is not installed"),
]


class User:
    """Eyes and hands: reads where things are, and sends X events."""

    def __init__(self, report: Path, process: subprocess.Popen[bytes]) -> None:
        self._report, self._process = report, process

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
            path = Path(folder) / f"{name}.png"
            subprocess.run(["import", "-window", "root", str(path)], check=True)

    @staticmethod
    def do(command: str, *arguments: object) -> None:
        """Send events through the X server."""
        texts = [f"{a:.0f}" if isinstance(a, np.floating) else str(a) for a in arguments]
        subprocess.run(["xdotool", command, *texts], check=True, capture_output=True)


@pytest.fixture
def sessions(tmp_path: Path) -> Path:
    return tmp_path / "sessions"


@pytest.fixture
def user(tmp_path: Path, sessions: Path) -> Iterator[User]:
    """Somebody before a window that has just been started."""
    report = tmp_path / "window.json"
    folders = {"ACUS_SESSIONS": sessions, "ACUS_DATA": tmp_path, "ACUS_SETTINGS": tmp_path}
    environment = os.environ | {name: str(path) for name, path in folders.items()}
    environment.pop("QT_QPA_PLATFORM", None)
    command = [sys.executable, "-m", "tests.display.window_under_test", str(report)]
    process = subprocess.Popen(command, cwd=ROOT, env=environment)
    try:
        yield User(report, process)
    finally:
        process.terminate()
        process.wait(20)


def test_open_place_insert_end_debrief_by_hand(user: User, sessions: Path) -> None:
    user.wait(lambda seen: seen["page"] == "StartPage", "start page", 60)
    user.click(user.see()["begin"])
    user.wait(lambda seen: seen["page"] == "BriefingPage", "briefing", 10)
    user.key("l")  # looks around before the attempt
    user.wait(lambda seen: seen["page"] == "WorkspacePage", "patient", 120)
    user.wait(lambda seen: seen["start"], "robot and cameras", 400)

    before = user.see()
    user.key("e")
    assert user.wait(lambda seen: seen["tool"] == "entry", "entry tool", 5)
    user.click(np.add(before["marks"]["entry"], [6, 0]).tolist())
    user.key("t")
    user.click(np.add(before["marks"]["target"], [4, 3]).tolist())
    placed = user.wait(
        lambda seen: seen if seen["plan"]["reachable"] and seen["start"] else None, "plan", 20
    )
    for point in ("entry_mm", "target_mm"):
        moved = np.subtract(placed["plan"][point], before["plan"][point])
        assert 1.0 < np.linalg.norm(moved) < 25.0, point

    user.click(placed["exercise_tab"])
    there = user.wait(lambda seen: seen["start_visible"] and seen["start"], "start button", 10)
    user.click(there)
    user.wait(lambda seen: seen["state"] == "aligning" and seen["pad"], "attempt", 10)
    for _ in range(3):  # the pad moves the hand half as far as the mouse
        pad = user.see()["pad"]
        user.drag(pad["centre"], 2.0 * np.subtract(pad["centre"], pad["hand"]))
    user.do("mousemove", *user.see()["pad"]["centre"])
    inside = user.wait(lambda seen: seen if seen["measured"] else None, "cameras", 20)
    user.wheel(round(inside["remaining_mm"]) - 6)
    time.sleep(1.0)
    inside = user.wait(lambda seen: seen if seen["measured"] else None, "cameras", 20)
    user.wheel(round(inside["remaining_mm"]))
    user.key("s")
    user.wait(lambda seen: seen["state"] == "holding", "needle at rest near the target", 20)
    user.key("Return")
    user.wait(lambda seen: seen["page"] == "DebriefPage", "debrief", 30)

    (summary,) = list_sessions(sessions)
    assert summary.state == "ended"
    recording = read_recording(next(sessions.rglob("*.mcap")))
    target = recording.placed_plan().plan.target_mm
    np.testing.assert_allclose(target, placed["plan"]["target_mm"], atol=1e-6)
    assert [event.kind for event in recording.events].count("scan") == 1
    tips = recording.trajectory().tip
    missed = np.linalg.norm(tips - recording.placed_plan().p_target, axis=1)
    assert np.nanmin(missed) < 5e-3


def test_an_assessment_by_control_scans_alone_by_hand(user: User, sessions: Path) -> None:
    user.wait(lambda seen: seen["page"] == "StartPage", "start page", 60)
    user.do("mousemove", *user.see()["begin"])
    user.do("mousemove", *next(iter(user.see()["exercises"].values())))
    while "scans-only" not in user.see()["exercises"]:  # further down the list
        user.do("click", 5, "sleep", 0.3)
    user.keep_picture("1-start")
    user.click(user.see()["exercises"]["scans-only"])
    user.click(user.see()["begin"])
    user.wait(lambda seen: seen["page"] == "BriefingPage", "briefing", 10)
    user.key("l")  # looks around before the attempt
    user.wait(lambda seen: seen["page"] == "WorkspacePage", "patient", 120)
    user.click(user.see()["exercise_tab"])
    seen = user.wait(
        lambda seen: seen if seen["start"] and seen["settled"] else None, "robot and cameras", 400
    )
    user.keep_picture("2-ready")

    user.click(seen["start"])
    seen = user.wait(lambda seen: seen if seen["state"] == "aligning" else None, "attempt", 10)
    panel = seen["scan_panel"]
    user.click(panel["here"])  # the crosshair stands at the target
    user.click(panel["slices"])
    user.key("Up", "Up")
    user.click(panel["head"])
    seen = user.wait(lambda seen: seen if seen["scan_panel"]["number"] == 5 else None, "range", 5)
    assert seen["scan_panel"]["centre_mm"] == pytest.approx(seen["plan"]["target_mm"][2] + 5, 0.1)
    user.click(panel["feet"])
    for _ in range(3):  # the pad moves the hand half as far as the mouse
        pad = user.see()["pad"]
        user.drag(pad["centre"], 2.0 * np.subtract(pad["centre"], pad["hand"]))
    user.do("mousemove", *user.see()["pad"]["centre"])
    user.keep_picture("3-aligned")
    user.wheel(45)
    time.sleep(1.5)
    for number in range(1, 5):
        user.wait(lambda seen: seen["measured"] and seen["state"] != "paused", "cameras", 60)
        user.key("s")
        scan = user.wait(
            lambda seen, n=number: seen["scan"] if seen["scan"] and seen["scan"]["number"] == n
            else None, f"scan {number}", 60,
        )  # fmt: skip
        user.keep_picture(f"4-scan-{number}")
        assert scan["slices"] == 5
        if abs(scan["remaining_mm"]) < 2.0:
            break
        user.do("mousemove", *user.see()["pad"]["centre"])
        user.wheel(max(1, round(scan["remaining_mm"])))
        time.sleep(1.5)
        assert not user.see()["needle_shown"]
    user.key("Return")
    user.wait(lambda seen: seen["page"] == "DebriefPage", "debrief", 30)
    time.sleep(1.0)
    user.keep_picture("5-debrief")
    assert user.see()["debrief_scans"] == number

    (summary,) = list_sessions(sessions)
    assert (summary.state, summary.scans) == ("ended", number)
    recording = read_recording(next(sessions.rglob("*.mcap")))
    scans = scans_of(recording.events)
    assert len(scans) == number
    assert scans[-1].seen is Seen.TIP
    assert scans[-1].order.slices == 5
    assert scans[-1].streak is True
    attempt = recording.trajectory()
    missed = np.linalg.norm(attempt.tip[attempt.final()] - attempt.placed.p_target)
    assert missed < 4e-3  # found by the pictures alone
