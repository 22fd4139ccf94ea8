"""Exercises, attempts of scripted hands at them in virtual time, and scores."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from acus._records import Record, record_of, recording_of
from app.core.messages import sentence
from app.exercises.library import library, load_exercise
from app.exercises.schema import Exercise

if TYPE_CHECKING:
    from app.scoring.result import Score

__all__ = ["Trial", "exercise", "exercises", "score", "skills", "try_exercise"]


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """An attempt of a scripted hand.

    Attributes:
        exercise: id of the exercise.
        skill: name of the hand's skill.
        seed: of the hand and of the cameras' noise.
        record: the attempt as arrays; it is in no file.
        score: None if the attempt cannot be scored.
        unscored: why not; empty if it is.
    """

    exercise: str
    skill: str
    seed: int
    record: Record
    score: Score | None
    unscored: str


def exercises() -> tuple[Exercise, ...]:
    """Return all exercises that can be used, shipped and the user's own, by level."""
    return library().exercises


def exercise(name_or_path: str | Path) -> Exercise:
    """Return an exercise by its id, by `id@version`, or by the path of its YAML file.

    Raises:
        AcusError: if there is none, naming those that there are, or its file cannot be used.
    """
    return load_exercise(name_or_path)


def skills() -> tuple[str, ...]:
    """Return the names of the scripted hands' skills, the least skilled first."""
    from app.simulation.skills import SKILLS

    return tuple(SKILLS)


def try_exercise(exercise: Exercise | str | Path, skill: str = "expert", seed: int = 1) -> Trial:
    """Let a scripted hand make one attempt in virtual time; nothing is written.

    Robot, cameras and tissue are simulated as in the program; the cameras' fixes are drawn, not
    rendered. The same seed gives the same attempt. Takes a few seconds; the first call on a
    computer compiles kernels for a minute or two.

    Args:
        exercise: with the assistance that it begins with; its id or file will do.
        skill: one of `skills()`.
        seed: of the hand and of the cameras' noise.

    Raises:
        AcusError: if the skill is none, or the exercise cannot be used; says why.
    """
    from app.compose.exercise_ct import read_ct
    from app.compose.exercise_field import resolve_tissue, tissues_of, trial_plan
    from app.compose.skill_scores import risks_of
    from app.compose.trial import attempt
    from app.exercises.parts import LayersFrom
    from app.exercises.scene import device_of, placed_plan_of
    from app.exercises.tissue import with_tissue
    from app.session.errors import SessionError

    chosen = exercise if isinstance(exercise, Exercise) else load_exercise(exercise)
    placed = placed_plan_of(chosen, device_of(chosen), trial_plan(chosen))
    if chosen.layers_from is LayersFrom.CT:
        chosen = with_tissue(chosen, read_ct(chosen), placed.plan)
    tissues = tissues_of(chosen, placed.plan)
    chosen, _ = resolve_tissue(chosen, placed, tissues)
    result = attempt(chosen, placed, skill, seed, risks_of(chosen), tissues=tissues)
    if result.recording is None:
        raise SessionError(
            sentence(
                "the attempt at {chosen_id} by {skill}, seed {seed}, left no samples",
                chosen_id=chosen.id,
                skill=skill,
                seed=seed,
            )
        )
    record = record_of(result.recording)
    return Trial(chosen.id, skill, seed, record, result.score, result.unscored)


def score(record: Record, exercise: Exercise | str | Path | None = None) -> Score:
    """Score an attempt by today's rules.

    Args:
        record: of a finished attempt.
        exercise: whose tolerances and rules it is judged by; the attempt's own where None.

    Raises:
        AcusError: if the attempt was not finished, or the record holds too little to score it.
    """
    from app.scoring.score import score as scored
    from app.session.errors import SessionError
    from app.session.machine import FINAL
    from app.session.scored import scorer
    from app.session.verify import judged_by, state_of, written_score

    recording = recording_of(record)
    if state_of(recording) not in {state.value for state in FINAL}:
        raise SessionError(
            sentence(
                "{record_id} was not finished: only ended attempts are scored", record_id=record.id
            )
        )
    path = recording.trajectory()
    if exercise is None:
        return scored(path, *judged_by(recording, written_score(recording)[0]))
    judge = exercise if isinstance(exercise, Exercise) else load_exercise(exercise)
    return scorer(judge)(path)
