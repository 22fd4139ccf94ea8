"""CTs in the window: the ways in, those of before, and the library of de-identified ones."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from PySide6.QtCore import QObject, Signal, SignalInstance
from PySide6.QtWidgets import (
    QFileDialog,
    QMenu,
    QWidget,
)

from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.imaging.series import Listing, Series
from app.views.kit.background import BackgroundTask, Indicator, run_in_background
from app.views.kit.menu_entries import add_entries, add_recent
from app.views.kit.names import NAMES
from app.views.kit.roles import STAFF, Role
from app.views.kit.text import tr
from app.views.series.browser import SeriesBrowser
from app.views.series.intake import Candidate, SeriesIntake
from app.views.shell.feature import Context, Feature

if TYPE_CHECKING:
    from app.imaging.privacy.burned_in import MaskBox


def of_folder(series: Series, keeper: object) -> Candidate:
    """Candidate of a series that was found on this computer."""

    def take(boxes: Sequence[MaskBox], progress: Progress) -> Any:
        with ONE_AT_A_TIME:
            from app.imaging.library import CtLibrary
        return CtLibrary().import_series(series, boxes, progress, series.remedy)

    return Candidate(series, take, lambda: None, keeper)


class LibraryImport(QObject):
    """Takes CTs into the library, from a folder, an archive or a file, beside the window.

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
            self,
            lambda progress: _scan(path, progress),
            self._choose,
            self.failed.emit,
            title=tr("Looking for CT series"),
            indicator=self._indicator,
        )

    def entries(self) -> list[tuple[str, Path]]:
        """CTs of the library: what to call each, and its folder."""
        from app.imaging.library import CtLibrary

        return [(f"{one.name}  {one.label}", one.folder) for one in CtLibrary().entries()]

    def _choose(self, listing: Listing) -> None:
        mended = [one for one in listing.series if not one.usable and one.remedies]
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


def _scan(path: Path, progress: Progress) -> Listing:
    with ONE_AT_A_TIME:  # pydicom: behind the window, not before it
        from app.imaging.scanning import scan_folder
    return scan_folder(path, progress)


class SeriesFeature(Feature):
    """Menu entries that open patients, and take CTs into the library."""

    topic: ClassVar[str] = "ct"
    place: ClassVar[int] = 10
    roles: ClassVar[frozenset[Role]] = STAFF

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        shell, self._patients = context.shell, context.patients
        self.library = LibraryImport(shell.progress, shell.dialog_parent)
        self.library.open_wanted.connect(self._patients.open_folder)
        self.library.failed.connect(self._patients.failed)
        self._patients.failed.connect(self.failed)
        self._patients.taking.connect(self.library.intake.begin)
        menu = shell.menu(tr("&File"))
        add_entries(
            menu,
            [
                (tr("Open CT folder…"), "Ctrl+O", self._patients.ask),
                (tr("Open CT archive or file…"), "", self._patients.ask_file),
                (tr("Series of the folder…"), "", self._patients.browse),
            ],
        )
        add_recent(menu, tr("Recent CTs"), self._patients.recents.paths, self._patients.open_folder)
        self._library_menu = menu.addMenu(tr("Library of CTs"))
        self._library_menu.aboutToShow.connect(lambda: self._fill(self._library_menu))
        add_entries(menu, [(tr("Phantom patient"), "", self.open_phantom), None])

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self._patients.opened,)

    def opens(self, path: Path) -> bool:
        """Open what was dropped, whatever it is: this feature is asked last."""
        self._patients.open_folder(path)
        return True

    def open_phantom(self) -> None:
        """Open the phantom of the present exercise, or the first."""
        exercise = self.context.conductor.exercise
        phantom = exercise.ct.phantom if exercise is not None else None
        self._patients.open_phantom(phantom.seed if phantom is not None else 1)

    def close(self) -> None:
        """Stop reading; idempotent."""
        self._patients.close()

    def _fill(self, menu: QMenu) -> None:
        """Offer the ways into the library, and what it holds."""
        menu.clear()
        library = self.library
        add_entries(
            menu,
            [
                (tr("Import CT folder, de-identified…"), "", library.ask),
                (tr("Import CT archive or file, de-identified…"), "", library.ask_file),
                *((title, "", way) for title, way in self._patients.ways_in),
                None,
            ],
        )
        for name, folder in library.entries():
            action = menu.addAction(NAMES.shown(name))
            action.triggered.connect(lambda _=False, f=folder: self._patients.open_folder(f))
