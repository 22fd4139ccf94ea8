"""Attempts of the hands at the window (`pointer_hands`) in virtual time; nothing is written."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from app.compose.needle import measured_axis, needle_scene
from app.compose.pointer_hands import HANDS, Desk, Eyes
from app.compose.skill_scores import Resolved, SkillOutcome, run_trial
from app.compose.trainer import TrainerSetup, beginnings_of, build_loop, pictures_of
from app.compose.trial_parts import BEGIN, STEP_TICKS, virtual_trainer
from app.core.clock import VirtualClock
from app.core.messages import sentence
from app.core.progress import Progress
from app.exercises.errors import ExerciseError
from app.exercises.scene import device_of
from app.session.machine import State
from app.session.pad.geometry import downward
from app.session.pad.hand import HandPose
from app.session.pad.readings import hand_pose
from app.session.pad.view import PadScene, depth_tolerance_of, rings_of
from app.session.shown_views import Shown
from app.session.snapshot import NextSteps
from app.session.trainer import Trainer
from app.session.withdrawal import WAITS
from app.tracking.optics.rig import load_rig
from app.tracking.simulated.sampled import SampledTracker, Spoiled

if TYPE_CHECKING:
    from app.exercises.schema import Exercise
    from app.imaging.field import TissueField
    from app.planning.placement import PlacedPlan
    from app.session.result import AttemptResult
    from app.session.risks import Risk

LONGEST: Final = 300.0
"""Virtual time of an attempt at most [s]."""


def pointer_attempt(
    exercise: Exercise,
    placed: PlacedPlan,
    name: str,
    seed: int,
    risks: tuple[Risk, ...] = (),
    tissues: TissueField | None = None,
) -> AttemptResult:
    """Let one of the hands at the window do its first attempt.

    Args:
        exercise: with its tissue resolved.
        placed: its plan in the robot's frame.
        name: of the hand, one of `pointer_hands.HANDS`.
        seed: of its start, its unsteadiness and the cameras' noise.
        risks: structures that the needle has to keep away from.
        tissues: field of the patient.

    Raises:
        AcusError: if a profile, an effect or the path cannot be used; says which and why.
    """
    if not Shown.of_exercise(exercise).live:
        raise ExerciseError(
            sentence(
                "the hands at the window steer by the live needle, and {exercise_id} shows none: "
                "try it with another --script",
                exercise_id=exercise.id,
            )
        )
    profile, clock = device_of(exercise), VirtualClock(BEGIN)
    setup = TrainerSetup(exercise, placed, seed=seed, clock=clock, tissues=tissues)
    loop, rig = build_loop(setup, profile), load_rig(exercise.rig)
    scene, axis = needle_scene(loop, profile, rig.needle.marker_offset), measured_axis(loop)
    spoiled = Spoiled.by(pictures_of(exercise, profile), rig.blur_px)
    tracker = SampledTracker(rig, profile.fulcrum, scene, axis, seed, spoiled)
    begins = beginnings_of(setup, profile)
    with virtual_trainer(setup, loop, profile, tracker, risks, begins) as trainer:
        trainer.begin(hand="mouse")
        snapshot = trainer.step(STEP_TICKS)
        while snapshot.state is State.WITHDRAWING and not snapshot.ready:
            snapshot = trainer.step(STEP_TICKS)
        _play(trainer, exercise, placed, name)
        result = trainer.result
        return trainer.end() if result is None else result


def _play(trainer: Trainer, exercise: Exercise, placed: PlacedPlan, name: str) -> None:
    profile, rings = device_of(exercise), rings_of(exercise)
    along = depth_tolerance_of(exercise)
    scene = PadScene.of(placed, profile, rings, along, exercise.touch is not None)
    steps = NextSteps(placed, rings[0], along)
    eyes = Eyes(Shown.of_exercise(exercise), placed, scene, steps, rings[0])
    nowhere = HandPose(downward(0.0, 0.0), WAITS, True)
    hand = scene.hand(hand_pose(trainer.snapshot()) or nowhere)
    told = trainer.hold_breath if exercise.longest_hold is not None else None
    ring = float(np.hypot(*scene.scale.place(np.array([rings[0] / placed.length, 0.0]))))
    desk, moves = Desk(hand, ring, told), None
    while trainer.snapshot().elapsed < LONGEST and trainer.result is None:
        desk.show(eyes.read(trainer.step(STEP_TICKS)))
        if moves is None:
            moves = HANDS[name](desk)
        if next(moves, _OVER) is _OVER:
            return
        x, y, _ = hand.pose.direction
        trainer.hand(float(x), float(y), hand.pose.depth)


_OVER: Final = object()


def pointer_outcomes(
    exercise: Exercise,
    seeds: int,
    risks: tuple[Risk, ...] = (),
    progress: Progress | None = None,
) -> tuple[SkillOutcome, ...]:
    """Let both hands at the window do their first attempt once per seed.

    Raises:
        AcusError: if the exercise cannot be used at all; says why.
        Cancelled: if `progress` was cancelled.
    """
    on = Resolved.of(exercise)

    def play(name: str, seed: int) -> AttemptResult:
        return pointer_attempt(on.exercise, on.placed, name, seed, risks, on.tissues)

    return run_trial(tuple(HANDS), play, seeds, progress)
