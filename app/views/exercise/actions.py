"""The attempt's buttons and their keys: each enabled exactly when the attempt allows it."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QGridLayout, QPushButton, QWidget

from app.session.machine import RUNNING, State
from app.views.exercise.hold_key import HoldKey
from app.views.kit.text import tr


class AttemptActions(QWidget):
    """Start, control scan, end, abort.

    Signals:
        start_requested(), scan_requested(), end_requested(), abort_requested().
    """

    start_requested = Signal()
    scan_requested = Signal()
    end_requested = Signal()
    abort_requested = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.start = _button(tr("Start attempt"), _starts())
        self.start.setProperty("role", "primary")
        self.scan = _button(tr("Control scan (S)"), _counts())
        self.end = _button(tr("End attempt (Enter)"), tr("The needle stays as it is and is scored"))
        self.abort = _button(
            tr("Abort (hold Esc)"), tr("Force to zero at once; the attempt is kept but not scored")
        )
        self._keys: list[tuple[QShortcut, QPushButton]] = []
        self._escape = HoldKey(Qt.Key.Key_Escape, self)
        self._escape.held.connect(self.abort.click)  # a disabled button ignores it
        self._lay_out()
        self._connect()
        self.show_state(None, False)

    def set_pedal(self, scans: bool) -> None:
        """Say what the scan's key does: it takes slices, or counts a scan only."""
        self.scan.setToolTip(_takes() if scans else _counts())

    def watch(self, window: QWidget) -> None:
        """Listen for Esc held down anywhere in `window`."""
        window.installEventFilter(self._escape)

    def show_state(self, state: State | None, can_start: bool, why: str = "") -> None:
        """Enable what is legal.

        Args:
            state: of the attempt; None without one.
            can_start: whether everything is there for a new attempt.
            why: it cannot start now, if there is more to say than that something is missing.
        """
        running = state in RUNNING
        self.start.setToolTip(why or _starts())
        for button, legal in (
            (self.start, can_start and not running),
            (self.scan, running and state is not State.WITHDRAWING),
            (self.end, running),
            (self.abort, running),
        ):
            button.setEnabled(legal)
        for shortcut, button in self._keys:
            shortcut.setEnabled(button.isEnabled())

    def _lay_out(self) -> None:
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.addWidget(self.start, 0, 0, 1, 2)
        grid.addWidget(self.scan, 1, 0)
        grid.addWidget(self.end, 1, 1)
        grid.addWidget(self.abort, 2, 0, 1, 2)

    def _connect(self) -> None:
        for button, signal, keys in (
            (self.start, self.start_requested, (Qt.Key.Key_F5,)),
            (self.scan, self.scan_requested, (Qt.Key.Key_S,)),
            (self.end, self.end_requested, (Qt.Key.Key_Return, Qt.Key.Key_Enter)),
            (self.abort, self.abort_requested, ()),
        ):
            button.clicked.connect(signal)
            for key in keys:
                shortcut = QShortcut(QKeySequence(key), self)
                shortcut.setAutoRepeat(False)
                shortcut.activated.connect(button.click)
                self._keys.append((shortcut, button))


def _starts() -> str:
    return tr("Arm the robot and begin recording (F5)")


def _counts() -> str:
    return tr("Counts a scan and keeps the needle's place with it")


def _takes() -> str:
    return tr("The pedal: takes the slices that are set below, with the needle where it is now")


def _button(text: str, help_text: str) -> QPushButton:
    button = QPushButton(text)
    button.setToolTip(help_text)
    # A button that keeps the focus would swallow the pad's keys; Space on it would repeat it.
    button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    return button
