"""A course: exercises with pinned versions, in order, for groups, as one YAML file."""

from __future__ import annotations

import datetime
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Final

import yaml
from pydantic import Field, model_validator

from app.core.configuration import FieldText, Strict, load
from app.core.errors import ConfigurationError, writing
from app.core.files import write_atomically
from app.core.messages import sentence
from app.exercises.guidance import Purpose
from app.exercises.library import library
from app.exercises.schema import Exercise
from app.scoring.competence import RULE, CompetenceRule, design
from app.session.audit import note
from app.session.errors import SessionError
from app.session.index import Indexed
from app.session.people import PEOPLE, People, Person, Remarks, people_folder
from app.session.signature import Signed

NAME: Final = r"^[a-z0-9]+(-[a-z0-9]+)*$"
"""A course's id is also its file's name."""


class CourseError(SessionError):
    """A course that cannot be read, written or found; says what would be valid."""


class CourseItem(Strict):
    """One exercise of a course.

    Attributes:
        exercise: id.
        version: of the exercise; attempts of another one do not count here. A course that is saved
            without one pins the newest.
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
            raise ValueError(
                sentence(
                    "closes on {closes}, before it opens on {opens}",
                    closes=self.closes,
                    opens=self.opens,
                )
            )
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
        competence: when a student is called competent at one of them.
    """

    id: Annotated[str, Field(pattern=NAME, max_length=64), FieldText("File name")]
    title: Annotated[str, Field(min_length=1, max_length=120), FieldText("Title")]
    groups: Annotated[tuple[str, ...], FieldText("Groups")] = ()
    ordered: Annotated[
        bool, FieldText("In order: the next opens when the one before was passed")
    ] = False
    items: tuple[CourseItem, ...] = ()
    competence: CompetenceRule = RULE

    @model_validator(mode="after")
    def _each_once(self) -> Course:
        counts = Counter(item.exercise for item in self.items)
        twice = [name for name, count in counts.items() if count > 1]
        if twice:
            raise ValueError(
                sentence(
                    "{exercise_name!r} stands there twice: an exercise has one place",
                    exercise_name=twice[0],
                )
            )
        return self

    @model_validator(mode="after")
    def _can_be_told(self) -> Course:
        if self.competence != RULE:
            design(
                self.competence
            )  # refuses rates that no test of a student's attempts tells apart
        return self

    def takes(self, person: Person) -> bool:
        """Return whether a student takes the course."""
        return not self.groups or bool(set(self.groups) & set(person.groups))

    def document(self) -> dict[str, Any]:
        """JSON-ready mapping, as in its file; every item says its version."""
        document = self.model_dump(mode="json", exclude_defaults=True)
        for shown, item in zip(document.get("items", ()), self.items, strict=False):
            shown["version"] = item.version
        return document

    def pinned(self, versions: Mapping[str, int]) -> Course:
        """Return the course with the newest version of each exercise where none was named."""
        items = [
            item
            if "version" in item.model_fields_set or item.exercise not in versions
            else item.model_copy(update={"version": versions[item.exercise]})
            for item in self.items
        ]
        return self.model_copy(update={"items": tuple(items)})

    def save(self, folder: Path | None = None) -> Path:
        """Write its file, whole or not at all; return its path.

        Raises:
            CourseError: if it cannot be written.
        """
        path = courses_folder(folder) / f"{self.id}.yaml"
        text = yaml.safe_dump(self.document(), sort_keys=False, allow_unicode=True)
        with writing(path, CourseError):
            write_atomically(path, text)
            note("course saved", [self.id], path.parent.parent)
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
    raise CourseError(sentence("{name!r} is no course; there: {known}", name=name, known=known))


def newest_versions() -> dict[str, int]:
    """Return the present version of each exercise of the library, by its id."""
    return {exercise.id: exercise.version for exercise in library()}


def pinned_problems(course: Course) -> list[str]:
    """Say which exercises of a course are not in the library as they are pinned, one line each."""
    known = newest_versions()
    found: list[str] = []
    for item in course.items:
        if item.exercise not in known:
            found.append(
                sentence(
                    "{item_exercise}: no such exercise in the library", item_exercise=item.exercise
                )
            )
        elif known[item.exercise] != item.version:
            found.append(
                sentence(
                    "{item_exercise}: the library has version {known}, the course pins "
                    "version {item_version}",
                    item_exercise=item.exercise,
                    known=known[item.exercise],
                    item_version=item.version,
                )
            )
    return found


def why_not(
    course: Course,
    exercise: str,
    own: Sequence[Indexed],
    today: datetime.date,
    titles: Mapping[str, str] | None = None,
) -> str:
    """Say why a student may not begin an exercise of a course; empty if he may.

    Args:
        course: that he takes.
        exercise: id.
        own: his attempts.
        today: by the station's calendar.
        titles: of exercises, as people read them; where one is missing its id stands.
    """
    titled = titles or {}
    place = next((n for n, item in enumerate(course.items) if item.exercise == exercise), None)
    if place is None:
        named = titled.get(exercise, exercise)
        return sentence(
            "{named} is no exercise of the course {course_title}",
            named=named,
            course_title=course.title,
        )
    item = course.items[place]
    if item.opens and today < item.opens:
        return sentence("it opens on {item_opens}", item_opens=item.opens)
    if item.closes and today > item.closes:
        return sentence("it closed on {item_closes}", item_closes=item.closes)
    done = attempts_used(own, item)
    if item.attempts is not None and len(done) >= item.attempts:
        many = item.attempts > 1
        return (
            sentence("all {item_attempts} attempts are used", item_attempts=item.attempts)
            if many
            else sentence("the one attempt is used")
        )
    if course.ordered and place > 0:
        before = course.items[place - 1]
        tries = attempts_used(own, before)
        used = before.attempts is not None and len(tries) >= before.attempts
        if not used and not any(one.passed for one in tries):
            return sentence(
                "first pass {exercise}", exercise=titled.get(before.exercise, before.exercise)
            )
    return ""


def assessed_by(known: Iterable[Course]) -> dict[str, list[Course]]:
    """Return which exercises courses hold as assessments, by id: nobody rehearses those."""
    found: dict[str, list[Course]] = {}
    for course in known:
        for item in course.items:
            if item.purpose is Purpose.ASSESSMENT:
                found.setdefault(item.exercise, []).append(course)
    return found


def refusals(
    known: Sequence[Course],
    person: Person,
    own: Sequence[Indexed],
    today: datetime.date,
    titles: Mapping[str, str] | None = None,
) -> dict[str, str]:
    """Say which exercises a student may not begin, by id, and why.

    The courses that he takes decide; an assessment of others is not his to begin.

    Args:
        known: all courses.
        person: the student.
        own: his attempts, those that are void left out.
        today: by the station's calendar.
        titles: of exercises, as people read them.
    """
    taken = [course for course in known if course.takes(person)]
    mine = {item.exercise for course in taken for item in course.items}
    found: dict[str, str] = {
        name: sentence(
            "it is an assessment of the course {course}, which you do not take: ask the instructor",
            course=held[0].title,
        )
        for name, held in assessed_by(known).items()
        if name not in mine
    }
    for course in taken:
        for item in course.items:
            if why := why_not(course, item.exercise, own, today, titles):
                found[item.exercise] = why
    return found


@dataclass(frozen=True, slots=True)
class CourseStanding:
    """How somebody stands in one exercise of a course.

    Attributes:
        item: the exercise.
        title: as it is written; its id where the library has none of that name.
        used: attempts that are used up; None where nobody is signed in.
        passed: whether one passes that may be told.
        best: points; None where there are none, or none that may be told.
        held: whether a result waits for its release.
        refusal: why it may not be begun now; empty if nothing speaks against it.
    """

    item: CourseItem
    title: str
    used: int | None = None
    passed: bool = False
    best: float | None = None
    held: bool = False
    refusal: str = ""


def course_standings(
    course: Course,
    exercises: Mapping[str, Exercise],
    person: Person | None,
    own: Sequence[Indexed],
    remarks: Mapping[str, Remarks],
    today: datetime.date,
) -> list[CourseStanding]:
    """Return how somebody stands in a course, in its order.

    Args:
        course: that he takes.
        exercises: that the library has, by id.
        person: who; None for nobody, who may begin all of it and of whom nothing counts.
        own: his attempts, those that are void left out.
        remarks: what the instructor said, by attempt.
        today: by the station's calendar.
    """
    titles = {name: one.title for name, one in exercises.items()}
    found = []
    for item in course.items:
        known = exercises.get(item.exercise)
        refusal = ""
        if known is None:
            refusal = sentence("this exercise is not in the library here")
        elif person is not None and known.version != item.version:
            refusal = sentence(
                "the course pins version {pinned}, the library has version {known}: the instructor "
                "changes one of them",
                pinned=item.version,
                known=known.version,
            )
        if person is None:
            named = titles.get(item.exercise, item.exercise)
            found.append(CourseStanding(item, named, refusal=refusal))
            continue
        tries = attempts_used(own, item)
        open_ = [one for one in tries if not _is_held(course, person, one, remarks)]
        totals = [one.total for one in open_ if one.total is not None]
        found.append(
            CourseStanding(
                item,
                titles.get(item.exercise, item.exercise),
                len(tries),
                any(one.passed for one in open_),
                max(totals, default=None),
                len(open_) < len(tries),
                refusal or why_not(course, item.exercise, own, today, titles),
            )
        )
    return found


def next_of_course(standings: Sequence[CourseStanding]) -> CourseStanding | None:
    """Return what comes next: not passed, nothing speaks against it; what waits comes last."""
    able = [one for one in standings if not one.refusal and not one.passed]
    return min(able, key=lambda one: one.held, default=None)


def waiting_for_release(
    course: Course,
    attempts: Sequence[Indexed],
    persons: Mapping[str, Person],
    remarks: Mapping[str, Remarks],
) -> list[str]:
    """Return ids of the attempts whose results a course holds back.

    Args:
        course: the course.
        attempts: of the index.
        persons: by key, which is what records name.
        remarks: what the instructor said, by attempt.
    """
    return [
        one.id
        for one in attempts
        if (person := persons.get(one.student)) and _is_held(course, person, one, remarks)
    ]


def not_void(attempts: Iterable[Indexed], remarks: Mapping[str, Remarks]) -> list[Indexed]:
    """Return attempts without those that the instructor declared void: they use up nothing."""
    return [one for one in attempts if one.id not in remarks or not remarks[one.id].uncounted]


def _is_held(course: Course, person: Person, item: Indexed, remarks: Mapping[str, Remarks]) -> bool:
    said = remarks.get(item.id)
    released = said is not None and said.released
    return holding([course], person, item.exercise, item.version, released) is not None


def holding(
    known: Sequence[Course], person: Person | None, exercise: str, version: int, released: bool
) -> Course | None:
    """Return the course that holds a result back until its instructor releases it; None if none.

    Args:
        known: all courses.
        person: whose result; None for somebody whom nobody knows, who takes no course.
        exercise: id of what was attempted.
        version: of it.
        released: whether the instructor has released this attempt's result.
    """
    if person is None or released:
        return None
    for course in known:
        for item in course.items:
            same = (item.exercise, item.version) == (exercise, version)
            if same and item.purpose is Purpose.ASSESSMENT and course.takes(person):
                return course
    return None


def held_back(attempts: Iterable[tuple[str, str, str, int]]) -> dict[str, str]:
    """Return which results are held back here, by id of the attempt: the title of the course.

    Args:
        attempts: id, whom the record names, id of the exercise and its version.

    Raises:
        SessionError: if people or courses cannot be read.
    """
    if not (people_folder() / PEOPLE).exists():
        return {}
    people, (known, _) = People(), courses()
    remarks = people.remarks()
    persons = {person.key: person for person in people.everybody()}
    found = {}
    for name, student, exercise, version in attempts:
        said, person = remarks.get(name), persons.get(student)
        released = said is not None and said.released
        course = holding(known, person, exercise, version, released)
        if course is not None:
            found[name] = course.title
    return found


def attempts_used(attempts: Sequence[Indexed], item: CourseItem) -> list[Indexed]:
    """Return a student's attempts that use one up: begun by a person, of this version.

    What this station did not seal uses up none, but for those that were cut off: nothing seals
    them, and a program that is killed must not give an attempt back.
    """
    return [
        one
        for one in attempts
        if one.exercise == item.exercise
        and one.version == item.version
        and one.state in ("ended", "aborted", "unfinished")
        and one.conditions.by_person
        and (one.stands or one.state == "unfinished" or one.verdict == Signed.ALTERED)
    ]
