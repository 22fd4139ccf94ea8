"""What is not known of an attempt, carried on to its metrics: one standard deviation of each.

Known is, from the record, what the cameras' fixes leave unsure of the tip: σₐ along the needle and
σ꜀ for each direction across it, and the age τ of the picture that each was read from. A depth is
that of its picture; since then the needle has gone on with its speed v, so that along the needle
(σₐ² + (vτ)²) counts. All samples of one picture share its error; errors of two pictures are
independent. What was left by the check of the registration, σ₉, is the same for all samples: it
moves the whole path and no length. The needle's direction comes from the encoders.

A metric m of positions p has, to first order, the variance Σ gᵀ C g with g = ∂m/∂p summed over the
samples of one picture. Where g is not worked out an upper bound is told, and says so.

Not known, and allowed for nowhere: what the estimate of forces leaves, a wrong model of the tissue,
and a calibration of the cameras that nobody has checked.
"""

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.units import DEGREE
from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Trajectory
from app.tracking.fix import DIRECTION_SIGMA

RADIUS_95: Final = 2.7955
"""Radius of the sphere that holds 95 % of a normal error of one standard deviation per axis."""

SPEED_OVER: Final = 0.2
"""The needle's speed is taken over this time before a sample [s]."""

EDGE: Final = 12.0**-0.5
"""Standard deviation of a moment that lies somewhere between two samples, in their distance."""


def agreement_sd(trajectory: Trajectory) -> float:
    """Return σ₉, what the check of the registration leaves per axis [m]; 0 without one."""
    return trajectory.agreement / RADIUS_95


def tip_covariance(trajectory: Trajectory, index: int) -> FloatArray:
    """Return the covariance of the tip at a sample [m²], shape (3, 3).

    Raises:
        MetricUnavailableError: if it was not recorded.
    """
    along, across, age = _spread(trajectory)[index]
    if not np.isfinite(along):
        raise MetricUnavailableError(sentence("how well the tip was known there was not recorded"))
    axis = trajectory.axis[index]
    own = np.outer(axis, axis)
    lag = _speed(trajectory, index) * age
    cross = across**2 + agreement_sd(trajectory) ** 2
    deep = along**2 + lag**2 + agreement_sd(trajectory) ** 2
    result: FloatArray = deep * own + cross * (np.eye(3) - own)
    return result


def tip_sd(trajectory: Trajectory, index: int, direction: FloatArray | None = None) -> float:
    """Return the standard deviation of the tip at a sample along a `direction` [m].

    Args:
        trajectory: the attempt.
        index: of the sample.
        direction: need not have length 1; without one, or with none to speak of, the largest of
            all directions.

    Raises:
        MetricUnavailableError: if it was not recorded.
    """
    covariance = tip_covariance(trajectory, index)
    length = 0.0 if direction is None else float(np.linalg.norm(direction))
    if direction is None or length < 1e-12:
        return float(np.sqrt(np.linalg.eigvalsh(covariance)[-1]))
    unit = direction / length
    return float(np.sqrt(unit @ covariance @ unit))


def axis_sd(trajectory: Trajectory) -> float:
    """Return the standard deviation of the needle's direction [°], in each plane that holds it.

    One count of the encoders, and σ₉ over the length of the planned path.
    """
    turned = agreement_sd(trajectory) / trajectory.placed.length
    return float(np.hypot(DIRECTION_SIGMA, turned)) / DEGREE


def time_sd(trajectory: Trajectory, mask: NDArray[np.bool_]) -> float:
    """Return the standard deviation of the time in `mask` [s]: each of its ends by a sample's time.

    An end lies somewhere between two samples Δ apart: Δ/√12. The record's own ends are known.
    """
    ends = np.flatnonzero(np.diff(mask.astype(np.int8)))
    return EDGE * float(np.linalg.norm(np.diff(trajectory.time)[ends]))


def path_sd(
    trajectory: Trajectory, samples: Sequence[NDArray[np.intp]], slopes: Sequence[FloatArray]
) -> float:
    """Return the standard deviation of what depends on the tip with the given slopes.

    Args:
        trajectory: the attempt.
        samples: indices, one array for each stretch.
        slopes: of the metric at each of them, in its unit per metre, shapes (n, 3).

    Raises:
        MetricUnavailableError: if it was not recorded how well the tip was known.
    """
    variance = 0.0
    for part, slope in zip(samples, slopes, strict=True):
        sigmas = _known(trajectory, part)
        first = _pictures(trajectory, part)
        deep = np.einsum("ij,ij->i", slope, trajectory.axis[part])
        across = slope - deep[:, None] * trajectory.axis[part]
        deep = np.add.reduceat(deep, first)
        across = np.add.reduceat(across, first, axis=0)
        along, cross = sigmas[first, 0], sigmas[first, 1]
        variance += float(((deep * along) ** 2).sum())
        variance += float((cross**2 * np.einsum("ij,ij->i", across, across)).sum())
    return float(np.sqrt(variance))


def picture_errors(
    trajectory: Trajectory, samples: NDArray[np.intp], rng: np.random.Generator
) -> Iterator[FloatArray]:
    """Yield errors of the tip at some samples, drawn anew each time [m], shape (n, 3); no end.

    Raises:
        MetricUnavailableError: if it was not recorded how well the tip was known.
    """
    sigmas = _known(trajectory, samples)
    first = _pictures(trajectory, samples)
    counts = np.diff(first, append=len(samples))
    axis = trajectory.axis[samples]
    while True:
        deep = rng.normal(0.0, sigmas[first, 0]).repeat(counts)
        aside = (rng.normal(size=(len(first), 3)) * sigmas[first, 1, None]).repeat(counts, axis=0)
        yield aside + (deep - np.einsum("ij,ij->i", aside, axis))[:, None] * axis


def largest_sd(trajectory: Trajectory, samples: NDArray[np.intp]) -> float:
    """Return the largest standard deviation of the tip over some samples, in any direction [m].

    A distance between paths changes by no more than the path does where it is decided, so this is
    an upper bound of its standard deviation, to first order. The lag is no part of it: a path does
    not change with when it was gone.

    Raises:
        MetricUnavailableError: if it was not recorded.
    """
    largest = _known(trajectory, samples)[:, :2].max()
    return float(np.hypot(largest, agreement_sd(trajectory)))


def _spread(trajectory: Trajectory) -> FloatArray:
    if trajectory.spread is None:
        raise MetricUnavailableError(sentence("how well the tip was known was not recorded"))
    return trajectory.spread


def _known(trajectory: Trajectory, samples: NDArray[np.intp]) -> FloatArray:
    """Return the spread at some samples, at all of them."""
    sigmas = _spread(trajectory)[samples]
    if not np.isfinite(sigmas).all():
        raise MetricUnavailableError(
            sentence("how well the tip was known was not recorded throughout")
        )
    return sigmas


def _speed(trajectory: Trajectory, index: int) -> float:
    """Speed along the needle before a sample [m/s]; 0 for the first."""
    now = trajectory.time[index]
    start = int(np.searchsorted(trajectory.time, now - SPEED_OVER))
    span = float(now - trajectory.time[start])
    if span <= 0.0:
        return 0.0
    return abs(float(trajectory.depth[index] - trajectory.depth[start])) / span


def _pictures(trajectory: Trajectory, samples: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return where among `samples` each picture begins, by the moment that it was taken."""
    taken = trajectory.time[samples] - _spread(trajectory)[samples, 2]
    changed = np.abs(np.diff(taken, prepend=-np.inf)) > 1e-4
    return np.flatnonzero(changed)
