"""Sample size and power: by simulated studies under the mixed model, and by closed forms.

The closed forms are the two-sample t test (noncentral t; Cohen, Statistical Power Analysis, 2nd
ed., 1988) and the same with the first visit as covariate, whose variance is less by 1 - r² (Borm,
Fransen & Lemmens, J Clin Epidemiol 60:1234, 2007). Simulation is for what they do not cover.

A mixed model for students who come to several visits: two arms, students as random intercepts.

All arms have one mean at the first visit, as randomisation makes them equal (constrained
longitudinal data analysis; Liang & Zeger, Sankhya B 62:134, 2000); each later visit has an effect
of the arm. Variances by restricted maximum likelihood. Where all students come to all visits the
covariance has two parts, within and between students, and the likelihood one unknown: many studies
are fitted at once. `nlme` and `lme4` of R give the same (tests).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.research.errors import ResearchError

MOST_STUDENTS: Final = 20_000
SIMULATIONS: Final = 2000
_AT_ONCE: Final = 250
_SEARCHES: Final = 4


@dataclass(frozen=True, slots=True)
class Assumptions:
    """What is assumed of a study of two arms.

    Attributes:
        effect: difference of the arms at the visit that matters, in the outcome's unit.
        sd: standard deviation of students' means at one visit, in the same unit.
        correlation: of a student's means at two visits.
        visits: how many, the first before training; 1 for none before.
        share: of the students in the second arm.
        alpha: of the two-sided test.
    """

    effect: float
    sd: float
    correlation: float = 0.5
    visits: int = 2
    share: float = 0.5
    alpha: float = 0.05

    def __post_init__(self) -> None:
        limits = (
            ("effect", math.isfinite(self.effect) and self.effect != 0.0, "not 0"),
            ("sd", math.isfinite(self.sd) and self.sd > 0.0, "greater than 0"),
            ("correlation", 0.0 <= self.correlation < 1.0, "0 to less than 1"),
            ("visits", 1 <= self.visits <= 12, "1 to 12"),
            ("share", 0.05 <= self.share <= 0.95, "0.05 to 0.95"),
            ("alpha", 0.0 < self.alpha < 0.5, "between 0 and 0.5"),
        )
        for name, holds, valid in limits:
            if not holds:
                raise ResearchError(
                    sentence(
                        "{name} is {entry:g}; it must be {valid}",
                        name=name,
                        entry=getattr(self, name),
                        valid=valid,
                    )
                )

    def second(self, students: int) -> int:
        """Return how many students are in the second arm."""
        return min(max(round(self.share * students), 2), students - 2)


@dataclass(frozen=True, slots=True)
class Simulated:
    """What simulated studies gave.

    Attributes:
        students: in all.
        power: share of the studies whose test was significant.
        error: standard error of `power`, of so many simulations.
        coverage: share whose interval held the effect.
        simulations: how many.
    """

    students: int
    power: float
    error: float
    coverage: float
    simulations: int


def power_of_t(students: int, assumed: Assumptions, with_baseline: bool) -> float:
    """Return the power of the two-sample t test, or of that with the first visit as covariate.

    Args:
        students: in all.
        assumed: of the study.
        with_baseline: whether the first visit is a covariate.
    """
    from scipy.stats import nct, t

    second = assumed.second(students)
    sd = assumed.sd * (math.sqrt(1.0 - assumed.correlation**2) if with_baseline else 1.0)
    freedom = students - (3 if with_baseline else 2)
    noncentral = abs(assumed.effect) / (sd * math.sqrt(1.0 / second + 1.0 / (students - second)))
    critical = t.ppf(1.0 - 0.5 * assumed.alpha, freedom)
    both = nct.sf(critical, freedom, noncentral) + nct.cdf(-critical, freedom, noncentral)
    return float(np.nan_to_num(both, nan=1.0))  # so far out that no digit is left


def simulate(
    students: int, assumed: Assumptions, simulations: int = SIMULATIONS, seed: int = 1
) -> Simulated:
    """Simulate studies and fit each: power, and how often the interval holds the effect.

    The effect is that of the second visit, which the later ones keep; with one visit alone the t
    test is taken.

    Args:
        students: in all.
        assumed: of the study.
        simulations: how many studies.
        seed: of the random numbers.

    Raises:
        ResearchError: if the students are too few.
    """
    from scipy.stats import t

    if students < 4:
        raise ResearchError(sentence("{n} students are too few: at least 4", n=students))
    rng = np.random.default_rng(seed)
    second = np.zeros(students)
    second[: assumed.second(students)] = 1.0
    significant = held = 0
    for begin in range(0, simulations, _AT_ONCE):
        count = min(_AT_ONCE, simulations - begin)
        values = _values(count, second, assumed, rng)
        if assumed.visits == 1:
            effects, errors, freedom = _difference(values[:, :, 0], second)
        else:
            found = fit(values, second)
            effects, errors, freedom = found.effects[:, 0], found.errors[:, 0], found.freedom
        critical = float(t.ppf(1.0 - 0.5 * assumed.alpha, freedom))
        significant += int((np.abs(effects) > critical * errors).sum())
        held += int((np.abs(effects - assumed.effect) <= critical * errors).sum())
    power = significant / simulations
    error = math.sqrt(power * (1.0 - power) / simulations)
    return Simulated(students, power, error, held / simulations, simulations)


def students_for(power: Callable[[int], float], wanted: float, step: int = 2) -> int:
    """Return the fewest students, in steps, whose power is what is wanted.

    Args:
        power: of so many students; it grows with them.
        wanted: share.
        step: students are a multiple of it.

    Raises:
        ResearchError: if `MOST_STUDENTS` do not suffice.
    """
    high = max(2, math.ceil(4 / step))
    while power(high * step) < wanted:
        high *= 2
        if high * step > MOST_STUDENTS:
            raise ResearchError(
                sentence(
                    "{most} students would be too few: the effect is too small beside the "
                    "standard deviation",
                    most=MOST_STUDENTS,
                )
            )
    low = max(1, math.ceil(4 / step) - 1)
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if power(middle * step) >= wanted else (middle, high)
    return high * step


def students_by_simulation(
    assumed: Assumptions, wanted: float, simulations: int = SIMULATIONS, seed: int = 1
) -> Simulated:
    """Return simulated studies of about as many students as the wanted power needs.

    The closed form with the first visit as covariate begins; then the number is moved until the
    simulated power is what is wanted, within its standard error.

    Raises:
        ResearchError: if `MOST_STUDENTS` do not suffice.
    """
    from scipy.stats import norm

    with_baseline = assumed.visits > 1
    students = students_for(lambda n: power_of_t(n, assumed, with_baseline), wanted)
    quantile = float(norm.ppf(1.0 - 0.5 * assumed.alpha))
    needed = quantile + float(norm.ppf(wanted))
    found = simulate(students, assumed, simulations, seed)
    for _ in range(_SEARCHES):
        if abs(found.power - wanted) <= found.error:
            break
        reached = quantile + float(norm.ppf(min(max(found.power, 0.02), 0.999)))
        moved = max(4, 2 * math.ceil(0.5 * students * (needed / reached) ** 2))
        if moved == students:
            break
        students = moved
        found = simulate(students, assumed, simulations, seed)
    return found


def _values(
    count: int, second: FloatArray, assumed: Assumptions, rng: np.random.Generator
) -> FloatArray:
    """Draw the outcomes of studies, shape (count, n, V)."""
    shape = (count, len(second), assumed.visits)
    own = math.sqrt(assumed.correlation) * assumed.sd
    rest = math.sqrt(1.0 - assumed.correlation) * assumed.sd
    values = own * rng.standard_normal((*shape[:2], 1)) + rest * rng.standard_normal(shape)
    after = 0 if assumed.visits == 1 else 1
    values[:, :, after:] += assumed.effect * second[:, None]
    result: FloatArray = values
    return result


def _difference(values: FloatArray, second: FloatArray) -> tuple[FloatArray, FloatArray, int]:
    """Return difference of means, its standard error and degrees of freedom, of each study."""
    in_second = second > 0.0
    a, b = values[:, ~in_second], values[:, in_second]
    freedom = values.shape[1] - 2
    squares = a.var(axis=1) * a.shape[1] + b.var(axis=1) * b.shape[1]
    errors = np.sqrt(squares / freedom * (1.0 / a.shape[1] + 1.0 / b.shape[1]))
    return b.mean(axis=1) - a.mean(axis=1), errors, freedom


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
