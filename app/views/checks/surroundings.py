"""What the pages of the checks need of the window."""

from __future__ import annotations

from typing import Protocol

from app.core.arrays import FloatArray
from app.imaging.volume import Volume
from app.views.exercise.run import ExerciseRun


class Surroundings(Protocol):
    """What the dialog needs of the window."""

    def run(self) -> ExerciseRun | None:
        """Return what runs now."""
        ...

    def volume(self) -> Volume | None:
        """Return the CT that is shown."""
        ...

    def cursor_mm(self) -> FloatArray:
        """Return the crosshair in the CT (LPS, mm), shape (3,)."""
        ...
