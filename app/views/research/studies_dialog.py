"""Research studies of this station: who is due, and a questionnaire for one of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import date
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QDialog,
    QHBoxLayout,
    QHeaderView,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.views.kit.parts import PlainLabel, button, label, size_dialog
from app.views.kit.text import day, tr


@dataclass(frozen=True)
class StudyLook:
    """Where a study stands.

    Attributes:
        status: as `research.status.status_of` gives it.
        students: pseudonyms of who takes part and has not left.
        visits: names.
    """

    status: dict[str, Any]
    students: tuple[str, ...]
    visits: tuple[str, ...]

    @property
    def words(self) -> str:
        """Say how many take part."""
        one = self.status
        return tr(
            "{study}: {enrolled} of {participants} enrolled, {left} left",
            study=one["study"],
            enrolled=one["enrolled"],
            participants=one["participants"],
            left=one["left"],
        )


class StudiesDialog(QDialog):
    """Due visits, the one that closes first first; below a questionnaire to be answered.

    Signals:
        wanted(str, str, str, str): study, pseudonym, visit, questionnaire.

    Args:
        studies: that have begun here.
        questionnaires: titles by id.
        parent: window.
    """

    wanted = Signal(str, str, str, str)

    def __init__(
        self, studies: Sequence[StudyLook], questionnaires: Mapping[str, str], parent: QWidget
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Research studies"))
        size_dialog(self, 820, 460)
        self._studies = {one.status["study"]: one for one in studies}
        due = [(one.status["study"], row) for one in studies for row in one.status["due"]]
        self._due = sorted(due, key=lambda pair: (pair[1]["closes"], pair[1]["pseudonym"]))
        self.table = self._filled()
        self.study, self.student = QComboBox(), QComboBox()
        self.visit, self.questionnaire = QComboBox(), QComboBox()
        self.visit.setPlaceholderText(tr("choose"))
        self.ask = button(tr("Answer…"))
        self.ask.setToolTip(tr("The student answers in the window that opens; nobody sees the arm"))
        close = button(tr("Close"))
        names = (tr("Study"), tr("Student"), tr("Visit"), tr("Questionnaire"))
        boxes = (self.study, self.student, self.visit, self.questionnaire)
        row = QHBoxLayout()
        for name, box in zip(names, boxes, strict=True):
            box.setAccessibleName(name)
            row.addWidget(PlainLabel(name))
            row.addWidget(box, 1)
        row.addWidget(self.ask)
        row.addWidget(close)
        heads = "\n".join(one.words for one in studies)
        nothing = tr("No study has begun here: Research studies in the help says how one begins.")
        column = QVBoxLayout(self)
        column.addWidget(label(heads or nothing, "dim"))
        column.addWidget(self.table, 1)
        column.addLayout(row)
        self.study.addItems(list(self._studies))
        for name, title in questionnaires.items():
            self.questionnaire.addItem(title, name)
        self._follow()
        self.study.currentTextChanged.connect(self._follow)
        for box in boxes:
            box.currentIndexChanged.connect(self._allow)
        self.table.itemSelectionChanged.connect(self._choose)
        self.table.itemActivated.connect(lambda _: self.ask.click())
        self.ask.clicked.connect(self._ask)
        close.clicked.connect(self.reject)
        open_now = [line for line, (_, one) in enumerate(self._due) if one["open"]]
        if open_now:
            self.table.selectRow(open_now[0])
        self._allow()

    def _filled(self) -> QTableWidget:
        heads = (tr("Study"), tr("Student"), tr("Visit"), tr("From"), tr("Until"), tr("Attempts"))
        table = QTableWidget(len(self._due), len(heads))
        table.setAccessibleName(tr("Visits that are due"))
        table.setHorizontalHeaderLabels(heads)
        table.verticalHeader().hide()
        table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        table.horizontalHeader().setStretchLastSection(True)
        for line, (study, one) in enumerate(self._due):
            made = tr("{made} of {wanted}", made=one["attempts"], wanted=one["wanted"])
            if one["late"]:
                made = tr("{made}, late", made=made)
            elif not one["open"]:
                made = tr("{made}, not open yet", made=made)
            whose = (study, one["pseudonym"], one["visit"])
            cells = (
                *whose,
                *(day(date.fromisoformat(one[name])) for name in ("opens", "closes")),
                made,
            )
            for place, words in enumerate(cells):
                cell = QTableWidgetItem(words)
                cell.setFlags(Qt.ItemFlag.ItemIsSelectable | Qt.ItemFlag.ItemIsEnabled)
                used = cell.font()
                used.setBold(bool(one["open"]))
                cell.setFont(used)
                table.setItem(line, place, cell)
        return table

    def _follow(self) -> None:
        """Offer students and visits of the study that is chosen."""
        look = self._studies.get(self.study.currentText())
        for box, some in (
            (self.student, look.students if look else ()),
            (self.visit, look.visits if look else ()),
        ):
            box.clear()
            box.addItems(list(some))
        self.visit.setCurrentIndex(-1)  # what is kept cannot be changed: nobody chooses by chance

    def _allow(self) -> None:
        """Let a questionnaire be answered once it is chosen whose, and of which visit."""
        self.ask.setEnabled(all(self._chosen()))

    def _choose(self) -> None:
        """Take study, student and visit of the row."""
        line = self.table.currentRow()
        if 0 <= line < len(self._due):
            study, one = self._due[line]
            self.study.setCurrentText(study)
            self.student.setCurrentText(one["pseudonym"])
            self.visit.setCurrentText(one["visit"])

    def _ask(self) -> None:
        self.wanted.emit(*self._chosen())

    def _chosen(self) -> list[str]:
        boxes = (self.study, self.student, self.visit)
        return [*(box.currentText() for box in boxes), self.questionnaire.currentData() or ""]
