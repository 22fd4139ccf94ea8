"""A pyqtgraph view that hands its mouse to somebody else and nothing to pyqtgraph's own."""

from __future__ import annotations

from typing import Protocol

import pyqtgraph
from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QWidget

from app.views.kit import theme


class Gestures(Protocol):
    """What the canvas hands its mouse events to."""

    def press(self, event: QMouseEvent) -> None:
        """Take a button that went down."""

    def move(self, event: QMouseEvent) -> None:
        """Take a move, with or without a button."""

    def release(self, event: QMouseEvent) -> None:
        """Take a button that went up."""

    def wheel(self, event: QWheelEvent) -> None:
        """Take a turn of the wheel."""


class MouseView(pyqtgraph.GraphicsView):
    """Hands over what the mouse does, and leaves the keys to the pane.

    Attributes:
        gestures: who takes it; nobody at first.

    Signals:
        left(): the mouse left the pane.
        double_clicked(): for maximising.
        ctrl_double_clicked(): for the window that there was at first.
    """

    left = Signal()
    double_clicked = Signal()
    ctrl_double_clicked = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent, useOpenGL=False, background=theme.IMAGE_BACKGROUND)
        self.gestures: Gestures | None = None

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Hand over."""
        if self.gestures is not None:
            self.gestures.press(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Hand over."""
        if self.gestures is not None:
            self.gestures.move(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Hand over."""
        if self.gestures is not None:
            self.gestures.release(event)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Hand over."""
        if self.gestures is not None:
            self.gestures.wheel(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Ask to be maximised or restored; with Ctrl for the first window."""
        if event.button() is Qt.MouseButton.LeftButton:
            ctrl = event.modifiers() & Qt.KeyboardModifier.ControlModifier
            (self.ctrl_double_clicked if ctrl else self.double_clicked).emit()

    def leaveEvent(self, event: QEvent) -> None:
        """Tell the read-outs."""
        self.left.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Leave the keys to the pane."""
        event.ignore()

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        """Leave the keys to the pane."""
        event.ignore()
