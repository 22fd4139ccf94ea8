"""Curves of an attempt: depth, distance from the path, angle and force over one time axis."""

from typing import Final

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QTimer, Signal
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from app.session.review import Review
from app.session.timeline import Span
from app.views.debrief.curve_plot import cursor_of, draw, prepare, shade
from app.views.debrief.curve_values import Curve, curves_of, time_end, value_range
from app.views.exercise.state_words import state_word
from app.views.kit import theme
from app.views.kit.text import tr

__all__ = ["Curve", "CurvesView", "curves_of", "time_end", "value_range"]

SHORT_S: Final = 2.0
"""Times of an attempt up to this are read out in milliseconds."""


class CurvesView(QWidget):
    """Four plots under each other with one time axis; the pointer reads all of them at once.

    The plots are drawn one after the other, each in its own turn of the event loop: the page is
    there at once and a robot that is on does not miss the window's sign of life.

    Signals:
        drawn(): all plots show the attempt.
    """

    drawn = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._review: Review | None = None
        self._curves: tuple[Curve, ...] = ()
        self._plots: list[pg.PlotItem] = []
        self._cursors: list[pg.InfiniteLine] = []
        self._turn = QTimer(self, interval=0)
        self._turn.timeout.connect(self._draw_next)
        self.readout = QLabel(self)
        self.readout.setProperty("role", "dim")
        self.graphics = pg.GraphicsLayoutWidget(self)
        self.graphics.setBackground(theme.IMAGE_GROUND)
        self.graphics.ci.layout.setSpacing(2)
        self.graphics.scene().sigMouseMoved.connect(self._hover)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.readout)
        column.addWidget(self.graphics, 1)

    def show_review(self, review: Review) -> None:
        """Draw an attempt, from the next turn of the event loop on."""
        self._review, self._curves = review, curves_of(review)
        self._cursors = []
        if len(self._plots) != len(self._curves):  # the last one alone has a time axis
            self.graphics.clear()
            self._plots = []
        for plot in self._plots:
            plot.clear()
        self.readout.setText(tr("Point at the curves to read them."))
        self._turn.start()

    def _draw_next(self) -> None:
        """Draw the plot whose turn it is."""
        row, review = len(self._cursors), self._review
        if review is None or row >= len(self._curves):
            self._turn.stop()
            self.drawn.emit()
            return
        curve = self._curves[row]
        if row == len(self._plots):
            self._plots.append(self._new_plot(row, curve))
        plot = self._plots[row]
        shade(plot, review, curve, names=row == 0)
        draw(plot, review, curve)
        self._cursors.append(cursor_of(plot))

    def _new_plot(self, row: int, curve: Curve) -> pg.PlotItem:
        box = pg.ViewBox(enableMenu=False)  # the menus that nobody opens take most of the time
        plot = self.graphics.addPlot(row=row, col=0, viewBox=box, enableMenu=False)
        prepare(plot, curve, last=row == len(self._curves) - 1)
        box.sigXRangeChanged.connect(self._follow)
        return plot

    def _follow(self, moved: pg.ViewBox, span: tuple[float, float]) -> None:
        """Give all plots the time axis of the one that was moved.

        Not `setXLink`: it aligns by pixels, and shifts the axis while the plots are not laid out.
        """
        for plot in self._plots:
            if plot.getViewBox() is not moved:
                plot.setXRange(*span, padding=0.0)

    def read_out(self, time: float) -> str:
        """Say all figures at a time [s]."""
        review = self._review
        if review is None or len(review.curves.time) == 0:
            return ""
        i = int(np.argmin(np.abs(review.curves.time - time)))
        digits = 1 if time_end(review.curves.time) > SHORT_S else 3
        parts = [f"{review.curves.time[i]:.{digits}f} s", _state_at(review.spans, time)]
        for curve in self._curves:
            value = curve.values[i]
            text = f"{value:.1f} {curve.unit}" if np.isfinite(value) else "–"
            parts.append(f"{curve.name} {text}")
        return "   ·   ".join(part for part in parts if part)

    def _hover(self, at: QPointF) -> None:
        if not self._cursors:
            return
        time = self._cursors[0].getViewBox().mapSceneToView(at).x()
        for cursor in self._cursors:
            cursor.setPos(time)
            cursor.show()
        self.readout.setText(self.read_out(time))


def _state_at(spans: tuple[Span, ...], time: float) -> str:
    for span in spans:
        if span.start <= time <= span.end:
            return state_word(span.state)
    return ""
