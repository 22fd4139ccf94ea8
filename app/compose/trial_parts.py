"""What an attempt in virtual time has in place of a running program's: records, cameras, a hand."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING, Any, Final

from app.core.arrays import FloatArray
from app.core.units import MILLISECOND
from app.exercises.parts import TissueSource
from app.session.beginnings import Beginnings
from app.session.context import RunContext
from app.session.fixes import DepthTrust
from app.session.header import FIELD_FACTS
from app.session.recorder import Recorder
from app.session.trainer import Trainer
from app.session.withdrawal import Start
from app.simulation.trainee import TraineeScript
from app.tracking.optics.rig import RigProfile
from app.tracking.simulated.sampled import PROCESSING, SampledTracker
from app.tracking.tracker import Tracker

if TYPE_CHECKING:
    from app.compose.trainer import TrainerSetup
    from app.device.control import Loop
    from app.exercises.schema import Exercise
    from app.mechanisms.profile import DeviceProfile
    from app.scoring.result import Score
    from app.session.risks import Risk
    from app.tracking.cameras.camera import Camera
    from app.tracking.fix import NeedleFix


STEP_TICKS: Final = 20
"""Ticks of the loop between two looks of the trainer, as in the program at 1 kHz."""

BEGIN: Final = 10.0
SETTLED: Final = 0.6
"""Virtual time [s]: of the beginning, and for the cameras to be believed."""


class _Unrecorded(Recorder):
    """A recorder that writes nothing: it is never open, so it drops what it is given."""

    def open(self) -> None:
        """Leave the disk alone."""


@dataclass(frozen=True, slots=True)
class NoRecords(RunContext):
    """The context of attempts of which nothing is kept."""

    def recorder(self, header: Any, loop: Any, placed: Any, clock: Any) -> Recorder:
        """Return one that writes nothing; no checkpoint is taken."""
        return _Unrecorded(self.folder, header, clock=clock)

    @classmethod
    def of(cls, exercise: Exercise, seed: int) -> NoRecords:
        """Return that of an attempt by a simulated hand, which feels the field if there is one."""
        looks = {FIELD_FACTS: {"digest": ""}} if exercise.tissue is TissueSource.FIELD else {}
        return cls(seed=seed, metadata={"device": {"simulated": "yes"}, **looks})


class RenderedTracker:
    """Fixes by rendered pictures, taken at the looks of a trainer; late as those of `tracker`."""

    def __init__(self, cameras: tuple[Camera, Camera], rig: RigProfile, *how: Any) -> None:
        self._tracker, self._next = Tracker(cameras, rig, *how), inf
        self._cameras, self._rig = cameras, rig
        self._late: list[tuple[float, NeedleFix]] = []

    def begin(self, now: float) -> None:
        """Take the first pictures now."""
        self._next = now
        for camera in self._cameras:
            camera.open()

    def cover(self, until: float) -> None:
        """Take no pictures before a time [s]."""
        self._next = max(self._next, until)

    def due(self, now: float) -> list[NeedleFix]:
        """Take pictures if they are there, and return the fixes that are there by now.

        Time does not wait for a picture: a camera that is asked too early would let it go on
        without the loop.
        """
        if now >= self._next:
            left, right = (camera.read() for camera in self._cameras)
            latency = self._rig.latency_ms * MILLISECOND
            self._next = max(left.time, right.time) + 1.0 / self._rig.rate_hz + latency
            fix = self._tracker.process(left, right)
            self._late.append((fix.time + latency + PROCESSING, fix))
        there = [fix for time, fix in self._late if time <= now]
        self._late = [(time, fix) for time, fix in self._late if time > now]
        return there


@contextmanager
def virtual_trainer(
    setup: TrainerSetup,
    loop: Loop,
    profile: DeviceProfile,
    tracker: SampledTracker | RenderedTracker,
    risks: tuple[Risk, ...] = (),
    beginnings: Beginnings | None = None,
    covered: Callable[[float], float | None] = lambda now: None,
) -> Iterator[Trainer]:
    """Put a trainer round a loop, in virtual time, until its cameras are believed; close the loop.

    Args:
        setup: of the run, with a virtual clock.
        loop: its own.
        profile: of the device.
        tracker: measures the needle.
        risks: structures that the needle has to keep away from.
        beginnings: where a person's simulated hand begins; None for where scripts do.
        covered: says until when the cameras are covered at a time [s]; None where they are not.
    """
    clock, exercise = setup.clock, setup.exercise

    def measure(now: float) -> None:
        until = covered(now)
        if until is not None:
            tracker.cover(until)
        for fix in tracker.due(now):
            trainer.on_fix(fix)

    trainer = Trainer(
        loop,
        None,
        setup.placed,
        exercise,
        NoRecords.of(exercise, setup.seed),
        clock,
        measure,
        risks=risks,
        tissues=setup.tissues,
        trust=DepthTrust(profile.hand.depth_speed),
        start=Start.SIMULATED,
        beginnings=beginnings,
        scripted=setup.skill or "",
        pictures=setup.pictures,
    )
    loop.open()
    try:
        begin = clock.now()
        trainer.step(STEP_TICKS)
        tracker.begin(clock.now())
        while clock.now() < begin + SETTLED:
            trainer.step(STEP_TICKS)
        yield trainer
    finally:
        loop.close()


@dataclass(frozen=True, slots=True, eq=False)
class PlayedHand:
    """A hand that no skill describes, and what it does beside the needle.

    Attributes:
        script: of the hand.
        dial: what it turns the robot's help to before it begins; None leaves it.
        covered: when it covers both cameras, (from, to) since the attempt began [s].
    """

    script: TraineeScript
    dial: float | None = None
    covered: tuple[tuple[float, float], ...] = ()

    def covers(self, since: float) -> float | None:
        """Return until when the cameras are covered at a time since the beginning [s], if so."""
        ends = [end for begin, end in self.covered if begin <= since < end]
        return max(ends, default=None)


@dataclass(frozen=True, slots=True)
class Trial:
    """What an attempt of `Trials` came to.

    Attributes:
        score: None where it could not be scored.
        duration: virtual time of the attempt [s].
    """

    score: Score | None
    duration: float


@dataclass(frozen=True, slots=True, eq=False)
class PlayedTrial(Trial):
    """The same of a hand that no skill describes.

    Attributes:
        rows: the loop's state at each look, as it truly was, shape (n, slots).
    """

    rows: FloatArray
