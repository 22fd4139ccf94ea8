"""Limits and planned attempts of the two tests, so that the errors asked for are kept."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import ceil, sqrt
from statistics import NormalDist
from typing import Final

import numpy as np

from app.core.messages import sentence
from app.scoring.competence.cusum import (
    CompetenceError,
    CusumWeights,
    learning_weights,
    watching_weights,
)
from app.scoring.competence.rule import RULE, CompetenceRule
from app.scoring.competence.run_lengths import MOST_ATTEMPTS, signalled_by

STEP: Final = 0.01
"""Limits have two decimals."""

NEAR: Final = 0.01
"""So near below what was asked an error shall lie."""

_FURTHER: Final = 100
"""So many steps above a limit that keeps both errors are tried for some nearer what was asked."""

_BELOW: Final = 0.9
"""From this part of it on: errors go in steps, so that a lower limit may keep both as well."""


@dataclass(frozen=True, slots=True)
class Design:
    """Two tests that keep what a rule asks.

    Attributes:
        rule: that was asked.
        learning, watching: weights.
        limit: h of the learning test.
        attempts: planned, N.
        false_alarm: share of students who fail at the unacceptable rate that is called competent
            within N attempts: alpha that is reached, at most that asked.
        missed: share of students who fail at the acceptable rate that is not: beta, likewise.
        watch_limit: h of the watching test.
        false_relapse: share of students who fail at the acceptable rate that is said to relapse
            within N attempts of being watched; at most alpha.
        false_relapse_after_gap: the same, counted from a gap.
        unseen_relapse: share of those who fail at the unacceptable rate that is not within N.
    """

    rule: CompetenceRule
    learning: CusumWeights
    watching: CusumWeights
    limit: float
    attempts: int
    false_alarm: float
    missed: float
    watch_limit: float
    false_relapse: float
    false_relapse_after_gap: float
    unseen_relapse: float

    def false_alarm_by(self, attempt: int) -> float:
        """Return the bound of a false alarm at a signal at an attempt.

        Within the planned attempts it is what the rule asks. Whoever goes on without a signal may
        still get one; then it is the share that fails at the unacceptable rate and has had one by
        then, which is more.
        """
        if attempt <= self.attempts:
            return self.rule.false_alarm
        if attempt > MOST_ATTEMPTS:
            return 1.0
        rate = self.rule.unacceptable
        return float(signalled_by(self.learning, self.limit, rate, MOST_ATTEMPTS)[attempt])


@lru_cache(maxsize=64)
def design(rule: CompetenceRule = RULE) -> Design:
    """Return limits and planned attempts that keep a rule.

    The higher the limit, the fewer false alarms in a number of attempts, and the more attempts are
    needed to miss few. Taken is the lowest limit of two decimals for which a number of attempts
    keeps both errors and leaves them at most `NEAR` below what was asked; where a step more in
    limit or attempts changes an error by more than that, the lowest that keeps both.

    Raises:
        CompetenceError: if the rates are so near that `MOST_ATTEMPTS` do not tell them apart.
    """
    learning = learning_weights(rule.acceptable, rule.unacceptable)
    watching = watching_weights(rule.acceptable, rule.unacceptable)
    limit, attempts, false_alarm, missed = _planned(learning, rule)
    watch_limit = _limit_within(watching, rule.acceptable, attempts, rule.false_alarm)
    watched = (watching, watch_limit)
    seen = signalled_by(*watched, np.array([rule.acceptable, rule.unacceptable]), attempts)
    after_gap = signalled_by(*watched, rule.acceptable, attempts, start=head_start(watch_limit))
    return Design(
        rule=rule,
        learning=learning,
        watching=watching,
        limit=limit,
        attempts=attempts,
        false_alarm=false_alarm,
        missed=missed,
        watch_limit=watch_limit,
        false_relapse=float(seen[0, -1]),
        false_relapse_after_gap=float(after_gap[-1]),
        unseen_relapse=float(1.0 - seen[1, -1]),
    )


def head_start(watch_limit: float) -> float:
    """Return the least score of the watching test after a gap: half its limit.

    Lucas and Crosier 1982, Technometrics 24:199: a CUSUM that begins at h/2 finds soon what was
    wrong at its beginning, and costs little where nothing was.
    """
    return 0.5 * watch_limit


def _planned(weights: CusumWeights, rule: CompetenceRule) -> tuple[float, int, float, float]:
    """Return limit, attempts, and the two errors that are reached."""
    if _fewest(rule) > MOST_ATTEMPTS:
        raise _too_near(rule)
    low, high = 0, 1
    while not _plans(weights, rule, high):  # doubled until it can be kept, then halved
        low, high = high, 2 * high
        if high * STEP > 40.0:
            raise _too_near(rule)
    while high - low > 1:
        middle = (low + high) // 2
        if _plans(weights, rule, middle):
            high = middle
        else:
            low = middle
    least: tuple[float, int, float, float] | None = None
    for step in range(max(1, int(_BELOW * high)), high + _FURTHER):
        plans = _plans(weights, rule, step)
        least = least or (plans[0] if plans else None)
        for limit, attempts, false_alarm, missed in plans:
            if rule.false_alarm - false_alarm <= NEAR and rule.missed - missed <= NEAR:
                return limit, attempts, false_alarm, missed
    if least is None:
        raise _too_near(rule)
    return least


def _fewest(rule: CompetenceRule) -> float:
    """Return about how many attempts any test needs: the likelihood ratio's, all at once.

    No test of so many attempts has smaller errors (Neyman and Pearson 1933); by the normal
    approximation of the binomial distribution.
    """
    normal = NormalDist()
    apart = sum(
        normal.inv_cdf(1.0 - error) * sqrt(rate * (1.0 - rate))
        for error, rate in (
            (rule.false_alarm, rule.unacceptable),
            (rule.missed, rule.acceptable),
        )
    )
    return float((apart / (rule.unacceptable - rule.acceptable)) ** 2)


def _plans(
    weights: CusumWeights, rule: CompetenceRule, step: int
) -> list[tuple[float, int, float, float]]:
    """Return limit, attempts and errors for each number of attempts with which both are kept."""
    limit, horizon = round(STEP * step, 2), 64
    rates = np.array([rule.unacceptable, rule.acceptable])
    while True:
        false_alarm, found = signalled_by(weights, limit, rates, horizon)
        missed = 1.0 - found
        if false_alarm[-1] > rule.false_alarm or horizon >= MOST_ATTEMPTS:
            break
        if missed[-1] <= 0.5 * rule.missed:
            break  # more attempts would only lower what is missed
        horizon = min(2 * horizon, MOST_ATTEMPTS)
    right = np.flatnonzero((false_alarm <= rule.false_alarm) & (missed <= rule.missed))
    return [(limit, int(n), float(false_alarm[n]), float(missed[n])) for n in right]


def _limit_within(weights: CusumWeights, failure_rate: float, attempts: int, error: float) -> float:
    """Return the lowest limit that so few signal within the attempts; two decimals."""
    low, high = 0, ceil(weights.gain * attempts / STEP) + 1  # nothing reaches that
    while high - low > 1:
        middle = (low + high) // 2
        if signalled_by(weights, STEP * middle, failure_rate, attempts)[-1] <= error:
            high = middle
        else:
            low = middle
    return round(STEP * high, 2)


def _too_near(rule: CompetenceRule) -> CompetenceError:
    return CompetenceError(
        sentence(
            "failure rates of {acceptable:g} and {unacceptable:g} are too near to be told apart in "
            "{most} attempts with errors of {false_alarm:g} and {missed:g}: take rates further "
            "apart, or larger errors",
            acceptable=rule.acceptable,
            unacceptable=rule.unacceptable,
            most=MOST_ATTEMPTS,
            false_alarm=rule.false_alarm,
            missed=rule.missed,
        )
    )
