"""Variance components of crossed random effects by restricted maximum likelihood.

The model is y = mean + Z_1 u_1 + ... + Z_m u_m + e with u_i ~ N(0, v_i), e ~ N(0, v). Each Z_i says
which level an observation has. With the ratios g_i = v_i / v = t_i² the restricted deviance is, but
for a constant, over v profiled out (Bates, D. and others 2015, Fitting linear mixed-effects models
using lme4, Journal of Statistical Software 67(1), section 3),

    d(t) = log|M| + log a + (N - 1) log(y'Py),    M = I + T Z'Z T,    a = 1'H⁻¹1,
    H⁻¹ = I - Z T M⁻¹ T Z',    y'Py = y'H⁻¹y - (1'H⁻¹y)² / a,

whose gradient needs the diagonal of M⁻¹ only. Z_i'Z_i of the effect with the most levels is
diagonal, so that M is factorised by its Schur complement. It starts where the quadratic forms
y'QZ_iZ_i'Qy have their expectations (Rao's MIVQUE of 0); the same equations tell whether the
observations tell the effects apart at all.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.scoring.errors import ReliabilityError

_LARGEST: Final = 1e4
"""Of a t: an effect of such a standard deviation, in that of chance, leaves nothing to chance."""

_ALIKE: Final = 1e-9
"""Least eigenvalue of the equations, scaled to a diagonal of 1, of effects that are told apart."""

_FIRST: Final = 1e-3
"""Least t to start from: at 0 itself the deviance is flat."""


class _Deviance:
    """The restricted deviance as a function of the ratios of standard deviations.

    Args:
        y: observations, shape (N,).
        levels: of each effect, the level of each observation, counted from 0.
    """

    def __init__(self, y: FloatArray, levels: Sequence[NDArray[np.intp]]) -> None:
        self.n = len(y)
        counts = [int(own.max()) + 1 for own in levels]
        # the effect with the most levels comes first: its block is diagonal
        self.order = sorted(range(len(levels)), key=lambda i: -counts[i])
        ordered = [levels[i] for i in self.order]
        self.sizes = [counts[i] for i in self.order]
        self.y_one = np.column_stack([y, np.ones(self.n)])
        self.inner = self.y_one.T @ self.y_one
        self.sums = np.vstack([_sums(own, self.y_one) for own in ordered])
        self.large = np.bincount(ordered[0]).astype(np.float64)
        self.side = np.hstack([_table(ordered[0], own) for own in ordered[1:]])
        self.rest = np.block([[_table(a, b) for b in ordered[1:]] for a in ordered[1:]])
        self.blocks = np.repeat(np.arange(len(ordered)), self.sizes)

    def __call__(self, t: FloatArray) -> tuple[float, FloatArray]:
        """Return the deviance and its gradient.

        Args:
            t: of each effect, in the order of the levels that were given.
        """
        from scipy.linalg import cho_factor, cho_solve

        own = t[self.order]
        scale = own[self.blocks]
        first, others = scale[: self.sizes[0]], scale[self.sizes[0] :]
        d = 1.0 + first * first * self.large
        b = first[:, None] * self.side * others[None, :]
        schur = np.eye(len(others)) + others[:, None] * self.rest * others[None, :]
        over = b / d[:, None]
        schur -= b.T @ over
        factor = cho_factor(schur, lower=True, check_finite=False)
        inverse = cho_solve(factor, np.eye(len(others)), check_finite=False)
        turned = over @ inverse
        diagonal = np.concatenate(
            [1.0 / d + np.einsum("ij,ij->i", turned, over), np.diagonal(inverse)]
        )
        scaled = scale[:, None] * self.sums
        up = scaled[: len(d)] / d[:, None]
        low = inverse @ (scaled[len(d) :] - b.T @ up)
        u = np.vstack([up - over @ low, low])  # M⁻¹ T Z' (y, 1)
        inner = self.inner - scaled.T @ u  # (y, 1)' H⁻¹ (y, 1)
        a = float(inner[1, 1])
        mean = float(inner[0, 1]) / a
        rest = max(float(inner[0, 0]) - mean * float(inner[0, 1]), 1e-300)
        log_m = float(np.log(d).sum()) + 2.0 * float(np.log(np.diagonal(factor[0])).sum())
        value = log_m + np.log(a) + (self.n - 1) * np.log(rest)
        # of one effect: tr(M⁻¹ dM) = 2 (levels - tr M⁻¹) / t; and Z_i'H⁻¹x = (M⁻¹ T Z'x)_i / t_i
        weights = np.array([1.0, -mean])
        random = u @ weights
        gradient = np.empty_like(t)
        for place, effect in enumerate(self.order):
            here = self.blocks == place
            size = max(abs(float(own[place])), 1e-12)
            trace = 2.0 * (self.sizes[place] - float(diagonal[here].sum())) / size
            of_mean = -2.0 * float((u[here, 1] ** 2).sum()) / size / a
            of_rest = -2.0 * float((random[here] ** 2).sum()) / size / rest
            gradient[effect] = trace + of_mean + (self.n - 1) * of_rest
        return float(value), gradient

    def chance(self, t: FloatArray) -> float:
        """Return the variance of what is left."""
        own = t[self.order][self.blocks]
        m = np.eye(len(own)) + own[:, None] * self._whole() * own[None, :]
        scaled = own[:, None] * self.sums
        inner = self.inner - scaled.T @ np.linalg.solve(m, scaled)
        return float((inner[0, 0] - inner[0, 1] ** 2 / inner[1, 1]) / (self.n - 1))

    def _whole(self) -> FloatArray:
        """Return Z'Z."""
        whole: FloatArray = np.block([[np.diag(self.large), self.side], [self.side.T, self.rest]])
        return whole


def reml(
    points: FloatArray, levels: Sequence[NDArray[np.intp]], names: Sequence[str]
) -> list[float]:
    """Return the variance of each effect and, at last, of what is left.

    Args:
        points: observations, shape (N,), which differ.
        levels: of each effect, the level of each observation, counted from 0.
        names: of the effects, for messages.

    Raises:
        ReliabilityError: where the observations do not tell two effects apart, or leave nothing to
            chance.
    """
    from scipy.optimize import minimize

    size = float(points.std())
    y = (points - points.mean()) / size
    start = _start(y, levels, names)
    deviance = _Deviance(y, levels)
    bounds = [(0.0, _LARGEST)] * len(levels)
    best = start
    for _ in range(3):
        answer = minimize(
            deviance,
            best,
            jac=True,
            method="L-BFGS-B",
            bounds=bounds,
            options={"ftol": 1e-15, "gtol": 1e-9, "maxiter": 500, "maxls": 50},
        )
        best = np.asarray(answer.x, dtype=np.float64)
        stuck = (best < _FIRST) & (_slope_at_zero(deviance, best) < 0.0)
        if not stuck.any():
            break
        best = np.where(stuck, 0.1, best)
    if best.max() >= 0.99 * _LARGEST:
        raise ReliabilityError(
            sentence(
                "the points repeat exactly and leave nothing to chance, with cells missing: take "
                "in more attempts, or a set in which every student has every exercise"
            )
        )
    chance = deviance.chance(best)
    return [*(float(t * t * chance * size * size) for t in best), chance * size * size]


def _slope_at_zero(deviance: _Deviance, t: FloatArray) -> FloatArray:
    """Return which way the deviance goes as each t that is all but 0 grows."""
    slopes = np.zeros_like(t)
    for place in np.flatnonzero(t < _FIRST):
        grown = t.copy()
        grown[place] = 10.0 * _FIRST
        slopes[place] = deviance(grown)[1][place]
    return slopes


def _start(
    y: FloatArray, levels: Sequence[NDArray[np.intp]], names: Sequence[str]
) -> FloatArray:
    """Return where the search begins, by expectations of quadratic forms.

    Raises:
        ReliabilityError: where effects are not told apart.
    """
    n, m = len(y), len(levels)
    matrix, right = np.empty((m + 1, m + 1)), np.empty(m + 1)
    counts = [np.bincount(own).astype(np.float64) for own in levels]
    for i, a in enumerate(levels):
        for j, b in enumerate(levels[: i + 1]):
            table = _table(a, b) - np.outer(counts[i], counts[j]) / n
            matrix[i, j] = matrix[j, i] = float((table**2).sum())
        matrix[i, m] = matrix[m, i] = n - float((counts[i] ** 2).sum()) / n
        right[i] = float((_sums(a, y[:, None]) ** 2).sum())
    matrix[m, m], right[m] = n - 1, float(y @ y)
    size = np.sqrt(np.diagonal(matrix))
    if size.min() > 0.0:
        scaled = matrix / np.outer(size, size)
        values, vectors = np.linalg.eigh(scaled)
    if size.min() <= 0.0 or values[0] < _ALIKE:
        worst = np.abs(vectors[:, 0]) if size.min() > 0.0 else -size
        mixed = sorted(np.argsort(-worst)[:2])
        raise ReliabilityError(
            sentence(
                "too many cells are missing: these {attempts} attempts do not tell {effect} from "
                "{other}; take in students who have the same exercises, twice at least",
                attempts=n,
                effect=[*names, "residual"][mixed[0]],
                other=[*names, "residual"][mixed[1]],
            )
        )
    found = np.linalg.solve(matrix, right)
    ratios = np.maximum(found[:m], 0.0) / max(float(found[m]), 1e-2)
    return np.clip(np.sqrt(ratios), 0.1, 10.0)


def _sums(levels: NDArray[np.intp], columns: FloatArray) -> FloatArray:
    """Return the sums of columns over each level, shape (levels, columns)."""
    sums = np.zeros((int(levels.max()) + 1, columns.shape[1]))
    np.add.at(sums, levels, columns)
    return sums


def _table(a: NDArray[np.intp], b: NDArray[np.intp]) -> FloatArray:
    """Return how many observations have each level of one effect with each of another."""
    rows, columns = int(a.max()) + 1, int(b.max()) + 1
    flat = np.bincount(a * columns + b, minlength=rows * columns)
    return flat.reshape(rows, columns).astype(np.float64)
