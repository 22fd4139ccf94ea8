"""One tip from two sources: the robot's fine line and the cameras' absolute point.

The robot says on which line the tip is, to within S_line across it; the cameras say where in
space, to within S_cam. With d̂ the line's direction and P_I a point of it, the depth that both agree
on best is the generalised least squares one,

    S = S_cam + S_line,   g = S⁻¹ d̂ / (d̂ᵀ S⁻¹ d̂),   depth = gᵀ (p - P_I),   var = 1 / (d̂ᵀ S⁻¹ d̂),

not the foot of the perpendicular: where the cameras see less exactly in some direction, the point
is moved to the line along that one. The tip is snapped to the line, P_I + depth·d̂, while point and
line agree; its error is then d̂gᵀn + (d̂gᵀ - 1)e, with n the cameras' and e the line's, so that

    Σ = d̂gᵀ S_cam g d̂ᵀ + (d̂gᵀ - 1) S_line (d̂gᵀ - 1)ᵀ.

Where they do not, as with a bent needle, the cameras' point stands by itself.
"""

from dataclasses import dataclass, replace
from math import log
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.rotation import skew

DIRECTION_SIGMA: Final = 1.0e-4
"""Standard deviation of the direction [rad]: one encoder count is 0.02° of needle, / √12. What the
robot's own calibration leaves is in the rig's `line_sd_mm`, the agreement of line and cameras."""

GATE: Final = 1e-5
"""Probability with which a tip on the line is taken for one beside it."""

_LIMIT: Final = -2.0 * log(GATE)  # of chi-square with two degrees of freedom


@dataclass(frozen=True, slots=True, eq=False)
class FusedTip:
    """The needle's tip from both sources.

    Attributes:
        p_tip: on the line if `snapped`, but as one camera and the line gave it where they did,
            else the cameras' own [m], shape (3,), read-only.
        covariance: of it [m²], shape (3, 3), read-only.
        depth: beyond the line's point, along it [m].
        depth_variance: of it [m²].
        snapped: whether point and line agree.
        beside: from the line to the cameras' point, across the line [m], shape (3,), read-only.
        chi_square: of that distance, two degrees of freedom.
    """

    p_tip: FloatArray
    covariance: FloatArray
    depth: float
    depth_variance: float
    snapped: bool
    beside: FloatArray
    chi_square: float


def line_covariance(axis: FloatArray, depth: float, line_variance: float) -> FloatArray:
    """Covariance of the line's place at a depth [m²], shape (3, 3): nothing along the line.

    Args:
        axis: unit direction.
        depth: from the point that the line turns about [m].
        line_variance: of that point across the line, per axis [m²].
    """
    across: FloatArray = np.eye(3) - np.outer(axis, axis)
    return (line_variance + (depth * DIRECTION_SIGMA) ** 2) * across


def fuse_tip(
    p_tip: FloatArray,
    covariance: FloatArray,
    fulcrum: FloatArray,
    axis: FloatArray,
    line_variance: float | None,
) -> FusedTip:
    """Fuse the cameras' tip with the robot's line.

    Args:
        p_tip: by the cameras [m], shape (3,).
        covariance: of it [m²], shape (3, 3).
        fulcrum: point of the line that it turns about, P_I [m], shape (3,).
        axis: unit direction of the line, hub to tip.
        line_variance: of the line across itself, per axis [m²]; None if the tip has been found
            with the line's help already (by one camera): the line must not count twice. Such a
            tip is not moved: its error is known in some directions far better than the line.
    """
    offset = np.asarray(p_tip - fulcrum, dtype=np.float64)
    along = np.outer(axis, axis)
    foot = float(offset @ axis)
    beside = read_only(offset - foot * axis)
    if line_variance is None:
        variance = max(0.0, float(axis @ covariance @ axis))
        return FusedTip(
            read_only(np.array(p_tip, dtype=np.float64)),
            read_only(np.array(covariance)),
            foot,
            variance,
            True,
            beside,
            0.0,
        )
    s_line = line_covariance(axis, foot, line_variance)
    total = covariance + s_line + 1e-18 * np.eye(3)
    weighted = np.linalg.solve(total, axis)
    information = float(axis @ weighted)
    gain = weighted / information
    depth = float(gain @ offset)
    apart = offset - depth * axis
    chi_square = float(apart @ np.linalg.solve(total, apart))
    if chi_square > _LIMIT:
        spread = max(0.0, float(axis @ covariance @ axis))
        return FusedTip(
            read_only(np.array(p_tip, dtype=np.float64)),
            read_only(np.array(covariance)),
            foot,
            spread,
            False,
            beside,
            chi_square,
        )
    moves = np.outer(axis, gain)
    stays = moves - np.eye(3)
    spread_tip = float(gain @ covariance @ gain) * along + stays @ s_line @ stays.T
    return FusedTip(
        read_only(fulcrum + depth * axis),
        read_only(spread_tip),
        depth,
        1.0 / information,
        True,
        beside,
        chi_square,
    )


def turned(tip: FusedTip, fulcrum: FloatArray, then: FloatArray, now: FloatArray) -> FusedTip:
    """Carry a tip on with its line, from the direction `then` to the direction `now`.

    The line turns about `fulcrum` [m] the short way; a line that has turned round altogether, which
    no needle does, leaves the tip where it was.
    """
    cosine = float(then @ now)
    if cosine < 0.0:
        return tip
    turn = skew(np.cross(then, now))
    rotation = np.eye(3) + turn + turn @ turn / (1.0 + cosine)
    return replace(
        tip,
        p_tip=read_only(fulcrum + rotation @ (tip.p_tip - fulcrum)),
        covariance=read_only(rotation @ tip.covariance @ rotation.T),
        beside=read_only(rotation @ tip.beside),
    )
