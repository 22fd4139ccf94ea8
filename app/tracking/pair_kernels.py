"""From both pictures' pixels to the band's point and what it says (compiled), see `solver`.

In one go, because it is a pair's every-day path: as dozens of small array operations it took as
long as a fit. `tests/tracking/test_tracking_pair_kernels.py` holds it against the same steps in
plain numpy.
"""

from typing import Any, Final

import numpy as np

from app.core.compiled import njit
from app.tracking.markers.silhouette import outline_shift
from app.tracking.optics.packed import normalise
from app.tracking.stereo.kernels import BEHIND, DEGENERATE, FOUND, NEAREST, inverse3, meet, optimum

NO_RAY: Final = 5
NO_OUTLINE: Final = 6
"""What `locate` returns besides `stereo.kernels.FOUND` and its like."""

_STEPS: Final = 10

SUMMARY: Final = 3
"""Root mean square residual [px], signed root of chi-square (the sign is that of x₂ᵀ E x₁), squared
distance from the line [variances]."""


@njit
def locate(
    cameras: Any,
    poses: Any,
    pixels: Any,
    spreads: Any,
    outlines: Any,
    needle: Any,
    axis: Any,
    point: Any,
    covariance: Any,
    residual: Any,
    observed: Any,
    seen: Any,
) -> Any:
    """Triangulate the band, outlines moved to its centre; returns status and chi-square.

    Args:
        cameras: rows of both, see `optics.packed`, (2, CAMERA).
        poses: rotations and translations of T_camera_world, (2, 3, 4).
        pixels: (2, 2) [px].
        spreads: covariances of them [px²], (2, 2, 2).
        outlines: whether each is an outline's centroid, (2,).
        needle: a `rig.NeedleShape` as an array.
        axis: unit vector from hub to tip, (3,).
        point: out [m], (3,).
        covariance: of it, out [m²], (3, 3).
        residual: out, observed minus predicted normalised coordinates, (4,).
        observed: out, normalised coordinates, (2, 2).
        seen: out, covariances of them, (2, 2, 2).
    """
    shift = np.zeros((2, 2))
    for attempt in range(2):
        for i in range(2):
            u, v = pixels[i, 0] - shift[i, 0], pixels[i, 1] - shift[i, 1]
            if not normalise(cameras[i], u, v, spreads[i], observed[i], seen[i]):
                return NO_RAY, 0.0
        steps = _STEPS if attempt else 0
        status, square = _triangulate(poses, observed, seen, steps, point, covariance, residual)
        if status != FOUND or attempt:
            break
        for i in range(2):
            if outlines[i] and not outline_shift(cameras[i], needle, point, axis, shift[i]):
                return NO_OUTLINE, 0.0
    return status, square


@njit
def _triangulate(
    poses: Any, observed: Any, seen: Any, steps: int, point: Any, covariance: Any, residual: Any
) -> Any:
    """See `stereo.triangulation.triangulate`: status and chi-square."""
    rotations, translations = poses[:, :, :3], poses[:, :, 3]
    status = meet(rotations, translations, observed, point)
    if status != FOUND:
        return status, 0.0
    square, nearest, found = optimum(
        rotations, translations, observed, seen, point, point.copy(), np.zeros((3, 3)), steps,
        residual, covariance,
    )  # fmt: skip
    if nearest <= NEAREST:
        return BEHIND, 0.0
    return (FOUND if found else DEGENERATE), square


@njit
def summarise(
    point: Any,
    covariance: Any,
    residual: Any,
    observed: Any,
    square: float,
    focal: Any,
    essential: Any,
    fulcrum: Any,
    axis: Any,
    line_variance: float,
    beside: Any,
    summary: Any,
) -> bool:
    """Compare a point with the robot's line and the pictures with each other.

    Args:
        point: [m], (3,).
        covariance: of it, with the calibration's share [m²], (3, 3).
        residual: observed minus predicted normalised coordinates, (4,).
        observed: normalised coordinates, (2, 2).
        square: chi-square of the point.
        focal: of both cameras, (4,) [px].
        essential: of the pair, (3, 3).
        fulcrum: a point of the line [m], (3,).
        axis: its unit vector, (3,).
        line_variance: of the line across itself [m²].
        beside: out, from the line to the point, across it [m], (3,).
        summary: out, see SUMMARY.

    Returns:
        False where the distance from the line cannot be weighed.
    """
    along, total, miss = 0.0, 0.0, 0.0
    for k in range(3):
        along += (point[k] - fulcrum[k]) * axis[k]
    for k in range(3):
        beside[k] = point[k] - fulcrum[k] - along * axis[k]
    for k in range(4):
        total += (residual[k] * focal[k]) ** 2
    for i in range(3):
        second = observed[1, i] if i < 2 else 1.0
        for k in range(3):
            first = observed[0, k] if k < 2 else 1.0
            miss += second * essential[i, k] * first
    summary[0], summary[1] = np.sqrt(0.25 * total), np.copysign(np.sqrt(square), miss)
    spread, inverse = np.empty((3, 3)), np.empty((3, 3))
    _across(covariance, axis, line_variance, spread)
    if not inverse3(spread, inverse):
        return False
    summary[2] = 0.0
    for i in range(3):
        for k in range(3):
            summary[2] += beside[i] * inverse[i, k] * beside[k]
    return True


@njit
def _across(covariance: Any, axis: Any, line_variance: float, out: Any) -> None:
    """P Σ Pᵀ + σ² I with P = I - d dᵀ, in place."""
    turned = np.empty((3, 3))
    for i in range(3):
        for k in range(3):
            turned[i, k] = covariance[i, k]
            for j in range(3):
                turned[i, k] -= axis[i] * axis[j] * covariance[j, k]
    for i in range(3):
        for k in range(3):
            out[i, k] = turned[i, k]
            for j in range(3):
                out[i, k] -= turned[i, j] * axis[j] * axis[k]
        out[i, i] += line_variance
