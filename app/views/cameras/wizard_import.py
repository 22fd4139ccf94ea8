"""Calibrations of other programs, or of another computer, into the history: `calibrate import`."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtWidgets import (
    QDialog,
    QFileDialog,
    QFormLayout,
    QHBoxLayout,
    QLineEdit,
    QVBoxLayout,
    QWidget,
)

from app.core.progress import Progress
from app.tracking.calibration.formats.reading import read_calibration
from app.tracking.calibration.formats.said import length, picture_size
from app.tracking.calibration.history import CalibrationHistory
from app.tracking.optics.calibration import StereoCalibration
from app.views.cameras.wizard_parts import button, label, tell
from app.views.exercise.status_items import Verdict
from app.views.kit import theme
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.text import tr


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
        self.unit, self.size_box = QLineEdit(self), QLineEdit(self)
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
        names = ", ".join(path.name for path in self.files)
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
        tell(self.state, Verdict.BAD, str(error))

    def _ask_files(self) -> None:
        names, _ = QFileDialog.getOpenFileNames(
            self, tr("Calibration files, left before right"), "",
            tr("Calibrations (*.yaml *.yml *.xml);;All files (*)"),
        )  # fmt: skip
        if names:
            self.set_files([Path(name) for name in sorted(names)])

    def _ask_folder(self) -> None:
        name = QFileDialog.getExistingDirectory(self, tr("Folder of TemugeB's text files"))
        if name:
            self.set_files([Path(name)])

    def _lay_out(self) -> None:
        self.unit.setPlaceholderText("1cm")
        self.size_box.setPlaceholderText("1280x720")
        form = QFormLayout()
        row = QHBoxLayout()
        for one in (self.open_files, self.open_folder):
            row.addWidget(one)
        row.addWidget(self.chosen, 1)
        form.addRow(row)
        form.addRow(tr("Unit of the board's square (--unit)"), self.unit)
        form.addRow(tr("Size of the pictures (--size)"), self.size_box)
        last = QHBoxLayout()
        last.addStretch(1)
        close = button(tr("Cancel"))
        close.clicked.connect(self.reject)
        for one in (close, self.take):
            last.addWidget(one)
        column = QVBoxLayout(self)
        column.setSpacing(theme.MARGIN)
        column.addWidget(label(tr(
            "One YAML of Acus; left and right YAML of ICube or ROS; the folder of TemugeB's text "
            "files; or intrinsics.yml and extrinsics.yml of OpenCV's stereo_calib. Only TemugeB's "
            "and OpenCV's files need unit and size. What other programs write does not say how "
            "sure it is, and has no place: find it on the page before."
        )))  # fmt: skip
        column.addLayout(form)
        column.addWidget(self.state)
        column.addLayout(last)
        self.resize(560, 300)
