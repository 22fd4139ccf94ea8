"""Which coefficients and which views an adjustment uses.

k1, k2, p1 and p2 are estimated always. A coefficient that is left out because its estimate lies
near 0 is then taken as known, and what it really is shows up in all others: with tangential
distortion of 4e-4 their stated ellipsoid of 95 % held 27 % (`acus study coverage`). Where a
coefficient is chosen by its value, standard deviations hold for the choice that was made and not
for having made it (Leeb and Poetscher, Econometric Theory 21, 21, 2005).

k3 alone may go, by what the views can tell and not by what it is: where its standard deviation is
beyond `K3_UNKNOWN`, several times what k3 of lenses is, an estimate says nothing of the lens, and
continues wildly where no corner was. Leaving it out then moves any other estimate by at most
|k3| / sd of what estimating it would add. An estimate that is beyond doubt stays.

Views that do not belong are left out by a robust rule on the residual of each. Held back for
validation are those whose absence leaves the coverage as it was.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
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
    """Return whether a view that was left out fits as those that are used do, [px].

    The first estimates are rough: what they leave out may fit the last one. With fewer than `LEAST`
    views in use only the median counts.
    """
    if len(used) >= LEAST:
        return residual <= limit_px(used)
    return residual <= max(FACTOR * float(np.median(used)), FLOOR)


K3_UNKNOWN = 0.5
"""Standard deviation of k3 beyond which views do not tell it: lenses have up to 0.2."""

BEYOND_DOUBT = 3.0
"""Standard deviations from 0 from which k3 is kept all the same."""


@dataclass(frozen=True)
class Dropped:
    """A coefficient that the views do not tell.

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
        return sentence(
            "{name} = {estimate:.3g} ± {sd:.2g}: the views do not tell; taken as 0",
            name=self.name,
            estimate=self.value,
            sd=self.sd,
        )


Fit = Callable[[tuple[str, ...], Adjusted | None], Adjusted]
"""Estimates the parameters named, starting from an earlier result."""


def smallest_model(
    fit: Fit, rich: tuple[str, ...] = PARAMETERS
) -> tuple[Adjusted, tuple[str, ...], tuple[Dropped, ...]]:
    """Estimate a camera, without k3 where the views do not tell it.

    Returns:
        The estimate, the names of its free parameters, and what was dropped.
    """
    result = fit(rich, None)
    if "k3" not in rich:
        return result, rich, ()
    place = PARAMETERS.index("k3")
    value, sd = float(result.state.parameters[0, place]), float(result.sd()[place])
    if sd <= K3_UNKNOWN or abs(value) > BEYOND_DOUBT * sd:
        return result, rich, ()
    names = tuple(name for name in rich if name != "k3")
    return fit(names, result), names, (Dropped("k3", value, sd),)
