"""What conditions cost a scripted hand: a sweep's means over its conditions, while it grows too."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING, Final

import pyqtgraph as pg
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QComboBox,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.scoring.metrics import available
from app.views.accuracy.diagram import HUES, SYMBOLS
from app.views.kit import theme
from app.views.kit.parts import button, label, table
from app.views.kit.text import declared, literal, number, tr, tr_n

if TYPE_CHECKING:
    from app.studies.sweep_table import SweepMean, SweepTable

_MILLION: Final = 1e6
_HOUR: Final = 3600.0
_ROWS: Final = 3
"""So many rows of the table are seen at once, however low the window."""


class SweepTab(QWidget):
    """A sweep: a measure along a condition, a line for each value of another one.

    Signals:
        wanted(): another table shall be chosen.

    Attributes:
        sweep: what is shown; None for nothing yet.
        over, apart, measure: what is chosen, by the names of the table's columns.
    """

    wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.sweep: SweepTable | None = None
        self.open = button(tr("Open a sweep…"))
        self.open.setToolTip(
            literal(tr("The table of `acus cohort sweep`, or one that is growing"))
        )
        self.open.clicked.connect(self.wanted)
        self.summary = label(
            tr("What `acus cohort sweep` has found, also while it works. Scripts, not people.")
        )
        self.grown = QProgressBar(self)
        self.grown.setAccessibleName(tr("Attempts of the sweep"))
        self.grown.hide()
        self.measure, self.over, self.apart = QComboBox(self), QComboBox(self), QComboBox(self)
        choice = QHBoxLayout()
        for words, box in (
            (tr("Measure"), self.measure),
            (tr("Over"), self.over),
            (tr("Apart by"), self.apart),
        ):
            box.setAccessibleName(words)
            box.setSizeAdjustPolicy(
                QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
            )
            box.setMinimumContentsLength(12)
            box.activated.connect(lambda _: self._draw())
            choice.addWidget(label(words))
            choice.addWidget(box, 1)
        self.plot = pg.PlotWidget(background=theme.IMAGE_BACKGROUND)
        self.plot.showGrid(x=True, y=True, alpha=0.25)
        self.plot.setMenuEnabled(False)
        self.plot.hideButtons()
        self.plot.setMouseEnabled(x=False, y=False)
        self._lines: list[tuple[pg.PlotDataItem, pg.PlotDataItem]] = []
        self.series = QLabel(self)
        self.series.setTextFormat(Qt.TextFormat.RichText)
        self.series.setWordWrap(True)
        self.means = table(
            (tr("Apart by"), tr("Over"), tr("Attempts"), tr("Mean"), tr("Interval of 95 %"))
        )
        self.means.setAccessibleName(tr("Means"))
        self.means.setMinimumHeight((_ROWS + 1) * theme.CONTROL_HEIGHT)
        head = QHBoxLayout()
        head.addWidget(self.open)
        head.addWidget(self.summary, 1)
        column = QVBoxLayout(self)
        column.addLayout(head)
        column.addWidget(self.grown)
        self._body = QWidget(self)  # an empty diagram and table would say nothing
        body = QVBoxLayout(self._body)
        body.setContentsMargins(0, 0, 0, 0)
        body.addLayout(choice)
        body.addWidget(self.plot, 3)
        body.addWidget(self.series)
        body.addWidget(self.means, 2)
        column.addWidget(self._body, 1)
        column.addStretch()
        self._body.hide()

    def show_sweep(self, sweep: SweepTable) -> None:
        """Show a sweep; what was chosen stays where it is still there."""
        self.sweep = sweep
        self._body.show()
        conditions = [(condition_words(name), name) for name in sweep.conditions]
        measures = [(measure_words(name), name) for name in sweep.measures]
        for box, entries in (
            (self.measure, measures),
            (self.over, conditions),
            (self.apart, [(tr("nothing"), ""), *conditions]),
        ):
            before = box.currentData()
            box.clear()
            for words, name in entries:
                box.addItem(words, name)
            box.setCurrentIndex(max(0, box.findData(before)))
        self._say(sweep)
        self._draw()

    def _say(self, sweep: SweepTable) -> None:
        parts = [
            sweep.exercise,
            tr_n(
                "{n} attempt of scripts, not people",
                "{n} attempts of scripts, not people",
                sweep.attempts,
            ),
        ]
        if sweep.unjudged:
            parts.append(
                tr_n(
                    "{n} has no score and is in no mean",
                    "{n} have no score and are in no mean",
                    sweep.unjudged,
                )
            )
        if sweep.attempt_s is not None:
            hours = number(_MILLION * sweep.attempt_s / _HOUR, ".3g")
            seconds = number(sweep.attempt_s, ".3g")
            parts.append(
                tr(
                    "one costs {seconds} s of a processor, a million {hours} h",
                    seconds=seconds,
                    hours=hours,
                )
            )
        self.summary.setText("; ".join(parts) + ".")
        self.grown.setVisible(not sweep.finished)
        self.grown.setRange(0, sweep.wanted or 0)
        self.grown.setValue(min(sweep.attempts, sweep.wanted or 0))

    def _draw(self) -> None:
        """Draw what is chosen."""
        sweep = self.sweep
        if sweep is None:
            return
        measure, over = self.measure.currentData(), self.over.currentData()
        apart = self.apart.currentData()
        means = sweep.means(measure, over, "" if apart == over else apart)
        scale = 100.0 if measure == "passed" else 1.0
        for line in self._lines:
            for part in line:
                part.setData([], [])
        self.plot.setLabel("bottom", escape(condition_words(over)))
        self.plot.setLabel("left", escape(measure_words(measure)))
        places = _places(means)
        ticks = [(place, str(at)) for at, place in places.items() if isinstance(at, str)]
        self.plot.getAxis("bottom").setTicks([ticks] if ticks else None)
        legend = []
        for order, name in enumerate(dict.fromkeys(one.series for one in means)):
            own = [one for one in means if one.series == name]
            mark = self._line(order, [places[one.at] for one in own], own, scale)
            if name:
                legend.append(f"{mark} {escape(name)}")
        self.series.setText(" &nbsp; ".join(legend))
        self.series.setVisible(bool(legend))
        self._fill(means, scale)

    def _line(self, order: int, x: list[float], means: Sequence[SweepMean], scale: float) -> str:
        """Draw a line and its intervals in the items of its place; return its legend's mark.

        The items stay as long as the plot: pyqtgraph's are not taken out of a plot and left to be
        destroyed beside it.
        """
        while len(self._lines) <= order:
            self._lines.append((self.plot.plot([], []), self.plot.plot([], [])))
        between, marks = self._lines[order]
        hue, symbol = HUES[order % len(HUES)], list(SYMBOLS)[order % len(SYMBOLS)]
        ends = [scale * end for one in means for end in (one.lower, one.upper)]
        twice = [place for place in x for _ in range(2)]  # a line from end to end, then a gap
        between.setData(twice, ends, pen=pg.mkPen(hue, width=1.2), connect="pairs")
        marks.setData(
            x,
            [scale * one.mean for one in means],
            pen=pg.mkPen(hue, width=1.5),
            symbol=symbol,
            symbolSize=9,
            symbolBrush=hue,
            symbolPen=None,
        )
        return f'<span style="color:{hue}">{SYMBOLS[symbol]}</span>'

    def _fill(self, means: Sequence[SweepMean], scale: float) -> None:
        self.means.setRowCount(len(means))
        for row, one in enumerate(means):
            at = number(one.at, ".4g") if isinstance(one.at, float) else str(one.at)
            low, high = (number(scale * value, ".3g") for value in (one.lower, one.upper))
            cells = (
                one.series,
                at,
                str(one.attempts),
                number(scale * one.mean, ".3g"),
                tr("{low} to {high}", low=low, high=high),
            )
            for column, words in enumerate(cells):
                self.means.setItem(row, column, QTableWidgetItem(words))


def condition_words(name: str) -> str:
    """Say what a column of conditions holds; an effect's parameter as the table names it."""
    return {
        "exercise": tr("Exercise"),
        "version": tr("Version"),
        "skill": tr("Skill"),
        "device": tr("Robot"),
        "tissue": tr("Tissue"),
        "registration_error_mm": tr("Registration error [mm]"),
        "tracking_noise": tr("Noise of the cameras (factor)"),
        "breathing_mm": tr("Breathing [mm]"),
        "assistance": tr("Assistance"),
    }.get(name, name)


def measure_words(name: str) -> str:
    """Say what a measure is, with its unit."""
    shipped = {
        "total": tr("Points"),
        "passed": tr("Share that passes [%]"),
        "duration_s": tr("Duration [s]"),
    }
    metric = available().get(name.removeprefix("value_"))
    if name in shipped or metric is None:
        return shipped.get(name, name)
    unit = f" [{metric.unit}]" if metric.unit else ""
    return f"{declared(metric.title)}{unit}"


def _places(means: Sequence[SweepMean]) -> dict[str | float, float]:
    """Return where each value stands on the axis: numbers as they are, texts one after another."""
    values = dict.fromkeys(one.at for one in means)
    if all(isinstance(value, int | float) for value in values):
        return {value: float(value) for value in values}
    return {value: float(place) for place, value in enumerate(values)}
