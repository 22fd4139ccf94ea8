"""How far off the rays of a calibrated camera may be, over its picture.

A calibration is measured where the board was seen and continued elsewhere. With B = ∂(pixel)/∂θ of
a ray at the camera's parameters θ and R = ∂(pixel)/∂ω by a turn of the camera, which whoever places
the camera in the world takes out, the error at a pixel of a grid over the picture is

    G·δθ,  G = B - R·(RᵀWR)⁻¹·RᵀWB (least squares over the grid),  Σ_pixel = G Σ_θ Gᵀ,

where W weighs each place by how well it is known.

A coefficient that the views do not tell is not known to be 0: it enters with what it is in lenses.
"""

from collections.abc import Sequence
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.optics.calibration import RAY_GRID
from app.tracking.optics.distortion import (
    distort_with_derivatives,
    fold_radius,
    undistort_grid,
)

ROWS, COLUMNS = RAY_GRID

K3_SD: Final = 0.2
"""Standard deviation of k3 over lenses, for views that do not tell it."""

_LEAST_VARIANCE: Final = 1e-12
"""[px²], so that exact corners weigh something finite."""

UNKNOWN_PX: Final = 1e3
"""Stated where no ray reaches a pixel: beyond the fold of the distortion."""


def with_usual_k3(covariance: FloatArray) -> FloatArray:
    """Return the covariance of nine parameters with k3 known as well as it is for all lenses.

    Args:
        covariance: with k3 estimated, shape (9, 9).
    """
    # scaled first: the variances of views that tell nothing are squares of no finite number
    gain = covariance[:, 8] / np.sqrt(max(float(covariance[8, 8]), 0.0) + K3_SD**2)
    return np.asarray(covariance - np.outer(gain, gain))


def ray_sds(parameters: FloatArray, covariance: FloatArray, size: tuple[int, int]) -> FloatArray:
    """Return the standard deviation of rays over the picture [px], shape (ROWS, COLUMNS).

    Root of the mean variance of both axes.

    Args:
        parameters: fx, fy, cx, cy and the lens' coefficients, shape (m,).
        covariance: of them, shape (m, m).
        size: width, height [px].
    """
    pixels = grid_pixels(size)
    lens = parameters[4:]
    rays, exist = undistort_grid(pixels, parameters[:4], lens, fold_radius(lens))
    result = np.full(len(pixels), UNKNOWN_PX)
    if int(exist.sum()) > 3:
        gain = _gain(rays[exist], parameters, covariance)
        spread = np.einsum("nij,jk,nik->n", gain, covariance, gain)
        result[exist] = np.sqrt(np.maximum(spread, 0.0) / 2.0)
    return np.minimum(result, UNKNOWN_PX).reshape(ROWS, COLUMNS)


def grid_pixels(size: tuple[int, int]) -> FloatArray:
    """Return the places of the grid, row by row [px], shape (ROWS * COLUMNS, 2)."""
    u, v = np.linspace(0.0, size[0] - 1.0, COLUMNS), np.linspace(0.0, size[1] - 1.0, ROWS)
    return np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 2)


def at_pixels(
    sds: Sequence[Sequence[float]] | FloatArray, size: tuple[int, int], pixels: FloatArray
) -> FloatArray:
    """Return the deviations at pixels inside the picture, (n, 2) -> (n,), between the grid's."""
    grid = np.asarray(sds, dtype=np.float64)
    place = pixels / (np.array(size) - 1.0) * (np.array([COLUMNS, ROWS]) - 1.0)
    place = np.clip(place, 0.0, np.array([COLUMNS, ROWS]) - 1.0)
    corner = np.minimum(place.astype(int), np.array([COLUMNS, ROWS]) - 2)
    (a, b), (i, j) = (place - corner).T, corner.T
    return np.asarray(
        (1.0 - b) * ((1.0 - a) * grid[j, i] + a * grid[j, i + 1])
        + b * ((1.0 - a) * grid[j + 1, i] + a * grid[j + 1, i + 1])
    )


def _gain(rays: FloatArray, parameters: FloatArray, covariance: FloatArray) -> FloatArray:
    """Change of pixels with the parameters beyond a turn of the camera, shape (n, 2, m)."""
    focal = parameters[:2, None]
    bent, by_ray, by_lens = distort_with_derivatives(rays, parameters[4:])
    change = np.zeros((len(rays), 2, parameters.size))
    change[:, 0, 0], change[:, 1, 1] = bent[:, 0], bent[:, 1]
    change[:, 0, 2] = change[:, 1, 3] = 1.0
    change[:, :, 4:] = focal * by_lens
    x, y = rays.T
    turn = np.empty((len(rays), 2, 3))  # of a ray (x, y, 1) by a small turn ω: ω x ray
    turn[:, 0] = np.column_stack([-x * y, 1.0 + x * x, -y])
    turn[:, 1] = np.column_stack([-1.0 - y * y, x * y, x])
    turn = focal * (by_ray @ turn)
    variance = np.einsum("nij,jk,nik->n", change, covariance, change)
    weights = np.repeat(1.0 / np.sqrt(np.maximum(variance, _LEAST_VARIANCE)), 2)[:, None]
    flat, turned = change.reshape(-1, parameters.size), turn.reshape(-1, 3)
    rest = flat - turned @ np.linalg.lstsq(weights * turned, weights * flat, rcond=None)[0]
    return np.asarray(rest.reshape(change.shape))
