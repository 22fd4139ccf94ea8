"""What each skill scores in an exercise, by many attempts in virtual time (`compose.trial`)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from app.compose.exercise_ct import load_risks, read_ct
from app.compose.exercise_field import resolve_tissue, tissues_of, trial_plan
from app.compose.trial import Trials
from app.core.progress import Progress
from app.exercises.parts import LayersFrom
from app.exercises.scene import device_of, placed_plan_of
from app.exercises.tissue import with_tissue
from app.simulation.hands import Script
from app.simulation.skills import SKILLS

if TYPE_CHECKING:
    from app.exercises.schema import Exercise
    from app.scoring.result import Score
    from app.session.risks import Risk


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
        """Return how many attempts had no score."""
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
    script: Script = Script.HAND,
) -> tuple[SkillOutcome, ...]:
    """Let every skill do the exercise once per seed; the least skilled first.

    An attempt that the robot's safety ends counts as one without a score.

    Raises:
        AcusError: if the exercise cannot be used at all; says why.
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    placed = placed_plan_of(exercise, device_of(exercise), trial_plan(exercise))
    if exercise.layers_from is LayersFrom.CT:
        exercise = with_tissue(exercise, read_ct(exercise), placed.plan)
    tissues = tissues_of(exercise, placed.plan)
    exercise, _ = resolve_tissue(exercise, placed, tissues)
    trials, outcomes = Trials(exercise, placed, risks, tissues, script), []
    for number, skill in enumerate(skills):
        part = progress.part(number / len(skills), (number + 1) / len(skills))
        results = []
        for seed in range(1, seeds + 1):
            part.report((seed - 1) / seeds, skill)
            results.append(trials.score(skill, seed))
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
        low, high = (np.nan_to_num(np.array(skill.totals), nan=-1.0) for skill in (worse, better))
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
    totals = np.array([np.nan_to_num(np.array(skill.totals), nan=-1.0) for skill in outcomes])
    return float((np.diff(totals, axis=0) > 0.0).all(axis=0).mean())


def _total(score: Score | None) -> float:
    return float("nan") if score is None or score.total is None else score.total
