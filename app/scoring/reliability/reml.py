"""Variance components of crossed random effects by restricted maximum likelihood.

The model is y = mean + Z_1 u_1 + ... + Z_m u_m + e with u_i ~ N(0, v_i), e ~ N(0, v). Each Z_i says
which level an observation has. With the ratios v_i / v = t_i² the restricted deviance is, but
for a constant, over v profiled out (Bates, D. and others 2015, Fitting linear mixed-effects models
using lme4, Journal of Statistical Software 67(1), section 3),

    d(t) = log|M| + log a + (N - 1) log(y'Py),    M = I + T Z'Z T,    a = 1'H⁻¹1,
    H⁻¹ = I - Z T M⁻¹ T Z',    y'Py = y'H⁻¹y - (1'H⁻¹y)² / a,

whose gradient needs the diagonal of M⁻¹ only. Levels of effects that are nested in students meet
none of another student, so that M is factorised student by student, with the Schur complement of
the other effects. It starts where the quadratic forms
y'QZ_iZ_i'Qy have their expectations (Rao's MIVQUE of 0); the same equations tell whether the
observations tell the effects apart at all.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.scoring.errors import ReliabilityError

_LARGEST: Final = 1e4
"""Of a t: an effect of such a standard deviation, in that of chance, leaves nothing to chance."""

_NO_CHANCE: Final = 1e-6
"""Least share of the variance that is left to chance: less is rounding."""

_ALIKE: Final = 1e-9
"""Least eigenvalue of the equations, scaled to a diagonal of 1, of effects that are told apart."""

DRAWS: Final = 10_000
"""So many values are drawn of what the components may be as well."""

_SEED: Final = 2015
_FIRST: Final = 1e-3
"""A smaller t is all but 0, where the deviance is flat whichever way it goes from there."""


@dataclass(frozen=True, slots=True)
class RandomEffect:
    """One random effect.

    Attributes:
        name: for messages.
        levels: the level of each observation, counted from 0, shape (N,).
        nested: whether each level belongs to one student.
    """

    name: str
    levels: NDArray[np.intp]
    nested: bool


class _Deviance:
    """The restricted deviance as a function of the ratios of standard deviations.

    Args:
        y: observations, shape (N,).
        students: of each observation, counted from 0.
        effects: with one at least that is nested, and one that is not.
    """

    def __init__(
        self, y: FloatArray, students: NDArray[np.intp], effects: Sequence[RandomEffect]
    ) -> None:
        self.n = len(y)
        y_one = np.column_stack([y, np.ones(self.n)])
        self.inner = y_one.T @ y_one
        inside, self.own_inside = _columns([e for e in effects if e.nested], students)
        outside, self.own_outside = _columns([e for e in effects if not e.nested])
        self.inside = [place for place, e in enumerate(effects) if e.nested]
        self.outside = [place for place, e in enumerate(effects) if not e.nested]
        count, p, r = int(students.max()) + 1, len(self.own_inside), len(self.own_outside)
        self.a, self.b = np.zeros((count, p, p)), np.zeros((count, p, r))
        self.c = np.zeros((r, r))
        self.sums_inside, self.sums_outside = np.zeros((count, p, 2)), np.zeros((r, 2))
        for i in inside:
            np.add.at(self.sums_inside, (students, i), y_one)
            for j in inside:
                np.add.at(self.a, (students, i, j), 1.0)
            for j in outside:
                np.add.at(self.b, (students, i, j), 1.0)
        for i in outside:
            np.add.at(self.sums_outside, i, y_one)
            for j in outside:
                np.add.at(self.c, (i, j), 1.0)

    def __call__(self, t: FloatArray) -> tuple[float, FloatArray]:
        """Return the deviance and its gradient.

        Args:
            t: of each effect, in their order.
        """
        value, gradient, _ = self.at(t)
        return value, gradient

    def at(self, t: FloatArray) -> tuple[float, FloatArray, float]:
        """Return the deviance, its gradient, and y'Py."""
        ti = t[self.inside][self.own_inside]
        to = t[self.outside][self.own_outside]
        d = np.eye(len(ti)) + ti[:, None] * self.a * ti
        b = ti[:, None] * self.b * to
        inverse_d = np.linalg.inv(d)
        over = inverse_d @ b
        flat, flat_over = b.reshape(-1, len(to)), over.reshape(-1, len(to))
        schur = np.eye(len(to)) + to[:, None] * self.c * to - flat.T @ flat_over
        inverse = np.linalg.inv(schur)
        # M⁻¹ T Z' (y, 1), of the levels inside students and of the others
        scaled, scaled_out = ti[:, None] * self.sums_inside, to[:, None] * self.sums_outside
        up = inverse_d @ scaled
        out = inverse @ (scaled_out - np.einsum("spr,spk->rk", b, up))
        within = up - over @ out
        inner = self.inner - np.einsum("spk,spl->kl", scaled, within) - scaled_out.T @ out
        a = max(
            float(inner[1, 1]), 1e-12 * self.n
        )  # where nothing is left to chance it is rounding
        mean = float(inner[0, 1]) / a
        rest = max(float(inner[0, 0]) - mean * float(inner[0, 1]), 1e-300)
        log_m = float(np.linalg.slogdet(d)[1].sum()) + float(np.linalg.slogdet(schur)[1])
        value = log_m + np.log(a) + (self.n - 1) * np.log(rest)
        # levels less trace of M⁻¹, and squares of Z_i'H⁻¹x t_i, by effect
        lost = 1.0 - np.einsum("spp->sp", inverse_d) - ((over @ inverse) * over).sum(axis=-1)
        gradient = np.empty_like(t)
        for places, own, free, u in (
            (self.inside, self.own_inside, lost.sum(axis=0), within),
            (self.outside, self.own_outside, 1.0 - np.diagonal(inverse), out[None]),
        ):
            squares = (u[:, :, 1] ** 2).sum(axis=0) / a
            squares += (self.n - 1) / rest * ((u[:, :, 0] - mean * u[:, :, 1]) ** 2).sum(axis=0)
            for number, place in enumerate(places):
                slope = 2.0 * float((free - squares)[own == number].sum())
                gradient[place] = slope / float(t[place]) if abs(t[place]) > 1e-8 else 0.0
        return float(value), gradient, rest


def _columns(
    effects: Sequence[RandomEffect], students: NDArray[np.intp] | None = None
) -> tuple[list[NDArray[np.intp]], NDArray[np.intp]]:
    """Return the column of each observation in each effect, and the effect of each column.

    Args:
        effects: whose columns stand side by side.
        students: of each observation: columns are counted anew for each; None counts through.
    """
    columns, own, begin = [], [], 0
    for number, effect in enumerate(effects):
        place = effect.levels
        if students is not None:
            first = np.full(int(students.max()) + 1, len(students))
            np.minimum.at(first, students, place)
            place = place - first[students]
        width = int(place.max()) + 1
        columns.append(begin + place)
        own.append(np.full(width, number))
        begin += width
    return columns, np.concatenate(own)


def reml(
    points: FloatArray, students: NDArray[np.intp], effects: Sequence[RandomEffect]
) -> tuple[list[float], list[FloatArray]]:
    """Return the variance of each effect and, at last, of what is left; and draws of them.

    Args:
        points: observations, shape (N,), which differ.
        students: of each observation, counted from 0.
        effects: with one at least that is nested in students, and one that is not; the levels of a
            student follow one another.

    Draws are of the ratios to what is left, by the curvature at the estimate; there are none where
    it is not that of a minimum.

    Raises:
        ReliabilityError: where the observations do not tell two effects apart, or leave nothing to
            chance.
    """
    from scipy.optimize import minimize

    size = float(points.std())
    y = (points - points.mean()) / size
    best = _start(y, effects)
    deviance = _Deviance(y, students, effects)
    for _ in range(4):
        answer = minimize(
            deviance,
            best,
            jac=True,
            method="L-BFGS-B",
            bounds=[(-_LARGEST, _LARGEST)] * len(effects),
            options={"ftol": 1e-16, "gtol": 1e-9, "maxiter": 500, "maxls": 50},
        )
        best = np.abs(answer.x)
        grown = _grown_from_zero(deviance, best)
        if (grown == best).all():
            break
        best = grown
    chance = deviance.at(best)[2] / (len(y) - 1)
    if best.max() >= 0.99 * _LARGEST or chance < _NO_CHANCE:
        raise ReliabilityError(
            sentence(
                "the points repeat exactly and leave nothing to chance, with cells missing: take "
                "in more attempts, or a set in which every student has every exercise"
            )
        )
    chance *= size * size
    draws = [chance * t * t for t in _drawn(deviance, best)]
    draws += [np.full(DRAWS, chance)] if draws else []
    return [*(float(t * t * chance) for t in best), chance], draws


def _drawn(deviance: _Deviance, best: FloatArray) -> list[FloatArray]:
    """Return what each t may be as well, normal by the curvature of the deviance at its least.

    The deviance is -2 log of the likelihood, so that the covariance is twice its inverse curvature.
    A t that is all but 0 stays there. Returns none where the curvature is not that of a minimum.
    """
    free = np.flatnonzero(best >= _FIRST)
    curvature = np.empty((len(free), len(free)))
    for row, place in enumerate(free):
        step = np.zeros_like(best)
        step[place] = 1e-4 * max(float(best[place]), 0.1)
        slopes = deviance.at(best + step)[1] - deviance.at(best - step)[1]
        curvature[row] = slopes[free] / (2.0 * step[place])
    curvature = 0.5 * (curvature + curvature.T)
    if not len(free) or np.linalg.eigvalsh(curvature)[0] <= 0.0:
        return []
    spread = np.linalg.cholesky(2.0 * np.linalg.inv(curvature))
    drawn = np.tile(best, (DRAWS, 1))
    drawn[:, free] += np.random.default_rng(_SEED).standard_normal((DRAWS, len(free))) @ spread.T
    return list(drawn.T)


def _grown_from_zero(deviance: _Deviance, t: FloatArray) -> FloatArray:
    """Return each t that is all but 0 made larger where the deviance falls on the way."""
    grown = t.copy()
    for place in np.flatnonzero(t < _FIRST):
        trial = t.copy()
        trial[place] = _FIRST
        if deviance.at(trial)[1][place] < 0.0:
            grown[place] = 10.0 * _FIRST
    return grown


def _start(y: FloatArray, effects: Sequence[RandomEffect]) -> FloatArray:
    """Return where the search begins, by expectations of quadratic forms.

    Raises:
        ReliabilityError: where effects are not told apart.
    """
    levels, names = [e.levels for e in effects], [e.name for e in effects]
    n, m = len(y), len(levels)
    matrix, right = np.empty((m + 1, m + 1)), np.empty(m + 1)
    counts = [np.bincount(own).astype(np.float64) for own in levels]
    for i, a in enumerate(levels):
        for j, b in enumerate(levels[: i + 1]):
            # |Z_a'Q Z_b|², Q taking the mean off, over the pairs of levels that there are
            both, times = np.unique(a * len(counts[j]) + b, return_counts=True)
            row, column = np.divmod(both, len(counts[j]))
            product = counts[i][row] * counts[j][column]
            squares = float((times.astype(np.float64) ** 2 - 2.0 / n * times * product).sum())
            squares += float((counts[i] ** 2).sum() * (counts[j] ** 2).sum()) / n**2
            matrix[i, j] = matrix[j, i] = squares
        matrix[i, m] = matrix[m, i] = n - float((counts[i] ** 2).sum()) / n
        right[i] = float((np.bincount(a, weights=y) ** 2).sum())
    matrix[m, m], right[m] = n - 1, float(y @ y)
    size = np.sqrt(np.diagonal(matrix))
    scaled = matrix / np.maximum(np.outer(size, size), 1e-300)
    if size.min() <= 0.0 or np.linalg.eigvalsh(scaled)[0] < _ALIKE:
        closest = np.abs(np.tril(scaled, -1)).round(9)
        other, effect = np.unravel_index(int(closest.argmax()), closest.shape)
        raise ReliabilityError(
            sentence(
                "too many cells are missing: these {attempts} attempts do not tell {effect} from "
                "{other}; take in students who have the same exercises, twice at least",
                attempts=n,
                effect=names[effect],
                other=[*names, "residual"][other],
            )
        )
    found = np.linalg.solve(matrix, right)
    ratios = np.maximum(found[:m], 0.0) / max(float(found[m]), 1e-2)
    return np.clip(np.sqrt(ratios), 0.1, 10.0)
