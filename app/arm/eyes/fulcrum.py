"""The fulcrum from the motion of the shaft: the point that all its lines pass through.

Two ways. `meet_lines` is the algebraic one: with e₁, e₂ across each line (p, d), the point f of the
least sum of squared distances solves e·f = e·p for all of them, and what the poses' covariances
make of it is its covariance. `meet_planes` asks the pictures: the fulcrum's picture lies on the
axis that each camera sees, and its distance from it counts by the variance of that axis there,

    e = -sin α (x - c_x) + cos α (y - c_y),   var e = hᵀ Σ h,   h = (sin α, -cos α, -u),

u along the axis: an axis is known best where the tool is, and less well the further off the fulcrum
lies. It needs no pose, so a picture of one camera counts too.

Lines that are all parallel meet nowhere: the motion must turn the shaft by ten times what its
direction is uncertain, or the answer is `degenerate`; never a far point. Systems of equations are
solved by singular values of the lines themselves, not of their normal equations, which would
square a grazing angle.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.arm.eyes.pose import AxisSight
from app.core.arrays import FloatArray, read_only
from app.core.units import MILLIMETRE
from app.tracking.confidence import chi_square_quantile

LARGEST_SD: Final = 3.0 * MILLIMETRE
"""Standard deviation of the fulcrum [m], in its worst direction, above which there is none."""

_TURNED: Final = 10.0
"""How far lines must turn, over the deviation of their directions."""

_PARALLEL: Final = 1e-7
"""Turn [rad] below which exact lines are parallel."""

_ROUNDS: Final = 4
_STEPS: Final = 8
_AGREEING: Final = 0.7
_FIT: Final = 1.0 - 1e-4


class FulcrumStatus(StrEnum):
    """What became of some lines."""

    FOUND = "found"
    DEGENERATE = "degenerate"  # fewer than two lines, all parallel, or turned too little
    CONTRADICTORY = "contradictory"  # they do not meet: the tool was not held by the trocar
    NOT_FINITE = "not_finite"  # a line that is no number


@dataclass(frozen=True, slots=True, eq=False)
class ShaftLine:
    """A line of the shaft.

    Attributes:
        p_world: a point on it [m], shape (3,).
        axis_world: unit vector along it, shape (3,).
        covariance: of both together, shape (6, 6).
    """

    p_world: FloatArray
    axis_world: FloatArray
    covariance: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class Fulcrum:
    """Where lines meet; numbers mean something only for `found`.

    Attributes:
        status: see `FulcrumStatus`.
        p_world: the point [m], shape (3,).
        covariance: of it [m²], shape (3, 3); inflated where lines miss it by more than they say.
        used: how many lines, or sights, count.
        left_out: how many did not fit and do not.
    """

    status: FulcrumStatus
    p_world: FloatArray
    covariance: FloatArray
    used: int
    left_out: int

    @property
    def sd_mm(self) -> float:
        """Standard deviation in the worst direction [mm]."""
        return float(np.sqrt(np.linalg.eigvalsh(self.covariance)[-1])) / MILLIMETRE


def meet_lines(lines: Sequence[ShaftLine]) -> Fulcrum:
    """Return the point nearest to all lines, each counting alike.

    Args:
        lines: of the shaft in several poses.
    """
    if len(lines) < 2:
        return _nothing(FulcrumStatus.DEGENERATE)
    points = np.array([line.p_world for line in lines])
    axes = np.array([line.axis_world for line in lines])
    spreads = np.array([line.covariance for line in lines])
    if not all(np.isfinite(values).all() for values in (points, axes, spreads)):
        return _nothing(FulcrumStatus.NOT_FINITE)
    across = _across(axes)
    keep = np.ones(len(lines), np.bool_)
    found = _nothing(FulcrumStatus.DEGENERATE)
    for _ in range(_ROUNDS):
        middle = points[keep].mean(axis=0)
        rows = across[keep].reshape(-1, 3)
        offsets = np.einsum("nij,nj->ni", across, points - middle)
        turning = np.einsum("nii->n", spreads[keep, 3:, 3:])
        solver = _inverse(rows, axes[keep], turning)
        if solver is None:
            return _nothing(FulcrumStatus.DEGENERATE)
        p_world = middle + solver @ offsets[keep].ravel()
        misses = np.einsum("nij,nj->ni", across, points - p_world)
        away = np.einsum("ni,ni->n", axes, points - p_world)
        by = np.concatenate([across, -away[:, None, None] * across], axis=2)  # (n, 2, 6)
        variances = by @ spreads @ by.transpose(0, 2, 1) + 1e-18 * np.eye(2)
        misfit = np.einsum("ni,nij,nj->n", misses, np.linalg.inv(variances), misses)
        gains = solver.reshape(3, -1, 2)
        spread = np.einsum("inj,njk,lnk->il", gains, variances[keep], gains)
        found = _found(p_world, spread, misfit, keep, 2)
        fits = _fitting(misfit, keep, 2)
        if (fits == keep).all():
            break
        if fits.mean() < _AGREEING:
            return _nothing(FulcrumStatus.CONTRADICTORY)
        keep = fits
    return found


def meet_planes(sights: Sequence[AxisSight]) -> Fulcrum:
    """Return the point whose pictures lie nearest to the axes seen, each by its own variance.

    Args:
        sights: of the shaft in several poses, by any of the cameras.
    """
    if len(sights) < 3:
        return _nothing(FulcrumStatus.DEGENERATE)
    seen = np.array([[*sight.centre, sight.angle, *sight.spread.ravel()] for sight in sights])
    if not np.isfinite(seen).all():
        return _nothing(FulcrumStatus.NOT_FINITE)
    keep = np.ones(len(sights), np.bool_)
    p_world = _where_planes_meet(sights, keep)
    if p_world is None:
        return _nothing(FulcrumStatus.DEGENERATE)
    found = _nothing(FulcrumStatus.DEGENERATE)
    for _ in range(_ROUNDS):
        for _ in range(_STEPS):
            misses, by, variances = _distances(sights, seen, p_world)
            weighted = by[keep] / np.sqrt(variances[keep])[:, None]
            left, values, right = np.linalg.svd(weighted, full_matrices=False)
            if not values[-1] > _PARALLEL * values[0]:
                return _nothing(FulcrumStatus.DEGENERATE)
            inverse = (right.T / values) @ left.T
            step = inverse @ (misses[keep] / np.sqrt(variances[keep]))
            p_world = p_world - step
            if float(np.abs(step).max()) < 1e-10:
                break
        misfit = misses**2 / variances
        found = _found(p_world, inverse @ inverse.T, misfit, keep, 1)
        fits = _fitting(misfit, keep, 1)
        if (fits == keep).all():
            break
        if fits.mean() < _AGREEING:
            return _nothing(FulcrumStatus.CONTRADICTORY)
        keep = fits
        if _where_planes_meet(sights, keep) is None:
            return _nothing(FulcrumStatus.DEGENERATE)
    return found


def _across(axes: FloatArray) -> FloatArray:
    """Two unit vectors across each axis and each other, (n, 2, 3)."""
    aside = np.eye(3)[np.argmin(np.abs(axes), axis=1)]
    first = np.cross(axes, aside)
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return np.stack([first, np.cross(axes, first)], axis=1)


def _inverse(rows: FloatArray, axes: FloatArray, turning: FloatArray) -> FloatArray | None:
    """Pseudo-inverse of equations, (3, m); None where noise alone could turn what is parallel.

    Args:
        rows: left sides, (m, 3).
        axes: of the lines that they belong to, (n, 3).
        turning: variance of each axis' direction [rad²], (n,).
    """
    left, values, right = np.linalg.svd(rows, full_matrices=False)
    weakest = right[-1]
    by_noise = float(turning @ (axes @ weakest) ** 2)
    turned = float(values[-1]) ** 2
    if not turned > max(_TURNED**2 * by_noise, len(axes) * _PARALLEL**2):
        return None
    return np.asarray((right.T / values) @ left.T)


def _where_planes_meet(sights: Sequence[AxisSight], keep: NDArray[np.bool_]) -> FloatArray | None:
    """Algebraic point of the planes through cameras and axes; None if they meet in no one point."""
    kept = [sight for sight, one in zip(sights, keep, strict=True) if one]
    planes = [sight.plane() for sight in kept]
    normals = np.array([plane[1] for plane in planes])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    turns = np.array([plane[3][:, 2] for plane in planes]) / lengths
    angle_sds = np.sqrt([sight.spread[2, 2] for sight in kept])[:, None]
    normals = normals / lengths
    centres = np.array([sight.T_world_camera.translation for sight in kept])
    middle = centres.mean(axis=0)
    solver = _inverse(normals, turns * angle_sds, np.ones(len(kept)))
    if solver is None:
        return None
    return np.asarray(middle + solver @ np.einsum("ni,ni->n", normals, centres - middle))


def _distances(
    sights: Sequence[AxisSight], seen: FloatArray, p_world: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Distance of the point's pictures from the axes, by the point, and their variances."""
    rotations = np.array([sight.T_world_camera.rotation.T for sight in sights])
    centres = np.array([sight.T_world_camera.translation for sight in sights])
    local = np.einsum("nij,nj->ni", rotations, p_world - centres)
    z = np.where(np.abs(local[:, 2]) > 1e-6, local[:, 2], 1e-6)
    x, y = local[:, 0] / z, local[:, 1] / z
    cosine, sine = np.cos(seen[:, 2]), np.sin(seen[:, 2])
    dx, dy = x - seen[:, 0], y - seen[:, 1]
    misses = -sine * dx + cosine * dy
    change = np.stack([sine, -cosine, -(cosine * dx + sine * dy)], axis=1)
    spreads = seen[:, 3:].reshape(-1, 3, 3)
    variances = np.einsum("ni,nij,nj->n", change, spreads, change)
    by_local = np.stack([-sine / z, cosine / z, (sine * x - cosine * y) / z], axis=1)
    by = np.einsum("ni,nij->nj", by_local, rotations)
    return misses, by, np.maximum(variances, 1e-30)


def _fitting(misfit: FloatArray, keep: NDArray[np.bool_], freedom: int) -> NDArray[np.bool_]:
    """Say which fit, against their own median: lines worse than they say are no outliers."""
    scale = max(1.0, float(np.median(misfit[keep])) / chi_square_quantile(0.5, freedom))
    return np.asarray(misfit < scale * chi_square_quantile(_FIT, freedom))


def _found(
    p_world: FloatArray,
    spread: FloatArray,
    misfit: FloatArray,
    keep: NDArray[np.bool_],
    freedom: int,
) -> Fulcrum:
    left = freedom * int(keep.sum()) - 3
    factor = max(1.0, float(misfit[keep].sum()) / left) if left > 0 else 1.0
    worst = float(np.linalg.eigvalsh(spread)[-1])
    if not worst <= LARGEST_SD**2:
        return _nothing(FulcrumStatus.DEGENERATE)
    if not factor * worst <= LARGEST_SD**2:
        return _nothing(FulcrumStatus.CONTRADICTORY)
    return Fulcrum(
        FulcrumStatus.FOUND,
        read_only(p_world),
        read_only(factor * spread),
        int(keep.sum()),
        int((~keep).sum()),
    )


def _nothing(status: FulcrumStatus) -> Fulcrum:
    return Fulcrum(status, read_only(np.zeros(3)), read_only(np.zeros((3, 3))), 0, 0)
