"""Where messages and progress appear: over the free end of the menu bar, so that nothing moves.

A bar that pushed the panes down would move the image under the mouse, in the middle of a drag.
"""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QMainWindow, QVBoxLayout, QWidget

GAP_PX = 12
NARROWEST_PX = 480
"""Where the menus leave less room the notices lie over them."""


class Notices(QWidget):
    """Stacks its parts from the top of the window and is there only while one of them is."""

    def __init__(self, window: QMainWindow, parts: tuple[QWidget, ...]) -> None:
        super().__init__(window)
        self._window, self._parts = window, parts
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self._column = column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        for part in parts:
            column.addWidget(part)
            part.installEventFilter(self)
        window.installEventFilter(self)
        self.place()

    def place(self) -> None:
        """Take the room right of the menus, as high as the notices need."""
        shown = [part for part in self._parts if not part.isHidden()]
        self.setVisible(bool(shown))
        if not shown:
            return
        bar = self._window.menuBar()
        ends = [bar.actionGeometry(action).right() for action in bar.actions()]
        left = max(ends, default=0) + GAP_PX
        if self._window.width() - left < NARROWEST_PX:
            left = 0
        width = self._window.width() - left
        column = self._column
        wraps = column.hasHeightForWidth()
        needed = column.totalHeightForWidth(width) if wraps else self.sizeHint().height()
        self.setGeometry(left, 0, width, max(bar.height(), needed))
        self.raise_()

    def event(self, event: QEvent) -> bool:
        """Follow the size that the parts ask for."""
        if event.type() is QEvent.Type.LayoutRequest:
            self.place()
        return super().event(event)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the window's size, and parts that come and go."""
        resized = watched is self._window and event.type() is QEvent.Type.Resize
        changed = event.type() in (QEvent.Type.ShowToParent, QEvent.Type.HideToParent)
        if resized or (changed and watched is not self._window):
            self.place()
        return False
