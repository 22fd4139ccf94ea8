"""Where the band's edges lie in a picture, seen through lens and perspective (compiled).

The band is a cylinder. The camera sees the half of it between two lines of tangency; a point of
that half has the coordinate x across, from -1 to 1 between the tangents, and its end circles give
two arcs. All are projected through the camera with its distortion and given in a frame of the
picture: origin at the picture of the band's centre, `e` along the needle towards the tip, `n`
across. Formulas: docs/band-fit.md.
"""

import math
from typing import Any, Final, NamedTuple

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.tracking.optics.distortion import distort_point
from app.tracking.optics.rig import NeedleShape

ARCS: Final = 4

_FEWEST, _MOST = 10, 40


class Outline(NamedTuple):
    """The band's edges in the frame of its picture; lengths in pixels."""

    u: float
    """Origin: picture of the band's centre."""
    v: float
    eu: float
    """Direction of `e`; that of `n` is (-ev, eu)."""
    ev: float
    left: float
    """n of the tangent x = -1 at e = 0, and per pixel of e."""
    left_slope: float
    right: float
    """The same of the tangent x = 1; greater."""
    right_slope: float
    apex: float
    """e of the needle's tip."""
    taper: float
    """Distance before the apex at which the point's tangents are as far apart as the band's."""
    bow: float
    """n per e² by the lens' distortion."""
    bow_zero: float
    """e² of the band's ends, where the tangents are exact."""
    arcs: FloatArray
    """e at the middle of each of the band's strips, (ARCS, strips): of the band's end to the hub,
    of that to the tip; then of the strips of the shaft that leaves either end."""


class _Projection(NamedTuple):
    """The cylinder before a camera: what a point of it takes to be put into the outline's frame."""

    centre: FloatArray
    """[m], camera frame; so are the following unit vectors."""
    axis: FloatArray
    across: FloatArray
    facing: FloatArray
    """Across the axis, to the camera."""
    intrinsics: FloatArray
    distortion: FloatArray
    u: float
    v: float
    eu: float
    ev: float


def strips(p_camera: FloatArray, shape: NeedleShape, intrinsics: FloatArray, blur: float) -> int:
    """Count the strips across the band, for integration: one per deviation of the blur.

    Their midpoints are then off by exp(-2π²), 3e-9; beyond 40 strips the band is close enough.

    Args:
        p_camera: the band's centre in the camera frame [m], shape (3,).
        shape: of the needle.
        intrinsics: fx, fy, cx, cy [px], shape (4,).
        blur: standard deviation of the point spread [px].
    """
    width = 2.0 * shape.radius * float(intrinsics[:2].max()) / float(p_camera[2])
    return min(_MOST, max(_FEWEST, math.ceil(width / max(blur, 0.1)))) if width > 0.0 else _FEWEST


@njit
def trace(c: Any, a: Any, shape: Any, intrinsics: Any, distortion: Any, cells: int) -> Any:
    """Project the band's outline: whether it has one (before the camera, not end on), and it.

    Args:
        c: centre of the band in the camera frame [m].
        a: unit vector from hub to tip, camera frame.
        shape: a `rig.NeedleShape`.
        intrinsics: fx, fy, cx, cy.
        distortion: k1, k2, p1, p2, k3.
        cells: how many `strips`.
    """
    arcs = np.zeros((ARCS, cells))
    nowhere = Outline(0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, arcs)
    radius, half = shape.radius, shape.half
    along = c[0] * a[0] + c[1] * a[1] + c[2] * a[2]
    f, t = np.empty(3), np.empty(3)
    for k in range(3):
        f[k] = along * a[k] - c[k]
    gap = np.sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2])
    if not (c[2] > 4.0 * half and gap > 4.0 * radius):
        return False, nowhere
    for k in range(3):
        f[k] /= gap
    t[0], t[1], t[2] = (
        a[1] * f[2] - a[2] * f[1],
        a[2] * f[0] - a[0] * f[2],
        a[0] * f[1] - a[1] * f[0],
    )
    u0, v0 = _pixel(c, a, 0.0, intrinsics, distortion)
    u1, v1 = _pixel(c, a, -half, intrinsics, distortion)
    u2, v2 = _pixel(c, a, half, intrinsics, distortion)
    length = np.hypot(u2 - u1, v2 - v1)
    if not length > 2.0:
        return False, nowhere
    eu, ev = (u2 - u1) / length, (v2 - v1) / length
    projection = _Projection(c, a, t, f, intrinsics, distortion, u0, v0, eu, ev)
    sine = radius / gap
    left, left_slope = _tangent(projection, shape, -1.0, sine)
    right, right_slope = _tangent(projection, shape, 1.0, sine)
    if left > right:  # n grows with x
        left, left_slope, right, right_slope = right, right_slope, left, left_slope
        for k in range(3):
            t[k] = -t[k]
    lean = _lean(shape, (along + half) / gap)
    apex, _ = _placed(projection, shape.tip, 0.0, 0.0, 0.0)
    base, _ = _placed(projection, shape.tip - shape.point, 0.0, 0.0, 0.0)
    taper = (apex - base) * math.sqrt(1.0 - lean * lean) * radius / shape.shaft
    far, bow = _placed(projection, -3.0 * half, 0.0, 0.0, 0.0)
    for end in range(2):
        faces = (along + half * (2 * end - 1)) * (2 * end - 1) < 0.0
        _fill_end(projection, shape, end, faces, sine, arcs[end])
        _fill_shaft(projection, shape, end, faces, sine, lean, arcs[2 + end])
    return True, Outline(
        u0,
        v0,
        eu,
        ev,
        left,
        left_slope,
        right,
        right_slope,
        apex,
        taper,
        bow / (far * far),
        0.25 * length * length,
        arcs,
    )


@njit
def _pixel(c: Any, a: Any, s: float, intrinsics: Any, distortion: Any) -> Any:
    """Pixel of the axis' point `s` from the centre."""
    x, y, z = c[0] + s * a[0], c[1] + s * a[1], c[2] + s * a[2]
    x_d, y_d = distort_point(x / z, y / z, distortion)
    return intrinsics[0] * x_d + intrinsics[2], intrinsics[1] * y_d + intrinsics[3]


@njit
def _placed(projection: Any, s: float, radius: float, x: float, depth: float) -> Any:
    """Put the point `s` along the axis and `radius` (x, depth) off it into the frame: (e, n)."""
    c, a, t, f = projection.centre, projection.axis, projection.across, projection.facing
    px = c[0] + s * a[0] + radius * (x * t[0] + depth * f[0])
    py = c[1] + s * a[1] + radius * (x * t[1] + depth * f[1])
    pz = c[2] + s * a[2] + radius * (x * t[2] + depth * f[2])
    x_d, y_d = distort_point(px / pz, py / pz, projection.distortion)
    du = projection.intrinsics[0] * x_d + projection.intrinsics[2] - projection.u
    dv = projection.intrinsics[1] * y_d + projection.intrinsics[3] - projection.v
    return du * projection.eu + dv * projection.ev, dv * projection.eu - du * projection.ev


@njit
def _tangent(projection: Any, shape: Any, side: float, sine: float) -> Any:
    """Line of tangency on a side (-1 or 1): n at e = 0, and per pixel of e."""
    x = side * np.sqrt(1.0 - sine * sine)
    e1, n1 = _placed(projection, -shape.half, shape.radius, x, sine)
    e2, n2 = _placed(projection, shape.half, shape.radius, x, sine)
    slope = (n2 - n1) / (e2 - e1)
    return n1 - slope * e1, slope


@njit
def _fill_end(projection: Any, shape: Any, end: int, faces: bool, sine: float, arc: Any) -> None:
    """Fill the arc of the band's end to the hub (0) or tip (1).

    An end that `faces` the camera shows its face where the shaft does not hide it: there the arc is
    that of the shaft's circle, and beside a shaft that is thinner than the band the far half of the
    end.
    """
    s, cells = (2 * end - 1) * shape.half, len(arc)
    cosine = np.sqrt(1.0 - sine * sine)
    for j in range(cells):
        x = cosine * ((2 * j + 1.0) / cells - 1.0)
        depth = np.sqrt(1.0 - x * x)
        if faces:
            hidden = (shape.shaft / shape.radius) ** 2 - x * x
            depth = np.sqrt(hidden) if hidden >= 0.0 else -depth
        arc[j], _ = _placed(projection, s, shape.radius, x, depth)


@njit
def _fill_shaft(
    projection: Any, shape: Any, end: int, faces: bool, sine: float, lean: float, arc: Any
) -> None:
    """Fill where the strips of shaft or point leave the end to the hub (0) or tip (1).

    Strips of their own width are others than the band's: those of the point run together in its
    apex.
    """
    s, cells = (2 * end - 1) * shape.half, len(arc)
    cosine = np.sqrt(1.0 - sine * sine)
    cone = end == 1 and tapers_at_once(shape)
    thick = shape.shaft * min(1.0, (shape.tip - s) / shape.point)
    for j in range(cells):
        x = (2 * j + 1.0) / cells - 1.0
        wide = thick
        if thick < shape.radius and not faces:
            x, wide = x * thick / shape.radius, shape.radius  # the band's own edge hides the shaft
            x, depth = cosine * x, np.sqrt(1.0 - x * x)
        else:
            x, depth = _on_circle(x, lean if cone else 0.0)
        arc[j], _ = _placed(projection, s, wide, x, depth)


@njit
def tapers_at_once(shape: Any) -> bool:
    """Return whether the point begins where the band ends, or before."""
    return shape.tip - shape.point < 1.02 * shape.half


@njit
def _lean(shape: Any, cotangent: float) -> float:
    """κ of the point: how much wider or narrower its tangents are than its base.

    `cotangent` is that of the angle to the ray, below 0 where the tip points to the camera. Short
    of 1, where the camera looks at the point so steeply that it sees no tangents.
    """
    return min(0.95, max(-0.95, shape.shaft / shape.point * cotangent))


@njit
def _on_circle(x: float, lean: float) -> Any:
    """Sine and cosine of ψ where the point's strip X meets the circle of its base."""
    root = math.sqrt(1.0 - lean * lean)
    psi = math.asin(x / math.hypot(root, x * lean)) - math.atan2(x * lean, root)
    return math.sin(psi), math.cos(psi)
