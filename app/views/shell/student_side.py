"""The student's side of the views: one panel at a time without names, and one way to the other.

The plan is there only where the exercise leaves it to the student; the attempt goes before it.
"""

from __future__ import annotations

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QPushButton, QWidget

from app.views.exercise.conductor import Conductor
from app.views.kit.access import ACCESS
from app.views.kit.roles import Role
from app.views.kit.text import tr
from app.views.reading.workspace import WorkspacePage


class StudentSide(QObject):
    """Shows plan or attempt to a student, whichever is at hand.

    Attributes:
        turn: goes to the other one; hidden where there is only the attempt.
    """

    def __init__(
        self, workspace: WorkspacePage, conductor: Conductor, plan: QWidget, parent: QObject
    ) -> None:
        super().__init__(parent)
        self._side, self._conductor, self._plan = workspace.side, conductor, plan
        self._attempt = workspace.exercise_panel
        self.turn = QPushButton(self._side)
        self._side.end_with(self.turn)
        self.turn.hide()
        self.turn.clicked.connect(lambda: self._show(not self._planning))
        self._side.changed.connect(lambda _: self.follow())
        conductor.exercise_taken.connect(lambda _: self._begin())
        conductor.patient_changed.connect(self._begin)
        conductor.controller.began.connect(lambda _: self._show(False))
        conductor.controller.worked.connect(self.follow)
        conductor.controller.finished.connect(lambda _: self.follow())

    def follow(self) -> None:
        """Show what belongs to the role, and the way to the other panel."""
        student = ACCESS.role is Role.STUDENT
        self._attempt.set_chosen_elsewhere(student)
        if student and self._planning and not self._plans:
            self._show(False)
        running = self._conductor.controller.is_running
        self.turn.setVisible(student and self._plans and not running)
        self.turn.setText(tr("Go on to the attempt") if self._planning else tr("Back to the plan"))

    @property
    def _plans(self) -> bool:
        """Return whether the plan is left to the student."""
        exercise = self._conductor.exercise
        return exercise is not None and exercise.is_own_plan

    @property
    def _planning(self) -> bool:
        shown = self._side.currentWidget()
        return shown is not None and (shown is self._plan or shown.isAncestorOf(self._plan))

    def _begin(self) -> None:
        if ACCESS.role is Role.STUDENT:
            self._show(self._plans)

    def _show(self, plan: bool) -> None:
        if ACCESS.role is Role.STUDENT:
            self._side.setCurrentWidget(self._plan if plan else self._attempt)
        self.follow()
