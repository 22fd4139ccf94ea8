"""Study: at which rate the needle's path is kept for score, curves and debrief.

What lies between two samples is drawn and measured as a straight line. Error: the farthest that the
true tip is from it, in strokes, with tremor, and while a let-go needle runs. Time: both measures of
an attempt's length and its smoothness, for one minute of it.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.scoring.paths import raw_length, smooth_length
from app.scoring.smoothness import even_speed, spectral_arc_length
from app.session.samples import SampleHistory
from app.studies.in_use import called
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION: Final[dict[str, Any]] = {
    "title": "Rate of the recorded path",
    "question": "How often must the needle's pose be kept?",
    "reference": "the motion itself, in closed form",
}

_RATES: Final = (10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
_SEEN_MM: Final = 0.1
_MINUTE: Final = 60.0  # [s]
_LET_GO: Final = 0.25  # [m/s]
_RISE: Final = 0.020  # [s]

Motion = Callable[[FloatArray], FloatArray]


def _strokes(t: FloatArray) -> FloatArray:
    """Minimum jerk, 20 mm in 0.8 s, and back, every 3 s."""
    phase = np.mod(t, 3.0)
    s = np.clip((phase - 0.3) / 0.8, 0.0, 1.0) - np.clip((phase - 1.7) / 0.8, 0.0, 1.0)
    return np.asarray(20.0 * MILLIMETRE * s**3 * (10.0 - 15.0 * s + 6.0 * s**2))


def _tremor(t: FloatArray) -> FloatArray:
    """2 mm/s with 0.2 mm at 9 Hz."""
    return np.asarray(2.0 * MILLIMETRE * t + 0.2 * MILLIMETRE * np.sin(2.0 * np.pi * 9.0 * t))


def _released(t: FloatArray) -> FloatArray:
    """Up to 0.25 m/s within 20 ms, 60 ms on, and to rest within 20 ms."""
    place = np.zeros_like(t)
    for start, slope in zip((0.3, 0.32, 0.38, 0.40), (1.0, -1.0, -1.0, 1.0), strict=True):
        place += 0.5 * slope * (_LET_GO / _RISE) * np.maximum(t - start, 0.0) ** 2
    return np.asarray(place)


MOTIONS: Final[dict[str, Motion]] = {
    "strokes": _strokes,
    "tremor": _tremor,
    "let go": _released,
}


def off(motion: Motion, rate: float, seconds: float = 3.0) -> float:
    """Farthest of the true place from the line between its samples [mm], any phase."""
    fine = np.arange(0.0, seconds, 1e-4)
    worst = 0.0
    for shift in np.linspace(0.0, 1.0 / rate, 7, endpoint=False):
        at = np.arange(shift, seconds, 1.0 / rate)
        inside = fine[(fine >= at[0]) & (fine <= at[-1])]
        worst = max(worst, float(np.abs(np.interp(inside, at, motion(at)) - motion(inside)).max()))
    return worst / MILLIMETRE


def _case(setting: Setting) -> Case:
    motion = MOTIONS[setting.name]
    return Case(motion, lambda rate: off(motion, rate), _SEEN_MM)


def _way(rate: float) -> Callable[[Case], Prepared]:
    def prepare(case: Case) -> Prepared:
        time = np.arange(0.0, _MINUTE, 1.0 / rate)
        place = case.data(time)
        tip = np.stack([0.1 * place, np.zeros_like(place), -place], axis=1)

        def run() -> float:
            raw_length(tip)
            smooth_length(time, tip)
            spectral_arc_length(even_speed(time, tip), 50.0)
            return rate

        return Prepared(run)

    return prepare


STUDY: Final = Study(
    error_label="farthest of the tip from its recorded path [mm]",
    ways=tuple(
        Way(f"{rate:g} Hz", "even rate", _way(rate), "lines between samples", 1.0 / rate)
        for rate in _RATES
    ),
    settings=tuple(Setting(name, {}) for name in MOTIONS),
    case=_case,
    deadline=Limit(0.1, "0.1 s after an attempt's end"),
    perception=Limit(_SEEN_MM, "0.1 mm on the screen"),
    default="100 Hz",
    because="cameras see the needle 30 times a second",
    exception=(
        "Only while a let-go needle takes up or loses its speed, within 20 ms, does the path bend "
        "so fast; what the robot did then is in the record's ticks, at 1 kHz."
    ),
    in_use=lambda: called(SampleHistory.add, "SAMPLE_PERIOD"),
)
