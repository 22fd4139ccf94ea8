"""Which coefficients and which views an adjustment uses.

The smallest distortion model that the data support: all five coefficients are estimated first.
Coefficients are correlated, so one is dropped at a time and everything is estimated anew: of those
that may go (p1, p2, and the highest radial one left) the one least different from 0, if its |value|
is under `LIMIT` standard deviations, or if keeping it is not worth its place by the Bayesian
information criterion (value² < ln(n) · variance, Schwarz 1978; for a linear parameter that is the
criterion's likelihood ratio).

Views that do not belong are left out by a robust rule on the residual of each. Held back for
validation are those whose absence leaves the coverage as it was.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.calibration.bundle import Adjusted
from app.tracking.calibration.views import BoardView
from app.tracking.optics.calibration import PARAMETERS


def held_back_count(views: int) -> int:
    """Return how many of so many views to hold back: one in five, from eight on, at least two."""
    return max(2, views // 5) if views >= 8 else 0


def choose_held_back(views: Sequence[BoardView], count: int) -> list[int]:
    """Numbers of the views to hold back, ascending.

    One after the other the view is taken whose nearest neighbour, of those kept, is nearest in
    place, size and shape in the picture: what it covers stays covered.
    """
    if not 0 < count < len(views):
        return []
    features = np.array([_feature(view) for view in views])
    kept = list(range(len(views)))
    held: list[int] = []
    while len(held) < count:
        chosen = features[kept]
        apart = np.linalg.norm(chosen[:, None] - chosen[None], axis=2)
        np.fill_diagonal(apart, np.inf)
        held.append(kept.pop(int(np.argmin(apart.min(axis=1)))))
    return sorted(held)


def _feature(view: BoardView) -> FloatArray:
    """Centre, and half axes of the corners' spread, in parts of the picture's width."""
    pixels = view.pixels / view.image_size[0]
    spread = np.cov(pixels.T)
    result: FloatArray = np.concatenate(
        [
            pixels.mean(axis=0),
            np.sqrt(np.diag(spread)),
            [np.sqrt(abs(spread[0, 1])) * np.sign(spread[0, 1])],
        ]
    )
    return result


SPREADS = 5.0
"""Robust standard deviations above the median from which a view counts as an outlier."""

FACTOR = 2.5
"""Times the median that it must exceed as well: alike views have next to no spread."""

FLOOR = 0.15
"""No view with less residual is an outlier [px]."""

LEAST = 5
"""Views needed to tell one that does not belong."""


def limit_px(residuals: Sequence[float]) -> float:
    """Residual from which a view counts as an outlier [px].

    max(median + 5 · 1.4826 · MAD, 2.5 · median, 0.15 px); infinite for fewer than five views. Up to
    nearly half of the views may be bad before median and MAD give way (Rousseeuw and Croux 1993).
    """
    values: FloatArray = np.asarray(residuals, dtype=np.float64)
    if values.size < LEAST:
        return float("inf")
    middle = float(np.median(values))
    spread = 1.4826 * float(np.median(np.abs(values - middle)))
    return max(middle + SPREADS * spread, FACTOR * middle, FLOOR)


def belongs(residual: float, used: Sequence[float]) -> bool:
    """Whether a view that was left out fits as those that are used do, [px].

    The first estimates are rough: what they leave out may fit the last one. With fewer than `LEAST`
    views in use only the median counts.
    """
    if len(used) >= LEAST:
        return residual <= limit_px(used)
    return residual <= max(FACTOR * float(np.median(used)), FLOOR)


LIMIT = 3.0
"""Standard deviations from 0 below which a coefficient is not significant."""

RADIAL = ("k3", "k2", "k1")
"""In the order in which they may be dropped."""


@dataclass(frozen=True)
class Dropped:
    """A coefficient that the data do not support.

    Attributes:
        name: of `PARAMETERS`.
        value, sd: when it was dropped.
    """

    name: str
    value: float
    sd: float

    @property
    def text(self) -> str:
        """One line for people."""
        return f"{self.name} = {self.value:.3g} ± {self.sd:.2g} is not significant: dropped"


Fit = Callable[[tuple[str, ...], Adjusted | None], Adjusted]
"""Estimates the parameters named, starting from an earlier result."""


def smallest_model(
    fit: Fit, rich: tuple[str, ...] = PARAMETERS
) -> tuple[Adjusted, tuple[str, ...], tuple[Dropped, ...]]:
    """Drop coefficients that are not significant.

    Returns:
        The estimate, the names of its free parameters, and what was dropped in order.
    """
    names, dropped = rich, list[Dropped]()
    result = fit(names, None)
    while (worst := _least(result, names)) is not None:
        dropped.append(worst)
        names = tuple(name for name in names if name != worst.name)
        result = fit(names, result)
    return result, names, tuple(dropped)


def _least(result: Adjusted, names: tuple[str, ...]) -> Dropped | None:
    """Find the coefficient to drop next, or None if all are significant."""
    radial = next((name for name in RADIAL if name in names), None)
    measured = 2 * sum(len(r) for r in result.residuals)
    limit = max(LIMIT, float(np.sqrt(np.log(measured))))
    worst, least = None, limit
    for name in ("p1", "p2", radial):
        if name is None or name not in names:
            continue
        place = PARAMETERS.index(name)
        value, sd = float(result.state.parameters[0, place]), float(result.sd()[place])
        ratio = abs(value) / max(sd, 1e-300)
        if ratio < least:
            worst, least = Dropped(name, value, sd), ratio
    return worst
