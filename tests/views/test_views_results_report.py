"""Reports of a group and of a student: pages of a PDF, with everybody on them once."""

import datetime
import os
import re
import subprocess
import sys
from dataclasses import replace

import pytest

pytest.importorskip("PySide6")

from PySide6.QtCore import QLocale

from app.core.disclaimer import DISCLAIMER
from app.core.progress import Cancelled, Progress
from app.exchange.moodle import GradeRule
from app.exchange.results import Results
from app.scoring.conditions import Assistance, Conditions, DeviceKind
from app.session.board import progress_board
from app.session.course import CourseItem
from app.session.index import Indexed
from app.session.people import Person, Remarks
from app.views.people.competence_marks import competence_line
from app.views.people.group_report import group_report, in_order
from app.views.people.report_facts import ReportFacts
from app.views.people.report_pages import ReportPages
from app.views.people.results_report import student_report

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
    write, paragraph = ReportPages.text, ReportPages.paragraph

    def text(sheet, x, words, *given, **more):
        pages.setdefault((sheet.pages, sheet.page), []).append(words)
        assert 0.0 < sheet.y < sheet.height
        return write(sheet, x, words, *given, **more)

    def lines(sheet, words, *given, **more):
        pages.setdefault((sheet.pages, sheet.page), []).append(words)
        return paragraph(sheet, words, *given, **more)

    monkeypatch.setattr(ReportPages, "text", text)
    monkeypatch.setattr(ReportPages, "paragraph", lines)

    def last():
        most = max(count for count, _ in pages)
        return [words for (count, _), words in sorted(pages.items()) if count == most]

    return last


def pages_of(data):
    return len(re.findall(rb"/Type /Page\b", data))


def facts(**given):
    return ReportFacts(**({"course": "Autumn", "group": "A", "now": NOW} | given))


@pytest.mark.long("journey")
def test_thirty_students_and_twelve_exercises_have_a_cover_to_sign_and_one_page_of_marks(drawn):
    titles = {f"exercise-{k}": f"Title of {k}" for k in range(12)}
    data = group_report(results_of(30, 12, 3), titles, facts(place="Basel, Theatre 2"))
    assert data.startswith(b"%PDF")
    cover, marks = drawn()
    assert pages_of(data) == 2
    for words in (
        *("Autumn · A", "Basel, Theatre 2", "2026-10-01 to 2026-10-03", "30", "12"),
        *("points of the best attempt, of 100", "0 of 30", "Title of 11"),
        *("Place, date", "Instructor", "Head of training", "page 1 of 2"),
    ):
        assert words in cover, words
    assert "2026-11-23 12:00" in "".join(cover)
    assert all(marks.count(f"student {k}") == 1 for k in range(30))
    assert marks.count("54") == 30 * 12 + 12  # marks, and the median of each exercise
    assert marks.count("(3)") == 30 * 12 - 1
    assert "(2)" in marks  # one is declared void
    assert marks.count("0 of 12") == 30
    assert "page 2 of 2" in marks


@pytest.mark.long("journey")
def test_heads_stand_on_every_page_of_a_larger_group_and_all_are_there_once_a_block(drawn):
    group_report(results_of(70, 15, 2), {"exercise-0": "First"}, facts())
    pages = drawn()
    words = [word for page in pages for word in page]
    assert all(words.count(f"student {k}") == 2 for k in range(70))  # two blocks of columns
    with_marks = [page for page in pages if "(2)" in page]
    assert len(with_marks) == 6
    assert all("Student" in page and "Autumn · A" in page for page in with_marks)
    assert [page.count("1") + page.count("13") for page in with_marks] == [1] * 6
    assert all(f"page {n} of {len(pages)}" in page for n, page in enumerate(pages, 1))


@pytest.mark.long("journey")
def test_the_disclaimer_stands_in_a_report_once(drawn):
    group_report(results_of(70, 15, 2), {}, facts())
    assert [word for page in drawn() for word in page].count(DISCLAIMER) == 1


def test_the_marks_follow_the_rule_and_chance_is_told(drawn):
    group_report(results_of(10, 3, 4), {}, facts(rule=GradeRule.of("first")))
    words = [word for page in drawn() for word in page]
    assert words.count("40") == 10 * 3 + 3
    assert "points of the first attempt, of 100" in words
    group_report(results_of(10, 3, 4), {}, facts())
    assert any("so the best of 5 equal attempts" in page_ for page in drawn() for page_ in page)


def test_names_are_sorted_as_the_language_of_the_reader_sorts_them(application):
    names = (
        "Zorn",
        "Łukasz",
        "Óscar",
        "Otto",
        "Müller",
        "Muzik",
        "Lutz",
        "student 10",
        "student 9",
    )
    results = results_of(len(names), 1, 1, {f"p-{k}": name for k, name in enumerate(names)})
    before = QLocale()
    try:
        for language, order in (
            ("en", "Łukasz Lutz Müller Muzik Óscar Otto student 9|student 10 Zorn"),
            ("pl", "Lutz Łukasz Müller Muzik Otto Óscar student 9|student 10 Zorn"),
        ):
            QLocale.setDefault(QLocale(language))
            shown = " ".join(names[int(person.key[2:])] for person in in_order(results))
            assert shown == order.replace("|", " "), language
    finally:
        QLocale.setDefault(before)


@pytest.mark.long("journey")
def test_a_report_of_a_group_tells_how_far_it_is_and_can_be_cancelled(drawn):
    told = []
    group_report(results_of(30, 12, 3), {}, facts(), Progress(lambda f, _: told.append(f)))
    assert told == sorted(told)
    assert len(told) > 30
    progress = Progress(lambda fraction, _: progress.cancel() if fraction > 0.4 else None)
    with pytest.raises(Cancelled):
        group_report(results_of(30, 12, 3), {}, facts(), progress)


def test_a_student_s_report_tells_curves_and_what_the_instructor_said(drawn):
    results = results_of(2, 3, 6)
    person = results.board.students[0]
    data = student_report(results, person, {}, facts())
    words = "\n".join(one for page in drawn() for one in page)
    assert pages_of(data) == len(drawn())
    assert words.count("median of five") == 3
    assert "Steadier at the skin." in words
    assert "Declared void: the phone rang" in words
    assert "not counted: 1 declared void by the instructor" in words
    assert "student 1" not in words


def test_reports_say_who_is_competent_since_when_and_with_which_error(drawn):
    """From the fourth attempt on each passes (61 points and more): the thirteenth is the tenth."""
    results = results_of(1, 1, 14)
    (person,) = results.board.students
    student_report(results, person, {}, facts())
    words = "\n".join(one for page in drawn() for one in page)
    assert "competent after 12 attempts (false alarm ≤ 5 %)" in words  # one is void
    assert "Of those who are not, at most 5 % are called competent within 24 attempts" in words


def test_the_report_of_a_group_marks_who_is_competent_and_nobody_else(drawn):
    group_report(results_of(3, 2, 14), {}, facts())
    words = [one for page in drawn() for one in page]
    assert words.count("★") == 6
    assert any("★ competent, ▼ relapse. Competent: fails 10 % of the time" in one for one in words)


def test_the_report_of_a_group_of_beginners_marks_nobody(drawn):
    group_report(results_of(2, 1, 5), {}, facts())
    assert "★" not in [one for page in drawn() for one in page]


def test_names_stand_in_a_report_only_where_they_are_asked_for(drawn):
    named = results_of(1, 1, 1, {"p-0": "Ada Lovelace"})
    group_report(named, {}, facts())
    assert any("Ada Lovelace" in page and "student 0" in page for page in drawn())


def test_without_names_the_report_holds_pseudonyms_alone(drawn):
    group_report(results_of(1, 1, 1), {}, facts())
    assert not any("Ada Lovelace" in page for page in drawn())


def test_a_group_without_attempts_has_a_report_too(drawn):
    assert pages_of(group_report(results_of(0, 0, 0), {}, facts())) == 1
    empty = results_of(1, 2, 0)
    assert pages_of(student_report(empty, empty.board.students[0], {}, facts())) == 1


def test_a_best_near_the_mark_is_marked_in_a_report_and_the_sign_is_explained(drawn):
    results, place = results_of(2, 1, 3), ("p-1", "exercise-0")
    explained = "≈ the best is within the error of measurement of the mark."
    group_report(results, {}, facts())
    assert explained not in [words for page in drawn() for words in page]
    near = replace(results.board.cells[place], near_mark=True)
    board = replace(results.board, cells={**results.board.cells, place: near})
    group_report(replace(results, board=board), {}, facts())
    texts = [words for page in drawn() for words in page]
    assert explained in texts
    assert texts.count("≈") == 1


def test_a_limit_of_the_course_stands_beside_what_competence_takes():
    results = results_of(1, 1, 5)
    (item,), (person,) = results.board.items, results.board.students
    counted = len(results.board.counted[person.key, item.exercise])
    limited = replace(results.board, items=(item.model_copy(update={"attempts": counted + 1}),))
    assert results.board.attempts_left(person.key, item.exercise) is None
    assert limited.attempts_left(person.key, item.exercise) == 1
    assert "the course allows 1" in competence_line(limited, person.key, item.exercise)
    assert "allows" not in competence_line(results.board, person.key, item.exercise)


def test_reports_say_which_points_pass_as_the_newest_attempt_was_judged(drawn, monkeypatch):
    results = results_of(1, 2, 2)

    def judged(attempt):
        return 72.5 if attempt.id == "a0-1-1" else 60.0

    monkeypatch.setattr(Indexed, "pass_mark", property(judged))
    (person,) = results.board.students
    group_report(results, {}, facts())
    assert [word for page in drawn() for word in page].count("72.5") == 1
    student_report(results, person, {}, facts())
    assert [word for page in drawn() for word in page].count("72.5") == 2


def test_a_student_s_report_names_course_venue_and_dates_and_can_be_signed(drawn):
    results = results_of(1, 1, 3)
    (person,) = results.board.students
    student_report(results, person, {}, facts(place="Basel, Theatre 2"))
    words = [word for page in drawn() for word in page]
    for wanted in ("Autumn", "Basel, Theatre 2", "2026-10-01 to 2026-10-03", "Place, date"):
        assert wanted in words, wanted
    assert words.count("Instructor") == words.count("Student") == 1


def test_a_report_by_command_is_in_the_language_of_its_reader(tmp_path):
    script = """
import sys
from pathlib import Path
from app.views.kit.text import tr
from app.views.people.results_report import write_report
write_report(Path(sys.argv[1]), lambda: tr("Report of a group").encode())
"""
    place = {"LC_ALL": "de_DE.UTF-8", "ACUS_DATA": str(tmp_path), "QT_QPA_PLATFORM": "offscreen"}
    command = [sys.executable, "-c", script, str(tmp_path / "report.pdf")]
    subprocess.run(command, check=True, env=os.environ | place, timeout=120)
    assert (tmp_path / "report.pdf").read_text() == "Bericht einer Gruppe"
