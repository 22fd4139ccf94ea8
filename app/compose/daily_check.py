"""The daily check without a window: robot and cameras for two minutes, and one touched point."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

import numpy as np

from app.compose.trainer import Rig, TrainerSetup, build_rig
from app.core.arrays import FloatArray, unit
from app.core.messages import sentence
from app.exercises.library import load_exercise
from app.exercises.scene import device_of, placed_plan_of
from app.exercises.tissue import in_layers
from app.planning.registration.errors import RegistrationError
from app.planning.registration.plate import FiducialPlate
from app.session.checks.facts import DailyFacts, TouchFacts
from app.session.checks.gather import daily_facts, robot_facts, touch_facts
from app.session.touch import TouchCollector, TouchError
from app.tracking.cameras.settings import CameraSettings

START: Final = 60.0
"""A first start compiles kernels [s]."""
SETTLE: Final = 2.0
"""The simulated hand needs this long to a point [s]."""
_LOOK: Final = 0.02


@dataclass
class DailyCheck:
    """Robot and cameras, opened for the check.

    Args:
        port: serial port of a real robot; None simulates one.
        cameras: real ones; None simulates them.
        exercise: names device and camera rig.
    """

    port: str | None = None
    cameras: CameraSettings | None = None
    exercise: str = "first-insertion"
    _rig: Rig | None = None
    _folder: TemporaryDirectory[str] | None = None
    _touch: TouchFacts | None = None
    _failure: str = field(default="")

    def open(self) -> None:
        """Start everything and wait for the first tick and the first fix.

        Raises:
            AcusError: if the robot does not answer or a camera cannot be opened.
        """
        exercise = in_layers(load_exercise(self.exercise))
        placed = placed_plan_of(exercise, device_of(exercise))
        self._folder = TemporaryDirectory()
        setup = TrainerSetup(
            exercise, placed, sessions=Path(self._folder.name), port=self.port, cameras=self.cameras
        )
        self._rig = rig = build_rig(setup)
        rig.trainer.open()
        self._live(
            START,
            until=lambda: rig.loop.latest().tick > 0 and rig.tracker.latest.read() is not None,
        )

    def close(self) -> None:
        """End everything at zero force; idempotent."""
        rig, self._rig = self._rig, None
        if rig is not None:
            rig.close()
        folder, self._folder = self._folder, None
        if folder is not None:
            folder.cleanup()

    @property
    def simulated(self) -> bool:
        """Return whether the robot is."""
        return self._running.robot is None

    @property
    def calibration(self) -> str:
        """Id of the cameras' calibration; empty for cameras by their profile."""
        calibration = self._running.stereo.rig.calibration
        return calibration.id if calibration is not None else ""

    @property
    def device(self) -> str:
        """Name of the device profile."""
        return self._running.profile.name

    def facts(self) -> DailyFacts:
        """Everything now."""
        rig = self._running
        rig.trainer.heartbeat()
        snapshot, robot = rig.trainer.snapshot(), rig.robot
        facts = robot_facts(
            snapshot,
            robot.link.info() if robot is not None else None,
            robot.clearance() if robot is not None else None,
            robot.readiness if robot is not None else None,
        )
        seen = rig.tracker.inspect(lines=False)
        return daily_facts(snapshot, seen, facts, self._touch, self._failure)

    def move_to(self, point: FloatArray) -> None:
        """Let the simulated hand bring the tip to a point of the world [m], shape (3,)."""
        rig = self._running
        way = point - rig.profile.fulcrum
        x, y, _ = unit(way).tolist()
        rig.trainer.hand(x, y, float(np.linalg.norm(way)))
        self._live(SETTLE)

    def touch(self, name: str, point: FloatArray) -> None:
        """Average the tip for a second and compare it with a known point [m], shape (3,)."""
        rig, collector = self._running, TouchCollector()
        self._failure = ""

        def full() -> bool:
            stamped = rig.tracker.latest.read()
            if stamped is not None:
                collector.add(stamped.value)
            return collector.share >= 1.0

        self._live(4.0 * collector.duration, until=full)
        try:
            self._touch = touch_facts(name, point, collector.touch())
        except TouchError as error:
            self._touch, self._failure = None, str(error)

    @property
    def _running(self) -> Rig:
        if self._rig is None:
            raise TouchError(sentence("the check is not open: call open() first"))
        return self._rig

    def _live(self, seconds: float, until: Callable[[], bool] = lambda: False) -> None:
        rig = self._running
        clock = rig.setup.clock
        end = clock.now() + seconds
        while clock.now() < end and not until():
            rig.trainer.heartbeat()
            clock.sleep(_LOOK)


def known_point(plate: FiducialPlate, name: str) -> tuple[str, FloatArray]:
    """Name and place in world [m] of a plate's fiducial; of the last one without a name.

    Raises:
        RegistrationError: if the plate has no known place, or no such fiducial.
    """
    if plate.place is None:
        raise RegistrationError(
            sentence(
                "plate {plate_name} has no known place in the robot's frame; give `place` in its "
                "file",
                plate_name=plate.name,
            )
        )
    chosen = name or plate.names[-1]
    row = plate.rows((chosen,))[0]
    return f"{plate.name} {chosen}", plate.place.transform @ plate.touch[row]
