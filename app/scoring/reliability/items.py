"""Exercises as items: how hard, how well each parts students, how far a single score can be off."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.scoring.errors import ReliabilityError
from app.scoring.reliability.icc import NO_VARIANCE, checked_table


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
