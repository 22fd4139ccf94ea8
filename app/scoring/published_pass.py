"""What share of the hands that were measured would pass an exercise, were all else perfect.

Distances and angles of published hands (`pass_line`) are drawn, judged by the exercise's own bands
and pass mark, and counted. Of a distance in space the parts along and across the path are those of
any direction alike; angles are independent of distances. Time, path, forces and structures of risk
are taken as an expert's, so that the share is the most that it can be.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.scoring.pass_line import ANGLES, DISTANCES, Hands
from app.scoring.result import judge
from app.scoring.rows import Row, ScoreRules
from app.scoring.tolerance import Tolerance

_HANDS: Final = 1000
"""So many are drawn, at even steps of their distribution: a share is good to some thousandths."""

_SEED: Final = 2015
_IN_SPACE: Final = ("target_error", "planned_target_error")


@dataclass(frozen=True, slots=True)
class PublishedShare:
    """Share of some published hands that would pass, 0 to 1."""

    hands: str
    share: float


def published_shares(
    tolerances: Mapping[str, Tolerance], rules: ScoreRules
) -> tuple[PublishedShare, ...]:
    """Return the share of each kind of published hands; none where no place is judged.

    Args:
        tolerances: of the exercise.
        rules: with its pass mark.
    """
    judged = [name for name, one in tolerances.items() if one.weight > 0.0 or one.required]
    if not {*_IN_SPACE, "lateral_error", "depth_error"} & set(judged):
        return ()
    freehand, guided = ANGLES
    return tuple(
        PublishedShare(hands.words, _share(tolerances, rules, hands, angles))
        for hands, angles in zip(DISTANCES, (freehand, guided, guided), strict=True)
    )


def _share(
    tolerances: Mapping[str, Tolerance], rules: ScoreRules, hands: Hands, angles: Hands
) -> float:
    rng = np.random.default_rng(_SEED)
    steps = (np.arange(_HANDS) + 0.5) / _HANDS
    distance = _quantiles(hands, steps)
    along = rng.permutation(steps)  # cosines of directions that are all alike
    values = {
        **dict.fromkeys(_IN_SPACE, distance),
        "depth_error": distance * along,
        "lateral_error": distance * np.sqrt(1.0 - along**2),
        "angle_error": rng.permutation(_quantiles(angles, steps)),
    }
    bare = rules.model_copy(update={"forbidden": ()})
    passed = 0
    for place in range(_HANDS):
        rows = tuple(
            Row(
                name=name,
                label=name,
                unit="",
                value=float(values[name][place]) if name in values else limits.expert,
                tolerance=limits,
            )
            for name, limits in tolerances.items()
        )
        passed += judge(rows, bare).passed
    return passed / _HANDS


def _quantiles(hands: Hands, shares: FloatArray) -> FloatArray:
    """Return errors that given shares of hands keep, of a gamma distribution."""
    from scipy.special import gammaincinv

    shape = (hands.mean / hands.sd) ** 2
    quantiles: FloatArray = gammaincinv(shape, shares) * hands.mean / shape
    return quantiles
