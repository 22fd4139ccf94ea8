"""Report of a student: his exercises, his curve in each, and what the instructor said.

It tells only attempts that may be compared; how many others there are, and why, is told beside.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Final

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QPen, QPolygonF
from PySide6.QtWidgets import QApplication

from app.core.files import write_atomically
from app.core.language import code
from app.core.messages import sentence
from app.exchange.errors import ExportError
from app.exchange.results import Results
from app.scoring.competence import Competence, CompetenceState
from app.scoring.tolerance import Band
from app.session.audit import note
from app.session.board import CurvePoint
from app.session.people import Person
from app.views.debrief.report import BAND_INKS, DIM, INK, LINE, MARGIN, RULE, WIDTH, font
from app.views.kit.language import use_language
from app.views.kit.text import date_text, listing, number, tr, tr_n, translated
from app.views.people.competence_marks import (
    competence_line,
    draw_changes,
    draw_pass_mark,
    rule_words,
)
from app.views.people.report_facts import (
    BY_HAND,
    ReportFacts,
    dates_words,
    draw_heading,
    draw_signatures,
    mark_words,
)
from app.views.people.report_pages import ROW, ReportPages, draw_pdf

PASSED, MEDIAN = BAND_INKS[Band.GOOD], "#8a5a00"
RELAPSED: Final = BAND_INKS[Band.FAIL]
INKS: Final = {CompetenceState.COMPETENT: PASSED, CompetenceState.RELAPSE: RELAPSED}
"""Of how somebody stands."""


def student_report(
    results: Results, person: Person, titles: Mapping[str, str], facts: ReportFacts
) -> bytes:
    """Return the report of one student as the bytes of a PDF.

    Args:
        results: board, remarks, and names where they are wanted.
        person: the student.
        titles: of exercises by id.
        facts: what stands above the marks.
    """

    def fill(sheet: ReportPages) -> None:
        board = results.board
        _heading(sheet, results, person, facts)
        _exercises(sheet, results, person, titles)
        if board.counted:
            sheet.paragraph(rule_words(board), colour=DIM)
            sheet.y += 8.0
        for item in board.items:
            points = board.curve(person.key, item.exercise)
            if points:
                standing = board.competence(person.key, item.exercise)
                mark = board.pass_mark(item.exercise)
                _curve(sheet, titles.get(item.exercise, item.exercise), points, standing, mark)
        _remarks(sheet, results, person, titles)
        draw_signatures(sheet, tr("Instructor"), tr("Student"))

    return draw_pdf(fill, _who(person, results))


def write_report(path: Path, draw: Callable[[], bytes]) -> None:
    """Write a report whole or not at all; works without a display.

    Raises:
        ExportError: if it cannot be written.
    """
    # Text needs an application; the platform without a display is enough.
    note("results written")
    application = QApplication.instance()
    if application is None:  # a command: in the language in which it answers
        application = QApplication(["acus", "-platform", "offscreen"])
        use_language(application, code())
    try:
        write_atomically(path, draw())
    except OSError as error:
        raise ExportError(
            sentence(
                "cannot write {path}: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    del application


# --- parts ------------------------------------------------------------------------------------
def _heading(sheet: ReportPages, results: Results, person: Person, facts: ReportFacts) -> None:
    counted = [
        one for (key, _), some in results.board.counted.items() for one in some if key == person.key
    ]
    attempts = tr_n("{n} attempt that counts", "{n} attempts that count", len(counted))
    group = listing(person.groups) if person.groups else "–"
    rows = (
        (tr("Course"), facts.course or tr("All exercises"), tr("Group"), group),
        (tr("Venue"), facts.place or BY_HAND, tr("Dates"), dates_words(counted)),
        (tr("Attempts"), attempts, "", ""),
    )
    draw_heading(sheet, _who(person, results), tr("Report of a student"), facts, rows)


_COLUMNS: Final = (0.0, 190.0, 250.0, 300.0, 350.0, 400.0, 462.0)


def _exercises(
    sheet: ReportPages, results: Results, person: Person, titles: Mapping[str, str]
) -> None:
    """List how the student stands in each exercise."""
    heads = (
        *(tr("Exercise"), tr("Attempts"), tr("Best"), tr("Last")),
        *(tr("Trend"), tr("Pass mark"), tr("Passed")),
    )

    def head() -> None:
        for left, words in zip(_COLUMNS, heads, strict=True):
            sheet.text(MARGIN + left, words, 9.0, DIM, bold=True)
        sheet.rule()
        sheet.y += ROW + 4.0

    head()
    for item in results.board.items:
        if sheet.need(3.0 * ROW):
            head()
        cell = results.board.cells[person.key, item.exercise]
        named = titles.get(item.exercise, item.exercise) + f", v{item.version}"
        trend = "–" if cell.trend is None else number(cell.trend, "+.1f")
        numbers = ("–" if one is None else f"{one:.0f}" for one in (cell.best, cell.last))
        mark = mark_words(results.board.pass_mark(item.exercise))
        texts = (named, str(cell.attempts), *numbers, trend, mark, "✔" if cell.passed else "–")
        for place, (left, words) in enumerate(zip(_COLUMNS, texts, strict=True)):
            colour = PASSED if cell.passed and place == 6 else INK
            sheet.text(MARGIN + left, words, colour=colour, width=180.0 if not place else 60.0)
        sheet.y += ROW
        standing = results.board.competence(person.key, item.exercise)
        if standing is not None:
            colour = INKS.get(standing.state, DIM)
            words = competence_line(results.board, person.key, item.exercise)
            sheet.y -= 3.0
            sheet.text(MARGIN + 10.0, words, 8.5, colour, width=460.0)
            sheet.y += ROW - 3.0
        if cell.why:
            why = "; ".join(f"{n} {translated(why)}" for why, n in cell.why)
            sheet.y -= 3.0
            sheet.text(MARGIN + 10.0, tr("not counted: {why}", why=why), 8.0, DIM, width=460.0)
            sheet.y += ROW - 3.0
    sheet.y += ROW


def _curve(
    sheet: ReportPages,
    title: str,
    points: Sequence[CurvePoint],
    standing: Competence | None,
    mark: float | None,
) -> None:
    """Draw points over the attempts, with the best until then, the moving median, the mark."""
    height = 110.0
    sheet.need(height + 40.0)
    sheet.text(MARGIN, title, 10.5, bold=True)
    sheet.right(tr("● attempt   — best until then   - - median of five"))
    top, left = sheet.y + 10.0, MARGIN + 26.0
    right, bottom = WIDTH - MARGIN, top + height
    painter = sheet.painter

    def place(number: int, total: float) -> QPointF:
        x = left + (right - left) * (number - 0.5) / max(2, len(points))
        return QPointF(x, bottom - height * total / 100.0)

    for level in (0, 50, 100):
        y = bottom - height * level / 100.0
        painter.setPen(QPen(QColor(RULE), 0.5))
        painter.drawLine(QPointF(left, y), QPointF(right, y))
        painter.setFont(font(7.5))
        painter.setPen(QColor(DIM))
        painter.drawText(QPointF(MARGIN, y + 3.0), str(level))
    step = max(1, len(points) // 10)
    for n in range(1, len(points) + 1, step):
        painter.drawText(QPointF(place(n, 0.0).x() - 2.0, bottom + 11.0), str(n))
    for ink, style, values in (
        (PASSED, Qt.PenStyle.SolidLine, [point.best for point in points]),
        (MEDIAN, Qt.PenStyle.DashLine, [point.median for point in points]),
    ):
        painter.setPen(QPen(QColor(ink), 1.0, style))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawPolyline(QPolygonF([place(n, value) for n, value in enumerate(values, 1)]))
    painter.setFont(font(7.5))
    draw_pass_mark(painter, mark, place, (left, right), DIM)
    draw_changes(painter, standing, place, (PASSED, RELAPSED))
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(LINE))
    size = 2.2 if len(points) < 80 else 1.2
    for n, point in enumerate(points, 1):
        painter.drawEllipse(place(n, point.total), size, size)
    sheet.y = bottom + 34.0


def _remarks(
    sheet: ReportPages, results: Results, person: Person, titles: Mapping[str, str]
) -> None:
    """Tell what the instructor said of the student's attempts, newest first."""
    said = [
        (one, results.remarks[one.id])
        for one in reversed(results.attempts)
        if (own := results.people.get(one.student)) is not None
        and own.key == person.key
        and (of_it := results.remarks.get(one.id)) is not None
        and (of_it.comment or of_it.void)
    ]
    if not said:
        return
    sheet.need(3.0 * ROW)
    sheet.text(MARGIN, tr("The instructor's remarks"), 10.5, bold=True)
    sheet.y += ROW
    for one, remarks in said:
        sheet.need(2.5 * ROW)
        total = "–" if one.total is None else f"{one.total:.0f}"
        named = titles.get(one.exercise, one.exercise)
        words = f"{date_text(one.started)}   {named}   {total}"
        sheet.text(MARGIN, words, 9.0, DIM, bold=True, width=WIDTH - 2.0 * MARGIN)
        sheet.y += 13.0
        if remarks.void:
            sheet.paragraph(tr("Declared void: {why}", why=remarks.void), left=10.0)
        if remarks.comment:
            sheet.paragraph(remarks.comment, left=10.0)
        sheet.y += 5.0


def _who(person: Person, results: Results) -> str:
    name = results.names.get(person.key, "")
    return f"{person.pseudonym} ({name})" if name else person.pseudonym
