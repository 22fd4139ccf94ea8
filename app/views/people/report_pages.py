"""Pages of a PDF that are filled from the top down: A4, upright or lying, vector text.

The foot of each page says which one it is; the first one says what the whole is not for.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF, QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetricsF,
    QPageLayout,
    QPageSize,
    QPainter,
    QPdfWriter,
    QPen,
)

from app import __version__
from app.views.debrief.report import DIM, HEIGHT, INK, MARGIN, RULE, WIDTH, font
from app.views.kit.text import disclaimer, tr

ROW: Final = 17.0
FOOT: Final = 26.0
_LYING_MARGIN: Final = 36.0


@dataclass(slots=True)
class ReportPages:
    """Pages that are filled from the top down.

    Attributes:
        painter: on the present page.
        next_page: begins another.
        title: repeated above every page but the first.
        pages: how many there will be; 0 while that is being counted.
        width, height: of a page [pt].
        margin: on every side [pt].
        page: number of the present one, from 1.
        y: where the page goes on [pt].
    """

    painter: QPainter
    next_page: Callable[[], object]
    title: str
    pages: int
    width: float = WIDTH
    height: float = HEIGHT
    margin: float = MARGIN
    page: int = 1
    y: float = MARGIN

    @property
    def inner(self) -> float:
        """Return the width between the margins [pt]."""
        return self.width - 2.0 * self.margin

    @property
    def bottom(self) -> float:
        """Return where the foot begins [pt]."""
        return self.height - self.margin - FOOT

    def metrics(self, used: QFont) -> QFontMetricsF:
        """Return the measures of a font on the page, which are not those on a screen."""
        return QFontMetricsF(used, self.painter.device())

    def advance(self, words: str, size: float, bold: bool = False) -> float:
        """Return how wide a line is [pt]."""
        return self.metrics(font(size, bold)).horizontalAdvance(words)

    def text(
        self,
        x: float,
        words: str,
        size: float = 9.5,
        colour: str = INK,
        bold: bool = False,
        width: float = 0.0,
    ) -> None:
        """Write a line at the present height; cut with dots where it is wider than `width`."""
        used = font(size, bold)
        if width > 0.0:
            words = self.metrics(used).elidedText(words, Qt.TextElideMode.ElideRight, width)
        self.painter.setFont(used)
        self.painter.setPen(QColor(colour))
        self.painter.drawText(QPointF(x, self.y), words)

    def paragraph(
        self, words: str, size: float = 9.5, colour: str = INK, left: float = 0.0
    ) -> None:
        """Write lines as wide as the page, and go on below."""
        used, width = font(size), self.inner - left
        wrap = int(Qt.TextFlag.TextWordWrap)
        box = self.metrics(used).boundingRect(QRectF(0.0, 0.0, width, 1e4), wrap, words)
        self.need(box.height() + 4.0)
        self.painter.setFont(used)
        self.painter.setPen(QColor(colour))
        place = QRectF(self.margin + left, self.y - 0.8 * size, width, box.height() + 2.0)
        self.painter.drawText(place, wrap, words)
        self.y += box.height() + 4.0

    def right(self, words: str, size: float = 8.0) -> None:
        """Write a line that ends at the right margin."""
        self.painter.setFont(font(size))
        width = self.painter.fontMetrics().horizontalAdvance(words)
        self.text(self.width - self.margin - width, words, size, DIM)

    def rule(self) -> None:
        """Draw a line across the page, below the present height."""
        self.painter.setPen(QPen(QColor(RULE), 0.6))
        y = self.y + 5.0
        self.painter.drawLine(QPointF(self.margin, y), QPointF(self.width - self.margin, y))

    def need(self, height: float) -> bool:
        """Begin another page unless so much [pt] is left on this one; tell whether one was."""
        if self.y + height <= self.bottom:
            return False
        self.turn()
        return True

    def turn(self) -> None:
        """Begin another page."""
        self.foot()
        self.next_page()
        self.page += 1
        self.y = self.margin + 8.0
        self.text(self.margin, self.title, 9.0, DIM, bold=True)
        self.rule()
        self.y += 24.0

    def foot(self) -> None:
        """Say at the bottom which page this is; on the first one also what it is not for."""
        self.y = self.height - self.margin - 4.0
        self.rule()
        self.y += 17.0
        if self.page == 1:
            self.text(self.margin, disclaimer(), 8.0, bold=True)
        words = tr("page {page} of {pages}", page=self.page, pages=self.pages or self.page)
        self.right(words)


def draw_pdf(fill: Callable[[ReportPages], None], title: str, lying: bool = False) -> bytes:
    """Draw twice, for how many pages there are is known after the first time; return the PDF.

    Args:
        fill: writes on a sheet, from its first page on.
        title: of the document, and above every page but the first.
        lying: whether pages are wider than high.
    """
    pages, data = 0, QByteArray()
    way = QPageLayout.Orientation.Landscape if lying else QPageLayout.Orientation.Portrait
    width, height = (HEIGHT, WIDTH) if lying else (WIDTH, HEIGHT)
    for _ in range(2):
        data = QByteArray()
        buffer = QBuffer(data)
        buffer.open(QIODevice.OpenModeFlag.WriteOnly)
        writer = QPdfWriter(buffer)
        writer.setResolution(72)  # one unit of the painter is one point
        size = QPageSize(QSizeF(WIDTH, HEIGHT), QPageSize.Unit.Point)
        writer.setPageLayout(QPageLayout(size, way, QMarginsF(0.0, 0.0, 0.0, 0.0)))
        writer.setTitle(title)
        writer.setCreator(f"Acus {__version__}")
        painter = QPainter(writer)
        margin = _LYING_MARGIN if lying else MARGIN
        sheet = ReportPages(painter, writer.newPage, title, pages, width, height, margin)
        try:
            fill(sheet)
            sheet.foot()
        finally:
            painter.end()
            buffer.close()
        pages = sheet.page
    return bytes(data.data())
