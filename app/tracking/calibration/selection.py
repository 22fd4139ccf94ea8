"""The smallest distortion model that the data support.

All five coefficients are estimated first. Coefficients are correlated, so one is dropped at a time
and everything is estimated anew: of those that may go (p1, p2, and the highest radial one left)
the one least different from 0, if its |value| is under `LIMIT` standard deviations, or if keeping
it is not worth its place by the Bayesian information criterion (value² < ln(n) · variance, Schwarz
1978; for a linear parameter that is the criterion's likelihood ratio).
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from app.tracking.calibration.bundle import Adjusted
from app.tracking.optics.calibration import PARAMETERS

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
