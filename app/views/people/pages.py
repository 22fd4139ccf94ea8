"""The page of people: the board of progress, students and groups, courses."""

from __future__ import annotations

import datetime
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from typing import Final

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import (
    QAction,
    QColor,
    QGuiApplication,
    QKeySequence,
    QShortcut,
)
from PySide6.QtWidgets import (
    QAbstractItemView,
    QCheckBox,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPlainTextEdit,
    QTableWidgetItem,
    QTabWidget,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.core.errors import AcusError
from app.exercises.guidance import Purpose
from app.scoring.competence import CompetenceState
from app.session.board import BoardCell, ProgressBoard
from app.session.course import Course, CourseStanding, next_of_course
from app.session.people import Person
from app.views.kit import theme
from app.views.kit.names import NAMES
from app.views.kit.parts import PlainLabel, add_row, button, label, table
from app.views.kit.settings_dialog import SettingsDialog
from app.views.kit.text import listing, literal, tr, tr_n, translated
from app.views.kit.verdict import Verdict, tell
from app.views.people.competence_marks import (
    MARKS,
    competence_line,
    mark_words,
    rule_words,
)

_DAY: Final = 24 * 60  # min
_LEVEL: Final = 0.5
"""A trend of less than this many points a time is level."""


def cell_words(cell: BoardCell) -> str:
    """Say how a student stands: best, last, trend, time since."""
    void = tr(" · {n} void", n=len(cell.void)) if cell.void else ""
    near = tr(" · near the mark") if cell.near_mark else ""
    if not cell.attempts or cell.best is None or cell.last is None or cell.since is None:
        return "–" if not cell.others else tr("– ({n} not counted)", n=cell.others) + void
    arrow = ""
    if cell.trend is not None:
        arrow = " ↗" if cell.trend > _LEVEL else " ↘" if cell.trend < -_LEVEL else " →"
    passed = "✔ " if cell.passed else ""
    return tr(
        "{passed}best {best:.0f}, last {last:.0f}{arrow} · {since}{void}   ",
        passed=passed,
        best=cell.best,
        last=cell.last,
        arrow=arrow,
        since=since_words(cell.since),
        void=near + void,
    )


def since_words(since: datetime.timedelta) -> str:
    """Say how long ago something was."""
    minutes = since.total_seconds() / 60.0
    if minutes < 2.0:
        return tr("just now")
    if minutes < 60.0:
        return tr("{n} min ago", n=int(minutes))
    if minutes < _DAY:
        return tr("{n} h ago", n=int(minutes / 60.0))
    return tr("{n} d ago", n=int(minutes / _DAY))


def cell_details(cell: BoardCell) -> str:
    """Say the rest of a cell: how many count, the trend, what does not count and why."""
    lines = [tr_n("{n} attempt counts", "{n} attempts count", cell.attempts)]
    if cell.near_mark:
        lines.append(tr("The best is within the error of measurement of the mark."))
    if cell.trend is not None:
        lines.append(tr("trend {trend:+.1f} points a time", trend=cell.trend))
    lines += [tr("{n} not counted: {why}", n=n, why=why) for why, n in cell.why]
    lines += [tr("void: {why}", why=why) for why in cell.void]
    return "\n".join(lines)


GROUP_PDF, STUDENT_PDF = "group-pdf", "student-pdf"
"""Forms of results that Qt draws, beside those of `exchange.results`."""


class BoardTab(QWidget):
    """Students by exercises.

    Signals:
        choice_changed(): another course or group.
        curve_wanted(str, str): key of a student, id of an exercise.
        attempts_wanted(str, str): likewise; of all exercises where the id is empty.
        export_wanted(str): a form of `exchange.results`, or a report.
    """

    choice_changed = Signal()
    curve_wanted = Signal(str, str)
    attempts_wanted = Signal(str, str)
    export_wanted = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.course, self.group = QComboBox(self), QComboBox(self)
        self.table = table((tr("Student"),))
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectItems)
        self.table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.table.setAccessibleName(tr("Progress"))
        self.curve = self._action(tr("Curve"), "Return", tr("Points over the attempts (Enter)"))
        self.attempts = self._action(
            tr("Attempts…"), "Ctrl+Return", tr("List them: debrief, replay, remarks (Ctrl+Enter)")
        )
        self.reliability = self._action(
            tr("How far scores can be relied on…"), "Ctrl+Shift+G", tr("G, Phi, agreement")
        )
        self.hint = label("", "dim")
        self.board: ProgressBoard | None = None
        self.form, self.export = QComboBox(self), button(tr("Export…"))
        self.form.setAccessibleName(tr("Form of the results"))
        # Its longest entry would make the page wider than a small screen; the list shows it whole.
        self.form.setSizeAdjustPolicy(
            QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        )
        self.form.setMinimumContentsLength(14)
        for title, name in (
            (tr("Table, a row for each metric (CSV)"), "tidy"),
            (tr("Table, a row for each student (CSV)"), "wide"),
            (tr("Gradebook for Moodle (CSV)"), "moodle"),
            (tr("Everything (JSON)"), "json"),
            (tr("Report of the group (PDF)"), GROUP_PDF),
            (tr("Report of the student chosen (PDF)"), STUDENT_PDF),
        ):
            self.form.addItem(title, name)
        self.semicolons = QCheckBox(tr("Decimal comma"), self)
        self.semicolons.setToolTip(
            tr("Semicolons and decimal commas: as Excel opens them where the comma is the sign")
        )
        top = QHBoxLayout()
        self._of_group = PlainLabel(tr("Group"), self)
        for words, box in (
            (PlainLabel(tr("Course"), self), self.course),
            (self._of_group, self.group),
        ):
            box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
            box.setAccessibleName(words.text())
            top.addWidget(words)
            top.addWidget(box)
        top.addStretch(1)
        self.stations = button(tr("Stations"))
        self.stations.setToolTip(tr("Bring the results of several stations together"))
        self._leaving = (self.form, self.semicolons, self.export, self.stations)
        for widget in self._leaving:
            top.addWidget(widget)
        column = QVBoxLayout(self)
        column.addLayout(top)
        column.addWidget(self.table, 1)
        self.store = label("", "dim")
        self.store.hide()
        column.addWidget(self.store)
        self.lrs = label("", "dim")
        self.lrs.hide()
        column.addWidget(self.lrs)
        below = QHBoxLayout()
        below.addWidget(self.hint, 1)
        self.buttons = tuple(button(action.text()) for action in (self.curve, self.attempts))
        for shown, action in zip(self.buttons, (self.curve, self.attempts), strict=True):
            shown.setToolTip(literal(action.toolTip()))
            shown.clicked.connect(action.trigger)
            below.addWidget(shown)
        column.addLayout(below)
        for box in (self.course, self.group):
            box.activated.connect(lambda _: self.choice_changed.emit())
        self.export.clicked.connect(lambda: self.export_wanted.emit(self.form.currentData()))
        self.table.cellDoubleClicked.connect(self._open)
        self.table.itemSelectionChanged.connect(self._enable)
        self.curve.triggered.connect(
            lambda: self._open(self.table.currentRow(), self.table.currentColumn())
        )
        self.attempts.triggered.connect(lambda: self._list())
        self._enable()

    def set_choices(self, courses: Sequence[Course], groups: Sequence[str]) -> None:
        """Offer courses and groups; what was chosen stays where it is still there."""
        offered = (
            (self.course, [("", tr("All exercises")), *((c.id, c.title) for c in courses)]),
            (self.group, [("", tr("Everybody")), *((name, name) for name in groups)]),
        )
        for box, entries in offered:
            before = box.currentData()
            box.clear()
            for value, title in entries:
                box.addItem(title, value)
            box.setCurrentIndex(max(0, box.findData(before)))

    def show_store(self, line: str) -> None:
        """Say how it stands with the school's store; empty where there is none."""
        _show_line(self.store, line)

    def show_lrs(self, line: str) -> None:
        """Say how it stands with the learning record store; empty where there is none."""
        _show_line(self.lrs, line)

    def set_leaving(self, may: bool) -> None:
        """Offer exports, and the choice of a group, or neither."""
        for widget in (*self._leaving, self._of_group, self.group, self.reliability):
            widget.setVisible(may)

    def show_board(self, board: ProgressBoard, titles: Mapping[str, str]) -> None:
        """Show a board; `titles` of exercises by id."""
        self.board = board
        names = [titles.get(item.exercise, item.exercise) for item in board.items]
        self.table.setColumnCount(1 + len(names))
        self.table.setHorizontalHeaderLabels([tr("Student"), *names])
        self.table.setRowCount(len(board.students))
        for row, person in enumerate(board.students):
            self.table.setRowHeight(row, theme.CONTROL_HEIGHT + theme.SPACING)
            self.table.setItem(row, 0, QTableWidgetItem(NAMES.shown(person.pseudonym)))
            for place, item in enumerate(board.items, 1):
                cell = board.cells[person.key, item.exercise]
                place_of = (person.key, item.exercise)
                mark = mark_words(board, *place_of)
                texts = (cell_words(cell).rstrip(), mark)
                shown = QTableWidgetItem(" · ".join(filter(None, texts)) + "   ")
                details = (competence_line(board, *place_of), cell_details(cell))
                shown.setToolTip(literal("\n".join(filter(None, details))))
                if cell.passed:
                    relapsed = mark.startswith(MARKS[CompetenceState.RELAPSE])
                    colour = theme.WARNING if relapsed else theme.GOOD
                    shown.setForeground(QColor(theme.now(colour)))
                self.table.setItem(row, place, shown)
        self.hint.setToolTip(literal(rule_words(board)) if board.items else "")
        self.hint.setText(
            tr("Nobody yet: add students, or a roster, on the next tab.")
            if not board.students
            else tr("Nothing yet: attempts of students who signed in will appear here.")
            if not board.items
            else tr(
                "Only attempts that may be compared; none of a script or an emulated robot. "
                "Double-click a cell for its curve, a student for all attempts."
            )
        )
        self._enable()

    def _action(self, text: str, keys: str, tip: str) -> QAction:
        action = QAction(text, self.table)
        action.setShortcut(QKeySequence(keys))
        action.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
        action.setToolTip(literal(tip))
        self.table.addAction(action)
        self.table.setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)
        return action

    def _chosen(self) -> tuple[str, str] | None:
        """Return the student, and the exercise or none for all, of the cell that is chosen."""
        row, column = self.table.currentRow(), self.table.currentColumn()
        board = self.board
        if board is None or not self.table.selectedItems() or row >= len(board.students):
            return None
        return board.students[row].key, board.items[column - 1].exercise if column > 0 else ""

    def _enable(self) -> None:
        chosen = self._chosen()
        self.attempts.setEnabled(chosen is not None)
        self.curve.setEnabled(chosen is not None and bool(chosen[1]))
        for shown, action in zip(self.buttons, (self.curve, self.attempts), strict=True):
            shown.setEnabled(action.isEnabled())

    def _list(self) -> None:
        chosen = self._chosen()
        if chosen is not None:
            self.attempts_wanted.emit(*chosen)

    def _open(self, row: int, column: int) -> None:
        if self.board is None or not 0 <= row < len(self.board.students):
            return
        student = self.board.students[row]
        if column > 0:
            self.curve_wanted.emit(student.key, self.board.items[column - 1].exercise)
        else:
            self.attempts_wanted.emit(student.key, "")


class StudentsTab(QWidget):
    """Who is known: a list to read, and what is done with who is chosen."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.people: list[Person] = []
        self.table = table((tr("Pseudonym"), tr("Groups"), tr("Name")), selectable=True)
        self.table.setAccessibleName(tr("Students"))
        self.add, self.roster = button(tr("Add…"), "primary"), button(tr("Roster from CSV…"))
        self.pin, self.erase = button(tr("New PIN")), button(tr("Erase…"))
        self._hint = label("", "dim")
        row = QHBoxLayout()
        for widget in (self.add, self.roster, self.pin, self.erase):
            row.addWidget(widget)
        row.addStretch(1)
        column = QVBoxLayout(self)
        column.addWidget(self.table, 1)
        column.addWidget(self._hint)
        column.addLayout(row)
        self.table.itemSelectionChanged.connect(self._enable)
        self._enable()

    def show_people(self, people: Sequence[Person]) -> None:
        """Show students."""
        self.people = list(people)
        self.table.setRowCount(len(self.people))
        for row, person in enumerate(self.people):
            words = (person.pseudonym, ", ".join(person.groups), person.name)
            for column, text in enumerate(words):
                self.table.setItem(row, column, QTableWidgetItem(NAMES.shown(text)))
        self._hint.setText(
            "" if people else tr("No students yet. A roster is CSV: pseudonym, name, pin, group.")
        )
        self._enable()

    def chosen(self) -> Person | None:
        """Return the student who is chosen."""
        rows = {index.row() for index in self.table.selectionModel().selectedRows()}
        return self.people[min(rows)] if rows else None

    def _enable(self) -> None:
        for widget in (self.pin, self.erase):
            widget.setEnabled(self.chosen() is not None)


class CoursesTab(QWidget):
    """The courses with their exercises, what is left of each, and what is done with them.

    Signals:
        begin_wanted(CourseStanding): begin this exercise.
        release_wanted(Course): release the results that wait in it.
    """

    begin_wanted = Signal(object)
    release_wanted = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.courses: list[Course] = []
        self._standings: Mapping[str, Sequence[CourseStanding]] = {}
        self._waiting: Mapping[str, Sequence[str]] = {}
        self._manages = True
        self.tree = QTreeWidget(self)
        self.tree.setAccessibleName(tr("Courses"))
        self.tree.setHeaderLabels(
            [tr("Exercise"), tr("Purpose"), tr("Attempts"), tr("Dates"), tr("Now")]
        )
        self.tree.setAlternatingRowColors(True)
        self.tree.setExpandsOnDoubleClick(False)
        self.begin = button(tr("Begin"), "primary")
        self.new, self.edit = button(tr("New course…")), button(tr("Edit…"))
        self.release = button(tr("Release results…"))
        self.release.setToolTip(tr("Let students see the results of this course that wait"))
        self.broken = label("", "dim")
        row = QHBoxLayout()
        for widget in (self.begin, self.new, self.edit, self.release):
            row.addWidget(widget)
        row.addStretch(1)
        column = QVBoxLayout(self)
        column.addWidget(self.tree, 1)
        column.addWidget(self.broken)
        column.addLayout(row)
        self.tree.currentItemChanged.connect(lambda *_: self._enable())
        self.tree.itemDoubleClicked.connect(lambda *_: self._activate())
        for key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            enter = QShortcut(QKeySequence(key), self.tree, lambda: self._activate())
            enter.setContext(Qt.ShortcutContext.WidgetShortcut)
        self.begin.clicked.connect(lambda: self._begin())
        self.release.clicked.connect(lambda: self.release_wanted.emit(self.chosen()))
        self._enable()

    def set_managing(self, may: bool) -> None:
        """Let courses be made and changed, or only done."""
        self._manages = may
        for widget in (self.new, self.edit, self.release):
            widget.setVisible(may)

    def show_courses(
        self,
        courses: Sequence[Course],
        broken: Sequence[str],
        standings: Mapping[str, Sequence[CourseStanding]],
        waiting: Mapping[str, Sequence[str]],
    ) -> None:
        """Show courses, how who is here stands in them, and what cannot be used.

        Args:
            courses: by title.
            broken: files that cannot be used, one line each.
            standings: by id of the course.
            waiting: attempts whose results wait for their release, likewise.
        """
        before = self._place()
        self.courses = list(courses)
        self._standings, self._waiting = standings, waiting
        self.tree.clear()
        for course in courses:
            who = listing(course.groups) or tr("everybody")
            ordered = tr(", in order") if course.ordered else ""
            held = len(waiting.get(course.id, ()))
            waits = (
                tr_n("{n} result waits for its release", "{n} results wait for their release", held)
                if held
                else ""
            )
            top = QTreeWidgetItem([course.title, f"{who}{ordered}", "", "", waits])
            self.tree.addTopLevelItem(top)
            comes = next_of_course(standings.get(course.id, ()))
            for standing in standings.get(course.id, ()):
                row = QTreeWidgetItem(standing_words(standing, standing is comes))
                if standing.passed:
                    row.setForeground(4, QColor(theme.now(theme.GOOD)))
                elif standing.refusal:
                    row.setForeground(4, QColor(theme.now(theme.TEXT_DIM)))
                top.addChild(row)
            if not course.items:
                top.addChild(QTreeWidgetItem([tr("no exercises yet")]))
        self.tree.expandAll()
        for column in range(4):
            self.tree.resizeColumnToContents(column)
        self._go_to(before)
        none = tr("No courses yet: a course is exercises in order, for groups, with dates.")
        if not self._manages:
            none = tr("You take no course. Exercises are on the start page.")
        self.broken.setText("\n".join(broken) or ("" if courses else none))
        self.broken.setVisible(bool(self.broken.text()))
        self._enable()

    def chosen(self) -> Course | None:
        """Return the course that is chosen, or that an exercise is chosen of."""
        course, _ = self._place()
        return next((one for one in self.courses if one.id == course), None)

    def standing(self) -> CourseStanding | None:
        """Return the exercise that is chosen, else the one that comes next in the course."""
        course, at = self._place()
        found = self._standings.get(course, ())
        if 0 <= at < len(found):
            return found[at]
        return next_of_course(found)

    def _place(self) -> tuple[str, int]:
        """Return the id of the course that is chosen, and the number of the exercise; or -1."""
        item = self.tree.currentItem()
        if item is None:
            return "", -1
        parent = item.parent()
        top = item if parent is None else parent
        course = self.courses[self.tree.indexOfTopLevelItem(top)].id
        return course, -1 if parent is None else parent.indexOfChild(item)

    def _go_to(self, place: tuple[str, int]) -> None:
        """Choose what was chosen, or the first course."""
        course, at = place
        ids = [one.id for one in self.courses]
        top = self.tree.topLevelItem(ids.index(course) if course in ids else 0)
        if top is not None:
            inner = top.child(at) if at >= 0 else None
            self.tree.setCurrentItem(inner or top)

    def _enable(self) -> None:
        course, standing = self.chosen(), self.standing()
        self.edit.setEnabled(course is not None)
        held = len(self._waiting.get(course.id, ())) if course is not None else 0
        self.release.setEnabled(held > 0)
        self.begin.setEnabled(course is not None and bool(course.items))
        title = standing.title if standing is not None else ""
        self.begin.setText(tr("Begin: {title}", title=title) if title else tr("Begin"))
        nothing = tr("nothing is left to be begun")
        why = translated(standing.refusal) if standing is not None else nothing
        self.begin.setToolTip(literal(why or tr("Briefing first, then the attempt (Enter)")))

    def _activate(self) -> None:
        """Do what a double click means: change a course, or begin an exercise."""
        if self._manages and self._place()[1] < 0:
            self.edit.click()
        else:
            self._begin()

    def _begin(self) -> None:
        course, standing = self.chosen(), self.standing()
        if standing is not None:
            self.begin_wanted.emit(standing)
        elif course is not None and course.items:
            refused = [one for one in self._standings.get(course.id, ()) if one.refusal]
            if refused:
                self.begin_wanted.emit(refused[0])


def standing_words(standing: CourseStanding, comes: bool) -> list[str]:
    """Say how somebody stands in an exercise of a course: the cells of its row."""
    item = standing.item
    purpose = tr("assessment") if item.purpose is Purpose.ASSESSMENT else tr("practice")
    attempts = tr("any number") if item.attempts is None else str(item.attempts)
    if item.attempts is not None and standing.used is not None:
        left = max(0, item.attempts - standing.used)
        attempts = tr("{left} of {n} left", left=left, n=item.attempts)
    elif standing.used is not None:
        attempts = tr("{used} done, any number", used=standing.used)
    days = ""
    if item.opens and item.closes:
        days = tr("{a} to {b}", a=item.opens, b=item.closes)
    elif item.opens:
        days = tr("from {a}", a=item.opens)
    elif item.closes:
        days = tr("until {b}", b=item.closes)
    now = []
    if standing.passed:
        now.append(tr("✔ passed"))
    if standing.best is not None:
        now.append(tr("best {best:.0f}", best=standing.best))
    if standing.held:
        now.append(tr("result not released"))
    if standing.refusal:
        now.append(translated(standing.refusal))
    elif comes and standing.used is not None:
        now.append(tr("▶ next"))
    return [standing.title, purpose, attempts, days, " · ".join(now)]


class PeoplePage(QWidget):
    """Board, students and courses as tabs.

    Signals:
        closed(): back to where the user came from.
    """

    closed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.board, self.students, self.courses = BoardTab(), StudentsTab(), CoursesTab()
        self.tabs = QTabWidget(self)
        self.tabs.addTab(self.board, tr("Progress"))
        self.tabs.addTab(self.students, tr("Students"))
        self.tabs.addTab(self.courses, tr("Courses"))
        heading = label(tr("People"), "title")
        back = button(tr("Back"))
        back.clicked.connect(self.closed)
        row = QHBoxLayout()
        row.addWidget(back)
        row.addStretch(1)
        column = QVBoxLayout(self)
        column.addWidget(heading)
        column.addWidget(self.tabs, 1)
        column.addLayout(row)

    def set_managing(self, may: bool) -> None:
        """Show students to who may change them, else the own progress and courses alone."""
        self.tabs.setTabVisible(self.tabs.indexOf(self.students), may)
        self.courses.set_managing(may)
        self.board.set_leaving(may)
        if not may and self.tabs.currentWidget() is self.students:
            self.tabs.setCurrentWidget(self.board)


def lead(dialog: QDialog, *fields: QWidget) -> None:
    """Let a dialog open with the cursor in the first of its fields, and Tab go through them."""
    for one, following in pairwise(fields):
        QWidget.setTabOrder(one, following)
    for first in fields[:1]:
        first.setFocus()


class EntryDialog(SettingsDialog):
    """A form of lines that are taken together; what is wrong is said below.

    Args:
        title: of the dialog.
        fields: name, and whether it is hidden while it is typed.
        take: takes the entries; raises an AcusError if they cannot be.
        words: what is to be known, above the form.
        parent: window.
    """

    def __init__(
        self,
        title: str,
        fields: Sequence[tuple[str, bool]],
        take: Callable[..., object],
        words: str = "",
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(title, (460, 0), QDialogButtonBox.StandardButton.Ok, parent)
        self._take = take
        self.lines = [QLineEdit(self) for _ in fields]
        self.form = form = QFormLayout()
        for line, (name, hidden) in zip(self.lines, fields, strict=True):
            add_row(form, name, line)
            line.setAccessibleName(name)
            if hidden:
                line.setEchoMode(QLineEdit.EchoMode.Password)
        self.names = [name for name, _ in fields]
        lead(self, *self.lines)
        column = QVBoxLayout(self)
        if words:
            column.addWidget(label(words, "dim"))
        column.addLayout(form)
        column.addWidget(self.note)
        column.addWidget(self.buttons)

    def check(self) -> None:
        """Everything is checked when it is taken."""

    def keep(self) -> None:
        """Take the entries; where one was wrong the cursor stands in it, and nothing is lost."""
        try:
            self._take(*(line.text() for line in self.lines))
        except AcusError as error:
            wrong = self._wrong(translated(error))
            wrong.setFocus()
            wrong.selectAll()
            raise

    def _wrong(self, message: str) -> QLineEdit:
        """Return the line that a message names, secrets first, else the first secret, or line."""
        ordered = sorted(
            zip(self.names, self.lines, strict=True),
            key=lambda one: one[1].echoMode() is not QLineEdit.EchoMode.Password,
        )
        named = (line for name, line in ordered if name.casefold() in message.casefold())
        return next(named, ordered[0][1])


class OnceDialog(QDialog):
    """Something that is shown once only: it closes when somebody says that it is written down.

    Attributes:
        written: says so.
    """

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.written = QCheckBox(tr("I have written it down"), self)
        self.asked = label()

    def reject(self) -> None:
        """Close, unless nobody has said that it is written down: then ask."""
        if self.written.isChecked():
            super().reject()
            return
        why = tr("It is shown this once only: write it down, tick the box, then close.")
        tell(self.asked, Verdict.WARNING, why)
        self.written.setFocus()


def text_dialog(title: str, words: str, text: str, parent: QWidget, once: bool = False) -> QDialog:
    """Return a dialog with text to copy or write down: a recovery key, PINs, errors.

    Args:
        title: of the dialog.
        words: what it is.
        text: to be copied.
        parent: window.
        once: whether it is shown this once only, so that it closes only when it is written down.
    """
    dialog = OnceDialog(parent) if once else QDialog(parent)
    dialog.setWindowTitle(title)
    dialog.resize(560, 360)
    shown = QPlainTextEdit(text)
    shown.setReadOnly(True)
    buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
    copied = button(tr("Copy"))
    copied.setToolTip(tr("Copy the text, to print it or to keep it elsewhere"))
    copied.clicked.connect(lambda: QGuiApplication.clipboard().setText(text))
    buttons.addButton(copied, QDialogButtonBox.ButtonRole.ActionRole)
    buttons.rejected.connect(dialog.reject)
    column = QVBoxLayout(dialog)
    column.addWidget(label(words))
    column.addWidget(shown, 1)
    if isinstance(dialog, OnceDialog):
        column.addWidget(dialog.written)
        column.addWidget(dialog.asked)
    column.addWidget(buttons)
    return dialog


def _show_line(shown: QLabel, line: str) -> None:
    shown.setText(literal(line))
    shown.setVisible(bool(line))
