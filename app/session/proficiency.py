"""Who masters an exercise: two passes in a row, and only then does the next one follow.

One pass may be luck. The newest two of a person's attempts that count decide, so that whoever fails
later practises again.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

from app.session.index import Indexed

IN_A_ROW: Final = 2
"""So many passes one after the other make mastery; this project's own."""


def passes_in_a_row(passed: Sequence[bool]) -> int:
    """Return how many of the newest attempts passed one after the other, at most `IN_A_ROW`.

    Args:
        passed: of each attempt of one person at one version of an exercise, oldest first.
    """
    newest = list(passed)[-IN_A_ROW:]
    return next((n for n, one in enumerate(reversed(newest)) if not one), len(newest))


def mastered(attempts: Sequence[Indexed], versions: Mapping[str, int]) -> set[str]:
    """Return which exercises a person masters.

    What a script, a drill or an emulated board did, what has no points, what this station does not
    vouch for and what was altered counts for nothing (`Indexed.counts`).

    Args:
        attempts: of one person, oldest first, those that were declared void left out.
        versions: the present one of each exercise, by its id.
    """
    passed: dict[str, list[bool]] = {name: [] for name in versions}
    for one in attempts:
        if one.counts and versions.get(one.exercise) == one.version:
            passed[one.exercise].append(bool(one.passed))
    return {name for name, those in passed.items() if passes_in_a_row(those) >= IN_A_ROW}
