"""A slice pane: canvas, read-outs, mouse, keys, context menu and cine of one plane.

Cine: the slices run by themselves, there and back, until something is touched.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from PySide6.QtCore import QEvent, QObject, QPoint, QPointF, Qt, QTimer, Signal
from PySide6.QtGui import QAction, QColor, QHelpEvent, QKeyEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QFrame, QInputDialog, QMenu, QVBoxLayout, QWidget

from app.views.kit import theme
from app.views.kit.text import literal, tr
from app.views.slices.bindings import Action, digit
from app.views.slices.canvas import SliceCanvas
from app.views.slices.gestures import ZOOM_PER_NOTCH, SliceGestures, thicken
from app.views.slices.panes import PANE_MARKS, PaneId, pane_name
from app.views.slices.presentation import KINDS, Slab, Turn, kind_name
from app.views.slices.presets import default_window, keyed_window, menu_windows
from app.views.slices.readouts import Readouts
from app.views.slices.slab import as_point
from app.views.slices.viewing import Tool, Viewing

RATES = (5, 10, 15, 25)
"""Slices a second to choose from."""

_ENDS_IT = (
    QEvent.Type.MouseButtonPress,
    QEvent.Type.Wheel,
    QEvent.Type.KeyPress,
    QEvent.Type.Hide,
)


class Cine(QObject):
    """Scrolls one canvas.

    Signals:
        changed(): it began or ended.
    """

    changed = Signal()

    def __init__(self, canvas: SliceCanvas) -> None:
        super().__init__(canvas)
        self._canvas, self._step = canvas, 1
        self._timer = QTimer(self)
        self._timer.timeout.connect(self.advance)
        self.set_rate(RATES[1])
        canvas.viewing.volume_changed.connect(self.stop)

    @property
    def is_running(self) -> bool:
        """Return whether the slices run."""
        return self._timer.isActive()

    @property
    def rate(self) -> int:
        """Slices a second."""
        return round(1000 / self._timer.interval())

    def set_rate(self, rate: int) -> None:
        """Run at so many slices a second."""
        self._timer.setInterval(round(1000 / rate))

    def toggle(self) -> None:
        """Begin or end."""
        if self.is_running:
            self.stop()
        elif self._canvas.plane is not None:
            self._watch(True)
            self._timer.start()
            self.changed.emit()

    def stop(self) -> None:
        """End; idempotent."""
        if self.is_running:
            self._watch(False)
            self._timer.stop()
            self.changed.emit()

    def _watch(self, on: bool) -> None:
        """See what is pressed while it runs; else every event would come by here for nothing."""
        canvas = self._canvas
        (canvas.installEventFilter if on else canvas.removeEventFilter)(self)

    def advance(self) -> None:
        """Go one slice on; turn round at the ends of the volume."""
        before = self._canvas.index
        for step in (self._step, -self._step):
            self._canvas.viewing.show_slice(self._canvas.pane, before + step)
            self._step = step
            if self._canvas.index != before:
                return
        self.stop()  # there is one slice only

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Any button, wheel or key ends it, and does what it always does."""
        if event.type() in _ENDS_IT:
            self.stop()
        return False


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
        """Show which pane has the keyboard, and the whole of read-outs that are cut."""
        if event.type() in (QEvent.Type.FocusIn, QEvent.Type.FocusOut):
            self.update()
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            return self.readouts.explain(event)
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
    """Return whether an attempt's keys are the same, so that who is there for them decides."""
    return event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Escape)


# --- keys ----------------------------------------------------------------------------------------
PAGE = 10
"""Slices that the Page keys move."""

NUDGE_MM = 1.0
"""How far a key moves the crosshair."""

END = 1e9


class PaneActions:
    """Carries out the actions of one pane."""

    def __init__(self, pane: SlicePane) -> None:
        self._pane = pane
        scroll, zoom, nudge = self._scroll, self._zoom, self._nudge
        self._table: dict[Action, Callable[[], object]] = {
            Action.NEXT: lambda: scroll(1),
            Action.PREVIOUS: lambda: scroll(-1),
            Action.TEN_ON: lambda: scroll(PAGE),
            Action.TEN_BACK: lambda: scroll(-PAGE),
            Action.FIRST: lambda: scroll(-END),
            Action.LAST: lambda: scroll(END),
            Action.ZOOM_IN: lambda: zoom(1),
            Action.ZOOM_OUT: lambda: zoom(-1),
            Action.FIT: pane.canvas.fit,
            Action.RESET: self.reset,
            Action.ZOOM_TOOL: self._zoom_tool,
            Action.INVERT: self.invert,
            Action.TURN_RIGHT: lambda: self.turn(1),
            Action.TURN_LEFT: lambda: self.turn(-1),
            Action.MIRROR: lambda: self.mirror(False),
            Action.MIRROR_UPRIGHT: lambda: self.mirror(True),
            Action.SLAB_KIND: self.next_kind,
            Action.THICKER: lambda: thicken(pane.canvas, 1),
            Action.THINNER: lambda: thicken(pane.canvas, -1),
            Action.CINE: pane.cine.toggle,
            Action.PANE_ON: lambda: pane.leave_wanted.emit(True),
            Action.PANE_BACK: lambda: pane.leave_wanted.emit(False),
            Action.MAXIMISE: pane.maximise_wanted.emit,
            Action.LEFT: lambda: nudge(-1, 0),
            Action.RIGHT: lambda: nudge(1, 0),
            Action.UP: lambda: nudge(0, -1),
            Action.DOWN: lambda: nudge(0, 1),
            Action.MENU: self._menu,
        }

    def do(self, action: Action) -> bool:
        """Carry it out; False if it means nothing now and the key is somebody else's."""
        viewing = self._pane.viewing
        if action is Action.CANCEL:
            return self._cancel()
        if action is Action.PLACE:
            return self._place()
        if viewing.volume is not None or action in (Action.PANE_ON, Action.PANE_BACK):
            self._table[action]()
        return True

    # --- slices, zoom, crosshair --------------------------------------------------------------
    def _scroll(self, slices: float) -> None:
        canvas = self._pane.canvas
        canvas.viewing.show_slice(canvas.pane, canvas.index + slices)

    def _zoom(self, steps: int) -> None:
        canvas = self._pane.canvas
        x, y = canvas.plane_at(QPointF(canvas.rect().center()))
        canvas.set_camera(canvas.camera.zoomed(ZOOM_PER_NOTCH**steps, x, y))

    def _nudge(self, right: int, down: int) -> None:
        canvas, viewing = self._pane.canvas, self._pane.viewing
        if canvas.plane is not None:
            at = canvas.plane.point(viewing.cursor_mm, canvas.index)
            x, y = at.x + right * NUDGE_MM, at.y + down * NUDGE_MM
            viewing.set_cursor(canvas.plane.lps_mm(x, y, canvas.index))

    def _zoom_tool(self) -> None:
        self._pane.viewing.left_zooms = not self._pane.viewing.left_zooms

    def _cancel(self) -> bool:
        viewing = self._pane.viewing
        going = (
            viewing.tool is not Tool.NAVIGATE or viewing.left_zooms or self._pane.cine.is_running
        )
        viewing.left_zooms = False
        viewing.set_tool(Tool.NAVIGATE)
        self._pane.cine.stop()
        return going

    def _place(self) -> bool:
        """Place entry or target at the crosshair, without a mouse."""
        viewing = self._pane.viewing
        if viewing.tool is Tool.NAVIGATE:
            return False
        viewing.point_refused, viewing.clicked_pane = False, self._pane.pane
        viewing.point_placed.emit(viewing.tool, as_point(viewing.cursor_mm), True)
        if not viewing.point_refused:
            viewing.set_tool(Tool.NAVIGATE)
        return True

    # --- greys, slab, turn --------------------------------------------------------------------
    def reset(self) -> None:
        """Fit the image, one slice thick, in the window that was there at first."""
        viewing, pane = self._pane.viewing, self._pane.pane
        viewing.set_presentation(pane, replace(viewing.presentation(pane), slab=Slab()))
        self._pane.canvas.fit()
        if not viewing.greys.is_locked:
            viewing.set_window(default_window(), pane)

    def invert(self) -> None:
        """Swap bright and dark in all panes."""
        greys = self._pane.viewing.greys
        greys.set_inverted(not greys.is_inverted)

    def turn(self, quarters: int) -> None:
        """Turn what is seen clockwise."""
        self._take_turn(self._turn.turned(quarters))

    def mirror(self, upright: bool) -> None:
        """Swap left and right, or top and bottom."""
        self._take_turn(self._turn.flipped(upright))

    def upright(self) -> None:
        """Turn back to the radiological convention."""
        self._take_turn(Turn())

    def next_kind(self) -> None:
        """Project the slab in the next way."""
        self.take_slab(self._slab.next_kind())

    def take_slab(self, slab: Slab) -> None:
        """Look at another slab."""
        viewing, pane = self._pane.viewing, self._pane.pane
        viewing.set_presentation(pane, replace(viewing.presentation(pane), slab=slab))

    @property
    def _turn(self) -> Turn:
        return self._pane.viewing.presentation(self._pane.pane).turn

    @property
    def _slab(self) -> Slab:
        return self._pane.viewing.presentation(self._pane.pane).slab

    def _take_turn(self, turn: Turn) -> None:
        viewing, pane = self._pane.viewing, self._pane.pane
        viewing.set_presentation(pane, replace(viewing.presentation(pane), turn=turn))

    def _menu(self) -> None:
        canvas = self._pane.canvas
        self._pane.show_menu(canvas.mapToGlobal(canvas.rect().center()))


# --- context menu --------------------------------------------------------------------------------
THICKNESSES_MM = (0.0, 3.0, 5.0, 10.0, 20.0, 40.0)


def fill_windows(menu: QMenu, pane: SlicePane) -> None:
    """Add every window with its key; they cannot be chosen while they are locked."""
    greys = pane.viewing.greys
    for name, key, window in menu_windows(pane.viewing.volume, greys.kept):
        action = menu.addAction(f"{name}  {window.width:g} / {window.level:g}\t{key}")
        action.setEnabled(not greys.is_locked)
        action.triggered.connect(lambda _=False, w=window: pane.viewing.set_window(w, pane.pane))


def build_menu(pane: SlicePane) -> QMenu:
    """Return the menu of a pane as things are now."""
    menu, greys = QMenu(pane), pane.viewing.greys
    fill_windows(menu, pane)
    _entry(menu, tr("Keep this window…"), lambda: _ask_name(pane))
    if greys.kept:
        forget = menu.addMenu(tr("Forget a kept window"))
        for name in greys.kept:
            _entry(forget, name, partial(greys.forget, name))
    menu.addSeparator()
    _switch(menu, tr("Invert grey") + "\tI", greys.is_inverted, pane.actions_of.invert)
    _switch(
        menu,
        tr("One window for all panes"),
        greys.is_linked,
        lambda: greys.set_linked(not greys.is_linked),
    )
    lock = _switch(
        menu,
        tr("Lock window and level"),
        greys.is_locked,
        lambda: greys.set_locked(not greys.is_locked),
    )
    lock.setEnabled(not greys.is_fixed)
    menu.addSeparator()
    slabs = menu.addMenu(tr("Slab"))
    _slabs(slabs, pane)
    slabs.setEnabled(not pane.viewing.is_slab_fixed)
    _turns(menu.addMenu(tr("Turn and mirror")), pane)
    cine = menu.addMenu(tr("Cine"))
    _switch(cine, tr("Run through the slices") + "\tC", pane.cine.is_running, pane.cine.toggle)
    cine.addSeparator()
    for rate in RATES:
        _switch(
            cine,
            tr("{rate} slices a second", rate=rate),
            rate == pane.cine.rate,
            partial(pane.cine.set_rate, rate),
        )
    menu.addSeparator()
    _entry(menu, tr("Fit to pane") + "\t=", pane.canvas.fit)
    _entry(menu, tr("Reset view") + "\t" + tr("Space"), pane.reset)
    _entry(menu, tr("Maximise or restore") + "\tX", pane.maximise_wanted.emit)
    return menu


def _entry(menu: QMenu, text: str, command: Callable[[], object]) -> None:
    menu.addAction(text).triggered.connect(lambda _=False: command())


def _switch(menu: QMenu, text: str, on: bool, command: Callable[[], object]) -> QAction:
    action = menu.addAction(text)
    action.setCheckable(True)
    action.setChecked(on)
    action.triggered.connect(lambda _=False: command())
    return action


def _slabs(menu: QMenu, pane: SlicePane) -> None:
    slab, take = pane.viewing.presentation(pane.pane).slab, pane.actions_of.take_slab
    for kind in KINDS:
        wanted = Slab(kind, slab.thickness_mm or 10.0)
        _switch(menu, kind_name(kind), slab == wanted, partial(take, wanted))
    menu.addSeparator()
    for thickness in THICKNESSES_MM:
        text = tr("{thickness:g} mm", thickness=thickness) if thickness else tr("One slice")
        wanted = replace(slab, thickness_mm=thickness)
        _switch(menu, text, slab == wanted, partial(take, wanted))


def _turns(menu: QMenu, pane: SlicePane) -> None:
    actions = pane.actions_of
    _entry(menu, tr("Right by 90°"), lambda: actions.turn(1))
    _entry(menu, tr("Left by 90°"), lambda: actions.turn(-1))
    _entry(menu, tr("By 180°: from the other side of the table"), lambda: actions.turn(2))
    _entry(menu, tr("Mirror left-right"), lambda: actions.mirror(False))
    _entry(menu, tr("Mirror top-bottom"), lambda: actions.mirror(True))
    menu.addSeparator()
    _entry(menu, tr("As radiologists read it"), actions.upright)


def _ask_name(pane: SlicePane) -> None:
    """Ask for the name of the present window; the window goes on meanwhile."""
    window = pane.viewing.greys.of(pane.pane)
    dialog = QInputDialog(pane)
    dialog.setWindowTitle(tr("Keep this window"))
    dialog.setLabelText(
        literal(tr("Name for W {width:.0f}  L {level:.0f}", width=window.width, level=window.level))
    )
    dialog.textValueSelected.connect(
        lambda name: pane.viewing.greys.keep(name.strip()[:40], window) if name.strip() else None
    )
    dialog.finished.connect(dialog.deleteLater)
    dialog.open()
