"""The ways to compute a needle in a foundation, against higher precision and each other."""

import mpmath  # type: ignore[import-untyped]
import numpy as np
import pytest

from app.simulation.errors import SimulationError
from app.simulation.needles import OUTER_DIAMETER, bending_stiffness
from app.studies.lateral_tissue import (
    beam_moment,
    difference_moment,
    hermite_moment,
    rigid_moment,
    solve_banded,
    springs_moment,
)

K, TURN = 20e3, 0.1


def precise(k: float, ei: float, depth: float) -> float:
    """Solve w'''' = -4β⁴ w with its boundary conditions in 60 digits; not the closed form."""
    with mpmath.workdps(60):
        beta = (mpmath.mpf(k) / (4 * mpmath.mpf(ei))) ** mpmath.mpf("0.25")
        roots = [beta * (1 + 1j), beta * (1 - 1j), beta * (-1 + 1j), beta * (-1 - 1j)]
        d = mpmath.mpf(depth)
        rows = [
            [1 for r in roots],
            list(roots),
            [r**2 * mpmath.exp(r * d) for r in roots],
            [r**3 * mpmath.exp(r * d) for r in roots],
        ]
        c = mpmath.lu_solve(mpmath.matrix(rows), mpmath.matrix([0, TURN, 0, 0]))
        return float(mpmath.re(-ei * sum(c[i] * roots[i] ** 2 for i in range(4))))


@pytest.mark.parametrize("gauge", OUTER_DIAMETER)
@pytest.mark.parametrize("depth", [1e-4, 0.01, 0.06, 0.12])
def test_the_closed_form_solves_the_beam_equation(gauge: int, depth: float) -> None:
    ei = bending_stiffness(OUTER_DIAMETER[gauge])
    assert beam_moment(K, ei, depth, TURN) == pytest.approx(precise(K, ei, depth), rel=1e-12)


def test_the_closed_form_has_no_seam_where_the_series_ends() -> None:
    ei = bending_stiffness(1.27e-3)
    at = (4.0 * ei / K) ** 0.25
    below, above = beam_moment(K, ei, at * (1 - 1e-15), 1.0), beam_moment(K, ei, at, 1.0)
    assert below == pytest.approx(above, rel=5e-15)


def test_a_stiff_needle_is_rigid_and_an_endless_one_has_a_limit() -> None:
    assert beam_moment(K, 1e6, 0.1, TURN) == pytest.approx(rigid_moment(K, 0.1, TURN), rel=1e-6)
    beta = (K / (4.0 * 1e-3)) ** 0.25
    assert beam_moment(K, 1e-3, 1e9, TURN) == pytest.approx(2.0 * 1e-3 * beta * TURN)
    assert beam_moment(K, 1e-3, 0.0, TURN) == 0.0


def difference(n: int, ei: float) -> float:
    return float(difference_moment(K, ei, 0.1, TURN, np.empty((n, 3)), np.empty(n)))


def hermite(n: int, ei: float) -> float:
    work = np.empty((2 * n, 4)), np.empty(2 * n)
    return float(hermite_moment(np.full(n, K), ei, 0.1, TURN, *work))


@pytest.mark.long("machine")
@pytest.mark.parametrize(
    ("way", "order", "coarse"), [(difference, 2, 20), (hermite, 4, 8)], ids=["second", "fourth"]
)
def test_the_solvers_converge_at_their_order(way: object, order: int, coarse: int) -> None:
    ei = bending_stiffness(0.908e-3)
    exact = beam_moment(K, ei, 0.1, TURN)
    errors = [abs(way(n, ei) - exact) for n in (coarse, 2 * coarse)]  # type: ignore[operator]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.2)


def test_springs_converge_to_the_closed_form_of_the_rigid_needle() -> None:
    exact = rigid_moment(K, 0.1, TURN)
    errors = [abs(springs_moment(K, 0.1, TURN, n) - exact) for n in (10, 20)]
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=1e-6)


def test_elements_of_unlike_stiffness_agree_with_many_of_each() -> None:
    ei, n = bending_stiffness(0.908e-3), 10
    k = np.array([1e4] * 5 + [5e4] * 5)
    coarse = hermite_moment(k, ei, 0.1, TURN, np.empty((2 * n, 4)), np.empty(2 * n))
    fine = hermite_moment(np.repeat(k, 8), ei, 0.1, TURN, np.empty((160, 4)), np.empty(160))
    assert coarse == pytest.approx(fine, rel=1e-4)


def test_the_banded_solver_solves() -> None:
    random = np.random.default_rng(1)
    n, b = 12, 3
    matrix = np.zeros((n, n))
    for d in range(1, b + 1):
        matrix += np.diag(random.normal(size=n - d), -d)
    matrix = matrix + matrix.T + 10.0 * np.eye(n)
    band = np.array([[matrix[i, i - d] if i >= d else 0.0 for d in range(b + 1)] for i in range(n)])
    right = random.normal(size=n)
    x = right.copy()
    solve_banded(band, x)
    np.testing.assert_allclose(matrix @ x, right, atol=1e-12)


def test_a_beam_without_stiffness_is_refused() -> None:
    with pytest.raises(SimulationError, match="needs k > 0, EI > 0"):
        beam_moment(K, 0.0, 0.1, TURN)


def test_bending_stiffness_is_as_published() -> None:
    assert bending_stiffness(1.270e-3) == pytest.approx(0.0255, abs=5e-5)
    assert bending_stiffness(1.270e-3, 0.838e-3) == pytest.approx(0.0207, abs=5e-5)
