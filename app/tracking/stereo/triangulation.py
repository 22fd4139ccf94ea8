"""Triangulation of one point from two pictures, its status and its covariance.

Observations are normalised coordinates (x, y) = (X/Z, Y/Z) of each camera, undistorted, with their
own 2×2 covariances. Three ways are named: `linear` (DLT, the null vector of four equations with
scaled rows), `midpoint` (of the shortest line between the rays) and `reprojection` (Gauss–Newton on
the squared, noise-weighted reprojection error, begun at the linear solution). The default is
`reprojection`: the covariance handed out is that of this maximum-likelihood point,

    Σ_p = (Jᵀ diag(Σ₁, Σ₂)⁻¹ J)⁻¹,   J = [J₁; J₂], 4×3, each camera with its own Σ

(annex D of the thesis, corrected), and `acus study stereo` measures what each way costs.
"""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.transform import RigidTransform
from app.tracking.stereo.closed_form import linear, midpoint, ray
from app.tracking.stereo.reprojection import NEAREST, inverse, refine, reprojection

_PARALLEL = 1e-6
"""Sine of the angle between rays [-] below which they do not meet at a finite point."""

_BASELINE = 1e-6
"""Distance of the camera centres [m] below which there is no second point of view."""


class Way(StrEnum):
    """How the point is computed."""

    LINEAR = "linear"
    MIDPOINT = "midpoint"
    REPROJECTION = "reprojection"


class StereoStatus(StrEnum):
    """What became of a pair of observations."""

    FOUND = "found"
    DEGENERATE = "degenerate"  # no baseline, or both rays along it: every depth fits
    AT_INFINITY = "at_infinity"  # parallel rays
    BEHIND = "behind"  # the rays meet behind a camera
    NOT_FINITE = "not_finite"  # an observation is NaN or infinite


@dataclass(frozen=True, slots=True, eq=False)
class Triangulation:
    """A point, or why there is none.

    Attributes:
        status: the point and its covariance mean something only for `found`.
        p_world: the point [m], shape (3,); zero where there is none.
        covariance: of the point [m²], shape (3, 3).
        chi_square: squared, noise-weighted reprojection error, one degree of freedom.
        residual: observed minus predicted normalised coordinates, both cameras, shape (4,).
        observations: as given, shape (2, 2).
        covariances: of the observations, as given, shape (2, 2, 2).
    """

    status: StereoStatus
    p_world: FloatArray
    covariance: FloatArray
    chi_square: float
    residual: FloatArray
    observations: FloatArray
    covariances: FloatArray


def triangulate(
    T_camera_world: tuple[RigidTransform, RigidTransform],
    observations: FloatArray,
    covariances: FloatArray,
    way: Way = Way.REPROJECTION,
) -> Triangulation:
    """Point of two observations.

    Args:
        T_camera_world: of both cameras.
        observations: normalised coordinates, shape (2, 2), a row per camera.
        covariances: of the observations, shape (2, 2, 2), positive definite.
        way: see the module.
    """
    observations = np.asarray(observations, dtype=np.float64)
    status = _ray_status(T_camera_world, observations)
    if status is not StereoStatus.FOUND:
        return _nothing(status)
    weights = np.zeros((4, 4))
    weights[:2, :2], weights[2:, 2:] = np.linalg.inv(np.asarray(covariances, dtype=np.float64))
    closed = midpoint if way is Way.MIDPOINT else linear
    p_world = closed(T_camera_world, observations)
    if way is Way.REPROJECTION:
        p_world = refine(T_camera_world, observations, weights, p_world)
    residual, jacobian, depths = reprojection(T_camera_world, observations, p_world)
    if depths.min() <= NEAREST:
        return _nothing(StereoStatus.BEHIND)
    covariance = inverse(jacobian.T @ weights @ jacobian)
    if covariance is None:
        return _nothing(StereoStatus.DEGENERATE)
    return Triangulation(
        StereoStatus.FOUND,
        read_only(p_world),
        read_only(covariance),
        float(residual @ weights @ residual),
        read_only(residual),
        read_only(np.array(observations)),
        read_only(np.array(covariances, dtype=np.float64)),
    )


def _ray_status(
    poses: tuple[RigidTransform, RigidTransform], observations: FloatArray
) -> StereoStatus:
    """Decide on the rays themselves, before any system is solved."""
    if not np.isfinite(observations).all():
        return StereoStatus.NOT_FINITE
    (centre, first), (other, second) = (
        ray(pose, xy) for pose, xy in zip(poses, observations, strict=True)
    )
    baseline = other - centre
    length = float(np.linalg.norm(baseline))
    if length < _BASELINE:
        return StereoStatus.DEGENERATE
    if float(np.linalg.norm(np.cross(first, second))) < _PARALLEL:
        along = float(np.linalg.norm(np.cross(first, baseline))) < _PARALLEL * length
        return StereoStatus.DEGENERATE if along else StereoStatus.AT_INFINITY
    return StereoStatus.FOUND


def _nothing(status: StereoStatus) -> Triangulation:
    zero, spread = read_only(np.zeros(3)), read_only(np.zeros((3, 3)))
    residual, observations = read_only(np.zeros(4)), read_only(np.zeros((2, 2)))
    covariances = read_only(np.zeros((2, 2, 2)))
    return Triangulation(status, zero, spread, 0.0, residual, observations, covariances)
