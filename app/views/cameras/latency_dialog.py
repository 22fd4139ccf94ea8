"""The latency test: a patch of the screen blinks at random times, the camera watches it, the delay
is kept.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QProgressBar,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from app.core.progress import Progress
from app.tracking.cameras.settings import CameraSettings
from app.views.cameras.live import LiveCamera, LivePreview
from app.views.kit import theme
from app.views.kit.background import run_in_background
from app.views.kit.parts import PlainLabel, size_dialog
from app.views.kit.progress_strip import ProgressStrip
from app.views.kit.text import tr, translated

if TYPE_CHECKING:
    from app.tracking.cameras.latency import CameraLatency
    from app.views.shell.services import Services


_DARK, _BRIGHT = QColor(0, 0, 0), QColor(255, 255, 255)
_LEAD = 0.3
"""Time [s] for which the patch is dark before it begins."""


class BlinkPatch(QWidget):
    """Blinks once through a list of times.

    Signals:
        progressed(float): share of the changes that were shown, 0 to 1.
        finished(): all were shown.
    """

    progressed = Signal(float)
    finished = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.shown: list[float] = []
        self._times: Sequence[float] = ()
        self._start = 0.0
        self._bright = False
        self._timer = QTimer(self, singleShot=True)
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._change)
        self.setMinimumSize(260, 260)

    def begin(self, times: Sequence[float]) -> None:
        """Blink at these times [s] from now on; `shown` gets the times [s] of the changes."""
        self._times, self._start = times, time.monotonic() + _LEAD
        self.shown, self._bright = [], False
        self.update()
        self._wait()

    def stop(self) -> None:
        """Stay dark."""
        self._timer.stop()
        self._bright = False
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Fill the patch."""
        QPainter(self).fillRect(self.rect(), _BRIGHT if self._bright else _DARK)

    def _wait(self) -> None:
        due = self._start + self._times[len(self.shown)] - time.monotonic()
        self._timer.start(max(0, round(1e3 * due)))

    def _change(self) -> None:
        self._bright = not self._bright
        self.repaint()  # at once; what follows is the screen's own delay
        self.shown.append(time.monotonic())
        self.progressed.emit(len(self.shown) / len(self._times))
        if len(self.shown) < len(self._times):
            self._wait()
        else:
            self.finished.emit()


TAIL_MS = 700
"""The last change has reached the camera by then."""


class LatencyDialog(QDialog):
    """Measures one camera.

    Args:
        settings: the cameras.
        side: `left` or `right`.
        services: opens the camera.
        free: waits, in another thread, until nobody else has it.
        parent: the window.
        seconds: how long the patch blinks.

    Signals:
        measured(str, Latency): the user kept the result for this side.
    """

    measured = Signal(str, object)

    def __init__(
        self,
        settings: CameraSettings,
        side: str,
        services: Services,
        free: Callable[[], object],
        parent: QWidget | None = None,
        seconds: float = 20.0,
    ) -> None:
        super().__init__(parent)
        name = {"left": tr("left"), "right": tr("right")}[side]
        self.setWindowTitle(tr("Latency of the {name} camera", name=name))
        self._side, self._seconds, self._rate = side, seconds, settings.rate_hz
        self.patch, self.preview = BlinkPatch(self), LivePreview(self)
        self.bar, self.outcome = QProgressBar(self), PlainLabel(self)
        self.waiting = ProgressStrip(self)
        self.start = QPushButton(tr("Start"))
        self.keep = QPushButton(tr("Keep"))
        self.latency: CameraLatency | None = None
        self._lay_out()

        def operation(progress: Progress) -> LiveCamera:
            free()
            return services.open_camera(settings, side, progress)

        self._camera: LiveCamera | None = None
        self.preview.opened.connect(self._take)
        self.preview.cancelled.connect(self.reject)
        self.preview.open(operation, self.waiting)

    def begin(self) -> None:
        """Blink, and keep the light of every picture."""
        from app.tracking.cameras.latency import blink_times  # scipy: when it is needed

        if self.preview.camera is None or self._camera is None:
            return
        self.latency = None
        self.keep.setEnabled(False)
        self.start.setEnabled(False)
        self.say(tr("measuring: leave camera and window where they are"))
        self._camera.measure_light(True)
        rng = np.random.default_rng()
        self.patch.begin(blink_times(self._seconds, self._rate, rng).tolist())

    def closed(self) -> Callable[[], object]:
        """Return what waits until the camera is closed; for other threads."""
        return self.preview.closed()

    def done(self, result: int) -> None:
        """Let go of the camera."""
        self.patch.stop()
        self.preview.stop()
        super().done(result)

    def say(self, text: str, verdict: str = "") -> None:
        """Show a line about the test."""
        colour, symbol = theme.VERDICTS[verdict] if verdict else (theme.TEXT, "")
        self.outcome.setStyleSheet(f"color: {colour};")
        self.outcome.setText(f"{symbol} {text}".strip())

    def _take(self, camera: LiveCamera) -> None:
        self._camera = camera
        self.start.setEnabled(True)

    def _evaluate(self) -> None:
        camera = self._camera if self.preview.camera is not None else None
        self.start.setEnabled(camera is not None)
        if camera is None:
            self.say(tr("the camera was lost; start again"), "bad")
            return
        times, light = camera.light()
        camera.measure_light(False)
        shown = list(self.patch.shown)

        def operation(_: Progress) -> CameraLatency:
            from app.tracking.cameras.latency import estimate_latency, liveliest

            return estimate_latency(shown, times, liveliest(light))

        run_in_background(
            self, operation, self._show, lambda error: self.say(translated(error), "bad")
        )

    def _show(self, latency: CameraLatency) -> None:
        self.latency = latency
        self.keep.setEnabled(True)
        self.say(
            tr("From the screen to the delivered picture: {value}", value=latency.text), "good"
        )

    def _keep(self) -> None:
        if self.latency is not None:
            latency = self.latency
            self.accept()
            self.measured.emit(self._side, latency)

    def _lay_out(self) -> None:
        words = PlainLabel(
            tr(
                "Point the camera at the patch, a hand's breadth away, so that the patch fills a "
                "good part of the picture. The patch blinks at random for {seconds:.0f} s. The "
                "result contains the screen's own delay, usually one or two of its pictures (10 "
                "to 30 ms).",
                seconds=self._seconds,
            )
        )
        words.setWordWrap(True)
        self.outcome.setWordWrap(True)
        self.outcome.setMinimumHeight(3 * theme.FONT_PX)
        self.bar.setRange(0, 1000)
        self.bar.setTextVisible(False)
        self.start.setProperty("role", "primary")
        self.start.setEnabled(False)
        self.keep.setEnabled(False)
        self.start.clicked.connect(lambda _=False: self.begin())
        self.keep.clicked.connect(lambda _=False: self._keep())
        self.patch.progressed.connect(lambda share: self.bar.setValue(round(1000 * share)))
        self.patch.finished.connect(lambda: QTimer.singleShot(TAIL_MS, self._evaluate))
        pair = QHBoxLayout()
        pair.setSpacing(theme.MARGIN)
        pair.addWidget(self.patch, 1)
        pair.addWidget(self.preview, 1)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close, parent=self)
        buttons.addButton(self.start, QDialogButtonBox.ButtonRole.ActionRole)
        buttons.addButton(self.keep, QDialogButtonBox.ButtonRole.ActionRole)
        buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.setSpacing(theme.MARGIN)
        column.addWidget(words)
        column.addWidget(self.waiting)
        column.addLayout(pair, 1)
        column.addWidget(self.bar)
        column.addWidget(self.outcome)
        column.addWidget(buttons)
        size_dialog(self, 820, 560)
