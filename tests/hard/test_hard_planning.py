"""Hard cases of plan, placement and reach: a bounded answer or a named error, never NaN."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core.arrays import angle_between
from app.core.errors import AcusError, NumericalError
from app.core.rotation import rotation_exp
from app.mechanisms.profile import load_profile
from app.planning.errors import PlanError
from app.planning.limits import ReachLimits, cone
from app.planning.placement import PatientOrientation, PlacedPlan, Placement
from app.planning.plan import Plan
from app.planning.reach import Obstacle, nearest_direction, reach, rotation_in_words, smallest_turn

FULCRUM = np.array([0.0, 0.16056, 0.090])
PROFILE = load_profile("icube")
DOWN = np.array([0.0, 0.0, -1.0])
seeded = settings(derandomize=True, deadline=None, max_examples=60)


def supine_path(axis: tuple[float, float, float], length_mm: float = 80.0) -> Plan:
    """The plan whose path runs along `axis` in world for a supine patient."""
    direction = PatientOrientation.SUPINE.rotation.T @ (np.array(axis) / np.linalg.norm(axis))
    return Plan(np.zeros(3), length_mm * direction)


@pytest.mark.parametrize("far", [1e3, 1e6, 9.9e6])
def test_a_patient_far_from_the_origin_loses_no_more_than_rounding(far: float) -> None:
    entry = np.array([far, -far, far])
    plan = Plan(entry, np.add(entry, (10.0, 60.0, -20.0)))
    placed = PlacedPlan.of(plan, Placement(rotation_deg=(3.0, 20.0, -7.0)), FULCRUM)
    rounding = far * 1e-3 * 1e-15
    np.testing.assert_allclose(
        placed.T_world_patient @ (plan.entry_mm * 1e-3), FULCRUM, atol=8 * rounding
    )
    near = PlacedPlan.of(Plan(np.zeros(3), (10.0, 60.0, -20.0)), placed.placement, FULCRUM)
    np.testing.assert_allclose(placed.p_target, near.p_target, atol=8 * rounding + 1e-15)
    np.testing.assert_array_equal(placed.p_entry, FULCRUM)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 1e300, 1.0000001e7])
def test_a_coordinate_beyond_all_patients_is_refused(value: float) -> None:
    with pytest.raises(PlanError, match="must be finite and within"):
        Plan((value, 0.0, 0.0), (0.0, 0.0, 0.0))


@pytest.mark.parametrize("gap", [0.0, 5e-324, 1e-160, 1e-9, 0.999])
def test_points_that_nearly_meet_are_refused(gap: float) -> None:
    with pytest.raises(PlanError, match="apart"):
        Plan((0.0, 0.0, 0.0), (gap, 0.0, 0.0))


def test_the_vertical_path_is_reachable_and_has_tilt_zero() -> None:
    answer = reach(supine_path((0.0, 0.0, -1.0)), Placement(), PROFILE)
    assert answer.reachable
    assert answer.tilt == 0.0


@pytest.mark.parametrize("noise", [0.0, 1e-320, 1e-17, 1e-9])
def test_a_path_straight_up_is_turned_over_by_half_a_turn(noise: float) -> None:
    answer = reach(supine_path((noise, -noise, 1.0)), Placement(), PROFILE)
    assert answer.reasons[0].obstacle is Obstacle.UPWARD
    remedy = answer.remedy
    assert remedy is not None
    assert np.isfinite(remedy.rotation_vector).all()
    assert remedy.angle == pytest.approx(np.pi - np.radians(37.0), abs=1e-6)
    assert reach(answer.placed.plan, remedy.placement, PROFILE).reachable
    assert remedy.orientation is PatientOrientation.PRONE


@pytest.mark.parametrize("turn", np.radians([0.0, 30.0, 90.0, 180.0, 270.0]))
def test_an_exactly_horizontal_path_is_named_and_cured(turn: float) -> None:
    answer = reach(supine_path((np.cos(turn), np.sin(turn), 0.0)), Placement(), PROFILE)
    assert "horizontal" in str(answer.reasons[0])
    assert answer.remedy is not None
    assert answer.remedy.angle == pytest.approx(np.radians(53.0), abs=1e-6)


def test_a_path_just_at_the_limit_is_reachable_and_just_beyond_is_not() -> None:
    limit = PROFILE.tilt_limit
    for beyond, expected in [(-1e-12, True), (0.0, True), (1e-12, True), (1e-6, False)]:
        angle = limit + beyond
        answer = reach(supine_path((np.sin(angle), 0.0, -np.cos(angle))), Placement(), PROFILE)
        assert answer.reachable is expected


def test_a_path_just_as_long_as_allowed_is_reachable() -> None:
    assert reach(supine_path((0.0, 0.0, -1.0), 120.0), Placement(), PROFILE).reachable
    assert not reach(supine_path((0.0, 0.0, -1.0), 120.001), Placement(), PROFILE).reachable


directions = st.tuples(*[st.floats(-1.0, 1.0)] * 3).filter(lambda d: np.linalg.norm(d) > 1e-3)
angles = st.tuples(*[st.floats(-360.0, 360.0)] * 3)


@seeded
@given(directions, angles, st.sampled_from(list(PatientOrientation)), st.floats(1.0, 500.0))
def test_every_plan_gets_an_answer_whose_remedy_holds(
    direction: tuple[float, float, float],
    angle: tuple[float, float, float],
    orientation: PatientOrientation,
    length: float,
) -> None:
    plan = supine_path(direction, length)
    answer = reach(plan, Placement(orientation, angle), PROFILE)
    assert np.isfinite([answer.tilt, answer.depth]).all()
    assert answer.reachable == (not answer.reasons)
    assert "nan" not in answer.message()
    if answer.remedy is not None:
        assert reach(plan, answer.remedy.placement, PROFILE).reachable
    elif not answer.reachable:
        assert Obstacle.DEPTH in [reason.obstacle for reason in answer.reasons]


@seeded
@given(directions, directions)
def test_the_smallest_turn_takes_one_direction_to_the_other(
    start: tuple[float, float, float], end: tuple[float, float, float]
) -> None:
    u, v = (np.array(d) / np.linalg.norm(d) for d in (start, end))
    turn = smallest_turn(u, v)
    assert np.linalg.norm(turn) == pytest.approx(angle_between(u, v), abs=1e-12)
    np.testing.assert_allclose(rotation_exp(turn) @ u, v, atol=1e-9)


@pytest.mark.parametrize("axis", [*np.eye(3), *-np.eye(3)])
def test_the_smallest_turn_between_equal_and_opposite_directions_is_defined(axis: object) -> None:
    u = np.asarray(axis, dtype=float)
    np.testing.assert_allclose(smallest_turn(u, u), np.zeros(3), atol=1e-15)
    np.testing.assert_allclose(rotation_exp(smallest_turn(u, -u)) @ u, -u, atol=1e-15)


def test_a_remedy_does_not_jump_as_the_path_crosses_the_vertical() -> None:
    previous = None
    for tilt in np.radians(np.linspace(60.0, 61.0, 21)):
        answer = reach(supine_path((np.sin(tilt), 0.0, -np.cos(tilt))), Placement(), PROFILE)
        assert answer.remedy is not None
        vector = answer.remedy.rotation_vector
        if previous is not None:
            assert np.linalg.norm(vector - previous) < 1.1 * np.radians(0.05)
        previous = vector


def test_a_tilt_limit_below_the_margin_leaves_the_vertical_as_the_remedy() -> None:
    limits = ReachLimits(FULCRUM, np.radians(1.0), 0.12, lambda x, y: True)
    direction = nearest_direction(np.array([1.0, 0.0, 0.0]), limits)
    assert direction is None or np.allclose(direction, DOWN)


def test_a_fulcrum_that_is_not_finite_is_refused() -> None:
    with pytest.raises(NumericalError, match="fulcrum"):
        PlacedPlan.of(supine_path((0.0, 0.0, -1.0)), Placement(), (np.nan, 0.0, 0.0))


def test_a_needle_in_the_plane_of_the_links_has_no_tool_point() -> None:
    limits = ReachLimits.of(PROFILE)
    assert limits.tool_point(np.array([1.0, 0.0, 0.0])) is None
    assert limits.tool_point(np.array([1.0, 0.0, -1e-12])) is None
    point = limits.tool_point(DOWN)
    np.testing.assert_allclose(point, FULCRUM[:2])


@seeded
@given(directions, st.floats(0.0, 1.0))
def test_a_cone_has_its_angle_everywhere(
    direction: tuple[float, float, float], angle: float
) -> None:
    axis = np.array(direction) / np.linalg.norm(direction)
    for around in cone(axis, angle)[1:]:
        assert angle_between(axis, around) == pytest.approx(angle, abs=1e-9)


@pytest.mark.parametrize(
    "turn", [(0.0, 0.0, 0.0), (1e-12, 0.0, 0.0), (0.0, 0.0, 1.0), (0.3, -0.2, 0.9)]
)
def test_every_rotation_has_words(turn: tuple[float, float, float]) -> None:
    words = rotation_in_words(np.array(turn), PatientOrientation.LEFT_DOWN.rotation)
    assert words
    assert "nan" not in words


def test_errors_of_planning_are_errors_of_acus() -> None:
    assert issubclass(PlanError, AcusError)
