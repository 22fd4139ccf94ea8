"""A slice pane: canvas, read-outs, mouse, keys and context menu of one plane."""

from __future__ import annotations

from PySide6.QtCore import QPoint, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QMenu, QVBoxLayout, QWidget

from app.views.slices.canvas import SliceCanvas
from app.views.slices.gestures import SliceGestures
from app.views.slices.panes import PANE_MARKS, PaneId
from app.views.slices.presets import default_window, keyed_window, menu_windows
from app.views.slices.readouts import Readouts
from app.views.slices.viewing import Tool, Viewing
from app.views.text import tr

_K = Qt.Key
PAGE = 10
"""Slices that the Page keys move."""


class SlicePane(QFrame):
    """Shows one plane of the viewing's volume and lets mouse and keys work on it.

    Signals:
        maximise_wanted(): double click.
    """

    maximise_wanted = Signal()

    def __init__(self, viewing: Viewing, pane: PaneId, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.viewing, self.pane = viewing, PaneId(pane)
        self.canvas = SliceCanvas(viewing, self.pane, self)
        self.readouts = Readouts(self.canvas)
        self.gestures = SliceGestures(self.canvas)
        self.canvas.gestures = self.gestures
        self.canvas.double_clicked.connect(self.maximise_wanted)
        self.gestures.hovered.connect(self.readouts.show_cursor)
        self.gestures.menu_wanted.connect(self.show_menu)
        viewing.tool_changed.connect(self._show_tool)
        self.setStyleSheet(f"SlicePane {{ border-top: 2px solid {PANE_MARKS[self.pane].colour}; }}")
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 2, 0, 0)
        layout.addWidget(self.canvas)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Scroll, choose a preset, fit or reset; other keys go to the window."""
        steps = {_K.Key_Up: 1, _K.Key_Right: 1, _K.Key_Down: -1, _K.Key_Left: -1,
                 _K.Key_PageUp: PAGE, _K.Key_PageDown: -PAGE}  # fmt: skip
        ends = {_K.Key_Home: -1e9, _K.Key_End: 1e9}
        key = _K(event.key())
        if key in steps:
            self.viewing.show_slice(self.pane, self.canvas.index + steps[key])
        elif key in ends:
            self.viewing.show_slice(self.pane, ends[key])
        elif key is _K.Key_Equal:
            self.canvas.fit()
        elif key is _K.Key_Space:
            self.reset()
        elif key is _K.Key_Escape and self.viewing.tool is not Tool.NAVIGATE:
            self.viewing.set_tool(Tool.NAVIGATE)
        elif window := keyed_window(key - _K.Key_0):
            self.viewing.set_window(window)
        else:
            super().keyPressEvent(event)

    def reset(self) -> None:
        """Fit the image and go back to the window that was there at first."""
        self.canvas.fit()
        self.viewing.set_window(default_window())

    def show_menu(self, place: QPoint) -> None:
        """Open the context menu at a point of the screen."""
        menu = self.build_menu()
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        menu.popup(place)

    def build_menu(self) -> QMenu:
        """Return the presets and what else the mouse's place offers."""
        menu = QMenu(self)
        for name, key, window in menu_windows(self.viewing.volume):
            action = menu.addAction(f"{name}  {window.width:g} / {window.level:g}\t{key}")
            action.triggered.connect(lambda _=False, w=window: self.viewing.set_window(w))
        menu.addSeparator()
        menu.addAction(tr("Fit to pane") + "\t=").triggered.connect(self.canvas.fit)
        menu.addAction(tr("Reset view") + "\t" + tr("Space")).triggered.connect(self.reset)
        menu.addAction(tr("Maximise or restore")).triggered.connect(self.maximise_wanted)
        return menu

    def _show_tool(self) -> None:
        placing = self.viewing.tool is not Tool.NAVIGATE
        shape = Qt.CursorShape.CrossCursor if placing else Qt.CursorShape.ArrowCursor
        self.canvas.viewport().setCursor(shape)
