"""People in the window: who signs in, students, courses, the board, results that leave."""

from __future__ import annotations

import datetime
import secrets
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar, TypeVar

from PySide6.QtCore import QStandardPaths, Signal, SignalInstance
from PySide6.QtWidgets import QDialog, QFileDialog, QMessageBox

from app.core.errors import AcusError
from app.core.progress import Progress
from app.exchange.openid import Entered, StationRole
from app.exchange.results import Results, ResultsFormat, results_text, write_results
from app.exercises.schema import Exercise
from app.session.access import Known
from app.session.accounts import accounts_in
from app.session.archive import Erased, backup, erase_person, left_out
from app.session.board import ProgressBoard, board_of
from app.session.course import (
    Course,
    CourseError,
    CourseStanding,
    course_standings,
    courses,
    not_void,
    refusals,
    waiting_for_release,
)
from app.session.course_plan import course_plans
from app.session.errors import PeopleError
from app.session.index import Index, Indexed
from app.session.people import PEOPLE, People, Person, RosterReport, people_folder
from app.session.reliability import reliability_lines
from app.session.roster import RosterLine, roster_in
from app.session.stations import NAME_SETTING
from app.views.kit.access import ACCESS
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.menu_entries import add_entries
from app.views.kit.names import NAMES
from app.views.kit.parts import message_box
from app.views.kit.roles import EVERYBODY, STAFF, Role
from app.views.kit.text import begun, declared, tr, tr_n, translated
from app.views.people.board import GROUP_PDF, STUDENT_PDF
from app.views.people.course_form import CourseDialog
from app.views.people.curve import CurveDialog
from app.views.people.dialogs import EntryDialog, text_dialog
from app.views.people.folder_backups import FolderBackups
from app.views.people.group_report import group_report
from app.views.people.hospital import HospitalSignIn
from app.views.people.leaving import LeavingChoice, LeavingDialog
from app.views.people.lrs_link import LrsLink
from app.views.people.pages import PeoplePage
from app.views.people.report_facts import ReportFacts
from app.views.people.restoring import BackupRestorer
from app.views.people.results_report import student_report, write_report
from app.views.people.school_link import SchoolLink
from app.views.people.stations import StationDoors, StationExchange
from app.views.shell.feature import Context, Feature

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Look:
    """What the page shows: students (with names for the instructor), courses, board, attempts.

    Of courses also how who is here stands in them, and which results wait for their release.
    """

    people: list[Person]
    courses: list[Course]
    broken: list[str]
    board: ProgressBoard
    attempts: Sequence[Indexed]
    standings: Mapping[str, list[CourseStanding]]
    waiting: Mapping[str, list[str]]


class PeopleFeature(Feature):
    """Signing in and out, and the page of people, in the menu of sessions.

    Signals:
        attempts_wanted(str, str, str): key of a student, id of an exercise (empty for all), and
            what these attempts are called: they are to be listed.
        attempt_wanted(str): the debrief of this attempt.

    Attributes:
        page: board, students and courses.
        restorer: of backups.
        folder_backups: adds backups to a folder.
        link: to the store that the stations of a school share.
        lrs: to the learning record store that is told of attempts.
        hospital: signs people in by the hospital, where a provider is configured.
        stations: results of several stations, written and brought together.
        dialog: the one that was opened last.
    """

    topic: ClassVar[str] = "people"
    place: ClassVar[int] = 180
    roles: ClassVar[frozenset[Role]] = EVERYBODY
    attempts_wanted = Signal(str, str, str)
    attempt_wanted = Signal(str)

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._shell, self._folder = context.shell, context.services.sessions()
        self._panel = context.conductor.views.panel
        self._people = People()
        self._look: Look | None = None
        self._asked = self._learning = 0
        self._running: list[BackgroundTask] = []
        self.dialog: QDialog | None = None
        self.page = PeoplePage()
        self._shell.add_page(self.page)
        menu = self._shell.menu(tr("&Sessions"))
        show, student = add_entries(
            menu,
            (
                None,
                (tr("Progress, students and courses"), "Shift+F7", self.show),
                (tr("Sign in as a student…"), "", self.sign_in_student),
            ),
        )
        with self._shell.made_for(STAFF):
            instructor = add_entries(
                menu, ((tr("Sign in as the instructor…"), "", self.sign_in_instructor),)
            )[0]
        leave = add_entries(menu, ((tr("Sign out"), "", lambda: ACCESS.sign_in(None)),))[0]
        with self._shell.made_for(STAFF):
            *saves, restore = add_entries(
                menu,
                (
                    (tr("Back up everything…"), "", self.back_up),
                    (tr("Back up into a folder…"), "", lambda: self.folder_backups.choose()),
                    (tr("Restore a backup…"), "", lambda: self.restorer.choose()),
                ),
            )
        self._actions = show, student, instructor, leave, *saves, restore
        self.restorer = BackupRestorer(self._doors())
        self.folder_backups = FolderBackups(self._doors())
        controller = context.conductor.controller
        self.link = SchoolLink(self._doors(), lambda: controller.is_running, self)
        self.link.told.connect(self.page.board.show_store)
        self.lrs = LrsLink(self._doors(), self._titles, lambda: controller.is_running, self)
        self.lrs.told.connect(self.page.board.show_lrs)
        self.hospital = HospitalSignIn(self._doors(), self._let_in, self)
        links = self.link, self.lrs
        self.stations = StationExchange(self.page.board.stations, self._doors(), *links)
        self._connect()
        ACCESS.changed.connect(self._follow)
        self._follow()
        if (people_folder() / PEOPLE).exists():
            ACCESS.learn(Known(guarded=True))  # until it is known
            self.look()

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self._shell.page_changed, ACCESS.changed)

    def suit_room(self) -> None:
        """Take names that are hidden, or shown again."""
        self.page.students.show_people(self.page.students.people)
        if self.page.board.board is not None:
            self.page.board.show_board(self.page.board.board, self._titles())

    def close(self) -> None:
        """End what runs, and the dialog that is open; nobody stays signed in."""
        self.link.close()
        self.lrs.close()
        self.hospital.close()
        for task in tuple(self._running):
            task.close()
        if self.dialog is not None:
            self.dialog.done(QDialog.DialogCode.Rejected)  # whatever it would ask
        ACCESS.sign_in(None)
        ACCESS.learn(Known())

    # --- signing in -------------------------------------------------------------------------------
    def sign_in_student(self) -> None:
        """Ask for pseudonym and PIN."""
        fields = ((tr("Pseudonym"), False), (tr("PIN"), True))

        def take(pseudonym: str, pin: str) -> None:
            ACCESS.sign_in(self._people.sign_in(pseudonym, pin))
            self.look()

        dialog = EntryDialog(tr("Sign in"), fields, take, parent=self._shell.dialog_parent)
        self.hospital.offer(dialog)
        self._open(dialog)

    def sign_in_instructor(self) -> None:
        """Ask for the password; the first time one is set, and the recovery key shown."""
        if not self._people.has_instructor():
            self._set_instructor()
            return

        def take(password: str) -> None:
            self._people.check_instructor(password)
            ACCESS.sign_in(None, instructor=True)
            self.look()

        fields = ((tr("Password"), True),)
        parent = self._shell.dialog_parent
        dialog = EntryDialog(tr("Sign in as the instructor"), fields, take, parent=parent)
        self.hospital.offer(dialog)
        self._open(dialog)

    def _let_in(self, entered: Entered) -> None:
        """Take who was signed in by the hospital, in the role that station and groups allow."""
        person, role = entered.person, entered.role
        if role is StationRole.STUDENT:
            ACCESS.sign_in(person)
        else:
            ACCESS.sign_in(None, True, Role(role.value), person.key)
        self.look()

    def _set_instructor(self) -> None:
        words = tr(
            "No password is set yet: whoever is here may do everything. A password keeps students "
            "from people, courses, deleting and exports. It guards against curiosity, not against "
            "the owner of the disk."
        )

        def take(password: str, again: str) -> None:
            if password != again:
                raise PeopleError(tr("the two passwords are not the same: type them again"))
            recovery = self._people.set_instructor(password)
            ACCESS.sign_in(None, instructor=True)
            self.look()
            self._tell(
                tr("Recovery key"),
                tr(
                    "Write this down and lock it away: it sets a new password, and opens "
                    "the station's key in a backup. It is not stored anywhere."
                ),
                recovery,
                once=True,
            )

        fields = ((tr("New password"), True), (tr("Again"), True))
        parent = self._shell.dialog_parent
        self._open(EntryDialog(tr("Set the instructor's password"), fields, take, words, parent))

    # --- looking ----------------------------------------------------------------------------------
    def show(self) -> None:
        """Go to the page of people."""
        if ACCESS.may_manage or ACCESS.student is not None:
            self._shell.show_page(self.page)
            self.refresh()
        else:
            self.failed.emit(tr("Sign in first: as a student, or as the instructor."))

    def look(self) -> None:
        """Learn who there is, and what the student who is here may begin, beside the window."""
        student, titles = ACCESS.student, self._titles()

        def find(_: Progress) -> Known:
            people = self._people
            known = Known.of(people)
            if student is None:
                return known
            index = Index(self._folder)
            index.refresh()
            own, today = not_void(index.attempts([student.key]), people.remarks()), _today()
            return replace(known, refused=refusals(courses()[0], student, own, today, titles))

        self._learning += 1
        asked = self._learning

        def learn(known: Known) -> None:
            if asked == self._learning:
                ACCESS.learn(known)

        self._beside(find, learn)

    def refresh(self) -> None:
        """Read people, courses and attempts anew, beside the window."""
        chosen, group = self.page.board.course.currentData(), self.page.board.group.currentData()
        names, student, exercises = ACCESS.may_manage, ACCESS.student, self._exercises()

        def read(progress: Progress) -> Look:
            people, (known, broken) = self._people, courses()
            course = next((one for one in known if one.id == chosen), None)
            board, attempts = board_of(
                self._folder, people, course, group or "", None, progress, released=not names
            )
            everybody, remarks = people.everybody(names), people.remarks()
            persons = {one.key: one for one in everybody}
            waiting = {
                one.id: waiting_for_release(one, attempts, persons, remarks) for one in known
            }
            if not names:
                everybody = [one for one in everybody if student and one.key == student.key]
                board = replace(board, students=tuple(everybody))
                known = [one for one in known if student and one.takes(student)]
                broken, waiting = [], {}
            board.tell_competence()  # here, where the window need not wait for it
            own = [one for one in attempts if student and one.student == student.key]
            own = not_void(own, remarks)
            standings = {
                one.id: course_standings(one, exercises, student, own, remarks, _today())
                for one in known
            }
            return Look(everybody, known, broken, board, attempts, standings, waiting)

        self._asked += 1
        asked = self._asked

        def show(look: Look) -> None:
            if asked == self._asked:  # else it was read before something changed
                self._show_look(look)

        self._beside(read, show, tr("Reading the attempts"))

    def _show_look(self, look: Look) -> None:
        self._look = look
        self.page.students.show_people(look.people)
        self.page.courses.show_courses(look.courses, look.broken, look.standings, look.waiting)
        groups = sorted({name for person in look.people for name in person.groups})
        self.page.board.set_choices(look.courses, groups)
        self.page.board.show_board(look.board, self._titles())

    def _exercises(self) -> dict[str, Exercise]:
        """Return the exercises that there are now: one may just have been made."""
        return {exercise.id: exercise for exercise in self.context.services.exercises()}

    def _titles(self) -> dict[str, str]:
        return {name: declared(exercise.title) for name, exercise in self._exercises().items()}

    def _show_curve(self, key: str, exercise: str) -> None:
        look = self._look
        if look is None:
            return
        parent = self._shell.dialog_parent
        dialog = CurveDialog(self._named(key, exercise), look.board, key, exercise, parent)
        dialog.attempt_chosen.connect(self.attempt_wanted)
        dialog.attempts.clicked.connect(lambda: self._show_attempts(key, exercise))
        dialog.attempts.clicked.connect(dialog.accept)
        self._open(dialog)

    def _show_attempts(self, key: str, exercise: str) -> None:
        self.attempts_wanted.emit(key, exercise, self._named(key, exercise))

    def _named(self, key: str, exercise: str) -> str:
        """Say whose attempts at what."""
        people = self._look.people if self._look is not None else ()
        who = NAMES.shown(next((one.pseudonym for one in people if one.key == key), ""))
        return f"{who}: {self._titles().get(exercise, exercise)}" if exercise else who

    # --- students ---------------------------------------------------------------------------------
    def add_student(self) -> None:
        """Ask for one student."""
        if not self._may():
            return
        names = (tr("Pseudonym"), tr("Name"), tr("PIN (empty: drawn)"), tr("Groups"))
        words = tr("The pseudonym is what screens show; the name is kept apart from all records.")

        def take(pseudonym: str, name: str, pin: str, groups: str) -> None:
            some = tuple(sorted({g.strip() for g in groups.split(",") if g.strip()}))
            person, drawn = self._people.add(RosterLine(pseudonym, name.strip(), pin.strip(), some))
            self._changed()
            if not pin.strip():
                self._tell(
                    tr("PIN"),
                    tr("Hand this out; it is not stored anywhere."),
                    f"{person.pseudonym}  {drawn}",
                    once=True,
                )

        fields = [(name, False) for name in names]
        parent = self._shell.dialog_parent
        self._open(EntryDialog(tr("Add a student"), fields, take, words, parent))

    def choose_roster(self) -> None:
        """Ask for a roster and take it."""
        if not self._may():
            return
        parent = self._shell.dialog_parent
        start, kind = str(NAMES.folder(_documents())), tr("CSV (*.csv *.txt)")
        path = QFileDialog.getOpenFileName(parent, tr("Roster"), start, kind)[0]
        if path:
            self.take_roster(Path(path))

    def take_roster(self, path: Path) -> None:
        """Take a roster, beside the window; what is wrong is shown line by line."""
        if not self._may():
            return

        def read(_: Progress) -> RosterReport:
            lines, errors = roster_in(path)
            if errors:
                return RosterReport(errors=tuple(errors))
            return self._people.take_roster(lines)

        self._beside(read, self._show_roster, tr("Taking the roster"))

    def _show_roster(self, report: RosterReport) -> None:
        self._changed()
        if report.errors:
            words = tr("Nothing was imported. Correct these rows and import the roster again:")
            self._tell(tr("Roster"), words, "\n".join(report.errors))
            return
        added, updated = len(report.added), len(report.updated)
        self.noted.emit(
            tr_n(
                "{n} student added, {m} updated",
                "{n} students added, {m} updated",
                added,
                m=updated,
            )
        )
        if report.pins:
            pins = "\n".join(f"{name}\t{pin}" for name, pin in report.pins.items())
            words = tr("Hand these out; they are kept nowhere.")
            self._tell(tr("PINs"), words, pins, once=True)

    def new_pin(self) -> None:
        """Ask whether another PIN is drawn for the student who is chosen."""
        if not self._may():
            return
        person = self.page.students.chosen()
        if person is None:
            return
        box = message_box(
            self._shell.dialog_parent,
            tr("PIN"),
            tr("Draw another PIN for {name}?", name=person.pseudonym),
            tr("The one before is worth nothing then. The new one is shown once."),
        )
        draw = box.addButton(tr("Draw a PIN"), QMessageBox.ButtonRole.AcceptRole)
        box.setDefaultButton(box.addButton(QMessageBox.StandardButton.Cancel))
        box.buttonClicked.connect(
            lambda clicked: self._draw_pin(person) if clicked is draw and self._may() else None
        )
        self._open(box)

    def _draw_pin(self, person: Person) -> None:
        pin = f"{secrets.randbelow(10**6):06d}"
        self._try(lambda: self._people.set_pin(person.pseudonym, pin))
        words = tr("Hand this out; it is not stored anywhere.")
        self._tell(tr("PIN"), words, f"{person.pseudonym}  {pin}", once=True)

    def erase(self) -> None:
        """Ask whether, and how, the student who is chosen is erased for good."""
        if not self._may():
            return
        person = self.page.students.chosen()
        if person is None:
            return
        box = message_box(
            self._shell.dialog_parent,
            tr("Erase"),
            tr("Erase {name} for good?", name=person.pseudonym),
            tr(
                "Name, PIN, groups and comments go, and no backup brings them back. The records of "
                "attempts hold a random key only: they can stay as nobody's, or go too."
            ),
        )
        box.setIcon(QMessageBox.Icon.Warning)
        role = QMessageBox.ButtonRole
        keep = box.addButton(tr("Erase, keep the records"), role.DestructiveRole)
        box.addButton(tr("Erase with all records"), role.DestructiveRole)
        box.setDefaultButton(box.addButton(QMessageBox.StandardButton.Cancel))
        box.buttonClicked.connect(
            lambda clicked: (
                self._erase(person.pseudonym, clicked is not keep)
                if box.buttonRole(clicked) is role.DestructiveRole
                else None
            )
        )
        self._open(box)

    def _erase(self, pseudonym: str, with_records: bool) -> None:
        def work(_: Progress) -> Erased:
            return erase_person(pseudonym, self._folder, with_records, self._people)

        def done(result: Erased) -> None:
            self._changed()
            text = tr(
                "{name} was erased; records deleted: {n}, kept as nobody's: {m}",
                name=pseudonym,
                n=result.deleted,
                m=result.anonymous,
            )
            self.noted.emit(text)

        self._beside(work, done, tr("Erasing"))

    # --- courses, results, backup -----------------------------------------------------------------
    def edit_course(self, course: Course | None) -> None:
        """Show a course, or an empty one, as a form."""
        if not self._may():
            return

        def take(edited: Course) -> None:
            if course is None and any(one.id == edited.id for one in courses()[0]):
                raise CourseError(
                    tr("{id} is already in use: choose another file name", id=edited.id)
                )
            edited.save()
            self._changed()

        groups = sorted({name for one in self._people.everybody() for name in one.groups})
        parent = self._shell.dialog_parent
        plans = [] if course is not None else course_plans()
        self._open(CourseDialog(course, self._exercises(), take, groups, plans, parent))

    def begin_of_course(self, standing: CourseStanding) -> None:
        """Begin an exercise of a course, or say why that cannot be."""
        if standing.refusal:
            self.failed.emit(
                tr("{title} cannot be begun: {why}.", title=standing.title, why=standing.refusal)
            )
        else:
            self.context.conductor.exercise_wanted.emit(standing.item.exercise)

    def release_course(self, course: Course) -> None:
        """Ask whether all results that wait in a course are released."""
        if not self._may():
            return
        ids = list(self._look.waiting.get(course.id, ())) if self._look is not None else []
        box = message_box(
            self._shell.dialog_parent,
            tr("Release results"),
            tr_n(
                "Release {n} result of {title}?",
                "Release {n} results of {title}?",
                len(ids),
                title=course.title,
            ),
            tr("Their students see score, replay and your comments then. Each can be held back."),
        )
        release = box.addButton(tr("Release"), QMessageBox.ButtonRole.AcceptRole)
        box.setDefaultButton(box.addButton(QMessageBox.StandardButton.Cancel))

        def answered(clicked: object) -> None:
            if clicked is release and ids and self._may():
                self._try(lambda: self._people.remark_all(ids, released=True))
                self.noted.emit(tr_n("{n} result released", "{n} results released", len(ids)))
                self._changed()

        box.buttonClicked.connect(answered)
        self._open(box)

    def choose_export(self, form: str) -> None:
        """Ask where results go, and write them."""
        if not self._may():
            return
        if form == STUDENT_PDF and self._chosen_student() is None:
            self.failed.emit(tr("Choose a student on the board first: click on the row."))
            return
        look = self._look
        if look is None or form not in (ResultsFormat.MOODLE, GROUP_PDF):
            self._ask_file(form)
            return
        report = form == GROUP_PDF
        dialog = LeavingDialog(
            look.board,
            None if report else accounts_in(self._people.names()),
            self._people.setting(NAME_SETTING),
            lambda choice: self._ask_file(form, choice),
            self._shell.dialog_parent,
        )
        self._open(dialog)

    def _ask_file(self, form: str, choice: LeavingChoice | None = None) -> None:
        """Ask which file results go to, and write them."""
        suffix = "pdf" if form.endswith("pdf") else "json" if form == "json" else "csv"
        parent, start = self._shell.dialog_parent, _documents() / f"acus-results-{form}.{suffix}"
        kind = f"{suffix.upper()} (*.{suffix})"
        path = QFileDialog.getSaveFileName(parent, tr("Export results"), str(start), kind)[0]
        if path:
            self.export(form, Path(path), choice)

    def export(self, form: str, path: Path, choice: LeavingChoice | None = None) -> None:
        """Write the results of those on the board, beside the window; it can be cancelled."""
        look, choice = self._look, choice or LeavingChoice()
        if look is None or not self._may():
            return
        semicolons, chosen = self.page.board.semicolons.isChecked(), self._chosen_student()
        saved, titles = tr("Saved {name}", name=str(path)), self._titles()
        board, rule = self.page.board, choice.gradebook.rule
        course, group = (
            box.currentText() if box.currentData() else "" for box in (board.course, board.group)
        )
        facts = ReportFacts(course, group, choice.place, rule)

        def gather() -> Results:
            known = {person.key: person for person in look.people}
            wanted = {item.exercise for item in look.board.items}
            shown = {person.key for person in look.board.students}
            some = [one for one in look.attempts if one.exercise in wanted and one.student in shown]
            accounts = accounts_in(self._people.names())
            return Results(look.board, some, known, self._people.remarks(), {}, accounts, titles)

        def work(progress: Progress) -> None:
            results = gather()
            if form == GROUP_PDF:  # on pages of its own: Qt allows that beside the window
                write_report(path, lambda: group_report(results, titles, facts, progress))
            elif form == STUDENT_PDF and chosen is not None:
                write_report(path, lambda: student_report(results, chosen, titles, facts))
            else:
                told = (ResultsFormat(form), semicolons, progress, choice.gradebook, translated)
                text = results_text(results, *told)
                write_results(path, text)

        self._beside(work, lambda _: self.noted.emit(saved), tr("Writing the results"))

    def show_reliability(self) -> None:
        """Say how far the scores of the board can be relied on; told beside the window."""
        if self._look is None or not self._may():
            return
        board, title = self._look.board, tr("How far scores can be relied on")

        def show(lines: Sequence[str]) -> None:
            self._tell(title, tr("Intervals are of 95 %."), "\n".join(map(begun, lines)))

        self._beside(lambda _: reliability_lines(board), show, title)

    def _chosen_student(self) -> Person | None:
        """Return the student whose row of the board is chosen."""
        row, board = self.page.board.table.currentRow(), self.page.board.board
        some = board.students if board is not None else ()
        return some[row] if 0 <= row < len(some) else None

    def back_up(self) -> None:
        """Ask where, and write everything into one file."""
        if not self._may():
            return
        parent = self._shell.dialog_parent
        start = _documents() / f"acus-{datetime.date.today()}.acusbackup"
        kind = tr("Backup of Acus (*.acusbackup)")
        path = QFileDialog.getSaveFileName(parent, tr("Back up everything"), str(start), kind)[0]
        if path:

            def save(progress: Progress) -> tuple[int, list[str]]:
                return backup(Path(path), self._folder, self._people, progress), left_out()

            def tell(saved: tuple[int, list[str]]) -> None:
                count, left = saved
                words = tr("{n} records saved in {name}", n=count, name=path)
                without = tr("Not in it: {what}", what="; ".join(left)) if left else ""
                self.noted.emit(". ".join(filter(None, (words, without))))

            self._beside(save, tell, tr("Backing up"))

    # --- inside -----------------------------------------------------------------------------------
    def _doors(self) -> StationDoors:
        return StationDoors(
            self._folder,
            self._people,
            self._may,
            self._beside,
            self.noted.emit,
            self._tell,
            self._open,
            self._changed,
            lambda: self._shell.dialog_parent,
        )

    def _connect(self) -> None:
        board, students, tab = self.page.board, self.page.students, self.page.courses
        self.page.closed.connect(self.context.leave_page)
        board.choice_changed.connect(self.refresh)
        board.curve_wanted.connect(self._show_curve)
        board.attempts_wanted.connect(self._show_attempts)
        board.export_wanted.connect(self.choose_export)
        board.reliability.triggered.connect(lambda: self.show_reliability())
        students.add.clicked.connect(lambda: self.add_student())
        students.roster.clicked.connect(lambda: self.choose_roster())
        students.pin.clicked.connect(lambda: self.new_pin())
        students.erase.clicked.connect(lambda: self.erase())
        tab.new.clicked.connect(lambda: self.edit_course(None))
        tab.begin_wanted.connect(self.begin_of_course)
        tab.release_wanted.connect(self.release_course)
        tab.edit.clicked.connect(lambda: self.edit_course(tab.chosen()) if tab.chosen() else None)
        conductor = self.context.conductor
        conductor.controller.finished.connect(lambda _: self._ended())

        def refusal() -> str:
            taken = conductor.exercise
            if taken is None:
                return ""
            drill = taken.drill
            why = ACCESS.refusal(taken.id) if drill is None else ACCESS.drill_refusal(drill.of)
            return tr("It cannot be begun: {why}.", why=why) if why else ""

        conductor.controller.refusal = refusal
        ACCESS.changed.connect(conductor.show_readiness)
        conductor.exercise_taken.connect(lambda _: conductor.show_readiness())

    def _follow(self) -> None:
        """Show what who is here may do."""
        show, student, instructor, leave, *saves, restore = self._actions
        here = ACCESS.student is not None or ACCESS.instructor
        show.setEnabled(ACCESS.may_manage or ACCESS.student is not None)
        show.setText(
            tr("Progress, students and courses")
            if ACCESS.may_manage
            else tr("Progress and courses")
        )
        student.setEnabled(not here)
        alone = ACCESS.role is Role.STUDENT  # who sees what he can do, and nothing that he cannot
        show.setVisible(show.isEnabled() or not alone)
        someone = ACCESS.has_students or self.hospital.configured
        student.setVisible(someone and not here if alone else True)
        leave.setVisible(here or not alone)
        instructor.setEnabled(not ACCESS.instructor)
        leave.setEnabled(here)
        for action in (*saves, restore):
            action.setEnabled(ACCESS.may_manage)
        self.page.set_managing(ACCESS.may_manage)
        self.stations.set_managing(ACCESS.may_manage)
        if not show.isEnabled() and self.page.isVisible():
            self.context.leave_page()
        elif self.page.isVisible():
            self.refresh()

    def _ended(self) -> None:
        """Look again: what may be begun next has changed with an attempt that ended."""
        self.link.soon()
        self.lrs.soon()
        if ACCESS.student is not None:
            self.look()

    def _changed(self) -> None:
        self.look()
        self.refresh()

    def _may(self) -> bool:
        """Return whether who is here may change people and courses, whatever asks; else it is
        said.
        """
        if not ACCESS.may_manage:
            self.failed.emit(ACCESS.why_not_manage)
        return ACCESS.may_manage

    def _try(self, work: Callable[[], object]) -> None:
        try:
            work()
        except AcusError as error:
            self.failed.emit(error)

    def _beside(
        self, work: Callable[[Progress], T], done: Callable[[T], object], title: str = ""
    ) -> None:
        indicator = self._shell.progress if title else None
        task = run_in_background(
            self, work, done, self.failed.emit, title=title, indicator=indicator
        )
        self._running.append(task)
        task.finished.connect(lambda: self._running.remove(task))

    def _tell(self, title: str, words: str, text: str, once: bool = False) -> None:
        self._open(text_dialog(title, words, text, self._shell.dialog_parent, once))

    def _open(self, dialog: QDialog) -> None:
        self.dialog = dialog

        def ended() -> None:
            if self.dialog is dialog:
                self.dialog = None
            dialog.deleteLater()

        dialog.finished.connect(ended)
        dialog.open()


def _today() -> datetime.date:
    return datetime.datetime.now().astimezone().date()


def _documents() -> Path:
    documents = QStandardPaths.StandardLocation.DocumentsLocation
    return Path(QStandardPaths.writableLocation(documents))
