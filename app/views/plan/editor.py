"""The plan and the patient's position while they are edited: undo, files, the robot's verdict.

Plans are 3D Slicer markups files, and nothing is lost without a question.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QFileDialog, QMessageBox, QWidget

from app.core.errors import AcusError
from app.exchange.markups import read_plan, write_plan
from app.mechanisms.profile import DeviceProfile
from app.planning.draft import DraftPlan, Edit, Judge, PlanVerdict
from app.planning.history import UndoHistory
from app.planning.placement import Placement
from app.planning.plan import Plan
from app.views.kit.access import ACCESS
from app.views.kit.names import NAMES
from app.views.kit.roles import Role
from app.views.kit.text import declared, literal, tr, translated
from app.views.shell.settings import Recents
from app.views.slices.viewing import Tool

if TYPE_CHECKING:
    from app.imaging.body import Body


SUFFIX = ".mrk.json"


class PlanFiles(QObject):
    """Reads and writes the editor's plan.

    Signals:
        failed(object): an error that kept a file from being read or written.
        noted(str): what was done.
    """

    failed = Signal(object)
    noted = Signal(str)

    def __init__(self, editor: PlanEditor, recents: Recents, window: QWidget) -> None:
        super().__init__(window)
        self._editor, self._recents, self._window = editor, recents, window

    def new(self) -> None:
        """Start an empty plan, unless an attempt keeps the present one."""
        if not self._editor.refuse_locked():
            self.after_question(lambda: self._editor.start(None))

    def ask_open(self) -> None:
        """Ask for a file and open it, unless an attempt keeps the present plan."""
        if not self._editor.refuse_locked():
            self.after_question(self._ask_open)

    def open(self, path: Path) -> None:
        """Open this file, after the question about unsaved changes."""
        self.after_question(lambda: self._open(path))

    def save(self) -> bool:
        """Write to the plan's file, or ask for one; return whether it was written."""
        path = self._editor.path
        return self._write(path) if path is not None else self.save_as()

    def save_as(self) -> bool:
        """Ask where to write; return whether it was written."""
        own = self._editor.path or Path.home() / f"{self._editor.edit.draft.name}{SUFFIX}"
        start = str(NAMES.folder(own))
        name, _ = QFileDialog.getSaveFileName(
            self._window, tr("Save plan"), start, tr("Plans (*{suffix})", suffix=SUFFIX)
        )
        if not name:
            return False
        path = Path(name if name.endswith(".json") else name + SUFFIX)
        return self._write(path)

    def after_question(self, action: Callable[[], object]) -> bool:
        """Do `action` unless the user wants to keep unsaved changes; return whether it was done."""
        if self._editor.dirty and not self._may_go():
            return False
        action()
        return True

    def _may_go(self) -> bool:
        buttons = QMessageBox.StandardButton
        if ACCESS.role is Role.STUDENT:  # whose window has no files of plans
            if self._editor.attempted:
                return True
            title, words = tr("Plan without an attempt"), tr("Leave the plan? No attempt has it.")
            choices = buttons.Discard | buttons.Cancel
        else:
            title, words = (
                tr("Unsaved plan"),
                tr("The plan has unsaved changes. Save them first?"),
            )
            choices = buttons.Save | buttons.Discard | buttons.Cancel
        # Enter, perhaps meant for the page, writes nothing and throws nothing away.
        answer = QMessageBox.question(self._window, title, literal(words), choices, buttons.Cancel)
        if answer == buttons.Save:
            return self.save()
        return answer == buttons.Discard

    def _ask_open(self) -> None:
        own = self._editor.path.parent if self._editor.path else Path.home()
        start = str(NAMES.folder(own))
        kinds = tr("Plans (*{suffix} *.json)", suffix=SUFFIX)
        name, _ = QFileDialog.getOpenFileName(self._window, tr("Open plan"), start, kinds)
        if name:
            self._open(Path(name))

    def _open(self, path: Path) -> None:
        NAMES.learn(path)
        try:
            plan = read_plan(path)
        except AcusError as error:
            self.failed.emit(error)
            return
        self._editor.opened(path, plan)
        self._recents.add(path)
        self.noted.emit(tr("Opened {name}", name=path.name))

    def _write(self, path: Path) -> bool:
        NAMES.learn(path)
        try:
            write_plan(path, self._editor.edit.draft.plan())
        except AcusError as error:
            self.failed.emit(error)
            return False
        self._editor.saved(path)
        self._recents.add(path)
        self.noted.emit(tr("Saved {name}", name=path.name))
        return True


Point = tuple[float, float, float]

OWN_TOOLS = (Tool.ENTRY, Tool.TARGET)
"""Tools whose points the plan takes."""


KEPT = "this exercise gives the target; the entry is yours to choose"


class PlanEditor(QObject):
    """Holds the history; every change gives a new verdict at once.

    Signals:
        changed(): draft, placement, verdict, dirty or path is another.
        stepped(object): this editor has made a step that can be undone.
        refused(object): why something was not done, as text.
    """

    changed = Signal()
    stepped = Signal(object)
    refused = Signal(object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._history = UndoHistory(Edit())
        self._saved = Edit()
        self._judge = Judge()
        self.path: Path | None = None
        self.locked = self.keeps_target = False
        self._exercise = ("", "")
        self._clicked: tuple[Point, DraftPlan] | None = None
        self._attempted: DraftPlan | None = None
        self._fresh = True  # the present gesture has changed nothing yet
        self.verdict = PlanVerdict(None)

    # --- what is there ------------------------------------------------------------------------
    @property
    def edit(self) -> Edit:
        """Points and position now."""
        return self._history.present

    @property
    def name(self) -> str:
        """Name of the plan for people: its file, or the title of the exercise that it is of."""
        if self.path is not None:
            return self.path.name
        name, (identifier, title) = self.edit.draft.name, self._exercise
        return declared(title) if title and name == identifier else name

    @property
    def dirty(self) -> bool:
        """Return whether points were changed since the plan was opened or saved."""
        return self.edit.draft != self._saved.draft

    @property
    def attempted(self) -> bool:
        """Return whether an attempt was made with the points as they are: its record has them."""
        return self._attempted is not None and self._attempted == self.edit.draft

    def note_attempt(self) -> None:
        """Remember that an attempt is made with the points as they are."""
        self._attempted = self.edit.draft

    @property
    def can_undo(self) -> bool:
        """Return whether there is a step to take back."""
        return self._history.can_undo and not self.locked

    @property
    def can_redo(self) -> bool:
        """Return whether there is a step to take again."""
        return self._history.can_redo and not self.locked

    # --- what it stands on --------------------------------------------------------------------
    def set_body(self, body: Body | None) -> None:
        """Take the patient whose skin entries snap to."""
        self._judge.body = body
        self._announce()

    def set_profile(self, profile: DeviceProfile) -> None:
        """Take the device whose reach is judged."""
        self._judge.profile = profile
        self._announce()

    def set_locked(self, locked: bool) -> None:
        """Refuse changes while an attempt runs."""
        self.locked = locked
        self.changed.emit()

    def set_exercise(self, identifier: str, title: str) -> None:
        """Take the exercise whose plans are called by its title."""
        self._exercise = identifier, title

    def set_keeps_target(self, keeps: bool) -> None:
        """Refuse another target from now on: the exercise gives it, the entry is the student's."""
        self.keeps_target = keeps

    def _moves_target(self, draft: DraftPlan) -> bool:
        """Return whether a draft has another target than the one to be kept."""
        return self.keeps_target and draft.target_mm != self.edit.draft.target_mm

    # --- edits --------------------------------------------------------------------------------
    def start(self, plan: Plan | DraftPlan | None, placement: Placement | None = None) -> None:
        """Begin anew with a plan, a part of one, or none; there is nothing to undo then.

        A target that the exercise gives (`set_keeps_target`) stays.
        """
        draft = DraftPlan.of(plan) if isinstance(plan, Plan) else plan or DraftPlan()
        if self._moves_target(draft):
            draft = DraftPlan(None, self.edit.draft.target_mm, self.edit.draft.name)
        edit = Edit(draft, placement or self.edit.placement)
        self._history, self._saved, self.path = UndoHistory(edit), edit, None
        self._attempted = None
        self._announce()

    def opened(self, path: Path, plan: Plan) -> None:
        """Take over a plan that was read from a file, unless an attempt keeps the present one."""
        if self.refuse_locked():
            return
        if self._moves_target(DraftPlan.of(plan)):
            self.refused.emit(KEPT)
            return
        self.start(plan)
        self.path = path
        self.changed.emit()

    def saved(self, path: Path | None) -> None:
        """Remember where the plan was written; None where an exercise holds it, and no file."""
        self.path, self._saved = path, self.edit
        self.changed.emit()

    @property
    def from_click_mm(self) -> tuple[float, float, float] | None:
        """From where the entry was clicked to where it lies on the skin, LPS [mm].

        None for an entry that was not clicked, or that something else has set since.
        """
        clicked, entry = self._clicked, self.edit.draft.entry_mm
        if clicked is None or entry is None or entry != clicked[1].entry_mm:
            return None
        (x, y, z), (a, b, c) = clicked[0], entry
        return a - x, b - y, c - z

    def place(self, tool: Tool, point: Point, starts_step: bool) -> None:
        """Set entry (on the skin next to `point`) or target; one drag is one step to undo.

        Points of other tools are somebody else's: nothing happens.
        """
        if tool not in OWN_TOOLS or self.refuse_locked():
            return
        if tool is Tool.TARGET and self.keeps_target:
            self.refused.emit(KEPT)
            return
        self._fresh = self._fresh or starts_step
        try:
            place = self._judge.on_skin(point) if tool is Tool.ENTRY else point
            draft = self.edit.draft
            draft = draft.with_entry(place) if tool is Tool.ENTRY else draft.with_target(place)
        except AcusError as error:
            self.refused.emit(translated(error))
            return
        edit = replace(self.edit, draft=draft)
        if edit == self.edit:
            return
        if tool is Tool.ENTRY:
            self._clicked = (point, draft)
        if self._fresh:
            self._do(edit)
        else:
            self._history = self._history.amend(edit)
        self._fresh = False
        self._announce()

    def set_placement(self, placement: Placement) -> None:
        """Lay the patient differently."""
        if not self.refuse_locked():
            self._do(replace(self.edit, placement=placement))
            self._announce()

    def take(self, draft: DraftPlan, placement: Placement) -> None:
        """Take points and position together, as one step to undo."""
        if self._moves_target(draft):
            self.refused.emit(KEPT)
            return
        if not self.refuse_locked():
            self._do(Edit(draft, placement))
            self._announce()

    def apply_remedy(self) -> None:
        """Turn the patient as the verdict suggests."""
        reached = self.verdict.reach
        if reached is not None and reached.remedy is not None:
            self.set_placement(reached.remedy.placement)

    def undo(self) -> None:
        """Take the last step back."""
        self._step(self._history.undo)

    def redo(self) -> None:
        """Take it again."""
        self._step(self._history.redo)

    # --- inside -------------------------------------------------------------------------------
    def _do(self, edit: Edit) -> None:
        before, self._history = self._history, self._history.do(edit)
        if self._history is not before:
            self.stepped.emit(self)

    def _step(self, move: Callable[[], UndoHistory[Edit]]) -> None:
        if not self.refuse_locked():
            self._history = move()
            self._announce()

    def refuse_locked(self) -> bool:
        """Return whether an attempt keeps the plan as it is; then that is said."""
        if self.locked:
            self.refused.emit("the plan cannot change while an attempt runs: end it first")
        return self.locked

    def _announce(self) -> None:
        self.verdict = self._judge.verdict(self.edit)
        self.changed.emit()
