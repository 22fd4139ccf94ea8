"""Which part of which plane a pane shows, and where its pixels lie: pan and zoom."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QResizeEvent, QTransform
from PySide6.QtWidgets import QGraphicsView, QWidget

from app.core.arrays import FloatArray
from app.views.slices.camera import Camera
from app.views.slices.mouse_view import MouseView
from app.views.slices.panes import PaneId
from app.views.slices.plane import Rect, SlicePlane
from app.views.slices.viewing import Viewing


class PlaneView(MouseView):
    """Looks at the plane of one pane; places are right at once, whatever is drawn yet.

    Attributes:
        viewing: whose planes.
        pane: which of them.
        plane: the plane; None where there is none.
        camera: pan and zoom.
    """

    def __init__(self, viewing: Viewing, pane: PaneId, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.viewing, self.pane = viewing, PaneId(pane)
        self.plane: SlicePlane | None = None
        self.camera = Camera(0.0, 0.0, 1.0)
        self._fitted = True
        self._size = (1, 1)
        self._visible: Rect = (0.0, 0.0, 1.0, 1.0)

    @property
    def index(self) -> float:
        """Slice that is shown; whole where the volume's own slices are."""
        return self.viewing.index(self.pane)

    @property
    def visible_mm(self) -> Rect:
        """Rectangle of the plane that the pane shows."""
        return self._visible

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
        self._look()

    def resizeEvent(self, event: QResizeEvent | None) -> None:
        """Keep the image fitted, or its middle in the middle."""
        if event is None:  # pyqtgraph calls it so while it constructs
            return
        QGraphicsView.resizeEvent(self, event)
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
            self.set_camera(Camera(camera.x + right, camera.y + down, camera.scale))
            self._fitted = fitted

    def _look(self) -> None:
        """Take what is seen from the camera; every place is asked of it."""
        self._size = (self.viewport().width(), self.viewport().height())
        self._visible = self.camera.visible(self._size)
        self._camera_moved()

    def _camera_moved(self) -> None:
        """Show it; who draws more than the scene's items may do so later."""
        self._apply_camera()

    def _apply_camera(self) -> None:
        self.setSceneRect(QRectF(*self._visible))
        self.setTransform(QTransform.fromScale(self.camera.scale, self.camera.scale))

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
