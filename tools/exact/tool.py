"""Principal axes of pixels and points where lines meet, in many digits."""

from math import cos, sin
from typing import Any

import mpmath  # type: ignore[import-untyped]
from mpmath import matrix, mpf

from tools.exact import exact

FOLDER = "app/arm/hard_cases"

FAR = 4.0e6
BLOB = tuple((FAR + 3.0 * cos(0.9 * k) + 1e-3 * k, FAR - 3.003 * sin(0.9 * k)) for k in range(7))
"""Pixels of an all but round blob, as far away as a mosaic of pictures is wide."""


@exact(
    "principal axis of an all but round blob far away",
    "½ atan2(2 C_xy, C_xx - C_yy), C with 1/(N - 1)",
    *(value for pixel in BLOB for value in pixel),
)
def _(*v: Any) -> Any:
    xs, ys = v[::2], v[1::2]
    n = len(xs)
    x, y = sum(xs) / n, sum(ys) / n
    xx = sum((a - x) ** 2 for a in xs) / (n - 1)
    yy = sum((b - y) ** 2 for b in ys) / (n - 1)
    xy = sum((a - x) * (b - y) for a, b in zip(xs, ys, strict=True)) / (n - 1)
    return [mpmath.atan2(2 * xy, xx - yy) / 2]


TURN = 1e-5
"""How far the grazing lines turn [rad]."""


def lines() -> tuple[float, ...]:
    """Point and direction of five lines that turn by 1e-5 rad and meet in no one point."""
    values: list[float] = []
    for k in range(5):
        lean_x, lean_y = TURN * cos(2.4 * k), TURN * sin(2.4 * k)
        values += [0.15 - 0.2 * lean_x, 0.02 - 0.2 * lean_y + 1e-9 * k, 0.3, lean_x, lean_y, -1.0]
    return tuple(values)


@exact(
    "point nearest to lines 1e-5 rad from parallel",
    "Σ (I - d dᵀ / d²) f = Σ (I - d dᵀ / d²) p",
    *lines(),
)
def _(*v: Any) -> Any:
    left, right = mpmath.zeros(3, 3), matrix([mpf(0)] * 3)
    for k in range(0, len(v), 6):
        p, d = matrix(v[k : k + 3]), matrix(v[k + 3 : k + 6])
        across = mpmath.eye(3) - d * d.T / (d.T * d)[0]
        left += across
        right += across * p
    return list(mpmath.lu_solve(left, right))
