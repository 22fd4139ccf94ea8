"""Mastery: two passes in a row, of what counts."""

from types import SimpleNamespace

import pytest

from app.session.proficiency import mastered, passes_in_a_row


@pytest.mark.parametrize(
    ("passed", "row"),
    [
        ([], 0),
        ([True], 1),
        ([False, True], 1),
        ([True, False], 0),
        ([True, False, True], 1),
        ([True, True], 2),
        ([False, True, True, True], 2),
        ([True, True, False], 0),
    ],
)
def test_the_newest_attempts_alone_decide(passed, row):
    assert passes_in_a_row(passed) == row


def one(passed=True, version=2, counts=True, exercise="kidney"):
    return SimpleNamespace(exercise=exercise, version=version, counts=counts, passed=passed)


@pytest.mark.parametrize(
    ("attempts", "masters"),
    [
        ([one(), one()], True),
        ([one(), one(counts=False), one()], True),
        ([one(), one(counts=False)], False),
        ([one(version=1), one()], False),
        ([one(), one(exercise="first-insertion")], False),
        ([one(), one(), one(passed=False)], False),
        ([one(), one(), one(passed=False, version=1)], True),
        ([one(), one(passed=None)], False),
    ],
)
def test_what_counts_at_the_present_version_alone_makes_mastery(attempts, masters):
    assert mastered(attempts, {"kidney": 2}) == ({"kidney"} if masters else set())
