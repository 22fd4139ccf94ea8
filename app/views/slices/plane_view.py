"""Which part of which plane a pane shows, and where its pixels lie: pan, zoom and the mouse."""

from __future__ import annotations

from typing import Protocol

from PySide6.QtCore import QEvent, QPointF, QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent, QResizeEvent, QTransform, QWheelEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.core.arrays import FloatArray
from app.views.slices.camera import SliceCamera
from app.views.slices.panes import PaneId
from app.views.slices.plane import Rect, SlicePlane
from app.views.slices.viewing import Viewing


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


class PlaneView(QWidget):
    """Looks at the plane of one pane; places are right at once, whatever is drawn yet.

    Hands over what the mouse does, and leaves the keys to the pane.

    Attributes:
        viewing: whose planes.
        pane: which of them.
        plane: the plane; None where there is none.
        camera: pan and zoom.
        gestures: who takes the mouse; nobody at first.

    Signals:
        left(): the mouse left the pane.
        double_clicked(): for maximising.
        ctrl_double_clicked(): for the window that there was at first.
    """

    left = Signal()
    double_clicked = Signal()
    ctrl_double_clicked = Signal()

    def __init__(self, viewing: Viewing, pane: PaneId, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.viewing, self.pane = viewing, PaneId(pane)
        self.plane: SlicePlane | None = None
        self.camera = SliceCamera(0.0, 0.0, 1.0)
        self.gestures: Gestures | None = None
        self._fitted = True
        self._size = (1, 1)
        self._visible: Rect = (0.0, 0.0, 1.0, 1.0)
        self._to_pixels = QTransform()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    @property
    def index(self) -> float:
        """Slice that is shown; whole where the volume's own slices are."""
        return self.viewing.index(self.pane)

    @property
    def visible_mm(self) -> Rect:
        """Rectangle of the plane that the pane shows."""
        return self._visible

    def sizeHint(self) -> QSize:
        """Return a size for a pane by itself."""
        return QSize(256, 192)

    def minimumSizeHint(self) -> QSize:
        """Return the least that a slice is of use in."""
        return QSize(72, 72)

    # --- pan and zoom -------------------------------------------------------------------------
    def fit(self) -> None:
        """Show the whole image, and keep doing so when the pane is resized."""
        if self.plane is not None:
            self.set_camera(SliceCamera.fit(self.plane.home_mm, (self.width(), self.height())))
            self._fitted = True

    def set_camera(self, camera: SliceCamera) -> None:
        """Pan and zoom to `camera`."""
        self.camera, self._fitted = camera, False
        self._look()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the image fitted, or its middle in the middle."""
        super().resizeEvent(event)
        if self._fitted and self.plane is not None:
            self.fit()
        else:
            self._look()

    def _keep_crosshair(self, before: SlicePlane, plane: SlicePlane) -> None:
        """Let the crosshair stay at its pixel, wherever the new plane counts from."""
        cursor = self.viewing.cursor_mm
        old, new = before.point(cursor, 0.0), plane.point(cursor, 0.0)
        right, down = new.x - old.x, new.y - old.y
        if max(abs(right), abs(down)) > 1e-6:
            camera, fitted = self.camera, self._fitted
            self.set_camera(SliceCamera(camera.x + right, camera.y + down, camera.scale))
            self._fitted = fitted

    def _look(self) -> None:
        """Take what is seen from the camera; every place is asked of it."""
        self._size = (self.width(), self.height())
        self._visible = self.camera.visible(self._size)
        self._camera_moved()

    def _camera_moved(self) -> None:
        """Show it; who draws more than a picture may do so later."""
        self._apply_camera()

    def _apply_camera(self) -> None:
        """Let what is drawn from now on stand where the camera has it."""
        scale, (left, top, _, _) = self.camera.scale, self._visible
        self._to_pixels = QTransform(scale, 0.0, 0.0, scale, -left * scale, -top * scale)

    # --- places -------------------------------------------------------------------------------
    def plane_at(self, position: QPointF) -> tuple[float, float]:
        """Plane point [mm] under a pixel of the pane."""
        x, y, _, _ = self._visible
        return x + position.x() / self.camera.scale, y + position.y() / self.camera.scale

    def lps_at(self, position: QPointF) -> FloatArray:
        """LPS point [mm] under a pixel of the pane; the crosshair's point without a volume."""
        if self.plane is None:
            return self.viewing.cursor_mm
        return self.plane.lps_mm(*self.plane_at(position), self.index)

    def pixel_at(self, x: float, y: float) -> QPointF:
        """Pixel of the pane at a plane point [mm]."""
        left, top, _, _ = self._visible
        return QPointF((x - left) * self.camera.scale, (y - top) * self.camera.scale)

    # --- mouse and keys -----------------------------------------------------------------------
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
