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
        self._there: list[int] | None = None  # None: all of them
        self._named = True
        self._names = QGridLayout()
        self._names.setSpacing(0)
        self._panels = QStackedWidget(self)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(self._names)
        column.addWidget(self._panels, 1)
        self._column = column

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
        there = self.there
        rows = max(1, -(-len(there) // IN_A_ROW))
        columns = -(-len(there) // rows)
        for index, button in enumerate(self._buttons.buttons()):
            self._names.removeWidget(button)
            button.setVisible(self._named and index in there)
            if index in there:
                place = there.index(index)
                self._names.addWidget(button, place // columns, place % columns)
        for column in range(IN_A_ROW):
            self._names.setColumnStretch(column, 1 if column < columns else 0)

    @property
    def there(self) -> list[int]:
        """Return the indices of the panels that can be shown."""
        return list(range(self.count())) if self._there is None else self._there

    def set_there(self, there: list[int], named: bool = True) -> None:
        """Let only these panels be shown, with their names or without."""
        if there == self.there and named == self._named:
            return
        self._there, self._named = there, named
        self._spread()
        if there and self.currentIndex() not in there:
            self.setCurrentIndex(there[0])

    def end_with(self, widget: QWidget) -> None:
        """Let a widget stand below the panels, whichever is shown."""
        self._column.addWidget(widget)

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

    def is_shown(self, panel: QWidget) -> bool:
        """Return whether a panel, or the one that it is in, is the one that is shown."""
        return _holds(self.currentWidget(), panel)

    def setCurrentWidget(self, panel: QWidget) -> None:
        """Show a panel that was added, or the one that it is in."""
        for index in range(self.count()):
            if _holds(self._panels.widget(index), panel) and index in self.there:
                self.setCurrentIndex(index)

    def names(self) -> tuple[str, ...]:
        """Names of the panels in their order."""
        buttons = self._buttons.buttons()
        return tuple(buttons[index].text() for index in self.there) if self._named else ()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Go to the next or the previous panel with Ctrl and the Page keys."""
        step = {Qt.Key.Key_PageDown: 1, Qt.Key.Key_PageUp: -1}.get(Qt.Key(event.key()), 0)
        if step and event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            there = self.there if self._named else []
            if self.currentIndex() in there:
                self.setCurrentIndex(there[(there.index(self.currentIndex()) + step) % len(there)])
        else:
            super().keyPressEvent(event)


def _holds(outer: QWidget | None, panel: QWidget) -> bool:
    return outer is not None and (outer is panel or outer.isAncestorOf(panel))


def scrolled(panel: QWidget, parent: QWidget | None = None) -> QScrollArea:
    """Return a panel in an area that scrolls up and down where there is too little room."""
    area = QScrollArea(parent)
    area.setFrameShape(QFrame.Shape.NoFrame)
    area.setWidgetResizable(True)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    area.setWidget(panel)
    wheel_scrolls(panel)
    return area
