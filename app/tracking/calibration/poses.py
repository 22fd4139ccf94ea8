"""First estimates: of a camera and its boards, and of a board's pose by a known camera.

Cameras by OpenCV's calibration with every coefficient; beside them the rigid motion that takes one
set of points closest to another.
"""

from collections.abc import Sequence
from functools import lru_cache

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.rotation import closest_rotation
from app.core.transform import RigidTransform
from app.tracking.calibration.bundle import adjust, rms
from app.tracking.calibration.sightings import AdjustedState, SeenBoard
from app.tracking.calibration.views import BoardView
from app.tracking.errors import CalibrationError
from app.tracking.optics.distortion import fold_radius, undistort_grid

POOR_PX = 0.3
"""Residual from which OpenCV's estimate may have lost its way, and another start is tried [px]."""

_NO_DISTORTION = (
    cv2.CALIB_FIX_K1 | cv2.CALIB_FIX_K2 | cv2.CALIB_FIX_K3 | cv2.CALIB_ZERO_TANGENT_DIST
)
_CENTRED = cv2.CALIB_FIX_PRINCIPAL_POINT | cv2.CALIB_FIX_K3 | cv2.CALIB_ZERO_TANGENT_DIST


def first_estimate(views: Sequence[BoardView]) -> AdjustedState:
    """Camera with five distortion coefficients and the boards' poses, by `calibrateCameraExtended`.

    Raises:
        CalibrationError: if no camera explains the views, with and without distortion.
    """
    starts = []
    for flags in (0, _CENTRED, _NO_DISTORTION):  # all of a wide lens at once may lose its way
        plain = _opencv(tuple(views), flags)
        state = _state(views, plain)
        if plain is not None and state is not None:
            starts.append((plain[0], state))
            if plain[0] < POOR_PX:
                break
    if starts:
        return min(starts, key=lambda start: start[0])[1]
    raise CalibrationError(
        sentence(
            "no camera explains the {views} views; tilt the board to different sides by 20 "
            "to 45 degrees, and check the board's counts",
            views=len(views),
        )
    )


def usual_rms(views: Sequence[BoardView]) -> float | None:
    """Reprojection error of OpenCV's plain recipe: all views, five coefficients [px]."""
    plain = _opencv(tuple(views), 0)
    return plain[0] if plain is not None and np.isfinite(plain[0]) else None


def usual_stereo_rms(pairs: Sequence[tuple[BoardView, BoardView]]) -> float | None:
    """Reprojection error of OpenCV's plain recipe for two cameras: all pairs, fixed lenses [px]."""
    both = [(a, b) for a, b in pairs if np.array_equal(a.ids, b.ids)]
    if not both or {a.image_size for a, _ in both} != {b.image_size for _, b in both}:
        return None
    sides = [tuple(pair[side] for pair in both) for side in (0, 1)]
    (points, left, size), (_, right, _) = map(_arguments, sides)
    plain = [_opencv(side, 0) for side in sides]
    if plain[0] is None or plain[1] is None:
        return None
    (_, K_left, d_left, *_), (_, K_right, d_right, *_) = plain[0], plain[1]
    try:
        found = cv2.stereoCalibrate(
            points,
            left,
            right,
            K_left,
            d_left,
            K_right,
            d_right,
            size,
            flags=cv2.CALIB_FIX_INTRINSIC,
        )[0]
    except cv2.error:
        return None
    return float(found) if np.isfinite(found) else None


def _arguments(views: Sequence[BoardView]) -> tuple[list[object], list[object], tuple[int, int]]:
    points: list[object] = [view.points.astype(np.float32) for view in views]
    pixels: list[object] = [view.pixels.astype(np.float32).reshape(-1, 1, 2) for view in views]
    return points, pixels, views[0].image_size


_Plain = tuple[float, FloatArray, FloatArray, Sequence[FloatArray], Sequence[FloatArray]]
"""What OpenCV finds: residual [px], camera matrix, coefficients, rotation vectors, translations."""


@lru_cache(maxsize=4)
def _opencv(views: tuple[BoardView, ...], flags: int) -> _Plain | None:
    """OpenCV's estimate from the very same views, None where it fails; asked for again and again:
    a start, and what its plain recipe would have left.
    """
    try:
        found = cv2.calibrateCameraExtended(*_arguments(views), None, None, flags=flags)
    except cv2.error:
        return None
    return (float(found[0]), found[1], found[2], found[3], found[4])


def _state(views: Sequence[BoardView], plain: _Plain | None) -> AdjustedState | None:
    """Camera and boards, or None where not finite or with boards behind the camera."""
    if plain is None:
        return None
    _, K, coefficients, turns, shifts = plain
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
    return AdjustedState(parameters[None], RigidTransform.identity(), poses) if before else None


def rigid_fit(source: FloatArray, target: FloatArray) -> RigidTransform:
    """T_target_source with the least sum of squared distances, no scale.

    Args:
        source: points [m], shape (n, 3), not all on one line.
        target: the same points elsewhere.
    """
    middle_source, middle_target = source.mean(axis=0), target.mean(axis=0)
    rotation, _ = closest_rotation((source - middle_source).T @ (target - middle_target))
    return RigidTransform(rotation, middle_target - rotation @ middle_source)


def board_pose(
    view: BoardView, parameters: FloatArray, near: RigidTransform | None = None
) -> tuple[RigidTransform, float]:
    """T_camera_board and the root mean square distance of its corners from the picture [px].

    A plane has two poses that look nearly alike; both are refined, the better one is taken.

    Args:
        view: corners in the picture.
        parameters: fx, fy, cx, cy and the lens' coefficients, shape (m,).
        near: pose to start from, where it is known roughly; none of the two if None.

    Raises:
        CalibrationError: if no pose puts the board before the camera.
    """
    starts = _two_poses(view, parameters) if near is None else [near]
    candidates = [_refined(view, parameters, T) for T in starts]
    found = [candidate for candidate in candidates if candidate is not None]
    if not found:
        raise CalibrationError(
            sentence(
                "view {view_name!r}: no pose of the board fits before the camera",
                view_name=view.name,
            )
        )
    return min(found, key=lambda candidate: candidate[1])


def better_corners(views: Sequence[BoardView], parameters: FloatArray) -> list[BoardView]:
    """Return views with the corners that fit the camera better: refined, or as they were found.

    Refining helps as a rule; where a picture is blurred and noisy beyond what its window takes out
    it does not, and the residual shows it.

    Args:
        views: with `unrefined` corners where they are known; a view that needs no change comes
            back as it is.
        parameters: fx, fy, cx, cy and the lens' coefficients, shape (m,).
    """
    return [_better(view, parameters) for view in views]


def _better(view: BoardView, parameters: FloatArray) -> BoardView:
    if view.unrefined is None:
        return view
    other = view.without_refinement()
    try:
        return min((view, other), key=lambda one: board_pose(one, parameters)[1])
    except CalibrationError:
        return view


def _two_poses(view: BoardView, p: FloatArray) -> list[RigidTransform]:
    rays, exist = undistort_grid(view.pixels, p[:4], p[4:], fold_radius(p[4:]))
    try:
        _, turns, shifts, _ = cv2.solvePnPGeneric(
            view.points[exist], rays[exist, None], np.eye(3), None, flags=cv2.SOLVEPNP_IPPE
        )
    except cv2.error as error:
        raise CalibrationError(
            sentence("view {view_name!r}: no pose of the board can be found", view_name=view.name)
        ) from error
    return [
        RigidTransform(cv2.Rodrigues(turn)[0], np.ravel(shift))
        for turn, shift in zip(turns, shifts, strict=True)
        if np.isfinite(turn).all() and np.isfinite(shift).all()
    ]


def _refined(
    view: BoardView, parameters: FloatArray, T: RigidTransform
) -> tuple[RigidTransform, float] | None:
    seen = SeenBoard(0, 0, view.points, view.pixels)
    start = AdjustedState(parameters[None], RigidTransform.identity(), (T,))
    try:
        found = adjust([seen], start, np.zeros((1, parameters.size), dtype=bool), rounds=20)
    except CalibrationError:
        return None
    return found.state.poses[0], rms(found.residuals[0])
