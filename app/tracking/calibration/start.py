"""First estimate of a camera and its boards: OpenCV's calibration with every coefficient."""

from collections.abc import Sequence

import cv2
import numpy as np

from app.core.transform import RigidTransform
from app.tracking.calibration.sightings import State
from app.tracking.calibration.views import BoardView
from app.tracking.errors import CalibrationError

_NO_DISTORTION = (
    cv2.CALIB_FIX_K1 | cv2.CALIB_FIX_K2 | cv2.CALIB_FIX_K3 | cv2.CALIB_ZERO_TANGENT_DIST
)


def first_estimate(views: Sequence[BoardView]) -> State:
    """Camera with five distortion coefficients and the boards' poses, by `calibrateCameraExtended`.

    Raises:
        CalibrationError: if no camera explains the views, with and without distortion.
    """
    for flags in (0, _NO_DISTORTION):
        state = _opencv(views, flags)
        if state is not None:
            return state
    raise CalibrationError(
        f"no camera explains the {len(views)} views; tilt the board to different sides by 20 to "
        "45 degrees, and check the board's counts"
    )


def usual_rms(views: Sequence[BoardView]) -> float | None:
    """Reprojection error of OpenCV's plain recipe: all views, five coefficients [px]."""
    try:
        found = cv2.calibrateCamera(*_arguments(views), None, None)[0]
    except cv2.error:
        return None
    return float(found) if np.isfinite(found) else None


def usual_stereo_rms(pairs: Sequence[tuple[BoardView, BoardView]]) -> float | None:
    """Reprojection error of OpenCV's plain recipe for two cameras: all pairs, fixed lenses [px]."""
    both = [(a, b) for a, b in pairs if np.array_equal(a.ids, b.ids)]
    if not both or {a.image_size for a, _ in both} != {b.image_size for _, b in both}:
        return None
    (points, left, size), (_, right, _) = (_arguments([p[side] for p in both]) for side in (0, 1))
    try:
        lenses = [
            cv2.calibrateCamera(points, pixels, size, None, None)[1:3] for pixels in (left, right)
        ]
        found = cv2.stereoCalibrate(
            points, left, right, *lenses[0], *lenses[1], size, flags=cv2.CALIB_FIX_INTRINSIC
        )[0]
    except cv2.error:
        return None
    return float(found) if np.isfinite(found) else None


def _arguments(views: Sequence[BoardView]) -> tuple[list[object], list[object], tuple[int, int]]:
    points: list[object] = [view.points.astype(np.float32) for view in views]
    pixels: list[object] = [view.pixels.astype(np.float32).reshape(-1, 1, 2) for view in views]
    return points, pixels, views[0].image_size


def _opencv(views: Sequence[BoardView], flags: int) -> State | None:
    """OpenCV's estimate, or None where it fails, is not finite or has boards behind the camera."""
    try:
        found = cv2.calibrateCameraExtended(*_arguments(views), None, None, flags=flags)
    except cv2.error:
        return None
    K, coefficients, turns, shifts = found[1:5]
    lens = np.zeros(5)
    lens[: min(5, coefficients.size)] = coefficients.ravel()[:5]
    parameters = np.array([K[0, 0], K[1, 1], K[0, 2], K[1, 2], *lens])
    vectors = [
        np.concatenate([np.ravel(t), np.ravel(r)]) for r, t in zip(turns, shifts, strict=True)
    ]
    if not (np.isfinite(parameters).all() and np.isfinite(vectors).all() and K[0, 0] > 0 < K[1, 1]):
        return None
    poses = tuple(RigidTransform(cv2.Rodrigues(v[3:])[0], v[:3]) for v in vectors)
    before = all((T @ view.points)[:, 2].min() > 0.0 for T, view in zip(poses, views, strict=True))
    return State(parameters[None], RigidTransform.identity(), poses) if before else None
