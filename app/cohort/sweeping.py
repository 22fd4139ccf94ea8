"""Sweeps: an exercise over a grid, each attempt in virtual time (`compose.trial`).

A part is up to `SEEDS` seeds of one cell, so that more seeds, or more values of an axis, leave the
parts that are there as they are.
"""

from __future__ import annotations

import json
import time
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from app.cohort.grid import SweepCell, SweepGrid
from app.cohort.running import Crew, Made, RunOutcome, WorkPart, run
from app.cohort.table import Columns, Row
from app.compose.skill_scores import Resolved, risks_of
from app.compose.trial import Trials
from app.core.progress import Progress
from app.core.transform import RigidTransform
from app.exercises.library import load_exercise
from app.exercises.schema import Exercise
from app.scoring.metrics import available
from app.simulation.hands import Script

if TYPE_CHECKING:
    from app.planning.placement import PlacedPlan
    from app.session.risks import Risk

SEEDS: Final = 8
"""Of a cell in one part: a quarter of a minute of one processor."""

UNJUDGED: Final = "only a whole trainer could judge it: the robot stopped, or nobody saw the needle"

_FIRST: Final[Columns] = {
    "exercise": str,
    "version": int,
    "skill": str,
    "device": str,
    "tissue": str,
    "registration_error_mm": float,
    "tracking_noise": float,
    "breathing_mm": float,
    "assistance": float,
}
_THEN: Final[Columns] = {
    "seed": int,
    "total": float,
    "total_sd": float,
    "passed": bool,
    "void_reason": str,
    "duration_s": float,
}


def sweep(grid: SweepGrid, out: Path, crew: Crew, progress: Progress | None = None) -> RunOutcome:
    """Do every attempt of a grid and write their table.

    Raises:
        CohortError: if the exercise cannot be so, the table not be written, or nobody works.
        AcusError: if the exercise, its CT or a profile cannot be used; says why.
        Cancelled: if `progress` was cancelled.
    """
    exercise = load_exercise(grid.exercise)
    names = tuple(grid.effects)
    files = _files(exercise)
    parts, document, of = [], {}, None
    for cell in grid.cells(exercise):
        if cell.exercise is not of:  # one document for all cells that share it
            of, document = cell.exercise, cell.exercise.model_dump(mode="json", by_alias=True)
        for seeds in _blocks(grid.every_seed):
            parts.append(WorkPart(_attempts, _given(cell, document, files, seeds), len(seeds)))
    return run(parts, columns(names), out, crew, progress)


def _files(exercise: Exercise) -> list[list[str]]:
    """Name the files that the patient is made of, with size and digest or time; none of a phantom.

    A CT is told by the sizes and times of its files: reading it all would take longer than a part.
    """
    places = [part.file for part in exercise.structures]
    places += [exercise.ct.folder] if exercise.ct.folder is not None else []
    found = []
    for place in (place for place in places if place.exists()):  # reading says what is missing
        for file in sorted(Path(place).rglob("*")) if Path(place).is_dir() else [Path(place)]:
            stat = file.stat()
            found.append([str(file), str(stat.st_size), str(stat.st_mtime_ns)])
    return found


def columns(effects: tuple[str, ...] = ()) -> Columns:
    """Return the columns of the table: the cell, the score, then every metric's value."""
    own = [name for name, metric in available().items() if metric.is_own]
    axes = dict.fromkeys(effects, float)
    return {**_FIRST, **axes, **_THEN, **{f"value_{name}": float for name in own}}


def displaced(placed: PlacedPlan, distance: float, seed: int) -> PlacedPlan:
    """Return where the patient truly lies if the registration errs by a distance [m].

    He is shifted whole; the direction is drawn by the seed, every direction of space alike.
    """
    way = np.random.default_rng([seed, 11]).standard_normal(3)
    shift = distance * way / np.linalg.norm(way)
    T_world_patient = placed.T_world_patient
    return replace(
        placed,
        T_world_patient=RigidTransform(
            T_world_patient.rotation, T_world_patient.translation + shift
        ),
        p_entry=placed.p_entry + shift,
        p_target=placed.p_target + shift,
    )


def _blocks(seeds: tuple[int, ...]) -> list[tuple[int, ...]]:
    return [seeds[begin : begin + SEEDS] for begin in range(0, len(seeds), SEEDS)]


def _given(
    cell: SweepCell, document: dict[str, Any], files: list[list[str]], seeds: tuple[int, ...]
) -> dict[str, Any]:
    return {
        "exercise": document,
        "files": files,
        "skill": cell.skill,
        "script": cell.script.value,
        "registration_error": cell.registration_error,
        "tracking_noise": cell.tracking_noise,
        "values": dict(cell.values),
        "seeds": list(seeds),
    }


@lru_cache(maxsize=2)
def _patient(document: str) -> tuple[Resolved, tuple[Risk, ...]]:
    exercise = Exercise.model_validate_json(document)
    return Resolved.of(exercise), risks_of(exercise)


@lru_cache(maxsize=2)
def _trials(document: str, script: str, noise: float) -> Trials:
    on, risks = _patient(document)
    return Trials(on.exercise, on.placed, risks, on.tissues, Script(script), noise=noise)


def _attempts(given: dict[str, Any]) -> Made:
    """Do some seeds of a cell."""
    document = json.dumps(given["exercise"])  # in its order: scores are sums in it
    error, noise = given["registration_error"], given["tracking_noise"]
    begin = time.process_time()
    on, risks = _patient(document)
    trials = None if error else _trials(document, given["script"], noise)
    ready = time.process_time()
    rows = []
    for seed in given["seeds"]:
        if error:
            true = displaced(on.placed, error, seed)
            trials = Trials(
                on.exercise,
                true,
                risks,
                on.tissues,
                Script(given["script"]),
                aimed=on.placed,
                noise=noise,
            )
        assert trials is not None  # noqa: S101  (made above where the registration does not err)
        rows.append(_row(given, seed, trials))
    return rows, ready - begin, time.process_time() - ready


def _row(given: dict[str, Any], seed: int, trials: Trials) -> Row:
    trial, exercise = trials.score(given["skill"], seed), given["exercise"]
    score = trial.score
    row = given["values"] | {
        "exercise": exercise["id"],
        "version": exercise["version"],
        "seed": seed,
        "duration_s": trial.duration,
        "passed": score is not None and score.passed,
    }
    if score is None:
        return row | {"void_reason": UNJUDGED}
    measured = {f"value_{one.name}": one.value for one in score.rows}
    return (
        row
        | measured
        | {
            "total": score.total,
            "total_sd": score.total_sd,
            "void_reason": str(score.void_reason),
        }
    )
