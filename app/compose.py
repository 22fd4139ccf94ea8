"""Builds a running trainer from a configuration: the only file that names concrete drivers."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from app.core import paths
from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import Clock, SystemClock
from app.device.control import Loop, VirtualFixture, pantograph_stages
from app.device.links.link import Triple
from app.device.links.simulated import simulated_link
from app.exercises.scene import compile_exercise, device_of
from app.exercises.schema import Exercise
from app.mechanisms.profile import DeviceProfile
from app.planning.placement import PlacedPlan
from app.session.context import RunContext
from app.session.header import Attachment
from app.session.scored import scorer
from app.session.trainer import Trainer
from app.simulation.plant import initial_plant, plant_stage
from app.simulation.trainee import trainee_stage
from app.tracking.rig import RigProfile, load_rig
from app.tracking.scene import MarkerScene, Scene
from app.tracking.simulated import simulated_cameras
from app.tracking.tracker import Tracker

START_DEPTH = -0.015
"""Where the needle waits: tip 15 mm above the skin [m]."""


@dataclass(frozen=True, slots=True)
class TrainerSetup:
    """What a trainer is built from.

    Attributes:
        exercise: effects, device, cameras, tolerances.
        placed: the plan in the robot's frame.
        ct: pseudonym of the CT, for the record.
        skill: `novice` or `expert` lets a scripted trainee insert the needle; None leaves it to
            the mouse.
        seed: of everything random in the run.
        sessions: folder of the records.
        clock: monotonic clock; a virtual one for runs faster than real time.
    """

    exercise: Exercise
    placed: PlacedPlan
    ct: str = ""
    skill: str | None = None
    seed: int = 0
    sessions: Path = field(default_factory=paths.sessions)
    clock: Clock = field(default_factory=SystemClock)


def build_trainer(setup: TrainerSetup) -> Trainer:
    """Build a trainer on the simulated robot and the simulated cameras; nothing is opened yet.

    Raises:
        AcusError: if a profile, an effect or the path cannot be used; says which and why.
    """
    profile, rig = device_of(setup.exercise), load_rig(setup.exercise.rig)
    loop = build_loop(setup, profile)
    trainer: Trainer | None = None
    tracker = build_tracker(loop, rig, profile, setup)
    trainer = Trainer(
        loop,
        tracker,
        setup.placed,
        setup.exercise,
        scorer(setup.exercise),
        _context(setup, profile, rig),
        setup.clock,
    )
    trainer.assistance(setup.exercise.assistance)
    return trainer


def build_loop(setup: TrainerSetup, profile: DeviceProfile) -> Loop:
    """Build the control loop of the simulated robot, with the effects the exercise calls for."""
    axis = setup.placed.axis
    start = (0.0, 0.0, -1.0)
    plan = compile_exercise(setup.exercise, profile)
    link = simulated_link(profile, [plant_stage(profile, start, START_DEPTH)])
    if setup.skill is not None:
        trainee = trainee_stage(axis, setup.placed.length, setup.skill, setup.seed)
        link = type(link).of([trainee, *link.read], link.write)
    laws: list[Triple] = [VirtualFixture.of(profile).stage()]
    table = pantograph_stages(profile, laws, plan.stages(), link)
    initial = initial_plant(profile, start, START_DEPTH)
    loop = Loop(table, profile.rate_hz, setup.clock, initial=initial)
    loop.inbox.write(hand_depth=START_DEPTH, hand_holds=1.0)
    return loop


def build_tracker(
    loop: Loop, rig: RigProfile, profile: DeviceProfile, setup: TrainerSetup
) -> Tracker:
    """Build the tracker on two simulated cameras that look at the simulated needle."""
    scene = needle_scene(loop, profile, rig.needle.marker_offset)
    cameras = simulated_cameras(rig, scene, setup.clock, setup.seed)
    return Tracker(cameras, rig, setup.clock, axis=_measured_axis(loop))


def needle_scene(loop: Loop, profile: DeviceProfile, marker_offset: float) -> Scene:
    """What the cameras see: the true needle of the simulated robot, not what its encoders say."""
    from app.mechanisms.pantograph import system_forward

    geometry = profile.pantograph

    def scene(_: float) -> MarkerScene:
        row = loop.latest().row
        depth = float(row[sv.PLANT_DEPTH])
        q = row[sv.PLANT_Q_LEFT : sv.PLANT_Q_LEFT + 2]
        needle = system_forward(geometry, q, geometry.needle_length - depth)
        tip = geometry.fulcrum + depth * needle.axis
        return MarkerScene.from_tip(tip, needle.axis, marker_offset)

    return scene


def _measured_axis(loop: Loop) -> Callable[[float], FloatArray | None]:
    def axis(_: float) -> FloatArray | None:
        state = loop.latest()
        return state.axis if state.tick and state.kinematics == 0 else None

    return axis


def _context(setup: TrainerSetup, profile: DeviceProfile, rig: RigProfile) -> RunContext:
    documents = {"exercise": setup.exercise, "device": profile, "cameras": rig}
    return RunContext(
        folder=setup.sessions,
        seed=setup.seed,
        metadata={
            "device": {"name": profile.name, "simulated": "yes"},
            "cameras": {"name": rig.name, "simulated": "yes"},
            "ct": {"pseudonym": setup.ct},
            "trainee": {"scripted": setup.skill or ""},
        },
        attachments=tuple(
            Attachment(
                f"{name}.json",
                "application/json",
                json.dumps(document.model_dump(mode="json"), indent=1).encode(),
            )
            for name, document in documents.items()
        ),
    )
