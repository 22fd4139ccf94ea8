"""When a path is where: the fastest motion within limits of speed, acceleration and jerk.

Along a straight line of the joints, from rest to rest, the fastest motion has one profile for all
joints, which Ruckig gives exactly. Along a curved path q(s) it is

    q̇ = q' ṡ,   q̈ = q'' ṡ² + q' s̈,   q⃛ = q''' ṡ³ + 3 q'' ṡ s̈ + q' s⃛.

The path is cut into blocks; each has limits of ṡ, s̈ and s⃛ that keep every joint's within its own
wherever in the block (shares of each limit go to each term), the speeds at the cuts are the largest
from which the next can be reached, at no acceleration, and Ruckig gives the fastest profile in each
block. Of several numbers of blocks and shares the fastest is taken: exact for a straight line, an
upper bound of the least time for a curved one. `free_move` is the fastest of all between two
postures, each joint for itself: for where nothing is in the way, as its path is not straight.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from app.arm.mechanics import ArmProfile
from app.arm.mechanics.kinematics import seven
from app.arm.motion.errors import MotionError, PlannerMissingError
from app.arm.motion.path import JointPath
from app.core.arrays import FloatArray, frozen, read_only
from app.core.extras import not_installed
from app.core.messages import sentence

BLOCKS: Final = (1, 2, 4, 8, 16, 32)
"""Numbers of blocks tried."""

SHARES: Final = (0.5, 0.8)
"""Shares of an acceleration tried for what the path's bend takes at full speed."""

_SHARE_JERK: Final = 1.0 / 3.0  # of a jerk, for each of its three terms
_FAR: Final = 1e3  # times what can be reached
_TOUCH: Final = 1e-9  # of a speed, as room for rounding at the cuts


@dataclass(frozen=True, slots=True, eq=False)
class TimeProfile:
    """Polynomials of third degree one after the other.

    Attributes:
        t: where each begins, and where the last ends [s], shape (n + 1,).
        terms: value, first, second and third derivative at its begin, shape (n, 4, m).
    """

    t: FloatArray
    terms: FloatArray

    def at(self, t: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Value and three derivatives at times [s], shape (k,) -> (k, m) each."""
        part = np.clip(np.searchsorted(self.t, t, "right") - 1, 0, len(self.terms) - 1)
        h = (t - self.t[part])[:, None]
        x, v, a, j = (self.terms[part, order] for order in range(4))
        return (
            x + h * (v + h * (a / 2.0 + h * j / 6.0)),
            v + h * (a + h * j / 2.0),
            a + h * j,
            j,
        )


@dataclass(frozen=True, slots=True, eq=False)
class JointMotion:
    """A path with times, or a free move of each joint for itself.

    Attributes:
        profile: of the path's parameter, m = 1; without a path of the joints themselves, m = 7.
        path: the path.
    """

    profile: TimeProfile
    path: JointPath | None

    @property
    def duration(self) -> float:
        """Return how long it takes [s]."""
        return float(self.profile.t[-1])

    def at(self, t: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Joint angles [rad], speeds, accelerations and jerks at times [s], (k,) -> (k, 7) each."""
        s, v, a, j = self.profile.at(np.atleast_1d(np.asarray(t, dtype=np.float64)))
        if self.path is None:
            return s, v, a, j
        d0, d1, d2, d3 = (self.path.at(s[:, 0], order) for order in range(4))
        return d0, d1 * v, d2 * v**2 + d1 * a, d3 * v**3 + 3.0 * d2 * v * a + d1 * j

    def use_of_limits(self, arm: ArmProfile, step: float = 1e-3) -> FloatArray:
        """Largest share of each joint's speed, acceleration and jerk that is used, (3, 7)."""
        _, v, a, j = self.at(np.append(np.arange(0.0, self.duration, step), self.duration))
        limits = (arm.speed, arm.acceleration, arm.jerk)
        return np.array(
            [np.abs(x).max(axis=0) / most for x, most in zip((v, a, j), limits, strict=True)]
        )


def import_ruckig() -> Any:
    """Import Ruckig.

    Raises:
        PlannerMissingError: if it is not installed; names the extra.
    """
    try:
        import ruckig
    except ImportError as error:
        raise not_installed(PlannerMissingError, "Ruckig", "arm") from error
    return ruckig


def timed(arm: ArmProfile, path: JointPath, scale: float = 1.0) -> JointMotion:
    """Move along a path from rest to rest within the arm's limits.

    Args:
        arm: its limits.
        path: the path.
        scale: share of the speed limits that is used, in (0, 1].

    Raises:
        PlannerMissingError: if Ruckig is not installed.
        MotionError: if the scale is not in (0, 1], or the path does not move.
    """
    if not 0.0 < scale <= 1.0:
        raise MotionError(
            sentence("a scale of {scale} was asked for; it must be in (0, 1]", scale=scale)
        )
    if not np.ptp(path.q, axis=0).max() > 0.0:
        raise MotionError(sentence("the path does not move: it has one posture only"))
    ways = [(1, 0.0)] if len(path.s) == 2 else [(n, share) for n in BLOCKS for share in SHARES]
    found = [_timed(arm, path, count, share, scale) for count, share in ways]
    return JointMotion(min(found, key=lambda one: float(one.t[-1])), path)


def free_move(arm: ArmProfile, start: ArrayLike, goal: ArrayLike) -> JointMotion:
    """Move from a posture to another, both at rest, in the least time that the limits allow.

    Args:
        arm: its limits.
        start: joint angles [rad], shape (7,).
        goal: joint angles [rad], shape (7,).

    Raises:
        PlannerMissingError: if Ruckig is not installed.
        MotionError: if Ruckig finds none.
    """
    zero = np.zeros(7)
    begin, end = (seven(start, "start"), zero), (seven(goal, "goal"), zero)
    return JointMotion(_ruckig(begin, end, arm.speed, arm.acceleration, arm.jerk), None)


def _timed(
    arm: ArmProfile, path: JointPath, count: int, turning: float, scale: float
) -> TimeProfile:
    cuts = np.linspace(path.s[0], path.s[-1], count + 1)
    limits = _limits(arm, path, cuts, turning, scale)
    speeds = _speeds(np.diff(cuts), limits)
    parts = [
        _ruckig(
            (cuts[k : k + 1], speeds[k : k + 1]),
            (cuts[k + 1 : k + 2], speeds[k + 1 : k + 2]),
            limits[k, :1],
            limits[k, 1:2],
            limits[k, 2:],
        )
        for k in range(count)
    ]
    begins = np.concatenate([[0.0], np.cumsum([part.t[-1] for part in parts])])
    times = [part.t[:-1] + begin for part, begin in zip(parts, begins, strict=False)]
    return TimeProfile(
        read_only(np.append(np.concatenate(times), begins[-1])),
        read_only(np.concatenate([part.terms for part in parts])),
    )


def _limits(
    arm: ArmProfile, path: JointPath, cuts: FloatArray, turning: float, scale: float
) -> FloatArray:
    """Largest ṡ, s̈ and s⃛ in each block, shape (n, 3), for all joints and places in it."""
    # pieces of the spline, cut at the blocks' ends: in each q''' is even, q'' linear
    s = np.unique(np.concatenate([path.s, cuts]))
    middle, step = 0.5 * (s[1:] + s[:-1]), np.diff(s)[:, None]
    block = np.searchsorted(cuts, middle) - 1
    third = np.abs(path.at(middle, 3))
    second = np.abs(path.at(middle, 2)) + 0.5 * step * third
    ends = np.abs(path.at(s, 1))
    first = np.maximum(ends[1:], ends[:-1]) + third * step**2 / 8.0
    out = np.empty((len(cuts) - 1, 3))
    for k in range(len(out)):
        d1, d2, d3 = (x[block == k].max(axis=0) for x in (first, second, third))
        rest = _SHARE_JERK if turning else 1.0
        with np.errstate(divide="ignore"):
            v = float((scale * arm.speed / d1).min())
            a = float(((1.0 - turning) * arm.acceleration / d1).min())
            j = float((rest * arm.jerk / d1).min())
            if turning:
                v = min(v, float(np.sqrt(turning * arm.acceleration / d2).min()))
                v = min(v, float(np.cbrt(rest * arm.jerk / d3).min()))
                a = min(a, float((rest * arm.jerk / (3.0 * d2 * v)).min()))
        out[k] = v, a, j
    return out


def _speeds(lengths: FloatArray, limits: FloatArray) -> FloatArray:
    """Largest speeds at the cuts between which the blocks' limits allow to change, (n + 1,)."""
    speeds = np.zeros(len(lengths) + 1)
    speeds[1:-1] = (1.0 - _TOUCH) * np.minimum(limits[1:, 0], limits[:-1, 0])
    for k in range(len(lengths)):
        speeds[k + 1] = min(speeds[k + 1], _reached(speeds[k], lengths[k], limits[k]))
    for k in reversed(range(len(lengths))):
        speeds[k] = min(speeds[k], _reached(speeds[k + 1], lengths[k], limits[k]))
    return speeds


def _reached(slow: float, length: float, limits: FloatArray) -> float:
    """Largest speed that a length allows to reach from a slower one, at no acceleration at ends."""
    most, acceleration, jerk = limits.tolist()

    def needed(fast: float) -> float:
        rise = fast - slow
        if rise >= acceleration**2 / jerk:
            time = rise / acceleration + acceleration / jerk
        else:
            time = 2.0 * np.sqrt(rise / jerk)
        return 0.5 * (fast + slow) * float(time)

    if most <= slow or needed(most) <= length:
        return max(most, slow)
    low, high = slow, most
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if needed(middle) <= length else (low, middle)
    return slow + (1.0 - _TOUCH) * (low - slow)


def _ruckig(
    start: tuple[FloatArray, FloatArray],
    goal: tuple[FloatArray, FloatArray],
    speed: FloatArray,
    acceleration: FloatArray,
    jerk: FloatArray,
) -> TimeProfile:
    """Return Ruckig's fastest profile between places and speeds, no acceleration at the ends.

    Asked in units of the way and of the time that it takes by jerk alone: Ruckig's tolerances are
    numbers without a unit, and a way of a nanoradian has limits of 1e9 of it.
    """
    way = goal[0] - start[0]
    length = float(np.abs(way).max()) or 1.0
    unit = float(np.cbrt(length / jerk.min()))
    orders = length / unit ** np.arange(4)  # of place, speed, acceleration, jerk
    ends = start[1] / orders[1], way / length, goal[1] / orders[1]
    # what is far above all that can be reached on the way is no limit
    most = [
        np.minimum(limit / order, _FAR * (1.0 + ends[0] + ends[2]))
        for limit, order in zip((speed, acceleration, jerk), orders[1:], strict=True)
    ]
    answer = _asked(*ends, *most)
    if isinstance(answer, str):
        raise MotionError(sentence("Ruckig finds no motion: {answer}", answer=answer))
    t, terms = answer
    terms *= orders[:, None]
    terms[:, 0] += start[0]
    return TimeProfile(frozen(unit * t), frozen(terms))


def _asked(
    begins: FloatArray,
    way: FloatArray,
    ends: FloatArray,
    speed: FloatArray,
    acceleration: FloatArray,
    jerk: FloatArray,
) -> tuple[FloatArray, FloatArray] | str:
    """Return times (n + 1,) and terms (n, 4, m) from place 0; or what Ruckig says against it."""
    ruckig, count = import_ruckig(), len(way)
    asked = ruckig.InputParameter(count)
    asked.current_position, asked.current_velocity = [0.0] * count, begins.tolist()
    asked.target_position, asked.target_velocity = way.tolist(), ends.tolist()
    asked.current_acceleration = asked.target_acceleration = [0.0] * count
    asked.max_velocity, asked.max_acceleration = speed.tolist(), acceleration.tolist()
    asked.max_jerk = jerk.tolist()
    found = ruckig.Trajectory(count)
    try:
        result = ruckig.Ruckig(count).calculate(asked, found)
    except ruckig.RuckigError as error:
        return str(error).splitlines()[0]
    if result not in (ruckig.Result.Working, ruckig.Result.Finished):
        return str(result)
    profiles = found.profiles[0]
    times = [np.cumsum([0.0, *one.t]) + one.brake.duration for one in profiles]
    t = np.unique(np.concatenate([*times, [0.0, found.duration]]).clip(0.0, found.duration))
    t = t[np.append(True, np.diff(t) > 1e-12)]
    t[-1] = found.duration
    terms = np.empty((len(t) - 1, 4, count))
    for k, (begin, end) in enumerate(pairwise(t)):
        terms[k, :3] = found.at_time(float(begin))
        for joint, one in enumerate(profiles):
            part = int(np.searchsorted(times[joint], 0.5 * (begin + end), "right")) - 1
            terms[k, 3, joint] = one.j[part] if 0 <= part < 7 else 0.0
    return t, terms
