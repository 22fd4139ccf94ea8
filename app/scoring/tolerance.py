"""Tolerance bands: how good a value is, from 0 to 1."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

import numpy as np
from pydantic import ConfigDict, Field, model_validator

from app.core.configuration import Strict
from app.core.errors import NumericalError
from app.core.messages import sentence

LARGEST_WEIGHT = 1e9
"""Sums of such weights stay finite."""

EXPERT_UTILITY, GOOD_UTILITY, PASS_UTILITY = 1.0, 0.8, 0.6


class Band(StrEnum):
    """Where a value falls."""

    EXPERT = "expert"
    GOOD = "good"
    PASS = "pass"
    FAIL = "fail"


class Bands(Strict):
    """Limits of the bands of one metric, in its unit.

    The order of the three tells the direction: 2, 3, 5 (expert, good, pass) means that lower is
    better, 99, 95, 80 that higher is. The sign of the value does not count.

    Attributes:
        expert: from here on the utility is 1.
        good: here it is 0.8.
        pass_: (`pass` in a file) here it is 0.6; beyond it the value has failed.
        zero: here and beyond it is 0; default twice `pass` where lower is better, else half of it.
    """

    model_config = ConfigDict(populate_by_name=True)

    expert: float
    good: float
    pass_: Annotated[float, Field(alias="pass")]
    zero: float | None = None

    @model_validator(mode="after")
    def _ordered(self) -> Bands:
        steps = np.diff(self.knots)
        if not ((steps > 0.0).all() or (steps < 0.0).all()):
            raise ValueError(
                sentence(
                    "expert, good, pass and zero must rise or fall strictly in this order; they "
                    "are "
                )
                + ", ".join(f"{knot:g}" for knot in self.knots)
            )
        if min(self.knots) < 0.0 or not np.isfinite(self.knots).all():
            raise ValueError(
                sentence(
                    "expert, good, pass and zero must be finite and 0 or more, as the sign of a "
                    "value does not count; they are "
                )
                + ", ".join(f"{knot:g}" for knot in self.knots)
            )
        return self

    @property
    def higher_is_better(self) -> bool:
        """Direction of the bands."""
        return self.expert > self.pass_

    @property
    def knots(self) -> tuple[float, float, float, float]:
        """Values at which the utility is 1, 0.8, 0.6 and 0."""
        beyond = 0.5 * self.pass_ if self.expert > self.pass_ else 2.0 * self.pass_
        zero = beyond if self.zero is None else self.zero
        return self.expert, self.good, self.pass_, zero


class Tolerance(Bands):
    """Bands of one metric and what it counts.

    Attributes:
        weight: share in the total, relative to the other weights; 0 shows without counting.
        required: whether the attempt fails when the value lies beyond `pass`, whatever the total.
    """

    weight: Annotated[float, Field(ge=0.0, le=LARGEST_WEIGHT)] = 1.0
    required: bool = False


def tolerance(value: float, bands: Bands) -> float:
    """Return how good a value is, 0 ... 1.

    1 at `expert` or better, then piecewise linear through 0.8 at `good`, 0.6 at `pass` and 0 at
    `zero`: continuous, and monotone in the distance of the value from zero.

    Raises:
        NumericalError: if the value is NaN.
    """
    if np.isnan(value):
        raise NumericalError(sentence("a value that is NaN has no utility"))
    sign = -1.0 if bands.higher_is_better else 1.0
    knots = sign * np.array(bands.knots)
    utilities = (EXPERT_UTILITY, GOOD_UTILITY, PASS_UTILITY, 0.0)
    return float(np.interp(sign * abs(value), knots, utilities))


def best_within(value: float, sd: float | None, bands: Bands) -> float:
    """Return the best size that a value may truly have within one standard deviation.

    Nobody can tell the two apart, so the doubt is the student's. It moves all knots by `sd`, the
    same for everybody whose `sd` is the same, and leaves the utility continuous and monotone.

    Args:
        value: as measured.
        sd: of it, in the same unit; None if not known: then the value counts as it is.
        bands: which tell the direction.
    """
    if not sd:
        return abs(value)
    return abs(value) + sd if bands.higher_is_better else max(0.0, abs(value) - sd)


def band(value: float, bands: Bands) -> Band:
    """Name the band that a value falls into; a limit belongs to the better band."""
    sign = -1.0 if bands.higher_is_better else 1.0
    for name, limit in zip(Band, bands.knots, strict=True):
        if sign * abs(value) <= sign * limit and name is not Band.FAIL:
            return name
    return Band.FAIL
