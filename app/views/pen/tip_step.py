"""Measuring the tip, step by step: rock the pen, see where it still must lean, keep or drop the
result.
"""

from __future__ import annotations

from math import cos, pi, radians, sin
from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QHBoxLayout, QProgressBar, QSizePolicy, QVBoxLayout, QWidget

from app.core.errors import AcusError
from app.tracking.pen.calibrating import LEANT, SIDES, WANTED, Lean, PenCalibration, Rocking
from app.tracking.pen.settings import PenSettings, can_undo, save_pen, undo_pen
from app.views.kit import theme
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.parts import button, label
from app.views.kit.text import tr, translated
from app.views.kit.verdict import Verdict, tell
from app.views.pen.status import Lines
from app.views.pen.words import Line, result_lines, tip_line

if TYPE_CHECKING:
    from app.views.pen.port import PenPort


_RIM = sin(radians(40.0))
"""Sine of the lean at the disc's rim."""

_WORDS = 20.0
"""Room for the words round the disc [px]."""


class DirectionsView(QWidget):
    """A disc of sectors, one for each side; those that the pen has leant to are filled."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.covered: frozenset[int] = frozenset()
        self.now: Lean | None = None
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.setToolTip(
            tr(
                "Seen from above, the webcam at the bottom. A sector fills when the pen has leant "
                "that way; the dot is how it leans now"
            )
        )

    def sizeHint(self) -> QSize:
        """Large enough to be read from a table's other side."""
        return QSize(188, 176)

    def show_leans(self, covered: frozenset[int], now: Lean | None) -> None:
        """Show which sides are covered, and how the pen leans now."""
        if covered != self.covered or now != self.now:
            self.covered, self.now = covered, now
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint sectors, the ring from which a lean counts, and the dot."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        middle = QPointF(0.5 * self.width(), 0.5 * self.height())
        radius = 0.5 * self.height() - _WORDS
        self._paint_sectors(painter, middle, radius)
        painter.setPen(QColor(theme.TEXT_DIM))
        box = QRectF(0.0, 0.0, self.width(), _WORDS)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, tr("away"))
        box.moveBottom(self.height())
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, tr("webcam"))
        if self.now is not None:
            scale = radius / _RIM
            x, y = self.now.right * scale, -self.now.away * scale
            longest = max(1.0, (x * x + y * y) ** 0.5 / radius)
            painter.setPen(QPen(QColor("#000000"), 2.0))
            painter.setBrush(QColor(theme.WARNING))
            painter.drawEllipse(middle + QPointF(x, y) / longest, 6.0, 6.0)

    def _paint_sectors(self, painter: QPainter, middle: QPointF, radius: float) -> None:
        disc = QRectF(middle.x() - radius, middle.y() - radius, 2 * radius, 2 * radius)
        wide = 360.0 / len(SIDES)
        for side in range(len(SIDES)):
            filled = side in self.covered
            painter.setPen(QPen(QColor(theme.BORDER), 1.5))
            painter.setBrush(QColor(theme.GOOD if filled else theme.SURFACE))
            painter.drawPie(disc, round(16 * (side - 0.5) * wide), round(16 * wide))
            if filled:  # not by colour alone
                angle = 2.0 * pi * side / len(SIDES)
                place = middle + QPointF(cos(angle), -sin(angle)) * (0.72 * radius)
                painter.setPen(QColor(theme.present().on_accent))
                painter.drawText(
                    QRectF(place.x() - 9, place.y() - 9, 18, 18), Qt.AlignmentFlag.AlignCenter, "✔"
                )
        painter.setBrush(QColor(theme.BACKGROUND))
        painter.setPen(QPen(QColor(theme.BORDER), 1.5))
        inner = radius * sin(LEANT) / _RIM
        painter.drawEllipse(middle, inner, inner)


POLL_MS: Final = 100


class TipStep(QWidget):
    """Collects positions of a pen that is rocked, computes the tip beside the window, keeps it.

    Signals:
        kept(): another tip is in use: saved, or taken back.
    """

    kept = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._settings: PenSettings | None = None
        self._live: PenPort | None = None
        self.rocking: Rocking | None = None
        self.found: PenCalibration | None = None
        self._task: BackgroundTask | None = None
        self.directions, self.bar = DirectionsView(self), QProgressBar(self)
        self.state, self.lines = label(), Lines(4, self)
        self.begin = button(tr("&Measure the tip"))
        self.compute = button(tr("Compute now"))
        self.stop = button(tr("Stop"))
        self.save = button(tr("&Save"), "primary")
        self.undo = button(tr("Undo"))
        self._timer = QTimer(self, interval=POLL_MS)
        self._timer.timeout.connect(self.poll)
        self._lay_out()
        self._connect()
        self.refresh()

    @property
    def running(self) -> bool:
        """Return whether positions are collected or the tip is computed."""
        return self.rocking is not None or self._task is not None

    def set_pen(self, settings: PenSettings | None, live: PenPort | None) -> None:
        """Measure another pen; None while there is none. What was collected is dropped."""
        if self.running:
            self.end(tr("stopped: pen or webcam are others now"))
        if settings != self._settings:
            self.found = None
        self._settings, self._live = settings, live
        self.refresh()

    def start(self) -> None:
        """Begin to collect."""
        if self._live is None or self.running:
            return
        self.found = None
        self.rocking = Rocking()
        self._live.listen(self.rocking.add)
        self._timer.start()
        self.refresh()
        self.poll()

    def end(self, reason: str = "") -> None:
        """Stop and drop what was collected; idempotent."""
        self._release()
        self._task = None  # what it finds is not taken any more
        self.bar.setValue(0)
        self.refresh()
        if reason:
            tell(self.state, Verdict.IDLE, reason)

    def poll(self) -> None:
        """Show how far it is; compute once there is enough."""
        rocking = self.rocking
        if rocking is None:
            return
        self.directions.show_leans(rocking.covered, rocking.now)
        self.bar.setValue(round(1000 * rocking.progress))
        self.compute.setEnabled(rocking.computable)
        count, missing = len(rocking.collector.poses), rocking.missing
        words = tr("{n} of {all} positions", n=min(count, WANTED), all=WANTED)
        if missing:
            words += tr("; still missing: {side}", side=tr(missing[0]))
        elif count < WANTED:
            words += tr("; all sides are covered, go on rocking")
        tell(self.state, Verdict.IDLE, words)
        if rocking.enough:
            self.finish()

    def finish(self) -> None:
        """Compute the tip from what there is, beside the window."""
        rocking, settings = self.rocking, self._settings
        if rocking is None or settings is None:
            return
        self._release()

        def operation(_: object) -> PenCalibration:
            return rocking.collector.finish(settings.profile())

        task = self._task = run_in_background(
            self,
            operation,
            lambda found: self._take(found) if self._task is task else None,
            lambda error: self._refuse(error) if self._task is task else None,
        )
        tell(self.state, Verdict.IDLE, tr("computing …"))
        self.refresh()

    def keep(self) -> None:
        """Keep the tip that was found, and use it."""
        if self.found is None or self._settings is None:
            return
        try:
            save_pen(self.found.pen, self._settings.kept_name)
        except (AcusError, OSError) as error:
            tell(self.state, Verdict.BAD, translated(error))
            return
        self.found = None
        self.refresh()
        tell(self.state, Verdict.GOOD, tr("saved and in use"))
        self.kept.emit()

    def take_back(self) -> None:
        """Use the tip before this one; once more uses this one again."""
        if self._settings is None:
            return
        try:
            measured = undo_pen(self._settings.kept_name)
        except OSError as error:
            tell(self.state, Verdict.BAD, translated(error))
            return
        self.refresh()
        told = tr("the tip before is in use") if measured else tr("the drawing's tip is in use")
        tell(self.state, Verdict.GOOD, told)
        self.kept.emit()

    def refresh(self) -> None:
        """Enable what can be done now."""
        ready = self._live is not None and not self.running
        collecting, practice = self.rocking is not None, self._simulated
        self.begin.setVisible(not collecting)
        self.begin.setEnabled(ready)
        self.begin.setText(
            tr("&Measure again") if self.found is not None else tr("&Measure the tip")
        )
        for one in (self.compute, self.stop):
            one.setVisible(collecting)
        self.save.setVisible(self.found is not None)
        self.save.setEnabled(not practice)
        self.save.setToolTip(
            tr("A simulated pen's tip is not saved: it would be mistaken for the real one's")
            if practice
            else tr("Keep this tip; it is used from now on")
        )
        name = "" if self._settings is None else self._settings.kept_name
        self.undo.setEnabled(ready and bool(name) and can_undo(name))
        if not self.running:
            self.lines.show_lines(() if self.found is None else result_lines(self.found))
        if not self.running and self.found is None:
            self._show_tip()

    @property
    def _simulated(self) -> bool:
        return self._settings is not None and self._settings.simulated

    def _show_tip(self) -> None:
        self.directions.show_leans(frozenset(), None)
        self.bar.setValue(0)
        if self._settings is None:
            return
        try:
            line = tip_line(self._settings.profile())
        except AcusError as error:
            line = Line(Verdict.BAD, translated(error))
        tell(self.state, line.verdict, line.text)

    def _take(self, result: PenCalibration) -> None:
        self._task, self.found = None, result
        self.bar.setValue(1000)
        self.refresh()
        practised = tr("done; a simulated pen is practice only and is not kept")
        words = practised if self._simulated else tr("measured, not saved yet")
        tell(self.state, Verdict.GOOD if self._simulated else Verdict.WARNING, words)

    def _refuse(self, error: Exception) -> None:
        self._task = None
        self.refresh()
        tell(self.state, Verdict.BAD, translated(error))

    def _release(self) -> None:
        """Collect no more; what was collected stays with whoever holds it."""
        self._timer.stop()
        self.rocking = None
        if self._live is not None:
            self._live.listen(None)

    def _lay_out(self) -> None:
        self.bar.setRange(0, 1000)
        self.bar.setTextVisible(False)
        self.bar.setFixedHeight(10)
        self.undo.setToolTip(tr("Use the tip before this one; once more uses this one again"))
        self.compute.setToolTip(tr("Do not wait for all positions and sides"))
        words = label(
            tr(
                "Stand the tip in a dimple on the sheet, hold it there, and rock the pen slowly to "
                "every side, by 30°."
            ),
            "dim",
        )
        beside = QVBoxLayout()
        beside.addWidget(words)
        beside.addWidget(self.bar)
        beside.addWidget(self.state)
        beside.addStretch(1)
        upper = QHBoxLayout()
        upper.addWidget(self.directions)
        upper.addLayout(beside, 1)
        buttons = QHBoxLayout()
        for one in (self.begin, self.compute, self.stop, self.save, self.undo):
            buttons.addWidget(one)
        buttons.addStretch(1)
        rows = QVBoxLayout(self)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.setSpacing(theme.SPACING)
        rows.addLayout(upper)
        rows.addWidget(self.lines)
        rows.addLayout(buttons)

    def _connect(self) -> None:
        self.begin.clicked.connect(lambda _=False: self.start())
        self.compute.clicked.connect(lambda _=False: self.finish())
        self.stop.clicked.connect(lambda _=False: self.end(tr("stopped, nothing is changed")))
        self.save.clicked.connect(lambda _=False: self.keep())
        self.undo.clicked.connect(lambda _=False: self.take_back())
