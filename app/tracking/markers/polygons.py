"""Convex polygons in a picture: hull, common part, area and moments (compiled).

Corners stand in rows, counter-clockwise (x to the right, y up); a count says how many there are.
"""

from typing import Any

import numpy as np

from app.core.compiled import njit


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
                    hull[count - 2, 0], hull[count - 2, 1], hull[count - 1, 0], hull[count - 1, 1],
                    p[0], p[1],
                ) <= 0.0
            ):  # fmt: skip
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
