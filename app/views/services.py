"""What the window asks of the rest of the program; `compose` hands it in."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from app.core.progress import Progress
from app.exercises.schema import Exercise
from app.planning.placement import PlacedPlan
from app.views.exercise.run import ExerciseRun


@dataclass(frozen=True, slots=True, eq=False)
class RunSetup:
    """What a run is made of.

    Attributes:
        exercise: effects, device, cameras, tolerances.
        placed: the plan in the robot's frame.
        ct: pseudonym of the CT, for the record.
    """

    exercise: Exercise
    placed: PlacedPlan
    ct: str = ""


class OpenRun(Protocol):
    """A trainer that runs."""

    @property
    def run(self) -> ExerciseRun:
        """What its views need."""
        ...

    def place(self, placed: PlacedPlan) -> ExerciseRun:
        """Take another plan and return the run with it.

        Raises:
            AcusError: if an attempt is running, or this device cannot follow the plan.
        """
        ...

    def close(self) -> None:
        """End everything at zero force; idempotent; may wait for threads."""
        ...


class Services(Protocol):
    """What `compose` gives the window."""

    def exercises(self) -> tuple[Exercise, ...]:
        """Exercises to choose from, easiest first."""
        ...

    def sessions(self) -> Path:
        """Folder of the recorded attempts."""
        ...

    def prepare(self, progress: Progress) -> None:
        """Load what an exercise needs; called beside the window once it is painted.

        Raises:
            ImportError: if a part of the program cannot be loaded; says which.
            Cancelled: if `progress` was cancelled.
        """
        ...

    def open_run(self, setup: RunSetup, progress: Progress) -> OpenRun:
        """Build and start a trainer; called beside the window, may take seconds.

        Returns once the loop has made its first ticks, so that an attempt can begin at once.

        Raises:
            AcusError: whatever keeps it from running; nothing stays open then.
            Cancelled: if `progress` was cancelled.
        """
        ...
