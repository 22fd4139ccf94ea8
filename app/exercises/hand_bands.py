"""Bands of one hand: what counts as good where mouse, tablet or gamepad move the simulated hand.

The tolerances of an exercise are those of a hand at the robot. Where the needle has to end is the
patient's and the same for every hand; how long, how straight and how steadily it goes there is not.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from typing import Final

from pydantic import Field

from app.core.configuration import Strict
from app.core.messages import sentence
from app.exercises.locks import HandName
from app.scoring.rows import REACHING
from app.scoring.tolerance import Bands, Tolerance


class BandsSource(StrEnum):
    """Whose attempts bands were fitted to."""

    SCRIPTS = "scripts"
    """Two scripts at the window; nobody has been measured."""
    PEOPLE = "people"
    AUTHOR = "author"
    """None: who wrote the exercise set them."""


class HandBands(Strict):
    """Bands of some metrics for one hand.

    Attributes:
        source: where they come from.
        metrics: metric -> bands in place of those of its tolerance, whose weight stays.
    """

    source: BandsSource = BandsSource.AUTHOR
    metrics: Mapping[str, Bands] = Field(min_length=1)


OF_HANDS: Final[Mapping[str, HandName]] = {
    **{hand.value: hand for hand in HandName},
    "keyboard": HandName.MOUSE,
}
"""Hand as a record names it -> the one whose bands it is judged by; keys go with the mouse."""


def judged_by_hand(
    tolerances: Mapping[str, Tolerance], bands: HandBands | None
) -> Mapping[str, Tolerance]:
    """Return tolerances with the bands of a hand; as they are where it has none of its own."""
    if bands is None:
        return tolerances
    changed = {
        name: limits.model_copy(update=dict(bands.metrics[name]))
        for name, limits in tolerances.items()
        if name in bands.metrics
    }
    return {name: changed.get(name, limits) for name, limits in tolerances.items()}


def check_bands(tolerances: Mapping[str, Tolerance], bands: Mapping[HandName, HandBands]) -> None:
    """Refuse bands of what is not judged, of where the needle has to end, or that run otherwise.

    Raises:
        ValueError: naming hand and metric.
    """
    for hand, own in bands.items():
        for name, knots in own.metrics.items():
            where = f"bands: {hand.value}: {name}"
            if name not in tolerances:
                raise ValueError(
                    sentence("{where} has no tolerance: give it one, with its weight", where=where)
                )
            if name in REACHING:
                raise ValueError(
                    sentence(
                        "{where} says where the needle has to end, which is the same for every "
                        "hand: change its tolerance",
                        where=where,
                    )
                )
            if knots.higher_is_better != tolerances[name].higher_is_better:
                raise ValueError(
                    sentence("{where} runs against the bands of its tolerance", where=where)
                )


def bands_among(
    bands: Mapping[HandName, HandBands], names: Mapping[str, object]
) -> dict[HandName, HandBands]:
    """Return the bands of some metrics alone."""
    some = {
        hand: {name: knots for name, knots in own.metrics.items() if name in names}
        for hand, own in bands.items()
    }
    return {
        hand: HandBands(source=bands[hand].source, metrics=metrics)
        for hand, metrics in some.items()
        if metrics
    }
