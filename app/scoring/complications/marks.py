"""Complications of an attempt as scoring sees them: when each began, was noticed, was answered.

They are scored apart from the needle. Where the lung has fallen back, the target lies elsewhere by
lot; so that no lot costs anybody, the needle is then judged by the nearer of two places: where the
target lay, and where the last control scan showed it (`shown`).
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.scoring.complications.answers import AnswerWorth, Kind
from app.scoring.errors import TrajectoryError

TIME_TO_ACT_S: Final = 30.0
"""A complication, or a worse row of the table, that had been there for less at the end, and that
nobody answered, is not asked for."""

UNNOTICED_S: Final = 600.0
"""Counts as the time after which one was noticed that nobody noticed."""


@dataclass(frozen=True, slots=True)
class Demand:
    """A row of the table of answers that held during an attempt.

    Attributes:
        kind: of the complication.
        row: name of the row.
        severity: of it.
        time: from which it held [s].
    """

    kind: Kind
    row: str
    severity: int
    time: float


@dataclass(frozen=True, slots=True)
class Given:
    """An answer.

    Attributes:
        time: of it [s].
        answer: its name.
        verdict: what it was worth.
        kind: of the complication that it was taken for; None where there was none.
    """

    time: float
    answer: str
    verdict: AnswerWorth
    kind: Kind | None = None


@dataclass(frozen=True, slots=True)
class ComplicationMarks:
    """What happened and what was done about it.

    Attributes:
        begun: kind -> moment at which it began [s].
        demands: rows that held, in order.
        noticed: moments at which somebody said that something is wrong [s], answers among them.
        given: answers, in order.
        shown: (time [s], displacement of the target in the last control scan, world [m]), in order.
        until: end of the attempt [s].

    Raises:
        TrajectoryError: if a number is not finite.
    """

    begun: tuple[tuple[Kind, float], ...] = ()
    demands: tuple[Demand, ...] = ()
    noticed: tuple[float, ...] = ()
    given: tuple[Given, ...] = ()
    shown: tuple[tuple[float, tuple[float, float, float]], ...] = ()
    until: float = 0.0

    def __post_init__(self) -> None:
        numbers = [self.until, *self.noticed, *(time for _, time in self.begun)]
        numbers += [demand.time for demand in self.demands]
        numbers += [given.time for given in self.given]
        numbers += [value for time, place in self.shown for value in (time, *place)]
        if not all(map(isfinite, numbers)):
            raise TrajectoryError(sentence("a complication of the attempt: a number is not finite"))

    def waits(self) -> tuple[float, ...]:
        """Return after how long each complication was noticed [s]; those too late are left out."""
        found = []
        for _, time in self.begun:
            after = [moment - time for moment in self.noticed if moment >= time]
            if after:
                found.append(min(after))
            elif self.until - time >= TIME_TO_ACT_S:
                found.append(UNNOTICED_S)
        return tuple(found)

    def worth(self) -> tuple[float, ...]:
        """Return what the answers to each row are worth, 0 to 1; 0 for each that nothing asked for.

        Right at once 1, right after another answer a half, one that helps a half, else 0.
        """
        found = [value for value in map(self._worth, self.demands) if value is not None]
        found += [0.0 for one in self.given if one.verdict is AnswerWorth.NOTHING_THERE]
        return tuple(found)

    def fallen(self, time: float) -> FloatArray | None:
        """Return how far the last control scan showed the target displaced [m], shape (3,).

        None where no scan before that moment showed it displaced.
        """
        number = bisect_right([moment for moment, _ in self.shown], time) - 1
        place = self.shown[number][1] if number >= 0 else (0.0, 0.0, 0.0)
        return np.array(place) if any(place) else None

    def _worth(self, demand: Demand) -> float | None:
        later = [
            other.time
            for other in self.demands
            if other.kind is demand.kind and other.time > demand.time
        ]
        end = min(later, default=self.until)
        answers = [
            one for one in self.given if one.kind is demand.kind and demand.time <= one.time <= end
        ]
        if not answers:
            return None if end - demand.time < TIME_TO_ACT_S else 0.0
        return _worth_of([one.verdict for one in answers])


def _worth_of(verdicts: Sequence[AnswerWorth]) -> float:
    if verdicts[0] is AnswerWorth.RIGHT:
        return 1.0
    helps = AnswerWorth.RIGHT in verdicts or AnswerWorth.HELPS in verdicts
    return 0.5 if helps else 0.0
