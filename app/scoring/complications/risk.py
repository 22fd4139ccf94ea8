"""Odds of a pneumothorax: a logistic model that gives the published odds ratios in a case mix.

What is published are crude odds ratios: of patients with a factor against those without, whatever
else they have. The coefficient of a factor in a model of them all is another number: odds ratios
do not collapse, and even of independent factors the crude one lies nearer to 1. So coefficients and
intercept are solved for together, such that the exact crude odds ratios over all combinations of
factors in the mix are the published ones, and the mean is the published incidence (12 equations).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, read_only
from app.core.messages import sentence
from app.scoring.complications.factors import (
    CONTRASTS,
    FACTOR_NAMES,
    FACTORS,
    CaseMix,
    Facts,
    Lying,
)
from app.scoring.errors import ScoringError

STANDARD: Final = CaseMix()

_POSITIONS: Final = tuple(Lying)


@dataclass(frozen=True, slots=True, eq=False)
class RiskModel:
    """A calibrated model.

    Attributes:
        mix: the patients it is calibrated for.
        intercept: log odds of a patient without any factor, the biopsied lung down.
        slopes: log odds ratio of each factor with all others the same, in the order of `FACTORS`.
        lying: the same of each position against the lung down, in the order of `Lying`.
    """

    mix: CaseMix
    intercept: float
    slopes: FloatArray
    lying: FloatArray

    def probability(self, facts: Facts) -> float:
        """Return the probability of a pneumothorax; what is not known counts as in the mix."""
        combinations, weights = _combinations(self.mix)
        chosen = np.ones(len(weights), np.bool_)
        for name, there in facts.known.items():
            chosen &= combinations[:, FACTOR_NAMES.index(name)] == there
        if facts.lying is not None:
            chosen &= combinations[:, -1] == _POSITIONS.index(facts.lying)
        weight = weights[chosen]
        return float(self._of(combinations[chosen]) @ weight / weight.sum())

    def crude(self, name: str) -> float:
        """Return the exact crude odds ratio of a factor in the mix."""
        combinations, _ = _combinations(self.mix)
        there = combinations[:, FACTOR_NAMES.index(name)] == 1
        return self._ratio(there, ~there)

    def crude_lying(self, these: tuple[Lying, ...], those: tuple[Lying, ...]) -> float:
        """Return the exact crude odds ratio of positions against others in the mix."""
        combinations, _ = _combinations(self.mix)
        first, second = (
            np.isin(combinations[:, -1], [_POSITIONS.index(one) for one in group])
            for group in (these, those)
        )
        return self._ratio(first, second)

    @property
    def incidence(self) -> float:
        """Return the share of the mix with a pneumothorax."""
        combinations, weights = _combinations(self.mix)
        return float(self._of(combinations) @ weights)

    def _of(self, combinations: NDArray[np.int64]) -> FloatArray:
        positions = self.lying[combinations[:, -1]]
        logit = self.intercept + combinations[:, :-1] @ self.slopes + positions
        return np.asarray(1.0 / (1.0 + np.exp(-np.clip(logit, -700.0, 700.0))))

    def _ratio(self, first: NDArray[np.bool_], second: NDArray[np.bool_]) -> float:
        combinations, weights = _combinations(self.mix)
        p, q = (
            float(self._of(combinations[group]) @ weights[group] / weights[group].sum())
            for group in (first, second)
        )
        return p / (1.0 - p) / (q / (1.0 - q))


@lru_cache(maxsize=8)
def calibrated(mix: CaseMix = STANDARD) -> RiskModel:
    """Return the model that gives the published odds ratios and the incidence in a case mix.

    Raises:
        ScoringError: if no model does.
    """
    from scipy.optimize import root  # loaded where it is used: half a second

    n = len(FACTORS)

    def model(x: FloatArray) -> RiskModel:
        lying = np.concatenate([[0.0], x[n + 1 :]])
        return RiskModel(mix, float(x[0]), read_only(x[1 : n + 1].copy()), read_only(lying))

    def misses(x: FloatArray) -> FloatArray:
        now = model(np.asarray(x))
        p = now.incidence
        return np.array(
            [np.log(p / (1.0 - p)) - np.log(mix.incidence / (1.0 - mix.incidence))]
            + [np.log(now.crude(one.name) / one.odds_ratio) for one in FACTORS]
            + [np.log(now.crude_lying(a, b) / ratio) for a, b, ratio in CONTRASTS]
        )

    start = np.concatenate([[-4.0], [np.log(one.odds_ratio) for one in FACTORS], [1.0, 1.0, 2.0]])
    found = root(misses, start, method="hybr", tol=1e-13)
    if not np.abs(misses(found.x)).max() < 1e-9:
        raise ScoringError(
            sentence("no odds of this case mix give the published odds ratios and incidence")
        )
    return model(np.asarray(found.x))


@lru_cache(maxsize=8)
def _combinations(mix: CaseMix) -> tuple[NDArray[np.int64], FloatArray]:
    """Return all combinations, factors then position, shape (n, factors + 1), and their shares."""
    rows = np.array(list(product(*[(0, 1)] * len(FACTORS), range(len(_POSITIONS)))), np.int64)
    shares = np.asarray(mix.shares)
    of_factors = np.where(rows[:, :-1] == 1, shares, 1.0 - shares).prod(axis=1)
    return rows, np.asarray(of_factors * np.asarray(mix.lying)[rows[:, -1]])
