"""What the mouse does in a slice."""

from __future__ import annotations

from enum import Enum, auto
from math import hypot
from typing import Protocol

from PySide6.QtCore import QObject, QPoint, QPointF, Qt, Signal
from PySide6.QtGui import QMouseEvent, QWheelEvent

from app.core.arrays import FloatArray
from app.imaging.window import WindowLevel
from app.views.slices.canvas import SliceCanvas
from app.views.slices.slab import as_point
from app.views.slices.viewing import Tool

GRAB_PX = 12.0
CLICK_PX = 4.0
ZOOM_PER_PX = 1.01
ZOOM_PER_NOTCH = 1.15
NOTCH = 120
WINDOW_GAIN = 1.0 / 300.0
"""Share of the window by which one pixel changes it: dragging 300 px doubles the width."""


class _Drag(Enum):
    NONE = auto()
    WINDOW = auto()
    PAN = auto()
    ZOOM = auto()
    POINT = auto()
    GRIP = auto()


class Grip(Protocol):
    """Something over a slice that the left button can take hold of and drag."""

    def grab(self, position: QPointF, event: QMouseEvent) -> bool:
        """Take hold of what lies under a pixel of the pane, if it is this grip's; say whether."""

    def drag(self, position: QPointF) -> None:
        """Follow the mouse."""

    def drop(self, position: QPointF) -> None:
        """Let go."""

    def hover(self, position: QPointF) -> bool:
        """Say whether `grab` would take hold here, for the cursor's shape."""


class SliceGestures(QObject):
    """Turns mouse events on one canvas into changes of the viewing.

    Signals:
        hovered(object): LPS point [mm] under the mouse.
        menu_wanted(QPoint): right click, in screen pixels.
    """

    hovered = Signal(object)
    menu_wanted = Signal(QPoint)

    def __init__(self, canvas: SliceCanvas, level_rises_upwards: bool = True) -> None:
        super().__init__(canvas)
        self._canvas = canvas
        self._level_sign = -1.0 if level_rises_upwards else 1.0  # pixels count downwards
        self._drag = _Drag.NONE
        self._point = Tool.ENTRY
        self._grips: list[Grip] = []
        self._held: Grip | None = None
        self._started = False
        self._offset = QPointF()  # from the mouse to the middle of the mark that is dragged
        self._pressed, self._last = QPointF(), QPointF()
        self._notches = 0

    def add_grip(self, grip: Grip) -> None:
        """Let the left button drag something more; who was added last is asked first."""
        self._grips.insert(0, grip)

    # --- events -------------------------------------------------------------------------------
    def press(self, event: QMouseEvent) -> None:
        """Decide what this drag does."""
        if self._canvas.plane is None or self._drag is not _Drag.NONE:
            return
        self._pressed = self._last = event.position()
        self._drag = self._choose(event)
        if self._drag is _Drag.POINT and self._canvas.viewing.tool is not Tool.NAVIGATE:
            self._place(event.position())

    def move(self, event: QMouseEvent) -> None:
        """Go on with the drag; Shift moves the crosshair."""
        if self._canvas.plane is None:
            return
        step = event.position() - self._last
        self._last = event.position()
        if self._drag is _Drag.WINDOW:
            self._canvas.viewing.set_window(self._windowed(step))
        elif self._drag is _Drag.PAN:
            self._canvas.set_camera(self._canvas.camera.panned(step.x(), step.y()))
        elif self._drag is _Drag.ZOOM:
            x, y = self._canvas.plane_at(self._pressed)
            self._canvas.set_camera(self._canvas.camera.zoomed(ZOOM_PER_PX ** -step.y(), x, y))
        elif self._drag is _Drag.POINT:
            self._place(event.position())
        elif self._drag is _Drag.GRIP and self._held is not None:
            self._held.drag(event.position())
        elif event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            self._canvas.viewing.set_cursor(self._lps(event.position()))
        self.hovered.emit(self._lps(event.position()))

    def release(self, event: QMouseEvent) -> None:
        """End the drag; a right click that did not move asks for the menu."""
        drag, self._drag = self._drag, _Drag.NONE
        if drag is _Drag.GRIP and self._held is not None:
            held, self._held = self._held, None
            held.drop(event.position())
        elif drag is _Drag.POINT:
            self._started = False
            if not self._canvas.viewing.point_refused:
                self._canvas.viewing.set_tool(Tool.NAVIGATE)
        elif drag is _Drag.ZOOM and _length(event.position() - self._pressed) < CLICK_PX:
            self.menu_wanted.emit(event.globalPosition().toPoint())

    def wheel(self, event: QWheelEvent) -> None:
        """Scroll through the slices, or zoom with Ctrl."""
        delta = event.angleDelta().y()
        if event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            x, y = self._canvas.plane_at(event.position())
            factor = ZOOM_PER_NOTCH ** (delta / NOTCH)
            self._canvas.set_camera(self._canvas.camera.zoomed(factor, x, y))
        else:
            self._notches += delta
            steps = int(self._notches / NOTCH)  # touch pads send parts of a notch
            self._notches -= steps * NOTCH
            if steps:
                self._canvas.viewing.show_slice(self._canvas.pane, self._canvas.index + steps)
        event.accept()

    # --- meaning ------------------------------------------------------------------------------
    def _choose(self, event: QMouseEvent) -> _Drag:
        button = event.button()
        if button is Qt.MouseButton.MiddleButton:
            return _Drag.PAN
        if button is Qt.MouseButton.RightButton:
            return _Drag.ZOOM
        if button is not Qt.MouseButton.LeftButton:
            return _Drag.NONE
        if event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            return _Drag.PAN
        if event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            self._canvas.viewing.set_cursor(self._lps(event.position()))
            return _Drag.NONE
        self._held = next((g for g in self._grips if g.grab(event.position(), event)), None)
        if self._held is not None:
            return _Drag.GRIP
        self._offset = QPointF()
        tool = self._canvas.viewing.tool
        point = tool if tool is not Tool.NAVIGATE else self._grabbed(event.position())
        if point is None:
            return _Drag.WINDOW
        self._point = point
        return _Drag.POINT

    def _grabbed(self, position: QPointF) -> Tool | None:
        """Entry or target under the mouse, if it lies in this slice's slab."""
        plane, draft = self._canvas.plane, self._canvas.viewing.draft
        if plane is None:
            return None
        for tool, point in ((Tool.TARGET, draft.target_mm), (Tool.ENTRY, draft.entry_mm)):
            if point is None:
                continue
            at = plane.point(point, self._canvas.index)
            near = abs(at.distance) <= plane.half_slab_mm
            offset = self._canvas.pixel_at(at.x, at.y) - position
            if near and _length(offset) <= GRAB_PX:
                self._offset = offset
                return tool
        return None

    def _place(self, position: QPointF) -> None:
        point = as_point(self._lps(position + self._offset))
        self._canvas.viewing.point_refused = False
        self._canvas.viewing.point_placed.emit(self._point, point, not self._started)
        self._started = True

    def _windowed(self, step: QPointF) -> WindowLevel:
        window = self._canvas.viewing.window
        gain = max(1.0, window.width * WINDOW_GAIN)
        return window.dragged(gain * step.x(), self._level_sign * gain * step.y())

    def _lps(self, position: QPointF) -> FloatArray:
        return self._canvas.lps_at(position)


def _length(vector: QPointF) -> float:
    return hypot(vector.x(), vector.y())
