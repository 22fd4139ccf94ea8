"""What came out of the calibration: computing it; and where the cameras stand, from the board at a
known place.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import (
    QDoubleSpinBox,
    QFileDialog,
    QGridLayout,
    QHBoxLayout,
    QTableWidgetItem,
    QWidget,
)

from app.core.progress import Progress
from app.core.transform import RigidTransform
from app.tracking.calibration.camera_pair import OpenPair
from app.tracking.calibration.job import CalibrationJob
from app.tracking.calibration.placed_board import PlacedBoard, place
from app.tracking.calibration.placed_pictures import placed_boards, take_board
from app.tracking.calibration.run import StereoResult
from app.tracking.calibration.world import WorldFrame
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import StereoCalibration
from app.views.cameras.wizard_words import (
    figures,
    other_notes,
    parameter_rows,
    ruler_line,
    verdict_of,
    view_rows,
    world_lines,
)
from app.views.kit import theme
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.parts import PlainLabel, button, column, label, table, thin_bar
from app.views.kit.text import number, tr, translated
from app.views.kit.verdict import Verdict, tell


class WorldPage(QWidget):
    """Takes places one by one; with each the world frame is found anew.

    Signals:
        changed(): it has begun or ended.
    """

    changed = Signal()

    def __init__(self, job: CalibrationJob, open_pair: OpenPair | None, parent: QWidget) -> None:
        super().__init__(parent)
        self._job, self._open_pair = job, open_pair
        self._task: BackgroundTask | None = None
        self._let_go = threading.Event()
        self._let_go.set()
        self.fields = tuple(_field(unit) for unit in ("mm",) * 3 + ("°",) * 3)
        for spin, value in zip(self.fields, (-60.0, 190.0, 90.0, 180.0, 0.0, 0.0), strict=True):
            spin.setValue(value)
        self.live = button(tr("Take it with the cameras"), "primary")
        self.folder = button(tr("Pictures of a folder…"))
        self.drop = button(tr("Drop all places"))
        self.state, self._lines = label(), label()
        self._lay_out()
        self._connect()
        self.refresh()

    @property
    def title(self) -> str:
        """Return what stands in the wizard's list."""
        return tr("Place")

    @property
    def verdict(self) -> Verdict:
        """Return how the page stands."""
        world = self._job.world
        if world is None:
            return Verdict.IDLE
        return Verdict.WARNING if world.remarks else Verdict.GOOD

    @property
    def running(self) -> bool:
        """Return whether pictures are taken or looked at."""
        return self._task is not None

    def begin_folder(self, folder: Path) -> None:
        """Take the pictures of a folder, at the place that is typed in."""
        at, board = self.placement(), self._job.board
        self._begin(lambda progress: placed_boards([folder], [at], board, progress)[0][0])

    def begin_live(self) -> None:
        """Take pictures with the cameras, at the place that is typed in."""
        open_pair, job, at = self._open_pair, self._job, self.placement()
        if open_pair is None:
            return
        self._begin(lambda progress: take_board(open_pair, job.board, job.names, at, progress))

    def placement(self) -> RigidTransform:
        """Return the place that is typed in, T_world_board."""
        return place(*(spin.value() for spin in self.fields))

    def stop(self) -> None:
        """Ask the work to stop."""
        if self._task is not None:
            self._task.cancel()

    def closed(self) -> Callable[[], object]:
        """Return what waits until the cameras are let go; for other threads."""
        let_go = self._let_go
        return lambda: let_go.wait(12.0)

    def refresh(self) -> None:
        """Show what is known."""
        self.live.setEnabled(self._open_pair is not None and not self.running)
        self.folder.setEnabled(not self.running)
        self.drop.setEnabled(bool(self._job.places) and not self.running)
        world = self._job.world
        if world is None:
            self._lines.clear()
            return
        texts = [
            f"{verdict.colour_and_symbol[1]} {text}"
            for verdict, text in world_lines(self._job.base(), world)
        ]
        self._lines.setText("\n".join(texts))

    def enter(self) -> None:
        """Say for which calibration a place is wanted."""
        self.refresh()
        if self.running or self._job.world is not None:
            return
        try:
            base = self._job.base_id()
        except CalibrationError as error:
            tell(self.state, Verdict.WARNING, translated(error))
            return
        tell(self.state, Verdict.IDLE, tr("for calibration {id}", id=base))

    # --- inside -----------------------------------------------------------------------------------
    def _begin(self, work: Callable[[Progress], PlacedBoard]) -> None:
        if self.running:
            return
        job, known = self._job, self._job.places

        let_go = self._let_go = threading.Event()

        def operation(progress: Progress) -> tuple[tuple[PlacedBoard, ...], WorldFrame]:
            try:
                places = (*known, work(progress))
            finally:
                let_go.set()
            return places, job.find_world(places)

        tell(self.state, Verdict.IDLE, tr("looking for the board …"))
        self._task = run_in_background(self, operation, self._done, self._failed, self._cancelled)
        self.refresh()
        self.changed.emit()

    def _done(self, result: tuple[tuple[PlacedBoard, ...], WorldFrame]) -> None:
        places, world = result
        self._job.set_world(places, world)
        count = len(places)
        words = tr("world frame found from one place; another place makes it better")
        if count > 1:
            words = tr("world frame found from {n} places", n=count)
        self._end(Verdict.WARNING if world.remarks else Verdict.GOOD, words)

    def _failed(self, error: Exception) -> None:
        self._end(Verdict.BAD, translated(error))

    def _cancelled(self) -> None:
        self._end(Verdict.WARNING, tr("cancelled"))

    def _end(self, verdict: Verdict, words: str) -> None:
        self._task = None
        tell(self.state, verdict, words)
        self.refresh()
        self.changed.emit()

    def _drop_all(self) -> None:
        self._job.set_world((), None)
        self.state.clear()
        self.refresh()
        self.changed.emit()

    def _ask(self) -> None:
        answer = QFileDialog.getExistingDirectory(self, tr("Pictures of the board at this place"))
        if answer:
            self.begin_folder(Path(answer))

    def _lay_out(self) -> None:
        rows = column(self, tr("Lay the board at a known place"))
        rows.addWidget(
            label(
                tr(
                    "The place is that of the first inner corner, in the robot's frame: origin "
                    "midway between the motor axes, x to the right motor, z up. Turned by 180° "
                    "about x the board lies print up with its columns along x. Several places are "
                    "better than one."
                ),
                "dim",
            )
        )
        grid = QGridLayout()
        names = ("x", "y", "z", tr("about x"), tr("about y"), tr("about z"))
        for i, (name, spin) in enumerate(zip(names, self.fields, strict=True)):
            row, k = divmod(i, 3)
            title = PlainLabel(name, self)
            title.setProperty("role", "dim")
            grid.addWidget(title, row, 2 * k)
            grid.addWidget(spin, row, 2 * k + 1)
        grid.setColumnStretch(6, 1)
        rows.addLayout(grid)
        rows.addWidget(self.state)
        rows.addWidget(self._lines)
        rows.addStretch(1)
        last = QHBoxLayout()
        for one in (self.live, self.folder):
            last.addWidget(one)
        last.addStretch(1)
        last.addWidget(self.drop)
        rows.addLayout(last)

    def _connect(self) -> None:
        self.live.clicked.connect(self.begin_live)
        self.folder.clicked.connect(self._ask)
        self.drop.clicked.connect(self._drop_all)


def _field(unit: str) -> QDoubleSpinBox:
    spin = QDoubleSpinBox()
    limit = 2000.0 if unit == "mm" else 360.0
    spin.setRange(-limit, limit)
    spin.setDecimals(2)
    spin.setSuffix(f" {unit}" if unit == "mm" else unit)
    spin.setFixedWidth(120)
    return spin


class ResultPage(QWidget):
    """Computes beside the window, with progress and cancel, and shows the result.

    Signals:
        changed(): it has begun or ended.
    """

    changed = Signal()

    def __init__(self, job: CalibrationJob, parent: QWidget) -> None:
        super().__init__(parent)
        self._job = job
        self._task: BackgroundTask | None = None
        self.start, self.cancel = button(tr("Compute again")), button(tr("Cancel"), "danger")
        self.bar = thin_bar()
        self.state, self.notes = label(), label(role="dim")
        self._figures = QGridLayout()
        self.ruler, self.ruled = QDoubleSpinBox(self), label()
        self.views = table((tr("Pair"), tr("px"), tr("Remark")))
        self.parameters = table((tr("Parameter"), job.names[0], job.names[1]))
        self._lay_out()
        self.start.clicked.connect(self.begin)
        self.cancel.clicked.connect(self.stop)
        self.ruler.valueChanged.connect(self._measured)
        self.refresh()

    @property
    def title(self) -> str:
        """Return what stands in the wizard's list."""
        return tr("Result")

    @property
    def verdict(self) -> Verdict:
        """Return how the page stands."""
        result = self._job.result
        if result is None:
            return Verdict.IDLE
        ruled = ruler_line(result.calibration, self.ruler.value())[0]
        return Verdict.BAD if ruled is Verdict.BAD else verdict_of(result.calibration)[0]

    @property
    def running(self) -> bool:
        """Return whether it computes."""
        return self._task is not None

    def enter(self) -> None:
        """Compute if there are views that were not calibrated yet."""
        if self._job.result is None and self._job.pairs and not self.running:
            self.begin()
        self.refresh()

    def begin(self) -> None:
        """Compute."""
        if self.running:
            return
        self.bar.setValue(0)
        tell(self.state, Verdict.IDLE, tr("computing …"))
        job = self._job
        self._task = run_in_background(
            self, job.calibrate, self._done, self._failed, self._cancelled
        )
        self._task.progressed.connect(self._progressed)
        self.refresh()
        self.changed.emit()

    def stop(self) -> None:
        """Ask the computation to stop."""
        if self._task is not None:
            self._task.cancel()

    def refresh(self) -> None:
        """Show what is known."""
        result = self._job.result
        self.start.setEnabled(not self.running and self._job.pairs > 0)
        self.cancel.setEnabled(self.running)
        if result is None:
            self._clear()
            if not self.running and not self._job.pairs:
                tell(self.state, Verdict.IDLE, tr("There are no pictures yet."))
            return
        calibration = result.calibration
        self._show_verdict(calibration)
        _fill_grid(self._figures, figures(calibration))
        self._show_views(result)
        alone = (result.estimate.left, result.estimate.right)
        left, right = (
            parameter_rows(mono, camera)
            for mono, camera in zip(alone, calibration.cameras, strict=True)
        )
        self.parameters.setRowCount(len(left))
        for i, ((name, one), (_, other)) in enumerate(zip(left, right, strict=True)):
            for k, text in enumerate((name, one, other)):
                item = QTableWidgetItem(text)
                if text.startswith("("):
                    item.setForeground(QColor(theme.TEXT_DIM))
                self.parameters.setItem(i, k, item)
        self.notes.setText("\n".join(other_notes(calibration)))
        self.bar.setValue(1000)

    def _show_views(self, result: StereoResult) -> None:
        rows = view_rows(result)
        self.views.setRowCount(len(rows))
        for i, (name, rms, verdict, remark) in enumerate(rows):
            colour = verdict.colour_and_symbol[0] if remark else theme.TEXT
            for k, text in enumerate((name, number(rms, ".2f"), remark)):
                item = QTableWidgetItem(text)
                item.setForeground(QColor(colour))
                if k == 1:
                    item.setTextAlignment(
                        Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
                    )
                self.views.setItem(i, k, item)

    def _measured(self) -> None:
        """Hold the distance of the cameras by ruler against the calibration's."""
        result = self._job.result
        if result is not None:
            self._show_verdict(result.calibration)
            self.changed.emit()

    def _show_verdict(self, calibration: StereoCalibration) -> None:
        ruled = ruler_line(calibration, self.ruler.value())
        tell(self.ruled, *ruled)
        if ruled[0] is Verdict.BAD:
            tell(self.state, Verdict.BAD, tr("Not to be used: a measured length contradicts it."))
        else:
            tell(self.state, *verdict_of(calibration))

    def _clear(self) -> None:
        _fill_grid(self._figures, [])
        self.views.setRowCount(0)
        self.parameters.setRowCount(0)
        self.notes.clear()
        self.ruled.clear()
        if not self.running:
            self.bar.setValue(0)
            self.state.clear()

    def _progressed(self, fraction: float, text: str) -> None:
        self.bar.setValue(round(1000 * fraction))
        tell(self.state, Verdict.IDLE, tr("computing: {what}", what=text))

    def _done(self, result: StereoResult) -> None:
        self._task = None
        self._job.set_result(result)
        self.refresh()
        self.changed.emit()

    def _failed(self, error: Exception) -> None:
        self._end(Verdict.BAD, translated(error))

    def _cancelled(self) -> None:
        self._end(Verdict.WARNING, tr("Cancelled; nothing was kept."))

    def _end(self, verdict: Verdict, words: str) -> None:
        self._task = None
        self.refresh()
        tell(self.state, verdict, words)
        self.changed.emit()

    def _ruler_row(self) -> QHBoxLayout:
        self.ruler.setRange(0.0, 5000.0)
        self.ruler.setDecimals(0)
        self.ruler.setSuffix(tr(" mm"))
        self.ruler.setSpecialValueText(tr("not measured"))
        row = QHBoxLayout()
        row.addWidget(label(tr("Distance of the lenses by ruler"), "dim"))
        row.addWidget(self.ruler)
        row.addWidget(self.ruled, 1)
        return row

    def _lay_out(self) -> None:
        rows = column(self, tr("Result"))
        rows.addWidget(self.bar)
        rows.addWidget(self.state)
        self._figures.setColumnStretch(1, 1)
        rows.addLayout(self._figures)
        rows.addLayout(self._ruler_row())
        tables = QHBoxLayout()
        tables.addWidget(self.views, 5)
        tables.addWidget(self.parameters, 6)
        rows.addLayout(tables, 1)
        rows.addWidget(self.notes)
        last = QHBoxLayout()
        last.addWidget(self.start)
        last.addWidget(self.cancel)
        last.addStretch(1)
        rows.addLayout(last)


def _fill_grid(grid: QGridLayout, rows: list[tuple[str, str]]) -> None:
    while (item := grid.takeAt(0)) is not None:
        if (widget := item.widget()) is not None:
            widget.deleteLater()
    for i, (title, value) in enumerate(rows):
        name = PlainLabel(title)
        name.setProperty("role", "dim")
        grid.addWidget(name, i, 0)
        grid.addWidget(PlainLabel(value), i, 1)
