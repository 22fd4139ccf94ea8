"""A key that acts only when it is held down, for what must not happen by a slip."""

from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent

HOLD_MS = 700


class HoldKey(QObject):
    """Watches a window for one key; auto-repeat and other keys change nothing.

    Signals:
        held(): the key was down for `HOLD_MS` without a break.
    """

    held = Signal()

    def __init__(self, key: Qt.Key, parent: QObject) -> None:
        super().__init__(parent)
        self._key = key
        self._timer = QTimer(self, interval=HOLD_MS, singleShot=True)
        self._timer.timeout.connect(self.held)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Start and stop the clock; the event goes on to whoever wants it."""
        kinds = (QEvent.Type.KeyPress, QEvent.Type.KeyRelease)
        if event.type() in kinds and isinstance(event, QKeyEvent) and event.key() == self._key:
            if event.isAutoRepeat():
                return False
            if event.type() == QEvent.Type.KeyPress:
                self._timer.start()
            else:
                self._timer.stop()
        elif event.type() == QEvent.Type.WindowDeactivate:
            self._timer.stop()
        return False
