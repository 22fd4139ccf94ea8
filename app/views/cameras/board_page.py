"""A calibration board as a PDF at true size, with a ruler to check the print by."""

from pathlib import Path
from typing import Final

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF, QPointF, QRectF, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QPageLayout,
    QPageSize,
    QPainter,
    QPainterPath,
    QPdfWriter,
    QPen,
)
from PySide6.QtWidgets import QApplication

from app import __version__
from app.core.files import write_atomically
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.tracking.calibration.board_layout import EDGE_MM, RULER_MM, BoardSheet, Paper, lay_out
from app.tracking.calibration.boards import Board, dark_rectangles
from app.tracking.errors import CalibrationError
from app.views.kit.text import tr

_DPI: Final = 1200
_MM_PER_INCH: Final = 25.4
_INK: Final = QColor(0, 0, 0)
_TEXT_MM: Final = 3.2
_LINE_MM: Final = 0.2


def write_board(path: Path, board: Board, paper: Paper) -> BoardSheet:
    """Write the PDF, whole or not at all; works without a display.

    Raises:
        CalibrationError: if the board does not fit on the paper, or the file cannot be written.
    """
    sheet = lay_out(board, paper)
    # Text needs an application; the platform without a display is enough.
    # A QApplication, not a QGuiApplication: the process may open a window later.
    application = QApplication.instance() or QApplication(["acus", "-platform", "offscreen"])
    try:
        write_atomically(path, board_bytes(board, sheet))
    except OSError as error:
        raise CalibrationError(
            sentence(
                "the board cannot be written to {path}: {why}",
                path=path,
                why=error.strerror or error,
            )
        ) from error
    del application
    return sheet


def board_bytes(board: Board, sheet: BoardSheet) -> bytes:
    """Render the sheet as the bytes of a PDF."""
    data = QByteArray()
    buffer = QBuffer(data)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    writer = QPdfWriter(buffer)
    writer.setResolution(_DPI)
    across = QPageLayout.Orientation.Landscape if sheet.landscape else _PORTRAIT
    page = QPageSize(_PAGE_SIZES[sheet.paper.name])
    writer.setPageLayout(QPageLayout(page, across, QMarginsF(0, 0, 0, 0)))
    writer.setTitle(tr("Calibration board {spec}", spec=board.spec))
    writer.setCreator(f"Acus {__version__}")
    painter = QPainter(writer)
    paint_sheet(painter, board, sheet, _DPI / _MM_PER_INCH)
    painter.end()
    buffer.close()
    return bytes(data.data())


def paint_sheet(painter: QPainter, board: Board, sheet: BoardSheet, dots_per_mm: float) -> None:
    """Paint the sheet on anything that has `dots_per_mm`; the sheet's corner is the origin."""
    _paint_pattern(painter, board, sheet, dots_per_mm)
    top = sheet.y_mm + sheet.pattern_mm[1] + 6.0
    _paint_ruler(painter, sheet, top, dots_per_mm)
    _paint_text(painter, board, sheet, top + 6.5, dots_per_mm)


def _paint_pattern(painter: QPainter, board: Board, sheet: BoardSheet, dots_per_mm: float) -> None:
    """One path for all that is black: cells that touch leave no seam between them."""
    path = QPainterPath()
    path.setFillRule(Qt.FillRule.WindingFill)
    for x, y, width, height in dark_rectangles(board) / MILLIMETRE:
        path.addRect(
            QRectF(
                (sheet.x_mm + x) * dots_per_mm,
                (sheet.y_mm + y) * dots_per_mm,
                width * dots_per_mm,
                height * dots_per_mm,
            )
        )
    painter.fillPath(path, _INK)


def _paint_ruler(painter: QPainter, sheet: BoardSheet, top: float, dots_per_mm: float) -> None:
    """Paint a line of 100 mm with a stroke every 10 mm, to hold a real ruler against."""
    left = 0.5 * (sheet.width_mm - RULER_MM)
    painter.setPen(QPen(_INK, _LINE_MM * dots_per_mm, c=Qt.PenCapStyle.FlatCap))

    def line(x1: float, y1: float, x2: float, y2: float) -> None:
        painter.drawLine(
            QPointF(x1 * dots_per_mm, y1 * dots_per_mm), QPointF(x2 * dots_per_mm, y2 * dots_per_mm)
        )

    line(left, top + 4.0, left + RULER_MM, top + 4.0)
    for k in range(11):
        x = left + 10.0 * k
        line(x, top + (0.0 if k % 10 == 0 else 2.0), x, top + 4.0)


def _paint_text(
    painter: QPainter, board: Board, sheet: BoardSheet, top: float, dots_per_mm: float
) -> None:
    font = QFont("DejaVu Sans")
    font.setPixelSize(max(1, round(_TEXT_MM * dots_per_mm)))
    painter.setFont(font)
    painter.setPen(_INK)
    lines = (
        board.spec,
        tr(
            "Print at 100 %, not fitted to the page. The line above measures 100 mm: check it. "
            "Glue the sheet on something flat."
        ),
    )
    for i, words in enumerate(lines):
        box = QRectF(
            EDGE_MM * dots_per_mm,
            (top + 1.6 * _TEXT_MM * i) * dots_per_mm,
            (sheet.width_mm - 2.0 * EDGE_MM) * dots_per_mm,
            1.6 * _TEXT_MM * dots_per_mm,
        )
        painter.drawText(box, Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop, words)


_PORTRAIT: Final = QPageLayout.Orientation.Portrait
_PAGE_SIZES: Final = {
    "A4": QPageSize.PageSizeId.A4,
    "A3": QPageSize.PageSizeId.A3,
    "Letter": QPageSize.PageSizeId.Letter,
}
