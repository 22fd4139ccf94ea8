"""Who is here, and what is open to them: the window and the command line ask the same answers.

It guards against curiosity, not against the owner of the disk. As long as no instructor's password
is set everybody may do everything.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from app.session.course import Course, assessed_by, courses
from app.session.people import People, Person


@dataclass(frozen=True, slots=True)
class Known:
    """What a look at the list of people gave.

    Attributes:
        guarded: whether an instructor's password is set.
        pseudonyms: of students, by the key that records name.
        refused: why the student who is signed in may not begin an exercise, by its id.
        assessed: exercises that a course holds as assessments -> title of the course.
        courses_here: all courses of this station.
    """

    guarded: bool = False
    pseudonyms: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    refused: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    assessed: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    courses_here: tuple[Course, ...] = ()

    @classmethod
    def of(cls, people: People) -> Known:
        """Look at the list of people and the courses; nobody is refused anything yet.

        Raises:
            SessionError: if they cannot be read.
        """
        known = tuple(courses()[0])
        assessed = {name: held[0].title for name, held in assessed_by(known).items()}
        return cls(people.has_instructor(), people.pseudonyms(), {}, assessed, known)


@dataclass(frozen=True, slots=True)
class Visitor:
    """Who is here: a student, the instructor, or somebody who has not signed in.

    Attributes:
        known: of people.
        student: who is signed in; None for nobody.
        instructor: whether the instructor is.
    """

    known: Known = field(default_factory=Known)
    student: Person | None = None
    instructor: bool = False

    @property
    def may_manage(self) -> bool:
        """Return whether people, courses, all results, exercises, deleting and exports are open."""
        return self.instructor or (not self.known.guarded and self.student is None)

    def owner(self, recorded: str) -> str:
        """Return the key of the student whom a record names; empty where nobody is known."""
        return recorded if recorded in self.known.pseudonyms else ""

    def may_see(self, recorded: str) -> bool:
        """Return whether attempts of whom a record names are open."""
        if self.may_manage:
            return True
        owner = self.owner(recorded)
        return owner == self.student.key if self.student is not None else not owner

    def assessment(self, exercise: str) -> str:
        """Return the course whose assessment an exercise is to who has not signed in; else ''."""
        if self.may_manage or self.student is not None:
            return ""
        return self.known.assessed.get(exercise, "")

    def examined_by(self, exercise: str) -> str:
        """Return the course in which who is signed in is assessed by an exercise; else ''.

        Nobody rehearses an assessment: no drill of it is his to begin.
        """
        student = self.student
        if student is None:
            return ""
        taken = (course for course in self.known.courses_here if course.takes(student))
        held = assessed_by(taken).get(exercise)
        return held[0].title if held else ""
