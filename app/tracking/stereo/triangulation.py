"""Triangulation of one point from two pictures, its status and its covariance.

Observations are normalised coordinates (x, y) = (X/Z, Y/Z) of each camera, undistorted, with their
own 2×2 covariances. Three ways are named: `linear` (DLT, the null vector of four equations with
scaled rows), `midpoint` (of the shortest line between the rays) and `reprojection` (Gauss–Newton on
the squared, noise-weighted reprojection error, begun at the midpoint). The default is
`reprojection`: the covariance handed out is that of this maximum-likelihood point,

    Σ_p = (Jᵀ diag(Σ₁, Σ₂)⁻¹ J)⁻¹,   J = [J₁; J₂], 4×3, each camera with its own Σ

(annex D of the thesis, corrected), and `acus study stereo` measures what each way costs.
"""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.transform import RigidTransform
from app.tracking.stereo import kernels
from app.tracking.stereo.closed_form import linear
from app.tracking.stereo.kernels import NEAREST, meet
from app.tracking.stereo.reprojection import refine, stacked

_STEPS = 10


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
    observed = np.array(observations, dtype=np.float64)
    middle = np.zeros(3)
    status = _STATUS[meet(*stacked(T_camera_world), observed, middle)]
    if status is not StereoStatus.FOUND:
        return _nothing(status)
    start = linear(T_camera_world, observed) if way is Way.LINEAR else middle
    steps = _STEPS if way is Way.REPROJECTION else 0
    spreads = np.array(covariances, dtype=np.float64)
    p_world, covariance, chi_square, nearest, residual = refine(
        T_camera_world, observed, spreads, start, steps=steps
    )
    if nearest <= NEAREST:
        return _nothing(StereoStatus.BEHIND)
    if covariance is None:
        return _nothing(StereoStatus.DEGENERATE)
    return triangulation(
        kernels.FOUND, p_world, covariance, chi_square, residual, observed, spreads
    )


def triangulation(
    status: int,
    p_world: FloatArray,
    covariance: FloatArray,
    chi_square: float,
    residual: FloatArray,
    observations: FloatArray,
    covariances: FloatArray,
) -> Triangulation:
    """Publish what a kernel has found: arrays become read-only; without a point they are zero.

    Args:
        status: one of those in `kernels`.
        p_world: see `Triangulation`.
        covariance: likewise.
        chi_square: likewise.
        residual: likewise.
        observations: likewise.
        covariances: likewise.
    """
    named = _STATUS[status]
    if named is not StereoStatus.FOUND:
        return _nothing(named)
    arrays = (p_world, covariance, residual, observations, covariances)
    point, spread, left, seen, noise = (read_only(array) for array in arrays)
    return Triangulation(named, point, spread, float(chi_square), left, seen, noise)


_STATUS = {
    kernels.FOUND: StereoStatus.FOUND,
    kernels.DEGENERATE: StereoStatus.DEGENERATE,
    kernels.AT_INFINITY: StereoStatus.AT_INFINITY,
    kernels.NOT_FINITE: StereoStatus.NOT_FINITE,
    kernels.BEHIND: StereoStatus.BEHIND,
}


def _nothing(status: StereoStatus) -> Triangulation:
    zero, spread = read_only(np.zeros(3)), read_only(np.zeros((3, 3)))
    residual, observations = read_only(np.zeros(4)), read_only(np.zeros((2, 2)))
    covariances = read_only(np.zeros((2, 2, 2)))
    return Triangulation(status, zero, spread, 0.0, residual, observations, covariances)
