"""Competence on the board, in a student's curve and in reports: words, marks and their colours.

Two failure rates of a course, as fields, with the attempts that it takes to tell them apart.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from pydantic import ValidationError
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QPainter, QPen
from PySide6.QtWidgets import QDoubleSpinBox, QHBoxLayout, QWidget

from app.scoring.competence import (
    RULE,
    Competence,
    CompetenceError,
    CompetenceRule,
    CompetenceState,
    Design,
    competence_words,
    design,
)
from app.session.board import ProgressBoard
from app.views.kit.parts import PlainLabel
from app.views.kit.text import number, tr, translated
from app.views.kit.wheel import wheel_scrolls

MARKS: Final = {CompetenceState.COMPETENT: "★", CompetenceState.RELAPSE: "▼"}
"""Short for a cell; who is not yet competent has none."""


def mark_words(board: ProgressBoard, key: str, exercise: str) -> str:
    """Return a mark with a word for a cell of the board; empty for whoever is not yet competent."""
    standing = board.competence(key, exercise)
    if standing is None or standing.state is CompetenceState.NOT_YET:
        return ""
    competent = standing.state is CompetenceState.COMPETENT
    return f"{MARKS[standing.state]} " + (tr("competent") if competent else tr("relapse"))


def competence_line(board: ProgressBoard, key: str, exercise: str) -> str:
    """Say in a line how a student stands at a skill; empty without an attempt."""
    standing = board.competence(key, exercise)
    left = board.attempts_left(key, exercise)
    return "" if standing is None else translated(competence_words(standing, left))


def rule_words(board: ProgressBoard) -> str:
    """Say what "competent" means on a board: rates, errors, planned attempts, what is supposed."""
    plan: Design = design(board.rule)
    rule = board.rule
    return tr(
        "Competent: fails {acceptable} % of the time or less, not {unacceptable} % or more "
        "(LC-CUSUM). Of those who are not, at most {false_alarm} % are called competent within "
        "{attempts} attempts; of those who are, at most {missed} % are not. Attempts more: 80 % "
        "interval, if the last attempts go on as they went.",
        acceptable=number(100.0 * rule.acceptable, "g"),
        unacceptable=number(100.0 * rule.unacceptable, "g"),
        false_alarm=number(100.0 * rule.false_alarm, "g"),
        attempts=plan.attempts,
        missed=number(100.0 * rule.missed, "g"),
    )


def draw_changes(
    painter: QPainter,
    standing: Competence | None,
    place: Callable[[int, float], QPointF],
    colours: tuple[str, str],
) -> None:
    """Draw a line with its mark where a student became competent or relapsed.

    Args:
        painter: of the plot.
        standing: None draws nothing.
        place: of the attempt with that number (from 1) and of points, in the plot.
        colours: of a line that says competent, and of one that says relapse.
    """
    for change in standing.changes if standing is not None else ():
        competent = change.state is CompetenceState.COMPETENT
        colour = QColor(colours[0] if competent else colours[1])
        top, bottom = place(change.attempt, 100.0), place(change.attempt, 0.0)
        painter.setPen(QPen(colour, 1.0, Qt.PenStyle.DotLine))
        painter.drawLine(top, bottom)
        painter.drawText(top + QPointF(3.0, 9.0), MARKS[change.state])


def draw_pass_mark(
    painter: QPainter,
    mark: float | None,
    place: Callable[[int, float], QPointF],
    across: tuple[float, float],
    colour: str,
) -> None:
    """Draw the points that pass as a dotted line with its name; None draws nothing.

    Args:
        painter: of the plot.
        mark: points.
        place: of the attempt with that number (from 1) and of points, in the plot.
        across: where the line begins and ends.
        colour: of line and name.
    """
    if mark is None:
        return
    y = place(1, mark).y()
    painter.setPen(QPen(QColor(colour), 1.0, Qt.PenStyle.DotLine))
    painter.drawLine(QPointF(across[0], y), QPointF(across[1], y))
    words = tr("{mark:g} to pass", mark=mark)
    wide = painter.fontMetrics().horizontalAdvance(words)
    painter.drawText(QPointF(across[1] - wide, y - 2.0), words)


class CompetenceRates(QWidget):
    """Acceptable and unacceptable failure rate [%]; what else a rule says stays as it was.

    Attributes:
        acceptable, unacceptable: fields.
        note: says how many attempts it takes, or that it cannot be.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._rule = RULE
        self.acceptable, self.unacceptable = QDoubleSpinBox(self), QDoubleSpinBox(self)
        self.note = PlainLabel("", self)
        names = (tr("Acceptable failures"), tr("Unacceptable failures"))
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        for name, field in zip(names, (self.acceptable, self.unacceptable), strict=True):
            field.setRange(0.1, 99.0)
            field.setDecimals(1)
            field.setSuffix(" %")
            field.setAccessibleName(name)
            wheel_scrolls(field)
            row.addWidget(PlainLabel(name, self))
            row.addWidget(field)
            field.editingFinished.connect(self._tell)
        row.addWidget(self.note, 1)
        self.show_rule(RULE)

    def show_rule(self, rule: CompetenceRule) -> None:
        """Show a rule."""
        self._rule = rule
        self.acceptable.setValue(100.0 * rule.acceptable)
        self.unacceptable.setValue(100.0 * rule.unacceptable)
        self._tell()

    def document(self) -> dict[str, float]:
        """Return the rule as the fields say, unchecked; rates nobody changed are as they were."""
        document: dict[str, float] = self._rule.model_dump()
        for name, field in (("acceptable", self.acceptable), ("unacceptable", self.unacceptable)):
            if field.value() != round(100.0 * document[name], field.decimals()):
                document[name] = round(field.value() / 100.0, 3)
        return document

    def _tell(self) -> None:
        try:
            plan = design(CompetenceRule(**self.document()))
        except (ValidationError, CompetenceError):
            self.note.setText(tr("no number of attempts tells these apart"))
            return
        self.note.setText(tr("told apart in {n} attempts", n=plan.attempts))
