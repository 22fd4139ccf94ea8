"""Boards and a needle before two cameras whose pixels are OpenCV's, not ours.

Nothing here is told to what estimates: it gets noisy corners, and where the board is said to lie.
"""

from dataclasses import dataclass, replace
from functools import cache
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.tracking.calibration.boards import Board, parse_board
from app.tracking.calibration.views import BoardView
from app.tracking.optics.rig import RigProfile, load_rig
from app.tracking.simulated.opencv import opencv_pixels

SIZE: Final = (640, 480)
RIGS: Final = ("usual", "thesis", "wide")
LENSES: Final = ("p = 0", "p = 4e-4", "rational")

CORNER_PX: Final = 0.1
"""Noise of a corner, standard deviation per axis."""

_MARGIN: Final = 8.0
_FULCRUM: Final = np.array([0.0, 0.16056, 0.090])


@dataclass(frozen=True, slots=True, eq=False)
class TrueCamera:
    """A camera as it is: matrix (3, 3), OpenCV's coefficients (8,), T_camera_world."""

    matrix: FloatArray
    distortion: FloatArray
    T_camera_world: RigidTransform

    def pixels(self, points: FloatArray) -> FloatArray:
        """Project points of the world [m], (n, 3), by OpenCV, (n, 2)."""
        return opencv_pixels(points, self.T_camera_world, self.matrix, self.distortion)

    def sees(self, points: FloatArray) -> bool:
        """Return whether all points lie well inside the picture."""
        if (self.T_camera_world @ points)[:, 2].min() < 0.02:
            return False
        uv = self.pixels(points)
        return bool((uv > _MARGIN).all() and (uv < np.array(SIZE) - 1.0 - _MARGIN).all())


@dataclass(frozen=True, slots=True, eq=False)
class RigScene:
    """Two cameras, the board that calibrates them, and where needle and world are.

    Attributes:
        profile: rig whose needle and rates are used; its cameras are not.
        cameras: left, right, as they are.
        board: shown to both.
        distance: of the board from the left camera [m].
        fulcrum: P_I in world [m], (3,).
        down: where the needle points to, unit, (3,).
        placed: T_world_board that the board is said to lie at for the world frame.
    """

    profile: RigProfile
    cameras: tuple[TrueCamera, TrueCamera]
    board: Board
    distance: float
    fulcrum: FloatArray
    down: FloatArray
    placed: RigidTransform

    def view(self, side: int, T_world_board: RigidTransform, rng: np.random.Generator) -> BoardView:
        """Return the board in one camera, corners with noise."""
        uv = self.cameras[side].pixels(T_world_board @ self.board.points)
        noisy = uv + rng.normal(0.0, CORNER_PX, uv.shape)
        return BoardView(self.board, np.arange(self.board.count), noisy, SIZE, name="board")

    def poses(self, count: int, seed: int) -> tuple[RigidTransform, ...]:
        """T_world_board of boards that both cameras see whole, turned to different sides."""
        rng, middle = np.random.default_rng(seed), self.board.points.mean(axis=0)
        left, right = (camera.T_camera_world for camera in self.cameras)
        half = RigidTransform.exp(np.r_[0.0, 0.0, 0.0, 0.5 * (right @ left.inverse()).log()[3:]])
        poses: list[RigidTransform] = []
        while len(poses) < count:
            turn = half.rotation.T @ rotation_exp(30.0 * DEGREE * rng.uniform(-1.0, 1.0, 3))
            place = np.array([0.0, 0.0, self.distance]) * rng.uniform(0.85, 1.3)
            place[:2] += rng.uniform(-0.25, 0.25, 2) * self.distance
            pose = left.inverse() @ RigidTransform(turn, place - turn @ middle)
            if all(camera.sees(pose @ self.board.points) for camera in self.cameras):
                poses.append(pose)
        return tuple(poses)

    def needle(self, rng: np.random.Generator) -> tuple[FloatArray, FloatArray]:
        """Band's centre [m] and axis of a needle whose band both cameras see."""
        reach = self.profile.range
        while True:
            side = rng.normal(size=3)
            across = np.cross(self.down, side) / np.linalg.norm(np.cross(self.down, side))
            tilt = reach.tilt_max_deg * DEGREE * np.sqrt(rng.uniform())
            axis = np.cos(tilt) * self.down + np.sin(tilt) * across
            depth = rng.uniform(reach.depth_min_mm, reach.depth_max_mm) * MILLIMETRE
            band = self.fulcrum + depth * axis
            if all(camera.sees(band[None]) for camera in self.cameras):
                return band, axis


@cache
def scene(rig: str, lens: str) -> RigScene:
    """Return a rig with a lens, by their names in `RIGS` and `LENSES`."""
    if rig == "usual":
        return _usual(lens)
    profile = load_rig(rig)
    cameras = tuple(
        TrueCamera(_matrix(model.intrinsics), _coefficients(rig, lens, side), model.T_camera_world)
        for side, model in enumerate(profile.models)
    )
    board = parse_board(
        f"charuco:8x6:{'5mm:3.5mm' if rig == 'thesis' else '12mm:9mm'}:DICT_5X5_100"
    )
    down, pose = np.array([0.0, 0.0, -1.0]), cameras[0].T_camera_world
    distance = float(np.linalg.norm(pose @ _FULCRUM))
    unplaced = RigScene(
        profile,
        (cameras[0], cameras[1]),
        board,
        distance,
        _FULCRUM,
        down,
        cameras[0].T_camera_world,
    )
    return _placed(unplaced)


def _usual(lens: str) -> RigScene:
    """640x480, cameras side by side 83 mm apart that look down, squares of 25 mm."""
    above = RigidTransform(np.diag([1.0, -1.0, -1.0]), np.array([0.0, 0.0, 0.5])).inverse()
    beside = RigidTransform(np.eye(3), np.array([-0.083, 0.0, 0.0])) @ above
    centres = ((534.0, 534.0, 342.0, 235.0), (537.0, 537.0, 327.0, 249.0))
    cameras = tuple(
        TrueCamera(_matrix(np.array(values)), _coefficients("usual", lens, side), pose)
        for side, (values, pose) in enumerate(zip(centres, (above, beside), strict=True))
    )
    unplaced = RigScene(
        load_rig("wide"),
        (cameras[0], cameras[1]),
        parse_board("charuco:10x7:25mm:18mm:DICT_5X5_100"),
        0.4,
        np.array([0.04, 0.05, 0.1]),
        np.array([0.0, -1.0, 0.0]),
        above,
    )
    return _placed(unplaced)


def _placed(unplaced: RigScene) -> RigScene:
    """Say where the board lies for the world frame: where both cameras see it, print up."""
    print_up = (T for T in unplaced.poses(30, 5) if T.rotation[2, 2] < -0.1)
    return replace(unplaced, placed=next(print_up))


def _matrix(intrinsics: FloatArray) -> FloatArray:
    fx, fy, cx, cy = intrinsics
    return np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])


def _coefficients(rig: str, lens: str, side: int) -> FloatArray:
    """k1, k2, p1, p2, k3 to k6 in OpenCV's order.

    The rational lens is a wide one in `usual`, which five coefficients do not follow. The other two
    see a sixth as much of the sky: there it bends much like the other lenses, and five do.
    """
    p = 4e-4 if lens == "p = 4e-4" else 0.0
    p1, p2 = (p, -0.75 * p) if side == 0 else (-0.75 * p, p)
    if lens == "rational" and rig == "usual":
        return np.array([3.6, 1.92, p1, p2, 0.256, 5.0, 5.6, 1.28])
    if lens == "rational":
        return np.array([0.19, 0.02, p1, p2, 0.0, 0.30, 0.02, 0.002])
    k1, k2 = (-0.29, 0.11) if rig == "usual" else (-0.11, 0.14)
    return np.array([k1, k2, p1, p2, 0.0, 0.0, 0.0, 0.0])
