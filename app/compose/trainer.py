"""Builds a running trainer from a configuration: the only file that names concrete drivers."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Final

from app.compose import effect_models
from app.compose.cameras import AttachedCameras, real_cameras, simulated_on
from app.compose.declared_views import declared_views
from app.compose.exercise_field import with_field
from app.compose.hub_tracker import CURSOR, HubTracker
from app.compose.needle import UPRIGHT, felt_force, measured_axis, needle_scene
from app.compose.needle_sources import NeedleSource
from app.compose.robot import Robot, connect
from app.compose.run_context import agreement_of, run_context, with_exercise
from app.compose.trainee import trainee_of
from app.core import paths
from app.core.arrays import FloatArray
from app.core.clock import Clock, SystemClock
from app.core.messages import sentence
from app.core.paced_clock import PacedClock
from app.core.parameters import Stage
from app.device.control import Loop, Table, laws, machine_stages
from app.device.links.link import Link
from app.device.links.simulated import simulated_link
from app.exercises.ablation import check_electrodes
from app.exercises.errors import ExerciseError
from app.exercises.parts import TissueSource
from app.exercises.scene import compile_exercise, device_of, law_requests
from app.exercises.schema import Exercise
from app.exercises.touching import check_touch
from app.imaging.field import TissueField
from app.mechanisms.hand_motion import hand_stage
from app.mechanisms.profile import DeviceProfile
from app.planning.placement import PlacedPlan
from app.session.beginnings import Beginnings
from app.session.conditions import TRAINEE
from app.session.context import RunContext
from app.session.ct_facts import UNKNOWN_CT, CtFacts
from app.session.fixes import DepthTrust
from app.session.risks import Risk
from app.session.scripted_answers import Pictures
from app.session.trainer import Trainer
from app.session.withdrawal import Start
from app.simulation.plant import initial_plant, plant_stage
from app.simulation.trainee import TraineeScript, script_stage
from app.simulation.unsteady import hand_unsteady_by_level
from app.tracking.cameras.settings import CameraSettings
from app.tracking.errors import TrackingError
from app.tracking.motion.depth_filter import FASTEST
from app.tracking.needle_tracker import NeedleTracker, StereoAbilities
from app.tracking.optics.rig import RigProfile, load_rig
from app.tracking.simulated.paced import PacedFixes
from app.tracking.tracker import Tracker

if TYPE_CHECKING:
    from app.simulation.bound_field import BoundField


START_DEPTH: Final = -0.015
"""Where the needle waits: tip 15 mm above the skin [m]."""


@dataclass(frozen=True, slots=True)
class TrainerSetup:
    """What a trainer is built from.

    Attributes:
        exercise: effects, device, cameras, tolerances.
        placed: the plan in the robot's frame.
        ct: the CT, for the record.
        skill: `novice` or `expert` lets a scripted trainee insert the needle; None leaves it to
            the mouse.
        script: what the scripted trainee does, in place of what his skill would; None for that.
        seed: of everything random in the run.
        sessions: folder of the records.
        clock: monotonic clock; a virtual one for runs faster than real time; a paced one where
            robot, cameras and hand are simulated, so that a slow computer slows all of it.
        held_arming: whether the forces are on only while a key or pedal is held; on a real robot
            they always are.
        port: serial port of a real robot; None simulates one.
        cameras: real ones; None simulates those of the exercise's rig.
        source: builds, of the exercise's device, what is in place of robot and cameras; no force
            then. None for a robot.
        risks: structures that the needle has to keep away from.
        tissues: field of the patient: tells what the needle met, and is what the loop looks into
            where the exercise's tissue is the field; None for none.
        pictures: makes the control scans that a scripted hand reads; None leaves it the monitor.
        led: whether another program leads the hand step by step, as the arm's demonstration does.
        hand_seed: of where a simulated hand begins and how it trembles, which attempts record;
            None takes `seed`.
    """

    exercise: Exercise
    placed: PlacedPlan
    ct: CtFacts = UNKNOWN_CT
    skill: str | None = None
    seed: int = 0
    sessions: Path = dataclasses.field(default_factory=paths.sessions)
    clock: Clock = dataclasses.field(default_factory=SystemClock)
    held_arming: bool = False
    port: str | None = None
    cameras: CameraSettings | None = None
    source: Callable[[DeviceProfile], NeedleSource] | None = None
    risks: tuple[Risk, ...] = ()
    tissues: TissueField | None = None
    hand_seed: int | None = None
    script: TraineeScript | None = None
    led: bool = False
    pictures: Pictures | None = None

    @property
    def by_program(self) -> bool:
        """Return whether no person moves the hand, so that the run is to be the same anywhere."""
        return self.led or self.skill is not None or self.script is not None

    def bound_field(self) -> BoundField | None:
        """Return the field in the robot's frame; None of an exercise whose tissue lies in layers.

        Raises:
            ExerciseError: if the exercise looks into a field, and there is none.
        """
        if self.exercise.tissue is TissueSource.LAYERS:
            return None
        if self.tissues is None or self.exercise.tissue is TissueSource.AUTO:
            raise ExerciseError(
                sentence(
                    "exercise {exercise_id} has tissue: {exercise_tissue}, and its"
                    " field has not been made: make it first, or set tissue: layers",
                    exercise_id=self.exercise.id,
                    exercise_tissue=self.exercise.tissue.value,
                )
            )
        from app.simulation.bound_field import BoundField

        return BoundField(self.tissues, self.placed.T_world_patient, self.placed.p_target)


def build_trainer(setup: TrainerSetup) -> Trainer:
    """Build a trainer and the parts behind it; see `build_rig`.

    Raises:
        AcusError: if a profile, an effect or the path cannot be used; says which and why.
    """
    return build_rig(setup).trainer


@dataclass(frozen=True, slots=True, eq=False)
class Rig:
    """What was built for one setup: the trainer and the parts behind it."""

    setup: TrainerSetup
    profile: DeviceProfile
    loop: Loop
    tracker: NeedleTracker
    trainer: Trainer
    robot: Robot | None = None
    source: NeedleSource | None = None

    @property
    def stereo(self) -> StereoAbilities:
        """Return what the tracker can do with two cameras.

        Raises:
            TrackingError: if a needle source is in place of robot and cameras.
        """
        if self.tracker.stereo is None:
            noun = "this needle" if self.source is None else self.source.noun
            raise TrackingError(
                sentence("this needs the two cameras of a robot; {noun} has none", noun=noun)
            )
        return self.tracker.stereo

    def close(self) -> None:
        """End everything at zero force, then let go of a real robot; idempotent."""
        try:
            self.trainer.close()
        finally:
            if self.robot is not None:
                self.robot.close()

    def compute_by(self, effect: str, model: str) -> Rig:
        """Compute an effect by another of its models from the next tick on, in an attempt too.

        Takes some milliseconds once the model's kernels are compiled.

        Raises:
            ControlLockedError: if the exercise keeps its models; an assessment does.
            AcusError: for an effect or model that there is not, or a loop that does not run.
        """
        if self.source is not None:
            noun = self.source.noun
            raise TrackingError(
                sentence("{noun} has no robot that could push: no effect is computed", noun=noun)
            )
        exercise = effect_models.with_model(self.setup.exercise, effect, model)
        if effect not in self.loop.names:
            raise ExerciseError(
                sentence(
                    "effect {effect} is not simulated in {exercise_id}: nobody needs what it "
                    "gives; `acus explain {exercise_id}` says why",
                    effect=effect,
                    exercise_id=exercise.id,
                )
            )
        setup = replace(self.setup, exercise=exercise)
        # Compiles what waits: before anything is held, so that nothing stands still meanwhile.
        fresh = loop_table(setup, self.profile, self.robot is None, self.robot)

        def change(loop: Loop) -> int:
            table, carry = effect_models.exchange(loop.table, fresh, effect)
            return loop.exchange(table, carry)

        self.trainer.compute_by(
            exercise, effect, model, change, lambda context: with_exercise(context, exercise)
        )
        return replace(self, setup=setup)

    def place(self, placed: PlacedPlan) -> Rig:
        """Take another plan: the trainer's aim, the effects' directions, the trainee's script.

        Raises:
            AcusError: if an attempt is running, or the trainee cannot follow the plan.
        """
        setup = replace(self.setup, placed=placed)
        check_touch(setup.exercise.touch_task(placed), self.profile)
        check_electrodes(setup.exercise.electrodes, placed, self.profile)
        table = (
            loop_table(setup, self.profile, self.robot is None, self.robot)
            if self.source is None
            else self.source.table(setup.exercise, placed, setup.skill, setup.seed)
        )
        self.trainer.place(placed)
        reopen = self.loop.is_open
        self.loop.close()
        self.loop.swap(table)
        if reopen:
            self.loop.open()
        return replace(self, setup=setup)


def build_rig(setup: TrainerSetup, robot: Robot | None = None) -> Rig:
    """Build a trainer on simulated or real cameras and on a simulated or real robot.

    Nothing is opened yet but the robot at `setup.port`: who answers there decides about the
    corrections of its readings and its clearance. A real robot's forces are armed by a held key.

    Args:
        setup: what it is built from.
        robot: one that is connected already, in place of `setup.port`; the rig closes it.

    Raises:
        AcusError: if a profile, an effect or the path cannot be used, or the robot does not answer.
    """
    profile = device_of(setup.exercise)
    check_touch(setup.exercise.touch_task(setup.placed), profile)
    check_electrodes(setup.exercise.electrodes, setup.placed, profile)
    if setup.source is not None:
        return _build_source_rig(setup, setup.source(profile))
    real = None
    if setup.cameras is not None and not setup.cameras.simulated:
        real = real_cameras(setup.cameras, setup.clock)
    robot = robot or connect(setup.port, profile)
    try:
        return _build_rig(setup, profile, robot, real)
    except BaseException:
        if robot is not None:
            robot.close()
        raise


def _build_rig(
    setup: TrainerSetup, profile: DeviceProfile, robot: Robot | None, real: AttachedCameras | None
) -> Rig:
    loop = build_loop(setup, profile, robot)
    placed = setup.exercise.placed_as(setup.placed.placement)
    cameras = real or simulated_on(
        load_rig(setup.exercise.rig),
        lambda offset: needle_scene(loop, profile, offset, real=robot is not None),
        setup.clock,
        setup.seed,
        pictures_of(placed, profile, robot is None),
    )
    trust = DepthTrust(profile.hand.depth_speed, seen=robot is None or real is not None)
    tracker: NeedleTracker
    if robot is not None and robot.link.hub is not None:
        cameras, trust = replace(cameras, metadata=CURSOR), DepthTrust(FASTEST)  # it is in the air
        tracker = HubTracker(robot.link.hub, profile, setup.clock, lambda fix: trainer.on_fix(fix))
    else:
        tracker = Tracker(
            cameras.cameras,
            cameras.rig,
            setup.clock,
            axis=measured_axis(loop),
            fulcrum=profile.fulcrum,
            on_fix=lambda fix: trainer.on_fix(fix),
            force=felt_force(loop),
            colour=cameras.colour,
            paced=_paced_fixes(setup, cameras.rig),
        )
    trainer = Trainer(
        loop,
        tracker,
        setup.placed,
        setup.exercise,
        _context(setup, profile, cameras, robot),
        setup.clock,
        clearance=robot.clearance if robot is not None else None,
        held_arming=setup.held_arming or robot is not None,
        risks=setup.risks,
        tissues=setup.tissues,
        trust=trust,
        start=Start.SIMULATED if robot is None else Start.REAL,
        beginnings=beginnings_of(setup, profile) if robot is None and setup.skill is None else None,
        simulated=robot is None and real is None,
        by_program=setup.by_program,
        pictures=setup.pictures,
        scripted=setup.skill or "",
    )
    return Rig(setup, profile, loop, tracker, trainer, robot)


def _paced_fixes(setup: TrainerSetup, rig: RigProfile) -> PacedFixes | None:
    if not isinstance(setup.clock, PacedClock):
        return None
    return PacedFixes(setup.clock, rig, every=setup.by_program)


def beginnings_of(setup: TrainerSetup, profile: DeviceProfile) -> Beginnings:
    """Return where attempts of a person's simulated hand begin: off the path, or on it."""
    drill, level = setup.exercise.drill, setup.exercise.hand_level
    aligned = drill is not None and drill.begins_aligned
    seed = setup.seed if setup.hand_seed is None else setup.hand_seed
    return Beginnings(seed, level, profile.tilt_limit, aligned)


def _build_source_rig(setup: TrainerSetup, source: NeedleSource) -> Rig:
    table = source.table(setup.exercise, setup.placed, setup.skill, setup.seed)
    initial = initial_plant(source.profile, UPRIGHT, START_DEPTH)
    loop = Loop(table, source.profile.rate_hz, setup.clock, initial=initial)
    loop.inbox.write(hand_depth=START_DEPTH, hand_holds=1.0, homed=1.0)
    tracker = source.tracker(loop, setup.clock, setup.seed)
    metadata = {**source.metadata(setup.skill), "ct": setup.ct.metadata()}
    documents = {"device": source.profile, **source.documents()}
    context = run_context(setup.exercise, setup.sessions, setup.seed, metadata, documents)
    trainer = Trainer(
        loop,
        tracker,
        setup.placed,
        setup.exercise,
        context,
        setup.clock,
        risks=setup.risks,
        tissues=setup.tissues,
        dial=0.0,
        trust=DepthTrust(FASTEST),  # a needle in the air is none in its tube
        start=Start.SIMULATED if source.simulated else Start.REAL,
    )
    tracker.listen(trainer.on_fix)
    return Rig(setup, source.profile, loop, tracker, trainer, source=source)


def pictures_of(
    exercise: Exercise, profile: DeviceProfile, simulated: bool = True
) -> dict[str, FloatArray]:
    """Return what an exercise has act on the pictures of simulated cameras: name -> parameters.

    Raises:
        AcusError: if an effect cannot be used; says which and why.
    """
    return compile_exercise(exercise, profile, declared_views(), simulated, True).pictures()


def build_loop(setup: TrainerSetup, profile: DeviceProfile, robot: Robot | None = None) -> Loop:
    """Build the control loop of a real robot, or of a simulated one whose needle waits upright."""
    initial = initial_plant(profile, UPRIGHT, START_DEPTH)
    table = loop_table(setup, profile, robot is None, robot)
    loop = Loop(table, profile.rate_hz, setup.clock, initial=initial)
    loop.inbox.write(hand_depth=START_DEPTH, hand_holds=1.0)
    if robot is not None:
        return loop  # the trainer asks for its clearance
    # The simulated robot knows its zero and its signs, and its forces are what they say.
    loop.inbox.write(homed=1.0, force_cap=profile.limits.hand_force)
    return loop


def loop_table(
    setup: TrainerSetup,
    profile: DeviceProfile,
    simulated: bool = True,
    robot: Robot | None = None,
) -> Table:
    """Table of a tick: trainee, encoders, the exercise's force laws and effects, plant.

    With a robot that is not simulated its link in place of encoders and plant, and a hand that
    moves only what simulated cameras see; without the robot itself neither trainee nor link nor
    plant: for a replay.
    """
    exercise = setup.exercise.placed_as(setup.placed.placement)
    link = robot.link.stages() if robot is not None else Link.of([], [])
    before: list[Stage] = []
    if simulated:
        link = simulated_link(profile, [plant_stage(profile, UPRIGHT, START_DEPTH)])
        if setup.skill is None:  # a script has a hand of its own
            before = [hand_unsteady_by_level(profile)]
    else:  # a simulated hand may still move what simulated cameras see
        before = [hand_stage(profile.needle_length)]
    if (simulated or robot is not None) and setup.skill is not None:
        placed = setup.placed
        trainee = (
            trainee_of(exercise, placed, setup.skill, setup.seed, setup.tissues)
            if setup.script is None
            else script_stage(setup.script, placed.axis)
        )
        before = [trainee, *before]
    requests = law_requests(exercise)
    # Of pictures nothing is computed in a tick: a replay needs no rig.
    tissue = setup.bound_field()
    plan = compile_exercise(
        exercise, profile, declared_views(), simulated, pictures=False, bound=tissue
    )
    bound = laws.energy_bound(requests, profile) + plan.energy_bound()
    forces = laws.stages_of(requests, profile)
    return machine_stages(
        profile,
        forces,
        plan.stages(),
        link,
        energy_bound=bound,
        before=before,
        corrections=[robot.corrections.stage()] if robot is not None else [],
    )


def _context(
    setup: TrainerSetup, profile: DeviceProfile, cameras: AttachedCameras, robot: Robot | None
) -> RunContext:
    metadata = {
        "device": {"name": profile.name, "simulated": "yes", "kind": "simulated"}
        if robot is None
        else robot.metadata(),
        "cameras": cameras.metadata,
        "ct": setup.ct.metadata(),
        TRAINEE: {"scripted": setup.skill or ""} | ({"hand": "robot"} if robot else {}),
    }
    documents = {"device": profile, "cameras": cameras.rig}
    calibration, rig = cameras.metadata.get("calibration", ""), cameras.rig.name
    agreement = agreement_of(calibration, rig, robot is None, setup.ct)
    context = run_context(
        setup.exercise, setup.sessions, setup.seed, metadata, documents, agreement
    )
    looks = setup.exercise.tissue is TissueSource.FIELD and setup.tissues is not None
    return with_field(context, setup.tissues) if looks and setup.tissues else context
