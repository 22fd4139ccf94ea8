"""Which attempts are beyond a course's limit, where two stations let a student begin them."""

from itertools import permutations

import pytest

from app.session.course import Course, CourseItem
from app.session.limits import beyond_limits
from app.session.people import Person
from app.session.station_results import CountedAttempt

ADA = Person("p-000000000001", "Ada", ("A",))


def attempt(name: str, station: str, number: int, record: str, **other: object) -> CountedAttempt:
    values = {"student": ADA.key, "exercise": "kidney", "version": 1, "uses": True} | other
    return CountedAttempt(name, station, number, record, **values)  # type: ignore[arg-type]


def beyond(attempts, limit: int = 2, **other) -> set[str]:
    item = CourseItem(exercise="kidney", version=1, attempts=limit)
    course = Course(id="autumn", title="Autumn", groups=("A",), items=(item,))
    found = beyond_limits(attempts, [course], [ADA], **other)
    assert set(found.values()) <= {("Autumn", limit)}
    return set(found)


# By names alone all of z would be beyond; by stations alone, all of the second one.
MIXED = (
    attempt("a1", "s", 4, "9"),
    attempt("a2", "s", 9, "1"),
    attempt("z1", "t", 1, "5"),
    attempt("z2", "t", 2, "0"),
)


@pytest.mark.parametrize("order", list(permutations(range(4)))[::5])
def test_the_first_of_each_station_count_whatever_order_names_and_numbers_have(order) -> None:
    assert beyond([MIXED[place] for place in order]) == {"a2", "z2"}


@pytest.mark.parametrize(("limit", "left"), [(1, 3), (3, 1), (4, 0)])
def test_as_many_count_as_the_course_allows_and_at_one_place_the_digest_decides(
    limit: int, left: int
) -> None:
    counting = ["z1", "a1", "z2", "a2"]  # digests 5 before 9, then 0 before 1
    assert beyond(MIXED, limit) == set(counting[limit:])
    assert len(beyond(MIXED, limit)) == left


def test_what_uses_nothing_up_leaves_room_for_the_next() -> None:
    shown = [one._replace(uses=one.attempt != "z1") for one in MIXED]
    assert beyond(shown) == {"a2"}
    assert beyond(MIXED, void=frozenset({"z1"})) == {"a2"}


@pytest.mark.parametrize("other", [{"student": "p-2"}, {"exercise": "liver"}, {"version": 2}])
def test_attempts_of_others_at_others_and_at_other_versions_use_nothing_up(other) -> None:
    more = [attempt(f"o{k}", "s", 20 + k, "0", **other) for k in range(3)]
    assert beyond([*more, *MIXED]) == {"a2", "z2"}
