"""The status strip: each part's health as symbol, words and colour."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from app.views.exercise.status_items import StatusItem, Verdict
from app.views.kit import theme
from app.views.kit.text import tr


class StatusStrip(QWidget):
    """Cells beside each other; their tooltips say what the value means and what to do."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._cells: list[StatusCell] = []
        self._row = QHBoxLayout(self)
        self._row.setContentsMargins(theme.MARGIN, 3, theme.MARGIN, 3)
        self._row.setSpacing(2 * theme.SPACING)
        self._row.addStretch(1)
        # Its height is kept while there is nothing to say, so that the panes stay where they are.
        cell = StatusCell(self)
        cell.show_item(StatusItem(Verdict.IDLE, tr("Status"), tr("Status"), ""))
        cell.ensurePolished()
        self.setMinimumHeight(cell.sizeHint().height() + 6)
        self._keep(cell)
        cell.hide()
        self.setAccessibleName(tr("Status"))

    def show_items(self, items: Sequence[StatusItem]) -> None:
        """Show these items in this order."""
        while len(self._cells) < len(items):
            self._keep(StatusCell(self))
        for i, cell in enumerate(self._cells):
            cell.setVisible(i < len(items))
            if i < len(items):
                cell.show_item(items[i])

    def _keep(self, cell: StatusCell) -> None:
        self._row.insertWidget(len(self._cells), cell)
        self._cells.append(cell)


class StatusCell(QWidget):
    """Symbol and title above the value."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._item: StatusItem | None = None
        self._title, self._text = QLabel(self), QLabel(self)
        for label in (self._title, self._text):
            label.setTextFormat(Qt.TextFormat.PlainText)
        self._text.setStyleSheet(f"font-size: {theme.SMALL_PX}px;")
        self._text.installEventFilter(self)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self._title)
        column.addWidget(self._text)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Take the room that the text needs in another size."""
        if watched is self._text and event.type() == QEvent.Type.FontChange:
            self._text.setMinimumWidth(self._text.sizeHint().width())
        return False

    def show_item(self, item: StatusItem) -> None:
        """Show an item; does nothing when it is the one shown."""
        if item == self._item:
            return
        colour, symbol = item.verdict.look
        if self._item is None or self._item.verdict is not item.verdict:
            self._title.setStyleSheet(
                f"color: {colour}; font-size: {theme.SMALL_PX}px; font-weight: 600;"
            )
        self._item = item
        self._title.setText(f"{symbol} {item.title}")
        self._text.setText(item.text)
        # The cell only ever grows, so that its neighbours do not dance with the digits.
        self._text.setMinimumWidth(max(self._text.minimumWidth(), self._text.sizeHint().width()))
        self.setToolTip(f"{item.title}: {item.text}\n\n{item.help}")
        self.setAccessibleName(f"{item.title}: {item.text}")

    @property
    def item(self) -> StatusItem | None:
        """What is shown."""
        return self._item
