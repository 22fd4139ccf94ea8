"""One attempt after the other by hand: *Again*, *Next*, a plan that was discarded, other people.

Run by `make by-hand`, on an X server of its own: it takes mouse and keyboard.
"""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.exercises.library import load_exercise
from tests.display.user import BY_HAND, User, somebody

pytestmark = BY_HAND

PASSWORD = "correct horse"


@pytest.fixture
def user(tmp_path: Path) -> Iterator[User]:
    """Somebody before a window that has just been started."""
    with somebody(tmp_path) as user:
        user.wait(lambda seen: seen["page"] == "StartPage", "start page", 60)
        time.sleep(1.0)
        user.press("Not now", "button")
        yield user


def choose(user: User, name: str) -> None:
    """Begin an exercise of the start page."""
    user.do("mousemove", *next(iter(user.see()["exercises"].values())))
    for button in (4, 5):
        for _ in range(25):
            if name in user.see()["exercises"]:
                break
            user.do("click", button, "sleep", 0.3)
    user.click(user.see()["exercises"][name])
    user.wait(lambda seen: seen["page"] == "BriefingPage", "briefing", 20)
    time.sleep(1.0)


def begun(user: User) -> dict[str, Any]:
    """Wait for the attempt; return where hand and needle are then."""
    user.wait(lambda seen: seen["state"] == "aligning" and seen["pad"], "attempt", 300)
    return user.wait(lambda seen: seen if seen["measured"] else None, "cameras", 30)


def off(seen: dict[str, Any]) -> np.ndarray:
    """Where the hand stands on the pad, from its middle [px]."""
    return np.subtract(seen["pad"]["hand"], seen["pad"]["centre"])


def insert_and_end(user: User, to_target: bool = False) -> None:
    """Lead the hand onto the path and in, part of the way or to the target; end the attempt."""
    for _ in range(3):
        pad = user.see()["pad"]
        user.drag(pad["centre"], 2.0 * np.subtract(pad["centre"], pad["hand"]))
    user.do("mousemove", *user.see()["pad"]["centre"])
    user.wheel(50)
    time.sleep(1.5)
    while to_target and abs(user.see()["remaining_mm"]) > 1.0:
        inside = user.wait(lambda seen: seen if seen["measured"] else None, "cameras", 30)
        user.wheel(max(1, round(inside["remaining_mm"])))
        time.sleep(1.5)
    if to_target:
        user.wait(lambda seen: seen["state"] == "holding", "needle at rest", 30)
        time.sleep(2.0)
    user.key("Return")
    user.wait(lambda seen: seen["page"] == "DebriefPage", "debrief", 60)
    time.sleep(1.0)


def test_again_and_next_begin_where_the_first_attempt_did(user: User) -> None:
    choose(user, "first-insertion")
    user.key("Return")
    first = begun(user)
    user.keep_picture("again-1-first")
    for number in range(2):
        insert_and_end(user)
        user.keep_picture(f"again-2-debrief-{number}")
        user.press("Again", "button")
        user.wait(lambda seen: "goes back to its start" in seen["step"], "way back", 30)
        user.keep_picture(f"again-3-back-{number}")
        user.do("mousemove", *user.see()["pad"]["centre"])
        early = 0
        while user.see()["state"] == "withdrawing":  # the hand obeys nobody yet
            user.wheel(1)
            early += 1
        now = begun(user)
        print(f"{early} notches too early")
        user.keep_picture(f"again-4-begun-{number}")
        np.testing.assert_allclose(off(now), off(first), atol=12.0)
        assert now["remaining_mm"] == pytest.approx(first["remaining_mm"], abs=6.0)
    insert_and_end(user, to_target=True)
    user.keep_picture("again-4-passed")
    user.press("Next", "button")
    user.wait(lambda seen: seen["page"] in ("BriefingPage", "WorkspacePage"), "what is next", 60)
    if user.see()["page"] == "BriefingPage":
        user.key("Return")
    now = begun(user)
    user.keep_picture("again-5-next")
    assert now["remaining_mm"] > 60.0


def take_a_mapped_path(user: User) -> None:
    """Let the map of entries find a path, and take the best."""
    user.press("Plan", "button", whole=True)
    user.press("Map entries for this target", "button", patience=30)
    user.wait(lambda _: user.find("Clear", "button", whole=True), "map", 120)
    time.sleep(1.0)
    user.keep_picture("plan-0-map")
    user.press("", "cell", patience=5)
    user.do("mousemove", *user.find("Clear", whole=True)[0]["at"])
    for _ in range(10):  # the button lies below, on a small screen
        user.do("click", 5, "sleep", 0.05)
    time.sleep(0.5)
    user.press("Take this path", "button")
    user.wait(lambda seen: seen["plan"]["reachable"], "plan", 20)


def test_a_plan_that_was_discarded_is_asked_for_anew(user: User) -> None:
    choose(user, "plan-it-yourself")
    user.key("Return")
    user.wait(lambda seen: seen["page"] == "WorkspacePage" and seen["settled"] is not None, "", 120)
    time.sleep(3.0)
    take_a_mapped_path(user)
    user.keep_picture("plan-1-mapped")
    user.wait(lambda seen: seen["start"], "the start", 300)
    user.key("F5")
    begun(user)
    user.keep_picture("plan-2-begun")
    insert_and_end(user)
    user.press("Again", "button")
    user.press("Discard", "button")
    user.wait(lambda seen: "Place the entry" in seen["step"], "what is missing", 20)
    user.click(user.see()["exercise_tab"])  # no window manager gives the keyboard back
    user.key("F5")
    user.wait(lambda seen: "Place the entry" in seen["message"], "what F5 says", 5)
    user.keep_picture("plan-3-discarded")
    assert user.see()["state"] == "ended"
    take_a_mapped_path(user)
    user.wait(lambda seen: seen["start"], "the start", 30)
    user.keep_picture("plan-4-placed")
    user.key("F5", "F5")
    begun(user)
    user.keep_picture("plan-5-again")


def test_the_instructors_map_goes_with_him(user: User) -> None:
    choose(user, "plan-it-yourself")
    user.key("Return")
    user.wait(lambda seen: seen["page"] == "WorkspacePage", "patient", 120)
    time.sleep(3.0)
    user.menu("Sessions", "Sign in as the instructor")
    user.write("New password", PASSWORD)
    user.write("Again", PASSWORD)
    user.key("Return")
    user.press("Close", "button")
    user.key("space")
    user.press("Close", "button")
    user.press("Map entries for this target", "button", patience=30)
    user.wait(lambda _: user.find("Clear", "button", whole=True), "map", 120)
    time.sleep(2.0)
    user.keep_picture("map-1-instructor")
    user.menu("Sessions", "Sign out")
    time.sleep(2.0)
    user.keep_picture("map-2-signed-out")
    assert not user.find("Clear", "button", whole=True), "there is nothing to clear"


def test_the_long_tools_steering_does_not_outlive_it(tmp_path: Path) -> None:
    with somebody(tmp_path) as user:
        user.wait(lambda seen: seen["page"] == "StartPage", "start page", 60)
        user.press("Not now", "button")
        choose(user, "laparoscopic-tool")
        user.key("Return")
        begun(user)
        user.keep_picture("tool-1-begun")
        time.sleep(2.0)  # Enter pressed twice ends nothing
        user.key("Return")
        user.wait(lambda seen: seen["page"] == "DebriefPage", "debrief", 60)
        user.key("ctrl+q")
        time.sleep(3.0)
    with somebody(tmp_path) as user:
        user.wait(lambda seen: seen["page"] == "StartPage", "start page", 60)
        choose(user, "first-insertion")
        user.key("Return")
        before = begun(user)
        pad = before["pad"]
        user.drag(pad["centre"], np.array([40.0, 0.0]))
        user.keep_picture("tool-2-after")
        assert user.see()["pad"]["hand"][0] > pad["hand"][0] + 8.0, "to the right is to the right"


def test_where_control_scans_guide_the_dial_cannot_be_turned(tmp_path: Path) -> None:
    exercise = load_exercise("first-insertion").model_dump(mode="json", exclude_defaults=True)
    exercise |= {
        "id": "by-scans", "title": "By control scans", "assistance": 0.0, "level": 1,
        "guidance": {"mode": "control_ct"},
    }  # fmt: skip
    (tmp_path / "exercises").mkdir()
    (tmp_path / "exercises" / "by-scans.yaml").write_text(json.dumps(exercise))
    with somebody(tmp_path) as user:
        user.wait(lambda seen: seen["page"] == "StartPage", "start page", 60)
        user.press("Not now", "button")
        choose(user, "by-scans")
        user.keep_picture("dial-1-briefing")
        user.key("Return")
        user.wait(lambda seen: seen["state"] == "aligning", "attempt", 300)
        user.keep_picture("dial-2-begun")
