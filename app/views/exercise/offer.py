"""Another way to watch an exercise, which a feature offers in the briefing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import Qt

from app.exercises.schema import Exercise
from app.views.kit.roles import STAFF, Role


@dataclass(frozen=True, slots=True, eq=False)
class BriefingOffer:
    """A button of the briefing.

    Attributes:
        name: of the offer.
        title: of the button, its key in it.
        tip: what comes of it.
        key: that presses it.
        suits: whether it is offered in an exercise.
        watch: begins it, as soon as patient and robot are there.
        roles: to whom it is offered.
    """

    name: str
    title: str
    tip: str
    key: Qt.Key
    suits: Callable[[Exercise], bool]
    watch: Callable[[], None]
    roles: frozenset[Role] = STAFF
