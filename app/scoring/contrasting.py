"""Contrasting groups: where attempts of the experienced and of others part.

Livingston, S. A. and Zieky, M. J. (1982), Passing Scores: two groups whose standing is known
beforehand do the same; the pass mark lies where the fewest of both are on the wrong side.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.scoring.errors import ReliabilityError
from app.scoring.pass_mark import MarkMethod
from app.scoring.standard_setting import PassMark
from app.scoring.tolerance import Bands

KEPT_SHARE: Final = 80.0
"""So many of a hundred attempts of the experienced are an expert's."""

_DRAWS: Final = 1000
"""Times that people are drawn anew for the standard error of a mark."""

_SEED: Final = 1982


def contrasted(experienced: Sequence[float], others: Sequence[float]) -> Bands | None:
    """Return bands of a metric of which less is better; None where nothing parts the two groups.

    Expert is what `KEPT_SHARE` of the experienced keep; pass the value with the fewest on the wrong
    side, the middle where several do; good is half-way; zero is the median of the others. Knots are
    rounded to two digits. The sign of a value does not count.

    Args:
        experienced: values of the ones, one at least.
        others: values of the others, one at least.
    """
    good, bad = np.sort(np.abs(experienced)), np.sort(np.abs(others))
    expert, zero = float(np.percentile(good, KEPT_SHARE)), float(np.median(bad))
    passing = _parting(good, bad)
    if passing is None:
        return None
    knots = [float(f"{one:.1e}") for one in (expert, 0.5 * (expert + passing), passing, zero)]
    if not all(a < b for a, b in pairwise(knots)):
        return None
    return Bands.model_validate(dict(zip(("expert", "good", "pass", "zero"), knots, strict=True)))


def contrasted_mark(
    experienced: Sequence[Sequence[float]], others: Sequence[Sequence[float]]
) -> PassMark:
    """Return the mark where the fewest of two groups are on the wrong side.

    Its standard error is that of `_DRAWS` bootstrap samples of people, each with all his attempts.

    Args:
        experienced: points of the attempts of each person, one at least.
        others: likewise.

    Raises:
        ReliabilityError: where nothing parts the groups.
    """
    points = _parting(-_all(experienced), -_all(others))
    if points is None:
        raise ReliabilityError(
            sentence(
                "the points do not part the two groups: half of both are on the wrong side of any "
                "mark; choose groups that differ more, or another method"
            )
        )
    rng = np.random.default_rng(_SEED)
    marks = []
    for _ in range(_DRAWS):
        drawn = [
            _all([own[i] for i in rng.integers(len(own), size=len(own))])
            for own in (experienced, others)
        ]
        mark = _parting(-drawn[0], -drawn[1])
        if mark is not None:
            marks.append(-mark)
    people = len(experienced) + len(others)
    attempts = sum(map(len, experienced)) + sum(map(len, others))
    error = float(np.std(marks)) if marks else 0.0
    return PassMark(MarkMethod.CONTRASTING, -points, error, people, attempts)


def _all(groups: Sequence[Sequence[float]]) -> FloatArray:
    """Return the values of all people."""
    values: FloatArray = np.concatenate([np.asarray(own, dtype=np.float64) for own in groups])
    return values


def _parting(better: FloatArray, worse: FloatArray) -> float | None:
    """Return the value, of which less is better, with the fewest on the wrong side.

    The middle where several have as few; None where half of both are on the wrong side at best.
    """
    good, bad = np.sort(better), np.sort(worse)
    both = np.unique(np.concatenate([good, bad]))
    cuts = 0.5 * (both[:-1] + both[1:])
    if not len(cuts):
        return None
    beyond = (len(good) - np.searchsorted(good, cuts, side="right")) / len(good)
    wrong = beyond + np.searchsorted(bad, cuts, side="right") / len(bad)
    least = np.flatnonzero(np.isclose(wrong, wrong.min()))
    return float(cuts[least[len(least) // 2]]) if wrong.min() < 0.5 else None
