"""The page of people: progress, students and groups, courses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor, QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QHBoxLayout,
    QTableWidgetItem,
    QTabWidget,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.exercises.guidance import Purpose
from app.session.course import Course, CourseStanding, next_of_course
from app.session.people import Person
from app.views.kit import theme
from app.views.kit.names import NAMES
from app.views.kit.parts import button, label, table
from app.views.kit.text import listing, literal, tr, tr_n, translated
from app.views.people.board import BoardTab


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
