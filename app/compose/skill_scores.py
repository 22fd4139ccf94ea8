"""What each skill scores in an exercise, by many attempts in virtual time (`compose.trial`)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Protocol, Self

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
    from app.imaging.field import TissueField
    from app.planning.placement import PlacedPlan
    from app.scoring.result import Score
    from app.session.risks import Risk
    from app.session.scripted_answers import Pictures


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


@dataclass(frozen=True, slots=True, eq=False)
class Resolved:
    """An exercise as attempts at it need it.

    Attributes:
        exercise: with its layers and its tissue.
        placed: its plan in the robot's frame.
        tissues: field of the patient; None without one.
        pictures: makes control scans, where complications are seen in them; else None.
    """

    exercise: Exercise
    placed: PlacedPlan
    tissues: TissueField | None
    pictures: Pictures | None = None

    @classmethod
    def of(cls, exercise: Exercise) -> Self:
        """Read what the exercise takes from its CT.

        Raises:
            AcusError: if the exercise cannot be used; says why.
        """
        placed = placed_plan_of(exercise, device_of(exercise), trial_plan(exercise))
        if exercise.layers_from is LayersFrom.CT:
            exercise = with_tissue(exercise, read_ct(exercise), placed.plan)
        tissues = tissues_of(exercise, placed.plan)
        exercise, _ = resolve_tissue(exercise, placed, tissues)
        asked, pictures = exercise.procedure, None
        if asked is not None and asked.complications is not None:
            volume = read_ct(exercise)
            pictures = lambda scan: scan.picture(volume, tissues)  # noqa: E731
        return cls(exercise, placed, tissues, pictures)


class Attempted(Protocol):
    """An attempt that is over."""

    @property
    def score(self) -> Score | None:
        """Return its score; None where it could not be scored."""

    @property
    def duration(self) -> float:
        """Return how long it took [s]."""


def run_trial(
    players: Sequence[str],
    play: Callable[[str, int], Attempted],
    seeds: int = 20,
    progress: Progress | None = None,
) -> tuple[SkillOutcome, ...]:
    """Let every player play once per seed.

    An attempt that the robot's safety ends counts as one without a score.

    Args:
        players: by name.
        play: does an attempt of a player with a seed.
        seeds: how many; they are 1 and on.
        progress: of all attempts.

    Raises:
        Cancelled: if `progress` was cancelled.
    """
    progress, outcomes = progress or Progress(), []
    for number, player in enumerate(players):
        part = progress.part(number / len(players), (number + 1) / len(players))
        results = []
        for seed in range(1, seeds + 1):
            part.report((seed - 1) / seeds, player)
            results.append(play(player, seed))
        scores = [result.score for result in results]
        outcomes.append(outcome(player, scores, [result.duration for result in results]))
    progress.report(1.0)
    return tuple(outcomes)


def skill_outcomes(
    exercise: Exercise,
    seeds: int = 20,
    skills: Sequence[str] = tuple(SKILLS),
    risks: tuple[Risk, ...] = (),
    progress: Progress | None = None,
    script: Script = Script.HAND,
) -> tuple[SkillOutcome, ...]:
    """Let every skill do the exercise once per seed; the least skilled first.

    Raises:
        AcusError: if the exercise cannot be used at all; says why.
        Cancelled: if `progress` was cancelled.
    """
    on = Resolved.of(exercise)
    trials = Trials(on.exercise, on.placed, risks, on.tissues, script, pictures=on.pictures)
    return run_trial(skills, trials.score, seeds, progress)


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
