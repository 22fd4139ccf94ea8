"""The view `force_gauge`: the force along the needle, to be read at arm's length."""

from __future__ import annotations

from math import isfinite
from typing import Any, Final

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.core import state_vector as sv
from app.core.units import MILLIMETRE
from app.session.snapshot import Snapshot
from app.views.kit import theme
from app.views.kit.text import tr

DECLARATION: Final[dict[str, Any]] = {
    "view": "force_gauge",
    "title": "Force along the needle",
    "reads": ("axial_force", "bone_contact", "bone_crossed"),
}

FULL_N: Final = 8.0
"""Force at the ends of the bar [N]: what the friction of 100 mm of tissue comes to, and some."""

NUMBER_PX: Final = 30
"""Height of the number [px]: 8 mm on a usual screen, readable from 2 m."""

_QUIET: Final = 0.05
"""Below this force it is said that there is none [N]."""
STANDS_MM: Final = 2.0
"""A tip that is no further beyond a bone's surface stands on it; else it has crossed it [mm]."""

_BAR: Final = 16
_NUMBER_WIDTH: Final = 5.2
"""Width that the number keeps, in its own heights."""


def axial_force(snapshot: Snapshot) -> float | None:
    """Force of the tissue along the needle [N], positive where it pushes the tip out; None where
    there is no robot that tells.
    """
    if snapshot.device is None:
        return None
    force = float(snapshot.device.row[sv.AXIAL_FORCE])
    return force if isfinite(force) else None


def bone_crossed_mm(snapshot: Snapshot) -> float | None:
    """Return how far the tip is beyond the surface of bone [mm]; None where it touches none."""
    if snapshot.device is None or snapshot.device.row[sv.BONE_CONTACT] <= 0.0:
        return None
    way = float(snapshot.device.row[sv.BONE_CROSSED]) / MILLIMETRE
    return way if isfinite(way) else None


WORDS_FROM_PX: Final = 320
"""In a narrower gauge number and bar stand alone."""


class AxialGauge(QWidget):
    """A large number and a bar from its middle: to the right the tissue pushes the needle out."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._force: float | None = None
        self._bone_mm: float | None = None
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setToolTip(
            tr(
                "Force of the tissue along the needle, as the simulation has it: friction on the "
                "shaft. The robot cannot push along the needle; a simulated hand feels it."
            )
        )
        self.show_force(None)

    def sizeHint(self) -> QSize:
        """Preferred size."""
        return QSize(320, self._height())

    def minimumSizeHint(self) -> QSize:
        """Size that number and words need."""
        return QSize(200, self._height())

    @property
    def force(self) -> float | None:
        """Return what is shown [N]; None while nobody knows."""
        return self._force

    @property
    def number(self) -> str:
        """The number as it is written."""
        return "–" if self._force is None else tr("{force:.1f} N", force=abs(self._force))

    @property
    def words(self) -> str:
        """Return what the force does."""
        if self._bone_mm is not None and self._bone_mm > STANDS_MM:
            return tr("Bone crossed by {way:.1f} mm", way=self._bone_mm)
        if self._bone_mm is not None:
            return tr("Along the needle: the tip stands on bone ▶")
        if self._force is None:
            return tr("Force along the needle: not known")
        if abs(self._force) < _QUIET:
            return tr("Force along the needle: none")
        if self._force > 0.0:
            return tr("Along the needle: tissue pushes it out ▶")
        return tr("Along the needle: tissue holds it back ◀")

    def show_force(self, force: float | None, bone_mm: float | None = None) -> None:
        """Show a force [N], positive outwards, and how far the tip is beyond the surface of bone.

        None where nobody knows, and where it touches none.
        """
        rounded = None if force is None else round(force, 2)
        bone = None if bone_mm is None else round(bone_mm, 1)
        if (rounded, bone) == (self._force, self._bone_mm) and self.accessibleName():
            return
        self._force, self._bone_mm = rounded, bone
        self.setAccessibleName(f"{self.words}, {self.number}")
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw number, words and bar."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        large, height = self._letters(), self.height()
        left = _NUMBER_WIDTH * 0.6 * large
        painter.setFont(theme.font_of(large, bold=True))
        painter.setPen(QColor(theme.TEXT))
        flags = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        painter.drawText(QRectF(0, 0, left, height), flags, self.number)
        self._paint_bar(
            painter, QRectF(left + 12, height - _BAR - 3, self.width() - left - 16, _BAR)
        )
        if self.width() < WORDS_FROM_PX * theme.scale():
            return  # cut off they would say nothing; the side of the bar says the same
        painter.setFont(theme.font_of(theme.SMALL_PX))
        painter.setPen(QColor(theme.TEXT))
        above = QRectF(left + 12, 0, self.width() - left - 16, height - _BAR - 4)
        words = painter.fontMetrics().elidedText(
            self.words, Qt.TextElideMode.ElideRight, int(above.width())
        )
        painter.drawText(above, Qt.AlignmentFlag.AlignVCenter, words)

    def _paint_bar(self, painter: QPainter, bar: QRectF) -> None:
        painter.setPen(QPen(QColor(theme.BORDER), 1.0))
        painter.setBrush(QColor("#0e1114"))
        painter.drawRoundedRect(bar, 3, 3)
        middle, half = bar.center().x(), bar.width() / 2 - 2
        reach = half * max(-1.0, min(1.0, (self._force or 0.0) / FULL_N))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(theme.NEEDLE.qcolor())
        painter.drawRect(
            QRectF(min(middle, middle + reach), bar.top() + 2, abs(reach), bar.height() - 4)
        )
        painter.setPen(QPen(QColor(theme.IMAGE_LINE), 2.0))
        painter.drawLine(QPointF(middle, bar.top() - 2), QPointF(middle, bar.bottom() + 2))

    def _letters(self) -> int:
        narrow = self.width() < WORDS_FROM_PX * theme.scale()
        return theme.TITLE_PX if narrow else round(NUMBER_PX * theme.scale())

    def _height(self) -> int:
        return round(NUMBER_PX * theme.scale()) + 12
