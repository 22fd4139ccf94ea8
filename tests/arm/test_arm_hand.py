"""The hand: its fingers against the published description, touches, force closure, a firm grasp."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from app.arm.hand import (
    OVERSHOOT,
    ClosureWay,
    Contacts,
    Coupling,
    FingerLink,
    FingerSide,
    FirmGrasp,
    HandFinger,
    Lever,
    SoftContact,
    ToolShaft,
    approach,
    branches,
    close_hand,
    driven,
    force_closure,
    forward,
    hand_names,
    heights,
    inverse,
    jacobian,
    load_hand,
    pair_closed,
    press,
    stable_gain,
    wrenches,
)
from app.arm.hand.errors import GraspError
from app.core.errors import ConfigurationError, NumericalError
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.mechanisms.errors import MechanismError, UnreachableError

PROFILE = load_hand()
HAND = PROFILE.hand
MOST = np.array([np.pi, HAND.most_proximal, HAND.most_distal])
DOWN = (0.0, 0.0, -1.0)
THREE = np.array([(np.cos(a), np.sin(a), 0.0) for a in (0.1, 2.3, 4.2)]) * 0.02
SQUARE = np.array([(1.0, 1.0, 1.0), (-1.0, -1.0, 1.0), (1.0, -1.0, -1.0), (-1.0, 1.0, -1.0)])


def joints_within(count: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).uniform(size=(count, 3)) * MOST


# Fingers


@pytest.mark.long("machine")
def test_the_inverse_brings_every_finger_back_to_its_point_on_the_branch_it_came_from():
    worst, over = 0.0, 0
    for q in joints_within(5_000, 1):
        p = forward(HAND, q)
        found = branches(HAND, p, HandFinger.TWO)
        rho = p[0] * np.cos(q[0]) + p[1] * np.sin(q[0])
        pose = found[0 if rho >= 0.0 else 1]
        assert pose.refused == ""
        assert pose.joints[1:] == pytest.approx(q[1:], abs=1e-13)
        worst = max(worst, float(np.linalg.norm(forward(HAND, pose.joints) - p)))
        over += rho < 0.0
    assert worst < 1e-15 * 250
    assert over / 5_000 == pytest.approx(0.374, abs=0.02), "errata D9: curled over the palm"


def test_the_first_branch_that_answers_is_outward():
    p = forward(HAND, (0.7, 0.5, 0.3))
    first = inverse(HAND, p, HandFinger.TWO)
    assert first.side is FingerSide.OUTWARD
    curled = inverse(HAND, forward(HAND, (0.7, 2.2, 0.7)), HandFinger.TWO)
    assert curled.side is FingerSide.OVER
    assert curled.joints == pytest.approx([0.7, 2.2, 0.7])
    assert [pose.side for pose in branches(HAND, p)] == [FingerSide.OUTWARD, FingerSide.OVER]


def test_the_printed_formulas_hold_only_at_joint_2():
    """Errata D8: from the spread axis they forget L1."""
    x, _, z = forward(HAND, (0.0, 0.9, 0.4))

    def printed(rho: float) -> float:
        c = (rho**2 + z**2 - HAND.proximal**2 - HAND.distal**2) / (2 * HAND.proximal * HAND.distal)
        return float(np.arctan2(np.sqrt(1.0 - c * c), c) - np.pi / 4) if abs(c) <= 1.0 else np.nan

    assert printed(x - HAND.knuckle) == pytest.approx(0.4)
    assert not abs(printed(x) - 0.4) < 0.1


def test_the_jacobian_is_the_derivative_of_the_forward_map():
    for q in joints_within(200, 2):
        columns = [(forward(HAND, q + h) - forward(HAND, q - h)) / 2e-6 for h in 1e-6 * np.eye(3)]
        assert jacobian(HAND, q) == pytest.approx(np.column_stack(columns), abs=1e-10)


def published_chain(finger: HandFinger, spread: float, q2: float, q3: float) -> RigidTransform:
    """Palm to distal link by the numbers of a published description.

    robots bh282.urdf.xacro of barrett_hand_common, Robotnik Automation, BSD 3-clause; joint 3
    stands (-69.936, 3) mm from joint 2, its 1.5708 are quarter turns. Fingers 11, 21, 31.
    """
    base, turn, heading = {
        HandFinger.ONE: ((-0.025, 0.0, 0.0252), -1.0, np.pi / 2),
        HandFinger.TWO: ((0.025, 0.0, 0.0252), 1.0, np.pi / 2),
        HandFinger.THREE: ((0.0, 0.0, 0.0252), 0.0, -np.pi / 2),
    }[finger]

    def placed(xyz, axis, angle):
        return RigidTransform(rotation_exp(angle * np.asarray(axis, float)), np.asarray(xyz))

    return (
        placed(base, (0, 0, 1), heading)
        @ placed((0.0, 0.0, 0.0), (0, 0, 1), turn * spread)
        @ placed((-0.05, 0.0, 0.0339), (1, 0, 0), np.pi / 2)
        @ placed((0.0, 0.0, 0.0), (0, 0, -1), q2)
        @ placed((-0.069936, 0.003, 0.0), (0, 0, -1), q3)
    )


@pytest.mark.parametrize("finger", list(HandFinger))
def test_the_fingers_stand_where_the_published_description_puts_them(finger):
    length, lead = np.hypot(0.069936, 0.003), np.arctan2(0.003, 0.069936)
    assert HAND.proximal == pytest.approx(length, abs=1e-6)
    hand = replace(HAND, proximal=float(length))
    height = np.array([0.0, 0.0, 0.0252 + 0.0339])
    for spread, q2, q3 in joints_within(200, 3):
        T_palm_distal = published_chain(finger, spread, q2, q3)
        tip = lead + hand.bend  # of the grasp point, from the distal link's -x
        p_distal = hand.distal * np.array([-np.cos(tip), np.sin(tip), 0.0])
        q = (finger.turn * spread, q2 + lead, q3)
        p_hand = finger.placed(hand) @ forward(hand, q)
        assert T_palm_distal @ p_distal - height == pytest.approx(p_hand, abs=1e-12)


def test_a_rigid_body_library_finds_the_published_fingers_at_the_same_places():
    """Pinocchio builds the chain of finger 2 from the same numbers and moves it itself."""
    pinocchio = pytest.importorskip("pinocchio")
    model = pinocchio.Model()
    around_x = rotation_exp((np.pi / 2, 0.0, 0.0))
    parent = 0
    for joint, rotation, place in (
        ("RZ", rotation_exp((0.0, 0.0, np.pi / 2)), (0.025, 0.0, 0.0252)),
        ("RZ", around_x, (-0.05, 0.0, 0.0339)),
        ("RZ", np.eye(3), (-0.069936, 0.003, 0.0)),
    ):
        kind = getattr(pinocchio, f"JointModel{joint}")()
        placed = pinocchio.SE3(rotation, np.array(place))
        parent = model.addJoint(parent, kind, placed, f"joint {parent}")
    data = model.createData()
    for spread, q2, q3 in joints_within(200, 9):
        pinocchio.forwardKinematics(model, data, np.array([spread, -q2, -q3]))
        ours = published_chain(HandFinger.TWO, spread, q2, q3)
        assert data.oMi[3].translation == pytest.approx(ours.translation, abs=1e-15)
        assert data.oMi[3].rotation == pytest.approx(ours.rotation, abs=1e-14)


def test_in_free_motion_one_motor_bends_the_tip_a_third_as_far_and_alone_four_times_as_fast():
    phi2, phi3 = driven(HAND, 100.0)
    assert (phi2, phi3) == pytest.approx((100 / 125, 100 / 375))
    assert HAND.coupling == pytest.approx(1 / 3)
    held, bent = driven(HAND, 130.0, broken_at=100.0)
    assert held == phi2
    assert bent - phi3 == pytest.approx(4 * 30 / 375)
    with pytest.raises(MechanismError, match="give 0 ≤ broken_at ≤ motor"):
        driven(HAND, 100.0, broken_at=101.0)


def test_a_point_says_whether_free_motion_reaches_it():
    for phi3, coupling in ((0.3, Coupling.FREE), (0.5, Coupling.BREAKAWAY), (0.1, Coupling.NEVER)):
        assert inverse(HAND, forward(HAND, (0.2, 0.9, phi3))).coupling is coupling


@pytest.mark.parametrize(
    ("q", "words"),
    [
        ((0.0, 0.5, 0.9), "φ3 would be 51.57°, its limits are 0 and 48°"),
        ((0.0, 0.5, -0.1), "φ3 would be -5.73°"),
        ((0.0, -0.2, 0.3), "φ2 would be -11.46°, its limits are 0 and 140°"),
    ],
)
def test_joints_beyond_their_limits_are_refused_with_the_limit(q, words):
    with pytest.raises(UnreachableError, match=words):
        inverse(HAND, forward(HAND, q))


def test_a_point_out_of_reach_says_how_far_the_links_reach():
    with pytest.raises(UnreachableError, match="250 mm from joint 2, the links reach from 12 to"):
        inverse(HAND, (0.3, 0.0, 0.0))


def test_spread_beyond_its_limits_is_flagged_and_not_refused():
    p = forward(HAND, (-0.4, 0.9, 0.3))
    assert inverse(HAND, p, HandFinger.TWO).beyond_spread
    one = inverse(HAND, p, HandFinger.ONE)
    assert not one.beyond_spread
    assert one.spread == pytest.approx(0.4)


def test_finger_3_has_no_spread_and_its_points_lie_in_its_plane():
    p = forward(HAND, (0.0, 0.9, 0.3))
    assert inverse(HAND, p, HandFinger.THREE).joints == pytest.approx([0.0, 0.9, 0.3])
    with pytest.raises(UnreachableError, match="it has no spread, and the point lies 1 mm off"):
        inverse(HAND, p + (0.0, 1e-3, 0.0), HandFinger.THREE)
    curled = forward(HAND, (0.0, 2.2, 0.7))
    assert inverse(HAND, curled, HandFinger.THREE).side is FingerSide.OVER


# Profile


def test_every_value_of_the_hand_says_where_it_comes_from():
    assert hand_names() == ["bh8-282"]
    assert PROFILE.geometry.provenance["knuckle"] == "published"
    assert PROFILE.drive.provenance["breakaway"] == "estimated"
    assert (HAND.knuckle, HAND.proximal, HAND.distal) == (0.050, 0.070, 0.058)
    assert pytest.approx(np.pi / 4) == HAND.bend


def test_an_unknown_hand_is_refused_with_the_names():
    with pytest.raises(ConfigurationError, match="no hand 'left'; valid names: bh8-282"):
        load_hand("left")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"knuckle": 0.0}, "knuckle is 0.0 m"),
        ({"most_distal": 4.0}, "most_distal is 4.0 rad"),
        ({"bend": -0.1}, "bend is -0.1 rad"),
        ({"pad": 0.058}, "pad is 0.058 m; give 0 or more, less than distal"),
        ({"distal_gear": 125.0}, "gears 125.0 .* the tip would open"),
        ({"breakaway": 0.0}, "breakaway is 0.0 N·m"),
    ],
)
def test_a_hand_that_cannot_be_is_refused(change, words):
    with pytest.raises(MechanismError, match=words):
        replace(HAND, **change)


# Touches


@pytest.mark.parametrize("diameter_mm", [2.0, 5.0, 10.0, 40.0, 120.0])
def test_the_palm_comes_so_that_three_grasp_points_meet_on_both_sides_of_the_tool(diameter_mm):
    tool = ToolShaft((0.3, 0.2, 0.1), (1.0, 0.4, 0.2), 1e-3 * diameter_mm)
    T_world_hand = approach(HAND, tool, DOWN)
    assert T_world_hand.rotation[:, 0] == pytest.approx(tool.axis)
    assert T_world_hand.rotation[2, 2] < -0.9
    seen = tool.seen_from(T_world_hand.inverse())
    grasp = close_hand(HAND, seen)
    assert [t.finger for t in grasp.touches] == list(HandFinger)
    for touch, side in zip(grasp.touches, (-1.0, -1.0, 1.0), strict=True):
        assert touch.link is FingerLink.DISTAL
        assert touch.coupling is Coupling.FREE
        assert touch.normal == pytest.approx([0.0, -side, 0.0], abs=1e-9)
        slim = replace(HAND, distal=HAND.distal - HAND.pad)
        tip = touch.finger.placed(HAND) @ forward(slim, touch.joints)
        assert touch.point == pytest.approx(tip + HAND.pad * touch.normal, abs=1e-10)
        assert touch.point[1] == pytest.approx(side * seen.diameter / 2)


def test_without_a_pad_the_grasp_point_itself_touches():
    """What the paper asks its inverse for."""
    thin = replace(HAND, pad=0.0)
    tool = ToolShaft((0.0, 0.0, heights(thin, 0.004)[1]), (1.0, 0.0, 0.0), 0.008)
    for touch in close_hand(thin, tool).touches:
        p_finger = touch.finger.placed(thin).inverse() @ touch.point
        pose = inverse(thin, p_finger, touch.finger)
        assert pose.joints == pytest.approx(touch.joints, abs=1e-9)
        assert pose.coupling is Coupling.FREE


@pytest.mark.long("machine")
def test_what_touches_lies_on_the_tool_wherever_the_tool_stands():
    rng, found, links = np.random.default_rng(4), 0, set()
    for _ in range(300):
        tool = ToolShaft(
            rng.uniform((-0.02, -0.03, 0.0), (0.02, 0.03, 0.1)),
            (1.0, *rng.uniform(-0.3, 0.3, 2)),
            rng.uniform(0.005, 0.05),
        )
        try:
            grasp = close_hand(HAND, tool, rng.uniform(0.0, 0.6))
        except GraspError:
            continue
        found += 1
        for touch in grasp.touches:
            away = touch.point - tool.position
            across = away - tool.axis * (away @ tool.axis)
            assert np.linalg.norm(across) == pytest.approx(tool.diameter / 2, abs=1e-12)
            assert touch.normal == pytest.approx(-across / np.linalg.norm(across), abs=1e-9)
            links.add((touch.link, touch.coupling))
    assert found > 100
    assert links >= {(FingerLink.DISTAL, Coupling.FREE), (FingerLink.DISTAL, Coupling.BREAKAWAY)}


def test_a_link_that_touches_before_the_tip_stays_and_the_tip_goes_on_alone():
    grasp = close_hand(HAND, ToolShaft((0.0, 0.01, 0.04), (1.0, 0.0, 0.0), 0.08))
    first, second = (t for t in grasp.touches if t.finger is HandFinger.THREE)
    assert (first.link, second.link) == (FingerLink.PROXIMAL, FingerLink.DISTAL)
    assert second.joints[1] == first.joints[1]
    assert second.joints[2] > first.joints[2]
    assert second.coupling is Coupling.BREAKAWAY


@pytest.mark.parametrize(
    ("position", "axis", "diameter", "spread", "words"),
    [
        ((0.0, 0.0, -0.02), (1.0, 0.0, 0.0), 0.05, 0.0, "stands in the palm, 11 mm deep"),
        ((0.0, 0.0, 0.1), (0.0, 0.0, 1.0), 0.01, 0.0, "stands in the palm, along its axis"),
        ((0.0, -0.1, 0.0), (1.0, 0.0, 0.0), 0.02, 0.0, "finger one stands in the tool with its p"),
        ((0.0, 0.1, 0.1), (1.0, 0.0, 0.0), 0.01, 0.0, "finger one closes to its limit without"),
        ((0.0, 0.0, 0.09), (1.0, 0.0, 0.0), 0.01, 4.0, "spread 229.2°; its limits are 0 and 180°"),
    ],
)
def test_what_cannot_be_gripped_is_refused_with_the_reason(position, axis, diameter, spread, words):
    with pytest.raises(GraspError, match=words):
        close_hand(HAND, ToolShaft(position, axis, diameter), spread)


def test_the_palm_refuses_to_come_along_the_axis_or_at_a_height_where_the_tips_do_not_meet():
    tool = ToolShaft((0.3, 0.2, 0.1), (0.0, 0.0, 1.0), 0.01)
    with pytest.raises(GraspError, match="along the tool's axis; give a direction across it"):
        approach(HAND, tool, DOWN)
    least, most = heights(HAND, 0.005)
    assert (1e3 * least, 1e3 * most) == pytest.approx((75.51, 90.82), abs=0.01)
    with pytest.raises(GraspError, match=r"from 75\.51 to 90\.82 mm"):
        approach(HAND, tool, (1.0, 0.0, 0.0), height=0.1)
    least, most = heights(replace(HAND, joint_height=0.2), 0.12)
    slim = replace(HAND, distal=HAND.distal - HAND.pad)
    away = np.arccos((0.126 - HAND.knuckle - HAND.proximal) / slim.distal) - HAND.bend
    assert least == pytest.approx(forward(slim, (0.0, 0.0, away))[2]), "joint 2 held at its begin"
    assert least < most
    with pytest.raises(GraspError, match="a tool of 330 mm"):
        heights(HAND, 0.165)


def test_a_tool_without_thickness_or_direction_is_refused():
    with pytest.raises(GraspError, match="diameter 0"):
        ToolShaft((0, 0, 0), (1, 0, 0), 0.0)
    with pytest.raises(NumericalError, match="has no direction"):
        ToolShaft((0, 0, 0), (0, 0, 0), 0.01)


# Force closure


def opposed(mu: float, radius: float = 0.004) -> Contacts:
    return Contacts(np.array([(-radius, 0.0), (radius, 0.0)]), np.array([(1, 0), (-1, 0)]), mu)


@pytest.mark.parametrize("way", list(ClosureWay))
@pytest.mark.parametrize("mu", [1e-3, 0.1, 0.5, 1.0, 3.0])
@pytest.mark.parametrize("scale", [None, 0.001, 0.05])
def test_two_opposed_contacts_have_the_margin_of_their_closed_form(way, mu, scale):
    found = force_closure(opposed(mu), way=way, scale=scale)
    lever = (scale or 0.004) / (0.004 * mu)
    assert found.closed
    assert found.margin == pytest.approx(1.0 / np.sqrt(1.0 + mu**-2 + lever**2), rel=1e-9)


@pytest.mark.long("statistics")
def test_two_contacts_in_the_plane_close_where_each_is_inside_the_others_cone():
    rng, closed = np.random.default_rng(5), 0
    for _ in range(200):
        points = rng.normal(size=(2, 2))
        line = points[1] - points[0]
        normals = np.array([line, -line]) + rng.normal(size=(2, 2)) * 0.7
        contacts = Contacts(points, normals, rng.uniform(0.05, 1.2))
        ways = [force_closure(contacts, way=way) for way in ClosureWay]
        assert {found.closed for found in ways} == {pair_closed(contacts)}
        hull, programme, pair = (found.margin for found in ways)
        assert pair == pytest.approx(hull, rel=1e-9, abs=1e-14)
        assert programme == pytest.approx(hull, rel=1e-6, abs=1e-9)
        closed += pair_closed(contacts)
    assert 40 < closed < 160


def test_two_contacts_hold_a_ring_from_within_as_well():
    points = np.array([(-0.01, 0.0), (0.01, 0.0)])
    within = Contacts(points, points, 0.3)
    assert pair_closed(within)
    found = force_closure(within)
    assert found.closed
    assert found.margin == pytest.approx(force_closure(Contacts(points, -points, 0.3)).margin)


def random_grasp(rng: np.random.Generator) -> Contacts:
    count = int(rng.integers(2, 5))
    points = rng.normal(size=(count, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    normals = -points + 0.3 * rng.normal(size=(count, 3))
    return Contacts(points, normals, rng.uniform(0.3, 1.2), float(rng.choice([0.0, 0.1])))


@pytest.mark.long("statistics")
def test_hull_and_linear_programme_agree_in_space_and_the_programme_never_says_less():
    rng, closed = np.random.default_rng(6), 0
    for _ in range(60):
        contacts = random_grasp(rng)
        hull = force_closure(contacts)
        programme = force_closure(contacts, way=ClosureWay.PROGRAMME)
        assert hull.closed is programme.closed
        assert programme.margin >= hull.margin * (1.0 - 1e-9)
        assert programme.margin <= hull.margin * 1.05
        closed += hull.closed
    assert 15 < closed < 50


def test_no_wrench_of_the_size_of_the_margin_is_out_of_reach():
    """In every direction some contact pushes by at least the margin, in one by just that much."""
    rng = np.random.default_rng(7)
    contacts = Contacts(THREE, -THREE, 0.6, 0.002)
    rays, found = wrenches(contacts).rays, force_closure(contacts)
    directions = rng.normal(size=(20_000, 6))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    assert (directions @ rays.T).max(axis=1).min() >= found.margin


def test_every_facet_tried_gives_the_margin_of_the_hull():
    contacts = Contacts(THREE, -THREE, 0.6)
    rays = wrenches(contacts, edges=4).rays
    nearest = np.inf
    for chosen in itertools.combinations(range(len(rays)), 6):
        corner = rays[list(chosen)]
        if abs(np.linalg.det(corner)) < 1e-12:
            continue
        normal = np.linalg.solve(corner, np.ones(6))
        if (rays @ normal).max() <= 1.0 + 1e-9:
            nearest = min(nearest, 1.0 / np.linalg.norm(normal))
    assert force_closure(contacts, edges=4).margin == pytest.approx(nearest, rel=1e-9)


def test_two_hard_fingers_in_space_never_close_and_soft_ones_do():
    points, normals = np.array([(-1.0, 0, 0), (1.0, 0, 0)]), np.array([(1.0, 0, 0), (-1.0, 0, 0)])
    hard = force_closure(Contacts(points, normals, 5.0))
    assert (hard.closed, hard.rank, hard.margin) == (False, 5, 0.0)
    assert hard.reason == "the wrenches span 5 of 6 dimensions"
    assert force_closure(Contacts(points, normals, 0.5, 0.05)).closed


def test_without_friction_the_plane_needs_couples_of_both_signs():
    square = np.array([(1.0, 0.3), (-1.0, -0.3), (0.3, -1.0), (-0.3, 1.0)])
    normals = np.array([(-1.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.0, -1.0)])
    assert not force_closure(Contacts(square, normals, 0.0)).closed, "all four turn one way"
    square[2:] *= (-1.0, 1.0)
    assert force_closure(Contacts(square, normals, 0.0)).closed, "two turn each way"


@pytest.mark.long("machine")
def test_a_cone_with_more_edges_closes_no_worse_and_the_inscribed_is_conservative():
    contacts = Contacts(THREE, -THREE, 0.5, 0.002)
    margins = [force_closure(contacts, edges).margin for edges in (4, 8, 16, 32)]
    assert margins == sorted(margins)
    assert margins[-1] / margins[1] - 1.0 < 0.1


def test_the_margin_knows_no_frame_and_its_scale_is_stated():
    rng = np.random.default_rng(8)
    contacts = Contacts(rng.normal(size=(3, 2)), rng.normal(size=(3, 2)), 0.8)
    before = force_closure(contacts)
    c, s = np.cos(1.1), np.sin(1.1)
    turn = np.array([[c, -s], [s, c]])
    moved = Contacts(contacts.points @ turn.T + (3.0, -2.0), contacts.normals @ turn.T, 0.8)
    assert force_closure(moved).margin == pytest.approx(before.margin, abs=1e-12)
    larger = Contacts(10.0 * contacts.points, contacts.normals, 0.8)
    assert force_closure(larger).margin == pytest.approx(before.margin, rel=1e-9)
    assert force_closure(larger).scale == pytest.approx(10.0 * before.scale)


def test_an_open_grasp_says_why_and_no_force_holds_it():
    one_side = Contacts(np.array([(0.0, 0.0), (1.0, 0.0)]), np.array([(0.0, 1.0), (0.0, 1.0)]), 0.5)
    found = force_closure(one_side)
    assert (found.closed, found.rank) == (False, 3)
    with pytest.raises(GraspError, match="no force holds the tool: a wrench exists against which"):
        found.squeeze(1.0)
    closed = force_closure(opposed(0.5))
    assert closed.squeeze(2.0) == pytest.approx(2.0 / closed.margin)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Contacts(np.zeros((2, 4)), np.zeros((2, 4)), 0.5), r"shape \(2, 4\)"),
        (lambda: Contacts(np.zeros((2, 2)), np.ones((3, 2)), 0.5), "normals of shape"),
        (lambda: Contacts(np.zeros((2, 2)), np.ones((2, 2)), -0.1), "friction is -0.1"),
        (lambda: Contacts(np.zeros((2, 2)), np.ones((2, 2)), 0.1, 0.1), "leave soft at 0"),
        (lambda: force_closure(Contacts(THREE, -THREE, 0.5), edges=2), "with 2 edges"),
        (lambda: force_closure(opposed(0.5), scale=0.0), "the torque scale is 0.0 m"),
        (
            lambda: force_closure(Contacts(THREE, -THREE, 0.5), way=ClosureWay.PAIR),
            "no closed form for 24 rays of 6 dimensions, only for two contacts in the plane",
        ),
        (lambda: pair_closed(Contacts(THREE, -THREE, 0.5)), "two contacts in the plane"),
    ],
)
def test_contacts_that_make_no_sense_are_refused(make, words):
    with pytest.raises(GraspError, match=words):
        make()


# Firm grasp

POSTURE = np.radians([0.0, 84.825, 28.275])
LEVER = Lever.of(HAND, POSTURE, (-1.0, 0.0, 0.0))
DRIVE = {key: getattr(PROFILE.drive, key) for key in ("lag", "period", "top_speed")}


def test_the_lever_is_the_travel_of_the_grasp_point_and_the_torque_at_joint_2():
    step = 1e-3
    motor = POSTURE[1] * HAND.proximal_gear
    start = forward(HAND, POSTURE)[0]
    free = forward(HAND, (0.0, *driven(HAND, motor + step)))[0]
    alone = forward(HAND, (0.0, *driven(HAND, motor + step, broken_at=motor)))[0]
    assert (start - free) / step == pytest.approx(LEVER.free, rel=1e-5)
    assert (start - alone) / step == pytest.approx(LEVER.alone, rel=1e-4)
    torque = jacobian(HAND, POSTURE).T @ (1.0, 0.0, 0.0)  # the tool pushes back along +x
    assert -torque[1] == pytest.approx(LEVER.arm)
    for q in joints_within(50, 10):
        normal = -jacobian(HAND, q)[:, 1] - jacobian(HAND, q)[:, 2]
        normal /= -np.linalg.norm(normal)
        lever = Lever.of(HAND, q, normal)
        _, by2, by3 = normal @ jacobian(HAND, q)
        assert lever.arm == pytest.approx(by2, abs=1e-15)
        assert lever.alone * HAND.distal_gear == pytest.approx(by3, abs=1e-15)
    with pytest.raises(GraspError, match="both must be into the tool"):
        Lever.of(HAND, POSTURE, (1.0, 0.0, 0.0))


@pytest.mark.long("machine")
@pytest.mark.parametrize("stiffness", [1e2, 1e3, 1e4, 1e5, 1e6])
@pytest.mark.parametrize("relaxation", [0.0, 1e-3, 0.05])
@pytest.mark.parametrize("softer", [1.0, 0.1])
@pytest.mark.parametrize("goal", [2.0, 8.0])
def test_a_press_comes_to_its_goal_without_overshoot(stiffness, relaxation, softer, goal):
    """Soft to stiff, below the breakaway's 5.5 N and above it."""
    design = SoftContact(stiffness, relaxation * stiffness)
    law = FirmGrasp(goal, LEVER, design, **DRIVE)
    contact = SoftContact(softer * stiffness, softer * relaxation * stiffness)
    slowest = 1.0 / (law.used_gain * contact.stiffness * LEVER.alone)
    found = press(law, contact, 12.0 * slowest + 1.0)
    assert found.overshoot(goal) <= OVERSHOOT
    assert found.settled(goal) < 10.0 * slowest + 0.1
    assert (found.broken_at is not None) is (goal > HAND.breakaway / LEVER.arm)


def test_the_motion_between_two_commands_is_exact():
    """Against small steps of the same law."""
    law = FirmGrasp(8.0, LEVER, SoftContact(2e3, 5.0), **DRIVE)
    found = press(law, SoftContact(2e3, 5.0, gap=0.001), 0.4)
    h, angle, speed, travel, gear = 1e-6, 0.0, 0.0, 0.0, LEVER.free
    forces = []
    for i in range(400_000):
        depth = travel - 0.001
        force = max(2e3 * depth + 5.0 * gear * speed, 0.0) if depth > 0.0 else 0.0
        if force * LEVER.arm >= LEVER.breakaway:
            gear = LEVER.alone
        if i % 2000 == 0:
            command = float(np.clip(law.used_gain * (8.0 - force), -250.0, 250.0))
        before = angle
        angle += h * speed
        speed += h * (command - speed) / DRIVE["lag"]
        travel += gear * (angle - before)
        forces.append(force)
    at = np.round(found.times / h).astype(int)[:-1]
    assert found.force[:-1] == pytest.approx(np.array(forces)[at], abs=5e-3)


def test_a_gain_that_would_oscillate_is_refused_with_the_largest_that_does_not():
    contact = SoftContact(1e5)
    most = stable_gain(contact, LEVER.free, DRIVE["lag"], DRIVE["period"])
    with pytest.raises(GraspError, match=f"give less than {most:.4g}"):
        FirmGrasp(5.0, LEVER, contact, **DRIVE, gain=1.001 * most)
    calm = press(FirmGrasp(2.0, LEVER, contact, **DRIVE, gain=0.9 * most), contact, 20.0)
    assert calm.force[-1] == pytest.approx(2.0, rel=1e-6)
    soft = FirmGrasp(5.0, LEVER, SoftContact(1e2), **DRIVE)
    with pytest.raises(GraspError, match="oscillate ever more"):
        press(soft, SoftContact(1e5), 1.0)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: SoftContact(0.0), "stiffness is 0.0 N/m; give more than 0"),
        (lambda: SoftContact(10.0, -1.0), "damping is -1.0"),
        (lambda: FirmGrasp(0.0, LEVER, SoftContact(1e3), **DRIVE), "goal is 0.0"),
        (lambda: FirmGrasp(1.0, LEVER, SoftContact(1e3), 0.01, 0.0, 1.0), "period is 0.0"),
        (lambda: FirmGrasp(1.0, LEVER, SoftContact(1e3), **DRIVE, gain=-1.0), "gain is -1.0"),
    ],
)
def test_impossible_presses_are_refused(make, words):
    with pytest.raises(GraspError, match=words):
        make()


def test_a_press_that_has_not_settled_says_so():
    law = FirmGrasp(2.0, LEVER, SoftContact(1e6), **DRIVE)
    found = press(law, SoftContact(1e3), 0.1)
    with pytest.raises(GraspError, match=r"after 0\.1 s the force is"):
        found.settled(2.0)
    with pytest.raises(GraspError, match="give 1 to 1e6"):
        press(law, SoftContact(1e3), 0.0)


def test_the_designed_gain_gives_the_sampled_loop_one_double_pole():
    law = FirmGrasp(4.0, LEVER, SoftContact(2e3), **DRIVE)
    period, lag = law.period, law.lag
    a = np.exp(-period / lag)

    def poles(gain):
        # a motor whose speed lags its command, which is held for a period, on a spring
        kappa = gain * law.contact.stiffness * max(law.lever.free, law.lever.alone)
        step = [
            [1.0 - kappa * (period - lag * (1.0 - a)), lag * (1.0 - a)],
            [-kappa * (1.0 - a), a],
        ]
        return np.linalg.eigvals(np.array(step))

    assert np.ptp(poles(law.designed_gain).real) < 1e-6
    assert np.abs(poles(0.999 * law.designed_gain).imag).max() == 0.0
    assert np.abs(poles(1.001 * law.designed_gain).imag).max() > 0.0
