"""Attempts in virtual time, without recorder and rendering; `skill_scores` sums many up.

Everything that decides about a score is the program's own: the loop with the exercise's laws and
effects, the scripted hand, the phases, the metrics. Only the pictures are left out, and the record
is never written. There are two ways:

`attempt` puts a running trainer round all of it, with whole fixes by `SampledTracker`. It can do
all that a trainer can (pause, abort), and it costs what the trainer's Python costs.

`Trials` is for the many attempts of a table or a plot. The cameras are a stage of the loop
(`SampledDepth`), so that the loop runs without being asked, and the samples of the attempt are made
of its rows at once, by the same rules: depth by the cameras while it is fresh, tip on the robot's
line, bent as the tissue bends it, phases by `session.transitions`. What a trainer would have to
judge (a fault of the robot, cameras that see nothing for a second) is not judged again here: such
an attempt is done over by `attempt`. `tests/test_compose_trial.py` holds the one against the other.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from app.compose.needle import UPRIGHT, measured_axis, needle_scene
from app.compose.trainee import trainee_of
from app.compose.trainer import START_DEPTH, TrainerSetup, build_loop, loop_table, pictures_of
from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.bend import tips_beside
from app.core.clock import VirtualClock
from app.core.parameters import Stage
from app.core.staleness import TRACKER_HOLD
from app.core.units import MILLIMETRE, MILLISECOND
from app.device.control import Loop, Table
from app.exercises.parts import OwnPlan
from app.exercises.scene import device_of, plan_of
from app.planning.plan import Plan
from app.scoring.touches import Touches
from app.session import machine
from app.session.context import RunContext
from app.session.fixes import AGREEING, FORGOTTEN, DepthTrust
from app.session.fusion import across_noise, depth_noise
from app.session.inputs import LoopInputs
from app.session.machine import AttemptEvent, State
from app.session.needle import DepthSource
from app.session.observation import GRACE
from app.session.recorder import Recorder
from app.session.risks import risk_marks_of
from app.session.samples import Samples
from app.session.scored import scorer, trajectory
from app.session.tissues import tissues_met_of
from app.session.touching import Touching
from app.session.trainer import Trainer
from app.session.transitions import LOST, Classifier, classify
from app.session.withdrawal import Start
from app.simulation.plant import initial_plant
from app.simulation.trainee import ScriptPhase
from app.tracking.optics.rig import RigProfile, load_rig
from app.tracking.simulated.cameras import simulated_cameras
from app.tracking.simulated.picture_effects import picture_effects
from app.tracking.simulated.sampled import (
    BOTH,
    PROCESSING,
    SampledDepth,
    SampledTracker,
    Spoiled,
)
from app.tracking.simulated.scene import MarkerScene
from app.tracking.tracker import Tracker

if TYPE_CHECKING:
    from app.exercises.schema import Exercise
    from app.imaging.field import TissueField
    from app.planning.placement import PlacedPlan
    from app.scoring.result import Score
    from app.session.result import AttemptResult
    from app.session.risks import Risk
    from app.tracking.cameras.camera import Camera
    from app.tracking.fix import NeedleFix

STEP_TICKS: Final = 20
"""Ticks of the loop between two looks of the trainer, as in the program at 1 kHz."""

BEGIN: Final = 10.0
SETTLED: Final = 0.6
LONGEST: Final = 300.0
"""Virtual time [s]: of the beginning, for the cameras to be believed, and of an attempt at most."""

STEP: Final = 1.0 * MILLIMETRE
BEYOND: Final = 20.0 * MILLIMETRE
"""Depths by the cameras are tabulated in such steps, to so far behind the target [m]."""

HEARTBEATS: Final = 10
"""Looks from one sign of life of the window to the next: 0.2 s, of 1 s that the loop allows."""


class _Unrecorded(Recorder):
    """A recorder that writes nothing: it is never open, so it drops what it is given."""

    def open(self) -> None:
        """Leave the disk alone."""


@dataclass(frozen=True, slots=True)
class _NoRecords(RunContext):
    """The context of attempts of which nothing is kept."""

    def recorder(self, header: Any, loop: Any, placed: Any, clock: Any) -> Recorder:
        """Return one that writes nothing; no checkpoint is taken."""
        return _Unrecorded(self.folder, header, clock=clock)


class _RenderedTracker:
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

    def due(self, now: float) -> list[NeedleFix]:
        """Take pictures if it is time, and return the fixes that are there by now."""
        if now >= self._next:
            self._next += 1.0 / self._rig.rate_hz
            left, right = (camera.read() for camera in self._cameras)
            fix = self._tracker.process(left, right)
            self._late.append((now + self._rig.latency_ms * MILLISECOND + PROCESSING, fix))
        there = [fix for time, fix in self._late if time <= now]
        self._late = [(time, fix) for time, fix in self._late if time > now]
        return there


def trial_plan(exercise: Exercise) -> Plan:
    """Return the plan that trials follow; where the student plans, the phantom's own entry.

    Raises:
        ExerciseError: if the student plans on a CT that is no phantom.
    """
    if isinstance(exercise.plan, OwnPlan) and exercise.ct.phantom is not None:
        return plan_of(exercise.model_copy(update={"plan": "phantom_default"}))
    return plan_of(exercise)


def attempt(
    exercise: Exercise,
    placed: PlacedPlan,
    skill: str,
    seed: int,
    risks: tuple[Risk, ...] = (),
    pictures: bool = False,
    tissues: TissueField | None = None,
) -> AttemptResult:
    """Let a scripted trainee do one attempt in virtual time; nothing is written.

    Args:
        exercise: with the assistance that it begins with.
        placed: its plan in the robot's frame.
        skill: a name of `skills.SKILLS`.
        seed: of the trainee and of the tracker's noise.
        risks: structures that the needle has to keep away from.
        tissues: field of the patient that tells what the needle met.
        pictures: whether both cameras' pictures are rendered and tracked: seven times the work.

    Raises:
        AcusError: if a profile, an effect or the path cannot be used; says which and why.
    """
    profile, clock = device_of(exercise), VirtualClock(BEGIN)
    setup = TrainerSetup(exercise, placed, skill=skill, seed=seed, clock=clock, tissues=tissues)
    loop, rig = build_loop(setup, profile), load_rig(exercise.rig)
    scene = needle_scene(loop, profile, rig.needle.marker_offset)
    fulcrum = profile.fulcrum
    axis, spoiling = measured_axis(loop), pictures_of(exercise, profile)
    tracker = (
        _RenderedTracker(
            simulated_cameras(rig, scene, clock, seed, picture_effects(spoiling)),
            rig,
            clock,
            axis,
            fulcrum,
        )
        if pictures
        else SampledTracker(rig, fulcrum, scene, axis, seed, Spoiled.by(spoiling, rig.blur_px))
    )

    def measure(now: float) -> None:
        for fix in tracker.due(now):
            trainer.on_fix(fix)

    trainer = Trainer(
        loop,
        None,
        placed,
        exercise,
        _NoRecords(seed=seed),
        clock,
        measure,
        risks=risks,
        tissues=tissues,
        trust=DepthTrust(profile.hand.depth_speed),
        start=Start.SIMULATED,
    )
    loop.open()
    try:
        trainer.step(STEP_TICKS)
        tracker.begin(clock.now())
        while clock.now() < BEGIN + SETTLED:
            trainer.step(STEP_TICKS)
        trainer.begin()
        while clock.now() < BEGIN + LONGEST:
            row = trainer.step(STEP_TICKS).device
            if row is None or row.row[sv.TRAINEE_PHASE] == ScriptPhase.DONE:
                break
            if trainer.result is not None:  # aborted: a fault of the robot, say
                return trainer.result
        return trainer.end()
    finally:
        loop.close()


@dataclass(frozen=True, slots=True)
class Trial:
    """What an attempt of `Trials` came to.

    Attributes:
        score: None where it could not be scored.
        duration: virtual time of the attempt [s].
    """

    score: Score | None
    duration: float


class Trials:
    """Many attempts at one exercise, each in a small part of the time that `attempt` takes.

    Args:
        exercise: with the assistance that it begins with.
        placed: its plan in the robot's frame.
        risks: structures that the needle has to keep away from.
        tissues: field of the patient that tells what the needle met.

    Raises:
        AcusError: if a profile, an effect or the path cannot be used; says which and why.
    """

    def __init__(
        self,
        exercise: Exercise,
        placed: PlacedPlan,
        risks: tuple[Risk, ...] = (),
        tissues: TissueField | None = None,
    ) -> None:
        self._exercise, self._placed, self._risks = exercise, placed, risks
        self._tissues = tissues
        self._profile = device_of(exercise)
        self._scorer = scorer(exercise)
        self._task = exercise.touch_task(placed)
        # What pulls towards the target follows the touches, which the loop alone does not know.
        self._pulled = self._task is not None and bool(exercise.laws) and exercise.assistance != 0.0
        setup = TrainerSetup(exercise, placed, clock=VirtualClock(BEGIN), tissues=tissues)
        table = loop_table(setup, self._profile)
        # What stages remember is in their arrays: each attempt takes copies, shared ones once.
        self._stages, self._write = table.compute, table.write
        self._fulcrum = self._profile.fulcrum
        rig = load_rig(exercise.rig)
        self._spoiled = Spoiled.by(pictures_of(exercise, self._profile), rig.blur_px)
        self._cameras, self._spread = self._measurements(rig)

    def score(self, skill: str, seed: int) -> Trial:
        """Let a scripted trainee of `simulation.skills` do one attempt; the same for one seed.

        Raises:
            AcusError: for an unknown skill.
        """
        rows, begin = self._rows(skill, seed)
        samples = self._samples(rows)
        faults = rows[rows[:, sv.TIME] > begin + GRACE, sv.FAULT]
        touching = None if self._task is None else Touching(self._task)
        went = _Course.of(samples, begin, touching)
        if faults.any() or went.unseen >= LOST or self._pulled:
            result = attempt(
                self._exercise, self._placed, skill, seed, self._risks, tissues=self._tissues
            )
            return Trial(result.score, result.duration)
        samples = replace(samples, state=went.states, target=went.target)
        near = risk_marks_of(samples, self._placed, self._risks)
        met = tissues_met_of(samples, self._placed, self._tissues)
        path = trajectory(samples, self._placed, risks=near, touches=went.touches, met=met)
        return Trial(self._scorer(path), float(samples.time[-1]) - begin)

    def _rows(self, skill: str, seed: int) -> tuple[FloatArray, float]:
        """Run the loop; returns its state at each look of an attempt, and when that began [s]."""
        placed, profile, clock = self._placed, self._profile, VirtualClock(BEGIN)
        own: dict[int, FloatArray] = {}

        def fresh(stage: Stage) -> Stage:
            values = own.setdefault(id(stage.parameters), stage.parameters.copy())
            return stage._replace(parameters=values)

        trainee = trainee_of(self._exercise, placed, skill, seed)
        before = trainee, self._cameras.stage(seed, self._spoiled)
        table = Table.of([*before, *map(fresh, self._stages)], map(fresh, self._write))
        initial = initial_plant(profile, UPRIGHT, START_DEPTH)
        loop = Loop(table, profile.rate_hz, clock, initial=initial)
        loop.inbox.write(
            hand_depth=START_DEPTH,
            hand_holds=1.0,
            homed=1.0,
            force_cap=profile.limits.hand_force,
        )
        inputs = LoopInputs(loop.inbox)
        inputs.prepare(placed, self._exercise.assistance)
        loop.open()
        try:
            inputs.heartbeat(BEGIN)
            loop.step(round(SETTLED * profile.rate_hz))
            begin, tick = clock.now(), round(SETTLED * profile.rate_hz)
            inputs.arm(True)
            rows: list[FloatArray] = []
            while clock.now() < BEGIN + LONGEST:
                if len(rows) % HEARTBEATS == 0:
                    inputs.heartbeat(clock.now())
                loop.step(STEP_TICKS)
                tick += STEP_TICKS
                rows.append(loop.rows(tick - 1)[0])
                if rows[-1][sv.TRAINEE_PHASE] == ScriptPhase.DONE:
                    break
        finally:
            loop.close()
        return np.array(rows), begin

    def _samples(self, rows: FloatArray) -> Samples:
        """Return what a trainer keeps of these states (`session.fusion`); all as if `aligning`."""
        time, axis = rows[:, sv.TIME], rows[:, sv.AXIS]
        age = time - rows[:, sv.TRACKED_TIME]
        measured = (rows[:, sv.TRACKED_TIME] > 0.0) & (age <= TRACKER_HOLD)
        depth = np.where(measured, rows[:, sv.TRACKED_DEPTH], rows[:, sv.DEPTH])
        axis = axis / np.linalg.norm(axis, axis=1, keepdims=True)
        bend = np.column_stack(
            [
                rows[:, sv.TIP_OFFSET],
                rows[:, sv.TIP_SLOPE],
                rows[:, sv.ROOT_CURVATURE],
                rows[:, sv.BENT_LENGTH],
            ]
        )
        bend[~(bend[:, 9] > 0.0)] = np.nan
        tip = self._fulcrum + depth[:, None] * axis + tips_beside(bend, depth)
        along = np.sqrt(np.maximum(rows[:, sv.TRACKED_VARIANCE], 0.0))
        across = np.interp(depth, *self._spread)
        spread = np.where(measured[:, None], np.column_stack([along, across, age]), np.nan)
        source = np.where(measured, DepthSource.TRACKED.value, DepthSource.MODEL.value)
        return Samples(
            time=time,
            state=np.full(len(rows), State.ALIGNING.value, dtype="<U10"),
            valid=(rows[:, sv.KINEMATICS] == 0.0) & np.isfinite(tip).all(axis=1),
            depth_source=source,
            depth=depth,
            tip=tip,
            axis=axis,
            target=self._placed.p_target + rows[:, sv.TARGET_SHIFT],
            hub=rows[:, sv.HUB],
            guide=rows[:, sv.GUIDE],
            felt=rows[:, sv.FELT],
            measured=np.full(len(rows), np.nan),
            bend=bend if np.isfinite(bend).any() else None,
            assistance=rows[:, sv.ASSISTANCE],
            spread=spread,
            clamped=rows[:, sv.LIMIT_SCALE] < 1.0,
        )

    def _measurements(self, rig: RigProfile) -> tuple[SampledDepth, tuple[FloatArray, FloatArray]]:
        """Tabulate by the tracker's solver and `fusion` what the cameras measure along the path.

        Returns:
            The cameras as a stage; depths and standard deviations across the needle [m].
        """
        placed, axis = self._placed, self._placed.axis
        offset = rig.needle.marker_offset
        tracker = SampledTracker(
            rig, self._fulcrum, lambda _: scenes[0], lambda _: axis, spoiled=self._spoiled
        )
        low, high = self._profile.depth_range
        aims = (placed,) if self._task is None else self._task.plans
        deepest = max(plan.length for plan in aims)
        last = min(high, deepest + BEYOND)
        depths = np.arange(min(low, START_DEPTH), last + STEP, STEP)
        tips = self._fulcrum + depths[:, None] * axis
        scenes = [MarkerScene.from_tip(tip, axis, offset) for tip in tips]
        table, across = np.full((len(depths), 3, 2), np.inf), np.zeros(len(depths))
        for row, scene in enumerate(scenes):
            for which, found in enumerate(((True, True), (True, False), (False, True))):
                fix = tracker.noiseless(scene, axis, found)
                if fix.usable:
                    table[row, which] = depth_noise(fix, self._fulcrum, axis)
                    if which == BOTH or not across[row]:
                        across[row] = across_noise(fix, self._fulcrum, axis)
        cameras = SampledDepth(
            table,
            float(depths[0]),
            STEP,
            1.0 / rig.rate_hz,
            rig.latency_ms * MILLISECOND + PROCESSING,
            AGREEING,
            FORGOTTEN,
        )
        return cameras, (depths, across)


@dataclass(frozen=True, slots=True, eq=False)
class _Course:
    """What a trainer would have made of the samples of an attempt, one after the other.

    Attributes:
        states: at each sample, shape (n,).
        unseen: longest time in the body without a depth [s].
        target: at each sample [m], shape (n, 3).
        touches: targets that were to be touched; None where there were none.
    """

    states: NDArray[np.str_]
    unseen: float
    target: FloatArray
    touches: Touches | None = None

    @classmethod
    def of(cls, samples: Samples, begin: float, touching: Touching | None = None) -> _Course:
        """Judge samples that are all taken for `aligning`, of an attempt from `begin` [s] on."""
        attempt = machine.advance(machine.Attempt(), AttemptEvent.BEGIN, begin)
        memory = Classifier()
        seen = (samples.depth_source == DepthSource.TRACKED.value) & samples.valid
        shift = samples.target - samples.target[0] if touching else None
        target, depths, states = samples.target.copy(), samples.depth.tolist(), []
        since, unseen, times = begin, 0.0, []
        for k, time in enumerate(samples.time.tolist()):
            if touching is not None and shift is not None:
                target[k] = touching.state.aim.p_target + shift[k]
            depth = depths[k] if seen[k] else None
            away = float(np.linalg.norm(samples.tip[k] - target[k]))
            memory, event = classify(memory, attempt.state, time, depth, away)
            if event is not None:
                attempt = machine.advance(attempt, event, time)
            if depth is not None or attempt.state is State.ALIGNING:
                since = time
            unseen = max(unseen, time - since)
            states.append(attempt.state.value)
            if touching is not None and samples.spread is not None:
                inside = depth is not None and attempt.state in (State.INSERTING, State.HOLDING)
                at = time - float(samples.spread[k, 2]) if inside else None
                if touching.take(samples.tip[k], at):
                    times.append(time)
        of = 0 if touching is None else len(touching.state.task)
        return cls(np.array(states), unseen, target, Touches(of, tuple(times)) if of else None)
