"""The tensegrity needle holder where it is stretched, folded, flat, overloaded or not a number.

Bounded answers or named errors, never NaN, never a jump; 60-digit references stand in the register
(`app/studies/hard_cases/tensegrity.py`).
"""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from app.core.arrays import angle_between
from app.core.errors import AcusError
from app.mechanisms.errors import DegenerateError, NotFiniteError, SingularError, UnreachableError
from app.mechanisms.status import NOT_FINITE, OK, SINGULAR, UNREACHABLE
from app.mechanisms.tensegrity import (
    Cables,
    CurvedBars,
    GuideSingularity,
    JointReading,
    TensegrityGeometry,
    TensionVerdict,
    conditioning,
    encoder_error,
    forward,
    guide_stiffness,
    inverse,
    jacobian,
    jacobian_rate,
    joint_rates,
    joint_stiffness,
    length_jacobian,
    lengths,
    machine_points,
    nearest,
    reaches,
    remote_centre_stiffness,
    tensions,
    torques,
    trilaterate,
)
from app.mechanisms.tensegrity.cable_kernels import tensions_kernel
from app.mechanisms.tensegrity.kernels import forward_kernel, inverse_kernel, jacobian_kernel

READINGS = [TensegrityGeometry(reading=reading) for reading in JointReading]
PAPER = READINGS[0]
CABLES = Cables()
RELAXED = settings(derandomize=True, deadline=None, max_examples=200)
anything = st.floats(allow_nan=True, allow_infinity=True)
angles = st.floats(0.0, np.pi)
machines = st.sampled_from(READINGS)
finite = st.floats(-1e3, 1e3)


@given(machines, st.tuples(anything, anything), st.tuples(anything, anything, anything))
@RELAXED
def test_any_number_gives_a_finite_answer_or_a_named_status(geometry, beta, t):
    status, *found = forward_kernel(*beta, *geometry.bars, 1.0)
    assert np.isfinite(found).all()
    assert status == OK or not any(found)
    status, *found = inverse_kernel(*t, *geometry.bars, 1.0)
    assert np.isfinite(found).all()
    assert status == OK or not any(found)
    status, *found = jacobian_kernel(*beta, *t, *geometry.bars)
    assert status != OK or np.isfinite(t + beta).all()


@given(machines, st.tuples(angles, angles))
@RELAXED
def test_joints_and_direction_close_to_the_law_of_their_conditions(geometry, beta):
    try:
        t = forward(geometry, beta)
    except UnreachableError:
        return
    assert np.linalg.norm(t) == pytest.approx(1.0, abs=4e-16)
    height = t @ np.cross(*geometry.bases)
    assert height >= -1e-15
    assume(min(beta) > 1e-7)
    found = inverse(geometry, t)
    assert np.abs(found - beta).max() <= 1e-14 / np.sin(0.5 * min(beta))
    assert np.linalg.norm(forward(geometry, found) - t) <= 1e-14 / max(height, 1e-8)


@pytest.mark.long("statistics")
@given(machines, st.tuples(finite, finite, finite))
@RELAXED
def test_every_direction_has_a_nearest_one_within_reach_that_is_its_own(geometry, t):
    assume(np.linalg.norm(t) > 1e-9)
    near = nearest(geometry, t)
    assert reaches(geometry, near)
    assert np.linalg.norm(nearest(geometry, near) - near) <= 1e-12
    if not reaches(geometry, t):
        with pytest.raises(UnreachableError, match="nearest within reach"):
            inverse(geometry, t)


@pytest.mark.parametrize("geometry", READINGS)
@pytest.mark.parametrize("gap", [1e-1, 1e-3, 1e-6, 1e-9, 1e-12, 0.0])
def test_a_stretched_or_folded_pantograph_is_named_and_all_else_is_finite(geometry, gap):
    for beta, kind in (
        ((gap, 1.9), GuideSingularity.EXTENDED_FIRST),
        ((1.9, gap), GuideSingularity.EXTENDED_SECOND),
    ):
        found = conditioning(geometry, beta, tolerance=1e-4)
        assert (kind in found.kinds) == (gap < 1e-4)
        assert np.isfinite(jacobian(geometry, beta)).all()
        assert np.isfinite(jacobian_rate(geometry, beta, (1.0, -1.0))).all()
        assert np.isfinite(encoder_error(geometry, beta)).all()
        assert np.isfinite(lengths(geometry, beta)).all()
        points = machine_points(geometry, forward(geometry, beta)).points
        assert all(np.isfinite(p).all() for p in points.values())
        if gap == 0.0:
            with pytest.raises(SingularError):
                joint_rates(geometry, beta)
            with pytest.raises(SingularError):
                guide_stiffness(geometry, CABLES, forward(geometry, beta), np.full(4, 5.0))


@pytest.mark.parametrize("geometry", READINGS)
def test_a_guide_on_a_base_joint_is_folded_and_flat_and_has_no_rhombus(geometry):
    for number, kind in enumerate((GuideSingularity.FOLDED_FIRST, GuideSingularity.FOLDED_SECOND)):
        base = geometry.bases[number]
        beta = inverse(geometry, base)
        assert beta[number] == pytest.approx(np.pi, abs=1e-15)
        found = conditioning(geometry, beta, tolerance=1e-7)
        assert kind in found.kinds
        assert GuideSingularity.FLAT in found.kinds
        assert forward(geometry, beta) == pytest.approx(base, abs=1e-7)
        with pytest.raises(DegenerateError, match="stands on A"):
            machine_points(geometry, base)
        with pytest.raises(DegenerateError):
            remote_centre_stiffness(geometry, CurvedBars(), base)
        with pytest.raises(UnreachableError):
            inverse(geometry, -base)


def test_both_pantographs_in_one_plane_are_flat_and_their_first_cables_parallel():
    first, second = PAPER.bases
    level = 0.7 * first + 0.6 * second
    beta = inverse(PAPER, level)
    found = conditioning(PAPER, beta, tolerance=1e-7)
    assert found.kinds == (GuideSingularity.FLAT,)
    shown = machine_points(PAPER, level).points
    pulls = [shown["B1"] - shown["D1"], shown["B2"] - shown["D2"]]
    assert min(angle_between(pulls[0], s * pulls[1]) for s in (1, -1)) < 1e-12
    held = tensions(PAPER, CABLES, beta, (0.5, -0.5))
    assert held.verdicts == (TensionVerdict.MET, TensionVerdict.MET)
    given_way = np.linalg.eigvalsh(guide_stiffness(PAPER, CABLES, level, held.tensions))
    assert np.abs(given_way[:2]).max() < 1.0  # along t, and the one that nothing holds
    assert jacobian_kernel(*beta, *level, *PAPER.bars)[0] == SINGULAR


@pytest.mark.parametrize("miss", [1e-15, 1e-13, 1e-11, 1e-9, 1e-6])
def test_cones_that_miss_each_other_touch_within_the_stated_room_and_are_unreachable_beyond(miss):
    """θ1 + θ2 = γ - miss: on the arc between the base axes."""
    gamma, (gain1, gain2) = PAPER.apart, PAPER.bars[:2]
    theta1 = 0.45 * gamma
    theta2 = gamma - theta1 - miss
    beta = [2.0 * np.arccos(np.tan(0.5 * x) / g) for x, g in ((theta1, gain1), (theta2, gain2))]
    if miss < 5e-13:
        t = forward(PAPER, beta)
        assert t @ np.cross(*PAPER.bases) == pytest.approx(0.0, abs=1e-6)
        assert angle_between(t, PAPER.bases[0]) == pytest.approx(theta1, abs=2e-12)
    elif miss > 2e-12:
        with pytest.raises(UnreachableError):
            forward(PAPER, beta)


@given(
    machines,
    st.tuples(angles, angles),
    st.tuples(finite, finite),
    st.one_of(st.none(), st.tuples(st.floats(1e-3, 1e6), st.floats(1e-3, 1e6))),
    st.sampled_from([CABLES, Cables(stiffening=13.0), Cables(least=0.0), Cables(4e3, 300.0)]),
)
@RELAXED
def test_tensions_keep_their_limits_and_hold_what_they_do_not_call_short(
    geometry, beta, load, wanted, cables
):
    found = tensions(geometry, cables, beta, load, wanted)
    assert found.tensions.min() >= cables.least
    assert found.tensions.max() <= cables.most
    held = torques(geometry, beta, found.tensions)
    assert held + found.shortfall == pytest.approx(load, abs=1e-10)
    assert np.isfinite(found.stiffness).all()
    for short, verdict in zip(found.shortfall, found.verdicts, strict=True):
        if abs(short) > 1e-9:
            assert verdict in (TensionVerdict.TORQUE_SHORT, TensionVerdict.SINGULAR)


@given(st.tuples(angles, angles), st.tuples(st.floats(-8.0, 8.0), st.floats(-8.0, 8.0)))
@RELAXED
def test_a_small_change_of_the_load_changes_tensions_by_no_more_than_its_lever_says(beta, load):
    """|Δt| ≤ |Δτ| / lever, at the limits of the polytope and of every cable."""
    lever = np.abs(length_jacobian(PAPER, beta)).max(axis=1)
    before = tensions(PAPER, CABLES, beta, load).tensions
    after = tensions(PAPER, CABLES, beta, np.add(load, 1e-6)).tensions
    weakest = min(lever[[0, 1]].min(), lever[[2, 3]].min())
    assert np.abs(after - before).max() <= 2e-6 / max(weakest, 1e-300) + 1e-9


@pytest.mark.parametrize("geometry", READINGS)
def test_without_a_lever_the_tensions_are_singular_bounded_and_have_no_jump(geometry):
    for at, other in ((0.0, 1e-13), (np.pi, np.pi - 1e-13)):
        for load in (-3.0, -0.1, 0.0, 0.1, 3.0):
            there = tensions(geometry, CABLES, (at, 1.5), (load, 0.0))
            near = tensions(geometry, CABLES, (other, 1.5), (load, 0.0))
            assert there.verdicts[0] is TensionVerdict.SINGULAR
            assert there.tensions == pytest.approx(near.tensions, abs=1e-6)


def test_the_status_of_the_loops_kernel_says_what_is_short_singular_or_no_number():
    rest = (0.0, 0.0, *CABLES.law, *PAPER.radii, *PAPER.bars)
    assert tensions_kernel(1.5, 1.9, 0.1, -0.1, *rest)[0] == OK
    assert tensions_kernel(1.5, 1.9, 9.0, -0.1, *rest)[0] == UNREACHABLE
    assert tensions_kernel(1.5, 0.0, 0.1, -0.1, *rest)[0] == SINGULAR
    status, *found = tensions_kernel(np.nan, 1.9, 0.1, -0.1, *rest)
    assert status == NOT_FINITE
    assert found == [CABLES.least] * 4 + [0.0, 0.0]


@given(st.tuples(finite, finite), st.tuples(finite, finite), st.tuples(finite, finite))
@RELAXED
def test_the_loops_tensions_are_within_their_limits_wherever_an_encoder_says_it_is(
    beta, load, wanted
):
    status, *found = tensions_kernel(*beta, *load, *wanted, *CABLES.law, *PAPER.radii, *PAPER.bars)
    assert CABLES.least <= min(found[:4]) <= max(found[:4]) <= CABLES.most
    assert np.isfinite(found).all()
    if not (0.0 <= min(beta) <= max(beta) <= np.pi):
        assert status != OK


def test_a_limit_met_exactly_is_met_from_both_sides():
    beta = np.array([1.5, 1.9])
    lever = length_jacobian(PAPER, beta)
    high = -lever[1, 0] * CABLES.most - lever[0, 0] * CABLES.least
    for off in (-1e-9, 0.0, 1e-9):
        found = tensions(PAPER, CABLES, beta, (high + off, 0.0))
        assert found.tensions[:2] == pytest.approx([CABLES.least, CABLES.most], abs=1e-6)
        assert found.shortfall[0] == pytest.approx(max(off, 0.0), abs=1e-14)


@given(st.tuples(angles, angles), st.lists(st.floats(-5.0, 60.0), min_size=4, max_size=4))
@RELAXED
def test_slack_cables_make_no_stiffness(beta, pulled):
    taut = [t if t > 0.0 else 0.0 for t in pulled]
    had = joint_stiffness(PAPER, CABLES, beta, pulled)
    assert had.tolist() == joint_stiffness(PAPER, CABLES, beta, taut).tolist()
    for i in range(2):
        if max(taut[2 * i : 2 * i + 2]) == 0.0:
            assert had[i] == 0.0


def test_spheres_in_line_apart_or_not_a_number_are_named():
    a = PAPER.bases[0] * 0.1339
    with pytest.raises(DegenerateError, match="one line"):
        trilaterate([np.zeros(3), a, 2.0 * a], [0.1339, 0.1, 0.1])
    with pytest.raises(UnreachableError):
        trilaterate([np.zeros(3), a, [0.0, 0.0, 0.1339]], [0.1339, 0.01, 0.01])
    with pytest.raises(NotFiniteError):
        trilaterate([np.zeros(3), a, [0.0, 0.0, np.nan]], [0.1339, 0.1, 0.1])


@pytest.mark.long("statistics")
@given(st.lists(anything, min_size=2, max_size=2), st.lists(anything, min_size=2, max_size=2))
@RELAXED
def test_every_public_function_answers_finitely_or_by_a_named_error(beta, load):
    for call in (
        lambda: forward(PAPER, beta),
        lambda: jacobian(PAPER, beta),
        lambda: joint_rates(PAPER, beta),
        lambda: jacobian_rate(PAPER, beta, load),
        lambda: tensions(PAPER, CABLES, beta, load).tensions,
        lambda: encoder_error(PAPER, beta),
        lambda: nearest(PAPER, [*beta, 1.0]),
        lambda: inverse(PAPER, [*load, 1.0]),
    ):
        try:
            found = call()
        except AcusError:
            continue
        assert np.isfinite(found).all()
