"""Whether the points are those they are named after: swapped ones and single wrong ones."""

from dataclasses import dataclass
from itertools import combinations, permutations
from math import factorial

import numpy as np

from app.core.arrays import FloatArray
from app.core.confidence import f_quantile
from app.planning.registration.errors import DegenerateFiducialsError
from app.planning.registration.rigid import RigidFit, rigid_fit

MOST_PERMUTATIONS = 5040
"""Up to seven points every order is tried; beyond, exchanges of two."""
SWAP_GAIN = 9.0
"""Another order is named where its sum of squares is smaller by this factor, and within limits."""
OUTLIER_PROBABILITY = 0.01
"""A good set of points is blamed for a wrong one with at most this probability."""


@dataclass(frozen=True, slots=True)
class Reordering:
    """An order in which the points fit far better.

    Attributes:
        order: measured point `order[i]` belongs to reference point i.
        fre: weighted root mean square residual in that order [m].
    """

    order: tuple[int, ...]
    fre: float

    @property
    def moved(self) -> tuple[int, ...]:
        """Reference points that another point belongs to."""
        return tuple(i for i, j in enumerate(self.order) if i != j)


@dataclass(frozen=True, slots=True)
class Outlier:
    """One point without which the others agree.

    Attributes:
        index: which point.
        distance: how far it lies from where the others put it [m].
        fre: of the others [m].
    """

    index: int
    distance: float
    fre: float


def better_order(fit: RigidFit, tolerance: float) -> Reordering | None:
    """Find the order of the measured points that fits best, where it is far better than the given.

    Args:
        fit: of the points in the given order; its weights are not used.
        tolerance: residuals (root mean square [m]) that need no explanation.
    """
    if fit.fre <= tolerance:
        return None
    orders = _orders(fit.count)
    squares = order_sums(fit.reference, fit.measured, orders)
    best = int(np.argmin(squares))
    given = float(np.sum(fit.residuals**2))
    if squares[best] * SWAP_GAIN > given or squares[best] > fit.count * tolerance**2:
        return None
    return Reordering(
        tuple(orders[best].tolist()), float(np.sqrt(max(squares[best], 0.0) / fit.count))
    )


def order_sums(x: FloatArray, y: FloatArray, orders: FloatArray) -> FloatArray:
    """Smallest sum of squared residuals [m²] of fitting y[order] to x, for each order, shape (m,).

    From the singular values alone: Σ|dx|² + Σ|dy|² - 2 (s₁ + s₂ ± s₃) (Umeyama 1991, eq. 33).
    """
    dx, dy = x - x.mean(axis=0), y - y.mean(axis=0)
    cross = np.einsum("ni,mnj->mij", dx, dy[orders])
    values = np.linalg.svd(cross, compute_uv=False)
    values[:, 2] *= np.sign(np.linalg.det(cross))
    total = float(np.sum(dx**2) + np.sum(dy**2))
    result: FloatArray = np.maximum(total - 2.0 * values.sum(axis=1), 0.0)
    return result


def outlier(fit: RigidFit, tolerance: float) -> Outlier | None:
    """Find the one point that does not belong, by leaving out each.

    The fall of the sum of squares against what remains is F(3, 3 N - 9) for a good point (an
    externally studentised residual); the limit is divided among the N points. With four points
    the limit is a factor of 6 between residuals, with three nothing can be said.

    Args:
        fit: of all points.
        tolerance: a point that the others put within this distance [m] is not blamed.
    """
    freedom = fit.freedom - 3
    if freedom < 3:
        return None
    limit = f_quantile(1.0 - OUTLIER_PROBABILITY / fit.count, 3, freedom)
    found: list[tuple[float, Outlier]] = []
    for i in range(fit.count):
        keep = np.arange(fit.count) != i
        try:
            rest = rigid_fit(fit.reference[keep], fit.measured[keep], fit.weights[keep])
        except DegenerateFiducialsError:
            continue  # without it the others fix no rotation, so it cannot be judged by them
        scale = float(fit.weights[keep].mean())  # the fit's weights have mean 1 again
        remaining = rest.sum_of_squares * scale
        gap = fit.measured[i] - rest.T_measured_reference @ fit.reference[i]
        distance = float(np.linalg.norm(gap))
        drop = (fit.sum_of_squares - remaining) * freedom / 3.0
        if drop > limit * remaining and distance > tolerance:
            found.append((remaining, Outlier(i, distance, rest.fre)))
    return min(found, key=lambda entry: entry[0])[1] if found else None


def _orders(count: int) -> FloatArray:
    if factorial(count) <= MOST_PERMUTATIONS:
        return np.array(list(permutations(range(count))))
    orders = [list(range(count))]
    for i, j in combinations(range(count), 2):
        order = list(range(count))
        order[i], order[j] = j, i
        orders.append(order)
    return np.array(orders)


def likeness(points: FloatArray) -> float:
    """Return how well the points fit themselves in the best other order (root mean square [m]).

    Zero for a square or any body with a symmetry: a swap of its points cannot be found.
    """
    orders = _orders(len(points))
    others = orders[np.any(orders != np.arange(len(points)), axis=1)]
    return float(np.sqrt(order_sums(points, points, others).min() / len(points)))
