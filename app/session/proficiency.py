"""Who masters an exercise: two passes in a row, and only then does the next one follow.

One pass may be luck. The newest two of a person's attempts that count decide, so that whoever fails
later practises again.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Final

from app.session.index import Indexed
from app.session.signature import Signed

IN_A_ROW: Final = 2
"""So many passes one after the other make mastery; this project's own."""


def passes_in_a_row(passed: Sequence[bool]) -> int:
    """Return how many of the newest attempts passed one after the other, at most `IN_A_ROW`.

    Args:
        passed: of each attempt of one person at one version of an exercise, oldest first.
    """
    newest = list(passed)[-IN_A_ROW:]
    return next((n for n, one in enumerate(reversed(newest)) if not one), len(newest))


def is_mastered(passed: Sequence[bool]) -> bool:
    """Return whether the newest two attempts passed; `passed` as `passes_in_a_row` takes it."""
    return passes_in_a_row(passed) >= IN_A_ROW


def row_of(attempts: Iterable[Indexed], exercise: str, version: int) -> int:
    """Return a person's passes in a row at the present version of an exercise.

    What a script, a drill or an emulated board did, what has no points, what this station does not
    vouch for and what was altered counts for nothing.

    Args:
        attempts: of one person, oldest first, those that were declared void left out.
        exercise: id.
        version: the present one.
    """
    return passes_in_a_row(
        [
            bool(one.passed)
            for one in attempts
            if (one.exercise, one.version) == (exercise, version)
            and (one.counts and one.stands and one.verdict != Signed.ALTERED)
        ]
    )


def mastered(attempts: Sequence[Indexed], versions: Mapping[str, int]) -> set[str]:
    """Return which exercises a person masters.

    Args:
        attempts: as `row_of` takes them.
        versions: the present one of each exercise, by its id.
    """
    return {
        name for name, version in versions.items() if row_of(attempts, name, version) >= IN_A_ROW
    }
