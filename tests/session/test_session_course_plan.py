"""Courses that ship: days counted from the first, begun on a day for groups."""

import datetime

import pytest

from app.exercises.library import library
from app.session.course import CourseError
from app.session.course_plan import CoursePlan, UnitPlan, course_plans, find_course_plan

FIRST = datetime.date(2026, 12, 7)


def test_every_exercise_of_a_plan_that_ships_is_there() -> None:
    known = {exercise.id: exercise for exercise in library()}
    plans = course_plans()
    assert plans
    for plan in plans:
        for unit in plan.units:
            assert unit.exercise in known
            assert unit.purpose is known[unit.exercise].purpose


def test_the_lung_biopsy_has_six_units_that_follow_each_other_week_by_week() -> None:
    course = find_course_plan("lung-biopsy-in-six-units").begun(FIRST, ("residents",))
    assert course.id == "lung-biopsy-in-six-units-2026-12"
    assert course.groups == ("residents",)
    assert course.ordered
    assert len(course.items) == 6
    for week, item in enumerate(course.items):
        assert item.opens == FIRST + datetime.timedelta(weeks=week)
        assert item.closes == FIRST + datetime.timedelta(days=7 * week + 6)
    assert "lung-biopsy" in [item.exercise for item in course.items]
    assert "version" not in course.items[0].model_fields_set, "saving pins the newest"


def test_what_a_plan_cannot_be_is_said() -> None:
    with pytest.raises(CourseError, match="no plan of a course; there: lung-biopsy"):
        find_course_plan("heart")
    with pytest.raises(ValueError, match="closes on day 3, before it opens on day 7"):
        UnitPlan(exercise="kidney", opens_day=7, closes_day=3)
    with pytest.raises(ValueError, match="at least 1"):
        CoursePlan(id="none", title="None", units=())
    open_ended = UnitPlan(exercise="kidney", opens_day=2).begun(FIRST)
    assert (open_ended.opens, open_ended.closes) == (datetime.date(2026, 12, 9), None)
