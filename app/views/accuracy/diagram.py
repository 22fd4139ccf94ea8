"""Error against time of the ways of one study, each at its worst, with the lines they keep."""

from __future__ import annotations

from html import escape
from math import isfinite, log10
from typing import TYPE_CHECKING, Final

import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from app.views.kit import theme
from app.views.kit.text import tr

if TYPE_CHECKING:
    from app.studies.kept import Kept
    from app.studies.study import Point

HUES: Final = ("#56b4e9", "#e69f00", "#009e73", "#cc79a7", "#f0e442", "#d55e00", "#ffffff")
SYMBOLS: Final = {"o": "●", "s": "■", "t": "▼", "d": "◆", "star": "★", "p": "⬟", "h": "⬢"}
"""One hue and one shape for each family of ways, so that neither stands alone."""

_LEAST: Final = 1e-16
"""Errors below this are drawn here: zero has no place on the axis."""


class Diagram(QWidget):
    """A work-precision diagram, both axes by powers of ten; less is better on both."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        axis = _TimeAxis("left")
        axis.enableAutoSIPrefix(False)
        self.plot = pg.PlotWidget(background=theme.IMAGE_BACKGROUND, axisItems={"left": axis})
        self.plot.setLogMode(x=True, y=True)
        self.plot.showGrid(x=True, y=True, alpha=0.25)
        self.plot.setMenuEnabled(False)
        self.plot.hideButtons()
        self.plot.setMouseEnabled(x=False, y=False)
        self.families = QLabel(self)
        self.families.setTextFormat(Qt.TextFormat.RichText)
        self.families.setWordWrap(True)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.plot, 1)
        column.addWidget(self.families)

    def show_study(self, found: Kept) -> None:
        """Draw the ways of a measured study."""
        study, points = found.result.study, found.result.summary()
        self.plot.clear()
        self.plot.setLabel("bottom", study.error_label)
        self.plot.setLabel("left", tr("Processor time of one call"))
        named, symbols = [], list(SYMBOLS)
        families = dict.fromkeys(way.family for way in study.ways)
        for number, family in enumerate(families):
            own = [p for p in points if p.family == family]
            hue, symbol = HUES[number % len(HUES)], symbols[number % len(symbols)]
            if own:
                self._draw(own, hue, symbol)
            named.append(f'<span style="color:{hue}">{SYMBOLS[symbol]}</span> {escape(family)}')
        self.families.setText(" &nbsp; ".join(named))
        self._line(study.deadline.value, study.deadline.label, 0)
        self._line(study.perception.value, study.perception.label, 90)
        for point in points:
            if point.way in (study.default, found.sweet_spot):
                self._ring(point, tr("in use") if point.way == study.default else tr("by the rule"))
        self.plot.autoRange(padding=0.12)

    def _draw(self, points: list[Point], hue: str, symbol: str) -> None:
        x, y = zip(*((_error(p), p.seconds) for p in points), strict=True)
        self.plot.plot(
            list(x),
            list(y),
            pen=pg.mkPen(hue, width=1.5),
            symbol=symbol,
            symbolSize=11,
            symbolBrush=hue,
            symbolPen=None,
        )

    def _line(self, value: float, words: str, angle: int) -> None:
        if not (isfinite(value) and value > 0.0):
            return
        pen = pg.mkPen(theme.IMAGE_WARNING, width=1.2, style=Qt.PenStyle.DashLine)
        anchors = [(0.0, 1.0), (0.0, 1.0)]
        options = {"position": 0.04, "color": theme.IMAGE_WARNING, "anchors": anchors}
        line = pg.InfiniteLine(log10(value), angle, pen, label=words, labelOpts=options)
        self.plot.addItem(line)

    def _ring(self, point: Point, words: str) -> None:
        x, y = log10(_error(point)), log10(point.seconds)
        ring = pg.ScatterPlotItem([x], [y], size=22, brush=None, pen=pg.mkPen("#ffffff", width=2))
        text = pg.TextItem(f"{point.way}: {words}", color=QColor(theme.IMAGE_TEXT), anchor=(0, 1))
        text.setPos(x, y)
        self.plot.addItem(ring)
        self.plot.addItem(text)


class _TimeAxis(pg.AxisItem):
    """Powers of ten of a second, in the unit that suits each."""

    def logTickStrings(self, values: list[float], scale: float, spacing: float) -> list[str]:
        """Say 1 µs, not 1e-06; only ones, twos and fives, which have room."""
        units = (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6), ("ns", 1e-9), ("ps", 1e-12))
        found = []
        for value in values:
            seconds = 10.0**value
            if round(10.0 ** (value % 1.0)) not in (1, 2, 5, 10):
                found.append("")
                continue
            unit, size = next((u for u in units if seconds >= 0.999 * u[1]), units[-1])
            found.append(f"{seconds / size:.3g} {unit}")
        return found


def _error(point: Point) -> float:
    return max(point.error, _LEAST)
