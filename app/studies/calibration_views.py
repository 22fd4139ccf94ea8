"""Study: how many views of a board calibrate a camera.

A checkerboard (9 × 6, 25 mm) before a camera whose truth is known, anywhere in its picture, turned
up to 30°, corners with noise. Error: directions of pixels all over the picture, but for a turn of
the camera as a whole, beside a needle 0.4 m away; RMS of several sets of views.
"""

from collections.abc import Callable
from functools import cache
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.studies.in_use import called
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way
from app.tracking.calibration import collector
from app.tracking.calibration.boards import parse_board
from app.tracking.calibration.mono import calibrate_mono
from app.tracking.calibration.views import BoardView
from app.tracking.optics.camera_model import CameraModel

DECLARATION: Final[dict[str, Any]] = {
    "title": "Views of a board that calibrate a camera",
    "question": "How many views of a board are enough?",
    "reference": "the camera that the views were made with, exact",
}

_BOARD: Final = parse_board("checkerboard:9x6:25mm")
_TRUE: Final = CameraModel(
    "camera",
    np.array([535.0, 535.0, 334.0, 236.0]),
    np.array([-0.28, 0.09, 0.0, 0.0, 0.0]),
    (640, 480),
    RigidTransform.identity(),
)
_DISTANCE: Final = 0.4  # [m]
_SETS: Final = 5
_COUNTS: Final = (4, 6, 8, 10, 15, 20, 30, 50)
_SEEN_MM: Final = 0.25


@cache
def poses(number: int) -> tuple[RigidTransform, ...]:
    """Boards that the camera sees whole: the set of this number, as many as are ever needed."""
    rng, middle = np.random.default_rng(100 + number), _BOARD.points.mean(axis=0)
    found: list[RigidTransform] = []
    while len(found) < max(_COUNTS):
        rotation = rotation_exp(np.deg2rad(30.0) * rng.uniform(-1.0, 1.0, 3))
        place = np.array([0.0, 0.0, _DISTANCE]) * rng.uniform(0.8, 1.4)
        place[:2] += rng.uniform(-0.3, 0.3, 2) * _DISTANCE
        pose = RigidTransform(rotation, place - rotation @ middle)
        if _TRUE.sees(pose @ _BOARD.points, 8.0).all():
            found.append(pose)
    return tuple(found)


def views(number: int, count: int, noise: float) -> list[BoardView]:
    """Return the first views of a set, their corners with noise [px]."""
    rng, seen = np.random.default_rng(number), []
    for k, pose in enumerate(poses(number)[:count]):
        pixels, _ = _TRUE.project(pose @ _BOARD.points)
        pixels = pixels + rng.normal(0.0, noise, pixels.shape)
        view = BoardView(_BOARD, np.arange(_BOARD.count), pixels, _TRUE.image_size)
        seen.append(view.called(f"view {k}"))
    return seen


def _rays(model: CameraModel) -> FloatArray:
    u, v = np.meshgrid(np.linspace(20.0, 619.0, 16), np.linspace(20.0, 459.0, 12))
    xy, _ = model.undistort(np.stack([u.ravel(), v.ravel()], axis=1))
    rays = np.column_stack([xy, np.ones(len(xy))])
    return np.asarray(rays / np.linalg.norm(rays, axis=1, keepdims=True))


def off_mm(model: CameraModel) -> float:
    """RMS error of a camera's directions at the distance of the needle [mm], turned to fit."""
    true, found = _rays(_TRUE), _rays(model)
    left, _, right = np.linalg.svd(true.T @ found)
    turn = left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right
    return 1e3 * _DISTANCE * float(np.sqrt(np.mean(np.sum((found @ turn.T - true) ** 2, axis=1))))


def _case(setting: Setting) -> Case:
    return Case(
        setting.values["noise_px"],
        lambda found: float(np.sqrt(np.mean([off_mm(model) ** 2 for model in found]))),
        _SEEN_MM,
    )


def _way(count: int) -> Callable[[Case], Prepared]:
    def prepare(case: Case) -> Prepared:
        given = [views(number, count, case.data) for number in range(_SETS)]
        still = RigidTransform.identity()
        return Prepared(
            lambda: [calibrate_mono(one, hold_back=0).calibration.model(still) for one in given],
            _SETS,
        )

    return prepare


STUDY: Final = Study(
    error_label="RMS error of directions at 0.4 m [mm]",
    ways=tuple(
        Way(f"{count} views", "views", _way(count), "one calibration of a camera", count)
        for count in _COUNTS
    ),
    settings=tuple(Setting(f"corners to {n:g} px", {"noise_px": n}) for n in (0.05, 0.1, 0.2)),
    case=_case,
    deadline=Limit(5.0, "5 s of waiting; each view costs a person two more"),
    perception=Limit(_SEEN_MM, "0.25 mm: a third of a pixel of the CT"),
    default="15 views",
    exception=(
        "A person takes each picture by hand. Views here are drawn at random; those that the "
        "program asks for cover the picture, distances and tilts, which this study does not count."
    ),
    in_use=lambda: called(collector.missing_words, "ENOUGH_VIEWS"),
)
