"""The pictures of slices, made beside the window's thread: values, window and scale in one go.

Requests neither wait nor queue up: the newest of each pane wins, and the panes take turns.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Hashable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject, QRectF, Signal
from PySide6.QtGui import QImage, QPainter

from app.core.loading import ONE_AT_A_TIME
from app.imaging.window import WindowLevel
from app.views.slices.plane import Rect, SlicePlane

IDLE_S = 20.0
"""The thread ends when nobody wants a picture for so long; the next request starts another."""

_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Screen:
    """The pixels that a picture is drawn into.

    Attributes:
        left, top: place of the first pixel's outer corner in the plane [mm].
        scale: the screen's own pixels for each millimetre.
        width, height: of the pane in the screen's own pixels.
        ratio: of those to the window's pixels.
    """

    left: float
    top: float
    scale: float
    width: int
    height: int
    ratio: float

    def place(self, rect: Rect) -> Rect:
        """Where a rectangle of the plane [mm] lies [px]."""
        left, top, width, height = rect
        return ((left - self.left) * self.scale, (top - self.top) * self.scale,
                width * self.scale, height * self.scale)  # fmt: skip

    @property
    def rect_mm(self) -> QRectF:
        """What of the plane is on it [mm]."""
        width, height = self.width / self.scale, self.height / self.scale
        return QRectF(self.left, self.top, width, height)


@dataclass(frozen=True, slots=True)
class Region:
    """Pixels of an interpolated picture: left and top edge [mm], size of a pixel, and counts."""

    left: float
    top: float
    pixel_mm: float
    columns: int
    rows: int


@dataclass(frozen=True, slots=True, eq=False)
class Values:
    """Hounsfield units of a slice.

    Attributes:
        plane: of which they are.
        index: of the slice.
        region: which pixels were interpolated; None for one of the volume's own.
        hu: shape (rows, columns), contiguous.
        bounds_mm: where they lie in the plane.
    """

    plane: SlicePlane
    index: float
    region: Region | None
    hu: NDArray[Any]
    bounds_mm: Rect

    @classmethod
    def of(cls, plane: SlicePlane, index: float, region: Region | None) -> Values:
        """Take them from the volume."""
        if region is None:  # contiguous: the next window then needs no second gather
            hu = np.ascontiguousarray(plane.image(index))
            return cls(plane, index, None, hu, plane.bounds_mm)
        corner, size = (region.left, region.top), region.pixel_mm
        hu = plane.pixels(index, corner, size, region.columns, region.rows)
        bounds = (*corner, region.columns * size, region.rows * size)
        return cls(plane, index, region, hu, bounds)

    def are(self, plane: SlicePlane, index: float, region: Region | None) -> bool:
        """Whether they are those of this slice."""
        return self.plane is plane and (self.index, self.region) == (index, region)


@dataclass(frozen=True, slots=True, eq=False)
class Wish:
    """A picture of a slice.

    Attributes:
        plane, index, region: which values, as in `Values`.
        window, inverted: how they become grey.
        screen: what they are drawn into.
        known: the values, where there are already.
        number: counts the wishes of a pane, so that none is answered after a later one.
    """

    plane: SlicePlane
    index: float
    region: Region | None
    window: WindowLevel
    inverted: bool
    screen: Screen
    known: Values | None = None
    number: int = 0

    def same(self, other: Wish | None) -> bool:
        """Whether both ask for the same pixels."""
        return other is not None and self.plane is other.plane and self.key == other.key

    @property
    def key(self) -> tuple[object, ...]:
        """All but the plane, which compares by identity."""
        return self.index, self.region, self.window, self.inverted, self.screen


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """What a wish became.

    Attributes:
        wish: which.
        values: its Hounsfield units.
        pixels: 0xAARRGGBB, shape (height, width) of the screen.
        image: the same as Qt's, on the memory of `pixels`.
    """

    wish: Wish
    values: Values
    pixels: NDArray[np.uint32]
    image: QImage

    @classmethod
    def of(cls, wish: Wish) -> Picture:
        """Make it; anywhere, most of it without the interpreter lock."""
        from app.imaging.screen import screen_pixels  # compiled: loaded since there is a volume

        values = wish.known or Values.of(wish.plane, wish.index, wish.region)
        screen = wish.screen
        place, size = screen.place(values.bounds_mm), (screen.width, screen.height)
        pixels = screen_pixels(values.hu, wish.window, wish.inverted, place, size)
        shape = QImage.Format.Format_RGB32
        image = QImage(pixels.data, screen.width, screen.height, 4 * screen.width, shape)
        image.setDevicePixelRatio(screen.ratio)
        return cls(wish, values, pixels, image)

    def paint(self, painter: QPainter, screen: Screen) -> None:
        """Copy it to a pane; on another part of the plane than it was made for it is scaled."""
        if screen == self.wish.screen:
            painter.resetTransform()
            painter.drawImage(0, 0, self.image)
            return
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.drawImage(self.wish.screen.rect_mm, self.image)


class Bell(QObject):
    """Tells the window's thread that a picture was made.

    Signals:
        rung(): emitted in the maker's thread, received in the window's.
    """

    rung = Signal()


class PictureMaker:
    """Makes the pictures of several panes in one thread.

    Attributes:
        bell: rings when there is something to `take`.
    """

    def __init__(self) -> None:
        self.bell = Bell()
        self._wishes: dict[Hashable, Wish] = {}
        self._made: dict[Hashable, Picture | None] = {}
        self._working: Hashable = None
        self._closing = False
        self._wake = threading.Condition()
        self._thread: threading.Thread | None = None

    def request(self, who: Hashable, wish: Wish) -> None:
        """Ask for a picture in place of any that `who` still waits for."""
        with self._wake:
            self._wishes[who] = wish  # keeps its place in the queue if there is one
            if self._thread is None:
                self._closing = False
                self._thread = threading.Thread(target=self._run, name="acus-pictures", daemon=True)
                self._thread.start()
            self._wake.notify_all()

    def take(self, who: Hashable) -> Picture | None:
        """Return the newest picture for `who` that was not taken yet."""
        with self._wake:
            return self._made.pop(who, None)

    def forget(self, who: Hashable) -> None:
        """Want nothing any more."""
        with self._wake:
            self._wishes.pop(who, None)
            self._made.pop(who, None)

    def waits(self, who: Hashable) -> bool:
        """Whether a picture is still to come, or to be taken."""
        with self._wake:
            return who in self._wishes or who in self._made or self._working == who

    def wait(self, timeout: float) -> bool:
        """Wait up to `timeout` [s] until every wish is answered; for tests and commands."""
        with self._wake:
            return self._wake.wait_for(lambda: not self._wishes and self._working is None, timeout)

    def close(self, timeout: float = 2.0) -> None:
        """Stop the thread; idempotent. A later request starts it again."""
        with self._wake:
            self._closing, thread = True, self._thread
            self._wishes.clear()
            self._wake.notify_all()
        if thread is not None:
            thread.join(timeout)

    def _run(self) -> None:
        with ONE_AT_A_TIME:  # compiled: nobody else may be loading it just now
            import app.imaging.oblique
            import app.imaging.screen  # noqa: F401
        while (work := self._next()) is not None:
            who, wish = work
            picture = None
            try:
                picture = Picture.of(wish)
            except Exception as error:  # the pane keeps its last picture, the others go on
                _log.warning("the picture of a slice could not be made", exc_info=error)
            with self._wake:
                self._working = None
                if picture is not None:
                    self._made[who] = picture
                self._wake.notify_all()
                if not self._closing:
                    self.bell.rung.emit()

    def _next(self) -> tuple[Hashable, Wish] | None:
        with self._wake:
            self._wake.wait_for(lambda: self._closing or self._wishes, IDLE_S)
            if self._closing or not self._wishes:
                self._thread = None
                return None
            who = next(iter(self._wishes))
            self._working = who
            return who, self._wishes.pop(who)
