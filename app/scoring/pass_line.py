"""What a pass line of an error is, and how many of the hands that were measured came so near.

2.7 mm is no measurement of anybody's hand: it is the mean of what the respondents of a survey would
allow at most (153, of whom 125 were radiologists; de Jong 2018, doi 10.2147/MDER.S160444). Hands
were measured by Gruber-Rouh (2015, PMC4499536). A share is that of a gamma distribution with the
published mean and standard deviation: errors are never negative, and no list of them is published.

What share of the hands that were measured would pass an exercise, were all else perfect.

Distances and angles of published hands (`pass_line`) are drawn, judged by the exercise's own bands
and pass mark, and counted. Of a distance in space the parts along and across the path are those of
any direction alike; angles are independent of distances. Time, path, forces and structures of risk
are taken as an expert's, so that the share is the most that it can be.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.scoring.errors import ToleranceError
from app.scoring.result import judge
from app.scoring.rows import Row, ScoreRules
from app.scoring.tolerance import Bands, Tolerance

WISHED_MM: Final = 2.7
"""Mean largest error that the respondents would allow [mm]."""


@dataclass(frozen=True, slots=True)
class Hands:
    """Errors of many hands: mean and standard deviation [mm] or [°]."""

    words: str
    mean: float
    sd: float


DISTANCES: Final = (
    Hands("freehand", 6.3, 3.6),
    Hands("guided", 4.0, 2.7),
    Hands("guided in patients", 5.0, 1.2),
)
"""From tip to target in space [mm]."""

ANGLES: Final = (Hands("freehand", 3.4, 3.1), Hands("guided", 1.3, 0.9))
"""Between needle and planned path [°]."""

_MEASURED: Final = {
    "target_error": DISTANCES,
    "planned_target_error": DISTANCES,
    "lateral_error": DISTANCES,
    "depth_error": DISTANCES,
    "angle_error": ANGLES,
}
_PARTS: Final = ("lateral_error", "depth_error")


def share_within(limit: float, hands: Hands) -> float:
    """Return the share of hands with no larger an error, 0 to 1.

    Args:
        limit: in the unit of `hands`, 0 or more.
        hands: what was measured.

    Raises:
        ToleranceError: for a limit below 0, or one that is no number.
    """
    if not limit >= 0.0:
        raise ToleranceError(sentence("no error lies within {limit}: give 0 or more", limit=limit))
    if limit == float("inf"):
        return 1.0
    from scipy.special import gammainc

    shape = (hands.mean / hands.sd) ** 2
    return float(gammainc(shape, limit * shape / hands.mean))


def pass_words(metric: str, limit: float) -> str:
    """Say what a pass line of a metric is; empty where no hands were measured by it.

    Args:
        metric: its name.
        limit: its pass line, in the metric's unit.
    """
    hands = _MEASURED.get(metric)
    if hands is None:
        return ""
    shares = ", ".join(f"{share_within(limit, one):.0%} {one.words}" for one in hands)
    at_least = "at least " if metric in _PARTS else ""
    wish = ""
    if metric not in ("angle_error",) and limit == WISHED_MM:
        wish = sentence("a wish of 153 respondents (125 radiologists), nobody's measured hand: ")
    return sentence(
        "{wish}of published hands {at_least}{shares} came so near",
        wish=wish,
        at_least=at_least,
        shares=shares,
    )


def pass_lines(tolerances: Mapping[str, Bands]) -> list[dict[str, Any]]:
    """Say of each pass line of an error what it is, and what share of measured hands passes it."""
    lines = ((name, one.knots[2]) for name, one in tolerances.items())
    return [
        {"metric": name, "pass": passing, "words": words}
        for name, passing in lines
        if (words := pass_words(name, passing))
    ]


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
