"""Opens patients: a folder, a dropped folder, a recent one, the phantom; all beside the window."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.imaging.errors import ImagingError
from app.imaging.series import Listing, Series
from app.views.background import Indicator, Task, run_in_background
from app.views.patient import Patient, load_phantom, read_patient
from app.views.series_dialog import SeriesDialog
from app.views.settings import Recents
from app.views.text import tr

T = TypeVar("T")


class OpenCt(QObject):
    """Finds, lets choose and reads; a newer wish replaces one that is still being read.

    Signals:
        opened(Patient): ready to be shown.
        failed(object): the error that kept it from being opened.
    """

    opened = Signal(object)
    failed = Signal(object)

    def __init__(self, recents: Recents, indicator: Indicator, window: QWidget) -> None:
        super().__init__(window)
        self._recents, self._indicator, self._window = recents, indicator, window
        self._task: Task | None = None

    def ask(self) -> None:
        """Ask for a folder and open it."""
        recent = self._recents.paths()
        start = str(recent[0].parent if recent else Path.home())
        name = QFileDialog.getExistingDirectory(self._window, tr("Open CT folder"), start)
        if name:
            self.open_folder(Path(name))

    def open_folder(self, path: Path) -> None:
        """Open the CT in a folder (of a file: in its folder)."""
        folder = path.parent if path.is_file() else path
        self._start(
            tr("Looking for CT series in {name}", name=folder.name),
            lambda progress: _scan(folder, progress),
            lambda listing: self._choose(folder, listing),
        )

    def open_phantom(self, seed: int = 1) -> None:
        """Open the procedural patient."""
        self._start(
            tr("Preparing the phantom patient"),
            lambda progress: load_phantom(seed, progress),
            self._finish,
        )

    def open_series(self, folder: Path, series: Series) -> None:
        """Read this series."""
        self._start(
            tr("Reading CT"),
            lambda progress: read_patient(series, folder, progress),
            self._finish,
        )

    def close(self) -> None:
        """Stop reading; idempotent."""
        if self._task is not None:
            self._task.close()
            self._task = None

    def _start(
        self, title: str, operation: Callable[[Progress], T], on_success: Callable[[T], object]
    ) -> None:
        self.close()
        self._task = run_in_background(
            self, operation, on_success, self._fail, title=title, indicator=self._indicator
        )

    def _choose(self, folder: Path, listing: Listing) -> None:
        self._task = None
        if len(listing.usable) > 1:
            dialog = SeriesDialog(listing, self._window)
            dialog.chosen.connect(lambda series: self.open_series(folder, series))
            dialog.finished.connect(dialog.deleteLater)
            dialog.open()
            return
        from app.imaging.reading import choose  # pydicom: loaded by the scan

        try:
            self.open_series(folder, choose(listing))
        except ImagingError as error:
            self._fail(error)

    def _finish(self, patient: Patient) -> None:
        self._task = None
        if patient.folder is not None:
            self._recents.add(patient.folder)
        self.opened.emit(patient)

    def _fail(self, error: Exception) -> None:
        self._task = None
        self.failed.emit(error)


def _scan(folder: Path, progress: Progress) -> Listing:
    with ONE_AT_A_TIME:  # pydicom: behind the window, not before it
        from app.imaging.scanning import scan_folder
    return scan_folder(folder, progress)
