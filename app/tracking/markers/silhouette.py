"""How far the centroid of the band's visible outline is from the picture of its centre.

The band is a convex body, so its outline is the convex hull of the pictures of its two end circles;
the shaft that leaves the end turned to the camera hides part of that. Perspective and the hidden
part move the outline's centroid away from the picture of the band's centre: by up to 0.5 px
where the needle leans towards the camera. With the axis known the shift is computed and taken off.
"""

import cv2
import numpy as np

from app.core.arrays import FloatArray, unit
from app.core.rotation import skew
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleShape

_CORNERS = 24
_ANGLES = 2.0 * np.pi * np.arange(_CORNERS) / _CORNERS
_CIRCLE = np.column_stack([np.cos(_ANGLES), np.sin(_ANGLES)]) * np.sqrt(
    2.0 * np.pi / (_CORNERS * np.sin(2.0 * np.pi / _CORNERS))
)
"""Unit circle as a polygon of the same area: neither inside nor outside on average."""


def centroid_shift(
    model: CameraModel, needle: NeedleShape, p_world: FloatArray, axis_world: FloatArray
) -> FloatArray | None:
    """Outline's centroid minus the picture of the band's centre [px], shape (2,).

    None where the band has no picture (behind the camera, beyond the fold).
    """
    centre = model.T_camera_world @ p_world
    axis = model.T_camera_world.rotate(axis_world)
    points = _body(needle, centre, axis)
    uv, ok = model.project_camera(np.vstack([points, centre]))
    if not ok.all():
        return None
    uv = (uv - uv[-1]).astype(np.float32)  # about the centre: single precision suffices then
    outline = cv2.convexHull(uv[: 2 * _CORNERS]).reshape(-1, 2)
    shaft = cv2.convexHull(uv[2 * _CORNERS : -1]).reshape(-1, 2)
    area, first = _moments(outline)
    hidden_area, hidden = 0.0, np.zeros(2)
    overlap, common = cv2.intersectConvexConvex(outline, shaft)
    if overlap > 0.0 and common is not None:
        hidden_area, hidden = _moments(common.reshape(-1, 2))
    visible = area - hidden_area
    return (first - hidden) / visible if visible > 0.0 else None


def _body(needle: NeedleShape, centre: FloatArray, axis: FloatArray) -> FloatArray:
    """Corners in the camera frame: both end circles, then the shaft before the near end."""
    turn = skew(axis)
    across = unit(turn[:, int(np.argmin(np.abs(axis)))])
    ring = _CIRCLE @ np.array([across, turn @ across])
    towards = -1.0 if axis @ centre > 0.0 else 1.0  # which end of the band faces the camera
    if towards > 0.0:
        stations = [needle.half, max(needle.half, needle.tip - needle.point), needle.tip]
    else:
        stations = [-needle.half, -needle.half - 3.0 * needle.radius]
    ends = [(needle.half, needle.radius), (-needle.half, needle.radius)]
    shaft = [(s, needle.shaft * min(1.0, (needle.tip - s) / needle.point)) for s in stations]
    return np.vstack([centre + s * axis + radius * ring for s, radius in ends + shaft])


def _moments(polygon: FloatArray) -> tuple[float, FloatArray]:
    """Area of a convex polygon [px²] and its first moments [px³], shape (2,)."""
    x, y = polygon.astype(np.float64).T
    next_x, next_y = np.concatenate([x[1:], x[:1]]), np.concatenate([y[1:], y[:1]])
    cross = x * next_y - next_x * y
    first = np.array([(x + next_x) @ cross, (y + next_y) @ cross])
    total = float(cross.sum())
    sign = 1.0 if total >= 0.0 else -1.0
    return 0.5 * sign * total, sign * first / 6.0
