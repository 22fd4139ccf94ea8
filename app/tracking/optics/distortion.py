"""Lens distortion of Brown and Conrady, forwards, its Jacobian, and backwards.

Coordinates are normalised (x = X/Z, y = Y/Z in the camera frame); the coefficients stand in
OpenCV's order (k1, k2, p1, p2, k3):

    x_d = x·g + 2·p1·x·y + p2·(r² + 2x²),   y_d = y·g + p1·(r² + 2y²) + 2·p2·x·y,
    g = 1 + k1·r² + k2·r⁴ + k3·r⁶,   r² = x² + y².

With a large negative k3 the map folds back on itself beyond some radius: two directions share one
pixel. Points there have no picture, and pixels are undistorted to the direction inside the fold.
"""

from typing import Any

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit

_ITERATIONS = 60
_TOLERANCE = 1e-13


def fold_radius(coefficients: FloatArray) -> float:
    """Undistorted radius at which the radial map stops growing; infinite if it never does.

    The smallest positive root of d(r·g)/dr = 1 + 3·k1·r² + 5·k2·r⁴ + 7·k3·r⁶, found as the largest
    of s³ + 3·k1·s² + 5·k2·s + 7·k3 with s = 1/r²: there the leading coefficient is 1, whatever
    vanishes.
    """
    k1, k2, _, _, k3 = coefficients
    roots = np.roots([1.0, 3.0 * k1, 5.0 * k2, 7.0 * k3])
    real = roots[np.abs(roots.imag) < 1e-9 * np.abs(roots) + 1e-300].real
    positive = real[real > 0.0]
    return float(1.0 / np.sqrt(positive.max())) if positive.size else float("inf")


@njit
def distort_point(x: float, y: float, c: Any) -> Any:
    """Distort one normalised point: (x_d, y_d)."""
    r2 = x * x + y * y
    g = 1.0 + r2 * (c[0] + r2 * (c[1] + r2 * c[4]))
    x_d = x * g + 2.0 * c[2] * x * y + c[3] * (r2 + 2.0 * x * x)
    y_d = y * g + c[2] * (r2 + 2.0 * y * y) + 2.0 * c[3] * x * y
    return x_d, y_d


@njit
def distortion_jacobian(x: float, y: float, c: Any) -> Any:
    """Return the derivatives (∂x_d/∂x, ∂x_d/∂y = ∂y_d/∂x, ∂y_d/∂y); the matrix is symmetric."""
    r2 = x * x + y * y
    g = 1.0 + r2 * (c[0] + r2 * (c[1] + r2 * c[4]))
    slope = c[0] + r2 * (2.0 * c[1] + r2 * 3.0 * c[4])  # dg/d(r²)
    xx = g + 2.0 * x * x * slope + 2.0 * c[2] * y + 6.0 * c[3] * x
    xy = 2.0 * x * y * slope + 2.0 * c[2] * x + 2.0 * c[3] * y
    yy = g + 2.0 * y * y * slope + 6.0 * c[2] * y + 2.0 * c[3] * x
    return xx, xy, yy


@njit
def undistort_point(x_d: float, y_d: float, c: Any, fold: float) -> Any:
    """Invert the distortion by a safeguarded Newton iteration: (x, y, found).

    Steps are halved until the residual falls and the point stays inside the fold with a positive
    Jacobian determinant, where the solution is unique. `found` is False for pixels that no
    direction inside the fold reaches; x and y are then the closest the iteration came.
    """
    radius = np.sqrt(x_d * x_d + y_d * y_d)
    if not np.isfinite(radius):
        return 0.0, 0.0, False
    start = 1.0 if radius < 0.9 * fold else 0.9 * fold / radius
    x, y = start * x_d, start * y_d
    u, v = distort_point(x, y, c)
    error = np.hypot(u - x_d, v - y_d)
    for _ in range(_ITERATIONS):
        if error <= _TOLERANCE * (1.0 + radius):
            return x, y, True
        xx, xy, yy = distortion_jacobian(x, y, c)
        determinant = xx * yy - xy * xy
        if determinant <= 0.0:
            return x, y, False
        step_x = (yy * (u - x_d) - xy * (v - y_d)) / determinant
        step_y = (xx * (v - y_d) - xy * (u - x_d)) / determinant
        scale, improved = 1.0, False
        while scale > 1e-6 and not improved:
            nx, ny = x - scale * step_x, y - scale * step_y
            nu, nv = distort_point(nx, ny, c)
            candidate = np.hypot(nu - x_d, nv - y_d)
            improved = candidate < error and np.hypot(nx, ny) < fold
            scale *= 0.5
        if not improved:
            return x, y, error <= 1e-10 * (1.0 + radius)  # at the floor of double precision
        x, y, u, v, error = nx, ny, nu, nv, candidate
    return x, y, False


@njit
def undistort_grid(pixels: Any, intrinsics: Any, c: Any, fold: float) -> Any:
    """Normalised coordinates of pixels, (n, 2) -> (n, 2) and which exist, (n,).

    `intrinsics` is (fx, fy, cx, cy). Where nothing is found the coordinates are zero.
    """
    rays = np.zeros(pixels.shape)
    found = np.zeros(pixels.shape[0], dtype=np.bool_)
    for i in range(pixels.shape[0]):
        x_d = (pixels[i, 0] - intrinsics[2]) / intrinsics[0]
        y_d = (pixels[i, 1] - intrinsics[3]) / intrinsics[1]
        x, y, ok = undistort_point(x_d, y_d, c, fold)
        if ok:
            rays[i, 0], rays[i, 1], found[i] = x, y, True
    return rays, found
