"""The last word before the torques leave: faults, staleness, arming and limits."""

from dataclasses import dataclass
from math import isfinite
from typing import Any

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.device.control.vectors import shrink_kernel, snapped
from app.device.faults import Fault
from app.mechanisms.pantograph.kernels import felt_kernel, tool_force_kernel
from app.mechanisms.pantograph.status import OK
from app.mechanisms.profile import DeviceProfile

# Compiled code takes plain integers as constants.
_INPUT_NOT_FINITE = int(Fault.INPUT_NOT_FINITE)
_FORCE_NOT_FINITE = int(Fault.FORCE_NOT_FINITE)
_ENCODERS_STALE = int(Fault.ENCODERS_STALE)
_HEARTBEAT_LOST = int(Fault.HEARTBEAT_LOST)
# Faults by kinematic status (see `mechanisms.pantograph.status`).
_OF_STATUS = np.array(
    [
        Fault.NONE,
        Fault.UNREACHABLE,
        Fault.SINGULAR,
        Fault.NO_GRIP,
        Fault.DEGENERATE,
        Fault.ENCODER_NOT_FINITE,
    ],
    dtype=np.int64,
)

(
    _HAND_LIMIT,
    _TORQUE_LIMIT,
    _FADE_FROM,
    _FADE_TO,
    _HEARTBEAT,
    _ARMING,
) = range(6)


@njit
def fade(age: float, start: float, end: float) -> float:
    """Factor on the force for data of an age [s]: 1 up to `start`, falling to 0 at `end`.

    A time as far in the future comes from another clock, and counts like one in the past.
    """
    age = abs(age)
    if not age < end:  # also for NaN
        return 0.0
    return 1.0 if age <= start else (end - age) / (end - start)


@njit
def ramp(previous: float, dt: float, duration: float, armed: bool) -> float:
    """Arming factor: grows from 0 to 1 over `duration` [s] while armed, else 0 at once."""
    return min(1.0, previous + max(dt, 0.0) / duration) if armed else 0.0


@njit
def _data_fault(state: FloatArray) -> int:
    # Adding finite numbers times zero gives zero; one NaN or infinite among them gives NaN.
    inputs = 0.0
    for slot in range(sv.INPUTS):
        inputs += 0.0 * state[slot]
    if inputs != 0.0 or state[sv.INPUT_FAULT] != 0.0:
        return _INPUT_NOT_FINITE
    status = int(state[sv.KINEMATICS])
    if status != OK:
        return _OF_STATUS[min(max(status, 0), len(_OF_STATUS) - 1)]
    forces = 0.0 * (state[sv.TORQUE_LEFT] + state[sv.TORQUE_RIGHT])
    for slot in range(sv.FORCE_X, sv.AXIAL_FORCE + 1):
        forces += 0.0 * state[slot]
    return _FORCE_NOT_FINITE if forces != 0.0 else 0


@njit
def _drop_bad_forces(state: FloatArray) -> None:
    for slot in range(sv.FORCE_X, sv.AXIAL_FORCE + 1):
        if not isfinite(state[slot]):
            state[slot] = 0.0


@njit
def _send(state: FloatArray, left: float, right: float, p: FloatArray) -> None:
    # Limits once more, on what is sent: torques by the joints' limit, the force felt by the hand's.
    largest = max(abs(left), abs(right))
    if largest > p[_TORQUE_LIMIT]:
        left, right = left * p[_TORQUE_LIMIT] / largest, right * p[_TORQUE_LIMIT] / largest
    status, gx, gy = tool_force_kernel(
        left, right, state[sv.J_XL], state[sv.J_XR], state[sv.J_YL], state[sv.J_YR]
    )
    fx, fy, fz, scale = 0.0, 0.0, 0.0, 0.0
    if status == OK:
        fx, fy, fz = felt_kernel(
            gx,
            gy,
            state[sv.AXIS_X],
            state[sv.AXIS_Y],
            state[sv.AXIS_Z],
            state[sv.L_IN],
            state[sv.L_OUT],
        )
        scale = shrink_kernel(fx, fy, fz, p[_HAND_LIMIT])
    state[sv.LIMIT_SCALE] *= scale
    state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = snapped(scale * left), snapped(scale * right)
    state[sv.FELT_X], state[sv.FELT_Y], state[sv.FELT_Z] = scale * fx, scale * fy, scale * fz


@njit
def _hold_at_zero(state: FloatArray) -> None:
    state[sv.TORQUE_LEFT] = 0.0
    state[sv.TORQUE_RIGHT] = 0.0
    state[sv.FELT_X], state[sv.FELT_Y], state[sv.FELT_Z] = 0.0, 0.0, 0.0


@stage
def safety_stage(state: FloatArray, p: FloatArray) -> None:
    """Let TORQUE_* pass, faded and limited, or hold it at zero and say why in FAULT.

    A fault is not latched: when its cause is gone the force comes back along the arming ramp.
    """
    now = state[sv.TIME]
    armed = state[sv.ENABLED] > 0.5
    fault = _data_fault(state)
    scale = fade(now - state[sv.Q_TIME], p[_FADE_FROM], p[_FADE_TO])
    if fault == 0 and scale == 0.0:
        fault = _ENCODERS_STALE
    if fault == 0 and armed and not abs(now - state[sv.HEARTBEAT]) <= p[_HEARTBEAT]:
        fault = _HEARTBEAT_LOST
    arming = ramp(state[sv.ARMING], state[sv.DT], p[_ARMING], armed and fault == 0)
    state[sv.ARMING] = arming
    scale *= arming
    state[sv.FAULT] = fault
    state[sv.SAFETY_SCALE] = scale
    if scale > 0.0:
        _send(state, scale * state[sv.TORQUE_LEFT], scale * state[sv.TORQUE_RIGHT], p)
    else:
        _drop_bad_forces(state)
        _hold_at_zero(state)


@dataclass(frozen=True, slots=True)
class Safety:
    """Limits and time-outs of the last stage before the link.

    Attributes:
        hand_limit: largest force felt at the hand [N].
        torque_limit: largest joint torque [N·m].
        fade_from: age of the encoder reading at which the force starts to fade [s].
        fade_to: age at which it is zero [s].
        heartbeat: largest silence of the window while armed [s].
        arming: time over which the force comes up after arming or after a fault [s].
    """

    hand_limit: float
    torque_limit: float
    fade_from: float = 0.020
    fade_to: float = 0.100
    heartbeat: float = 1.0
    arming: float = 1.0

    @classmethod
    def of(cls, profile: DeviceProfile) -> "Safety":
        """Safety with the limits of a device profile."""
        return cls(profile.limits.hand_force, profile.limits.joint_torque)

    def stage(self) -> tuple[str, Any, FloatArray]:
        """Return the stage for a loop's table; its memory is the slot ARMING."""
        parameters = np.array(
            [
                self.hand_limit,
                self.torque_limit,
                self.fade_from,
                self.fade_to,
                self.heartbeat,
                self.arming,
            ]
        )
        return "safety", safety_stage, parameters
