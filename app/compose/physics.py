"""Whether an exercise simulates what its patient calls for, and what to add where it does not."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import yaml

from app.compose.declared_views import declared_views
from app.core.progress import Progress
from app.exercises.called_for import Call, additions, called_for
from app.exercises.parts import EffectPart, OwnPlan, TissueSource
from app.exercises.scene import compile_exercise, device_of, draft_of, placed_plan_of, plan_of
from app.planning.plan import Plan
from app.simulation.plan import TISSUE_FIELD

if TYPE_CHECKING:
    from app.exercises.schema import Exercise
    from app.imaging.field import TissueField
    from app.planning.placement import PlacedPlan


def calls_of(
    exercise: Exercise, progress: Progress | None = None
) -> tuple[tuple[Call, ...], TissueField | None]:
    """Return what an exercise's patient calls for, and his field; see `exercises.called_for`.

    Nothing is compiled; the field is made where it is not in the cache, in up to ten seconds.

    Raises:
        AcusError: if device, CT or plan cannot be used, or `without` names what is not called for.
        Cancelled: if `progress` was cancelled.
    """
    from app.compose.exercise_ct import load_field, read_ct

    progress = progress or Progress()
    profile = device_of(exercise)
    placed = placed_plan_of(exercise, profile, _plan(exercise))
    if exercise.touch is not None:
        return called_for(exercise, placed, profile, None, ()), None
    volume = read_ct(exercise, progress.part(0.0, 0.4))
    field = load_field(exercise, volume, placed.plan, progress.part(0.4, 1.0))
    simulated = _simulated(exercise, placed, field)
    return called_for(exercise, placed, profile, field, simulated), field


def _plan(exercise: Exercise) -> Plan:
    """Return its plan; where the student chooses the entry, one of any entry to its target."""
    if not isinstance(exercise.plan, OwnPlan):
        return plan_of(exercise)
    target = np.array(draft_of(exercise).target_mm)
    return Plan(target - (0.0, 100.0, 0.0), target, exercise.id)


def _simulated(
    exercise: Exercise, placed: PlacedPlan, field: TissueField | None
) -> tuple[str, ...]:
    """Names of what is simulated on the simulated device, which has all ports."""
    from app.compose.exercise_field import resolve_tissue
    from app.simulation.bound_field import BoundField

    bound = None
    if exercise.tissue is not TissueSource.LAYERS and field is not None:
        exercise, _ = resolve_tissue(exercise, placed, field)
        if exercise.tissue is TissueSource.FIELD:
            bound = BoundField(field, placed.T_world_patient, placed.p_target)
    plan = compile_exercise(exercise, device_of(exercise), declared_views(), bound=bound)
    return tuple(effect.name for effect in plan.kept)


def completed(exercise: Exercise, calls: Sequence[Call]) -> Exercise:
    """Return an exercise that has all that is absent."""
    more = additions(calls, exercise)
    effects = {name: EffectPart(**part) for name, part in more.get("effects", {}).items()}
    changes: dict[str, Any] = {"effects": {**exercise.effects, **effects}}
    if TISSUE_FIELD in {call.effect for call in calls if call.is_absent}:
        changes["tissue"] = TissueSource.FIELD
    return exercise.model_copy(update=changes)


def suggested_lines(more: dict[str, Any]) -> list[str]:
    """Return lines of YAML to add to an exercise's file."""
    if not more:
        return []
    text = yaml.safe_dump(more, sort_keys=False, allow_unicode=True, default_flow_style=None)
    return text.rstrip().splitlines()
