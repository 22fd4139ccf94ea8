"""Cables of the tensegrity needle holder: lengths, equilibrium, pretension, stiffness."""

import numpy as np
import pytest
from scipy.integrate import quad_vec
from scipy.optimize import minimize

from app.core.arrays import unit
from app.mechanisms.errors import DegenerateError, MechanismError, NotFiniteError
from app.mechanisms.tensegrity import (
    CABLE_ENDS,
    Cables,
    CurvedBars,
    JointReading,
    TensegrityGeometry,
    TensionVerdict,
    force_limit,
    guide_direction,
    guide_stiffness,
    hub_force,
    hub_torques,
    inverse,
    jacobian,
    joint_rates,
    joint_stiffness,
    length_curvature,
    length_jacobian,
    lengths,
    machine_points,
    remote_centre_stiffness,
    slack,
    tensions,
    torque_limits,
    torques,
)
from app.mechanisms.tensegrity.cable_kernels import pulled_kernel, stretch_kernel

READINGS = [TensegrityGeometry(reading=reading) for reading in JointReading]
both = pytest.mark.parametrize("geometry", READINGS, ids=lambda g: g.reading.value)
PAPER = READINGS[0]
CABLES = Cables()
STIFFENING = Cables(stiffness=4e3, stiffening=300.0)


def poses(count, seed=0, tilt=40.0):
    """Directions (count, 3) within a cone."""
    rng = np.random.default_rng(seed)
    half, turn = np.deg2rad(tilt) * np.sqrt(rng.uniform(size=count)), rng.uniform(0, 7, count)
    return np.stack([np.sin(half) * np.cos(turn), np.sin(half) * np.sin(turn), np.cos(half)], 1)


@both
def test_lengths_are_the_distances_of_the_joints(geometry):
    for t in poses(20):
        shown = machine_points(geometry, t).points
        drawn = [np.linalg.norm(shown[a] - shown[b]) for a, b in CABLE_ENDS]
        assert lengths(geometry, inverse(geometry, t)) == pytest.approx(drawn, abs=1e-14)


@both
def test_both_derivatives_of_the_lengths_agree_with_differences_and_have_their_signs(geometry):
    h = 1e-5
    for angle in np.linspace(0.05, np.pi - 0.05, 60):
        beta = np.array([angle, np.pi - angle])
        first, second = length_jacobian(geometry, beta), length_curvature(geometry, beta)
        for i, d in enumerate(h * np.eye(2)):
            slope = (lengths(geometry, beta + d) - lengths(geometry, beta - d)) / (2.0 * h)
            assert first[:, i] == pytest.approx(slope, abs=1e-10)
            up, down = length_jacobian(geometry, beta + d), length_jacobian(geometry, beta - d)
            assert second[:, i] == pytest.approx((up - down)[:, i] / (2.0 * h), abs=1e-9)
        own = first[0, 0], -first[1, 0], first[2, 1], -first[3, 1]
        assert min(own) > 0.0
        assert second.max() <= 0.0


@both
@pytest.mark.parametrize("cables", [CABLES, STIFFENING])
def test_feasible_loads_are_held_to_1e_10_within_the_limits(geometry, cables):
    rng = np.random.default_rng(1)
    for t in poses(200, seed=2):
        beta = inverse(geometry, t)
        low, high = torque_limits(geometry, cables, beta).T
        load = low + rng.uniform(0.001, 0.999, 2) * (high - low)
        for wanted in (None, rng.uniform(1.0, 300.0, 2)):
            found = tensions(geometry, cables, beta, load, wanted)
            held = torques(geometry, beta, found.tensions)
            assert held == pytest.approx(load, abs=1e-10)
            assert found.tensions.min() >= cables.least
            assert found.tensions.max() <= cables.most
            assert found.shortfall.tolist() == [0.0, 0.0]


@both
def test_a_load_beyond_the_limits_leaves_them_kept_and_its_shortfall_said(geometry):
    beta = inverse(geometry, (0.1, 0.2, 1.0))
    low, high = torque_limits(geometry, CABLES, beta).T
    for load in (high + [0.2, 0.3], low - [0.2, 0.3], [high[0] + 0.2, low[1] - 0.3]):
        found = tensions(geometry, CABLES, beta, load)
        assert set(found.tensions) == {CABLES.least, CABLES.most}
        held = torques(geometry, beta, found.tensions)
        assert held + found.shortfall == pytest.approx(load, abs=1e-12)
        assert np.abs(found.shortfall) == pytest.approx([0.2, 0.3], abs=1e-12)
        assert found.verdicts == (TensionVerdict.TORQUE_SHORT,) * 2


def test_without_a_request_the_tensions_have_the_least_norm():
    rng = np.random.default_rng(3)
    for t in poses(10, seed=4):
        beta = inverse(PAPER, t)
        low, high = torque_limits(PAPER, CABLES, beta).T
        load = low + rng.uniform(0.1, 0.9, 2) * (high - low)
        found = tensions(PAPER, CABLES, beta, load).tensions
        whole = minimize(
            lambda x: 0.5 * x @ x,
            np.full(4, 30.0),
            jac=lambda x: x,
            method="SLSQP",
            bounds=[(CABLES.least, CABLES.most)] * 4,
            constraints={
                "type": "eq",
                "fun": lambda x, at=beta, to=load: torques(PAPER, at, x) - to,
                "jac": lambda x, at=beta: -length_jacobian(PAPER, at).T,
            },
            options={"ftol": 1e-14, "maxiter": 200},
        )
        assert found == pytest.approx(whole.x, abs=1e-4)


@pytest.mark.parametrize("cables", [CABLES, STIFFENING, Cables(stiffening=13.0)])
def test_a_stiffness_within_the_range_is_met_and_one_beyond_it_gets_the_nearest(cables):
    for t in poses(50, seed=5):
        beta, load = inverse(PAPER, t), (0.3, -0.2)
        soft, hard = tensions(PAPER, cables, beta, load).stiffness_range.T
        middle = 0.5 * (soft + hard)
        found = tensions(PAPER, cables, beta, load, middle)
        assert torques(PAPER, beta, found.tensions) == pytest.approx(load, abs=1e-10)
        assert found.stiffness == pytest.approx(middle, rel=2e-3)
        for beyond, end in ((0.5 * soft, soft), (2.0 * hard, hard)):
            limited = tensions(PAPER, cables, beta, load, beyond)
            assert limited.stiffness == pytest.approx(end, rel=2e-3)
            assert limited.verdicts == (TensionVerdict.STIFFNESS_LIMITED,) * 2


@pytest.mark.parametrize("cables", [CABLES, STIFFENING, Cables(stiffening=13.0)])
def test_tensions_have_no_jump_along_a_path_through_all_limits(cables):
    """Through poses, loads and requests, the slope of stiffness changing its sign on the way."""

    def at(s):
        beta = (0.1 + 2.9 * s, 3.04 - 2.9 * s)
        load = (5.0 * np.sin(23.0 * s), 5.0 * np.cos(17.0 * s))
        wanted = (150.0 + 100.0 * np.sin(31.0 * s), 100.0 + 60.0 * np.cos(5.0 * s))
        return tensions(PAPER, cables, beta, load, wanted).tensions

    grid = np.linspace(0.0, 1.0, 8001)
    steps = np.abs(np.diff([at(s) for s in grid], axis=0)).max(axis=1)
    for worst in np.argsort(steps)[-30:]:
        low, high = grid[worst], grid[worst + 1]
        for _ in range(25):  # into the half that holds more of the change: a jump would stay
            middle = 0.5 * (low + high)
            left, right = (np.abs(np.subtract(at(x), at(middle))).max() for x in (low, high))
            low, high = (low, middle) if left > right else (middle, high)
        assert np.abs(at(high) - at(low)).max() < 1e-4


def test_the_programme_of_both_pantographs_falls_into_two():
    beta = inverse(PAPER, (0.2, -0.1, 1.0))
    whole = tensions(PAPER, CABLES, beta, (1.0, -1.0), (118.0, 110.0)).tensions
    first = tensions(PAPER, CABLES, (beta[0], 1.0), (1.0, 0.0), (118.0, 50.0)).tensions
    second = tensions(PAPER, CABLES, (2.0, beta[1]), (0.0, -1.0), (50.0, 110.0)).tensions
    assert whole.tolist() == [*first[:2], *second[2:]]


@both
def test_pretension_alone_softens_everywhere_and_a_stiffening_cable_stiffens(geometry):
    for angle in np.linspace(0.05, np.pi - 0.05, 60):
        beta = np.array([angle, angle])
        lever = length_jacobian(geometry, beta)
        null = np.array([-lever[1, 0], lever[0, 0], -lever[3, 1], lever[2, 1]])
        assert torques(geometry, beta, null) == pytest.approx([0.0, 0.0], abs=1e-16)
        softening = length_curvature(geometry, beta).T @ null
        assert softening.max() < 0.0
        sizes = np.linalg.norm(null.reshape(2, 2), axis=1) * geometry.radii
        assert (-softening / sizes).min() > 0.1, "steep enough to meet every request exactly"
        soft = [joint_stiffness(geometry, CABLES, beta, c * null) for c in (100.0, 500.0)]
        assert (soft[1] < soft[0]).all()
        if 0.5 < angle < 2.5:
            hard = [joint_stiffness(geometry, STIFFENING, beta, c * null) for c in (100.0, 500.0)]
            assert (hard[1] > hard[0]).all()


@both
@pytest.mark.parametrize("cables", [CABLES, STIFFENING])
def test_stiffness_is_the_second_derivative_of_the_energy_of_held_winches(geometry, cables):
    """Along great circles through the pose, with and without a load."""
    rng, h = np.random.default_rng(6), 1e-4
    for t in poses(10, seed=7):
        beta = inverse(geometry, t)
        for load in ((0.0, 0.0), (0.8, -0.7)):
            pulled = tensions(geometry, cables, beta, load).tensions
            rest = [
                length - stretch_kernel(f, cables.stiffness, cables.stiffening)
                for length, f in zip(lengths(geometry, beta), pulled, strict=True)
            ]

            def energy(direction, rest=rest):
                there = lengths(geometry, inverse(geometry, direction))
                law = cables.stiffness, cables.stiffening
                return sum(pulled_kernel(x, *law)[2] for x in there - rest)

            found = guide_stiffness(geometry, cables, t, pulled)
            assert found @ t == pytest.approx(np.zeros(3), abs=1e-10)
            for _ in range(3):
                w = rng.normal(size=3)
                w = unit(w - (w @ t) * t)
                up, down = (energy(np.cos(h) * t + s * np.sin(h) * w) for s in (1.0, -1.0))
                second = (up - 2.0 * energy(t) + down) / h**2
                assert w @ found @ w == pytest.approx(second, rel=1e-4, abs=1e-3)


def test_a_slack_cable_gives_no_stiffness_and_is_named():
    beta = inverse(PAPER, (0.0, 0.0, 1.0))
    lever = length_jacobian(PAPER, beta)
    pulled = np.array([0.0, 10.0, 5.0, 5.0])
    assert slack(pulled) == ("B1D1",)
    had = joint_stiffness(PAPER, CABLES, beta, pulled)
    curvature = length_curvature(PAPER, beta)[1, 0]
    alone = CABLES.stiffness * lever[1, 0] ** 2 + 10.0 * curvature
    assert had[0] == pytest.approx(alone, rel=1e-12)


def test_force_at_the_hub_and_torques_are_one_map_by_virtual_work():
    rng = np.random.default_rng(8)
    for t in poses(20, seed=9):
        beta, l_out = inverse(PAPER, t), 0.12
        by_joints, rates = jacobian(PAPER, beta), joint_rates(PAPER, beta)
        force = rng.normal(size=3)
        across = force - (force @ t) * t
        load = hub_torques(by_joints, force, l_out)
        moved = rng.normal(size=2)
        assert load @ moved == pytest.approx(force @ (l_out * by_joints @ moved), abs=1e-13)
        assert hub_force(rates, load, l_out) == pytest.approx(across, abs=1e-12)


@pytest.mark.long("statistics")
def test_the_force_limit_is_felt_in_every_direction_and_no_more_in_the_worst():
    for t in poses(10, seed=10):
        beta, l_out = inverse(PAPER, t), 0.15
        most = force_limit(PAPER, CABLES, beta, l_out)
        aside = unit(np.cross(t, (1.0, 0.3, 0.0)))
        other, by_joints = np.cross(t, aside), jacobian(PAPER, beta)
        short = []
        for turn in np.linspace(0.0, 2.0 * np.pi, 721):
            direction = np.cos(turn) * aside + np.sin(turn) * other
            for share in (0.999, 1.001):
                load = hub_torques(by_joints, share * most * direction, l_out)
                missing = np.abs(tensions(PAPER, CABLES, beta, load).shortfall).max()
                short.append((share, missing > 0.0))
        assert not any(missing for share, missing in short if share < 1.0)
        assert any(missing for share, missing in short if share > 1.0)


@pytest.mark.long("statistics")
@both
def test_compliance_of_the_remote_centre_is_the_energy_of_its_bars_by_quadrature(geometry):
    """One pantograph alone stands for a force shared by nobody: the other's bars made stiff."""
    bars, t = CurvedBars(), guide_direction(0.1, 1.3)
    shown = machine_points(geometry, t).points
    inertia, area = bars.width**4 / 12.0, bars.width**2
    torsion = 0.1406 * bars.width**4

    def compliance(near, far, radius):
        start, end = unit(shown[near]), unit(shown[far])
        normal = unit(np.cross(start, end))
        angle = np.arctan2(np.linalg.norm(np.cross(start, end)), start @ end)

        def section(phi):
            at = np.cos(phi) * start + np.sin(phi) * np.cross(normal, start)
            along = np.cross(normal, at)
            out = np.zeros((3, 3))
            for i, force_i in enumerate(np.eye(3)):
                for j, force_j in enumerate(np.eye(3)):
                    mi, mj = np.cross(radius * at, force_i), np.cross(radius * at, force_j)
                    out[i, j] = (mi @ along) * (mj @ along) / (bars.shear_modulus * torsion)
                    out[i, j] += (mi @ normal) * (mj @ normal) / (bars.modulus * inertia)
                    out[i, j] += (force_i @ along) * (force_j @ along) / (bars.modulus * area)
            return radius * out

        return quad_vec(section, 0.0, angle)[0]

    total = np.zeros((3, 3))
    for number, radius in zip("12", geometry.radii, strict=True):
        rhombi = [("A", "BD", "T")]
        if geometry.rhombi == 2:
            rhombi = [("A", "BD", "C"), ("C", "EF", "T")]
        give = np.zeros((3, 3))
        for near, pair, far in rhombi:
            held = np.zeros((3, 3))
            for joint in pair:
                chain = compliance(near + number, joint + number, radius)
                chain += compliance(joint + number, far + number, radius)
                held += np.linalg.inv(chain)
            give += np.linalg.inv(held)
        total += np.linalg.inv(give)
    found = remote_centre_stiffness(geometry, bars, t)
    assert found == pytest.approx(total, rel=1e-6)
    assert np.linalg.eigvalsh(found).min() > 0.0


def test_the_law_of_a_cable_is_its_own_inverse_and_derivative():
    for law in ((20e3, 0.0), (4e3, 300.0)):
        for tension in (0.5, 2.0, 60.0):
            stretch = stretch_kernel(tension, *law)
            pulled, stiffness, energy = pulled_kernel(stretch, *law)
            assert pulled == pytest.approx(tension, rel=1e-12)
            assert stiffness == pytest.approx(law[0] + law[1] * tension, rel=1e-12)
            h = 1e-7
            up, down = pulled_kernel(stretch + h, *law), pulled_kernel(stretch - h, *law)
            assert stiffness == pytest.approx((up[0] - down[0]) / (2.0 * h), rel=1e-6)
            assert tension == pytest.approx((up[2] - down[2]) / (2.0 * h), rel=1e-5)
            assert energy > 0.0
        assert pulled_kernel(-1e-3, *law) == (0.0, 0.0, 0.0)
        assert stretch_kernel(-1.0, *law) == 0.0


@pytest.mark.parametrize(
    "wrong",
    [
        {"stiffness": 0.0},
        {"stiffening": -1.0},
        {"least": -1.0},
        {"least": 60.0, "most": 60.0},
        {"most": float("nan")},
    ],
)
def test_impossible_cables_are_refused(wrong):
    with pytest.raises(MechanismError, match="cables: "):
        Cables(**wrong)


def test_bad_requests_are_refused_by_name():
    beta = inverse(PAPER, (0.0, 0.0, 1.0))
    with pytest.raises(NotFiniteError):
        tensions(PAPER, CABLES, beta, (np.nan, 0.0))
    with pytest.raises(MechanismError, match="more than 0"):
        tensions(PAPER, CABLES, beta, (0.0, 0.0), (0.0, 10.0))
    with pytest.raises(MechanismError, match="width"):
        CurvedBars(width=0.0)
    with pytest.raises(DegenerateError):
        hub_force(joint_rates(PAPER, beta), (0.1, 0.1), 0.0)
