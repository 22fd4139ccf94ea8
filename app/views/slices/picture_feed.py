"""The picture of one pane: made beside the window, or at once for who cannot wait."""

from __future__ import annotations

from math import ceil, floor
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject, Qt, QTimer, Signal

from app.imaging.window import WindowLevel
from app.views.slices.picture_maker import Picture, PictureMaker, Region, Screen, Values, Wish
from app.views.slices.plane import Rect, SlicePlane

PATIENCE_MS = 100
"""A picture later than this is not waited for: its code is being compiled, or the slab is thick."""

HELP_MS = 8
"""So long a quick picture is left to its thread, which may not get a turn on a busy machine."""

FINEST = 4.0
"""Pixels per finest voxel beyond which a picture only grows and gains nothing."""

_NOTHING = np.zeros((1, 1), np.int16)


class PictureFeed(QObject):
    """Keeps the picture of one pane.

    Attributes:
        picture: the newest that there is; None while nothing is shown.
        wish: what is wanted.

    Signals:
        arrived(): a picture has come; or there is none to wait for any longer, as it is given up or
            late.
    """

    arrived = Signal()

    def __init__(self, maker: PictureMaker, parent: QObject) -> None:
        super().__init__(parent)
        self._maker = maker
        self.wish: Wish | None = None
        self.picture: Picture | None = None
        self.is_waiting = self._is_late = False
        self._count = self._least = 0
        self._help = QTimer(self, interval=HELP_MS, singleShot=True)
        self._help.timeout.connect(self._finish_late)
        self._timer = QTimer(self, interval=PATIENCE_MS, singleShot=True)
        self._timer.timeout.connect(self._give_up)
        maker.bell.rung.connect(self._look, Qt.ConnectionType.QueuedConnection)

    @property
    def hu(self) -> NDArray[Any]:
        """Hounsfield units of the picture, shape (rows, columns), contiguous."""
        return _NOTHING if self.picture is None else self.picture.values.hu

    @property
    def bounds_mm(self) -> Rect:
        """Where they lie in the plane."""
        return (0.0, 0.0, 0.0, 0.0) if self.picture is None else self.picture.values.bounds_mm

    @property
    def is_near(self) -> bool:
        """Whether a picture is still to come and what belongs over it may wait for it."""
        return self.is_waiting and not self._is_late

    def want(
        self, plane: SlicePlane, index: float, screen: Screen, window: WindowLevel, inverted: bool
    ) -> None:
        """Take a slice; its picture comes, unless it is there already.

        Args:
            plane: of the pane.
            index: of the slice.
            screen: the pane's pixels.
            window: of the greys.
            inverted: whether they are turned round.
        """
        region = None
        if not plane.is_native:
            region = _region(plane, screen)
            if region is None:
                self.drop()
                return
        shown = self.picture
        values: Values | None = None if shown is None else shown.values
        known = values if values is not None and values.are(plane, index, region) else None
        wish = Wish(plane, index, region, window, inverted, screen, known, self._count + 1)
        if wish.same(self.wish):
            return
        self.wish, self._count = wish, wish.number
        self._maker.request(id(self), wish)
        if not self.is_waiting:
            self.is_waiting, self._is_late = True, False
            self._timer.start()
            self._help.start()

    def finish(self) -> None:
        """Have the picture now, where making it takes no longer than copying it."""
        wish = self.wish
        if self.is_waiting and wish is not None and (wish.known or wish.plane.is_native):
            self._maker.forget(id(self))
            self._show(Picture.of(wish))

    def _finish_late(self) -> None:
        before = self.picture
        self.finish()
        if self.picture is not before:
            self.arrived.emit()

    def drop(self) -> None:
        """Want nothing any more, and show nothing."""
        if self.wish is not None:
            self.wish = None
            self._maker.forget(id(self))
        self.picture, self.is_waiting = None, False
        self._least = self._count + 1
        self._timer.stop()
        self._help.stop()

    def _show(self, picture: Picture) -> None:
        self.picture, self._least = picture, picture.wish.number
        self.is_waiting, self._is_late = picture.wish is not self.wish, False
        for timer in (self._timer, self._help):
            (timer.start if self.is_waiting else timer.stop)()

    def _look(self) -> None:
        """Take a picture if there is one; the bell rings for all panes."""
        if not self.is_waiting:
            return
        picture = self._maker.take(id(self))
        if picture is not None and picture.wish.number < self._least:
            return  # of what was dropped, or overtaken
        if picture is not None:
            self._show(picture)
            self.arrived.emit()
        elif not self._maker.waits(id(self)):  # it could not be made
            self.is_waiting = False
            self._timer.stop()
            self.arrived.emit()

    def _give_up(self) -> None:
        self._is_late = True
        self.arrived.emit()


def _region(plane: SlicePlane, screen: Screen) -> Region | None:
    """Return the part of the volume that is seen, on the pane's pixels; None if there is none."""
    pixel = max(1.0 / screen.scale, plane.finest_mm / FINEST)
    first, last = [], []
    for start, count, low, room in zip(
        (screen.left, screen.top),
        (screen.width, screen.height),
        plane.bounds_mm[:2],
        plane.bounds_mm[2:],
        strict=True,
    ):
        first.append(max(0, floor((low - start) / pixel)))
        last.append(min(ceil(count / screen.scale / pixel), ceil((low + room - start) / pixel)))
    columns, rows = last[0] - first[0], last[1] - first[1]
    if columns < 1 or rows < 1:
        return None
    left, top = screen.left + first[0] * pixel, screen.top + first[1] * pixel
    return Region(left, top, pixel, columns, rows)
