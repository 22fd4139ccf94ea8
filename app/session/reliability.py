"""How far the scores of a course can be relied on, from the attempts that count on its board.

Of each student the newest attempts at an exercise are taken, as many at most of everybody, so that
nobody who practises much decides alone. What a script did is no person's, and is on no board.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence, sentence_of
from app.scoring.errors import ReliabilityError
from app.scoring.reliability import (
    Agreement,
    DecisionStudy,
    ItemStatistics,
    ScoreCube,
    VarianceComponents,
    intraclass,
    item_statistics,
    variance_components,
    within_student_sd,
)
from app.scoring.reliability.dependability import WANTED
from app.session.board import ProgressBoard
from app.session.course import CourseItem
from app.session.index import Indexed

AT_MOST: Final = 5
"""So many attempts of a student at an exercise are taken, the newest."""

COUNTS: Final = (1, 2, 3, 5, 8, 12)
"""Numbers of attempts that G and Phi are told of."""


@dataclass(frozen=True, slots=True)
class ExerciseReliability:
    """One exercise of a course.

    Attributes:
        exercise, version: which.
        students: with attempts that count.
        attempts: that were taken.
        statistics: among the other exercises; None where students lack some.
        mean: points; the difficulty is a hundredth of it.
        score_error: standard error of a single score, of students who repeated it; None without.
        agreement: of a student's attempts with each other (2,1); None without.
        pass_mark: points; None where no score says.
        near_mark: students whose best lies within the standard error of a score of that mark.
    """

    exercise: str
    version: int
    students: int
    attempts: int
    statistics: ItemStatistics | None
    mean: float
    score_error: float | None
    agreement: Agreement | None
    pass_mark: float | None
    near_mark: tuple[str, ...]

    @property
    def attempts_wanted(self) -> int | None:
        """Return how many attempts have a mean of which 0.8 is reliable; None where none has."""
        if self.agreement is None or self.agreement.value <= 0.0:
            return None
        single = self.agreement.value
        needed = WANTED / (1.0 - WANTED) * (1.0 - single) / single
        return max(1, int(np.ceil(needed - 1e-9)))

    def document(self) -> dict[str, Any]:
        """JSON-ready mapping; the keys stand in docs/json.md."""
        return {
            "exercise": self.exercise,
            "version": self.version,
            "students": self.students,
            "attempts": self.attempts,
            "difficulty": self.mean / 100.0,
            "discrimination": None if self.statistics is None else self.statistics.discrimination,
            "score_error": self.score_error,
            "agreement": None if self.agreement is None else agreement_document(self.agreement),
            "attempts_wanted": self.attempts_wanted,
            "pass_mark": self.pass_mark,
            "near_mark": list(self.near_mark),
        }


@dataclass(frozen=True, slots=True)
class CourseReliability:
    """A course, or all exercises that were attempted.

    Attributes:
        students: with attempts that count.
        attempts: that were taken.
        components: of variance; None where the attempts do not tell them apart.
        agreement: of exercises with each other, all six forms; empty where too few students have
            all of them.
        complete: students who have all exercises.
        exercises: one by one.
        notes: what could not be told, and what to do; a line each.
    """

    students: int
    attempts: int
    components: VarianceComponents | None
    agreement: tuple[Agreement, ...]
    complete: int
    exercises: tuple[ExerciseReliability, ...]
    notes: tuple[str, ...]

    @property
    def study(self) -> DecisionStudy | None:
        """Return what other numbers of exercises and attempts would give."""
        return None if self.components is None else DecisionStudy(self.components)

    def decision(self) -> dict[str, Any] | None:
        """Return G and Phi as it was, and with other numbers of attempts; keys as in docs/json.md.

        None where the attempts do not tell the components.
        """
        study, components = self.study, self.components
        if study is None or components is None:
            return None
        exercises, occasions = components.exercises, components.occasions
        counts = sorted({*COUNTS, occasions}) if study.sees_attempts else [1]
        return {
            "exercises": exercises,
            "attempts": occasions,
            "rows": [
                {
                    "attempts": count,
                    "g": study.coefficient(exercises, count),
                    "g_interval": _limits(study.interval(exercises, count)),
                    "phi": study.coefficient(exercises, count, absolute=True),
                    "phi_interval": _limits(study.interval(exercises, count, absolute=True)),
                    "relative_error": study.standard_error(exercises, count, absolute=False),
                    "absolute_error": study.standard_error(exercises, count),
                }
                for count in counts
            ],
            "attempts_for_g": study.attempts_for(exercises),
            "attempts_for_phi": study.attempts_for(exercises, absolute=True),
            "exercises_for_g": study.exercises_for(occasions),
            "exercises_for_phi": study.exercises_for(occasions, absolute=True),
            "score_error": {
                "relative": study.standard_error(absolute=False),
                "absolute": study.standard_error(),
            },
        }

    def lines(self) -> tuple[str, ...]:
        """Say it in a few lines, for a report and the board."""
        study, components, lines = self.study, self.components, list[str]()
        if study is not None and components is not None:
            there = (components.exercises, components.occasions)
            for name, absolute in (("G", False), ("Phi", True)):
                lines.append(
                    sentence(
                        "{name} {coefficient:.2f}{interval}: {meaning}, of a mean of {exercises} "
                        "exercises with {attempts} attempts at each",
                        name=name,
                        coefficient=study.coefficient(*there, absolute),
                        interval=_between(study.interval(*there, absolute)),
                        meaning=sentence("how far it holds a student against a mark")
                        if absolute
                        else sentence("how far it ranks students"),
                        exercises=there[0],
                        attempts=there[1],
                    )
                )
            lines.append(
                sentence(
                    "a single score is good to ± {error:.1f} points",
                    error=study.standard_error(),
                )
            )
        for one in self.agreement:
            if one.form == "2,k":
                lines.append(
                    sentence(
                        "ICC(2,k) {coefficient:.2f}{interval}: agreement of the exercises, of the "
                        "{students} students who have them all",
                        coefficient=one.value,
                        interval=_between((one.lower, one.upper)),
                        students=self.complete,
                    )
                )
        return tuple(lines)


def _limits(interval: tuple[float, float] | None) -> dict[str, float] | None:
    return None if interval is None else {"lower": interval[0], "upper": interval[1]}


def _between(interval: tuple[float, float] | None) -> str:
    if interval is None:
        return ""
    return sentence(" ({lower:.2f} to {upper:.2f})", lower=interval[0], upper=interval[1])


def agreement_document(agreement: Agreement) -> dict[str, Any]:
    """JSON-ready mapping of an intraclass correlation."""
    return {
        "form": agreement.form,
        "value": agreement.value,
        "lower": agreement.lower,
        "upper": agreement.upper,
    }


def course_reliability(board: ProgressBoard, at_most: int = AT_MOST) -> CourseReliability:
    """Return how far the scores of a board can be relied on.

    Args:
        board: whose counted attempts are taken.
        at_most: attempts of a student at an exercise.

    Raises:
        ReliabilityError: under 2 students, where each has one attempt, or where nothing varies.
    """
    taken = {
        place: [one for one in some if one.total is not None][-at_most:]
        for place, some in board.counted.items()
    }
    taken = {place: some for place, some in taken.items() if some}
    students = [one for one in board.students if any(key == one.key for key, _ in taken)]
    items = [one for one in board.items if any(name == one.exercise for _, name in taken)]
    cube = _cube([one.key for one in students], items, taken)
    notes: list[str] = []
    components = _components(ScoreCube(cube), notes)
    names = [one.pseudonym for one in students]
    agreement, statistics, complete = _across(cube, names, items, notes)
    known = {one.key: one.pseudonym for one in students}
    exercises = tuple(
        _exercise(
            item,
            {key: some for (key, name), some in taken.items() if name == item.exercise},
            board,
            known,
            statistics[place] if statistics else None,
        )
        for place, item in enumerate(items)
    )
    scripted = sum(dict(cell.why).get("scripted", 0) for cell in board.cells.values())
    if scripted:
        notes.append(
            sentence("{attempts} attempts were left out: scripts, not people", attempts=scripted)
        )
    return CourseReliability(
        students=len(students),
        attempts=sum(map(len, taken.values())),
        components=components,
        agreement=agreement,
        complete=complete,
        exercises=exercises,
        notes=tuple(notes),
    )


def reliability_lines(board: ProgressBoard) -> tuple[str, ...]:
    """Say how far the scores of a board can be relied on, or in one line why that is not known."""
    try:
        result = course_reliability(board)
    except ReliabilityError as error:
        return (sentence_of(error),)
    return (*result.lines(), *result.notes)


def _cube(
    keys: Sequence[str],
    items: Sequence[CourseItem],
    taken: Mapping[tuple[str, str], Sequence[Indexed]],
) -> FloatArray:
    occasions = max(map(len, taken.values()), default=1)
    cube = np.full((len(keys), len(items), occasions), np.nan)
    for row, key in enumerate(keys):
        for column, item in enumerate(items):
            for place, one in enumerate(taken.get((key, item.exercise), ())):
                cube[row, column, place] = one.total
    return cube


def _components(cube: ScoreCube, notes: list[str]) -> VarianceComponents | None:
    try:
        components = variance_components(cube)
    except ReliabilityError as error:
        notes.append(sentence_of(error))
        return None
    if components.exercises == 1:
        notes.append(
            sentence(
                "one exercise only: how students would do at others is not known; have them do a "
                "second one"
            )
        )
    if components.occasions == 1:
        notes.append(
            sentence(
                "one attempt each: how far a second one would differ is not known; have some "
                "students repeat an exercise"
            )
        )
    return components


def _across(
    cube: FloatArray, names: Sequence[str], items: Sequence[CourseItem], notes: list[str]
) -> tuple[tuple[Agreement, ...], tuple[ItemStatistics, ...], int]:
    """Return agreement of exercises, each one's statistics, and how many students have them all."""
    there = np.isfinite(cube)
    counts = there.sum(axis=2)
    sums = np.where(there, cube, 0.0).sum(axis=2)
    has_all = (counts > 0).all(axis=1)
    lacking = np.argwhere(counts == 0)
    if len(lacking):
        row, column = lacking[0]
        notes.append(
            sentence(
                "{student} has no attempt at {exercise} that counts, and {cells} such cells are "
                "empty in all: agreement and discrimination are of the {complete} students who "
                "have every exercise",
                student=names[row],
                exercise=items[column].exercise,
                cells=len(lacking),
                complete=int(has_all.sum()),
            )
        )
    complete = int(has_all.sum())
    if len(items) < 2 or complete < 2:
        return (), (), complete
    means = sums[has_all] / counts[has_all]
    try:
        return intraclass(means), item_statistics(means), complete
    except ReliabilityError as error:
        notes.append(sentence_of(error))
        return (), item_statistics(means), complete


def _exercise(
    item: CourseItem,
    taken: Mapping[str, Sequence[Indexed]],
    board: ProgressBoard,
    known: Mapping[str, str],
    statistics: ItemStatistics | None,
) -> ExerciseReliability:
    points = {key: [one.total or 0.0 for one in some] for key, some in taken.items()}
    error, agreement = _repeated(list(points.values()))
    newest = max((some[-1] for some in taken.values()), key=lambda one: one.started)
    mark = newest.pass_mark
    best = {key: board.cells[key, item.exercise].best for key in taken}
    near = [
        known[key]
        for key, total in best.items()
        if total is not None and error is not None and mark is not None
        if abs(total - mark) <= error
    ]
    return ExerciseReliability(
        exercise=item.exercise,
        version=item.version,
        students=len(taken),
        attempts=sum(map(len, taken.values())),
        statistics=statistics,
        mean=float(np.mean([np.mean(own) for own in points.values()])),
        score_error=error,
        agreement=agreement,
        pass_mark=mark,
        near_mark=tuple(sorted(near, key=str.casefold)),
    )


def _repeated(points: Sequence[Sequence[float]]) -> tuple[float | None, Agreement | None]:
    """Return the standard error of a score and the agreement of attempts, None without either.

    The agreement is of as many attempts as each student has who repeated the exercise.
    """
    several = [own for own in points if len(own) > 1]
    try:
        error = within_student_sd(several)[0]
    except ReliabilityError:
        return None, None
    count = min(map(len, several))
    try:
        forms = intraclass(np.array([own[-count:] for own in several]))
    except ReliabilityError:
        return error, None
    return error, next(one for one in forms if one.form == "2,1")
