"""A camera as dialogs show it: its live picture with a line drawn into it, and what is wrong with
it.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QColor, QImage, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QVBoxLayout, QWidget

from app.core.progress import Progress
from app.views.kit import theme
from app.views.kit.background import BackgroundTask, Indicator, run_in_background
from app.views.kit.parts import PlainLabel
from app.views.kit.text import tr, translated
from app.views.kit.themes import DARK

if TYPE_CHECKING:
    from app.core.arrays import FloatArray
    from app.tracking.cameras.camera import CameraFrame, Image
    from app.tracking.cameras.watch import CameraHealth


_LINE = QColor(DARK.good)
_DARK = QColor(0, 0, 0, 150)


class PictureView(QWidget):
    """Shows a picture (blue, green, red) and an outline in its pixels."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._image: Image | None = None
        self._outline: FloatArray | None = None
        self._size = (640, 480)
        self._dimmed = False
        self.setMinimumSize(280, 210)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def sizeHint(self) -> QSize:
        """Half a usual picture."""
        return QSize(400, 300)

    @property
    def has_image(self) -> bool:
        """Return whether there is a picture."""
        return self._image is not None

    def show_image(self, image: Image | None) -> None:
        """Show a picture, (height, width, 3); None shows none."""
        if image is not self._image:
            self._image = image
            self.update()

    def set_outline(self, outline: FloatArray | None, size: tuple[int, int]) -> None:
        """Draw a closed line [px], (m, 2), of pictures of a size (width, height)."""
        self._outline, self._size = outline, size
        self.update()

    def set_dimmed(self, dimmed: bool) -> None:
        """Darken the picture: it is an old one."""
        if dimmed != self._dimmed:
            self._dimmed = dimmed
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint picture and outline."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(theme.IMAGE_BACKGROUND))
        frame = self._frame()
        if self._image is None:
            painter.setPen(QColor(theme.IMAGE_DIM))
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, tr("no picture"))
        else:
            height, width = self._image.shape[:2]
            image = QImage(
                self._image.tobytes(), width, height, 3 * width, QImage.Format.Format_BGR888
            )
            painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
            painter.drawImage(frame, image)
            if self._dimmed:
                painter.fillRect(frame, _DARK)
        self._draw_outline(painter, frame)

    def _frame(self) -> QRectF:
        """Return where the picture lies: as large as it fits, in the middle."""
        width, height = self._size
        if self._image is not None:
            height, width = self._image.shape[:2]
        scale = min(self.width() / width, self.height() / height)
        w, h = scale * width, scale * height
        return QRectF(0.5 * (self.width() - w), 0.5 * (self.height() - h), w, h)

    def _draw_outline(self, painter: QPainter, frame: QRectF) -> None:
        if self._outline is None or not self._outline.size:
            return
        width, height = self._size
        scale_x, scale_y = frame.width() / width, frame.height() / height
        points = [
            QPointF(frame.x() + (u + 0.5) * scale_x, frame.y() + (v + 0.5) * scale_y)
            for u, v in self._outline.tolist()
        ]
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setClipRect(frame)
        painter.setPen(QPen(QColor(0, 0, 0, 160), 4.0))
        painter.drawPolygon(QPolygonF(points))
        painter.setPen(QPen(_LINE, 2.0))
        painter.drawPolygon(QPolygonF(points))


POLL_MS = 33


class ShownCamera(Protocol):
    """A camera that is open, and whose picture is shown."""

    def newest(self) -> CameraFrame | None:
        """Return the newest picture, or None before the first."""
        ...

    def health(self) -> CameraHealth:
        """Return how it does now."""
        ...

    def settings(self) -> tuple[str, ...]:
        """Return what the driver accepted, a line each."""
        ...

    def close(self) -> None:
        """Let go of it; idempotent; may wait for threads."""
        ...


class LiveCamera(ShownCamera, Protocol):
    """A camera that is open, and whose light is measured."""

    def measure_light(self, wanted: bool) -> None:
        """Begin to keep the light of every picture, from none, or stop."""
        ...

    def light(self) -> tuple[FloatArray, FloatArray]:
        """Return times of delivery [s], (m,), and light, (m, tiles)."""
        ...


class ConePort(Protocol):
    """The needle's cone in both pictures (`tracking.optics.view_cone.ViewCone`)."""

    @property
    def share(self) -> float:
        """Share that both cameras see, 0 to 1."""
        ...

    @property
    def shares(self) -> tuple[float, float]:
        """Share that each sees, 0 to 1."""
        ...

    @property
    def outlines(self) -> tuple[FloatArray, FloatArray]:
        """Closed line in each picture [px], (m, 2)."""
        ...

    def losses(self) -> tuple[str, ...]:
        """Say where the cone is lost."""
        ...


class AimPort(Protocol):
    """What the cameras see of the cone, and whose cameras they are."""

    @property
    def cone(self) -> ConePort:
        """The cone."""
        ...

    @property
    def basis(self) -> str:
        """Calibration, or the rig as designed."""
        ...

    @property
    def assumed(self) -> bool:
        """Return whether real cameras are taken to stand as designed, never measured."""
        ...

    @property
    def image_size(self) -> tuple[int, int]:
        """Width, height [px] that the outlines count in."""
        ...


class _Opening:
    """A camera that is being opened; who no longer wants it need not wait for it."""

    def __init__(self, open_camera: Callable[[Progress], ShownCamera]) -> None:
        self._open = open_camera
        self._lock = threading.Lock()
        self._stopped = False
        self._camera: ShownCamera | None = None
        self.ended = threading.Event()

    def run(self, progress: Progress) -> ShownCamera:
        """Open it, in another thread."""
        try:
            camera = self._open(progress)
        except BaseException:
            self.ended.set()
            raise
        with self._lock:
            self._camera, stopped = camera, self._stopped
        if stopped:
            self._close(camera)
        return camera

    def stop(self) -> None:
        """Close it, now or as soon as it is open; `ended` says when."""
        with self._lock:
            stopped, self._stopped, camera = self._stopped, True, self._camera
        if camera is not None and not stopped:
            threading.Thread(target=self._close, args=(camera,), daemon=True).start()

    def _close(self, camera: ShownCamera) -> None:
        try:
            camera.close()
        finally:
            self.ended.set()


class LivePreview(QWidget):
    """Live picture of one camera, and one line about it.

    Signals:
        opened(object): the camera that delivers now, as `open_camera` gave it.
        failed(object): the error that kept it from opening; it is said below the picture too.
        cancelled(): the user did not wait for it.
    """

    opened = Signal(object)
    failed = Signal(object)
    cancelled = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.picture, self.note = PictureView(self), PlainLabel(self)
        self.note.setWordWrap(True)
        self.note.setMinimumHeight(3 * theme.FONT_PX)
        self.camera: ShownCamera | None = None
        self._opening: _Opening | None = None
        self._last: _Opening | None = None
        self._task: BackgroundTask | None = None
        self._timer = QTimer(self, interval=POLL_MS)
        self._timer.timeout.connect(self._poll)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.picture, 1)
        column.addWidget(self.note)

    def open(
        self,
        open_camera: Callable[[Progress], ShownCamera],
        indicator: Indicator | None = None,
    ) -> None:
        """Show another camera; `open_camera` runs beside the window.

        Args:
            open_camera: what it reports is told below the picture.
            indicator: shows the waiting as well, with a button to cancel it.
        """
        self.stop()
        before = self._last
        opening = _Opening(open_camera)
        self._opening = self._last = opening
        self.say(tr("opening the camera …"))

        def operation(progress: Progress) -> ShownCamera:
            if before is not None:
                before.ended.wait(6.0)  # one port is opened once
            return opening.run(progress)

        task = run_in_background(
            self,
            operation,
            lambda camera: self._take(opening, camera),
            lambda error: self._refuse(opening, error),
            self.cancelled.emit,
            title=tr("Opening the camera") if indicator is not None else "",
            indicator=indicator,
        )
        self._task = task
        task.progressed.connect(lambda _, text: self._tell_opening(opening, text))

    def stop(self) -> None:
        """Show nothing; the camera is closed beside the window, one that is not open is not."""
        self._timer.stop()
        if self._task is not None:
            self._task.cancel()
        opening, self._opening, self.camera = self._opening, None, None
        if opening is not None:
            opening.stop()
        self.picture.show_image(None)

    def closed(self) -> Callable[[], object]:
        """Return what waits until the last camera is closed; for other threads."""
        last = self._last
        return (lambda: None) if last is None else (lambda: last.ended.wait(8.0))

    def say(self, text: str, bad: bool = False) -> None:
        """Show a line below the picture."""
        colour, symbol = theme.VERDICTS["bad"] if bad else (theme.TEXT_DIM, "")
        self.note.setStyleSheet(f"color: {colour};")
        self.note.setText(f"{symbol} {text}".strip())

    def _tell_opening(self, opening: _Opening, text: str) -> None:
        if opening is self._opening and self.camera is None and text:
            self.say(tr("opening the camera: {what}", what=text))

    def _take(self, opening: _Opening, camera: ShownCamera) -> None:
        if opening is self._opening:
            self.camera = camera
            self._timer.start()
            self.opened.emit(camera)

    def _refuse(self, opening: _Opening, error: Exception) -> None:
        if opening is self._opening:
            self.say(translated(error), bad=True)
            self.failed.emit(error)

    def _poll(self) -> None:
        if self.camera is None:
            return
        frame, health = self.camera.newest(), self.camera.health()
        if frame is not None:
            self.picture.show_image(frame.image)
        well = health.state.value == "live"
        self.picture.set_dimmed(not well)
        if not well and health.state.value != "waiting":
            self.say(health.text, bad=True)
            return
        figures = health.figures
        line = tr(
            "{rate:.0f} pictures/s, jitter {jitter:.1f} ms",
            rate=figures.rate,
            jitter=1e3 * figures.jitter,
        )
        refused = [text for text in self.camera.settings() if "did not accept" in text]
        self.say("; ".join([line, *([figures.text] if figures.text else []), *refused]))
