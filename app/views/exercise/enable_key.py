"""The key or pedal that switches the forces on for as long as it is held down."""

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QWidget

DEFAULT_KEY = Qt.Key.Key_H
"""`H` for hold: F, B, E, T and S have other meanings in the window."""

_GONE = (QEvent.Type.WindowDeactivate, QEvent.Type.Hide, QEvent.Type.Close)
_UNFOCUSED = QEvent.Type.FocusOut


class EnableKey(QObject):
    """Watches a window for one key, whatever modifiers are down and whoever has the focus.

    It looks at the window itself, not at its widgets: no field can swallow the release. A pedal on
    USB is a keyboard with one key. Anything that takes the keyboard away counts as letting go.

    Signals:
        held(bool): pressed, or let go; each change once.
    """

    held = Signal(bool)

    def __init__(self, parent: QWidget, key: Qt.Key = DEFAULT_KEY) -> None:
        super().__init__(parent)
        self._key = key
        self._down = False
        self._active = False

    @property
    def key(self) -> Qt.Key:
        """Key that is watched."""
        return self._key

    @property
    def name(self) -> str:
        """Key as it is written on the keyboard."""
        return key_name(self._key)

    def set_key(self, key: Qt.Key) -> None:
        """Watch another key; lets go of the present one."""
        self._change(False)
        self._key = key

    def set_active(self, active: bool) -> None:
        """Watch, or let go and leave the key to whoever else wants it."""
        if not active:
            self._change(False)
        self._active = active

    def watch(self, window: QWidget) -> None:
        """Watch a top-level widget; it is given its native window if it has none yet."""
        window.installEventFilter(self)
        window.winId()
        handle = window.windowHandle()
        if handle is not None:
            handle.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the key; while the watch is on, nobody else gets it."""
        if event.type() in _GONE or (_is_window(watched) and event.type() is _UNFOCUSED):
            self._change(False)
        elif isinstance(event, QKeyEvent) and event.key() == self._key and self._active:
            return self._take(event)
        return False

    def _take(self, event: QKeyEvent) -> bool:
        if event.isAutoRepeat():
            return True
        if event.type() == QEvent.Type.KeyPress:
            self._change(True)
            return True
        if event.type() == QEvent.Type.KeyRelease:
            self._change(False)
            return True
        return False

    def _change(self, down: bool) -> None:
        if down is not self._down:
            self._down = down
            self.held.emit(down)


def key_name(key: Qt.Key) -> str:
    """Name of a key as it is written on the keyboard."""
    return QKeySequence(key).toString(QKeySequence.SequenceFormat.NativeText)


def _is_window(watched: QObject) -> bool:
    return not watched.isWidgetType()
