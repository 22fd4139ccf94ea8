"""Poses at the edge: stretched, folded, elbows meeting or in line, motor axis, no grip, below P_I.

Bounded answers or named errors, never NaN, never a jump.
"""

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mechanisms.hub_region import HubRegion, locate

from app.core.errors import AcusError
from app.mechanisms.errors import (
    DegenerateError,
    MechanismError,
    NoGripError,
    SingularError,
    UnreachableError,
)
from app.mechanisms.pantograph import (
    Geometry,
    Singularity,
    Status,
    branches,
    dexterity,
    dynamic_terms,
    forward,
    inverse,
    jacobian,
    jacobian_rate,
    joints_by_hub,
    lever_map,
    needle_at,
    passive_angles,
    singularity,
    system_inverse,
    system_rates,
)
from app.mechanisms.pantograph.dynamics import dynamics_kernel, friction_kernel
from app.mechanisms.profile import load_profile

PROFILE = load_profile("icube")
GEOMETRY, MODEL = PROFILE.pantograph, PROFILE.dynamic_model
A1, A2, BASE = GEOMETRY.links
MEETING = np.arccos(BASE / (2.0 * A1))
RELAXED = settings(derandomize=True, deadline=None, max_examples=200)
anything = st.floats(allow_nan=True, allow_infinity=True)
angles = st.floats(-4.0, 4.0)


def on_left_arm(reach: float, turn: float) -> np.ndarray:
    return np.array([-BASE / 2, 0.0]) + reach * np.array([np.cos(turn), np.sin(turn)])


@pytest.mark.parametrize("reach", [A1 + A2, A2 - A1], ids=["stretched", "folded"])
@pytest.mark.parametrize("short", [1e-3, 1e-6, 1e-9, 1e-12, 1e-15])
def test_an_arm_stretched_or_folded_is_named_and_every_term_stays_bounded(reach, short):
    """Type 1: the Jacobian loses rank, the dynamics in the motor angles do not mind."""
    inwards = -1.0 if reach == A1 + A2 else 1.0
    p3 = on_left_arm(reach * (1.0 + inwards * short), 1.2)
    q = inverse(GEOMETRY, p3)
    measure = singularity(GEOMETRY, q, tolerance=1e-5)
    assert abs(measure.serial_left) < 3.0 * np.sqrt(short) + 1e-7
    if short <= 1e-12:
        assert measure.kind is Singularity.SERIAL_LEFT
        assert 1.0 / max(dexterity(jacobian(GEOMETRY, q)), 1e-300) > 1e5
    terms = dynamic_terms(MODEL, q, (1.0, -1.0), 0.02)
    assert np.linalg.eigvalsh(terms.mass).min() > 1e-4
    assert np.abs(terms.mass).max() < 0.1
    assert np.abs(terms.velocity).max() < 0.1
    assert np.abs(jacobian_rate(GEOMETRY, q, (1.0, -1.0))).max() < 1.0
    assert forward(GEOMETRY, q) == pytest.approx(p3, abs=1e-14)


def test_both_arms_stretched_are_one_point_of_all_working_modes():
    p3 = np.array([0.0, np.sqrt((A1 + A2) ** 2 - BASE**2 / 4)]) * (1.0 - 1e-15)
    found = branches(GEOMETRY, p3)
    for branch in found:
        assert branch.status == Status.OK
        assert branch.q == pytest.approx(found[0].q, abs=1e-6)
        assert singularity(GEOMETRY, branch.q, 1).kind is Singularity.SERIAL_BOTH
    q, needle = found[0].q, needle_at(GEOMETRY, p3, 0.1)
    assert np.isfinite(system_rates(GEOMETRY, q, 0.1).by_joints).all()
    assert np.abs(joints_by_hub(GEOMETRY, needle.hub)).max() > 1e6  # as far as it is from singular
    beyond = needle_at(GEOMETRY, p3 * (1.0 + 1e-9), 0.1)
    with pytest.raises(UnreachableError):
        joints_by_hub(GEOMETRY, beyond.hub)


def test_where_the_elbows_meet_every_term_is_named_singular():
    q = (MEETING, np.pi - MEETING)
    assert singularity(GEOMETRY, q).kind is Singularity.PARALLEL
    for call in (
        lambda: dynamic_terms(MODEL, q, (0.0, 0.0), 0.0),
        lambda: jacobian_rate(GEOMETRY, q, (1.0, 0.0)),
        lambda: passive_angles(GEOMETRY, q),
        lambda: system_rates(GEOMETRY, q, 0.1),
    ):
        with pytest.raises(SingularError):
            call()


def test_towards_the_meeting_elbows_terms_grow_as_the_distance_allows_and_stay_exact():
    """J against 60 digits at the angles as stored; the error may grow as 1/l22', no more."""
    mpmath.mp.dps = 60
    a1, a2, base = (mpmath.mpf(v) for v in GEOMETRY.links)

    def exact(q1, q2):
        left = mpmath.matrix([a1 * mpmath.cos(q1) - base / 2, a1 * mpmath.sin(q1)])
        right = mpmath.matrix([a1 * mpmath.cos(q2) + base / 2, a1 * mpmath.sin(q2)])
        e = right - left
        l2 = e[0] ** 2 + e[1] ** 2
        r = mpmath.sqrt((a2**2 - l2 / 4) / l2)
        return mpmath.matrix([left[0] + e[0] / 2 - r * e[1], left[1] + e[1] / 2 + r * e[0]])

    for gap in 10.0 ** -np.arange(2.0, 9.0):
        q = np.array([MEETING + gap, np.pi - MEETING - 0.5 * gap])
        h = mpmath.mpf(10) ** -25
        columns = []
        for i in range(2):
            up, down = ([mpmath.mpf(v) for v in q] for _ in range(2))
            up[i] += h
            down[i] -= h
            columns.append((exact(*up) - exact(*down)) / (2 * h))
        reference = np.array([[float(columns[j][i]) for j in range(2)] for i in range(2)])
        error = np.abs(jacobian(GEOMETRY, q) - reference).max() / np.abs(reference).max()
        assert error < 1e-15 / gap
        mass = dynamic_terms(MODEL, q, (0.0, 0.0), 0.0).mass
        assert np.isfinite(mass).all()
        assert mass[0, 0] < 1.0 / gap**2
        measure = singularity(GEOMETRY, q)
        assert abs(measure.parallel) < 2.0 * gap


def test_near_the_meeting_elbows_the_closure_is_as_good_as_one_bit_of_an_angle_allows():
    rng = np.random.default_rng(4)
    for gap in 10.0 ** -np.arange(2.0, 10.0):
        for turn in rng.uniform(0.0, 2.0 * np.pi, 20):
            q = np.array([MEETING, np.pi - MEETING]) + gap * np.array([np.cos(turn), np.sin(turn)])
            p3 = forward(GEOMETRY, q)
            for branch in branches(GEOMETRY, p3):
                if branch.assembly == 1 and branch.q == pytest.approx(q, abs=10 * gap):
                    error = np.abs(forward(GEOMETRY, branch.q) - p3).max()
                    assert error < 4e-15 * A2 / gap


def test_elbows_in_line_through_the_tool_are_named_singular():
    """Only a wider base or longer driven links than the robot's can stretch the distal links."""
    wide = Geometry(0.1225, 0.165, 0.085, GEOMETRY.fulcrum, 0.2)
    q = (np.pi, 0.0)
    assert singularity(wide, q).kind is Singularity.PARALLEL
    assert passive_angles(wide, q).left_absolute == pytest.approx(0.0, abs=1e-7)
    with pytest.raises(SingularError):
        jacobian_rate(wide, q, (1.0, 1.0))
    assert BASE + 2.0 * A1 < 2.0 * A2  # the shipped robot cannot


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_a_tool_on_a_motor_axis_has_no_branches_whatever_the_links(side):
    equal = Geometry(0.1, 0.1, 0.085, GEOMETRY.fulcrum, 0.2)
    for geometry in (GEOMETRY, equal):
        p3 = (side * BASE / 2, 0.0)
        assert {branch.status for branch in branches(geometry, p3)} == {Status.DEGENERATE}
        with pytest.raises(DegenerateError):
            inverse(geometry, p3)
    near = inverse(equal, (side * BASE / 2 + 1e-9, 1e-9))  # folded onto itself: bounded
    assert np.isfinite(near).all()
    hub = GEOMETRY.fulcrum + 0.5 * (GEOMETRY.fulcrum - [side * BASE / 2, 0.0, 0.0])
    assert locate(GEOMETRY, hub, 1.5, (-0.2, 0.2)).region is HubRegion.UNREACHABLE


def test_nothing_jumps_as_the_needle_passes_through_the_vertical():
    previous = None
    for offset in np.linspace(-1e-9, 1e-9, 21):
        p3 = GEOMETRY.fulcrum[:2] + offset * np.array([1.0, 0.3])
        q = inverse(GEOMETRY, p3)
        rates = system_rates(GEOMETRY, q, 0.11)
        terms = dynamic_terms(MODEL, q, (1.0, 0.5), 0.09, 0.2)
        found = np.concatenate([rates.by_joints.ravel(), terms.mass.ravel(), terms.velocity])
        assert previous is None or np.abs(found - previous).max() < 1e-8
        previous = found


def test_as_the_needle_is_drawn_out_of_the_grip_maps_vanish_or_grow_and_zero_is_named():
    for l_out in 10.0 ** -np.arange(1.0, 12.0):
        needle = needle_at(GEOMETRY, (0.03, 0.18), l_out)
        assert np.abs(lever_map(needle)).max() <= 1.01 * l_out / GEOMETRY.fulcrum[2]
        assert np.abs(joints_by_hub(GEOMETRY, needle.hub)).max() < 30.0 / l_out
    for l_out in (0.0, -0.01, np.nan):
        with pytest.raises(NoGripError):
            needle_at(GEOMETRY, (0.03, 0.18), l_out)
        with pytest.raises(NoGripError):
            system_rates(GEOMETRY, inverse(GEOMETRY, (0.03, 0.18)), l_out)
    with pytest.raises(DegenerateError):
        joints_by_hub(GEOMETRY, GEOMETRY.fulcrum)


def test_hubs_around_the_fulcrum_are_named_without_a_gap():
    for tilt in np.radians(np.linspace(0.0, 180.0, 181)):
        hub = GEOMETRY.fulcrum + 0.1 * np.array([np.sin(tilt), 0.0, np.cos(tilt)])
        place = locate(GEOMETRY, hub, PROFILE.tilt_limit, PROFILE.depth_range)
        if tilt >= 0.5 * np.pi:
            assert place.region is HubRegion.BELOW_FULCRUM
            with pytest.raises(UnreachableError):
                system_inverse(GEOMETRY, hub)
        elif place.q is None:
            assert place.region is HubRegion.UNREACHABLE
        else:
            inside = tilt <= PROFILE.tilt_limit
            assert place.region is (HubRegion.INSIDE if inside else HubRegion.BEYOND_TILT)


@RELAXED
@given(angles, angles, anything, anything, anything, anything)
def test_terms_of_any_state_are_finite_or_an_error_by_name(q1, q2, v1, v2, depth, rate):
    try:
        terms = dynamic_terms(MODEL, (q1, q2), (v1, v2), depth, rate)
        for part in (terms.mass, terms.velocity, terms.gravity, terms.friction):
            assert np.isfinite(part).all()
        assert np.isfinite(jacobian_rate(GEOMETRY, (q1, q2), (v1, v2))).all()
    except AcusError:
        return


@RELAXED
@given(angles, angles, st.floats(-0.03, 0.12))
def test_the_mass_matrix_is_positive_definite_wherever_it_exists(q1, q2, depth):
    try:
        mass = dynamic_terms(MODEL, (q1, q2), (0.0, 0.0), depth).mass
    except MechanismError:
        return
    assert mass[0, 0] > 0.0
    assert np.linalg.det(mass) > 0.0


@RELAXED
@given(anything, anything, anything)
def test_any_hub_point_is_located(x, y, z):
    place = locate(GEOMETRY, (x, y, z), PROFILE.tilt_limit, PROFILE.depth_range)
    for value in (place.tilt, place.depth, *(place.q or ())):
        assert value is None or np.isfinite(value)


def test_kernels_survive_what_is_not_a_number():
    """No trap, no hang: the caller checks the status of the Jacobian first."""
    values = dynamics_kernel(np.nan, 0.5, 1.0, 1.0, 0.0, 0.16, 0.0, 0.0, MODEL.values, 0)
    assert len(values) == 7
    for speed in (1e300, -1e300, 5e-324):
        assert np.isfinite(friction_kernel(speed, 0.004, 0.002, 0.02))
