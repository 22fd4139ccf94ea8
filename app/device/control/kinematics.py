"""From joint angles to the needle: tool point, Jacobian, direction, depth, hub and tip."""

from dataclasses import dataclass
from math import atan2, isfinite
from typing import Any

import numpy as np

from app.core import staleness
from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.device.control.vectors import norm_kernel, unit_kernel
from app.mechanisms.geometry import Geometry
from app.mechanisms.pantograph.kernels import (
    axis_kernel,
    forward_kernel,
    hub_velocity_kernel,
    jacobian_kernel,
)
from app.mechanisms.pantograph.status import OK
from app.mechanisms.profile import DeviceProfile

(
    _A1,
    _A2,
    _BASE,
    _FX,
    _FY,
    _FZ,
    _LENGTH,
    _FRESH,
    _HOLD,
    _BLEND,
    _L_OUT_MIN,
    _STARTED,
    _WEIGHT,
    _HELD,
    _SIZE,
) = range(15)

MODEL, TRACKED, HELD = 0, 1, 2
"""Values of the slot `DEPTH_SOURCE`."""


@njit
def _clear_forces(state: FloatArray) -> None:
    for slot in range(sv.FORCE_X, sv.AXIAL_FORCE + 1):  # POTENTIAL and JOINT_* lie between them
        state[slot] = 0.0


@njit
def _length_outside(state: FloatArray, p: FloatArray, l_in: float) -> float:
    # L_out: measured while the cameras' fix is younger than _HOLD, else C - L_in. The weight of the
    # measurement moves over _BLEND seconds, so that losing the marker does not make the lever jump.
    # A stamp in the future is as wrong as an old one: it must not stay fresh until its time comes.
    age = abs(state[sv.TIME] - state[sv.TRACKED_TIME])
    depth = state[sv.TRACKED_DEPTH]
    source = MODEL
    if state[sv.TRACKED_TIME] != 0.0 and isfinite(depth) and age < p[_HOLD]:
        source = TRACKED if age < p[_FRESH] else HELD
        p[_HELD] = depth
    goal = 0.0 if source == MODEL else 1.0
    step = state[sv.DT] / p[_BLEND] if p[_STARTED] != 0.0 else 1.0
    weight = p[_WEIGHT]
    weight += min(max(goal - weight, -step), step)
    p[_WEIGHT] = weight
    p[_STARTED] = 1.0
    model = p[_LENGTH] - l_in
    l_out = model + weight * (p[_LENGTH] - p[_HELD] - model)
    state[sv.DEPTH_SOURCE] = source
    return max(l_out, p[_L_OUT_MIN])


@njit
def _place_needle(state: FloatArray, p: FloatArray, x: float, y: float) -> None:
    fx, fy, fz = p[_FX], p[_FY], p[_FZ]
    dx, dy, dz, l_in = axis_kernel(x, y, fx, fy, fz)
    l_out = _length_outside(state, p, l_in)
    depth = p[_LENGTH] - l_out
    state[sv.P3_X], state[sv.P3_Y] = x, y
    state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z] = dx, dy, dz
    state[sv.L_IN], state[sv.L_OUT], state[sv.DEPTH] = l_in, l_out, depth
    state[sv.HUB_X] = fx - l_out * dx
    state[sv.HUB_Y] = fy - l_out * dy
    state[sv.HUB_Z] = fz - l_out * dz
    state[sv.TIP_X] = fx + depth * dx
    state[sv.TIP_Y] = fy + depth * dy
    state[sv.TIP_Z] = fz + depth * dz


@njit
def _set_velocities(state: FloatArray, vx: float, vy: float) -> None:
    dx, dy, dz = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    wx, wy, wz = hub_velocity_kernel(vx, vy, dx, dy, dz, state[sv.L_IN], state[sv.L_OUT])
    state[sv.P3_VX], state[sv.P3_VY] = vx, vy
    state[sv.HUB_VX], state[sv.HUB_VY], state[sv.HUB_VZ] = wx, wy, wz


@njit
def angle_error_kernel(dx: float, dy: float, dz: float, px: float, py: float, pz: float) -> float:
    """Angle between the needle and a path [rad] by atan2, exact near 0 and π; 0 without a path."""
    px, py, pz = unit_kernel(px, py, pz)
    cx, cy, cz = py * dz - pz * dy, pz * dx - px * dz, px * dy - py * dx
    return atan2(norm_kernel(cx, cy, cz), px * dx + py * dy + pz * dz)


@stage
def kinematics_stage(state: FloatArray, p: FloatArray) -> None:
    """Place the needle and clear the force accumulators.

    Where the pose does not exist the status says so, velocities are zero and the last valid pose
    stays: nothing downstream ever sees a NaN.
    """
    _clear_forces(state)
    q1, q2 = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    a1, a2, base = p[_A1], p[_A2], p[_BASE]
    status, x, y = forward_kernel(q1, q2, a1, a2, base, 1.0)
    jxl = jxr = jyl = jyr = 0.0
    if status == OK:
        status, jxl, jxr, jyl, jyr = jacobian_kernel(q1, q2, x, y, a1, a2, base)
    state[sv.KINEMATICS] = status
    if status == OK:
        state[sv.J_XL], state[sv.J_XR], state[sv.J_YL], state[sv.J_YR] = jxl, jxr, jyl, jyr
        _place_needle(state, p, x, y)
        v1, v2 = state[sv.QD_LEFT], state[sv.QD_RIGHT]
        _set_velocities(state, jxl * v1 + jxr * v2, jyl * v1 + jyr * v2)
    else:
        if state[sv.L_IN] == 0.0:  # no valid pose yet: a vertical needle
            _place_needle(state, p, p[_FX], p[_FY])
        _set_velocities(state, 0.0, 0.0)
    state[sv.ANGLE_ERROR] = angle_error_kernel(
        state[sv.AXIS_X],
        state[sv.AXIS_Y],
        state[sv.AXIS_Z],
        state[sv.PATH_X],
        state[sv.PATH_Y],
        state[sv.PATH_Z],
    )


@dataclass(frozen=True, slots=True)
class Kinematics:
    """Kinematics of a needle pantograph whose depth the cameras measure.

    Attributes:
        geometry: lengths of the mechanism.
        fresh: age up to which a fix counts as tracked [s].
        hold: age up to which the last fix is held [s]; beyond, L_out = C - L_in.
        blend: time over which the lever changes between the two [s].
        l_out_min: smallest L_out [m], so that the lever stays defined.
    """

    geometry: Geometry
    fresh: float = staleness.TRACKER_FRESH
    hold: float = staleness.TRACKER_HOLD
    blend: float = 0.1
    l_out_min: float = 0.005

    @classmethod
    def of(cls, profile: DeviceProfile) -> "Kinematics":
        """Kinematics of a device profile."""
        return cls(profile.pantograph)

    def stage(self) -> tuple[str, Any, FloatArray]:
        """Return the stage for a loop's table, with memory of its own."""
        parameters = np.zeros(_SIZE)
        parameters[:_LENGTH] = (*self.geometry.links, *self.geometry.fulcrum_xyz)
        parameters[_LENGTH:_STARTED] = (
            self.geometry.needle_length,
            self.fresh,
            self.hold,
            self.blend,
            self.l_out_min,
        )
        return "kinematics", kinematics_stage, parameters
