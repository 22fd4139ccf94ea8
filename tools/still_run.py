"""A whole simulated attempt that stands still where it is told to: for pictures.

The trainer is the real one in virtual time with the scripted trainee, so that a picture is the same
on every machine and no clock has to be waited for. The cameras are left out: the depth comes from
the plant itself.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from app.compose.desktop import Desktop
from app.compose.exercise_ct import load_field
from app.compose.exercise_field import resolve_tissue
from app.compose.trainer import Rig, TrainerSetup, build_rig
from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.core.progress import Progress
from app.exercises.guidance import GuidanceMode
from app.exercises.schema import Exercise
from app.exercises.tissue import with_tissue
from app.planning.placement import PlacedPlan
from app.session.pad.view import rings
from app.session.shown_views import Shown
from app.session.snapshot import Snapshot
from app.session.trainer import Trainer
from app.tracking.fix import FixStatus, NeedleFix
from app.views.exercise.run import ExerciseRun
from app.views.shell.services import RunSetup

START, LONGEST = 100.0, 120.0


class StillTrainer(Trainer):
    """Time passes only in `go_on`."""

    def go_on(self, until: Callable[[Snapshot], bool]) -> None:
        """Let virtual time pass until something is so.

        Raises:
            TimeoutError: if it has not been so within two minutes of that time.
        """
        end = self._clock.now() + LONGEST
        while not until(self.step()):
            if self._clock.now() > end:
                raise TimeoutError("the attempt did not get where the picture is taken")


class StillRun:
    """A trainer in virtual time for the window (`views.services.OpenRun`)."""

    def __init__(self, setup: RunSetup, sessions: Path, progress: Progress) -> None:
        clock, plan = VirtualClock(START), setup.placed.plan
        self._setup = setup
        tissues = load_field(setup.exercise, setup.volume, plan, progress)
        exercise = with_tissue(setup.exercise, setup.volume, plan)
        exercise, _ = resolve_tissue(exercise, setup.placed, tissues)
        self._rig: Rig = build_rig(
            TrainerSetup(
                exercise,
                setup.placed,
                setup.ct,
                "novice",
                setup.exercise.seed,
                sessions,
                clock,
                tissues=tissues,
            )
        )
        self.trainer = StillTrainer(
            self._rig.loop, None, setup.placed, exercise, None, clock, self._measure
        )
        self._rig.loop.open()
        self.trainer.go_on(lambda now: now.pose.measured)  # a depth is believed after some pictures

    def _measure(self, now: float) -> None:
        state = self._rig.loop.latest()
        tip = self._rig.profile.fulcrum + state.row[sv.PLANT_DEPTH] * state.axis
        pixels = (np.zeros(2), np.zeros(2))
        spread = np.diag([0.2e-3, 0.2e-3, 0.4e-3]) ** 2
        self.trainer.on_fix(NeedleFix(tip, spread, now, FixStatus.VALID, pixels, 0.0))

    @property
    def run(self) -> ExerciseRun:
        """What the views need."""
        exercise = self._setup.exercise
        return ExerciseRun(
            self.trainer,
            self._setup.placed,
            self._rig.profile,
            rings=rings(exercise.tolerances),
            guidance=exercise.guidance,
            shown=Shown(live=exercise.guidance_mode is GuidanceMode.LIVE),
        )

    @property
    def exercise(self) -> Exercise:
        """The exercise as it is computed."""
        return self._setup.exercise

    def compute_by(self, effect: str, model: str) -> Exercise:
        """Leave the exercise as it is."""
        return self._setup.exercise

    def place(self, placed: PlacedPlan) -> ExerciseRun:
        """Keep still: nothing is planned while a picture is taken."""
        return self.run

    def close(self) -> None:
        """End it."""
        self.trainer.abort()
        self._rig.loop.close()


class StillDesktop(Desktop):
    """The services of the window, with runs that stand still."""

    def open_run(self, setup: RunSetup, progress: Progress) -> StillRun:  # type: ignore[override]
        """Build a trainer in virtual time."""
        return StillRun(setup, self.sessions(), progress)
