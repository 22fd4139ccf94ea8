import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core.arrays import angle_between
from app.core.rotation import rotation_exp
from app.mechanisms.profile import load_profile
from app.planning.limits import ReachLimits, in_workspace, tilt_of
from app.planning.placement import PatientOrientation, Placement
from app.planning.plan import Plan
from app.planning.reach import MARGIN, Obstacle, reach, reach_within

FULCRUM = np.array([0.0, 0.16056, 0.090])
DEGREE = np.pi / 180.0


def limits(tilt_deg: float = 39.0, in_workspace=lambda x, y: True) -> ReachLimits:  # type: ignore[no-untyped-def]
    return ReachLimits(FULCRUM, tilt_deg * DEGREE, 0.120, in_workspace)


def tilted(tilt_deg: float, azimuth_deg: float = 0.0, length: float = 80.0) -> Plan:
    """A path on a supine patient at this tilt and azimuth in world."""
    t, a = tilt_deg * DEGREE, azimuth_deg * DEGREE
    world = np.array([np.sin(t) * np.cos(a), np.sin(t) * np.sin(a), -np.cos(t)])
    entry = np.array([12.0, -90.0, 300.0])
    return Plan(entry, entry + length * PatientOrientation.SUPINE.rotation.T @ world)


def test_a_steep_short_path_is_reachable_and_says_its_numbers() -> None:
    answer = reach_within(tilted(20.0), Placement(), limits())
    assert answer.reachable
    assert answer.reasons == ()
    assert answer.remedy is None
    assert answer.message() == "reachable: tilt 20.0°, depth 80.0 mm"


def test_too_much_tilt_is_said_with_both_numbers() -> None:
    answer = reach_within(tilted(47.2), Placement(), limits())
    assert [str(reason) for reason in answer.reasons] == ["tilt 47.2° exceeds 39°"]
    assert answer.tilt == pytest.approx(47.2 * DEGREE)


def test_a_path_that_is_too_long_has_no_remedy_and_says_so() -> None:
    answer = reach_within(tilted(10.0, length=131.0), Placement(), limits())
    assert not answer.reachable
    assert answer.remedy is None
    assert "depth 131.0 mm exceeds 120 mm; no rotation shortens a path" in answer.message()


def test_every_reason_is_given_at_once() -> None:
    answer = reach_within(tilted(60.0, length=131.0), Placement(), limits())
    assert [reason.obstacle for reason in answer.reasons] == [Obstacle.TILT, Obstacle.DEPTH]
    assert answer.remedy is None


@pytest.mark.parametrize(
    ("tilt", "word"), [(90.0, "horizontal"), (120.0, "upward"), (180.0, "upward")]
)
def test_a_path_that_does_not_go_down_is_named(tilt: float, word: str) -> None:
    answer = reach_within(tilted(tilt), Placement(), limits())
    assert answer.reasons[0].obstacle is Obstacle.UPWARD
    assert word in answer.reasons[0].text
    assert answer.remedy is not None


@pytest.mark.parametrize(
    ("azimuth", "words"),
    [
        (0.0, "about the head–foot axis, right side up"),
        (180.0, "about the head–foot axis, left side up"),
        (90.0, "about the left–right axis, feet up"),
        (-90.0, "about the left–right axis, head up"),
    ],
)
def test_the_remedy_says_which_side_comes_up(azimuth: float, words: str) -> None:
    """A path that runs to the patient's left becomes steeper when the right side is lifted."""
    answer = reach_within(tilted(49.0, azimuth), Placement(), limits())
    assert answer.remedy is not None
    turned = answer.remedy.placement
    assert f"turn the patient 12.0° {words}" in answer.remedy.words
    letter = {"left": (1, 0, 0), "right": (-1, 0, 0), "head": (0, 0, 1), "feet": (0, 0, -1)}
    side = np.array(letter[words.split(", ")[1].split()[0]], dtype=float)
    assert (turned.rotation @ side)[2] > (Placement().rotation @ side)[2] + 0.1


def test_a_diagonal_remedy_names_both_sides() -> None:
    answer = reach_within(tilted(49.0, 45.0), Placement(), limits())
    assert answer.remedy is not None
    words = answer.remedy.words
    assert "right side and feet up" in words or "feet and right side up" in words


directions = st.tuples(st.floats(0.0, 180.0), st.floats(-180.0, 180.0))


@settings(derandomize=True, deadline=None, max_examples=80)
@given(
    directions,
    st.sampled_from(list(PatientOrientation)),
    st.tuples(*[st.floats(-170.0, 170.0)] * 3),
)
def test_the_remedy_makes_the_path_reachable_with_two_degrees_to_spare(
    direction: tuple[float, float],
    orientation: PatientOrientation,
    angle: tuple[float, float, float],
) -> None:
    plan, device = tilted(*direction), limits()
    answer = reach_within(plan, Placement(orientation, angle), device)
    if answer.reachable:
        return
    remedy = answer.remedy
    assert remedy is not None
    cured = reach_within(plan, remedy.placement, device)
    assert cured.reachable
    assert cured.tilt <= device.tilt_limit - MARGIN + 1e-9
    assert remedy.angle == pytest.approx(answer.tilt - (device.tilt_limit - MARGIN), abs=1e-9)
    if remedy.orientation is not None:
        assert reach_within(plan, Placement(remedy.orientation), device).reachable


def test_no_smaller_rotation_reaches_the_limit() -> None:
    answer = reach_within(tilted(63.0, 70.0), Placement(), limits())
    remedy = answer.remedy
    assert remedy is not None
    rng = np.random.default_rng(1)
    for axis in rng.normal(size=(500, 3)):
        turn = axis / np.linalg.norm(axis) * remedy.angle * rng.uniform(0.0, 0.999)
        assert tilt_of(rotation_exp(turn) @ answer.placed.axis) > limits().tilt_limit - MARGIN


def test_a_lateral_path_is_better_cured_by_lying_on_the_other_side() -> None:
    entry = np.array([150.0, 0.0, 300.0])  # from the patient's left towards the middle
    answer = reach_within(Plan(entry, entry - (80.0, 0.0, 0.0)), Placement(), limits())
    assert answer.remedy is not None
    assert answer.remedy.orientation is PatientOrientation.RIGHT_DOWN
    assert answer.remedy.words.startswith("lay the patient right side down (tilt 0°), or turn")


def test_a_tool_point_outside_the_workspace_is_named_and_cured() -> None:
    device = limits(in_workspace=lambda x, y: x < 0.03)
    answer = reach_within(tilted(30.0), Placement(), device)
    assert answer.reasons[0].obstacle is Obstacle.WORKSPACE
    assert "tool point (52.0, 160.6) mm lies outside" in answer.reasons[0].text
    assert answer.remedy is not None
    assert reach_within(tilted(30.0), answer.remedy.placement, device).reachable
    assert answer.remedy.angle < 20.0 * DEGREE


def test_a_device_that_reaches_nothing_offers_no_remedy() -> None:
    answer = reach_within(tilted(60.0), Placement(), limits(in_workspace=lambda x, y: False))
    assert not answer.reachable
    assert answer.remedy is None


def test_the_tool_point_lies_on_the_line_through_the_fulcrum() -> None:
    axis = np.array([0.3, -0.2, -0.9]) / np.linalg.norm([0.3, -0.2, -0.9])
    point = limits().tool_point(axis)
    assert point is not None
    assert angle_between([*point, 0.0] - FULCRUM, axis) < 1e-15 * 10


def test_the_new_joint_of_the_device_allows_39_degrees_and_the_old_one_45() -> None:
    profile = load_profile("icube")
    plan = tilted(42.0)
    new = reach(plan, Placement(), profile)
    assert str(new.reasons[0]) == "tilt 42.0° exceeds 39°"
    assert reach(plan, Placement(), profile.with_joint("old")).reachable
    assert new.remedy is not None
    assert reach(plan, new.remedy.placement, profile).reachable


def test_the_device_holds_its_tool_point_everywhere_within_45_degrees() -> None:
    device = ReachLimits.of(load_profile("icube").with_joint("old"))
    for tilt in np.radians(np.arange(0.0, 46.0, 5.0)):
        for turn in np.radians(np.arange(0.0, 360.0, 15.0)):
            axis = (np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), -np.cos(tilt))
            assert device.holds(np.array(axis))


@pytest.mark.parametrize("point", [(0.0, 0.3), (0.0, -0.06), (-0.0425, 0.0), (1e6, 0.0)])
def test_points_that_the_links_cannot_hold_are_outside_the_workspace(
    point: tuple[float, float],
) -> None:
    """Too far; only in the mirrored assembly; on a motor axis; absurdly far."""
    holds = in_workspace(load_profile("icube"))
    assert not holds(*point)
    assert holds(0.0, 0.16056)


def test_the_needle_holder_has_the_same_verdict_with_a_remedy():
    profile = load_profile("tensegrity")
    device = ReachLimits.of(profile)
    assert device.holds(np.array([0.5, -0.2, -0.84]) / np.linalg.norm([0.5, -0.2, -0.84]))
    answer = reach_within(tilted(55.0), Placement(), device)
    assert not answer.reachable
    assert "exceeds 40" in answer.message()
    assert answer.remedy is not None
    assert device.holds(answer.remedy.placement.rotation @ tilted(55.0).direction)
