"""What the window asks for; light, so that the window comes first."""

from __future__ import annotations

import contextlib
import shutil
from dataclasses import replace
from pathlib import Path
from secrets import randbits
from typing import TYPE_CHECKING, Any, Final

from app.compose.first_start import TrackerKernels
from app.core import paths
from app.core.clock import SystemClock
from app.core.loading import load_modules, turn
from app.core.messages import sentence
from app.core.paced_clock import PacedClock
from app.core.progress import Progress, elapsed_share, moving
from app.device.errors import LoopError
from app.exercises.library import library
from app.exercises.portrait import Portrait, find_portrait
from app.exercises.schema import Exercise
from app.imaging.volume import Volume
from app.planning.placement import PlacedPlan

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from app.compose.camera_check import Aim
    from app.compose.live_cameras import LiveReader
    from app.compose.trainer import Rig
    from app.compose.watchers import RunWatcher
    from app.core.arrays import FloatArray
    from app.device.commissioning.bench import Bench
    from app.imaging.field import TissueField
    from app.mechanisms.profile import DeviceProfile
    from app.session.scripted_answers import Pictures
    from app.tracking.cameras.settings import CameraSettings
    from app.tracking.inspection import Inspection
    from app.tracking.needle_tracker import StereoAbilities
    from app.views.cameras.live import ShownCamera
    from app.views.exercise.run import ExerciseRun
    from app.views.shell.services import RobotPort, RunSetup


HEAVY_MODULES: Final = (
    "app.imaging.reading",
    "app.imaging.body",
    "app.imaging.phantom",
    "app.core.compiled",
    "app.mechanisms.pantograph.machine",
    "app.device.control.loop",
    "app.simulation.plan",
    "app.tracking.simulated.cameras",
    "app.tracking.tracker",
    "app.compose.trainer",
    "app.views.scene.surfaces",
    "app.views.scene.stage",
)
"""What no start page needs and every exercise does, in the order in which an exercise needs it."""

DEMONSTRATOR: Final = "expert"
"""Skill of the scripted hand that shows an exercise."""

_PATIENCE: Final = 120.0
_LOOK: Final = 0.02
_LONG: Final = 2.0  # what lasts longer [s] says for how long already


def unusable_files() -> tuple[str, ...]:
    """Return why files of others cannot be used, one text each, without those of whole folders."""
    from app.compose.plugins import refused_files

    return tuple(file.refused for file in refused_files() if file.kind != "folder")


class Desktop:
    """What the window asks for (`views.services.Services`).

    Args:
        skill: a scripted trainee inserts the needle instead of the mouse; None for the mouse.
        seed: of everything random; None takes each exercise's own.
        sessions: folder of the records.
        besides: exercises of other files; each stands for one of its name in the library.
        led: whether a program leads the hand in every run, which time waits for.
        watchers: are told of every run (`compose.watchers`).
    """

    def __init__(
        self,
        skill: str | None = None,
        seed: int | None = None,
        sessions: Path | None = None,
        besides: tuple[Exercise, ...] = (),
        led: bool = False,
        watchers: tuple[RunWatcher, ...] = (),
    ) -> None:
        self.watchers = watchers
        self._skill, self._seed, self._besides = skill, seed, besides
        self._led = led
        self._sessions = sessions or paths.sessions()
        self._kernels = TrackerKernels()

    def exercises(self) -> tuple[Exercise, ...]:
        """Exercises to choose from, easiest first."""
        found = {one.id: one for one in (*library(), *self._besides)}
        return tuple(sorted(found.values(), key=lambda one: one.level))

    def check_exercise(
        self, exercise: Exercise
    ) -> tuple[Mapping[str, str], tuple[tuple[str, str], ...]]:
        """Say why each effect is simulated or not, and what cannot be used; quick."""
        from app.compose.explaining import quick_explanation

        return quick_explanation(exercise)

    def explain_exercise(self, exercise: Exercise) -> dict[str, Any]:
        """Return what `acus explain --json` prints; called beside the window."""
        with turn(Progress()):  # kernels: behind the window, not before it
            from app.compose.explaining import explanation
        return explanation(exercise)

    def sessions(self) -> Path:
        """Folder of the recorded attempts."""
        return self._sessions

    def portrait(
        self, exercise: Exercise, volume: Volume | None, progress: Progress
    ) -> Portrait | None:
        """Return a picture of an exercise's patient; called beside the window, may take seconds."""
        return find_portrait(exercise, volume, progress)

    def prepare(self, progress: Progress) -> tuple[str, ...]:
        """Load what an exercise needs; called beside the window as soon as it is painted.

        Returns why files of the user's own (laws, effects, metrics, …) cannot be used, one line
        each; of whole folders the window knows by itself, before.
        """
        from app.core.temporary import sweep_temporary
        from app.imaging.errors import WorkerError, WorkerLostError
        from app.imaging.worker.pool import shared_worker

        sweep_temporary()
        with contextlib.suppress(WorkerError):  # said by the first folder that is opened
            shared_worker().warm()
        self._kernels.start()
        load_modules(HEAVY_MODULES, progress.part(0.0, 0.5))
        from app.imaging.worker.service import load_decoders

        with contextlib.suppress(WorkerError, WorkerLostError):
            load_decoders(Progress())  # a moment, of which nobody need be told
            shared_worker().warm(2)  # a folder is read by both
        self._kernels.load(progress.part(0.5, 1.0))
        return unusable_files()

    def robots(self) -> tuple[RobotPort, ...]:
        """Ports at which a robot may be plugged in now."""
        from app.compose.robot import robot_ports

        return robot_ports()

    def served_robots(self) -> tuple[RobotPort, ...]:
        """Robots behind a service of this computer; called beside the window."""
        from app.compose.robot import served_robots

        return served_robots()

    def open_robot(self, port: str, profile: DeviceProfile, progress: Progress) -> Bench:
        """Open a robot for commissioning; called beside the window, may take seconds."""
        from app.compose.robot import open_bench

        return open_bench(port, profile, progress)

    def camera_sources(self) -> tuple[RobotPort, ...]:
        """Cameras that are plugged in now."""
        from app.tracking.cameras.ports import camera_ports
        from app.views.shell.services import RobotPort

        return tuple(
            RobotPort(f"usb:{port.port}", f"{port.title} (usb:{port.port})")
            for port in camera_ports()
        )

    def open_camera(self, settings: CameraSettings, side: str, progress: Progress) -> LiveReader:
        """Open one camera; called beside the window, may take seconds."""
        with turn(progress):
            from app.compose.live_cameras import open_live
        progress.report(0.5, sentence("asking the camera for its first picture"))
        return open_live(settings, side)

    def aim(self, settings: CameraSettings, device: str, progress: Progress) -> Aim:
        """Return what the cameras see of the needle's cone; called beside the window."""
        with turn(progress):  # kernels of the distortion
            from app.compose.camera_check import aim_of
        progress.report(0.5, sentence("computing what the cameras see of the needle's cone"))
        return aim_of(settings, device)

    def open_source(self, name: str, settings: object, progress: Progress) -> ShownCamera:
        """Open what the page of a needle source looks at; called beside the window."""
        with turn(progress):
            from app.compose.needle_sources import open_preview
        progress.report(0.5, sentence("asking the webcam for its first picture"))
        preview: ShownCamera = open_preview(name, settings)
        return preview

    def open_run(self, setup: RunSetup, progress: Progress) -> DesktopRun:
        """Build and start a trainer; called beside the window, may take seconds."""
        with turn(progress):  # kernels and OpenCV: behind the window, not before it
            from app.compose.exercise_ct import load_field, load_risks
            from app.compose.exercise_field import resolve_tissue
            from app.compose.needle_sources import named, needle_source
            from app.compose.trainer import TrainerSetup, build_rig
            from app.core.temporary import temporary_folder
            from app.exercises.tissue import with_tissue
            from app.session.motion import ShownMotion
        self._kernels.wait(progress)
        risks = load_risks(setup.exercise, setup.volume, progress.part(0.0, 0.1))
        plan = setup.placed.plan
        tissues = load_field(setup.exercise, setup.volume, plan, progress.part(0.1, 0.6))
        exercise = with_tissue(setup.exercise, setup.volume, plan)
        exercise, _ = resolve_tissue(exercise, setup.placed, tissues)
        seed = setup.exercise.seed if self._seed is None else self._seed
        ct = setup.ct
        if setup.volume is not None:  # by it the debrief knows the CT again
            ct = replace(ct, digest=setup.volume.digest)
        shows = setup.demonstrates
        skill = DEMONSTRATOR if shows else self._skill
        kept = temporary_folder("demonstration") if shows else self._sessions
        shown = ShownMotion.kept(exercise.id, exercise.version) if shows else None
        # Where all is simulated a busy computer slows the world, not only its hand.
        simulated = setup.cameras is None or setup.cameras.simulated
        paced = simulated and not setup.robot.port and not setup.robot.pen
        trainer = TrainerSetup(
            exercise,
            setup.placed,
            ct,
            skill,
            seed,
            kept,
            PacedClock() if paced else SystemClock(),
            held_arming=setup.robot.held_arming and skill is None,
            port=setup.robot.port or None,
            cameras=setup.cameras,
            source=needle_source(*named(setup.robot.pen)) if setup.robot.pen else None,
            risks=risks,
            tissues=tissues,
            # Each start is another one; who asks for a seed has the same again.
            hand_seed=randbits(32) if self._seed is None else None,
            script=None if shown is None else shown.script(setup.placed),
            led=self._led,
            pictures=_pictures(exercise, setup.volume, tissues) if skill is not None else None,
        )
        with moving(progress.part(0.6, 0.8), _compiling):
            rig = build_rig(trainer)
        try:
            rig.trainer.open()
            _wait_until_alive(rig, progress)
        except BaseException:
            rig.close()
            raise
        run = DesktopRun(rig, kept if shows else None, self.watchers)
        for watcher in self.watchers:
            watcher.began(run, setup.volume)
        return run


def _pictures(
    exercise: Exercise, volume: Volume | None, tissues: TissueField | None
) -> Pictures | None:
    """Return what makes the control scans that a scripted hand answers complications by."""
    asked = exercise.procedure
    if volume is None or asked is None or asked.complications is None:
        return None
    return lambda scan: scan.picture(volume, tissues)


def _compiling(waited: float) -> str:
    """Say that the loop is compiled, and for how long already [s]."""
    if waited < _LONG:
        return sentence("compiling the loop")
    return sentence("compiling the loop: {waited:.0f} s", waited=waited)


def _wait_until_alive(rig: Rig, progress: Progress) -> None:
    """Wait for the first tick and the first picture: on a first start kernels are compiled there.

    A tracker without a picture is no reason not to begin; the status strip says what it lacks.
    """
    clock = SystemClock()  # another's time may stand until the loop ticks
    begin = clock.now()
    while (waited := clock.now() - begin) < _PATIENCE:
        said = sentence("waiting for the first picture")
        if waited >= _LONG:
            said = sentence("waiting for the first picture: {waited:.0f} s", waited=waited)
        progress.report(0.8 + 0.2 * elapsed_share(waited), said)
        rig.trainer.heartbeat()
        if rig.loop.latest().tick > 0 and rig.tracker.latest.read() is not None:
            return
        clock.sleep(_LOOK)
    if rig.loop.latest().tick == 0:
        raise LoopError(
            sentence(
                "the control loop has not ticked in {waited:.0f} s; start it again", waited=waited
            )
        )


def _learner(
    stereo: StereoAbilities | None, cameras: CameraSettings | None
) -> Callable[[str, FloatArray], None] | None:
    """Learn the marker's colour from a click, for the next start too."""
    from app.tracking.cameras.settings import keep_colour

    if stereo is None:
        return None

    def learn(camera: str, pixel: FloatArray) -> None:
        colour = stereo.learn_colour(camera, pixel)
        if cameras is not None:
            keep_colour(cameras, colour)

    return learn


class DesktopRun:
    """A trainer that runs for the window (`views.services.OpenRun`).

    Args:
        rig: what was built.
        passing: folder of records that go with the run: of a demonstration; None keeps them.
        watchers: are told when it ends.
    """

    def __init__(
        self, rig: Rig, passing: Path | None = None, watchers: tuple[RunWatcher, ...] = ()
    ) -> None:
        self._rig, self._passing, self._watchers = rig, passing, watchers

    @property
    def rig(self) -> Rig:
        """Return the trainer and its parts: others after each change of the plan."""
        return self._rig

    @property
    def run(self) -> ExerciseRun:
        """Return what its views need, as the robot's board says it now: it may have come back
        anew.
        """
        from app.session.pad.view import (  # Qt only for who has a window
            depth_tolerance_of,
            rings_of,
        )
        from app.session.shown_views import Shown
        from app.views.exercise.run import ExerciseRun

        setup, robot, tracker = self._rig.setup, self._rig.robot, self._rig.tracker
        source = self._rig.source
        return ExerciseRun(
            self._rig.trainer,
            setup.placed,
            self._rig.profile,
            interactive=setup.skill is None and (source is None or source.simulated),
            rings=rings_of(setup.exercise),
            depth_tolerance=depth_tolerance_of(setup.exercise),
            touches=setup.exercise.touch is not None,
            breathes="breathing" in setup.exercise.effects and source is None,
            inspect=self._inspect,
            touched=None if tracker.stereo is None else tracker.stereo.touched,
            learn_colour=_learner(tracker.stereo, setup.cameras),
            board=None if robot is None else robot.link.info(),
            port=setup.port or "",
            clearance=None if robot is None else robot.clearance(),
            readiness=None if robot is None else robot.readiness,
            velocity=self._rig.profile.velocity.value,
            forceful=source is None,
            held_arming=self._rig.trainer.held_arming,
            guidance=setup.exercise.guidance,
            shown=Shown.of_exercise(setup.exercise),
            demonstrates=self._passing is not None,
            resting=self._rig.trainer.resting,
        )

    def _inspect(self, masks: bool, lines: bool) -> Inspection:
        """Return the newest pictures; whoever looks at them keeps the cameras going."""
        self._rig.trainer.resting.want()
        return self._rig.tracker.inspect(masks, lines)

    @property
    def exercise(self) -> Exercise:
        """The exercise as it is computed now."""
        return self._rig.setup.exercise

    def compute_by(self, effect: str, model: str) -> Exercise:
        """Compute an effect by another of its models from the next tick on."""
        self._rig = self._rig.compute_by(effect, model)
        return self.exercise

    def place(self, placed: PlacedPlan) -> ExerciseRun:
        """Take another plan and return the run with it."""
        self._rig = self._rig.place(placed)
        return self.run

    def close(self) -> None:
        """End everything at zero force; idempotent."""
        for watcher in self._watchers:
            watcher.ended(self)
        self._rig.close()
        if self._passing is not None:
            shutil.rmtree(self._passing, ignore_errors=True)
