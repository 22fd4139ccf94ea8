"""Pass marks out of judges' estimates and examiners' ratings, each with its standard error.

Angoff, W. H. (1971), Scales, norms and equivalent scores; of whole exercises in place of items
(extended Angoff: Hambleton and Plake 1995): the mark is the mean over judges of the points that
somebody who is just good enough would have, its standard error that of a mean. Borderline
regression (Kramer, A. and others 2003, Medical Education 37, 132-139): the line of points on global
ratings, at the rating that means borderline; its standard error that of the line there. Contrasting
groups stand in `contrasting`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core.messages import sentence
from app.scoring.errors import ReliabilityError
from app.scoring.pass_mark import MarkMethod

LEAST_JUDGES: Final = 3
"""Fewer say more of themselves than of the standard."""

LEAST_RATED: Final = 5
"""Attempts that a line of points on ratings needs."""

BORDERLINE: Final = 2.0
"""Rating that means borderline, of 1 (clear fail), 2 (borderline), 3 (clear pass), 4 and 5."""


@dataclass(frozen=True, slots=True)
class PassMark:
    """A pass mark as a method gives it.

    Attributes:
        method: by which.
        points: the mark, 0 ... 100.
        standard_error: of it [points].
        people: judges, or persons whose attempts were used.
        attempts: that were used; 0 where judges saw none.
    """

    method: MarkMethod
    points: float
    standard_error: float
    people: int
    attempts: int = 0


def angoff(estimates: Sequence[float]) -> PassMark:
    """Return the mark of judges: their mean, with its standard error.

    Args:
        estimates: of each judge, points that somebody who is just good enough would have.

    Raises:
        ReliabilityError: under `LEAST_JUDGES` judges.
    """
    given = np.asarray(estimates, dtype=np.float64)
    if len(given) < LEAST_JUDGES:
        raise ReliabilityError(
            sentence(
                "{judges} judges: a mark by Angoff needs {least} at least; ask more",
                judges=len(given),
                least=LEAST_JUDGES,
            )
        )
    error = float(given.std(ddof=1)) / np.sqrt(len(given))
    return PassMark(MarkMethod.ANGOFF, float(given.mean()), float(error), len(given))


def borderline(
    ratings: Sequence[float], points: Sequence[float], people: int, at: float = BORDERLINE
) -> PassMark:
    """Return the mark where the line of points on ratings passes the rating of borderline.

    Args:
        ratings: global ratings of attempts.
        points: of the same attempts.
        people: how many persons did them.
        at: rating that means borderline.

    Raises:
        ReliabilityError: for too few attempts, ratings without spread or that do not reach `at`,
            points that do not rise with them, or a mark beyond 0 ... 100.
    """
    x, y = np.asarray(ratings, dtype=np.float64), np.asarray(points, dtype=np.float64)
    if len(x) < LEAST_RATED:
        raise ReliabilityError(
            sentence(
                "{attempts} rated attempts: borderline regression needs {least} at least; "
                "rate more",
                attempts=len(x),
                least=LEAST_RATED,
            )
        )
    if x.min() == x.max():
        raise ReliabilityError(
            sentence(
                "all ratings are {rating:g}: ratings without spread have no line; rate attempts of "
                "other quality as well",
                rating=float(x[0]),
            )
        )
    if not x.min() <= at <= x.max():
        raise ReliabilityError(
            sentence(
                "ratings go from {least:g} to {most:g}, and borderline is {borderline:g}: rate "
                "attempts on both sides of it, or give the rating that means borderline by --at",
                least=float(x.min()),
                most=float(x.max()),
                borderline=at,
            )
        )
    middle = float(x.mean())
    spread = float(((x - middle) ** 2).sum())
    slope = float((x - middle) @ (y - y.mean())) / spread
    if slope <= 0.0:
        raise ReliabilityError(
            sentence(
                "points do not rise with the ratings ({slope:.1f} points a step): the ratings say "
                "something else than the score; see whether the scale runs the right way",
                slope=slope,
            )
        )
    rest = y - y.mean() - slope * (x - middle)
    variance = float(rest @ rest) / (len(x) - 2)
    mark = float(y.mean()) + slope * (at - middle)
    error = np.sqrt(variance * (1.0 / len(x) + (at - middle) ** 2 / spread))
    if not 0.0 <= mark <= 100.0:
        raise ReliabilityError(
            sentence(
                "the line gives {mark:.0f} points at {borderline:g}, beyond 0 to 100: rate more "
                "attempts near borderline",
                mark=mark,
                borderline=at,
            )
        )
    return PassMark(MarkMethod.BORDERLINE, mark, float(error), people, len(x))
