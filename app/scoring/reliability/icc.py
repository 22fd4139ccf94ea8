"""Intraclass correlations of students by exercises (or attempts, or judges), with intervals.

Shrout, P. E. and Fleiss, J. L. (1979), Intraclass correlations: uses in assessing rater
reliability, Psychological Bulletin 86, 420-428. With the mean squares between students B, within
them W, between columns J and of the residual E, of n students by k columns:

    1,1 = (B - W) / (B + (k - 1) W)                        each student has columns of his own
    2,1 = (B - E) / (B + (k - 1) E + k (J - E) / n)        columns drawn from many
    3,1 = (B - E) / (B + (k - 1) E)                        these columns and no others

and 1,k 2,k 3,k of the mean of the k columns. Intervals are theirs; that of 2,1 takes
Satterthwaite's degrees of freedom. No formula here divides by W or E, so that columns that agree
exactly give 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.scoring.errors import ReliabilityError

CONFIDENCE: Final = 0.95
"""Of all intervals here."""

FORMS: Final = ("1,1", "2,1", "3,1", "1,k", "2,k", "3,k")

NO_VARIANCE: Final = 1e-12
"""A mean square that is a smaller share of the points' own size is none."""

LEAST: Final = -100.0
"""Agreement of means has no lower end; what is below this says no more."""

_LEAST_DF: Final = 0.5
"""Satterthwaite's degrees of freedom come near 0 where all cancels; F has no quantile there."""


@dataclass(frozen=True, slots=True)
class Agreement:
    """One intraclass correlation.

    Attributes:
        form: one of `FORMS`.
        value: at most 1; below 0 where students differ less than chance has them.
        lower, upper: of its interval.
    """

    form: str
    value: float
    lower: float
    upper: float


@dataclass(frozen=True, slots=True)
class MeanSquares:
    """Mean squares of a complete table of n students by k columns.

    Attributes:
        n, k: rows and columns.
        between: of students.
        within: of students, with columns and residual together.
        columns: of columns.
        error: of the residual.
    """

    n: int
    k: int
    between: float
    within: float
    columns: float
    error: float

    @classmethod
    def of(cls, points: FloatArray) -> MeanSquares:
        """Return those of a table.

        Args:
            points: shape (students, columns), complete.

        Raises:
            ReliabilityError: under 2 students or columns, where a cell is missing, or where
                students do not differ at all.
        """
        points = checked_table(points)
        n, k = points.shape
        centred = points - points.mean()
        rows, columns = centred.mean(axis=1), centred.mean(axis=0)
        rest = centred - rows[:, None] - columns[None, :]
        between = k * float(rows @ rows) / (n - 1)
        if between <= NO_VARIANCE * (float((points**2).mean()) + 1e-300):
            raise ReliabilityError(
                sentence(
                    "all {students} students have the same mean points: nothing tells them apart; "
                    "take in more students, or a harder exercise",
                    students=n,
                )
            )
        return cls(
            n=n,
            k=k,
            between=between,
            within=float(((centred - rows[:, None]) ** 2).sum()) / (n * (k - 1)),
            columns=n * float(columns @ columns) / (k - 1),
            error=float((rest**2).sum()) / ((n - 1) * (k - 1)),
        )


def checked_table(points: FloatArray) -> FloatArray:
    """Return a complete table of points.

    Raises:
        ReliabilityError: under 2 students or 2 columns, or where a cell is missing or no number.
    """
    points = np.asarray(points, dtype=np.float64)
    if points.ndim != 2 or points.shape[0] < 2:
        raise ReliabilityError(
            sentence(
                "students with points: {students}; reliability needs 2 students at least: "
                "take in more",
                students=points.shape[0] if points.ndim == 2 else 0,
            )
        )
    if points.shape[1] < 2:
        raise ReliabilityError(
            sentence(
                "{columns} column of points: agreement needs 2 exercises or 2 attempts at least",
                columns=points.shape[1],
            )
        )
    missing = np.argwhere(~np.isfinite(points))
    if len(missing):
        row, column = (int(place) + 1 for place in missing[0])
        raise ReliabilityError(
            sentence(
                "the points in row {row}, column {column} are missing: leave that row or that "
                "column out, or complete it",
                row=row,
                column=column,
            )
        )
    return points


def intraclass(points: FloatArray, confidence: float = CONFIDENCE) -> tuple[Agreement, ...]:
    """Return all six intraclass correlations of a table, in the order of `FORMS`.

    Args:
        points: shape (students, columns), complete.
        confidence: of the intervals, between 0 and 1.

    Raises:
        ReliabilityError: as `MeanSquares.of`.
    """
    ms = MeanSquares.of(points)
    tail = 0.5 * (1.0 + confidence)
    singles = (
        _fixed("1,1", ms, ms.within, ms.n * (ms.k - 1), tail),
        _random(ms, tail),
        _fixed("3,1", ms, ms.error, (ms.n - 1) * (ms.k - 1), tail),
    )
    means = [
        Agreement(
            f"{single.form[0]},k",
            *(_of_mean(value, ms.k) for value in (single.value, single.lower, single.upper)),
        )
        for single in singles
    ]
    return (*singles, *means)


def _fixed(form: str, ms: MeanSquares, error: float, df: int, tail: float) -> Agreement:
    """Return a form whose F is that of students over one error."""
    low, high = _quantile(tail, ms.n - 1, df), 1.0 / _quantile(tail, df, ms.n - 1)

    def at(factor: float) -> float:
        return (ms.between - factor * error) / (ms.between + (ms.k - 1) * factor * error)

    return Agreement(form, at(1.0), at(low), at(high))


def _random(ms: MeanSquares, tail: float) -> Agreement:
    """Return the form 2,1."""
    n, k = ms.n, ms.k
    # B + (k - 1) E + k (J - E) / n, in terms none of which is below 0
    whole = ms.between + (k * ms.columns + (k * n - k - n) * ms.error) / n
    value = (ms.between - ms.error) / whole
    a = k * value * ms.columns
    b = (n * (1.0 + (k - 1) * value) - k * value) * ms.error
    below = (n - 1) * a * a + b * b
    df = (k - 1) * (n - 1) * (a + b) ** 2 / below if below > 0.0 else _LEAST_DF
    df = max(df, _LEAST_DF)
    upper, lower = _quantile(tail, n - 1, df), _quantile(tail, df, n - 1)
    others = k * ms.columns + (k * n - k - n) * ms.error
    least = n * (ms.between - upper * ms.error) / (upper * others + n * ms.between)
    most = n * (lower * ms.between - ms.error) / (others + n * lower * ms.between)
    return Agreement("2,1", value, min(least, value), max(most, value))


def _of_mean(single: float, k: int) -> float:
    """Return what the mean of k columns has, by Spearman and Brown; `LEAST` at least."""
    below = 1.0 + (k - 1) * single
    return max(k * single / below, LEAST) if below > 0.0 else LEAST


def _quantile(tail: float, above: float, below: float) -> float:
    from scipy.special import fdtri

    return float(fdtri(above, below, tail))
