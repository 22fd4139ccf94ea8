"""The compiled part of the simulated robot; see `plant` for the equations and what they promise."""

from typing import Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.mechanisms.dynamic_model import FX, FY, FZ
from app.mechanisms.pantograph.kernels import axis_kernel, hub_velocity_kernel
from app.simulation.hand_motion import advance, grip_direction, take_hold, turn, wanted
from app.simulation.plant_hand import axial_spring, spring
from app.simulation.plant_layout import AT, MOTION, SHORTEST_LEVER, Pose
from app.simulation.plant_motion import pose_of, slide, swing

SUBSTEP: Final = 0.5e-3  # [s]
LONGEST_STEP: Final = 5e-3  # [s] as the loop clamps it
_TORQUE: Final = 5.0  # [N·m] far beyond any motor of this size
_AXIAL: Final = 50.0  # [N]


@njit
def _bounded(value: float, limit: float) -> float:
    """Return `value` within ±limit; NaN counts as zero."""
    return 0.0 if np.isnan(value) else min(max(value, -limit), limit)


@njit
def _recover(state: FloatArray, p: FloatArray) -> Pose:
    """Go back to the starting pose, at rest, if the pose is none the mechanism can have.

    Returns the pose.
    """
    q1, q2 = state[sv.PLANT_Q_LEFT], state[sv.PLANT_Q_RIGHT]
    v1, v2 = state[sv.PLANT_QD_LEFT], state[sv.PLANT_QD_RIGHT]
    pose = pose_of(p, q1, q2)
    if not (np.isfinite(q1 + q2 + v1 + v2) and pose[0]):
        state[sv.PLANT_Q_LEFT], state[sv.PLANT_Q_RIGHT] = p[AT.start_left], p[AT.start_right]
        state[sv.PLANT_QD_LEFT] = state[sv.PLANT_QD_RIGHT] = 0.0
        pose = pose_of(p, p[AT.start_left], p[AT.start_right])
    if not np.isfinite(state[sv.PLANT_DEPTH] + state[sv.PLANT_DEPTH_RATE]):
        state[sv.PLANT_DEPTH], state[sv.PLANT_DEPTH_RATE] = p[AT.start_depth], 0.0
    return pose


@njit
def _report(state: FloatArray, p: FloatArray, holds: bool, pose: Pose) -> None:
    """Write the force of the hand across (PULL_*) and along (PUSH) the needle."""
    state[sv.PULL_X] = state[sv.PULL_Y] = state[sv.PULL_Z] = state[sv.PUSH] = 0.0
    ok, x, y, jxl, jxr, jyl, jyr = pose
    if not (holds and ok):
        return
    v1, v2 = state[sv.PLANT_QD_LEFT], state[sv.PLANT_QD_RIGHT]
    dx, dy, dz, l_in = axis_kernel(x, y, p[FX], p[FY], p[FZ])
    l_out = max(p[AT.length] - state[sv.PLANT_DEPTH], SHORTEST_LEVER)
    gx, gy, gz = grip_direction(state)
    _, fx, fy, fz = spring(p, gx, gy, gz, dx, dy, dz, l_out)
    ux, uy, uz = hub_velocity_kernel(
        jxl * v1 + jxr * v2, jyl * v1 + jyr * v2, dx, dy, dz, l_in, l_out
    )
    state[sv.PULL_X] = fx - p[AT.hand_b] * ux
    state[sv.PULL_Y] = fy - p[AT.hand_b] * uy
    state[sv.PULL_Z] = fz - p[AT.hand_b] * uz
    state[sv.PUSH] = axial_spring(state, p)[1] - p[AT.hand_axial_b] * state[sv.PLANT_DEPTH_RATE]


@njit
def _move_hand(state: FloatArray, p: FloatArray, dt: float, pose: Pose) -> bool:
    """Move GRIP_* towards HAND_*; returns whether the hand holds."""
    holds, wx, wy, wz = wanted(state)
    ok, x, y, _, _, _, _ = pose
    dx, dy, _, _ = axis_kernel(x, y, p[FX], p[FY], p[FZ])
    if not ok:
        dx, dy = 0.0, 0.0
    if take_hold(state, p, MOTION, holds, dx, dy, state[sv.PLANT_DEPTH]) and dt > 0.0:
        lever = max(p[AT.length] - state[sv.PLANT_DEPTH], SHORTEST_LEVER)
        turn(state, p, MOTION, dt, wx, wy, wz, lever)
        advance(state, p, MOTION, dt)
    return holds


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Move hand, robot and needle by DT (at most 5 ms) and write the forces of the hand."""
    pose = _recover(state, parameters)
    dt = min(state[sv.DT], LONGEST_STEP) if state[sv.DT] > 0.0 else 0.0  # not for NaN
    holds = _move_hand(state, parameters, dt, pose)
    if dt > 0.0:
        gx, gy, gz = grip_direction(state)
        substeps = int(np.ceil(dt / SUBSTEP - 1e-9))
        h = dt / max(substeps, 1)
        t1 = _bounded(state[sv.TORQUE_LEFT], _TORQUE)
        t2 = _bounded(state[sv.TORQUE_RIGHT], _TORQUE)
        tissue = _bounded(state[sv.AXIAL_FORCE], _AXIAL)
        for _ in range(substeps):
            slide(state, parameters, h, tissue, holds, pose)
            pose = swing(state, parameters, h, t1, t2, holds, gx, gy, gz, pose)
    _report(state, parameters, holds, pose)
