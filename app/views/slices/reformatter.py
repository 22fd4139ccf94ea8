"""The thread that interpolates slices: requests neither wait nor queue up, the newest wins."""

from __future__ import annotations

import logging
import threading
from collections.abc import Hashable
from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

from app.core.loading import ONE_AT_A_TIME
from app.views.slices.plane import Rect, SlicePlane

IDLE_S = 20.0
"""The thread ends when nobody wants a picture for so long; the next request starts another."""

_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True, eq=False)
class Wish:
    """A picture of a plane.

    Attributes:
        plane: which.
        index: of the slice.
        corner: left and top edge [mm].
        pixel_mm: size of a pixel.
        columns: width of the picture.
        rows: height of the picture.
    """

    plane: SlicePlane
    index: float
    corner: tuple[float, float]
    pixel_mm: float
    columns: int
    rows: int

    @property
    def bounds_mm(self) -> Rect:
        """Rectangle of the picture in the plane."""
        return (*self.corner, self.columns * self.pixel_mm, self.rows * self.pixel_mm)

    def same(self, other: Wish | None) -> bool:
        """Whether both ask for the same pixels."""
        return other is not None and (
            self.plane is other.plane
            and (self.index, self.corner, self.pixel_mm, self.columns, self.rows)
            == (other.index, other.corner, other.pixel_mm, other.columns, other.rows)
        )


class Reformatter:
    """Makes the pictures of several panes in one thread; the panes take turns.

    The thread touches nothing of Qt: who asked looks for the answer with `take`.
    """

    def __init__(self) -> None:
        self._wishes: dict[Hashable, Wish] = {}
        self._made: dict[Hashable, tuple[Wish, NDArray[Any]]] = {}
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
                self._thread = threading.Thread(target=self._run, name="acus-reformat", daemon=True)
                self._thread.start()
            self._wake.notify_all()

    def take(self, who: Hashable) -> tuple[Wish, NDArray[Any]] | None:
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
            import app.imaging.oblique  # noqa: F401
        while (work := self._next()) is not None:
            who, wish = work
            picture = None
            try:
                picture = wish.plane.pixels(
                    wish.index, wish.corner, wish.pixel_mm, wish.columns, wish.rows
                )
            except Exception as error:  # the pane keeps its last picture, the others go on
                _log.warning("a slice could not be interpolated", exc_info=error)
            with self._wake:
                self._working = None
                if picture is not None:
                    self._made[who] = wish, picture
                self._wake.notify_all()

    def _next(self) -> tuple[Hashable, Wish] | None:
        with self._wake:
            self._wake.wait_for(lambda: self._closing or self._wishes, IDLE_S)
            if self._closing or not self._wishes:
                self._thread = None
                return None
            who = next(iter(self._wishes))
            self._working = who
            return who, self._wishes.pop(who)
