"""Variance components of points of students x exercises x occasions, all crossed and all random.

Brennan, R. L. (2001), Generalizability Theory: the points of a student at an exercise on an
occasion are a mean, an effect of each of the three, one of each pair of them, and what is left,
which the interaction of all three cannot be told from. A facet of one level drops out, with its
interactions: they are in what is left.

Where every cell has points the components are those of the expected mean squares (closed form; an
estimate below 0 counts as 0 and is named). Where cells are missing they maximise the restricted
likelihood (`reml`). An occasion is the first, second, third ... of the attempts that are taken of a
student at an exercise, so that what all learn from one to the next is the occasion's.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from itertools import combinations
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.scoring.errors import ReliabilityError
from app.scoring.reliability.icc import NO_VARIANCE
from app.scoring.reliability.reml import DRAWS, RandomEffect, reml

STUDENT: Final = "student"
EXERCISE: Final = "exercise"
OCCASION: Final = "occasion"
RESIDUAL: Final = "residual"
FACETS: Final = (STUDENT, EXERCISE, OCCASION)
"""Axes of a cube."""

_SEED: Final = 1993


class Estimator(StrEnum):
    """How components were estimated."""

    ANOVA = "anova"
    """Closed form of a complete table."""
    REML = "reml"
    """Restricted likelihood of a table with missing cells."""


@dataclass(frozen=True)
class ScoreCube:
    """Points of students x exercises x occasions.

    Attributes:
        values: shape (students, exercises, occasions); NaN where there are none.
    """

    values: FloatArray

    def __post_init__(self) -> None:
        """Refuse what no component can be estimated of.

        Raises:
            ReliabilityError: for another shape, points that are infinite, under 2 students, nothing
                beside students, or no variance.
        """
        values = np.asarray(self.values, dtype=np.float64)
        if values.ndim != 3 or np.isinf(values).any():
            raise ReliabilityError(
                sentence("points need the axes student, exercise and occasion, all finite")
            )
        there = np.isfinite(values)
        students = int(there.any(axis=(1, 2)).sum())
        if students < 2:
            raise ReliabilityError(
                sentence(
                    "students with points: {students}; reliability needs 2 students at least: "
                    "take in more",
                    students=students,
                )
            )
        if there.sum(axis=(1, 2)).max() < 2:
            raise ReliabilityError(
                sentence(
                    "each student has points once only: reliability needs 2 exercises or 2 "
                    "attempts at least"
                )
            )
        known = values[there]
        if float(known.var()) <= NO_VARIANCE * (float((known**2).mean()) + 1e-300):
            raise ReliabilityError(
                sentence(
                    "all {attempts} attempts have the same points: nothing varies; take in more "
                    "students, or harder exercises",
                    attempts=len(known),
                )
            )
        object.__setattr__(self, "values", values)


@dataclass(frozen=True)
class VarianceComponents:
    """Where the variance of points comes from.

    Attributes:
        students, exercises, occasions: how many there were.
        attempts: cells with points.
        estimator: how it was estimated.
        variances: by name, in points², none below 0: `student`, `exercise`, `occasion`, pairs as
            `student:exercise`, and `residual`; those of facets of one level are not there.
        below_zero: names whose closed form was below 0.
        draws: by name what the components may be as well, shape (DRAWS,), but for a common factor:
            generalised pivotal quantities of the mean squares (Weerahandi 1993, JASA 88, 899-905;
            Burdick, Borror and Montgomery 2005, chapter 3), or drawn by the curvature of the
            restricted likelihood; empty where that has none.
    """

    students: int
    exercises: int
    occasions: int
    attempts: int
    estimator: Estimator
    variances: Mapping[str, float]
    below_zero: tuple[str, ...] = ()
    draws: Mapping[str, FloatArray] = field(default_factory=dict, compare=False, repr=False)

    @property
    def total(self) -> float:
        """Return the variance of one attempt of anybody at any exercise [points²]."""
        return sum(self.variances.values())

    def variance(self, *facets: str) -> float:
        """Return one component, 0 where there is none [points²]."""
        return self.variances.get(":".join(facets), 0.0)


def variance_components(cube: ScoreCube) -> VarianceComponents:
    """Return the variance components of a cube.

    Raises:
        ReliabilityError: where the attempts that there are do not tell the components apart, or
            leave nothing to chance.
    """
    values = _without_empty(cube.values)
    facets = [name for name, count in zip(FACETS, values.shape, strict=True) if count > 1]
    if np.isfinite(values).all():
        estimates, draws = _closed_form(values.reshape([n for n in values.shape if n > 1]), facets)
        estimator = Estimator.ANOVA
    else:
        (estimates, draws), estimator = _restricted(values, facets), Estimator.REML
    students, exercises, occasions = (int(count) for count in values.shape)
    return VarianceComponents(
        students=students,
        exercises=exercises,
        occasions=occasions,
        attempts=int(np.isfinite(values).sum()),
        estimator=estimator,
        variances=MappingProxyType({name: max(0.0, v) for name, v in estimates.items()}),
        below_zero=tuple(name for name, v in estimates.items() if v < 0.0),
        draws=MappingProxyType({name: np.maximum(0.0, some) for name, some in draws.items()}),
    )


def _without_empty(values: FloatArray) -> FloatArray:
    """Return a cube without students, exercises and occasions that have no points at all."""
    for axis in range(3):
        others = tuple(one for one in range(3) if one != axis)
        values = np.compress(np.isfinite(values).any(axis=others), values, axis=axis)
    return values


def _effects(facets: list[str]) -> list[tuple[str, ...]]:
    """Return all effects of some facets, the one of all of them at last."""
    return [own for size in range(1, len(facets) + 1) for own in combinations(facets, size)]


def _name(effect: tuple[str, ...], facets: list[str]) -> str:
    return RESIDUAL if len(effect) == len(facets) else ":".join(effect)


def _closed_form(
    values: FloatArray, facets: list[str]
) -> tuple[dict[str, float], dict[str, FloatArray]]:
    """Return the components by expected mean squares (Brennan 2001, section 3.2.2), and draws.

    A mean square of expectation s with n degrees of freedom is s chi²(n) / n, so that what s may be
    is drawn as n times the mean square that was seen over chi²(n).

    Args:
        values: one axis for each facet, complete.
        facets: names of the axes.
    """
    from scipy.special import gammaincinv

    axes = range(len(facets))
    centred = values - values.mean()
    squares: dict[tuple[str, ...], float] = {}
    drawn: dict[tuple[str, ...], FloatArray] = {}
    rng = np.random.default_rng(_SEED)
    for effect in _effects(facets):
        inside = [axis for axis in axes if facets[axis] in effect]
        deviation = centred
        for axis in axes:
            mean = deviation.mean(axis=axis, keepdims=True)
            deviation = deviation - mean if axis in inside else mean
        repeats = values.size / deviation.size
        df = float(np.prod([values.shape[axis] - 1 for axis in inside]))
        squares[effect] = repeats * float((deviation**2).sum()) / df
        shares = rng.permutation((np.arange(DRAWS) + 0.5) / DRAWS)
        drawn[effect] = df * squares[effect] / (2.0 * gammaincinv(0.5 * df, shares))
    # what differs from 0 by rounding alone is not below it
    rounding = NO_VARIANCE * float((values**2).mean())
    estimates = _solved(squares, facets, values.shape)
    exact = {name: 0.0 if abs(v) <= rounding else float(v) for name, v in estimates.items()}
    return exact, _solved(drawn, facets, values.shape)


def _solved(
    squares: Mapping[tuple[str, ...], Any], facets: list[str], shape: tuple[int, ...]
) -> dict[str, Any]:
    """Return the components whose expected mean squares these are: numbers, or arrays of draws."""
    solved = {}
    for effect in squares:
        outside = [count for count, facet in zip(shape, facets, strict=True) if facet not in effect]
        total = sum(
            (-1) ** (len(other) - len(effect)) * square
            for other, square in squares.items()
            if set(effect) <= set(other)
        )
        solved[_name(effect, facets)] = total / np.prod(outside)
    return solved


def _restricted(
    values: FloatArray, facets: list[str]
) -> tuple[dict[str, float], dict[str, FloatArray]]:
    """Return the components of a cube with missing cells, and draws."""
    cells = np.argwhere(np.isfinite(values))
    points = values[tuple(cells.T)]
    effects = []
    for own in _effects(facets)[:-1]:
        columns = cells[:, [FACETS.index(facet) for facet in own]]
        levels = np.unique(columns, axis=0, return_inverse=True)[1].reshape(-1)
        effects.append(RandomEffect(_name(own, facets), levels, nested=STUDENT in own))
    estimates, draws = reml(points, cells[:, 0], effects)
    names = [*(effect.name for effect in effects), RESIDUAL]
    return dict(zip(names, estimates, strict=True)), dict(zip(names, draws, strict=False))
