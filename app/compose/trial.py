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

from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import ArrayLike

from app.compose.needle import UPRIGHT, measured_axis, needle_scene
from app.compose.stepped_loop import SteppedLoop, bends_of
from app.compose.trainee import trainee_of
from app.compose.trainer import START_DEPTH, TrainerSetup, build_loop, loop_table, pictures_of
from app.compose.trial_course import TrialCourse
from app.compose.trial_parts import (
    BEGIN,
    STEP_TICKS,
    PlayedHand,
    PlayedTrial,
    RenderedTracker,
    Trial,
    virtual_trainer,
)
from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.bend import tips_beside
from app.core.clock import VirtualClock
from app.core.parameters import Stage
from app.core.staleness import TRACKER_HOLD
from app.core.units import MILLIMETRE, MILLISECOND
from app.device.control import Table
from app.exercises.guidance import Purpose
from app.exercises.parts import TissueSource
from app.exercises.scene import device_of
from app.session.ablation import AblationState
from app.session.complication_case import ComplicationCase
from app.session.control_scan import Taking, scan_marks
from app.session.fixes import AGREEING, FORGOTTEN
from app.session.fusion import across_noise, depth_noise
from app.session.machine import State
from app.session.needle import DepthSource
from app.session.observation import GRACE
from app.session.planned import judged_plan_of
from app.session.procedure_marks import marks_of
from app.session.risks import risk_marks_of
from app.session.samples import Samples
from app.session.scored import scorer, trajectory
from app.session.scripted_answers import Pictures, ScriptedPatient
from app.session.scripted_steps import StepsDone, steps_of_rows
from app.session.tissues import tissues_met_of
from app.session.touching import Touching
from app.session.transitions import LOST
from app.simulation.hands import Script, named
from app.simulation.skills import find_skill
from app.simulation.trainee import ScriptPhase, script_stage
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

if TYPE_CHECKING:
    from app.exercises.schema import Exercise
    from app.imaging.field import TissueField
    from app.planning.placement import PlacedPlan
    from app.session.result import AttemptResult
    from app.session.risks import Risk

LONGEST: Final = 900.0
"""Virtual time of an attempt at most [s]."""

STEP: Final = 1.0 * MILLIMETRE
BEYOND: Final = 20.0 * MILLIMETRE
"""Depths by the cameras are tabulated in such steps, to so far behind the target [m]."""


def attempt(
    exercise: Exercise,
    placed: PlacedPlan,
    skill: str,
    seed: int,
    risks: tuple[Risk, ...] = (),
    pictures: bool = False,
    tissues: TissueField | None = None,
    script: Script = Script.HAND,
    hand: PlayedHand | None = None,
    watch: Callable[[FloatArray], object] = lambda row: None,
    scans: Pictures | None = None,
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
        script: how the trainee behaves: as people do, or as in a demonstration.
        hand: plays in place of the skill's.
        scans: makes the control scans that the hand reads; None leaves it the monitor.
        watch: told the loop's state at each look, as the attempt goes on; what it is told is the
            loop's own memory.

    Raises:
        AcusError: if a profile, an effect or the path cannot be used; says which and why.
    """
    if hand is not None and hand.dial is not None:
        exercise = exercise.model_copy(update={"assistance": hand.dial})
    profile, clock = device_of(exercise), VirtualClock(BEGIN)
    played = named(find_skill(skill).name, script)
    setup = TrainerSetup(
        exercise,
        placed,
        skill=played,
        seed=seed,
        clock=clock,
        tissues=tissues,
        script=None if hand is None else hand.script,
        pictures=scans,
    )
    loop, rig = build_loop(setup, profile), load_rig(exercise.rig)
    scene = needle_scene(loop, profile, rig.needle.marker_offset)
    fulcrum = profile.fulcrum
    axis, spoiling = measured_axis(loop), pictures_of(exercise, profile)
    tracker = (
        RenderedTracker(
            simulated_cameras(rig, scene, clock, seed, picture_effects(spoiling)),
            rig,
            clock,
            axis,
            fulcrum,
        )
        if pictures
        else SampledTracker(rig, fulcrum, scene, axis, seed, Spoiled.by(spoiling, rig.blur_px))
    )

    began = inf

    def covered(now: float) -> float | None:
        until = None if hand is None else hand.covers(now - began)
        return None if until is None else began + until

    with virtual_trainer(setup, loop, profile, tracker, risks, covered=covered) as trainer:
        trainer.begin(hand="script")  # judged by the tolerances, not by the bands of a pointer
        began = clock.now()
        while clock.now() < BEGIN + LONGEST:
            row = trainer.step(STEP_TICKS).device
            if row is not None:
                watch(row.row)
            if row is None or row.row[sv.TRAINEE_PHASE] == ScriptPhase.DONE:
                break
            if trainer.result is not None:  # aborted: a fault of the robot, say
                return trainer.result
        return trainer.end()


class Trials:
    """Many attempts at one exercise, each in a small part of the time that `attempt` takes.

    Args:
        exercise: with the assistance that it begins with.
        placed: its plan in the robot's frame.
        risks: structures that the needle has to keep away from.
        tissues: field of the patient that tells what the needle met.
        script: how the trainees behave: as people do, or as in a demonstration.
        aimed: plan as robot and hand have it, where the registration errs; None for `placed`.
        noise: factor on the noise of the cameras.
        pictures: makes the control scans that hands read; None leaves them the monitor.

    Raises:
        AcusError: if a profile, an effect or the path cannot be used; says which and why.
    """

    def __init__(
        self,
        exercise: Exercise,
        placed: PlacedPlan,
        risks: tuple[Risk, ...] = (),
        tissues: TissueField | None = None,
        script: Script = Script.HAND,
        aimed: PlacedPlan | None = None,
        noise: float = 1.0,
        pictures: Pictures | None = None,
    ) -> None:
        self._script, self._pictures = script, pictures
        self._aimed = placed if aimed is None else aimed
        self._only_here = aimed is not None or noise != 1.0
        self._exercise, self._placed, self._risks = exercise, placed, risks
        self._tissues = tissues
        self._profile = device_of(exercise)
        self._scorer = scorer(exercise)
        asks_lung = exercise.asks_lung_path
        self._planned = judged_plan_of(placed, tissues, asks_lung) if exercise.is_own_plan else None
        self._case = ComplicationCase.of(exercise, placed, tissues)
        self._task = exercise.touch_task(placed)
        # What pulls towards the target follows the touches, which the loop alone does not know.
        self._ablation = AblationState.of(exercise.procedure, placed, tissues)
        moves = self._task is not None or self._ablation is not None
        self._pulls = moves and bool(exercise.laws)
        setup = TrainerSetup(exercise, placed, clock=VirtualClock(BEGIN), tissues=tissues)
        table = loop_table(setup, self._profile)
        # What stages remember is in their arrays: each attempt takes copies, shared ones once.
        self._stages, self._write = table.compute, table.write
        self._fulcrum = self._profile.fulcrum
        rig = load_rig(exercise.rig)
        spoiled = Spoiled.by(pictures_of(exercise, self._profile), rig.blur_px)
        self._spoiled = replace(spoiled, noise=noise * spoiled.noise)
        self._cameras, self._spread = self._measurements(rig)

    def score(self, skill: str, seed: int) -> Trial:
        """Let a scripted trainee of `simulation.skills` do one attempt; the same for one seed.

        What only a trainer can judge has no score where the registration errs or the cameras' noise
        is another: a trainer knows nothing of either.

        Raises:
            AcusError: for an unknown skill.
        """
        played = named(find_skill(skill).name, self._script)
        trainee = trainee_of(self._exercise, self._aimed, played, seed, self._tissues)
        rows, begin = self._rows(trainee, seed)
        trial = self._judged(rows, begin, self._exercise.assistance, played, seed)
        if trial is not None:
            return trial
        if self._only_here:
            return Trial(None, float(rows[-1, sv.TIME]) - begin)
        result = self._whole(skill, seed)
        return Trial(result.score, result.duration)

    def play(self, hand: PlayedHand, seed: int) -> PlayedTrial:
        """Let a hand do one attempt; the same for one seed, which is of the cameras' noise."""
        trainee = script_stage(hand.script, self._placed.axis)
        rows, begin = self._rows(trainee, seed, hand)
        trial = self._judged(rows, begin, self._dial(hand))
        if trial is not None:
            return PlayedTrial(trial.score, trial.duration, rows)
        looks: list[FloatArray] = []
        result = self._whole("expert", seed, hand, lambda row: looks.append(row.copy()))
        return PlayedTrial(result.score, result.duration, np.array(looks or rows))

    def _dial(self, hand: PlayedHand | None) -> float:
        return self._exercise.assistance if hand is None or hand.dial is None else hand.dial

    def _whole(
        self,
        skill: str,
        seed: int,
        hand: PlayedHand | None = None,
        watch: Callable[[FloatArray], object] = lambda row: None,
    ) -> AttemptResult:
        """Do it with a whole trainer, which judges what is not judged here."""
        risks, tissues, script = self._risks, self._tissues, self._script
        on = self._exercise, self._placed, skill, seed
        return attempt(*on, risks, False, tissues, script, hand, watch, self._pictures)

    def _judged(
        self, rows: FloatArray, begin: float, dial: float, skill: str = "", seed: int = 0
    ) -> Trial | None:
        """Score an attempt by its rows; None where only a trainer can judge it."""
        samples = self._samples(rows)
        faults = rows[rows[:, sv.TIME] > begin + GRACE, sv.FAULT]
        touching = None if self._task is None else Touching(self._task)
        steps = self._steps(samples, rows, skill, seed)
        went = TrialCourse.of(samples, begin, touching, None if steps is None else steps.aside)
        if faults.any() or went.unseen >= LOST or (self._pulls and dial != 0.0):
            return None
        samples = replace(samples, state=went.states, target=went.target)
        near = risk_marks_of(samples, self._placed, self._risks)
        felt = self._exercise.tissue is TissueSource.FIELD
        met = tissues_met_of(samples, self._placed, self._tissues, felt)
        path = trajectory(
            samples,
            self._placed,
            risks=near,
            touches=went.touches,
            met=met,
            planned=self._planned,
            scans=() if steps is None else scan_marks(steps.events),
            procedure=None if steps is None else marks_of(steps.events, samples, met, self._placed),
        )
        return Trial(self._scorer(path), float(samples.time[-1]) - begin)

    def _steps(self, samples: Samples, rows: FloatArray, skill: str, seed: int) -> StepsDone | None:
        part = self._exercise.procedure
        if part is None:
            return None
        phases = rows[:, sv.TRAINEE_PHASE]
        is_assessment = self._exercise.purpose is Purpose.ASSESSMENT
        drawn = 0 if is_assessment else seed
        patient = ScriptedPatient.of(self._case, skill, drawn, self._taking(), self._pictures)
        begin = self._placed, self._tissues, self._ablation, patient
        return steps_of_rows(part, samples, phases, *begin)

    def _taking(self) -> Taking:
        """Return the scan by which a hand watches the patient: as proposed, about the target."""
        guidance, needle = self._exercise.guidance, self._exercise.needle
        order = guidance.order(float(self._placed.plan.target_mm[2]))
        choice = replace(guidance.choice, leaves=False)
        return Taking(order, guidance, choice, needle.gauge, needle.tip)

    def truth(self, rows: FloatArray) -> Samples:
        """Return the needle as it truly was at each look, whatever the cameras saw of it."""
        samples, depth = self._samples(rows), rows[:, sv.PLANT_DEPTH]
        tip = samples.tip + (depth - samples.depth)[:, None] * samples.axis
        inside = np.where(depth > 0.0, State.INSERTING.value, State.ALIGNING.value)
        return replace(
            samples,
            state=inside.astype("<U10"),
            depth_source=np.full(len(rows), DepthSource.TRACKED.value),
            depth=depth,
            tip=tip,
            spread=None,
        )

    def _rows(
        self, trainee: Stage, seed: int, hand: PlayedHand | None = None
    ) -> tuple[FloatArray, float]:
        """Run the loop; returns its state at each look of an attempt, and when that began [s]."""
        stepped = self.stepped(trainee, seed, self._dial(hand))
        with closing(stepped):
            while stepped.now < BEGIN + LONGEST:
                until = None if hand is None else hand.covers(stepped.now - stepped.begin)
                if until is not None:
                    stepped.cover(stepped.begin + until)
                if stepped.step()[sv.TRAINEE_PHASE] == ScriptPhase.DONE:
                    break
        return np.array(stepped.rows), stepped.begin

    def stepped(
        self, hand: Stage | None, seed: int, dial: float, axis: ArrayLike = UPRIGHT
    ) -> SteppedLoop:
        """Begin an attempt that is stepped from outside; to be closed.

        Args:
            hand: what moves it; None for who steps it.
            seed: of the cameras' noise.
            dial: of the robot's help.
            axis: direction that the needle has at the beginning.
        """
        own: dict[int, FloatArray] = {}

        def fresh(stage: Stage) -> Stage:
            values = own.setdefault(id(stage.parameters), stage.parameters.copy())
            return stage._replace(parameters=values)

        cameras = self._cameras.stage(seed, self._spoiled)
        before = [cameras] if hand is None else [hand, cameras]
        table = Table.of([*before, *map(fresh, self._stages)], map(fresh, self._write))
        return SteppedLoop(table, cameras, self._profile, self._aimed, dial, axis)

    def judged(self, stepped: SteppedLoop) -> Trial | None:
        """Score what was stepped so far; None where only a trainer can judge it."""
        return self._judged(np.array(stepped.rows), stepped.begin, stepped.dial)

    def _samples(self, rows: FloatArray) -> Samples:
        """Return what a trainer keeps of these states (`session.fusion`); all as if `aligning`."""
        time, axis = rows[:, sv.TIME], rows[:, sv.AXIS]
        age = time - rows[:, sv.TRACKED_TIME]
        measured = (rows[:, sv.TRACKED_TIME] > 0.0) & (age <= TRACKER_HOLD)
        depth = np.where(measured, rows[:, sv.TRACKED_DEPTH], rows[:, sv.DEPTH])
        axis = axis / np.linalg.norm(axis, axis=1, keepdims=True)
        bend = bends_of(rows)
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
            along=rows[:, sv.AXIAL_FORCE],
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
        aims = aims if self._ablation is None else self._ablation.plans
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
