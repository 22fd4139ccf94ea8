"""A dialog that leads from step to step: the list of steps, the page of one, Back and Next."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtGui import QColor
from PySide6.QtWidgets import (
    QDialog,
    QHBoxLayout,
    QListWidget,
    QListWidgetItem,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from app.views.kit import theme
from app.views.kit.parts import button, size_dialog
from app.views.kit.text import literal, tr
from app.views.kit.verdict import Verdict


class Wizard(QDialog):
    """The frame of a wizard; what its steps are, and how they stand, is the subclass'.

    A subclass adds its pages, calls `show_page(0)`, and `refresh` whenever a step has changed.

    Args:
        title: of the dialog.
        size: of the dialog at the usual text size [px].
        list_width: of the list of steps [px].
        parent: window.
    """

    def __init__(
        self, title: str, size: tuple[int, int], list_width: int, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        size_dialog(self, theme.px(size[0]), size[1])
        self.list, self.pages = QListWidget(self), QStackedWidget(self)
        self.list.setAccessibleName(title)
        self.back, self.next = button(tr("Back")), button(tr("Next"))
        self._lay_out(list_width)
        self.list.currentRowChanged.connect(self.show_page)
        self.back.clicked.connect(lambda: self.show_page(self.pages.currentIndex() - 1))
        self.next.clicked.connect(self._go_on)

    def add_pages(self, pages: Sequence[QWidget]) -> None:
        """Add steps at the end."""
        for page in pages:
            self.pages.addWidget(page)
            self.list.addItem(QListWidgetItem())

    def show_page(self, number: int) -> None:
        """Go to a page; one that works keeps it."""
        if self.busy:
            number = self.pages.currentIndex()
        number = min(max(number, 0), self.pages.count() - 1)
        self.pages.setCurrentIndex(number)
        self.list.setCurrentRow(number)
        self.enter(number)
        self.refresh()

    def refresh(self) -> None:
        """Mark the steps in the list, and say what Back and Next do."""
        for row, (verdict, title) in enumerate(self.marks()):
            colour, symbol = verdict.colour_and_symbol
            item = self.list.item(row)
            item.setText(f"{symbol} {title}")
            item.setForeground(QColor(colour))
        here, busy = self.pages.currentIndex(), self.busy
        lacks = self.lacks(here)
        self.back.setEnabled(here > 0 and not busy)
        self.next.setEnabled(not busy and not lacks)
        self.next.setToolTip(literal(lacks))
        self.next.setText(tr("Close") if here == self.pages.count() - 1 else tr("Next"))
        self.list.setEnabled(not busy)

    # --- what a subclass says -------------------------------------------------------------------
    @property
    def busy(self) -> bool:
        """Return whether a step works; it keeps its page until it ends."""
        return False

    def marks(self) -> Sequence[tuple[Verdict, str]]:
        """Return how each step stands, and its title."""
        raise NotImplementedError

    def enter(self, number: int) -> None:
        """Prepare a page that is shown now."""

    def lacks(self, number: int) -> str:
        """Say what a page must have before the next one makes sense; empty if it has it."""
        return ""

    def finish(self) -> None:
        """Close after the last page."""
        self.accept()

    # --- inside ---------------------------------------------------------------------------------
    def _go_on(self) -> None:
        here = self.pages.currentIndex()
        if here == self.pages.count() - 1:
            self.finish()
        else:
            self.show_page(here + 1)

    def _lay_out(self, list_width: int) -> None:
        self.list.setFixedWidth(list_width)
        row = QHBoxLayout()
        row.addWidget(self.list)
        row.addWidget(self.pages, 1)
        buttons = QHBoxLayout()
        buttons.addStretch(1)
        for one in (self.back, self.next):
            buttons.addWidget(one)
        column = QVBoxLayout(self)
        column.setContentsMargins(theme.MARGIN, theme.MARGIN, theme.MARGIN, theme.MARGIN)
        column.addLayout(row, 1)
        column.addLayout(buttons)
