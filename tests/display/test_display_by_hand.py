"""One insertion by hand: the real window, driven with mouse and keyboard through the X server.

Run by `make by-hand`, on an X server of its own: it takes the mouse.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from app.imaging.scan_order import Seen
from app.session.control_scan import scans_of
from app.session.recording import read_recording
from app.session.store import list_sessions
from tests.display.user import BY_HAND, User, somebody

pytestmark = BY_HAND


@pytest.fixture
def sessions(tmp_path: Path) -> Path:
    return tmp_path / "sessions"


@pytest.fixture
def user(tmp_path: Path) -> Iterator[User]:
    """Somebody before a window that has just been started."""
    with somebody(tmp_path) as user:
        yield user


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
    while "scans-only" not in user.see()["exercises"]:  # further down the map
        user.do("click", 5, "sleep", 0.3)
    user.keep_picture("1-start")
    user.click(user.see()["exercises"]["scans-only"])
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
