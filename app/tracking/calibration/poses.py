"""The pose of a board from one view by a camera that is known."""

from collections.abc import Sequence

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.core.transform import RigidTransform
from app.tracking.calibration.bundle import adjust, rms
from app.tracking.calibration.sightings import Sighting, State
from app.tracking.calibration.views import BoardView
from app.tracking.errors import CalibrationError

_NONE_FREE = np.zeros((1, 9), dtype=bool)


def board_pose(view: BoardView, parameters: FloatArray) -> tuple[RigidTransform, float]:
    """T_camera_board and the root mean square distance of its corners from the picture [px].

    A plane has two poses that look nearly alike; both are refined, the better one is taken.

    Args:
        view: corners in the picture.
        parameters: of the camera, in the order of `PARAMETERS`, shape (9,).

    Raises:
        CalibrationError: if no pose puts the board before the camera.
    """
    candidates = [_refined(view, parameters, T) for T in _two_poses(view, parameters)]
    found = [candidate for candidate in candidates if candidate is not None]
    if not found:
        raise CalibrationError(f"view {view.name!r}: no pose of the board fits before the camera")
    return min(found, key=lambda candidate: candidate[1])


def better_corners(views: Sequence[BoardView], parameters: FloatArray) -> list[BoardView]:
    """Return views with the corners that fit the camera better: refined, or as they were found.

    Refining helps as a rule; where a picture is blurred and noisy beyond what its window takes out
    it does not, and the residual shows it.

    Args:
        views: with `unrefined` corners where they are known; a view that needs no change comes
            back as it is.
        parameters: of the camera, in the order of `PARAMETERS`, shape (9,).
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
    matrix = np.array([[p[0], 0.0, p[2]], [0.0, p[1], p[3]], [0.0, 0.0, 1.0]])
    try:
        _, turns, shifts, _ = cv2.solvePnPGeneric(
            view.points, view.pixels.reshape(-1, 1, 2), matrix, p[4:], flags=cv2.SOLVEPNP_IPPE
        )
    except cv2.error as error:
        raise CalibrationError(f"view {view.name!r}: no pose of the board can be found") from error
    return [
        RigidTransform(cv2.Rodrigues(turn)[0], np.ravel(shift))
        for turn, shift in zip(turns, shifts, strict=True)
        if np.isfinite(turn).all() and np.isfinite(shift).all()
    ]


def _refined(
    view: BoardView, parameters: FloatArray, T: RigidTransform
) -> tuple[RigidTransform, float] | None:
    seen = Sighting(0, 0, view.points, view.pixels)
    start = State(parameters[None], RigidTransform.identity(), (T,))
    try:
        found = adjust([seen], start, _NONE_FREE, rounds=20)
    except CalibrationError:
        return None
    return found.state.poses[0], rms(found.residuals[0])
