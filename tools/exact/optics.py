"""Points from two pictures, and lenses, in many digits."""

from typing import Any

import mpmath  # type: ignore[import-untyped]
import numpy as np
from mpmath import matrix, mpf

from app.core.transform import RigidTransform
from tools.exact import exact

LENS = (-0.091006, 2.735876, -0.001135, -0.004749, -20.789586)
"""Of the laboratory's first camera: its map folds at a radius of 0.47."""

TURNED = RigidTransform.exp([-0.2, 0.01, 0.08, 0.05, 0.8, -0.02])
"""A second camera, turned by 46° about y."""


def distort(x: Any, y: Any, c: Any) -> list[Any]:
    """Brown's model as OpenCV has it."""
    k1, k2, p1, p2, k3 = c
    r2 = x**2 + y**2
    radial = 1 + k1 * r2 + k2 * r2**2 + k3 * r2**3
    return [
        x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x**2),
        y * radial + p1 * (r2 + 2 * y**2) + 2 * p2 * x * y,
    ]


for depth in (1.0, 100.0, 10_000.0):
    seen = 0.1, -0.05, 0.1 - 0.2 / depth

    @exact(f"point {depth:g} m away from a baseline of 0.2 m", "Z = b / (x₁ - x₂)", *seen)
    def _(x: Any, y: Any, second: Any) -> Any:
        z = mpf(0.2) / (x - second)
        return [x * z, y * z, z]


POINT = np.array([0.01, -0.005, 0.3])
BESIDE = TURNED @ POINT
SKEW = (
    POINT[0] / POINT[2],
    POINT[1] / POINT[2],
    BESIDE[0] / BESIDE[2],
    BESIDE[1] / BESIDE[2] + 0.04,
)
"""Normalised coordinates in both pictures of what is no point: the rays pass 12 mm apart."""


@exact(
    "point of two skew rays",
    "stationary sum of squared reprojection errors, Newton",
    *TURNED.rotation.ravel().tolist(),
    *TURNED.translation.tolist(),
    *map(float, SKEW),
)
def _(*v: Any) -> Any:
    rotation, shift = mpmath.matrix(3, 3), matrix(v[9:12])
    for i in range(9):
        rotation[i // 3, i % 3] = v[i]
    x1, y1, x2, y2 = v[12:]

    def gradient(*p: Any) -> list[Any]:
        total = [mpf(0)] * 3
        for r, t, x, y in ((mpmath.eye(3), matrix([0, 0, 0]), x1, y1), (rotation, shift, x2, y2)):
            c = r * matrix(p) + t
            ex, ey = c[0] / c[2] - x, c[1] / c[2] - y
            for k in range(3):
                dx = (r[0, k] * c[2] - c[0] * r[2, k]) / c[2] ** 2
                dy = (r[1, k] * c[2] - c[1] * r[2, k]) / c[2] ** 2
                total[k] += ex * dx + ey * dy
        return total

    return mpmath.findroot(gradient, tuple(map(mpf, POINT)), tol=1e-200, maxsteps=60)


for words, radius in (("0.40", 0.40), ("0.46, at the edge of the fold", 0.46)):
    place = np.array(distort(radius * 0.8, radius * 0.6, LENS), dtype=float)
    start = radius * 0.8, radius * 0.6

    @exact(f"ray of a distorted point at a radius of {words}", "Newton", *place.tolist(), *start)
    def _(x: Any, y: Any, *near: Any) -> Any:
        def off(a: Any, b: Any) -> list[Any]:
            found = distort(a, b, [mpf(k) for k in LENS])
            return [found[0] - x, found[1] - y]

        return mpmath.findroot(off, near, tol=1e-200, maxsteps=60)
