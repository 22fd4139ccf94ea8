"""Survey: is there an attempt that passes and did what no needle may?

A search (`attacks.search`) attacks exercises: entry, path, motion, timing, withdrawals, dial, views
and covered cameras. It is paid by the score and looks for what ought not to be paid: a needle that
truly met bone, vessel, gut, heart or lung and passes, one that passes without reaching the target,
points for nothing. `compose.attacked` plays the attempts in virtual time and tells the truth, by a
walk and by the loop's own state; attempts about which these two differ are listed too.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Final, Protocol

from app.core.progress import Progress
from app.exercises.library import library
from app.studies.attacks.attack import Attack
from app.studies.attacks.search import (
    AttackJournal,
    AttackVerdict,
    Hole,
    TriedAttack,
    key_of,
    search,
    worst,
)
from app.studies.findings import Cell, Findings, Sheet, Survey

DECLARATION: Final[dict[str, Any]] = {
    "title": "Adversary: attempts that are paid and ought not to be",
    "question": "Does an attempt pass that meets what no needle may, or reaches nothing?",
    "reference": "the true tip, walked through the patient's tissue field",
}

EVALUATIONS: Final = 200
"""Attempts at each exercise, where no number is asked for."""

QUICK: Final = 20

SUMMARY: Final = (
    "exercise",
    "attempts",
    "known before",
    "passed",
    "best total",
    *(f"{hole}: attempts" for hole in Hole),
    "walk and loop differ",
    "camera model",
)

DIFFERENCES: Final = ("exercise", "difference", "attempts", "first attempt")
"""Columns of what the judgement's walk and the loop tell otherwise."""

SHOWN: Final = ("exercise", "hole", "total", "met", "judged", "nearest [mm]", "attempt")


class Target(Protocol):
    """What the study needs of an exercise: see `compose.attacked.Attacked`."""

    @property
    def id(self) -> str:
        """Name of the exercise."""

    @property
    def cameras(self) -> str:
        """Model of the cameras, in words."""

    @property
    def shut(self) -> frozenset[str]:
        """Genes that it does not leave to the student."""

    def facts(self) -> tuple[object, ...]:
        """Return all that a verdict depends on beside the genes."""

    def play(self, attack: Attack) -> AttackVerdict:
        """Play an attack and judge it."""


def attack_exercises(
    progress: Progress | None,
    open_target: Callable[[str, int, Progress], Target],
    exercise: Sequence[str] = (),
    evaluations: int = EVALUATIONS,
    seed: int = 1,
    folder: Path | None = None,
) -> Findings:
    """Attack exercises one after the other.

    Args:
        progress: told how far it is; may cancel between two attempts. What was tried is kept.
        open_target: opens an exercise by name, with the seed of its cameras.
        exercise: names; all shipped and own ones if empty.
        evaluations: attempts at each.
        seed: of the search and of the cameras.
        folder: of the journals; the cache folder if left out.

    Raises:
        AcusError: if an exercise cannot be used.
        Cancelled: if `progress` was cancelled.
    """
    watch, names = progress or Progress(), tuple(exercise) or tuple(library().ids())
    rows: list[tuple[Cell, ...]] = []
    holes: list[tuple[Cell, ...]] = []
    differences: list[tuple[Cell, ...]] = []
    for number, name in enumerate(names):
        part = watch.part(number / len(names), (number + 1) / len(names))
        part.report(0.0, name)
        target = open_target(name, seed, part.part(0.0, 0.05))
        journal = AttackJournal(target.id, key_of(*target.facts()), folder)
        before = len(journal)
        tried = search(
            target.play,
            evaluations,
            seed,
            target.shut,
            journal.known,
            journal.tell,
            part.part(0.05, 1.0),
            target.id,
        )
        rows.append(_summary(target, tried, min(before, len(tried))))
        holes += _holes(target.id, tried)
        differences += _differences(target.id, tried)
    sheets = [Sheet("attempts", "What was tried", SUMMARY, tuple(rows))]
    if holes:
        sheets.append(Sheet("holes", "The best paid of each kind", SHOWN, tuple(holes)))
    if differences:
        title = "What the walk of the judgement and the loop tell otherwise"
        sheets.append(Sheet("differences", title, DIFFERENCES, tuple(differences)))
    return Findings(tuple(sheets), lines=_lines(rows, holes), passed=not holes)


def _summary(target: Target, tried: Sequence[TriedAttack], before: int) -> tuple[Cell, ...]:
    totals = [one.verdict.total for one in tried if one.verdict.total is not None]
    counts = [sum(hole in one.verdict.holes for one in tried) for hole in Hole]
    passed = sum(one.verdict.passed for one in tried)
    best = round(max(totals, default=0.0), 1)
    differ = sum(bool(one.verdict.disagree) for one in tried)
    return (target.id, len(tried), before, passed, best, *counts, differ, target.cameras)


def _differences(name: str, tried: Sequence[TriedAttack]) -> list[tuple[Cell, ...]]:
    """List each difference between walk and loop, with how often and the first attempt."""
    first: dict[str, TriedAttack] = {}
    counts: dict[str, int] = {}
    for one in tried:
        for line in one.verdict.disagree:
            first.setdefault(line, one)
            counts[line] = counts.get(line, 0) + 1
    return [(name, key, counts[key], first[key].attack.words()) for key in sorted(first)]


def _holes(name: str, tried: Sequence[TriedAttack]) -> list[tuple[Cell, ...]]:
    rows: list[tuple[Cell, ...]] = []
    for hole in Hole:
        shown = worst(tried, hole)
        if shown is None:
            continue
        verdict = shown.verdict
        rows.append(
            (
                name,
                hole.value,
                round(verdict.total or 0.0, 1),
                "; ".join(verdict.fines) or "nothing",
                "; ".join(verdict.judged) or "nothing",
                round(verdict.closest_mm, 1),
                shown.attack.words(),
            )
        )
    return rows


def _lines(rows: Sequence[tuple[Cell, ...]], holes: Sequence[tuple[Cell, ...]]) -> tuple[str, ...]:
    clean = [str(row[0]) for row in rows if not any(hole[0] == row[0] for hole in holes)]
    lines = [f"{row[0]}: {row[1]}, {row[2]} points of 100: {row[6]}" for row in holes]
    if clean:
        lines.append(f"no hole, as far as was tried: {', '.join(clean)}")
    return tuple(lines)


def _quick(progress: Progress | None, open_target: Callable[..., Target], **asked: Any) -> Findings:
    return attack_exercises(progress, open_target, **({"evaluations": QUICK} | asked))


STUDY: Final = Survey(
    measure=attack_exercises,
    quick=_quick,
    borrows=("app.compose.attacked:Attacked",),
    options=("exercise", "evaluations", "seed"),
)
