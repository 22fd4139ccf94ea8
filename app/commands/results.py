"""`acus results`: who stands where, and tables that leave."""

import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands import completion
from app.commands.answer import Answer, Commands
from app.commands.doors import instructor, secret
from app.commands.people import Pseudonym
from app.commands.reader_language import local, template
from app.commands.record_options import RecordsFolder
from app.commands.results_reliability import board_at, reliability, results_at
from app.commands.shown import Each
from app.core.messages import Sentence, counted, joined, sentence

if TYPE_CHECKING:
    from app.exchange.moodle import GradeRule
    from app.exchange.results import Results

CourseOption = Annotated[
    str,
    typer.Option(
        "--course",
        help="Its id; without one every exercise that was attempted.",
        autocompletion=completion.courses,
    ),
]
GroupOption = Annotated[str, typer.Option("--group", help="Only students of this group.")]
PASSWORD = "ACUS_LRS_PASSWORD"
PDF = "pdf"
"""Form of `results export` beside those of `exchange.results`: Qt draws it."""


RANK = 110


def register(app: typer.Typer) -> None:
    """Add `results board`, `curve`, `reliability`, `export`, `xapi`, `lrs` and `send`."""
    results = Commands(help="Results of students and groups.")
    results.command("board")(board)
    results.command("curve")(curve)
    results.command("reliability")(reliability)
    results.command("export")(export)
    results.command("xapi")(xapi)
    results.command("lrs")(lrs)
    results.command("send")(send)
    app.add_typer(results, name="results")


def board(
    course: CourseOption = "", group: GroupOption = "", folder: RecordsFolder = None
) -> Answer:
    """Show best, last, trend, time since, competence (instructor).

    Only comparable attempts count, none of a scripted trainee or an emulated board.
    """
    from app.exchange.results import board_rows

    instructor()
    found, _, _ = board_at(course, group, folder)
    rows = board_rows(found)
    lines = [
        joined("", (f"{row['pseudonym']:20} {row['exercise']:24} ", _cell(row))) for row in rows
    ]
    nothing = sentence("nobody and nothing to show: add students first")
    return Answer({"cells": rows}, lines or [nothing])


def curve(
    pseudonym: Pseudonym,
    exercise: Annotated[str, typer.Argument(metavar="EXERCISE", help="Its id.")],
    course: CourseOption = "",
    folder: RecordsFolder = None,
) -> Answer:
    """Show a student's points, median, competence (instructor)."""
    from app.exchange.results import competence_document
    from app.session.people import People

    instructor()
    person = People().find(pseudonym)
    found, _, _ = board_at(course, "", folder)
    points = found.curve(person.key, exercise)
    standing = competence_document(found, person.key, exercise)
    facts = {
        "pseudonym": person.pseudonym,
        "exercise": exercise,
        "points": [
            {
                "attempt": p.attempt,
                "started": p.started,
                "total": p.total,
                "best": p.best,
                "median": p.median,
            }
            for p in points
        ],
        "competence": standing,
    }
    row = template("{started:@}  {total:5.1f}  best {best:5.1f}  median {median:5.1f}")
    nothing = sentence(
        "{pseudonym} has no attempt at {exercise} that counts",
        pseudonym=pseudonym,
        exercise=exercise,
    )
    lines = [nothing] if standing is None else [standing["words"]]
    return Answer(facts, lines, shown=Each("points", row))


def export(
    form: Annotated[str, typer.Argument(metavar="FORM", help="tidy, wide, moodle, json or pdf.")],
    out: Annotated[Path, typer.Option("--out", help="File to write.")],
    course: CourseOption = "",
    group: GroupOption = "",
    semicolons: Annotated[
        bool,
        typer.Option("--semicolons", help="For an Excel whose decimal sign is the comma."),
    ] = False,
    names: Annotated[bool, typer.Option("--names", help="Names too.")] = False,
    student: Annotated[
        str,
        typer.Option("--student", help="pdf: of this one.", autocompletion=completion.students),
    ] = "",
    identifier: Annotated[
        str, typer.Option("--identifier", help="moodle: username, email or idnumber.")
    ] = "",
    grade: Annotated[
        str, typer.Option("--grade", help="moodle, pdf: best, first, last, or mean:N of the last.")
    ] = "",
    feedback: Annotated[
        bool, typer.Option("--feedback", help="moodle: a column of feedback too.")
    ] = False,
    place: Annotated[str, typer.Option("--place", help="pdf: where the course was.")] = "",
    folder: RecordsFolder = None,
) -> Answer:
    """Write results as table, grades, JSON or report (instructor).

    tidy: a row for each metric of each attempt. wide: a row for each student. moodle: grades as
    Moodle's gradebook imports them. json: all of it. pdf: report of the group, or of one student.
    Ctrl-C cancels; a file is written whole or not at all.
    """
    from app.commands.calibrate_parts import with_progress
    from app.exchange.moodle import GradeRule, MoodleChoice, chance_words
    from app.exchange.results import ResultsFormat, results_text, write_results
    from app.session.accounts import Account
    from app.session.people import People

    forms = [*(one.value for one in ResultsFormat), PDF]
    if form not in forms:
        raise typer.BadParameter(
            sentence("{form}: the forms are {forms}", form=form, forms=", ".join(forms))
        )
    if student and form != PDF:
        raise typer.BadParameter(sentence("--student is for pdf; the tables hold everybody"))
    if identifier and identifier not in list(Account):
        raise typer.BadParameter(
            sentence(
                "{identifier}: Moodle knows students by username, email or idnumber",
                identifier=identifier,
            )
        )
    for_moodle = bool(identifier or feedback) and form != ResultsFormat.MOODLE
    if for_moodle or (grade and form not in (ResultsFormat.MOODLE, PDF)):
        raise typer.BadParameter(
            sentence("--identifier and --feedback are for moodle, --grade for moodle and pdf")
        )
    rule = GradeRule.of(grade or "best")
    instructor()
    results = results_at(course, group, folder, names)
    chance = ""
    if form == PDF:
        _write_report(results, out, student, course, group, rule, place)
    else:
        choice = MoodleChoice(Account(identifier or "username"), rule, feedback)
        told = (ResultsFormat(form), semicolons)
        text = with_progress(lambda progress: results_text(results, *told, progress, choice, local))
        write_results(out, text)
    if form == ResultsFormat.MOODLE or (form == PDF and not student):
        chance = chance_words(results.board, rule)
    shown_counts = template(
        "{attempts:#1 attempt|# attempts} of {students:#1 student|# students} written to {files}"
    )
    attempts, students = results.attempts, len(results.board.students)
    if student:
        key = People().find(student).key
        attempts, students = [one for one in attempts if one.student == key], 1
    counts = {"attempts": len(attempts), "students": students}
    facts = {"files": [out], **counts, "chance": chance}
    return Answer(facts, [chance] if chance else [], shown=shown_counts)


def xapi(
    home: Annotated[
        str,
        typer.Option("--home", help="Address that you own: ids begin with it, at every time."),
    ],
    out: Annotated[
        Path | None, typer.Option("--out", help="File: .json an array, else one a line.")
    ] = None,
    queue: Annotated[
        bool, typer.Option("--queue", help="Put what is new into the queue of what is to be sent.")
    ] = False,
    course: CourseOption = "",
    group: GroupOption = "",
    folder: RecordsFolder = None,
) -> Answer:
    """Write attempts as xAPI statements (instructor).

    Statements of the Experience API: students are accounts by pseudonym, and the same attempt is
    the same statement, whenever it is written. Void attempts, drills and what no person did are
    left out; in the queue they are taken back.
    """
    from app.commands.calibrate_parts import with_progress
    from app.exchange.results import write_results
    from app.exchange.xapi import (
        checked_home,
        statements,
        statements_text,
        voiding_statements,
    )
    from app.session.people import people_folder
    from app.session.statement_queue import FOLDER, StatementQueue

    checked_home(home)
    if out is None and not queue:
        raise typer.BadParameter(sentence("nothing to do: give --out FILE, --queue, or both"))
    instructor()
    results = results_at(course, group, folder, names=False)
    told = with_progress(lambda progress: statements(results, home, course, progress))
    if out is not None:
        write_results(out, statements_text(told, out.suffix.lower() == ".json"))
    waiting = StatementQueue(people_folder() / FOLDER)
    voided = waiting.take_back(voiding_statements(results, home)) if queue else 0
    new = waiting.put(told) if queue else 0
    facts = {
        "files": [] if out is None else [out],
        "statements": len(told),
        "new": new,
        "voided": voided,
        "waiting": len(waiting.waiting()),
    }
    shown = (
        template("{statements:#1 statement|# statements}{files:?, written to {files}|}"),
        template("queue: {new:#} new, {voided:#} taken back, {waiting:#1 waits|# wait} to be sent"),
    )
    return Answer(facts, shown=shown)


def lrs(
    url: Annotated[
        str, typer.Argument(metavar="URL", help="What stands before /statements; https.")
    ] = "",
    home: Annotated[
        str, typer.Option("--home", help="Address that you own: ids begin with it, at every time.")
    ] = "",
    user: Annotated[str, typer.Option("--user", help="Name, or key, that it gave you.")] = "",
    forget: Annotated[bool, typer.Option("--forget", help="Tell nothing any more.")] = False,
) -> Answer:
    """Tell attempts to a record store (LRS) (instructor).

    Without URL it says where it is and how many statements wait. The password is asked for, or
    stands in ACUS_LRS_PASSWORD. What answers is asked whether it is a record store before it is
    kept; the window sends from then on, and `acus results send`.
    """
    from app.exchange.lrs import Lrs, LrsPlace, place_of_lrs, put_lrs
    from app.session.people import People
    from app.session.statement_queue import FOLDER, StatementQueue

    people = People()
    instructor(people)
    known = None if forget else place_of_lrs(people.folder) if not url else None
    if forget:
        put_lrs(None, people.folder)
    elif url:
        if not home:
            raise typer.BadParameter(sentence("give --home: ids of statements begin with it"))
        known = LrsPlace(url, home, user).checked()
        if user:
            given = os.environ.get(PASSWORD)
            password = secret(sentence("Password")) if given is None else given
            known = LrsPlace(known.endpoint, known.home, user, password)
        Lrs(known).about()
        put_lrs(known, people.folder)
    number = len(StatementQueue(people.folder / FOLDER).waiting())
    facts = {
        "lrs": known and known.endpoint,
        "home": known and known.home,
        "user": (known and known.user) or None,
        "waiting": number,
    }
    shown = template("{lrs:?attempts are told to {lrs}|this station tells no record store}")
    lines = []
    if number:
        lines.append(
            counted(
                "{n} statement waits to be sent: `acus results send`",
                "{n} statements wait to be sent: `acus results send`",
                number,
            )
        )
    return Answer(facts, lines, shown=shown)


def send(
    folder: RecordsFolder = None,
) -> Answer:
    """Send attempts to the record store (instructor).

    The window does it by itself while it runs. What the store has taken leaves the queue; all else
    stays in it. Ends with code 3 if the store refuses a statement.
    """
    from app.commands.calibrate_parts import with_progress
    from app.exchange.lrs import LrsError, deliver, place_of_lrs, tell_attempts
    from app.session.people import People
    from app.session.statement_queue import FOLDER, StatementQueue

    people = People()
    instructor(people)
    place, queue = place_of_lrs(people.folder), StatementQueue(people.folder / FOLDER)
    if place is None:
        raise LrsError(
            sentence(
                "this station tells no record store: `acus results lrs URL --home ADDRESS` does"
            )
        )
    results = results_at("", "", folder, names=False)
    new = with_progress(lambda progress: tell_attempts(results, place, queue, progress=progress))
    done = with_progress(lambda progress: deliver(place, queue, progress))
    facts = {
        "lrs": place.endpoint,
        "new": new,
        "sent": done.sent,
        "waiting": done.waiting,
        "refused": list(done.refused),
    }
    shown = (
        template("{sent:#1 statement|# statements} sent; {waiting:#1 waits|# wait}"),
        Each("refused", template("✖ {}")),
    )
    return Answer(facts, yes=not done.refused, shown=shown)


def _write_report(
    results: "Results",
    out: Path,
    student: str,
    course: str,
    group: str,
    rule: "GradeRule",
    place: str,
) -> None:
    """Draw the report of the group, or of one student, and write it whole or not at all."""
    from app.commands.calibrate_parts import with_progress
    from app.session.course import find_course
    from app.session.people import People
    from app.session.stations import NAME_SETTING
    from app.views.people.group_report import group_report
    from app.views.people.report_facts import ReportFacts
    from app.views.people.results_report import student_report, write_report

    people, titles = People(), results.titles
    person = people.find(student) if student else None
    where = place or people.setting(NAME_SETTING)
    facts = ReportFacts(find_course(course).title if course else "", group, where, rule)
    with_progress(
        lambda progress: write_report(
            out,
            lambda: (
                group_report(results, titles, facts, progress)
                if person is None
                else student_report(results, person, titles, facts)
            ),
        )
    )


def _cell(row: dict[str, Any]) -> Sentence:
    """Return what a student did at one exercise."""
    points: str = "-"
    if row["attempts"]:
        trend = row["trend"]
        points = sentence(
            "best {best:3.0f}, last {last:3.0f}, {trend}, {attempts}, {days:.1f} days ago",
            best=row["best"],
            last=row["last"],
            trend=sentence("no trend yet")
            if trend is None
            else sentence("{change:+.1f} a time", change=trend),
            attempts=counted("{n} attempt", "{n} attempts", row["attempts"]),
            days=row["since_s"] / 86400.0,
        )
        if row["near_mark"]:
            near = sentence(", within the error of measurement of the mark")
            points = joined("", (points, near))
    others = sentence(" ({others} not counted)", others=row["others"]) if row["others"] else ""
    competent = ("; ", row["competence"]["words"]) if row["competence"] else ()
    return joined("", (points, others, *competent))
