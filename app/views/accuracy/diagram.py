"""Error against time of the ways of one study, each at its worst, with the lines they keep."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from math import ceil, floor, isfinite, log10
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

_BEYOND: Final = 1e4
"""Errors of more than this times what is noticed are drawn here, with their value beside them: a
way that blows up leaves no room for the others."""

_LABELS: Final = 9
"""So many powers of ten have room on an axis."""

_POWERS: Final = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Diagram(QWidget):
    """A work-precision diagram, both axes by powers of ten; less is better on both."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        axes: dict[str, pg.AxisItem] = {"left": _TimeAxis("left"), "bottom": _ErrorAxis("bottom")}
        for axis in axes.values():
            axis.enableAutoSIPrefix(False)
        self.plot = pg.PlotWidget(background=theme.IMAGE_BACKGROUND, axisItems=axes)
        self.plot.setLogMode(x=True, y=True)
        self.plot.showGrid(x=True, y=True, alpha=0.25)
        self.plot.setMenuEnabled(False)
        self.plot.hideButtons()
        self.plot.setMouseEnabled(x=False, y=False)
        self._most = _LEAST
        self.families = QLabel(self)
        self.families.setTextFormat(Qt.TextFormat.RichText)
        self.families.setWordWrap(True)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.plot, 1)
        column.addWidget(self.families)

    def show_study(self, outcome: Kept) -> None:
        """Draw the ways of a measured study."""
        study, points = outcome.result.study, outcome.result.summary()
        self._most = _BEYOND * study.perception.value
        self.plot.clear()
        self._fit(points, study.perception.value, study.deadline.value)
        self.plot.setLabel("bottom", escape(study.error_label))
        self.plot.setLabel("left", tr("Processor time of one call"))
        titles, symbols = [], list(SYMBOLS)
        families = dict.fromkeys(way.family for way in study.ways)
        for number, family in enumerate(families):
            own = [p for p in points if p.family == family]
            hue, symbol = HUES[number % len(HUES)], symbols[number % len(symbols)]
            if own:
                self._draw(own, hue, symbol)
            titles.append(f'<span style="color:{hue}">{SYMBOLS[symbol]}</span> {escape(family)}')
        self.families.setText(" &nbsp; ".join(titles))
        self._line(study.deadline.value, study.deadline.label, 0)
        self._line(study.perception.value, study.perception.label, 90)
        named = (study.default, outcome.sweet_spot)
        for point in points:
            if point.way in named:
                self._ring(point, tr("in use") if point.way == study.default else tr("by the rule"))
        far = [one for one in points if one.error > self._most and one.way not in named]
        for number, point in enumerate(sorted(far, key=lambda one: -one.seconds)):
            self._say(point, f"{point.way}: {point.error:.1e} →", below=bool(number % 2))

    def _fit(self, points: Sequence[Point], *limits: float) -> None:
        """Show the points, and the lines that they keep, with room for what is written on them."""
        noticed, deadline = ([one] if isfinite(one) and one > 0.0 else [] for one in limits)
        x = [log10(one) for one in (*(self._error(p) for p in points), *noticed)]
        y = [log10(one) for one in (*(p.seconds for p in points), *deadline)]
        ranges = []
        for values in (x, y):
            low, high = min(values), max(values)
            room = max(0.1 * (high - low), 0.3)
            ranges.append((low - room, high + room))
        self.plot.setRange(xRange=ranges[0], yRange=ranges[1], padding=0.0)

    def _draw(self, points: list[Point], hue: str, symbol: str) -> None:
        x, y = zip(*((self._error(p), p.seconds) for p in points), strict=True)
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
        # Below the line, or left of it, where it stands in the upper or the right half.
        anchors = [(0.0, 1.0), (1.0, 1.0)] if angle else [(0.0, 0.0), (0.0, 1.0)]
        options = {"position": 0.04, "color": theme.IMAGE_WARNING, "anchors": anchors}
        line = pg.InfiniteLine(log10(value), angle, pen, label=words, labelOpts=options)
        self.plot.addItem(line)

    def _ring(self, point: Point, words: str) -> None:
        x, y = log10(self._error(point)), log10(point.seconds)
        ring = pg.ScatterPlotItem([x], [y], size=22, brush=None, pen=pg.mkPen("#ffffff", width=2))
        self.plot.addItem(ring)
        far = f" ({point.error:.1e} →)" if point.error > self._most else ""
        self._say(point, f"{point.way}: {words}{far}")

    def _say(self, point: Point, words: str, below: bool = False) -> None:
        """Write beside a point, towards the middle, so that nothing is cut at the edge."""
        x, y = log10(self._error(point)), log10(point.seconds)
        (left, right), (low, high) = self.plot.viewRange()
        above = y < low + 0.85 * (high - low) and not below
        anchor = (float(x > 0.5 * (left + right)), float(above))
        text = pg.TextItem(words, color=QColor(theme.IMAGE_TEXT), anchor=anchor)
        text.setPos(x, y)
        self.plot.addItem(text, ignoreBounds=True)

    def _error(self, point: Point) -> float:
        """Return where a point stands on the axis of errors."""
        return min(max(point.error, _LEAST), self._most)


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


class _ErrorAxis(pg.AxisItem):
    """Powers of ten as such; twos and fives between them where there are few."""

    def logTickValues(
        self, minVal: float, maxVal: float, size: float, stdTicks: object
    ) -> list[tuple[float | None, list[float]]]:
        """Place ticks at as many decades as have room."""
        first, last = ceil(minVal), floor(maxVal)
        step = max(1, -(-(last - first + 1) // _LABELS))
        found: list[float] = [float(one) for one in range(first, last + 1) if one % step == 0]
        if len(found) < 3:
            found += [n + log10(m) for n in range(first - 1, last + 1) for m in (2, 5)]
        return [(None, sorted(one for one in found if minVal <= one <= maxVal))]

    def logTickStrings(self, values: list[float], scale: float, spacing: float) -> list[str]:
        """Say 10⁻⁶, not 1e-06, and no factor apart."""
        found = []
        for value in values:
            power = floor(value + 1e-9)
            times = round(10.0 ** (value - power))
            ten = "10" + str(power).translate(_POWERS)
            found.append(ten if times == 1 else f"{times}·{ten}")
        return found
