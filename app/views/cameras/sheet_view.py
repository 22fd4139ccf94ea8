"""The sheet of paper with the board, small."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.core.errors import AcusError
from app.tracking.calibration.board_layout import PAPERS, lay_out
from app.tracking.calibration.boards import Board
from app.views.cameras.board_page import paint_sheet


class SheetView(QWidget):
    """The sheet of paper with the board, small."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._board: Board | None = None
        self._paper, self.fits = "A4", False
        self.setMinimumSize(260, 220)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def show_board(self, board: Board | None, paper: str) -> str:
        """Show a board on paper; returns why it does not fit, empty if it does."""
        self._board, self._paper, self.fits = board, paper, False
        self.update()
        if board is None:
            return ""
        try:
            lay_out(board, PAPERS[paper])
        except AcusError as error:
            return str(error)
        self.fits = True
        return ""

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the sheet."""
        if self._board is None or not self.fits:
            return
        sheet = lay_out(self._board, PAPERS[self._paper])
        scale = min(self.width() / sheet.width_mm, self.height() / sheet.height_mm) * 0.97
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.translate(
            0.5 * (self.width() - scale * sheet.width_mm),
            0.5 * (self.height() - scale * sheet.height_mm),
        )
        painter.fillRect(
            0, 0, round(scale * sheet.width_mm), round(scale * sheet.height_mm), QColor("white")
        )
        painter.setPen(Qt.PenStyle.NoPen)
        paint_sheet(painter, self._board, sheet, scale)
