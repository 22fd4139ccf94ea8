"""What attempts cost in the time of processors, and what many more of them would."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

HOUR: Final = 3600.0


@dataclass(frozen=True, slots=True)
class Spent:
    """Time of a processor that one part took.

    Attributes:
        attempts: in it.
        preparing: once in a process, for the patient and the robot's tables [s].
        working: on the attempts themselves [s].
    """

    attempts: int
    preparing: float
    working: float


@dataclass(frozen=True, slots=True)
class AttemptCost:
    """AttemptCost of an attempt, and a model: processes x preparing + attempts x working.

    Time of processors is counted, not of clocks: a busy computer takes longer and costs the same.

    Attributes:
        attempt: time of a processor for one attempt [s]; 0 where there was none.
        attempt_sd: standard error of that by the parts [s]; None with fewer than two parts.
        preparing: once in a process [s]: the most that a part took.
    """

    attempt: float
    attempt_sd: float | None
    preparing: float

    @classmethod
    def of(cls, spent: Sequence[Spent]) -> AttemptCost:
        """Sum up what parts took: the mean over attempts, its error from part to part."""
        counted = [part for part in spent if part.attempts]
        attempts = sum(part.attempts for part in counted)
        preparing = max((part.preparing for part in spent), default=0.0)
        if not attempts:
            return cls(0.0, None, preparing)
        mean = sum(part.working for part in counted) / attempts
        sizes = np.array([part.attempts for part in counted], dtype=float)
        rest = np.array([part.working for part in counted]) - mean * sizes
        number = len(counted)
        error = None
        if number > 1:  # of a ratio of two sums
            error = float(np.sqrt(number / (number - 1) * np.sum(rest**2)) / attempts)
        return cls(mean, error, preparing)

    def core_hours(self, attempts: float, processes: int = 1) -> float:
        """Return how long one processor would be busy with so many attempts [h]."""
        return (attempts * self.attempt + processes * self.preparing) / HOUR

    def document(self, attempts: float, processes: int, price: float | None) -> dict[str, Any]:
        """Return the figures as JSON-ready values.

        Args:
            attempts: that the model is asked for.
            processes: that would do them.
            price: of an hour of one processor; None says no money.
        """
        hours = self.core_hours(attempts, processes)
        return {
            "attempt_s": self.attempt,
            "attempt_sd_s": self.attempt_sd,
            "preparing_s": self.preparing,
            "attempts": attempts,
            "core_hours": hours,
            "price": price,
            "money": None if price is None else hours * price,
        }
