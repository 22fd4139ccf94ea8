"""How an expert would have led the needle along the plan of an attempt, to stand beside its replay.

It is the movement that an instructor chose to be shown in the exercise, else what the scripted
expert of *Show me* does, each along the attempt's own plan. It is nobody's attempt: nothing was
simulated for it, so that it tells of the way alone, not of forces.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.loading import ONE_AT_A_TIME
from app.session.curves import at_rest, curves
from app.session.machine import State
from app.session.motion import ShownMotion, motion
from app.session.needle import DepthSource
from app.session.review import Review
from app.session.samples import Samples

STEP_S: Final = 0.02
"""Time between two moments of it [s]."""

SEED: Final = 1
"""Of the expert's own small errors."""


def expert_beside(own: Review) -> Review | None:
    """Return an attempt's review with the expert's way in place of its own, without points.

    None where many targets are touched, or where nothing can be replayed.

    Raises:
        AcusError: if the plan cannot be followed by a script.
    """
    if own.touches or own.motion is None or own.conditions is None:
        return None
    with ONE_AT_A_TIME:  # compiled: for who looks at it
        from app.simulation.skills import EXPERT
        from app.simulation.trainee import directions, write_script
    placed, under = own.placed, own.conditions
    exercise = own.drill.of if own.drill is not None else under.exercise
    version = own.drill.version if own.drill is not None else under.version
    chosen = ShownMotion.kept(exercise, version)
    if chosen is not None:
        script = chosen.script(placed)
    else:
        script = write_script(placed.axis, placed.length, EXPERT, SEED)
    every = max(1, round(STEP_S / script.row))
    rows = script.rows[::every]
    time: FloatArray = np.arange(len(rows), dtype=np.float64) * (script.row * every)
    axis = directions(rows[:, 0], rows[:, 1], placed.axis, script.basis)
    samples = _samples(time, rows[:, 2], axis, placed.p_entry, placed.p_target)
    return replace(
        own,
        score=None,
        motion=motion(samples, placed, own.motion.length),
        curves=curves(samples, placed),
        tip=at_rest(samples, placed),
        origin=0.0,
        clock=None,
        measured_force=None,
    )


def _samples(
    time: FloatArray, depth: FloatArray, axis: FloatArray, entry: FloatArray, target: FloatArray
) -> Samples:
    """Return the samples of a needle through the entry that nothing pushes."""
    n = len(time)
    inside = depth > 0.0
    nothing = np.full((n, 3), np.nan)
    return Samples(
        time=read_only(time),
        state=np.where(inside, State.INSERTING.value, State.ALIGNING.value),
        valid=np.ones(n, dtype=np.bool_),
        depth_source=np.full(n, DepthSource.TRACKED.value),
        depth=read_only(depth),
        tip=read_only(entry + depth[:, None] * axis),
        axis=read_only(axis),
        target=read_only(np.tile(target, (n, 1))),
        hub=nothing,
        guide=nothing,
        felt=nothing,
        measured=np.full(n, np.nan),
    )
