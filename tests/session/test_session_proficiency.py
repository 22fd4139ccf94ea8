"""Mastery: two passes in a row, of what counts."""

from dataclasses import replace

import pytest

from app.session.index import Indexed
from app.session.proficiency import is_mastered, mastered, passes_in_a_row, row_of

PASS = Indexed(
    "a", "2026-11-20T10:00:00+00:00", "ada", "lung", 3, "ended", 30.0, 90.0, True, "verified", True,
    "", "{}",
)  # fmt: skip


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
    assert is_mastered(passed) is (row == 2)


@pytest.mark.parametrize(
    "change",
    [
        {"counts": False},  # a script, a drill, an emulated board, without points
        {"stands": False},  # this station does not vouch for it
        {"verdict": "altered"},
        {"version": 2},
        {"exercise": "liver"},
    ],
)
def test_what_does_not_count_neither_masters_nor_breaks_a_row(change):
    passed, failed = replace(PASS, **change), replace(PASS, passed=False, **change)
    assert row_of([PASS, PASS], "lung", 3) == 2
    assert row_of([passed, passed], "lung", 3) == 0
    assert row_of([PASS, passed], "lung", 3) == 1
    assert row_of([PASS, failed, PASS, failed], "lung", 3) == 2
    assert mastered([PASS, failed, PASS], {"lung": 3, "liver": 1}) == {"lung"}
