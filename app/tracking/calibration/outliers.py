"""Views that do not belong: a robust rule on the residual of each."""

from collections.abc import Sequence

import numpy as np

from app.core.arrays import FloatArray

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
