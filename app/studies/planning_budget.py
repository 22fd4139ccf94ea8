"""Study: how close together the entries lie from which paths to a target are scored.

Targets in built-in patients, five beside each other per exercise. Error: points of score by which
the best path found stays below the best that entries every 2 mm find; the worst of the targets.
"""

from collections.abc import Callable
from functools import cache
from typing import Any, Final, NamedTuple

import numpy as np

from app.core.arrays import FloatArray
from app.exercises.library import load_exercise
from app.exercises.scene import device_of, plan_of
from app.imaging import skin
from app.imaging.body import Body, find_body
from app.imaging.phantom.series import phantom_series
from app.imaging.reading import load_ct
from app.planning.limits import ReachLimits
from app.planning.paths import score_paths
from app.planning.placement import Placement
from app.studies.in_use import default_of
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION: Final[dict[str, Any]] = {
    "title": "Entries that planning help tries: how many find the best path",
    "question": "How close together must the entries lie from which paths are scored?",
    "reference": "entries every 2 mm, which is every cell of the skin that there is",
}

EXERCISES: Final = ("first-insertion", "kidney", "lung-between-ribs")
REFERENCE_MM: Final = 2.0
_STEPS_MM: Final = (3.0, 4.0, 6.0, 8.0, 12.0, 16.0)
_TARGETS: Final = 5
_ASIDE_MM: Final = 4.0
_SEEN: Final = 1.0


class EntrySearch(NamedTuple):
    """What paths are looked for in."""

    body: Body
    placement: Placement
    limits: ReachLimits
    targets_mm: FloatArray


@cache
def search(exercise: str) -> EntrySearch:
    """Return the patient of an exercise, and targets about its own, shape (n, 3) [mm]."""
    found = load_exercise(exercise)
    volume = load_ct(phantom_series(found.ct.phantom.seed if found.ct.phantom else 1))
    rng = np.random.default_rng(1)
    aside = rng.uniform(-_ASIDE_MM, _ASIDE_MM, (_TARGETS, 3))
    return EntrySearch(
        find_body(volume),
        found.placement.placement(),
        ReachLimits.of(device_of(found)),
        plan_of(found).target_mm + aside,
    )


def best_scores(where: EntrySearch, step_mm: float) -> FloatArray:
    """Score of the best path to each target from entries this far apart; 0 where all are blocked.

    Returns:
        Shape (n,), 0 to 100.
    """
    patch = skin.skin_points(where.body, step_mm)
    found = [
        score_paths(target, patch, where.body, (), where.placement, where.limits).score
        for target in where.targets_mm
    ]
    return np.array([np.nanmax(one) if np.isfinite(one).any() else 0.0 for one in found])


def _case(setting: Setting) -> Case:
    where = search(EXERCISES[int(setting.values["exercise"])])
    true = best_scores(where, REFERENCE_MM)
    return Case(where, lambda found: max(0.0, float((true - found).max())), _SEEN)


def _way(step_mm: float) -> Callable[[Case], Prepared]:
    return lambda case: Prepared(lambda: best_scores(case.data, step_mm), _TARGETS)


STUDY: Final = Study(
    error_label="points of score below the best path",
    ways=tuple(
        Way(f"{step:g} mm", "entries over the skin", _way(step), "entries this far apart", step)
        for step in _STEPS_MM
    ),
    settings=tuple(
        Setting(name, {"exercise": float(number)}) for number, name in enumerate(EXERCISES)
    ),
    case=_case,
    deadline=Limit(1.0, "1 s of waiting for the map"),
    perception=Limit(_SEEN, "1 point of 100, as the table shows it"),
    default="4 mm",
    in_use=lambda: default_of(skin.skin_points, "spacing_mm"),
)
