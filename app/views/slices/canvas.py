"""One slice on the screen: the pyqtgraph view, its layers, and pan and zoom."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
import pyqtgraph
from numpy.typing import NDArray
from PySide6.QtCore import QEvent, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent, QResizeEvent, QTransform, QWheelEvent
from PySide6.QtWidgets import QFrame, QGraphicsView, QWidget

from app.core.arrays import FloatArray
from app.imaging.orthogonal import View
from app.views import theme
from app.views.slices.camera import Camera
from app.views.slices.error_layer import ErrorLayer
from app.views.slices.items import ImageItem
from app.views.slices.layers import CrosshairLayer, Labels, NeedleLayer, PlanLayer
from app.views.slices.plane import SlicePlane
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


class SliceCanvas(pyqtgraph.GraphicsView):
    """Draws the slice of `view` that passes through the crosshair.

    Signals:
        changed(): slice, window, zoom or pan is another: the read-outs are out of date.
        left(): the mouse left the pane.
        double_clicked(): for maximising.
    """

    changed = Signal()
    left = Signal()
    double_clicked = Signal()

    def __init__(self, viewing: Viewing, view: View, parent: QWidget | None = None) -> None:
        super().__init__(parent, useOpenGL=False, background=theme.IMAGE_BACKGROUND)
        self.viewing, self.view = viewing, view
        self.plane: SlicePlane | None = None
        self.camera = Camera(0.0, 0.0, 1.0)
        self.gestures: Gestures | None = None
        self._fitted = True
        self._shown: tuple[object, ...] = ()
        self._hu: NDArray[Any] = np.zeros((1, 1), np.int16)
        self.setCentralItem(None)  # layers stand in the scene itself; its end would crash Qt
        scene = self.scene()
        scene.setItemIndexMethod(scene.ItemIndexMethod.NoIndex)  # a dozen items, moved often
        self._image = ImageItem()
        scene.addItem(self._image)
        self._crosshair = CrosshairLayer(scene, view)
        self._plan, self._needle = PlanLayer(scene), NeedleLayer(scene)
        self._errors = ErrorLayer(scene)
        self._labels = Labels((self._plan.target, self._plan.entry, self._needle.tip))
        self._set_up_view()
        viewing.volume_changed.connect(self.show_volume)
        viewing.cursor_changed.connect(self._show_cursor)
        viewing.window_changed.connect(self._show_cursor)
        viewing.plan_changed.connect(self._show_plan)
        viewing.needle_changed.connect(self._show_needle)

    def _set_up_view(self) -> None:
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCacheMode(QGraphicsView.CacheModeFlag.CacheNone)
        self.setViewportUpdateMode(QGraphicsView.ViewportUpdateMode.MinimalViewportUpdate)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)

    # --- what is shown ------------------------------------------------------------------------
    @property
    def index(self) -> int:
        """Slice that is shown."""
        return self.viewing.index(self.view)

    def show_volume(self) -> None:
        """Take the viewing's volume and fit it."""
        slicer = self.viewing.slicer
        self.plane = None if slicer is None else SlicePlane(slicer, self.view)
        self._shown = ()
        self.fit()
        self._show_cursor()

    def _show_cursor(self) -> None:
        if self.plane is None:
            return
        index, window = self.index, self.viewing.window
        moved = self._shown[:1] != (index,)
        if self._shown != (index, window):
            self._shown = (index, window)
            if moved:  # kept contiguous: changing the window then needs no second gather
                self._hu = np.ascontiguousarray(self.plane.image(index))
            self._image.set_slice(self._hu, window, self.plane.extent_mm)
            self.changed.emit()
        point = self.plane.point(self.viewing.cursor_mm, index)
        self._crosshair.place(point, self.plane.extent_mm, self.camera.scale)
        if moved:
            self._show_plan()
            self._show_needle()

    def _show_plan(self) -> None:
        if self.plane is not None:
            scale, viewing = self.camera.scale, self.viewing
            error = viewing.target_error if viewing.shows_errors else None
            self._plan.place(viewing.draft, self.plane, self.index, scale, error is not None)
            self._errors.place_target(error, self.plane, self.index, scale)
            self._arrange_labels()

    def _show_needle(self) -> None:
        if self.plane is not None:
            needle, scale = self.viewing.needle, self.camera.scale
            shown = needle is not None and self.viewing.shows_errors
            self._needle.place(needle, self.plane, self.index, scale)
            self._errors.place_tip(
                needle.error if needle and shown else None, self.plane, self.index, scale
            )
            self._arrange_labels()

    def _arrange_labels(self) -> None:
        """Put the names of the marks where they cover nothing and nothing cuts them."""
        plane, draft, needle = self.plane, self.viewing.draft, self.viewing.needle
        if plane is None:
            return
        lines = [] if needle is None else [(needle.start_mm, needle.tip_mm)]
        if draft.entry_mm is not None and draft.target_mm is not None:
            lines.append((np.asarray(draft.entry_mm), np.asarray(draft.target_mm)))
        places = [[plane.point(point, self.index) for point in line] for line in lines]
        ends = [(self.pixel_at(a.x, a.y), self.pixel_at(b.x, b.y)) for a, b in places]
        size = (float(self.viewport().width()), float(self.viewport().height()))
        self._labels.arrange(size, self.pixel_at, ends)

    # --- pan and zoom -------------------------------------------------------------------------
    def fit(self) -> None:
        """Show the whole image, and keep doing so when the pane is resized."""
        if self.plane is not None:
            size = (self.viewport().width(), self.viewport().height())
            self.set_camera(Camera.fit(self.plane.extent_mm, size))
            self._fitted = True

    def set_camera(self, camera: Camera) -> None:
        """Pan and zoom to `camera`."""
        self.camera, self._fitted = camera, False
        self._apply_camera()

    def _apply_camera(self) -> None:
        size = (self.viewport().width(), self.viewport().height())
        self.setSceneRect(QRectF(*self.camera.visible(size)))
        self.setTransform(QTransform.fromScale(self.camera.scale, self.camera.scale))
        self._show_cursor()
        self._show_plan()
        self._show_needle()
        self.changed.emit()

    def resizeEvent(self, event: QResizeEvent | None) -> None:
        """Keep the image fitted, or its middle in the middle."""
        if event is None:  # pyqtgraph calls it so while it constructs
            return
        QGraphicsView.resizeEvent(self, event)
        if self._fitted:
            self.fit()
        elif self.plane is not None:
            self._apply_camera()

    # --- places -------------------------------------------------------------------------------
    def plane_at(self, position: QPointF) -> tuple[float, float]:
        """Plane point [mm] under a pixel of the pane."""
        x, y, _, _ = self.camera.visible((self.viewport().width(), self.viewport().height()))
        return x + position.x() / self.camera.scale, y + position.y() / self.camera.scale

    def lps_at(self, position: QPointF) -> FloatArray:
        """LPS point [mm] under a pixel of the pane; the crosshair's point without a volume."""
        if self.plane is None:
            return self.viewing.cursor_mm
        return self.plane.lps_mm(*self.plane_at(position), self.index)

    def pixel_at(self, x: float, y: float) -> QPointF:
        """Pixel of the pane at a plane point [mm]."""
        left, top, _, _ = self.camera.visible((self.viewport().width(), self.viewport().height()))
        return QPointF((x - left) * self.camera.scale, (y - top) * self.camera.scale)

    # --- mouse: everything goes to the gestures, nothing to pyqtgraph's own -----------------------
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
        """Ask to be maximised, or restored."""
        if event.button() is Qt.MouseButton.LeftButton:
            self.double_clicked.emit()

    def leaveEvent(self, event: QEvent) -> None:
        """Tell the read-outs."""
        self.left.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Leave the keys to the pane."""
        event.ignore()

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        """Leave the keys to the pane."""
        event.ignore()
