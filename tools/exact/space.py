"""Rotations, directions and distances in many digits."""

from math import pi
from typing import Any

import mpmath  # type: ignore[import-untyped]
from mpmath import matrix

from tools.exact import exact


def cross(a: Any, b: Any) -> Any:
    """Cross product."""
    return matrix([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def skew(v: Any) -> Any:
    """Cross-product matrix."""
    return matrix([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def rotation(v: Any) -> Any:
    """Rodrigues' formula as it stands in books."""
    angle = mpmath.norm(v)
    k = skew(v / angle)
    return mpmath.eye(3) + mpmath.sin(angle) * k + (1 - mpmath.cos(angle)) * (k * k)


def angle(a: Any, b: Any) -> Any:
    """Angle between two vectors."""
    return mpmath.atan2(mpmath.norm(cross(a, b)), mpmath.fdot(a, b))


def flat(m: Any) -> list[Any]:
    """Entries row by row."""
    return [m[i, j] for i in range(m.rows) for j in range(m.cols)]


for size, words in ((1e-8, "1e-8"), (1e-160, "1e-160"), (pi - 1e-9, "1e-9 short of half a turn")):

    @exact(f"rotation by {words}", "Rodrigues", 0.36 * size, -0.48 * size, 0.8 * size)
    def _(*v: Any) -> Any:
        return flat(rotation(matrix(v)))


@exact(
    "left jacobian at 2e-4 rad", "∫ exp(s ω) ds of a shift", 1.0, -2.0, 3.0, 1.2e-4, -9e-5, 1.3e-4
)
def _(*twist: Any) -> Any:
    shift, omega = matrix(twist[:3]), matrix(twist[3:])
    a, w = mpmath.norm(omega), skew(omega)
    b, c = (1 - mpmath.cos(a)) / a**2, (a - mpmath.sin(a)) / a**3
    return (mpmath.eye(3) + b * w + c * (w * w)) * shift


for off, words in ((1e-9, "1e-9 apart"), (1e-150, "1e-150 apart")):

    @exact(f"angle of directions {words}", "atan2(|a × b|, a · b)", off, -0.5 * off, -1.0)
    def _(*a: Any) -> Any:
        return [angle(matrix(a), matrix([0, 0, -1]))]


@exact("angle of directions 1e-9 short of opposite", "atan2(|a × b|, a · b)", 1e-9, -5e-10, 1.0)
def _(*a: Any) -> Any:
    return [angle(matrix(a), matrix([0, 0, -1]))]


@exact("smallest turn between directions 1e-7 short of opposite", "u onto v", 1e-7, 2e-7, 1.0)
def _(*a: Any) -> Any:
    u, v = matrix([0, 0, -1]), matrix(a)
    v = v / mpmath.norm(v)
    axis = cross(u, v)
    return axis / mpmath.norm(axis) * angle(u, v)
