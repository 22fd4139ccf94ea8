"""Reports of a group and of a student: pages of a PDF, with everybody on them once."""

import datetime
import re
from dataclasses import replace

import pytest

pytest.importorskip("PySide6")

from app.exchange.results import Results
from app.scoring.conditions import Assistance, Conditions, DeviceKind
from app.session.board import progress_board
from app.session.course import CourseItem
from app.session.index import Indexed
from app.session.people import Person, Remarks
from app.views.people import results_report
from app.views.people.results_report import group_report, student_report

NOW = datetime.datetime(2026, 11, 23, 12, 0, tzinfo=datetime.UTC)


def attempt(name, student, exercise, total, day):
    """One attempt of the index, on one day of November."""
    conditions = Conditions(
        exercise,
        version=1,
        assistance=Assistance(0.7, 0.7, 0.7, 0.7),
        kind=DeviceKind.SIMULATED,
        hand="mouse",
        scoring_version=3,
    )
    started = f"2026-10-{day:02d}T10:00:00+00:00"
    one = Indexed(name, started, student, exercise, 1, "ended", 20.0, total, total >= 60.0,
                  "verified", True, "", "{}")  # fmt: skip
    one.__dict__["conditions"] = conditions
    return one


def results_of(students, exercises, attempts, names=None):
    people = [Person(f"p-{k}", f"student {k}", groups=("A",)) for k in range(students)]
    items = [CourseItem(exercise=f"exercise-{k}") for k in range(exercises)]
    some = [
        attempt(f"a{k}-{e}-{n}", f"p-{k}", f"exercise-{e}", 40.0 + 7.0 * n, n + 1)
        for k in range(students)
        for e in range(exercises)
        for n in range(attempts)
    ]
    said = {some[0].id: Remarks(comment="Steadier at the skin. " * 12)} if some else {}
    if len(some) > 1:
        said[some[1].id] = Remarks(void="the phone rang")
    board = progress_board(people, items, some, said, NOW)
    by_key = {one.key: one for one in people}
    return Results(board, some, by_key, said, names or {})


@pytest.fixture
def drawn(monkeypatch, application):
    """Every text that is drawn on the last pass, page by page."""
    pages = {}
    write, paragraph = results_report._Sheet.text, results_report._Sheet.paragraph

    def text(sheet, x, words, *given, **more):
        pages.setdefault((sheet.pages, sheet.page), []).append(words)
        assert 0.0 < sheet.y < results_report.HEIGHT
        return write(sheet, x, words, *given, **more)

    def lines(sheet, words, *given, **more):
        pages.setdefault((sheet.pages, sheet.page), []).append(words)
        return paragraph(sheet, words, *given, **more)

    monkeypatch.setattr(results_report._Sheet, "text", text)
    monkeypatch.setattr(results_report._Sheet, "paragraph", lines)

    def last():
        most = max(count for count, _ in pages)
        return [words for (count, _), words in sorted(pages.items()) if count == most]

    return last


def pages_of(data):
    return len(re.findall(rb"/Type /Page\b", data))


def test_everybody_stands_in_the_report_of_a_group_and_pages_are_numbered(drawn):
    data = group_report(results_of(60, 8, 3), {"exercise-0": "First"}, "Autumn · A", NOW)
    assert data.startswith(b"%PDF")
    shown = drawn()
    assert pages_of(data) == len(shown) > 2
    words = [one for page in shown for one in page]
    assert all(words.count(f"student {k}") == 2 for k in range(60))  # two blocks of columns
    assert words.count("54 / 54 (3)") == 60 * 8 - 1
    assert "54 / 54 (2)" in words  # one is declared void
    assert [f"page {n} of {len(shown)}" in page for n, page in enumerate(shown, 1)]
    assert "2026-11-23 12:00" in "".join(words)


def test_a_student_s_report_tells_curves_and_what_the_instructor_said(drawn):
    results = results_of(2, 3, 6)
    person = results.board.students[0]
    data = student_report(results, person, {}, NOW)
    words = "\n".join(one for page in drawn() for one in page)
    assert pages_of(data) == len(drawn())
    assert words.count("median of five") == 3
    assert "Steadier at the skin." in words
    assert "Declared void: the phone rang" in words
    assert "not counted: 1 declared void by the instructor" in words
    assert "student 1" not in words


def test_names_stand_in_a_report_only_where_they_are_asked_for(drawn):
    named = results_of(1, 1, 1, {"p-0": "Ada Lovelace"})
    group_report(named, {}, "A", NOW)
    assert any("student 0 (Ada Lovelace)" in page for page in drawn())
    assert "Ada Lovelace" not in str(group_report(results_of(1, 1, 1), {}, "A", NOW))


def test_a_group_without_attempts_has_a_report_too(drawn):
    assert pages_of(group_report(results_of(0, 0, 0), {}, "A", NOW)) == 1
    empty = results_of(1, 2, 0)
    assert pages_of(student_report(empty, empty.board.students[0], {}, NOW)) == 1


def test_a_best_near_the_mark_is_marked_in_a_report_and_the_sign_is_explained(drawn):
    results = results_of(2, 1, 3)
    place, explained = ("p-1", "exercise-0"), "≈: within the error of measurement of the mark"
    assert "%PDF" in group_report(results, {}, "Group A", NOW)[:8].decode("latin-1")
    assert explained not in [words for page in drawn() for words in page]
    near = replace(results.board.cells[place], near_mark=True)
    board = replace(results.board, cells={**results.board.cells, place: near})
    group_report(replace(results, board=board), {}, "Group A", NOW)
    texts = [words for page in drawn() for words in page]
    assert explained in texts
    assert len([words for words in texts if words.endswith(" ≈")]) == 1
