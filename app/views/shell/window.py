"""The main window: start page, workspace, debrief and sessions, and what stands around them."""

from __future__ import annotations

from PySide6.QtCore import QTimer
from PySide6.QtGui import QCloseEvent, QDragEnterEvent, QDropEvent, QShowEvent
from PySide6.QtWidgets import QMainWindow, QStackedWidget, QVBoxLayout, QWidget

from app.session.result import AttemptResult
from app.views.cameras.desk import CamerasDesk
from app.views.checks.desk import ChecksDesk
from app.views.debrief.controller import DebriefController
from app.views.debrief.page import DebriefPage
from app.views.debrief.scan_picture import ScanPictures
from app.views.debrief.sessions import SessionsPage
from app.views.exercise.conductor import Conductor
from app.views.exercise.exercise_choice import ExerciseChoice
from app.views.exercise.runs import Runs
from app.views.kit.names import NAMES
from app.views.kit.progress_strip import ProgressStrip
from app.views.measure.desk import MeasureDesk
from app.views.pen.desk import PenDesk
from app.views.plan.editor import PlanEditor
from app.views.plan.files import PlanFiles
from app.views.plan.helper import PathsHelper
from app.views.reading.workspace import Workspace
from app.views.robot.desk import RobotDesk
from app.views.series.open_ct import OpenCt
from app.views.series.patient import Patient
from app.views.shell.about import about
from app.views.shell.change_of_patient import ChangeOfPatient, forget_patient
from app.views.shell.drops import dropped, open_dropped
from app.views.shell.menus import Menus
from app.views.shell.message_bar import MessageBar
from app.views.shell.message_topics import MessageTopics
from app.views.shell.notices import Notices
from app.views.shell.page_ways import connect_pages
from app.views.shell.problem_report import ProblemReport
from app.views.shell.projector import Projector
from app.views.shell.remembered import Remembered
from app.views.shell.services import Services
from app.views.shell.settings import Recents, open_settings
from app.views.shell.shortcuts import ShortcutSheet
from app.views.shell.start_page import StartPage
from app.views.shell.undo import UndoOrder
from app.views.structures.desk import StructuresDesk

PAINTED_MS = 50
"""This long after it is shown the window is painted, and heavy parts may load."""


class MainWindow(QMainWindow):
    """Composes pages and parts; everything else is theirs."""

    def __init__(self, services: Services, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.services = services
        self.settings = open_settings()
        self.recent_cts = Recents(self.settings, "recent/cts")
        self.recent_plans = Recents(self.settings, "recent/plans")
        self.editor = PlanEditor(self)
        self.message_bar, self.progress = MessageBar(self), ProgressStrip(self)
        self.workspace = Workspace(self.editor, self)
        self.runs = Runs(services, self.progress, self)
        self.conductor = Conductor(self.workspace, self.editor, self.runs, self.progress, self)
        self.robot = RobotDesk(services, self.settings, self.conductor, self.runs, self.workspace,
                               self.progress, self)  # fmt: skip
        self.cameras = CamerasDesk(services, self.settings, self.conductor, self.runs, self)
        self.pen = PenDesk(services, self.robot, self.cameras, self.conductor, self.runs, self)
        self.checks = ChecksDesk(self.conductor, self.editor, self.workspace,
                                 lambda: self.runs.run, self)  # fmt: skip
        self.structures = StructuresDesk(self.conductor, self.editor, self.workspace, self.progress,
                                         self)  # fmt: skip
        self.paths = PathsHelper(self.conductor, self.editor, self.workspace,
                                 self.structures.book, self.progress, self)  # fmt: skip
        self.undo = UndoOrder((self.editor, self.workspace.measure, self.structures.book), self)
        self.measuring = MeasureDesk(self)
        self.plan_files = PlanFiles(self.editor, self.recent_plans, self)
        self.open_ct = OpenCt(self.recent_cts, self.progress, self)
        self.start_page, self.debrief_page = StartPage(self), DebriefPage(self)
        self.sessions_page = SessionsPage(services.sessions(), self)
        self.debrief = DebriefController(
            self.debrief_page, self.sessions_page, services.sessions(), parent=self
        )
        self.scan_pictures = ScanPictures(self.debrief_page, self.conductor, self.progress)
        self.choice, self.change = ExerciseChoice(self), ChangeOfPatient(self)
        self.exercises = {exercise.id: exercise for exercise in services.exercises()}
        self._lay_out()
        self.projector = Projector(self)
        self.menus = Menus(self)
        self.notices = Notices(self, (self.progress, self.message_bar))
        self._connect()
        self.remembered = Remembered(self, self.settings)
        self.conductor.exercise_taken.connect(self.remembered.follow)
        self.remembered.restore()
        self.show_start()

    # --- pages --------------------------------------------------------------------------------
    def show_start(self) -> None:
        """Go to the start page."""
        self.start_page.set_recents(self.recent_cts.paths())
        self.pages.setCurrentWidget(self.start_page)

    def show_workspace(self) -> None:
        """Go to the panes."""
        self.pages.setCurrentWidget(self.workspace)
        self.workspace.panes[0].canvas.setFocus()

    def show_sessions(self) -> None:
        """Go to the past attempts."""
        self.sessions_page.refresh()
        self.pages.setCurrentWidget(self.sessions_page)

    def show_debrief(self) -> None:
        """Go to the attempt that the debrief shows."""
        self.pages.setCurrentWidget(self.debrief_page)

    # --- commands -----------------------------------------------------------------------------
    def open_phantom(self) -> None:
        """Open the phantom of the present exercise, or the first."""
        self.choice.open_phantom()

    def begin_exercise(self, identifier: str) -> None:
        """Take an exercise and open its patient, unless it is shown already."""
        self.choice.begin(identifier)

    def cursor_to_target(self) -> None:
        """Let the slices pass through the target."""
        target = self.editor.edit.draft.target_mm
        if target is not None:
            self.workspace.viewing.set_cursor(target)

    def toggle_full_screen(self) -> None:
        """Fill the screen, or stop doing so."""
        if self.isFullScreen():
            self.showNormal()
        else:
            self.showFullScreen()

    def show_shortcuts(self) -> None:
        """Open the sheet of keys."""
        sheet = ShortcutSheet(self.workspace.viewing.scheme, self)
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

    # --- what happens -------------------------------------------------------------------------
    def show_patient(self, patient: Patient) -> None:
        """Show a patient that was opened."""
        self.choice.show_patient(patient)

    def show_result(self, result: AttemptResult) -> None:
        """Show the debrief of an attempt that ended."""
        self.editor.set_locked(False)
        self.debrief.show_result(result)

    def refresh(self) -> None:
        """Write the title and enable what can be done."""
        name = self.conductor.patient.label if self.conductor.patient else ""
        self.setWindowTitle(f"{NAMES.shown(name)} – Acus" if name else "Acus")
        self.menus.undo.setEnabled(self.undo.can_undo)
        self.menus.redo.setEnabled(self.undo.can_redo)

    # --- set-up -------------------------------------------------------------------------------
    def _lay_out(self) -> None:
        self.pages = QStackedWidget(self)
        for page in (self.start_page, self.workspace, self.debrief_page, self.sessions_page):
            self.pages.addWidget(page)
        centre = QWidget(self)
        column = QVBoxLayout(centre)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.pages, 1)
        self.setCentralWidget(centre)
        self.setAcceptDrops(True)
        self.start_page.set_exercises(tuple(self.exercises.values()))
        self.workspace.exercise_panel.set_exercises(self.choice.titles)
        self.workspace.exercise_panel.buttons.watch(self)

    def _connect(self) -> None:
        conductor = self.conductor
        self.topics = MessageTopics(self)
        self.runs.ready.connect(lambda _: self.checks.forget())
        change, open_ct = self.change, self.open_ct
        open_ct.may_replace = change.may_replace
        open_ct.reading.connect(change.set_loading)
        open_ct.opened.connect(lambda patient: change.take(patient, self.show_patient))
        open_ct.failed.connect(lambda _: self.choice.give_up())
        open_ct.given_up.connect(self.choice.give_up)
        conductor.patient_left.connect(lambda: forget_patient(self))
        conductor.patient_changed.connect(self.refresh)
        self.undo.changed.connect(self.refresh)
        connect_pages(self)
        panel = self.workspace.plan_panel
        panel.new_wanted.connect(self.plan_files.new)
        panel.open_wanted.connect(self.plan_files.ask_open)
        panel.save_wanted.connect(self.plan_files.save)
        panel.save_as_wanted.connect(self.plan_files.save_as)

    # --- events -------------------------------------------------------------------------------
    def showEvent(self, event: QShowEvent) -> None:
        """Begin to load what an exercise needs, behind the window."""
        super().showEvent(event)
        QTimer.singleShot(PAINTED_MS, self.runs.prepare)

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Accept a folder or a file from it."""
        if dropped(event):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        """Open a dropped folder, plan or position."""
        for path in dropped(event)[:1]:
            open_dropped(self, path)
            event.acceptProposedAction()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Ask about an unsaved plan, then end everything."""
        if not self.plan_files.after_question(self.remembered.remember):
            event.ignore()
            return
        self.open_ct.close()
        self.checks.close()
        self.structures.close()
        self.paths.close()
        self.robot.close()
        self.cameras.close()
        self.conductor.close()
        event.accept()
