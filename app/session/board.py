"""The board of progress: who stands where in a course, by attempts that may be compared.

On the board and in curves only comparable attempts meet (`scoring.conditions.comparable`): of each
exercise those of the pinned version that the most were made under. Attempts of scripted trainees or
emulated boards, void ones and those that were altered after they were signed never count.
"""

from __future__ import annotations

import datetime
from collections import Counter, defaultdict
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise, product
from pathlib import Path
from statistics import median
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from app.core.messages import sentence
from app.core.progress import Progress
from app.exercises.schema import Exercise
from app.scoring.competence import RULE, Competence, CompetenceRule, competence
from app.scoring.conditions import Conditions, groups_of_tasks
from app.scoring.pass_mark import is_near_mark
from app.session.course import Course, CourseItem, courses, held_back, holding
from app.session.index import Index
from app.session.indexed import Attempts, Coded, Indexed, conditions_of, time_of
from app.session.people import PEOPLE, People, Person, Remarks, people_folder
from app.session.proficiency import IN_A_ROW, passes_in_a_row
from app.session.signature import Signed
from app.session.store import records

MEDIAN_OF: Final = 5
"""The moving median of a curve is over so many attempts."""

TREND_OF: Final = 8
"""The trend is that of so many last attempts, of three at least."""


@dataclass(frozen=True, slots=True)
class BoardCell:
    """How a student stands in an exercise, by attempts that may be compared.

    Attributes:
        attempts: how many count.
        best, last: points; None without one.
        trend: points per attempt over the last ones (Theil-Sen); None under three.
        passed: whether one of them passes.
        since: time since the last one; None without one.
        others: his attempts at this exercise that do not count here.
        why: of the others, each reason with how many.
        void: reasons of those that the instructor declared void, oldest first.
        near_mark: whether the best lies within the error of measurement of the pass mark.
    """

    attempts: int = 0
    best: float | None = None
    last: float | None = None
    trend: float | None = None
    passed: bool = False
    since: datetime.timedelta | None = None
    others: int = 0
    why: tuple[tuple[str, int], ...] = ()
    void: tuple[str, ...] = ()
    near_mark: bool = False

    def document(self) -> dict[str, Any]:
        """JSON-ready mapping; the keys stand in docs/json.md."""
        return {
            "attempts": self.attempts,
            "best": self.best,
            "last": self.last,
            "trend": self.trend,
            "passed": self.passed,
            "near_mark": self.near_mark,
            "since_s": None if self.since is None else self.since.total_seconds(),
            "others": self.others,
            "why": dict(self.why),
            "void": list(self.void),
        }


@dataclass(frozen=True, slots=True)
class CurvePoint:
    """One attempt of a student's curve: points, the best until then, the moving median."""

    attempt: str
    started: str
    total: float
    best: float
    median: float


@dataclass(frozen=True)
class ProgressBoard:
    """Students by exercises.

    Attributes:
        students: rows.
        items: columns.
        cells: by key of the student and id of the exercise.
        counted: attempts that count, in order of time, likewise.
        rule: by which a student is called competent.
        now: time that "since" is told from.
    """

    students: tuple[Person, ...]
    items: tuple[CourseItem, ...]
    cells: Mapping[tuple[str, str], BoardCell]
    counted: Mapping[tuple[str, str], Sequence[Indexed]]
    rule: CompetenceRule = RULE
    now: datetime.datetime | None = None

    def curve(self, key: str, exercise: str) -> list[CurvePoint]:
        """Return a student's curve in an exercise, oldest first."""
        found: list[CurvePoint] = []
        totals: list[float] = []
        for one in self.counted.get((key, exercise), ()):
            totals.append(one.total or 0.0)
            middle = median(totals[-MEDIAN_OF:])
            found.append(CurvePoint(one.id, one.started, totals[-1], max(totals), middle))
        return found

    def competence(self, key: str, exercise: str) -> Competence | None:
        """Return how a student stands at the skill of an exercise; None without an attempt.

        It is told when it is asked for: of a large board most cells never are.

        Raises:
            CompetenceError: if no test keeps the course's rule.
        """
        place = (key, exercise)
        if place not in self._competences and (some := self.counted.get(place)):
            passed, times = [bool(one.passed) for one in some], [one.time for one in some]
            self._competences[place] = competence(passed, times, self.now, self.rule)
        return self._competences.get(place)

    def pass_mark(self, exercise: str) -> float | None:
        """Return the points that the newest attempt that counts had to reach; None without one."""
        some = [those[-1] for (_, name), those in self.counted.items() if name == exercise]
        return max(some, key=lambda one: one.started).pass_mark if some else None

    def attempts_left(self, key: str, exercise: str) -> int | None:
        """Return how many attempts the course still allows at most; None without a limit."""
        limit = next((one.attempts for one in self.items if one.exercise == exercise), None)
        return None if limit is None else max(0, limit - len(self.counted.get((key, exercise), ())))

    def tell_competence(self) -> None:
        """Tell it of every cell now, so that nobody waits for it later."""
        for person in self.students:
            for item in self.items:
                self.competence(person.key, item.exercise)

    @cached_property
    def _competences(self) -> dict[tuple[str, str], Competence]:
        return {}


def progress_board(
    students: Sequence[Person],
    items: Sequence[CourseItem],
    attempts: Sequence[Indexed],
    remarks: Mapping[str, Remarks],
    now: datetime.datetime,
    held: Container[str] = (),
    rule: CompetenceRule = RULE,
) -> ProgressBoard:
    """Make the board.

    Args:
        students: rows.
        items: columns.
        attempts: of the index, oldest first.
        remarks: what the instructor said, by attempt.
        now: time that "since" is told from.
        held: attempts whose results are not open to who looks at the board.
        rule: by which a student is called competent.
    """
    whole, of_exercise = Attempts.of(attempts), {item.exercise: item for item in items}
    columns, rows = numbered(of_exercise), numbered(one.key for one in students)
    if not rows or not columns:
        return ProgressBoard(tuple(students), tuple(items), {}, {}, rule, now)
    column, row = whole.exercise.within(columns), whole.student.within(rows)
    on_board = np.flatnonzero((column >= 0) & (row >= 0))
    some, cell = whole.taken(on_board), (row * len(columns) + column)[on_board]
    reasons = _why_not(some, list(of_exercise.values()), column[on_board], remarks, held)
    for exercise, k in columns.items():
        taken = np.flatnonzero((column[on_board] == k) & (reasons.codes == 0))
        if len(taken):
            used, codes = np.unique(some.task.codes[taken], return_inverse=True)
            tasks = [conditions_of(some.task.texts[code], exercise) for code in used]
            groups = groups_of_tasks(tasks, codes, some.dial[taken])
            reasons.codes[taken[groups != _largest(groups)]] = 1
    in_cells = np.argsort(cell, kind="stable")
    ends = np.searchsorted(cell[in_cells], np.arange(len(rows) * len(columns) + 1))
    places = list(product(rows, columns))
    members = {
        place: in_cells[begin:end]
        for place, (begin, end) in zip(places, pairwise(ends.tolist()), strict=True)
        if end > begin
    }
    counted = {place: ks[reasons.codes[ks] == 0] for place, ks in members.items()}
    counted = {place: ks for place, ks in counted.items() if len(ks)}
    left = {place: ks[reasons.codes[ks] > 0] for place, ks in members.items()}
    totals = np.nan_to_num(some.total)
    trends = _trends(totals, counted)
    void = {name: said.void for name, said in remarks.items() if said.void}
    empty = np.empty(0, np.int64)
    cells = {
        place: _cell(
            some,
            totals,
            counted.get(place, empty),
            Counter(reasons.texts[code] for code in reasons.codes[left.get(place, empty)].tolist()),
            trends.get(place),
            now,
            tuple(void[some.ids[k]] for k in left.get(place, empty).tolist() if some.ids[k] in void)
            if void
            else (),
        )
        for place in places
    }
    return ProgressBoard(tuple(students), tuple(items), cells, Counted(some, counted), rule, now)


def numbered(names: Iterable[str]) -> dict[str, int]:
    """Return the place of each name, the first of several."""
    return {name: number for number, name in enumerate(dict.fromkeys(names))}


@dataclass(frozen=True)
class Counted(Mapping[tuple[str, str], "Sequence[Indexed]"]):
    """Attempts that count, by key of the student and id of the exercise; made when asked for."""

    attempts: Attempts
    places: Mapping[tuple[str, str], NDArray[np.int64]]

    def __getitem__(self, place: tuple[str, str]) -> Sequence[Indexed]:
        return self.attempts.taken(self.places[place])

    def __iter__(self) -> Iterator[tuple[str, str]]:
        return iter(self.places)

    def __len__(self) -> int:
        return len(self.places)


def _why_not(
    some: Attempts,
    items: Sequence[CourseItem],
    column: NDArray[np.int64],
    remarks: Mapping[str, Remarks],
    held: Container[str],
) -> Coded:
    """Return why attempts count nowhere: number 0 where they do; 1 is for other conditions.

    Asked once for all that are alike in what decides; and for each of which something was said.
    """
    known = {"": 0, sentence("made under other conditions than most"): 1}
    alike = np.zeros(len(some), np.int64)
    for part in (
        some.verdict.codes,
        some.stands,
        some.counts,
        some.version,
        some.task.codes,
        column,
    ):
        _, codes = np.unique(part, return_inverse=True)
        _, alike = np.unique(alike * (codes.max(initial=0) + 1) + codes, return_inverse=True)
    _, first = np.unique(alike, return_index=True)

    def number(place: int, remark: Remarks | None) -> int:
        item = items[column[place]]
        why = _why_not_counted(some[place], some.task_of(place), item, remark)
        return known.setdefault(why, len(known))

    codes = np.array([number(place, None) for place in first.tolist()] or [0], np.int64)
    codes = codes[alike]
    special = {name for name, said in remarks.items() if said.void or said.excess}
    if special or held:
        for place, name in enumerate(some.ids):
            if name in held:
                codes[place] = known.setdefault(sentence("not released yet"), len(known))
            elif name in special:
                codes[place] = number(place, remarks[name])
    return Coded(tuple(known), codes)


def board_of(
    folder: Path,
    people: People,
    course: Course | None = None,
    group: str = "",
    now: datetime.datetime | None = None,
    progress: Progress | None = None,
    released: bool = False,
) -> tuple[ProgressBoard, Attempts]:
    """Return the board of a folder of records, and all attempts in it, oldest first.

    Args:
        folder: of the records.
        people: of this station.
        course: None takes every exercise that was attempted, in its newest version.
        group: of students; empty takes all who take the course.
        now: time that "since" is told from.
        progress: reports, and may cancel.
        released: leave out results that a course holds back, as a student sees the board.

    Raises:
        SessionError: if something cannot be read.
    """
    index = Index(folder)
    index.refresh(progress)
    attempts = Attempts.of(index.attempts())
    students = [
        person
        for person in people.everybody()
        if (not group or group in person.groups) and (course is None or course.takes(person))
    ]
    own = attempts.of_students(list(people.pseudonyms()))
    items = course.items if course is not None else every_item(own)
    now = now or datetime.datetime.now(datetime.UTC)
    asked = ((one.id, one.student, one.exercise, one.version) for one in own)
    held = held_back(asked) if released else {}
    rule = course.competence if course is not None else RULE
    board = progress_board(students, items, own, people.remarks(), now, held, rule)
    return board, attempts


def every_item(attempts: Sequence[Indexed]) -> list[CourseItem]:
    """Return an item for each exercise with an attempt that stands, in its newest version."""
    some, newest = Attempts.of(attempts), dict[str, int]()
    for code, name in enumerate(some.exercise.texts):
        versions = some.version[(some.exercise.codes == code) & some.stands]
        if name and len(versions):
            newest[name] = max(1, int(versions.max()))
    found = []
    for name, version in sorted(newest.items()):
        try:
            found.append(CourseItem(exercise=name, version=version))
        except ValidationError:
            continue  # a record with an id that no exercise can have
    return found


@dataclass(frozen=True, slots=True)
class Standing:
    """How far somebody has come in an exercise.

    Attributes:
        attempts: how many count.
        best: points; None where there are none, or none that may be told.
        passed: whether one passes that may be told.
        in_a_row: of one person: how many of the newest attempts passed one after the other, two at
            most; of everybody the most that a person has.
        masters: how many persons master it: of one person 0 or 1.
    """

    attempts: int = 0
    best: float | None = None
    passed: bool = False
    in_a_row: int = 0
    masters: int = 0


def standings(
    folder: Path,
    exercises: Sequence[Exercise],
    student: Person | None,
    may_see: Callable[[str], bool] = lambda _: True,
) -> dict[str, Standing]:
    """Return how far a student has come, or everybody at this station, by id of the exercise.

    Attempts at other versions do not count, nor what never counts on the board. A result that the
    instructor has not released is an attempt and nothing more.

    Args:
        folder: of the records; one without any gives nothing, and nothing is written there.
        exercises: that there are.
        student: whose attempts; None for those of everybody.
        may_see: without a student: whether attempts of whom a record names are open.

    Raises:
        SessionError: if something cannot be read.
    """
    if not any(True for _ in records(folder)):
        return {}
    index, people = Index(folder), People()
    index.refresh()
    there = (people_folder() / PEOPLE).exists()
    remarks = people.remarks() if there else {}
    known = {one.key: one for one in people.everybody()} if there else {}
    taken, (some_courses, _) = {one.id: one for one in exercises}, courses()
    found: dict[str, Standing] = {}
    passed: dict[str, dict[str, list[bool]]] = defaultdict(lambda: defaultdict(list))
    attempts = Attempts.of(index.attempts())
    for place, one in enumerate(attempts):
        exercise = taken.get(one.exercise)
        mine = one.student == student.key if student is not None else may_see(one.student)
        if exercise is None or not mine:
            continue
        item, said = CourseItem(exercise=exercise.id, version=exercise.version), remarks.get(one.id)
        if _why_not_counted(one, attempts.task_of(place), item, said):
            continue
        released = said is not None and said.released
        held = holding(some_courses, known.get(one.student), one.exercise, one.version, released)
        if not held:
            passed[one.exercise][one.student].append(bool(one.passed))
        before = found.get(one.exercise, Standing())
        totals = [total for total in (before.best, one.total) if total is not None]
        found[one.exercise] = Standing(
            before.attempts + 1,
            before.best if held else max(totals, default=None),
            before.passed or (bool(one.passed) and not held),
        )
    for name, persons in passed.items():
        rows = [passes_in_a_row(one) for one in persons.values()]
        masters = sum(row >= IN_A_ROW for row in rows)
        found[name] = replace(found[name], in_a_row=max(rows), masters=masters)
    return found


def _why_not_counted(
    entry: Indexed, known: Conditions, item: CourseItem, answer: Remarks | None
) -> str:
    if entry.verdict == Signed.ALTERED:
        return sentence("altered after it was signed")
    if answer is not None and answer.void:
        return sentence("declared void by the instructor")
    if answer is not None and answer.excess:
        return sentence("beyond the attempts that the course allows")
    if not entry.stands:
        return sentence("not sealed by this station")
    if not entry.counts:
        if not known.by_person:
            by_arm = known.hand == "arm"
            return sentence("carried out by the arm") if by_arm else sentence("scripted")
        if known.drill:
            return sentence("a drill")
        emulated = known.kind == "emulated"
        return sentence("emulated robot") if emulated else sentence("not scored or void")
    if entry.version != item.version:
        return sentence("version {entry_version} of the exercise", entry_version=entry.version)
    if item.content and known.content != item.content:
        return sentence("the exercise said something else")
    return ""


def _largest(groups: NDArray[np.int64]) -> int:
    """Return the group with the most members; of equal ones that with the newest attempt."""
    counts = np.bincount(groups)
    last = np.zeros(len(counts), np.int64)
    np.maximum.at(last, groups, np.arange(len(groups)))
    return int(np.lexsort((last, counts))[-1])


def _cell(
    attempts: Attempts,
    total: NDArray[np.float64],
    places: NDArray[np.int64],
    left: Counter[str],
    trend: float | None,
    now: datetime.datetime,
    void: tuple[str, ...],
) -> BoardCell:
    others, why = left.total(), tuple(sorted(left.items()))
    if not len(places):
        return BoardCell(others=others, why=why, void=void)
    totals = total[places]
    best = int(places[totals.argmax()])
    return BoardCell(
        attempts=len(places),
        best=float(totals.max()),
        last=float(totals[-1]),
        trend=trend,
        passed=bool((attempts.passed[places] == 1).any()),
        since=now - time_of(attempts.started[places[-1]]),
        others=others,
        why=why,
        void=void,
        near_mark=bool(attempts.has_error[best])
        and is_near_mark(attempts[best].summary.score or {}),
    )


def _trends(
    total: NDArray[np.float64], cells: Mapping[tuple[str, str], NDArray[np.int64]]
) -> dict[tuple[str, str], float]:
    """Medians of the slopes between all pairs, after Theil (1950) and Sen (1968).

    Over the last `TREND_OF` of each cell, three at least; those of equal number all at once.
    """
    found: dict[tuple[str, str], float] = {}
    for number in range(3, TREND_OF + 1):
        alike = {
            place: ks[-number:]
            for place, ks in cells.items()
            if len(ks) == number or (number == TREND_OF and len(ks) > number)
        }
        if alike:
            totals = total[np.stack(list(alike.values()))]
            a, b = np.triu_indices(number, 1)
            slopes = np.median((totals[:, b] - totals[:, a]) / (b - a), axis=1)
            found.update(zip(alike, slopes.tolist(), strict=True))
    return found
