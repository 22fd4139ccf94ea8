"""Smoothness of a speed profile: spectral arc length and log dimensionless jerk.

As published: Balasubramanian, Melendez-Calderon, Roby-Brami and Burdet, "On the analysis of
movement smoothness", J. NeuroEng. Rehabil. 12:112 (2015), with the parameters of its programs. The
mean of the speed is not removed. Nearer to zero is smoother.
"""

import numpy as np

from app.core.arrays import FloatArray
from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Trajectory

RATE = 50.0
"""Speeds of an attempt are sampled evenly at this rate [Hz]."""

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


def spectral_arc_length(speed: FloatArray, rate: float) -> float:
    """Return SPARC of a speed profile, negative.

    Args:
        speed: evenly sampled, not all zero, shape (n,).
        rate: samples a second [Hz].
    """
    length = int(2 ** (np.ceil(np.log2(len(speed))) + PADDING))
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

    Only samples with a measured depth count; between them the tip goes straight on. Positions are
    smoothed over `SMOOTHING` first: jerk is a third derivative, and would be that of the tracking.

    Raises:
        MetricUnavailableError: if the insertion is too short or too long, or the tip stood still.
    """
    last = trajectory.measured_stays()[-1]
    time = trajectory.time[last]
    if not SHORTEST <= time[-1] - time[0] <= LONGEST:
        raise MetricUnavailableError(
            f"the insertion was measured for {time[-1] - time[0]:.2f} s; smoothness needs "
            f"{SHORTEST:g} to {LONGEST:g} s"
        )
    at = np.arange(time[0], time[-1], 1.0 / RATE)
    reach = round(4.0 * SMOOTHING * RATE)
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / (SMOOTHING * RATE)) ** 2)
    kernel /= kernel.sum()
    tip = np.column_stack(
        [
            np.convolve(np.pad(np.interp(at, time, one), reach, mode="edge"), kernel, mode="valid")
            for one in trajectory.tip[last].T
        ]
    )
    speed: FloatArray = np.linalg.norm(np.diff(tip, axis=0), axis=1) * RATE
    if float(np.ptp(speed)) <= 1e-9:
        raise MetricUnavailableError("the tip's speed never changed: it has no smoothness")
    return speed
