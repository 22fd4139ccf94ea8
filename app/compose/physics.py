"""Whether an exercise simulates what its patient calls for, and what to add where it does not."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import yaml

from app.compose.declared_views import declared_views
from app.compose.exercise_field import ExercisePatient
from app.core.progress import Progress
from app.exercises.called_for import Call, additions, called_for
from app.exercises.parts import EffectPart, TissueSource
from app.exercises.scene import compile_exercise
from app.simulation.plan import TISSUE_FIELD

if TYPE_CHECKING:
    from app.exercises.schema import Exercise
    from app.imaging.field import TissueField


def calls_of(
    exercise: Exercise, progress: Progress | None = None, patient: ExercisePatient | None = None
) -> tuple[tuple[Call, ...], TissueField | None]:
    """Return what an exercise's patient calls for, and his field; see `exercises.called_for`.

    Nothing is compiled; the field is made where it is not in the cache, in up to ten seconds.
    Present is what the simulated device simulates, which has all ports.

    Args:
        exercise: the exercise.
        progress: of reading and making.
        patient: of the exercise, where he has been looked at already.

    Raises:
        AcusError: if device, CT or plan cannot be used, or `without` names what is not called for.
        Cancelled: if `progress` was cancelled.
    """
    patient = patient or ExercisePatient(exercise, progress)
    if exercise.touch is not None:
        return called_for(exercise, None, ()), None
    needles = patient.needles
    resolved, bound, _ = patient.within(exercise)
    plan = compile_exercise(resolved, patient.profile, declared_views(), bound=bound)
    present = tuple(effect.name for effect in plan.kept)
    return called_for(exercise, needles, present), patient.field


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
