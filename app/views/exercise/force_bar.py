"""A bar for the force felt at the hand, with the limit and what can be had here marked."""

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.views.exercise.felt import Felt, GuidanceLimit, force_words, origin_help
from app.views.kit import theme
from app.views.kit.text import tr

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

    @property
    def words(self) -> str:
        """Force and where it comes from, or that it is a bound, as written under the bar."""
        return force_words(Felt(self._force, self._measured, self._at_most))

    def _explain(self) -> None:
        line = tr("The line is the largest force the device may give now.")
        here = f" {self.guidance}." if self._guidance is not None else ""
        self.setToolTip(f"{origin_help(self._measured, self._at_most)} {line}{here}")

    @property
    def words_of_guidance(self) -> str:
        """How much guidance there is here, as written below the force; empty if all of it."""
        return self._guidance.words if self._guidance is not None else ""

    @property
    def guidance(self) -> str:
        """What holds the force below the limit here, with the reason; empty if nothing."""
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
        painter.drawText(below, Qt.AlignmentFlag.AlignLeft, f"{symbol} {self.words}")
        painter.setPen(QColor(theme.TEXT_DIM))
        limit = tr("limit {limit:g} N", limit=self._limit)
        painter.drawText(below, Qt.AlignmentFlag.AlignRight, limit)
        if self._guidance is not None:
            painter.setPen(QColor(theme.VERDICTS["warning"][0]))
            words = painter.fontMetrics().elidedText(
                self.words_of_guidance, Qt.TextElideMode.ElideRight, self.width()
            )
            painter.drawText(below.translated(0, 19), Qt.AlignmentFlag.AlignLeft, words)
