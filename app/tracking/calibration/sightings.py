"""What an adjustment starts from: boards seen by cameras; and how predictions change with both."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray, crosses
from app.core.transform import RigidTransform
from app.tracking.optics.distortion import distort_with_derivatives


def project(points: FloatArray, p: FloatArray) -> FloatArray:
    """Pixels of points, (n, 3) -> (n, 2); see `project_with_derivatives`."""
    xy = points[:, :2] / points[:, 2:]
    pixels: FloatArray = p[:2] * distort_with_derivatives(xy, p[4:])[0] + p[2:4]
    return pixels


def project_with_derivatives(
    points: FloatArray, p: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Pixels (n, 2), their derivatives by the point (n, 2, 3) and by the parameters (n, 2, m).

    Args:
        points: in the camera's frame, in front of it [m], shape (n, 3).
        p: fx, fy, cx, cy and the lens' coefficients, whose number tells the model (see
            `optics.distortion`), shape (m,); unchecked.
    """
    z = points[:, 2]
    xy = points[:, :2] / z[:, None]
    bent, by_xy, by_lens = distort_with_derivatives(xy, p[4:])
    focal = p[:2]
    by_point = np.empty((len(points), 2, 3))
    by_point[:, :, :2] = focal[:, None] * by_xy / z[:, None, None]
    by_point[:, :, 2] = -(by_point[:, :, :2] * xy[:, None]).sum(axis=2)
    by_parameter = np.zeros((len(points), 2, p.size))
    by_parameter[:, 0, 0], by_parameter[:, 1, 1] = bent[:, 0], bent[:, 1]
    by_parameter[:, 0, 2] = by_parameter[:, 1, 3] = 1.0
    by_parameter[:, :, 4:] = focal[:, None] * by_lens
    return focal * bent + p[2:4], by_point, by_parameter


@dataclass(frozen=True, eq=False)
class SeenBoard:
    """A board seen by a camera.

    Attributes:
        pose: number of the board's pose.
        camera: 0 left, 1 right.
        points: in the board's frame [m], shape (n, 3).
        pixels: shape (n, 2).
    """

    pose: int
    camera: int
    points: FloatArray
    pixels: FloatArray


@dataclass(frozen=True, eq=False)
class AdjustedState:
    """What is estimated.

    Attributes:
        parameters: of each camera, shape (cameras, m): both have the same model of the lens.
        T_right_left: identity for one camera.
        poses: T_left_board of every board.
    """

    parameters: FloatArray
    T_right_left: RigidTransform
    poses: tuple[RigidTransform, ...]


class SightedBoards:
    """All boards that one camera saw, in a row, so that they are linearised in one go.

    Attributes:
        camera: 0 left, 1 right.
        numbers: of the sightings in what was given, in the order of the rows.
        poses: number of the board's pose, sighting by sighting.
        spans: where the points of each sighting stand, shape (sightings, 2).
    """

    def __init__(self, sightings: Sequence[SeenBoard], camera: int) -> None:
        own = [(i, seen) for i, seen in enumerate(sightings) if seen.camera == camera]
        counts = [len(seen.points) for _, seen in own]
        ends = np.cumsum(counts)
        self.camera = camera
        self.numbers = [i for i, _ in own]
        self.poses = np.array([seen.pose for _, seen in own], dtype=np.int64)
        self.spans = np.column_stack([ends - counts, ends])
        self._points = np.concatenate([seen.points for _, seen in own])
        self._pixels = np.concatenate([seen.pixels for _, seen in own])
        self._pose_of = np.repeat(self.poses, counts)

    def linearised(
        self,
        parameters: FloatArray,
        rotations: FloatArray,
        translations: FloatArray,
        T_right_left: RigidTransform,
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray | None] | None:
        """Linearise the prediction of the pixels.

        Args:
            parameters: of the camera, shape (m,).
            rotations: of T_left_board of every board, shape (poses, 3, 3).
            translations: of the same, shape (poses, 3).
            T_right_left: pose of the right camera; without meaning for the left one.

        Returns:
            Residuals (n, 2), and the prediction's derivatives by the parameters (n, 2, m), by the
            twist of the board's pose (n, 2, 6), and by that of T_right_left (n, 2, 6), None for the
            left camera. None where a point lies behind the camera or a value is not finite.
        """
        turned = np.einsum("nij,nj->ni", rotations[self._pose_of], self._points)
        p_left = turned + translations[self._pose_of]
        points = p_left if self.camera == 0 else T_right_left @ p_left
        if not (np.isfinite(points).all() and points[:, 2].min() > 1e-6):
            return None
        uv, by_point, by_parameter = project_with_derivatives(points, parameters)
        if not np.isfinite(uv).all():
            return None
        by_left = by_point if self.camera == 0 else by_point @ T_right_left.rotation
        by_right = _by_twist(by_point, points) if self.camera == 1 else None
        return self._pixels - uv, by_parameter, _by_twist(by_left, p_left), by_right


def _by_twist(by_point: FloatArray, points: FloatArray) -> FloatArray:
    """Differentiate by a twist on the left of the pose that made the points: [I | -[p]x]."""
    turn = crosses(points[:, None, :], by_point)  # row·(ω x p) = ω·(p x row)
    return np.concatenate([by_point, turn], axis=2)
