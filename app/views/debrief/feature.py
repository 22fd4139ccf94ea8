"""Attempts that are over: the debrief of one, the list of all, their reports, tables and past
scans.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import ClassVar

from PySide6.QtCore import QObject, QStandardPaths, Signal, SignalInstance
from PySide6.QtWidgets import QDialog, QFileDialog, QVBoxLayout, QWidget

from app.core.files import write_atomically
from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.exchange.csv_export import score_table, trajectory_table, write_csv
from app.imaging.volume import Volume
from app.planning.draft import DraftPlan
from app.planning.needle_overlay import NeedleOverlay
from app.session.control_scan import ControlScan
from app.session.errors import SessionError
from app.session.recording import open_recording
from app.session.result import AttemptResult
from app.session.review import Review, review, review_of_result
from app.session.sidecar import fresh_summary
from app.session.store import find
from app.session.summary import Summary
from app.views.debrief.page import DebriefPage
from app.views.debrief.report import report_bytes
from app.views.debrief.sessions import SessionsPage
from app.views.exercise.conductor import Conductor
from app.views.exercise.scan_view import ScanView, caption
from app.views.kit.background import Indicator, run_in_background
from app.views.kit.menu_entries import add_entries
from app.views.kit.text import tr
from app.views.shell.feature import Context, Feature

AskPath = Callable[[QWidget, str, str, str], str]
"""Asks where to save: parent, title, suggested path, filter; an empty answer means no."""


class DebriefController(QObject):
    """Connects debrief page and sessions page with the folder of records.

    Signals:
        shown(): the debrief page shows an attempt; bring it to the front.
        saved(str): a file was written there.
        failed(str): something did not work, in one line.
    """

    shown = Signal()
    saved = Signal(str)
    failed = Signal(str)

    def __init__(
        self,
        page: DebriefPage,
        sessions: SessionsPage,
        folder: Path,
        ask_path: AskPath | None = None,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._page = page
        self._sessions = sessions
        self._folder = folder
        self._ask_path = ask_path or ask_path_in_dialog
        page.report_requested.connect(self.save_report)
        page.export_requested.connect(self.export_one)
        sessions.open_requested.connect(lambda summary: self.open_session(summary.id))
        sessions.export_requested.connect(self.export_list)
        sessions.failed.connect(self.failed)

    def show_result(self, result: AttemptResult) -> None:
        """Show an attempt that has just finished."""
        self._read(lambda: review_of_result(result))

    def open_session(self, session_id: str) -> None:
        """Show a recorded session."""
        self._read(lambda: review(open_recording(find(self._folder, session_id))))

    def save_report(self, shown: Review) -> None:
        """Ask where, and write the report."""
        path = self._ask(tr("Save report"), f"acus-{shown.id}.pdf", tr("PDF (*.pdf)"), ".pdf")
        if path is not None:
            data = report_bytes(shown)  # Qt draws it, so it is drawn on the window's thread
            self._save(path, lambda: write_atomically(path, data))

    def export_one(self, shown: Review) -> None:
        """Ask where, and write one attempt over time as a table."""
        path = self._ask(tr("Export attempt"), f"acus-{shown.id}.csv", tr("CSV (*.csv)"), ".csv")
        if path is not None:
            self._save(path, lambda: write_csv(path, self._trajectory(shown.id)))

    def export_list(self, summaries: Sequence[Summary]) -> None:
        """Ask where, and write the scores of these sessions as a table."""
        path = self._ask(tr("Export sessions"), "acus-sessions.csv", tr("CSV (*.csv)"), ".csv")
        if path is not None:
            self._save(path, lambda: write_csv(path, self._scores(summaries)))

    # --- inside -----------------------------------------------------------------------------------
    def _read(self, operation: Callable[[], Review]) -> None:
        run_in_background(self, lambda _: operation(), self._show, self._fail)

    def _show(self, shown: Review) -> None:
        self._page.show_review(shown)
        self.shown.emit()

    def _ask(self, title: str, name: str, kind: str, suffix: str) -> Path | None:
        documents = QStandardPaths.StandardLocation.DocumentsLocation
        start = Path(QStandardPaths.writableLocation(documents)) / name
        answer = self._ask_path(self._page, title, str(start), kind)
        if not answer:
            return None
        path = Path(answer)
        return path if path.suffix else path.with_suffix(suffix)

    def _trajectory(self, session_id: str) -> str:
        return trajectory_table(open_recording(find(self._folder, session_id)))

    def _scores(self, summaries: Sequence[Summary]) -> str:
        """Table of scores, each computed from its record; what has gone stays as it was listed."""
        return score_table([self._computed(summary) for summary in summaries])

    def _computed(self, summary: Summary) -> Summary:
        try:
            return fresh_summary(find(self._folder, summary.id))
        except SessionError:
            return summary

    def _save(self, path: Path, write: Callable[[], None]) -> None:
        run_in_background(self, lambda _: write(), lambda _: self.saved.emit(str(path)), self._fail)

    def _fail(self, error: Exception) -> None:
        if isinstance(error, OSError):
            self.failed.emit(
                tr(
                    "Cannot write {file}: {why}",
                    file=error.filename or "",
                    why=error.strerror or "",
                )
            )
        else:
            self.failed.emit(str(error))


def ask_path_in_dialog(parent: QWidget, title: str, start: str, kind: str) -> str:
    """Ask with Qt's file dialog; it asks before it overwrites."""
    return QFileDialog.getSaveFileName(parent, title, start, kind)[0]


class ScanPictures(QObject):
    """Opens a scan of the debrief, if the CT that it was taken of is open."""

    def __init__(self, page: DebriefPage, conductor: Conductor, indicator: Indicator) -> None:
        super().__init__(page)
        self._page, self._conductor, self._indicator = page, conductor, indicator
        self.dialog: QDialog | None = None
        page.scans.scan_wanted.connect(self.open)

    def open(self, scan: ControlScan) -> None:
        """Make the picture beside the window, then show it."""
        patient, review = self._conductor.patient, self._page.review
        if review is None:
            return
        pseudonym = review.ct.pseudonym
        known = patient is not None and pseudonym in ("", patient.volume.series.pseudonym)
        if patient is None or not known:
            self._conductor.failed.emit(
                tr(
                    "The slices are made of the CT that was scanned, {ct}: open it first",
                    ct=pseudonym or tr("which is not open"),
                )
            )
            return
        volume, recipe = patient.volume, review.ct.recipe

        def make(progress: Progress) -> Volume:
            with ONE_AT_A_TIME:  # compiled parts: beside the window
                from app.imaging.resampling import read_again
                from app.imaging.scanned import scan_image
            ct = volume
            if recipe is not None and recipe != volume.recipe:  # the scan was of a mended one
                ct = read_again(volume.series, recipe, progress)
            return scan_image(ct, scan.order, scan.needle, bool(scan.streak), scan.shift_mm)

        run_in_background(
            self,
            make,
            lambda picture: self._show(picture, scan),
            self._conductor.failed.emit,
            title=tr("Making the slices again"),
            indicator=self._indicator,
        )

    def _show(self, picture: Volume, scan: ControlScan) -> None:
        review = self._page.review
        if review is None:
            return
        self.dialog = dialog = QDialog(self._page)
        dialog.setWindowTitle(caption(scan, review.origin))
        dialog.resize(900, 700)
        view = ScanView(self._conductor.planning, dialog)
        view.show_scan(picture, scan, review.origin)
        view.viewing.set_draft(DraftPlan.of(review.placed.plan))
        needle = scan.needle
        view.viewing.set_needle(
            NeedleOverlay(needle.hub_mm, needle.tip_mm, curve_mm=needle.corners_mm)
        )
        column = QVBoxLayout(dialog)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(view)
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()


class DebriefFeature(Feature):
    """Two pages: shown when an attempt ends, and from the menu.

    Attributes:
        page: the debrief.
        sessions: the list of past attempts.
    """

    topic: ClassVar[str] = "debrief"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        shell, folder = context.shell, context.services.sessions()
        self.page, self.sessions = DebriefPage(), SessionsPage(folder)
        for page in (self.page, self.sessions):
            shell.add_page(page)
        self._controller = DebriefController(self.page, self.sessions, folder, parent=self)
        self.scan_pictures = ScanPictures(self.page, context.conductor, shell.progress)
        self._controller.failed.connect(lambda why: self.failed.emit(why))
        self._controller.saved.connect(lambda path: self.noted.emit(tr("Saved {name}", name=path)))
        self._controller.shown.connect(self.show)
        self.page.retry_requested.connect(shell.show_workspace)
        self.page.sessions_requested.connect(self.show_sessions)
        self.sessions.closed.connect(shell.show_workspace)
        context.conductor.controller.finished.connect(self.show_result)
        menu = shell.menu(tr("&Sessions"))
        add_entries(menu, [(tr("Past sessions"), "F7", self.show_sessions)])

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self._controller.saved, self.context.shell.page_changed)

    def suit_room(self) -> None:
        """Take other colours and sizes; names are hidden, or shown again."""
        self.sessions.table.viewport().update()
        self.page.suit_room()

    def show(self) -> None:
        """Go to the attempt that the debrief shows."""
        self.context.shell.show_page(self.page)

    def show_sessions(self) -> None:
        """Go to the past attempts."""
        self.sessions.refresh()
        self.context.shell.show_page(self.sessions)

    def show_result(self, result: AttemptResult) -> None:
        """Show the debrief of an attempt that ended."""
        self.context.editors.plan.set_locked(False)
        self._controller.show_result(result)
