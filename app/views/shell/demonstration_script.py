"""What is demonstrated, and what cannot be."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from app.core.errors import AcusError


class DemonstrationError(AcusError):
    """An exercise cannot be shown by itself."""


@dataclass(frozen=True, slots=True)
class Script:
    """What is demonstrated.

    Attributes:
        exercise: identifier of the exercise.
        ct: folder of another CT; None for the exercise's own patient.
        student: pseudonym.
        pictures: folder for pictures and report; None for none.
    """

    exercise: str = "first-insertion"
    ct: Path | None = None
    student: str = "demo"
    pictures: Path | None = None
