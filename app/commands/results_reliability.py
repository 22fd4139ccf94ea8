"""`acus results reliability`: how far the scores of a course can be relied on."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands import completion
from app.commands.answer import Answer
from app.commands.doors import instructor
from app.commands.reader_language import template
from app.commands.record_options import RecordsFolder
from app.commands.shown import Each, Shown

if TYPE_CHECKING:
    from app.exchange.results import Results
    from app.session.board import ProgressBoard
    from app.session.index import Indexed
    from app.session.people import People
    from app.session.reliability import CourseReliability

SOURCES = {
    "student": template("student"),
    "exercise": template("exercise"),
    "occasion": template("attempt"),
    "student:exercise": template("student x exercise"),
    "student:occasion": template("student x attempt"),
    "exercise:occasion": template("exercise x attempt"),
    "residual": template("what is left"),
}
"""Names of the variance components, for people."""


def reliability(
    course: Annotated[
        str,
        typer.Option(
            "--course",
            help="Its id; without one every exercise that was attempted.",
            autocompletion=completion.courses,
        ),
    ] = "",
    group: Annotated[str, typer.Option("--group", help="Only students of this group.")] = "",
    last: Annotated[
        int, typer.Option("--last", min=1, help="So many newest attempts of each.")
    ] = 5,
    folder: RecordsFolder = None,
) -> Answer:
    """Show how far scores can be relied on (instructor).

    Variance by source, G and Phi with how many attempts reach 0.8, agreement, and of each exercise
    difficulty, discrimination and the standard error of a score.
    """
    from app.session.reliability import course_reliability

    instructor()
    board, _, _ = board_at(course, group, folder)
    result = course_reliability(board, last)
    return Answer(_facts(result, course, last), shown=_shown(result))


def board_at(
    course: str, group: str, folder: Path | None
) -> tuple["ProgressBoard", Sequence["Indexed"], "People"]:
    """Return board, attempts and people, as the instructor sees them."""
    from app.commands.calibrate_parts import with_progress
    from app.session.board import board_of
    from app.session.course import find_course
    from app.session.people import People
    from app.session.store import records_folder

    people, chosen = People(), find_course(course) if course else None
    place = records_folder(folder)
    found, attempts = with_progress(
        lambda progress: board_of(place, people, chosen, group, progress=progress)
    )
    return found, attempts, people


def results_at(course: str, group: str, folder: Path | None, names: bool) -> "Results":
    """Return the results of a course and a group, as they leave."""
    from app.commands.reader_language import known as in_words
    from app.exchange.results import Results
    from app.exercises.library import library
    from app.session.accounts import accounts_in

    found, attempts, people = board_at(course, group, folder)
    known = {person.key: person for person in people.everybody(names)}
    if course or group:
        shown = {person.key for person in found.students}
        attempts = [a for a in attempts if a.student in shown]
    if course:
        exercises = {item.exercise for item in found.items}
        attempts = [one for one in attempts if one.exercise in exercises]
    listed = {key: person.name for key, person in known.items()} if names else {}
    titles = {exercise.id: in_words(exercise.title) for exercise in library()}
    told = (people.remarks(), listed, accounts_in(people.names()), titles)
    return Results(found, attempts, known, *told)


def _facts(result: "CourseReliability", course: str, last: int) -> dict[str, Any]:
    from app.session.reliability import agreement_document

    return {
        "course": course,
        "students": result.students,
        "attempts": result.attempts,
        "last": last,
        "variance": _variance(result),
        "decision": result.decision(),
        "complete": result.complete,
        "agreement": [agreement_document(one) for one in result.agreement],
        "exercises": [one.document() for one in result.exercises],
        "notes": list(result.notes),
    }


def _variance(result: "CourseReliability") -> dict[str, Any] | None:
    components = result.components
    if components is None:
        return None
    total = components.total
    return {
        "estimator": components.estimator.value,
        "exercises": components.exercises,
        "occasions": components.occasions,
        "below_zero": list(components.below_zero),
        "components": [
            {
                "source": name,
                "title": SOURCES[name],
                "variance": variance,
                "share": variance / total if total else 0.0,
            }
            for name, variance in components.variances.items()
        ],
    }


def _shown(result: "CourseReliability") -> Shown:
    parts: list[str | Each] = [
        template(
            "{students} students, {attempts} attempts that count (the newest {last} of each at "
            "most)"
        )
    ]
    if result.components is not None:
        parts += [
            template("\nwhere the variance of a score comes from ({variance.estimator}, points²)"),
            Each("variance.components", "{variance:9.1f}  {share:>5.0%}  {title:~}"),
            *([BELOW] if result.components.below_zero else []),
            *_decision_lines(result),
        ]
    if result.agreement:
        parts += [
            template("\nagreement of the exercises, {complete} students who have them all"),
            Each("agreement", "  ICC({form})  {value:5.2f}  ({lower:.2f} … {upper:.2f})"),
        ]
    parts += [
        template(
            "\nexercise                  points   discr.   score ±   ICC(2,1)   for 0.8   near mark"
        ),
        Each(
            "exercises",
            "{exercise:24} {difficulty:8.0%}  {discrimination:?{discrimination:7.2f}|      –}"
            "  {score_error:?{score_error:8.1f}|       –}"
            "  {agreement:?{agreement.value:9.2f}|        –}"
            "  {attempts_wanted:?{attempts_wanted:8}|       –}   {near_mark:#}",
        ),
        Each("exercises", NEAR),
        Each("notes", template("note: {}")),
    ]
    return parts


NEAR = template(
    "{near_mark:?{exercise}: within the error of measurement of the mark ({pass_mark:g}) are "
    "{near_mark}|}"
)
BELOW = template("  below 0 by the closed form, taken as 0: {variance.below_zero}")


def _decision_lines(result: "CourseReliability") -> list[str | Each]:
    study = result.study
    lines: list[str | Each] = [
        template(
            "\na single score is good to ± {decision.score_error.absolute:.1f} points "
            "(± {decision.score_error.relative:.1f} between students)"
        ),
        template(
            "mean of {decision.exercises} exercises:  attempts     G    Phi   score ±   intervals "
            "of 95 %"
        ),
        Each(
            "decision.rows",
            "                      {attempts:9}  {g:4.2f}   {phi:4.2f}  {absolute_error:8.1f}"
            "{g_interval:?   G {g_interval.lower:.2f} … {g_interval.upper:.2f}"
            ", Phi {phi_interval.lower:.2f} … {phi_interval.upper:.2f}|}",
        ),
    ]
    if study is not None and study.sees_attempts:
        lines += [
            template(
                "G 0.8 {decision.attempts_for_g:?by {decision.attempts_for_g:#1 attempt|# attempts}"
                "|by no number of attempts} at each of these exercises, Phi 0.8 "
                "{decision.attempts_for_phi:?by {decision.attempts_for_phi}|by none}"
            )
        ]
    if study is not None and study.sees_exercises:
        lines += [
            template(
                "with {decision.attempts:#1 attempt|# attempts} each, G 0.8 "
                "{decision.exercises_for_g:?by {decision.exercises_for_g} such exercises"
                "|by no number of exercises}, Phi 0.8 "
                "{decision.exercises_for_phi:?by {decision.exercises_for_phi}|by none}"
            )
        ]
    return lines
