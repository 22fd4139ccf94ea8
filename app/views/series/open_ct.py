"""Opens patients: a folder, archive or file, a recent one, the phantom; all beside the window."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.imaging.errors import ImagingError, TooLargeError
from app.imaging.series import NO_REMEDY, Listing, Series
from app.planning.patient import Patient, load_phantom, read_patient
from app.views.kit.background import BackgroundTask, Indicator, run_in_background
from app.views.kit.names import NAMES
from app.views.kit.text import tr
from app.views.series.browser import SeriesBrowser
from app.views.shell.settings import Recents

T = TypeVar("T")


class OpenCt(QObject):
    """Finds, lets choose and reads; a newer wish replaces one that is still being read.

    Signals:
        opened(Patient): ready to be shown.
        failed(object): the error that kept it from being opened.
        given_up(): nothing will be opened: refused, cancelled, or nothing was chosen.
        reading(bool): one is being looked for or read, or no more.
        taking(Candidate): to be looked through, then taken into the library.

    Attributes:
        ways_in: further ways into the library, for its menu: title, and what leads there.
        recents: those opened before.
        may_replace: asked before one is read, whether it may take the place of what is open.
    """

    opened = Signal(object)
    failed = Signal(object)
    given_up = Signal()
    reading = Signal(bool)
    taking = Signal(object)

    def __init__(self, recents: Recents, indicator: Indicator, window: QWidget) -> None:
        super().__init__(window)
        self.recents, self._indicator, self._window = recents, indicator, window
        self._task: BackgroundTask | None = None
        self._listing: Listing | None = None
        self.may_replace: Callable[[], bool] = lambda: True
        self.ways_in: list[tuple[str, Callable[[], object]]] = []

    @property
    def is_reading(self) -> bool:
        """Return whether a patient is being looked for or read."""
        return self._task is not None

    def ask(self) -> None:
        """Ask for a folder and open it."""
        name = QFileDialog.getExistingDirectory(
            self._window, tr("Open CT folder"), str(self._start_folder())
        )
        if name:
            self.open_folder(Path(name))

    def ask_file(self) -> None:
        """Ask for an archive, a directory of a medium or a NIfTI file and open it."""
        start = str(self._start_folder())
        kinds = tr("CT archives and files") + " (*.zip DICOMDIR *.nii *.nii.gz);;" + tr("All (*)")
        name = QFileDialog.getOpenFileName(self._window, tr("Open CT file"), start, kinds)[0]
        if name:
            self.open_folder(Path(name))

    def open_folder(self, path: Path, series: str | None = None, remedy: str = NO_REMEDY) -> None:
        """Open the CT in a folder, archive, DICOMDIR or NIfTI file (of another: in its folder).

        Args:
            path: where.
            series: which series; where None and several could be opened, one is asked for.
            remedy: what is asked for in reading it; then nothing is asked of the user.
        """
        source = path.parent if path.is_file() and not _is_source(path) else path
        NAMES.learn(path, source)
        self._start(
            tr("Looking for CT series in {name}", name=source.name),
            lambda progress: _scan(source, progress),
            lambda listing: self._choose(listing, series, remedy),
        )

    def _start_folder(self) -> Path:
        recent = self.recents.paths()
        return NAMES.folder(recent[0].parent if recent else Path.home())

    def browse(self) -> None:
        """Show the series of the folder that was opened last."""
        if self._listing is None:
            self.ask()
        else:
            self._browse(self._listing)

    def open_phantom(self, seed: int = 1) -> None:
        """Open the procedural patient."""
        if not self._ask_to_replace():
            return
        self._start(
            tr("Preparing the phantom patient"),
            lambda progress: load_phantom(seed, progress),
            self._finish,
        )

    def open_series(self, listing: Listing, series: Series, remedy: str = NO_REMEDY) -> None:
        """Read this series, as it is or in the way asked for."""
        if not self._ask_to_replace():
            return
        self._start(
            tr("Reading CT"),
            lambda progress: read_patient(series, listing.path, progress, remedy),
            self._finish,
        )

    def close(self) -> None:
        """Stop reading; idempotent."""
        if self._task is not None:
            self._task.close()
            self._set_task(None)

    def _ask_to_replace(self) -> bool:
        if self.may_replace():
            return True
        self.given_up.emit()
        return False

    def _set_task(self, task: BackgroundTask | None) -> None:
        was, self._task = self._task is not None, task
        if was != (task is not None):
            self.reading.emit(task is not None)

    def _cancelled(self) -> None:
        self._set_task(None)
        self.given_up.emit()

    def _start(
        self, title: str, operation: Callable[[Progress], T], on_success: Callable[[T], object]
    ) -> None:
        if self._task is not None:
            self._task.drop()
        task = run_in_background(
            self,
            operation,
            on_success,
            self._fail,
            self._cancelled,
            title=title,
            indicator=self._indicator,
        )
        self._set_task(task)

    def _choose(self, listing: Listing, series: str | None = None, remedy: str = NO_REMEDY) -> None:
        self._set_task(None)
        self._listing = listing
        openable = [s for s in listing.series if s.usable or s.remedies]
        unclear = len(openable) > 1 or not listing.usable
        if series is None and remedy == NO_REMEDY and listing.series and unclear:
            self._browse(listing)
            return
        from app.imaging.reading import choose  # pydicom: loaded by the scan

        try:
            self.open_series(listing, choose(listing, series, remedy), remedy)
        except ImagingError as error:
            self._fail(error)

    def _browse(self, listing: Listing) -> None:
        browser = SeriesBrowser(listing, self._window)
        browser.chosen.connect(lambda series, way: self.open_series(listing, series, way))
        browser.rejected.connect(self.given_up)
        browser.finished.connect(browser.deleteLater)
        browser.open()

    def _finish(self, patient: Patient) -> None:
        self._set_task(None)
        if patient.folder is not None:
            self.recents.add(patient.folder)
        self.opened.emit(patient)

    def _fail(self, error: Exception) -> None:
        self._set_task(None)
        offer = error.offer if isinstance(error, TooLargeError) else None
        if offer is None or self._listing is None:
            self.failed.emit(error)
            return
        series = tuple(offer if s.key == offer.key else s for s in self._listing.series)
        self._browse(replace(self._listing, series=series))


def _scan(folder: Path, progress: Progress) -> Listing:
    with ONE_AT_A_TIME:  # pydicom: behind the window, not before it
        from app.imaging.scanning import scan_folder
    return scan_folder(folder, progress)


def _is_source(path: Path) -> bool:
    """Return whether a file is opened for itself; any other stands for the folder it is in."""
    name = path.name.lower()
    return name in ("dicomdir", "dirfile") or name.endswith((".zip", ".nii", ".nii.gz"))
