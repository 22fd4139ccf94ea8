"""Attempt limits of courses over the attempts of all stations: what is beyond them is marked.

Each station holds a limit for what it has seen; together there may be more. Which attempts count is
chosen by what no order of gathering and no clock changes: the first attempts of every station come
before the second ones, and so on, by each station's own numbers; among those at one place the
digest of the record decides. What is beyond is marked and counts nowhere; nothing of it is lost.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from app.session.course import Course, courses, read_course
from app.session.people import Person, tables
from app.session.school_tables import EXCESS
from app.session.station_results import CountedAttempt, counted_attempts

if TYPE_CHECKING:
    from sqlalchemy import Connection


def beyond_limits(
    attempts: Iterable[CountedAttempt],
    known: Iterable[Course],
    persons: Iterable[Person],
    void: frozenset[str] = frozenset(),
) -> dict[str, tuple[str, int]]:
    """Return which attempts are beyond what a course allows, by id: its title, and how many it
    allows.

    Args:
        attempts: of all stations, numbered.
        known: courses.
        persons: students.
        void: ids of those that use up nothing.
    """
    own: dict[tuple[str, str, int], list[CountedAttempt]] = defaultdict(list)
    for one in attempts:
        if one.uses and one.attempt not in void:
            own[one.student, one.exercise, one.version].append(one)
    excess: dict[str, tuple[str, int]] = {}
    students = tuple(persons)
    for course in known:
        for item in course.items:
            if item.attempts is None:
                continue
            for person in filter(course.takes, students):
                tries = own.get((person.key, item.exercise, item.version), [])
                beyond = in_turn(tries)[item.attempts :]
                excess |= {one.attempt: (course.title, item.attempts) for one in beyond}
    return excess


def in_turn(attempts: Sequence[CountedAttempt]) -> list[CountedAttempt]:
    """Return a student's attempts at one exercise in the order in which they count."""
    stations: dict[str, list[CountedAttempt]] = defaultdict(list)
    for one in sorted(attempts, key=lambda one: (one.number, one.attempt)):
        stations[one.station].append(one)
    placed = [(place, one) for some in stations.values() for place, one in enumerate(some)]
    placed.sort(key=lambda pair: (pair[0], pair[1].record, pair[1].attempt))
    return [one for _, one in placed]


def hold_limits(connection: Connection, folder: Path, more: Sequence[Path] = ()) -> int:
    """Mark the attempts that are beyond a course's limit now, and no others; return how many.

    Args:
        connection: to the list of people.
        folder: of the people, with the courses.
        more: files of courses that are about to come there.
    """
    from sqlalchemy import select

    t = tables()
    groups: dict[str, list[str]] = defaultdict(list)
    for person, group in connection.execute(select(t["members"])):
        groups[person].append(group)
    persons = [
        Person(row.key, row.pseudonym, tuple(groups[row.key]))
        for row in connection.execute(select(t["persons"]))
    ]
    wanted = select(t["remarks"].c.attempt).where(t["remarks"].c.void != "")
    void = frozenset(connection.execute(wanted).scalars())
    known = [*courses(folder)[0], *map(read_course, more)]
    excess = beyond_limits(counted_attempts(connection).values(), known, persons, void)
    connection.execute(t[EXCESS].delete())
    rows = [
        {"attempt": name, "course": title, "attempts": attempts}
        for name, (title, attempts) in excess.items()
    ]
    if rows:
        connection.execute(t[EXCESS].insert(), rows)
    return len(rows)
