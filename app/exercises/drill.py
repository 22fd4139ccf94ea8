"""A drill: the same exercise, patient and plan, of which one part alone is practised and judged.

It is an exercise of its own, derived from the whole one when somebody wants it, and held by the
record of each attempt as every exercise is; so it is scored, replayed and compared like any other.
It is practice: it is in no library and no course, and no attempt at it counts for a person.
"""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated, Final

from pydantic import Field

from app.core.configuration import Strict
from app.core.messages import sentence

ROUNDS: Final = 10
ROUND_S: Final = 180.0
"""So often is repeated, and each round ends after so long at the latest [s]."""

THROUGH_S: Final = 0.2
"""Aligning alone ends so long after the tip has gone through the skin [s]."""

LONGEST_ID: Final = 64
"""Characters of an exercise's identifier."""


class DrillKind(StrEnum):
    """What is practised."""

    ALIGN = "align"
    """Aligning: it ends as the tip goes through the skin, and the tilt there is judged."""
    DEPTH = "depth"
    """The depth: it begins aligned, and the depth is judged."""
    BREATH = "breath"
    """Pushing within the gate of the breath: how far the target was off its place meanwhile."""
    REPEAT = "repeat"
    """The whole exercise, ten times three minutes."""


class DrillPart(Strict):
    """What an exercise is a drill of.

    Attributes:
        kind: what is practised.
        of: identifier of the whole exercise.
        version: of it.
    """

    kind: DrillKind
    of: Annotated[str, Field(min_length=1, max_length=LONGEST_ID)]
    version: Annotated[int, Field(ge=1)] = 1

    @property
    def begins_aligned(self) -> bool:
        """Return whether a simulated hand begins on the path, not off it."""
        return self.kind is DrillKind.DEPTH

    def is_over(self, in_body: bool, since: float, lasted: float) -> bool:
        """Return whether an attempt ends by itself now.

        Args:
            in_body: whether the needle is in the body.
            since: time in that state [s].
            lasted: time since the attempt began [s].
        """
        if self.kind is DrillKind.ALIGN:
            return in_body and since >= THROUGH_S
        return self.kind is DrillKind.REPEAT and lasted >= ROUND_S


def asks(kind: DrillKind, aligned: bool = False) -> str:
    """Say what a drill asks for, and when it ends.

    Args:
        kind: what is practised.
        aligned: whether a simulated hand leads the needle, which begins on the path where the drill
            has it so; whoever holds a needle aligns it himself.
    """
    depth = (
        sentence(
            "Depth only: you begin aligned; only the depth counts, and nothing may be met that the "
            "exercise forbids."
        )
        if aligned
        else sentence(
            "Depth only: only the depth counts, and nothing may be met that the exercise forbids."
        )
    )
    return {
        DrillKind.ALIGN: sentence(
            "Align only: it ends as the tip goes through the skin, and only the tilt there counts."
        ),
        DrillKind.DEPTH: depth,
        DrillKind.BREATH: sentence(
            "Breath only: push while the target is in its place, wait while it is not. Only that "
            "counts, and nothing may be met that the exercise forbids."
        ),
        DrillKind.REPEAT: sentence(
            "Ten times three minutes: the whole exercise; each round ends by itself after three "
            "minutes."
        ),
    }[kind]
