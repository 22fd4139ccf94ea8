"""What held the needle in an attempt; it stands in every record."""

from collections.abc import Mapping
from typing import Final

from app.session.errors import SessionError

TRAINEE: Final = "trainee"
"""Name of the metadata record; its key `hand` holds one of `HANDS`."""

HANDS: Final = ("mouse", "keyboard", "tablet", "gamepad", "robot", "pen", "script")
"""Sources of the hand: `robot` is a real hand at a real robot, `pen` one that holds a pen with
printed markers, `script` the scripted trainee."""


def hand_of(trainee: Mapping[str, str], asked: str = "") -> str:
    """Return the hand of an attempt.

    A run that was built for one hand (a scripted trainee, a real robot, a pen) keeps it whatever is
    asked for; without a word it is the mouse.

    Args:
        trainee: metadata record of the run: `scripted` not empty, or `hand`, says the one hand.
        asked: what the window says.

    Raises:
        SessionError: for another name; gives the valid ones.
    """
    if trainee.get("scripted"):
        return "script"
    hand = trainee.get("hand") or asked or "mouse"
    if hand not in HANDS:
        raise SessionError(f"hand {hand!r} is not known; valid names: {', '.join(HANDS)}")
    return hand
