"""Which exercise is open, and the patient that goes with it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.core.errors import AcusError
from app.exercises.schema import Exercise
from app.views.patient import Patient
from app.views.text import tr

if TYPE_CHECKING:
    from app.views.window import MainWindow


class ExerciseChoice:
    """Takes exercises and patients into a window; what goes wrong is said at its top."""

    def __init__(self, window: MainWindow) -> None:
        self._window = window

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
        elif window.plan_files.after_question(lambda: self._begin(exercise)):
            window.workspace.exercise_panel.set_exercises(self.titles, identifier)

    def _begin(self, exercise: Exercise) -> None:
        window = self._window
        if not self._take(exercise):
            return
        patient = window.conductor.patient
        if patient is not None and window.conductor.fits(patient):
            window.show_workspace()
        elif exercise.ct.phantom is not None:
            window.open_ct.open_phantom(exercise.ct.phantom.seed)
        elif (ct := exercise.ct).folder is not None:
            window.open_ct.open_folder(ct.folder, ct.series, ct.remedy)

    def show_patient(self, patient: Patient) -> None:
        """Show a patient that was opened, in the first exercise where none is taken."""
        window = self._window
        window.message_bar.clear()  # what went wrong before is over
        if window.conductor.exercise is None and window.exercises:
            self._take(next(iter(window.exercises.values())))
        window.conductor.set_patient(patient)
        window.show_workspace()

    def _take(self, exercise: Exercise) -> bool:
        try:
            self._window.conductor.set_exercise(exercise)
        except AcusError as error:
            self._window.message_bar.show_error(error)
            return False
        return True
