"""The enabling switch on the page: a large button that is held, and the state of the forces."""

from PySide6.QtCore import QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFont, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton, QSizePolicy, QWidget

from app.views.exercise.enable_key import EnableKey, key_name
from app.views.exercise.enable_words import Enabling, enable_words
from app.views.kit import theme
from app.views.kit.text import tr

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
        """Whether key or button is held."""
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
        colour = QColor(verdict.look[0])
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
        self.setToolTip(tr(
            "The robot gives force only while {key}, a pedal or this button is held; the force "
            "rises within a second and is gone when you let go, or when the window loses the "
            "keyboard. After a fault let go and hold again.", key=key_name(self.key.key),
        ))  # fmt: skip

    def _hold(self, by_key: bool | None = None, by_button: bool | None = None) -> None:
        before = self.is_held
        self._by_key = self._by_key if by_key is None else by_key
        self._by_button = self._by_button if by_button is None else by_button
        if self.is_held is not before:
            self.held.emit(self.is_held)
