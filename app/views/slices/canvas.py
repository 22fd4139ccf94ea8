"""One slice on the screen: the pyqtgraph view, its layers, and pan and zoom."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import (
    QHideEvent,
    QResizeEvent,
    QShowEvent,
    QTransform,
)
from PySide6.QtWidgets import QFrame, QGraphicsView, QWidget

from app.core.arrays import FloatArray
from app.views.slices.camera import Camera
from app.views.slices.items import ImageItem, MarkItem
from app.views.slices.layer_stack import Layer, LayerStack
from app.views.slices.looks import Turn
from app.views.slices.mouse_view import MouseView
from app.views.slices.panes import PaneId, others
from app.views.slices.picture_feed import PictureFeed
from app.views.slices.plane import Rect, SlicePlane
from app.views.slices.reformat_plane import ReformatPlane
from app.views.slices.viewing import Viewing


class SliceCanvas(MouseView):
    """Draws the slice of one pane.

    Signals:
        changed(): slice, window, zoom or pan is another: the read-outs are out of date.
        plane_taken(): the plane is another one, or gone.
        seen(): the pane was shown or hidden.
    """

    changed = Signal()
    plane_taken = Signal()
    seen = Signal()

    def __init__(self, viewing: Viewing, pane: PaneId, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.viewing, self.pane = viewing, PaneId(pane)
        self.plane: SlicePlane | None = None
        self.camera = Camera(0.0, 0.0, 1.0)
        self._fitted, self._turn = True, Turn()
        self._shown: tuple[object, ...] = ()
        self.feed = PictureFeed(viewing.reformatter, self)
        self.feed.arrived.connect(self._show_picture)
        self.setCentralItem(None)  # layers stand in the scene itself; its end would crash Qt
        scene = self.scene()
        scene.setItemIndexMethod(scene.ItemIndexMethod.NoIndex)  # a dozen items, moved often
        self._image = ImageItem()
        scene.addItem(self._image)
        self.layers = LayerStack(scene, viewing, self.pane)
        self._set_up_view()
        viewing.volume_changed.connect(self.show_volume)
        viewing.cursor_changed.connect(self._show_cursor)
        viewing.plane_changed.connect(self._show_plane)
        viewing.look_changed.connect(self._show_look)
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
    def index(self) -> float:
        """Slice that is shown; whole where the volume's own slices are."""
        return self.viewing.index(self.pane)

    @property
    def values(self) -> NDArray[Any]:
        """Hounsfield units of the picture, on `values_mm`, shape (rows, columns)."""
        return self.feed.hu

    @property
    def values_mm(self) -> Rect:
        """Left, top, width and height [mm] of the picture in the plane."""
        return self.feed.bounds_mm

    def add_layer(self, layer: Layer, marks: Sequence[MarkItem] = ()) -> None:
        """Draw something more over the slice.

        Args:
            layer: placed whenever slice, plane or zoom change; its items stand in `scene()`. Who
                changes what it shows calls `refresh`.
            marks: those of its marks whose names shall be arranged with the others'.
        """
        self.layers.add(layer, marks)
        self.refresh()

    @property
    def _is_asleep(self) -> bool:
        """Whether nothing needs to be drawn: a needle's pane that nobody sees."""
        return self.plane is None or (self.pane.is_needle and not self.isVisible())

    def refresh(self) -> None:
        """Place the added layers anew, because what they show has changed."""
        if self.plane is not None and not self._is_asleep:
            self.layers.place_added(self.plane, self.index, self.camera.scale)
            self._arrange_labels()

    def show_volume(self) -> None:
        """Take the viewing's volume and fit it."""
        self._take_plane()
        self.fit()
        self._show_cursor()

    def _show_plane(self, pane: PaneId) -> None:
        """Take another plane, or show another's trace; zoom and pan stay."""
        if pane is not self.pane:
            if pane in others(self.pane):
                self._place_crosshair()
            return
        before = self.plane
        self._take_plane()
        if before is None:
            self.fit()
        elif self.plane is not None and not self.pane.is_needle:
            self._keep_crosshair(before, self.plane)
        self._show_cursor()

    def _keep_crosshair(self, before: SlicePlane, plane: SlicePlane) -> None:
        """Let the crosshair stay at its pixel, wherever the new plane counts from."""
        cursor = self.viewing.cursor_mm
        old, new = before.point(cursor, 0.0), plane.point(cursor, 0.0)
        right, down = new.x - old.x, new.y - old.y
        if max(abs(right), abs(down)) > 1e-6:
            camera, fitted = self.camera, self._fitted
            self.set_camera(Camera(camera.x + right, camera.y + down, camera.scale))
            self._fitted = fitted

    def _show_look(self, pane: PaneId) -> None:
        """Fit what has been turned; a slab leaves zoom and pan."""
        turn = self.viewing.look(self.pane).turn
        if pane is self.pane and turn != self._turn:
            self._turn = turn
            self._take_plane()  # first, or the crosshair would be kept at its pixel afterwards
            self.fit()

    def _take_plane(self) -> None:
        plane = self.viewing.plane(self.pane)
        if plane is not self.plane:
            self.plane, self._shown = plane, ()
            self.plane_taken.emit()
        if plane is None:
            self.feed.drop()
            self._image.clear()
            self.layers.hide()

    def _show_cursor(self) -> None:
        if self.plane is None or self._is_asleep:
            return
        index, greys = self.index, self.viewing.greys
        moved = self._shown[:1] != (index,)
        state = (index, greys.of(self.pane), greys.is_inverted, greys.is_locked)
        if self._shown != state:
            self._shown = state
            if moved:
                self._fetch()
            self._show_picture()
            self.changed.emit()
        self._place_crosshair()
        if moved:
            self.layers.place_plan(self.plane, index, self.camera.scale)
            self.layers.place_needle(self.plane, index, self.camera.scale)
            self.refresh()

    def _fetch(self) -> None:
        """Want the picture of what the pane shows."""
        if self.plane is not None and not self._is_asleep:
            visible = self.camera.visible((self.viewport().width(), self.viewport().height()))
            pixel = 1.0 / (self.camera.scale * self.devicePixelRatioF())
            self.feed.want(self.plane, self.index, visible, pixel)

    def _show_picture(self) -> None:
        greys = self.viewing.greys
        window, bounds = greys.of(self.pane), self.feed.bounds_mm
        self._image.set_slice(self.feed.hu, window, bounds, greys.is_inverted)

    def _place_crosshair(self) -> None:
        if self.plane is not None and not self._is_asleep:
            self.layers.place_crosshair(self.plane, self.index, self.camera.scale)

    def _show_plan(self) -> None:
        if self.plane is not None and not self._is_asleep:
            self.layers.place_plan(self.plane, self.index, self.camera.scale)
            self._arrange_labels()

    def _show_needle(self) -> None:
        if self.plane is not None and not self._is_asleep:
            self.layers.place_needle(self.plane, self.index, self.camera.scale)
            self._arrange_labels()

    def _arrange_labels(self) -> None:
        if self.plane is not None:
            size = (float(self.viewport().width()), float(self.viewport().height()))
            self.layers.arrange_labels(self.plane, self.index, size, self.pixel_at)

    # --- pan and zoom -------------------------------------------------------------------------
    def fit(self) -> None:
        """Show the whole image, and keep doing so when the pane is resized."""
        if self.plane is not None:
            size = (self.viewport().width(), self.viewport().height())
            self.set_camera(Camera.fit(self.plane.home_mm, size))
            self._fitted = True

    def set_camera(self, camera: Camera) -> None:
        """Pan and zoom to `camera`."""
        self.camera, self._fitted = camera, False
        self._apply_camera()

    def _apply_camera(self) -> None:
        size = (self.viewport().width(), self.viewport().height())
        self.setSceneRect(QRectF(*self.camera.visible(size)))
        self.setTransform(QTransform.fromScale(self.camera.scale, self.camera.scale))
        if isinstance(self.plane, ReformatPlane):
            self._fetch()  # the pixels are other ones
        self._show_cursor()
        if self.plane is not None and not self._is_asleep:
            self.layers.place_plan(self.plane, self.index, self.camera.scale)
            self.layers.place_needle(self.plane, self.index, self.camera.scale)
        self.refresh()
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

    # --- seen and unseen ----------------------------------------------------------------------
    def showEvent(self, event: QShowEvent) -> None:
        """Catch up with what happened unseen."""
        super().showEvent(event)
        if self.pane.is_needle:
            self._shown = ()
            self._take_plane()
            self._apply_camera()
        self.seen.emit()

    def hideEvent(self, event: QHideEvent) -> None:
        """Stop drawing."""
        super().hideEvent(event)
        if self.pane.is_needle:
            self.feed.drop()
        self.seen.emit()
