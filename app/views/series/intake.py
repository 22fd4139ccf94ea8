"""How a series enters the library in the window: looked at, taken in, told what was removed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.imaging.candidate import Candidate
from app.imaging.series import Series
from app.views.kit.background import BackgroundTask, Indicator, run_in_background
from app.views.kit.text import tr
from app.views.series.import_report import ImportReport
from app.views.series.mask_dialog import Boxes, MaskDialog

if TYPE_CHECKING:
    from app.imaging.library import Imported
    from app.imaging.privacy.pictures import Pictures

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
            lambda pictures: self._look(replace(candidate, pictures=pictures), pictures),
            candidate, tr("Reading the pictures"),
        )  # fmt: skip

    def _look(
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
            self._tell, candidate, tr("Importing, de-identified"), boxes,
        )  # fmt: skip

    def _work(
        self, work: Callable[[Progress], T], then: Callable[[T], object], candidate: Candidate,
        title: str, boxes: Boxes = (),
    ) -> None:  # fmt: skip
        self._task = run_in_background(
            self, work, then, lambda error: self._fail(error, candidate, boxes),
            candidate.give_up, title=title, indicator=self._indicator,
        )  # fmt: skip

    def _tell(self, imported: Imported) -> None:
        report = ImportReport(imported, self._window)
        report.open_wanted.connect(self.open_wanted)
        report.finished.connect(report.deleteLater)
        self.report = report
        report.open()

    def _fail(self, error: Exception, candidate: Candidate, boxes: Boxes) -> None:
        from app.imaging.privacy.errors import AnnotatedError  # pydicom is loaded by now

        if isinstance(error, AnnotatedError) and candidate.pictures is not None:
            note = tr("The files say that there is writing in their pictures: every picture that "
                      "says so needs a box over it.")  # fmt: skip
            self._look(candidate, candidate.pictures, boxes, note)
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
