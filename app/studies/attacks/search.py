"""The search for an attack that is paid and ought not to be: a small evolution with a seed.

A (μ + 1) evolution of its own, and not differential evolution of scipy: genes work together in
tricks that most attacks leave alone, where differences between members of a population say little;
three aims share what was tried; and each attempt counts for itself, so that a search that was
broken off goes on at the attempt at which it stopped.

**Worth** of an attempt is its total and whether it passes. **Wrong** is, for one aim, what the
needle truly met that no needle may; for another, how far its tip stayed from the target; for the
third, what share of that the score knows nothing of. An aim is paid with the product; the
three take turns, so that the easiest does not crowd out the others.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Collection, Sequence
from dataclasses import asdict, dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any, Final

import numpy as np

from app.core import paths, plugin_folders
from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.progress import Progress
from app.studies.attacks.attack import Attack, honest_genes, open_tricks
from app.studies.errors import StudyError

PARENTS: Final = 12
FIRST: Final = 64
"""So many attacks are an honest hand's with some tricks, before parents are chosen."""

FRESH, CROSSED, TRICKED = 0.1, 0.3, 0.5
"""Shares of the attacks that are begun so anew, that have two parents, that get another trick."""

TRICKS: Final = 3
"""At most so many in an attack that is begun anew."""

FORGOTTEN: Final = 0.25
"""Share of the changes of a trick that leave it off."""

CHANGED: Final = 2.0
"""Genes that any other child changes a little, in the mean."""

FAR_MM: Final = 20.0
"""A tip that stayed this far from the target has reached nothing."""

NOTHING_POINTS: Final = 50.0
"""Half of all points or more, for an attempt that has reached nothing, are points for nothing."""

LITTLE: Final = 0.1

VOID: Final = 0.6
"""What a void attempt is worth by what it would have; so the search learns to be seen enough."""

ROUNDED: Final = 4
"""Digits of a gene that count: what is kept is what was played."""


class Hole(StrEnum):
    """What an attempt shows of the judgement."""

    FINED_PASS = "passes and is fined"
    MISSED_PASS = "passes without reaching the target"
    POINTS_FOR_NOTHING = "points for nothing"


@dataclass(frozen=True, slots=True)
class AttackVerdict:
    """What came of an attack.

    Attributes:
        total: 0 to 100; None where the attempt is void or has no score.
        passed: whether it passed.
        fines: what the needle truly met and no needle may, in sentences.
        fine: how bad that is, 0 to 1.
        closest_mm: least distance of the true tip from the target.
        judged: for what the score fails it; empty where it does not.
        hidden: share of what is fined that the score knows nothing of.
        seen: share of the insertion that was tracked, 0 to 1.
        otherwise: the total that it would have were it not void.
        disagree: where the walk that the judgement makes and the loop differ about what was met.
    """

    total: float | None
    passed: bool
    fines: tuple[str, ...] = ()
    fine: float = 0.0
    closest_mm: float = 0.0
    judged: tuple[str, ...] = ()
    hidden: float = 0.0
    seen: float = 1.0
    otherwise: float = 0.0
    disagree: tuple[str, ...] = ()

    @property
    def worth(self) -> float:
        """Return what it pays, 0 to 1; a void one the less, the less of it was seen."""
        if self.total is None:
            return VOID * self.seen * self.otherwise / 100.0
        return 0.5 * ((self.total or 0.0) / 100.0 + float(self.passed))

    @property
    def holes(self) -> tuple[Hole, ...]:
        """Return what it shows of the judgement; empty where it was judged as it ought to be."""
        far = self.closest_mm > FAR_MM
        shown = []
        if self.passed and self.fines:
            shown.append(Hole.FINED_PASS)
        if self.passed and far:
            shown.append(Hole.MISSED_PASS)
        if far and (self.total or 0.0) >= NOTHING_POINTS:
            shown.append(Hole.POINTS_FOR_NOTHING)
        return tuple(shown)

    def document(self) -> dict[str, Any]:
        """Return it as JSON-ready values."""
        lists = {name: list(getattr(self, name)) for name in ("fines", "judged", "disagree")}
        return asdict(self) | lists

    @classmethod
    def of(cls, document: dict[str, Any]) -> AttackVerdict:
        """Read what `document` wrote.

        Raises:
            LookupError, TypeError, ValueError: if it is no such document.
        """
        total = document["total"]
        return cls(
            None if total is None else float(total),
            bool(document["passed"]),
            tuple(map(str, document["fines"])),
            float(document["fine"]),
            float(document["closest_mm"]),
            tuple(map(str, document["judged"])),
            float(document["hidden"]),
            float(document["seen"]),
            float(document["otherwise"]),
            tuple(map(str, document.get("disagree", ()))),
        )


@dataclass(frozen=True, slots=True)
class TriedAttack:
    """An attack with what came of it."""

    genes: tuple[float, ...]
    verdict: AttackVerdict

    @property
    def attack(self) -> Attack:
        """Return what its genes mean."""
        return Attack.of(self.genes)


def _paid(worth: float, wrong: float) -> float:
    """Return what an attempt is to an aim: a little also where one of the two is nothing."""
    return (LITTLE + (1.0 - LITTLE) * worth) * (LITTLE + (1.0 - LITTLE) * wrong)


def _met(verdict: AttackVerdict) -> float:
    return _paid(verdict.worth, verdict.fine)


def _missed(verdict: AttackVerdict) -> float:
    return _paid(verdict.worth, min(1.0, verdict.closest_mm / FAR_MM))


def _hidden(verdict: AttackVerdict) -> float:
    return _paid(verdict.worth, verdict.hidden + 0.5 * (1.0 - verdict.hidden) * bool(verdict.fines))


AIMS: Final[tuple[Callable[[AttackVerdict], float], ...]] = (_met, _missed, _hidden)
"""What is paid for, in turns."""


def search(
    play: Callable[[Attack], AttackVerdict],
    evaluations: int,
    seed: int,
    shut: Collection[str] = (),
    known: Callable[[tuple[float, ...]], AttackVerdict | None] = lambda _: None,
    tell: Callable[[TriedAttack], object] = lambda _: None,
    progress: Progress | None = None,
    label: str = "",
) -> tuple[TriedAttack, ...]:
    """Try attacks; returns all of them, in order; the same for the same seed.

    Args:
        play: plays one and judges it.
        evaluations: how many are tried; those that are known count.
        seed: of the search.
        shut: genes that stay honest: what the exercise locks.
        known: returns what is known of genes from a run before; None if nothing is.
        tell: told of each that was played anew, at once.
        progress: told how far it is; may cancel between two.
        label: that the progress is told with.

    Raises:
        Cancelled: if `progress` was cancelled.
    """
    watch, random = progress or Progress(), np.random.default_rng([seed, 27])
    tricks = open_tricks(shut)
    tried: list[TriedAttack] = []
    holes = 0
    for number in range(evaluations):
        watch.report(
            number / evaluations,
            sentence(
                "{label}: {current} of {evaluations}, {holes} holes",
                label=label,
                current=number,
                evaluations=evaluations,
                holes=holes,
            ),
        )
        if number < FIRST:
            genes = _fresh(tricks, random) if number else honest_genes()
        else:
            genes = _child(tried, AIMS[number % len(AIMS)], tricks, random)
        key = tuple(np.round(genes, ROUNDED).tolist())
        verdict = known(key)
        if verdict is None:
            verdict = play(Attack.of(key))
            tell(TriedAttack(key, verdict))
        tried.append(TriedAttack(key, verdict))
        holes += bool(verdict.holes)
    watch.report(1.0)
    return tuple(tried)


def worst(tried: Collection[TriedAttack], hole: Hole) -> TriedAttack | None:
    """Return the attack that shows a hole and is paid the most; None where none shows it."""
    showing = [one for one in tried if hole in one.verdict.holes]
    return max(showing, key=lambda one: one.verdict.worth, default=None)


def _fresh(tricks: Sequence[tuple[int, ...]], random: np.random.Generator) -> FloatArray:
    """Return the genes of an honest hand with some tricks, shape (n,)."""
    genes = honest_genes()
    for _ in range(int(random.integers(1, TRICKS + 1)) if tricks else 0):
        _play_trick(genes, tricks, random)
    return genes


def _play_trick(
    genes: FloatArray, tricks: Sequence[tuple[int, ...]], random: np.random.Generator
) -> None:
    """Change one trick as a whole: to anything, or to what is honest."""
    numbers = list(tricks[int(random.integers(len(tricks)))])
    genes[numbers] = 0.5 if random.random() < FORGOTTEN else random.random(len(numbers))


def _parents(
    tried: list[TriedAttack],
    aim: Callable[[AttackVerdict], float],
    tricks: Sequence[tuple[int, ...]],
) -> list[TriedAttack]:
    """Return those that an aim pays best, of each set of tricks one alone."""
    best: dict[tuple[bool, ...], TriedAttack] = {}
    for one in sorted(tried, key=lambda one: -aim(one.verdict)):
        played = tuple(any(one.genes[n] != 0.5 for n in numbers) for numbers in tricks)
        best.setdefault(played, one)
        if len(best) == PARENTS:
            break
    return list(best.values())


def _child(
    tried: list[TriedAttack],
    aim: Callable[[AttackVerdict], float],
    tricks: Sequence[tuple[int, ...]],
    random: np.random.Generator,
) -> FloatArray:
    """Return genes made of those that an aim pays best."""
    if not tricks or random.random() < FRESH:
        return _fresh(tricks, random)
    parents = _parents(tried, aim, tricks)
    genes = np.array(parents[int(random.integers(len(parents)))].genes)
    if random.random() < CROSSED:
        other = np.array(parents[int(random.integers(len(parents)))].genes)
        for numbers in tricks:  # a trick comes from one of the two as a whole
            if random.random() < 0.5:
                genes[list(numbers)] = other[list(numbers)]
    if random.random() < TRICKED:
        _play_trick(genes, tricks, random)
        return genes
    free = np.concatenate([np.array(numbers) for numbers in tricks])
    changed = random.random(len(free)) < CHANGED / len(free)
    changed[int(random.integers(len(free)))] = True
    step = 10.0 ** random.uniform(-2.0, -0.5)
    genes[free[changed]] += step * random.standard_normal(int(changed.sum()))
    inside: FloatArray = 1.0 - np.abs(1.0 - np.abs(genes) % 2.0)
    return inside


FORMAT: Final = "acus-attacks/1"


def key_of(*parts: Any) -> str:
    """Return a digest of JSON-ready values, of the program's files and of its profiles and rigs."""
    digest = hashlib.sha256(json.dumps(parts, sort_keys=True, default=str).encode())
    for path in sorted(plugin_folders.APP.rglob("*.py")):
        digest.update(str(path.relative_to(plugin_folders.APP)).encode() + path.read_bytes())
    for path in sorted(paths.resources().rglob("*.yaml")):
        digest.update(str(path.relative_to(paths.resources())).encode() + path.read_bytes())
    return digest.hexdigest()[:16]


class AttackJournal:
    """What was tried at one exercise.

    Args:
        name: of the exercise.
        key: digest of all that a verdict depends on beside the genes.
        folder: where it lies; the cache folder if left out.

    Raises:
        StudyError: if it cannot be written.
    """

    def __init__(self, name: str, key: str, folder: Path | None = None) -> None:
        self._file = (folder or paths.cache() / "adversary") / f"{name}-{key}.jsonl"
        self._known: dict[tuple[float, ...], AttackVerdict] = {}
        try:
            self._file.parent.mkdir(parents=True, exist_ok=True)
            lines = self._file.read_text("utf-8").splitlines() if self._file.exists() else []
            if not lines:
                self._append({"format": FORMAT, "exercise": name})
        except OSError as error:
            raise StudyError(
                sentence(
                    "{file} cannot be written, so that what is tried would be lost: {error}",
                    file=self._file,
                    error=error,
                )
            ) from error
        for line in lines[1:]:
            try:
                document = json.loads(line)
                genes = tuple(float(one) for one in document["genes"])
                self._known[genes] = AttackVerdict.of(document["verdict"])
            except (LookupError, TypeError, ValueError):
                continue  # a line that was not finished when the run was broken off

    def __len__(self) -> int:
        """Return how many attacks are known."""
        return len(self._known)

    def known(self, genes: tuple[float, ...]) -> AttackVerdict | None:
        """Return what came of genes; None if they have not been tried."""
        return self._known.get(genes)

    def tell(self, tried: TriedAttack) -> None:
        """Keep one more, at once."""
        self._known[tried.genes] = tried.verdict
        self._append({"genes": list(tried.genes), "verdict": tried.verdict.document()})

    def _append(self, document: dict[str, Any]) -> None:
        new = "" if not self._file.exists() or self._ended() else "\n"
        with self._file.open("a", encoding="utf-8") as file:
            file.write(new + json.dumps(document, ensure_ascii=False) + "\n")

    def _ended(self) -> bool:
        content = self._file.read_bytes()[-1:]
        return content in (b"", b"\n")
