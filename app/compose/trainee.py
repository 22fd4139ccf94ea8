"""The scripted trainee of an exercise: what it does follows from what is to be done there."""

from __future__ import annotations

from app.core.parameters import Stage
from app.exercises.schema import Exercise
from app.planning.placement import PlacedPlan
from app.simulation.touching import write_touch_script
from app.simulation.trainee import script_stage, trainee_stage


def trainee_of(exercise: Exercise, placed: PlacedPlan, skill: str, seed: int) -> Stage:
    """Build the stage of a trainee who inserts a needle along the path, or touches the targets.

    Args:
        exercise: what is to be done.
        placed: its plan.
        skill: a name of `simulation.skills.SKILLS`.
        seed: another seed is another attempt of the same skill.

    Raises:
        AcusError: for an unknown skill, or targets that no tip can touch.
    """
    task = exercise.touch_task(placed)
    if task is None:
        return trainee_stage(placed.axis, placed.length, skill, seed, holds=exercise.holds_breath)
    ways = task.p_targets - placed.p_entry
    script = write_touch_script(placed.axis, ways, task.radius, task.dwell, skill, seed)
    return script_stage(script, placed.axis)
