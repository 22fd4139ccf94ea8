"""The enabling switch: a large button, a key or a pedal held down, and the state of the forces."""

from dataclasses import dataclass

from PySide6.QtCore import QEvent, QObject, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFont, QKeyEvent, QKeySequence, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton, QSizePolicy, QWidget

from app.core import state_vector as sv
from app.session.machine import RUNNING, State
from app.session.snapshot import Snapshot
from app.views.exercise.readings import fault_text
from app.views.kit import theme
from app.views.kit.text import literal, tr
from app.views.kit.verdict import Verdict

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


@dataclass(frozen=True, slots=True)
class Enabling:
    """How the forces are armed now.

    Attributes:
        running: whether an attempt runs; without one there is nothing to arm.
        held: whether key, pedal or button is held.
        ramp: arming ramp, 0 off … 1 fully on.
        fault: what holds the force at zero, in words; empty if nothing does.
        ready: whether an attempt can begin on this robot: it is homed, its signs are checked.
    """

    running: bool
    held: bool
    ramp: float
    fault: str = ""
    ready: bool = True


def enabling(snapshot: Snapshot, held: bool) -> Enabling:
    """Return how a snapshot says that the forces are armed."""
    device = snapshot.device
    ramp = float(device.row[sv.ARMING]) if device is not None else 0.0
    fault = fault_text(int(device.fault)) if device is not None else ""
    clearance = snapshot.clearance
    ready = clearance is None or clearance.homed > 0.5
    running = snapshot.state in RUNNING and snapshot.state is not State.WITHDRAWING
    return Enabling(running, held, min(1.0, max(0.0, ramp)), fault, ready)


def enable_words(now: Enabling, key: str) -> tuple[Verdict, str, str]:
    """Verdict, the state in a few words, and what to do; `key` is the key's name."""
    if not now.running and not now.ready:
        return Verdict.BAD, tr("✖ robot not ready"), tr("why, and what to do: Robot's health (F8)")
    if not now.running:
        return Verdict.IDLE, tr("– forces off"), tr("start the attempt first")
    if now.fault:
        todo = tr("let go of {key}", key=key) if now.held else tr("hold {key} again", key=key)
        return Verdict.BAD, tr("✖ no force: {todo}", todo=todo), now.fault
    if not now.held:
        return Verdict.IDLE, tr("○ forces off"), hold(key)
    if now.ramp < 1.0:
        percent = tr("◐ switching on {percent:.0f} %", percent=100 * now.ramp)
        return Verdict.WARNING, percent, tr("keep holding {key}", key=key)
    return Verdict.GOOD, tr("● FORCES ON"), tr("let go of {key}: forces off", key=key)


def hold(key: str) -> str:
    """Say how to switch on."""
    return tr("hold {key}, pedal or this button to switch on", key=key)


_OFF = Enabling(False, False, 0.0)


class EnableSwitch(QAbstractButton):
    """Held by mouse, touch, key or pedal; the forces are armed only while it is held.

    Signals:
        held(bool): somebody began to hold it, or nobody does any more.
    """

    held = Signal(bool)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.key = EnableKey(self)
        self._now = _OFF
        self._by_key = self._by_button = False
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # Space would press it and stay pressed
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.pressed.connect(lambda: self._hold(by_button=True))
        self.released.connect(lambda: self._hold(by_button=False))
        self.key.held.connect(lambda down: self._hold(by_key=down))
        self._explain()
        self.show_enabling(_OFF)
        self.hide()

    @property
    def is_held(self) -> bool:
        """Return whether key or button is held."""
        return self._by_key or self._by_button

    @property
    def words(self) -> tuple[str, str]:
        """State, and what to do."""
        _, title, help_text = enable_words(self._now, key_name(self.key.key))
        return title, help_text

    def set_key(self, key: Qt.Key) -> None:
        """Watch another key."""
        self.key.set_key(key)
        self._explain()
        self.update()

    def set_wanted(self, wanted: bool) -> None:
        """Show the switch and watch the key, or neither: the attempt arms by itself then."""
        self.setVisible(wanted)
        if not wanted:
            self.release()

    def release(self) -> None:
        """Let go, whoever holds it."""
        self.key.set_active(False)
        self.setDown(False)
        self._hold(by_button=False)

    def show_enabling(self, now: Enabling) -> None:
        """Show how the forces are armed; the key is watched only while an attempt runs."""
        if now != self._now:
            self._now = now
            self.setAccessibleName(". ".join(self.words))
            self.update()
        live = now.running and not self.isHidden()
        self.setEnabled(live)
        self.key.set_active(live)

    def sizeHint(self) -> QSize:
        """Room for three lines of a fault, so that nothing below moves when one comes."""
        return QSize(240, 80)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw frame, ramp, state and what to do."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        verdict, title, help_text = enable_words(self._now, key_name(self.key.key))
        colour = QColor(verdict.colour_and_symbol[0])
        box = QRectF(self.rect()).adjusted(1, 1, -1, -1)
        painter.setPen(QPen(colour, 2.0))
        painter.setBrush(QColor(theme.SURFACE))
        painter.drawRoundedRect(box, 6, 6)
        self._paint_ramp(painter, box, colour)
        font = QFont(painter.font())
        font.setPixelSize(theme.TITLE_PX - 2)
        font.setBold(True)
        painter.setFont(font)
        painter.setPen(colour)
        painter.drawText(box.adjusted(10, 6, -10, 0), Qt.AlignmentFlag.AlignLeft, title)
        font.setPixelSize(theme.SMALL_PX)
        font.setBold(False)
        painter.setFont(font)
        painter.setPen(QColor(theme.TEXT))
        below = box.adjusted(10, 29, -10, 0)
        painter.drawText(below, Qt.AlignmentFlag.AlignLeft | Qt.TextFlag.TextWordWrap, help_text)

    def _paint_ramp(self, painter: QPainter, box: QRectF, colour: QColor) -> None:
        """Fill the frame from the left as the force rises."""
        if not self._now.held or self._now.fault or self._now.ramp <= 0.0:
            return
        filled = QRectF(box)
        filled.setWidth(box.width() * self._now.ramp)
        shade = QColor(colour)
        shade.setAlphaF(0.18)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(shade)
        painter.drawRoundedRect(filled, 6, 6)

    def _explain(self) -> None:
        self.setToolTip(
            literal(
                tr(
                    "The robot gives force only while {key}, a pedal or this button is held; the "
                    "force rises within a second and is gone when you let go, or when the window "
                    "loses the keyboard. After a fault let go and hold again.",
                    key=key_name(self.key.key),
                )
            )
        )

    def _hold(self, by_key: bool | None = None, by_button: bool | None = None) -> None:
        before = self.is_held
        self._by_key = self._by_key if by_key is None else by_key
        self._by_button = self._by_button if by_button is None else by_button
        if self.is_held is not before:
            self.held.emit(self.is_held)
