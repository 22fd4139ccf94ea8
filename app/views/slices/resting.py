"""A layer that is too slow to follow a live needle: gone while the plane moves, back at rest."""

from __future__ import annotations

from PySide6.QtCore import QObject, QTimer

from app.views.slices.layer_stack import Layer
from app.views.slices.plane import SlicePlane

REST_MS = 150
"""A plane that has stayed this long rests."""


class RestingLayer(QObject):
    """Shows another layer only where the plane has been for a while."""

    def __init__(self, layer: Layer, parent: QObject) -> None:
        super().__init__(parent)
        self._layer = layer
        self._wanted: tuple[SlicePlane, float, float] | None = None
        self._timer = QTimer(self, interval=REST_MS, singleShot=True)
        self._timer.timeout.connect(self._show)

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Show the layer at once where the plane is the same, else once it rests."""
        before, self._wanted = self._wanted, (plane, index, scale)
        if before is not None and before[0] is plane and before[1] == index:
            if not self._timer.isActive():
                self._layer.place(plane, index, scale)
            return
        self._layer.hide()
        self._timer.start()

    def hide(self) -> None:
        """Show nothing."""
        self._timer.stop()
        self._wanted = None
        self._layer.hide()

    def _show(self) -> None:
        if self._wanted is not None:
            self._layer.place(*self._wanted)
