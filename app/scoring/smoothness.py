"""Smoothness of a speed profile: spectral arc length and log dimensionless jerk.

As published: Balasubramanian, Melendez-Calderon, Roby-Brami and Burdet, "On the analysis of
movement smoothness", J. NeuroEng. Rehabil. 12:112 (2015), with the parameters of its programs. The
mean of the speed is not removed. Nearer to zero is smoother.
"""

from collections.abc import Callable
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import first_of_pictures, picture_errors

RATE = 50.0
"""Speeds of an attempt are sampled evenly at this rate [Hz]; `acus study scoring_rate`."""

SMOOTHING = 0.1
"""Standard deviation of the Gaussian that positions are smoothed with before their jerk is taken,
which is a third derivative [s]; with more nobody could tell 16 stops in 8 s from 8."""

FINEST = 1.0 / 30.0
"""Shortest Gaussian for the spectral arc [s], one picture of the cameras: movements of up to 7 Hz,
of which hands consist (Celik 2009), keep a third of their power and more."""

NOISE = 0.1
"""Largest share that the noise of the smoothed speed may have in its mean: 1, 2, 4, 8 and 16 stops
stay 3 standard deviations apart (`tests/scoring/test_scoring_smoothness.py`)."""

WHITE = 4.0 * np.pi**0.5
"""White noise σ of positions every Δ, behind a Gaussian of s: variance of speed σ²Δ/(WHITE s³)."""

SHORTEST = 1.0
"""Shorter insertions have no smoothness [s]."""

LONGEST = 3600.0
"""Nor have longer ones [s]: somebody left the needle where it was."""

CUTOFF = 10.0
"""Highest frequency of the spectrum that counts [Hz]."""

AMPLITUDE = 0.05
"""The spectrum ends where it stays below this share of its largest value."""

PADDING = 4
"""Powers of two by which the profile is lengthened with zeros."""

COARSE = 2
"""The same where only the spread of several arcs is looked for: a quarter of the work."""

REPEATS = 12
"""An insertion is measured again so many times; its deviation is then good to 20 %."""

SEED = 1
"""Of the errors of these."""


def spectral_arc_length(speed: FloatArray, rate: float, padding: int = PADDING) -> float:
    """Return SPARC of a speed profile, negative.

    Args:
        speed: evenly sampled, not all zero, shape (n,).
        rate: samples a second [Hz].
        padding: powers of two by which it is lengthened with zeros.
    """
    length = int(2 ** (np.ceil(np.log2(len(speed))) + padding))
    spectrum = np.abs(np.fft.rfft(speed, length))
    spectrum /= spectrum.max()
    frequency = np.arange(len(spectrum)) * rate / length
    kept = frequency <= CUTOFF
    spectrum, frequency = spectrum[kept], frequency[kept]
    loud = np.flatnonzero(spectrum >= AMPLITUDE)
    part = slice(int(loud[0]), int(loud[-1]) + 1)
    spectrum, frequency = spectrum[part], frequency[part]
    if len(frequency) < 2:
        return 0.0
    steps = np.diff(frequency) / (frequency[-1] - frequency[0])
    return -float(np.hypot(steps, np.diff(spectrum)).sum())


def log_dimensionless_jerk(speed: FloatArray, rate: float) -> float:
    """Return LDLJ = -ln(T³/v² ∫|d²v/dt²|² dt) of a speed profile; T its duration, v its peak.

    Args:
        speed: evenly sampled, at least three samples that are on no straight line, shape (n,).
        rate: samples a second [Hz].
    """
    duration = len(speed) / rate
    bends = np.diff(speed, 2) * rate**2
    jerk = duration**3 / float(np.max(speed)) ** 2 * float((bends**2).sum()) / rate
    return -float(np.log(jerk))


def insertion_speed(trajectory: Trajectory) -> FloatArray:
    """Speed of the tip in the last insertion [m/s], `RATE` times a second, shape (n,).

    A pause has no pace: of an insertion that one broke, the longest part counts. Only samples with
    a measured depth count; between them the tip goes straight on. Positions are smoothed over
    `SMOOTHING` first: jerk is a third derivative, and would be that of the tracking.

    Raises:
        MetricUnavailableError: if the insertion is too short or too long, or the tip stood still.
    """
    last = _insertion(trajectory)
    return _changing(even_speed(trajectory.time[last], trajectory.tip[last], smoothing=SMOOTHING))


def picture_speed(trajectory: Trajectory) -> FloatArray:
    """Speed as `insertion_speed`, by one position of each picture, smoothed by `gaussian_for`.

    A depth is that of its picture until the next one: by all samples the speed would jump with the
    pictures, 30 times a second.

    Raises:
        MetricUnavailableError: as `insertion_speed` does.
    """
    last = _insertion(trajectory)
    time, first = _taken(trajectory, last)
    tip = trajectory.tip[last][first]
    return _changing(even_speed(time, tip, smoothing=_smoothing(trajectory, last)))


@lru_cache(maxsize=1)  # both measures ask, one after the other
def repeated_speeds(trajectory: Trajectory) -> tuple[FloatArray, ...]:
    """Return speeds as `insertion_speed` would give them, had it been measured again.

    A parametric bootstrap: both measures bend too much in noise for a first order. The errors of
    the pictures (`scoring.uncertainty`) are drawn anew, always the same ones, `REPEATS` times.

    Raises:
        MetricUnavailableError: if it was not recorded how well the tip was known.
    """
    time = trajectory.time[_insertion(trajectory)]
    return _repeated(trajectory, lambda tip: even_speed(time, tip, smoothing=SMOOTHING))


def repeated_picture_speeds(trajectory: Trajectory) -> tuple[FloatArray, ...]:
    """Return speeds as `picture_speed` would give them, had it been measured again.

    Raises:
        MetricUnavailableError: if it was not recorded how well the tip was known.
    """
    last = _insertion(trajectory)
    time, first = _taken(trajectory, last)
    width = _smoothing(trajectory, last)
    return _repeated(trajectory, lambda tip: even_speed(time, tip[first], smoothing=width))


def gaussian_for(sigma: float, interval: float, pace: float) -> float:
    """Return the shortest smoothing [s] that leaves `NOISE` of the pace in the speed.

    Args:
        sigma: standard deviation of a position [m].
        interval: between two of them [s].
        pace: mean speed of the insertion [m/s].
    """
    if not pace > 0.0:
        return SMOOTHING
    least = float(np.cbrt((sigma / (NOISE * pace)) ** 2 * interval / WHITE))
    return min(max(least, FINEST), SMOOTHING)


def even_speed(
    time: FloatArray, points: FloatArray, rate: float = RATE, smoothing: float = FINEST
) -> FloatArray:
    """Speed along sampled points [m/s], smoothed and evenly sampled at a rate [Hz], shape (n,)."""
    at = np.arange(time[0], time[-1], 1.0 / rate)
    reach = round(4.0 * smoothing * rate)
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / (smoothing * rate)) ** 2)
    kernel /= kernel.sum()
    smooth = np.column_stack(
        [
            np.convolve(np.pad(np.interp(at, time, one), reach, mode="edge"), kernel, mode="valid")
            for one in points.T
        ]
    )
    result: FloatArray = np.linalg.norm(np.diff(smooth, axis=0), axis=1) * rate
    return result


def _insertion(trajectory: Trajectory) -> NDArray[np.intp]:
    """Return the samples of the last insertion's longest part, in their order.

    Raises:
        MetricUnavailableError: if it is too short or too long.
    """
    last = trajectory.longest_part(trajectory.measured_stays()[-1])
    time = trajectory.time[last]
    if not SHORTEST <= time[-1] - time[0] <= LONGEST:
        raise MetricUnavailableError(
            sentence(
                "the insertion was measured for {duration_s:.2f} s; smoothness needs "
                "{shortest:g} to {longest:g} s",
                duration_s=time[-1] - time[0],
                shortest=SHORTEST,
                longest=LONGEST,
            )
        )
    return last


def _changing(speed: FloatArray) -> FloatArray:
    if float(np.ptp(speed)) <= 1e-9:
        raise MetricUnavailableError(
            sentence("the tip's speed never changed: it has no smoothness")
        )
    return speed


def _taken(trajectory: Trajectory, last: NDArray[np.intp]) -> tuple[FloatArray, NDArray[np.intp]]:
    """Return when the pictures were taken [s], rising, and the first of the samples by each.

    Where it is not known of all, every sample counts as a picture of its own.
    """
    time = trajectory.time[last]
    first = first_of_pictures(trajectory, last)
    if first is None or trajectory.spread is None:
        return time, np.arange(len(last))
    taken = time[first] - trajectory.spread[last[first], 2]
    rising = np.flatnonzero(np.diff(np.maximum.accumulate(taken), prepend=-np.inf) > 0.0)
    if taken[rising[-1]] - taken[rising[0]] < 1.0 / RATE:
        return time, np.arange(len(last))
    return taken[rising], first[rising]


def _smoothing(trajectory: Trajectory, last: NDArray[np.intp]) -> float:
    """Return what `gaussian_for` says of an insertion; the finest where its noise is not known."""
    time, first = _taken(trajectory, last)
    if trajectory.spread is None:
        return FINEST
    noise = trajectory.spread[last[first], :2]
    if not np.isfinite(noise).all():
        return FINEST
    ends = trajectory.depth[last[[0, -1]]]
    pace = abs(float(ends[1] - ends[0])) / float(time[-1] - time[0])
    interval = float(time[-1] - time[0]) / max(len(time) - 1, 1)
    return gaussian_for(float(np.sqrt((noise[:, 0] ** 2).mean())), interval, pace)


def _repeated(
    trajectory: Trajectory, speed: Callable[[FloatArray], FloatArray]
) -> tuple[FloatArray, ...]:
    last = _insertion(trajectory)
    errors = picture_errors(trajectory, last, np.random.default_rng(SEED))
    tip = trajectory.tip[last]
    return tuple(speed(tip + next(errors)) for _ in range(REPEATS))
