"""Attempts of the hands at the window (`pointer_hands`) in virtual time; nothing is written."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from app.compose.exercise_field import resolve_tissue, tissues_of, trial_plan
from app.compose.needle import measured_axis, needle_scene
from app.compose.pointer_hands import HANDS, Desk, Eyes
from app.compose.skill_scores import SkillOutcome, outcome
from app.compose.trainer import TrainerSetup, build_loop, pictures_of
from app.compose.trial import BEGIN, SETTLED, STEP_TICKS
from app.compose.trial_parts import NoRecords
from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.core.progress import Progress
from app.exercises.scene import device_of, placed_plan_of
from app.session.beginnings import Beginnings
from app.session.fixes import DepthTrust
from app.session.machine import State
from app.session.pad.geometry import PadScale, downward, path_frame
from app.session.pad.hand import HandLimits, HandPose, PadHand
from app.session.pad.view import depth_tolerance_of, rings_of
from app.session.shown_views import Shown
from app.session.snapshot import NextSteps
from app.session.trainer import Trainer
from app.session.withdrawal import WAITS, Start
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
    profile, clock = device_of(exercise), VirtualClock(BEGIN)
    setup = TrainerSetup(exercise, placed, seed=seed, clock=clock, tissues=tissues)
    loop, rig = build_loop(setup, profile), load_rig(exercise.rig)
    scene, axis = needle_scene(loop, profile, rig.needle.marker_offset), measured_axis(loop)
    spoiled = Spoiled.by(pictures_of(exercise, profile), rig.blur_px)
    tracker = SampledTracker(rig, profile.fulcrum, scene, axis, seed, spoiled)

    def measure(now: float) -> None:
        for fix in tracker.due(now):
            trainer.on_fix(fix)

    trainer = Trainer(
        loop,
        None,
        placed,
        exercise,
        NoRecords.of(exercise, seed),
        clock,
        measure,
        risks=risks,
        tissues=tissues,
        trust=DepthTrust(profile.hand.depth_speed),
        start=Start.SIMULATED,
        beginnings=Beginnings(seed, exercise.hand_level, profile.tilt_limit),
    )
    loop.open()
    try:
        trainer.step(STEP_TICKS)
        tracker.begin(clock.now())
        while clock.now() < BEGIN + SETTLED:
            trainer.step(STEP_TICKS)
        trainer.begin(hand="mouse")
        snapshot = trainer.step(STEP_TICKS)
        while snapshot.state is State.WITHDRAWING and not snapshot.ready:
            snapshot = trainer.step(STEP_TICKS)
        _play(trainer, exercise, placed, name)
        result = trainer.result
        return trainer.end() if result is None else result
    finally:
        loop.close()


def _play(trainer: Trainer, exercise: Exercise, placed: PlacedPlan, name: str) -> None:
    profile, rings = device_of(exercise), rings_of(exercise)
    frame = path_frame(placed.axis, placed.T_world_patient.rotation)
    scale = PadScale(placed.length, rings[0])
    steps = NextSteps(placed, rings[0], depth_tolerance_of(exercise))
    eyes = Eyes(Shown.of_exercise(exercise), placed, frame, scale, steps, rings[0])
    snapshot = trainer.snapshot()
    row = snapshot.device.row if snapshot.device is not None else None
    direction = (
        downward(0.0, 0.0)
        if row is None
        else downward(float(row[sv.HAND_X]), float(row[sv.HAND_Y]))
    )
    limits = HandLimits(profile.tilt_limit, *profile.depth_range)
    hand = PadHand(frame, scale, limits, HandPose(direction, WAITS, True))
    told = trainer.hold_breath if exercise.longest_hold is not None else None
    ring = float(np.hypot(*scale.place(np.array([rings[0] / placed.length, 0.0]))))
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
    progress, outcomes = progress or Progress(), []
    placed = placed_plan_of(exercise, device_of(exercise), trial_plan(exercise))
    tissues = tissues_of(exercise, placed.plan)
    exercise, _ = resolve_tissue(exercise, placed, tissues)
    for number, name in enumerate(HANDS):
        part = progress.part(number / len(HANDS), (number + 1) / len(HANDS))
        results = []
        for seed in range(1, seeds + 1):
            part.report((seed - 1) / seeds, name)
            results.append(pointer_attempt(exercise, placed, name, seed, risks, tissues))
        scores, durations = [r.score for r in results], [r.duration for r in results]
        outcomes.append(outcome(name, scores, durations))
    progress.report(1.0)
    return tuple(outcomes)
