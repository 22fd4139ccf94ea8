"""Asks for the key or pedal that arms while it is held."""

from collections.abc import Iterable

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QLabel, QVBoxLayout, QWidget

from app.views.exercise.enable_key import DEFAULT_KEY, key_name
from app.views.kit import theme
from app.views.kit.text import tr

MODIFIERS = (
    Qt.Key.Key_Shift, Qt.Key.Key_Control, Qt.Key.Key_Alt, Qt.Key.Key_AltGr, Qt.Key.Key_Meta,
    Qt.Key.Key_CapsLock, Qt.Key.Key_NumLock, Qt.Key.Key_unknown,
)  # fmt: skip
MOVING = (
    Qt.Key.Key_Escape, Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Tab, Qt.Key.Key_Backtab,
    Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_PageUp,
    Qt.Key.Key_PageDown, Qt.Key.Key_Home, Qt.Key.Key_End, Qt.Key.Key_S, Qt.Key.Key_F5,
)  # fmt: skip
"""Keys that mean something during an attempt."""


def refusal(key: Qt.Key, taken: Iterable[QKeySequence]) -> str:
    """Say why a key cannot be the one; empty if it can."""
    if key in MODIFIERS:
        return tr("this key is a modifier; take another one")
    if key in MOVING or any(QKeySequence(key) == sequence for sequence in taken):
        return tr("{key} has another meaning in the window; take another one", key=key_name(key))
    return ""


class KeyDialog(QDialog):
    """Takes the next key that is pressed.

    Signals:
        chosen(Qt.Key): the user pressed a key that is free, and confirmed.
    """

    chosen = Signal(object)

    def __init__(
        self, present: Qt.Key, taken: Iterable[QKeySequence], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Key for the forces"))
        self._key, self._taken = present, tuple(taken)
        self._shown, self._note = QLabel(self), QLabel(self)
        self._shown.setStyleSheet(f"font-size: {theme.TITLE_PX + 8}px; font-weight: 600;")
        self._shown.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._note.setWordWrap(True)
        self._note.setMinimumHeight(3 * theme.FONT_PX)
        words = QLabel(tr(
            "Press the key or pedal that shall switch the forces on while it is held. A pedal on "
            "USB counts as a keyboard."
        ))  # fmt: skip
        words.setWordWrap(True)
        kinds = QDialogButtonBox.StandardButton
        buttons = QDialogButtonBox(kinds.Ok | kinds.Cancel | kinds.RestoreDefaults, parent=self)
        for button in buttons.buttons():
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # keys go to the dialog
        buttons.accepted.connect(self._take)
        buttons.rejected.connect(self.reject)
        restore = buttons.button(kinds.RestoreDefaults)
        restore.clicked.connect(lambda: self.show_key(DEFAULT_KEY))
        column = QVBoxLayout(self)
        column.setSpacing(theme.MARGIN)
        for widget in (words, self._shown, self._note, buttons):
            column.addWidget(widget)
        self.setMinimumWidth(380)
        self.show_key(present)

    def show_key(self, key: Qt.Key) -> None:
        """Show a key, or why it cannot be taken."""
        reason = refusal(key, self._taken)
        if not reason:
            self._key = key
            self._shown.setText(key_name(key))
        colour, symbol = theme.VERDICTS["bad"]
        self._note.setText(f"{symbol} {reason}" if reason else "")
        self._note.setStyleSheet(f"color: {colour};")

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Take the key; Esc closes as everywhere."""
        if event.key() == Qt.Key.Key_Escape:
            self.reject()
        elif not event.isAutoRepeat():
            self.show_key(Qt.Key(event.key()))

    def _take(self) -> None:
        self.chosen.emit(self._key)
        self.accept()
