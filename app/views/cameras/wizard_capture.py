"""The wizard's second page: pictures of the board, live or from a folder, and what they cover so
far.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QColor, QImage, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QFileDialog, QHBoxLayout, QSizePolicy, QWidget

from app.core.errors import AcusError
from app.tracking.calibration.camera_pair import OpenCamera, OpenPair, PairOpening
from app.tracking.calibration.capture import BoardShot, FolderShots, LiveShots, Search
from app.tracking.calibration.collector import ViewCollector
from app.tracking.calibration.corners import to_grey
from app.tracking.calibration.coverage import COLUMNS, ROWS, Coverage
from app.tracking.calibration.job import CalibrationJob, Views
from app.tracking.calibration.views import BoardView
from app.views.cameras.wizard_words import pairs_words
from app.views.kit import theme
from app.views.kit.background import run_in_background
from app.views.kit.parts import button, column, label, thin_bar
from app.views.kit.text import tr, translated
from app.views.kit.verdict import Verdict, tell

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from app.tracking.calibration.collector import Offer


_MANY = 12
"""Corners in a cell at which it has its full colour."""


class CoverageView(QWidget):
    """Shows the picture in grey, cells that hold corners in colour, and the corners found now."""

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._name = name
        self._image: QImage | None = None
        self._size = (640, 480)
        self._view: BoardView | None = None
        self._coverage = Coverage()
        self._kept = False
        self.setMinimumSize(260, 195)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def sizeHint(self) -> QSize:
        """Half a usual picture."""
        return QSize(360, 270)

    def show_picture(
        self, image: NDArray[Any] | None, view: BoardView | None, stored: bool = False
    ) -> None:
        """Show a picture and the corners found in it; `stored` marks it as one that is used."""
        if image is not None:
            grey = to_grey(image)
            height, width = grey.shape
            self._size = (width, height)
            self._image = QImage(
                grey.tobytes(), width, height, width, QImage.Format.Format_Grayscale8
            ).copy()
        else:
            self._image = None
        self._view, self._kept = view, stored
        self.update()

    def show_coverage(self, coverage: Coverage) -> None:
        """Show which part of the picture is covered."""
        self._coverage = coverage
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint picture, cells, corners and the name."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.fillRect(self.rect(), QColor(theme.IMAGE_BACKGROUND))
        frame = self._frame()
        if self._image is not None:
            painter.drawImage(frame, self._image)
        self._paint_cells(painter, frame)
        if self._view is not None:
            self._paint_corners(painter, frame, self._view)
        self._paint_words(painter, frame)

    def _frame(self) -> QRectF:
        width, height = self._size
        scale = min(self.width() / width, self.height() / height)
        w, h = scale * width, scale * height
        return QRectF(0.5 * (self.width() - w), 0.5 * (self.height() - h), w, h)

    def _paint_cells(self, painter: QPainter, frame: QRectF) -> None:
        width, height = frame.width() / COLUMNS, frame.height() / ROWS
        colour = QColor(theme.on_image(theme.GOOD))
        for row in range(ROWS):
            for k in range(COLUMNS):
                count = int(self._coverage.cells[row, k])
                if count:
                    colour.setAlphaF(0.14 + 0.20 * min(1.0, count / _MANY))
                    cell = QRectF(frame.x() + k * width, frame.y() + row * height, width, height)
                    painter.fillRect(cell.adjusted(1, 1, -1, -1), colour)

    def _paint_corners(self, painter: QPainter, frame: QRectF, view: BoardView) -> None:
        scale = frame.width() / self._size[0]
        points = [
            QPointF(frame.x() + (u + 0.5) * scale, frame.y() + (v + 0.5) * scale)
            for u, v in view.pixels.tolist()
        ]
        painter.setPen(QPen(QColor(theme.on_image(theme.ACCENT)), 1.0))
        painter.drawPolyline(QPolygonF(points))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(theme.on_image(theme.GOOD if self._kept else theme.WARNING)))
        for point in points:
            painter.drawEllipse(point, 2.5, 2.5)

    def _paint_words(self, painter: QPainter, frame: QRectF) -> None:
        share = round(100.0 * self._coverage.covered)
        words = tr(
            "{camera}: {n} different views, {share} % covered",
            camera=self._name,
            n=len(self._coverage.views),
            share=share,
        )
        box = QRectF(frame.x(), frame.bottom() - 24.0, frame.width(), 24.0)
        painter.fillRect(box, QColor(0, 0, 0, 150))
        painter.setPen(QColor(theme.IMAGE_TEXT))
        painter.drawText(box.adjusted(8, 0, -8, 0), Qt.AlignmentFlag.AlignVCenter, words)
        if self._image is None:
            painter.setPen(QColor(theme.IMAGE_DIM))
            painter.drawText(frame, Qt.AlignmentFlag.AlignCenter, tr("no picture yet"))


POLL_MS: Final = 40
LEAST_PAIRS: Final = 5
"""Fewer pairs are not worth computing."""


class CapturePage(QWidget):
    """Collects views.

    Signals:
        changed(): there are more views, or the search has begun or ended.
    """

    changed = Signal()

    def __init__(self, job: CalibrationJob, open_pair: OpenPair | None, parent: QWidget) -> None:
        super().__init__(parent)
        self._job, self._open_pair = job, open_pair
        self._pair: PairOpening | None = None
        self.search: Search | None = None
        self._live, self._opening = False, False
        self._collector: ViewCollector | None = None
        self.views = tuple(CoverageView(name, self) for name in job.names)
        self.live = button(tr("Begin with the live cameras"), "primary")
        self.folder = button(tr("Pictures of a folder…"))
        self.stop = button(tr("Stop"))
        self.back = button(tr("Drop the last"))
        self.state, self.advice = label(), label()
        self.bar = thin_bar()
        self._timer = QTimer(self, interval=POLL_MS)
        self._timer.timeout.connect(self.poll)
        self._lay_out()
        self._connect()
        self.refresh()

    @property
    def title(self) -> str:
        """Return what stands in the wizard's list."""
        return tr("Pictures")

    @property
    def verdict(self) -> Verdict:
        """Return how the page stands."""
        if self._job.pairs >= LEAST_PAIRS:
            return Verdict.GOOD if self._enough() else Verdict.WARNING
        return Verdict.IDLE

    @property
    def running(self) -> bool:
        """Return whether pictures are searched."""
        return self.search is not None or self._opening

    @property
    def found(self) -> bool:
        """Return whether the search that goes on has found what closing would lose."""
        return self.search is not None and bool(self.search.collector.kept or not self._live)

    def begin_live(self) -> None:
        """Open the cameras beside the window, then search their pictures."""
        if self._open_pair is None or self.running:
            return
        self._opening = True
        pair = self._pair = PairOpening(self._open_pair, self._pair)
        tell(self.state, Verdict.IDLE, tr("opening the cameras …"))
        self.refresh()
        self.changed.emit()
        run_in_background(
            self, pair.run, lambda cameras: self._opened(pair, cameras), self._refused
        )

    def begin_folder(self, folder: Path) -> None:
        """Search the pictures of a folder."""
        if self.running:
            return
        try:
            shots = FolderShots(folder)
        except AcusError as error:
            tell(self.state, Verdict.BAD, translated(error))
            return
        self._live = False
        self.bar.setRange(0, shots.count)
        self._begin(Search(shots, ViewCollector(self._job.board, self._job.names, live=False)))

    def end(self) -> None:
        """Stop the search and keep what it found; idempotent."""
        self._timer.stop()
        search, self.search = self.search, None
        if search is not None:
            search.close()
            self._show(search)
            self._take(search)
        self._opening = False
        if self._pair is not None:
            self._pair.stop()
        self.refresh()
        self.changed.emit()

    def closed(self) -> Callable[[], object]:
        """Return what waits until the cameras are let go; for other threads."""
        pair = self._pair
        return (lambda: None) if pair is None else (lambda: pair.ended.wait(8.0))

    def poll(self) -> None:
        """Show what the search has found since."""
        search = self.search
        if search is None:
            return
        self._show(search)
        if search.done.is_set():
            error = search.error
            self.end()
            if error is not None:
                tell(self.state, Verdict.BAD, translated(error))

    def refresh(self) -> None:
        """Enable what can be done now."""
        self.live.setEnabled(self._open_pair is not None and not self.running)
        self.folder.setEnabled(not self.running)
        self.stop.setEnabled(self.running)
        self.back.setEnabled(self.search is not None and self._live)
        if self._open_pair is None:
            self.live.setToolTip(tr("Choose real cameras in the menu Cameras first"))
        if not self.running and not self._job.views and not self.state.text():
            self.state.setText(tr("No pictures yet."))

    def forget(self) -> None:
        """Show nothing: another board was chosen."""
        if self._job.views:
            return
        for view in self.views:
            view.show_picture(None, None)
        collector = ViewCollector(self._job.board, self._job.names)
        for i, view in enumerate(self.views):
            view.show_coverage(collector.coverage(i))
        self.advice.clear()
        self.bar.setValue(0)

    # --- inside -----------------------------------------------------------------------------------
    def _opened(self, pair: PairOpening, cameras: Sequence[OpenCamera]) -> None:
        if not self._opening or pair is not self._pair:
            return  # nobody wants them any more: they are closed already
        self._opening, self._live = False, True
        self.bar.setRange(0, 1000)
        collector = ViewCollector(self._job.board, self._job.names)
        self._begin(Search(LiveShots(cameras, self._job.names), collector))

    def _refused(self, error: Exception) -> None:
        if not self._opening:
            return
        self._opening = False
        self.refresh()
        tell(self.state, Verdict.BAD, translated(error))
        self.changed.emit()

    def _begin(self, search: Search) -> None:
        self._job.set_views((), ())
        self.search = search.open()
        self._timer.start()
        tell(self.state, Verdict.IDLE, tr("looking for the board …"))
        self.refresh()
        self.changed.emit()

    def _show(self, search: Search) -> None:
        collector, newest = search.collector, search.newest
        for i, view in enumerate(self.views):
            view.show_coverage(collector.coverage(i))
        if newest is not None:
            self._show_shot(*newest)
        self.advice.setText("\n".join(f"➜ {line}" for line in collector.missing[:4]))
        if self._live:
            self.bar.setValue(round(1000 * collector.progress))
            if collector.enough:
                self.advice.setText(tr("✔ There are enough views: go on, or take more."))
        else:
            self.bar.setValue(search.count)

    def _show_shot(self, shot: BoardShot, offer: Offer) -> None:
        for view, image, found in zip(self.views, shot.images, offer.seen, strict=True):
            view.show_picture(image, found if isinstance(found, BoardView) else None, offer.kept)
        verdict = Verdict.GOOD if offer.kept else Verdict.IDLE
        tell(self.state, verdict, offer.words)

    def _take(self, search: Search) -> None:
        """Live pictures that were kept; all of a folder in which the board was found."""
        chosen = search.collector.kept if self._live else search.views
        views: tuple[Views, ...] = tuple((one[0], one[1]) for one in chosen)
        self._job.set_views(views, () if self._live else search.refused)
        different = None if self._live else search.collector.pairs
        words = pairs_words(self._job.pairs, different, self._job.refused)
        enough = self._job.pairs >= LEAST_PAIRS
        tell(self.state, Verdict.GOOD if enough else Verdict.BAD, words)
        self._collector = search.collector

    def _enough(self) -> bool:
        return self._collector is not None and self._collector.enough

    def _drop(self) -> None:
        if self.search is not None:
            self.search.collector.drop_last()

    def _ask(self) -> None:
        answer = QFileDialog.getExistingDirectory(self, tr("Folder of the pictures"))
        if answer:
            self.begin_folder(Path(answer))

    def _lay_out(self) -> None:
        rows = column(self, tr("Show the board to both cameras"))
        rows.addWidget(
            label(
                tr(
                    "Hold it still for a moment, then move it on: near and far, to every corner of "
                    "the pictures, tilted to all sides. A useful picture is taken by itself. From "
                    "a folder, pictures are paired by name: left01.png with right01.png."
                ),
                "dim",
            )
        )
        pictures = QHBoxLayout()
        for view in self.views:
            pictures.addWidget(view, 1)
        rows.addLayout(pictures, 1)
        rows.addWidget(self.bar)
        rows.addWidget(self.state)
        rows.addWidget(self.advice)
        last = QHBoxLayout()
        for one in (self.live, self.folder, self.stop, self.back):
            last.addWidget(one)
        last.addStretch(1)
        rows.addLayout(last)

    def _connect(self) -> None:
        self.live.clicked.connect(self.begin_live)
        self.folder.clicked.connect(self._ask)
        self.stop.clicked.connect(self.end)
        self.back.clicked.connect(self._drop)
