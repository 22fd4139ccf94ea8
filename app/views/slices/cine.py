"""Cine: the slices of a pane run by themselves, there and back, until something is touched."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QTimer, Signal

from app.views.slices.canvas import SliceCanvas

RATES = (5, 10, 15, 25)
"""Slices a second to choose from."""

_ENDS_IT = (
    QEvent.Type.MouseButtonPress, QEvent.Type.Wheel, QEvent.Type.KeyPress, QEvent.Type.Hide,
)  # fmt: skip


class Cine(QObject):
    """Scrolls one canvas.

    Signals:
        changed(): it began or ended.
    """

    changed = Signal()

    def __init__(self, canvas: SliceCanvas) -> None:
        super().__init__(canvas)
        self._canvas, self._step = canvas, 1
        self._timer = QTimer(self)
        self._timer.timeout.connect(self.advance)
        self.set_rate(RATES[1])
        canvas.viewing.volume_changed.connect(self.stop)

    @property
    def is_running(self) -> bool:
        """Whether the slices run."""
        return self._timer.isActive()

    @property
    def rate(self) -> int:
        """Slices a second."""
        return round(1000 / self._timer.interval())

    def set_rate(self, rate: int) -> None:
        """Run at so many slices a second."""
        self._timer.setInterval(round(1000 / rate))

    def toggle(self) -> None:
        """Begin or end."""
        if self.is_running:
            self.stop()
        elif self._canvas.plane is not None:
            self._watch(True)
            self._timer.start()
            self.changed.emit()

    def stop(self) -> None:
        """End; idempotent."""
        if self.is_running:
            self._watch(False)
            self._timer.stop()
            self.changed.emit()

    def _watch(self, on: bool) -> None:
        """See what is pressed while it runs; else every event would come by here for nothing."""
        canvas = self._canvas
        (canvas.installEventFilter if on else canvas.removeEventFilter)(self)

    def advance(self) -> None:
        """Go one slice on; turn round at the ends of the volume."""
        before = self._canvas.index
        for step in (self._step, -self._step):
            self._canvas.viewing.show_slice(self._canvas.pane, before + step)
            self._step = step
            if self._canvas.index != before:
                return
        self.stop()  # there is one slice only

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Any button, wheel or key ends it, and does what it always does."""
        if event.type() in _ENDS_IT:
            self.stop()
        return False
