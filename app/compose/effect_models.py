"""Computing an effect by another of its models while the loop runs, live and in a replay."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Final, NamedTuple

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.parameters import Stage
from app.device.control import Table
from app.device.control.passivity import carry_accounts
from app.exercises.errors import ExerciseError
from app.exercises.schema import Exercise
from app.simulation.effects import declaration, effect_names, implementation

_GUARD: Final = "guard"

Carry = Callable[[FloatArray, FloatArray], None]


class Exchange(NamedTuple):
    """A table to go on with, and what has to be done between the two ticks."""

    table: Table
    carry: Callable[[], None]


def with_model(exercise: Exercise, effect: str, model: str) -> Exercise:
    """Return an exercise whose effect is computed by another of its models.

    Raises:
        ExerciseError: if the exercise does not ask for the effect (names those that it does), or
            it is one on pictures.
        SimulationError: for a model that the effect does not have.
    """
    if effect not in exercise.effects:
        raise ExerciseError(
            sentence(
                "exercise {exercise_id} has no effect {effect!r}; it has {exercise_effects}",
                exercise_id=exercise.id,
                effect=effect,
                exercise_effects=", ".join(exercise.effects) or "none",
            )
        )
    if declaration(effect).pictures:
        raise ExerciseError(
            sentence(
                "effect {effect} acts on the pictures of cameras that are running: choose its "
                "model in the exercise, before the attempt",
                effect=effect,
            )
        )
    part = exercise.effects[effect]
    chosen = part.model_copy(update={"model": declaration(effect).model(model)})
    return exercise.model_copy(update={"effects": {**exercise.effects, effect: chosen}})


def exchange(running: Table, fresh: Table, effect: str) -> Exchange:
    """Return how a loop goes on with a fresh table in which one effect is computed otherwise.

    All else keeps its memory. The effect gets what it can use of the old one's memory (a function
    `carry(old, new)` of its file), or begins anew; the passivity guard keeps its accounts under the
    new bound.
    """
    table, ended = running.continued(fresh, (effect, _GUARD))
    return Exchange(table, lambda: _carry(ended))


def _carry(ended: tuple[tuple[Stage, Stage], ...]) -> None:
    known: Mapping[str, Carry] = {_GUARD: carry_accounts}
    for old, new in ended:
        carry = known.get(old.name) or _of_effect(old.name)
        if carry is not None:
            carry(old.parameters, new.parameters)


def _of_effect(name: str) -> Carry | None:
    if name not in effect_names():
        return None
    return getattr(implementation(name), "carry", None)
