"""Tubes of the phantom: vessels, gut and airways as chains of overlapping balls."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit

_OVERLAP: Final = 0.4
"""Distance between balls, as a share of their radius."""


@dataclass(frozen=True, slots=True, eq=False)
class Tubes:
    """Balls: centre and radius [mm], shape (n, 4), model coordinates."""

    balls: FloatArray

    def discs(self, z: float, shrink: float = 0.0) -> FloatArray:
        """Cut at a height: centre and radius (x, y, r) of the discs, shape (m, 3).

        Args:
            z: the height [mm].
            shrink: taken off the radius of every ball [mm]: the lumen of a tube with a wall.
        """
        radius = self.balls[:, 3] - shrink
        square = radius * np.abs(radius) - (self.balls[:, 2] - z) ** 2
        cut = np.flatnonzero(square > 0.0)
        return np.column_stack([self.balls[cut, :2], np.sqrt(square[cut])])

    def distance(self, points: FloatArray) -> FloatArray:
        """Signed distance of points, shape (n, 3) -> (n,), to the nearest ball."""
        if not len(self.balls):
            return np.full(len(points), np.inf)
        gap = np.linalg.norm(points[:, None] - self.balls[None, :, :3], axis=2) - self.balls[:, 3]
        result: FloatArray = gap.min(axis=1)
        return result


def joined(parts: Iterable[Tubes]) -> Tubes:
    """Put several tubes together."""
    return Tubes(np.vstack([np.empty((0, 4)), *(part.balls for part in parts)]))


def tube(knots: Any, radii: Any) -> Tubes:
    """Smooth tube through knots (n, 3), its radius interpolated between `radii` (n,)."""
    points, widths = np.asarray(knots, np.float64), np.asarray(radii, np.float64)
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    step = max(0.35, _OVERLAP * float(widths.min()))
    along = np.linspace(0.0, length[-1], max(2, int(length[-1] / step) + 1))
    return Tubes(
        np.column_stack([_smooth(length, points, along), np.interp(along, length, widths)])
    )


def _smooth(s: FloatArray, values: FloatArray, at: FloatArray) -> FloatArray:
    """Cubic Hermite interpolation of rows of `values` with finite-difference slopes."""
    chords = np.diff(values, axis=0) / np.diff(s)[:, None]
    slopes = np.vstack([chords[:1], 0.5 * (chords[1:] + chords[:-1]), chords[-1:]])
    n = np.minimum(np.searchsorted(s, at, side="right") - 1, len(s) - 2)
    h = (s[n + 1] - s[n])[:, None]
    t = (at - s[n])[:, None] / h
    t2, t3 = t * t, t * t * t
    result: FloatArray = (
        (2 * t3 - 3 * t2 + 1) * values[n]
        + (t3 - 2 * t2 + t) * h * slopes[n]
        + (3 * t2 - 2 * t3) * values[n + 1]
        + (t3 - t2) * h * slopes[n + 1]
    )
    return result


@njit
def cover_discs(
    coverage: Any, x0: float, y0: float, step_x: float, step_y: float, discs: Any
) -> None:
    """Raise `coverage` (rows, columns) to the share of each pixel that the discs cover.

    Pixel (row, column) lies at (x0 + column · step_x, y0 + row · step_y); discs are (x, y, r).
    """
    rows, columns = coverage.shape
    for n in range(discs.shape[0]):
        x, y, r = discs[n, 0], discs[n, 1], discs[n, 2]
        for row in range(
            max(0, int((y - r - y0) / step_y)), min(rows, int((y + r - y0) / step_y) + 2)
        ):
            dy = y0 + row * step_y - y
            left, right = int((x - r - x0) / step_x), int((x + r - x0) / step_x) + 2
            for column in range(max(0, left), min(columns, right)):
                dx = x0 + column * step_x - x
                share = 0.5 - ((dx * dx + dy * dy) ** 0.5 - r) / step_x
                share = min(1.0, max(0.0, share))
                if share > coverage[row, column]:
                    coverage[row, column] = share
