"""Whether the robot's direction follows the needle that the cameras see turn.

The needle's line goes through the fulcrum, so a band beyond it says the direction c by itself, and
the encoders say another, a. Over some seconds both sweep; about their means a = M c. For encoders
that count M is the unit matrix, however a camera was moved or a needle bent. An encoder that stands
still leaves only one direction in which the robot can move: an eigenvalue of M is 0. One that
counts backwards mirrors one: it is -1. Where the needle was swept along one line only, the answer
to that line says which.
"""

from enum import StrEnum
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, unit

LEAST_DEPTH: Final = 0.03
"""Depth of the band beyond the fulcrum [m] below which it says no direction."""

SWEEP: Final = np.radians(2.5)
"""Standard deviation of the cameras' direction [rad] from which an answer to it is looked for."""

AWAY: Final = 0.5
"""An answer that is further from what was asked, of 1, is none of an encoder that counts."""

NEAR: Final = 0.35
"""Distance from 0, or from -1, within which an eigenvalue is that."""

EXPLAINED: Final = 0.25
"""Share of the robot's own sweep that may remain unexplained."""


class Following(StrEnum):
    """How the robot's direction follows the cameras'."""

    UNKNOWN = "unknown"  # the needle was not turned enough, or nothing explains it
    FOLLOWS = "follows"
    STANDS_STILL = "stands_still"  # an encoder does not count
    BACKWARDS = "backwards"  # an encoder counts the wrong way


def following(axes: FloatArray, depths: FloatArray, beside: FloatArray) -> Following:
    """Return how the robot's directions follow the cameras'.

    Args:
        axes: needle's directions by the robot, hub to tip, shape (n, 3).
        depths: of the band beyond the fulcrum along them [m], shape (n,).
        beside: from the robot's lines to the band [m], shape (n, 3).
    """
    rows = depths > LEAST_DEPTH
    if int(rows.sum()) < 3:
        return Following.UNKNOWN
    seen = depths[rows, None] * axes[rows] + beside[rows]
    seen = seen / np.linalg.norm(seen, axis=1, keepdims=True)
    basis = _across(unit(seen.mean(axis=0)))
    c, a = ((d - d.mean(axis=0)) @ basis for d in (seen, axes[rows]))
    sweeps, ways = np.linalg.eigh(c.T @ c / len(c))
    used = np.sqrt(np.maximum(sweeps, 0.0)) >= SWEEP
    if not used.any():
        return Following.UNKNOWN
    asked = c @ ways[:, used]
    answers = np.linalg.lstsq(asked, a, rcond=None)[0]  # a row for each way
    left = float(np.sum((a - asked @ answers) ** 2))
    if left > EXPLAINED * max(float(np.sum(a**2)), len(a) * SWEEP**2):
        return Following.UNKNOWN
    if np.linalg.norm(answers - ways[:, used].T, axis=1).max() < AWAY:
        return Following.FOLLOWS
    return _named(answers @ ways[:, used])


def _named(matrix: FloatArray) -> Following:
    """Say what a matrix M of answers, on the ways that were used, is of."""
    values = np.linalg.eigvals(matrix).real
    if np.abs(values + 1.0).min() < NEAR:
        return Following.BACKWARDS
    if np.abs(values).min() < NEAR or len(values) == 1:
        return Following.STANDS_STILL
    return Following.UNKNOWN


def _across(axis: FloatArray) -> FloatArray:
    """Two unit vectors across a unit vector, shape (3, 2)."""
    first = np.eye(3)[int(np.argmin(np.abs(axis)))]
    first = unit(first - (first @ axis) * axis)
    return np.column_stack([first, np.cross(axis, first)])
