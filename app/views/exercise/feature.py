"""Exercises in the window: which one is open, the patient that goes with it, their panels."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QSplitter

from app.core.errors import AcusError
from app.core.progress import Progress
from app.exercises.guidance import StartingDial, starting_dial
from app.exercises.scene import draft_of
from app.exercises.schema import Exercise
from app.planning.draft import DraftPlan
from app.planning.patient import Patient
from app.views.exercise.beginning import Beginning
from app.views.kit.access import ACCESS
from app.views.kit.background import run_in_background
from app.views.kit.parts import ask
from app.views.kit.roles import EVERYBODY, Role
from app.views.kit.text import declared, listing, tr, translated
from app.views.reading.lock_words import CAMERA_ROLES
from app.views.shell.feature import Context, Feature
from app.views.shell.message_bar import ATTEMPT_RUNS


class ExerciseFeature(Feature):
    """Takes exercises and patients into the window; what goes wrong is said at its top.

    Attributes:
        exercises: all there are, by identifier, easiest first.
        beginning: leads from the wish to begin one to its attempt.
    """

    place: ClassVar[int] = 60
    roles: ClassVar[frozenset[Role]] = EVERYBODY

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._conductor, self._patients = context.conductor, context.patients
        self._editor, self._shell = context.editors.plan, context.shell
        self._panel = context.conductor.views.panel
        self._waiting: Exercise | None = None  # until its patient is there
        self._fading: Exercise | None = None  # whose dial changes over the attempts
        self._asked = 0
        self.exercises = {exercise.id: exercise for exercise in context.services.exercises()}
        self._shell.add_panel(self._panel, tr("Exercise"))
        with self._shell.made_for(CAMERA_ROLES):
            self._shell.add_panel(self._cameras(), tr("Cameras"), scrolls=False)
        self._panel.set_exercises(self.titles)
        self._panel.buttons.watch(self._shell.dialog_parent)
        self._panel.exercise_chosen.connect(self.begin)
        self._conductor.exercises_changed.connect(self._read_exercises)
        self._conductor.exercise_taken.connect(lambda _: self.show_taken())
        self._conductor.exercise_taken.connect(self._take_fading)
        self._conductor.controller.finished.connect(lambda _: self._follow_fading())
        self._panel.student.editingFinished.connect(self._follow_fading)
        self.beginning = Beginning(context, self._begin, lambda: self.exercises, self)
        self._patients.failed.connect(lambda _: self.give_up())
        self._patients.given_up.connect(self.give_up)

    def _cameras(self) -> QSplitter:
        views = self._conductor.views
        cameras = QSplitter(Qt.Orientation.Vertical)
        cameras.addWidget(views.tracker)
        cameras.addWidget(views.messages)
        cameras.setStretchFactor(0, 3)
        cameras.setStretchFactor(1, 1)
        return cameras

    # --- the end of the window ----------------------------------------------------------------
    def may_quit(self) -> bool:
        """Ask whether an attempt that runs may end with the window; True where none does."""
        run, controller = self._conductor.controller.run, self._conductor.controller
        if run is None or run.demonstrates or not controller.is_running:
            return True
        answers = tr("Go on with the attempt"), tr("End it and quit")
        answer = ask(
            self._shell.dialog_parent,
            tr("Quit"),
            tr("An attempt is running. End it and quit?"),
            tr("It ends without a score; what is recorded so far stays."),
            answers,
            escape=0,
        )
        return answer == 1

    # --- assistance over the attempts ---------------------------------------------------------
    def _take_fading(self, _: str) -> None:
        exercise = self._conductor.exercise
        self._fading = None if exercise is None or exercise.fading is None else exercise
        self._follow_fading()

    def _follow_fading(self) -> None:
        """Look up what the student did so far, and begin the next attempt accordingly."""
        exercise, controller = self._fading, self._conductor.controller
        self._asked += 1
        if exercise is None:
            return
        number = self._asked
        student = ACCESS.recorded_as(self._panel.student.text().strip())
        folder = self.context.services.sessions()
        controller.set_waiting(tr("Start has to wait: earlier attempts are being looked up."))

        def look_up(_: Progress) -> list[float | None]:
            from app.session.index import totals_of  # SQLAlchemy: behind the window

            return totals_of(folder, student, exercise.id, exercise.version)

        def fail(error: Exception) -> None:
            self.failed.emit(error)
            take([])

        def take(totals: list[float | None]) -> None:
            if number != self._asked:
                return  # somebody else, or another exercise, by now
            controller.set_waiting("")
            self._begin_with(exercise, starting_dial(exercise.assistance, exercise.fading, totals))

        run_in_background(self, look_up, take, fail)

    def _begin_with(self, exercise: Exercise, dial: StartingDial) -> None:
        self._conductor.go_on_with(exercise.beginning_with(dial))
        if dial.is_probe:
            self.noted.emit(tr("This attempt is a probe: without help, as in an assessment."))
        else:
            self.noted.emit(
                tr("Assistance of this attempt: {share} %", share=f"{100.0 * dial.share:.0f}")
            )

    def _read_exercises(self) -> None:
        """List the exercises anew."""
        found = self.context.services.exercises()
        self.exercises = {exercise.id: exercise for exercise in found}
        self.show_taken()

    @property
    def titles(self) -> list[tuple[str, str]]:
        """Identifiers and titles of all exercises, and of one that is taken without being kept."""
        found = {exercise.id: declared(exercise.title) for exercise in self.exercises.values()}
        taken = self._conductor.exercise
        if taken is not None and taken.id not in found:
            words = tr("{title} (not kept)", title=declared(taken.title))
            found[taken.id] = _drill_words(taken) or words
        return list(found.items())

    def begin(self, identifier: str) -> None:
        """Take an exercise and open its patient, unless it is shown already."""
        exercise = self.exercises.get(identifier)
        if exercise is None:
            names = listing(self.exercises)
            self._shell.messages.show_error(
                tr("There is no exercise {name}; there are: {names}", name=identifier, names=names)
            )
        else:
            self._begin(exercise)

    def take_first(self) -> None:
        """Take the easiest exercise and open its patient."""
        if self.exercises:
            self._begin(next(iter(self.exercises.values())))

    def _begin(self, exercise: Exercise) -> None:
        """Take an exercise at once where its patient is shown, else once that one is there."""
        patient = self._conductor.patient
        if patient is not None and self._conductor.fits(patient, exercise):
            if self._editor.locked:
                self._shell.messages.show_until(
                    ATTEMPT_RUNS,
                    tr("An attempt is running: end it before another exercise is chosen"),
                )
                self.show_taken()
                return
            self._take_once_asked(exercise)
            self.show_taken()
            return
        try:
            self._conductor.check(exercise)
        except AcusError as error:
            self._shell.messages.show_error(error)
            self.show_taken()
            return
        self._waiting = exercise
        ct = exercise.ct
        if ct.phantom is not None:
            self._patients.open_phantom(ct.phantom.seed)
        elif ct.folder is not None:
            self._patients.open_folder(ct.folder, ct.series, ct.remedy)

    def _take_once_asked(self, exercise: Exercise) -> None:
        """Take an exercise on the patient who is shown; the plan of the same one may stay."""
        taken, plan = self._conductor.exercise, self._editor
        own = exercise.is_own_plan
        if exercise.drill is not None and _same_points(plan.edit.draft, draft_of(exercise)):
            self._take_here(exercise)  # nothing is lost: its plan is the one that is shown
            self.noted.emit(translated(exercise.description))
            return
        again = taken is not None and taken.id == exercise.id and plan.edit.draft.complete
        if not (again and (own or plan.dirty)):
            if self._shell.may_go():
                self._take_here(exercise)
            return
        if own and not plan.attempted:
            self._go_on(exercise)  # it is being planned: there is nothing to choose between
            return
        answer = ask(
            self._shell.dialog_parent,
            declared(exercise.title),
            tr("Same plan, or a new one?"),
            tr("The plan of an attempt stays in its record."),
            (tr("Same plan"), tr("New plan"), tr("Cancel")),
            escape=2,
        )
        if answer == 0:
            self._go_on(exercise)
        elif answer == 1 and (own or self._shell.may_go()):
            self._take_here(exercise)

    def _go_on(self, exercise: Exercise) -> None:
        """Go on with the plan that is shown."""
        if exercise.fading is None:  # else the dial of the next attempt is there already
            self._conductor.go_on_with(exercise)
        self._show(exercise)

    def _take_here(self, exercise: Exercise) -> None:
        if self._take(exercise):
            self._show(exercise)

    def give_up(self) -> None:
        """Stay with the present exercise: the patient of the one that was chosen did not come."""
        self._waiting = None
        self.beginning.give_up()
        self.show_taken()

    def forget(self) -> None:
        """End a demonstration: another patient is coming."""
        self.beginning.forget()

    def show_taken(self) -> None:
        """Let the list stand at the exercise that is taken."""
        taken = self._conductor.exercise
        chosen = None if taken is None else taken.id
        self._panel.set_exercises(self.titles, chosen)
        self._panel.rail.set_drill("" if taken is None else _drill_words(taken))

    def show_patient(self, patient: Patient) -> None:
        """Show a patient that was opened, in the first exercise where none is taken."""
        self._shell.messages.clear()  # what went wrong before is over
        waiting, self._waiting = self._waiting, None
        begun = waiting
        if waiting is None and self._conductor.exercise is None and self.exercises:
            waiting = next(iter(self.exercises.values()))
        self._conductor.leave_patient()
        if waiting is not None:
            self._take(waiting)
        self._conductor.set_patient(patient)
        self.show_taken()
        self._show(begun)

    def _show(self, begun: Exercise | None) -> None:
        """Begin means begin: go to the attempt, or to what is to be planned or was only opened."""
        if begun is None or begun.is_own_plan:
            self._shell.show_workspace()
        else:
            self._shell.show_panel(self._panel)

    def _take(self, exercise: Exercise) -> bool:
        try:
            self._conductor.set_exercise(exercise)
        except AcusError as error:
            self._shell.messages.show_error(error)
            return False
        return True


def _same_points(plan: DraftPlan, other: DraftPlan) -> bool:
    """Return whether two plans have the same entry and target, both whole."""
    pairs = ((plan.entry_mm, other.entry_mm), (plan.target_mm, other.target_mm))
    return all(a is not None and b is not None and np.allclose(a, b) for a, b in pairs)


def _drill_words(exercise: Exercise) -> str:
    """Name a drill by the exercise that it is of; empty for a whole exercise."""
    title = declared(exercise.title)
    return "" if exercise.drill is None else tr("Drill: {title}", title=title)
