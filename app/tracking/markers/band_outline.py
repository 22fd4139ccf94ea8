"""Where the band's edges lie in a picture, seen through lens and perspective (compiled).

The band is a cylinder. The camera sees the half of it between two lines of tangency; a point of
that half has the coordinate x across, from -1 to 1 between the tangents, and its end circles give
two arcs. All are projected through the camera with its distortion and given in a frame of the
picture: origin at the picture of the band's centre, `e` along the needle towards the tip, `n`
across.

An end that faces the camera shows its face where the shaft does not hide it: there the arc is that
of the shaft's circle, and beside a shaft that is thinner than the band the far half of the end.

Shaft and point begin where the strips of their own width meet the end, which are others than the
band's: those of the point run together in its apex. A line through the apex's picture meets the
end's circle, of the needle's radius r there, at the angle ψ from the direction to the camera with

    X = sin ψ · √(1 - κ²) / (1 - κ cos ψ),   κ = (r / length of the point) · cot(angle to the ray)

X from -1 to 1 between the tangents from the apex; for a cylinder κ = 0 and X = sin ψ.
"""

import math
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.tracking.optics.distortion import distort_point
from app.tracking.optics.rig import NeedleShape

FRAME: Final = 12

ARCS: Final = 4

_FEWEST, _MOST = 10, 40


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
def _pixel(x: float, y: float, z: float, intrinsics: Any, distortion: Any) -> Any:
    x_d, y_d = distort_point(x / z, y / z, distortion)
    return intrinsics[0] * x_d + intrinsics[2], intrinsics[1] * y_d + intrinsics[3]


@njit
def outline(
    c: Any, a: Any, shape: Any, intrinsics: Any, distortion: Any, arcs: Any, frame: Any
) -> bool:
    """Fill the band's outline; False where it has none (behind the camera, seen end on).

    Args:
        c: centre of the band in the camera frame [m].
        a: unit vector from hub to tip, camera frame.
        shape: a `rig.NeedleShape`.
        intrinsics: fx, fy, cx, cy.
        distortion: k1, k2, p1, p2, k3.
        arcs: out, (ARCS, strips): e of both ends [px] at the middle of each of the band's strips,
            hub end first; the same of the strips of the shaft that leaves them.
        frame: out, (FRAME,): origin u, v; e's u, v; n of the tangents x = -1 and x = 1, each at
            e = 0 and per pixel of e; e of the apex, and what e before it makes the point as wide
            as the band; n per e² by the lens' distortion, and the e² of the ends, where the
            tangents are exact.
    """
    radius, half = shape[1], shape[2]
    along = c[0] * a[0] + c[1] * a[1] + c[2] * a[2]
    fx, fy, fz = along * a[0] - c[0], along * a[1] - c[1], along * a[2] - c[2]
    gap = np.sqrt(fx * fx + fy * fy + fz * fz)
    if not (c[2] > 4.0 * half and gap > 4.0 * radius):
        return False
    fx, fy, fz = fx / gap, fy / gap, fz / gap
    tx, ty, tz = a[1] * fz - a[2] * fy, a[2] * fx - a[0] * fz, a[0] * fy - a[1] * fx
    u0, v0 = _pixel(c[0], c[1], c[2], intrinsics, distortion)
    u1, v1 = _pixel(
        c[0] - half * a[0], c[1] - half * a[1], c[2] - half * a[2], intrinsics, distortion
    )
    u2, v2 = _pixel(
        c[0] + half * a[0], c[1] + half * a[1], c[2] + half * a[2], intrinsics, distortion
    )
    length = np.hypot(u2 - u1, v2 - v1)
    if not length > 2.0:
        return False
    eu, ev = (u2 - u1) / length, (v2 - v1) / length
    sine = radius / gap
    cosine = np.sqrt(1.0 - sine * sine)
    frame[0], frame[1], frame[2], frame[3] = u0, v0, eu, ev
    lean = _lean(shape, (along + half) / gap)
    reach = np.empty(2)
    for k in range(2):
        s = shape[3] - k * shape[5]
        u, v = _pixel(c[0] + s * a[0], c[1] + s * a[1], c[2] + s * a[2], intrinsics, distortion)
        reach[k] = (u - u0) * eu + (v - v0) * ev
    frame[8] = reach[0]
    frame[9] = (reach[0] - reach[1]) * math.sqrt(1.0 - lean * lean) * radius / shape[0]
    u, v = _pixel(
        c[0] - 3.0 * half * a[0], c[1] - 3.0 * half * a[1], c[2] - 3.0 * half * a[2],
        intrinsics, distortion,
    )  # fmt: skip
    far = (u - u0) * eu + (v - v0) * ev
    frame[10], frame[11] = ((v - v0) * eu - (u - u0) * ev) / (far * far), 0.25 * length * length
    for side in range(2):
        x = -cosine if side == 0 else cosine
        n, e = np.empty(2), np.empty(2)
        for end in range(2):
            s = half if end else -half
            u, v = _pixel(
                c[0] + s * a[0] + radius * (x * tx + sine * fx),
                c[1] + s * a[1] + radius * (x * ty + sine * fy),
                c[2] + s * a[2] + radius * (x * tz + sine * fz),
                intrinsics,
                distortion,
            )
            e[end] = (u - u0) * eu + (v - v0) * ev
            n[end] = (v - v0) * eu - (u - u0) * ev
        slope = (n[1] - n[0]) / (e[1] - e[0])
        frame[4 + 2 * side], frame[5 + 2 * side] = n[0] - slope * e[0], slope
    if frame[4] > frame[6]:  # n grows with x
        for k in range(2):
            frame[4 + k], frame[6 + k] = frame[6 + k], frame[4 + k]
        tx, ty, tz = -tx, -ty, -tz
    cells = arcs.shape[1]
    for end in range(2):
        s = half if end else -half
        faces = (along + s) * s < 0.0
        for j in range(cells):
            x = cosine * ((2 * j + 1.0) / cells - 1.0)
            depth = np.sqrt(1.0 - x * x)
            if faces:
                hidden = (shape[0] / radius) ** 2 - x * x
                depth = np.sqrt(hidden) if hidden >= 0.0 else -depth
            u, v = _pixel(
                c[0] + s * a[0] + radius * (x * tx + depth * fx),
                c[1] + s * a[1] + radius * (x * ty + depth * fy),
                c[2] + s * a[2] + radius * (x * tz + depth * fz),
                intrinsics,
                distortion,
            )
            arcs[end, j] = (u - u0) * eu + (v - v0) * ev
        cone = end == 1 and tapers_at_once(shape)
        thick = shape[0] * min(1.0, (shape[3] - s) / shape[5])
        for j in range(cells):
            x = (2 * j + 1.0) / cells - 1.0
            wide = thick
            if thick < radius and not faces:
                x, wide = x * thick / radius, radius  # the band's own edge hides the shaft
                x, depth = cosine * x, np.sqrt(1.0 - x * x)
            else:
                x, depth = _on_circle(x, lean if cone else 0.0)
            u, v = _pixel(
                c[0] + s * a[0] + wide * (x * tx + depth * fx),
                c[1] + s * a[1] + wide * (x * ty + depth * fy),
                c[2] + s * a[2] + wide * (x * tz + depth * fz),
                intrinsics,
                distortion,
            )
            arcs[2 + end, j] = (u - u0) * eu + (v - v0) * ev
    return True


@njit
def tapers_at_once(shape: Any) -> bool:
    """Whether the point begins where the band ends, or before."""
    return shape[3] - shape[5] < 1.02 * shape[2]


@njit
def _lean(shape: Any, cotangent: float) -> float:
    """κ of the point: how much wider or narrower its tangents are than its base.

    `cotangent` is that of the angle to the ray, below 0 where the tip points to the camera. Short
    of 1, where the camera looks at the point so steeply that it sees no tangents.
    """
    return min(0.95, max(-0.95, shape[0] / shape[5] * cotangent))


@njit
def _on_circle(x: float, lean: float) -> Any:
    """Sine and cosine of ψ where the point's strip X meets the circle of its base."""
    root = math.sqrt(1.0 - lean * lean)
    psi = math.asin(x / math.hypot(root, x * lean)) - math.atan2(x * lean, root)
    return math.sin(psi), math.cos(psi)
