"""A needle without a robot: a pen with printed markers, one webcam, the same loop and exercises.

The loop turns as ever; joint angles come from the pen's direction, as a robot holding its needle
that way would have them. There is no force: laws, transmission and safety are not in its table,
and the scene compiler drops what only a hand could feel. A simulated pen is held by the simulated
hand: the plant moves, the webcam's pictures are drawn of it, and the angles come from them alone.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Final

from app.compose.declared_views import declared_views
from app.compose.live_pen import attached_camera, simulated_lens, simulated_webcam
from app.compose.needle import UPRIGHT, row_at
from app.compose.trainee import trainee_of
from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import Clock, SystemClock
from app.core.messages import sentence
from app.core.parameters import Stage
from app.device.control import Loop, Table
from app.device.control.depth_interval import DepthInterval
from app.device.control.kinematics import Kinematics
from app.device.control.velocity import velocity_stage
from app.device.links.pen import PenLink
from app.exercises.scene import compile_exercise
from app.exercises.schema import Exercise
from app.mechanisms.errors import MechanismError
from app.mechanisms.profile import DeviceProfile, load_profile
from app.planning.placement import PlacedPlan
from app.session.conditions import TRAINEE
from app.simulation.plant import initial_plant, plant_stage
from app.tracking.calibration.pictures import list_pictures
from app.tracking.cameras.camera import Camera, CameraFrame
from app.tracking.cameras.files import read_picture
from app.tracking.cameras.source import SourceKind, parse_source
from app.tracking.pen.body import PenProfile
from app.tracking.pen.calibrating import WANTED, PenCalibration, PoseCollector
from app.tracking.pen.errors import PenError
from app.tracking.pen.needle import PenTip
from app.tracking.pen.settings import PenSettings, load_settings, with_source
from app.tracking.pen.step import PenObservation, PenStep
from app.tracking.pen.tracker import PenTracker
from app.tracking.pen.webcam import Webcam
from app.tracking.simulated.pen_scene import PenScene, PenSceneAt, body_pose


def calibrate_pen(
    settings: PenSettings,
    seconds: float,
    tell: Callable[[str], None],
    clock: Clock | None = None,
) -> PenCalibration:
    """Look at the pen until its tip is known, or the time is over.

    Args:
        settings: webcam and pen.
        seconds: at most.
        tell: takes a line now and then: how far it is, or why a picture is of no use.
        clock: for the time.

    Raises:
        PenError: if the pictures do not tell the tip; says what to do.
        CameraError: if the webcam cannot be used.
    """
    if settings.simulated:
        raise PenError(sentence("a simulated pen has no tip to measure; give --source usb:0"))
    pen, collector = settings.profile(), PoseCollector()
    _collect(settings, collector, seconds, tell, clock)
    return collector.finish(pen)


def measure_shaft(
    settings: PenSettings,
    result: PenCalibration,
    seconds: float,
    tell: Callable[[str], None],
    clock: Clock | None = None,
) -> PenCalibration:
    """Look at the pen being rolled about itself; return the calibration with the shaft measured.

    Args:
        settings: source of these pictures, and pen.
        result: tip, as rocking gave it.
        seconds: at most.
        tell: takes a line now and then.
        clock: for the time.

    Raises:
        PenError: if the pictures do not tell the shaft; says what to do.
        CameraError: if the webcam cannot be used.
    """
    collector = PoseCollector()
    _collect(settings, collector, seconds, tell, clock)
    return collector.finish_rolling(result)


def _collect(
    settings: PenSettings,
    collector: PoseCollector,
    seconds: float,
    tell: Callable[[str], None],
    clock: Clock | None,
) -> None:
    time, said = clock or SystemClock(), ""
    fulcrum = load_profile("icube").fulcrum
    step = PenStep(settings.profile(), settings.webcam(), fulcrum)
    for frame in _frames(settings, seconds, time):
        seen = step.observe(frame)
        kept = collector.add(seen)
        line = seen.fix.reason or f"{len(collector.poses)} of {WANTED} poses"
        if line != said and (not kept or len(collector.poses) % 10 == 0):
            said = line
            tell(line)
        if len(collector.poses) >= WANTED:
            break
    if step.webcam is not None and step.webcam.guessed:
        tell(step.webcam.words)


def _frames(settings: PenSettings, seconds: float, time: Clock) -> Iterator[CameraFrame]:
    """Pictures of a webcam until the time is over, or all of a folder, once, in their order."""
    source = parse_source(settings.source)
    if source.kind is SourceKind.FOLDER:
        for number, path in enumerate(list_pictures(Path(source.place))):
            yield CameraFrame(read_picture(path), number / settings.rate_hz)
        return
    camera = attached_camera(settings, time)
    camera.open()
    try:
        end = time.now() + seconds
        while time.now() < end:
            yield camera.read()
    finally:
        camera.close()


START_DEPTH: Final = -0.015
"""Where the needle of a simulated hand waits [m]."""


def without_force(profile: DeviceProfile) -> DeviceProfile:
    """Return the geometry of a device that pushes nobody."""
    return profile.model_copy(update={"loop": profile.loop.model_copy(update={"renders": ()})})


def joint_angles(profile: DeviceProfile, axis: FloatArray) -> FloatArray | None:
    """Joint angles [rad], shape (2,), of a robot whose needle points along `axis` (unit vector).

    None where no robot could: a needle that does not point down, or out of reach.
    """
    if not axis[2] < -0.1:
        return None
    try:
        return profile.machine.usable(axis)
    except MechanismError:
        return None


def pen_table(
    exercise: Exercise,
    placed: PlacedPlan,
    profile: DeviceProfile,
    read: list[Stage],
    skill: str | None,
    seed: int,
    simulated: bool,
) -> Table:
    """Table of a tick without force.

    Args:
        exercise: whose effects are computed; its force laws are not.
        placed: the plan.
        profile: geometry that renders nothing.
        read: stages that give the joint angles; none in a replay, which is given them.
        skill: of the scripted trainee; None without one.
        seed: of the trainee.
        simulated: whether a simulated hand holds the pen.
    """
    placed_exercise = exercise.placed_as(placed.placement)
    effects = compile_exercise(placed_exercise, profile, declared_views(), simulated=False)
    plant = [plant_stage(profile, UPRIGHT, START_DEPTH)] if simulated else []
    trainee = []
    if simulated and skill:
        trainee = [trainee_of(exercise, placed, skill, seed)]
    pose = profile.machine.stages().pose
    place = [DepthInterval.of(profile).stage(), pose, Kinematics.of(profile).stage()]
    stages = [*trainee, *read, velocity_stage(profile), *place]
    return Table.of([*stages, *effects.stages()], plant)


_ROLL: Final = 1.0
"""Turn of the simulated pen about its shaft [rad]: two sides and the top show."""


def pen_settings(source: str) -> PenSettings:
    """Return what is remembered of pen and webcam, with another source of pictures.

    Raises:
        CameraError: if the source cannot be read.
        ConfigurationError: if the settings file cannot be used.
    """
    return with_source(load_settings(), source)


@dataclass(frozen=True, slots=True, eq=False)
class Pen:
    """The pen of a rig: what moves the loop.

    Attributes:
        settings: webcam and pen.
        profile: geometry, without force.
        link: joint angles for the loop.
    """

    settings: PenSettings
    profile: DeviceProfile
    link: PenLink
    noun: ClassVar[str] = "a pen"

    @property
    def simulated(self) -> bool:
        """Return whether a simulated hand holds it."""
        return self.settings.simulated

    @classmethod
    def of(cls, settings: PenSettings, profile: DeviceProfile) -> Pen:
        """Build it; nothing is opened."""
        bare = without_force(profile)
        upright = initial_plant(bare, UPRIGHT, START_DEPTH)
        return cls(settings, bare, PenLink((upright["plant_q_left"], upright["plant_q_right"])))

    def take(self, observation: PenObservation) -> None:
        """Move the loop to where the pen points; a direction that no robot has is passed over."""
        needle = observation.needle
        q = joint_angles(self.profile, needle.axis) if needle is not None else None
        if q is not None:
            self.link.write(q, observation.fix.time)

    def table(self, exercise: Exercise, placed: PlacedPlan, skill: str | None, seed: int) -> Table:
        """Table of a tick: trainee, pen, velocity, kinematics, effects, simulated hand."""
        read = [self.link.stage()]
        return pen_table(exercise, placed, self.profile, read, skill, seed, self.settings.simulated)

    def camera(self, loop: Loop, clock: Clock, seed: int) -> Camera:
        """Return the webcam, not open yet.

        Raises:
            CameraError: if its source cannot be used.
        """
        if self.settings.simulated:
            return simulated_webcam(self.settings, self.scene(loop), self.profile, clock, seed)
        return attached_camera(self.settings, clock)

    def webcam(self) -> Webcam | None:
        """Return its lens; None if it has to be guessed.

        Raises:
            ConfigurationError: if the calibration's file cannot be used.
        """
        return simulated_lens() if self.settings.simulated else self.settings.webcam()

    def scene(self, loop: Loop) -> PenSceneAt:
        """Return what a simulated webcam sees: the pen in the simulated hand."""
        machine, tip = self.profile.machine, PenTip.of(self.settings.profile().tip)

        def scene(time: float) -> PenScene:
            row = row_at(loop, time)
            depth = float(row[sv.PLANT_DEPTH])
            axis = machine.axis(row[sv.PLANT_Q])
            p_tip = machine.centre + depth * axis
            return PenScene(body_pose(p_tip, axis, tip.p_tip, tip.axis, _ROLL), p_tip)

        return scene

    def tracker(self, loop: Loop, clock: Clock, seed: int) -> PenTracker:
        """Build the tracker that moves the loop; `on_fix` is left to whoever listens."""
        return PenTracker(
            self.camera(loop, clock, seed),
            self.settings.profile(),
            clock,
            self.profile.fulcrum,
            self.webcam(),
            on_needle=self.take,
        )

    def documents(self) -> dict[str, PenProfile]:
        """Return what a record has attached beside exercise and device: the pen."""
        return {"pen": self.settings.profile()}

    def metadata(self, skill: str | None) -> dict[str, dict[str, str]]:
        """Facts for the head of a record; `skill` of the scripted trainee, None without one."""
        kind, pen = self.settings.source.partition(":")[0], self.settings.profile()
        simulated = "yes" if self.settings.simulated else "no"
        webcam = self.webcam()
        hand = {} if self.settings.simulated else {"hand": "pen"}
        lens = "guessed" if webcam is None or webcam.guessed else "calibrated"
        return {
            # What the loop reads is given, never computed: to a replay this is no simulated robot.
            "device": {"name": "pen", "simulated": "no", "pen": simulated},
            "cameras": {
                "name": "webcam",
                "simulated": simulated,
                "source": kind,
                "lens": lens,
                "pen": pen.name,
                "tip": "measured" if pen.tip.calibrated else "drawn",
            },
            TRAINEE: {"scripted": skill or ""} | hand,
        }
