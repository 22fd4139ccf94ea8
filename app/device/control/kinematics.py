"""From the machine's tool point to the needle: direction, depth, hub, tip and their velocities."""

from dataclasses import dataclass
from math import atan2, isfinite
from typing import Final, NamedTuple

from app.core import staleness
from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import Stage, numbered, packed
from app.device.control.vectors import norm_kernel, unit_kernel
from app.mechanisms.lever import axis_kernel, hub_velocity_kernel
from app.mechanisms.profile import DeviceProfile
from app.mechanisms.status import OK


class _KinematicsPlaces(NamedTuple):
    """Remote centre and needle [m], the limits of `Kinematics`, and memory."""

    fx: int
    fy: int
    fz: int
    length: int
    fresh: int
    hold: int
    blend: int
    l_out_min: int
    started: int = 0
    weight: int = 0
    held: int = 0


_AT: Final = numbered(_KinematicsPlaces)

MODEL, TRACKED, HELD = 0, 1, 2
"""Values of the slot `DEPTH_SOURCE`."""


@njit
def _clear_forces(state: FloatArray) -> None:
    for slot in sv.SUMS:
        state[slot] = 0.0


@njit
def _length_outside(state: FloatArray, p: FloatArray, l_in: float) -> float:
    # L_out: measured while the cameras' fix is younger than _HOLD, else C - L_in. The weight of the
    # measurement moves over _BLEND seconds, so that losing the marker does not make the lever jump.
    # A stamp in the future is as wrong as an old one: it must not stay fresh until its time comes.
    age = abs(state[sv.TIME] - state[sv.TRACKED_TIME])
    depth = state[sv.TRACKED_DEPTH]
    source = MODEL
    if state[sv.TRACKED_TIME] != 0.0 and isfinite(depth) and age < p[_AT.hold]:
        source = TRACKED if age < p[_AT.fresh] else HELD
        p[_AT.held] = depth
    goal = 0.0 if source == MODEL else 1.0
    step = state[sv.DT] / p[_AT.blend] if p[_AT.started] != 0.0 else 1.0
    weight = p[_AT.weight]
    weight += min(max(goal - weight, -step), step)
    p[_AT.weight] = weight
    p[_AT.started] = 1.0
    model = p[_AT.length] - l_in
    l_out = model + weight * (p[_AT.length] - p[_AT.held] - model)
    state[sv.DEPTH_SOURCE] = source
    return max(l_out, p[_AT.l_out_min])


@njit
def _place_needle(state: FloatArray, p: FloatArray, x: float, y: float) -> None:
    fx, fy, fz = p[_AT.fx], p[_AT.fy], p[_AT.fz]
    dx, dy, dz, l_in = axis_kernel(x, y, fx, fy, fz)
    l_out = _length_outside(state, p, l_in)
    depth = p[_AT.length] - l_out
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

    The machine's own stage before has written KINEMATICS, P3_* and J_*. Where the pose does not
    exist the status says so, velocities are zero and the last valid pose stays: nothing downstream
    ever sees a NaN.
    """
    _clear_forces(state)
    if state[sv.KINEMATICS] == OK:
        _place_needle(state, p, state[sv.P3_X], state[sv.P3_Y])
        jxl, jxr, jyl, jyr = state[sv.J_XL], state[sv.J_XR], state[sv.J_YL], state[sv.J_YR]
        v1, v2 = state[sv.QD_LEFT], state[sv.QD_RIGHT]
        _set_velocities(state, jxl * v1 + jxr * v2, jyl * v1 + jyr * v2)
    else:
        if state[sv.L_IN] == 0.0:  # no valid pose yet: a vertical needle
            _place_needle(state, p, p[_AT.fx], p[_AT.fy])
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
    """Kinematics of a needle that a machine points and whose depth the cameras measure.

    Attributes:
        fulcrum: remote centre in world [m].
        needle_length: C, hub to tip [m].
        fresh: age up to which a fix counts as tracked [s].
        hold: age up to which the last fix is held [s]; beyond, L_out = C - L_in.
        blend: time over which the lever changes between the two [s].
        l_out_min: smallest L_out [m], so that the lever stays defined.
    """

    fulcrum: tuple[float, float, float]
    needle_length: float
    fresh: float = staleness.TRACKER_FRESH
    hold: float = staleness.TRACKER_HOLD
    blend: float = 0.1
    l_out_min: float = 0.005

    @classmethod
    def of(cls, profile: DeviceProfile) -> "Kinematics":
        """Kinematics of a device profile."""
        return cls(profile.geometry.fulcrum, profile.needle_length)

    def stage(self) -> Stage:
        """Return the stage for a loop's table, with memory of its own."""
        fx, fy, fz = self.fulcrum
        parameters = packed(
            _AT,
            fx=fx,
            fy=fy,
            fz=fz,
            length=self.needle_length,
            fresh=self.fresh,
            hold=self.hold,
            blend=self.blend,
            l_out_min=self.l_out_min,
        )
        return Stage("kinematics", kinematics_stage, parameters)
