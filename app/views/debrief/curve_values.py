"""What the curves of an attempt show: figures over time, their level, their range."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.session.review import Review
from app.views.exercise.felt import origin_word
from app.views.kit import theme
from app.views.kit.text import tr

SHORTEST_S: Final = 0.05
"""Shortest time axis [s]."""


@dataclass(frozen=True, slots=True, eq=False)
class Curve:
    """One plot.

    Attributes:
        title: what it shows, with the unit.
        values: shape (n,), in the unit of the title.
        colour: of the line.
        line: level drawn across the plot; None for none.
        line_name: what that level is.
        unit: for the read-out.
        name: for the read-out.
    """

    title: str
    values: FloatArray
    colour: str
    line: float | None
    line_name: str
    unit: str
    name: str


def curves_of(review: Review) -> tuple[Curve, ...]:
    """Return the plots of an attempt: depth, two errors, and the force if something could push."""
    c = review.curves
    target_mm = 1e3 * review.placed.length
    return (
        Curve(
            tr("Depth [mm]"), 1e3 * c.depth, theme.NEEDLE.colour, target_mm,
            tr("target {mm:.0f} mm", mm=target_mm), "mm", tr("depth"),
        ),
        Curve(
            tr("Off the path [mm]"), 1e3 * c.lateral, theme.NEEDLE_TIP.colour, None, "", "mm",
            tr("off the path"),
        ),
        Curve(
            tr("Angle error [°]"), np.degrees(c.angle), theme.PATH.colour, None, "", "°",
            tr("angle"),
        ),
        *([_force_curve(review)] if review.renders else []),
    )  # fmt: skip


def _force_curve(review: Review) -> Curve:
    """Curve of the force, as the gauge measured it where there was one, else estimated."""
    force, origin = review.measured_force, origin_word(review.measured_force is not None)
    return Curve(
        tr("Force felt, {origin} [N]", origin=origin),
        review.curves.felt if force is None else np.abs(force), "#f0e442", review.force_limit,
        tr("limit {n:g} N", n=review.force_limit), "N", tr("{origin} force", origin=origin),
    )  # fmt: skip


def time_end(time: FloatArray) -> float:
    """End of the time axis [s]: the last sample, however short the attempt was."""
    return max(SHORTEST_S, float(time[-1]) if len(time) else 1.0)


def value_range(curve: Curve) -> tuple[float, float]:
    """Range of a plot: all values and the line, with room for the title above."""
    values = curve.values[np.isfinite(curve.values)]
    low = min(0.0, float(values.min(initial=0.0)))
    high = max(float(values.max(initial=0.0)), curve.line or 0.0, low + 1e-3)
    return low - 0.2 * (high - low), high + 0.28 * (high - low)
