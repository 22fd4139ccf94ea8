"""How far the centroid of the band's visible outline is from the picture of its centre (compiled).

The band is a convex body, so its outline is the convex hull of the pictures of its two end circles;
the shaft that leaves the end turned to the camera hides part of that. Perspective and the hidden
part move the outline's centroid away from the picture of the band's centre: by up to 0.5 px
where the needle leans towards the camera. With the axis known the shift is computed and taken off.

Polygons are convex; corners stand in rows, counter-clockwise (x to the right, y up); a count says
how many there are.
"""

from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.packed import packed, project_point, to_camera
from app.tracking.optics.rig import NeedleShape


@njit
def turn(ax: float, ay: float, bx: float, by: float, cx: float, cy: float) -> float:
    """Twice the area of a triangle, positive if its corners go round counter-clockwise."""
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)


@njit
def sort_points(points: Any) -> None:
    """Sort by x, equal ones by y, in place: there are some dozens."""
    for i in range(1, points.shape[0]):
        x, y, k = points[i, 0], points[i, 1], i
        while k > 0 and (points[k - 1, 0] > x or (points[k - 1, 0] == x and points[k - 1, 1] > y)):
            points[k, 0], points[k, 1] = points[k - 1, 0], points[k - 1, 1]
            k -= 1
        points[k, 0], points[k, 1] = x, y


@njit
def convex_hull(points: Any, hull: Any) -> int:
    """Corners of the convex hull (Andrew's monotone chain, 1979); returns how many.

    Args:
        points: finite, (n, 2); sorted in place.
        hull: out, (2 n, 2).
    """
    sort_points(points)
    n, count = points.shape[0], 0
    for half in range(2):  # lower from left to right, then upper back
        start = count + 1
        for step in range(n):
            p = points[n - 1 - step] if half else points[step]
            if half and step == 0:
                continue  # the lower half's last
            while (
                count >= start + (0 if half else 1)
                and turn(
                    hull[count - 2, 0],
                    hull[count - 2, 1],
                    hull[count - 1, 0],
                    hull[count - 1, 1],
                    p[0],
                    p[1],
                )
                <= 0.0
            ):
                count -= 1
            hull[count, 0], hull[count, 1] = p[0], p[1]
            count += 1
    return count - 1  # the first again


@njit
def common_part(subject: Any, size: int, cutter: Any, edges: int, out: Any, other: Any) -> int:
    """Cut a convex polygon by another (Sutherland and Hodgman 1974); returns the count of corners.

    Args:
        subject: corners, (at least size, 2).
        size: how many.
        cutter: corners of the other, (at least edges, 2).
        edges: how many; fewer than three enclose nothing.
        out: out, (at least size + edges, 2).
        other: memory of the same shape.
    """
    if size < 3 or edges < 3:
        return 0
    for k in range(size):
        out[k, 0], out[k, 1] = subject[k, 0], subject[k, 1]
    count = size
    for j in range(edges):
        ax, ay = cutter[j, 0], cutter[j, 1]
        bx, by = cutter[(j + 1) % edges, 0], cutter[(j + 1) % edges, 1]
        kept = 0
        for k in range(count):
            px, py = out[k, 0], out[k, 1]
            qx, qy = out[(k + 1) % count, 0], out[(k + 1) % count, 1]
            p, q = turn(ax, ay, bx, by, px, py), turn(ax, ay, bx, by, qx, qy)
            if p >= 0.0:
                other[kept, 0], other[kept, 1] = px, py
                kept += 1
            if (p >= 0.0) != (q >= 0.0):
                share = p / (p - q)
                other[kept, 0], other[kept, 1] = px + share * (qx - px), py + share * (qy - py)
                kept += 1
        count = kept
        for k in range(count):
            out[k, 0], out[k, 1] = other[k, 0], other[k, 1]
        if count < 3:
            return 0
    return count


@njit
def moments(corners: Any, count: int) -> Any:
    """Area of a polygon [px²] and its first moments [px³]: (area, by x, by y)."""
    area, mx, my = 0.0, 0.0, 0.0
    for k in range(count):
        x, y = corners[k, 0], corners[k, 1]
        nx, ny = corners[(k + 1) % count, 0], corners[(k + 1) % count, 1]
        cross = x * ny - nx * y
        area += 0.5 * cross
        mx += (x + nx) * cross / 6.0
        my += (y + ny) * cross / 6.0
    return area, mx, my


@njit
def hull_of(points: Any) -> Any:
    """Convex hull of points, (n, 2), as an array of its own and the count of corners."""
    hull = np.empty((2 * points.shape[0], 2))
    return hull, convex_hull(points, hull)


_CORNERS: Final = 24
_ANGLES = 2.0 * np.pi * np.arange(_CORNERS) / _CORNERS
_CIRCLE: Final = np.column_stack([np.cos(_ANGLES), np.sin(_ANGLES)]) * np.sqrt(
    2.0 * np.pi / (_CORNERS * np.sin(2.0 * np.pi / _CORNERS))
)
"""Unit circle as a polygon of the same area: neither inside nor outside on average."""


def centroid_shift(
    model: CameraModel, needle: NeedleShape, p_world: FloatArray, axis_world: FloatArray
) -> FloatArray | None:
    """Outline's centroid minus the picture of the band's centre [px], shape (2,).

    None where the band has no picture (behind the camera, beyond the fold).
    """
    shift, point = np.empty(2), np.array(p_world, dtype=np.float64)
    axis = np.array(axis_world, dtype=np.float64)
    area = outline_shift(packed(model), np.array(needle), point, axis, shift)
    return shift if area > 0.0 else None


def visible_area(
    model: CameraModel, needle: NeedleShape, p_world: FloatArray, axis_world: FloatArray
) -> float:
    """Return the area of the band's outline that its own shaft does not hide [px²]; 0 without."""
    point, axis = np.array(p_world, dtype=np.float64), np.array(axis_world, dtype=np.float64)
    return float(outline_shift(packed(model), np.array(needle), point, axis, np.empty(2)))


@njit
def outline_shift(camera: Any, needle: Any, p_world: Any, axis_world: Any, shift: Any) -> float:
    """Fill the shift of `centroid_shift`; return the visible area, 0 where there is no picture.

    Args:
        camera: see `optics.packed`.
        needle: a `rig.NeedleShape` as an array.
        p_world: centre of the band [m], (3,).
        axis_world: unit vector from hub to tip, (3,).
        shift: out [px], (2,).
    """
    centre, axis = np.empty(3), np.empty(3)
    to_camera(camera, p_world, 1.0, centre)
    to_camera(camera, axis_world, 0.0, axis)
    u, v, seen = project_point(camera, centre[0], centre[1], centre[2])
    circles = np.empty((5, 2))
    along = axis[0] * centre[0] + axis[1] * centre[1] + axis[2] * centre[2]
    rings = 2 + _circles(needle, along > 0.0, circles)
    points = np.empty((rings * _CORNERS, 2))
    if not (seen and _rings(camera, centre, axis, circles[:rings], u, v, points)):
        return 0.0
    outline, corners = hull_of(points[: 2 * _CORNERS])
    shaft, edges = hull_of(points[2 * _CORNERS :])
    visible, mu, mv = moments(outline, corners)
    common, other = np.empty((corners + edges, 2)), np.empty((corners + edges, 2))
    count = common_part(outline, corners, shaft, edges, common, other)
    if count > 0:
        hidden, hu, hv = moments(common, count)
        visible, mu, mv = visible - hidden, mu - hu, mv - hv
    if not visible > 0.0:
        return 0.0
    shift[0], shift[1] = mu / visible, mv / visible
    return float(visible)


@njit
def _circles(needle: Any, away: bool, circles: Any) -> int:
    """Fill position and radius of both end circles of the band and of the shaft before it.

    The shaft counts that leaves the end which faces the camera: the hub's where the needle points
    `away` from it. Returns how many circles of it there are.
    """
    shaft, radius, half, tip, point = needle[0], needle[1], needle[2], needle[3], needle[5]
    circles[0, 0], circles[1, 0] = half, -half
    circles[:2, 1] = radius
    if away:
        count, circles[2, 0], circles[3, 0] = 2, -half, -half - 3.0 * radius
    else:
        count, circles[2, 0], circles[3, 0], circles[4, 0] = 3, half, max(half, tip - point), tip
    for k in range(2, 2 + count):
        circles[k, 1] = shaft * min(1.0, (tip - circles[k, 0]) / point)
    return count


@njit
def _rings(
    camera: Any, centre: Any, axis: Any, circles: Any, u: float, v: float, points: Any
) -> bool:
    """Fill the pixels of circles about the axis, from the pixel of the centre; False without."""
    x, y, z = axis[0], axis[1], axis[2]
    a, b = np.zeros(3), np.empty(3)
    if abs(x) <= min(abs(y), abs(z)):  # across the axis: its product with the unit vector
        a[1], a[2] = z, -y  # that it is furthest from
    elif abs(y) <= abs(z):
        a[0], a[2] = -z, x
    else:
        a[0], a[1] = y, -x
    length = np.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])
    if not length > 0.0:
        return False
    a /= length
    b[0], b[1], b[2] = y * a[2] - z * a[1], z * a[0] - x * a[2], x * a[1] - y * a[0]
    for i in range(circles.shape[0]):
        s, radius = circles[i, 0], circles[i, 1]
        for j in range(_CORNERS):
            p, q = radius * _CIRCLE[j, 0], radius * _CIRCLE[j, 1]
            pu, pv, seen = project_point(
                camera,
                centre[0] + s * x + p * a[0] + q * b[0],
                centre[1] + s * y + p * a[1] + q * b[1],
                centre[2] + s * z + p * a[2] + q * b[2],
            )
            if not seen:
                return False
            points[i * _CORNERS + j, 0], points[i * _CORNERS + j, 1] = pu - u, pv - v
    return True
