"""The picture of a slice: Hounsfield units that become grey when they are painted."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QRectF
from PySide6.QtGui import QImage, QPainter

from app.imaging.window import WindowLevel, to_grey

_OPAQUE_GREY = np.arange(256, dtype=np.uint32) * np.uint32(0x010101) + np.uint32(0xFF000000)
"""Pixel of each grey level: 32 bits scale twice as fast as 8."""


class PictureItem:
    """A grey slice, scaled smoothly.

    Grey values are made when the slice is painted: of the many windows of a fast drag only those
    that reach the screen cost anything.
    """

    def __init__(self) -> None:
        self._rect = QRectF()
        self._image = QImage()
        self._pixels: NDArray[np.uint32] | None = None  # the image's own memory
        self._hu: NDArray[Any] | None = None
        self._window: WindowLevel | None = None
        self._inverted = self._stale = False

    @property
    def is_stale(self) -> bool:
        """Whether the next painting shows another picture than the last one."""
        return self._stale

    def set_slice(
        self,
        hu: NDArray[Any],
        window: WindowLevel,
        bounds_mm: tuple[float, float, float, float],
        inverted: bool = False,
    ) -> None:
        """Show Hounsfield units, shape (rows, columns), on this left, top, width, height [mm]."""
        self._rect = QRectF(*bounds_mm)
        if hu is self._hu and window == self._window and inverted == self._inverted:
            return
        self._hu, self._window, self._inverted, self._stale = hu, window, inverted, True

    def clear(self) -> None:
        """Show nothing."""
        self._rect, self._hu, self._stale = QRectF(), None, False

    def image(self) -> QImage:
        """Return the slice in grey."""
        if self._stale and self._hu is not None and self._window is not None:
            self._stale = False
            self._pixels = _pixels(self._hu, self._window, self._inverted)
            rows, columns = self._pixels.shape
            shape = QImage.Format.Format_RGB32
            self._image = QImage(self._pixels.data, columns, rows, 4 * columns, shape)
        return self._image

    def boundingRect(self) -> QRectF:
        """Return the image's place in the plane."""
        return self._rect

    def paint(self, painter: QPainter) -> None:
        """Draw the image with a painter in millimetres."""
        if self._rect.isEmpty():
            return
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.drawImage(self._rect, self.image())


def _pixels(hu: NDArray[Any], window: WindowLevel, inverted: bool) -> NDArray[np.uint32]:
    """Pixels of Hounsfield units, contiguous; of whole ones in a single pass."""
    if hu.dtype == np.int16:
        return np.take(_table(window, inverted), hu.view(np.uint16))
    grey = to_grey(hu, window)
    return np.take(_OPAQUE_GREY[::-1] if inverted else _OPAQUE_GREY, grey)


@lru_cache(maxsize=16)
def _table(window: WindowLevel, inverted: bool) -> NDArray[np.uint32]:
    """Pixel of each int16 value, indexed by its bits as unsigned."""
    return _pixels(np.arange(65536, dtype=np.uint16).view(np.int16).astype(np.float32),
                   window, inverted)  # fmt: skip
