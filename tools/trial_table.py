"""Let every skill do every shipped exercise, and print the table of `docs/exercises.md`.

Run as `make trial`, or as `python -m tools.trial_table [NAME…] [--seeds N] [--write]`. Attempts
are kept in a file as soon as they are done, so a run that was stopped goes on where it was.
They are judged when the table is made: what only changes bands, weights or the pass mark needs no
new attempt. It ends with 1 where an exercise orders the skills in less than 95 % of the seeds, or a
novice passes or an expert fails more often than in one of twenty seeds.
"""

import argparse
import json
import os
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from functools import cache
from hashlib import sha256
from pathlib import Path

from app.compose.exercise_field import tissues_of, trial_plan
from app.compose.skill_scores import (
    SkillOutcome,
    ordered_seeds,
    outcome,
    risks_of,
)
from app.compose.trial import Trials
from app.core import paths
from app.exercises.library import library, load_exercise
from app.exercises.scene import device_of, placed_plan_of
from app.exercises.schema import Exercise
from app.scoring.result import Score
from app.scoring.version import SCORING_VERSION
from app.simulation.hands import HANDS
from app.simulation.skills import SKILLS

DOCS = Path(__file__).resolve().parents[1] / "docs" / "exercises.md"
BEGIN, END = "<!-- table of tools/trial_table.py -->", "<!-- end of the table -->"
KEPT = Path("out/trials.jsonl")
WANTED = 0.95
LITTLE = 0.05

Job = tuple[str, str, int]
"""Exercise, skill, seed."""


def shipped() -> list[str]:
    """Exercises that come with the program, the easiest first."""
    names = {file.stem for file in (paths.resources() / "exercises").glob("*.yaml")}
    found = sorted((one.level, one.id) for one in library() if one.id in names)
    return [name for _, name in found]


def kind_of_attempts(exercise: Exercise) -> str:
    """Digest of all that decides about the course of an attempt: not what only judges it."""
    document = exercise.model_dump(mode="json")
    for field in ("version", "title", "description", "level", "rules"):
        document.pop(field)
    document["tolerances"] = sorted(document["tolerances"])  # an effect may live by a metric
    text = json.dumps([document, SCORING_VERSION, repr(HANDS)], sort_keys=True)
    return sha256(text.encode()).hexdigest()[:16]


@cache
def _prepared(name: str) -> tuple[Exercise, Trials]:
    exercise = load_exercise(name)
    placed = placed_plan_of(exercise, device_of(exercise), trial_plan(exercise))
    tissues = tissues_of(exercise, placed.plan)
    return exercise, Trials(exercise, placed, risks_of(exercise), tissues)


def one_attempt(job: Job) -> str:
    """Do one attempt; returns its line of the file."""
    name, skill, seed = job
    exercise, trials = _prepared(name)
    result = trials.score(skill, seed)
    return json.dumps(
        {
            "of": kind_of_attempts(exercise),
            "exercise": name,
            "skill": skill,
            "seed": seed,
            "duration": result.duration,
            "score": None if result.score is None else result.score.document(),
        }
    )


def _kept(file: Path) -> Iterator[dict[str, object]]:
    if file.is_file():
        for line in file.read_text(encoding="utf-8").splitlines():
            with suppress(json.JSONDecodeError):  # one that a stop has cut off
                yield json.loads(line)


def collect(names: list[str], seeds: int, file: Path, workers: int) -> None:
    """Do the attempts that the file does not hold yet."""
    kinds = {name: kind_of_attempts(load_exercise(name)) for name in names}
    there = {(row["of"], row["exercise"], row["skill"], row["seed"]) for row in _kept(file)}
    jobs = [
        (name, skill, seed)
        for seed in range(1, seeds + 1)
        for name in names
        for skill in SKILLS
        if (kinds[name], name, skill, seed) not in there
    ]
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("a", encoding="utf-8") as out, ProcessPoolExecutor(workers) as pool:
        for done, line in enumerate(pool.map(one_attempt, jobs, chunksize=4), 1):
            out.write(f"\n{line}")  # before it: the last one may be cut off
            out.flush()
            if sys.stderr.isatty() or done % 100 == 0:
                print(f"{done} of {len(jobs)} attempts", file=sys.stderr)


def judged(name: str, seeds: int, file: Path) -> list[SkillOutcome]:
    """Judge the kept attempts of an exercise by its present bands; the least skilled first."""
    exercise = load_exercise(name)
    kind = kind_of_attempts(exercise)
    rows = {
        (row["skill"], row["seed"]): row
        for row in _kept(file)
        if (row["of"], row["exercise"]) == (kind, name)
    }
    found = []
    for skill in SKILLS:
        own = [rows[skill, seed] for seed in range(1, seeds + 1)]
        scores = [
            Score.from_json(json.dumps(row["score"])).recomputed(
                exercise.tolerances, exercise.rules
            )
            if row["score"]
            else None
            for row in own
        ]
        found.append(outcome(skill, scores, [float(str(row["duration"])) for row in own]))
    return found


def faults(name: str, outcomes: list[SkillOutcome]) -> list[str]:
    """Say what the exercise's bands do not separate."""
    said = []
    if (share := ordered_seeds(outcomes)) < WANTED:
        said.append(f"{name}: the skills are in their order in {share:.0%} of the seeds")
    if (passed := outcomes[0].share_passed) > LITTLE:
        said.append(f"{name}: the novice passes in {passed:.0%} of the seeds")
    if (passed := outcomes[-1].share_passed) < 1.0 - LITTLE:
        said.append(f"{name}: the expert passes in only {passed:.0%} of the seeds")
    return said


def table(result: dict[str, list[SkillOutcome]], seeds: int) -> str:
    """Write the table as Markdown: median score and share passed of each skill."""
    head = ["exercise", *SKILLS, f"in order, of {seeds} seeds"]
    lines = [" | ".join(head), " | ".join(["---"] * len(head))]
    for name, outcomes in result.items():
        cells = [
            "–" if one.quartiles is None else f"{one.quartiles[1]:.0f} ({one.share_passed:.0%})"
            for one in outcomes
        ]
        version = load_exercise(name).version
        lines.append(" | ".join([f"`{name}` {version}", *cells, f"{ordered_seeds(outcomes):.0%}"]))
    return "\n".join(f"| {line} |" for line in lines)


def write(text: str) -> None:
    """Put the table into the docs, in place of the one that is there."""
    before, rest = DOCS.read_text(encoding="utf-8").split(BEGIN)
    after = rest.split(END)[1]
    DOCS.write_text(f"{before}{BEGIN}\n{text}\n{END}{after}", encoding="utf-8")


def main() -> int:
    """Collect, print, check."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help="exercises; all shipped ones without it")
    parser.add_argument("--seeds", type=int, default=100)
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--kept", type=Path, default=KEPT, help="file of the attempts")
    parser.add_argument("--write", action="store_true", help=f"write the table into {DOCS.name}")
    asked = parser.parse_args()
    names = asked.names or shipped()
    collect(names, asked.seeds, asked.kept, asked.workers)
    found = {name: judged(name, asked.seeds, asked.kept) for name in names}
    text = table(found, asked.seeds)
    print(text)
    if asked.write:
        write(text)
    wrong = [fault for name, outcomes in found.items() for fault in faults(name, outcomes)]
    print("\n".join(wrong) or "every exercise separates the skills")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
