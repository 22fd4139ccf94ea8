"""All corners of a board in one picture against a pose: weighted residual, and its minimum."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import asin, sqrt

import numpy as np

from app.core.arrays import FloatArray
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.tracking.optics.camera_model import CameraModel
from app.tracking.pen.pose import parameter_jacobians, projection_jacobians, skews

_STEPS = 12
_ROUNDS = 3
_CONVERGED = 1e-9
"""Decrease of chi-square still to be expected, below which a pose is as good as it gets."""

_RELATIVE = 1e-7
"""The same, as a share of chi-square: a false minimum, whose chi-square is thousands, need not be
known to more digits than are compared."""


SAME = 0.01
"""Angle [rad] below which two poses are one."""


@dataclass(frozen=True, slots=True, eq=False)
class Evaluated:
    """A pose held against the corners.

    Attributes:
        white: whitened residual, shape (2n,).
        slopes: whitened Jacobian by the twist, shape (2n, 6).
        bare: residual [px], shape (2n,).
        whiten: inverse Cholesky factors of the corners' covariances, shape (markers, 8, 8).
    """

    white: FloatArray
    slopes: FloatArray
    bare: FloatArray
    whiten: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class BoardProblem:
    """All corners of a board in one picture: points (n, 3) [m], pixels (n, 2), and weights."""

    model: CameraModel
    points: FloatArray
    pixels: FloatArray
    covariances: FloatArray  # (markers, 8, 8) [px²]
    build_sd: float

    def evaluate(self, p_camera: FloatArray, whiten: FloatArray | None = None) -> Evaluated | None:
        """Whitened residual and Jacobian by the pose's twist; None outside of the picture.

        Args:
            p_camera: `points` in the camera's frame [m], shape (n, 3).
            whiten: `Evaluated.whiten` of a pose nearby, which saves its computation.
        """
        uv, ok = self.model.project_camera(p_camera)
        if not ok.all():
            return None
        by_point = projection_jacobians(self.model, p_camera)
        jacobian = np.concatenate([by_point, -by_point @ skews(p_camera)], axis=2)
        residual = (self.pixels - uv).reshape(-1, 8)
        if whiten is None:
            whiten = self._whitening(by_point)
        white = np.einsum("mij,mj->mi", whiten, residual).ravel()
        slopes = np.einsum("mij,mjk->mik", whiten, jacobian.reshape(-1, 8, 6)).reshape(-1, 6)
        return Evaluated(white, slopes, residual.ravel(), whiten)

    def by_parameters(self, T: RigidTransform) -> FloatArray:
        """Whitened derivative of the pixels with the camera's parameters, (2n, 9)."""
        p_camera = T @ self.points
        by_point = projection_jacobians(self.model, p_camera)
        slopes = parameter_jacobians(self.model, p_camera)
        count = slopes.shape[2]
        slopes = slopes.reshape(-1, 8, count)
        return np.einsum("mij,mjk->mik", self._whitening(by_point), slopes).reshape(-1, count)

    def _whitening(self, by_point: FloatArray) -> FloatArray:
        """Inverse Cholesky factors of the corners' covariance with what the print adds."""
        built = self.build_sd**2 * by_point @ by_point.transpose(0, 2, 1)
        total = self.covariances.copy()
        for k in range(4):
            total[:, 2 * k : 2 * k + 2, 2 * k : 2 * k + 2] += built[k::4]
        return np.linalg.inv(np.linalg.cholesky(total))


@dataclass(frozen=True, slots=True, eq=False)
class Minimum:
    """A pose that fits best among its neighbours.

    Attributes:
        pose: T_camera_board.
        cost: chi-square of the residual.
        normal: normal matrix of the twist, shape (6, 6).
        slopes: whitened Jacobian, shape (2n, 6).
        residual_px: root mean square of the residual per axis [px].
    """

    pose: RigidTransform
    cost: float
    normal: FloatArray
    slopes: FloatArray
    residual_px: float


def refine(
    problem: BoardProblem, pose: RigidTransform, known: Sequence[RigidTransform] = ()
) -> Minimum | None:
    """Levenberg-Marquardt on the twist; None if it runs out of the picture or is singular.

    The weights are those of the start until it has converged, then those of the pose found.

    Args:
        problem: the corners.
        pose: start.
        known: minima that are known already; a way that leads to one of them is given up: None.
    """
    found = problem.evaluate(pose @ problem.points)
    for _ in range(_ROUNDS):
        if found is None:
            return None
        start = pose
        pose = _descend(problem, pose, found, known)
        if any(angle_between(pose, other) < SAME for other in known):
            return None
        if pose is start:
            break
        found = problem.evaluate(pose @ problem.points)
    if found is None:
        return None
    normal = found.slopes.T @ found.slopes
    if not np.isfinite(normal).all() or np.linalg.cond(normal) > 1e15:
        return None
    rms = float(np.sqrt(np.mean(found.bare**2)))
    return Minimum(pose, float(found.white @ found.white), normal, found.slopes, rms)


def _descend(
    problem: BoardProblem, pose: RigidTransform, result: Evaluated, known: Sequence[RigidTransform]
) -> RigidTransform:
    """Pose of least cost from `pose` on, with the weights of `result`; the same one if it is.

    A step (ρ, ω) is taken as R ← exp(ω) R, t ← exp(ω) t + ρ: to first order the twist on the left,
    without the cost of a transform that is checked each time.
    """
    damping, cost, moved = 1e-6, float(result.white @ result.white), False
    rotation, translation = pose.rotation, pose.translation
    for _ in range(_STEPS):
        normal, gradient = result.slopes.T @ result.slopes, result.slopes.T @ result.white
        if not np.isfinite(normal).all():
            break
        try:
            step = np.linalg.solve(normal + damping * np.diag(np.diag(normal)), gradient)
        except np.linalg.LinAlgError:
            break
        if step @ gradient < _CONVERGED + _RELATIVE * cost:
            break
        if np.linalg.norm(step[3:]) > 1.0:
            damping = max(10.0 * damping, 1e-3)
            continue
        turn = rotation_exp(step[3:])
        turned, shifted = turn @ rotation, turn @ translation + step[:3]
        after = problem.evaluate(problem.points @ turned.T + shifted, result.whiten)
        if after is None or after.white @ after.white > cost:
            damping = max(10.0 * damping, 1e-3)
            continue
        rotation, translation, result, moved = turned, shifted, after, True
        damping, cost = 0.1 * damping, float(after.white @ after.white)
        if any(_turn(rotation, other.rotation) < SAME for other in known):
            break
    return RigidTransform(rotation, translation) if moved else pose


def angle_between(first: RigidTransform, second: RigidTransform) -> float:
    """Angle between two poses' rotations [rad]."""
    return _turn(first.rotation, second.rotation)


def _turn(first: FloatArray, second: FloatArray) -> float:
    """Angle between two rotations [rad]: |R1 - R2| = 2 √2 sin(angle / 2), exact for small ones."""
    apart = float(np.sqrt(np.sum((first - second) ** 2)))
    return 2.0 * asin(min(1.0, apart / sqrt(8.0)))
