"""Lots of one attempt, drawn once: whether a complication happens is then decided by what is done.

A pneumothorax happens at the moment at which its probability, given all that was done until then,
first exceeds its lot. As everything that is done only ever raises the probability, it happens in
exactly the share of attempts that the model states, whatever was done in which order, how fast, or
how long the needle lay.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from math import isfinite
from typing import Any

import numpy as np

from app.core.messages import sentence
from app.scoring.errors import ScoringError


@dataclass(frozen=True, slots=True)
class Lots:
    """Numbers between 0 and 1, each evenly spread over seeds and independent of the others.

    Attributes:
        air: whether a pneumothorax happens.
        drain: whether it is one that needs a drain, if nothing else is done.
        size: of it.
        delay: until it begins, after what caused it.
        aspiration: whether aspirating it helps.
        blood: whether the lung bleeds.
        grade: whether that is of a higher grade.
        cough: whether blood is coughed.
        spread: how far the blood spreads.
        bleeding: until it begins, after what caused it.

    Raises:
        ScoringError: if a number is no lot.
    """

    air: float
    drain: float
    size: float
    delay: float
    aspiration: float
    blood: float
    grade: float
    cough: float
    spread: float
    bleeding: float

    def __post_init__(self) -> None:
        for one in fields(self):
            value = getattr(self, one.name)
            if not (isinstance(value, float) and isfinite(value) and 0.0 <= value < 1.0):
                raise ScoringError(
                    sentence(
                        "lot {name} is {drawn!r}; it must lie between 0 and 1",
                        name=one.name,
                        drawn=value,
                    )
                )

    @classmethod
    def of(cls, seed: int, attempt: int) -> Lots:
        """Draw those of an attempt; the same for the same two numbers, 0 and up."""
        drawn = np.random.default_rng([seed, attempt]).random(len(fields(cls)))
        return cls(*drawn.tolist())

    def document(self) -> dict[str, float]:
        """Return them as JSON-ready values; `read` reads them back to the last bit."""
        return asdict(self)

    @classmethod
    def read(cls, document: Mapping[str, Any]) -> Lots:
        """Read them back.

        Raises:
            ScoringError, LookupError, TypeError, ValueError: if it is no such document.
        """
        return cls(*(float(document[one.name]) for one in fields(cls)))
