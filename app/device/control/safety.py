"""The last word before the torques leave: faults, staleness, arming and limits."""

from dataclasses import dataclass
from math import atan2, isfinite
from typing import Final, NamedTuple

import numpy as np

from app.core import staleness
from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import Stage, numbered, packed
from app.device.control.depth_interval import shortest_lever
from app.device.control.vectors import norm_kernel, shrink_kernel, snapped
from app.device.faults import Fault
from app.mechanisms.lever import felt_kernel, tool_force_kernel, torque_kernel
from app.mechanisms.profile import DeviceProfile
from app.mechanisms.status import OK


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
def torque_factor(left: float, right: float, limit: float) -> float:
    """Factor in [0, 1] that brings the larger of two torques [N·m] to at most `limit`."""
    largest = max(abs(left), abs(right))
    if not (isfinite(left) and isfinite(right)) or limit <= 0.0:
        return 0.0
    return limit / largest if largest > limit else 1.0


@njit
def _growth(torque: float, last: float, step: float) -> float:
    room = step + (abs(last) if (torque > 0.0) == (last > 0.0) else 0.0)
    return room / abs(torque) if abs(torque) > room else 1.0


@njit
def slew_factor(
    left: float, right: float, last_left: float, last_right: float, step: float
) -> float:
    """Factor in [0, 1] after which neither torque grows by more than `step` [N·m] in this tick.

    Growing is moving away from zero: a torque may fall, or drop to zero and begin anew on the
    other side, as fast as it likes. Without a step (0, or NaN) nothing grows.
    """
    if not step > 0.0:
        step = 0.0
    if not (isfinite(last_left) and isfinite(last_right)):
        last_left, last_right = 0.0, 0.0
    return min(_growth(left, last_left, step), _growth(right, last_right, step))


@njit
def cap(limit: float, cleared: float, homed: float, sign_check: float) -> float:
    """Largest force at the hand [N]: the profile's `limit`, what the device is `cleared` for, and
    `sign_check` while the signs are being checked (`homed` below 1). Zero for NaN.
    """
    largest = min(limit, cleared)
    if not homed >= 1.0:
        largest = min(largest, sign_check)
    return largest if largest > 0.0 else 0.0


@njit
def tilt_kernel(dx: float, dy: float, dz: float) -> float:
    """Angle of the needle direction from straight down [rad], by atan2; 0 for a zero vector."""
    return atan2((dx * dx + dy * dy) ** 0.5, -dz) if dx * dx + dy * dy > 0.0 or dz > 0.0 else 0.0


@njit
def inwards(
    gx: float, gy: float, dx: float, dy: float, tilt: float, limit: float, margin: float
) -> tuple[float, float]:
    """Tool force (gx, gy) [N] without its outward part, beyond the tilt limit.

    The part along the outward direction (that of dx, dy) fades to zero over `margin` [rad] beyond
    `limit` [rad]; the inward and sideways parts stay, and the force felt only gets smaller.
    Continuous in pose and force.
    """
    beyond = (tilt - limit) / margin
    length = (dx * dx + dy * dy) ** 0.5
    if not (beyond > 0.0 and length > 0.0):
        return gx, gy
    ox, oy = dx / length, dy / length
    drop = min(beyond, 1.0) * max(gx * ox + gy * oy, 0.0)
    return gx - drop * ox, gy - drop * oy


# Compiled code takes plain integers as constants.
_INPUT_NOT_FINITE = int(Fault.INPUT_NOT_FINITE)
_FORCE_NOT_FINITE = int(Fault.FORCE_NOT_FINITE)
_ENCODERS_STALE = int(Fault.ENCODERS_STALE)
_HEARTBEAT_LOST = int(Fault.HEARTBEAT_LOST)
_LET_GO = int(Fault.LET_GO)
_NOT_HOMED = int(Fault.NOT_HOMED)
_LINK_LOST = int(Fault.LINK_LOST)
_BOARD_ERROR = int(Fault.BOARD_ERROR)
# Faults by kinematic status (see `mechanisms.status`).
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


class _SafetyPlaces(NamedTuple):
    """Limits and time-outs of `Safety`, and memory."""

    hand_limit: int
    torque_limit: int
    fade_from: int
    fade_to: int
    heartbeat: int
    arming: int
    slew: int
    tilt: int
    tilt_margin: int
    check_force: int
    check_torque: int
    last_left: int = 0
    last_right: int = 0
    latched: int = 0


_AT: Final = numbered(_SafetyPlaces)


_SILENT = 0.6  # share of the heartbeat's limit from which the force fades


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
    for slot in sv.SUMS:
        forces += 0.0 * state[slot]
    return _FORCE_NOT_FINITE if forces != 0.0 else 0


@njit
def _latching_fault(state: FloatArray) -> int:
    """Fault that is kept until the forces are disarmed."""
    if state[sv.LINK_STATUS] != 0.0:
        return _LINK_LOST
    if state[sv.BOARD_ERROR] != 0.0:
        return _BOARD_ERROR
    if state[sv.ENCODER_FAULT] != 0.0:
        return int(state[sv.ENCODER_FAULT])
    if state[sv.MACHINE_FAULT] != 0.0:
        return int(state[sv.MACHINE_FAULT])
    return _LET_GO if state[sv.LET_GO] != 0.0 else 0


@njit
def _fault(state: FloatArray, p: FloatArray, armed: bool, freshness: float) -> int:
    latching = _latching_fault(state)
    if not armed:
        p[_AT.latched] = 0.0
    elif latching != 0:
        p[_AT.latched] = latching
    fault = latching if latching != 0 else int(p[_AT.latched])
    if fault == 0:
        fault = _data_fault(state)
    if fault == 0 and freshness == 0.0:
        fault = _ENCODERS_STALE
    if fault == 0 and armed:
        if not state[sv.HOMED] >= 0.25:
            fault = _NOT_HOMED
        elif not abs(state[sv.TIME] - state[sv.HEARTBEAT]) <= p[_AT.heartbeat]:
            fault = _HEARTBEAT_LOST
    return fault


@njit
def _drop_bad_forces(state: FloatArray) -> None:
    for slot in sv.SUMS:
        if not isfinite(state[slot]):
            state[slot] = 0.0


@njit
def _send(state: FloatArray, p: FloatArray, left: float, right: float) -> None:
    # Limits once more, on what is sent: the tilt limit's, the joints', the hand's, and the growth.
    jxl, jxr, jyl, jyr = state[sv.J_XL], state[sv.J_XR], state[sv.J_YL], state[sv.J_YR]
    status, gx, gy = tool_force_kernel(left, right, jxl, jxr, jyl, jyr)
    if status != OK:
        state[sv.LIMIT_SCALE] = 0.0
        _hold_at_zero(state, p)
        return
    dx, dy, dz = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    tilt = tilt_kernel(dx, dy, dz)
    if tilt > p[_AT.tilt]:
        gx, gy = inwards(gx, gy, dx, dy, tilt, p[_AT.tilt], p[_AT.tilt_margin])
        before = abs(left) + abs(right)
        left, right = torque_kernel(gx, gy, jxl, jxr, jyl, jyr)
        after = abs(left) + abs(right)
        if after > before:  # the guard before has let pass what was asked, not more
            left, right = left * before / after, right * before / after
            gx, gy = gx * before / after, gy * before / after
    fx, fy, fz = felt_kernel(gx, gy, dx, dy, dz, state[sv.L_IN], state[sv.L_OUT])
    worst = state[sv.L_OUT] / shortest_lever(state)  # the hand can feel this much more
    homed = state[sv.HOMED]
    torque_limit = (
        p[_AT.torque_limit] if homed >= 1.0 else min(p[_AT.torque_limit], p[_AT.check_torque])
    )
    hand_limit = cap(p[_AT.hand_limit], state[sv.FORCE_CAP], homed, p[_AT.check_force])
    scale = min(
        torque_factor(left, right, torque_limit), shrink_kernel(fx, fy, fz, hand_limit / worst)
    )
    step = p[_AT.slew] * state[sv.DT]
    scale *= slew_factor(scale * left, scale * right, p[_AT.last_left], p[_AT.last_right], step)
    left, right = snapped(scale * left), snapped(scale * right)
    p[_AT.last_left], p[_AT.last_right] = left, right
    state[sv.LIMIT_SCALE] *= scale
    state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = left, right
    state[sv.FELT_X], state[sv.FELT_Y], state[sv.FELT_Z] = scale * fx, scale * fy, scale * fz
    state[sv.FELT_MOST] = worst * scale * norm_kernel(fx, fy, fz)


@njit
def _hold_at_zero(state: FloatArray, p: FloatArray) -> None:
    p[_AT.last_left], p[_AT.last_right] = 0.0, 0.0
    state[sv.TORQUE_LEFT] = 0.0
    state[sv.TORQUE_RIGHT] = 0.0
    state[sv.FELT_X], state[sv.FELT_Y], state[sv.FELT_Z] = 0.0, 0.0, 0.0
    state[sv.FELT_MOST] = 0.0


@stage
def safety_stage(state: FloatArray, p: FloatArray) -> None:
    """Let TORQUE_* pass, faded and limited, or hold it at zero and say why in FAULT.

    LET_GO, LINK_LOST, BOARD_ERROR and what the machine's watch finds stay until the forces are
    disarmed: somebody looks, then arms again. ENCODER_WRAPPED and ENCODER_JUMPED stay until the
    robot is homed. Any other fault ends with its cause, and the force comes back along the arming
    ramp.
    """
    armed = state[sv.ENABLED] > 0.5
    freshness = fade(state[sv.TIME] - state[sv.Q_TIME], p[_AT.fade_from], p[_AT.fade_to])
    fault = _fault(state, p, armed, freshness)
    arming = ramp(state[sv.ARMING], state[sv.DT], p[_AT.arming], armed and fault == 0)
    if armed:
        # A window that goes silent loses the force bit by bit; it comes back along the arming ramp,
        # since a force that returns in one tick throws the needle.
        silence = state[sv.TIME] - state[sv.HEARTBEAT]
        arming = min(arming, fade(silence, _SILENT * p[_AT.heartbeat], p[_AT.heartbeat]))
    state[sv.ARMING] = arming
    scale = freshness * arming
    state[sv.FAULT] = fault
    state[sv.SAFETY_SCALE] = scale
    if scale > 0.0:
        _send(state, p, scale * state[sv.TORQUE_LEFT], scale * state[sv.TORQUE_RIGHT])
    else:
        _drop_bad_forces(state)
        _hold_at_zero(state, p)


@dataclass(frozen=True, slots=True)
class Safety:
    """Limits and time-outs of the last stage before the link.

    The inputs HOMED and FORCE_CAP narrow the limits: below 0.25 not homed, no force; below 1 the
    signs are being checked, `check_force` and `check_torque` hold; the force felt never exceeds
    FORCE_CAP, which is 0 until somebody sets it. The force felt is taken at the depth that makes it
    largest, DEPTH_MOST: FELT_MOST.

    Attributes:
        hand_limit: largest force felt at the hand [N].
        torque_limit: largest joint torque [N·m].
        tilt_limit: tilt from which the outward part of the force fades [rad].
        slew: fastest growth of a torque [N·m/s]; by default the limit in 20 ms.
        fade_from: age of the encoder reading at which the force starts to fade [s].
        fade_to: age at which it is zero [s].
        heartbeat: largest silence of the window while armed [s]; the force fades from six tenths of
            it on.
        arming: time over which the force comes up after arming or after a fault [s].
        tilt_margin: range beyond the tilt limit over which the outward part goes to zero [rad].
        check_force, check_torque: limits while the signs are being checked [N], [N·m].
    """

    hand_limit: float
    torque_limit: float
    tilt_limit: float
    slew: float
    fade_from: float = staleness.ENCODER_FADE
    fade_to: float = staleness.ENCODER_ZERO
    heartbeat: float = staleness.HEARTBEAT
    arming: float = 1.0
    tilt_margin: float = 0.035
    check_force: float = 0.3
    check_torque: float = 0.03

    @classmethod
    def of(cls, profile: DeviceProfile) -> "Safety":
        """Safety with the limits of a device profile."""
        limits = profile.limits
        slew = limits.joint_torque / 0.020
        return cls(
            hand_limit=limits.hand_force,
            torque_limit=limits.joint_torque,
            tilt_limit=profile.tilt_limit,
            slew=slew,
        )

    def stage(self) -> Stage:
        """Return the stage for a loop's table, with memory of its own."""
        parameters = packed(
            _AT,
            hand_limit=self.hand_limit,
            torque_limit=self.torque_limit,
            fade_from=self.fade_from,
            fade_to=self.fade_to,
            heartbeat=self.heartbeat,
            arming=self.arming,
            slew=self.slew,
            tilt=self.tilt_limit,
            tilt_margin=self.tilt_margin,
            check_force=self.check_force,
            check_torque=self.check_torque,
        )
        return Stage("safety", safety_stage, parameters)
