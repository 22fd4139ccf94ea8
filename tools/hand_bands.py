"""Fits bands of the mouse to two scripts at the window, and checks them on other seeds.

    python -m tools.hand_bands [EXERCISE…] --fit 9000 9020 --check 8000 8020 --file attempts.jsonl

By contrasting groups (`scoring.contrasting`): attempts of a careful script and of a hasty one, who
look and act through the same hand (`compose.pointer_hands`), of each metric that says how the
needle went, not where it ended. Where the hasty are no worse (they are quick), nothing parts them:
the tolerance stays. These are scripts; attempts of people give bands by `acus exercise bands`.

Attempts are kept in the file, a line each, and not done again. Where bands would let the hasty come
above or the careful below what the exercise is meant to give (`MOST`, `LEAST`), the stricter of
each knot and the tolerance's is what is proposed.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, Final

import numpy as np

from app.compose.pointer_trial import pointer_attempt
from app.compose.skill_scores import Resolved, risks_of
from app.exercises.hand_bands import BandsSource, HandBands, judged_by_hand
from app.exercises.library import load_exercise
from app.exercises.schema import Exercise
from app.scoring.contrasting import contrasted
from app.scoring.result import Score
from app.scoring.rows import REACHING
from app.scoring.tolerance import Bands

EXERCISES: Final = ("first-insertion", "kidney", "breathing-liver")
CAREFUL, HASTY = "careful", "hasty"
MOST: Final = {1: 80.0, 2: 80.0}
"""Most that the hasty may have in the median, by level."""

MOST_ABOVE: Final = 70.0
"""From level 3 on."""

LEAST: Final = 90.0
"""Least that the careful must have in the median."""


def attempts(file: Path, names: Sequence[str], seeds: Sequence[int]) -> None:
    """Do the attempts that the file does not hold yet."""
    there = {(row["name"], row["hand"], row["seed"]) for row in _rows(file)}
    for name in names:
        exercise = load_exercise(name)
        wanted = [
            (hand, seed)
            for seed in seeds
            for hand in (HASTY, CAREFUL)
            if (name, hand, seed) not in there
        ]
        if not wanted:
            continue
        on, risks = Resolved.of(exercise), risks_of(exercise)
        with file.open("a", encoding="utf-8") as out:
            for hand, seed in wanted:
                done = pointer_attempt(on.exercise, on.placed, hand, seed, risks, on.tissues)
                document = None if done.score is None else done.score.document()
                row = {"name": name, "hand": hand, "seed": seed, "document": document}
                out.write(json.dumps(row) + "\n")
                out.flush()


def _rows(file: Path) -> Iterator[dict[str, Any]]:
    if file.is_file():
        for line in file.read_text(encoding="utf-8").splitlines():
            with suppress(json.JSONDecodeError):  # one that a stop has cut off
                yield json.loads(line)


def scores(file: Path, name: str, hand: str, seeds: Sequence[int]) -> list[Score]:
    """Return the scores of a hand at an exercise that the file holds."""
    return [
        Score.from_json(json.dumps(row["document"]))
        for row in _rows(file)
        if row["name"] == name and row["hand"] == hand and row["seed"] in seeds and row["document"]
    ]


def proposed(exercise: Exercise, careful: Sequence[Score], hasty: Sequence[Score]) -> HandBands:
    """Fit bands of all metrics that count, but for where the needle ended.

    Raises:
        ValueError: if nothing is proposed.
    """
    metrics = {}
    for name, limits in exercise.tolerances.items():
        if name in REACHING or limits.higher_is_better or not limits.weight:
            continue
        groups = [_values(group, name) for group in (careful, hasty)]
        bands = contrasted(*groups) if all(groups) else None
        spans = " | ".join(map(_quantiles, groups))
        print(f"  {name}: {spans} -> {_words(bands)}")
        if bands is not None:
            metrics[name] = bands
    return HandBands(source=BandsSource.SCRIPTS, metrics=metrics)


def _stricter(exercise: Exercise, bands: HandBands) -> HandBands:
    """Return bands with the smaller of each knot and the tolerance's."""
    metrics = {}
    for name, own in bands.metrics.items():
        knots = map(min, own.knots, exercise.tolerances[name].knots)
        named = dict(zip(("expert", "good", "pass", "zero"), knots, strict=True))
        metrics[name] = Bands.model_validate(named)
        print(f"  {name}: {_words(metrics[name])}")
    return bands.model_copy(update={"metrics": metrics})


def checked(
    exercise: Exercise, bands: HandBands | None, careful: Sequence[Score], hasty: Sequence[Score]
) -> bool:
    """Print what both have by some bands; return whether it is what the exercise means to give."""
    tolerances = judged_by_hand(exercise.tolerances, bands)
    medians = []
    for group in (hasty, careful):
        judged = [score.recomputed(tolerances, exercise.rules) for score in group]
        totals = [0.0 if one.total is None else one.total for one in judged]
        medians.append(float(np.median(totals)))
        passed = sum(one.passed for one in judged)
        print(f"    median {medians[-1]:.1f}, {passed} of {len(judged)} passed", end=";")
    print()
    return medians[0] <= MOST.get(exercise.level, MOST_ABOVE) and medians[1] >= LEAST


def _values(group: Sequence[Score], name: str) -> list[float]:
    rows = (row for score in group for row in score.rows if row.name == name)
    return [abs(row.value) for row in rows if row.value is not None]


def _quantiles(values: Sequence[float]) -> str:
    if not values:
        return "none"
    return " ".join(f"{one:.2f}" for one in np.percentile(values, [5, 50, 95]))


def _words(bands: Bands | None) -> str:
    if bands is None:
        return "nothing parts them: the tolerance stays"
    named: Mapping[str, float] = dict(
        zip(("expert", "good", "pass", "zero"), bands.knots, strict=True)
    )
    return "{" + ", ".join(f"{name}: {knot:g}" for name, knot in named.items()) + "}"


def main() -> None:
    """Do what attempts are missing, fit, check, and print."""
    parser = argparse.ArgumentParser(description="Fit bands of the mouse to two scripts.")
    parser.add_argument("exercise", nargs="*", default=list(EXERCISES))
    parser.add_argument("--fit", nargs=2, type=int, default=(9000, 9020), metavar="SEED")
    parser.add_argument("--check", nargs=2, type=int, default=(8000, 8020), metavar="SEED")
    parser.add_argument("--file", type=Path, default=Path("attempts.jsonl"))
    parser.add_argument("--kept", action="store_true", help="do none that the file lacks")
    given = parser.parse_args()
    fit, check = range(*given.fit), range(*given.check)
    if set(fit) & set(check):
        parser.error("bands are checked on seeds that they were not fitted to")
    if not given.kept:
        attempts(given.file, given.exercise, (*fit, *check))
    for name in given.exercise:
        exercise = load_exercise(name)
        print(f"{name}: 5, 50, 95 % of careful | hasty, seeds {fit.start} to {fit.stop - 1}")
        groups = [scores(given.file, name, hand, fit) for hand in (CAREFUL, HASTY)]
        print(f"  {len(groups[0])} careful attempts, {len(groups[1])} hasty ones")
        with suppress(ValueError):
            bands = proposed(exercise, *groups)
            held = [scores(given.file, name, hand, check) for hand in (CAREFUL, HASTY)]
            print(f"  seeds {check.start} to {check.stop - 1}, hasty; careful:")
            checked(exercise, None, *held)
            if not checked(exercise, bands, *held):
                print("  not what the exercise is meant to give; the stricter of both:")
                checked(exercise, _stricter(exercise, bands), *held)


if __name__ == "__main__":
    main()
