"""Study: which velocity estimator, by the error of the tool's speed over a hand's motions.

Rest with tremor on the edge between two counts, a slow sine of 5 mm, a correction of 10 mm, and a
let-go up to 0.25 m/s, read by the encoders of two devices at two rates.
"""

from typing import Any

from app.core import state_vector as sv
from app.core.compiled import STAGE_TYPE
from app.device.control.kernel import compiled

from numba import types  # isort: skip  (after core.compiled)
from collections.abc import Callable
from dataclasses import dataclass
from math import pi
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.core.parameters import Stage
from app.core.units import MILLIMETRE
from app.device.control.table import machine_stages
from app.device.control.velocity import (
    AdaptiveWindow,
    AlphaBeta,
    BackwardDifference,
    Kalman,
    VelocityFilter,
)
from app.device.links.link import Link
from app.mechanisms.pantograph import inverse, jacobian
from app.mechanisms.pantograph.profile import PantographProfile, load_pantograph
from app.studies.findings import Cell, Figure, Findings, Sheet
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION: Final[dict[str, Any]] = {
    "title": "Velocity from encoder angles",
    "question": "Which estimator of the joint velocities?",
    "reference": "the motion's own speed, in closed form",
}


_ROW = types.float64[::1]
_TABLE = types.Array(types.float64, 2, "C", readonly=True)


@compiled(
    types.void(
        STAGE_TYPE,
        _ROW,
        _ROW,
        types.Array(types.float64, 1, "C", readonly=True),
        _TABLE,
        types.float64[:, ::1],
        types.int64,
    )
)
def drive(
    function: Any,
    state: Any,
    parameters: Any,
    times: Any,
    readings: Any,
    rates: Any,
    rounds: int,
) -> None:
    """Step a velocity estimator through readings (n, 2) taken at `times` (n,); fill `rates`.

    Further `rounds` do the same again, to be timed: stamps that go back make it begin afresh.
    """
    for tick in range(rounds * len(times)):
        k = tick % len(times)
        state[sv.DT] = times[1] - times[0]
        state[sv.TIME], state[sv.Q_TIME] = times[k], times[k]
        state[sv.Q_LEFT], state[sv.Q_RIGHT] = readings[k, 0], readings[k, 1]
        function(state, parameters)
        rates[k, 0], rates[k, 1] = state[sv.QD_LEFT], state[sv.QD_RIGHT]


_PHYSIOLOGICAL: Final = 2.0 * np.pi * 9.0  # [rad/s] tremor of a resting hand
_TREMOR: Final = 5e-6  # [m]
_LET_GO: Final = 0.25  # [m/s] the fastest that the governor allows
_RISE: Final = 0.020  # [s]

Path = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
"""Times (n,) -> displacement [m] and speed [m/s] of the tool along its line, each (n,)."""


def _rest(t: FloatArray) -> tuple[FloatArray, FloatArray]:
    return _TREMOR * np.sin(_PHYSIOLOGICAL * t), _TREMOR * _PHYSIOLOGICAL * np.cos(
        _PHYSIOLOGICAL * t
    )


def _sine(t: FloatArray) -> tuple[FloatArray, FloatArray]:
    w = np.pi  # 0.5 Hz
    return 5e-3 * np.sin(w * t), 5e-3 * w * np.cos(w * t)


def _correction(t: FloatArray) -> tuple[FloatArray, FloatArray]:
    # Minimum jerk over 10 mm in 0.5 s, from 0.5 s on (Flash and Hogan 1985).
    s = np.clip((t - 0.5) / 0.5, 0.0, 1.0)
    return 10e-3 * s**3 * (10.0 - 15.0 * s + 6.0 * s**2), 10e-3 / 0.5 * 30.0 * (s * (1.0 - s)) ** 2


def _let_go(t: FloatArray) -> tuple[FloatArray, FloatArray]:
    # Up to 0.25 m/s within 20 ms, 60 ms on, and down again within 20 ms.
    knots = np.array([0.5, 0.5 + _RISE, 0.58 + _RISE, 0.58 + 2.0 * _RISE])
    speed = np.interp(t, knots, [0.0, _LET_GO, _LET_GO, 0.0])
    place = np.zeros_like(t)
    for start, slope in zip(knots, np.array([1.0, -1.0, -1.0, 1.0]) * _LET_GO / _RISE, strict=True):
        place += 0.5 * slope * np.maximum(t - start, 0.0) ** 2
    return place, speed


MOTIONS: Final[dict[str, tuple[float, Path]]] = {
    "rest on an edge": (1.0, _rest),
    "slow sine": (2.0, _sine),
    "correction": (1.5, _correction),
    "let go": (0.8, _let_go),
}
"""Duration [s] and path of each motion."""


@dataclass(frozen=True, slots=True)
class HandMotion:
    """A motion sampled at a loop's rate.

    Attributes:
        times: of the ticks [s], shape (n,).
        readings: joint angles as encoders give them [rad], (n, 2).
        rates: true joint velocities [rad/s], (n, 2).
        speed: true speed of the tool along its line [m/s], (n,).
        lever: dP3/dq along that line [m/rad], (n, 2).
    """

    times: FloatArray
    readings: FloatArray
    rates: FloatArray
    speed: FloatArray
    lever: FloatArray


def motion(name: str, profile: PantographProfile, rate_hz: float) -> HandMotion:
    """Sample a motion of `MOTIONS` on a device: along x through a point where its joints change
    counts, 10 mm off the middle of the workspace.
    """
    duration, path = MOTIONS[name]
    times = np.arange(1, round(duration * rate_hz) + 1) / rate_hz
    place, speed = path(times)
    geometry, count = profile.pantograph, 2.0 * np.pi / profile.encoder.counts_per_turn
    home = np.array(profile.encoder.home_offsets)
    middle = geometry.fulcrum[:2] + np.array([0.0, 10.0 * MILLIMETRE])
    p3 = middle + np.outer(place, [1.0, 0.0])
    q = np.array([inverse(geometry, point) for point in p3])
    maps = np.array([jacobian(geometry, row) for row in q])
    rates = np.linalg.solve(maps, np.outer(speed, [1.0, 0.0])[:, :, None])[:, :, 0]
    # Shift the encoders' zero so that the middle lies on the edge between two counts.
    zero = home + count * (((inverse(geometry, middle) - home) / count - 0.5) % 1.0)
    readings = zero + np.floor((q - zero) / count + 0.5) * count
    return HandMotion(
        frozen(times), frozen(readings), frozen(rates), frozen(speed), frozen(maps[:, 0])
    )


_DEVICES: Final = ("icube", "haply-2diy")
_RATES: Final = (500.0, 1000.0)
_FELT: Final = 10.0  # [mm/s]
_SHARE: Final = 0.1  # of the top speed
_TIMED: Final = 20_000  # ticks at least, so that the call itself does not count

Maker = Callable[[float], Stage]
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
    profile = load_pantograph(device)
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

    return Way(name, _MAKERS[name][0], prepare, used=_what(_MAKERS[name][1](_count())))


def _count() -> float:
    """One encoder count of the device that the program has without a choice [rad]."""
    return 2.0 * pi / load_pantograph(_DEVICES[0]).encoder.counts_per_turn


def _what(stage: Stage) -> object:
    """Tell what a stage calls and what it is set to."""
    return stage.function, tuple(stage.parameters.tolist())


def _in_use() -> object:
    table = machine_stages(load_pantograph(_DEVICES[0]), [], [], Link.of([], []))
    return next(_what(stage) for stage in table if stage.name == "velocity")


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
    profile = load_pantograph("icube")
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
    default="window 20",
    because="the least error in the geometric mean over all motions",
    exception=(
        "Its window is long at rest and short in quick movement, so that it is calm and follows a "
        "let-go within 2.4 ms; a filter is either. The price is a share of 0.0002 of the 1 ms tick."
    ),
    in_use=_in_use,
    findings=_findings,
)
