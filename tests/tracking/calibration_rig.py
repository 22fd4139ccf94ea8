"""Boards before cameras whose truth is known: views by projection, and rendered pictures."""

from dataclasses import dataclass

import numpy as np

from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.tracking.calibration.boards import Board, parse_board
from app.tracking.calibration.views import BoardView
from app.tracking.optics.camera_model import CameraModel


@dataclass(frozen=True)
class Rig:
    """Two cameras; the left one is the world."""

    left: CameraModel
    right: CameraModel
    board: Board
    distance: float

    @property
    def T_right_left(self) -> RigidTransform:
        return self.right.T_camera_world

    def poses(self, count: int, seed: int, tilt_deg: float = 30.0) -> list[RigidTransform]:
        """Boards that both cameras see whole, turned to different sides."""
        rng = np.random.default_rng(seed)
        found: list[RigidTransform] = []
        middle = self.board.points.mean(axis=0)
        # Half way between the cameras' axes, so that both look at it at the same slant.
        half = RigidTransform.exp(np.concatenate([[0, 0, 0], 0.5 * self._turn()]))
        while len(found) < count:
            tilt = rotation_exp(np.deg2rad(tilt_deg) * rng.uniform(-1, 1, 3))
            place = np.array([0.0, 0.0, self.distance]) * rng.uniform(0.9, 1.3)
            place[:2] += rng.uniform(-0.2, 0.2, 2) * self.distance
            rotation = half.rotation @ tilt
            T = RigidTransform(rotation, place - rotation @ middle)
            if all(self._sees(camera, T) for camera in (self.left, self.right)):
                found.append(T)
        return found

    def _turn(self) -> np.ndarray:
        return self.T_right_left.inverse().log()[3:]

    def _sees(self, camera: CameraModel, T_left_board: RigidTransform) -> bool:
        corners = T_left_board @ self.board.points
        facing = (T_left_board.rotation[:, 2] @ (corners.mean(axis=0) - camera.centre)) > 0.0
        return bool(facing and camera.sees(corners, 8.0).all())

    def view(
        self, camera: CameraModel, T: RigidTransform, noise: float, rng: np.random.Generator
    ) -> BoardView:
        uv, ok = camera.project(T @ self.board.points)
        assert ok.all()
        pixels = uv + noise * rng.standard_normal(uv.shape)
        return BoardView(self.board, np.arange(self.board.count), pixels, camera.image_size)

    def pairs(
        self, count: int, seed: int, noise: float = 0.1, tilt_deg: float = 30.0
    ) -> tuple[list[BoardView], list[BoardView]]:
        rng = np.random.default_rng(seed)
        poses = self.poses(count, seed, tilt_deg)
        left = [self.view(self.left, T, noise, rng).called(f"l{i}") for i, T in enumerate(poses)]
        right = [self.view(self.right, T, noise, rng).called(f"r{i}") for i, T in enumerate(poses)]
        return left, right


def camera(
    name: str,
    intrinsics: tuple[float, ...],
    distortion: tuple[float, ...],
    size: tuple[int, int],
    pose: RigidTransform | None = None,
) -> CameraModel:
    return CameraModel(
        name,
        np.array(intrinsics),
        np.array(distortion),
        size,
        pose or RigidTransform.identity(),
    )


def beside(baseline: float, angle_deg: float, distance: float) -> RigidTransform:
    """T_left_right of a camera to the right, turned inwards about y by an angle."""
    turn = np.deg2rad(angle_deg)
    rotation = rotation_exp([0.0, -turn, 0.0])
    if angle_deg == 0.0:
        return RigidTransform(rotation, np.array([baseline, 0.0, 0.0]))
    middle = np.array([0.0, 0.0, distance])
    return RigidTransform(rotation, middle - rotation @ middle)


def usual_rig(board: str = "checkerboard:9x6:25mm") -> Rig:
    size, lens = (640, 480), (-0.29, 0.11, 0.0, 0.0, 0.0)
    right = camera("right", (537.0, 537.0, 327.0, 249.0), lens, size, beside(0.083, 0.0, 0.4))
    left = camera("left", (534.0, 534.0, 342.0, 235.0), lens, size)
    return Rig(left, right, parse_board(board), 0.4)


def thesis_rig() -> Rig:
    """640x480, cameras 102 degrees apart, 5x7 corners of 5 mm, seen from 15 cm."""
    size = (640, 480)
    left = camera("left", (1088.6, 1090.8, 314.5, 220.8), (-0.02, 0, 0, 0, 0), size)
    right = camera(
        "right",
        (1066.0, 1068.4, 300.3, 235.4),
        (-0.02, 0, 0, 0, 0),
        size,
        beside(0.0, 102.0, 0.15),
    )
    return Rig(left, right, parse_board("checkerboard:5x7:5mm"), 0.15)


def small_rig() -> Rig:
    """270x180, squares of about ten pixels."""
    size, lens = (270, 180), (-0.2, 0.0, 0.0, 0.0, 0.0)
    left = camera("left", (260.0, 260.0, 134.0, 90.0), lens, size)
    right = camera("right", (262.0, 262.0, 136.0, 88.0), lens, size, beside(0.1, 12.0, 0.5))
    return Rig(left, right, parse_board("checkerboard:8x6:20mm"), 0.48)
