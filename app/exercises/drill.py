"""A drill: the same exercise, patient and plan, of which one part alone is practised and judged.

It is an exercise of its own, derived from the whole one when somebody wants it, and held by the
record of each attempt as every exercise is; so it is scored, replayed and compared like any other.
It is practice: it is in no library and no course, and no attempt at it counts for a person.
"""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated, Final

from pydantic import Field

from app.core.configuration import Strict
from app.core.messages import sentence
from app.exercises.parts import PlanPoints
from app.planning.placement import PlacedPlan
from app.scoring.defaults import DEFAULT_TOLERANCES
from app.scoring.rows import ScoreRules
from app.scoring.tolerance import Tolerance

if TYPE_CHECKING:
    from app.exercises.schema import Exercise

ROUNDS: Final = 10
ROUND_S: Final = 180.0
"""So often is repeated, and each round ends after so long at the latest [s]."""

THROUGH_S: Final = 0.2
"""Aligning alone ends so long after the tip has gone through the skin [s]."""

_LONGEST_ID: Final = 64


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
    of: Annotated[str, Field(min_length=1, max_length=_LONGEST_ID)]
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


def drilled(exercise: Exercise, kind: DrillKind, placed: PlacedPlan) -> Exercise:
    """Return an exercise as a drill on the plan of an attempt at it.

    Args:
        exercise: the whole one; a drill for the whole that it is of.
        kind: what is practised.
        placed: plan and placement of the attempt, which are those of the drill.
    """
    from app.exercises.guidance import Purpose

    whole = exercise.drill or DrillPart(kind=kind, of=exercise.id, version=exercise.version)
    plan = placed.plan
    changes: dict[str, object] = {
        "id": f"drill-{kind}-{whole.of}"[:_LONGEST_ID].rstrip("-"),
        "drill": whole.model_copy(update={"kind": kind}),
        "purpose": Purpose.PRACTICE,
        "fading": None,
        "plan": PlanPoints(
            entry_mm=tuple(plan.entry_mm.tolist()), target_mm=tuple(plan.target_mm.tolist())
        ),
        "description": asks(kind),
    }
    if kind is not DrillKind.REPEAT:
        others = {
            name: bands.model_copy(update={"weight": 0.0, "required": False})
            for name, bands in exercise.tolerances.items()
        }  # shown, and the rings stay what they are
        changes["tolerances"] = others | _judged(kind, exercise)
    if kind is DrillKind.ALIGN:  # nothing lies deeper than the skin, and hardly a picture of it
        changes["rules"] = ScoreRules(
            pass_mark=exercise.rules.pass_mark,
            minimum_tracking=0.0,
            maximum_pause=exercise.rules.maximum_pause,
        )
    return exercise.placed_as(placed.placement).model_copy(update=changes)


def asks(kind: DrillKind) -> str:
    """Say what a drill asks for, and when it ends."""
    return {
        DrillKind.ALIGN: sentence(
            "Align only: it ends as the tip goes through the skin, and only the tilt there counts."
        ),
        DrillKind.DEPTH: sentence("Depth only: you begin aligned, and only the depth counts."),
        DrillKind.BREATH: sentence(
            "Breath only: push while the target is in its place, wait while it is not; nothing "
            "else counts."
        ),
        DrillKind.REPEAT: sentence(
            "Ten times three minutes: the whole exercise; each round ends by itself after three "
            "minutes."
        ),
    }[kind]


def _judged(kind: DrillKind, exercise: Exercise) -> dict[str, Tolerance]:
    """Return the one metric that counts in a drill, by the exercise's own bands if it has them."""
    known = exercise.tolerances
    if kind is DrillKind.DEPTH:
        bands = known.get("depth_error", DEFAULT_TOLERANCES["depth_error"])
        return {"depth_error": _alone(bands)}
    if kind is DrillKind.ALIGN:
        default = known.get("angle_error", DEFAULT_TOLERANCES["angle_error"])
        return {"angle_at_skin": _alone(known.get("angle_at_skin", default))}
    gate = known.get("lateral_error", DEFAULT_TOLERANCES["lateral_error"]).expert
    limits = {"expert": 0.5 * gate, "good": gate, "pass": 1.5 * gate}
    return {"breath_offset": _alone(Tolerance.model_validate(limits))}


def _alone(bands: Tolerance) -> Tolerance:
    return bands.model_copy(update={"weight": 1.0, "required": True})
