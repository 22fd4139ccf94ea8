"""Residual, Jacobian and optimum of a point's reprojection; the work is done by `kernels`."""

import numpy as np

from app.core.arrays import FloatArray
from app.core.transform import RigidTransform
from app.tracking.stereo.kernels import NEAREST, optimum, reproject

Poses = tuple[RigidTransform, ...]
"""T_camera_world of the cameras."""

__all__ = ["NEAREST", "Poses", "inverse", "refine", "reprojection", "stacked"]


def stacked(poses: Poses) -> tuple[FloatArray, FloatArray]:
    """Rotations (n, 3, 3) and translations (n, 3): parts of one array, as `locate` has them.

    The kernels are compiled for such parts then, and for nothing else.
    """
    whole = np.empty((len(poses), 3, 4))
    for row, pose in zip(whole, poses, strict=True):
        row[:, :3], row[:, 3] = pose.rotation, pose.translation
    return whole[:, :, :3], whole[:, :, 3]


def reprojection(
    poses: Poses, observations: FloatArray, p_world: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Reproject a point into n cameras.

    Returns:
        Residual observed minus predicted, shape (2n,), Jacobian of the prediction by the point
        [1/m], shape (2n, 3), and depths before the cameras [m], shape (n,).
    """
    n = len(poses)
    rotations, translations = stacked(poses)
    observed, point = np.array(observations), np.array(p_world)
    residual, jacobian, depths = np.empty(2 * n), np.empty((2 * n, 3)), np.empty(n)
    for i in range(n):
        rows = slice(2 * i, 2 * i + 2)
        depths[i] = reproject(
            rotations[i], translations[i], observed[i], point, residual[rows], jacobian[rows]
        )
    return residual, jacobian, depths


def refine(
    poses: Poses,
    observations: FloatArray,
    covariances: FloatArray,
    p_world: FloatArray,
    prior: tuple[FloatArray, FloatArray] | None = None,
    steps: int = 10,
) -> tuple[FloatArray, FloatArray | None, float, float, FloatArray]:
    """Gauss–Newton from `p_world` [m]; a step that does not lower the error is not taken.

    Args:
        poses: T_camera_world of n cameras.
        observations: normalised coordinates, shape (n, 2).
        covariances: of them, shape (n, 2, 2), positive definite.
        p_world: where to begin, shape (3,).
        prior: a point [m] and the information about it [1/m²], (3,) and (3, 3); its error is added.
        steps: at most so many; 0 evaluates at `p_world`.

    Returns:
        Point [m], (3,); its covariance [m²], (3, 3), None where it is not determined; squared
        weighted error; least depth before a camera [m]; residual, (2n,).
    """
    point = np.array(p_world, dtype=np.float64)
    centre, information = prior if prior is not None else (point, np.zeros((3, 3)))
    residual, spread = np.empty(2 * len(poses)), np.empty((3, 3))
    cost, least, found = optimum(
        *stacked(poses),
        np.array(observations, dtype=np.float64),
        np.array(covariances, dtype=np.float64),
        point,
        np.array(centre, dtype=np.float64),
        np.array(information, dtype=np.float64),
        steps,
        residual,
        spread,
    )
    return point, spread if found else None, float(cost), float(least), residual


def inverse(information: FloatArray) -> FloatArray | None:
    """Inverse of a positive definite matrix, or None if it is not safely that."""
    values, vectors = np.linalg.eigh(information)
    if not values[0] > 1e-14 * values[-1]:
        return None
    return np.asarray((vectors / values) @ vectors.T)
