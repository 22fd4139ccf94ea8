"""Mouse and keyboard of the X server, through `xdotool`: they come from outside the program."""

from __future__ import annotations

import subprocess
import time

from tests.careless.actions import Action

BUTTONS = {"click": (1, 1), "double": (1, 2), "right": (3, 1), "middle": (2, 1)}
STEP_S = 0.01


def point(box: tuple[int, int, int, int], at: tuple[float, float]) -> tuple[int, int]:
    """Return a place [px of the screen] in a rectangle by shares of its sides."""
    x, y, width, height = box
    return round(x + at[0] * (width - 1)), round(y + at[1] * (height - 1))


def click(box: tuple[int, int, int, int], action: Action) -> None:
    """Click, twice or with another button by the action's kind."""
    button, times = BUTTONS.get(action.kind, (1, 1))
    x, y = point(box, action.at)
    _do("mousemove", x, y, "sleep", 0.02, "click", "--repeat", times, "--delay", 40, button)


def drag(box: tuple[int, int, int, int], action: Action) -> None:
    """Press, move in steps of a hundredth of a second, release."""
    x, y = point(box, action.at)
    steps = max(1, round(action.seconds / STEP_S))
    words: list[object] = ["mousemove", x, y, "mousedown", action.number or 1]
    for step in range(1, steps + 1):
        share = step / steps
        words += ["mousemove", _on(x + share * action.to[0]), _on(y + share * action.to[1])]
        words += ["sleep", STEP_S]
    try:
        _do(*words)
    finally:
        _do("mouseup", action.number or 1)


def wheel(box: tuple[int, int, int, int], action: Action) -> None:
    """Turn the wheel, as fast as it goes."""
    x, y = point(box, action.at)
    button = 4 if action.number > 0 else 5
    _do("mousemove", x, y, "click", "--repeat", abs(action.number), "--delay", 5, button)


def key(action: Action) -> None:
    """Press and release a key, or several times."""
    for _ in range(max(1, action.number)):
        _do("key", action.words)


def write(text: str) -> None:
    """Type a text into whatever has the keyboard."""
    if text:
        _do("type", "--delay", 5, "--", text)


def wait(seconds: float) -> None:
    """Do nothing."""
    time.sleep(seconds)


def _on(value: float) -> int:
    """Keep a coordinate on a screen: a mouse stops at its edge."""
    return max(0, min(round(value), 1919))


def _do(*words: object) -> None:
    subprocess.run(["xdotool", *map(str, words)], check=True, capture_output=True, timeout=60)
