"""Mastery: two passes in a row, of what counts."""

import pytest

from app.session.proficiency import is_mastered, passes_in_a_row


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
