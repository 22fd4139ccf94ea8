"""Report of a group, to be read, signed and filed: what the course was, and who has which marks.

A4 lying. The first page says what was done and leaves room for signatures; the others hold the
marks, thirty students by twelve exercises on each, under heads that every page repeats. Marks are
by the rule that is named, of attempts that may be compared; what chance adds to them is said.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from statistics import median
from typing import Final

from PySide6.QtCore import QCollator, QLocale, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPen

from app.core.progress import Progress
from app.exchange.moodle import GradeRule, chance_words
from app.exchange.results import Results
from app.exercises.guidance import Purpose
from app.session.board import BoardCell
from app.session.course import CourseItem
from app.session.people import Person
from app.session.reliability import reliability_lines
from app.views.debrief.report import DIM, INK, RULE
from app.views.kit.text import day, number, tr, tr_n, translated
from app.views.people.competence_marks import MARKS
from app.views.people.competence_marks import rule_words as competence_rule
from app.views.people.report_facts import (
    BY_HAND,
    ReportFacts,
    dates_words,
    draw_heading,
    draw_signatures,
    mark_words,
    rule_words,
)
from app.views.people.report_pages import ReportPages, draw_pdf
from app.views.people.results_report import INKS, PASSED

_LINE: Final = 13.4
"""Height of a row of marks [pt]: thirty of them stand on a page."""
_NAME: Final = 162.0
"""Width of the student's column [pt]."""
_NARROW: Final = 46.0
"""Least width of an exercise's column [pt]."""
_WIDE: Final = 92.0
"""Most width of an exercise's column [pt]."""
_TOTAL: Final = 52.0
"""Width of the last column [pt]."""
_RIGHT: Final = 28.0
"""Where a mark ends in its column [pt]."""
_SMALL: Final = 6.2
_STAR: Final = 40.0
"""Where the mark of who is competent stands in a column [pt]."""
_HEAD: Final = 32.0
_STRIPE: Final = "#f1f3f5"


def group_report(
    results: Results,
    titles: Mapping[str, str],
    facts: ReportFacts,
    progress: Progress | None = None,
) -> bytes:
    """Return the report of a group as the bytes of a PDF.

    Args:
        results: board, and names where they are wanted.
        titles: of exercises by id.
        facts: what stands above the marks.
        progress: reports, and may cancel.

    Raises:
        Cancelled: if that was asked for.
    """
    progress = progress or Progress()
    students, reliable = in_order(results), reliability_lines(results.board)

    def fill(sheet: ReportPages) -> None:
        begun = 0.5 if sheet.pages else 0.0
        progress.report(begun, facts.heading)
        _heading(sheet, results, facts)
        _exercises(sheet, results, titles)
        _notes(sheet, results, facts.rule, reliable)
        draw_signatures(sheet, tr("Instructor"), tr("Head of training"))
        room = max(1, int((sheet.inner - _NAME - _TOTAL) // _NARROW))
        items = results.board.items
        for first in range(0, len(items), room):
            some = progress.part(begun + 0.5 * first / len(items), begun + 0.5)
            _marks(sheet, results, titles, students, facts.rule, (first, room), some)

    return draw_pdf(fill, facts.heading, lying=True)


def in_order(results: Results) -> list[Person]:
    """Return the students as the reader's language sorts what stands in their column."""
    locale = QLocale()
    if locale.language() == QLocale.Language.C:  # which sorts by code, ł behind z
        locale = QLocale(QLocale.Language.English)
    collator = QCollator(locale)
    collator.setNumericMode(True)
    collator.setCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)
    students = results.board.students
    return sorted(students, key=lambda person: collator.sortKey(_who(person, results)))


# --- above the marks ------------------------------------------------------------------------------
def _heading(sheet: ReportPages, results: Results, facts: ReportFacts) -> None:
    board = results.board
    counted = [one for some in board.counted.values() for one in some]
    attempts = tr_n("{n} attempt that counts", "{n} attempts that count", len(counted))
    rows = (
        (tr("Venue"), facts.place or BY_HAND, tr("Students"), str(len(board.students))),
        (tr("Dates"), dates_words(counted), tr("Attempts"), attempts),
        (tr("Group"), facts.group or tr("Everybody"), tr("Mark"), rule_words(facts.rule)),
    )
    draw_heading(sheet, facts.heading, tr("Report of a group"), facts, rows)


_COLUMNS: Final = (0.0, 26.0, 250.0, 298.0, 372.0, 490.0, 640.0, 706.0)


def _exercises(sheet: ReportPages, results: Results, titles: Mapping[str, str]) -> None:
    """List the exercises by the numbers that stand above the marks."""
    heads = (
        *("", tr("Exercise"), tr("Version"), tr("Purpose")),
        *(tr("Attempts allowed"), tr("Dates"), tr("Pass mark"), tr("Passed")),
    )

    def head() -> None:
        sheet.y += 10.0
        for left, words in zip(_COLUMNS, heads, strict=True):
            sheet.text(sheet.margin + left, words, 8.5, DIM, bold=True)
        sheet.rule()
        sheet.y += 19.0

    head()
    if not results.board.items:
        sheet.paragraph(tr("No attempt of a student who signed in yet."))
    for place, item in enumerate(results.board.items, 1):
        if sheet.need(14.0):
            head()
        named = titles.get(item.exercise, item.exercise)
        purpose = tr("practice") if item.purpose is Purpose.PRACTICE else tr("assessment")
        allowed = str(item.attempts) if item.attempts else tr("any")
        days = [day(one) for one in (item.opens, item.closes) if one]
        passed = _passed_of(results, item)
        given = (named, str(item.version), purpose, allowed, " – ".join(days))
        mark = mark_words(results.board.pass_mark(item.exercise))
        texts = (str(place), *given, mark, passed)
        widths = (*(b - a for a, b in pairwise(_COLUMNS)), sheet.inner - _COLUMNS[-1])
        for left, words, width in zip(_COLUMNS, texts, widths, strict=True):
            sheet.text(sheet.margin + left, words, 8.5, bold=not left, width=width - 8.0)
        sheet.y += 14.0
    sheet.y += 10.0


def _passed_of(results: Results, item: CourseItem) -> str:
    board = results.board
    passed = sum(board.cells[person.key, item.exercise].passed for person in board.students)
    return tr("{n} of {m}", n=passed, m=len(board.students))


# --- marks ----------------------------------------------------------------------------------------
def _marks(
    sheet: ReportPages,
    results: Results,
    titles: Mapping[str, str],
    students: Sequence[Person],
    rule: GradeRule,
    columns: tuple[int, int],
    progress: Progress,
) -> None:
    """Write the marks at some exercises, from a number on, of every student."""
    first, room = columns
    board = results.board
    items = board.items[first : first + room]
    last = first + room >= len(board.items)
    width = min(_WIDE, (sheet.inner - _NAME - _TOTAL) / len(items))
    end = sheet.margin + _NAME + width * len(items)

    def head() -> None:
        top = sheet.y
        sheet.y = top + _HEAD - 8.0
        sheet.text(sheet.margin, tr("Student"), 8.5, DIM, bold=True)
        for place, item in enumerate(items):
            sheet.y = top + 2.0
            left = sheet.margin + _NAME + place * width + 9.0
            sheet.text(left, str(first + place + 1), 9.0, INK, bold=True)
            _small(sheet, left, titles.get(item.exercise, item.exercise), width - 4.0)
        sheet.y = top + _HEAD - 8.0
        if last:
            sheet.text(end + 6.0, tr("Passed"), 8.5, DIM, bold=True, width=_TOTAL - 6.0)
        sheet.rule()
        sheet.y += 17.0

    sheet.turn()
    sheet.y -= 8.0
    head()
    for row, person in enumerate(students):
        progress.report(row / len(students), person.pseudonym)
        if sheet.need(0.0):
            head()
        if row % 2:
            stripe = QRectF(sheet.margin - 3.0, sheet.y - 9.4, sheet.inner + 6.0, _LINE)
            sheet.painter.fillRect(stripe, QColor(_STRIPE))
        _student(sheet, person, results)
        for place, item in enumerate(items):
            cell = board.cells[person.key, item.exercise]
            mark = rule.grade(board.counted.get((person.key, item.exercise), ()))
            left = sheet.margin + _NAME + place * width
            _mark(sheet, left, cell, mark)
            standing = board.competence(person.key, item.exercise)
            if standing is not None and standing.state in MARKS:
                sheet.text(left + _STAR, MARKS[standing.state], _SMALL, INKS[standing.state])
        if last:
            passed = sum(board.cells[person.key, item.exercise].passed for item in board.items)
            words = tr("{n} of {m}", n=passed, m=len(board.items))
            sheet.text(end + 6.0, words, 8.5, bold=passed == len(board.items))
        sheet.y += _LINE
    if sheet.need(_LINE):
        head()
    _below(sheet, results, items, rule, width)


def _small(sheet: ReportPages, left: float, words: str, width: float) -> None:
    """Write the title of an exercise below its number: two short lines, cut where it is longer."""
    first, rest = "", words.split()
    while rest and (not first or sheet.advance(f"{first} {rest[0]}", _SMALL) <= width):
        first = f"{first} {rest.pop(0)}".strip()
    for line in (first, " ".join(rest)):
        sheet.y += 7.6
        sheet.text(left, line, _SMALL, DIM, width=width)


def _student(sheet: ReportPages, person: Person, results: Results) -> None:
    """Write who it is: the name, and the pseudonym beside it where there is room."""
    who = _who(person, results)
    sheet.text(sheet.margin, who, 8.5, width=_NAME - 8.0)
    taken = sheet.advance(who, 8.5) + 6.0
    pseudonym = "" if who == person.pseudonym else person.pseudonym
    if taken + sheet.advance(pseudonym, _SMALL) < _NAME - 8.0:
        sheet.text(sheet.margin + taken, pseudonym, _SMALL, DIM)


def _mark(sheet: ReportPages, left: float, cell: BoardCell, mark: float | None) -> None:
    """Write a mark: whether it was passed, the points, and how many attempts count."""
    if mark is None:
        sheet.text(left + 9.0, "–" if not cell.others else f"– ({cell.others})", 8.0, DIM)
        return
    colour, words = PASSED if cell.passed else INK, number(mark, ".0f")
    if cell.passed:
        sheet.text(left + 2.0, "✔", 7.0, colour)
    taken = sheet.advance(words, 8.0, bold=cell.passed)
    sheet.text(left + _RIGHT - taken, words, 8.0, colour, bold=cell.passed)
    if cell.near_mark:
        sheet.text(left + 9.5, "≈", 5.6, DIM)
    sheet.text(left + _RIGHT + 2.0, f"({cell.attempts})", 5.6, DIM)


def _below(
    sheet: ReportPages, results: Results, items: Sequence[CourseItem], rule: GradeRule, width: float
) -> None:
    """Write below the marks how many pass, and the mark in the middle."""
    board = results.board
    sheet.painter.setPen(QPen(QColor(RULE), 0.6))
    y = sheet.y - 9.4
    sheet.painter.drawLine(QPointF(sheet.margin, y), QPointF(sheet.width - sheet.margin, y))
    sheet.text(sheet.margin, tr("passed"), 8.0, DIM, bold=True)
    for place, item in enumerate(items):
        passed = sum(board.cells[one.key, item.exercise].passed for one in board.students)
        _ending(sheet, sheet.margin + _NAME + place * width + _RIGHT, str(passed))
    sheet.y += _LINE
    sheet.text(sheet.margin, tr("median"), 8.0, DIM, bold=True)
    for place, item in enumerate(items):
        every = (board.counted.get((one.key, item.exercise), ()) for one in board.students)
        marks = [mark for some in every if (mark := rule.grade(some)) is not None]
        words = number(median(marks), ".0f") if marks else "–"
        _ending(sheet, sheet.margin + _NAME + place * width + _RIGHT, words)
    sheet.y += _LINE


def _ending(sheet: ReportPages, right: float, words: str) -> None:
    """Write a figure below a column, where the marks end."""
    taken = sheet.advance(words, 8.0, bold=True)
    sheet.text(right - taken, words, 8.0, DIM, bold=True)


# --- below the marks ------------------------------------------------------------------------------
def _notes(sheet: ReportPages, results: Results, rule: GradeRule, reliable: Sequence[str]) -> None:
    """Say how to read the marks, what chance does to them, and how far they can be relied on."""
    sheet.y += 6.0
    how = tr(
        "✔ passed at least once. In brackets the attempts that count: scored, comparable, by a "
        "person, not declared void; – (2): two that do not count."
    )
    pages = tr(
        "The signatures are for all {pages} pages: the marks stand on those after this one.",
        pages=sheet.pages or 1,
    )
    chance = translated(chance_words(results.board, rule))
    cells = results.board.cells.values()
    near = tr("≈ the best is within the error of measurement of the mark.")
    near = near if any(cell.near_mark for cell in cells) else ""
    stars = tr("★ competent, ▼ relapse.")
    competent = f"{stars} {competence_rule(results.board)}" if results.board.items else ""
    chance = chance[:1].upper() + chance[1:]
    lines = "; ".join(map(translated, reliable))
    relied = tr("Reliability (intervals of 95 %): {lines}", lines=lines) if reliable else ""
    for words in filter(None, (how, near, competent, pages, chance, relied)):
        sheet.paragraph(words if words.endswith(".") else f"{words}.", 8.0, DIM)


def _who(person: Person, results: Results) -> str:
    return results.names.get(person.key, "") or person.pseudonym
