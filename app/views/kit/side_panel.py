"""Panels beside the panes, one at a time: their names in rows of buttons, none hidden or cut."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import (
    QButtonGroup,
    QFrame,
    QGridLayout,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from app.views.kit.wheel import wheel_scrolls

IN_A_ROW = 4
"""Names in a row: more would be cut at the panel's width."""


class SidePanel(QWidget):
    """Shows one of several panels; a tab widget whose names wrap instead of scrolling away.

    Signals:
        changed(int): another panel is shown.
    """

    changed = Signal(int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._buttons = QButtonGroup(self)
        self._buttons.idClicked.connect(self.setCurrentIndex)
        self._names = QGridLayout()
        self._names.setSpacing(0)
        self._panels = QStackedWidget(self)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(self._names)
        column.addWidget(self._panels, 1)

    def addTab(self, panel: QWidget, name: str, scrolls: bool = False) -> int:
        """Take one more panel; returns its index.

        Args:
            panel: to add.
            name: on its button.
            scrolls: whether it scrolls up and down where there is too little room.
        """
        index = self._panels.addWidget(scrolled(panel, self._panels) if scrolls else panel)
        button = QPushButton(name, self)
        button.setObjectName("side-name")
        button.setCheckable(True)
        button.setChecked(index == 0)
        button.setFlat(True)
        # A click that took the focus would take the arrows from the needle in an attempt.
        button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        button.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self._buttons.addButton(button, index)
        self._spread()
        return index

    def _spread(self) -> None:
        """Share the names among as few rows as they need, as evenly as they go."""
        rows = -(-self.count() // IN_A_ROW)
        columns = -(-self.count() // rows)
        for index, button in enumerate(self._buttons.buttons()):
            self._names.addWidget(button, index // columns, index % columns)
        for column in range(IN_A_ROW):
            self._names.setColumnStretch(column, 1 if column < columns else 0)

    def count(self) -> int:
        """Return the number of panels."""
        return self._panels.count()

    def currentIndex(self) -> int:
        """Return the index of the panel that is shown."""
        return self._panels.currentIndex()

    def currentWidget(self) -> QWidget | None:
        """Return the panel that is shown."""
        return self._panels.currentWidget()

    def setCurrentIndex(self, index: int) -> None:
        """Show another panel."""
        self._panels.setCurrentIndex(index)
        self._buttons.button(index).setChecked(True)
        self.changed.emit(index)

    def setCurrentWidget(self, panel: QWidget) -> None:
        """Show a panel that was added, or the one that it is in."""
        for index in range(self.count()):
            there = self._panels.widget(index)
            if there is not None and (there is panel or there.isAncestorOf(panel)):
                self.setCurrentIndex(index)

    def names(self) -> tuple[str, ...]:
        """Names of the panels in their order."""
        return tuple(button.text() for button in self._buttons.buttons())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Go to the next or the previous panel with Ctrl and the Page keys."""
        step = {Qt.Key.Key_PageDown: 1, Qt.Key.Key_PageUp: -1}.get(Qt.Key(event.key()), 0)
        if step and event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            self.setCurrentIndex((self.currentIndex() + step) % self.count())
        else:
            super().keyPressEvent(event)


def scrolled(panel: QWidget, parent: QWidget | None = None) -> QScrollArea:
    """Return a panel in an area that scrolls up and down where there is too little room."""
    area = QScrollArea(parent)
    area.setFrameShape(QFrame.Shape.NoFrame)
    area.setWidgetResizable(True)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    area.setWidget(panel)
    wheel_scrolls(panel)
    return area
