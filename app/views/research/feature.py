"""Research studies in the window, for the instructor: due visits, and questionnaires."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from datetime import UTC, datetime
from typing import ClassVar, TypeVar

from PySide6.QtCore import SignalInstance
from PySide6.QtWidgets import QDialog

from app.core.errors import AcusError
from app.core.loading import ONE_AT_A_TIME
from app.session.people import People
from app.views.kit.access import ACCESS
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.menu_entries import add_entries
from app.views.kit.roles import STAFF, Role
from app.views.kit.text import tr, tr_n
from app.views.research.questionnaire import QuestionnaireDialog
from app.views.research.studies_dialog import StudiesDialog, StudyLook
from app.views.shell.feature import Context, Feature

T = TypeVar("T")


class ResearchFeature(Feature):
    """An entry of the menu *Sessions*; when the instructor signs in, how many visits are due.

    Attributes:
        entry: of the menu.
        dialog: the one that was opened last; None where none is open.
    """

    topic: ClassVar[str] = "research"
    place: ClassVar[int] = 185
    roles: ClassVar[frozenset[Role]] = STAFF
    help: ClassVar[str] = "research.md"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._people, self._folder = People(), context.services.sessions()
        self._tasks: list[BackgroundTask] = []
        self._was_instructor = False
        self.dialog: QDialog | None = None
        menu = context.shell.menu(tr("&Sessions"))
        (self.entry,) = add_entries(menu, ((tr("Research studies…"), "", self.show),))
        ACCESS.changed.connect(self._follow)
        self._follow()

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self.context.shell.page_changed, ACCESS.changed)

    def close(self) -> None:
        """End what runs, and the dialog that is open."""
        ACCESS.changed.disconnect(self._follow)
        for task in tuple(self._tasks):
            task.close()
        if self.dialog is not None:
            self.dialog.done(QDialog.DialogCode.Rejected)

    def show(self) -> None:
        """Look where the studies stand, and show it."""
        if not ACCESS.may_manage:
            self.failed.emit(ACCESS.why_not_manage)
            return
        self._beside(self._looked, self._show, tr("Looking at the studies"))

    def answer(self, study: str, student: str, visit: str, questionnaire: str) -> None:
        """Let a student answer a questionnaire; what is kept cannot be changed."""
        from app.research import find_study
        from app.research.questionnaires import find_questionnaire
        from app.research.research_study import AnsweredRow

        try:
            begun, asked = find_study(study), find_questionnaire(questionnaire)
            begun.check_answerable(student, visit, asked, self._people)
        except AcusError as error:
            self.failed.emit(error)
            return

        def take(answers: Mapping[str, float]) -> None:
            begun.answer([AnsweredRow(student, visit, answers)], asked, self._people)
            self.noted.emit(
                tr(
                    "Kept: {title} of {student}, {visit}",
                    title=asked.title,
                    student=student,
                    visit=visit,
                )
            )

        who = tr(
            "{student}, visit {visit}. Nobody is judged by this.", student=student, visit=visit
        )
        self._open(QuestionnaireDialog(asked, who, take, self.context.shell.dialog_parent))

    def _looked(self) -> list[StudyLook]:
        with ONE_AT_A_TIME:
            from app.research import studies_here
            from app.research.status import status_of, taking_part
        return [
            StudyLook(
                status_of(one, self._people, self._folder),
                tuple(taking_part(one, self._people)),
                tuple(visit.name for visit in one.design.visits),
            )
            for one in studies_here()
        ]

    def _show(self, studies: list[StudyLook]) -> None:
        from app.research.questionnaires import questionnaire_titles

        parent = self.context.shell.dialog_parent
        dialog = StudiesDialog(studies, questionnaire_titles(), parent)
        dialog.wanted.connect(self.answer)
        self._open(dialog)

    def _follow(self) -> None:
        """Close the entry to students; say how many visits are due when the instructor has come."""
        self.entry.setEnabled(ACCESS.may_manage)
        came = ACCESS.instructor and not self._was_instructor
        self._was_instructor = ACCESS.instructor
        if came:
            self._beside(self._looked, self._tell_due)

    def _tell_due(self, studies: list[StudyLook]) -> None:
        today = datetime.now(UTC).date().isoformat()
        due = [row for one in studies for row in one.status["due"] if row["open"]]
        if due and ACCESS.instructor:
            last = sum(row["closes"] == today for row in due)
            words = tr_n(
                "{n} visit of a study is due: Sessions, Research studies…",
                "{n} visits of studies are due: Sessions, Research studies…",
                len(due),
            )
            if last:
                words += " " + tr_n("The last day for {n}.", "The last day for {n}.", last)
            self.noted.emit(words)

    def _beside(self, work: Callable[[], T], done: Callable[[T], object], title: str = "") -> None:
        indicator = self.context.shell.progress if title else None
        task = run_in_background(
            self, lambda _: work(), done, self.failed.emit, title=title, indicator=indicator
        )
        self._tasks.append(task)
        task.finished.connect(lambda: self._tasks.remove(task))

    def _open(self, dialog: QDialog) -> None:
        self.dialog = dialog

        def ended() -> None:
            if self.dialog is dialog:
                self.dialog = None
            dialog.deleteLater()

        dialog.finished.connect(ended)
        dialog.open()
