"""Curves of an attempt for the debrief page, and the same figures at one moment for the window."""

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.planning.placement import PlacedPlan
from app.session.needle import NeedlePose
from app.session.samples import Samples


@dataclass(frozen=True, slots=True)
class Offset:
    """From the tip to the target, split along and across the planned path.

    Attributes:
        lateral: distance across the path [m].
        remaining: way still to go along the path [m]; negative once too deep.
        distance: from the tip to the target [m].
        angle: between needle and path [rad].
    """

    lateral: float
    remaining: float
    distance: float
    angle: float


@dataclass(frozen=True, slots=True, eq=False)
class Curves:
    """Figures over time, n samples, read-only; NaN where the pose was not valid.

    Attributes:
        time: since the first sample [s], shape (n,).
        depth: of the tip [m].
        lateral: see `Offset` [m].
        remaining: see `Offset` [m].
        angle: see `Offset` [rad].
        felt: magnitude of the force at the hub point [N].
    """

    time: FloatArray
    depth: FloatArray
    lateral: FloatArray
    remaining: FloatArray
    angle: FloatArray
    felt: FloatArray


def offset(pose: NeedlePose, p_target: FloatArray, path: FloatArray) -> Offset:
    """Offset of one pose from a target [m] on a path (unit vector)."""
    lateral, remaining = _split(pose.p_tip - p_target, path)
    angle = _angles(pose.axis, path)
    return Offset(
        float(lateral), float(remaining), float(np.hypot(lateral, remaining)), float(angle)
    )


def curves(samples: Samples, placed: PlacedPlan) -> Curves:
    """Curves of an attempt; the target is the moving one."""
    lateral, remaining = _split(samples.tip - samples.target, placed.axis)
    start = samples.time[0] if len(samples.time) else 0.0
    return Curves(
        time=read_only(samples.time - start),
        depth=samples.depth,
        lateral=read_only(lateral),
        remaining=read_only(remaining),
        angle=read_only(_angles(samples.axis, placed.axis)),
        felt=read_only(np.linalg.norm(samples.felt, axis=1)),
    )


def _split(beyond: FloatArray, path: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Lateral distance and way to go of tip - target, shape (3,) or (n, 3)."""
    along = beyond @ path
    across = beyond - along[..., None] * path
    return np.linalg.norm(across, axis=-1), -along


def _angles(axes: FloatArray, path: FloatArray) -> FloatArray:
    result: FloatArray = np.arctan2(np.linalg.norm(np.cross(axes, path), axis=-1), axes @ path)
    return result
