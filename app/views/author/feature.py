"""Make an exercise from what is open; change, try, keep, carry it: one form beside the CT."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

from PySide6.QtCore import (
    QEvent,
    QObject,
    QProcess,
    QProcessEnvironment,
    QTemporaryDir,
    QTimer,
    Signal,
    SignalInstance,
)
from PySide6.QtGui import QCloseEvent, QKeyEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QFileDialog,
    QHBoxLayout,
    QLineEdit,
    QMessageBox,
    QPlainTextEdit,
    QVBoxLayout,
    QWidget,
)

from app.core.child_process import environment, module_command
from app.core.configuration import FieldProblem
from app.core.documents import Where
from app.core.errors import AcusError
from app.core.progress import Progress
from app.core.units import MILLIMETRE
from app.exchange.acusx import (
    SUFFIX,
    CtMissingError,
    TakenError,
    UnpackedExercise,
    pack,
    read_manifest,
    unpack,
)
from app.exercises.errors import ExerciseError
from app.exercises.hand_bands import bands_among
from app.exercises.library import folders
from app.exercises.parts import OF_OWN_PLANS
from app.exercises.scene import plan_of
from app.exercises.schema import Exercise
from app.exercises.writing import exercise_document, exercise_text, free_id, taken_ids
from app.imaging.errors import ImagingError
from app.session.pad.view import rings_of
from app.views.author.editing import (
    OWN_PLAN,
    PLANNED,
    ExerciseEditor,
    bone_words,
    finished,
    is_own,
    opened_document,
    plan_document,
)
from app.views.author.effects_page import EffectsPage
from app.views.author.page import FormPage
from app.views.author.pages import (
    OWN,
    SCANS,
    HelpPage,
    PatientPage,
    ReviewPage,
    SightPage,
    TaskPage,
)
from app.views.author.score_page import ScorePage
from app.views.kit import theme
from app.views.kit.access import ACCESS
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.field_words import problem_words
from app.views.kit.menu_entries import add_entries
from app.views.kit.names import NAMES
from app.views.kit.parts import button, label
from app.views.kit.roles import STAFF, Role
from app.views.kit.side_panel import scrolled
from app.views.kit.text import listing, literal, tr, tr_n, translated
from app.views.kit.verdict import Verdict
from app.views.kit.wizard import Wizard
from app.views.shell.feature import Context, Feature
from app.views.slices.panes import PaneId

UNDO_KEYS = ("Ctrl+Z", "Ctrl+Y", "Ctrl+Shift+Z")

COST_AFTER_MS = 400
TRIAL_AFTER_MS = 700
TRIAL_SEEDS = (2, 20)


class _UndoOfTheForm(QObject):
    """Keeps texts from undoing letters of their own: Ctrl+Z takes back the form's last step."""

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Leave the keys of undo and redo to the form's shortcuts."""
        if event.type() is QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent):
            keys = QKeySequence(event.keyCombination()).toString(
                QKeySequence.SequenceFormat.PortableText
            )
            if keys in UNDO_KEYS:
                event.ignore()
                return True
        return False


class ExerciseDialog(Wizard):
    """The form: pages at the left, what can be done below; it stands beside the CT.

    Args:
        editor: what is edited.
        context: of the window.
        parent: the window.
    """

    def __init__(self, editor: ExerciseEditor, context: Context, parent: QWidget) -> None:
        super().__init__(tr("Exercise"), (900, 760), theme.px(160), parent)
        self.setModal(False)
        self.editor = editor
        structures = context.editors.structures
        self.task = TaskPage(editor)
        self.patient = PatientPage(editor, lambda: structures.structures)
        self.help, self.sight = HelpPage(editor), SightPage(editor)
        self.effects, self.score = EffectsPage(editor), ScorePage(editor)
        self.review = ReviewPage(editor, self._file, self.name_of)
        self.forms: tuple[FormPage, ...] = (
            self.task,
            self.patient,
            self.help,
            self.sight,
            self.effects,
            self.score,
            self.review,
        )
        self.add_pages([scrolled(form) for form in self.forms])
        self.undo, self.redo = button(tr("Undo")), button(tr("Redo"))
        self.copy, self.export = button(tr("Duplicate")), button(tr("Export…"))
        self.attempt = button(tr("Try at once"))
        self.keep = button(tr("Keep"), "primary")
        self.note = label()
        self._lay_out_buttons()
        for keys, command in (
            ("Ctrl+Z", editor.undo),
            ("Ctrl+Y", editor.redo),
            ("Ctrl+Shift+Z", editor.redo),
        ):
            QShortcut(QKeySequence(keys), self).activated.connect(command)
        keeper = _UndoOfTheForm(self)
        for kind in (QLineEdit, QPlainTextEdit):
            for field in self.pages.findChildren(kind):
                field.installEventFilter(keeper)
        self.undo.clicked.connect(editor.undo)
        self.redo.clicked.connect(editor.redo)
        self.may_close: Callable[[], bool] = lambda: True
        editor.changed.connect(self.follow)
        self.show_page(0)

    def marks(self) -> list[tuple[Verdict, str]]:
        """Return how each page stands, and its title."""
        bad = self.editor.problems
        found = [
            (Verdict.BAD if form.problems else Verdict.GOOD, form.title) for form in self.forms
        ]
        found[-1] = (Verdict.BAD if bad else Verdict.GOOD, self.review.title)
        return found

    def enter(self, number: int) -> None:
        """Show on a page what the document says now."""
        self.forms[number].load()

    def follow(self) -> None:
        """Show another document."""
        self.enter(self.pages.currentIndex())
        self.refresh()

    def refresh(self) -> None:
        """Mark the pages, and enable what can be done now."""
        super().refresh()
        if not hasattr(self, "keep"):
            return
        fine = not self.editor.problems
        self.undo.setEnabled(self.editor.can_undo)
        self.redo.setEnabled(self.editor.can_redo)
        for one in (self.keep, self.attempt, self.export):
            one.setEnabled(fine)
            one.setToolTip(literal(self.first_problem()))
        title = self.editor.get("title", default="") or tr("Exercise")
        self.setWindowTitle(f"{title} •" if self.editor.dirty else str(title))

    def name_of(self, problem: FieldProblem) -> str:
        """Name the field of a problem as the form calls it."""
        for form in self.forms:
            if problem.field and problem.field[0] in form.covers:
                return form.name_of(problem)
        return problem.name

    def first_problem(self) -> str:
        """Say the first thing that is wrong, with its field; empty where nothing is."""
        problems = self.editor.problems
        found = problems[0] if problems else None
        return "" if found is None else f"{self.name_of(found)}: {problem_words(found)}"

    def say(self, text: str, verdict: Verdict = Verdict.GOOD) -> None:
        """Write the line above the buttons."""
        colour, symbol = verdict.colour_and_symbol
        self.note.setText(f"{symbol} {text}" if text else "")
        self.note.setStyleSheet(f"color: {colour};")

    def reject(self) -> None:
        """Close, unless somebody wants to keep what is not kept yet."""
        if self.may_close():
            super().reject()

    def finish(self) -> None:
        """Close after the last page, as Escape does."""
        self.reject()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Ask before what is not kept goes."""
        event.ignore()
        self.reject()

    def _file(self) -> str:
        exercise = self.editor.exercise
        try:
            return "" if exercise is None else exercise_text(exercise, folders()[1])
        except AcusError as error:
            return translated(error)

    def _lay_out_buttons(self) -> None:
        row = QHBoxLayout()
        for one in (self.undo, self.redo, self.copy, self.export):
            row.addWidget(one)
        row.addStretch(1)
        for one in (self.attempt, self.keep):
            row.addWidget(one)
        outer = self.layout()
        if isinstance(outer, QVBoxLayout):  # the wizard's own
            outer.insertWidget(1, self.note)
            outer.insertLayout(2, row)


class SkillTrial(QObject):
    """What scripted skills score in an exercise that is being edited.

    They try it in a process of its own, so the window is never held; a change ends it. One seed
    first, then several.

    Signals:
        found(list, int): rows of `acus exercise trial --json`, and how many seeds they are of.
        failed(str): why it cannot be tried.
    """

    found = Signal(list, int)
    failed = Signal(str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._process: QProcess | None = None
        self._folder: QTemporaryDir | None = None

    @property
    def running(self) -> bool:
        """Return whether something is being tried."""
        return self._process is not None

    def begin(self, exercise: Exercise) -> None:
        """Try an exercise; whatever was being tried is left. Structures of risk are left out."""
        self.cancel()
        self._folder = QTemporaryDir()
        file = Path(self._folder.filePath("trial.yaml"))
        tolerances = {
            name: one for name, one in exercise.tolerances.items() if not name.startswith("risk_")
        }
        bands = bands_among(exercise.bands, tolerances)
        changes = {"structures": (), "tolerances": tolerances, "bands": bands}
        tried = exercise.model_copy(update=changes)
        try:
            file.write_text(exercise_text(tried, folders()[1]), encoding="utf-8")
        except (OSError, AcusError) as error:
            self.failed.emit(translated(error))
            return
        self._start(file, TRIAL_SEEDS)

    def cancel(self) -> None:
        """Leave what is being tried; returns at once."""
        process, self._process = self._process, None
        if process is not None:
            process.finished.disconnect()
            process.finished.connect(process.deleteLater)
            process.kill()

    def close(self) -> None:
        """Leave it, and wait until its process, and what was left before, has ended."""
        self.cancel()
        for process in self.findChildren(QProcess):
            process.waitForFinished(2000)

    def _start(self, file: Path, seeds: tuple[int, ...]) -> None:
        process = self._process = QProcess(self)
        surroundings = QProcessEnvironment()
        for name, value in environment().items():
            surroundings.insert(name, value)
        process.setProcessEnvironment(surroundings)
        process.finished.connect(lambda *_: self._ended(file, seeds))
        words = ["exercise", "trial", str(file), "--seeds", str(seeds[0]), "--json"]
        program, *arguments = module_command("app", *words)
        process.start(program, arguments)

    def _ended(self, file: Path, seeds: tuple[int, ...]) -> None:
        process, self._process = self._process, None
        if process is None:
            return
        output = bytes(process.readAllStandardOutput().data()).decode(errors="replace")
        errors = bytes(process.readAllStandardError().data()).decode(errors="replace")
        process.deleteLater()
        try:
            rows = json.loads(output)["facts"]["skills"]
        except (ValueError, KeyError, TypeError):
            said = [line for line in errors.splitlines() if line.strip()]
            self.failed.emit(said[-1] if said else tr("the trial ended without an answer"))
            return
        self.found.emit(rows, seeds[0])
        if seeds[1:]:
            self._start(file, seeds[1:])


class AuthorFeature(Feature):
    """Menu entries, the form, files of exercises."""

    topic: ClassVar[str] = "author"
    place: ClassVar[int] = 50
    roles: ClassVar[frozenset[Role]] = STAFF
    help: ClassVar[str] = "authoring.md"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._conductor, self._shell = context.conductor, context.shell
        self.editor = ExerciseEditor(context.services.check_exercise, self)
        self.dialog: ExerciseDialog | None = None
        self._task: BackgroundTask | None = None
        self._measuring: BackgroundTask | None = None
        self._measured: Exercise | None = None  # of which it is known what its patient calls for
        self._kept_unchecked = ""
        self._cost_timer = QTimer(self, singleShot=True, interval=COST_AFTER_MS)
        self._cost_timer.timeout.connect(self._measure)
        self.trial = SkillTrial(self)
        self.trial.found.connect(self._show_skills)
        self.trial.failed.connect(self._no_skills)
        self._tried: Exercise | None = None
        self._trial_timer = QTimer(self, singleShot=True, interval=TRIAL_AFTER_MS)
        self._trial_timer.timeout.connect(self._try_skills)
        self.editor.changed.connect(self._follow)
        context.editors.structures.stepped.connect(lambda _: self._redraw())
        self._actions = add_entries(
            self._shell.menu(tr("&File"), tr("Exercise")),
            [
                (tr("Make an exercise from the open patient…"), "Ctrl+Shift+E", self.make),
                (tr("Change the present exercise…"), "", self.change),
                None,
                (tr("Import an exercise…"), "", self.ask_import),
                (tr("Export the present exercise…"), "", self.export_taken),
            ],
        )
        ACCESS.changed.connect(self._allow)
        self._allow()

    def _allow(self) -> None:
        """Close all of it to students once an instructor's password is set."""
        for action in self._actions:
            action.setEnabled(ACCESS.may_manage)

    def _may(self) -> bool:
        """Return whether who is here may make exercises, whatever asks; else it is said."""
        why = ACCESS.why_not_manage
        if why:
            self.failed.emit(why)
            self._say(why, Verdict.BAD)
        return not why

    # --- what the window asks -------------------------------------------------------------------
    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self.noted, self.editor.changed)

    def unsaved(self) -> str:
        """Say that the exercise has changes that are not kept; empty where it has none."""
        if self.dialog is None or not self.editor.dirty:
            return ""
        title = self.editor.get("title", default="") or tr("without a title")
        return tr("the exercise “{title}”, which is not kept yet", title=title)

    def save(self) -> bool:
        """Keep the exercise; return whether that was done."""
        return self.keep()

    def may_go(self) -> bool:
        """Ask whether changes may go, or keep them; True where there are none."""
        if not self.unsaved():
            return True
        box = QMessageBox.StandardButton
        answer = QMessageBox.question(
            self.dialog or self._shell.dialog_parent,
            tr("Exercise not kept"),
            literal(tr("Keep {what}?", what=self.unsaved())),
            box.Save | box.Discard | box.Cancel,
            box.Cancel,  # Enter, perhaps meant for a page, writes nothing
        )
        return self.keep() if answer == box.Save else answer == box.Discard

    def forget(self) -> None:
        """Close the form: it is of the patient who leaves."""
        self._close_dialog()

    def opens(self, path: Path) -> bool:
        """Take in a dropped file of an exercise."""
        if path.suffix != SUFFIX or not ACCESS.may_manage:
            return False
        self.import_from(path)
        return True

    def close(self) -> None:
        """End what runs, and the form."""
        self._trial_timer.stop()
        self.trial.close()
        for task in (self._task, self._measuring):
            if task is not None:
                task.close()
        self._close_dialog()

    # --- making and changing --------------------------------------------------------------------
    def make(self) -> None:
        """Begin an exercise on the CT, plan and structures that are open."""
        if not self._may():
            return
        patient = self._conductor.patient
        if patient is None:
            self.failed.emit(tr("There is no CT open to make an exercise of: open one first."))
            return
        if self.dialog is not None and not self.may_go():
            return
        editors = self.context.editors
        structures = editors.structures.structures
        taken = self._conductor.exercise
        self._begin(opened_document(patient, editors.plan.edit, structures, taken), None)
        if patient.phantom_seed is None:
            run_in_background(
                self, lambda _: patient.volume.digest, self._take_digest, self.failed.emit
            )

    def change(self) -> None:
        """Change the exercise that is taken; one that comes with Acus is copied first."""
        if not self._may():
            return
        exercise = self._conductor.exercise
        if exercise is None:
            self.failed.emit(tr("No exercise is open: choose one first."))
            return
        if self.dialog is not None and not self.may_go():
            return
        if (folders()[0] / f"{exercise.id}.yaml").is_file():
            title = tr("{title} (copy)", title=exercise.title)
            document = exercise_document(exercise)
            document |= {"title": title, "id": free_id(title, taken_ids()), "version": 1}
            self._begin(document, None)
            self._say(tr("Exercises that come with Acus stay as they are: this is a copy."))
        else:
            self._begin(exercise_document(exercise), exercise)

    def _begin(self, document: dict[str, Any], saved: Exercise | None) -> None:
        self._close_dialog()
        self.dialog = dialog = ExerciseDialog(self.editor, self.context, self._shell.dialog_parent)
        dialog.may_close = self.may_go
        dialog.finished.connect(lambda _: self._closed(dialog))
        dialog.keep.clicked.connect(self.keep)
        dialog.attempt.clicked.connect(self.try_at_once)
        dialog.copy.clicked.connect(self.duplicate)
        dialog.export.clicked.connect(self.export)
        dialog.task.kind_wanted.connect(self.set_kind)
        dialog.patient.plan_wanted.connect(self.take_plan)
        dialog.effects.layers.ct_wanted.connect(self.take_tissue)
        dialog.sight.reading_wanted.connect(self.take_reading)
        dialog.score.looked_at.connect(self._trial_timer.start)
        self.editor.begin(document, saved)
        frame = self._shell.dialog_parent.geometry()  # at its right: the axial pane stays free
        lowest = dialog.screen().availableGeometry().bottom() - dialog.height()
        top = max(min(frame.top() + 60, lowest), 0)
        dialog.move(max(frame.right() - dialog.width() - theme.MARGIN, 0), top)
        dialog.show()
        dialog.raise_()
        dialog.activateWindow()
        dialog.task.name.setFocus()

    def set_kind(self, kind: str) -> None:
        """Make it an exercise of another type: what the path, the pictures and the score are."""
        edit = self.context.editors.plan.edit
        values: dict[Where, Any] = {}
        plan = self.editor.get("plan")
        if kind == OWN:
            target = plan.get("target_mm") if isinstance(plan, dict) else None
            values["plan",] = {"own": True} | ({"target_mm": target} if target else {})
            if self.editor.get("tolerances", PLANNED) is None:
                values["tolerances", PLANNED] = dict(OWN_PLAN)
        elif is_own(self.editor.document):
            values["plan",] = plan_document(edit) if edit.draft.complete else None
            judged = self.editor.get("tolerances", default={})
            values |= {("tolerances", name): None for name in OF_OWN_PLANS & judged.keys()}
        scans = kind == SCANS
        values["guidance", "mode"] = "control_ct" if scans else None
        if scans:
            values["assistance",] = 0.0
            values["views",] = ["three_d"]
        elif self.editor.get("guidance", "mode") == "control_ct":
            values["views",] = ["live_overlay", "bullseye", "three_d"]
            values["assistance",] = 0.7
        self.editor.put_all(values)

    def take_plan(self) -> None:
        """Take path and position from the window."""
        edit = self.context.editors.plan.edit
        plan = plan_document(edit, own=is_own(self.editor.document))
        if plan is None:
            self._say(tr("There is no target in the window yet: press T, then click."), Verdict.BAD)
            return
        lies = edit.placement
        self.editor.put_all(
            {
                ("plan",): plan,
                ("placement",): {
                    "orientation": lies.orientation.value,
                    "rotation_deg": list(lies.rotation_deg),
                },
            }
        )
        self._say(tr("Path and position taken from the window."))

    def take_tissue(self) -> None:
        """Fill the layers with what the CT holds along the exercise's path."""
        patient, exercise = self._conductor.patient, self.editor.exercise
        if patient is None or exercise is None:
            why = tr("It takes a CT that is open, and an exercise without mistakes.")
            self._say(why, Verdict.BAD)
            return
        from app.exercises.tissue import bone_before, layers_along  # scipy

        try:
            marked, path = self.context.editors.structures.structures, plan_of(exercise)
            layers = layers_along(patient.volume, path, tuple(marked))
        except AcusError as error:
            self._say(translated(error), Verdict.BAD)
            return
        found = [layer.model_dump(mode="json", exclude_defaults=True) for layer in layers]
        self.editor.put("layers", value=found)
        names = listing(layer.name for layer in layers)
        said = tr("{count} layers along the path: {names}", count=len(layers), names=names)
        bone = bone_before(layers, path.length_mm)
        if bone is None:
            self._say(said)
        else:
            self._say(f"{said}. {bone_words(bone, path.length_mm)}", Verdict.WARNING)

    def take_reading(self) -> None:
        """Take window and slab from the axial pane."""
        viewing = self.context.views.viewing
        window, slab = viewing.window, viewing.presentation(PaneId.AXIAL).slab
        self.editor.put_all(
            {
                ("reading", "window"): {"width": window.width, "level": window.level},
                ("reading", "slab"): {"kind": slab.kind, "thickness_mm": slab.thickness_mm},
            }
        )
        self._say(tr("Window and slab taken from the axial pane."))

    def duplicate(self) -> None:
        """Go on with a copy of what is in the form."""
        if self.editor.saved is not None and self.editor.dirty and not self.may_go():
            return
        title = tr("{title} (copy)", title=self.editor.get("title", default=""))
        self.editor.duplicate(title)
        self._say(tr("This is a copy now; the exercise that it was made of stays as it is."))

    # --- trying and keeping ---------------------------------------------------------------------
    def try_at_once(self) -> None:
        """Take the exercise as it stands, without keeping it."""
        if self.context.editors.plan.locked:
            self._say(tr("An attempt is running: end it first."), Verdict.BAD)
            return
        exercise = self._finished()
        if exercise is None:
            return
        try:
            self._conductor.set_exercise(exercise)
        except AcusError as error:
            self._say(translated(error), Verdict.BAD)
            return
        if self.editor.dirty:
            self._say(tr("The exercise is used as it is now; this does not save it."))
        else:
            self._say(tr("The exercise is now in use."))
        self._shell.show_panel(self._conductor.views.panel)

    def keep(self) -> bool:
        """Keep the exercise; a changed one is a new version. Returns whether that was done."""
        if not self._may():
            return False
        exercise = self._finished()
        if exercise is None:
            return False
        checked = self._measured is not None and self._measured == _bare(self.editor.exercise)
        try:
            saved = self.editor.keep(exercise)
        except AcusError as error:
            self._say(translated(error), Verdict.BAD)
            return False
        plan = self.context.editors.plan
        drawn = plan_document(plan.edit, own=is_own(self.editor.document))
        if plan.path is None and drawn == self.editor.get("plan"):
            plan.saved(None)  # nobody has to be asked for it any more: the exercise holds it
        self._conductor.exercises_changed.emit()
        words = tr("Kept as “{name}”, version {n}.", name=saved.id, n=saved.version)
        self._kept_unchecked = "" if checked else words
        if checked:
            self._say(words)
        else:
            doubt = tr("Not checked yet: what the patient calls for. The answer comes here.")
            self._say(f"{words} {doubt}", Verdict.WARNING)
        self.noted.emit(words)
        return True

    def _say_checked(self, result: Mapping[str, Any] | Exception) -> None:
        """Say what came of the check that an exercise was kept without; nothing if of none."""
        words, self._kept_unchecked = self._kept_unchecked, ""
        if not words:
            return
        if isinstance(result, Exception):
            doubt = tr("It cannot be checked: {reason}", reason=translated(result))
            self._say(f"{words} {doubt}", Verdict.WARNING)
            return
        absent = [call["effect"] for call in result.get("called_for", ()) if call["absent"]]
        if absent:
            lacks = tr("The patient calls for more: {names}.", names=listing(absent))
            self._say(f"{words} {lacks}", Verdict.WARNING)
        else:
            self._say(f"{words} " + tr("Checked: the patient calls for nothing more."))

    def _finished(self) -> Exercise | None:
        """Return the exercise with its structures written; None where something is wrong."""
        exercise, problems = self.editor.exercise, self.editor.problems
        if exercise is None or problems:
            if self.dialog is not None:
                self._say(self.dialog.first_problem(), Verdict.BAD)
            return None
        structures = self.context.editors.structures.structures
        try:
            return finished(exercise, self._conductor.patient, structures)
        except AcusError as error:
            self._say(translated(error), Verdict.BAD)
            return None

    # --- files ----------------------------------------------------------------------------------
    def export(self) -> None:
        """Write what is in the form into one file."""
        if not self._may():
            return
        exercise = self._finished()
        if exercise is not None:
            self._export(exercise)

    def export_taken(self) -> None:
        """Write the exercise that is taken into one file."""
        if not self._may():
            return
        if self._conductor.exercise is None:
            self.failed.emit(tr("No exercise is open: choose one first."))
        else:
            self._export(self._conductor.exercise)

    def _export(self, exercise: Exercise) -> None:
        patient = self._conductor.patient
        if patient is None or not self._conductor.fits(patient, exercise):
            self.failed.emit(ExerciseError(tr("Open the CT of the exercise first: begin it.")))
            return
        start = str(Path.home() / f"{exercise.id}{SUFFIX}")
        kinds = tr("Exercises (*{suffix})", suffix=SUFFIX)
        parent = self.dialog or self._shell.dialog_parent
        name, _ = QFileDialog.getSaveFileName(parent, tr("Export exercise"), start, kinds)
        if not name:
            return
        with_ct = False
        if exercise.ct.folder is not None:
            box = QMessageBox.StandardButton
            text = tr(
                "Put the CT into the file, de-identified?\nWithout it, it can be used where "
                "the same CT is."
            )
            answer = QMessageBox.question(
                parent, tr("Export exercise"), text, box.Yes | box.No | box.Cancel, box.No
            )
            if answer == box.Cancel:
                return
            with_ct = answer == box.Yes
        path, volume = Path(name if name.endswith(SUFFIX) else name + SUFFIX), patient.volume
        self._run(
            lambda progress: pack(path, exercise, volume, with_ct, progress),
            lambda _: self.noted.emit(tr("Exported {name}", name=path.name)),
            tr("Exporting the exercise"),
        )

    def ask_import(self) -> None:
        """Ask for a file of an exercise and take it in."""
        if not self._may():
            return
        kinds = tr("Exercises (*{suffix})", suffix=SUFFIX)
        name, _ = QFileDialog.getOpenFileName(
            self._shell.dialog_parent, tr("Import exercise"), str(Path.home()), kinds
        )
        if name:
            self.import_from(Path(name))

    def import_from(
        self, path: Path, ct: Path | None = None, name: str = "", replace: bool = False
    ) -> None:
        """Take an exercise in; asks for its CT, and what to do where its name is taken.

        Nobody is asked for the CT that is open.
        """
        again, patient = partial(self.import_from, path), self._conductor.patient

        def fail(error: Exception) -> None:
            self._task = None
            if isinstance(error, CtMissingError) and ct is None:
                self._ask_ct(path, lambda folder: again(folder, name, replace))
            elif isinstance(error, TakenError) and not name:
                self._ask_name(error, path, lambda other, newer: again(ct, other, newer))
            else:
                self.failed.emit(error)

        def take_in(progress: Progress) -> UnpackedExercise:
            here = None if patient is None or ct is not None else patient.folder
            if patient is not None and here is not None:
                same = read_manifest(path).ct.digest == patient.volume.digest
                with suppress(ImagingError):  # it may have gone from its folder meanwhile
                    return unpack(path, here if same else None, None, name, replace, progress)
            return unpack(path, ct, None, name, replace, progress)

        self._run(
            take_in,
            self._taken_in,
            tr("Importing the exercise"),
            fail,
        )

    def _ask_ct(self, path: Path, go_on: Callable[[Path], object]) -> None:
        self.failed.emit(
            tr(
                "{file} does not hold its CT: choose the folder of the CT that the exercise was "
                "made on",
                file=NAMES.shown(path.name),
            )
        )
        folder = QFileDialog.getExistingDirectory(
            self._shell.dialog_parent, tr("Folder of the exercise's CT"), str(Path.home())
        )
        if folder:
            go_on(Path(folder))

    def _ask_name(self, error: Exception, path: Path, go_on: Callable[[str, bool], object]) -> None:
        box = QMessageBox.StandardButton
        text = tr(
            "There is another exercise of this name.\nYes: keep this one as a new version of "
            "it.\nNo: keep it under another name."
        )
        answer = QMessageBox.question(
            self._shell.dialog_parent, tr("Import exercise"), text, box.Yes | box.No | box.Cancel
        )
        if answer == box.Yes:
            go_on("", True)
        elif answer == box.No:
            go_on(free_id(path.stem, taken_ids()), False)
        else:
            self.failed.emit(error)

    def _taken_in(self, result: UnpackedExercise) -> None:
        self._conductor.exercises_changed.emit()
        title = result.exercise.title
        if result.known:
            self.noted.emit(tr("The exercise “{title}” was there already.", title=title))
        else:
            self.noted.emit(tr("The exercise “{title}” is in the list now.", title=title))

    def _run(
        self,
        work: Callable[[Progress], Any],
        done: Callable[[Any], object],
        title: str,
        fail: Callable[[Exception], object] | None = None,
    ) -> None:
        def end(result: Any) -> None:
            self._task = None
            done(result)

        def failed(error: Exception) -> None:
            self._task = None
            self.failed.emit(error)

        self._task = run_in_background(
            self, work, end, fail or failed, title=title, indicator=self._shell.progress
        )

    # --- live -----------------------------------------------------------------------------------
    def _follow(self) -> None:
        """Draw the tolerances on the CT, and measure anew what a tick costs."""
        exercise, dialog = self.editor.exercise, self.dialog
        if dialog is not None and self._tried != _bare(exercise):
            self._tried = None
            self.trial.cancel()
            dialog.score.tried.setText("")
            self._trial_timer.start()
        if dialog is None or exercise is None:
            return
        self._draw(exercise)
        self._cost_timer.start()

    def _redraw(self) -> None:
        """Let the next version hold what was painted since this one was kept."""
        patient, exercise = self._conductor.patient, self.editor.exercise
        if self.dialog is None or patient is None or exercise is None:
            return
        if self._conductor.fits(patient, exercise):
            self.editor.redraw([part.name for part in self.context.editors.structures.structures])

    def _draw(self, exercise: Exercise | None) -> None:
        if exercise is not None:
            radii = tuple(radius / MILLIMETRE for radius in rings_of(exercise))
            viewing = self.context.views.viewing
            if viewing.tolerances_mm != radii:  # every pane is drawn anew
                viewing.set_tolerances(radii)

    def _measure(self) -> None:
        exercise, dialog = self.editor.exercise, self.dialog
        if exercise is None or dialog is None or self.editor.problems:
            return
        if self._measuring is not None:
            self._cost_timer.start()
            return
        dialog.effects.show_cost(None)

        def done(result: Any) -> None:
            self._measuring = None
            if self.dialog is None:
                return
            if isinstance(result, Exception):
                self.dialog.effects.show_no_cost(translated(result))
            else:
                self._measured = _bare(exercise)
                self.dialog.effects.show_cost(result)
            if _bare(exercise) == _bare(self.editor.exercise):
                self._say_checked(result)

        services = self.context.services
        self._measuring = run_in_background(
            self, lambda _: services.explain_exercise(exercise), done, done
        )

    def _try_skills(self) -> None:
        """Let the skills try what is edited, while somebody looks at the page that shows it."""
        exercise, dialog = self.editor.exercise, self.dialog
        if exercise is None or dialog is None or self.editor.problems:
            return
        if not dialog.score.isVisible() or self._tried is not None:
            return
        self._tried = _bare(exercise)
        dialog.score.skills.show_scores((), exercise.rules.pass_mark)
        dialog.score.tried.setText(tr("five scripted skills are trying it …"))
        self.trial.begin(exercise)

    def _show_skills(self, rows: list[dict[str, Any]], seeds: int) -> None:
        exercise, dialog = self.editor.exercise, self.dialog
        if exercise is None or dialog is None:
            return
        dialog.score.skills.show_scores(rows, exercise.rules.pass_mark)
        said = tr_n(
            "{n} attempt of each skill, without structures of risk",
            "{n} attempts of each skill, without structures of risk",
            seeds,
        )
        if self.trial.running or seeds < TRIAL_SEEDS[-1]:
            said += "; " + tr("more are on their way …")
        dialog.score.tried.setText(said)

    def _no_skills(self, reason: str) -> None:
        if self.dialog is not None:
            self.dialog.score.tried.setText(tr("It cannot be tried: {why}", why=reason))

    def _take_digest(self, digest: str) -> None:
        if self.dialog is not None and self.editor.get("ct", "folder") is not None:
            self.editor.learn("ct", "digest", value=digest)

    def _say(self, text: str, verdict: Verdict = Verdict.GOOD) -> None:
        if self.dialog is not None:
            self.dialog.say(text, verdict)
        elif verdict is Verdict.BAD:
            self.failed.emit(text)

    def _close_dialog(self) -> None:
        dialog = self.dialog
        if dialog is not None:
            dialog.may_close = lambda: True
            dialog.reject()

    def _closed(self, dialog: ExerciseDialog) -> None:
        if self.dialog is dialog:
            self.dialog = None
            self._cost_timer.stop()
            self._trial_timer.stop()
            self.trial.cancel()
            self._tried = self._measured = None
            self._kept_unchecked = ""
            self._draw(self._conductor.exercise)
        self.editor.changed.disconnect(dialog.follow)
        dialog.deleteLater()


def _bare(exercise: Exercise | None) -> Exercise | None:
    """Return an exercise without its words, which no score depends on."""
    if exercise is None:
        return None
    words = {"id": "x", "title": "x", "description": "", "level": 1, "version": 1}
    return exercise.model_copy(update=words)
