"""How soon a CUSUM test signals: exact distributions of its run length, by a Markov chain.

The score of a series that passes or fails takes few values: a whole number of gains less a whole
number of losses, begun anew at 0. These values are the states of a Markov chain (Brook and Evans
1972, Biometrika 59:539), here without the rounding that is needed where scores are continuous: what
comes out is exact but for the rounding of doubles.
"""

from __future__ import annotations

from functools import lru_cache
from math import inf
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.messages import sentence
from app.scoring.competence.cusum import CompetenceError, CusumWeights

MOST_ATTEMPTS: Final = 300
"""No test is planned, and no run length told, over more attempts of one person at one skill."""

_DIGITS: Final = 9
"""Scores that agree to so many decimals are one state."""

_SETTLED: Final = 1e-12
"""Where the share that goes on changes by less from attempt to attempt, it stays as it is."""


def signalled_by(
    weights: CusumWeights,
    limit: float,
    failure_rates: FloatArray | float,
    attempts: int,
    start: float = 0.0,
) -> FloatArray:
    """Return the probability that the test has signalled by each attempt.

    Args:
        weights: of the test.
        limit: h; the score that signals, > 0.
        failure_rates: one, or several, shape (m,).
        attempts: n, 0 to `MOST_ATTEMPTS`.
        start: score before the first attempt, below the limit.

    Returns:
        Shape (n + 1,), or (m, n + 1); the first is that before any attempt, 0.

    Raises:
        CompetenceError: if limit, start or attempts are out of these ranges.
    """
    if not (0 <= attempts <= MOST_ATTEMPTS and 0.0 <= start < limit < inf):
        raise CompetenceError(
            sentence(
                "limit {limit:g}, start {start:g} and {attempts} attempts: the start is at least 0 "
                "and below the limit, attempts are 0 to {most}",
                limit=limit,
                start=start,
                attempts=attempts,
                most=MOST_ATTEMPTS,
            )
        )
    upwards, downwards = _states(weights, limit, attempts, start)
    rates: FloatArray = np.atleast_1d(np.asarray(failure_rates, float))
    gaining = np.array([weights.chance(rate) for rate in rates])[:, None]
    count, above = len(upwards), upwards < 0
    rows = np.arange(len(rates))[:, None]
    targets = np.concatenate(  # of a gain, then of a loss, from each score at each rate
        [rows * count + np.maximum(upwards, 0), rows * count + np.maximum(downwards, 0)], axis=None
    )
    going_on = np.zeros((len(rates), count))
    going_on[:, 0] = 1.0
    signalled = np.zeros((len(rates), attempts + 1))
    for attempt in range(1, attempts + 1):
        gained = gaining * going_on
        new = signalled[:, attempt - 1] + gained[:, above].sum(axis=1)
        signalled[:, attempt] = np.minimum(new, 1.0)
        gained[:, above] = 0.0
        moved = np.concatenate([gained, (1.0 - gaining) * going_on], axis=None)
        counted = np.bincount(targets, moved, going_on.size)
        going_on = counted.astype(float, copy=False).reshape(going_on.shape)
    return read_only(signalled[0] if np.ndim(failure_rates) == 0 else signalled)


def mean_run_length(weights: CusumWeights, limit: float, failure_rate: float) -> float:
    """Return how many attempts the test takes on average to signal; inf where it never does.

    Summed are the shares that go on after each attempt. These fall geometrically in the end, by
    which the sum is closed.

    Raises:
        CompetenceError: as `signalled_by`.
    """
    chance = weights.chance(failure_rate)
    if chance <= 0.0:
        return inf
    share = 1.0 - signalled_by(weights, limit, failure_rate, MOST_ATTEMPTS)
    last = int(np.argmax(share < _SETTLED)) or len(share) - 1
    if share[last] < _SETTLED:
        return float(share[: last + 1].sum())
    ratio = share[-1] / share[-2]
    return float(share.sum() + share[-1] * ratio / (1.0 - ratio)) if ratio < 1.0 else inf


@lru_cache(maxsize=256)
def _states(
    weights: CusumWeights, limit: float, attempts: int, start: float
) -> tuple[np.ndarray[tuple[int], np.dtype[np.int64]], ...]:
    """Return where a gain and where a loss leads from each score; -1 is the signal.

    Scores that could only come up after the last attempt are left out; what leads to them leads to
    the first state instead, which nobody asks for any more.
    """
    scores, depths, number = [start], [0], {round(start, _DIGITS): 0}
    upwards: list[int] = []
    downwards: list[int] = []

    def state(score: float, depth: int) -> int:
        known = number.get(key := round(score, _DIGITS))
        if known is None and depth <= attempts:
            known = number[key] = len(scores)
            scores.append(score)
            depths.append(depth)
        return known or 0

    for place, score in enumerate(scores):  # it grows while it is walked through
        depth = depths[place] + 1
        above = score + weights.gain
        upwards.append(-1 if above >= limit else state(above, depth))
        downwards.append(state(max(0.0, score - weights.loss), depth))
    return np.array(upwards), np.array(downwards)
