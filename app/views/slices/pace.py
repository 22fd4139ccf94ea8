"""What is done less often than it is asked for: words that are read, layers that are slow."""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic

from PySide6.QtCore import QObject, QTimer

from app.views.slices.layers import Layer
from app.views.slices.plane import SlicePlane

READING_MS = 100
"""Numbers and names that change more often than this are not read."""


class Unhurried(QObject):
    """Does something no more often than every `READING_MS`; what was asked last is always done.

    While it is asked again and again it is done within one of the asks: together with what else
    is drawn then, not between.
    """

    def __init__(self, action: Callable[[], None], parent: QObject) -> None:
        super().__init__(parent)
        self._action, self._done_at = action, -1.0
        self._timer = QTimer(self, interval=READING_MS, singleShot=True)
        self._timer.timeout.connect(self.do)

    @property
    def is_waiting(self) -> bool:
        """Return whether it is still to be done."""
        return self._timer.isActive()

    def ask(self) -> None:
        """Do it now, or as soon as the last time is long enough ago."""
        if 1e3 * (monotonic() - self._done_at) >= READING_MS:
            self.do()
        else:
            self._timer.start()

    def forget(self) -> None:
        """Let nothing wait any more, and the next ask be done at once."""
        self._timer.stop()
        self._done_at = -1.0

    def do(self) -> None:
        """Do it now."""
        self._timer.stop()
        self._done_at = monotonic()
        self._action()


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
