"""Which readings of the encoders are believed: those that hand and motors could have caused.

A joint turns by at most `FASTEST` for each millisecond between two readings, 52 rad/s: faster than
any hand, and than these motors. What is further away than that is a missing reading: the last one
that was believed stays, with its time, and everything that is said of old readings holds for it.
The same goes for what follows such a jump and stays with it, however near it is by then: a joint
that is 3.6° further on from one millisecond to the next and stays there has lost its zero, it has
not moved. After a jump a reading is therefore believed if it goes on with the joint: it is where
the joint's last speed leads, to within what hand and motors change of it, and not nearer to where
the same speed leads from the jump.

More than `PATIENCE` of readings that are not believed is a fault, ENCODER_WRAPPED where the first
jump was a power of two counts or a turn, else ENCODER_JUMPED. It stays until the robot is homed:
HOMED goes down and up. A robot that is not homed gives no torque, so its readings pass: homing
itself makes them jump. What comes first may be the wrong one; until `SETTLED` readings have agreed
nothing is held back, while the arming ramp has hardly begun.

The stage stands behind the link's read stages, whatever machine it is, and before the corrections.
"""

from dataclasses import dataclass
from math import isfinite, pi
from typing import Final, NamedTuple

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import Stage, numbered, packed
from app.device.control.vectors import snapped
from app.device.faults import Fault
from app.mechanisms.profile import DeviceProfile

FASTEST: Final = 3.0 * pi / 180.0 / 1e-3
"""Fastest that hand and motors turn a joint [rad/s]: 3° in a millisecond."""

FARTHEST: Final = pi
"""Furthest that a joint can be from where it was read last [rad], however long ago that was."""

PATIENCE: Final = 0.020
"""Time of readings that are not believed after which it is a fault [s]."""

SETTLED: Final = 5
"""Readings that must agree, one after the other, before one is held back."""

_SHORTEST: Final = 1e-3  # [s] two readings count as at least so far apart: stamps jitter
_LONGEST: Final = 5e-3  # [s] one reading counts as at most so much time without a believed one
_FORGIVEN: Final = 0.25  # share of the time of believed readings that makes up for others
_TOLD_WITHIN: Final = 0.010  # [s] after a longer gap a jump cannot be told from a motion
_QUICKENS: Final = 1000.0  # [rad/s²] a hand with 100 m/s² at a joint's 0.1 m
_SMOOTHING: Final = 0.25  # share of the newest difference in the speed
_ROUNDING: Final = 1e-9  # [s]

_LEAST_BITS: Final = 8
_MOST_BITS: Final = 32
_NEAR: Final = 0.02  # share of a power of two, or of a turn, within which a jump is one

# Compiled code takes plain integers as constants.
_WRAPPED = int(Fault.ENCODER_WRAPPED)
_JUMPED = int(Fault.ENCODER_JUMPED)


class _PlausibilityPlaces(NamedTuple):
    """Constants of `Plausibility`, and memory: joint angles as the link gave them [rad]."""

    one_count: int
    fastest: int
    farthest: int
    patience: int
    homed: int = 0
    agreed: int = 0
    stamp: int = 0  # of the newest reading that is believed [s]
    left: int = 0
    right: int = 0
    speed_left: int = 0  # [rad/s]
    speed_right: int = 0
    doubts: int = 0  # 1 while the newest reading is not believed
    doubt_stamp: int = 0
    doubt_left: int = 0
    doubt_right: int = 0
    kind: int = 0  # fault that the first jump would be
    lacking: int = 0  # time of readings that were not believed, less what others made up for [s]


_AT: Final = numbered(_PlausibilityPlaces)


@njit
def is_wrap(jump: float, count: float) -> bool:
    """Return whether a jump [rad] is near a power of two of counts [rad], 2⁸ to 2³², or near a
    turn.
    """
    size = abs(jump)
    if abs(size - 2.0 * pi) <= _NEAR * 2.0 * pi:
        return True
    power = 2.0**_LEAST_BITS * count
    for _ in range(_LEAST_BITS, _MOST_BITS + 1):
        if abs(size - power) <= _NEAR * power:
            return True
        power *= 2.0
    return False


@njit
def _smoothed(before: float, speed: float) -> float:
    """Return the smoothed speed [rad/s]; one that fades away ends at zero, not at a subnormal."""
    return snapped(before + _SMOOTHING * (speed - before))


@njit
def _believe(p: FloatArray, stamp: float, left: float, right: float) -> None:
    since = stamp - p[_AT.stamp]
    if since > 0.0:
        p[_AT.speed_left] = _smoothed(p[_AT.speed_left], (left - p[_AT.left]) / since)
        p[_AT.speed_right] = _smoothed(p[_AT.speed_right], (right - p[_AT.right]) / since)
        p[_AT.lacking] = max(p[_AT.lacking] - _FORGIVEN * since, 0.0)
    p[_AT.stamp], p[_AT.left], p[_AT.right], p[_AT.doubts] = stamp, left, right, 0.0


@njit
def _begin(p: FloatArray, stamp: float, left: float, right: float) -> None:
    p[_AT.agreed], p[_AT.doubts], p[_AT.lacking] = 1.0, 0.0, 0.0
    p[_AT.speed_left], p[_AT.speed_right] = 0.0, 0.0
    p[_AT.stamp], p[_AT.left], p[_AT.right] = stamp, left, right


@njit
def _beside(p: FloatArray, of: int, stamp: float, left: float, right: float) -> float:
    """Return how far a reading is from that at `of` (stamp, left, right), moved on at the last
    speed.
    """
    since = stamp - p[of]
    return max(
        abs(left - p[of + 1] - p[_AT.speed_left] * since),
        abs(right - p[of + 2] - p[_AT.speed_right] * since),
    )


@njit
def _goes_on(p: FloatArray, stamp: float, left: float, right: float) -> bool:
    """Return whether a reading goes on with what was believed last, and not with a jump after
    it.
    """
    if p[_AT.doubts] == 0.0 or not stamp - p[_AT.doubt_stamp] <= _TOLD_WITHIN:
        return True
    since = stamp - p[_AT.stamp]
    beside = _beside(p, _AT.stamp, stamp, left, right)
    if beside > p[_AT.fastest] * _SHORTEST + 0.5 * _QUICKENS * since * since:
        return False
    return beside <= _beside(p, _AT.doubt_stamp, stamp, left, right)


@njit
def _doubt(state: FloatArray, p: FloatArray, stamp: float, left: float, right: float) -> None:
    """Keep what was believed last; say after a while that it is a fault."""
    before = p[_AT.doubt_stamp] if p[_AT.doubts] != 0.0 else p[_AT.stamp]
    if p[_AT.doubts] == 0.0:
        since = stamp - p[_AT.stamp]
        first = left - p[_AT.left] - p[_AT.speed_left] * since
        second = right - p[_AT.right] - p[_AT.speed_right] * since
        count = p[_AT.one_count]
        jump = first if abs(first) > abs(second) else second
        p[_AT.kind] = _WRAPPED if is_wrap(jump, count) else _JUMPED
    p[_AT.doubts], p[_AT.doubt_stamp] = 1.0, stamp
    p[_AT.doubt_left], p[_AT.doubt_right] = left, right
    p[_AT.lacking] += min(max(stamp - before, 0.0), _LONGEST)
    state[sv.UNBELIEVED] += 1.0
    if p[_AT.lacking] > p[_AT.patience] + _ROUNDING:
        state[sv.ENCODER_FAULT] = p[_AT.kind]
    _hold(state, p)


@njit
def _hold(state: FloatArray, p: FloatArray) -> None:
    state[sv.Q_LEFT], state[sv.Q_RIGHT] = p[_AT.left], p[_AT.right]
    state[sv.Q_TIME] = p[_AT.stamp]


@stage
def plausibility_stage(state: FloatArray, p: FloatArray) -> None:
    """Let Q_* and Q_TIME pass, or put those back that were believed last; write ENCODER_FAULT.

    A reading that is no number passes: the kinematics name it, and hold the force at zero at once.
    """
    homed = 1.0 if state[sv.HOMED] >= 0.25 else 0.0
    if homed > p[_AT.homed]:
        state[sv.ENCODER_FAULT] = 0.0
        p[_AT.agreed] = 0.0
    p[_AT.homed] = homed
    stamp, left, right = state[sv.Q_TIME], state[sv.Q_LEFT], state[sv.Q_RIGHT]
    if homed == 0.0:
        return
    if state[sv.ENCODER_FAULT] != 0.0:
        if stamp != p[_AT.stamp]:
            _hold(state, p)
        return
    if not isfinite(left + right + stamp) or (p[_AT.agreed] > 0.0 and stamp == p[_AT.stamp]):
        return
    since = max(stamp - p[_AT.stamp], _SHORTEST)
    # Either reading is true to half a count.
    limit = min(p[_AT.fastest] * since, p[_AT.farthest]) + p[_AT.one_count]
    near = abs(left - p[_AT.left]) <= limit and abs(right - p[_AT.right]) <= limit
    if p[_AT.agreed] < SETTLED:
        if near and p[_AT.agreed] > 0.0:
            p[_AT.agreed] += 1.0
            _believe(p, stamp, left, right)
        else:
            _begin(p, stamp, left, right)
    elif near and _goes_on(p, stamp, left, right):
        _believe(p, stamp, left, right)
    else:
        _doubt(state, p, stamp, left, right)


@dataclass(frozen=True, slots=True)
class Plausibility:
    """What hand and motors can do to the joints of a machine.

    Attributes:
        count: one encoder count at the joint [rad].
        fastest: that a joint turns [rad/s].
        farthest: that it can be from where it was read last [rad].
        patience: time of readings that are not believed after which it is a fault [s].
    """

    count: float
    fastest: float = FASTEST
    farthest: float = FARTHEST
    patience: float = PATIENCE

    @classmethod
    def of(cls, profile: DeviceProfile) -> "Plausibility":
        """Return the test for a device profile's encoders."""
        return cls(2.0 * pi / profile.encoder.counts_per_turn)

    def stage(self) -> Stage:
        """Return the stage for a loop's table, with memory of its own."""
        parameters = packed(
            _AT,
            one_count=self.count,
            fastest=self.fastest,
            farthest=self.farthest,
            patience=self.patience,
        )
        return Stage("plausibility", plausibility_stage, parameters)
