"""A course (exercises with pinned versions, for groups) and the board of who stands where in it.

A course is one YAML file. On the board and in curves only comparable attempts meet
(`scoring.conditions.comparable`): of each exercise those of the pinned version that the most were
made under. Attempts of scripted trainees or emulated boards, void ones and those that were altered
after they were signed never count.
"""

from __future__ import annotations

import datetime
import re
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Annotated, Any, Final

import yaml
from pydantic import Field, ValidationError, model_validator

from app.core.configuration import Strict, load, parse
from app.core.errors import ConfigurationError
from app.core.files import write_atomically
from app.core.progress import Progress
from app.exercises.guidance import Purpose
from app.exercises.library import library
from app.scoring.conditions import comparison_groups
from app.session.errors import SessionError
from app.session.index import Index, Indexed
from app.session.people import People, Person, Remarks, people_folder
from app.session.signature import Signed

NAME: Final = r"^[a-z0-9]+(-[a-z0-9]+)*$"
"""A course's id is also its file's name."""

MEDIAN_OF: Final = 5
"""The moving median of a curve is over so many attempts."""

TREND_OF: Final = 8
"""The trend is that of so many last attempts, of three at least."""


class CourseError(SessionError):
    """A course that cannot be read, written or found; says what would be valid."""


class CourseItem(Strict):
    """One exercise of a course.

    Attributes:
        exercise: id.
        version: of the exercise; attempts of another one do not count here.
        content: digest of what the exercise says; empty pins the version alone.
        attempts: how many are allowed; None for any number.
        purpose: practice, or an assessment whose result the instructor releases.
        opens: first day on which it may be done; None from the beginning.
        closes: last day; None without end.
    """

    exercise: Annotated[str, Field(pattern=NAME, max_length=64)]
    version: Annotated[int, Field(ge=1)] = 1
    content: str = ""
    attempts: Annotated[int, Field(ge=1)] | None = None
    purpose: Purpose = Purpose.PRACTICE
    opens: datetime.date | None = None
    closes: datetime.date | None = None

    @model_validator(mode="after")
    def _days_in_order(self) -> CourseItem:
        if self.opens and self.closes and self.closes < self.opens:
            raise ValueError(f"closes on {self.closes}, before it opens on {self.opens}")
        return self


class Course(Strict):
    """A course.

    Attributes:
        id: name of its file.
        title: one line for people.
        groups: who takes it; empty for everybody.
        ordered: whether an exercise opens only after the one before it was passed or its attempts
            are used up.
        items: the exercises, in order.
    """

    id: Annotated[str, Field(pattern=NAME, max_length=64)]
    title: Annotated[str, Field(min_length=1, max_length=120)]
    groups: tuple[str, ...] = ()
    ordered: bool = False
    items: tuple[CourseItem, ...] = ()

    @model_validator(mode="after")
    def _each_once(self) -> Course:
        counts = Counter(item.exercise for item in self.items)
        twice = [name for name, count in counts.items() if count > 1]
        if twice:
            raise ValueError(f"{twice[0]!r} stands there twice: an exercise has one place")
        return self

    def takes(self, person: Person) -> bool:
        """Whether a student takes the course."""
        return not self.groups or bool(set(self.groups) & set(person.groups))

    def document(self) -> dict[str, Any]:
        """JSON-ready mapping, as in its file."""
        return self.model_dump(mode="json", exclude_defaults=True)

    def save(self, folder: Path | None = None) -> Path:
        """Write its file, whole or not at all; return its path.

        Raises:
            CourseError: if it cannot be written.
        """
        path = courses_folder(folder) / f"{self.id}.yaml"
        text = yaml.safe_dump(self.document(), sort_keys=False, allow_unicode=True)
        try:
            write_atomically(path, text)
        except OSError as error:
            raise CourseError(f"cannot write {path}: {error.strerror or error}") from error
        return path


def courses_folder(folder: Path | None = None) -> Path:
    """Return the folder of the courses, in that of people (the user's by default)."""
    return (folder or people_folder()) / "courses"


def courses(folder: Path | None = None) -> tuple[list[Course], list[str]]:
    """Return all courses by title, and a line for each file that cannot be used."""
    found, broken = [], []
    for path in sorted(courses_folder(folder).glob("*.yaml")):
        try:
            found.append(read_course(path))
        except ConfigurationError as error:
            broken.append(str(error))
    return sorted(found, key=lambda course: course.title.casefold()), broken


def read_course(path: Path) -> Course:
    """Read a course from its file.

    Raises:
        ConfigurationError: naming file, field, value and what would be valid.
    """
    return load(path, Course)


def course_of(document: Mapping[str, Any], origin: str) -> Course:
    """Return a course of what was typed; raises ConfigurationError naming field and value."""
    return parse(document, Course, origin)


def find_course(name: str, folder: Path | None = None) -> Course:
    """Return a course by its id.

    Raises:
        CourseError: if there is none; names those that there are.
        ConfigurationError: if its file cannot be used.
    """
    path = courses_folder(folder) / f"{name}.yaml"
    if re.fullmatch(NAME, name) and path.is_file():
        return read_course(path)
    known = ", ".join(course.id for course in courses(folder)[0]) or "none"
    raise CourseError(f"{name!r} is no course; there: {known}")


def pinned_problems(course: Course) -> list[str]:
    """Say which exercises of a course are not in the library as they are pinned, one line each."""
    known = {exercise.id: exercise.version for exercise in library()}
    found = []
    for item in course.items:
        if item.exercise not in known:
            found.append(f"{item.exercise}: no such exercise in the library")
        elif known[item.exercise] != item.version:
            found.append(
                f"{item.exercise}: the library has version {known[item.exercise]}, the course pins "
                f"version {item.version}"
            )
    return found


def why_not(course: Course, exercise: str, own: Sequence[Indexed], today: datetime.date) -> str:
    """Say why a student may not begin an exercise of a course; empty if he may.

    Args:
        course: that he takes.
        exercise: id.
        own: his attempts.
        today: by the station's calendar.
    """
    place = next((n for n, item in enumerate(course.items) if item.exercise == exercise), None)
    if place is None:
        return f"{exercise} is no exercise of the course {course.title}"
    item = course.items[place]
    if item.opens and today < item.opens:
        return f"it opens on {item.opens}"
    if item.closes and today > item.closes:
        return f"it closed on {item.closes}"
    done = _of_item(own, item)
    if item.attempts is not None and len(done) >= item.attempts:
        return f"all {item.attempts} attempts are used"
    if course.ordered and place > 0:
        before = course.items[place - 1]
        tries = _of_item(own, before)
        used = before.attempts is not None and len(tries) >= before.attempts
        if not used and not any(one.passed for one in tries):
            return f"first pass {before.exercise}"
    return ""


def _of_item(attempts: Sequence[Indexed], item: CourseItem) -> list[Indexed]:
    """Return the attempts that use one up: begun in earnest, by a person, of this version."""
    return [
        one
        for one in attempts
        if one.exercise == item.exercise
        and one.version == item.version
        and one.state in ("ended", "aborted", "unfinished")
        and not one.conditions.scripted
    ]


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
    """

    attempts: int = 0
    best: float | None = None
    last: float | None = None
    trend: float | None = None
    passed: bool = False
    since: datetime.timedelta | None = None
    others: int = 0
    why: tuple[tuple[str, int], ...] = ()

    def document(self) -> dict[str, Any]:
        """JSON-ready mapping; the keys stand in docs/json.md."""
        return {
            "attempts": self.attempts,
            "best": self.best,
            "last": self.last,
            "trend": self.trend,
            "passed": self.passed,
            "since_s": None if self.since is None else self.since.total_seconds(),
            "others": self.others,
            "why": dict(self.why),
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
    """

    students: tuple[Person, ...]
    items: tuple[CourseItem, ...]
    cells: Mapping[tuple[str, str], BoardCell]
    counted: Mapping[tuple[str, str], tuple[Indexed, ...]]

    def curve(self, key: str, exercise: str) -> list[CurvePoint]:
        """Return a student's curve in an exercise, oldest first."""
        found: list[CurvePoint] = []
        totals: list[float] = []
        for one in self.counted.get((key, exercise), ()):
            totals.append(one.total or 0.0)
            middle = median(totals[-MEDIAN_OF:])
            found.append(CurvePoint(one.id, one.started, totals[-1], max(totals), middle))
        return found


def progress_board(
    students: Sequence[Person],
    items: Sequence[CourseItem],
    attempts: Sequence[Indexed],
    whose: Mapping[str, str],
    remarks: Mapping[str, Remarks],
    now: datetime.datetime,
) -> ProgressBoard:
    """Make the board.

    Args:
        students: rows.
        items: columns.
        attempts: of the index, oldest first.
        whose: key of the student by what records name (`People.keys`).
        remarks: what the instructor said, by attempt.
        now: time that "since" is told from.
    """
    wanted = {item.exercise: item for item in items}
    rows = {person.key for person in students}
    taken: dict[str, list[Indexed]] = defaultdict(list)
    left: dict[tuple[str, str], Counter[str]] = defaultdict(Counter)
    for one in attempts:
        key, item = whose.get(one.student, ""), wanted.get(one.exercise)
        if item is None or key not in rows:
            continue
        reason = _why_not_counted(one, item, remarks.get(one.id))
        if reason:
            left[key, one.exercise][reason] += 1
        else:
            taken[one.exercise].append(one)
    counted: dict[tuple[str, str], list[Indexed]] = defaultdict(list)
    for exercise, some in taken.items():
        groups = comparison_groups([one.conditions for one in some])
        most = _largest(groups)
        for one, group in zip(some, groups, strict=True):
            key = whose[one.student]
            if group == most:
                counted[key, exercise].append(one)
            else:
                left[key, exercise]["made under other conditions than most"] += 1
    cells = {
        (person.key, item.exercise): _cell(
            counted[person.key, item.exercise], left[person.key, item.exercise], now
        )
        for person in students
        for item in items
    }
    kept = {place: tuple(some) for place, some in counted.items() if some}
    return ProgressBoard(tuple(students), tuple(items), cells, kept)


def board_of(
    folder: Path,
    people: People,
    course: Course | None = None,
    group: str = "",
    now: datetime.datetime | None = None,
    progress: Progress | None = None,
) -> tuple[ProgressBoard, list[Indexed]]:
    """Return the board of a folder of records, and all attempts in it, oldest first.

    Args:
        folder: of the records.
        people: of this station.
        course: None takes every exercise that was attempted, in its newest version.
        group: of students; empty takes all who take the course.
        now: time that "since" is told from.
        progress: reports, and may cancel.

    Raises:
        SessionError: if something cannot be read.
    """
    index = Index(folder)
    index.refresh(progress)
    attempts = index.attempts()
    students = [
        person
        for person in people.everybody()
        if (not group or group in person.groups) and (course is None or course.takes(person))
    ]
    whose = people.keys()
    own = [one for one in attempts if one.student in whose]
    items = course.items if course is not None else every_item(own)
    now = now or datetime.datetime.now(datetime.UTC)
    return progress_board(students, items, own, whose, people.remarks(), now), attempts


def every_item(attempts: Sequence[Indexed]) -> list[CourseItem]:
    """Return an item for each exercise that was attempted, in its newest version: no course."""
    newest: dict[str, int] = {}
    for one in attempts:
        if one.exercise:
            newest[one.exercise] = max(one.version, newest.get(one.exercise, 1))
    found = []
    for name, version in sorted(newest.items()):
        try:
            found.append(CourseItem(exercise=name, version=version))
        except ValidationError:
            continue  # a record with an id that no exercise can have
    return found


def _why_not_counted(one: Indexed, item: CourseItem, said: Remarks | None) -> str:
    if one.verdict == Signed.ALTERED:
        return "altered after it was signed"
    if said is not None and said.void:
        return "declared void by the instructor"
    if not one.counts:
        known = one.conditions
        if known.scripted:
            return "scripted"
        return "emulated robot" if known.kind == "emulated" else "not scored or void"
    if one.version != item.version:
        return f"version {one.version} of the exercise"
    if item.content and one.conditions.content != item.content:
        return "the exercise said something else"
    return ""


def _largest(groups: Sequence[int | None]) -> int | None:
    """Return the group with the most members; of equal ones that with the newest attempt."""
    counts = Counter(groups)
    last = {group: place for place, group in enumerate(groups)}
    return max(counts, key=lambda group: (counts[group], last[group]), default=None)


def _cell(some: Sequence[Indexed], left: Counter[str], now: datetime.datetime) -> BoardCell:
    others, why = left.total(), tuple(sorted(left.items()))
    if not some:
        return BoardCell(others=others, why=why)
    totals = [one.total or 0.0 for one in some]
    return BoardCell(
        attempts=len(some),
        best=max(totals),
        last=totals[-1],
        trend=_trend(totals[-TREND_OF:]),
        passed=any(one.passed for one in some),
        since=now - some[-1].time,
        others=others,
        why=why,
    )


def _trend(totals: Sequence[float]) -> float | None:
    """Median of the slopes between all pairs, after Theil (1950) and Sen (1968)."""
    if len(totals) < 3:
        return None
    return median(
        (totals[b] - totals[a]) / (b - a)
        for a in range(len(totals))
        for b in range(a + 1, len(totals))
    )
