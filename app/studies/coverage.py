"""Survey: do stated errors of calibration, relative pose, tip and registration hold?

The whole chain again and again: pictures of a board, both cameras, the world frame, a fix. Corners
come from OpenCV's projection with noise; what estimates them knows neither the lens' coefficients
nor which of them are 0. An honest covariance has a mean squared Mahalanobis distance of one per
degree of freedom, and its 95 % ellipsoid and sphere hold the truth 95 times in 100.

Sums are kept as they grow, in the folder that is given or the user's own, so that a run that is
broken off goes on; another version of the program begins anew.
"""

from functools import partial
from pathlib import Path
from typing import Any, Final

from app.core import paths
from app.core.progress import Progress
from app.studies.coverage_trials.chain import chain
from app.studies.coverage_trials.scene import LENSES, RIGS
from app.studies.coverage_trials.tally import KINDS, CoverageCell, CoverageTally, touched
from app.studies.findings import Figure, Findings, Sheet, Survey

DECLARATION: Final[dict[str, Any]] = {
    "title": "Coverage: stated errors of calibration, pose, tip and registration",
    "question": "Is what is said to hold with 95 % right 95 times in 100?",
    "reference": "the truth, by OpenCV's projection, unknown to what estimates it",
}

TRIALS: Final = 2500
"""A cell: the share that holds is known to ± 0.4 %."""

_ROUND: Final = 25
_QUICK: Final = 20

HELD: Final = (0.93, 0.97)
RIGHT: Final = (0.9, 1.1)
"""Where an honest share, and an honest ratio, lie."""

_COLUMNS: Final = (
    "kind",
    "quantity",
    "trials",
    "d²/dof",
    "95 % ellipsoid holds",
    "95 % sphere holds",
    "error/sd, least",
    "error/sd, most",
    "holds",
)


def cells() -> list[CoverageCell]:
    """Return every kind of trial, none tried yet."""
    chains = [
        CoverageCell(f"{rig}, {lens}", partial(chain, rig, lens)) for rig in RIGS for lens in LENSES
    ]
    return chains + [CoverageCell(f"touches {kind}", partial(touched, kind)) for kind in KINDS]


def _measure(progress: Progress | None = None, inputs: tuple[Path, ...] = ()) -> Findings:
    folder = inputs[0] if inputs else paths.data() / "studies" / "coverage"
    return _tried(TRIALS, folder, progress)


def _first_look(progress: Progress | None = None, inputs: tuple[Path, ...] = ()) -> Findings:
    return _tried(_QUICK, None, progress)


def _tried(count: int, folder: Path | None, progress: Progress | None) -> Findings:
    """Try all kinds in turn, some trials at a time, so that a part says something of each."""
    progress = progress or Progress()
    kinds = [cell.go_on(folder) if folder is not None else cell for cell in cells()]
    while waiting := [cell for cell in kinds if cell.done < count]:
        for cell in waiting:
            progress.report(sum(k.done for k in kinds) / (count * len(kinds)), cell.name)
            cell.run(min(_ROUND, count - cell.done))
            if folder is not None:
                cell.keep(folder)
    return findings(kinds)


def findings(kinds: list[CoverageCell]) -> Findings:
    """Return the table of what was tried, and what it says."""
    rows = [
        (cell.name, *_row(name, t, cell.name.endswith("not stated")))
        for cell in kinds
        for name, t in cell.tallies.items()
    ]
    wrong = [row for row in rows if row[-1] != "yes"]
    lines = [f"{len(rows) - len(wrong)} of {len(rows)} stated errors hold."]
    lines += [f"{row[0]}, {row[1]}: {row[-1]}" for row in wrong]
    lines += [f"{c.name}: {c.refused} of {c.done} refused" for c in kinds if c.refused]
    return Findings(
        (Sheet("table", "Stated errors against true ones", _COLUMNS, tuple(rows)),),
        (Figure("held", lambda figure: _draw(figure, rows), (9.0, 10.0)),),
        tuple(lines),
        not wrong,
    )


def _row(quantity: str, tally: CoverageTally, bound: bool) -> tuple[str | float | int, ...]:
    """Return a quantity's row; a bound may hold more, since its scale is estimated."""
    spread = tally.spread.values()
    ratio, held = tally.squares / tally.freedom, tally.held / tally.trials
    within = tally.within / tally.points if tally.points else None
    shares = [held] if within is None else [held, within]
    troubles = [
        text
        for text, bad in (
            ("d²/dof", not (bound or RIGHT[0] <= ratio) or ratio > RIGHT[1]),
            ("share", min(shares) < HELD[0] or (max(shares) > HELD[1] and not bound)),
            ("error/sd", not (bound or RIGHT[0] <= min(spread)) or max(spread) > RIGHT[1]),
        )
        if bad
    ]
    return (
        quantity,
        tally.trials,
        round(ratio, 3),
        round(held, 4),
        "-" if within is None else round(within, 4),
        round(min(spread), 3),
        round(max(spread), 3),
        "; ".join(troubles) or "yes",
    )


def _draw(figure: Any, rows: list[tuple[str | float | int, ...]]) -> None:
    """Shares that hold, and mean d² per degree of freedom, of every row."""
    labels = [f"{row[0]}: {row[1]}" for row in rows]
    places = range(len(rows), 0, -1)
    left, right = figure.subplots(1, 2, sharey=True)
    for axes, limits, true, columns in ((left, HELD, 0.95, (4, 5)), (right, RIGHT, 1.0, (3,))):
        axes.axvspan(*limits, color="0.9")
        axes.axvline(true, color="0.5", linewidth=0.8)
        for column, marker in zip(columns, "os", strict=False):
            known = [(row[column], y) for row, y in zip(rows, places, strict=True)]
            known = [(x, y) for x, y in known if not isinstance(x, str)]
            axes.plot(*zip(*known, strict=True), marker, markersize=4)
    left.set(xlabel="share that 95 % ellipsoid (●) and sphere (■) hold")
    left.set_yticks(list(places), labels, fontsize=7)
    right.set(xlabel="mean d² per degree of freedom")
    figure.tight_layout()


STUDY: Final = Survey(measure=_measure, quick=_first_look, inputs="a folder that keeps the sums")
"""Chains of calibration, world frame and tip, over rigs and lenses; and registrations."""
