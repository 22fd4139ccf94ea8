"""The simulated arm watched by mouse and keyboard, in the real window, and taken over from.

It is begun from the briefing, paused, stepped and stopped; then from the menu, and taken over in
the middle of the insertion, which goes on by the wheel. Run by `make by-hand`.
"""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from app.session.recording import open_recording
from app.session.review import review
from app.session.store import records
from tests.display.user import BY_HAND, User, somebody

pytestmark = [*BY_HAND]

PHASES = {
    "reaches": "approach",
    "lifts": "lift",
    "brings": "transfer",
    "stands": "align",
    "turns": "pivot",
    "inserts": "insert",
    "holds": "hold",
}


def test_the_arm_is_watched_stopped_and_taken_over_by_hand(tmp_path: Path) -> None:
    pytest.importorskip("mujoco", reason="needs the extra arm: make extra NAME=arm")
    with somebody(tmp_path) as user:
        user.wait(lambda seen: seen["page"] == "StartPage", "start page", 60)
        user.press("Not now", "button")
        user.press("First insertion", "cell")
        user.press("Begin exercise", "button")
        user.wait(lambda seen: seen["page"] == "BriefingPage", "briefing", 10)
        time.sleep(2.0)
        user.keep_picture("arm-01-briefing")
        user.key("w")
        user.wait(lambda seen: "%" in seen["arm"], "the way is worked out", 120)
        user.keep_picture("arm-02-works-out")
        watch(user, "arm-03", until="turns")
        user.key("space")
        user.wait(lambda _: user.find("Go on (Space)", "button"), "paused", 10)
        user.keep_picture("arm-04-paused")
        user.key("F10")
        user.key("Escape")
        user.wait(lambda seen: not seen["arm"], "stopped", 20)
        assert user.see()["page"] == "WorkspacePage"
        user.keep_picture("arm-05-stopped")
        user.menu("Sessions", "Watch the arm do my plan")
        user.wait(lambda _: user.find("To the entry (F3)", "button"), "it fetches", 240)
        user.press("To the entry (F3)", "button")
        watch(user, "arm-06", until="inserts")
        inside = user.wait(
            lambda seen: seen if seen["measured"] and seen["remaining_mm"] < 60.0 else None,
            "the needle is in the body", 60,
        )  # fmt: skip
        user.key("F12")
        user.wait(lambda seen: not seen["arm"] and seen["pad"], "taken over", 10)
        time.sleep(1.0)
        after = user.see()
        assert inside["remaining_mm"] - after["remaining_mm"] < 25.0  # it went on till the key
        user.keep_picture("arm-07-taken-over")
        user.do("mousemove", *after["pad"]["centre"])
        user.wheel(5)
        user.wait(
            lambda seen: abs(after["remaining_mm"] - seen["remaining_mm"] - 5.0) < 1.5,
            "the wheel pushes", 20,
        )  # fmt: skip
        user.key("Return")
        user.wait(lambda seen: seen["page"] == "DebriefPage", "debrief", 60)
        time.sleep(3.0)
        user.keep_picture("arm-08-debrief")
        user.menu("Sessions", "Past sessions")
        time.sleep(3.0)
        user.keep_picture("arm-09-sessions")
    folder = tmp_path / "sessions"
    shown = [review(open_recording(folder / name)).conditions for name in records(folder)]
    assert [one.hand for one in shown if one is not None] == ["arm", "arm"]
    assert [one.taken_over for one in shown if one is not None] == ["", "mouse"]


def watch(user: User, picture: str, until: str) -> None:
    """Keep a picture of each phase, a moment after it began, until one begins."""
    kept: set[str] = set()

    def looked(seen: dict[str, str]) -> bool:
        for word, phase in PHASES.items():
            if word in seen["arm"] and "%" not in seen["arm"] and phase not in kept:
                kept.add(phase)
                time.sleep(0.8)
                user.keep_picture(f"{picture}-{phase}")
        return until in seen["arm"] and "%" not in seen["arm"]

    user.wait(looked, f"it {until}", 240)
