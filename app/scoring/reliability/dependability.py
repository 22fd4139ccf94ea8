"""G and D study: how far a mean of several exercises and attempts can be relied on.

Brennan (2001), sections 1.1 and 4.1. Of a mean over n exercises with m attempts each, all drawn
from many, the error variances are

    relative  v(se)/n + v(so)/m + v(seo)/(nm)                 for ranking students
    absolute  relative + v(e)/n + v(o)/m + v(eo)/(nm)         for a pass mark

and G = v(s) / (v(s) + relative), Phi = v(s) / (v(s) + absolute). The standard error of a score is
the root of the absolute error variance. With one exercise, or one attempt at each, the components
that cannot be seen are in the residual, and nothing is said of more exercises, or attempts.

Exercises as items: how hard, how well each parts students, how far a single score can be off.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.scoring.errors import ReliabilityError
from app.scoring.reliability.components import (
    EXERCISE,
    OCCASION,
    RESIDUAL,
    STUDENT,
    VarianceComponents,
)
from app.scoring.reliability.icc import CONFIDENCE, NO_VARIANCE, checked_table

WANTED: Final = 0.8
"""G or Phi that an assessment with consequences should have (Brennan 2001; Downing 2004)."""

_MOST: Final = 10_000
"""More attempts or exercises than that are as good as never."""


@dataclass(frozen=True, slots=True)
class DecisionStudy:
    """What a mean of so many exercises and attempts would be worth.

    Attributes:
        components: as estimated.
    """

    components: VarianceComponents

    @property
    def sees_exercises(self) -> bool:
        """Return whether there were several exercises."""
        return self.components.exercises > 1

    @property
    def sees_attempts(self) -> bool:
        """Return whether there were several attempts at an exercise."""
        return self.components.occasions > 1

    def error(self, exercises: int, attempts: int, absolute: bool = True) -> float:
        """Return the error variance of a mean [points²].

        Args:
            exercises: how many, 1 or more.
            attempts: at each of them, 1 or more.
            absolute: against a pass mark; else against other students.
        """
        return float(_error(self.components.variance, exercises, attempts, absolute))

    def coefficient(self, exercises: int, attempts: int, absolute: bool = False) -> float:
        """Return G, or Phi where `absolute`: 0 ... 1, and 0 where students do not differ."""
        own = self.components.variance(STUDENT)
        return own / (own + self.error(exercises, attempts, absolute)) if own > 0.0 else 0.0

    def interval(
        self, exercises: int, attempts: int, absolute: bool = False, confidence: float = CONFIDENCE
    ) -> tuple[float, float] | None:
        """Return an interval of G, or Phi; None where nothing tells how uncertain it is.

        Args:
            exercises: how many, 1 or more.
            attempts: at each of them, 1 or more.
            absolute: for Phi, else for G.
            confidence: between 0 and 1.
        """
        draws = self.components.draws
        if not draws:
            return None
        own = draws[STUDENT]
        nothing = np.zeros_like(own)
        error = _error(
            lambda *facets: draws.get(":".join(facets), nothing), exercises, attempts, absolute
        )
        whole = np.maximum(own + error, np.finfo(float).tiny)
        tail = 0.5 * (1.0 - confidence)
        low, high = np.quantile(own / whole, [tail, 1.0 - tail])
        value = self.coefficient(exercises, attempts, absolute)
        return min(float(low), value), max(float(high), value)

    def standard_error(self, exercises: int = 1, attempts: int = 1, absolute: bool = True) -> float:
        """Return the standard error of a score [points]."""
        return math.sqrt(self.error(exercises, attempts, absolute))

    def attempts_for(
        self, exercises: int, absolute: bool = False, wanted: float = WANTED
    ) -> int | None:
        """Return how many attempts at each exercise are enough; None where no number is.

        Args:
            exercises: how many there are.
            absolute: for Phi, else for G.
            wanted: coefficient, between 0 and 1.
        """
        if not self.sees_attempts:
            return None
        return self._enough(lambda count: self.coefficient(exercises, count, absolute), wanted)

    def exercises_for(
        self, attempts: int, absolute: bool = False, wanted: float = WANTED
    ) -> int | None:
        """Return how many exercises are enough with so many attempts each; None where no number is.

        Args:
            attempts: at each exercise.
            absolute: for Phi, else for G.
            wanted: coefficient, between 0 and 1.
        """
        if not self.sees_exercises:
            return None
        return self._enough(lambda count: self.coefficient(count, attempts, absolute), wanted)

    @staticmethod
    def _enough(of: Callable[[int], float], wanted: float) -> int | None:
        """Return the least count for which a coefficient, which rises, is as wanted."""
        if of(_MOST) < wanted:
            return None
        low, high = 0, _MOST
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (low, middle) if of(middle) >= wanted else (middle, high)
        return high


def _error(v: Callable[..., Any], exercises: int, attempts: int, absolute: bool) -> Any:
    """Return the error variance of a mean, of components that are numbers or draws of them."""
    both = exercises * attempts
    error = v(STUDENT, EXERCISE) / exercises + v(STUDENT, OCCASION) / attempts + v(RESIDUAL) / both
    if absolute:
        error += v(EXERCISE) / exercises + v(OCCASION) / attempts + v(EXERCISE, OCCASION) / both
    return error


@dataclass(frozen=True, slots=True)
class ItemStatistics:
    """One exercise among others.

    Attributes:
        difficulty: mean points over 100, as the classical p: 1 is easy.
        discrimination: correlation of its points with the mean of the *other* exercises
            (corrected item-total); None where one of the two has no spread.
    """

    difficulty: float
    discrimination: float | None


def item_statistics(points: FloatArray) -> tuple[ItemStatistics, ...]:
    """Return the statistics of each exercise.

    Args:
        points: mean of each student at each exercise, shape (students, exercises), complete.

    Raises:
        ReliabilityError: under 2 students or exercises, or where a cell is missing.
    """
    points = checked_table(points)
    whole = points.sum(axis=1)
    return tuple(
        ItemStatistics(float(own.mean()) / 100.0, _correlation(own, whole - own))
        for own in points.T
    )


def _correlation(a: FloatArray, b: FloatArray) -> float | None:
    """Return Pearson's correlation; None where one of them has no spread."""
    sizes = [float(np.mean(one**2)) for one in (a, b)]
    a, b = a - a.mean(), b - b.mean()
    spread = float(a @ a), float(b @ b)
    if any(s <= NO_VARIANCE * n * len(a) for s, n in zip(spread, sizes, strict=True)):
        return None
    return float(np.clip(float(a @ b) / np.sqrt(spread[0]) / np.sqrt(spread[1]), -1.0, 1.0))


def within_student_sd(attempts: Sequence[Sequence[float]]) -> tuple[float, int]:
    """Return the standard deviation of a student's points about his own mean, and its freedom.

    Pooled over students: the root of the mean square within students of a one-way analysis of
    variance, which takes as many attempts of each as there are. It is the standard error of a
    single score, with all that changes from one attempt of a student to the next.

    Args:
        attempts: points of each student's attempts.

    Raises:
        ReliabilityError: unless two students have two attempts each.
    """
    several = [np.asarray(own, dtype=np.float64) for own in attempts if len(own) > 1]
    if len(several) < 2:
        raise ReliabilityError(
            sentence(
                "students with 2 attempts or more: {students}; the standard error of a score needs "
                "2 such students at least: let them repeat the exercise",
                students=len(several),
            )
        )
    freedom = sum(len(own) - 1 for own in several)
    squares = sum(float(((own - own.mean()) ** 2).sum()) for own in several)
    return float(np.sqrt(squares / freedom)), freedom
