"""What the window asks of the rest of the program; `compose` hands it in."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from app.core.progress import Progress
from app.exercises.parts import LayersFrom
from app.exercises.portrait import Portrait
from app.exercises.schema import Exercise
from app.imaging.volume import Volume
from app.mechanisms.profile import DeviceProfile
from app.planning.placement import PlacedPlan
from app.session.ct_facts import UNKNOWN_CT, CtFacts
from app.tracking.cameras.settings import CameraSettings
from app.views.cameras.live import AimPort, LiveCamera, ShownCamera
from app.views.exercise.run import ExerciseRun

if TYPE_CHECKING:
    from app.device.commissioning.bench import Bench


@dataclass(frozen=True, slots=True)
class RobotChoice:
    """Which robot a run is on.

    Attributes:
        port: where it is plugged in; empty for the simulated one.
        held_arming: whether the simulated robot too gives force only while a key is held; a real
            one always does.
        pen: source of the webcam's pictures where a pen with printed markers is used in place of
            robot and cameras; empty without a pen.
    """

    port: str = ""
    held_arming: bool = False
    pen: str = ""


@dataclass(frozen=True, slots=True)
class RobotPort:
    """A port at which there may be a robot.

    Attributes:
        port: its name, as the system calls it.
        title: what is known of it, for people.
    """

    port: str
    title: str


_ABOUT_MM = 50.0  # entries of one run whose tissue field is one


@dataclass(frozen=True, slots=True, eq=False)
class RunSetup:
    """What a run is made of.

    Attributes:
        exercise: effects, device, cameras, tolerances.
        placed: the plan in the robot's frame.
        ct: the CT, for the record.
        robot: which robot.
        cameras: real ones; None for simulated ones.
        volume: the CT itself, for the exercise's structures.
        demonstrates: whether a scripted expert shows the exercise: nothing is kept of it.
    """

    exercise: Exercise
    placed: PlacedPlan
    ct: CtFacts = UNKNOWN_CT
    robot: RobotChoice = RobotChoice()
    cameras: CameraSettings | None = None
    volume: Volume | None = None
    demonstrates: bool = False

    def same_run(self, other: RunSetup) -> bool:
        """Return whether a run of the other setup only has to take this plan."""
        return self._fixed() == other._fixed()

    def _fixed(self) -> tuple[object, ...]:
        # A run has the tissue of its path, if the exercise takes it from the CT.
        plan = self.placed.plan if self.exercise.layers_from is LayersFrom.CT else None
        path = None if plan is None else (*plan.entry_mm, *plan.target_mm)
        # A run has the tissue field about its entry, if it looks into it.
        entry = self.placed.plan.entry_mm if self.exercise.needs_field else None
        about = None if entry is None else tuple(round(float(one) / _ABOUT_MM) for one in entry)
        return self.exercise, self.ct, self.robot, self.cameras, self.demonstrates, path, about


class OpenRun(Protocol):
    """A trainer that runs."""

    @property
    def run(self) -> ExerciseRun:
        """Return what its views need."""
        ...

    def compute_by(self, effect: str, model: str) -> Exercise:
        """Compute an effect by another of its models from the next tick on, in an attempt too.

        Returns:
            The exercise as it is computed now.

        Raises:
            AcusError: if the exercise keeps its models, or there is no such effect or model.
        """
        ...

    @property
    def exercise(self) -> Exercise:
        """The exercise as it is computed now."""
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
    """What `compose` gives the window.

    Attributes:
        watchers: what is told of every run besides the window, such as live links.
    """

    watchers: tuple[Any, ...]

    def exercises(self) -> tuple[Exercise, ...]:
        """Exercises to choose from, easiest first."""
        ...

    def check_exercise(
        self, exercise: Exercise
    ) -> tuple[Mapping[str, str], tuple[tuple[str, str], ...]]:
        """Say why each effect is simulated or not, and what cannot be used; quick.

        Returns:
            Effect -> why; pairs of a field and what is wrong with it.
        """
        ...

    def explain_exercise(self, exercise: Exercise) -> dict[str, Any]:
        """Return what `acus explain --json` prints, costs included; called beside the window.

        Raises:
            AcusError: if the exercise names what there is not.
        """
        ...

    def sessions(self) -> Path:
        """Folder of the recorded attempts."""
        ...

    def portrait(
        self, exercise: Exercise, volume: Volume | None, progress: Progress
    ) -> Portrait | None:
        """Return a picture of an exercise's patient; called beside the window, may take seconds.

        Args:
            exercise: whose patient.
            volume: his CT, where it is open; else what is kept, or his CT is read.
            progress: may cancel.

        Returns:
            None where the patient's CT cannot be read.
        """
        ...

    def prepare(self, progress: Progress) -> tuple[str, ...]:
        """Load what an exercise needs; called beside the window once it is painted.

        Returns what cannot be used of the user's own files, one line each.

        Raises:
            ImportError: if a part of the program cannot be loaded; says which.
            Cancelled: if `progress` was cancelled.
        """
        ...

    def robots(self) -> tuple[RobotPort, ...]:
        """Ports at which a robot may be plugged in now; quick, opens none."""
        ...

    def served_robots(self) -> tuple[RobotPort, ...]:
        """Robots that a service of this computer answers for; called beside the window."""
        ...

    def open_robot(self, port: str, profile: DeviceProfile, progress: Progress) -> Bench:
        """Open a robot for commissioning; called beside the window, may take seconds.

        Args:
            port: where it is plugged in.
            profile: of the device that it should be.
            progress: told what is being done.

        Raises:
            AcusError: if nobody answers, somebody else does, or another program has it.
            Cancelled: if `progress` was cancelled.
        """
        ...

    def camera_sources(self) -> tuple[RobotPort, ...]:
        """Cameras that are plugged in now, `port` being the source; quick, opens none."""
        ...

    def open_camera(self, settings: CameraSettings, side: str, progress: Progress) -> LiveCamera:
        """Open one camera, `left` or `right`; called beside the window, may take seconds.

        Raises:
            AcusError: if it is simulated, cannot be opened, or delivers no picture.
        """
        ...

    def aim(self, settings: CameraSettings, device: str, progress: Progress) -> AimPort:
        """Return what the cameras see of the needle's cone; called beside the window.

        Raises:
            AcusError: if the calibration is of other cameras or another size.
        """
        ...

    def open_source(self, name: str, settings: object, progress: Progress) -> ShownCamera:
        """Open what the page of a needle source looks at; called beside the window, may take
        seconds.

        Args:
            name: of the source (`compose.needle_sources`).
            settings: as its page has them.
            progress: told what is being done.

        Raises:
            AcusError: if there is no such source, or it cannot be opened.
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
