"""Small parts that pages and dialogs are made of: title, text, button, bar, table."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QLabel,
    QProgressBar,
    QPushButton,
    QTableWidget,
    QVBoxLayout,
    QWidget,
)

from app.views.kit import theme


def column(page: QWidget, title: str, spacing: int = theme.SPACING) -> QVBoxLayout:
    """Return a page's column, its title on top."""
    rows = QVBoxLayout(page)
    rows.setContentsMargins(theme.MARGIN, 0, 0, 0)
    rows.setSpacing(spacing)
    heading = QLabel(title, page)
    heading.setProperty("role", "title")
    rows.addWidget(heading)
    return rows


def label(text: str = "", role: str = "") -> QLabel:
    """Return a label of plain text that wraps."""
    made = QLabel(text)
    made.setWordWrap(True)
    made.setTextFormat(Qt.TextFormat.PlainText)
    if role:
        made.setProperty("role", role)
    return made


def button(text: str, role: str = "") -> QPushButton:
    """Return a button that Enter does not press by itself."""
    made = QPushButton(text)
    made.setAutoDefault(False)
    if role:
        made.setProperty("role", role)
    return made


FRAME = QSize(16, 48)
"""About what a desktop draws round a window: border and title bar [px]."""


def size_dialog(dialog: QWidget, width: int, height: int) -> None:
    """Give a dialog a size [px], or what of it the screen has room for with a title bar."""
    dialog.resize(QSize(width, height).boundedTo(dialog.screen().availableSize() - FRAME))


def thin_bar() -> QProgressBar:
    """Return a bar of progress, 0 to 1000, without words."""
    made = QProgressBar()
    made.setRange(0, 1000)
    made.setTextVisible(False)
    made.setFixedHeight(10)
    return made


def table(titles: tuple[str, ...], selectable: bool = False) -> QTableWidget:
    """Return a table to read; `selectable` lets whole rows be chosen, one at a time."""
    made = QTableWidget(0, len(titles))
    made.setHorizontalHeaderLabels(titles)
    made.verticalHeader().setVisible(False)
    made.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
    mode = QAbstractItemView.SelectionMode
    made.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
    made.setSelectionMode(mode.SingleSelection if selectable else mode.NoSelection)
    made.setShowGrid(False)
    header = made.horizontalHeader()
    header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
    header.setStretchLastSection(True)
    header.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
    return made
