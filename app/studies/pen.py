"""Study: how well one webcam knows a pen with printed markers, and whether it says so honestly."""

from typing import Any, Final

import numpy as np

from app.core.progress import Progress
from app.core.units import DEGREE, MILLIMETRE
from app.studies.findings import Cell, Figure, Findings, Sheet, Survey
from app.studies.webcam.setups import SETUPS, Setup
from app.studies.webcam.trials import Outcome, rendered, trials
from app.tracking.confidence import chi_square_quantile

DECLARATION: Final[dict[str, Any]] = {
    "title": "A pen with printed markers before one webcam",
    "question": "How well is a needle known that is a pen before a webcam?",
    "reference": "rendered pictures with known truth; trials with everything declared drawn anew",
}

_LIMIT: Final = 0.95


def _inside(outcome: Outcome) -> float:
    """Share of the tips inside the 95 % ellipsoid [%]."""
    return 100.0 * float(np.mean(outcome.distance < chi_square_quantile(_LIMIT, 3)))


def _row(setup: Setup, found: Outcome) -> tuple[Cell, ...]:
    if not len(found.tip):
        return (setup.edge_mm, setup.distance, f"{setup.width}x{setup.height}", setup.noise,
                0.0, "-", "-", "-", "-", "-")  # fmt: skip
    return (
        setup.edge_mm,
        setup.distance,
        f"{setup.width}x{setup.height}",
        setup.noise,
        100.0 * found.share,
        float(np.sqrt(np.mean(found.tip**2))) / MILLIMETRE,
        float(np.percentile(found.tip, 95)) / MILLIMETRE,
        float(np.sqrt(np.mean(found.axis**2))) / DEGREE,
        float(np.percentile(found.axis, 95)) / DEGREE,
        _inside(found),
    )


def _measure(progress: Progress | None = None) -> Findings:
    watch = progress or Progress()
    rows, outcomes = [], []
    for number, setup in enumerate(SETUPS):
        watch.report(0.7 * number / len(SETUPS), f"cube of {setup.edge_mm:g} mm")
        outcomes.append(rendered(setup))
        rows.append(_row(setup, outcomes[-1]))
    watch.report(0.7, "trials")
    drawn = trials()
    sheet = Sheet(
        "workspace",
        "Error of the needle in rendered pictures, print and tip exact",
        ("edge [mm]", "distance [m]", "pictures", "noise [grey]", "found [%]", "tip RMS [mm]",
         "tip 95 % [mm]", "axis RMS [°]", "axis 95 % [°]", "in 95 % ellipsoid [%]"),
        tuple(rows),
    )  # fmt: skip
    lines = (
        f"With a print to 0.2 mm, a tip by the drawing (2 mm across, 5 mm along) and 0.05 px in "
        f"the corners: tip {np.sqrt(np.mean(drawn.tip**2)) / MILLIMETRE:.1f} mm RMS, axis "
        f"{np.sqrt(np.mean(drawn.axis**2)) / DEGREE:.1f}° RMS.",
        f"In {len(drawn.tip)} such trials the 95 % ellipsoid of the tip held the truth in "
        f"{_inside(drawn):.1f} %.",
    )
    return Findings((sheet,), (Figure("errors", lambda figure: _draw(figure, outcomes)),), lines)


def _draw(figure: Any, outcomes: list[Outcome]) -> None:
    axes = figure.add_subplot(1, 1, 1)
    names = [f"{s.edge_mm:g} mm, {s.distance:g} m,\n{s.width} px, {s.noise:g} grey" for s in SETUPS]
    axes.boxplot([outcome.tip / MILLIMETRE for outcome in outcomes], tick_labels=names)
    axes.set(ylabel="error of the tip [mm]")
    axes.tick_params(axis="x", labelsize=6, rotation=30)
    axes.grid(True, axis="y", color="#DDDDDD", linewidth=0.5)
    figure.tight_layout()


STUDY: Final = Survey(
    measure=_measure,
)
