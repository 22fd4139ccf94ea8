"""A course that has not begun: exercises in their order, with days counted from the first one.

The program ships some; a school begins one on a day, for its groups, and has a course of its own.
"""

from __future__ import annotations

import datetime
from pathlib import Path
from typing import Annotated

from pydantic import Field, model_validator

from app.core import paths
from app.core.configuration import Strict, load
from app.core.messages import sentence
from app.exercises.guidance import Purpose
from app.session.course import NAME, Course, CourseError, CourseItem

Day = Annotated[int, Field(ge=0, le=3650)]


class UnitPlan(Strict):
    """One exercise of a course that has not begun.

    Attributes:
        exercise: id.
        attempts: how many are allowed; None for any number.
        purpose: practice, or an assessment.
        opens_day: first day on which it may be done, 0 for the day on which the course begins.
        closes_day: last day; None without end.
    """

    exercise: Annotated[str, Field(pattern=NAME, max_length=64)]
    attempts: Annotated[int, Field(ge=1)] | None = None
    purpose: Purpose = Purpose.PRACTICE
    opens_day: Day = 0
    closes_day: Day | None = None

    @model_validator(mode="after")
    def _days_in_order(self) -> UnitPlan:
        if self.closes_day is not None and self.closes_day < self.opens_day:
            raise ValueError(
                sentence(
                    "closes on day {closes}, before it opens on day {opens}",
                    closes=self.closes_day,
                    opens=self.opens_day,
                )
            )
        return self

    def begun(self, first: datetime.date) -> CourseItem:
        """Return it with its days, of a course that begins on a day."""
        closes = None if self.closes_day is None else first + datetime.timedelta(self.closes_day)
        return CourseItem(
            exercise=self.exercise,
            attempts=self.attempts,
            purpose=self.purpose,
            opens=first + datetime.timedelta(self.opens_day),
            closes=closes,
        )


class CoursePlan(Strict):
    """A course that has not begun.

    Attributes:
        id: name of its file.
        title: one line for people.
        description: what it leads to.
        ordered: as of a course.
        units: the exercises, in order.
    """

    id: Annotated[str, Field(pattern=NAME, max_length=64)]
    title: Annotated[str, Field(min_length=1, max_length=120)]
    description: str = ""
    ordered: bool = False
    units: Annotated[tuple[UnitPlan, ...], Field(min_length=1)]

    def begun(
        self, first: datetime.date, groups: tuple[str, ...] = (), identifier: str = ""
    ) -> Course:
        """Return the course that begins on a day.

        Args:
            first: that day.
            groups: who takes it; empty for everybody.
            identifier: of the course; empty for the plan's with year and month.
        """
        return Course(
            id=identifier or f"{self.id}-{first:%Y-%m}",
            title=self.title,
            groups=groups,
            ordered=self.ordered,
            items=tuple(unit.begun(first) for unit in self.units),
        )


def course_plans() -> list[CoursePlan]:
    """Return the plans that the program ships, by title.

    Raises:
        ConfigurationError: naming file, field, value and what would be valid.
    """
    found = [load(path, CoursePlan) for path in _folder().glob("*.yaml")]
    return sorted(found, key=lambda plan: plan.title.casefold())


def find_course_plan(name: str) -> CoursePlan:
    """Return a plan by its id.

    Raises:
        CourseError: if there is none; names those that there are.
    """
    plans = {plan.id: plan for plan in course_plans()}
    if name not in plans:
        known = ", ".join(plans)
        raise CourseError(
            sentence("{name!r} is no plan of a course; there: {known}", name=name, known=known)
        )
    return plans[name]


def _folder() -> Path:
    return paths.resources() / "courses"
