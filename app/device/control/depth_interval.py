"""Between which depths the tip is: what safety may rely on where a depth is an estimate.

The cameras' depth is true to 4 standard deviations when the picture is taken, what the calibration
leaves included; from then on the needle slides as fast as a hand moves it. With d the depth, s its
standard deviation, v that speed and a the age of the fix,

    least, most = d ∓ (4 s + v a),     within the range of the profile,

which grows without a step until, from `hold` to `hold + blend`, it reaches the whole range. Without
a fix it is the whole range at once. A newer fix narrows it over `blend`, not in a step: between two
pictures the age goes up and down, and the force at its limit would hum with it.

The force at the hand is γ L_in / L_out for a force γ at the tool, so the deepest end of the
interval (the shortest L_out) is the worst for force; the hub of a needle let go moves with
L_out / L_in, so the other end is the worst for its speed.

What cannot be seen is an error that is the same in every picture (a needle shorter than the profile
says, a band that has slipped): the force is then wrong by error / L_out, and no interval says so.
"""

from dataclasses import dataclass
from math import isfinite, sqrt
from typing import Final, NamedTuple

import numpy as np

from app.core import staleness
from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import Stage, numbered, packed
from app.mechanisms.profile import DeviceProfile

SIGMAS: Final = 4.0
"""Standard deviations of a fix within which the true depth is taken to lie."""

SHORTEST: Final = 0.005
"""Smallest L_out [m] that anything is computed with."""


class _DepthIntervalPlaces(NamedTuple):
    """Range of the profile [m], the fields of `DepthInterval`, and memory."""

    low: int
    high: int
    speed: int
    hold: int
    blend: int
    started: int = 0
    least: int = 0
    most: int = 0


_AT: Final = numbered(_DepthIntervalPlaces)


@njit
def shortest_lever(state: FloatArray) -> float:
    """Smallest L_out [m] that the needle can have: that of the interval's deepest end."""
    length = state[sv.L_OUT] + state[sv.DEPTH]
    return min(max(length - state[sv.DEPTH_MOST], SHORTEST), state[sv.L_OUT])


@njit
def longest_lever(state: FloatArray) -> float:
    """Largest L_out [m] that the needle can have: that of the interval's other end."""
    length = state[sv.L_OUT] + state[sv.DEPTH]
    return max(length - state[sv.DEPTH_LEAST], state[sv.L_OUT])


@njit
def interval_kernel(
    depth: float,
    variance: float,
    age: float,
    low: float,
    high: float,
    speed: float,
    hold: float,
    blend: float,
) -> tuple[float, float]:
    """Depths between which the tip is [m]: (least, most).

    Args:
        depth: by the newest fix that counts [m].
        variance: of it [m²].
        age: of the fix [s]; infinity without one.
        low: least depth of the profile [m].
        high: largest depth of the profile [m].
        speed: fastest that a hand moves the needle along itself [m/s].
        hold: age up to which the interval grows by `speed` alone [s].
        blend: time after it in which the interval reaches the whole range [s].
    """
    if not (isfinite(depth) and isfinite(variance) and 0.0 <= age < hold + blend):
        return low, high
    half = SIGMAS * sqrt(max(variance, 0.0)) + speed * age
    half += max(age - hold, 0.0) / blend * (high - low)
    return max(depth - half, min(low, depth)), min(depth + half, max(high, depth))


@stage
def depth_stage(state: FloatArray, p: FloatArray) -> None:
    """Write DEPTH_LEAST and DEPTH_MOST from TRACKED_*."""
    age = abs(state[sv.TIME] - state[sv.TRACKED_TIME])  # a stamp in the future is as wrong as old
    if state[sv.TRACKED_TIME] == 0.0:
        age = np.inf
    least, most = interval_kernel(
        state[sv.TRACKED_DEPTH],
        state[sv.TRACKED_VARIANCE],
        age,
        p[_AT.low],
        p[_AT.high],
        p[_AT.speed],
        p[_AT.hold],
        p[_AT.blend],
    )
    if p[_AT.started] != 0.0:
        share = min(max(state[sv.DT], 0.0) / p[_AT.blend], 1.0)
        least = min(least, p[_AT.least] + share * (least - p[_AT.least]))
        most = max(most, p[_AT.most] + share * (most - p[_AT.most]))
    p[_AT.started], p[_AT.least], p[_AT.most] = 1.0, least, most
    state[sv.DEPTH_LEAST], state[sv.DEPTH_MOST] = least, most


@dataclass(frozen=True, slots=True)
class DepthInterval:
    """How far the depth can be from what was measured last.

    Attributes:
        depth_range: of the tip beyond the fulcrum, least and largest [m].
        speed: fastest that a hand moves the needle along itself [m/s].
        hold: age of a fix from which the whole range takes over [s].
        blend: time that it takes for it [s].
    """

    depth_range: tuple[float, float]
    speed: float
    hold: float = staleness.TRACKER_HOLD
    blend: float = 0.1

    @classmethod
    def of(cls, profile: DeviceProfile) -> "DepthInterval":
        """Interval of a device profile."""
        return cls(profile.depth_range, profile.hand.depth_speed)

    def stage(self) -> Stage:
        """Return the stage for a loop's table, with memory of its own."""
        low, high = self.depth_range
        parameters = packed(
            _AT, low=low, high=high, speed=self.speed, hold=self.hold, blend=self.blend
        )
        return Stage("depth", depth_stage, parameters)
