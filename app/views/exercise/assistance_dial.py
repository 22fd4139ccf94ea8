"""The dial of the assistance: from pushing away, through nothing, to guiding."""

from math import isfinite
from typing import Final

from PySide6.QtCore import QPointF, QRectF, QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetrics,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QWheelEvent,
)
from PySide6.QtWidgets import QGridLayout, QSizePolicy, QSlider, QWidget

from app.views.kit import theme
from app.views.kit.parts import PlainLabel
from app.views.kit.text import literal, tr

DEAD_ZONE: Final = 0.05
"""Below this share the force laws do nothing; the dial says `off` and shows the zone."""

_REPELS, _GUIDES = "◀▶", "▶◀"
_FULL: Final = 100
_HANDLE: Final = 16
"""Width of the slider's handle [px], as the style sheet draws it."""


class AssistanceDial(QWidget):
    """A slider with its scale below and its value in words beside it.

    Signals:
        changed(float): the user chose a share, -1 full repulsion … 0 off … 1 full guidance.
    """

    changed = Signal(float)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.slider = _Slider(self)
        self.words = PlainLabel(self)
        self.words.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.words.ensurePolished()
        widest = max(self.words.fontMetrics().horizontalAdvance(share_words(s)) for s in (-1, 1))
        self.words.setMinimumWidth(widest + 2)  # the slider keeps its length whatever is said
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setVerticalSpacing(0)
        grid.setColumnStretch(0, 1)
        grid.addWidget(self.slider, 0, 0)
        grid.addWidget(self.words, 0, 1)
        grid.addWidget(_Scale(self), 1, 0)
        self.slider.valueChanged.connect(self._show)
        self.slider.valueChanged.connect(lambda percent: self.changed.emit(percent / _FULL))
        self._help = tr(
            "How the robot helps. To the right it guides the needle back to the planned path, to "
            "the left it pushes the needle away from it, which is harder to master; in the middle "
            "it does nothing. Arrow keys 1 %, Page keys 10 %, Home or double click: off."
        )
        self.set_locked("")
        self.setFocusProxy(self.slider)
        self._show(self.slider.value())

    @property
    def share(self) -> float:
        """Return what is shown, -1…1."""
        return self.slider.value() / _FULL

    def set_share(self, share: float) -> None:
        """Show a share that came from elsewhere; emits nothing. Not a number counts as 0."""
        percent = round(_FULL * share) if isfinite(share) else 0
        with QSignalBlocker(self.slider):
            self.slider.setValue(percent)
        self._show(self.slider.value())

    def set_locked(self, reason: str) -> None:
        """Keep the dial as it is, because of `reason`; empty lets it be turned again."""
        self.slider.setEnabled(not reason)
        self.setToolTip(literal(reason or self._help))

    def _show(self, percent: int) -> None:
        text = share_words(percent / _FULL)
        self.words.setText(text)
        self.slider.setAccessibleDescription(text)


def share_words(share: float) -> str:
    """Say a share of assistance, -1…1, with a mark that tells pushing from guiding."""
    percent = round(_FULL * abs(share))
    if abs(share) < DEAD_ZONE:
        return tr("○ off")
    if share > 0.0:
        return tr("▶◀ guides {percent} %", percent=percent)
    return tr("◀▶ repels {percent} %", percent=percent)


class _Slider(QSlider):
    """Turns only on purpose: the wheel needs the focus, Home and a double click switch off."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        self.setRange(-_FULL, _FULL)
        self.setPageStep(10)
        self.setValue(_FULL)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName(tr("Assistance"))

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Leave the wheel to the panel behind, unless the dial was chosen first."""
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            event.ignore()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Home would jump to full repulsion; it switches off instead."""
        if event.key() == Qt.Key.Key_Home:
            self.setValue(0)
        else:
            super().keyPressEvent(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Switch off."""
        self.setValue(0)


class _Scale(QWidget):
    """Ticks, the dead zone, and which side does what."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def sizeHint(self) -> QSize:
        """Preferred size."""
        return QSize(160, 24)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the scale under the groove that the handle's middle runs along."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        left, right = _HANDLE / 2, self.width() - _HANDLE / 2
        middle, half = (left + right) / 2, (right - left) / 2
        zone = half * DEAD_ZONE
        painter.fillRect(QRectF(middle - zone, 0, 2 * zone, 6), QColor(theme.TEXT_DIM))
        painter.setPen(QPen(QColor(theme.TEXT_DIM), 1.0))
        for share in (-1.0, -0.5, 0.5, 1.0):
            x = middle + share * half
            painter.drawLine(QPointF(x, 0), QPointF(x, 5))
        font = QFont(painter.font())
        font.setPixelSize(theme.SMALL_PX - 1)
        painter.setFont(font)
        box = QRectF(0, 7, self.width(), self.height() - 7)
        flags = Qt.AlignmentFlag.AlignVCenter
        words = (tr("repel"), tr("off"), tr("guide"))
        sides = (
            Qt.AlignmentFlag.AlignLeft,
            Qt.AlignmentFlag.AlignHCenter,
            Qt.AlignmentFlag.AlignRight,
        )
        for word, side in zip(apart(words, QFontMetrics(font), self.width()), sides, strict=True):
            painter.drawText(box, flags | side, word)


def apart(words: tuple[str, str, str], metrics: QFontMetrics, width: int) -> tuple[str, str, str]:
    """Return words for left, middle and right of a width [px] that do not run into each other.

    Where they would, the signs of the value above stand at both sides; the middle one stays.
    """
    left, middle, right = words
    room = (width - metrics.horizontalAdvance(middle)) // 2 - metrics.horizontalAdvance(" ")
    if all(metrics.horizontalAdvance(word) <= room for word in (left, right)):
        return words
    return _REPELS, middle, _GUIDES
