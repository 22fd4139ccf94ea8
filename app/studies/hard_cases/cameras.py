"""Hard cases of the cameras: far and parallel rays, folding lenses, boards face on."""

from collections.abc import Callable, Sequence
from functools import cache, partial
from typing import Any, Final

import numpy as np

from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.studies.hard_cases.case import HardCase, analytic, answers, digits, named
from app.tracking.calibration.boards import parse_board
from app.tracking.calibration.mono import calibrate_mono
from app.tracking.calibration.poses import board_pose
from app.tracking.calibration.views import BoardView
from app.tracking.errors import CalibrationError
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.distortion import fold_radius, undistort_point
from app.tracking.stereo.closed_form import closest, linear
from app.tracking.stereo.triangulation import StereoStatus, triangulate

_Way = Callable[..., Any]

SIDE: Final = RigidTransform.from_translation([-0.2, 0.0, 0.0])
SPREAD: Final = np.array([np.eye(2) * 1e-8, np.eye(2) * 1e-8])
LENS: Final = np.array([-0.091006, 2.735876, -0.001135, -0.004749, -20.789586])


# --- triangulation --------------------------------------------------------------------------------
def _far() -> tuple[HardCase, ...]:
    poses = RigidTransform.identity(), SIDE

    def met(seen: tuple[float, ...], way: _Way) -> Any:
        x, y, second = seen
        return way(poses, np.array([[x, y], [second, y]]), SPREAD).p_world

    def parallel() -> bool:
        found = triangulate(poses, np.array([[0.1, 0.2], [0.1, 0.2]]), SPREAD)
        return found.status is StereoStatus.AT_INFINITY

    return tuple(
        HardCase(
            subsystem="triangulation",
            case=f"a point {depth:g} m away",
            given="two cameras 0.2 m apart, rays that meet",
            way=triangulate,
            found=partial(met, digits(_name(depth)).given),
            reference=digits(_name(depth)),
            unit="m",
            bound=2e-15 * depth**2 / 0.2,  # one bit of an observation, Z² / b
            beyond=answers("named AT_INFINITY for parallel rays", parallel),
        )
        for depth in (1.0, 100.0, 10_000.0)
    )


def _name(depth: float) -> str:
    return f"point {depth:g} m away from a baseline of 0.2 m"


def _skew() -> HardCase:
    reference = digits("point of two skew rays")
    rotation = np.array(reference.given[:9]).reshape(3, 3)
    poses = RigidTransform.identity(), RigidTransform(rotation, np.array(reference.given[9:12]))
    seen = np.array(reference.given[12:]).reshape(2, 2)

    def behind() -> bool:
        found = triangulate(
            (RigidTransform.identity(), SIDE), np.array([[0.0, 0.0], [0.1, 0.0]]), SPREAD
        )
        return found.status is StereoStatus.BEHIND

    return HardCase(
        subsystem="triangulation",
        case="the point of least reprojection error of two rays that miss each other",
        given="46° between the cameras, rays some 12 mm apart",
        way=triangulate,
        found=lambda way: way(poses, seen, SPREAD).p_world,
        reference=reference,
        unit="m",
        bound=1e-9,  # where Gauss–Newton stops
        beyond=answers("named BEHIND where rays part", behind),
    )


def _nearly_parallel() -> HardCase:
    """Lines 1e-6 rad from parallel, 1 m apart: where they are closest is 1 / angle away."""
    turn = 1e-6
    first = np.zeros(3), np.array([0.0, 0.0, 1.0])
    second = np.array([1.0, 0.1, 0.0]), np.array([-np.sin(turn), 0.0, np.cos(turn)])
    right = 1.0 / np.tan(turn)

    return HardCase(
        subsystem="triangulation",
        case="where two lines 1e-6 rad from parallel are closest",
        given="1 m apart, 0.1 m aside",
        way=closest,
        found=lambda way: way(first, second)[0],
        reference=analytic("1 m / tan(1e-6)", (0.0, 0.0, right)),
        unit="1",
        bound=1e-9,  # ε / 1e-6
        relative=True,
        beyond=answers(
            "named DEGENERATE without a baseline",
            lambda: (
                triangulate(
                    (RigidTransform.identity(),) * 2, np.array([[0.1, 0], [0.2, 0]]), SPREAD
                ).status
                is StereoStatus.DEGENERATE
            ),
        ),
    )


def _far_from_the_world() -> HardCase:
    # The same rig 10 km from the world's origin: the linear way may not notice.
    away = RigidTransform.from_translation([1e4, -1e4, 1e4])
    poses = RigidTransform.identity(), RigidTransform.exp([-0.2, 0.0, 0.05, 0.0, 0.7, 0.0])
    point = np.array([0.05, -0.02, 0.3])
    seen = np.array([(c := pose @ point)[:2] / c[2] for pose in poses])
    moved = tuple(pose @ away.inverse() for pose in poses)

    return HardCase(
        subsystem="triangulation",
        case="linear triangulation 10 km from the world's origin",
        given="a rig of 0.2 m whose poses are shifted by 10 km",
        way=linear,
        found=lambda way: way(moved, seen) - away.translation,
        reference=analytic("the point that was projected", point),
        unit="m",
        bound=1e-10,  # 1e4 ε, and its lever
        beyond=answers("finite for observations of one point at the epipoles", _at_the_epipoles),
    )


def _at_the_epipoles() -> bool:
    poses = RigidTransform.identity(), RigidTransform.from_translation([0.0, 0.0, 0.2])
    found = triangulate(poses, np.zeros((2, 2)), SPREAD)
    return found.status is StereoStatus.DEGENERATE


def _lens() -> tuple[HardCase, ...]:
    fold = fold_radius(LENS)

    def straightened(seen: tuple[float, ...], way: _Way) -> Any:
        return way(seen[0], seen[1], LENS, fold)[:2]

    return tuple(
        HardCase(
            subsystem="triangulation",
            case=f"ray of a pixel at a radius of {words}",
            given="the laboratory's lens, k₃ = -20.8",
            way=undistort_point,
            found=partial(straightened, digits(_radius(words)).given),
            reference=digits(_radius(words)),
            unit="1",
            bound=bound,
            beyond=answers(
                "no ray beyond the fold, said so",
                lambda: not undistort_point(1.0, 0.0, LENS, fold)[2],
            ),
        )
        for words, bound in (("0.40", 1e-14), ("0.46, at the edge of the fold", 1e-12))
    )


def _radius(words: str) -> str:
    return f"ray of a distorted point at a radius of {words}"


# --- calibration ----------------------------------------------------------------------------------
@cache
def camera() -> CameraModel:
    """Return the camera that sees exact corners."""
    return CameraModel(
        "left",
        np.array([534.0, 534.0, 342.0, 235.0]),
        np.zeros(5),
        (640, 480),
        RigidTransform.identity(),
    )


BOARD: Final = parse_board("checkerboard:9x6:25mm")
MIDDLE: Final = BOARD.points.mean(axis=0)


def _held(turn_deg: Sequence[float], place: Sequence[float]) -> RigidTransform:
    rotation = rotation_exp(np.deg2rad(turn_deg))
    return RigidTransform(rotation, np.array(place) - rotation @ MIDDLE)


def _view(T: RigidTransform, off: float = 0.0) -> BoardView:
    pixels, _ = camera().project(T @ BOARD.points)
    return BoardView(BOARD, np.arange(BOARD.count), pixels + off, (640, 480))


def _exact_views() -> HardCase:
    turns = ((30, 0, 0), (-30, 5, 0), (0, 30, 0), (5, -30, 0), (20, 20, 10), (-20, 20, -10))
    poses = [_held(turn, (0.02 * i - 0.05, 0.01 * i, 0.45)) for i, turn in enumerate(turns)]
    views = [_view(T) for T in poses]
    facing = [_view(_held((0, 0, 0), (0.03 * (i % 3 - 1), 0.0, 0.4 + 0.02 * i))) for i in range(6)]

    def intrinsics(way: _Way) -> Any:
        camera = way(views, "left", 0).calibration
        return [*camera.focal_px, *camera.centre_px]

    return HardCase(
        subsystem="calibration",
        case="a camera from six exact views of a flat board",
        given="30° to four sides, 0.45 m away, no noise",
        way=calibrate_mono,
        found=intrinsics,
        reference=analytic("the camera that projected them", (534.0, 534.0, 342.0, 235.0)),
        unit="px",
        bound=1e-9,
        beyond=named(CalibrationError, lambda: calibrate_mono(facing, "left", 0)),
    )


def _slanted() -> tuple[HardCase, ...]:
    parameters = np.array([534.0, 534.0, 342.0, 235.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    one = BoardView(BOARD, np.arange(BOARD.count), np.full((BOARD.count, 2), 200.0), (640, 480))

    def bounded() -> bool:
        try:
            T, error = board_pose(one, parameters)
        except CalibrationError:
            return True
        return bool(np.isfinite(T.matrix()).all() and np.isfinite(error))

    return tuple(
        HardCase(
            subsystem="calibration",
            case=f"pose of a board {words}",
            given="54 exact corners at 0.45 m",
            way=board_pose,
            found=lambda way, T=pose: way(_view(T), parameters)[0].matrix(),
            reference=analytic("the pose that was projected", pose.matrix()),
            unit="m, 1",
            bound=bound,
            beyond=answers("all corners in one pixel: finite, or CalibrationError", bounded),
        )
        for words, pose, bound in (
            ("square to the axis", _held((0.0, 0.0, 0.0), (0.0, 0.0, 0.45)), 1e-12),
            ("seen 5° from its edge", _held((85.0, 0.0, 0.0), (0.0, 0.0, 0.45)), 1e-12),
            ("upside down", _held((0.0, 0.0, 179.999999), (0.0, 0.0, 0.45)), 1e-12),
        )
    )


CASES: Final = (
    *_far(),
    _skew(),
    _nearly_parallel(),
    _far_from_the_world(),
    *_lens(),
    _exact_views(),
    *_slanted(),
)
"""Triangulation, calibration."""
