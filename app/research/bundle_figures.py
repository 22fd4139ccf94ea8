"""The figures of a bundle, drawn from its tables alone: the same tables give the same bytes.

Means of participants, not of attempts, are compared: one who tried more often weighs no more. The
intervals are those of Student's t over the participants of an arm at a visit.
"""

from __future__ import annotations

import csv
import io
from collections import defaultdict
from collections.abc import Mapping, Sequence
from itertools import cycle
from typing import Any, Final

import numpy as np
from scipy.stats import t as student_t

from app.core.configuration import parse_yaml
from app.core.extras import not_installed
from app.research.design import ResearchDesign
from app.research.errors import ResearchError

FOLDER: Final = "figures/"
OUTCOME: Final = f"{FOLDER}primary_outcome.svg"
FLOW: Final = f"{FOLDER}consort.svg"
EXTRA: Final = "research"

_INKS: Final = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00")
"""Okabe and Ito (2008): told apart by people who see few colours."""
_SIGNS: Final = ("o", "s", "^", "D", "v", "P")
_STYLE: Final[Mapping[str, Any]] = {
    "svg.hashsalt": "acus",
    "svg.fonttype": "none",
    "font.family": ["DejaVu Sans"],
    "font.size": 10.0,
}

Rows = Sequence[Mapping[str, str]]


def matplotlib_version() -> str:
    """Return the version of matplotlib.

    Raises:
        ResearchError: if it is not installed; names the extra.
    """
    try:
        import matplotlib
    except ImportError as error:
        raise not_installed(ResearchError, "matplotlib", EXTRA) from error
    return str(matplotlib.__version__)


def bundle_figures(files: Mapping[str, bytes]) -> dict[str, bytes]:
    """Draw the figures of a bundle as SVG.

    Args:
        files: of the bundle, by name; `design.yaml` and the tables are read.

    Raises:
        ResearchError: if matplotlib is not installed.
        KeyError, ValueError, AcusError: if a table or the design is not what it should be.
    """
    matplotlib_version()
    design = ResearchDesign.model_validate(parse_yaml(files["design.yaml"].decode(), "design.yaml"))
    return {OUTCOME: _outcome(design, files), FLOW: _flow(design, _table(files, "consort.csv"))}


def participant_means(
    outcome: str, attempts: Rows, metrics: Rows
) -> dict[tuple[str, str], list[float]]:
    """Return the means of participants by arm and visit, in the order of their codes.

    Args:
        outcome: a metric, or `score_total`.
        attempts: that table of the bundle.
        metrics: likewise.
    """
    value = {row["attempt"]: row["value"] for row in metrics if row["metric"] == outcome}
    if outcome == "score_total":
        value = {row["attempt"]: row["score_total"] for row in attempts}
    own: dict[tuple[str, str, str], list[float]] = defaultdict(list)
    for row in attempts:
        if row["visit"] and (text := value.get(row["attempt"], "")):
            own[row["arm"], row["visit"], row["participant"]].append(float(text))
    means: dict[tuple[str, str], list[float]] = defaultdict(list)
    for (arm, visit, _), values in sorted(own.items()):
        means[arm, visit].append(float(np.mean(values)))
    return dict(means)


def t_interval(values: Sequence[float], level: float = 0.95) -> float:
    """Return half of the interval of a mean by Student's t; 0 under two values."""
    if len(values) < 2:
        return 0.0
    n = len(values)
    return float(student_t.ppf(0.5 + 0.5 * level, n - 1) * np.std(values, ddof=1) / np.sqrt(n))


def _outcome(design: ResearchDesign, files: Mapping[str, bytes]) -> bytes:
    name, visits = design.primary_outcome, [visit.name for visit in design.visits]
    means = participant_means(name, _table(files, "attempts.csv"), _table(files, "metrics.csv"))
    units = {row["metric"]: row["unit"] for row in _table(files, "metrics_codebook.csv")}

    def draw(axes: Any) -> None:
        for place, arm in enumerate(design.arms):
            ink, sign = _INKS[place % len(_INKS)], _SIGNS[place % len(_SIGNS)]
            shift = 0.12 * (place - 0.5 * (len(design.arms) - 1))
            at, middle, half = [], [], []
            for x, visit in enumerate(visits):
                values = means.get((arm.name, visit), [])
                aside = [x + shift + 0.012 * d for _, d in zip(values, cycle((-1, 0, 1)))]
                axes.plot(aside, values, sign, color=ink, markersize=3.0, alpha=0.35)
                if values:
                    at.append(x + shift)
                    middle.append(float(np.mean(values)))
                    half.append(t_interval(values))
            look = {"marker": sign, "color": ink, "capsize": 3.0, "label": arm.name}
            axes.errorbar(at, middle, yerr=half, **look)
        axes.set_xticks(range(len(visits)), visits)
        unit = "points" if name == "score_total" else units.get(name, "")
        axes.set_ylabel(f"{name} [{unit}]" if unit else name)
        axes.set_title(f"{design.title}\nmean and 95 % interval over participants", fontsize=10.0)
        axes.legend(frameon=False)
        axes.spines[["top", "right"]].set_visible(False)

    return _svg(draw, (6.4, 4.2))


def _flow(design: ResearchDesign, rows: Rows) -> bytes:
    """Draw the flow of participants: a column for each arm, a box for each stage."""
    arms = [arm.name for arm in design.arms]
    stages = list(dict.fromkeys(row["stage"] for row in rows))
    count = {(row["stage"], row["arm"]): row["n"] for row in rows}

    def draw(axes: Any) -> None:
        axes.set_axis_off()
        axes.set_xlim(0.0, float(len(arms)))
        axes.set_ylim(-float(len(stages)), 1.0)
        for column, arm in enumerate(arms):
            x = column + 0.5
            axes.text(x, 0.5, arm, ha="center", va="center", weight="bold")
            axes.plot([x, x], [0.3, 0.6 - len(stages)], color="#333333", linewidth=0.8, zorder=0)
            for line, stage in enumerate(stages):
                words = f"{stage}\nn = {count.get((stage, arm), '0')}"
                box = {"boxstyle": "square,pad=0.4", "facecolor": "white", "edgecolor": "#333333"}
                axes.text(x, -line - 0.4, words, ha="center", va="center", bbox=box, fontsize=9.0)

    return _svg(draw, (2.6 * len(arms), 0.8 * (len(stages) + 1)))


def _svg(draw: Any, size: tuple[float, float]) -> bytes:
    import matplotlib
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    from matplotlib.figure import Figure

    stream = io.BytesIO()
    with matplotlib.rc_context(dict(_STYLE)):
        figure = Figure(figsize=size, layout="constrained")
        FigureCanvasSVG(figure)
        draw(figure.add_subplot())
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    return stream.getvalue()


def _table(files: Mapping[str, bytes], name: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(files[name].decode(), newline="")))
