"""Joint velocities from encoder angles: five estimators, which a device profile chooses by name.

All of them answer a first, bad, repeated or late reading and a jump of the encoder in one way
(`next_reading`), are zero at rest without subnormal numbers, and depend on nothing but their
readings. A tick may come late with its step DT clamped, while the encoder went on moving; a wire
may deliver the same reading twice. The time between readings is therefore DT, unless their stamps
Q_TIME say that it was clearly longer. Stamps of 0 are no stamps.

`acus study velocity` compares them; what each does and whose it is stands at its class.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite, pi
from typing import Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import Stage, numbered, packed
from app.device.control.vectors import snapped
from app.mechanisms.profile import DEFAULT_VELOCITY, DeviceProfile, VelocityMethod

__all__ = [
    "DEFAULT_VELOCITY",
    "AdaptiveWindow",
    "AlphaBeta",
    "BackwardDifference",
    "Kalman",
    "VelocityFilter",
    "VelocityMethod",
    "velocity_stage",
]

FASTEST: Final = 100.0
"""[rad/s] No joint of this size turns faster; an estimate beyond is cut to it."""

JUMP: Final = pi
"""[rad] Half a turn between two readings is no movement: an encoder wrapped, slipped or failed."""

_LATE: Final = 1.5  # of DT: what an ordinary wake-up does not exceed
_HELD: Final = 0.020  # [s] a velocity is kept this long without a new reading: as safety fades from
_GAP: Final = 0.200  # [s] after a longer gap nothing is known of the movement


# --- readings -------------------------------------------------------------------------------------
class _ReadingAt(NamedTuple):
    """First entries of every estimator's parameters: is there a last reading, and its stamp [s]."""

    started: int = 0
    stamp: int = 0


_READING: Final = numbered(_ReadingAt)

KEEP: Final = 0
RESTART: Final = 1
STEP: Final = 2
"""What a reading asks for: leave everything as it is, begin with it, or go on with it."""


@njit
def next_reading(state: FloatArray, p: FloatArray) -> tuple[int, float]:
    """Judge the reading in Q_*: what to do, and the time since the last one [s].

    On RESTART, and where a reading is not finite or too old, QD_* has been set to zero.
    """
    stamp, dt = state[sv.Q_TIME], state[sv.DT]
    if not isfinite(state[sv.Q_LEFT] + state[sv.Q_RIGHT]):
        return _forget(state, p), 0.0
    if p[_READING.started] == 0.0:
        return _begin(state, p, stamp), 0.0
    if not dt > 0.0:  # the clock stands still; also for NaN
        return KEEP, 0.0
    if stamp == 0.0 or not isfinite(stamp):
        return STEP, min(dt, _GAP)
    between = stamp - p[_READING.stamp]
    if between == 0.0 and abs(state[sv.TIME] - stamp) <= _HELD:
        return KEEP, 0.0
    if between == 0.0:
        state[sv.QD_LEFT], state[sv.QD_RIGHT] = 0.0, 0.0
        return KEEP, 0.0
    if not 0.0 < between <= _GAP:
        return _begin(state, p, stamp), 0.0
    p[_READING.stamp] = stamp
    return STEP, between if between > _LATE * dt else dt


@njit
def _forget(state: FloatArray, p: FloatArray) -> int:
    p[_READING.started] = 0.0
    state[sv.QD_LEFT], state[sv.QD_RIGHT] = 0.0, 0.0
    return KEEP


@njit
def _begin(state: FloatArray, p: FloatArray, stamp: float) -> int:
    p[_READING.started] = 1.0
    p[_READING.stamp] = stamp if isfinite(stamp) else 0.0
    state[sv.QD_LEFT], state[sv.QD_RIGHT] = 0.0, 0.0
    return RESTART


@njit
def plausible(velocity: float) -> float:
    """Return an estimate within ±FASTEST; NaN and what is too small to matter become zero."""
    if not abs(velocity) <= FASTEST:
        return FASTEST if velocity > FASTEST else (-FASTEST if velocity < -FASTEST else 0.0)
    return snapped(velocity)


# --- backward difference --------------------------------------------------------------------------
class _DifferenceAt(NamedTuple):
    """Memory of `BackwardDifference`: the last reading."""

    started: int = 0
    stamp: int = 0
    left: int = 0
    right: int = 0


_DIFFERENCE: Final = numbered(_DifferenceAt)


@njit
def _difference(now: float, before: float, elapsed: float) -> float:
    turned = now - before
    return plausible(turned / elapsed) if abs(turned) < JUMP else 0.0


@stage
def difference_stage(state: FloatArray, p: FloatArray) -> None:
    """Write QD_* as the last difference of Q_* over the time between the readings."""
    action, elapsed = next_reading(state, p)
    if action == KEEP:
        return
    left, right = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    if action != RESTART:
        state[sv.QD_LEFT] = _difference(left, p[_DIFFERENCE.left], elapsed)
        state[sv.QD_RIGHT] = _difference(right, p[_DIFFERENCE.right], elapsed)
    p[_DIFFERENCE.left], p[_DIFFERENCE.right] = left, right


@dataclass(frozen=True, slots=True)
class BackwardDifference:
    """Difference of the last two readings, the thesis' own way.

    No memory, no lag beyond half a tick, all the noise: one encoder count shows as Δ/T; the RMS of
    the error is Δ/(T√6) (0.13 rad/s at 1 kHz and 20 000 counts per turn).
    """

    def stage(self) -> Stage:
        """Return the stage for a loop's table, with memory of its own."""
        return Stage("velocity", difference_stage, packed(_DIFFERENCE))


# --- low-pass -------------------------------------------------------------------------------------
class _FilteredAt(NamedTuple):
    """Constant of `VelocityFilter`, and the last reading."""

    started: int = 0
    stamp: int = 0
    time_constant: int = 0
    left: int = 0
    right: int = 0


_FILTERED: Final = numbered(_FilteredAt)


@njit
def _filtered(velocity: float, turned: float, elapsed: float, constant: float) -> float:
    # Backward Euler of the low-pass on the difference quotient, without dividing by the time.
    if not abs(turned) < JUMP:
        return 0.0
    return plausible(velocity + (turned - velocity * elapsed) / (constant + elapsed))


@stage
def filtered_stage(state: FloatArray, p: FloatArray) -> None:
    """Write QD_* from Q_*; the filter's memory is QD_* itself."""
    action, elapsed = next_reading(state, p)
    if action == KEEP:
        return
    left, right = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    if action != RESTART:
        constant = p[_FILTERED.time_constant]
        turned_left, turned_right = left - p[_FILTERED.left], right - p[_FILTERED.right]
        state[sv.QD_LEFT] = _filtered(state[sv.QD_LEFT], turned_left, elapsed, constant)
        state[sv.QD_RIGHT] = _filtered(state[sv.QD_RIGHT], turned_right, elapsed, constant)
    p[_FILTERED.left], p[_FILTERED.right] = left, right


@dataclass(frozen=True, slots=True)
class VelocityFilter:
    """Backward difference through a first-order low-pass: lag 1/(2π·cutoff), whatever the speed.

    Attributes:
        cutoff_hz: corner of the filter. At 1 kHz one encoder count is 0.3 rad/s without it.
    """

    cutoff_hz: float = 50.0

    def stage(self) -> Stage:
        """Return the stage for a loop's table, with memory of its own."""
        parameters = packed(_FILTERED, time_constant=1.0 / (2.0 * pi * self.cutoff_hz))
        return Stage("velocity", filtered_stage, parameters)


# --- alpha-beta -----------------------------------------------------------------------------------
class _AlphaBetaAt(NamedTuple):
    """Constant of `AlphaBeta`, and the tracked angles."""

    started: int = 0
    stamp: int = 0
    time_constant: int = 0
    left: int = 0
    right: int = 0


_ALPHA_BETA: Final = numbered(_AlphaBetaAt)


@njit
def _track(p: FloatArray, slot: int, reading: float, velocity: float, h: float) -> float:
    predicted = p[slot] + velocity * h
    residual = reading - predicted
    if not abs(residual) < JUMP:
        p[slot] = reading
        return 0.0
    constant = p[_ALPHA_BETA.time_constant]
    alpha = h / (constant + h)
    p[slot] = predicted + alpha * residual
    # β r/h with α = h/(τ + h): the step cancels.
    return plausible(velocity + alpha * residual / ((constant + h) * (2.0 - alpha)))


@stage
def alpha_beta_stage(state: FloatArray, p: FloatArray) -> None:
    """Write QD_* from Q_*."""
    action, elapsed = next_reading(state, p)
    if action == KEEP:
        return
    left, right = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    if action == RESTART:
        p[_ALPHA_BETA.left], p[_ALPHA_BETA.right] = left, right
        return
    state[sv.QD_LEFT] = _track(p, _ALPHA_BETA.left, left, state[sv.QD_LEFT], elapsed)
    state[sv.QD_RIGHT] = _track(p, _ALPHA_BETA.right, right, state[sv.QD_RIGHT], elapsed)


@dataclass(frozen=True, slots=True)
class AlphaBeta:
    """Alpha-beta filter: a tracker of constant velocity with fixed gains.

    Prediction x + v h, residual r, then x += α r and v += β r/h. Gains follow the time h between
    the readings: α = h/(τ + h), and β = α²/(2 - α), the best transient response for a given α
    (Benedict and Bordner 1962). Written so, v changes by at most r/h for a long step and by nothing
    for a short one.

    Attributes:
        time_constant: τ [s]; 2.5 ms is α = 0.29 at 1 kHz (`acus study velocity`).
    """

    time_constant: float = 2.5e-3

    def stage(self) -> Stage:
        """Return the stage for a loop's table, with memory of its own."""
        parameters = packed(_ALPHA_BETA, time_constant=self.time_constant)
        return Stage("velocity", alpha_beta_stage, parameters)


# --- adaptive window ------------------------------------------------------------------------------
class _WindowAt(NamedTuple):
    """Constants of `AdaptiveWindow`, and its place in the rings, which follow."""

    started: int = 0
    stamp: int = 0
    band: int = 0
    window: int = 0
    head: int = 0
    used_left: int = 0  # steps back that count
    used_right: int = 0


LONGEST: Final = 30
"""Steps of the longest window."""

_WINDOW: Final = numbered(_WindowAt)
_RING: Final = 32  # a power of two above LONGEST + 1
_TIMES: Final = len(_WINDOW)
_READINGS: Final = _TIMES + _RING  # left, then right
_ROUNDING: Final = 1e-6  # of a count: readings on the band's edge are within it


@njit
def end_fit(p: FloatArray, head: int, first: int, used: int) -> float:
    """Slope [rad/s] of the longest line within the band over at most `used` steps back.

    Args:
        p: the estimator's memory.
        head: ring position of the newest reading.
        first: where the ring of this joint's readings begins.
        used: steps back, at least 1.
    """
    newest, now, band = p[first + head], p[_TIMES + head], p[_WINDOW.band]
    slope, least, most = 0.0, -np.inf, np.inf
    for back in range(1, used + 1):
        k = (head - back) & (_RING - 1)
        per_length = 1.0 / (now - p[_TIMES + k])
        candidate = (newest - p[first + k]) * per_length
        if candidate < least or candidate > most:
            break
        slope = candidate
        least = max(least, candidate - band * per_length)
        most = min(most, candidate + band * per_length)
    return slope


@njit
def _add(p: FloatArray, joint: int, head: int, before: int, reading: float) -> float:
    first, used = _READINGS + joint * _RING, _WINDOW.used_left + joint
    p[first + head] = reading
    if not abs(reading - p[first + before]) < JUMP:
        p[used] = 0.0
        return 0.0
    p[used] = min(p[used] + 1.0, p[_WINDOW.window])
    return plausible(end_fit(p, head, first, int(p[used])))


@stage
def window_stage(state: FloatArray, p: FloatArray) -> None:
    """Write QD_* from Q_*."""
    action, elapsed = next_reading(state, p)
    if action == KEEP:
        return
    before = int(p[_WINDOW.head])
    head = before if action == RESTART else (before + 1) & (_RING - 1)
    p[_WINDOW.head] = head
    if action == RESTART:
        p[_WINDOW.used_left], p[_WINDOW.used_right], p[_TIMES + head] = 0.0, 0.0, 0.0
        p[_READINGS + head], p[_READINGS + _RING + head] = state[sv.Q_LEFT], state[sv.Q_RIGHT]
        return
    p[_TIMES + head] = p[_TIMES + before] + elapsed
    state[sv.QD_LEFT] = _add(p, 0, head, before, state[sv.Q_LEFT])
    state[sv.QD_RIGHT] = _add(p, 1, head, before, state[sv.Q_RIGHT])


@dataclass(frozen=True, slots=True)
class AdaptiveWindow:
    """First-order adaptive windowing, end-fit: long windows at rest, short ones in quick movement.

    The estimate is the slope of the longest line that ends in the newest reading, begins in an
    older one, and passes all between them within a band of one encoder count (Janabi-Sharifi,
    Hayward, Chen: Discrete-time adaptive windowing for velocity estimation, IEEE TCST 8(6):1003,
    2000). All such lines share their end, so each reading allows an interval of slopes; keeping the
    intersection of these makes one pass over the window do what the paper's repeated checks do.

    Attributes:
        band: half width of the band about the line [rad]: one encoder count, since both the line's
            ends and each reading between them are off by up to half a count.
        window: longest window [steps], 1 to `LONGEST`; 20 has nearly all that 30 gain, at two
            thirds of the cost and of the lag at rest (`acus study velocity`).
    """

    band: float
    window: int = 20

    def stage(self) -> Stage:
        """Return the stage for a loop's table, with memory of its own."""
        parameters = packed(
            _WINDOW,
            np.zeros(3 * _RING),
            band=self.band * (1.0 + _ROUNDING),
            window=min(max(self.window, 1), LONGEST),
        )
        return Stage("velocity", window_stage, parameters)


# --- Kalman ---------------------------------------------------------------------------------------
class _JointAt(NamedTuple):
    """Memory of `Kalman` for one joint: its angle, and the covariance of (angle, velocity)."""

    angle: int = 0
    aa: int = 0
    av: int = 0
    vv: int = 0
    unused: int = 0


class _KalmanAt(NamedTuple):
    """Constants of `Kalman`; the joints' memories follow, left and right."""

    started: int = 0
    stamp: int = 0
    noise: int = 0
    density: int = 0


_KALMAN: Final = numbered(_KalmanAt)
_JOINT: Final = numbered(_JointAt)
_SPEED_AT_FIRST: Final = 1.0  # [rad/s] standard deviation of the velocity at the first reading


@njit
def _start(p: FloatArray, m: int, reading: float) -> None:
    p[m + _JOINT.angle] = reading
    p[m + _JOINT.aa], p[m + _JOINT.av] = p[_KALMAN.noise], 0.0
    p[m + _JOINT.vv] = _SPEED_AT_FIRST * _SPEED_AT_FIRST


@njit
def _update(p: FloatArray, m: int, reading: float, velocity: float, h: float) -> float:
    q, noise = p[_KALMAN.density], p[_KALMAN.noise]
    residual = reading - (p[m + _JOINT.angle] + velocity * h)
    if not abs(residual) < JUMP:
        _start(p, m, reading)
        return 0.0
    aa, av, vv = p[m + _JOINT.aa], p[m + _JOINT.av], p[m + _JOINT.vv]
    aa += h * (2.0 * av + h * (vv + q * h / 3.0))
    av += h * (vv + 0.5 * q * h)
    vv += q * h
    gain_a, gain_v = aa / (aa + noise), av / (aa + noise)
    p[m + _JOINT.angle] = reading - (1.0 - gain_a) * residual
    # (1 - gain) keeps the variances positive whatever is rounded: aa (1 - gain_a) = gain_a noise.
    p[m + _JOINT.aa], p[m + _JOINT.av] = gain_a * noise, gain_v * noise
    p[m + _JOINT.vv] = max(vv - gain_v * av, q * h * 1e-6)
    return plausible(velocity + gain_v * residual)


@stage
def kalman_stage(state: FloatArray, p: FloatArray) -> None:
    """Write QD_* from Q_*."""
    action, elapsed = next_reading(state, p)
    if action == KEEP:
        return
    left = len(_KALMAN)
    right = left + len(_JOINT)
    if action == RESTART:
        _start(p, left, state[sv.Q_LEFT])
        _start(p, right, state[sv.Q_RIGHT])
        return
    state[sv.QD_LEFT] = _update(p, left, state[sv.Q_LEFT], state[sv.QD_LEFT], elapsed)
    state[sv.QD_RIGHT] = _update(p, right, state[sv.Q_RIGHT], state[sv.QD_RIGHT], elapsed)


@dataclass(frozen=True, slots=True)
class Kalman:
    """Kalman filter for constant velocity, time-varying, quantisation taken as white noise Δ²/12.

    State (angle, velocity) driven by white acceleration of spectral density q [rad²/s³]: over a
    time h its covariance is q [[h³/3, h²/2], [h²/2, h]] (Bar-Shalom, Li, Kirubarajan 2001, section
    6.2.2). The covariance is carried along, so first readings, late ticks and gaps weigh as they
    should.

    Attributes:
        count: one encoder count Δ [rad]; the readings' variance is Δ²/12.
        density: spectral density of the acceleration that is expected [rad²/s³].
    """

    count: float
    density: float = 0.1

    def stage(self) -> Stage:
        """Return the stage for a loop's table, with memory of its own."""
        memory = np.zeros(2 * len(_JOINT))
        parameters = packed(_KALMAN, memory, noise=self.count**2 / 12.0, density=self.density)
        return Stage("velocity", kalman_stage, parameters)


# --- choice ---------------------------------------------------------------------------------------
_STAGES: Final[dict[VelocityMethod, Callable[[float], Stage]]] = {
    VelocityMethod.BACKWARD_DIFFERENCE: lambda count: BackwardDifference().stage(),
    VelocityMethod.FILTERED: lambda count: VelocityFilter().stage(),
    VelocityMethod.ALPHA_BETA: lambda count: AlphaBeta().stage(),
    VelocityMethod.FOAW: lambda count: AdaptiveWindow(count).stage(),
    VelocityMethod.KALMAN: lambda count: Kalman(count).stage(),
}


def velocity_stage(profile: DeviceProfile, method: VelocityMethod | None = None) -> Stage:
    """Return an estimator's stage for a loop's table, with memory of its own.

    It reads Q_*, Q_TIME, TIME and DT, and writes QD_*: zero at first and after a bad reading.

    Args:
        profile: gives the encoders' resolution, and the estimator.
        method: another estimator than the profile's.
    """
    return _STAGES[method or profile.velocity](2.0 * pi / profile.encoder.counts_per_turn)
