"""The board of progress: students by exercises, and what of it leaves the program."""

from __future__ import annotations

import datetime
from collections.abc import Mapping, Sequence
from typing import Final

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QAction, QColor, QKeySequence
from PySide6.QtWidgets import (
    QAbstractItemView,
    QCheckBox,
    QComboBox,
    QHBoxLayout,
    QLabel,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.scoring.competence import CompetenceState
from app.session.board import BoardCell, ProgressBoard
from app.session.course import Course
from app.views.kit import theme
from app.views.kit.names import NAMES
from app.views.kit.parts import PlainLabel, button, label, table
from app.views.kit.text import literal, tr, tr_n
from app.views.people.competence_marks import MARKS, competence_line, mark_words, rule_words

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
            top.addWidget(widget, int(widget is self.form))
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
        _show_words(self.store, line)

    def show_lrs(self, line: str) -> None:
        """Say how it stands with the learning record store; empty where there is none."""
        _show_words(self.lrs, line)

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


def _show_words(shown: QLabel, line: str) -> None:
    shown.setText(literal(line))
    shown.setVisible(bool(line))
