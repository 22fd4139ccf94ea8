"""The box that one draws in a slice to see what it holds in the best window."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRect
from PySide6.QtWidgets import QRubberBand

from app.views.slices.canvas import SliceCanvas
from app.views.slices.presets import best_window

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
