"""Bands of a metric by contrasting groups: where attempts of the experienced and of others part.

Livingston, S. A. and Zieky, M. J. (1982), Passing Scores: two groups whose standing is known
beforehand do the same; the pass mark lies where the fewest of both are on the wrong side.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Final

import numpy as np

from app.scoring.tolerance import Bands

KEPT_SHARE: Final = 80.0
"""So many of a hundred attempts of the experienced are an expert's."""


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
    both = np.unique(np.concatenate([good, bad]))
    cuts = 0.5 * (both[:-1] + both[1:])
    if not len(cuts):
        return None
    wrong = [(good > cut).mean() + (bad <= cut).mean() for cut in cuts]
    least = np.flatnonzero(np.isclose(wrong, min(wrong)))
    passing = float(cuts[least[len(least) // 2]])
    knots = [float(f"{one:.1e}") for one in (expert, 0.5 * (expert + passing), passing, zero)]
    if min(wrong) >= 0.5 or not all(a < b for a, b in pairwise(knots)):
        return None
    return Bands.model_validate(dict(zip(("expert", "good", "pass", "zero"), knots, strict=True)))
