"""The webcam's picture with what was found in it: markers, axes, the tip and its error."""

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.tracking.cameras.camera import Image
from app.tracking.confidence import chi_square_quantile
from app.tracking.pen.pose import BoardPose, PoseStatus
from app.tracking.pen.projection import projection_jacobians
from app.tracking.pen.step import PenObservation

_SEEN, _LOST = (80, 200, 80), (60, 60, 220)
_AXES = ((60, 60, 230), (80, 200, 80), (230, 120, 60))  # x red, y green, z blue
_TIP = (0, 215, 255)
_LENGTH = 0.03
"""Length of a drawn axis [m]."""
_SHIFT = 4  # OpenCV draws in sixteenths of a pixel


def draw_observation(image: Image, seen: PenObservation) -> Image:
    """Return a copy of the picture with everything that was found drawn into it."""
    drawn = image.copy()
    for marker in seen.sightings.markers:
        cv2.polylines(drawn, [_fixed(marker.corners)], True, _SEEN, 1, cv2.LINE_AA, _SHIFT)
        place = tuple(int(c) for c in marker.corners.mean(axis=0))
        cv2.putText(drawn, str(marker.id), place, cv2.FONT_HERSHEY_SIMPLEX, 0.4, _LOST, 1)
    for pose in (seen.base, seen.body):
        if pose.status is PoseStatus.FOUND:
            _axes(drawn, seen, pose)
    if seen.needle is not None:
        _needle(drawn, seen)
    return drawn


def _axes(image: Image, seen: PenObservation, pose: BoardPose) -> None:
    points = pose.T_camera_board @ np.vstack([np.zeros(3), _LENGTH * np.eye(3)])
    uv, ok = seen.model.project_camera(points)
    for end, visible, colour in zip(uv[1:], ok[1:], _AXES, strict=True):
        if ok[0] and visible:
            _line(image, uv[0], end, colour, 2)


def _needle(image: Image, seen: PenObservation) -> None:
    """Draw the shaft from the cube to the tip, and the tip's 95 % ellipse."""
    needle = seen.needle
    if needle is None:
        return
    T_camera_world = needle.T_world_camera.inverse()
    ends = T_camera_world @ np.vstack([needle.T_world_body.translation, needle.p_tip])
    uv, ok = seen.model.project_camera(ends)
    if not ok.all():
        return
    _line(image, uv[0], uv[1], _TIP, 1)
    slopes = projection_jacobians(seen.model, ends[1:])[0] @ T_camera_world.rotation
    spread = slopes @ needle.tip_covariance @ slopes.T
    values, vectors = np.linalg.eigh(spread)
    radii = np.sqrt(np.maximum(values, 0.0) * chi_square_quantile(0.95, 2))
    turns = np.linspace(0.0, 2.0 * np.pi, 37)
    ellipse = uv[1] + np.column_stack([np.cos(turns), np.sin(turns)]) * radii @ vectors.T
    if np.abs(ellipse).max() < 1e4:
        cv2.polylines(image, [_fixed(ellipse)], True, _TIP, 1, cv2.LINE_AA, _SHIFT)


def _line(
    image: Image, start: FloatArray, end: FloatArray, colour: tuple[int, int, int], width: int
) -> None:
    if max(np.abs(start).max(), np.abs(end).max()) < 1e4:
        a, b = _fixed(np.array([start, end]))
        cv2.line(image, tuple(a.tolist()), tuple(b.tolist()), colour, width, cv2.LINE_AA, _SHIFT)


def _fixed(points: FloatArray) -> np.ndarray:
    return np.rint(points * 2**_SHIFT).astype(np.int32)
