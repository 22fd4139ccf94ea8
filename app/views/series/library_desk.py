"""The library in the window: a CT is taken in de-identified, said what was removed, opened."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.imaging.series import Listing, Series
from app.views.background import Indicator, Task, run_in_background
from app.views.series.browser import SeriesBrowser
from app.views.series.import_report import ImportReport
from app.views.series.pacs_panel import PacsPanel
from app.views.text import tr

if TYPE_CHECKING:
    from app.imaging.library import Imported
    from app.imaging.pacs.query import FoundSeries
    from app.imaging.pacs.settings import PacsSettings

Work = Callable[[Progress], "Imported"]


class LibraryDesk(QObject):
    """Takes CTs into the library, from a folder or a PACS, beside the window.

    Signals:
        open_wanted(Path): the folder of a library's CT is to be opened.
        failed(object): the error that kept a CT out; nothing of it was kept.
    """

    open_wanted = Signal(object)
    failed = Signal(object)

    def __init__(self, indicator: Indicator, window: QWidget) -> None:
        super().__init__(window)
        self._indicator, self._window = indicator, window
        self._task: Task | None = None
        self.report: ImportReport | None = None
        self.panel: PacsPanel | None = None

    def ask(self) -> None:
        """Ask for a folder and take a series of it in."""
        name = QFileDialog.getExistingDirectory(
            self._window, tr("Import CT into the library"), str(Path.home())
        )
        if name:
            self.import_folder(Path(name))

    def import_folder(self, folder: Path) -> None:
        """Take the series of a folder in; where several could be, one is asked for."""
        self._task = run_in_background(
            self, lambda progress: _scan(folder, progress), self._choose, self._fail,
            title=tr("Looking for CT series"), indicator=self._indicator,
        )  # fmt: skip

    def ask_pacs(self) -> None:
        """Open the browser of the PACS."""
        panel = PacsPanel(self._indicator, self._window)
        panel.wanted.connect(self._retrieve)
        panel.failed.connect(self.failed)
        panel.finished.connect(panel.deleteLater)
        self.panel = panel
        panel.open()

    def entries(self) -> list[tuple[str, Path]]:
        """CTs of the library: what to call each, and its folder."""
        from app.imaging.library import CtLibrary

        return [(f"{one.name}  {one.label}", one.folder) for one in CtLibrary().entries()]

    def _choose(self, listing: Listing) -> None:
        if len(listing.usable) > 1:
            browser = SeriesBrowser(listing, self._window)
            browser.chosen.connect(lambda series, _: self._take(series))
            browser.finished.connect(browser.deleteLater)
            browser.open()
            return
        from app.imaging.errors import ImagingError
        from app.imaging.reading import choose

        try:
            self._take(choose(listing))
        except ImagingError as error:
            self.failed.emit(error)

    def _take(self, series: Series) -> None:
        self._work(lambda progress: _import(series, progress), tr("Importing, de-identified"))

    def _retrieve(self, settings: PacsSettings, series: FoundSeries) -> None:
        title = tr("Retrieving from {name}", name=settings.name)
        self._work(lambda progress: _fetch(settings, series, progress), title)

    def _work(self, work: Work, title: str) -> None:
        self._task = run_in_background(
            self, work, self._tell, self._fail, title=title, indicator=self._indicator
        )

    def _tell(self, imported: Imported) -> None:
        report = ImportReport(imported, self._window)
        report.open_wanted.connect(self.open_wanted)
        report.finished.connect(report.deleteLater)
        self.report = report
        report.open()

    def _fail(self, error: Exception) -> None:
        self.failed.emit(error)


def _scan(folder: Path, progress: Progress) -> Listing:
    with ONE_AT_A_TIME:  # pydicom: behind the window, not before it
        from app.imaging.scanning import scan_folder
    return scan_folder(folder, progress)


def _import(series: Series, progress: Progress) -> Imported:
    with ONE_AT_A_TIME:
        from app.imaging.library import CtLibrary
    return CtLibrary().import_series(series, progress=progress)


def _fetch(settings: PacsSettings, series: FoundSeries, progress: Progress) -> Imported:
    with ONE_AT_A_TIME:
        from app.imaging.library import CtLibrary
        from app.imaging.pacs.client import Pacs
        from app.imaging.pacs.taking import take
    return take(Pacs(settings), series.study.uid, series.uid, CtLibrary(), progress)
