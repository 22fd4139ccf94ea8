"""Which controls an exercise keeps from the student, and the hand that it is done with."""

from enum import StrEnum


class Lock(StrEnum):
    """A control that an exercise can lock: it then stays as the exercise has it."""

    ASSISTANCE = "assistance"
    """The dial."""
    VIEWS = "views"
    """What is shown."""
    READING = "reading"
    """Window, level, slab and layout."""
    HAND = "hand"
    """What moves the simulated hand, and how far."""
    MODELS = "models"
    """By which model each effect is computed."""


EVERY_LOCK = frozenset(Lock)
"""What an assessment locks."""


class HandName(StrEnum):
    """What can move the simulated hand."""

    MOUSE = "mouse"
    TABLET = "tablet"
    GAMEPAD = "gamepad"
