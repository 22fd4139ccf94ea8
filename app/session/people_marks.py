"""Pass marks of an exercise from people: whose attempts and judgements may set one.

What scripts do sets none, whatever they are called: `scripts, not people`.
"""

from __future__ import annotations

import datetime
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from app.core.messages import sentence
from app.exercises.schema import Exercise
from app.scoring.errors import ReliabilityError
from app.scoring.pass_mark import SetMark
from app.scoring.reliability import within_student_sd
from app.scoring.standard_setting import PassMark
from app.session.board import progress_board
from app.session.course import CourseItem
from app.session.errors import ScriptsSetNoMarkError, SessionError
from app.session.index import Indexed
from app.session.people import Person, Remarks
from app.session.people_bands import EACH
from app.simulation.skills import SKILLS


@dataclass(frozen=True, slots=True)
class Rating:
    """One global rating: of which attempt, by how much, and where it stands, for messages."""

    attempt: str
    rating: float
    where: str


@dataclass(frozen=True, slots=True)
class RatedAttempts:
    """Attempts with the mean of their ratings.

    Attributes:
        ratings, points: of each attempt.
        people: how many persons did them.
    """

    ratings: tuple[float, ...]
    points: tuple[float, ...]
    people: int


def refuse_scripts(names: Iterable[str]) -> None:
    """Let nobody set a mark who is called as a scripted skill is.

    Raises:
        ScriptsSetNoMarkError: naming the first.
    """
    for name in names:
        if name.casefold() in SKILLS:
            raise ScriptsSetNoMarkError(
                sentence(
                    "{name!r} is a scripted skill: scripts, not people, and scripts set no mark; "
                    "name a group of people, or judges",
                    name=name,
                )
            )


def rated_attempts(
    ratings: Sequence[Rating],
    exercise: Exercise,
    attempts: Sequence[Indexed],
    remarks: Mapping[str, Remarks],
) -> RatedAttempts:
    """Return the points of rated attempts; of several ratings of one the mean.

    Args:
        ratings: of the sheet.
        exercise: with its version.
        attempts: everybody's.
        remarks: of the instructor, by id of the attempt.

    Raises:
        ScriptsSetNoMarkError: for an attempt of a script.
        SessionError: for one that is not there, of another exercise or version, or that does not
            count; says where it stands.
    """
    known = {one.id: one for one in attempts}
    given: dict[str, list[float]] = {}
    for each in ratings:
        attempt = known.get(each.attempt)
        problem = _problem(each.attempt, attempt, exercise, remarks)
        if problem:
            refusal = (
                ScriptsSetNoMarkError
                if attempt is not None and not attempt.conditions.by_person
                else SessionError
            )
            raise refusal(sentence("{where}: {reason}", where=each.where, reason=problem))
        given.setdefault(each.attempt, []).append(each.rating)
    return RatedAttempts(
        ratings=tuple(float(np.mean(own)) for own in given.values()),
        points=tuple(known[name].total or 0.0 for name in given),
        people=len({known[name].student for name in given}),
    )


def _problem(
    name: str, attempt: Indexed | None, exercise: Exercise, remarks: Mapping[str, Remarks]
) -> str:
    """Say why an attempt cannot set a mark; empty if it can."""
    if attempt is None:
        return sentence("{name!r} is no attempt here: `acus session list` has the ids", name=name)
    if not attempt.conditions.by_person:
        return sentence(
            "{name!r} was done by a script: scripts, not people, and scripts set no mark; delete "
            "the row",
            name=name,
        )
    if (attempt.exercise, attempt.version) != (exercise.id, exercise.version):
        return sentence(
            "{name!r} is of {other}, version {other_version}, not of {exercise}, version "
            "{version}: delete the row",
            name=name,
            other=attempt.exercise,
            other_version=attempt.version,
            exercise=exercise.id,
            version=exercise.version,
        )
    said = remarks.get(name)
    if not attempt.counts or attempt.total is None or (said is not None and said.uncounted):
        return sentence(
            "{name!r} does not count (void, no score, a drill, or not this station's): delete the "
            "row",
            name=name,
        )
    return ""


def points_of_people(
    exercise: Exercise,
    people: Sequence[Person],
    attempts: Sequence[Indexed],
    remarks: Mapping[str, Remarks],
) -> list[list[float]]:
    """Return the points of each person's newest comparable attempts, as on the board."""
    item = CourseItem(exercise=exercise.id, version=exercise.version)
    now = datetime.datetime.now(datetime.UTC)
    board = progress_board(people, [item], attempts, remarks, now)
    return [[one.total or 0.0 for one in some][-EACH:] for some in board.counted.values()]


def set_mark(mark: PassMark, points: Sequence[Sequence[float]]) -> SetMark:
    """Return what an exercise says of a mark, rounded as it is shown.

    Args:
        mark: as a method gives it.
        points: of people's attempts, which tell the standard error of a score where two repeated.
    """
    try:
        score_error: float | None = round(within_student_sd(points)[0], 2)
    except ReliabilityError:
        score_error = None
    return SetMark(
        method=mark.method,
        points=round(mark.points, 1),
        standard_error=round(mark.standard_error, 2),
        people=mark.people,
        score_error=score_error,
    )


def with_mark(exercise: Exercise, mark: SetMark) -> Exercise:
    """Return an exercise with another pass mark; kept, it is another version."""
    rules = exercise.rules.model_copy(update={"pass_mark": mark.points, "mark": mark})
    return exercise.model_copy(update={"rules": rules})
