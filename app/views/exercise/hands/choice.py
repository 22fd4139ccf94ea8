"""Which sources there are, and what each is called and does."""

from collections.abc import Callable
from typing import Final

from app.views.exercise.hands.gamepad import GamepadHand
from app.views.exercise.hands.mouse import MouseHand
from app.views.exercise.hands.source import HandSource
from app.views.exercise.hands.tablet import TabletHand
from app.views.exercise.pad_canvas import PadCanvas
from app.views.kit.text import tr

SOURCES: Final[dict[str, Callable[[PadCanvas], HandSource]]] = {
    source.name: source for source in (MouseHand, TabletHand, GamepadHand)
}
"""Name in settings and records -> how it is made."""


def source_title(name: str) -> str:
    """Name of a source for people."""
    return {
        "mouse": tr("mouse and keys"),
        "tablet": tr("pen tablet"),
        "gamepad": tr("gamepad"),
    }.get(name, name)


def source_help(name: str) -> str:
    """Say in one line how a source moves the hand."""
    return {
        "mouse": tr(
            "Drag: tilt  ·  wheel or Page keys: depth 1 mm  ·  arrows: 0.2°  ·  "
            "Shift: finer  ·  Home: hand to needle"
        ),
        "tablet": tr(
            "Hold the pen like the needle, its point on the pad: lean it to tilt  ·  press: "
            "push in, with the side button: pull  ·  wheel or Page keys: 1 mm"
        ),
        "gamepad": tr(
            "Left stick: tilt  ·  right stick away from you: push in, towards you: pull  ·  "
            "A: hand to needle"
        ),
    }.get(name, "")


def depth_help() -> str:
    """Say in one line what is left to move where a person holds a real robot's needle."""
    return tr(
        "You hold the needle. The simulated cameras cannot see how deep it is: say it by "
        "wheel or Page keys, 1 mm  ·  Shift: finer"
    )
