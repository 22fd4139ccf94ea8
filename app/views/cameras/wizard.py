"""The calibration wizard: board, pictures, result, place, save."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QMessageBox, QWidget

from app.core.progress import Progress
from app.tracking.calibration.camera_pair import OpenCamera, OpenPair
from app.tracking.calibration.job import CalibrationJob
from app.views.cameras.wizard_board import BoardPage
from app.views.cameras.wizard_capture import CapturePage
from app.views.cameras.wizard_result import ResultPage
from app.views.cameras.wizard_save import SavePage
from app.views.cameras.wizard_world import WorldPage
from app.views.kit.text import tr
from app.views.kit.verdict import Verdict
from app.views.kit.wizard import Wizard

Step = BoardPage | CapturePage | ResultPage | WorldPage | SavePage


class CalibrationWizard(Wizard):
    """Leads through the calibration of two cameras; nothing in it blocks the window.

    Signals:
        used(): another calibration is in use.

    Args:
        job: what is calibrated, and where it is kept.
        open_pair: opens the real cameras; None if none are chosen: folders only.
        parent: window.
    """

    used = Signal()

    def __init__(
        self, job: CalibrationJob, open_pair: OpenPair | None = None, parent: QWidget | None = None
    ) -> None:
        super().__init__(tr("Calibration of the cameras"), (940, 620), 150, parent)
        self.job = job
        self.board_page = BoardPage(job, self)
        self.capture_page = CapturePage(job, open_pair, self)
        self.result_page = ResultPage(job, self)
        self.world_page = WorldPage(job, self._after_capture(open_pair), self)
        self.save_page = SavePage(job, self)
        self.steps: tuple[Step, ...] = (
            self.board_page,
            self.capture_page,
            self.result_page,
            self.world_page,
            self.save_page,
        )
        self.add_pages(self.steps)
        self._connect()
        self.show_page(0)

    @property
    def busy(self) -> bool:
        """Whether a page works."""
        return any(page.running for page in self.steps if not isinstance(page, BoardPage))

    def marks(self) -> tuple[tuple[Verdict, str], ...]:
        """Return how each page stands, and its title."""
        return tuple((page.verdict, page.title) for page in self.steps)

    def enter(self, number: int) -> None:
        """Prepare a page that is shown now."""
        page = self.steps[number]
        if isinstance(page, ResultPage | WorldPage | SavePage):
            page.enter()

    def lacks(self, number: int) -> str:
        """Say what a page must have before the next one makes sense; empty if it has it."""
        if not self.board_page.valid:
            return tr("Choose a board that can be")
        page = self.steps[number]
        if page is self.capture_page and not self.job.pairs:
            return tr(
                "Take or open pictures first. To place or to import a calibration without any, "
                "choose the page in the list."
            )
        if page is self.result_page and self.job.result is None:
            return tr("There is no result yet")
        return ""

    def finish(self) -> None:
        """Close after the last page, by the way that asks."""
        self.reject()

    def reject(self) -> None:
        """Close by Escape or by the window's cross; what is not kept yet is asked about."""
        if not (self.job.unsaved or self.capture_page.found) or self._may_go():
            super().reject()

    def done(self, code: int) -> None:
        """Close by any way: what works is stopped, the cameras are let go."""
        self.capture_page.end()
        self.result_page.stop()
        self.world_page.stop()
        super().done(code)

    def closed(self) -> Callable[[], object]:
        """Return what waits until the cameras are let go; for other threads."""
        waits = (self.capture_page.closed(), self.world_page.closed())
        return lambda: [wait() for wait in waits]

    def _after_capture(self, open_pair: OpenPair | None) -> OpenPair | None:
        """Open the cameras once the page before has let them go: one port is opened once."""
        if open_pair is None:
            return None
        closed = self.capture_page.closed

        def open_after(progress: Progress) -> Sequence[OpenCamera]:
            closed()()
            return open_pair(progress)

        return open_after

    def _may_go(self) -> bool:
        buttons = QMessageBox.StandardButton
        answer = QMessageBox.question(
            self,
            tr("Unsaved calibration"),
            tr("Pictures and calibration are not saved and will be lost. Close all the same?"),
            buttons.Discard | buttons.Cancel,
            buttons.Cancel,
        )
        return answer == buttons.Discard

    def _board_changed(self) -> None:
        self.capture_page.forget()
        self.refresh()

    def _saved(self) -> None:
        self.refresh()
        self.used.emit()

    def _connect(self) -> None:
        self.board_page.changed.connect(self._board_changed)
        for page in (self.capture_page, self.result_page, self.world_page):
            page.changed.connect(self.refresh)
        self.save_page.began.connect(self.refresh)
        self.save_page.changed.connect(self._saved)
