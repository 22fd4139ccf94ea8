"""Study: which sampled spring-dampers the free device can hold without oscillating.

K and B are those at the tool point P3, needle vertical, no hand: the hardest case, since a hand
adds damping. The whole simulated device runs through the loop's own stages on a virtual clock; a
reduction to one direction is solved exactly beside it, with the bound of Colgate and Schenkel and
its form for delay.
"""

from functools import partial
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.progress import Progress
from app.core.units import MILLIMETRE
from app.mechanisms.profile import DeviceProfile, load_profile
from app.studies.findings import Cell, Figure, Findings, Sheet, Survey
from app.studies.rendering.device import (
    DEPTH,
    DURATION,
    LASTING,
    OFFSET,
    QUIET_COUNTS,
    WIDER,
    Device,
)
from app.studies.rendering.reduction import reductions
from app.studies.rendering.sweep import (
    LOOP,
    estimators_sheet,
    highest,
    limits_sheet,
    maps,
    protected_sheet,
    regions,
)

DECLARATION: Final[dict[str, Any]] = {
    "title": "Stable (K, B) of the free device over rate and delay",
    "question": "How stiff a spring can the device render before it oscillates by itself?",
    "reference": (
        "reduction to one direction, solved exactly; Colgate-Schenkel bound and delay form"
    ),
}

_DEVICE: Final = "icube"
_EXAMPLES: Final = ((300.0, 1.0), (3000.0, 1.0))  # K, B: on both sides of the limit


def _measure(progress: Progress | None) -> Findings:
    profile = load_profile(_DEVICE)
    found = regions(profile, progress)
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
            Figure("regions", partial(maps, found=found), (11.0, 9.0)),
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


def _reduction_sheet(profile: DeviceProfile) -> Sheet:
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
)
