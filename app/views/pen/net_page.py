"""Cube or ring with its tabs, and the sheet, as a PDF at true size."""

from pathlib import Path
from typing import Final

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QLineF, QMarginsF, QPointF, QRectF, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QPageLayout,
    QPageSize,
    QPainter,
    QPdfWriter,
    QPen,
    QPolygonF,
)
from PySide6.QtWidgets import QApplication

from app import __version__
from app.core.files import write_atomically
from app.core.messages import sentence
from app.tracking.calibration.board_layout import RULER_MM, Paper
from app.tracking.pen.board import marker_cells
from app.tracking.pen.body import PenProfile
from app.tracking.pen.errors import PenError
from app.tracking.pen.net_layout import Face, Page, base_page, body_page
from app.views.kit.text import tr

_DPI: Final = 1200
_MM_PER_INCH: Final = 25.4
_INK: Final = QColor(0, 0, 0)
_FOLD: Final = QColor(150, 150, 150)
_TEXT_MM: Final = 3.0
_LINE_MM: Final = 0.15
_SIZES: Final = {
    "A4": QPageSize.PageSizeId.A4,
    "A3": QPageSize.PageSizeId.A3,
    "Letter": QPageSize.PageSizeId.Letter,
}


def write_pen(path: Path, pen: PenProfile, paper: Paper) -> tuple[Page, Page]:
    """Write both pages, whole or not at all; works without a display.

    Raises:
        PenError: if one does not fit on the paper, or the file cannot be written.
    """
    pages = (body_page(pen.body, paper), base_page(pen.base, paper))
    # Text needs an application; the platform without a display is enough.
    # A QApplication, not a QGuiApplication: the process may open a window later.
    application = QApplication.instance() or QApplication(["acus", "-platform", "offscreen"])
    try:
        write_atomically(path, pen_bytes(pen, pages, paper))
    except OSError as error:
        raise PenError(
            sentence(
                "{path} cannot be written: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    del application
    return pages


def pen_bytes(pen: PenProfile, pages: tuple[Page, Page], paper: Paper) -> bytes:
    """Render the pages as the bytes of a PDF."""
    data = QByteArray()
    buffer = QBuffer(data)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    writer = QPdfWriter(buffer)
    writer.setResolution(_DPI)
    writer.setPageLayout(_layout(pages[0], paper))
    writer.setTitle(tr("Pen {name}", name=pen.name))
    writer.setCreator(f"Acus {__version__}")
    painter = QPainter(writer)
    paint_page(painter, pages[0], _DPI / _MM_PER_INCH)
    writer.setPageLayout(_layout(pages[1], paper))
    writer.newPage()
    paint_page(painter, pages[1], _DPI / _MM_PER_INCH)
    painter.end()
    buffer.close()
    return bytes(data.data())


def _layout(page: Page, paper: Paper) -> QPageLayout:
    across = QPageLayout.Orientation
    return QPageLayout(
        QPageSize(_SIZES[paper.name]),
        across.Landscape if page.landscape else across.Portrait,
        QMarginsF(0, 0, 0, 0),
    )


def paint_page(painter: QPainter, page: Page, dots_per_mm: float) -> None:
    """Paint a page on anything that has `dots_per_mm`; the sheet's corner is the origin."""
    painter.save()
    painter.scale(dots_per_mm, dots_per_mm)
    for tab in page.tabs:
        painter.setPen(QPen(_FOLD, _LINE_MM))
        painter.drawPolyline(QPolygonF([QPointF(*point) for point in tab]))
    for face in page.faces:
        if page.outline:
            painter.setPen(QPen(_FOLD, _LINE_MM))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(QRectF(face.x, face.y, face.edge, face.edge))
        _paint_marker(painter, face, page.dictionary)
    painter.setPen(QPen(_FOLD, _LINE_MM))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for x, y, edge in page.blanks:
        painter.drawRect(QRectF(x, y, edge, edge))
    _paint_crosses(painter, page)
    _paint_ruler(painter, page)
    painter.restore()
    _paint_text(painter, page, dots_per_mm)


def _paint_marker(painter: QPainter, face: Face, dictionary: str) -> None:
    """Paint the dark cells; runs in a row are one rectangle, so that no seam shows."""
    cells = marker_cells(dictionary, face.id)
    size = face.marker / len(cells)
    left, top = face.marker_corner
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(_INK)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
    for row, white in enumerate(cells.tolist()):
        start = 0
        while start < len(white):
            end = start
            while end < len(white) and not white[end]:
                end += 1
            if end > start:
                x, y = left + start * size, top + row * size
                painter.drawRect(QRectF(x, y, (end - start) * size, size))
            start = end + 1
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)


def _paint_crosses(painter: QPainter, page: Page) -> None:
    """Paint where the shaft goes through, white below black: seen on either."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for colour, thick in ((QColor(255, 255, 255), 0.5), (_INK, 0.2)):
        painter.setPen(QPen(colour, thick))
        for x, y, half, radius in page.crosses:
            painter.drawLine(QLineF(x - half, y, x + half, y))
            painter.drawLine(QLineF(x, y - half, x, y + half))
            if radius > 0.0:
                painter.drawEllipse(QPointF(x, y), radius, radius)


def _paint_ruler(painter: QPainter, page: Page) -> None:
    left, top = 0.5 * (page.width - RULER_MM), page.bottom + 5.0
    painter.setPen(QPen(_INK, 0.2))
    painter.drawLine(QLineF(left, top, left + RULER_MM, top))
    for tick in range(0, int(RULER_MM) + 1, 10):
        high = 3.0 if tick % 50 == 0 else 2.0
        painter.drawLine(QLineF(left + tick, top, left + tick, top + high))


def _paint_text(painter: QPainter, page: Page, dots_per_mm: float) -> None:
    font = QFont()
    font.setPixelSize(max(1, round(_TEXT_MM * dots_per_mm)))
    painter.setFont(font)
    painter.setPen(_INK)
    text = tr(
        "Print at 100 %, not “fit to page”: the line is 100 mm, a black square {side:.1f} mm; "
        "{how}.",
        side=page.faces[0].marker,
        how=_how(page),
    )
    scaled = QRectF(
        8.0 * dots_per_mm,
        (page.bottom + 9.0) * dots_per_mm,
        (page.width - 16.0) * dots_per_mm,
        10.0 * dots_per_mm,
    )
    flags = Qt.AlignmentFlag.AlignHCenter | Qt.TextFlag.TextWordWrap
    painter.drawText(scaled, int(flags), text)


def _how(page: Page) -> str:
    if not page.outline:
        return tr("lay it on a box and punch the cross: the shaft goes through it")
    if page.across > 0.0:
        return tr(
            "cut, fold along the lines and close it round two discs of cardboard, {across:.0f} mm "
            "from side to side; the shaft goes through their middles",
            across=page.across,
        )
    return tr(
        "cut along the outside, fold along the lines, glue the tabs inside; the shaft goes through "
        "both crosses"
    )
