"""How many attempts more until somebody is called competent: an interval, and what it supposes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.scoring.competence.design import Design
from app.scoring.competence.run_lengths import signalled_by

LAST: Final = 20
"""The failure rate is told from so many last attempts, or as many as there are."""

INTERVAL: Final = 0.8
"""Share of students in this situation whose number lies in the interval, a tenth on either side."""

_AHEAD: Final = 3
"""It looks so many times the planned attempts ahead."""

_ANGLES: Final = 24
"""Rates over which is averaged: from 16 on more of them change no interval of 300 tried."""


@dataclass(frozen=True, slots=True)
class Forecast:
    """From `low` to `high` attempts more, with 80 %; None for more than anybody looks ahead."""

    low: int | None
    high: int | None


def forecast(plan: Design, score: float, last: Sequence[bool]) -> Forecast:
    """Return how many attempts more it takes until the learning test signals.

    It supposes that he goes on to fail at the rate of his last attempts, each independently of the
    others. That rate is not known exactly: of k failures in n attempts it has the distribution
    Beta(k + 1/2, n - k + 1/2), which is what Jeffreys' prior makes of them. The run length from the
    present score is exact for each rate, and averaged over them. Somebody who is still learning
    needs fewer, somebody who tires needs more.

    Args:
        plan: the tests.
        score: of the learning test.
        last: whether each of the last attempts passed.
    """
    failures = sum(not one for one in last)
    return _forecast(plan, round(score, 9), failures, len(last))


@lru_cache(maxsize=4096)
def _forecast(plan: Design, score: float, failures: int, attempts: int) -> Forecast:
    rates, shares = rates_of(failures, attempts)
    signalled = signalled_by(plan.learning, plan.limit, rates, _AHEAD * plan.attempts, score)
    reached = shares @ signalled
    low, high = (_first(reached, 0.5 * (1.0 + side * INTERVAL)) for side in (-1.0, 1.0))
    return Forecast(low, high)


def rates_of(failures: int, attempts: int) -> tuple[FloatArray, FloatArray]:
    """Return failure rates and how likely each is, after so many failures in so many attempts.

    With p = sin² a the prior p^(-1/2) (1 - p)^(-1/2) dp is even in a: of evenly spaced angles, m of
    them, means are exact for polynomials in p of a degree below 2 m (Gauss and Chebyshev).
    """
    angles = (np.arange(_ANGLES) + 0.5) * (0.5 * np.pi / _ANGLES)
    logarithms = 2.0 * (
        failures * np.log(np.sin(angles)) + (attempts - failures) * np.log(np.cos(angles))
    )
    shares = np.exp(logarithms - logarithms.max())
    return read_only(np.sin(angles) ** 2), read_only(shares / shares.sum())


def _first(reached: FloatArray, share: float) -> int | None:
    """Return the first attempt by which so many are reached."""
    there = np.flatnonzero(reached >= share)
    return int(there[0]) if len(there) else None
