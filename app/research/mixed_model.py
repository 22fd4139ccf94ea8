"""A mixed model for students who come to several visits: two arms, students as random intercepts.

All arms have one mean at the first visit, as randomisation makes them equal (constrained
longitudinal data analysis; Liang & Zeger, Sankhya B 62:134, 2000); each later visit has an effect
of the arm. Variances by restricted maximum likelihood. Where all students come to all visits the
covariance has two parts, within and between students, and the likelihood one unknown: many studies
are fitted at once. `nlme` and `lme4` of R give the same (tests).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.research.errors import ResearchError

_GOLDEN: Final = 0.5 * (5**0.5 - 1.0)
_STEPS: Final = 48
"""Of the golden section: the interval shrinks to 1e-10 of itself."""

_LEAST: Final = 1e-9
"""Share w = 1 / (1 + visits · λ) is no less: students would explain all."""


@dataclass(frozen=True, slots=True, eq=False)
class MixedFit:
    """Fits of S studies.

    Attributes:
        effects: of the second arm at each visit but the first, shape (S, V - 1).
        errors: their standard errors, shape (S, V - 1).
        sd_students: of the random intercepts, shape (S,).
        sd_rest: of what is left, shape (S,).
        freedom: degrees of freedom of the intervals: students less arms.
    """

    effects: FloatArray
    errors: FloatArray
    sd_students: FloatArray
    sd_rest: FloatArray
    freedom: int


def fit(values: FloatArray, second: FloatArray) -> MixedFit:
    """MixedFit S studies that have the same students in the same arms.

    Args:
        values: outcomes, shape (S, n, V): studies, students, visits; two visits at least.
        second: 1 for a student of the second arm, else 0, shape (n,).

    Raises:
        ResearchError: if there are fewer than two visits or students in an arm.
    """
    _, n, visits = values.shape
    in_second = int(second.sum())
    if visits < 2 or min(in_second, n - in_second) < 2:
        raise ResearchError(
            sentence("a mixed model needs two visits and two students in each arm at least")
        )
    design = _design(second, visits)
    p = design.shape[2]
    mean = design.mean(axis=1)
    inner = design - mean[:, None, :]
    within = np.einsum("ivp,ivq->pq", inner, inner)
    between = visits * mean.T @ mean
    level = values.mean(axis=2)
    rest = values - level[:, :, None]
    y_within = np.einsum("ivp,siv->sp", inner, rest)
    y_between = visits * level @ mean
    sum_within = np.einsum("siv,siv->s", rest, rest)
    sum_between = visits * np.einsum("si,si->s", level, level)
    freedom = n * visits - p

    def parts(w: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        matrix = within + w[:, None, None] * between
        right = y_within + w[:, None] * y_between
        found = np.linalg.solve(matrix, right[:, :, None])[:, :, 0]
        squares = sum_within + w * sum_between - np.einsum("sp,sp->s", found, right)
        return matrix, found, squares

    def deviance(log_w: FloatArray) -> FloatArray:
        w = np.exp(log_w)
        matrix, _, squares = parts(w)
        _, determinant = np.linalg.slogdet(matrix)
        result: FloatArray = freedom * np.log(squares / freedom) + determinant - n * log_w
        return result

    w = np.exp(_least(deviance, len(values)))
    matrix, found, squares = parts(w)
    variance = squares / freedom
    inverse = np.linalg.inv(matrix)
    errors = np.sqrt(variance[:, None] * np.diagonal(inverse, axis1=1, axis2=2))
    between_variance = variance * (1.0 / w - 1.0) / visits
    return MixedFit(
        found[:, visits:], errors[:, visits:], np.sqrt(between_variance), np.sqrt(variance), n - 2
    )


def _design(second: FloatArray, visits: int) -> FloatArray:
    """Return columns for each visit, then for the arm at each but the first, shape (n, V, p)."""
    n = len(second)
    design = np.zeros((n, visits, 2 * visits - 1))
    for visit in range(visits):
        design[:, visit, visit] = 1.0
        if visit:
            design[:, visit, visits + visit - 1] = second
    return design


def _least(function: Callable[[FloatArray], FloatArray], count: int) -> FloatArray:
    """Return where a function of log w is least for each of `count` studies: golden section."""
    low, high = np.full(count, np.log(_LEAST)), np.zeros(count)
    a, b = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    at_a, at_b = function(a), function(b)
    for _ in range(_STEPS):
        left = at_a < at_b
        high, low = np.where(left, b, high), np.where(left, low, a)
        next_a, next_b = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        fresh = np.where(left, next_a, next_b)
        at_fresh = function(fresh)
        at_a, at_b = np.where(left, at_fresh, at_b), np.where(left, at_a, at_fresh)
        a, b = next_a, next_b
    middle: FloatArray = 0.5 * (low + high)
    edge = function(np.zeros(count)) <= function(middle)  # no variance between students
    return np.where(edge, 0.0, middle)
