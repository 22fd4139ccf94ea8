"""A series on its way into the library of CTs: looked through, taken in or given up, told of."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, TypeVar

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QPlainTextEdit, QVBoxLayout, QWidget

from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.imaging.series import Series
from app.views.kit import theme
from app.views.kit.background import BackgroundTask, Indicator, run_in_background
from app.views.kit.names import NAMES
from app.views.kit.parts import PlainLabel
from app.views.kit.text import tr
from app.views.series.mask_dialog import Boxes, MaskDialog

if TYPE_CHECKING:
    from app.imaging.library import Imported
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
        self.text.setAccessibleName(self.windowTitle())
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
