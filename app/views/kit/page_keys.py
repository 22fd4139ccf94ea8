"""The keys of a page, wherever the focus is in its window: a button of the frame has none of them.

A key goes to the widget with the focus and up from there; a page hears of it only if the focus is
within it. After a click on a button of the frame, the role's for one, a page's keys would be dead.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QLabel,
    QLineEdit,
    QMainWindow,
    QPlainTextEdit,
    QStackedWidget,
    QStatusBar,
    QTextEdit,
    QWidget,
)

_WITHOUT_KEYS: Final = (QAbstractButton, QMainWindow, QStackedWidget, QStatusBar, QLabel)
"""Widgets of a frame that want none of a page's keys: no text is written there, nothing chosen."""

_FIELDS: Final = (QLineEdit, QTextEdit, QPlainTextEdit, QAbstractSpinBox, QComboBox)
"""Keys that these leave to their parents are still theirs."""

_PRESSES: Final = (QEvent.Type.ShortcutOverride, QEvent.Type.KeyPress)


class PageKeys(QObject):
    """Brings a page its keys while it is shown and the focus is outside it.

    Args:
        page: whose keys they are; it owns this.
        has: returns whether a key is one of the page's now.
        take: does what the key says.
    """

    def __init__(
        self,
        page: QWidget,
        has: Callable[[QKeyEvent], bool],
        take: Callable[[QKeyEvent], None],
    ) -> None:
        super().__init__(page)
        self._page, self._has, self._take = page, has, take
        page.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Listen to the whole program while the page is shown; take its keys."""
        if watched is self._page:
            application = QApplication.instance()
            if application is not None and event.type() == QEvent.Type.Show:
                application.installEventFilter(self)
            elif application is not None and event.type() == QEvent.Type.Hide:
                application.removeEventFilter(self)
            return False
        if event.type() not in _PRESSES or not isinstance(event, QKeyEvent):
            return False
        if not (isinstance(watched, _WITHOUT_KEYS) and self._is_outside(watched)):
            return False
        if not self._has(event):
            return False
        event.accept()
        if event.type() == QEvent.Type.KeyPress:
            self._take(event)
        return True

    def _is_outside(self, widget: QWidget) -> bool:
        """Return whether a widget is of the page's window, not of the page, and nothing is open."""
        if QApplication.activeModalWidget() or QApplication.activePopupWidget():
            return False
        page = self._page
        if isinstance(QApplication.focusWidget(), _FIELDS):
            return False
        return widget.window() is page.window() and not page.isAncestorOf(widget)
