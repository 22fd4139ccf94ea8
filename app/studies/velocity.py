"""Study: which velocity estimator, by the error of the tool's speed over a hand's motions.

Rest with tremor on the edge between two counts, a slow sine of 5 mm, a correction of 10 mm, and a
let-go up to 0.25 m/s, read by the encoders of two devices at two rates.
"""

from collections.abc import Callable
from math import pi
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.device.control.velocity import (
    AdaptiveWindow,
    AlphaBeta,
    BackwardDifference,
    Kalman,
    VelocityFilter,
)
from app.mechanisms.profile import load_profile
from app.studies.estimation.drive import drive
from app.studies.estimation.motions import MOTIONS, HandMotion, motion
from app.studies.findings import Cell, Figure, Findings, Sheet
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION: Final[dict[str, Any]] = {
    "title": "Velocity from encoder angles",
    "question": "Which estimator of the joint velocities?",
    "reference": "the motion's own speed, in closed form",
}

_DEVICES: Final = ("icube", "haply-2diy")
_RATES: Final = (500.0, 1000.0)
_FELT: Final = 10.0  # [mm/s]
_SHARE: Final = 0.1  # of the top speed
_TIMED: Final = 20_000  # ticks at least, so that the call itself does not count

Maker = Callable[[float], tuple[str, Any, FloatArray]]
"""One encoder count [rad] -> a fresh stage."""

_MAKERS: Final[dict[str, tuple[str, Maker]]] = {
    "difference": ("backward difference", lambda count: BackwardDifference().stage()),
    **{
        f"filter {cutoff:g} Hz": (
            "filtered",
            lambda count, cutoff=cutoff: VelocityFilter(cutoff).stage(),  # type: ignore[misc]
        )
        for cutoff in (20.0, 50.0, 100.0)
    },
    **{
        f"alpha-beta {constant:g} ms": (
            "alpha-beta",
            lambda count, constant=constant: AlphaBeta(constant * 1e-3).stage(),  # type: ignore[misc]
        )
        for constant in (2.5, 5.7, 12.0)
    },
    **{
        f"window {window}": (
            "FOAW",
            lambda count, window=window: AdaptiveWindow(count, window).stage(),  # type: ignore[misc]
        )
        for window in (8, 15, 20, 30)
    },
    **{
        f"kalman {density:g}": (
            "Kalman",
            lambda count, density=density: Kalman(count, density).stage(),  # type: ignore[misc]
        )
        for density in (0.01, 0.1, 1.0, 10.0)
    },
}
_SHOWN: Final = ("difference", "filter 50 Hz", "alpha-beta 2.5 ms", "window 20", "kalman 0.1")


def estimate(name: str, seen: HandMotion, count: float) -> FloatArray:
    """Run an estimator of this study over a motion; joint velocities [rad/s], (n, 2)."""
    _, function, memory = _MAKERS[name][1](count)
    rates = np.zeros_like(seen.readings)
    drive(function, sv.empty_state(), memory, seen.times, seen.readings, rates, 1)
    return rates


def speed_error(seen: HandMotion, rates: FloatArray) -> FloatArray:
    """Error of the tool's speed along its line [m/s], (n,)."""
    return np.asarray(((rates - seen.rates) * seen.lever).sum(axis=1))


def _case(setting: Setting) -> Case:
    device, name = setting.name.split(", ")[0], setting.name.split(", ")[2]
    profile = load_profile(device)
    seen = motion(name, profile, setting.values["rate_hz"])

    noticed = max(_FELT, _SHARE * float(np.abs(seen.speed).max()) / MILLIMETRE)
    return Case(
        (seen, 2.0 * pi / profile.encoder.counts_per_turn),
        lambda rates: _rms_mm(seen, rates) / noticed,
        1.0,
    )


def _way(name: str) -> Way:
    def prepare(case: Case) -> Prepared:
        seen, count = case.data
        _, function, memory = _MAKERS[name][1](count)
        state, rates = sv.empty_state(), np.zeros_like(seen.readings)
        rounds = -(-_TIMED // len(seen.times))

        def run() -> FloatArray:
            drive(function, state, memory, seen.times, seen.readings, rates, rounds)
            return rates

        return Prepared(run, rounds * len(seen.times))

    return Way(name, _MAKERS[name][0], prepare)


def lag(seen: HandMotion, rates: FloatArray) -> float:
    """Delay [s] of the true speed that fits the estimated one best, to 0.1 ms."""
    found = ((rates) * seen.lever).sum(axis=1)
    shifts = np.arange(0.0, 0.060, 1e-4)
    misfits = [
        float(np.mean((np.interp(seen.times - shift, seen.times, seen.speed) - found) ** 2))
        for shift in shifts
    ]
    return float(shifts[int(np.argmin(misfits))])


def _findings() -> Findings:
    profile = load_profile("icube")
    count = 2.0 * pi / profile.encoder.counts_per_turn
    seen = {(name, rate): motion(name, profile, rate) for name in MOTIONS for rate in _RATES}
    errors: list[tuple[Cell, ...]] = []
    lags: list[tuple[Cell, ...]] = []
    for name in _MAKERS:
        rates = {key: estimate(name, value, count) for key, value in seen.items()}
        errors.append((name, *(_rms_mm(value, rates[key]) for key, value in seen.items())))
        kinds = [(m, r) for m in ("correction", "let go") for r in _RATES]
        lags.append((name, *(1e3 * lag(seen[key], rates[key]) for key in kinds)))
    headings = tuple(f"{name}, {rate:g} Hz" for name, rate in seen)
    return Findings(
        (
            Sheet("errors", "icube: RMS error of the speed [mm/s]", ("way", *headings), (*errors,)),
            Sheet(
                "lag",
                "icube: lag [ms]",
                ("way", *(h for h in headings if h.startswith(("correction", "let go")))),
                (*lags,),
            ),
        ),
        (Figure("traces", lambda figure: _traces(figure, seen, count), (9.0, 6.5)),),
    )


def _rms_mm(seen: HandMotion, rates: FloatArray) -> float:
    return float(np.sqrt(np.mean(speed_error(seen, rates) ** 2))) / MILLIMETRE


def _traces(figure: Any, seen: dict[tuple[str, float], HandMotion], count: float) -> None:
    windows = {"slow sine": (1.4, 1.8), "let go": (0.48, 0.68)}
    for column, (name, (start, end)) in enumerate(windows.items()):
        part = seen[name, 1000.0]
        keep = (part.times >= start) & (part.times <= end)
        for row, way in enumerate(_SHOWN):
            axes = figure.add_subplot(len(_SHOWN), 2, 2 * row + column + 1)
            found = (estimate(way, part, count) * part.lever).sum(axis=1) / MILLIMETRE
            axes.plot(part.times[keep], found[keep], color="#0072B2", linewidth=0.9)
            true = part.speed[keep] / MILLIMETRE
            axes.plot(part.times[keep], true, color="#222222", linewidth=0.8, linestyle="--")
            axes.set_title(f"{way}: {name}", fontsize=7, pad=2)
            axes.tick_params(labelsize=6)
            axes.grid(True, color="#DDDDDD", linewidth=0.5)
    figure.suptitle("Speed of the tool [mm/s] over time [s], icube at 1 kHz; dashed: true", size=9)
    figure.tight_layout()


STUDY: Final = Study(
    error_label="RMS error of the tool's speed, as a share of what is noticed [-]",
    ways=tuple(_way(name) for name in _MAKERS),
    settings=tuple(
        Setting(f"{device}, {rate:g} Hz, {name}", {"rate_hz": rate})
        for device in _DEVICES
        for rate in _RATES
        for name in MOTIONS
    ),
    case=_case,
    deadline=Limit(1e-6, "1 µs: a third of the 3 µs that a whole tick may take"),
    perception=Limit(1.0, "1: 10 mm/s (0.1 N at 10 N·s/m), or 10 % of the top speed"),
    default=(
        "FOAW with a window of 20: least error at rest and in slow motion, and quick when the "
        "needle is let go"
    ),
    findings=_findings,
)
