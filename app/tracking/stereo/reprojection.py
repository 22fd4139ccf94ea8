"""The optimal point: least squared, noise-weighted reprojection error, by Gauss–Newton."""

from typing import Any

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.transform import RigidTransform

NEAREST = 1e-6
"""Depth [m] before a camera below which a point counts as not in front of it."""

_STEPS = 10

Poses = tuple[RigidTransform, ...]
"""T_camera_world of the cameras."""


def reprojection(
    poses: Poses, observations: FloatArray, p_world: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Reproject a point into n cameras.

    Returns:
        Residual observed minus predicted, shape (2n,), Jacobian of the prediction by the point
        [1/m], shape (2n, 3), and depths before the cameras [m], shape (n,).
    """
    n = len(poses)
    residual, jacobian, depths = np.empty(2 * n), np.empty((2 * n, 3)), np.empty(n)
    for i, pose in enumerate(poses):
        rows = slice(2 * i, 2 * i + 2)
        depths[i] = _reproject(
            pose.rotation,
            pose.translation,
            observations[i],
            p_world,
            residual[rows],
            jacobian[rows],
        )
    return residual, jacobian, depths


def refine(
    poses: Poses,
    observations: FloatArray,
    weights: FloatArray,
    p_world: FloatArray,
    prior: tuple[FloatArray, FloatArray] | None = None,
) -> FloatArray:
    """Gauss–Newton from `p_world` [m]; a step that does not lower the error is not taken.

    Args:
        poses: T_camera_world of n cameras.
        observations: normalised coordinates, shape (n, 2).
        weights: inverse of their covariance, shape (2n, 2n).
        p_world: where to begin, shape (3,).
        prior: a point [m] and the information about it [1/m²], (3,) and (3, 3); its error is added.
    """
    centre, information = prior if prior is not None else (p_world, np.zeros((3, 3)))
    residual, jacobian, depths = reprojection(poses, observations, p_world)
    if depths.min() <= NEAREST:
        return p_world
    cost = float(residual @ weights @ residual) + _squared(p_world - centre, information)
    for _ in range(_STEPS):
        spread = inverse(jacobian.T @ weights @ jacobian + information)
        if spread is None:
            break
        slope = jacobian.T @ (weights @ residual) - information @ (p_world - centre)
        candidate = p_world + spread @ slope
        new_residual, new_jacobian, new_depths = reprojection(poses, observations, candidate)
        new_cost = float(new_residual @ weights @ new_residual)
        new_cost += _squared(candidate - centre, information)
        if new_depths.min() <= NEAREST or not new_cost <= cost:
            break
        done = cost - new_cost <= 1e-12 * cost or np.abs(candidate - p_world).max() < 1e-12
        p_world, residual, jacobian, cost = candidate, new_residual, new_jacobian, new_cost
        if done:
            break
    return p_world


def inverse(information: FloatArray) -> FloatArray | None:
    """Inverse of a positive definite matrix, or None if it is not safely that."""
    values, vectors = np.linalg.eigh(information)
    if not values[0] > 1e-14 * values[-1]:
        return None
    return np.asarray((vectors / values) @ vectors.T)


def _squared(difference: FloatArray, information: FloatArray) -> float:
    return float(difference @ information @ difference)


@njit
def _reproject(r: Any, t: Any, observed: Any, p: Any, residual: Any, jacobian: Any) -> float:
    """One camera's rows, in place; returns the depth."""
    x = r[0, 0] * p[0] + r[0, 1] * p[1] + r[0, 2] * p[2] + t[0]
    y = r[1, 0] * p[0] + r[1, 1] * p[1] + r[1, 2] * p[2] + t[1]
    depth = r[2, 0] * p[0] + r[2, 1] * p[1] + r[2, 2] * p[2] + t[2]
    z = depth if abs(depth) > NEAREST else NEAREST
    x, y = x / z, y / z
    residual[0], residual[1] = observed[0] - x, observed[1] - y
    for k in range(3):
        jacobian[0, k] = (r[0, k] - x * r[2, k]) / z
        jacobian[1, k] = (r[1, k] - y * r[2, k]) / z
    return depth
