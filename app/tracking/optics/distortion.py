"""Lens distortion, forwards, its derivatives, and backwards, for three models of a lens.

Coordinates are normalised (x = X/Z, y = Y/Z in the camera frame), coefficients in OpenCV's order.
Their number tells which model they are of (`optics.lens.LensModel`):

5, Brown and Conrady (k1, k2, p1, p2, k3):

    x_d = x·g + 2·p1·x·y + p2·(r² + 2x²),   y_d = y·g + p1·(r² + 2y²) + 2·p2·x·y,
    g = 1 + k1·r² + k2·r⁴ + k3·r⁶,   r² = x² + y².

12, rational with thin prism (k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4): g is divided by
1 + k4·r² + k5·r⁴ + k6·r⁶, and s1·r² + s2·r⁴ is added to x_d, s3·r² + s4·r⁴ to y_d.

4, fisheye (k1, k2, k3, k4; Kannala and Brandt 2006, `cv2.fisheye`): x_d = x·g, y_d = y·g with

    g = θ·(1 + k1·θ² + k2·θ⁴ + k3·θ⁶ + k4·θ⁸) / r,   θ = atan(r).

The map may fold back on itself beyond some radius: two directions share one pixel. Points there
have no picture, and pixels are undistorted to the direction inside the fold.
"""

from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit

_ITERATIONS = 60
_TOLERANCE = 1e-13

FISHEYE: Final = 4
BROWN: Final = 5
RATIONAL: Final = 12

FARTHEST: Final = 1e3
"""Undistorted radius beyond which no point has a picture (89.94° off the axis)."""

_SMALL: Final = 1e-3
"""Radius below which the fisheye model is taken by its series: θ/r is 0/0 on the axis."""

_BISECTIONS: Final = 40

_PLACES: Final = 8
"""On the way from the axis to a point at which the map is asked whether it has folded."""


def fold_radius(coefficients: FloatArray) -> float:
    """Undistorted radius at which the radial map stops growing; infinite if it never does.

    The smallest positive root of d(r·g)/dr, or pole of g. For five coefficients d(r·g)/dr is
    1 + 3·k1·r² + 5·k2·r⁴ + 7·k3·r⁶, whose root is found as the largest of
    s³ + 3·k1·s² + 5·k2·s + 7·k3 with s = 1/r²: there the leading coefficient is 1, whatever
    vanishes; the others likewise.
    """
    c = np.asarray(coefficients, dtype=np.float64)
    if c.size == FISHEYE:
        angle = _first_root(np.array([1.0, 3.0 * c[0], 5.0 * c[1], 7.0 * c[2], 9.0 * c[3]]))
        return float(np.tan(angle)) if angle < 0.5 * np.pi else float("inf")
    if c.size == BROWN:
        return _first_root(np.array([1.0, 3.0 * c[0], 5.0 * c[1], 7.0 * c[4]]))
    above = np.polynomial.Polynomial([1.0, c[0], c[1], c[4]])
    below = np.polynomial.Polynomial([1.0, c[5], c[6], c[7]])
    s = np.polynomial.Polynomial([0.0, 1.0])
    growth = above * below + 2.0 * s * (above.deriv() * below - above * below.deriv())
    return min(_first_root(np.asarray(p.coef, dtype=np.float64)) for p in (growth, below))


def _first_root(rising: FloatArray) -> float:
    """Smallest positive r at which a polynomial in r² with the constant 1 is 0; infinite if none.

    Args:
        rising: coefficients from the constant on.
    """
    roots = np.roots(rising)  # of the polynomial in 1/r²: its leading coefficient is the constant
    real = roots[np.abs(roots.imag) < 1e-9 * np.abs(roots) + 1e-300].real
    positive = real[real > 0.0]
    return float(1.0 / np.sqrt(positive.max())) if positive.size else float("inf")


@njit
def _radial(r2: float, c: Any) -> Any:
    """Radial factor g and its slope dg/d(r²) at a squared radius."""
    if c.size == BROWN:
        g = 1.0 + r2 * (c[0] + r2 * (c[1] + r2 * c[4]))
        return g, c[0] + r2 * (2.0 * c[1] + r2 * 3.0 * c[4])
    if c.size == RATIONAL:
        below = 1.0 + r2 * (c[5] + r2 * (c[6] + r2 * c[7]))
        g = (1.0 + r2 * (c[0] + r2 * (c[1] + r2 * c[4]))) / below
        above_slope = c[0] + r2 * (2.0 * c[1] + r2 * 3.0 * c[4])
        below_slope = c[5] + r2 * (2.0 * c[6] + r2 * 3.0 * c[7])
        return g, (above_slope - g * below_slope) / below
    r = np.sqrt(r2)
    if r < _SMALL:
        first, second = c[0] - 1.0 / 3.0, 0.2 - c[0] + c[1]
        return 1.0 + r2 * (first + r2 * second), first + 2.0 * r2 * second
    angle = np.arctan(r)
    a2 = angle * angle
    g = angle * (1.0 + a2 * (c[0] + a2 * (c[1] + a2 * (c[2] + a2 * c[3])))) / r
    growth = 1.0 + a2 * (3.0 * c[0] + a2 * (5.0 * c[1] + a2 * (7.0 * c[2] + a2 * 9.0 * c[3])))
    return g, (growth / (1.0 + r2) - g) / (2.0 * r2)


@njit
def distort_point(x: float, y: float, c: Any) -> Any:
    """Distort one normalised point: (x_d, y_d)."""
    r2 = x * x + y * y
    g, _ = _radial(r2, c)
    if c.size == FISHEYE:
        return x * g, y * g
    x_d = x * g + 2.0 * c[2] * x * y + c[3] * (r2 + 2.0 * x * x)
    y_d = y * g + c[2] * (r2 + 2.0 * y * y) + 2.0 * c[3] * x * y
    if c.size == RATIONAL:
        x_d += r2 * (c[8] + r2 * c[9])
        y_d += r2 * (c[10] + r2 * c[11])
    return x_d, y_d


@njit
def distortion_jacobian(x: float, y: float, c: Any) -> Any:
    """Return the derivatives (∂x_d/∂x, ∂x_d/∂y, ∂y_d/∂x, ∂y_d/∂y)."""
    r2 = x * x + y * y
    g, slope = _radial(r2, c)
    if c.size == FISHEYE:
        cross = 2.0 * x * y * slope
        return g + 2.0 * x * x * slope, cross, cross, g + 2.0 * y * y * slope
    xx = g + 2.0 * x * x * slope + 2.0 * c[2] * y + 6.0 * c[3] * x
    xy = 2.0 * x * y * slope + 2.0 * c[2] * x + 2.0 * c[3] * y
    yx = xy
    yy = g + 2.0 * y * y * slope + 6.0 * c[2] * y + 2.0 * c[3] * x
    if c.size == RATIONAL:
        across, down = c[8] + 2.0 * c[9] * r2, c[10] + 2.0 * c[11] * r2
        xx += 2.0 * x * across
        xy += 2.0 * y * across
        yx += 2.0 * x * down
        yy += 2.0 * y * down
    return xx, xy, yx, yy


@njit
def _fill_by_coefficients(x: float, y: float, c: Any, out: Any) -> None:
    """Fill in the derivatives of (x_d, y_d) by the coefficients, (2, number of them)."""
    r2 = x * x + y * y
    if c.size == FISHEYE:
        r = np.sqrt(r2)
        angle = np.arctan(r)
        power = angle / r if r > _SMALL else 1.0 - r2 / 3.0
        for k in range(4):
            power *= angle * angle
            out[0, k], out[1, k] = x * power, y * power
        return
    below = 1.0
    if c.size == RATIONAL:
        below += r2 * (c[5] + r2 * (c[6] + r2 * c[7]))
        g, _ = _radial(r2, c)
        power = -g / below
        for k in range(5, 8):
            power *= r2
            out[0, k], out[1, k] = x * power, y * power
        out[0, 8:], out[1, 8:] = 0.0, 0.0
        out[0, 8], out[0, 9] = r2, r2 * r2
        out[1, 10], out[1, 11] = r2, r2 * r2
    for k, power in ((0, r2 / below), (1, r2 * r2 / below), (4, r2 * r2 * r2 / below)):
        out[0, k], out[1, k] = x * power, y * power
    out[0, 2], out[1, 2] = 2.0 * x * y, r2 + 2.0 * y * y
    out[0, 3], out[1, 3] = r2 + 2.0 * x * x, 2.0 * x * y


@njit
def distort_with_derivatives(xy: Any, c: Any) -> Any:
    """Distort normalised points, (n, 2), with the derivatives by point and by coefficients.

    Returns:
        Distorted points (n, 2), derivatives by the point (n, 2, 2), by `c` (n, 2, c.size).
    """
    n = xy.shape[0]
    bent, by_point, by_lens = np.empty((n, 2)), np.empty((n, 2, 2)), np.empty((n, 2, c.size))
    for i in range(n):
        x, y = xy[i, 0], xy[i, 1]
        bent[i, 0], bent[i, 1] = distort_point(x, y, c)
        xx, xy_, yx, yy = distortion_jacobian(x, y, c)
        by_point[i, 0, 0], by_point[i, 0, 1] = xx, xy_
        by_point[i, 1, 0], by_point[i, 1, 1] = yx, yy
        _fill_by_coefficients(x, y, c, by_lens[i])
    return bent, by_point, by_lens


@njit
def distort_grid(xy: Any, c: Any, fold: float) -> Any:
    """Distort normalised points, (n, 2), and tell which have a picture, (n,).

    One has a picture inside the fold; where thin prism and tangential terms fold the map before
    the radial one does, the map's determinant tells. Points without one are zero.
    """
    bent, seen = np.zeros(xy.shape), np.zeros(xy.shape[0], dtype=np.bool_)
    for i in range(xy.shape[0]):
        if inside_fold(xy[i, 0], xy[i, 1], c, fold):
            bent[i, 0], bent[i, 1] = distort_point(xy[i, 0], xy[i, 1], c)
            seen[i] = True
    return bent, seen


@njit
def inside_fold(x: float, y: float, c: Any, fold: float) -> bool:
    """Return whether a normalised point has a picture; see `distort_grid`."""
    if not np.hypot(x, y) < min(fold, FARTHEST):
        return False
    if c.size != RATIONAL:
        return True
    for k in range(_PLACES):  # from the point inwards: beyond a fold the map may grow again
        part = 1.0 - k / _PLACES
        xx, xy, yx, yy = distortion_jacobian(part * x, part * y, c)
        if not xx * yy - xy * yx > 0.0:
            return False
    return True


@njit
def _start(x_d: float, y_d: float, c: Any, fold: float) -> Any:
    """Point from which to invert the distortion: (x, y).

    For five coefficients the distorted point itself, drawn inside the fold. Wider lenses bend too
    much for that: there the radial map alone is inverted by bisection, of the angle for a fisheye
    lens: it grows up to the fold.
    """
    radius = np.sqrt(x_d * x_d + y_d * y_d)
    if c.size == BROWN:
        start = 1.0 if radius < 0.9 * fold else 0.9 * fold / radius
        return start * x_d, start * y_d
    limit = 0.999999 * min(fold, FARTHEST)
    low, high = 0.0, np.arctan(limit) if c.size == FISHEYE else limit
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        m2 = middle * middle
        if c.size == FISHEYE:
            bent = middle * (1.0 + m2 * (c[0] + m2 * (c[1] + m2 * (c[2] + m2 * c[3]))))
        else:
            bent = middle * _radial(m2, c)[0]
        if bent < radius:
            low = middle
        else:
            high = middle
    r = np.tan(low) if c.size == FISHEYE else low
    start = r / radius if radius > 0.0 else 1.0
    return start * x_d, start * y_d


@njit
def undistort_point(x_d: float, y_d: float, c: Any, fold: float) -> Any:
    """Invert the distortion by a safeguarded Newton iteration: (x, y, found).

    Steps are halved until the residual falls and the point stays inside the fold with a positive
    Jacobian determinant, where the solution is unique. `found` is False for pixels that no
    direction inside the fold reaches; x and y are then the closest the iteration came.
    """
    x, y, found = _newton(x_d, y_d, c, fold)
    return x, y, found and (c.size != RATIONAL or inside_fold(x, y, c, fold))


@njit
def _newton(x_d: float, y_d: float, c: Any, fold: float) -> Any:
    """Iterate; see `undistort_point`."""
    radius = np.sqrt(x_d * x_d + y_d * y_d)
    if not np.isfinite(radius):
        return 0.0, 0.0, False
    x, y = _start(x_d, y_d, c, fold)
    u, v = distort_point(x, y, c)
    error = np.hypot(u - x_d, v - y_d)
    for _ in range(_ITERATIONS):
        if error <= _TOLERANCE * (1.0 + radius):
            return x, y, True
        xx, xy, yx, yy = distortion_jacobian(x, y, c)
        determinant = xx * yy - xy * yx
        if determinant <= 0.0:
            return x, y, False
        step_x = (yy * (u - x_d) - xy * (v - y_d)) / determinant
        step_y = (xx * (v - y_d) - yx * (u - x_d)) / determinant
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
