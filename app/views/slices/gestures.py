"""What the mouse does in a slice."""

from __future__ import annotations

from dataclasses import replace
from enum import Enum, auto
from math import hypot
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject, QPoint, QPointF, QRect, Qt, Signal
from PySide6.QtGui import QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QRubberBand

from app.core.arrays import FloatArray
from app.imaging.window import WindowLevel
from app.views.slices.bindings import Drag, Wheel
from app.views.slices.canvas import SliceCanvas
from app.views.slices.presets import best_window
from app.views.slices.slab import as_point
from app.views.slices.viewing import Tool

SMALLEST_PX = 4


class WindowBox:
    """Follows the mouse from where it was pressed, then chooses the window."""

    def __init__(self, canvas: SliceCanvas) -> None:
        self._canvas = canvas
        self._band = QRubberBand(QRubberBand.Shape.Rectangle, canvas)
        self._from = QPointF()

    def begin(self, position: QPointF) -> None:
        """Put the first corner."""
        self._from = position
        self.move(position)
        self._band.show()

    def move(self, position: QPointF) -> None:
        """Put the other corner."""
        self._band.setGeometry(QRect(self._from.toPoint(), position.toPoint()).normalized())

    def end(self) -> None:
        """Show what the box holds in its best window; a click changes nothing."""
        box = self._band.geometry()
        self._band.hide()
        if box.width() < SMALLEST_PX or box.height() < SMALLEST_PX:
            return
        window = best_window(self._values(box))
        if window is not None:
            self._canvas.viewing.set_window(window, self._canvas.pane)

    def _values(self, box: QRect) -> NDArray[Any]:
        """Hounsfield units of the pixels whose centres lie in a rectangle of the pane."""
        plane, hu = self._canvas.plane, self._canvas.values
        if plane is None:
            return hu[:0]
        left, top, width, height = self._canvas.values_mm
        corners = (box.topLeft().toPointF(), box.bottomRight().toPointF())
        (x0, y0), (x1, y1) = (self._canvas.plane_at(corner) for corner in corners)
        rows, columns = hu.shape
        across = (np.array([x0, x1]) - left) / width * columns - 0.5
        down = (np.array([y0, y1]) - top) / height * rows - 0.5
        c0, c1 = np.clip(np.ceil(across), 0, columns).astype(int)
        r0, r1 = np.clip(np.ceil(down), 0, rows).astype(int)
        return hu[r0:r1, c0:c1]


GRAB_PX = 12.0
CLICK_PX = 4.0
ZOOM_PER_PX = 1.01
ZOOM_PER_NOTCH = 1.15
NOTCH = 120
WINDOW_GAIN = 1.0 / 300.0
"""Share of the window by which one pixel changes it: dragging 300 px doubles the width."""


class _Held(Enum):
    """What the left button has taken hold of in place of the scheme's drag."""

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

    def __init__(self, canvas: SliceCanvas) -> None:
        super().__init__(canvas)
        self._canvas = canvas
        self._box = WindowBox(canvas)
        self._drag: Drag | _Held | None = None
        self._button = Qt.MouseButton.NoButton
        self._point = Tool.ENTRY
        self._grips: list[Grip] = []
        self._held: Grip | None = None
        self._started = self._over = False
        self._offset = QPointF()  # from the mouse to the middle of the mark that is dragged
        self._pressed, self._last = QPointF(), QPointF()
        self._notches = 0

    def add_grip(self, grip: Grip) -> None:
        """Let the left button drag something more; who was added last is asked first."""
        self._grips.insert(0, grip)

    # --- events -------------------------------------------------------------------------------
    def press(self, event: QMouseEvent) -> None:
        """Decide what this drag does."""
        if self._canvas.plane is None or self._drag is not None:
            return
        self._pressed = self._last = event.position()
        self._button = event.button()
        self._drag = self._choose(event)
        if self._drag is _Held.POINT and self._canvas.viewing.tool is not Tool.NAVIGATE:
            self._place(event.position())
        elif self._drag is Drag.CROSSHAIR:
            self._canvas.viewing.set_cursor(self._lps(event.position()))
        elif self._drag is Drag.BOX:
            self._box.begin(event.position())

    def move(self, event: QMouseEvent) -> None:
        """Go on with the drag; Shift without a button moves the crosshair."""
        if self._canvas.plane is None:
            return
        step = event.position() - self._last
        self._last = event.position()
        shift = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
        if self._drag is not None:
            self._go_on(event.position(), step)
        elif shift and event.buttons() == Qt.MouseButton.NoButton:
            self._canvas.viewing.set_cursor(self._lps(event.position()))
        else:
            self._show_grip(event.position())
        self.hovered.emit(self._lps(event.position()))

    def _show_grip(self, position: QPointF) -> None:
        """Show a hand over what can be dragged."""
        if self._canvas.viewing.tool is not Tool.NAVIGATE:
            self._over = False
            return
        over = any(grip.hover(position) for grip in self._grips)
        if over != self._over:
            self._over = over
            shape = Qt.CursorShape.OpenHandCursor if over else Qt.CursorShape.ArrowCursor
            self._canvas.setCursor(shape)

    def _go_on(self, position: QPointF, step: QPointF) -> None:
        canvas, drag = self._canvas, self._drag
        if drag is Drag.WINDOW:
            canvas.viewing.set_window(self._windowed(step), canvas.pane)
        elif drag is Drag.PAN:
            canvas.set_camera(canvas.camera.panned(step.x(), step.y()))
        elif drag is Drag.ZOOM:
            x, y = canvas.plane_at(self._pressed)
            canvas.set_camera(canvas.camera.zoomed(ZOOM_PER_PX ** -step.y(), x, y))
        elif drag is Drag.CROSSHAIR:
            canvas.viewing.set_cursor(self._lps(position))
        elif drag is Drag.BOX:
            self._box.move(position)
        elif drag is _Held.POINT:
            self._place(position)
        elif self._held is not None:
            self._held.drag(position)

    def release(self, event: QMouseEvent) -> None:
        """End the drag; a right click that did not move asks for the menu."""
        if event.button() is not self._button and self._button is not Qt.MouseButton.NoButton:
            return  # another button that was pressed in between
        drag, self._drag = self._drag, None
        self._button = Qt.MouseButton.NoButton
        if drag is _Held.GRIP and self._held is not None:
            held, self._held = self._held, None
            held.drop(event.position())
        elif drag is _Held.POINT:
            self._started = False
            if not self._canvas.viewing.point_refused:
                self._canvas.viewing.set_tool(Tool.NAVIGATE)
        elif drag is Drag.BOX:
            self._box.end()
        elif event.button() is Qt.MouseButton.RightButton and drag is not None:
            self._ask_for_menu(event)

    def _ask_for_menu(self, event: QMouseEvent) -> None:
        if _length(event.position() - self._pressed) < CLICK_PX:
            self.menu_wanted.emit(event.globalPosition().toPoint())

    def wheel(self, event: QWheelEvent) -> None:
        """Scroll through the slices, zoom, or change the slab, as the scheme has it."""
        delta = event.angleDelta().y()
        does = self._canvas.viewing.scheme.wheel(event.modifiers())
        if does is Wheel.ZOOM:
            x, y = self._canvas.plane_at(event.position())
            factor = ZOOM_PER_NOTCH ** (delta / NOTCH)
            self._canvas.set_camera(self._canvas.camera.zoomed(factor, x, y))
        else:
            self._notches += delta
            steps = int(self._notches / NOTCH)  # touch pads send parts of a notch
            self._notches -= steps * NOTCH
            if steps and does is Wheel.SLAB:
                thicken(self._canvas, steps)
            elif steps:
                self._canvas.viewing.show_slice(self._canvas.pane, self._canvas.index + steps)
        event.accept()

    # --- meaning ------------------------------------------------------------------------------
    def _choose(self, event: QMouseEvent) -> Drag | _Held | None:
        viewing, button = self._canvas.viewing, event.button()
        drag = viewing.scheme.drag(button, event.modifiers())
        # What the plain left drag does, marks, lines and tools take first.
        if button is not Qt.MouseButton.LeftButton or drag is not Drag.WINDOW:
            return drag
        self._held = next((g for g in self._grips if g.grab(event.position(), event)), None)
        if self._held is not None:
            return _Held.GRIP
        self._offset = QPointF()
        tool = viewing.tool
        point = tool if tool is not Tool.NAVIGATE else self._grabbed(event.position())
        if point is None:
            return Drag.ZOOM if viewing.left_zooms else drag
        self._point = point
        return _Held.POINT

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
        self._canvas.viewing.clicked_pane = self._canvas.pane
        self._canvas.viewing.point_placed.emit(self._point, point, not self._started)
        self._started = True

    def _windowed(self, step: QPointF) -> WindowLevel:
        viewing = self._canvas.viewing
        window = viewing.greys.of(self._canvas.pane)
        gain = max(1.0, window.width * WINDOW_GAIN)
        rises = viewing.scheme.level_rises_upwards is not viewing.level_reversed
        sign = -1.0 if rises else 1.0  # pixels count downwards
        return window.dragged(gain * step.x(), sign * gain * step.y())

    def _lps(self, position: QPointF) -> FloatArray:
        return self._canvas.lps_at(position)


def thicken(canvas: SliceCanvas, steps: int) -> None:
    """Make a pane's slab thicker by so many steps, or thinner."""
    presentation = canvas.viewing.presentation(canvas.pane)
    canvas.viewing.set_presentation(
        canvas.pane, replace(presentation, slab=presentation.slab.thicker(steps))
    )


def _length(vector: QPointF) -> float:
    return hypot(vector.x(), vector.y())
