"""Which exercise is open, and the patient that goes with it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.core.errors import AcusError
from app.exercises.schema import Exercise
from app.views.kit.text import tr
from app.views.series.patient import Patient

if TYPE_CHECKING:
    from app.views.shell.window import MainWindow


class ExerciseChoice:
    """Takes exercises and patients into a window; what goes wrong is said at its top."""

    def __init__(self, window: MainWindow) -> None:
        self._window = window
        self._waiting: Exercise | None = None  # until its patient is there

    @property
    def titles(self) -> list[tuple[str, str]]:
        """Identifiers and titles of all exercises."""
        return [(exercise.id, exercise.title) for exercise in self._window.exercises.values()]

    def open_phantom(self) -> None:
        """Open the phantom of the present exercise, or the first."""
        exercise = self._window.conductor.exercise
        phantom = exercise.ct.phantom if exercise is not None else None
        self._window.open_ct.open_phantom(phantom.seed if phantom is not None else 1)

    def begin(self, identifier: str) -> None:
        """Take an exercise and open its patient, unless it is shown already."""
        window = self._window
        exercise = window.exercises.get(identifier)
        if exercise is None:
            names = ", ".join(window.exercises)
            window.message_bar.show_error(tr("There is no exercise {name}; there are: {names}",
                                             name=identifier, names=names))  # fmt: skip
        else:
            self._begin(exercise)

    def _begin(self, exercise: Exercise) -> None:
        """Take an exercise at once where its patient is shown, else once that one is there."""
        window = self._window
        patient = window.conductor.patient
        if patient is not None and window.conductor.fits(patient, exercise):
            if window.editor.locked:
                window.message_bar.show_error(
                    tr("An attempt is running: end it before another exercise is chosen")
                )
                self.show_taken()
                return
            window.plan_files.after_question(lambda: self._take_here(exercise))
            self.show_taken()
            return
        try:
            window.conductor.check(exercise)
        except AcusError as error:
            window.message_bar.show_error(error)
            self.show_taken()
            return
        self._waiting = exercise
        ct = exercise.ct
        if ct.phantom is not None:
            window.open_ct.open_phantom(ct.phantom.seed)
        elif ct.folder is not None:
            window.open_ct.open_folder(ct.folder, ct.series, ct.remedy)

    def _take_here(self, exercise: Exercise) -> None:
        if self._take(exercise):
            self._window.show_workspace()

    def give_up(self) -> None:
        """Stay with the present exercise: the patient of the one that was chosen did not come."""
        self._waiting = None
        self.show_taken()

    def show_taken(self) -> None:
        """Let the list stand at the exercise that is taken."""
        taken = self._window.conductor.exercise
        chosen = None if taken is None else taken.id
        self._window.workspace.exercise_panel.set_exercises(self.titles, chosen)

    def show_patient(self, patient: Patient) -> None:
        """Show a patient that was opened, in the first exercise where none is taken."""
        window = self._window
        window.message_bar.clear()  # what went wrong before is over
        waiting, self._waiting = self._waiting, None
        if waiting is None and window.conductor.exercise is None and window.exercises:
            waiting = next(iter(window.exercises.values()))
        window.conductor.leave_patient()
        if waiting is not None:
            self._take(waiting)
        window.conductor.set_patient(patient)
        self.show_taken()
        window.show_workspace()

    def _take(self, exercise: Exercise) -> bool:
        try:
            self._window.conductor.set_exercise(exercise)
        except AcusError as error:
            self._window.message_bar.show_error(error)
            return False
        return True
