"""A course as a form: its exercises in a table, from nothing or from a plan that ships."""

from __future__ import annotations

import datetime
from collections.abc import Callable, Mapping, Sequence

from PySide6.QtCore import QDate, Qt
from PySide6.QtWidgets import (
    QComboBox,
    QDateEdit,
    QDialogButtonBox,
    QHBoxLayout,
    QLineEdit,
    QSpinBox,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.core.configuration import FieldProblem, checked
from app.exercises.guidance import Purpose
from app.exercises.schema import Exercise
from app.scoring.competence import RULE
from app.session.course import Course, CourseError
from app.session.course_plan import CoursePlan
from app.views.kit import theme
from app.views.kit.field_words import problem_words
from app.views.kit.form import Form
from app.views.kit.parts import button
from app.views.kit.settings_dialog import SettingsDialog
from app.views.kit.text import declared, listing, literal, tr
from app.views.kit.wheel import wheel_scrolls
from app.views.people.competence_marks import CompetenceRates
from app.views.people.dialogs import lead


class CourseDialog(SettingsDialog):
    """A course as a form: exercises in a table, each with version, attempts, purpose and days.

    Args:
        course: to be changed; None for a new one.
        exercises: that the library has, by id.
        take: takes the course; raises an AcusError if it cannot be taken.
        groups: that students are in.
        plans: that a new course can begin with.
        parent: window.
    """

    def __init__(
        self,
        course: Course | None,
        exercises: Mapping[str, Exercise],
        take: Callable[[Course], object],
        groups: Sequence[str] = (),
        plans: Sequence[CoursePlan] = (),
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(tr("Course"), (860, 520), QDialogButtonBox.StandardButton.Save, parent)
        self._take, self._exercises, self._known = take, exercises, tuple(groups)
        self.form = Form(Course, self)
        self.id = self.form.text("id", hint="autumn-2026", read=str.strip)
        self.title = self.form.text("title", read=str.strip)
        self.groups = self.form.text(
            "groups",
            hint=tr("separated by commas; empty: everybody"),
            read=_names_of,
            write=", ".join,
        )
        self.rates = CompetenceRates(self)
        show, read = self.rates.show_rule, self.rates.document
        title = tr("Competence")
        self.form.add(("competence",), title, self.rates, lambda rule: show(rule or RULE), read)
        self.ordered = self.form.check("ordered")
        self.offered = QComboBox(self)
        self.offered.setAccessibleName(tr("Exercise to add"))
        for identifier, exercise in exercises.items():
            self.offered.addItem(declared(exercise.title), identifier)
        self.add, self.remove = button(tr("Add")), button(tr("Remove"))
        titles = (tr("Exercise"), tr("Version"), tr("Attempts"), tr("Purpose"), tr("Opens"))
        self.items = QTableWidget(0, 6, self)
        self.items.setTabKeyNavigation(False)
        self.items.setAccessibleName(tr("Exercises"))
        self.items.setHorizontalHeaderLabels([*titles, tr("Closes")])
        self.items.verticalHeader().setDefaultSectionSize(theme.CONTROL_HEIGHT + 8)
        for place, width in enumerate((230, 80, 90, 120, 125, 125)):
            self.items.setColumnWidth(place, width)
        row = QHBoxLayout()
        row.addWidget(self.offered, 1)
        row.addWidget(self.add)
        row.addWidget(self.remove)
        column = QVBoxLayout(self)
        if course is None and plans:
            column.addLayout(self._beginning(plans))
        column.addWidget(self.form)
        column.addLayout(row)
        column.addWidget(self.items, 1)
        column.addWidget(self.note)
        column.addWidget(self.buttons)
        self.add.clicked.connect(lambda: self.add_item(self.offered.currentData()))
        self.remove.clicked.connect(lambda: self.items.removeRow(self.items.currentRow()))
        lead(self, *((self.id,) if course is None else ()), self.title, self.groups)
        if course is not None:
            self._show(course)

    def _beginning(self, plans: Sequence[CoursePlan]) -> QHBoxLayout:
        """Offer plans, and the day on which one begins."""
        self.plan, self.first = QComboBox(self), QDateEdit(QDate.currentDate(), self)
        self.plan.setAccessibleName(tr("Begin with"))
        self.plan.addItem(tr("nothing: an empty course"), None)
        for plan in plans:
            self.plan.addItem(declared(plan.title), plan)
            last = self.plan.count() - 1
            words = literal(declared(plan.description))
            self.plan.setItemData(last, words, Qt.ItemDataRole.ToolTipRole)
        self.first.setCalendarPopup(True)
        self.first.setDisplayFormat("yyyy-MM-dd")
        self.first.setToolTip(tr("First day of the course; its units are counted from it"))
        self.first.setAccessibleName(tr("First day"))
        fill = button(tr("Fill in"))
        fill.setToolTip(
            tr("Put the plan's exercises and days into the form, in place of what is there")
        )
        fill.clicked.connect(self._fill)
        row = QHBoxLayout()
        for widget, stretch in ((self.plan, 1), (self.first, 0), (fill, 0)):
            row.addWidget(widget, stretch)
        return row

    def _fill(self) -> None:
        """Take title, order and units of the chosen plan; file name and groups stay if given."""
        plan = self.plan.currentData()
        self.items.setRowCount(0)
        if not isinstance(plan, CoursePlan):
            return
        first = self.first.date()
        course = plan.begun(datetime.date(first.year(), first.month(), first.day()))
        if not self.id.text().strip():
            self.id.setText(course.id)
        self.title.setText(declared(course.title))
        self.ordered.setChecked(course.ordered)
        for item in course.items:
            days = [str(day) if day else "" for day in (item.opens, item.closes)]
            self.add_item(item.exercise, 0, item.attempts or 0, item.purpose, *days)

    def add_item(
        self,
        exercise: str,
        version: int = 0,
        attempts: int = 0,
        purpose: Purpose | None = None,
        opens: str = "",
        closes: str = "",
    ) -> None:
        """Add an exercise at the end.

        Version 0 pins the one that the library has now; without a purpose it has the exercise's.
        """
        known = self._exercises.get(exercise)
        if purpose is None:
            purpose = known.purpose if known else Purpose.PRACTICE
        row = self.items.rowCount()
        self.items.insertRow(row)
        name = QTableWidgetItem(known.title if known else exercise)
        name.setData(Qt.ItemDataRole.UserRole, exercise)
        name.setToolTip(literal(exercise))
        name.setFlags(name.flags() & ~Qt.ItemFlag.ItemIsEditable)
        self.items.setItem(row, 0, name)
        pinned = QSpinBox()
        pinned.setRange(1, 9999)
        pinned.setValue(version or (known.version if known else 1))
        allowed = QSpinBox()
        allowed.setRange(0, 999)
        allowed.setSpecialValueText(tr("any"))
        allowed.setValue(attempts)
        kind = QComboBox()
        kind.addItem(tr("practice"), Purpose.PRACTICE.value)
        kind.addItem(tr("assessment"), Purpose.ASSESSMENT.value)
        kind.setCurrentIndex(kind.findData(purpose.value))
        for column, widget in enumerate((pinned, allowed, kind), 1):
            self.items.setCellWidget(row, column, widget)
            wheel_scrolls(widget)
        for column, text in ((4, opens), (5, closes)):
            day = QLineEdit(text)
            day.setPlaceholderText(tr("any day"))
            day.setToolTip(tr("A day as year-month-day, such as 2026-11-30; empty: any"))
            self.items.setCellWidget(row, column, day)

    def course(self) -> Course:
        """Return the course as it stands in the form.

        Raises:
            CourseError: naming the field as the form does, its value and what would be valid.
        """
        items = [self._item(row) for row in range(self.items.rowCount())]
        course, problems = checked({**self.form.values(), "items": items}, Course)
        if course is None:
            raise self._refused(problems[0])
        return course

    def _refused(self, problem: FieldProblem) -> CourseError:
        """Say what is wrong with a field as the form calls it, and put the cursor there."""
        place, words = problem.field, problem_words(problem)
        first = str(place[0]) if place else ""
        label, field = self.form.names.get((first,)), self.form.fields.get((first,))
        name = tr("Course") if label is None else label.text()
        if first == "items" and len(place) > 1:
            row, key = int(place[1]), str(place[2]) if len(place) > 2 else ""
            column = ("exercise", "version", "attempts", "purpose", "opens", "closes")
            at = column.index(key) if key in column else 0
            item, head = self.items.item(row, 0), self.items.horizontalHeaderItem(at)
            parts = ("" if item is None else item.text(), head.text() if at and head else "")
            name = ", ".join(filter(None, parts))
            self.items.setCurrentCell(row, at)
            cell = self.items.cellWidget(row, at)
            (self.items if cell is None else cell).setFocus()
        elif field is not None:
            field.setFocus()
        return CourseError(f"{name}: {words}")

    def check(self) -> None:
        """Read the form; refuse groups that nobody is in."""
        course = self.course()
        unknown = [name for name in course.groups if name not in self._known]
        if unknown:
            self.groups.setFocus()
            there = (
                tr("there are: {names}", names=listing(self._known))
                if self._known
                else tr("there are none yet: add students with their groups first")
            )
            raise CourseError(
                tr(
                    "Groups: no student is in {name}; {there}. Empty means everybody.",
                    name=unknown[0],
                    there=there,
                )
            )

    def keep(self) -> None:
        """Hand the course on; a name that is taken is typed anew."""
        try:
            self._take(self.course())
        except CourseError:
            self.id.setFocus()
            self.id.selectAll()
            raise

    def _item(self, row: int) -> dict[str, object]:
        name = self.items.item(row, 0)
        found: dict[str, object] = {
            "exercise": "" if name is None else name.data(Qt.ItemDataRole.UserRole)
        }
        for column, key in ((1, "version"), (2, "attempts")):
            widget = self.items.cellWidget(row, column)
            if isinstance(widget, QSpinBox) and widget.value():
                found[key] = widget.value()
        kind = self.items.cellWidget(row, 3)
        if isinstance(kind, QComboBox):
            found["purpose"] = kind.currentData()
        for column, key in ((4, "opens"), (5, "closes")):
            day = self.items.cellWidget(row, column)
            if isinstance(day, QLineEdit) and day.text().strip():
                found[key] = day.text().strip()
        return found

    def _show(self, course: Course) -> None:
        self.form.show_values(dict(course))
        self.id.setReadOnly(True)
        for item in course.items:
            days = [str(day) if day else "" for day in (item.opens, item.closes)]
            self.add_item(item.exercise, item.version, item.attempts or 0, item.purpose, *days)


def _names_of(text: str) -> tuple[str, ...]:
    return tuple(name.strip() for name in text.split(",") if name.strip())
