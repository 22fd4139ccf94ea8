"""What is told of an attempt, as plain values in the frame of its CT."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from typing import Final

Point = tuple[float, float, float]

POINTS: Final = ("Entry", "Target", "Tip")


@dataclass(frozen=True, slots=True)
class MeasuredValue:
    """One measured value.

    Attributes:
        name: of the metric.
        label: for people.
        value: in `unit`.
        unit: as the metric declares it: mm, °, s, N, % …; empty for a plain number.
    """

    name: str
    label: str
    value: float
    unit: str


@dataclass(frozen=True, slots=True)
class AttemptFacts:
    """An attempt.

    Attributes:
        id: of the attempt; UIDs are made of it.
        moment: when it began, `YYYYMMDDHHMMSS`, UTC; objects are dated by it.
        title: of the exercise.
        entry_mm: of the plan, LPS.
        target_mm: of the plan, LPS.
        tip_mm: of the needle at the end, LPS; None where it is not known.
        measured: values, the total of the score first.
        passed: whether the score passes; None without one.
    """

    id: str
    moment: str
    title: str
    entry_mm: Point
    target_mm: Point
    tip_mm: Point | None
    measured: tuple[MeasuredValue, ...]
    passed: bool | None

    @property
    def points(self) -> dict[str, Point]:
        """Return entry, target and, where it is known, the tip, by name."""
        found = dict(zip(POINTS, (self.entry_mm, self.target_mm, self.tip_mm), strict=True))
        return {name: point for name, point in found.items() if point is not None}

    def uid(self, *parts: str) -> str:
        """Return a UID under 2.25 (PS3.5 B.2) of this attempt and what it is for."""
        digest = hashlib.sha256(repr(("attempt", self.id, *parts)).encode()).digest()[:16]
        return f"2.25.{int.from_bytes(digest, 'big')}"
