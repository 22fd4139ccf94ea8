"""What the debrief's buttons do: read records, write reports and tables, beside the window."""

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import QObject, QStandardPaths, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from app.core.files import write_atomically
from app.exchange.csv_export import score_table, trajectory_table, write_csv
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
from app.views.kit.background import run_in_background
from app.views.kit.text import tr

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
