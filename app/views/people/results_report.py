"""Reports of a group and of a student: A4, vector text and curves, for whoever set the course.

A group's report holds the board, as many exercises beside each other as the page is wide, and what
the columns pass. A student's holds his exercises, his curve in each, and what the instructor said.
Both tell only attempts that may be compared; how many others there are, and why, is told beside.
"""

from __future__ import annotations

import datetime
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF, QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import (
    QColor,
    QFontMetricsF,
    QPageLayout,
    QPageSize,
    QPainter,
    QPdfWriter,
    QPen,
    QPolygonF,
)
from PySide6.QtWidgets import QApplication

from app import __version__
from app.core.files import write_atomically
from app.core.messages import sentence
from app.exchange.errors import ExportError
from app.exchange.results import Results
from app.scoring.tolerance import Band
from app.session.board import BoardCell, CurvePoint
from app.session.people import Person
from app.views.debrief.report import BAND_INKS, DIM, HEIGHT, INK, LINE, MARGIN, RULE, WIDTH, font
from app.views.kit.text import date_text, disclaimer, listing, moment, number, tr, tr_n, translated

PASSED, MEDIAN = BAND_INKS[Band.GOOD], "#8a5a00"
_ROW: Final = 17.0
_FOOT: Final = 26.0
_NAME: Final = 110.0
"""Width of the first column of the board [pt]."""
_CELL: Final = 96.0
"""Least width of a column of the board [pt]."""


@dataclass(slots=True)
class _Sheet:
    """Pages that are filled from the top down.

    Attributes:
        painter: on the present page.
        next_page: begins another.
        title: repeated above every page but the first.
        pages: how many there will be; 0 while that is being found out.
        page: number of the present one, from 1.
        y: where the page goes on [pt].
    """

    painter: QPainter
    next_page: Callable[[], object]
    title: str
    pages: int
    page: int = 1
    y: float = MARGIN

    def text(
        self,
        x: float,
        words: str,
        size: float = 9.5,
        colour: str = INK,
        bold: bool = False,
        width: float = 0.0,
    ) -> None:
        """Write a line at the present height; cut with dots where it is wider than `width`."""
        used = font(size, bold)
        if width > 0.0:
            words = QFontMetricsF(used).elidedText(words, Qt.TextElideMode.ElideRight, width)
        self.painter.setFont(used)
        self.painter.setPen(QColor(colour))
        self.painter.drawText(QPointF(x, self.y), words)

    def paragraph(
        self, words: str, size: float = 9.5, colour: str = INK, left: float = 0.0
    ) -> None:
        """Write lines as wide as the page, and go on below."""
        size = 9.5
        used, width = font(size), WIDTH - 2.0 * MARGIN - left
        wrap = int(Qt.TextFlag.TextWordWrap)
        box = QFontMetricsF(used).boundingRect(QRectF(0.0, 0.0, width, 1e4), wrap, words)
        self.need(box.height() + 4.0)
        self.painter.setFont(used)
        self.painter.setPen(QColor(colour))
        place = QRectF(MARGIN + left, self.y - 0.8 * size, width, box.height() + 2.0)
        self.painter.drawText(place, wrap, words)
        self.y += box.height() + 4.0

    def head(self, x: float, words: str, width: float) -> None:
        """Write the head of a column: two lines at most, the last one at the present height."""
        self.painter.setFont(font(9.0, bold=True))
        self.painter.setPen(QColor(DIM))
        place = QRectF(x, self.y - 21.0, width, 24.0)
        flags = int(Qt.TextFlag.TextWordWrap) | int(Qt.AlignmentFlag.AlignBottom)
        self.painter.drawText(place, flags, words)

    def right(self, words: str, size: float = 8.0) -> None:
        """Write a line that ends at the right margin."""
        self.painter.setFont(font(size))
        width = self.painter.fontMetrics().horizontalAdvance(words)
        self.text(WIDTH - MARGIN - width, words, size, DIM)

    def rule(self) -> None:
        """Draw a line across the page, below the present height."""
        self.painter.setPen(QPen(QColor(RULE), 0.6))
        y = self.y + 5.0
        self.painter.drawLine(QPointF(MARGIN, y), QPointF(WIDTH - MARGIN, y))

    def need(self, height: float) -> bool:
        """Begin another page unless so much [pt] is left on this one; tell whether one was."""
        if self.y + height <= HEIGHT - MARGIN - _FOOT:
            return False
        self.turn()
        return True

    def turn(self) -> None:
        """Begin another page."""
        self.foot()
        self.next_page()
        self.page += 1
        self.y = MARGIN + 8.0
        self.text(MARGIN, self.title, 9.0, DIM, bold=True)
        self.rule()
        self.y += 24.0

    def foot(self) -> None:
        """Say at the bottom what this is, and which page."""
        self.y = HEIGHT - MARGIN - 4.0
        self.rule()
        self.y += 17.0
        self.text(MARGIN, disclaimer(), 8.0, bold=True)
        words = tr("page {page} of {pages}", page=self.page, pages=self.pages or self.page)
        self.right(words)


def group_report(
    results: Results,
    titles: Mapping[str, str],
    heading: str,
    now: datetime.datetime | None = None,
) -> bytes:
    """Return the report of a group as the bytes of a PDF.

    Args:
        results: board, remarks, and names where they are wanted.
        titles: of exercises by id.
        heading: course and group, as chosen.
        now: time of the report.
    """

    def fill(sheet: _Sheet) -> None:
        board = results.board
        _heading(sheet, heading, tr("Report of a group"), now)
        counted = sum(len(some) for some in board.counted.values())
        sheet.paragraph(
            tr(
                "{students}, {exercises}, {attempts}: scored, comparable, by a person, not "
                "declared void.",
                students=tr_n("{n} student", "{n} students", len(board.students)),
                exercises=tr_n("{n} exercise", "{n} exercises", len(board.items)),
                attempts=tr_n("{n} attempt that counts", "{n} attempts that count", counted),
            ),
            colour=DIM,
        )
        sheet.y += 8.0
        room = int((WIDTH - 2.0 * MARGIN - _NAME) // _CELL)
        for first in range(0, len(board.items), room):
            _block(sheet, results, titles, first, room)
        if not board.items:
            sheet.paragraph(tr("No attempt of a student who signed in yet."))

    return _pdf(fill, heading)


def student_report(
    results: Results,
    person: Person,
    titles: Mapping[str, str],
    now: datetime.datetime | None = None,
) -> bytes:
    """Return the report of one student as the bytes of a PDF; arguments as in `group_report`."""
    heading = _who(person, results)

    def fill(sheet: _Sheet) -> None:
        board = results.board
        _heading(sheet, heading, tr("Report of a student"), now)
        if person.groups:
            sheet.paragraph(tr("Group: {groups}", groups=listing(person.groups)), colour=DIM)
        sheet.y += 6.0
        _exercises(sheet, results, person, titles)
        for item in board.items:
            points = board.curve(person.key, item.exercise)
            if points:
                _curve(sheet, titles.get(item.exercise, item.exercise), points)
        _remarks(sheet, results, person, titles)

    return _pdf(fill, heading)


def write_report(path: Path, draw: Callable[[], bytes]) -> None:
    """Write a report whole or not at all; works without a display.

    Raises:
        ExportError: if it cannot be written.
    """
    # Text needs an application; the platform without a display is enough.
    application = QApplication.instance() or QApplication(["acus", "-platform", "offscreen"])
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
def _heading(sheet: _Sheet, title: str, kind: str, now: datetime.datetime | None) -> None:
    sheet.y = MARGIN + 14.0
    sheet.text(MARGIN, title, 17.0, bold=True, width=WIDTH - 2.0 * MARGIN)
    sheet.y += 17.0
    when = moment(now or datetime.datetime.now().astimezone())
    words = tr("{kind}, {when}, by Acus {version}", kind=kind, when=when, version=__version__)
    sheet.text(MARGIN, words, 9.5, DIM)
    sheet.y += 4.0
    sheet.rule()
    sheet.y += 26.0


def _block(
    sheet: _Sheet, results: Results, titles: Mapping[str, str], first: int, room: int
) -> None:
    """Write some columns of the board, for every student."""
    board = results.board
    items = board.items[first : first + room]
    width = (WIDTH - 2.0 * MARGIN - _NAME) / max(len(items), min(room, 3))

    def head() -> None:
        sheet.y += 10.0
        sheet.text(MARGIN, tr("Student"), 9.0, DIM, bold=True)
        for place, item in enumerate(items):
            named = titles.get(item.exercise, item.exercise)
            sheet.head(MARGIN + _NAME + place * width, named, width - 6.0)
        sheet.rule()
        sheet.y += _ROW + 4.0

    sheet.need(4.0 * _ROW)
    head()
    for person in board.students:
        if sheet.need(_ROW):
            head()
        sheet.text(MARGIN, _who(person, results), width=_NAME - 6.0)
        for place, item in enumerate(items):
            cell = board.cells[person.key, item.exercise]
            words, colour = _cell(cell), PASSED if cell.passed else INK
            sheet.text(MARGIN + _NAME + place * width, words, 9.5, colour, width=width - 6.0)
        sheet.y += _ROW
    if sheet.need(2.0 * _ROW):
        head()
    sheet.text(MARGIN, tr("passed"), 9.0, DIM, bold=True)
    for place, item in enumerate(items):
        passed = sum(board.cells[one.key, item.exercise].passed for one in board.students)
        words = tr("{n} of {m}", n=passed, m=len(board.students))
        sheet.text(MARGIN + _NAME + place * width, words, 9.0, DIM, bold=True)
    if any(
        board.cells[one.key, item.exercise].near_mark for one in board.students for item in items
    ):
        sheet.y += _ROW
        sheet.text(MARGIN, tr("≈: within the error of measurement of the mark"), 9.0, DIM)
    sheet.y += 2.0 * _ROW


def _cell(cell: BoardCell) -> str:
    """Say how a student stands in an exercise: passed, best, last, how many."""
    if cell.best is None or cell.last is None:
        return "–" if not cell.others else tr("– ({n} not counted)", n=cell.others)
    words = f"{cell.best:.0f} / {cell.last:.0f} ({cell.attempts})"
    words = f"{words} ≈" if cell.near_mark else words
    return f"✔ {words}" if cell.passed else words


_COLUMNS: Final = (0.0, 190.0, 250.0, 300.0, 350.0, 420.0)


def _exercises(sheet: _Sheet, results: Results, person: Person, titles: Mapping[str, str]) -> None:
    """List how the student stands in each exercise."""
    heads = (
        *(tr("Exercise"), tr("Attempts"), tr("Best"), tr("Last")),
        *(tr("Trend"), tr("Passed")),
    )

    def head() -> None:
        for left, words in zip(_COLUMNS, heads, strict=True):
            sheet.text(MARGIN + left, words, 9.0, DIM, bold=True)
        sheet.rule()
        sheet.y += _ROW + 4.0

    head()
    for item in results.board.items:
        if sheet.need(2.0 * _ROW):
            head()
        cell = results.board.cells[person.key, item.exercise]
        named = titles.get(item.exercise, item.exercise) + f", v{item.version}"
        trend = "–" if cell.trend is None else number(cell.trend, "+.1f")
        numbers = ("–" if one is None else f"{one:.0f}" for one in (cell.best, cell.last))
        texts = (named, str(cell.attempts), *numbers, trend, "✔" if cell.passed else "–")
        for place, (left, words) in enumerate(zip(_COLUMNS, texts, strict=True)):
            colour = PASSED if cell.passed and place == 5 else INK
            sheet.text(MARGIN + left, words, colour=colour, width=180.0 if not place else 60.0)
        sheet.y += _ROW
        if cell.why:
            why = "; ".join(f"{n} {translated(why)}" for why, n in cell.why)
            sheet.y -= 3.0
            sheet.text(MARGIN + 10.0, tr("not counted: {why}", why=why), 8.0, DIM, width=460.0)
            sheet.y += _ROW - 3.0
    sheet.y += _ROW


def _curve(sheet: _Sheet, title: str, points: Sequence[CurvePoint]) -> None:
    """Draw points over the attempts, with the best until then and the moving median."""
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
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(LINE))
    size = 2.2 if len(points) < 80 else 1.2
    for n, point in enumerate(points, 1):
        painter.drawEllipse(place(n, point.total), size, size)
    sheet.y = bottom + 34.0


def _remarks(sheet: _Sheet, results: Results, person: Person, titles: Mapping[str, str]) -> None:
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
    sheet.need(3.0 * _ROW)
    sheet.text(MARGIN, tr("The instructor's remarks"), 10.5, bold=True)
    sheet.y += _ROW
    for one, remarks in said:
        sheet.need(2.5 * _ROW)
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


# --- pages ------------------------------------------------------------------------------------
def _pdf(fill: Callable[[_Sheet], None], title: str) -> bytes:
    """Draw twice: how many pages there are is known after the first time."""
    pages = 0
    data = QByteArray()
    for _ in range(2):
        data = QByteArray()
        buffer = QBuffer(data)
        buffer.open(QIODevice.OpenModeFlag.WriteOnly)
        writer = QPdfWriter(buffer)
        writer.setResolution(72)  # one unit of the painter is one point
        size = QPageSize(QSizeF(WIDTH, HEIGHT), QPageSize.Unit.Point)
        margins = QMarginsF(0.0, 0.0, 0.0, 0.0)
        writer.setPageLayout(QPageLayout(size, QPageLayout.Orientation.Portrait, margins))
        writer.setTitle(title)
        writer.setCreator(f"Acus {__version__}")
        painter = QPainter(writer)
        sheet = _Sheet(painter, writer.newPage, title, pages)
        try:
            fill(sheet)
            sheet.foot()
        finally:
            painter.end()
            buffer.close()
        pages = sheet.page
    return bytes(data.data())
