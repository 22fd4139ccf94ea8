"""A path of the arm's joints, and what is certain about it between the places that are looked at.

A path is a cubic spline q(s) through knots (two knots: a straight line of the joints). What is
fixed to the tool, seen from the world, has the second derivative along s

    |p''| ≤ Σ_i Σ_j |q'_i| |q'_j| d_max(i,j) + Σ_i |q''_i| d_i,

d_i its distance from axis i: of two turns, the one nearer to the point is a lever of the other. A
point of the world seen from the tool is the same with the chain turned round (d_min(i,j)), and a
direction of length one has every d = 1. Whatever has a second derivative below M lies within
M h² / 8 of its chord over a step h: so a few places looked at bound all between.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline

from app.arm.mechanics import ArmProfile
from app.arm.mechanics.kernels import forward_kernel
from app.arm.mechanics.profile import JOINTS
from app.arm.motion.errors import MotionError
from app.core.arrays import FloatArray, frozen, read_only
from app.core.compiled import njit
from app.core.messages import sentence

FINE: Final = 4
"""Places looked at in each interval of a path's knots."""

_NEARER: Final = np.maximum.outer(np.arange(JOINTS), np.arange(JOINTS))
_FARTHER: Final = np.minimum.outer(np.arange(JOINTS), np.arange(JOINTS))


@dataclass(frozen=True, slots=True, eq=False)
class JointPath:
    """Joint angles along a parameter.

    Attributes:
        s: parameter at the knots, ascending, shape (n,); whatever the maker says, mostly 0 to 1.
        q: joint angles there [rad], shape (n, 7).

    Raises:
        MotionError: if there are fewer than two knots, or s does not ascend.
    """

    s: FloatArray
    q: FloatArray
    _spline: Any = field(init=False, repr=False)

    def __post_init__(self) -> None:
        s = frozen(self.s, name="s")
        q = frozen(self.q, (len(s), JOINTS), "q")
        if len(s) < 2 or not (np.diff(s) > 0.0).all():
            raise MotionError(
                sentence("a path needs two knots or more, ascending; s is {s}", s=s.tolist())
            )
        object.__setattr__(self, "s", s)
        object.__setattr__(self, "q", q)
        object.__setattr__(self, "_spline", CubicSpline(s, q))

    @classmethod
    def straight(cls, start: ArrayLike, goal: ArrayLike) -> JointPath:
        """Return the straight line of the joints, s from 0 to 1."""
        return cls(np.array([0.0, 1.0]), np.array([start, goal], dtype=np.float64))

    def at(self, s: ArrayLike, order: int = 0) -> FloatArray:
        """Joint angles at s, or their derivative by s of an order up to 3; shape (..., 7)."""
        result: FloatArray = self._spline(s, order)
        return result

    def places(self, fine: int = FINE) -> FloatArray:
        """Return the knots, and `fine` - 1 places evenly between any two, ascending."""
        share = np.arange(fine) / fine
        between = self.s[:-1, None] + np.diff(self.s)[:, None] * share
        return np.append(between.ravel(), self.s[-1])

    @property
    def length(self) -> float:
        """Length of the path in the space of joints, Euclidean [rad]."""
        q = self.at(self.places())
        return float(np.linalg.norm(np.diff(q, axis=0), axis=1).sum())


@dataclass(frozen=True, slots=True, eq=False)
class Bends:
    """A path at some places, and how fast it can bend in the steps between.

    Attributes:
        s: the places, shape (n,).
        q: joint angles there [rad], shape (n, 7).
        rotation, position: of the wrist in the base's frame, (n, 3, 3) and (n, 3) [m].
        centres: a point on the axis of each joint in the base's frame [m], (n, 7, 3).
        speeds: at most |q'| in the step that begins there, (n - 1, 7).
        second: at most |q''|, (n - 1, 7).
    """

    s: FloatArray
    q: FloatArray
    rotation: FloatArray
    position: FloatArray
    centres: FloatArray
    speeds: FloatArray
    second: FloatArray

    @classmethod
    def of(cls, arm: ArmProfile, path: JointPath, fine: int = FINE) -> Bends:
        """Look at a path."""
        s = path.places(fine)
        q = path.at(s)
        rotation, position = wrists(arm, q)
        step = np.diff(s)[:, None]
        first, second = np.abs(path.at(s, 1)), np.abs(path.at(s, 2))
        third = np.abs(path.at(0.5 * (s[1:] + s[:-1]), 3))
        speeds = np.maximum(first[1:], first[:-1]) + third * step**2 / 8.0
        # q'' is linear in a step, but jumps not even at the knots: its ends bound it
        return cls(
            s,
            q,
            rotation,
            position,
            axis_points(arm, q, position),
            read_only(speeds),
            read_only(np.maximum(second[1:], second[:-1])),
        )

    def fixed_to_tool(self, at_wrist: FloatArray) -> FloatArray:
        """Bound, per step, of |p''| of a point given in the wrist's frame [m], (3,) -> (n - 1,)."""
        there = self.position + self.rotation @ at_wrist
        return self._bound(there, _NEARER)

    def fixed_to_base(self, p_base: FloatArray) -> FloatArray:
        """Bound, per step, of |c''| of a point of the base's frame [m] as the tool sees it."""
        return self._bound(np.broadcast_to(p_base, self.position.shape), _FARTHER)

    def direction(self) -> FloatArray:
        """Bound, per step, of the second derivative of any unit vector fixed to the tool."""
        return self.speeds.sum(axis=1) ** 2 + self.second.sum(axis=1)

    def _bound(self, p_base: FloatArray, lever: Any) -> FloatArray:
        away = np.linalg.norm(self.centres - p_base[:, None, :], axis=2)
        reach = away.max(axis=1, keepdims=True)
        moved = self.speeds.sum(axis=1, keepdims=True) * np.diff(self.s)[:, None]
        # a distance changes by at most the turn times the longest lever; e^x - 1 as that grows too
        slack = np.expm1(moved) * np.maximum(reach[1:], reach[:-1])
        levers = np.maximum(away[1:], away[:-1]) + slack
        pairs = np.einsum("ni,nj,nij->n", self.speeds, self.speeds, levers[:, lever])
        return np.asarray(pairs + (self.second * levers).sum(axis=1))

    def between(self, at_places: FloatArray, bound: FloatArray) -> FloatArray:
        """Bound of what is `at_places` (n,) at the places, per step: its larger end + M h² / 8."""
        ends = np.maximum(at_places[1:], at_places[:-1])
        return np.asarray(ends + bound * np.diff(self.s) ** 2 / 8.0)


@njit
def _wrists(
    q: FloatArray,
    lengths: tuple[float, float, float],
    rotation: FloatArray,
    position: FloatArray,
) -> None:
    for k in range(len(q)):
        forward_kernel(q[k], lengths, rotation[k], position[k])


def wrists(arm: ArmProfile, q: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Rotations (n, 3, 3) and positions (n, 3) [m] of the wrist in the base's frame, q (n, 7)."""
    rotation, position = np.empty((len(q), 3, 3)), np.empty((len(q), 3))
    _wrists(np.ascontiguousarray(q), arm.lengths, rotation, position)
    return rotation, position


def axis_points(arm: ArmProfile, q: FloatArray, wrist: FloatArray) -> FloatArray:
    """Return a point on each joint's axis in the base's frame [m], (n, 7, 3)."""
    points = np.empty((len(q), JOINTS, 3))
    points[:, :3] = (0.0, 0.0, arm.pedestal)
    sine = np.sin(q[:, 1])
    upwards = np.stack([np.cos(q[:, 0]) * sine, np.sin(q[:, 0]) * sine, np.cos(q[:, 1])], axis=1)
    points[:, 3] = points[:, 0] + arm.upper_arm * upwards
    points[:, 4:] = wrist[:, None, :]
    return points
