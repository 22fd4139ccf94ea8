"""Builds a running trainer from a configuration: the only file that names concrete drivers."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from app.core import paths
from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.build import BUILD, build
from app.core.clock import Clock, SystemClock
from app.device.control import Loop, Table, laws, pantograph_stages
from app.device.links.link import Link
from app.device.links.simulated import simulated_link
from app.exchange.markups import plan_document
from app.exercises.scene import compile_exercise, device_of, law_requests
from app.exercises.schema import Exercise
from app.mechanisms.pantograph import system_forward
from app.mechanisms.profile import DeviceProfile
from app.planning.placement import PlacedPlan
from app.session.context import RunContext
from app.session.hands import TRAINEE
from app.session.header import Attachment
from app.session.trainer import Trainer
from app.simulation.plant import initial_plant, plant_stage
from app.simulation.trainee import trainee_stage
from app.tracking.rig import RigProfile, load_rig
from app.tracking.scene import MarkerScene, Scene
from app.tracking.simulated import simulated_cameras
from app.tracking.tracker import Tracker

UPRIGHT: Final = (0.0, 0.0, -1.0)
"""Needle direction at the start, hub to tip."""

START_DEPTH: Final = -0.015
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
        held_arming: whether the forces are on only while a key or pedal is held.
    """

    exercise: Exercise
    placed: PlacedPlan
    ct: str = ""
    skill: str | None = None
    seed: int = 0
    sessions: Path = field(default_factory=paths.sessions)
    clock: Clock = field(default_factory=SystemClock)
    held_arming: bool = False


def build_trainer(setup: TrainerSetup) -> Trainer:
    """Build a trainer on the simulated robot and the simulated cameras; nothing is opened yet.

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
    tracker: Tracker
    trainer: Trainer

    def place(self, placed: PlacedPlan) -> Rig:
        """Take another plan: the trainer's aim, the effects' directions, the trainee's script.

        Raises:
            AcusError: if an attempt is running, or the trainee cannot follow the plan.
        """
        setup = replace(self.setup, placed=placed)
        table = loop_table(setup, self.profile)
        self.trainer.place(placed)
        reopen = self.loop.is_open
        self.loop.close()
        self.loop.swap(table)
        if reopen:
            self.loop.open()
        return replace(self, setup=setup)


def build_rig(setup: TrainerSetup) -> Rig:
    """Build a trainer and keep the parts behind it; see `build_trainer`."""
    profile, cameras = device_of(setup.exercise), load_rig(setup.exercise.rig)
    loop = build_loop(setup, profile)
    scene = needle_scene(loop, profile, cameras.needle.marker_offset)
    tracker = Tracker(
        simulated_cameras(cameras, scene, setup.clock, setup.seed),
        cameras,
        setup.clock,
        axis=_measured_axis(loop),
        fulcrum=profile.pantograph.fulcrum,
        on_fix=lambda fix: trainer.on_fix(fix),
    )
    context = _context(setup, profile, cameras)
    trainer = Trainer(
        loop, tracker, setup.placed, setup.exercise, context, setup.clock,
        held_arming=setup.held_arming,
    )  # fmt: skip
    trainer.assistance(setup.exercise.assistance)
    return Rig(setup, profile, loop, tracker, trainer)


def build_loop(setup: TrainerSetup, profile: DeviceProfile) -> Loop:
    """Build the control loop of the simulated robot, the needle waiting upright over the skin."""
    initial = initial_plant(profile, UPRIGHT, START_DEPTH)
    table = loop_table(setup, profile)
    loop = Loop(table, profile.rate_hz, setup.clock, initial=initial)
    loop.inbox.write(hand_depth=START_DEPTH, hand_holds=1.0)
    # The simulated robot knows its zero and its signs, and its forces are what they say.
    loop.inbox.write(homed=1.0, force_cap=profile.limits.hand_force)
    return loop


def loop_table(setup: TrainerSetup, profile: DeviceProfile, simulated: bool = True) -> Table:
    """Table of a tick: trainee, encoders, the exercise's force laws and effects, plant.

    With a robot that is not simulated neither trainee nor link nor plant: for a replay.
    """
    exercise = setup.exercise.placed_as(setup.placed.placement)
    link = Link.of([], [])
    if simulated:
        link = simulated_link(profile, [plant_stage(profile, UPRIGHT, START_DEPTH)])
    if simulated and setup.skill is not None:
        placed = setup.placed
        trainee = trainee_stage(placed.axis, placed.length, setup.skill, setup.seed)
        link = Link.of([trainee, *link.read], link.write)
    requests = law_requests(exercise)
    plan = compile_exercise(exercise, profile, simulated)
    bound = laws.energy_bound(requests, profile) + plan.energy_bound()
    forces = laws.stages_of(requests, profile)
    return pantograph_stages(profile, forces, plan.stages(), link, energy_bound=bound)


def needle_scene(loop: Loop, profile: DeviceProfile, marker_offset: float) -> Scene:
    """Return what the cameras see: the true needle of the robot, not what its encoders say."""
    geometry = profile.pantograph

    def scene(time: float) -> MarkerScene:
        row = row_at(loop, time)
        depth = float(row[sv.PLANT_DEPTH])
        q = row[sv.PLANT_Q_LEFT : sv.PLANT_Q_LEFT + 2]
        needle = system_forward(geometry, q, geometry.needle_length - depth)
        tip = geometry.fulcrum + depth * needle.axis
        return MarkerScene.from_tip(tip, needle.axis, marker_offset)

    return scene


def row_at(loop: Loop, time: float) -> FloatArray:
    """Return the tick nearest before a monotonic time [s]: both pictures show one moment.

    The newest tick for a time to come, the oldest of the last tenth of a second for one long past.
    """
    newest = loop.latest()
    if newest.time <= time or newest.tick == 0:
        return newest.row
    rows = loop.rows(newest.tick - round(0.1 * loop.rate_hz))
    index = int(np.searchsorted(rows[:, sv.TIME], time, side="right")) - 1
    row: FloatArray = rows[max(index, 0)]
    return row


def _measured_axis(loop: Loop) -> Callable[[float], FloatArray | None]:
    def axis(time: float) -> FloatArray | None:
        row = row_at(loop, time)
        known = row[sv.TICK] > 0.0 and row[sv.KINEMATICS] == 0.0
        return row[sv.AXIS_X : sv.AXIS_X + 3] if known else None

    return axis


def _context(setup: TrainerSetup, profile: DeviceProfile, rig: RigProfile) -> RunContext:
    documents = {"exercise": _anonymous(setup.exercise), "device": profile, "cameras": rig}
    return RunContext(
        folder=setup.sessions,
        seed=setup.seed,
        metadata={
            "device": {"name": profile.name, "simulated": "yes"},
            "cameras": {"name": rig.name, "simulated": "yes"},
            "ct": {"pseudonym": setup.ct},
            TRAINEE: {"scripted": setup.skill or ""},
            BUILD: build(),
        },
        attachments=tuple(
            _attachment(f"{name}.json", document.model_dump(mode="json"))
            for name, document in documents.items()
        ),
        plan_files=lambda placed: (_attachment("plan.mrk.json", plan_document(placed.plan)),),
    )


def _anonymous(exercise: Exercise) -> Exercise:
    """Without folder and series of its CT, which may name a patient; the record has a pseudonym."""
    ct = exercise.ct.model_copy(update={"folder": None, "series": None})
    return exercise.model_copy(update={"ct": ct})


def _attachment(name: str, document: Any) -> Attachment:
    return Attachment(name, "application/json", json.dumps(document, indent=1).encode())
