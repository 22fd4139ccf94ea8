"""The zone that one electrode ablates: a spheroid about the needle's axis, and depths in it.

Tables of generators give the long axis, along the needle, and the short one, across it; the zone is
taken as the ellipsoid of revolution with these two (as the tables' own volumes are). What a vessel
cools away is not in it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
from app.planning.errors import PlanError

_HALVINGS: Final = 46  # of a bracket a few half axes wide: to 1e-13 of them


@dataclass(frozen=True, slots=True, eq=False)
class Zone:
    """A spheroid.

    Attributes:
        centre_mm: LPS, shape (3,).
        axis: unit direction of its axis of revolution, shape (3,).
        half_long_mm: half axis along it.
        half_short_mm: half axis across it.

    Raises:
        PlanError: if an axis is not above 0, or no direction is given.
    """

    centre_mm: FloatArray
    axis: FloatArray
    half_long_mm: float
    half_short_mm: float

    def __post_init__(self) -> None:
        halves = self.half_long_mm, self.half_short_mm
        if not all(isfinite(half) and half > 0.0 for half in halves):
            raise PlanError(
                sentence(
                    "an ablated zone of {long:g} × {short:g} mm: both must be above 0",
                    long=2.0 * self.half_long_mm,
                    short=2.0 * self.half_short_mm,
                )
            )
        axis = np.asarray(self.axis, np.float64)
        length = float(np.linalg.norm(axis))
        if not (isfinite(length) and length > 1e-9):
            raise PlanError(sentence("the needle has no direction"))
        object.__setattr__(self, "axis", frozen(axis / length, (3,), "axis"))
        object.__setattr__(self, "centre_mm", frozen(self.centre_mm, (3,), "centre_mm"))

    @property
    def volume_mm3(self) -> float:
        """Return its volume."""
        return 4.0 / 3.0 * np.pi * self.half_long_mm * self.half_short_mm**2

    @property
    def box_mm(self) -> tuple[FloatArray, FloatArray]:
        """Return the lowest and highest corner that it reaches, each of shape (3,)."""
        across = np.sqrt(np.maximum(0.0, 1.0 - self.axis**2))
        reach = np.hypot(self.half_long_mm * self.axis, self.half_short_mm * across)
        return self.centre_mm - reach, self.centre_mm + reach

    def depths_mm(self, points_mm: ArrayLike) -> FloatArray:
        """Return how deep points lie below its surface, negative outside, shape (n, 3) -> (n,)."""
        return self._nearest(np.asarray(points_mm, np.float64).reshape(-1, 3))[1]

    def nearest_mm(self, points_mm: ArrayLike) -> FloatArray:
        """Return the places of its surface that are nearest to points, shape (n, 3)."""
        return self._nearest(np.asarray(points_mm, np.float64).reshape(-1, 3))[0]

    def about_mm(self, points_mm: ArrayLike) -> FloatArray:
        """Return `depths_mm` to first order: exact on the surface, and everywhere in a ball."""
        away = np.asarray(points_mm, np.float64).reshape(-1, 3) - self.centre_mm
        along = away @ self.axis
        across = np.sqrt(np.maximum(0.0, (away * away).sum(axis=1) - along * along))
        u, v = along / self.half_long_mm, across / self.half_short_mm
        level = np.hypot(u, v)
        steep = np.hypot(u / self.half_long_mm, v / self.half_short_mm)
        least = min(self.half_long_mm, self.half_short_mm)
        safe = np.maximum(steep, 1e-12)
        return np.where(level > 1e-9, (1.0 - level) * level / safe, least)

    def surface_mm(self, step_mm: float) -> FloatArray:
        """Return places spread over its surface, about `step_mm` apart, shape (n, 3)."""
        count = max(64, int(np.ceil(4.0 * np.pi * (self._largest / step_mm) ** 2)))
        n = np.arange(count) + 0.5
        polar = np.arccos(1.0 - 2.0 * n / count)
        turn = np.pi * (1.0 + 5.0**0.5) * n
        first, second = self.across()
        along = self.half_long_mm * np.cos(polar)
        out = self.half_short_mm * np.sin(polar)
        return np.asarray(
            self.centre_mm
            + along[:, None] * self.axis
            + (out * np.cos(turn))[:, None] * first
            + (out * np.sin(turn))[:, None] * second
        )

    @property
    def _largest(self) -> float:
        return max(self.half_long_mm, self.half_short_mm)

    def across(self) -> tuple[FloatArray, FloatArray]:
        """Return two unit directions across its axis and each other, each of shape (3,)."""
        first = np.cross(self.axis, np.eye(3)[int(np.argmin(np.abs(self.axis)))])
        first /= np.linalg.norm(first)
        return first, np.cross(self.axis, first)

    def _nearest(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Nearest places of the surface, shape (n, 3), and depths below it, shape (n,).

        In the plane of a point and the axis the surface is an ellipse with half axes e0 >= e1. Of
        its nearest point x_i = e_i^2 y_i / (t + e_i^2), with the one root t >= -e1^2 of
        sum (e_i y_i / (t + e_i^2))^2 = 1 (Eberly, Distance from a point to an ellipse, 2013), which
        is bracketed and halved; nothing there divides by what may vanish.
        """
        away = points - self.centre_mm
        along = away @ self.axis
        side = away - along[:, None] * self.axis
        across = np.linalg.norm(side, axis=1)
        first, _ = self.across()
        off = across > 1e-12
        out = np.where(off[:, None], side / np.where(off, across, 1.0)[:, None], first)
        y = np.stack([np.abs(along), across])
        e = np.array([self.half_long_mm, self.half_short_mm])
        order = np.argsort(-e, kind="stable")
        x = np.empty_like(y)
        x[order] = _on_ellipse(e[order], y[order])
        at = x[0] * np.where(along < 0.0, -1.0, 1.0)
        nearest = self.centre_mm + at[:, None] * self.axis + x[1][:, None] * out
        distance = np.hypot(x[0] - y[0], x[1] - y[1])
        inside = np.hypot(y[0] / e[0], y[1] / e[1]) < 1.0
        return nearest, np.where(inside, distance, -distance)


def _on_ellipse(e: FloatArray, y: FloatArray) -> FloatArray:
    """Return the points of an ellipse nearest to `y`, both in the first quadrant, shape (2, n)."""
    e0, e1 = float(e[0]), float(e[1])
    z = y / e[:, None]
    ratio = (e0 / e1) ** 2
    # s = t / e1^2 + 1 >= 0; in it the equation is (ratio z0 / (s + ratio - 1))^2 + (z1 / s)^2 = 1
    low = z[1].copy()
    high = np.hypot(ratio * z[0], z[1])
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        left = ratio * z[0] / np.maximum(middle + ratio - 1.0, 1e-300)
        right = np.where(z[1] > 0.0, z[1] / np.maximum(middle, 1e-300), 0.0)
        beyond = left * left + right * right > 1.0
        low, high = np.where(beyond, middle, low), np.where(beyond, high, middle)
    s = 0.5 * (low + high)
    x0 = np.minimum(ratio * y[0] / np.maximum(s + ratio - 1.0, 1e-300), e0)
    x1 = np.where(z[1] > 0.0, y[1] / np.maximum(s, 1e-300), 0.0)
    # On the long axis near the middle the nearest point lies off it, and s says little: there x0
    # is what is known. In a ball it is the other way about.
    flat = (z[1] <= 0.0) | ((s < 1e-5) & (ratio > 1.0 + 1e-3))
    x1 = np.where(flat, e1 * np.sqrt(np.maximum(0.0, 1.0 - (x0 / e0) ** 2)), x1)
    level = np.hypot(x0 / e0, x1 / e1)
    none = ~(np.isfinite(level) & (level > 1e-9))
    x0, x1 = np.where(none, 0.0, x0), np.where(none, e1, x1)
    return np.stack([x0, x1]) / np.where(none, 1.0, level)
