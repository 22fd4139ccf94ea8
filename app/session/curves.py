"""Curves of an attempt for the debrief page, and the same figures at one moment for the window."""

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.planning.off_path import Offset, angles, path_to, split
from app.planning.off_path import offset as offset_of
from app.planning.placement import PlacedPlan
from app.session.needle import NeedlePose
from app.session.samples import Samples


@dataclass(frozen=True, slots=True, eq=False)
class Curves:
    """Figures over time, n samples, read-only; NaN where the pose was not valid.

    Attributes:
        time: since the first sample [s], shape (n,).
        depth: of the tip [m].
        lateral: see `planning.off_path.Offset` [m].
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


def offset(pose: NeedlePose, p_target: FloatArray, placed: PlacedPlan) -> Offset:
    """Offset of one pose from the target as it is now [m]."""
    return offset_of(pose.p_tip, pose.axis, placed, p_target)


def curves(samples: Samples, placed: PlacedPlan) -> Curves:
    """Curves of an attempt; the path is the one to the moving target."""
    path = path_to(placed, samples.target)
    if np.array_equal(path, np.broadcast_to(placed.axis, path.shape)):
        path = placed.axis
    across, remaining = split(samples.tip - samples.target, path)
    start = samples.time[0] if len(samples.time) else 0.0
    return Curves(
        time=read_only(samples.time - start),
        depth=samples.depth,
        lateral=read_only(np.linalg.norm(across, axis=-1)),
        remaining=read_only(remaining),
        angle=read_only(angles(samples.axis, path)),
        felt=read_only(np.linalg.norm(samples.felt, axis=1)),
    )


def at_rest(samples: Samples, placed: PlacedPlan) -> FloatArray:
    """Tips as they stood to the target, drawn about the target at rest [m], shape (n, 3).

    Breathing moves rings and target while the attempt runs; a track is one picture, so what moves
    in it is the needle, by the turn that brings the path of each moment to the planned one.
    """
    path = path_to(placed, samples.target)
    if np.array_equal(path, np.broadcast_to(placed.axis, path.shape)):
        return samples.tip
    across, remaining = split(samples.tip - samples.target, path)
    cosine = np.sum(path * placed.axis, axis=-1, keepdims=True)
    cross = np.cross(path, placed.axis)
    turned = (
        across
        + np.cross(cross, across)
        + np.cross(cross, np.cross(cross, across)) / (1.0 + np.maximum(cosine, -0.9))
    )
    result: FloatArray = placed.p_target + turned - remaining[:, None] * placed.axis
    return read_only(result)
