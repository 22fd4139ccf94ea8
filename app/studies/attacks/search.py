"""The search for an attack that is paid and ought not to be: a small evolution with a seed.

A (μ + λ) evolution of its own, and not differential evolution of scipy: half of the genes are
switches that do nothing most of the time, where differences of populations say little; two aims
share what was tried; and an evaluation counts for itself, so that a search that was broken off goes
on at the attempt at which it stopped.

**Worth** of an attempt is its total and whether it passes. **Wrong** is, for the one aim, what the
needle truly met that no needle may, for the other, how far its tip stayed from the target. An aim
is paid with the product; the two take turns, so that the easier does not crowd out the other.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import asdict, dataclass
from enum import StrEnum
from typing import Any, Final

import numpy as np
from scipy.stats import qmc

from app.core.arrays import FloatArray
from app.core.progress import Progress
from app.studies.attacks.attack import GENES, Attack, honest_genes, open_genes

PARENTS: Final = 12
FIRST: Final = 64
"""So many attacks lie evenly over all that can be tried, before the first parents are chosen."""

FRESH: Final = 0.1
CROSSED: Final = 0.25
"""Shares of the attacks that have no parents, and two."""

CHANGED: Final = 2.5
"""Genes that a child changes, in the mean."""

FAR_MM: Final = 20.0
"""A tip that stayed this far from the target has reached nothing."""

NOTHING_POINTS: Final = 30.0
"""So many points or more for an attempt that has reached nothing are points for nothing."""

ROUNDED: Final = 4
"""Digits of a gene that count: what is kept is what was played."""


class Hole(StrEnum):
    """What an attempt shows of the judgement."""

    FINED_PASS = "passes and is fined"
    MISSED_PASS = "passes without reaching the target"
    POINTS_FOR_NOTHING = "points for nothing"


@dataclass(frozen=True, slots=True)
class Verdict:
    """What came of an attack.

    Attributes:
        total: 0 to 100; None where the attempt is void or has no score.
        passed: whether it passed.
        fines: what the needle truly met and no needle may, in sentences.
        fine: how bad that is, 0 to 1.
        closest_mm: least distance of the true tip from the target.
        judged: what of the fines the score knows; empty where it knows of nothing.
    """

    total: float | None
    passed: bool
    fines: tuple[str, ...] = ()
    fine: float = 0.0
    closest_mm: float = 0.0
    judged: tuple[str, ...] = ()

    @property
    def worth(self) -> float:
        """Return what it pays, 0 to 1."""
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
        return asdict(self) | {"fines": list(self.fines), "judged": list(self.judged)}

    @classmethod
    def of(cls, document: dict[str, Any]) -> Verdict:
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
        )


@dataclass(frozen=True, slots=True)
class Tried:
    """An attack with what came of it."""

    genes: tuple[float, ...]
    verdict: Verdict

    @property
    def attack(self) -> Attack:
        """Return what its genes mean."""
        return Attack.of(self.genes)


def _met(verdict: Verdict) -> float:
    return verdict.worth * (0.1 + 0.9 * verdict.fine)


def _missed(verdict: Verdict) -> float:
    return verdict.worth * (0.1 + 0.9 * min(1.0, verdict.closest_mm / FAR_MM))


AIMS: Final[tuple[Callable[[Verdict], float], ...]] = (_met, _missed)
"""What is paid for, in turns."""


def search(
    play: Callable[[Attack], Verdict],
    evaluations: int,
    seed: int,
    shut: Collection[str] = (),
    known: Callable[[tuple[float, ...]], Verdict | None] = lambda _: None,
    tell: Callable[[Tried], object] = lambda _: None,
    progress: Progress | None = None,
    label: str = "",
) -> tuple[Tried, ...]:
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
    free = open_genes(shut)
    first = _first(free, min(FIRST, evaluations), seed)
    tried: list[Tried] = []
    holes = 0
    for number in range(evaluations):
        watch.report(number / evaluations, f"{label}: {number} of {evaluations}, {holes} holes")
        if number < len(first):
            genes = first[number]
        else:
            genes = _child(tried, AIMS[number % len(AIMS)], free, random)
        key = tuple(np.round(genes, ROUNDED).tolist())
        verdict = known(key)
        if verdict is None:
            verdict = play(Attack.of(key))
            tell(Tried(key, verdict))
        tried.append(Tried(key, verdict))
        holes += bool(verdict.holes)
    watch.report(1.0)
    return tuple(tried)


def worst(tried: Collection[Tried], hole: Hole) -> Tried | None:
    """Return the attack that shows a hole and is paid the most; None where none shows it."""
    showing = [one for one in tried if hole in one.verdict.holes]
    return max(showing, key=lambda one: one.verdict.worth, default=None)


def _first(free: list[int], count: int, seed: int) -> FloatArray:
    """Return an honest attempt and others evenly over all that can be tried, shape (count, n)."""
    genes = np.tile(honest_genes(), (count, 1))
    if count > 1 and free:
        even = qmc.Sobol(len(free), rng=np.random.default_rng([seed, 28]))
        genes[1:, free] = even.random_base2(int(np.ceil(np.log2(count))))[: count - 1]
    return genes


def _child(
    tried: list[Tried],
    aim: Callable[[Verdict], float],
    free: list[int],
    random: np.random.Generator,
) -> FloatArray:
    """Return genes made of those that an aim pays best."""
    if not free or random.random() < FRESH:
        fresh = honest_genes()
        fresh[free] = random.random(len(free))
        return fresh
    ranked = sorted(tried, key=lambda one: -aim(one.verdict))
    parents = list({one.genes: one for one in ranked[: 4 * PARENTS]}.values())[:PARENTS]
    genes = np.array(parents[int(random.integers(len(parents)))].genes)
    if random.random() < CROSSED:
        other = np.array(parents[int(random.integers(len(parents)))].genes)
        genes = np.where(random.random(len(GENES)) < 0.5, genes, other)
    changed = random.random(len(free)) < CHANGED / len(free)
    changed[int(random.integers(len(free)))] = True
    step = 10.0 ** random.uniform(-2.0, -0.3)
    for number in np.array(free)[changed].tolist():
        if random.random() < 0.2:
            genes[number] = random.choice([0.5, random.random()])
        else:
            genes[number] += step * random.standard_normal()
    inside: FloatArray = 1.0 - np.abs(1.0 - np.abs(genes) % 2.0)
    return inside
