"""The main window: builds what its features are made from, then loops over the list of them.

It lets every message stand while its state is true, and asks before a patient is replaced, of
whom nothing is left.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TypeVar

from PySide6.QtCore import QObject, Qt, QTimer, SignalInstance
from PySide6.QtGui import QCloseEvent, QCursor, QDragEnterEvent, QDropEvent, QShowEvent
from PySide6.QtWidgets import (
    QApplication,
    QMainWindow,
    QMessageBox,
    QVBoxLayout,
    QWidget,
)

from app.core import plugin_folders
from app.core.events import Event
from app.core.messages import joined
from app.planning.draft import DraftPlan
from app.planning.patient import Patient
from app.session.result import AttemptResult
from app.session.withdrawal import KIND as WITHDRAWAL
from app.views.debrief.feature import DebriefFeature
from app.views.exercise.conductor import Conductor
from app.views.exercise.equipment import Equipment
from app.views.exercise.feature import ExerciseFeature
from app.views.exercise.runs import Runs
from app.views.kit.access import ACCESS
from app.views.kit.menu_entries import add_entries
from app.views.kit.names import NAMES
from app.views.kit.progress_strip import ProgressStrip
from app.views.kit.roles import EVERYBODY, STAFF, Role
from app.views.kit.text import declared, literal, tr
from app.views.measure.editor import MeasureEditor
from app.views.people.feature import PeopleFeature
from app.views.plan.editor import PlanEditor
from app.views.plan.feature import PlanFeature
from app.views.reading.editors import Editors, UndoOrder
from app.views.reading.workspace import WorkspacePage
from app.views.series.open_ct import OpenCt
from app.views.shell.feature import Context, Feature
from app.views.shell.features import FEATURES
from app.views.shell.foreign_features import made
from app.views.shell.help import ProblemReport, about, page_of, show_help
from app.views.shell.message_bar import (
    ATTEMPT_RUNS,
    PAUSE,
    REFUSAL,
    ROBOT,
    START,
    MessageBar,
    Notices,
)
from app.views.shell.pages import Pages
from app.views.shell.projector import Projector
from app.views.shell.remembered import Remembered
from app.views.shell.role_switch import RoleSwitch
from app.views.shell.services import Services
from app.views.shell.settings import Recents, open_settings
from app.views.shell.shell import Shell
from app.views.shell.shortcuts import ShortcutSheet
from app.views.shell.start_facts import StartFacts
from app.views.shell.start_page import StartPage
from app.views.shell.student_side import StudentSide
from app.views.shell.tour import Tour
from app.views.shell.view_menu import ViewMenu
from app.views.structures.book import StructureBook


def connect_messages(
    context: Context, features: Sequence[Feature], hand_chosen: SignalInstance
) -> None:
    """Let everything that can fail say so at the top of the window.

    Args:
        context: whose parts speak.
        features: speak for themselves, until one of `Feature.over` says more.
        hand_chosen: signal: another hand moves the needle.
    """
    bar, runs, conductor = context.shell.messages, context.runs, context.conductor
    controller, equipment, editor = conductor.controller, context.equipment, context.editors.plan
    ended = controller.finished
    attempt = (controller.worked, controller.began, ended, runs.ready, runs.gone, hand_chosen)
    topics = [(feature.topic, feature.failed, feature.over()) for feature in features]
    for topic, failed, over in (
        *topics,
        ("patient", conductor.failed, ()),
        ("attempt", controller.failed, attempt),
        ("equipment", equipment.failed, (equipment.accepted, ended)),
    ):
        failed.connect(lambda error, topic=topic: bar.show_until(topic, error))
        for signal in over:
            signal.connect(lambda *_, topic=topic: bar.forget(topic))
    panel = conductor.views.panel
    panel.start_refused.connect(lambda why: bar.show_until(START, why, "warning"))
    panel.start_changed.connect(lambda: bar.forget(START))
    for feature in features:
        feature.noted.connect(bar.show_note)
    editor.refused.connect(lambda error: bar.show_until(REFUSAL, error))
    editor.changed.connect(lambda: bar.forget(REFUSAL))
    runs.failed.connect(lambda error: bar.show_until(ROBOT, error))
    runs.unusable.connect(
        lambda why: bar.show_until("laws", tr("A file of your own cannot be used: {why}", why=why))
    )
    if reasons := plugin_folders.refused_folders():
        why = joined("; ", reasons)
        bar.show_until("folders", tr("A folder of plug-ins cannot be used: {why}", why=why))
    for signal in (ended, runs.gone):
        signal.connect(lambda *_: bar.forget(ATTEMPT_RUNS))
    for signal in (runs.ready, equipment.accepted):
        signal.connect(lambda *_: bar.forget(ROBOT))
    runs.starting.connect(lambda begun: bar.forget(ROBOT) if begun else None)
    runs.starting.connect(panel.set_preparing)
    controller.event_seen.connect(lambda event: tell_pause(bar, event))
    panel.withdrawal.over.connect(lambda: bar.forget(WITHDRAWAL))


def tell_pause(bar: MessageBar, event: Event) -> None:
    """Say on every page that the attempt or its beginning waits, until it goes on or ends."""
    if event.kind == "pause" and "duration_s" not in event.data:
        bar.show_until(PAUSE, event.message)
    elif event.kind == WITHDRAWAL and "how" not in event.data:
        bar.show_until(WITHDRAWAL, event.message, "warning")
    elif event.kind in ("pause", "state", "abort", WITHDRAWAL):
        bar.forget(PAUSE)
        bar.forget(WITHDRAWAL)


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
        # A student opens no CT but the exercises' own: nothing of them is his, or lost.
        if patient is not None and ACCESS.role is not Role.STUDENT:
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
        saves = dirty and ACCESS.role is not Role.STUDENT
        if saves:
            text += "\n\n" + tr("Save the plan first?")
        choices = box.Discard | box.Cancel if dirty else box.Open | box.Cancel
        choices = choices | box.Save if saves else choices
        # Enter, perhaps meant for the page, writes nothing and throws nothing away.
        title, default = tr("Open another patient"), box.Cancel if dirty else box.Open
        parent = self._context.shell.dialog_parent
        answer = QMessageBox.question(parent, title, literal(text), choices, default)
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


PAINTED_MS = 50
"""This long after it is shown the window is painted, and heavy parts may load."""

F = TypeVar("F", bound=Feature)


class MainWindow(QMainWindow):
    """Start page and workspace, and the frame of every feature: menus, messages, undo, settings.

    Attributes:
        features: one of each kind in `FEATURES`.
    """

    def __init__(
        self,
        services: Services,
        features: tuple[type[Feature], ...] = FEATURES,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.services = services
        self.settings, self._asked = open_settings(), False
        self.editors = Editors(PlanEditor(self), MeasureEditor(self), StructureBook(self))
        self.editor = self.editors.plan
        self.message_bar, self.progress = MessageBar(self), ProgressStrip(self)
        self._lay_out()
        self.workspace = WorkspacePage(self.editor, self.pages)
        self.runs = Runs(services, self.progress, self)
        self.conductor = Conductor(self.workspace, self.editor, self.runs, self.progress, self)
        self.equipment = Equipment(self.settings, self.conductor, self)
        self.open_ct = OpenCt(Recents(self.settings, "recent/cts"), self.progress, self)
        self.undo = UndoOrder((self.editor, self.editors.measures, self.editors.structures), self)
        self.projector, self.start_page = Projector(self), StartPage(self.pages)
        self.start_facts = StartFacts(self.start_page, services, self)
        for page in (self.start_page, self.workspace):
            self.pages.addWidget(page)
        shell = Shell(
            self,
            self.settings,
            self.pages,
            self.workspace,
            self.workspace.side,
            self.message_bar,
            self.progress,
            self.may_go,
        )
        self.context = Context(
            services,
            self.workspace.views,
            self.editors,
            self.runs,
            self.conductor,
            self.equipment,
            self.open_ct,
            shell,
        )
        with shell.made_for(EVERYBODY):
            self._begin_menus(shell)
        self.features = made(features, self.context)
        with shell.made_for(EVERYBODY):
            self._end_menus(shell)
            self._connect()
        self.roles = RoleSwitch(
            self.menuBar(),
            shell,
            self.conductor.controller,
            self.feature(PeopleFeature).sign_in_instructor,
            self,
        )
        plan = self.feature(PlanFeature).panel
        self.student_side = StudentSide(self.workspace, self.conductor, plan, self)
        shell.owned.leave = self.show_start
        for follow in (self.student_side.follow, self.refresh, self._follow_role):
            self.roles.changed.connect(follow)
            follow()
        self.notices = Notices(self, (self.progress, self.message_bar), self.workspace.next_step)
        self.remembered = Remembered(
            self, self.settings, self.workspace, self.conductor, self.projector
        )
        self.conductor.exercise_taken.connect(self.remembered.follow)
        self.remembered.restore()
        self.show_start()

    def feature(self, kind: type[F]) -> F:
        """Return the feature of a kind.

        Raises:
            StopIteration: if it is not in the list.
        """
        return next(one for one in self.features if isinstance(one, kind))

    # --- pages --------------------------------------------------------------------------------
    def show_start(self) -> None:
        """Go to the start page; an attempt whose clock runs is not left behind it."""
        if self.conductor.controller.is_running_by_hand:
            self.show_workspace()
            self.message_bar.show_until(
                ATTEMPT_RUNS, tr("An attempt is running: end it before you go to the start page")
            )
            return
        self.start_page.set_recents(self.open_ct.recents.paths())
        self.pages.setCurrentWidget(self.start_page)
        if self.isVisible():  # nothing is read before the window stands
            self.start_facts.refresh()

    def show_workspace(self) -> None:
        """Go to the panes."""
        self.context.shell.show_workspace()

    def begin_exercise(self, identifier: str) -> None:
        """Take an exercise and open its patient, unless it is shown already; without a briefing."""
        self.feature(ExerciseFeature).beginning.trust(identifier)
        self.feature(ExerciseFeature).begin(identifier)

    def show_patient(self, patient: Patient) -> None:
        """Show a patient that was opened."""
        self.feature(ExerciseFeature).show_patient(patient)

    def show_result(self, result: AttemptResult) -> None:
        """Show the debrief of an attempt that ended."""
        self.feature(DebriefFeature).show_result(result)

    def show_help(self) -> None:
        """Open the user guide at the page about what has the keyboard, or is under the mouse."""
        within = QApplication.focusWidget() or QApplication.widgetAt(QCursor.pos())
        show_help(self, page_of(within))

    def show_shortcuts(self) -> None:
        """Open the sheet of keys."""
        keys = {key: words for one in self._here() for key, words in one.watching().items()}
        pen = self.equipment.offers_pen and self.roles.role is Role.TECHNICIAN
        sheet = ShortcutSheet(self.workspace.viewing.scheme, self, keys, pen, self.roles.role)
        sheet.finished.connect(sheet.deleteLater)
        sheet.open()

    def report_problem(self) -> None:
        """Show what a report of a problem holds."""
        report = ProblemReport(self)
        report.finished.connect(report.deleteLater)
        report.open()

    def show_about(self) -> None:
        """Say what this is and what it is not."""
        about(self).open()

    def open_dropped(self, path: Path) -> None:
        """Offer what was dropped to the features, from the last to the first."""
        any(feature.opens(path) for feature in reversed(self._here()))

    def _here(self) -> list[Feature]:
        """Return the features that the present role has."""
        return [feature for feature in self.features if self.roles.role in feature.roles]

    def refresh(self) -> None:
        """Write the title and enable what can be done."""
        conductor, patient = self.conductor, self.conductor.patient
        taken = conductor.exercise if patient and conductor.fits(patient) else None
        name = "" if patient is None else NAMES.shown(patient.label)
        here = tr("signed in as the instructor") if ACCESS.instructor else ""
        student = ACCESS.student
        here = here if student is None else NAMES.shown(student.pseudonym)
        parts = ("" if taken is None else declared(taken.title), name, here, "Acus")
        self.setWindowTitle(" – ".join(filter(None, parts)))
        self.undo_action.setEnabled(self.undo.can_undo)
        self.redo_action.setEnabled(self.undo.can_redo)

    def may_go(self) -> bool:
        """Ask about everything that is unsaved; return whether all of it may go."""
        return all(feature.may_go() for feature in self.features)

    def _take_name(self, name: str) -> None:
        """Let attempts and progress be those of a name, which is remembered."""
        panel = self.workspace.exercise_panel
        self.start_page.who.line.setText(name)
        if ACCESS.student is None and panel.student.text() != name:
            panel.set_student(name)
            panel.student.editingFinished.emit()
        self.settings.setValue("student/name", name)
        if self.isVisible():
            self.start_facts.refresh()

    def _follow_role(self) -> None:
        """Ask for a name where somebody practises who does not sign in."""
        own = ACCESS.role is Role.STUDENT and ACCESS.student is None
        self.start_page.who.setVisible(own)
        self.start_page.who.line.setText(self.workspace.exercise_panel.student.text())

    # --- set-up -------------------------------------------------------------------------------
    def _lay_out(self) -> None:
        """Make the place of the pages before them: a page that moves is styled once more."""
        centre = QWidget(self)
        self.pages = Pages(centre)
        column = QVBoxLayout(centre)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.pages, 1)
        self.setCentralWidget(centre)
        self.setAcceptDrops(True)

    def _begin_menus(self, shell: Shell) -> None:
        """Add what stands above the entries of features."""
        add_entries(shell.menu(tr("&File")), [(tr("Start page"), "", self.show_start)])
        self.undo_action, self.redo_action = add_entries(
            shell.menu(tr("&Edit")),
            [
                (tr("Undo"), "Ctrl+Z", self.undo.undo),
                (tr("Redo"), "Ctrl+Y | Ctrl+Shift+Z", self.undo.redo),
            ],
        )
        self.addActions((self.undo_action, self.redo_action))  # their keys are everybody's
        with shell.made_for(STAFF):
            shell.owned.keep_menu(shell.menu(tr("&Edit")))
        add_entries(shell.menu(tr("&Sessions")), [(tr("Workspace"), "F6", self.show_workspace)])

    def _end_menus(self, shell: Shell) -> None:
        """Add what stands below the entries of features."""
        (leave,) = add_entries(shell.menu(tr("&File")), [None, (tr("Quit"), "Ctrl+Q", self.close)])
        leave.setShortcutContext(Qt.ShortcutContext.ApplicationShortcut)  # from a page of its own
        self.view_menu = ViewMenu(
            shell, self.workspace, self.conductor, self.editor, self.projector
        )
        add_entries(
            shell.menu(tr("&Help")),
            [
                (tr("Help on this part"), "F1", self.show_help),
                (tr("User guide"), "", lambda: show_help(self)),
                (tr("Keys and mouse"), "?", self.show_shortcuts),
                (tr("Report a problem…"), "", self.report_problem),
                (tr("About Acus"), "", self.show_about),
            ],
        )

    def _connect(self) -> None:
        conductor, start, open_ct = self.conductor, self.start_page, self.open_ct
        hand_chosen = self.workspace.bullseye.source.chosen
        connect_messages(self.context, self.features, hand_chosen)
        change = ChangeOfPatient(self.context, self.features)
        open_ct.may_replace = change.may_replace
        open_ct.reading.connect(change.set_loading)
        open_ct.opened.connect(lambda patient: change.take(patient, self.show_patient))
        conductor.patient_left.connect(self._forget_patient)
        conductor.patient_changed.connect(self.refresh)
        conductor.exercise_taken.connect(lambda _: self.refresh())
        self.undo.changed.connect(self.refresh)
        ACCESS.changed.connect(self.refresh)
        self.projector.changed.connect(self._suit_room)
        start.set_exercises(self.services.exercises())
        conductor.exercises_changed.connect(lambda: start.set_exercises(self.services.exercises()))
        start.exercise_chosen.connect(conductor.exercise_wanted)
        conductor.start_wanted.connect(self.show_start)
        self.pages.currentChanged.connect(lambda _: self._let_picture())
        open_ct.reading.connect(lambda _: self._let_picture())
        self.runs.prepared.connect(self._let_picture)
        self._connect_people()
        debrief = self.feature(DebriefFeature).page
        exercises = self.feature(ExerciseFeature)
        self.tour = tour = Tour(self.context, start, self.workspace, debrief, exercises.take_first)
        start.offer_tour(tour.is_wanted)
        start.tour_wanted.connect(lambda yes: tour.begin() if yes else tour.decline())
        start.recent_chosen.connect(open_ct.open_folder)
        start.named.connect(self._take_name)
        with self.context.shell.made_for(STAFF):
            self.context.shell.owned.keep(start.own)
        self._take_name(str(self.settings.value("student/name", "")))
        ACCESS.changed.connect(self._follow_role)
        debrief_feature = self.feature(DebriefFeature)
        debrief_feature.begin_wanted.connect(exercises.beginning.go_on)
        debrief_feature.drill_wanted.connect(exercises.beginning.practise)

    def _connect_people(self) -> None:
        """Let the board lead to the attempts of a student, and back."""
        people, debrief = self.feature(PeopleFeature), self.feature(DebriefFeature)
        people.attempt_wanted.connect(debrief.open_attempt)
        people.attempts_wanted.connect(
            lambda key, exercise, words: debrief.show_attempts(key, exercise, words, people.show)
        )

    def _let_picture(self) -> None:
        """Let missing pictures of patients be made while nobody waits for anything else."""
        idle = self.pages.currentWidget() is self.start_page and not self.open_ct.is_reading
        self.start_facts.let_picture(idle and self.runs.is_prepared)

    def _forget_patient(self) -> None:
        """Empty everything of the patient. Settings, records and the exercise stay."""
        for feature in self.features:
            feature.forget()
        self.undo.clear()
        self.conductor.scans.forget()
        self.workspace.forget()
        self.message_bar.clear()

    def _suit_room(self) -> None:
        self.workspace.suit_room()
        self.start_page.set_recents(self.open_ct.recents.paths())
        for feature in self.features:
            feature.suit_room()
        self.refresh()

    def leave(self) -> None:
        """Close without a question: whoever calls this has asked."""
        self._asked = True
        self.close()

    # --- events -------------------------------------------------------------------------------
    def showEvent(self, event: QShowEvent) -> None:
        """Begin to load what an exercise needs, behind the window."""
        super().showEvent(event)
        self.start_facts.show_kept()  # tens of milliseconds: no place is ever without its face
        QTimer.singleShot(PAINTED_MS, self.runs.prepare)
        QTimer.singleShot(PAINTED_MS, self.start_facts.begin)
        debrief = self.feature(DebriefFeature)
        for offers in (debrief.interruptions, debrief.gathering):
            QTimer.singleShot(PAINTED_MS, offers, offers.look)

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Accept a folder or a file from it."""
        if _dropped(event):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        """Open what was dropped."""
        for path in _dropped(event)[:1]:
            self.open_dropped(path)
            event.acceptProposedAction()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Ask about an attempt that runs and what is unsaved, then end everything."""
        if not (self._asked or (self.feature(ExerciseFeature).may_quit() and self.may_go())):
            event.ignore()
            return
        self.remembered.remember()
        for feature in self.features:
            feature.close()
        self.tour.close()
        self.start_facts.close()
        self.equipment.close()
        self.conductor.close()
        event.accept()


def open_window(services: Services) -> MainWindow:
    """Return the window, not yet shown."""
    return MainWindow(services)


def _dropped(event: QDropEvent) -> list[Path]:
    """Return what of this computer is dropped."""
    return [Path(url.toLocalFile()) for url in event.mimeData().urls() if url.isLocalFile()]
