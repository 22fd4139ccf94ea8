"""The wizard's third page: computing, and what came out."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import (
    QDoubleSpinBox,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QTableWidgetItem,
    QWidget,
)

from app.tracking.calibration.job import CalibrationJob
from app.tracking.calibration.run import StereoResult
from app.tracking.optics.calibration import StereoCalibration
from app.views.cameras.wizard_words import (
    figures,
    other_notes,
    parameter_rows,
    ruler_line,
    verdict_of,
    view_rows,
)
from app.views.kit import theme
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.parts import button, column, label, table, thin_bar
from app.views.kit.text import tr
from app.views.kit.verdict import Verdict, tell


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
        """What stands in the wizard's list."""
        return tr("Result")

    @property
    def verdict(self) -> Verdict:
        """How the page stands."""
        result = self._job.result
        if result is None:
            return Verdict.IDLE
        ruled = ruler_line(result.calibration, self.ruler.value())[0]
        return Verdict.BAD if ruled is Verdict.BAD else verdict_of(result.calibration)[0]

    @property
    def running(self) -> bool:
        """Whether it computes."""
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
            for k, text in enumerate((name, f"{rms:.2f}", remark)):
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
        self._end(Verdict.BAD, str(error))

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
        name = QLabel(title)
        name.setProperty("role", "dim")
        grid.addWidget(name, i, 0)
        grid.addWidget(QLabel(value), i, 1)
