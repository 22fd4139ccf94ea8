"""The band's place from one camera's ray and the shaft's line: what is left if a camera is lost.

The ray leaves one direction open, the line by the robot another. Both together are a least squares
problem with the point p as unknown,

    minimise  rᵀ Σ_ray⁻¹ r  +  |(I - d̂d̂ᵀ)(p - P_I)|² / σ_line²,

whose inverse information is the point's covariance. Where the ray runs nearly along the shaft the
two say the same, and the place along it stays open: such a point is refused.
"""

from dataclasses import dataclass
from enum import StrEnum
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.transform import RigidTransform
from app.core.units import DEGREE
from app.tracking.stereo.closed_form import closest, ray
from app.tracking.stereo.reprojection import NEAREST, refine

LEAST_ANGLE: Final = 15.0 * DEGREE
"""Angle between ray and shaft [rad] below which there is no point: there an error of the line
counts four times along the needle."""


class RayStatus(StrEnum):
    """What became of a ray and the shaft's line."""

    FOUND = "found"
    ALONG_THE_SHAFT = "along_the_shaft"  # the camera looks along the needle
    BEHIND = "behind"  # the line passes the ray behind the camera
    NOT_FINITE = "not_finite"


@dataclass(frozen=True, slots=True, eq=False)
class LinePoint:
    """A point seen by one camera on a line.

    Attributes:
        status: the rest means something only for `found`.
        p_world: the point [m], shape (3,).
        covariance: of the point [m²], shape (3, 3).
        chi_square: squared, weighted distance of ray and line, one degree of freedom.
        residual: observed minus predicted normalised coordinates, shape (2,).
    """

    status: RayStatus
    p_world: FloatArray
    covariance: FloatArray
    chi_square: float
    residual: FloatArray


def point_on_line(
    T_camera_world: RigidTransform,
    observation: FloatArray,
    covariance: FloatArray,
    line: tuple[FloatArray, FloatArray],
    line_variance: float,
) -> LinePoint:
    """Point on a line that one camera sees.

    Args:
        T_camera_world: of the camera.
        observation: normalised coordinates, shape (2,).
        covariance: of the observation, shape (2, 2), positive definite.
        line: a point of it [m] and its unit direction, both shape (3,).
        line_variance: of the line's place across itself, per axis [m²].
    """
    if not (np.isfinite(observation).all() and np.isfinite(line[0]).all()):
        return _nothing(RayStatus.NOT_FINITE)
    seen = ray(T_camera_world, observation)
    if float(np.linalg.norm(np.cross(seen[1], line[1]))) < np.sin(LEAST_ANGLE):
        return _nothing(RayStatus.ALONG_THE_SHAFT)
    start = closest(seen, line)[1]
    poses, observed = (T_camera_world,), np.asarray(observation)[None]
    prior = (np.eye(3) - np.outer(line[1], line[1])) / line_variance
    p_world, spread, chi_square, nearest, residual = refine(
        poses, observed, np.asarray(covariance)[None], start, (line[0], prior)
    )
    if nearest <= NEAREST:
        return _nothing(RayStatus.BEHIND)
    if spread is None:
        return _nothing(RayStatus.ALONG_THE_SHAFT)
    return LinePoint(
        RayStatus.FOUND, read_only(p_world), read_only(spread), chi_square, read_only(residual)
    )


def _nothing(status: RayStatus) -> LinePoint:
    zero = np.zeros(3)
    return LinePoint(
        status, read_only(zero), read_only(np.zeros((3, 3))), 0.0, read_only(np.zeros(2))
    )
