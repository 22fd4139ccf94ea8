"""The webcam's picture with what was found in it: markers, axes, the tip and its error."""

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.tracking.cameras.camera import Image
from app.tracking.confidence import chi_square_quantile
from app.tracking.pen.pose import BoardPose, PoseStatus, projection_jacobians
from app.tracking.pen.step import PenObservation

_SEEN, _NUMBER, _RIM = (80, 200, 80), (255, 255, 255), (0, 0, 0)
_AXES = ((60, 60, 230), (80, 200, 80), (230, 120, 60))  # x red, y green, z blue
_TIP = (0, 215, 255)
_LENGTH = 0.03
"""Length of a drawn axis [m]."""
_SHIFT = 4  # OpenCV draws in sixteenths of a pixel
_WIDE = 640
"""Width [px] of a picture for which a line is as wide as it says; wider ones have wider lines."""


def draw_observation(image: Image, seen: PenObservation) -> Image:
    """Return a copy of the picture with everything that was found drawn into it."""
    drawn = image.copy()
    scale = max(1, round(image.shape[1] / _WIDE))
    for marker in seen.sightings.markers:
        cv2.polylines(drawn, [_fixed(marker.corners)], True, _SEEN, 2 * scale, cv2.LINE_AA, _SHIFT)
        _number(drawn, str(marker.id), marker.corners.mean(axis=0), scale)
    for pose in (seen.base, seen.body):
        if pose.status is PoseStatus.FOUND:
            _axes(drawn, seen, pose)
    if seen.needle is not None:
        _needle(drawn, seen)
    return drawn


def _number(image: Image, text: str, middle: FloatArray, scale: int) -> None:
    """Write white with a black rim: legible on paper and on ink."""
    font, size = cv2.FONT_HERSHEY_SIMPLEX, 0.45 * scale
    (wide, high), _ = cv2.getTextSize(text, font, size, scale)
    place = (round(middle[0] - 0.5 * wide), round(middle[1] + 0.5 * high))
    cv2.putText(image, text, place, font, size, _RIM, 4 * scale, cv2.LINE_AA)
    cv2.putText(image, text, place, font, size, _NUMBER, scale, cv2.LINE_AA)


def _axes(image: Image, seen: PenObservation, pose: BoardPose) -> None:
    points = pose.T_camera_board @ np.vstack([np.zeros(3), _LENGTH * np.eye(3)])
    uv, ok = seen.model.project_camera(points)
    for end, visible, colour in zip(uv[1:], ok[1:], _AXES, strict=True):
        if ok[0] and visible:
            _line(image, uv[0], end, colour, 3 * max(1, round(image.shape[1] / _WIDE)))


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
    scale = max(1, round(image.shape[1] / _WIDE))
    _line(image, uv[0], uv[1], _TIP, 2 * scale)
    slopes = projection_jacobians(seen.model, ends[1:])[0] @ T_camera_world.rotation
    spread = slopes @ needle.tip_covariance @ slopes.T
    values, vectors = np.linalg.eigh(spread)
    radii = np.sqrt(np.maximum(values, 0.0) * chi_square_quantile(0.95, 2))
    turns = np.linspace(0.0, 2.0 * np.pi, 37)
    ellipse = uv[1] + np.column_stack([np.cos(turns), np.sin(turns)]) * radii @ vectors.T
    if np.abs(ellipse).max() < 1e4:
        for colour, width in ((_RIM, 4 * scale), (_TIP, 2 * scale)):
            cv2.polylines(image, [_fixed(ellipse)], True, colour, width, cv2.LINE_AA, _SHIFT)


def _line(
    image: Image, start: FloatArray, end: FloatArray, colour: tuple[int, int, int], width: int
) -> None:
    if max(np.abs(start).max(), np.abs(end).max()) < 1e4:
        a, b = _fixed(np.array([start, end]))
        cv2.line(image, tuple(a.tolist()), tuple(b.tolist()), colour, width, cv2.LINE_AA, _SHIFT)


def _fixed(points: FloatArray) -> np.ndarray:
    return np.rint(points * 2**_SHIFT).astype(np.int32)
