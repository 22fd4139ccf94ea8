"""Kinematics of the tensegrity needle holder: closed, against differences, by geometry."""

import numpy as np
import pytest

from app.core.arrays import angle_between
from app.mechanisms.errors import MechanismError, UnreachableError
from app.mechanisms.tensegrity import (
    JointReading,
    TensegrityGeometry,
    conditioning,
    encoder_error,
    forward,
    guide_angles,
    guide_direction,
    inverse,
    jacobian,
    jacobian_rate,
    joint_rates,
    machine_points,
    nearest,
    reaches,
    trilaterate,
)
from app.mechanisms.tensegrity.numerical import forward_by_root, newton_kernel

READINGS = [TensegrityGeometry(reading=reading) for reading in JointReading]
both = pytest.mark.parametrize("geometry", READINGS, ids=lambda g: g.reading.value)
PAPER = READINGS[0]


def reached(geometry, count, seed=0, least_height=0.0):
    """Directions (count, 3) spread evenly over the workspace."""
    rng, found = np.random.default_rng(seed), []
    normal = np.cross(*geometry.bases)
    while len(found) < count:
        t = rng.normal(size=3)
        t /= np.linalg.norm(t)
        if t @ normal >= least_height and reaches(geometry, t):
            found.append(t)
    return np.array(found)


@both
def test_the_direction_comes_back_through_the_joints_with_the_right_root(geometry):
    normal = np.cross(*geometry.bases)
    for t in reached(geometry, 3000):
        height = t @ normal
        error = np.linalg.norm(forward(geometry, inverse(geometry, t)) - t)
        assert error <= min(1e-14 / height, 1e-12 if height >= 0.01 else np.inf)


@both
def test_the_joints_come_back_through_the_direction(geometry):
    """To 1e-12; a pantograph that is almost stretched shows β only in √ of θ: 1e-15/sin(β/2)."""
    for t in reached(geometry, 3000, seed=1):
        beta = inverse(geometry, t)
        error = np.abs(inverse(geometry, forward(geometry, beta)) - beta).max()
        stretched = np.sin(0.5 * beta).min()
        assert error <= max(1e-12 if stretched > 2e-3 else 0.0, 4e-15 / stretched)


def test_both_roots_have_the_same_joints_and_a_tenth_of_them_look_up():
    up = 0
    rng, kept = np.random.default_rng(2), 0
    while kept < 2000:
        beta = rng.uniform(0.0, np.pi, 2)
        try:
            right, mirrored = forward(PAPER, beta), forward(PAPER, beta, -1)
        except UnreachableError:
            continue
        kept += 1
        normal = np.cross(*PAPER.bases)
        assert right @ normal >= 0.0 >= mirrored @ normal
        assert inverse(PAPER, mirrored, -1) == pytest.approx(beta, abs=1e-6)
        up += bool(right[2] > 0.0 and mirrored[2] > 0.0)
    assert 0.08 < up / kept < 0.13


def test_the_angles_are_those_of_the_papers_equations():
    t = guide_direction(0.2, 1.4)
    assert guide_angles(t) == pytest.approx((0.2, 1.4), abs=1e-15)
    assert guide_angles((0.0, 0.0, 1.0)) == (0.0, np.pi / 2.0)
    for beta, base, radius, reach in zip(
        inverse(PAPER, t),
        PAPER.bases,
        PAPER.radii,
        (PAPER.first_reach, PAPER.second_reach),
        strict=True,
    ):
        theta = angle_between(t, base)
        assert np.cos(beta / 2.0) == pytest.approx(radius / reach * np.tan(theta / 2.0), rel=1e-13)


def test_the_readings_agree_at_both_ends_and_differ_by_almost_14_degrees_between():
    rhombus, scissor = READINGS
    beta = np.linspace(0.0, np.pi, 2001)
    openings = []
    for geometry in (rhombus, scissor):
        gain, fold = geometry.bars[0], geometry.bars[2]
        openings.append(2.0 * fold * np.arctan(gain * np.cos(beta / 2.0)))
    apart = np.rad2deg(np.abs(openings[0] - openings[1]))
    assert apart[[0, -1]] == pytest.approx([0.0, 0.0], abs=1e-9)
    assert apart.max() == pytest.approx(13.8, abs=0.1)


@both
def test_the_jacobian_its_inverse_and_its_rate_agree_with_differences(geometry):
    rng = np.random.default_rng(3)
    for t in reached(geometry, 200, seed=4, least_height=0.1):
        beta = inverse(geometry, t)
        if min(np.sin(beta / 2.0).min(), np.cos(beta / 2.0).min()) < 0.05:
            continue
        rates, h = rng.normal(size=2), 1e-5
        columns = [
            (forward(geometry, beta + d) - forward(geometry, beta - d)) / (2.0 * h)
            for d in h * np.eye(2)
        ]
        found = jacobian(geometry, beta)
        assert found == pytest.approx(np.column_stack(columns), rel=1e-6, abs=1e-6)
        assert found.T @ forward(geometry, beta) == pytest.approx(np.zeros(2), abs=1e-13)
        assert joint_rates(geometry, beta) @ found == pytest.approx(np.eye(2), abs=1e-12)
        difference = (
            jacobian(geometry, beta + h * rates) - jacobian(geometry, beta - h * rates)
        ) / (2.0 * h)
        assert jacobian_rate(geometry, beta, rates) == pytest.approx(difference, rel=1e-5, abs=2e-4)


def test_the_numerical_ways_end_where_the_closed_form_is():
    for t in reached(PAPER, 50, seed=5, least_height=0.2):
        beta = inverse(PAPER, t)
        near = t + np.array([0.02, -0.01, 0.015])
        assert forward_by_root(PAPER, beta, near) == pytest.approx(t, abs=1e-10)
        status, *found, steps = newton_kernel(*beta, *near, 1e-15, *PAPER.bars)
        assert status == 0
        assert steps <= 8
        assert found == pytest.approx(t, abs=1e-13)


@both
def test_bars_keep_their_lengths_and_trilateration_finds_the_same_joints(geometry):
    lengths = {}
    for t in reached(geometry, 60, seed=6, least_height=0.05):
        shown = machine_points(geometry, t)
        for bar in shown.bars:
            length = np.linalg.norm(shown.points[bar[0]] - shown.points[bar[1]])
            assert length == pytest.approx(lengths.setdefault(bar, length), abs=1e-13)
        for number, radius in zip("12", geometry.radii, strict=True):
            a, c, end = (shown.points[name + number] for name in "ACT")
            far = end if geometry.rhombi == 1 else c
            bar = lengths["A" + number, "B" + number]
            for name, side in (("B", 1), ("D", -1)):
                found = trilaterate([np.zeros(3), a, far], [radius, bar, bar], side)
                assert found.point == pytest.approx(shown.points[name + number], abs=1e-9)
            theta = angle_between(a, end)
            chord = 2.0 * radius * np.sin(theta / 4.0)
            touched = trilaterate([np.zeros(3), a, end], [radius, chord, chord])
            assert touched.tangent
            assert touched.point == pytest.approx(c, abs=1e-6)


def test_the_joint_variable_is_the_angle_between_the_bars_at_the_base():
    for geometry in READINGS:
        t = guide_direction(0.1, 1.2)
        shown, beta = machine_points(geometry, t), inverse(geometry, t)
        for number, angle in zip("12", beta, strict=True):
            a, b, d = (shown.points[name + number] for name in "ABD")
            along = a / np.linalg.norm(a)
            sides = [v - (v @ along) * along for v in (b, d)]
            assert angle_between(*sides) == pytest.approx(angle, abs=1e-12)


@pytest.mark.parametrize("half_deg", [20.0, 40.0])
def test_the_assumed_tilts_cover_the_cone_in_both_its_readings(half_deg):
    worst = 0.0
    for half in np.deg2rad(np.linspace(0.0, half_deg, 12)):
        for turn in np.linspace(0.0, 2.0 * np.pi, 73):
            t = (np.sin(half) * np.cos(turn), np.sin(half) * np.sin(turn), np.cos(half))
            worst = max(worst, 1.0 / conditioning(PAPER, inverse(PAPER, t)).dexterity)
    assert worst == pytest.approx(1.7 if half_deg == 20.0 else 3.7, abs=0.3)


@pytest.mark.long("statistics")
@both
def test_the_nearest_direction_is_reached_and_none_is_nearer(geometry):
    rng = np.random.default_rng(7)
    spread = reached(geometry, 4000, seed=8)
    for _ in range(100):
        t = rng.normal(size=3)
        t /= np.linalg.norm(t)
        near = nearest(geometry, t)
        assert reaches(geometry, near)
        assert angle_between(near, t) <= np.arccos(np.clip(spread @ t, -1.0, 1.0)).min() + 1e-9
        if reaches(geometry, t):
            assert near == pytest.approx(t, abs=1e-15)
        inside = nearest(geometry, t, margin=0.02)
        measures = conditioning(geometry, inverse(geometry, inside))
        assert measures.kinds == ()


def test_a_direction_out_of_reach_is_refused_with_the_nearest_one():
    with pytest.raises(UnreachableError, match=r"the nearest within reach is .*° away"):
        inverse(PAPER, (1.0, 0.0, -1.0))


def test_encoders_of_500_lines_know_the_upright_guide_to_a_third_of_a_degree():
    beta = inverse(PAPER, (0.0, 0.0, 1.0))
    counts, edges = (encoder_error(PAPER, beta, steps) for steps in (500, 2000))
    step = 2.0 * np.pi / 500
    t = forward(PAPER, beta)
    moved = [
        angle_between(forward(PAPER, beta + 0.5 * step * np.array(signs)), t)
        for signs in ((1, 1), (1, -1), (-1, 1), (-1, -1))
    ]
    assert counts[0] == pytest.approx(max(moved), rel=0.02)
    assert edges[0] == pytest.approx(counts[0] / 4.0, rel=1e-12)
    rng = np.random.default_rng(9)
    off = [
        angle_between(forward(PAPER, beta + step * rng.uniform(-0.5, 0.5, 2)), t)
        for _ in range(2000)
    ]
    assert counts[1] == pytest.approx(np.sqrt(np.mean(np.square(off))), rel=0.05)
    angles = [
        np.abs(np.subtract(guide_angles(forward(PAPER, beta + step * np.array(s))), (0, np.pi / 2)))
        for s in ((1, 1), (1, -1))
    ]
    assert np.rad2deg(np.max(angles, axis=0)) == pytest.approx([0.67, 0.69], abs=0.03)


@pytest.mark.parametrize(
    "wrong",
    [
        {"first_radius": 0.0},
        {"second_reach": -0.1},
        {"first_reach": float("inf")},
        {"first_tilt": np.pi / 2.0},
        {"second_tilt": float("nan")},
        {"first_tilt": np.deg2rad(88.9), "second_tilt": np.deg2rad(88.9)},
        {"first_tilt": np.deg2rad(-88.9), "second_tilt": np.deg2rad(88.9)},
        {"first_reach": 0.04, "second_reach": 0.04},
        {"reading": "both"},
    ],
)
def test_impossible_bars_are_refused(wrong):
    with pytest.raises(MechanismError, match=r"geometry: "):
        TensegrityGeometry(**wrong)
