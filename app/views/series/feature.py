"""CTs in the window: the ways in, those of before, the PACS, and the library of de-identified
ones.

A series on its way into the library, a `Candidate`, is looked through first, then taken in or given
up; what was removed is told at the end.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from PySide6.QtCore import QObject, Signal, SignalInstance
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFileDialog,
    QMenu,
    QPlainTextEdit,
    QVBoxLayout,
    QWidget,
)

from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.imaging.series import Listing, Series
from app.views.kit import theme
from app.views.kit.background import BackgroundTask, Indicator, run_in_background
from app.views.kit.menu_entries import add_entries, add_recent
from app.views.kit.names import NAMES
from app.views.kit.parts import PlainLabel
from app.views.kit.text import tr
from app.views.series.browser import SeriesBrowser
from app.views.series.mask_dialog import Boxes, MaskDialog
from app.views.series.pacs_panel import PacsPanel
from app.views.series.pacs_settings import PacsSettingsDialog
from app.views.shell.feature import Context, Feature

if TYPE_CHECKING:
    from app.imaging.library import Imported
    from app.imaging.pacs.query import FoundSeries
    from app.imaging.pacs.settings import PacsSettings
    from app.imaging.pacs.taking import Fetched
    from app.imaging.privacy.burned_in import MaskBox
    from app.imaging.privacy.pictures import Pictures


@dataclass(frozen=True, slots=True, eq=False)
class Candidate:
    """What is to be taken in.

    Attributes:
        series: a usable one, or one that opens on request.
        take: `take(boxes, progress)` brings it into the library.
        give_up: deletes what was set aside for it, if anything was.
        keeper: holds its files (an unpacked archive) as long as the candidate lives.
        pictures: once they were read.
    """

    series: Series
    take: Callable[[Sequence[MaskBox], Progress], Imported]
    give_up: Callable[[], object]
    keeper: object = None
    pictures: Pictures | None = None


def of_folder(series: Series, keeper: object) -> Candidate:
    """Candidate of a series that was found on this computer."""

    def take(boxes: Sequence[MaskBox], progress: Progress) -> Any:
        with ONE_AT_A_TIME:
            from app.imaging.library import CtLibrary
        return CtLibrary().import_series(series, boxes, progress, series.remedy)

    return Candidate(series, take, lambda: None, keeper)


def of_pacs(fetched: Fetched) -> Candidate:
    """Candidate of a series that was retrieved."""

    def take(boxes: Sequence[MaskBox], progress: Progress) -> Any:
        with ONE_AT_A_TIME:
            from app.imaging.library import CtLibrary
            from app.imaging.pacs.taking import keep
        return keep(fetched, CtLibrary(), progress, boxes, fetched.series.remedy)

    return Candidate(fetched.series, take, fetched.forget)


T = TypeVar("T")


class SeriesIntake(QObject):
    """Leads one candidate after the other from the pictures to the report.

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
        self.mask: MaskDialog | None = None
        self.report: ImportReport | None = None

    def begin(self, candidate: Candidate) -> None:
        """Read the pictures of a candidate and show them."""
        self._work(
            lambda progress: _read(candidate.series, progress),
            lambda pictures: self._review(replace(candidate, pictures=pictures), pictures),
            candidate,
            tr("Reading the pictures"),
        )

    def _review(
        self, candidate: Candidate, pictures: Pictures, boxes: Boxes = (), note: str = ""
    ) -> None:
        dialog = MaskDialog(pictures, boxes, note, self._window)
        dialog.wanted.connect(lambda boxes: self._take(candidate, boxes))
        dialog.rejected.connect(lambda: candidate.give_up())
        dialog.finished.connect(dialog.deleteLater)
        self.mask = dialog
        dialog.open()

    def _take(self, candidate: Candidate, boxes: Boxes) -> None:
        self._work(
            lambda progress: candidate.take(boxes, progress),
            self._tell,
            candidate,
            tr("Importing, de-identified"),
            boxes,
        )

    def _work(
        self,
        work: Callable[[Progress], T],
        then: Callable[[T], object],
        candidate: Candidate,
        title: str,
        boxes: Boxes = (),
    ) -> None:
        self._task = run_in_background(
            self,
            work,
            then,
            lambda error: self._fail(error, candidate, boxes),
            candidate.give_up,
            title=title,
            indicator=self._indicator,
        )

    def _tell(self, imported: Imported) -> None:
        report = ImportReport(imported, self._window)
        report.open_wanted.connect(self.open_wanted)
        report.finished.connect(report.deleteLater)
        self.report = report
        report.open()

    def _fail(self, error: Exception, candidate: Candidate, boxes: Boxes) -> None:
        from app.imaging.privacy.errors import AnnotatedError  # pydicom is loaded by now

        if isinstance(error, AnnotatedError) and candidate.pictures is not None:
            note = tr(
                "The files say that there is writing in their pictures: every picture that "
                "says so needs a box over it."
            )
            self._review(candidate, candidate.pictures, boxes, note)
            return
        candidate.give_up()
        self.failed.emit(error)


def _read(series: Series, progress: Progress) -> Pictures:
    with ONE_AT_A_TIME:  # pydicom: behind the window, not before it
        from app.imaging.errors import SeriesRefusedError
        from app.imaging.privacy.pictures import read_pictures
    if not series.slices:
        raise SeriesRefusedError("only DICOM series are taken into the library; open this file")
    return read_pictures(series, progress)


class ImportReport(QDialog):
    """Shows the report of an import; it holds no value of the files.

    Signals:
        open_wanted(Path): open the CT that was taken in.
    """

    open_wanted = Signal(object)

    def __init__(self, imported: Imported, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Taken into the library"))
        self.resize(760, 460)
        entry, report = imported.entry, imported.report
        words = _words(imported)
        heading = PlainLabel(f"{NAMES.shown(entry.name)}\n{NAMES.without_names(words)}", self)
        heading.setProperty("role", "heading")
        self.warning = PlainLabel("\n".join(f"⚠  {text}" for text in report.warnings), self)
        self.warning.setWordWrap(True)
        self.warning.setVisible(bool(report.warnings))
        lines = [line for line in report.lines() if not line.startswith("look at this")]
        self.text = QPlainTextEdit(NAMES.without_names("\n\n".join(lines)), self)
        self.text.setReadOnly(True)
        kinds = QDialogButtonBox.StandardButton
        self.buttons = QDialogButtonBox(kinds.Open | kinds.Close, parent=self)
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        self.accepted.connect(lambda: self.open_wanted.emit(entry.folder))
        column = QVBoxLayout(self)
        column.setSpacing(theme.SPACING)
        for widget in (heading, self.warning, self.text, self.buttons):
            column.addWidget(widget)


def _words(imported: Imported) -> str:
    """Say what became of it."""
    label, before, given = imported.entry.label, imported.before, imported.given
    if imported.again and given < before:
        return tr(
            "{label}: all {before} images are in the library already; the {given} given are a part",
            label=label,
            before=before,
            given=given,
        )
    if imported.again:
        return tr("{label}: it was in the library already", label=label)
    words = tr(
        "{label}: {count} files, de-identified and checked", label=label, count=imported.entry.files
    )
    if 0 < before < given:
        words += tr("; they replace the {before} of them that lay there", before=before)
    return words


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
            self,
            lambda progress: _scan(path, progress),
            self._choose,
            self.failed.emit,
            title=tr("Looking for CT series"),
            indicator=self._indicator,
        )

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

    def _retrieve(self, settings: PacsSettings, series: FoundSeries) -> None:
        self._task = run_in_background(
            self,
            lambda progress: _fetch(settings, series, progress),
            lambda fetched: self.intake.begin(of_pacs(fetched)),
            self.failed.emit,
            title=tr("Retrieving from {name}", name=settings.name),
            indicator=self._indicator,
        )


def _scan(path: Path, progress: Progress) -> Listing:
    with ONE_AT_A_TIME:  # pydicom: behind the window, not before it
        from app.imaging.scanning import scan_folder
    return scan_folder(path, progress)


def _fetch(settings: PacsSettings, series: FoundSeries, progress: Progress) -> Fetched:
    with ONE_AT_A_TIME:
        from app.imaging.pacs.client import Pacs
        from app.imaging.pacs.taking import fetch
    return fetch(Pacs(settings), series.study.uid, series.uid, progress, remedy=None)


class SeriesFeature(Feature):
    """Menu entries that open patients, and take CTs into the library."""

    topic: ClassVar[str] = "ct"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        shell, self._patients = context.shell, context.patients
        self.library = LibraryImport(shell.progress, shell.dialog_parent)
        self.library.open_wanted.connect(self._patients.open_folder)
        self.library.failed.connect(self._patients.failed)
        self._patients.failed.connect(self.failed)
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
                (tr("From the PACS…"), "", library.ask_pacs),
                (tr("Configure PACS…"), "", library.configure_pacs),
                None,
            ],
        )
        for name, folder in library.entries():
            action = menu.addAction(NAMES.shown(name))
            action.triggered.connect(lambda _=False, f=folder: self._patients.open_folder(f))
