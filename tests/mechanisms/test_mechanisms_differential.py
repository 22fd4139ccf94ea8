"""Derivatives against complex step and differences; postures, singularities, workspace, closure."""

import numpy as np
import pytest

from app.core.compiled import njit
from app.mechanisms.pantograph import (
    ASSEMBLIES,
    WORKING_MODES,
    Singularity,
    branches,
    dexterity,
    forward,
    inverse,
    jacobian,
    jacobian_rate,
    passive_angles,
    singularity,
    working_mode,
)
from app.mechanisms.pantograph.differential import singularity_kernel
from app.mechanisms.pantograph.dynamics import links
from app.mechanisms.pantograph.kernels import forward_kernel, inverse_kernel, jacobian_kernel
from app.mechanisms.profile import load_profile

PROFILE = load_profile("icube")
GEOMETRY = PROFILE.pantograph
COMPLEX_STEP = 1e-30


def tool_points(n: int, tilt_deg: float = 45.0, seed: int = 7) -> np.ndarray:
    """Random tool points of needles up to a tilt, even over the disc, shape (n, 2)."""
    rng = np.random.default_rng(seed)
    radius = GEOMETRY.fulcrum[2] * np.tan(np.radians(tilt_deg)) * np.sqrt(rng.uniform(0, 1, n))
    turn = rng.uniform(0.0, 2.0 * np.pi, n)
    return GEOMETRY.fulcrum[:2] + np.column_stack([radius * np.cos(turn), radius * np.sin(turn)])


def configurations(n: int, seed: int = 11) -> list[tuple[np.ndarray, int]]:
    """Random joint angles over the full turn with either assembly, away from the meeting elbows."""
    rng, found = np.random.default_rng(seed), []
    while len(found) < n:
        q, assembly = rng.uniform(-np.pi, np.pi, 2), int(rng.choice(ASSEMBLIES))
        if abs(singularity(GEOMETRY, q, assembly).parallel) > 0.05:
            found.append((q, assembly))
    return found


def complex_forward(q: np.ndarray, assembly: int) -> np.ndarray:
    """Forward kinematics written anew, for complex angles."""
    a1, a2, base = GEOMETRY.links
    left = a1 * np.array([np.cos(q[0]), np.sin(q[0])]) - np.array([base / 2, 0.0])
    right = a1 * np.array([np.cos(q[1]), np.sin(q[1])]) + np.array([base / 2, 0.0])
    e = right - left
    l2 = e @ e
    height = np.sqrt((a2 * a2 - l2 / 4) / l2)
    return 0.5 * (left + right) + assembly * height * np.array([-e[1], e[0]])


def complex_jacobian(q: np.ndarray, assembly: int) -> np.ndarray:
    columns = [complex_forward(q + 1j * COMPLEX_STEP * e, assembly).imag for e in np.eye(2)]
    return np.column_stack(columns) / COMPLEX_STEP


def test_the_jacobian_is_the_complex_step_of_an_independent_forward():
    for q, assembly in configurations(300):
        exact = complex_jacobian(q, assembly)
        error = np.abs(jacobian(GEOMETRY, q, assembly) - exact).max() / np.abs(exact).max()
        assert error < 1e-13


def test_the_jacobians_rate_is_its_derivative_along_the_motion():
    """J(q + i h q̇) by complex step of the formula with sines and cosines of complex angles."""
    a1, a2, base = GEOMETRY.links
    rng = np.random.default_rng(2)
    for q, assembly in configurations(200, seed=5):
        rates = rng.uniform(-3.0, 3.0, 2)
        z = q + 1j * COMPLEX_STEP * rates
        p = complex_forward(z, assembly)
        c2, s2 = (p[0] - a1 * np.cos(z[0]) + base / 2) / a2, (p[1] - a1 * np.sin(z[0])) / a2
        c2r, s2r = (p[0] - a1 * np.cos(z[1]) - base / 2) / a2, (p[1] - a1 * np.sin(z[1])) / a2
        closing = s2r * c2 - c2r * s2
        left = a1 * (s2 * np.cos(z[0]) - c2 * np.sin(z[0])) / closing
        right = a1 * (s2r * np.cos(z[1]) - c2r * np.sin(z[1])) / closing
        matrix = np.array([[s2r * left, -s2 * right], [-c2r * left, c2 * right]])
        exact = matrix.imag / COMPLEX_STEP
        found = jacobian_rate(GEOMETRY, q, rates, assembly)
        assert np.abs(found - exact).max() < 1e-11 * np.abs(exact).max()


def test_the_jacobians_rate_times_the_rates_is_the_acceleration_of_the_dynamics():
    rates = np.array([1.2, -0.8])
    for p3 in tool_points(20):
        q = inverse(GEOMETRY, p3)
        turns = np.cos(q[0]), np.sin(q[0]), np.cos(q[1]), np.sin(q[1])
        u = links.distal_kernel(turns, *p3, *GEOMETRY.links)
        lengths = GEOMETRY.proximal, GEOMETRY.distal
        speeds = links.speeds_kernel(links.passive_rates_kernel(turns, u, *lengths), *rates)
        moved = links.passive_acceleration_kernel(turns, u, speeds, *lengths)
        assert jacobian_rate(GEOMETRY, q, rates) @ rates == pytest.approx(moved[2:], abs=1e-13)


@njit(cache=False)
def _closure(q, links, errors, distances):
    a1, a2, base = links
    for k in range(len(q)):
        status, x, y = forward_kernel(q[k, 0], q[k, 1], a1, a2, base, 1.0)
        if status != 0:
            errors[k] = -1.0
            continue
        left, right, parallel = singularity_kernel(q[k, 0], q[k, 1], x, y, a1, a2, base)
        distances[k] = min(abs(left), abs(right), abs(parallel))
        modes = (-1.0 if left > 0.0 else 1.0), (-1.0 if right > 0.0 else 1.0)
        status, q1, q2 = inverse_kernel(x, y, a1, a2, base, modes[0], modes[1])
        status_2, x2, y2 = forward_kernel(q1, q2, a1, a2, base, 1.0)
        if status != 0 or status_2 != 0:
            errors[k] = -2.0
            continue
        errors[k] = np.hypot(x2 - x, y2 - y)


@pytest.mark.long("statistics")
def test_a_million_random_configurations_close():
    """Forward, inverse in the configuration's own working mode, forward: all turns of both motors.

    Nearer to the meeting elbows no formula in double precision can hold the bound: the last bit of
    an angle moves P3 by 1e-16 a2/l22' (tests/hard).
    """
    n = 1_000_000
    q = np.random.default_rng(1).uniform(-np.pi, np.pi, (n, 2))
    errors, distances = np.zeros(n), np.zeros(n)
    _closure(q, GEOMETRY.links, errors, distances)
    regular = errors[distances > 1e-6]
    assert len(regular) > 0.999 * n
    assert regular.min() >= 0.0  # every one has an answer
    assert np.median(regular) <= 1e-15
    assert regular.max() <= 1e-12


def test_inverse_has_all_working_modes_and_says_in_which_assembly_each_returns():
    seen = set()
    for p3 in tool_points(50):
        for branch in branches(GEOMETRY, p3):
            assert branch.status == 0
            back = forward(GEOMETRY, branch.q, branch.assembly)
            assert back == pytest.approx(p3, abs=1e-14)
            away = forward(GEOMETRY, branch.q, -branch.assembly)
            assert np.linalg.norm(away - p3) > 1e-3
            assert working_mode(GEOMETRY, branch.q, branch.assembly) == branch.mode
            seen.add((branch.mode, branch.assembly))
    assert {mode for mode, _ in seen} == set(WORKING_MODES)


def test_a_point_that_an_arm_does_not_reach_has_no_branches():
    for branch in branches(GEOMETRY, (0.0, 0.4)):
        assert branch.status.name == "UNREACHABLE"
        assert branch.assembly == 0
        assert not branch.q.any()


def test_passive_angles_are_those_between_the_links():
    a1, a2, base = GEOMETRY.links
    for q, assembly in configurations(50, seed=3):
        angles, p3 = passive_angles(GEOMETRY, q, assembly), forward(GEOMETRY, q, assembly)
        for side, turn, absolute, relative in (
            (-1, q[0], angles.left_absolute, angles.left_relative),
            (1, q[1], angles.right_absolute, angles.right_relative),
        ):
            elbow = np.array([side * base / 2 + a1 * np.cos(turn), a1 * np.sin(turn)])
            for end in (absolute, turn + relative):
                along = np.array([np.cos(end), np.sin(end)])
                assert elbow + a2 * along == pytest.approx(p3, abs=1e-15)
            assert -np.pi < relative <= np.pi


def test_relative_passive_angles_have_the_signs_of_the_thesis_mode():
    angles = passive_angles(GEOMETRY, inverse(GEOMETRY, GEOMETRY.fulcrum[:2]))
    assert angles.left_relative < 0.0 < angles.right_relative  # errata B4


def test_both_kinds_of_singularity_are_named():
    assert singularity(GEOMETRY, inverse(GEOMETRY, (0.0, 0.16))).kind is Singularity.REGULAR
    meeting = np.arccos(GEOMETRY.base / (2.0 * GEOMETRY.proximal))
    assert np.degrees(meeting) == pytest.approx(64.849, abs=5e-4)
    q = np.array([meeting, np.pi - meeting])
    assert singularity(GEOMETRY, q).kind is Singularity.PARALLEL
    reach = GEOMETRY.proximal + GEOMETRY.distal
    high = (0.0, np.sqrt(reach**2 - GEOMETRY.base**2 / 4) * (1 - 1e-15))
    assert singularity(GEOMETRY, inverse(GEOMETRY, high)).kind is Singularity.SERIAL_BOTH
    along = np.array([np.cos(1.265), np.sin(1.265)])
    aside = np.array([-GEOMETRY.base / 2, 0.0]) + reach * (1 - 1e-15) * along
    kind = singularity(GEOMETRY, inverse(GEOMETRY, aside)).kind
    assert kind is Singularity.SERIAL_LEFT


def test_the_sines_are_the_factors_of_the_jacobians_determinant():
    """det J = a1² sin(θ2-θ1) sin(θ2'-θ1') / sin(θ2'-θ2)."""
    for q, assembly in configurations(50, seed=8):
        m = singularity(GEOMETRY, q, assembly)
        product = GEOMETRY.proximal**2 * m.serial_left * m.serial_right / m.parallel
        assert np.linalg.det(jacobian(GEOMETRY, q, assembly)) == pytest.approx(product, abs=1e-15)


def test_dexterity_is_the_reciprocal_condition_number():
    for q, assembly in configurations(50, seed=9):
        j = jacobian(GEOMETRY, q, assembly)
        assert dexterity(j) == pytest.approx(1.0 / np.linalg.cond(j), rel=1e-10)
    assert dexterity(np.eye(2)) == 1.0
    assert dexterity([[1.0, 2.0], [2.0, 4.0]]) == 0.0
    assert dexterity(np.zeros((2, 2))) == 0.0


def test_the_kernels_and_the_functions_are_one():
    q = inverse(GEOMETRY, (0.02, 0.18))
    entries = jacobian_kernel(*q, 0.02, 0.18, *GEOMETRY.links)
    assert entries[0] == 0
    assert jacobian(GEOMETRY, q).ravel() == pytest.approx(entries[1:], abs=1e-15)
