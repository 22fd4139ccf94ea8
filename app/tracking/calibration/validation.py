"""The test that counts: boards that took no part, triangulated, against their true geometry."""

from collections.abc import Sequence

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.tracking.calibration.poses import rigid_fit
from app.tracking.calibration.views import BoardView
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import StereoCalibration, Validation
from app.tracking.optics.camera_model import CameraModel

LEAST_SHARED = 6

ViewPair = tuple[BoardView, BoardView]


def validate(calibration: StereoCalibration, pairs: Sequence[ViewPair]) -> Validation:
    """Triangulate boards and compare them with what is printed.

    `scale` compares lengths with the board's. For the board of the calibration that tells whether
    the two cameras fit together, not whether its squares were entered right: both would be wrong
    by the same factor. For that another board or a length known otherwise is needed.

    Args:
        calibration: the two cameras.
        pairs: views of one board by both, corner orders matching.

    Raises:
        CalibrationError: if no pair shares six corners.
    """
    left, right = _in_left_frame(calibration)
    boards = [shared for pair in pairs if (shared := _shared(*pair)) is not None]
    if not boards:
        raise CalibrationError(
            sentence(
                "none of {pairs} pairs shares {least_shared} corners; nothing can be validated",
                pairs=len(pairs),
                least_shared=LEAST_SHARED,
            )
        )
    distances, scales, lines, far = [], [], [], []
    for view_left, view_right in boards:
        points = triangulated(left, right, view_left.pixels, view_right.pixels)
        board = view_left.points
        away = rigid_fit(board, points) @ board - points
        distances.append(np.linalg.norm(away, axis=1))
        scales.append(board_scale(board, points))
        middle = points.mean(axis=0)
        far.append(np.mean([np.linalg.norm(middle - model.centre) for model in (left, right)]))
        lines.append(epipolar_distances(left, right, view_left.pixels, view_right.pixels))
    away_mm = np.concatenate(distances) / MILLIMETRE
    spread = float(np.std(scales, ddof=1) / np.sqrt(len(scales))) if len(scales) > 1 else 0.0
    return Validation(
        views=len(boards),
        points=int(away_mm.size),
        rms_mm=float(np.sqrt(np.mean(away_mm**2))),
        max_mm=float(away_mm.max()),
        scale=float(np.mean(scales)),
        scale_sd=spread,
        epipolar_px=float(np.sqrt(np.mean(np.concatenate(lines) ** 2))),
        distance_mm=float(np.mean(far)) / MILLIMETRE,
    )


def board_scale(board: FloatArray, points: FloatArray) -> float:
    """Mean measured over true length of neighbouring corners, shape (n, 3) each [m]."""
    apart = np.linalg.norm(board[:, None] - board[None], axis=2)
    step = apart[apart > 0.0].min()
    i, j = np.nonzero(np.triu(np.abs(apart - step) < 0.01 * step))
    return float(np.linalg.norm(points[i] - points[j], axis=1).mean() / step)


def triangulated(
    left: CameraModel, right: CameraModel, pixels_left: FloatArray, pixels_right: FloatArray
) -> FloatArray:
    """Points nearest to both rays (midpoint of the shortest distance) in the left frame, (n, 3).

    Raises:
        CalibrationError: if a pixel has no ray, or two rays are parallel.
    """
    from_left, from_right = _rays(left, pixels_left), _rays(right, pixels_right)
    between = right.centre - left.centre
    a, b = (from_left**2).sum(axis=1), (from_left * from_right).sum(axis=1)
    c = (from_right**2).sum(axis=1)
    d, e = from_left @ between, from_right @ between
    determinant = a * c - b * b
    if determinant.min() <= 1e-12 * float((a * c).max()):
        raise CalibrationError(
            sentence("rays of the two cameras are parallel; nothing can be triangulated")
        )
    s, t = (c * d - b * e) / determinant, (b * d - a * e) / determinant
    near_left = left.centre + s[:, None] * from_left
    near_right = right.centre + t[:, None] * from_right
    result: FloatArray = 0.5 * (near_left + near_right)
    return result


def epipolar_distances(
    left: CameraModel, right: CameraModel, pixels_left: FloatArray, pixels_right: FloatArray
) -> FloatArray:
    """Signed distance of undistorted right pixels from the left ones' epipolar lines [px], (n,)."""
    T_right_left = right.T_camera_world @ left.T_world_camera
    t = T_right_left.translation
    cross = np.array([[0.0, -t[2], t[1]], [t[2], 0.0, -t[0]], [-t[1], t[0], 0.0]])
    essential = cross @ T_right_left.rotation
    x_left, x_right = _normalised(left, pixels_left), _normalised(right, pixels_right)
    lines = x_left @ essential.T
    focal = float(np.sqrt(right.intrinsics[0] * right.intrinsics[1]))
    norm = np.maximum(np.linalg.norm(lines[:, :2], axis=1), 1e-300)
    result: FloatArray = focal * (lines * x_right).sum(axis=1) / norm
    return result


def _in_left_frame(calibration: StereoCalibration) -> tuple[CameraModel, CameraModel]:
    first, second = calibration.cameras
    return (
        first.model(RigidTransform.identity()),
        second.model(calibration.pose.transform.inverse()),
    )


def _shared(left: BoardView, right: BoardView) -> ViewPair | None:
    """Return both views with only the corners that both have, or None if they are too few."""
    common = np.intersect1d(left.ids, right.ids)
    if common.size < LEAST_SHARED:
        return None
    first, second = (
        BoardView(v.board, common, v.pixels[np.isin(v.ids, common)], v.image_size, name=v.name)
        for v in (left, right)
    )
    return first, second


def _normalised(camera: CameraModel, pixels: FloatArray) -> FloatArray:
    rays, found = camera.undistort(pixels)
    if not found.all():
        raise CalibrationError(
            sentence(
                "camera {camera_name}: {missing} corners lie where its distortion folds "
                "back; the calibration does not reach there",
                camera_name=camera.name,
                missing=int((~found).sum()),
            )
        )
    return np.column_stack([rays, np.ones(len(rays))])


def _rays(camera: CameraModel, pixels: FloatArray) -> FloatArray:
    return camera.T_world_camera.rotate(_normalised(camera, pixels))
