"""Study: at which rate the speed is sampled that smoothness is computed from.

Insertions recorded at 100 Hz: one smooth stroke, strokes with pauses, strokes with tremor. Error:
how far both measures of smoothness are from their values at 3200 Hz, as a share of their own
deviation in repeated measurements; differences below that are not scored.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.scoring import smoothness as arc
from app.scoring.smoothness import (
    SMOOTHING,
    even_speed,
    insertion_speed,
    log_dimensionless_jerk,
    spectral_arc_length,
)
from app.session.samples import SAMPLE_PERIOD
from app.studies.in_use import called, default_of
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION: Final[dict[str, Any]] = {
    "title": "Smoothness: rate of the sampled speed",
    "question": "At which rate must the speed be sampled that smoothness is scored by?",
    "reference": "the same measures of the motion itself at 3200 Hz, good to 0.001",
}

FINEST: Final = 3200.0  # [Hz]
_RATES: Final = (12.5, 25.0, 50.0, 100.0, 200.0, 400.0)
_NOISE: Final = 0.06 * MILLIMETRE
_REPEATS: Final = 24
_SECONDS: Final = 12.0

Motion = Callable[[FloatArray], FloatArray]
Measures = tuple[float, float]


def _stroke(t: FloatArray, start: float, length: float) -> FloatArray:
    """Minimum jerk from 0 to 1 (Flash and Hogan 1985)."""
    s = np.clip((t - start) / length, 0.0, 1.0)
    return np.asarray(s**3 * (10.0 - 15.0 * s + 6.0 * s**2))


MOTIONS: Final[dict[str, Motion]] = {
    "one stroke": lambda t: 60.0 * MILLIMETRE * _stroke(t, 0.5, 10.0),
    "strokes and pauses": lambda t: (
        15.0
        * MILLIMETRE
        * sum((_stroke(t, 0.5 + 3.0 * k, 1.2) for k in range(4)), np.zeros_like(t))
    ),
    "with tremor": lambda t: (
        60.0 * MILLIMETRE * _stroke(t, 0.5, 10.0)
        + 0.3
        * MILLIMETRE
        * np.sin(2.0 * np.pi * 4.0 * t)
        * (_stroke(t, 0.5, 2.0) - _stroke(t, 8.5, 2.0))
    ),
}
"""Depth of the tip [m] by time [s]."""


def points(motion: Motion, time: FloatArray) -> FloatArray:
    """Places of the tip [m], (n, 3)."""
    depth = motion(time)
    return np.stack([0.1 * depth, np.zeros_like(depth), -depth], axis=1)


def measures(time: FloatArray, tips: FloatArray, rate: float) -> Measures:
    """Spectral arc length and log dimensionless jerk of a path at a rate [Hz]."""
    speed, smooth = (even_speed(time, tips, rate, width) for width in (arc.FINEST, SMOOTHING))
    return spectral_arc_length(speed, rate), log_dimensionless_jerk(smooth, rate)


def _case(setting: Setting) -> Case:
    motion = MOTIONS[setting.name]
    fine, time = np.arange(0.0, _SECONDS, 1.0 / FINEST), np.arange(0.0, _SECONDS, SAMPLE_PERIOD)
    true, tips = np.array(measures(fine, points(motion, fine), FINEST)), points(motion, time)
    rng = np.random.default_rng(6)
    again = [
        measures(time, tips + rng.normal(0.0, _NOISE, tips.shape), 50.0) for _ in range(_REPEATS)
    ]
    deviation = np.std(again, axis=0, ddof=1)
    return Case(
        (time, tips),
        lambda found: float(np.max(np.abs(np.array(found) - true) / deviation)),
        1.0,
    )


def _way(rate: float) -> Callable[[Case], Prepared]:
    return lambda case: Prepared(lambda: measures(case.data[0], case.data[1], rate))


def _in_use() -> object:
    speed: Any = called(insertion_speed, "even_speed")
    return default_of(speed, "rate")


STUDY: Final = Study(
    error_label="error over the measures' own deviation [-]",
    ways=tuple(
        Way(f"{rate:g} Hz", "even rate", _way(rate), "both measures of 12 s", rate)
        for rate in _RATES
    ),
    settings=tuple(Setting(name, {}) for name in MOTIONS),
    case=_case,
    deadline=Limit(0.1, "0.1 s after an attempt's end"),
    perception=Limit(1.0, "1: their deviation in repeated measurements"),
    default="50 Hz",
    exception=(
        "With tremor the jerk would need 100 Hz. Another rate is another version of scoring, whose "
        "scores do not compare with those that are kept."
    ),
    in_use=_in_use,
)
