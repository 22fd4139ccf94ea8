"""Study: which sampled spring-dampers the free device can hold without oscillating.

K and B are those at the tool point P3, needle vertical, no hand: the hardest case, since a hand
adds damping. The whole simulated device runs through the loop's own stages on a virtual clock; a
reduction to one direction is solved exactly beside it, with the bound of Colgate and Schenkel and
its form for delay.
"""

from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.progress import Progress
from app.core.units import MILLIMETRE
from app.device.control.velocity import VelocityMethod
from app.mechanisms.pantograph.profile import PantographProfile, load_pantograph
from app.studies.findings import Cell, Figure, Findings, Sheet, Survey
from app.studies.rendered_stiffness import (
    DEPTH,
    DURATION,
    LASTING,
    OFFSET,
    QUIET_COUNTS,
    WIDER,
    Device,
    Reduction,
    colgate,
    delayed,
    reductions,
    spectral_radius,
)

DECLARATION: Final[dict[str, Any]] = {
    "title": "Stable (K, B) of the free device over rate and delay",
    "question": "How stiff a spring can the device render before it oscillates by itself?",
    "reference": (
        "reduction to one direction, solved exactly; Colgate-Schenkel bound and delay form"
    ),
}


RATES: Final = (500.0, 1000.0, 2000.0)
DELAYS: Final = (0, 1, 2)
STIFFNESS: Final = np.geomspace(50.0, 10_000.0, 16)  # [N/m] at P3
DAMPING: Final = np.array([0.0, 0.1, 0.3, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0])  # [N·s/m] at P3
LOOP: Final = (1000.0, 1)  # [Hz], ticks: the device as it is, with a wire in between
UNSTABLE: Final = (
    (1000.0, 1, 1500.0, 1.0),
    (1000.0, 1, 3000.0, 1.0),
    (1000.0, 1, 10_000.0, 0.0),
    (1000.0, 2, 3000.0, 1.0),
    (500.0, 2, 3000.0, 1.0),
)
"""Rate [Hz], delay, K and B that oscillate."""
_FINE: Final = np.geomspace(5.0, 100_000.0, 500)  # [N/m] for the reduction
_MOST_STEPS: Final = 8  # of a bisection: K to 2 %


@dataclass(frozen=True, slots=True, eq=False)
class StableRegion:
    """What is stable at one rate and delay.

    Attributes:
        rate_hz: of the loop.
        delay: ticks.
        stable: whole device as it is, (K, B) of `STIFFNESS` and `DAMPING`.
        smooth: largest stable K of the whole device without dry friction [N/m], per B.
        linear: the same for the reduction.
        passive: by Colgate and Schenkel.
        light: by the delay form.
    """

    rate_hz: float
    delay: int
    stable: FloatArray
    smooth: FloatArray
    linear: FloatArray
    passive: FloatArray
    light: FloatArray


def without_dry_friction(profile: PantographProfile) -> PantographProfile:
    """Return the same device without Coulomb friction: what the bounds are about."""
    friction = profile.friction.model_copy(update={"coulomb": 0.0})
    return profile.model_copy(update={"friction": friction})


def largest(device: Device, damping: float) -> float:
    """Largest stable K [N/m] at a damping [N·s/m], between the ends of `STIFFNESS`, by bisection.

    0 if the softest is unstable. The stable range is taken for one interval, as the map shows.
    """
    low, high = float(STIFFNESS[0]), float(STIFFNESS[-1])
    if not device.stable(low, damping):
        return 0.0
    if device.stable(high, damping):
        return high
    for _ in range(_MOST_STEPS):
        middle = float(np.sqrt(low * high))
        low, high = (middle, high) if device.stable(middle, damping) else (low, middle)
    return low


def linear_limit(models: tuple[Reduction, ...], damping: float, step: float, delay: int) -> float:
    """Largest K [N/m] below which the reduction is stable along every direction; 0 if none."""
    virtual = np.full(len(_FINE), damping)
    radius = np.max([spectral_radius(m, _FINE, virtual, step, delay) for m in models], axis=0)
    unstable = np.flatnonzero(radius >= 1.0)
    if len(unstable) == 0:
        return float(_FINE[-1])
    return float(_FINE[unstable[0] - 1]) if unstable[0] > 0 else 0.0


def region(profile: PantographProfile, rate_hz: float, delay: int) -> StableRegion:
    """Sweep one rate and delay."""
    step, models = 1.0 / rate_hz, reductions(profile, DEPTH)
    device = Device(profile, rate_hz, delay)
    smooth = replace(device, profile=without_dry_friction(profile))
    least = min(model.damping for model in models)
    return StableRegion(
        rate_hz,
        delay,
        np.array([[device.stable(k, b) for b in DAMPING] for k in STIFFNESS], dtype=np.float64),
        np.array([largest(smooth, b) for b in DAMPING]),
        np.array([linear_limit(models, b, step, delay) for b in DAMPING]),
        colgate(least, DAMPING, step),
        delayed(least, DAMPING, step, delay),
    )


def regions(
    profile: PantographProfile,
    progress: Progress | None,
    cases: tuple[tuple[float, int], ...] = (),
) -> tuple[StableRegion, ...]:
    """Sweep all rates and delays, or only some pairs of them."""
    found = []
    cases = cases or tuple((rate, delay) for rate in RATES for delay in DELAYS)
    for number, (rate, delay) in enumerate(cases):
        if progress is not None:
            progress.report(
                number / len(cases), sentence("{rate:g} Hz, {delay} ticks", rate=rate, delay=delay)
            )
        found.append(region(profile, rate, delay))
    return tuple(found)


def highest(stable: FloatArray) -> FloatArray:
    """Largest K of `STIFFNESS` below which every K is stable, per B; 0 if there is none."""
    below = np.cumprod(stable, axis=0).sum(axis=0).astype(int)
    return np.asarray(np.where(below > 0, STIFFNESS[np.maximum(below - 1, 0)], 0.0))


def limits_sheet(result: tuple[StableRegion, ...]) -> Sheet:
    """Largest stable K per rate, delay and B, by every account."""
    rows: list[tuple[Cell, ...]] = []
    for part in result:
        measured = highest(part.stable)
        for k, b in enumerate(DAMPING):
            rows.append(
                (
                    part.rate_hz,
                    part.delay,
                    float(b),
                    float(part.passive[k]),
                    float(part.light[k]),
                    float(part.linear[k]),
                    float(part.smooth[k]),
                    float(measured[k]),
                )
            )
    return Sheet(
        "limits",
        "Largest stable K [N/m] at the tool point, free device",
        (
            "rate [Hz]",
            "delay [ticks]",
            "B [N·s/m]",
            "Colgate",
            "delay form",
            "reduction",
            "device, no dry friction",
            "device",
        ),
        tuple(rows),
    )


def estimators_sheet(profile: PantographProfile) -> Sheet:
    """Largest stable K per velocity estimator, at `LOOP`, with and without dry friction."""
    rows: list[tuple[Cell, ...]] = []
    for method in VelocityMethod:
        cells: list[Cell] = [method.value]
        for kind in (without_dry_friction(profile), profile):
            device = Device(kind, *LOOP, method)
            cells += [largest(device, b) for b in (1.0, 5.0, 20.0)]
        rows.append(tuple(cells))
    headings = [f"B = {b:g}, {kind}" for kind in ("no dry friction", "device") for b in (1, 5, 20)]
    return Sheet(
        "estimators",
        f"Largest stable K [N/m] by velocity estimator, {LOOP[0]:g} Hz, {LOOP[1]} tick of delay",
        ("estimator", *headings),
        tuple(rows),
    )


def protected_sheet(profile: PantographProfile) -> Sheet:
    """Show what becomes of unstable pairs without and with what guards the device."""
    rows: list[tuple[Cell, ...]] = []
    for rate, delay, k, b in UNSTABLE:
        cells: list[Cell] = [rate, delay, k, b]
        for protected in (False, True):
            device = Device(without_dry_friction(profile), rate, delay, protected=protected)
            track = device.release(k, b)
            speed = np.linalg.norm(np.diff(track, axis=0), axis=1).max() * rate
            late = track[2 * len(track) // 3 :]
            cells += [float(np.ptp(late, axis=0).max()) / MILLIMETRE, float(speed)]
        rows.append(tuple(cells))
    return Sheet(
        "protected",
        "Unstable laws without dry friction: swing of the tool in the last third and top speed",
        (
            "rate [Hz]",
            "delay [ticks]",
            "K [N/m]",
            "B [N·s/m]",
            "law alone [mm]",
            "law alone [m/s]",
            "protected [mm]",
            "protected [m/s]",
        ),
        tuple(rows),
    )


def maps(figure: Any, result: tuple[StableRegion, ...]) -> None:
    """Draw the stable region of every rate (rows) and delay (columns) with the bounds."""
    shown = np.maximum(DAMPING, 0.05)  # B = 0 has no logarithm; it is drawn at the left edge
    for part in result:
        number = RATES.index(part.rate_hz) * len(DELAYS) + DELAYS.index(part.delay)
        axes = figure.add_subplot(len(RATES), len(DELAYS), number + 1)
        axes.set(xscale="log", yscale="log")
        b, k = np.meshgrid(shown, STIFFNESS)
        yes = part.stable > 0.5
        axes.plot(b[yes], k[yes], "s", color="#A6D8C8", markersize=7, label="device: stable")
        axes.plot(b[~yes], k[~yes], "x", color="#D55E00", markersize=4, label="device: oscillates")
        for values, style, colour, label in (
            (part.smooth, "-", "#0072B2", "device, no dry friction"),
            (part.linear, "--", "#222222", "reduction, one direction"),
            (part.light, ":", "#CC79A7", "K = (b + B)/(T/2 + t_d)"),
            (part.passive, "-.", "#E69F00", "Colgate: b = K T/2 + |B|"),
        ):
            drawn = np.where(values > 0.0, values, np.nan)
            axes.plot(shown, drawn, style, color=colour, linewidth=1.4, label=label)
        axes.set_ylim(20.0, 2e4)
        axes.set_title(f"{part.rate_hz:g} Hz, {part.delay} ticks of delay", fontsize=8)
        axes.tick_params(labelsize=7)
        if number // len(DELAYS) == len(RATES) - 1:
            axes.set_xlabel("B [N·s/m] (left edge: 0)", fontsize=8)
        if number % len(DELAYS) == 0:
            axes.set_ylabel("K [N/m] at P3", fontsize=8)
    handles, labels = figure.axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=6, fontsize=8)
    figure.tight_layout(rect=(0.0, 0.04, 1.0, 1.0))


_DEVICE: Final = "icube"
_EXAMPLES: Final = ((300.0, 1.0), (3000.0, 1.0))  # K, B: on both sides of the limit


def _quick(progress: Progress | None) -> Findings:
    return _measure(progress, ((RATES[0], DELAYS[0]), LOOP))


def _measure(progress: Progress | None, cases: tuple[tuple[float, int], ...] = ()) -> Findings:
    profile = load_pantograph(_DEVICE)
    found = regions(profile, progress, cases)
    tracks = {pair: Device(profile, *LOOP).release(*pair) for pair in _EXAMPLES}
    slowest, usual = found[0], next(r for r in found if (r.rate_hz, r.delay) == LOOP)
    return Findings(
        (
            _reduction_sheet(profile),
            limits_sheet(found),
            estimators_sheet(profile),
            protected_sheet(profile),
        ),
        (
            Figure("regions", partial(maps, result=found), (11.0, 9.0)),
            Figure("examples", partial(_draw_examples, tracks=tracks), (9.0, 3.6)),
        ),
        (
            f"Oscillates: let go {OFFSET / MILLIMETRE:g} mm along x and y beside its rest, the "
            f"tool swings wider than {WIDER:g} times its first swing within {DURATION:g} s, or "
            f"still over {QUIET_COUNTS:g} counts and {LASTING:g} times as wide in the last third "
            "as in the second.",
            f"At {usual.rate_hz:g} Hz with {usual.delay} tick of delay and B = 1 N·s/m the device "
            f"holds K up to {highest(usual.stable)[3]:.0f} N/m, without its dry friction "
            f"{usual.smooth[3]:.0f}; at {slowest.rate_hz:g} Hz without delay "
            f"{highest(slowest.stable)[3]:.0f} and {slowest.smooth[3]:.0f} N/m.",
            "Dry friction stops a small swing: what it adds shrinks with the swing's width.",
        ),
    )


def _reduction_sheet(profile: PantographProfile) -> Sheet:
    rows: list[tuple[Cell, ...]] = [
        (axis, model.mass, model.damping)
        for axis, model in zip("xy", reductions(profile, DEPTH), strict=True)
    ]
    return Sheet(
        "reduction",
        f"{_DEVICE} at the tool point, needle vertical, {DEPTH / MILLIMETRE:g} mm deep",
        ("along", "mass [kg]", "viscous damping [N·s/m]"),
        tuple(rows),
    )


def _draw_examples(figure: Any, tracks: dict[tuple[float, float], FloatArray]) -> None:
    for number, ((stiffness, damping), track) in enumerate(tracks.items()):
        axes = figure.add_subplot(1, 2, number + 1)
        times = np.arange(len(track)) / LOOP[0]
        axes.plot(times, (track - track.mean(axis=0)) / MILLIMETRE, linewidth=0.7)
        axes.set_title(f"K = {stiffness:g} N/m, B = {damping:g} N·s/m", fontsize=9)
        axes.set(xlabel="time [s]", ylabel="tool: x, y [mm]")
        axes.grid(True, color="#DDDDDD", linewidth=0.5)
    figure.suptitle(f"{_DEVICE}, {LOOP[0]:g} Hz, {LOOP[1]} tick of delay, no hand", fontsize=9)
    figure.tight_layout()


STUDY: Final = Survey(
    measure=_measure,
    quick=_quick,
)
