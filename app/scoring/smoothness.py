"""Smoothness of a speed profile: spectral arc length and log dimensionless jerk.

As published: Balasubramanian, Melendez-Calderon, Roby-Brami and Burdet, "On the analysis of
movement smoothness", J. NeuroEng. Rehabil. 12:112 (2015), with the parameters of its programs. The
mean of the speed is not removed. Nearer to zero is smoother.
"""

from functools import lru_cache

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import picture_errors

RATE = 50.0
"""Speeds of an attempt are sampled evenly at this rate [Hz]; `acus study scoring_rate`."""

SMOOTHING = 0.1
"""Standard deviation of the Gaussian that positions are smoothed with first [s]."""

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
    a measured depth count; between them the tip goes straight on. Positions are
    smoothed over `SMOOTHING` first: jerk is a third derivative, and would be that of the tracking.

    Raises:
        MetricUnavailableError: if the insertion is too short or too long, or the tip stood still.
    """
    last = trajectory.longest_part(trajectory.measured_stays()[-1])
    time = trajectory.time[last]
    if not SHORTEST <= time[-1] - time[0] <= LONGEST:
        raise MetricUnavailableError(
            sentence(
                "the insertion was measured for {time_last:.2f} s; smoothness needs "
                "{shortest:g} to {longest:g} s",
                time_last=time[-1] - time[0],
                shortest=SHORTEST,
                longest=LONGEST,
            )
        )
    speed = even_speed(time, trajectory.tip[last])
    if float(np.ptp(speed)) <= 1e-9:
        raise MetricUnavailableError(
            sentence("the tip's speed never changed: it has no smoothness")
        )
    return speed


@lru_cache(maxsize=1)  # both measures ask, one after the other
def repeated_speeds(trajectory: Trajectory) -> tuple[FloatArray, ...]:
    """Return speeds as `insertion_speed` would give them, had it been measured again.

    A parametric bootstrap: both measures bend too much in noise for a first order. The errors of
    the pictures (`scoring.uncertainty`) are drawn anew, always the same ones, `REPEATS` times.

    Raises:
        MetricUnavailableError: if it was not recorded how well the tip was known.
    """
    last = trajectory.longest_part(trajectory.measured_stays()[-1])
    errors = picture_errors(trajectory, last, np.random.default_rng(SEED))
    time, tip = trajectory.time[last], trajectory.tip[last]
    return tuple(even_speed(time, tip + next(errors)) for _ in range(REPEATS))


def even_speed(time: FloatArray, points: FloatArray, rate: float = RATE) -> FloatArray:
    """Speed along sampled points [m/s], smoothed and evenly sampled at a rate [Hz], shape (n,)."""
    at = np.arange(time[0], time[-1], 1.0 / rate)
    reach = round(4.0 * SMOOTHING * rate)
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / (SMOOTHING * rate)) ** 2)
    kernel /= kernel.sum()
    smooth = np.column_stack(
        [
            np.convolve(np.pad(np.interp(at, time, one), reach, mode="edge"), kernel, mode="valid")
            for one in points.T
        ]
    )
    result: FloatArray = np.linalg.norm(np.diff(smooth, axis=0), axis=1) * rate
    return result
