"""The picture of one pane: handed out by the plane at once, or interpolated beside the window."""

from __future__ import annotations

from math import ceil, floor
from time import monotonic
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject, QTimer, Signal

from app.views.slices.plane import Rect, SlicePlane
from app.views.slices.reformatter import Reformatter, Wish

LOOK_MS = 4
PATIENCE_S = 0.1
"""A picture later than this is not waited for: its code is being compiled, or the slab is thick."""

FINEST = 4.0
"""Pixels per finest voxel beyond which a picture only grows and gains nothing."""


class PictureFeed(QObject):
    """Keeps the Hounsfield units of one pane.

    Attributes:
        hu: shape (rows, columns), contiguous.
        bounds_mm: where they lie in the plane.

    Signals:
        arrived(): an interpolated picture has come; or there is none to wait for any longer, as it
            is given up or late.
    """

    arrived = Signal()

    def __init__(self, reformatter: Reformatter, parent: QObject) -> None:
        super().__init__(parent)
        self._reformatter = reformatter
        self._wish: Wish | None = None
        self._show_nothing()
        self._since, self._is_late = 0.0, False
        self._timer = QTimer(self, interval=LOOK_MS)
        self._timer.timeout.connect(self._look)

    def _show_nothing(self) -> None:
        self.hu: NDArray[Any] = np.zeros((1, 1), np.int16)
        self.bounds_mm: Rect = (0.0, 0.0, 0.0, 0.0)

    @property
    def is_waiting(self) -> bool:
        """Whether an interpolated picture is still to come."""
        return self._timer.isActive()

    @property
    def is_near(self) -> bool:
        """Whether a picture is still to come and what belongs over it may wait for it."""
        return self.is_waiting and not self._is_late

    def want(self, plane: SlicePlane, index: float, visible: Rect, pixel_mm: float) -> None:
        """Take a slice: the volume's own at once, an interpolated one when it comes.

        Args:
            plane: of the pane.
            index: of the slice.
            visible: rectangle that the pane shows [mm].
            pixel_mm: size of the pane's pixels.
        """
        if plane.is_native:
            self.drop()
            # kept contiguous: changing the window then needs no second gather
            self.hu, self.bounds_mm = np.ascontiguousarray(plane.image(index)), plane.bounds_mm
            return
        wish = _wish(plane, index, visible, pixel_mm)
        if wish is None:
            self.drop()
            self._show_nothing()
            return
        if wish.same(self._wish):
            return
        self._wish = wish
        self._reformatter.request(id(self), wish)
        if not self._timer.isActive():
            self._since, self._is_late = monotonic(), False
            self._timer.start()

    def drop(self) -> None:
        """Want nothing any more."""
        if self._wish is not None:
            self._wish = None
            self._reformatter.forget(id(self))
            self._timer.stop()

    def _look(self) -> None:
        made = self._reformatter.take(id(self))
        if made is not None:
            wish, self.hu = made
            self.bounds_mm = wish.bounds_mm
            self._since, self._is_late = monotonic(), False
        late = not self._is_late and monotonic() - self._since > PATIENCE_S
        self._is_late = self._is_late or late
        done = not self._reformatter.waits(id(self))
        if done:
            self._timer.stop()
        if made is not None or done or late:
            self.arrived.emit()


def _wish(plane: SlicePlane, index: float, visible: Rect, pixel_mm: float) -> Wish | None:
    """Return the part of the volume that is seen, on the pane's pixels; None if there is none."""
    pixel = max(pixel_mm, plane.finest_mm / FINEST)
    first, last = [], []
    for start, size, low, room in zip(
        visible[:2], visible[2:], plane.bounds_mm[:2], plane.bounds_mm[2:], strict=True
    ):
        first.append(max(0, floor((low - start) / pixel)))
        last.append(min(ceil(size / pixel), ceil((low + room - start) / pixel)))
    columns, rows = last[0] - first[0], last[1] - first[1]
    if columns < 1 or rows < 1:
        return None
    corner = (visible[0] + first[0] * pixel, visible[1] + first[1] * pixel)
    return Wish(plane, index, corner, pixel, columns, rows)
