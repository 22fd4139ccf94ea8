"""The pictures of slices, made beside the window's thread: values, window and scale in one go.

A pane's `PictureFeed` wishes for pictures, the `PictureMaker` makes them in threads of its own and
hands them over in the window's. Requests neither wait nor queue up: the newest of each pane wins,
and the panes take turns.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Hashable
from dataclasses import dataclass
from math import ceil, floor
from time import monotonic
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject, QRectF, Qt, QTimer, Signal
from PySide6.QtGui import QImage, QPainter

from app.core.loading import ONE_AT_A_TIME
from app.imaging.window import WindowLevel
from app.views.slices.plane import Rect, SlicePlane

IDLE_S = 20.0
"""A thread ends when nobody wants a picture for so long; the next request starts another."""

THREADS = 2
"""So many make pictures at once: while they do, the window's thread has little to do."""

LATE_S = 0.1
"""A picture later than this is not waited for: its code is being compiled, or the slab is thick."""

HELP_S = 0.008
"""So long a quick picture is left to its thread, which may not get a turn on a busy machine."""

WATCH_MS = 4
"""So often one looks whether a picture is late, while any is awaited."""

FINEST = 4.0
"""Pixels per finest voxel beyond which a picture only grows and gains nothing."""

_NOTHING = np.zeros((1, 1), np.int16)

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
        """Return where a rectangle of the plane [mm] lies [px]."""
        left, top, width, height = rect
        return (
            (left - self.left) * self.scale,
            (top - self.top) * self.scale,
            width * self.scale,
            height * self.scale,
        )

    @property
    def rect_mm(self) -> QRectF:
        """Return what of the plane is on it [mm]."""
        width, height = self.width / self.scale, self.height / self.scale
        return QRectF(self.left, self.top, width, height)


@dataclass(frozen=True, slots=True)
class PixelGrid:
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
    region: PixelGrid | None
    hu: NDArray[Any]
    bounds_mm: Rect

    @classmethod
    def of(cls, plane: SlicePlane, index: float, region: PixelGrid | None) -> Values:
        """Take them from the volume."""
        if region is None:  # contiguous: the next window then needs no second gather
            hu = np.ascontiguousarray(plane.image(index))
            return cls(plane, index, None, hu, plane.bounds_mm)
        corner, size = (region.left, region.top), region.pixel_mm
        hu = plane.pixels(index, corner, size, region.columns, region.rows)
        bounds = (*corner, region.columns * size, region.rows * size)
        return cls(plane, index, region, hu, bounds)

    def are(self, plane: SlicePlane, index: float, region: PixelGrid | None) -> bool:
        """Return whether they are those of this slice."""
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
    region: PixelGrid | None
    window: WindowLevel
    inverted: bool
    screen: Screen
    known: Values | None = None
    number: int = 0

    def same(self, other: Wish | None) -> bool:
        """Return whether both ask for the same pixels."""
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
        sheet: the same again, for who draws over it.
    """

    wish: Wish
    values: Values
    pixels: NDArray[np.uint32]
    sheet: NDArray[np.uint32]

    @classmethod
    def of(cls, wish: Wish) -> Picture:
        """Make it; anywhere, most of it without the interpreter lock."""
        from app.imaging.screen import screen_pixels  # compiled: loaded since there is a volume

        values = wish.known or Values.of(wish.plane, wish.index, wish.region)
        screen = wish.screen
        place, size = screen.place(values.bounds_mm), (screen.width, screen.height)
        pixels = screen_pixels(values.hu, wish.window, wish.inverted, place, size)
        return cls(wish, values, pixels, pixels.copy())

    @property
    def image(self) -> QImage:
        """The same as Qt's, on the memory of `pixels`."""
        return image_of(self.pixels, self.wish.screen.ratio)

    def paint(self, painter: QPainter) -> None:
        """Scale it to a part of the plane that it was not made for, with a painter in mm."""
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.drawImage(self.wish.screen.rect_mm, self.image)


def image_of(pixels: NDArray[np.uint32], ratio: float, opaque: bool = True) -> QImage:
    """Return a pane's pixels as Qt's picture, on the same memory."""
    height, width = pixels.shape
    kind = QImage.Format.Format_RGB32 if opaque else QImage.Format.Format_ARGB32_Premultiplied
    image = QImage(pixels.data, width, height, 4 * width, kind)
    image.setDevicePixelRatio(ratio)
    return image


class PictureMaker(QObject):
    """Makes the pictures of several panes, those of one pane one after another.

    Signals:
        idle(): every picture that was awaited is there, or late.
    """

    idle = Signal()
    _rung = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._wishes: dict[Hashable, Wish] = {}
        self._made: dict[Hashable, Picture | None] = {}
        self._answered: list[Hashable] = []
        self._working: set[Hashable] = set()
        self._closing = False
        self._wake = threading.Condition()
        self._threads: list[threading.Thread] = []
        self._feeds: dict[Hashable, PictureFeed] = {}
        self._timer = QTimer(self, interval=WATCH_MS)
        self._timer.timeout.connect(self._watch)
        self._rung.connect(self._hand_over, Qt.ConnectionType.QueuedConnection)

    # --- in the window's thread -----------------------------------------------------------------
    @property
    def is_awaited(self) -> bool:
        """Return whether a picture is to come that is not late yet."""
        return any(feed.is_near for feed in self._feeds.values())

    def await_for(self, feed: PictureFeed) -> None:
        """Hand the next pictures over to a feed, and help it where they do not come."""
        self._feeds[id(feed)] = feed
        if not self._timer.isActive():
            self._timer.start()

    def request(self, who: Hashable, wish: Wish) -> None:
        """Ask for a picture in place of any that `who` still waits for."""
        with self._wake:
            self._wishes[who] = wish  # keeps its place in the queue if there is one
            self._closing = False
            if len(self._threads) < min(THREADS, len(self._wishes) + len(self._working)):
                thread = threading.Thread(target=self._run, name="acus-pictures", daemon=True)
                self._threads.append(thread)
                thread.start()
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
        """Return whether a picture is still to come, or to be taken."""
        with self._wake:
            return who in self._wishes or who in self._made or who in self._working

    def wait(self, timeout: float) -> bool:
        """Wait up to `timeout` [s] until every wish is answered; for tests and commands."""
        with self._wake:
            return self._wake.wait_for(lambda: not self._wishes and not self._working, timeout)

    def close(self, timeout: float = 2.0) -> None:
        """Stop the threads; idempotent. A later request starts them again."""
        with self._wake:
            self._closing, threads = True, self._threads
            self._threads = []
            self._wishes.clear()
            self._wake.notify_all()
        for thread in threads:
            thread.join(timeout)

    def _hand_over(self) -> None:
        """Let those take a picture who got an answer."""
        with self._wake:
            answered, self._answered = self._answered, []
        for who in answered:
            if feed := self._feeds.get(who):
                feed.take()
        self._rest()

    def _watch(self) -> None:
        """Help those whose pictures are late."""
        now = monotonic()
        for feed in list(self._feeds.values()):
            feed.check(now)
        self._rest()

    def _rest(self) -> None:
        """Watch no longer than somebody waits."""
        for who in [who for who, feed in self._feeds.items() if not feed.is_waiting]:
            del self._feeds[who]
        if not self._feeds:
            self._timer.stop()
        if not self.is_awaited:
            self.idle.emit()

    # --- in its own threads ---------------------------------------------------------------------
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
                self._working.discard(who)
                if picture is not None:
                    self._made[who] = picture
                first = not self._answered  # one event hands over all that is there by then
                self._answered.append(who)
                self._wake.notify_all()
                if first and not self._closing:
                    self._rung.emit()

    def _next(self) -> tuple[Hashable, Wish] | None:
        me = threading.current_thread()
        with self._wake:
            self._wake.wait_for(lambda: me not in self._threads or self._free() is not None, IDLE_S)
            who = self._free()
            if me not in self._threads or who is None:
                if me in self._threads:
                    self._threads.remove(me)
                return None
            self._working.add(who)
            return who, self._wishes.pop(who)

    def _free(self) -> Hashable:
        """Return whose wish comes next: nobody's whose last one is still in the making."""
        return next((who for who in self._wishes if who not in self._working), None)


class PictureFeed:
    """Keeps the picture of one pane: made beside the window, or at once for who cannot wait.

    Attributes:
        picture: the newest that there is; None while nothing is shown.
        wish: what is wanted.
        is_waiting: whether a picture is still to come.
    """

    def __init__(self, maker: PictureMaker, arrived: Callable[[], None]) -> None:
        """Want nothing yet.

        Args:
            maker: who makes the pictures.
            arrived: called when a picture has come; or there is none to wait for any longer, as it
                is given up or late.
        """
        self._maker, self._arrived = maker, arrived
        self.wish: Wish | None = None
        self.picture: Picture | None = None
        self.is_waiting = self._is_late = False
        self._count = self._least = 0
        self._since = self._help_at = 0.0

    @property
    def hu(self) -> NDArray[Any]:
        """Hounsfield units of the picture, shape (rows, columns), contiguous."""
        return _NOTHING if self.picture is None else self.picture.values.hu

    @property
    def bounds_mm(self) -> Rect:
        """Return where they lie in the plane."""
        return (0.0, 0.0, 0.0, 0.0) if self.picture is None else self.picture.values.bounds_mm

    @property
    def is_near(self) -> bool:
        """Return whether a picture is still to come and what belongs over it may wait for it."""
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
            self._wait()

    def finish(self) -> None:
        """Have the picture now, where making it takes no longer than copying it."""
        wish = self.wish
        if self.is_waiting and wish is not None and (wish.known or wish.plane.is_native):
            self._maker.forget(id(self))
            self._show(Picture.of(wish))

    def drop(self) -> None:
        """Want nothing any more, and show nothing."""
        if self.wish is not None:
            self.wish = None
            self._maker.forget(id(self))
        self.picture, self.is_waiting = None, False
        self._least = self._count + 1

    def take(self) -> None:
        """Take the picture if there is one, as there was an answer."""
        if not self.is_waiting:
            return
        picture = self._maker.take(id(self))
        if picture is not None and picture.wish.number < self._least:
            return  # of what was dropped, or overtaken
        if picture is not None:
            self._show(picture)
            self._arrived()
        elif not self._maker.waits(id(self)):  # it could not be made
            self.is_waiting = False
            self._arrived()

    def check(self, now: float) -> None:
        """Make a picture here that does not come, or wait for it no longer."""
        if not self.is_waiting:
            return
        before = self.picture
        if now >= self._help_at:
            self._help_at = float("inf")
            self.finish()
        if self.picture is not before:
            self._arrived()
        elif not self._is_late and now - self._since >= LATE_S:
            self._is_late = True
            self._arrived()

    def _wait(self) -> None:
        self.is_waiting, self._is_late = True, False
        self._since = monotonic()
        self._help_at = self._since + HELP_S
        self._maker.await_for(self)

    def _show(self, picture: Picture) -> None:
        self.picture, self._least = picture, picture.wish.number
        self.is_waiting = self._is_late = False
        if picture.wish is not self.wish:
            self._wait()


def _region(plane: SlicePlane, screen: Screen) -> PixelGrid | None:
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
    return PixelGrid(left, top, pixel, columns, rows)
