"""What each effect of a scene costs of a tick, and which one to lower where the tick is too long.

Times are measured on this computer: of the whole tick by the loop while it runs, of each effect by
each of its models on its own. Effects on camera pictures cost nothing of a tick.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Any, Final

from app.views.kit.text import tr

FULL: Final = 0.5
"""Share of the period from which on a tick is too long: the rest is for waking up late."""

MISSING: Final = 0.01
"""Share of deadlines missed from which on a scene is not held at the loop's rate."""


@dataclass(frozen=True, slots=True)
class EffectCost:
    """One effect of the scene that runs.

    Attributes:
        name: of the effect.
        title: for people.
        model: by which it is computed.
        models: each of its models -> what it is.
        costs: each of its models -> time of a tick [s]; none for an effect on pictures.
        why: who needs it.
        warnings: what to know before its forces are believed.
    """

    name: str
    title: str
    model: str
    models: Mapping[str, str]
    costs: Mapping[str, float]
    why: str
    warnings: tuple[str, ...] = ()

    @property
    def cost(self) -> float:
        """Time of a tick by the model that it has [s]."""
        return self.costs.get(self.model, 0.0)

    @property
    def cheapest(self) -> str:
        """The model that costs least."""
        return min(self.costs, key=lambda model: self.costs[model], default=self.model)


@dataclass(frozen=True, slots=True)
class SceneCost:
    """The effects of a scene.

    Attributes:
        effects: that are simulated, in running order.
        left_out: effect -> why it is not.
    """

    effects: tuple[EffectCost, ...]
    left_out: Mapping[str, str]

    @classmethod
    def of(cls, explanation: Mapping[str, Any]) -> SceneCost:
        """Read what `acus explain --json` prints."""
        return cls(
            tuple(
                EffectCost(
                    one["effect"],
                    one["title"],
                    one["model"],
                    one["model_descriptions"],
                    {name: 1e-9 * cost for name, cost in one["model_costs_ns"].items()},
                    one["why"],
                    tuple(one["warnings"]),
                )
                for one in explanation["simulated"]
            ),
            {one["effect"]: one["why"] for one in explanation["dropped"]},
        )


@dataclass(frozen=True, slots=True)
class Lowering:
    """One effect to compute by a cheaper model, and what that saves of a tick [s]."""

    effect: EffectCost
    model: str
    saved: float


def too_much(tick: float, period: float, missed: float) -> bool:
    """Return whether a scene cannot be held at the loop's rate.

    Args:
        tick: time that a tick takes [s]; not finite where nobody measured it.
        period: from tick to tick [s].
        missed: share of deadlines missed lately.
    """
    return (isfinite(tick) and tick > FULL * period) or missed > MISSING


def lowering(effects: Sequence[EffectCost], period: float = 0.0) -> Lowering | None:
    """Return what saves most of a tick.

    Args:
        effects: of the scene.
        period: from tick to tick [s]; what saves less than a share of `MISSING` of it helps nobody.

    Returns:
        None where every effect has its cheapest model, or none is the reason.
    """
    found = [Lowering(e, e.cheapest, e.cost - e.costs[e.cheapest]) for e in effects if e.costs]
    best = max(found, key=lambda one: one.saved, default=None)
    if best is None or best.saved <= 0.0 or best.saved < MISSING * period:
        return None
    return best


def advice(effects: Sequence[EffectCost], tick: float, period: float, missed: float) -> str:
    """Say whether the scene is held at the loop's rate, and what to lower if it is not."""
    if not too_much(tick, period, missed):
        return ""
    late = tr("{share:.1f} % of the ticks come too late", share=100.0 * missed)
    long = tr("a tick takes {us:.0f} µs of {period:.0f} µs", us=1e6 * tick, period=1e6 * period)
    what = long if isfinite(tick) and tick > FULL * period else late
    best = lowering(effects, period)
    if best is None:
        return tr(
            "{what}: no effect of this scene is the reason; close other programs, or use a faster "
            "computer",
            what=what,
        )
    return tr(
        "{what}: compute “{title}” by {model}, which saves {us:.1f} µs a tick",
        what=what,
        title=best.effect.title,
        model=best.model,
        us=1e6 * best.saved,
    )


def in_words(seconds: float) -> str:
    """Write a time of a tick in the unit that suits it."""
    if seconds < 1e-6:
        return tr("{ns:.0f} ns", ns=1e9 * seconds)
    return tr("{us:.2f} µs", us=1e6 * seconds)
