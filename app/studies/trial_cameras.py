"""Study: what of the program has to run when only the score of an attempt is wanted.

Scripted trainees at the exercise `first-insertion`, the same hand in each way: the loop alone with
cameras as one of its stages, a whole trainer with sampled fixes, and a whole trainer with rendered
and tracked pictures, which is the reference. Lent by `compose.trial`.
"""

from collections.abc import Callable
from functools import cache
from typing import Any, Final

from app.exercises.library import load_exercise
from app.exercises.scene import device_of, placed_plan_of
from app.exercises.tissue import in_layers
from app.simulation.hands import Script
from app.studies.in_use import called
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION: Final[dict[str, Any]] = {
    "title": "Trials: the loop alone, a trainer, a trainer with rendered pictures",
    "question": "How much of the program must run to know what a skill would score?",
    "reference": "the whole program with rendered pictures; the same hand, other noise",
}

_EXERCISE: Final = "first-insertion"
_SEEDS: Final = (1, 2)
_POINTS: Final = 1.0

Lent = tuple[Callable[..., Any], Callable[..., Any], Callable[..., Any]]


@cache
def _exercise(trial_plan: Callable[..., Any]) -> tuple[Any, Any]:
    exercise = in_layers(load_exercise(_EXERCISE))
    return exercise, placed_plan_of(exercise, device_of(exercise), trial_plan(exercise))


@cache
def _whole(lent: Lent, skill: str) -> tuple[float, ...]:
    """Totals of the reference."""
    _, attempt, plan = lent
    return tuple(
        attempt(*_exercise(plan), skill, seed, pictures=True, script=Script.QUICK).score.total
        for seed in _SEEDS
    )


def _case(setting: Setting, *lent: Callable[..., Any]) -> Case:
    trials, attempt, plan, _ = lent
    true = _whole((trials, attempt, plan), setting.name)
    return Case(
        (setting.name, trials, attempt, plan),
        lambda totals: max(abs(a - b) for a, b in zip(totals, true, strict=True)),
        _POINTS,
    )


def _alone(case: Case) -> Prepared:
    skill, trials, _, plan = case.data
    ready = trials(*_exercise(plan), script=Script.QUICK)
    return Prepared(lambda: [ready.score(skill, seed).score.total for seed in _SEEDS], len(_SEEDS))


def _trainer(pictures: bool) -> Callable[[Case], Prepared]:
    def prepare(case: Case) -> Prepared:
        skill, _, attempt, plan = case.data
        return Prepared(
            lambda: [
                attempt(
                    *_exercise(plan), skill, seed, pictures=pictures, script=Script.QUICK
                ).score.total
                for seed in _SEEDS
            ],
            len(_SEEDS),
        )

    return prepare


def _in_use(*lent: Callable[..., Any]) -> object:
    built: Any = called(lent[3], "Trials")
    return built.__name__


STUDY: Final = Study(
    error_label="error of the total score [points of 100]",
    ways=(
        Way("loop", "loop alone", _alone, "cameras as a stage of the loop", "Trials"),
        Way("trainer", "trainer", _trainer(False), "sampled fixes, all phases", "attempt"),
        Way("pictures", "pictures", _trainer(True), "rendered and tracked", "pictures"),
    ),
    settings=tuple(Setting(skill, {}) for skill in ("novice", "competent", "expert")),
    case=_case,
    deadline=Limit(0.2, "0.2 s: a hundred attempts in 20 s"),
    perception=Limit(_POINTS, "1 point of 100"),
    default="loop",
    because="twenty attempts of each skill in seconds",
    in_use=_in_use,
    borrows=(
        "app.compose.trial:Trials",
        "app.compose.trial:attempt",
        "app.compose.exercise_field:trial_plan",
        "app.compose.skill_scores:skill_outcomes",
    ),
)
