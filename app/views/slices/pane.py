"""A slice pane: canvas, read-outs, mouse, keys and context menu of one plane."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QPoint, Qt, Signal
from PySide6.QtGui import QColor, QKeyEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QFrame, QMenu, QVBoxLayout, QWidget

from app.views.kit import theme
from app.views.slices.bindings import digit
from app.views.slices.canvas import SliceCanvas
from app.views.slices.cine import Cine
from app.views.slices.gestures import SliceGestures
from app.views.slices.pane_actions import PaneActions
from app.views.slices.pane_menu import build_menu
from app.views.slices.panes import PANE_MARKS, PaneId, pane_name
from app.views.slices.presets import default_window, keyed_window
from app.views.slices.readouts import Readouts
from app.views.slices.viewing import Tool, Viewing

EDGE_PX = 2
"""Width of the ring about the pane that has the keyboard."""


class SlicePane(QFrame):
    """Shows one plane of the viewing's volume and lets mouse and keys work on it.

    Signals:
        maximise_wanted(): double click.
        leave_wanted(bool): the keyboard shall go to the next pane (True) or the previous one.

    Attributes:
        canvas, readouts, gestures, cine: its parts.
        actions_of: what its keys and its menu do.
    """

    maximise_wanted = Signal()
    leave_wanted = Signal(bool)

    def __init__(self, viewing: Viewing, pane: PaneId, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.viewing, self.pane = viewing, PaneId(pane)
        self.canvas = SliceCanvas(viewing, self.pane, self)
        self.readouts = Readouts(self.canvas)
        self.gestures, self.cine = SliceGestures(self.canvas), Cine(self.canvas)
        self.actions_of = PaneActions(self)
        self.menu_parts: list[Callable[[QMenu], None]] = []
        self.canvas.gestures = self.gestures
        self.canvas.double_clicked.connect(self.maximise_wanted)
        self.canvas.ctrl_double_clicked.connect(
            lambda: viewing.set_window(default_window(), self.pane)
        )
        self.gestures.hovered.connect(self.readouts.show_cursor)
        self.gestures.menu_wanted.connect(self.show_menu)
        self.cine.changed.connect(self.readouts.refresh)
        viewing.tool_changed.connect(self._show_tool)
        self.setAccessibleName(pane_name(self.pane))
        self.setFocusProxy(self.canvas)
        self.canvas.installEventFilter(self)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(EDGE_PX, EDGE_PX + 1, EDGE_PX, EDGE_PX)
        layout.addWidget(self.canvas)

    # --- keys ---------------------------------------------------------------------------------
    def event(self, event: QEvent) -> bool:
        """Claim one's own keys before the menus do."""
        if event.type() != QEvent.Type.ShortcutOverride or not isinstance(event, QKeyEvent):
            return super().event(event)
        own = self.viewing.scheme.action(event) is not None and not _is_shared(event)
        event.setAccepted(own)
        return own

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Do what the scheme says; other keys go to the window."""
        action, number = self.viewing.scheme.action(event), digit(event)
        if action is not None and self.actions_of.do(action):
            return
        window = None
        if number is not None:
            present = self.viewing.greys.of(self.pane)
            window = keyed_window(number, self.viewing.volume, present)
        if window is not None:
            self.viewing.set_window(window, self.pane)
        else:
            super().keyPressEvent(event)

    def reset(self) -> None:
        """Fit the image and go back to the window and the slice that were there at first."""
        self.actions_of.reset()

    # --- menu ---------------------------------------------------------------------------------
    def show_menu(self, place: QPoint) -> None:
        """Open the context menu at a point of the screen."""
        menu = self.build_menu()
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        menu.popup(place)

    def build_menu(self) -> QMenu:
        """Return the presets and what else the mouse's place offers."""
        menu = build_menu(self)
        for fill in self.menu_parts:
            fill(menu)
        return menu

    # --- looks --------------------------------------------------------------------------------
    def eventFilter(self, watched: object, event: QEvent) -> bool:
        """Show which pane has the keyboard."""
        if event.type() in (QEvent.Type.FocusIn, QEvent.Type.FocusOut):
            self.update()
        return False

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw a line of the plane's colour on top, and a white ring where the keyboard is."""
        painter = QPainter(self)
        ring = "#ffffff" if self.canvas.hasFocus() else theme.IMAGE_BACKGROUND
        painter.fillRect(self.rect(), QColor(ring))
        top = self.rect().adjusted(0, 0, 0, EDGE_PX + 1 - self.height())
        painter.fillRect(top, QColor(PANE_MARKS[self.pane].colour))

    def _show_tool(self) -> None:
        placing = self.viewing.tool is not Tool.NAVIGATE
        shape = Qt.CursorShape.CrossCursor if placing else Qt.CursorShape.ArrowCursor
        self.canvas.setCursor(shape)


def _is_shared(event: QKeyEvent) -> bool:
    """Whether an attempt's keys are the same, so that who is there for them decides."""
    return event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Escape)
