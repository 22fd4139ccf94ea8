"""What stands above the marks of a report and below them: course, venue, dates, signatures."""

from __future__ import annotations

import datetime
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Final

from PySide6.QtCore import QPointF
from PySide6.QtGui import QColor, QPen

from app import __version__
from app.exchange.moodle import GradeFrom, GradeRule
from app.session.index import Indexed
from app.views.debrief.report import DIM, INK
from app.views.kit.text import day, moment, tr
from app.views.people.report_pages import ReportPages

_SIGNED: Final = 70.0
"""Height of the lines for signatures, which stay together [pt]."""

BY_HAND: Final = "_" * 34
"""A line to fill in by hand."""


@dataclass(frozen=True, slots=True)
class ReportFacts:
    """What stands above the marks.

    Attributes:
        course: its title; empty for all exercises.
        group: of students; empty for everybody.
        place: where the course was; empty leaves a line to fill in by hand.
        rule: of the marks.
        now: time of the report.
    """

    course: str = ""
    group: str = ""
    place: str = ""
    rule: GradeRule = field(default_factory=GradeRule)
    now: datetime.datetime | None = None

    @property
    def heading(self) -> str:
        """Return course and group in one line."""
        return " · ".join(filter(None, (self.course or tr("All exercises"), self.group)))


def draw_heading(
    sheet: ReportPages,
    title: str,
    kind: str,
    facts: ReportFacts,
    rows: Sequence[tuple[str, str, str, str]],
) -> None:
    """Write title, kind of report and time; below a rule the rows, each two names with texts."""
    sheet.y = sheet.margin + 12.0
    sheet.text(sheet.margin, title, 17.0, bold=True, width=sheet.inner)
    sheet.y += 16.0
    when = moment(facts.now or datetime.datetime.now().astimezone())
    words = tr("{kind}, {when}, by Acus {version}", kind=kind, when=when, version=__version__)
    sheet.text(sheet.margin, words, 9.0, DIM)
    sheet.y += 2.0
    sheet.rule()
    sheet.y += 20.0
    half = sheet.inner / 2.0
    for left, first, right, second in rows:
        for x, name, text in ((sheet.margin, left, first), (sheet.margin + half, right, second)):
            sheet.text(x, name, 9.0, DIM, bold=True, width=66.0)
            sheet.text(x + 70.0, text, 9.0, width=half - 78.0)
        sheet.y += 13.5
    sheet.y += 8.0


def mark_words(mark: float | None) -> str:
    """Say a pass mark; a dash where no attempt tells it."""
    return "–" if mark is None else f"{mark:.3g}"


def rule_words(rule: GradeRule) -> str:
    """Say which attempts make a mark."""
    return {
        GradeFrom.BEST: tr("points of the best attempt, of 100"),
        GradeFrom.FIRST: tr("points of the first attempt, of 100"),
        GradeFrom.LAST: tr("points of the last attempt, of 100"),
        GradeFrom.MEAN: tr("mean of the points of the last {n} attempts, of 100", n=rule.last),
    }[rule.rule]


def dates_words(attempts: Iterable[Indexed]) -> str:
    """Say from when to when attempts were made."""
    times = [one.time for one in attempts]
    if not times:
        return "–"
    first, last = (day(time.astimezone().date()) for time in (min(times), max(times)))
    return first if first == last else tr("{first} to {last}", first=first, last=last)


def draw_signatures(sheet: ReportPages, *who: str) -> None:
    """Leave lines for place and date and for signatures, on one page."""
    sheet.need(_SIGNED)
    sheet.y += 48.0
    names = (tr("Place, date"), *who)
    width = (sheet.inner - 24.0 * (len(names) - 1)) / len(names)
    for column, words in enumerate(names):
        left = sheet.margin + column * (width + 24.0)
        sheet.painter.setPen(QPen(QColor(INK), 0.6))
        sheet.painter.drawLine(QPointF(left, sheet.y), QPointF(left + width, sheet.y))
        sheet.y += 12.0
        sheet.text(left, words, 8.5, DIM)
        sheet.y -= 12.0
    sheet.y += 16.0
