"""The library of CTs: ways for a CT in, and what it holds."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.imaging.candidate import of_folder, of_pacs
from app.imaging.series import Listing, Series
from app.views.kit.background import BackgroundTask, Indicator, run_in_background
from app.views.kit.names import NAMES
from app.views.kit.text import tr
from app.views.series.browser import SeriesBrowser
from app.views.series.intake import SeriesIntake
from app.views.series.pacs_panel import PacsPanel
from app.views.series.pacs_settings import PacsSettingsDialog

if TYPE_CHECKING:
    from app.imaging.pacs.query import FoundSeries
    from app.imaging.pacs.settings import PacsSettings
    from app.imaging.pacs.taking import Fetched


class LibraryImport(QObject):
    """Takes CTs into the library, from a folder, an archive, a file or a PACS, beside the window.

    Signals:
        open_wanted(Path): the folder of a library's CT is to be opened.
        failed(object): the error that kept a CT out; nothing of it was kept.
    """

    open_wanted = Signal(object)
    failed = Signal(object)

    def __init__(self, indicator: Indicator, window: QWidget) -> None:
        super().__init__(window)
        self._indicator, self._window = indicator, window
        self._task: BackgroundTask | None = None
        self.intake = SeriesIntake(indicator, window)
        self.intake.open_wanted.connect(self.open_wanted)
        self.intake.failed.connect(self.failed)
        self.panel: PacsPanel | None = None
        self.configuration: PacsSettingsDialog | None = None

    def ask(self) -> None:
        """Ask for a folder and take a series of it in."""
        name = QFileDialog.getExistingDirectory(
            self._window, tr("Import CT into the library"), str(Path.home())
        )
        if name:
            self.import_from(Path(name))

    def ask_file(self) -> None:
        """Ask for a zip archive, a DICOMDIR or a DICOM file and take a series of it in."""
        kinds = f"{tr('Archives and DICOM files')} (*.zip DICOMDIR *.dcm);;{tr('All')} (*)"
        name, _ = QFileDialog.getOpenFileName(
            self._window, tr("Import CT into the library"), str(Path.home()), kinds
        )
        if name:
            self.import_from(Path(name))

    def import_from(self, path: Path) -> None:
        """Take in a series of a folder, archive, DICOMDIR or file; of several one is asked for."""
        NAMES.learn(path)
        self._task = run_in_background(
            self, lambda progress: _scan(path, progress), self._choose, self.failed.emit,
            title=tr("Looking for CT series"), indicator=self._indicator,
        )  # fmt: skip

    def ask_pacs(self) -> None:
        """Open the browser of the PACS."""
        panel = PacsPanel(self._window)
        panel.wanted.connect(self._retrieve)
        panel.configure_wanted.connect(self.configure_pacs)
        panel.finished.connect(self._panel_closed)
        self.panel = panel
        panel.open()

    def configure_pacs(self) -> None:
        """Open the dialog in which PACS are entered; an open browser follows it."""
        dialog = PacsSettingsDialog(self.panel or self._window)
        if self.panel is not None:
            dialog.kept.connect(self.panel.fill_servers)
        dialog.finished.connect(dialog.deleteLater)
        self.configuration = dialog
        dialog.open()

    def _panel_closed(self) -> None:
        if self.panel is not None:
            self.panel.deleteLater()
            self.panel = None

    def entries(self) -> list[tuple[str, Path]]:
        """CTs of the library: what to call each, and its folder."""
        from app.imaging.library import CtLibrary

        return [(f"{one.name}  {one.label}", one.folder) for one in CtLibrary().entries()]

    def _choose(self, listing: Listing) -> None:
        mended = [one for one in listing.series if not one.usable and one.remedy != "none"]
        if len(listing.usable) + len(mended) > 1:
            browser = SeriesBrowser(listing, self._window, taking=True)
            browser.chosen.connect(lambda series, _: self._begin(series, listing))
            browser.finished.connect(browser.deleteLater)
            browser.open()
            return
        from app.imaging.errors import ImagingError
        from app.imaging.reading import choose

        try:
            series = mended[0] if mended else choose(listing)
            self._begin(series, listing)
        except ImagingError as error:
            self.failed.emit(error)

    def _begin(self, series: Series, listing: Listing) -> None:
        self.intake.begin(of_folder(series, listing.keeper))

    def _retrieve(self, settings: PacsSettings, series: FoundSeries) -> None:
        self._task = run_in_background(
            self, lambda progress: _fetch(settings, series, progress),
            lambda fetched: self.intake.begin(of_pacs(fetched)), self.failed.emit,
            title=tr("Retrieving from {name}", name=settings.name), indicator=self._indicator,
        )  # fmt: skip


def _scan(path: Path, progress: Progress) -> Listing:
    with ONE_AT_A_TIME:  # pydicom: behind the window, not before it
        from app.imaging.scanning import scan_folder
    return scan_folder(path, progress)


def _fetch(settings: PacsSettings, series: FoundSeries, progress: Progress) -> Fetched:
    with ONE_AT_A_TIME:
        from app.imaging.pacs.client import Pacs
        from app.imaging.pacs.taking import fetch
    return fetch(Pacs(settings), series.study.uid, series.uid, progress, remedy=None)
