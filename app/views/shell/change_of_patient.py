"""From one patient to the next: what is replaced is named first, and nothing of it is left."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QMessageBox

from app.planning.draft import DraftPlan
from app.views.kit.names import NAMES
from app.views.kit.text import tr
from app.views.series.patient import Patient
from app.views.slices.viewing import Tool

if TYPE_CHECKING:
    from app.views.shell.window import MainWindow


def forget_patient(window: MainWindow) -> None:
    """Empty everything that a window has of its patient.

    The one place for it: a feature that keeps something of a patient (a number, a picture, a mark,
    a step to undo) is emptied here. Settings, the record of attempts and the exercise stay.
    """
    workspace = window.workspace
    viewing, scene, panel = workspace.viewing, workspace.scene, workspace.exercise_panel
    window.structures.forget()
    window.paths.clear()
    window.checks.forget()
    workspace.measure.set_volume(None)
    window.undo.clear()
    window.conductor.scans.forget()
    workspace.share_room()
    viewing.set_tool(Tool.NAVIGATE)
    viewing.set_needle(None)
    viewing.set_draft(DraftPlan())
    scene.set_surfaces(None)
    scene.set_needle(None)
    scene.set_plan(DraftPlan())
    scene.set_note("")
    panel.forget()
    workspace.bullseye.set_scene(None, False)
    workspace.needle_cell.gauge.show_force(None)
    workspace.tracker_panel.forget()
    workspace.health_panel.clear()
    workspace.status.show_items(())
    workspace.messages.clear()
    window.message_bar.clear()


class ChangeOfPatient(QObject):
    """Asks before a patient is replaced, and lets an attempt wait until the new one is there."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self._window = window
        self._asked: DraftPlan | None = None

    # --- before -------------------------------------------------------------------------------
    def at_stake(self) -> list[str]:
        """Say what another patient would replace: CT, running attempt, unsaved plan."""
        window, stake = self._window, []
        patient = window.conductor.patient
        if patient is not None:
            stake.append(tr("the CT {name}", name=NAMES.shown(patient.label)))
        if window.editor.locked:
            stake.append(tr("the attempt that is running: it ends and is saved, without a score"))
        if window.editor.dirty:
            name = NAMES.shown(window.editor.edit.draft.name)
            stake.append(tr("the plan “{name}”, which has unsaved changes", name=name))
        return stake

    def may_replace(self) -> bool:
        """Ask whether what is at stake may go; True at once where nothing is."""
        stake = self.at_stake()
        self._asked = self._window.editor.edit.draft
        if not stake:
            return True
        lines = "\n".join(f"•  {line}" for line in stake)
        text = tr("Opening a patient replaces:") + f"\n{lines}"
        box, dirty = QMessageBox.StandardButton, self._window.editor.dirty
        if dirty:
            text += "\n\n" + tr("Save the plan first?")
        choices = box.Save | box.Discard | box.Cancel if dirty else box.Open | box.Cancel
        title, default = tr("Open another patient"), box.Save if dirty else box.Open
        answer = QMessageBox.question(self._window, title, text, choices, default)
        if answer == box.Save:
            return self._window.plan_files.save()
        return answer in (box.Discard, box.Open)

    # --- meanwhile ----------------------------------------------------------------------------
    def set_loading(self, loading: bool) -> None:
        """Let Start wait while a patient is loaded: it would run on the one that is to go."""
        why = tr("Start waits: another patient is being opened.") if loading else ""
        self._window.conductor.controller.set_waiting(why)

    # --- after --------------------------------------------------------------------------------
    def take(self, patient: Patient, show: Callable[[Patient], object]) -> bool:
        """Show a patient that has been loaded; asks again about a plan that was changed since."""
        editor = self._window.editor
        if editor.dirty and editor.edit.draft != self._asked and not self.may_replace():
            self._window.choice.give_up()
            return False
        show(patient)
        return True
