"""The wizard's last page: keeping the result, the calibrations kept so far, and those of others
(`calibrate import`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import (
    QDialog,
    QFileDialog,
    QHBoxLayout,
    QInputDialog,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.core.errors import AcusError
from app.core.progress import Progress
from app.tracking.calibration.formats.reading import length, picture_size, read_calibration
from app.tracking.calibration.history import CalibrationHistory, KeptCalibration
from app.tracking.calibration.job import CalibrationJob
from app.tracking.optics.calibration import StereoCalibration
from app.views.kit import theme
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.form import Form
from app.views.kit.parts import button, column, label, table
from app.views.kit.text import listing, literal, tr, translated
from app.views.kit.verdict import Verdict, tell


class ImportDialog(QDialog):
    """Asks for files, and for what some of them leave out; reads, keeps and uses them.

    Signals:
        imported(StereoCalibration): it was kept and is in use.

    Args:
        history: where it is kept.
        names: of the cameras in the rig, left and right.
        parent: window.
    """

    imported = Signal(object)

    def __init__(
        self, history: CalibrationHistory, names: tuple[str, str], parent: QWidget
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Import a calibration"))
        self._history, self._names = history, names
        self.files: tuple[Path, ...] = ()
        self.chosen, self.state = label(role="dim"), label()
        self.open_files = button(tr("Files…"))
        self.open_folder = button(tr("Folder…"))
        self.take = button(tr("Import and use it"), "primary")
        self._task: BackgroundTask | None = None
        self._lay_out()
        self.open_files.clicked.connect(self._ask_files)
        self.open_folder.clicked.connect(self._ask_folder)
        self.take.clicked.connect(self.begin)
        self.set_files(())

    def set_files(self, files: Sequence[Path]) -> None:
        """Choose files, left before right, or one folder."""
        self.files = tuple(files)
        names = listing(path.name for path in self.files)
        self.chosen.setText(names or tr("nothing is chosen yet"))
        self.take.setEnabled(bool(self.files))
        tell(self.state, Verdict.IDLE, "")

    def begin(self) -> None:
        """Read, keep and use them, beside the window."""
        if self._task is not None or not self.files:
            return
        files, unit, size = self.files, self.unit.text().strip(), self.size_box.text().strip()

        def work(_: Progress) -> StereoCalibration:
            calibration = read_calibration(
                files,
                unit=length(unit) if unit else None,
                image_size=picture_size(size) if size else None,
                names=self._names,
            )
            self._history.keep(calibration)
            return calibration

        self.take.setEnabled(False)
        tell(self.state, Verdict.IDLE, tr("reading …"))
        self._task = run_in_background(self, work, self._done, self._failed)

    def _done(self, calibration: StereoCalibration) -> None:
        self._task = None
        self.imported.emit(calibration)
        self.accept()

    def _failed(self, error: Exception) -> None:
        self._task = None
        self.take.setEnabled(True)
        tell(self.state, Verdict.BAD, translated(error))

    def _ask_files(self) -> None:
        names, _ = QFileDialog.getOpenFileNames(
            self,
            tr("Calibration files, left before right"),
            "",
            tr("Calibrations (*.yaml *.yml *.xml);;All files (*)"),
        )
        if names:
            self.set_files([Path(name) for name in sorted(names)])

    def _ask_folder(self) -> None:
        name = QFileDialog.getExistingDirectory(self, tr("Folder of TemugeB's text files"))
        if name:
            self.set_files([Path(name)])

    def _lay_out(self) -> None:
        form = Form(parent=self)
        row = QHBoxLayout()
        for one in (self.open_files, self.open_folder):
            row.addWidget(one)
        row.addWidget(self.chosen, 1)
        form.wide(row)
        title = tr("Unit of the board's square (--unit)")
        self.unit = form.text("unit", title=title, hint="1cm")
        title = tr("Size of the pictures (--size)")
        self.size_box = form.text("size", title=title, hint="1280x720")
        last = QHBoxLayout()
        last.addStretch(1)
        close = button(tr("Cancel"))
        close.clicked.connect(self.reject)
        for one in (close, self.take):
            last.addWidget(one)
        column = QVBoxLayout(self)
        column.setSpacing(theme.MARGIN)
        column.addWidget(
            label(
                tr(
                    "One YAML of Acus; left and right YAML of ICube or ROS; the folder of "
                    "TemugeB's text files; or intrinsics.yml and extrinsics.yml of OpenCV's "
                    "stereo_calib. Only TemugeB's and OpenCV's files need unit and size. What "
                    "other programs write does not say how sure it is, and has no place: find it "
                    "on the page before."
                )
            )
        )
        column.addWidget(form)
        column.addWidget(self.state)
        column.addLayout(last)
        self.resize(560, 300)


Details = tuple[str, str, str]
"""Figures, place and problem of a calibration, in words."""


def show_entry(table: QTableWidget, row: int, entry: KeptCalibration, shown: Details) -> None:
    """Fill a row; the entry's id is the first cell's data."""
    figures, world, problem = shown
    colour, state = theme.TEXT_DIM, ""
    if entry.active:
        colour, state = theme.GOOD, tr("✔ in use")
    if problem:
        colour, state = theme.BAD, tr("✖ unreadable: {why}", why=problem)
    if entry.rejected is not None:
        colour, state = theme.BAD, tr("✖ found bad: {why}", why=entry.rejected.reason)
    for k, text in enumerate((entry.id, figures, world, state)):
        item = QTableWidgetItem(text)
        item.setToolTip(literal(text))
        if k == 3:
            item.setForeground(QColor(colour))
        if k == 0:
            item.setData(Qt.ItemDataRole.UserRole, entry.id)
        table.setItem(row, k, item)


def details(history: CalibrationHistory, calibration_id: str) -> Details:
    """Read a calibration and say what it is."""
    try:
        calibration = history.load(calibration_id)
    except AcusError as error:
        return "", "", translated(error)
    checked = calibration.validation
    figures = tr("{px:.2f} px", px=calibration.rms_px)
    if checked is not None:
        figures += tr(", {mm:.3f} mm held back", mm=checked.rms_mm)
    if not calibration.uncertainty_known:
        figures += tr(", own uncertainty not known")
    return figures, tr("placed") if calibration.world is not None else tr("no place"), ""


class SavePage(QWidget):
    """Keeps, uses, takes back, rejects; nothing is deleted.

    Signals:
        changed(): another calibration is in use, or one was kept or found bad.
        began(): files are being written: the page is to stay.
    """

    changed = Signal()
    began = Signal()

    def __init__(self, job: CalibrationJob, parent: QWidget) -> None:
        super().__init__(parent)
        self._job = job
        self._details: dict[str, tuple[str, str, str]] = {}
        self._task: BackgroundTask | None = None
        self.state, self._remark = label(), label(role="dim")
        self.save = button(tr("Save and use it"), "primary")
        self.import_ = button(tr("Import…"))
        self.undo, self.redo = button(tr("Undo")), button(tr("Redo"))
        self.use, self.found_bad = button(tr("Use this one")), button(tr("Found bad…"), "danger")
        titles = (tr("Calibration"), tr("Error"), tr("Place"), tr("State"))
        self.table = table(titles, selectable=True)
        self._lay_out()
        self._connect()
        self.refresh()

    @property
    def title(self) -> str:
        """Return what stands in the wizard's list."""
        return tr("Save")

    @property
    def verdict(self) -> Verdict:
        """Return how the page stands."""
        if self._job.saved is not None:
            return Verdict.GOOD
        return Verdict.WARNING if self._job.outcome() is not None else Verdict.IDLE

    def enter(self) -> None:
        """Show the present state."""
        self.refresh()

    def refresh(self) -> None:
        """Show what there is to keep, and the history."""
        outcome, saved = self._job.outcome(), self._job.saved
        self.save.setEnabled(outcome is not None and saved is None)
        if saved is not None:
            tell(self.state, Verdict.GOOD, tr("saved as {id} and in use", id=saved.id))
        elif outcome is None:
            tell(self.state, Verdict.IDLE, tr("There is nothing new to save."))
        elif outcome.world is None:
            tell(
                self.state,
                Verdict.WARNING,
                tr("Not saved yet. Without a place (the page before) it cannot be used to track."),
            )
        else:
            tell(self.state, Verdict.WARNING, tr("Not saved yet."))
        self._show_history()

    def chosen(self) -> str | None:
        """Id of the calibration that is selected in the list."""
        rows = self.table.selectionModel().selectedRows()
        item = self.table.item(rows[0].row(), 0) if rows else None
        return str(item.data(Qt.ItemDataRole.UserRole)) if item is not None else None

    def reject_chosen(self, reason: str) -> None:
        """Say that the selected calibration was found bad."""
        chosen = self.chosen()
        if chosen is not None:
            self._do(lambda: self._job.history.reject(chosen, reason))

    def ask_import(self) -> ImportDialog:
        """Ask for a calibration of another program; what is imported is in use."""
        dialog = ImportDialog(self._job.history, self._job.names, self)
        dialog.imported.connect(self._imported)
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()
        return dialog

    # --- inside -----------------------------------------------------------------------------------
    def _imported(self, calibration: StereoCalibration) -> None:
        self._done(None)
        placed = calibration.world is not None
        note = "" if placed else tr("; it has no place yet: find it on the page before")
        words = tr("imported as {id} and in use{note}", id=calibration.id, note=note)
        tell(self.state, Verdict.GOOD if placed else Verdict.WARNING, words)

    def _save(self) -> None:
        self._do(self._job.save)

    def _use(self) -> None:
        chosen = self.chosen()
        if chosen is not None:
            self._do(lambda: self._job.history.use(chosen))

    def _ask_why(self) -> None:
        reason, given = QInputDialog.getText(
            self, tr("Found bad"), tr("What is wrong with it? Attempts made with it will say so.")
        )
        if given:
            self.reject_chosen(reason)

    @property
    def running(self) -> bool:
        """Return whether files are written or read for the user."""
        return self._task is not None

    def _do(self, work: Callable[[], object]) -> None:
        """Work beside the window: a calibration's file takes some tenths of a second."""
        if self.running:
            return
        self._task = run_in_background(self, lambda _: work(), self._done, self._failed)
        self._enable(())
        self.save.setEnabled(False)
        self.began.emit()

    def _done(self, _: object) -> None:
        self._task = None
        self.refresh()
        self.changed.emit()

    def _failed(self, error: Exception) -> None:
        self._task = None
        self.refresh()
        tell(self.state, Verdict.BAD, translated(error))
        self.changed.emit()

    def _read(self, entries: tuple[KeptCalibration, ...]) -> None:
        """Read what is not known yet of the calibrations, beside the window."""
        history = self._job.history
        missing = [entry.id for entry in entries if entry.id not in self._details]
        if not missing:
            return

        def read(progress: Progress) -> dict[str, tuple[str, str, str]]:
            found = {}
            for i, name in enumerate(missing):
                progress.report(i / len(missing))
                found[name] = details(history, name)
            return found

        def show(result: dict[str, tuple[str, str, str]]) -> None:
            self._details |= result
            self._fill(entries)

        run_in_background(self, read, show, lambda error: self._remark.setText(translated(error)))

    def _show_history(self) -> None:
        try:
            entries = self._job.history.entries()
        except AcusError as error:
            self.table.setRowCount(0)
            self._remark.setText(translated(error))
            self._enable(())
            return
        self._remark.setText(str(self._job.history.folder))
        self._fill(entries)
        self._read(entries)

    def _fill(self, entries: tuple[KeptCalibration, ...]) -> None:
        self.table.setRowCount(len(entries))
        for row, entry in enumerate(reversed(entries)):
            show_entry(self.table, row, entry, self._details.get(entry.id, ("…", "", "")))
        self._enable(entries)

    def _enable(self, entries: tuple[KeptCalibration, ...]) -> None:
        self.undo.setEnabled(any(entry.active for entry in entries))
        self.redo.setEnabled(bool(entries))
        chosen = self.chosen()
        entry = next((one for one in entries if one.id == chosen), None)
        good = entry is not None and entry.rejected is None
        self.use.setEnabled(good and entry is not None and not entry.active)
        self.found_bad.setEnabled(good)

    def _selected(self) -> None:
        try:
            self._enable(self._job.history.entries())
        except AcusError:
            self._enable(())

    def _lay_out(self) -> None:
        rows = column(self, tr("Save"))
        rows.addWidget(self.state)
        first = QHBoxLayout()
        first.addWidget(self.save)
        first.addWidget(self.import_)
        first.addStretch(1)
        rows.addLayout(first)
        rows.addWidget(
            label(
                tr(
                    "Calibrations so far; none is ever deleted. One that proves bad is no "
                    "longer used, and attempts made with it are flagged."
                ),
                "dim",
            )
        )
        rows.addWidget(self.table, 1)
        rows.addWidget(self._remark)
        last = QHBoxLayout()
        for one in (self.undo, self.redo, self.use):
            last.addWidget(one)
        last.addStretch(1)
        last.addWidget(self.found_bad)
        rows.addLayout(last)

    def _connect(self) -> None:
        history = self._job.history
        self.save.clicked.connect(self._save)
        self.import_.clicked.connect(self.ask_import)
        self.undo.clicked.connect(lambda: self._do(history.undo))
        self.redo.clicked.connect(lambda: self._do(history.redo))
        self.use.clicked.connect(self._use)
        self.found_bad.clicked.connect(self._ask_why)
        self.table.itemSelectionChanged.connect(self._selected)
