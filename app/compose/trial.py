"""Attempts in virtual time, without recorder and rendering: what would each skill score?

Everything that decides about a score is the program's own: the loop with the exercise's laws and
effects, the trainer with its states, the scripted hand, the metrics. Only the pictures are left
out. In their place stands a model of what the tracker measures (`SampledTracker`), and the record
is never written.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import hypot, inf
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from app.compose.desktop import load_risks, read_ct
from app.compose.needle import measured_axis, needle_scene
from app.compose.trainer import TrainerSetup, build_loop
from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.core.progress import Progress
from app.core.units import MILLIMETRE, MILLISECOND
from app.exercises.parts import OwnPlan
from app.exercises.scene import device_of, placed_plan_of, plan_of
from app.planning.plan import Plan
from app.session.context import RunContext
from app.session.fixes import DepthTrust
from app.session.recorder import Recorder
from app.session.trainer import Trainer
from app.session.withdrawal import Start
from app.simulation.skills import SKILLS
from app.simulation.trainee import ScriptPhase
from app.tracking.fix import NeedleFix
from app.tracking.health import Hiding
from app.tracking.markers.extractor import Centre
from app.tracking.optics.rig import RigProfile, load_rig
from app.tracking.simulated.scene import MarkerScene, Scene
from app.tracking.solver import FixSolver, SeenMarker

if TYPE_CHECKING:
    from app.core.arrays import FloatArray
    from app.exercises.schema import Exercise
    from app.planning.placement import PlacedPlan
    from app.scoring.result import Score
    from app.session.result import AttemptResult
    from app.session.risks import Risk

ALONG_PX: Final = 0.015
ACROSS_PX: Final = 0.02
"""Standard deviation of a marker's centre in one picture [px], along the needle as it is seen and
across it: measured in 333 rendered pictures of rig `wide`, whose noise is 4 grey values, at depths
from -15 to 108 mm and tilts up to 40°. Robust figures (1.48 times the median): rare
pictures, further off across the needle (0.035 px with them), are not modelled."""

MISSED: Final = 0.01
"""Share of pictures in which the marker is not found though it is there: 3 of 336 of them."""

NOISE_GREY: Final = 4.0
"""Noise of the pictures that these were measured in; they grow with it in proportion."""

PROCESSING: Final = 0.005
"""From a pair's arrival to its fix [s]: a followed pair takes 2 to 5 ms of one processor."""

STEP_TICKS: Final = 20
"""Ticks of the loop between two looks of the trainer, as in the program at 1 kHz."""

BEGIN: Final = 10.0
SETTLED: Final = 0.6
LONGEST: Final = 300.0
"""Virtual time [s]: of the beginning, for the cameras to be believed, and of an attempt at most."""


class SampledTracker:
    """Fixes as the tracker would give them, from where the marker truly is instead of pictures.

    The band's centre is projected into both cameras by their own models, Gaussian noise is added
    along and across the needle as the picture shows it, and the tracker's own solver makes the fix
    of it: status, covariance and a fix by one camera come from there. A camera does not see a band
    that leaves its picture or that the tube hides, and misses one of a hundred. Of a second camera
    that captures later (`skew_ms`) the tracker takes the pixel at the first's time, as this does.

    Args:
        rig: cameras and needle.
        fulcrum: P_I in world [m], shape (3,).
        scene: what stands before the cameras at a time.
        axis: the needle's direction by the robot at a time; None while it is not known.
        seed: of the noise.
    """

    def __init__(
        self,
        rig: RigProfile,
        fulcrum: FloatArray,
        scene: Scene,
        axis: Callable[[float], FloatArray | None],
        seed: int = 0,
    ) -> None:
        self._rig = rig
        self._models = rig.models
        self._fulcrum = fulcrum
        self._scene = scene
        self._axis = axis
        self._solver = FixSolver(rig, fulcrum)
        self._hiding = Hiding(rig.needle)
        self._random = np.random.default_rng([seed, 7])
        self._sd = np.array([ALONG_PX, ACROSS_PX]) * max(rig.noise_grey, 1.0) / NOISE_GREY
        self._delay = rig.latency_ms * MILLISECOND + PROCESSING
        self._next = inf

    def begin(self, now: float) -> None:
        """Capture from `now` [s] on."""
        self._next = now

    def due(self, now: float) -> list[NeedleFix]:
        """Return the fixes that have come since they were last asked for, at `now` [s]."""
        fixes = []
        while self._next + self._delay <= now + 1e-9:
            fixes.append(self.fix(self._next))
            self._next += 1.0 / self._rig.rate_hz
        return fixes

    def fix(self, time: float) -> NeedleFix:
        """Return the fix of pictures captured at a time [s]."""
        scene = self._scene(time)
        seen = (self._sighting(0, scene), self._sighting(1, scene))
        return self._hiding.judge(self._solver.solve(seen, self._axis(time), time))

    def _sighting(self, camera: int, scene: MarkerScene) -> SeenMarker | None:
        model, noise = self._models[camera], self._random.standard_normal(2)
        missed = self._random.random() < MISSED
        if missed or not scene.visible or self._hidden(scene):
            return None
        ends = (scene.p_world, scene.p_world + MILLIMETRE * scene.axis_world)
        uv, found = model.project(np.array(ends))
        (u, v), (u_on, v_on) = uv.tolist()
        width, height = model.image_size
        if not (found.all() and 0.0 <= u <= width - 1.0 and 0.0 <= v <= height - 1.0):
            return None
        length = hypot(u_on - u, v_on - v)
        c, s = ((u_on - u) / length, (v_on - v) / length) if length > 1e-9 else (1.0, 0.0)
        a, b = self._sd * noise
        var_a, var_b = self._sd**2
        mixed = c * s * (var_a - var_b)
        spread = [
            [c * c * var_a + s * s * var_b, mixed],
            [mixed, s * s * var_a + c * c * var_b],
        ]
        centre = np.array([u + c * a - s * b, v + s * a + c * b])
        return SeenMarker(centre, np.array(spread), Centre.BAND)

    def _hidden(self, scene: MarkerScene) -> bool:
        hidden = self._rig.needle.hidden_mm
        beyond = float((scene.p_world - self._fulcrum) @ scene.axis_world) / MILLIMETRE
        return hidden is not None and hidden[0] < beyond < hidden[1]


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


def trial_plan(exercise: Exercise) -> Plan:
    """Return the plan that trials follow; where the student plans, the phantom's own entry.

    Raises:
        ExerciseError: if the student plans on a CT that is no phantom.
    """
    if isinstance(exercise.plan, OwnPlan) and exercise.ct.phantom is not None:
        return plan_of(exercise.model_copy(update={"plan": "phantom_default"}))
    return plan_of(exercise)


def risks_of(exercise: Exercise, progress: Progress | None = None) -> tuple[Risk, ...]:
    """Read an exercise's structures of risk onto its CT; none where it names none.

    Raises:
        AcusError: if the CT or a file cannot be read, or a structure that is named is missing.
        Cancelled: if `progress` was cancelled.
    """
    if not any(part.risks for part in exercise.structures):
        return ()
    progress = progress or Progress()
    volume = read_ct(exercise, progress.part(0.0, 0.6))
    return load_risks(exercise, volume, progress.part(0.6, 1.0))


def attempt(
    exercise: Exercise,
    placed: PlacedPlan,
    skill: str,
    seed: int,
    risks: tuple[Risk, ...] = (),
) -> AttemptResult:
    """Let a scripted trainee do one attempt in virtual time; nothing is written.

    Args:
        exercise: with the assistance that it begins with.
        placed: its plan in the robot's frame.
        skill: a name of `skills.SKILLS`.
        seed: of the trainee and of the tracker's noise.
        risks: structures that the needle has to keep away from.

    Raises:
        AcusError: if a profile, an effect or the path cannot be used; says which and why.
    """
    profile, clock = device_of(exercise), VirtualClock(BEGIN)
    setup = TrainerSetup(exercise, placed, skill=skill, seed=seed, clock=clock)
    loop, rig = build_loop(setup, profile), load_rig(exercise.rig)
    scene = needle_scene(loop, profile, rig.needle.marker_offset)
    fulcrum = profile.pantograph.fulcrum
    tracker = SampledTracker(rig, fulcrum, scene, measured_axis(loop), seed)

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
class SkillOutcome:
    """What one skill scored in an exercise.

    Attributes:
        skill: its name.
        totals: scores of 0 to 100, one per seed; NaN where an attempt was void or had no score.
        passed: whether each passed.
        duration: median virtual time of an attempt [s].
    """

    skill: str
    totals: tuple[float, ...]
    passed: tuple[bool, ...]
    duration: float

    @property
    def quartiles(self) -> tuple[float, float, float] | None:
        """Lower quartile, median and upper quartile of the scores; None where none counts."""
        scores = np.array(self.totals)
        scores = scores[np.isfinite(scores)]
        if not len(scores):
            return None
        low, middle, high = np.percentile(scores, [25.0, 50.0, 75.0]).tolist()
        return low, middle, high

    @property
    def void(self) -> int:
        """How many attempts had no score."""
        return int(np.count_nonzero(~np.isfinite(self.totals)))

    @property
    def share_passed(self) -> float:
        """Share of all attempts that passed, 0 to 1."""
        return float(np.mean(self.passed))


def outcome(skill: str, scores: Sequence[Score | None], durations: Sequence[float]) -> SkillOutcome:
    """Sum up a skill's attempts, one score and one duration [s] per seed."""
    return SkillOutcome(
        skill,
        tuple(_total(score) for score in scores),
        tuple(score is not None and score.passed for score in scores),
        float(np.median(durations)),
    )


def run_trial(
    exercise: Exercise,
    seeds: int = 20,
    skills: Sequence[str] = tuple(SKILLS),
    risks: tuple[Risk, ...] = (),
    progress: Progress | None = None,
) -> tuple[SkillOutcome, ...]:
    """Let every skill do the exercise once per seed; the least skilled first.

    An attempt that the robot's safety ends counts as one without a score.

    Raises:
        AcusError: if the exercise cannot be used at all; says why.
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    placed = placed_plan_of(exercise, device_of(exercise), trial_plan(exercise))
    outcomes = []
    for number, skill in enumerate(skills):
        part = progress.part(number / len(skills), (number + 1) / len(skills))
        results = []
        for seed in range(1, seeds + 1):
            part.report((seed - 1) / seeds, skill)
            results.append(attempt(exercise, placed, skill, seed, risks))
        scores = [result.score for result in results]
        outcomes.append(outcome(skill, scores, [result.duration for result in results]))
    progress.report(1.0)
    return tuple(outcomes)


def ordered_share(outcomes: Sequence[SkillOutcome]) -> float:
    """Share of neighbouring skills' attempts, every seed with every other, that are ordered right.

    A tie counts as half, as in a rank test; an attempt without a score is below all others.
    """
    shares = []
    for worse, better in pairwise(outcomes):
        low, high = (np.nan_to_num(np.array(one.totals), nan=-1.0) for one in (worse, better))
        more = high[:, None] - low[None, :]
        shares.append(np.mean((more > 0.0) + 0.5 * (more == 0.0)))
    return float(np.mean(shares)) if shares else 1.0


def ordered_seeds(outcomes: Sequence[SkillOutcome]) -> float:
    """Share of the seeds in which every skill scores more than the one below it; no tie counts.

    A seed gives all skills the same tracker noise and begins the same row of random numbers for
    their scripts, so skills are compared in pairs on what is nearly the same attempt. That is a
    weaker question than `ordered_share`, which compares any attempt of one with any of the other.
    """
    if len(outcomes) < 2:
        return 1.0
    totals = np.array([np.nan_to_num(np.array(one.totals), nan=-1.0) for one in outcomes])
    return float((np.diff(totals, axis=0) > 0.0).all(axis=0).mean())


def _total(score: Score | None) -> float:
    return float("nan") if score is None or score.total is None else score.total
