"""From one patient to the next: what is replaced is named first, and nothing of it is left."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QMessageBox

from app.planning.draft import DraftPlan
from app.planning.patient import Patient
from app.views.kit.names import NAMES
from app.views.kit.text import tr
from app.views.shell.feature import Context, Feature


class ChangeOfPatient(QObject):
    """Asks before a patient is replaced, and lets an attempt wait until the new one is there."""

    def __init__(self, context: Context, features: Sequence[Feature]) -> None:
        super().__init__(context.shell.dialog_parent)
        self._context, self._features = context, features
        self._conductor, self._editor = context.conductor, context.editors.plan
        self._asked: DraftPlan | None = None

    # --- before -------------------------------------------------------------------------------
    def at_stake(self) -> list[str]:
        """Say what another patient would replace: CT, running attempt, unsaved plan."""
        stake = []
        patient = self._conductor.patient
        if patient is not None:
            stake.append(tr("the CT {name}", name=NAMES.shown(patient.label)))
        if self._editor.locked:
            stake.append(tr("the attempt that is running: it ends and is saved, without a score"))
        return stake + self._unsaved()

    def _unsaved(self) -> list[str]:
        return [words for feature in self._features if (words := feature.unsaved())]

    def may_replace(self) -> bool:
        """Ask whether what is at stake may go; True at once where nothing is."""
        stake = self.at_stake()
        self._asked = self._editor.edit.draft
        if not stake:
            return True
        lines = "\n".join(f"•  {line}" for line in stake)
        text = tr("Opening a patient replaces:") + f"\n{lines}"
        box, dirty = QMessageBox.StandardButton, bool(self._unsaved())
        if dirty:
            text += "\n\n" + tr("Save the plan first?")
        choices = box.Save | box.Discard | box.Cancel if dirty else box.Open | box.Cancel
        title, default = tr("Open another patient"), box.Save if dirty else box.Open
        parent = self._context.shell.dialog_parent
        answer = QMessageBox.question(parent, title, text, choices, default)
        if answer == box.Save:
            return all(feature.save() for feature in self._features if feature.unsaved())
        return answer in (box.Discard, box.Open)

    # --- meanwhile ----------------------------------------------------------------------------
    def set_loading(self, loading: bool) -> None:
        """Let Start wait while a patient is loaded: it would run on the one that is to go."""
        why = tr("Start waits: another patient is being opened.") if loading else ""
        self._conductor.controller.set_waiting(why)

    # --- after --------------------------------------------------------------------------------
    def take(self, patient: Patient, show: Callable[[Patient], object]) -> bool:
        """Show a patient that has been loaded; asks again about a plan that was changed since."""
        editor = self._editor
        if editor.dirty and editor.edit.draft != self._asked and not self.may_replace():
            self._context.patients.given_up.emit()
            return False
        show(patient)
        return True
