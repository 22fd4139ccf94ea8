"""A long tool steered by hand: the real window, driven with mouse and wheel through the X server.

Run by `make by-hand`, on an X server of its own: it takes the mouse. The hand moves the handle, so
the mouse goes the other way than the tip is to go.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.session.pad.hand import GAINS
from app.session.recording import read_recording
from app.session.store import list_sessions
from app.session.touching import marks_at, touches_of
from app.session.verify import verify
from tests.display.user import BY_HAND, User, somebody

pytestmark = BY_HAND

WELL_MM = 1.5
"""A tip so near to a target is left there."""


@pytest.fixture
def user(tmp_path: Path) -> Iterator[User]:
    """Somebody before a window that has just been started."""
    with somebody(tmp_path) as user:
        yield user


def steer(user: User, stands: dict[str, Any]) -> None:
    """Move the handle the other way than the tip is to go, by as much as the depth asks for."""
    way = np.array([stands["right_mm"], -stands["up_mm"]])  # the screen counts downwards
    scale = max(stands["depth_mm"], 20.0) / stands["outside_mm"]
    mouse_mm = -way / scale / GAINS["normal"]
    step = mouse_mm / stands["reach_mm"] * stands["radius_px"]
    longest = 0.9 * stands["radius_px"]
    user.drag(user.see()["pad"]["centre"], step * min(1.0, longest / np.linalg.norm(step)))


def push(user: User, stands: dict[str, Any]) -> None:
    """Turn the wheel: a notch is a millimetre."""
    notches = round(stands["along_mm"])
    user.do("mousemove", *user.see()["pad"]["centre"])
    for _ in range(abs(notches)):
        user.do("click", 4 if notches > 0 else 5, "sleep", 0.02)
    time.sleep(0.4)


def test_all_targets_are_touched_by_mouse_and_wheel(user: User, tmp_path: Path) -> None:
    user.wait(lambda seen: seen["page"] == "StartPage", "start page", 60)
    user.do("mousemove", *next(iter(user.see()["exercises"].values())))
    while "laparoscopic-tool" not in user.see()["exercises"]:  # further down the map
        user.do("click", 5, "sleep", 0.3)
    user.click(user.see()["exercises"]["laparoscopic-tool"])
    user.wait(lambda seen: seen["page"] == "BriefingPage", "briefing", 10)
    time.sleep(2.0)
    user.keep_picture("1-briefing")
    user.key("l")  # looks around before the attempt
    user.wait(lambda seen: seen["page"] == "WorkspacePage", "patient", 120)
    user.click(user.see()["exercise_tab"])
    seen = user.wait(
        lambda seen: seen if seen["start"] and seen["settled"] else None, "robot and cameras", 400
    )
    user.keep_picture("2-ready")
    user.click(seen["start"])
    user.wait(lambda seen: seen["state"] == "aligning" and seen["pad"], "attempt", 10)
    assert user.see()["touch_note"].startswith("0 of 6 touched")

    shown, end = -1, time.monotonic() + 240.0
    while time.monotonic() < end:
        stands = user.wait(lambda seen: seen["measured"] and seen["touch"], "cameras", 30)
        if stands["touched"] != shown:
            shown = stands["touched"]
            user.keep_picture(f"3-touched-{shown}")
        if stands["touched"] == stands["of"]:
            break
        aside = float(np.hypot(stands["right_mm"], stands["up_mm"]))
        if aside > WELL_MM and stands["depth_mm"] > 5.0:
            steer(user, stands)
        elif abs(stands["along_mm"]) > WELL_MM:
            push(user, stands)
        else:
            time.sleep(0.3)
    assert shown == user.see()["touch"]["of"]
    assert "the other way" in user.see()["touch_note"]
    assert "Enter" in user.wait(lambda s: "Enter" in s["step"] and s["step"], "what is next", 5)
    user.key("Return")
    user.wait(lambda seen: seen["page"] == "DebriefPage", "debrief", 150)
    time.sleep(4.0)
    user.keep_picture("4-debrief")

    (summary,) = list_sessions(tmp_path / "sessions")
    assert summary.state == "ended"
    recording = read_recording(next((tmp_path / "sessions").rglob("*.mcap")))
    touches = touches_of(recording.events)
    assert touches is not None
    assert len(touches.times) == touches.of
    marks = marks_at(recording.events, touches.times[-1])
    assert marks is not None
    assert marks.touched == touches.of
    assert verify(recording).confirmed
    scored = {row.name: row.value for row in verify(recording).recomputed.rows}
    assert scored["targets_touched"] == 100.0
