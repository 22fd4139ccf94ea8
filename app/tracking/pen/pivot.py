"""Where the tip is in the body's frame: the pen is rocked with its tip in a dimple.

Tip t (body) and dimple c (world) fulfil R_i t + p_i = c for every pose i: linear in both. Each
equation is weighted by what the pose's covariance makes of the tip. A direction that the motion
says nothing about is named, not guessed.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.tracking.confidence import chi_square_quantile
from app.tracking.pen.errors import PenError
from app.tracking.pen.pose import skews

FEWEST = 20
"""Poses below which nothing is computed."""

LARGEST_SD = 2.0e-3
"""Standard deviation of the tip [m], in its worst direction, above which a motion is refused."""

LEAST_ROCKING = 12.0 * DEGREE
"""Spread of the shaft's direction [rad] that pivoting needs, both ways."""

_GATE = 1e-6
_ROUNDS = 4


@dataclass(frozen=True, slots=True, eq=False)
class MeasuredPose:
    """Pose of the body at one moment and its covariance (twist on the left), shape (6, 6)."""

    T: RigidTransform
    covariance: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class TipCalibration:
    """What pivoting found.

    Attributes:
        p_tip: tip in the body's frame [m], shape (3,).
        covariance: of it [m²], shape (3, 3); inflated if the residual is larger than expected.
        p_dimple: where the tip stood, in the poses' frame [m], shape (3,).
        rms: root mean square distance of the tips from the dimple [m].
        poses: how many were used.
        left_out: how many did not fit (a tip that jumped out) and were left out.
    """

    p_tip: FloatArray
    covariance: FloatArray
    p_dimple: FloatArray
    rms: float
    poses: int
    left_out: int

    @property
    def sd_mm(self) -> float:
        """Standard deviation in the worst direction [mm]."""
        return float(np.sqrt(np.linalg.eigvalsh(self.covariance)[-1])) / MILLIMETRE


def pivot(poses: Sequence[MeasuredPose]) -> TipCalibration:
    """Find the tip from poses of a pen whose tip stood still.

    Raises:
        PenError: with fewer than `FEWEST` poses; if the pen was not rocked, or in one plane only,
            or only rolled; or if most poses contradict each other.
    """
    if len(poses) < FEWEST:
        raise PenError(
            sentence(
                "{poses} poses are too few to find the tip; rock the pen until there are {fewest}",
                poses=len(poses),
                fewest=FEWEST,
            )
        )
    rotations = np.array([pose.T.rotation for pose in poses])
    shifts = np.array([pose.T.translation for pose in poses])
    _require_motion(rotations)
    keep = np.ones(len(poses), dtype=np.bool_)
    solution: FloatArray = np.zeros(6)
    for number in range(_ROUNDS):
        weights = _weights(poses, solution[:3] if number else None)
        normal, right = _normal_equations(rotations, shifts, weights, keep)
        solution = np.asarray(np.linalg.solve(normal, right), dtype=np.float64)
        rest = rotations @ solution[:3] + shifts - solution[3:]
        misfit = np.einsum("ni,nij,nj->n", rest, weights, rest)
        if number:
            # Against their own median: a print that is worse than declared is not an outlier.
            scale = max(1.0, float(np.median(misfit[keep])) / chi_square_quantile(0.5, 3))
            keep = misfit < scale * chi_square_quantile(1.0 - 1e-4, 3)
            _require_agreement(keep)
    freedom = 3 * int(keep.sum()) - 6
    factor = max(1.0, float(misfit[keep].sum()) / freedom)
    covariance = factor * np.linalg.inv(normal)[:3, :3]
    found = TipCalibration(
        read_only(solution[:3]),
        read_only(covariance),
        read_only(solution[3:]),
        float(np.sqrt(np.mean((rest[keep] ** 2).sum(axis=1)))),
        int(keep.sum()),
        int((~keep).sum()),
    )
    _require_certainty(found)
    return found


def _weights(poses: Sequence[MeasuredPose], p_tip: FloatArray | None) -> FloatArray:
    """Inverse covariance of each pose's tip in the poses' frame, (n, 3, 3)."""
    if p_tip is None:
        return np.tile(np.eye(3) / MILLIMETRE**2, (len(poses), 1, 1))
    jacobians = np.empty((len(poses), 3, 6))
    jacobians[:, :, :3] = np.eye(3)
    jacobians[:, :, 3:] = -skews(np.array([pose.T @ p_tip for pose in poses]))
    covariances = np.array([pose.covariance for pose in poses])
    spread = jacobians @ covariances @ jacobians.transpose(0, 2, 1)
    return np.asarray(np.linalg.inv(spread + (1e-6) ** 2 * np.eye(3)))


def _normal_equations(
    rotations: FloatArray, shifts: FloatArray, weights: FloatArray, keep: np.ndarray
) -> tuple[FloatArray, FloatArray]:
    rows = np.concatenate(
        [rotations[keep], np.broadcast_to(-np.eye(3), rotations[keep].shape)], axis=2
    )
    weighted = np.einsum("nij,njk->nik", weights[keep], rows)
    normal = np.einsum("nji,njk->ik", rows, weighted)
    return normal, -np.einsum("nji,nj->i", weighted, shifts[keep])


def _require_motion(rotations: FloatArray) -> None:
    """Refuse motions that leave a direction of the tip open.

    (R_i - mean R) t says everything that is known of t: its null direction is the common axis.
    """
    about = rotations - rotations.mean(axis=0)
    values, directions = np.linalg.eigh(np.einsum("nji,njk->ik", about, about) / len(rotations))
    spread = np.sqrt(np.maximum(values, 0.0))  # about the sine of the angles swept, each direction
    if spread[1] < np.sin(LEAST_ROCKING) / 2.0:
        raise PenError(
            sentence(
                "the pen was held still: rock it by 30° to every side with its tip in the dimple"
            )
        )
    if spread[0] < np.sin(LEAST_ROCKING) / 2.0:
        named = np.abs(directions[:, 0])
        how = "only rolled about its own axis" if named[2] > 0.9 else "rocked in one plane only"
        raise PenError(
            sentence(
                "the pen was {how}: the tip's place along that axis stays open; rock it by 30° "
                "to every side with its tip in the dimple",
                how=how,
            )
        )


def _require_agreement(keep: np.ndarray) -> None:
    if keep.mean() < 0.7:
        raise PenError(
            sentence(
                "{contradicting} of {poses} poses contradict the others: the tip slipped; "
                "press it into the dimple and rock again",
                contradicting=int((~keep).sum()),
                poses=len(keep),
            )
        )


def _require_certainty(result: TipCalibration) -> None:
    if result.sd_mm * MILLIMETRE > LARGEST_SD:
        raise PenError(
            sentence(
                "the tip is known to {result_sd_mm:.1f} mm only (standard deviation), the limit "
                "is {largest_sd_mm:.0f} mm: rock it further, nearer to the webcam",
                result_sd_mm=result.sd_mm,
                largest_sd_mm=LARGEST_SD / MILLIMETRE,
            )
        )
