"""The scripted trainee of an exercise: what it does follows from what is to be done there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.core.arrays import read_only
from app.core.parameters import Stage
from app.core.units import MILLIMETRE
from app.exercises.ablation import AblationPart, electrode_plans
from app.exercises.procedure import ProcedurePart
from app.exercises.schema import Exercise
from app.imaging.field import TissueField
from app.planning.membrane import membrane_on
from app.planning.placement import PlacedPlan
from app.session.scripted_steps import sampling_time
from app.simulation.electrode_script import one_after_another
from app.simulation.hands import HANDS, SUFFIX, write_hand_script
from app.simulation.procedure_script import StopPhase, Stops, with_stops, withdrawn
from app.simulation.skills import find_skill
from app.simulation.touching import write_touch_script
from app.simulation.trainee import script_stage, trainee_stage, write_script


def trainee_of(
    exercise: Exercise,
    placed: PlacedPlan,
    skill: str,
    seed: int,
    tissues: TissueField | None = None,
) -> Stage:
    """Build the stage of a trainee who inserts a needle along the path, or touches the targets.

    Args:
        exercise: what is to be done.
        placed: its plan.
        skill: a name of `simulation.skills.SKILLS` for a quick script, one of
            `simulation.hands.HANDS` for a hand as people have it; at a tool through a trocar both
            are the same, whose times are those of people there.
        seed: another seed is another attempt of the same skill.
        tissues: field of the patient, by which one knows where pleura or capsule lie.

    Raises:
        AcusError: for an unknown skill, or targets that no tip can touch.
    """
    if exercise.procedure is not None and exercise.procedure.ablation is not None:
        return _with_electrodes(exercise, exercise.procedure.ablation, placed, skill, seed)
    task = exercise.touch_task(placed)
    holds = exercise.holds_breath
    depth, stops = placed.length, None
    if exercise.procedure is not None:
        depth, stops = _stops(exercise.procedure, placed, tissues)
    if task is None and skill in HANDS:
        script = write_hand_script(placed.axis, depth, HANDS[skill], seed, holds)
        script = script if stops is None else with_stops(script, stops)
        return script_stage(script, placed.axis, holds_at=placed.length if holds else None)
    if task is None and stops is not None:
        script = with_stops(write_script(placed.axis, depth, find_skill(skill), seed), stops)
        return script_stage(script, placed.axis, holds_at=placed.length if holds else None)
    if task is None:
        return trainee_stage(placed.axis, placed.length, skill, seed, holds=holds)
    ways = task.p_targets - placed.p_entry
    touching = skill.removesuffix(SUFFIX) if skill in HANDS else skill
    script = write_touch_script(placed.axis, ways, task.radius, task.dwell, touching, seed)
    return script_stage(script, placed.axis)


def _with_electrodes(
    exercise: Exercise, part: AblationPart, placed: PlacedPlan, skill: str, seed: int
) -> Stage:
    """Build the stage of a trainee who leaves electrodes in place, one after another."""
    plans, holds = electrode_plans(part, placed), exercise.holds_breath
    scripts = [
        write_hand_script(placed.axis, plan.length, HANDS[skill], seed + 1000 * k, holds)
        if skill in HANDS
        else write_script(placed.axis, plan.length, find_skill(skill), seed + 1000 * k)
        for k, plan in enumerate(plans)
    ]
    axes = np.array([plan.axis for plan in plans])
    script = one_after_another(scripts, axes, placed.axis)
    asked = exercise.procedure
    if asked is not None and asked.rollover is not None:
        rows = withdrawn(script.rows, TURNING, script.row, StopPhase.TURN)
        script = replace(script, rows=read_only(rows))
    return script_stage(script, placed.axis, holds_at=placed.length if holds else None)


TURNING = 4.0
"""A script stays so long with the needle out, until the patient is turned [s]."""

SHORT_OF = 1.5 * MILLIMETRE
"""Local anaesthetic is given so far before the membrane, and the way in paused twice so far."""


def _stops(
    part: ProcedurePart, placed: PlacedPlan, tissues: TissueField | None
) -> tuple[float, Stops]:
    """Return how deep a trainee brings the needle of an exercise with steps [m], and the stops."""
    depth = placed.length
    if part.biopsy is not None:  # the notch's middle shall lie at the target
        begin, end = part.biopsy.throw(0).notch_span_mm
        depth -= 0.5 * (begin + end) * MILLIMETRE
    plan, wall = placed.plan, None
    if tissues is not None:
        way = (plan.target_mm - plan.entry_mm) / plan.length_mm
        membrane = membrane_on(tissues, plan.entry_mm, way, plan.target_mm)
        wall = None if membrane is None else membrane.depth_mm * MILLIMETRE
    return depth, Stops(
        anaesthetic=None if wall is None or part.anaesthetic is None else wall - SHORT_OF,
        before=None if wall is None else wall - 2.0 * SHORT_OF,
        sampling=sampling_time(part),
        turning=0.0 if part.rollover is None else TURNING,
    )
