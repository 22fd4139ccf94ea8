"""The panel's live read-outs: large numbers that do not move their neighbours, and a bar for the
force.
"""

from math import degrees
from typing import Final

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontDatabase, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QGridLayout, QLabel, QSizePolicy, QWidget

from app.views.exercise.felt import Felt, GuidanceLimit, force_words, origin_help
from app.views.exercise.live import LiveFigures
from app.views.kit import theme
from app.views.kit.parts import PlainLabel
from app.views.kit.text import literal, tr

_HEADROOM = 1.15
"""Length of the bar over the limit: the mark stands inside it."""


_HEIGHT = 57
"""Of bar, force and limit, and the line on guidance, whose room is kept where it is empty."""


class ForceBar(QWidget):
    """Force [N] as a bar and a number; the limit as a line with its value; below it how much
    guidance can be had where the needle is, if that is less.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._force, self._limit, self._measured, self._at_most = 0.0, 5.0, False, False
        self._guidance: GuidanceLimit | None = None
        self._detailed = True
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setMinimumHeight(_HEIGHT)
        self._explain()

    def sizeHint(self) -> QSize:
        """Preferred size."""
        return QSize(200, _HEIGHT)

    def show_force(
        self,
        force: float,
        limit: float,
        measured: bool = False,
        guidance: GuidanceLimit | None = None,
        at_most: bool = False,
    ) -> None:
        """Show a force and the limit [N]; not finite counts as zero.

        Args:
            force: at the hand [N].
            limit: largest that the device may give [N].
            measured: whether a gauge measured the force; else it is called estimated.
            guidance: what holds it below the limit where the needle is; None if nothing.
            at_most: whether `force` is only a bound, because nobody measures the depth; it is then
                drawn as an outline.
        """
        force = force if 0.0 <= force < 1e6 else 0.0
        shown = (self._force, self._limit, self._measured, self._guidance, self._at_most)
        if (force, limit, measured, guidance, at_most) == shown:
            return
        self._force, self._limit = force, limit
        if (measured, guidance, at_most) != (self._measured, self._guidance, self._at_most):
            self._measured, self._guidance, self._at_most = measured, guidance, at_most
            self._explain()
        self.setAccessibleName(self.words)
        self.update()

    def set_detailed(self, detailed: bool) -> None:
        """Say how much guidance there is here, and why, or only show it."""
        self._detailed = detailed
        self._explain()
        self.update()

    @property
    def words(self) -> str:
        """Force and where it comes from, or that it is a bound, as written under the bar."""
        return force_words(Felt(self._force, self._measured, self._at_most))

    def _explain(self) -> None:
        line = tr("The line is the largest force the device may give now.")
        here = f" {self.guidance}." if self._guidance is not None and self._detailed else ""
        self.setToolTip(literal(f"{origin_help(self._measured, self._at_most)} {line}{here}"))

    @property
    def words_of_guidance(self) -> str:
        """Return how much guidance there is here, as written below the force; empty if all of
        it.
        """
        return self._guidance.words if self._guidance is not None else ""

    @property
    def guidance(self) -> str:
        """Return what holds the force below the limit here, with the reason; empty if nothing."""
        if self._guidance is None:
            return ""
        words = tr("{limit}: {reason}", limit=self._guidance.words, reason=self._guidance.reason)
        return words[0].upper() + words[1:]

    @property
    def verdict(self) -> str:
        """`good`, from 80 % of the limit `warning`, at the limit `bad`."""
        share = self._force / self._limit if self._limit > 0.0 else 1.0
        return "good" if share < 0.8 else "warning" if share < 0.999 else "bad"

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw bar, number and limit."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        colour, symbol = theme.VERDICTS[self.verdict]
        bar = QRectF(1, 2, self.width() - 2, 14)
        painter.setPen(QPen(QColor(theme.BORDER), 1.0))
        painter.setBrush(QColor("#0e1114"))
        painter.drawRoundedRect(bar, 3, 3)
        full = _HEADROOM * self._limit if self._limit > 0.0 else 1.0
        painter.setPen(QPen(QColor(colour), 1.5) if self._at_most else Qt.PenStyle.NoPen)
        painter.setBrush(Qt.BrushStyle.NoBrush if self._at_most else QColor(colour))
        filled = bar.adjusted(1, 1, -1, -1)
        filled.setWidth(filled.width() * min(1.0, self._force / full))
        painter.drawRoundedRect(filled, 2, 2)
        limit_x = bar.left() + bar.width() * self._limit / full
        painter.setPen(QPen(QColor(theme.TEXT), 2.0))
        painter.drawLine(QPointF(limit_x, 0), QPointF(limit_x, 18))
        if self._guidance is not None:
            here_x = bar.left() + bar.width() * self._guidance.force / full
            painter.setPen(QPen(QColor(theme.VERDICTS["warning"][0]), 2.0))
            painter.drawLine(QPointF(here_x, 2), QPointF(here_x, 16))
        self._paint_texts(painter, symbol)

    def _paint_texts(self, painter: QPainter, symbol: str) -> None:
        font = QFont(painter.font())
        font.setPixelSize(theme.SMALL_PX)
        painter.setFont(font)
        below = QRectF(0, 19, self.width(), 19)
        painter.setPen(QColor(theme.TEXT))
        metrics, force = painter.fontMetrics(), f"{symbol} {self.words}"
        shown = metrics.elidedText(force, Qt.TextElideMode.ElideRight, self.width())
        painter.drawText(below, Qt.AlignmentFlag.AlignLeft, shown)
        painter.setPen(QColor(theme.TEXT_DIM))
        limit = tr("limit {limit:g} N", limit=self._limit)
        if metrics.horizontalAdvance(f"{force}  {limit}") <= self.width():  # else its line is there
            painter.drawText(below, Qt.AlignmentFlag.AlignRight, limit)
        if self._guidance is not None and self._detailed:
            painter.setPen(QColor(theme.VERDICTS["warning"][0]))
            words = metrics.elidedText(
                self.words_of_guidance, Qt.TextElideMode.ElideRight, self.width()
            )
            painter.drawText(below.translated(0, 19), Qt.AlignmentFlag.AlignLeft, words)


_EMPTY = "–"

DETAILS: Final = frozenset({"radius", "bending"})
"""Read-outs that say how well the needle is known."""

OFFSETS: Final = frozenset({"angle", "lateral", "to_target"})
"""Read-outs that say what the bull's-eye shows."""


class AttemptReadouts(QWidget):
    """Time, depth, angle, distances, scans and force."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._values: dict[str, QLabel] = {}
        self._titles: dict[str, QLabel] = {}
        self.force = ForceBar(self)
        self._telling: frozenset[str] | None = None
        self._offsets = self._forceful = self._detailed = True
        self._elsewhere: frozenset[str] = frozenset()
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setVerticalSpacing(3)
        # The values take the free room: a text that grows is never cut, not even for one picture.
        self._grid.setColumnStretch(1, 1)
        for key, (name, help_text) in _rows().items():
            self._add(key, name, help_text)
        row = self._grid.rowCount()
        self._force_title = PlainLabel(tr("Force felt"), self)
        self._grid.addWidget(self._force_title, row, 0, 1, 2)
        self._grid.addWidget(self.force, row + 1, 0, 1, 2)

    def show_figures(self, figures: LiveFigures | None) -> None:
        """Show a moment; None empties the read-outs."""
        texts = dict.fromkeys(self._values, _EMPTY) if figures is None else figure_texts(figures)
        for key, text in texts.items():
            if self._values[key].text() != text:
                self._values[key].setText(text)
        if figures is None:
            self.force.show_force(0.0, 5.0)
        else:
            self.force.show_force(
                figures.force,
                figures.force_limit,
                figures.force_measured,
                figures.guidance,
                figures.force_at_most,
            )

    def set_telling(self, keys: frozenset[str] | None) -> None:
        """Leave only these read-outs, None for all with the force: the rest would tell too much."""
        self._telling = keys
        self._show_rows()
        self._show_force_bar()

    def set_elsewhere(self, keys: frozenset[str]) -> None:
        """Leave out these read-outs and the force, which stand beside this; empty: none do."""
        self._elsewhere = keys
        self._show_rows()
        self._show_force_bar()

    def set_detailed(self, detailed: bool) -> None:
        """Show how well the tip is known, and what limits the guidance, or leave that out."""
        self._detailed = detailed
        self.force.set_detailed(detailed)
        self._show_rows()

    def set_offsets(self, shown: bool) -> None:
        """Say how far the needle is off the path, or not."""
        self._offsets = shown
        self._show_rows()

    def _show_rows(self) -> None:
        for key, value in self._values.items():
            told = self._telling is None or key in self._telling
            told = told and (self._detailed or key not in DETAILS)
            told = told and key not in self._elsewhere
            for label in (value, self._titles[key]):
                label.setVisible(told and (self._offsets or key not in OFFSETS))

    def set_forceful(self, forceful: bool) -> None:
        """Show the force felt, or not where nothing can push."""
        self._forceful = forceful
        self._show_force_bar()

    def _show_force_bar(self) -> None:
        for widget in (self._force_title, self.force):
            shown = self._telling is None and self._forceful
            widget.setVisible(shown and not self._elsewhere)

    def text(self, key: str) -> str:
        """Text of one read-out: `elapsed`, `depth`, `angle`, `lateral`, `to_target`, `scans`."""
        return self._values[key].text()

    def _add(self, key: str, name: str, help_text: str) -> None:
        row = self._grid.rowCount()
        title, value = PlainLabel(name, self), PlainLabel(_EMPTY, self)
        value.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        value.setStyleSheet(f"font-size: {theme.FONT_PX + 3}px; font-weight: 600;")
        value.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        for label in (title, value):
            label.setToolTip(literal(help_text))
        self._grid.addWidget(title, row, 0)
        self._grid.addWidget(value, row, 1)
        self._values[key], self._titles[key] = value, title


def _rows() -> dict[str, tuple[str, str]]:
    return {
        "elapsed": (tr("Time"), tr("Since the start of the attempt")),
        "depth": (
            tr("Depth"),
            tr("Tip beyond the entry, along the needle; ◇ when it is not measured now"),
        ),
        "angle": (tr("Angle error"), tr("Between the needle and the planned path")),
        "lateral": (tr("Off the path"), tr("Tip from the line of the planned path")),
        "to_target": (tr("To target"), tr("Along the path; negative when the tip is too deep")),
        "radius": (
            tr("Tip known to"),
            tr("Radius round the tip that holds the true one with 95 %, as it is shown now"),
        ),
        "bending": (
            tr("Bending"),
            tr("Tip off the straight needle, by tissue or cameras; less than chance is shown as <"),
        ),
        "scans": (tr("Control scans"), tr("Scans taken in this attempt")),
    }


def figure_texts(figures: LiveFigures) -> dict[str, str]:
    """Return each read-out's text, by its key."""
    if figures.hidden:
        said = {"elapsed": clock_text(figures.elapsed), "scans": str(figures.scans)}
        return dict.fromkeys(_rows(), _EMPTY) | said

    def measured_mm(value: float) -> str:  # a guess is never said as if it were known
        return tr("{mm:.1f} mm", mm=1e3 * value) if figures.measured else "– ◇"

    return {
        "elapsed": clock_text(figures.elapsed),
        "depth": measured_mm(figures.depth),
        "angle": tr("{deg:.1f}°", deg=degrees(figures.angle_error)),
        "lateral": measured_mm(figures.lateral),
        "to_target": measured_mm(figures.to_target),
        "radius": radius_text(figures.radius),
        "bending": bending_text(figures.deflection, figures.deflection_sigma),
        "scans": str(figures.scans),
    }


def radius_text(radius: float | None) -> str:
    """Radius that holds the true tip with 95 % [m]; a dash while the tip is not measured."""
    return _EMPTY if radius is None else tr("± {mm:.1f} mm", mm=1e3 * radius)


def bending_text(deflection: float | None, sigma: float) -> str:
    """Say how far the tip is off the straight needle [m]; below three sigma, the bound."""
    if deflection is None:
        return _EMPTY
    if deflection > 3.0 * sigma:
        return tr("{mm:.1f} mm", mm=1e3 * deflection)
    return tr("< {mm:.1f} mm", mm=3e3 * sigma)


def clock_text(seconds: float) -> str:
    """Seconds as minutes and seconds: `1:07`."""
    whole = int(max(0.0, seconds))
    return f"{whole // 60}:{whole % 60:02d}"
