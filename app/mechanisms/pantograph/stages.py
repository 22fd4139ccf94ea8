"""The pantograph in the loop: its own stages of a tick, and how the simulated one moves."""

from typing import Final, NamedTuple

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import numbered
from app.mechanisms.direct_drive import direct_drive, nothing_behind
from app.mechanisms.dynamic_model import A1, A2, BASE
from app.mechanisms.needle_motion import OWN, SUBSTEP, Pose, move_needle
from app.mechanisms.pantograph.differential import jacobian_rate_kernel
from app.mechanisms.pantograph.dynamics import (
    dynamics_kernel,
    links_potential_kernel,
    mass_matrix_kernel,
)
from app.mechanisms.pantograph.kernels import forward_kernel, jacobian_kernel
from app.mechanisms.status import OK


class PosePlaces(NamedTuple):
    """Lengths [m], and inertias of the links [kg·m²] and the tool [kg]."""

    a1: int
    a2: int
    base: int
    driven: int
    passive: int
    coupling: int
    tool: int


AT: Final = numbered(PosePlaces)


@stage
def pose_stage(state: FloatArray, p: FloatArray) -> None:
    """Write KINEMATICS, and where the pose exists P3_*, J_* and INERTIA_*, from Q_*."""
    q1, q2 = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    a1, a2, base = p[AT.a1], p[AT.a2], p[AT.base]
    status, x, y = forward_kernel(q1, q2, a1, a2, base, 1.0)
    jxl = jxr = jyl = jyr = 0.0
    if status == OK:
        status, jxl, jxr, jyl, jyr = jacobian_kernel(q1, q2, x, y, a1, a2, base)
    state[sv.KINEMATICS] = status
    if status == OK:
        state[sv.P3_X], state[sv.P3_Y] = x, y
        state[sv.J_XL], state[sv.J_XR], state[sv.J_YL], state[sv.J_YR] = jxl, jxr, jyl, jyr
        left, cross, right = mass_matrix_kernel(
            q1,
            q2,
            x,
            y,
            a1,
            a2,
            base,
            p[AT.driven],
            p[AT.passive],
            p[AT.coupling],
            p[AT.tool],
        )
        state[sv.INERTIA_LEFT] = left
        state[sv.INERTIA_CROSS] = cross
        state[sv.INERTIA_RIGHT] = right


@stage
def dynamics_stage(state: FloatArray, p: FloatArray) -> None:
    """Write MASS_*, BIAS_*, DRIFT_*, WEIGHT_* and LINKS_POTENTIAL where the pose exists."""
    if state[sv.KINEMATICS] != OK:
        return
    q1, q2, v1, v2 = state[sv.Q_LEFT], state[sv.Q_RIGHT], state[sv.QD_LEFT], state[sv.QD_RIGHT]
    x, y, depth = state[sv.P3_X], state[sv.P3_Y], state[sv.DEPTH]
    left, cross, right, h1, h2, g1, g2 = dynamics_kernel(q1, q2, v1, v2, x, y, depth, 0.0, p, 0)
    state[sv.MASS_LEFT], state[sv.MASS_CROSS], state[sv.MASS_RIGHT] = left, cross, right
    state[sv.BIAS_LEFT], state[sv.BIAS_RIGHT] = h1, h2
    state[sv.WEIGHT_LEFT], state[sv.WEIGHT_RIGHT] = g1, g2
    _, rxl, rxr, ryl, ryr = jacobian_rate_kernel(q1, q2, v1, v2, x, y, p[A1], p[A2], p[BASE])
    state[sv.DRIFT_X], state[sv.DRIFT_Y] = rxl * v1 + rxr * v2, ryl * v1 + ryr * v2
    state[sv.LINKS_POTENTIAL] = links_potential_kernel(q1, q2, x, y, p, 0)


@njit
def pose_of(p: FloatArray, q1: float, q2: float) -> Pose:
    """Tool point and Jacobian: (ok, x, y, jxl, jxr, jyl, jyr)."""
    a1, a2, base = p[OWN + A1], p[OWN + A2], p[OWN + BASE]
    status, x, y = forward_kernel(q1, q2, a1, a2, base, 1.0)
    if status != 0:
        return False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    status, jxl, jxr, jyl, jyr = jacobian_kernel(q1, q2, x, y, a1, a2, base)
    return status == 0, x, y, jxl, jxr, jyl, jyr


@njit
def _terms(
    state: FloatArray, p: FloatArray, pose: Pose
) -> tuple[float, float, float, float, float, float, float]:
    return dynamics_kernel(
        state[sv.PLANT_Q_LEFT],
        state[sv.PLANT_Q_RIGHT],
        state[sv.PLANT_QD_LEFT],
        state[sv.PLANT_QD_RIGHT],
        pose[1],
        pose[2],
        state[sv.PLANT_DEPTH],
        state[sv.PLANT_DEPTH_RATE],
        p,
        OWN,
    )


@njit
def move(state: FloatArray, p: FloatArray, substep: float) -> None:
    """Do what `plant_stage` does, in substeps of at most `substep` [s]."""
    move_needle(state, p, substep, pose_of, _terms, direct_drive, nothing_behind)


@stage
def plant_stage(state: FloatArray, p: FloatArray) -> None:
    """Move hand, robot and needle by DT (at most 5 ms) and write the forces of the hand."""
    move(state, p, SUBSTEP)
