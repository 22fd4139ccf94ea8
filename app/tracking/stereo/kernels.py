"""Compiled parts of the triangulation: it must cost a small part of a pair of pictures.

Arrays in, arrays out, in place; n cameras with rotations (n, 3, 3) and translations (n, 3) of
T_camera_world, observations (n, 2) in normalised coordinates, covariances of them (n, 2, 2).
"""

from typing import Any

import numpy as np

from app.core.compiled import njit

NEAREST = 1e-6
"""Depth [m] before a camera below which a point counts as not in front of it."""

_PARALLEL = 1e-6
_BASELINE = 1e-6
_STEPS = 10
_WORST = 1e-14

FOUND, DEGENERATE, AT_INFINITY, NOT_FINITE, BEHIND = 0, 1, 2, 3, 4
"""What `meet` returns, and behind a camera."""


@njit
def reproject(r: Any, t: Any, observed: Any, p: Any, residual: Any, jacobian: Any) -> float:
    """One camera's two rows of residual and Jacobian, in place; returns the depth [m]."""
    x = r[0, 0] * p[0] + r[0, 1] * p[1] + r[0, 2] * p[2] + t[0]
    y = r[1, 0] * p[0] + r[1, 1] * p[1] + r[1, 2] * p[2] + t[1]
    depth = r[2, 0] * p[0] + r[2, 1] * p[1] + r[2, 2] * p[2] + t[2]
    z = depth if abs(depth) > NEAREST else NEAREST
    x, y = x / z, y / z
    residual[0], residual[1] = observed[0] - x, observed[1] - y
    for k in range(3):
        jacobian[0, k] = (r[0, k] - x * r[2, k]) / z
        jacobian[1, k] = (r[1, k] - y * r[2, k]) / z
    return depth


@njit
def inverse3(a: Any, out: Any) -> bool:
    """Inverse of a symmetric positive definite matrix by cofactors; False if not safely that."""
    c00 = a[1, 1] * a[2, 2] - a[1, 2] * a[1, 2]
    c01 = a[0, 2] * a[1, 2] - a[0, 1] * a[2, 2]
    c02 = a[0, 1] * a[1, 2] - a[0, 2] * a[1, 1]
    determinant = a[0, 0] * c00 + a[0, 1] * c01 + a[0, 2] * c02
    scale = (a[0, 0] + a[1, 1] + a[2, 2]) / 3.0
    if not (scale > 0.0 and determinant > _WORST * scale**3 and np.isfinite(determinant)):
        return False
    out[0, 0], out[0, 1], out[0, 2] = c00, c01, c02
    out[1, 1] = a[0, 0] * a[2, 2] - a[0, 2] * a[0, 2]
    out[1, 2] = a[0, 1] * a[0, 2] - a[0, 0] * a[1, 2]
    out[2, 2] = a[0, 0] * a[1, 1] - a[0, 1] * a[0, 1]
    out[1, 0], out[2, 0], out[2, 1] = out[0, 1], out[0, 2], out[1, 2]
    for i in range(3):
        for k in range(3):
            out[i, k] /= determinant
    return True


@njit
def meet(rotations: Any, translations: Any, observations: Any, middle: Any) -> int:
    """Midpoint of the two rays, in place; returns whether they meet at all, and if not, why.

    With c = d₁·d₂ and b = o₂ - o₁ the closest points lie at s₁ = (b·d₁ - c·b·d₂) / (1 - c²) and
    s₂ = (c·b·d₁ - b·d₂) / (1 - c²).
    """
    directions, centres = np.empty((2, 3)), np.empty((2, 3))
    for i in range(2):
        x, y = observations[i, 0], observations[i, 1]
        if not (np.isfinite(x) and np.isfinite(y)):
            return NOT_FINITE
        length = np.sqrt(x * x + y * y + 1.0)
        for k in range(3):
            r = rotations[i]
            directions[i, k] = (r[0, k] * x + r[1, k] * y + r[2, k]) / length
            t = translations[i]
            centres[i, k] = -(r[0, k] * t[0] + r[1, k] * t[1] + r[2, k] * t[2])
    d, e, b = directions[0], directions[1], centres[1] - centres[0]
    length = np.sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2])
    if length < _BASELINE:
        return DEGENERATE
    sine2 = _cross_squared(d, e)
    if sine2 < _PARALLEL * _PARALLEL:
        along = _cross_squared(d, b) < (_PARALLEL * length) ** 2
        return DEGENERATE if along else AT_INFINITY
    c = d[0] * e[0] + d[1] * e[1] + d[2] * e[2]
    bd = b[0] * d[0] + b[1] * d[1] + b[2] * d[2]
    be = b[0] * e[0] + b[1] * e[1] + b[2] * e[2]
    first, second = (bd - c * be) / sine2, (c * bd - be) / sine2
    for k in range(3):
        middle[k] = 0.5 * (centres[0, k] + first * d[k] + centres[1, k] + second * e[k])
    return FOUND


@njit
def _cross_squared(a: Any, b: Any) -> float:
    x = a[1] * b[2] - a[2] * b[1]
    y = a[2] * b[0] - a[0] * b[2]
    z = a[0] * b[1] - a[1] * b[0]
    return float(x * x + y * y + z * z)


@njit
def _system(
    rotations: Any,
    translations: Any,
    observations: Any,
    weights: Any,
    p: Any,
    centre: Any,
    prior: Any,
    residual: Any,
    information: Any,
    slope: Any,
) -> Any:
    """Set up the normal equations at a point, in place: (cost, least depth)."""
    jacobian = np.empty((2, 3))
    cost, least = 0.0, np.inf
    for j in range(3):
        slope[j] = 0.0
        for k in range(3):
            information[j, k] = prior[j, k]
            slope[j] -= prior[j, k] * (p[k] - centre[k])
            cost += (p[j] - centre[j]) * prior[j, k] * (p[k] - centre[k])
    for i in range(rotations.shape[0]):
        e = residual[2 * i : 2 * i + 2]
        depth = reproject(rotations[i], translations[i], observations[i], p, e, jacobian)
        least = min(least, depth)
        for a in range(2):
            for b in range(2):
                w = weights[i, a, b]
                cost += e[a] * w * e[b]
                for j in range(3):
                    slope[j] += jacobian[a, j] * w * e[b]
                    for k in range(3):
                        information[j, k] += jacobian[a, j] * w * jacobian[b, k]
    return cost, least


@njit
def optimum(
    rotations: Any,
    translations: Any,
    observations: Any,
    covariances: Any,
    p: Any,
    centre: Any,
    prior: Any,
    steps: int,
    residual: Any,
    spread: Any,
) -> Any:
    """Find the least squares point by Gauss–Newton; a step that raises the cost is not taken.

    Begins at `p` [m], (3,), which becomes the point. `centre` [m] and `prior` [1/m²] are a point
    and the information about it; with 0 `steps` everything is evaluated at `p`. Into `residual`,
    (2n,), goes observed minus predicted, into `spread`, (3, 3), the covariance [m²]. Returned are
    the squared weighted error, the least depth before a camera [m] and whether the spread exists.
    """
    n = rotations.shape[0]
    weights, information = np.empty((n, 2, 2)), np.empty((3, 3))
    slope, candidate = np.empty(3), np.empty(3)
    other, other_information, other_slope = np.empty(2 * n), np.empty((3, 3)), np.empty(3)
    for i in range(n):
        s = covariances[i]
        determinant = s[0, 0] * s[1, 1] - s[0, 1] * s[1, 0]
        weights[i, 0, 0], weights[i, 1, 1] = s[1, 1] / determinant, s[0, 0] / determinant
        weights[i, 0, 1], weights[i, 1, 0] = -s[0, 1] / determinant, -s[1, 0] / determinant
    cost, least = _system(
        rotations,
        translations,
        observations,
        weights,
        p,
        centre,
        prior,
        residual,
        information,
        slope,
    )
    found = inverse3(information, spread)
    for _ in range(steps):
        if not found or least <= NEAREST:
            break
        size = 0.0
        for j in range(3):
            step = spread[j, 0] * slope[0] + spread[j, 1] * slope[1] + spread[j, 2] * slope[2]
            candidate[j] = p[j] + step
            size = max(size, abs(step))
        new, nearest = _system(
            rotations,
            translations,
            observations,
            weights,
            candidate,
            centre,
            prior,
            other,
            other_information,
            other_slope,
        )
        if nearest <= NEAREST or not new <= cost:
            break
        done = cost - new <= 1e-12 * cost or size < 1e-12
        p[:], residual[:], slope[:] = candidate, other, other_slope
        cost, least = new, nearest
        found = inverse3(other_information, spread)
        if done:
            break
    return cost, least, found
