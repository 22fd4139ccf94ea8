"""Makes a drill of an exercise: patient, plan and help are kept, one metric counts."""

from __future__ import annotations

from collections.abc import Mapping

from app.exercises.drill import LONGEST_ID, DrillKind, DrillPart, asks
from app.exercises.guidance import Purpose
from app.exercises.hand_bands import HandBands, bands_among
from app.exercises.locks import HandName
from app.exercises.parts import OF_OWN_PLANS, PlanPoints
from app.exercises.schema import Exercise
from app.planning.placement import PlacedPlan
from app.scoring.defaults import DEFAULT_TOLERANCES
from app.scoring.rows import ScoreRules
from app.scoring.tolerance import Tolerance


def drilled(exercise: Exercise, kind: DrillKind, placed: PlacedPlan) -> Exercise:
    """Return an exercise as a drill on the plan of an attempt at it.

    Args:
        exercise: the whole one; a drill for the whole that it is of.
        kind: what is practised.
        placed: plan and placement of the attempt, which are those of the drill.
    """
    whole = exercise.drill or DrillPart(kind=kind, of=exercise.id, version=exercise.version)
    plan = placed.plan
    changes: dict[str, object] = {
        "id": f"drill-{kind}-{whole.of}"[:LONGEST_ID].rstrip("-"),
        "drill": whole.model_copy(update={"kind": kind}),
        "purpose": Purpose.PRACTICE,
        "fading": None,
        "plan": PlanPoints(
            entry_mm=tuple(plan.entry_mm.tolist()), target_mm=tuple(plan.target_mm.tolist())
        ),
        "description": asks(kind),
    }
    tolerances = {
        name: bands for name, bands in exercise.tolerances.items() if name not in OF_OWN_PLANS
    }  # the path is given: nobody plans
    if kind is not DrillKind.REPEAT:
        others = {
            name: bands.model_copy(update={"weight": 0.0, "required": False})
            for name, bands in tolerances.items()
        }  # shown, and the rings stay what they are
        tolerances = others | _judged(kind, exercise)
    if kind is DrillKind.ALIGN:  # nothing lies deeper than the skin, and hardly a picture of it
        changes["rules"] = ScoreRules(
            pass_mark=exercise.rules.pass_mark,
            minimum_tracking=0.0,
            maximum_pause=exercise.rules.maximum_pause,
        )
    changes |= {
        "tolerances": tolerances,
        "bands": bands_among(_bands(exercise, kind), tolerances),
    }
    return exercise.placed_as(placed.placement).model_copy(update=changes)


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


def _bands(exercise: Exercise, kind: DrillKind) -> Mapping[HandName, HandBands]:
    """Return the bands of hands; the angle at the skin has those of the angle where it has none."""
    if kind is not DrillKind.ALIGN or "angle_at_skin" in exercise.tolerances:
        return exercise.bands
    return {
        hand: own.model_copy(
            update={"metrics": {**own.metrics, "angle_at_skin": own.metrics["angle_error"]}}
        )
        if "angle_error" in own.metrics
        else own
        for hand, own in exercise.bands.items()
    }


def _alone(bands: Tolerance) -> Tolerance:
    return bands.model_copy(update={"weight": 1.0, "required": True})
