"""The scripted trainee of an exercise: what it does follows from what is to be done there."""

from __future__ import annotations

from app.core.parameters import Stage
from app.exercises.schema import Exercise
from app.planning.placement import PlacedPlan
from app.simulation.hands import HANDS, SUFFIX, write_hand_script
from app.simulation.touching import write_touch_script
from app.simulation.trainee import script_stage, trainee_stage


def trainee_of(exercise: Exercise, placed: PlacedPlan, skill: str, seed: int) -> Stage:
    """Build the stage of a trainee who inserts a needle along the path, or touches the targets.

    Args:
        exercise: what is to be done.
        placed: its plan.
        skill: a name of `simulation.skills.SKILLS` for a quick script, one of
            `simulation.hands.HANDS` for a hand as people have it; at a tool through a trocar both
            are the same, whose times are those of people there.
        seed: another seed is another attempt of the same skill.

    Raises:
        AcusError: for an unknown skill, or targets that no tip can touch.
    """
    task = exercise.touch_task(placed)
    holds = exercise.holds_breath
    if task is None and skill in HANDS:
        script = write_hand_script(placed.axis, placed.length, HANDS[skill], seed, holds)
        return script_stage(script, placed.axis, holds_at=placed.length if holds else None)
    if task is None:
        return trainee_stage(placed.axis, placed.length, skill, seed, holds=holds)
    ways = task.p_targets - placed.p_entry
    touching = skill.removesuffix(SUFFIX) if skill in HANDS else skill
    script = write_touch_script(placed.axis, ways, task.radius, task.dwell, touching, seed)
    return script_stage(script, placed.axis)
