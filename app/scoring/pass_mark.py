"""The pass mark as people set it: by which method, with which standard error.

It stands in an exercise (`rules.mark`) and so in each of its scores: another mark is another
version of the exercise. What scripts do sets none: they are `scripts, not people`.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from typing import Annotated, Any

from pydantic import Field

from app.core.configuration import Strict


class MarkMethod(StrEnum):
    """How people set a pass mark."""

    ANGOFF = "angoff"
    """Judges say what somebody who is just good enough would score."""
    BORDERLINE = "borderline"
    """Regression of points on examiners' global ratings, at the rating `borderline`."""
    CONTRASTING = "contrasting"
    """Where attempts of the experienced and of others part."""


class SetMark(Strict):
    """How the pass mark was set.

    Attributes:
        method: by which it was set.
        points: the mark, which `pass_mark` repeats.
        standard_error: of the mark, were it set again by others of their kind [points].
        people: judges, or persons whose attempts were used.
        score_error: standard error of a single score [points], from people who repeated the
            exercise; none where too few had.
    """

    method: MarkMethod
    points: Annotated[float, Field(ge=0.0, le=100.0)]
    standard_error: Annotated[float, Field(ge=0.0, le=100.0)]
    people: Annotated[int, Field(ge=1)]
    score_error: Annotated[float, Field(ge=0.0, le=100.0)] | None = None


def is_near_mark(score: Mapping[str, Any]) -> bool:
    """Return whether a stored score lies within the error of measurement of its pass mark.

    Args:
        score: as `scoring.result.Score.document` writes it.
    """
    rules = score.get("rules") or {}
    error, total = (rules.get("mark") or {}).get("score_error"), score.get("total")
    if error is None or total is None:
        return False
    return bool(abs(float(total) - float(rules["pass_mark"])) <= float(error))
