"""A planner's word on one path, in bodies whose distances and angles are known by formula."""

import numpy as np
import pytest
from field_rig import ball, beyond, field_of_shapes

from app.imaging.field import TissueKind
from app.planning.errors import PlanError
from app.planning.judged_plan import judge_plan, outward

Kind = TissueKind
TARGET = np.array([0.0, 60.0, 0.0])


def rod(x: float, y: float, radius: float):
    """Return a straight rod along z."""
    return lambda points: np.hypot(points[:, 0] - x, points[:, 1] - y) - radius


def slab(low: float, high: float):
    """Return all between two planes across y."""
    return lambda points: np.maximum(low - points[:, 1], points[:, 1] - high)


def body(*more, spacing: float = 1.0, deep: int = 100):
    """Skin at y = 0, the body behind it, liver from 10 mm on; and what is laid over."""
    shapes = [
        (Kind.AIR, "", lambda points: np.full(len(points), -50.0)),
        (Kind.FAT, "", beyond((0, 1, 0), 0.0)),
        (Kind.ORGAN, "liver", beyond((0, 1, 0), 10.0)),
        *more,
    ]
    size = tuple(round(length / spacing) + 1 for length in (120.0, deep + 20.0, 60.0))
    return field_of_shapes(shapes, (-60.0, -20.0, -30.0), size, spacing)


@pytest.mark.parametrize("degrees", [0.0, 15.0, 30.0])
def test_length_and_angle_are_those_of_the_triangle(degrees: float) -> None:
    entry = TARGET + 60.0 * np.array([np.tan(np.radians(degrees)), -1.0, 0.0])
    plan = judge_plan(body(), entry, TARGET)
    assert plan.length_mm == pytest.approx(60.0 / np.cos(np.radians(degrees)))
    assert plan.angle_deg == pytest.approx(degrees, abs=1.5)
    assert plan.clear_mm == np.inf
    assert plan.meets == ()
    assert (plan.is_long, plan.is_flat) == (False, False)


@pytest.mark.parametrize("away", [3.0, 6.0, 9.0])
def test_room_is_the_distance_from_the_nearest_that_must_not_be_met(away: float) -> None:
    rib = (Kind.BONE, "rib", rod(away + 3.0, 5.0, 3.0))
    vein = (Kind.VESSEL, "portal vein", rod(-away - 6.0, 40.0, 5.0))
    plan = judge_plan(body(rib, vein), (0.0, 0.0, 0.0), TARGET)
    assert plan.clear_mm == pytest.approx(away, abs=0.6)
    assert plan.nearest == "rib"
    assert plan.nearest_mm == pytest.approx(5.0, abs=1.0)
    assert plan.meets == ()


@pytest.mark.parametrize("spacing", [0.8, 1.6])
def test_room_is_in_millimetres_whatever_the_voxels_are(spacing: float) -> None:
    rib = (Kind.BONE, "rib", rod(9.0, 20.0, 3.0))
    plan = judge_plan(body(rib, spacing=spacing), (0.0, 0.0, 0.0), TARGET)
    assert plan.clear_mm == pytest.approx(6.0, abs=spacing)


@pytest.mark.long("statistics")
@pytest.mark.parametrize("kind", [Kind.BONE, Kind.LUNG, Kind.VESSEL, Kind.GUT, Kind.HEART])
def test_each_kind_that_no_needle_should_meet_is_kept_away_from(kind: TissueKind) -> None:
    plan = judge_plan(body((kind, "it", rod(9.0, 30.0, 3.0))), (0.0, 0.0, 0.0), TARGET)
    assert plan.clear_mm == pytest.approx(6.0, abs=0.6)
    met = judge_plan(body((kind, "it", rod(0.0, 30.0, 3.0))), (0.0, 0.0, 0.0), TARGET)
    assert (met.points, met.clear_mm, [one.kind for one in met.meets]) == (0.0, 0.0, [kind])


@pytest.mark.parametrize("name", ["small vessel", "lung vessel"])
def test_a_small_vessel_may_be_met_and_costs_nothing(name: str) -> None:
    vessel = (Kind.VESSEL, name, rod(0.5, 30.0, 1.6))
    plan, without = (judge_plan(body(*some), (0, 0, 0), TARGET) for some in ((vessel,), ()))
    assert (plan.meets, plan.clear_mm) == ((), np.inf)
    assert plan.points == pytest.approx(without.points)


def test_what_holds_the_target_is_kept_away_from_by_none() -> None:
    lung = (Kind.LUNG, "", slab(20.0, 110.0))
    assert judge_plan(body(lung), (0.0, 0.0, 0.0), TARGET).clear_mm == np.inf


def test_the_points_are_those_of_the_written_rule() -> None:
    """Parts of length to 120 mm and of angle to 65°, and of room to 10 mm twice, of four; a lung
    that holds the target adds a fifth, of the angle at the pleura to 90°.
    """
    rib = (Kind.BONE, "rib", rod(9.0, 5.0, 3.0))
    plan = judge_plan(body(rib), (0.0, 0.0, 0.0), TARGET)
    assert plan.points == pytest.approx(100.0 * (1.0 - (60.0 / 120.0 + 2.0 * 0.4) / 4.0), abs=3.0)
    entry = (60.0 * np.tan(np.radians(30.0)), 0.0, 0.0)
    tilted = judge_plan(body((Kind.LUNG, "", slab(20.0, 110.0))), entry, TARGET)
    length = 60.0 / np.cos(np.radians(30.0))
    cost = length / 120.0 + 30.0 / 65.0 + 30.0 / 90.0
    assert tilted.points == pytest.approx(100.0 * (1.0 - cost / 5.0), abs=2.0)


def test_a_path_that_is_too_long_is_none() -> None:
    for length, is_long in ((119.0, False), (121.0, True)):
        plan = judge_plan(body(deep=140), (0.0, 0.0, 0.0), (0.0, length, 0.0))
        assert plan.is_long is is_long
        assert (plan.points == 0.0) is is_long


@pytest.mark.long("statistics")
def test_what_lies_nearer_costs_more_and_what_is_met_costs_all() -> None:
    points = [
        judge_plan(body((Kind.BONE, "rib", rod(away + 3.0, 5.0, 3.0))), (0, 0, 0), TARGET).points
        for away in (30.0, 9.0, 6.0, 3.0, -1.0)
    ]
    assert points[0] > points[1] > points[2] > points[3] > points[4] == 0.0


def test_lung_on_the_path_is_told_with_its_length_and_its_depth() -> None:
    plan = judge_plan(body((Kind.LUNG, "", slab(20.0, 26.0))), (0.0, 0.0, 0.0), TARGET)
    (lung,) = plan.meets
    assert lung.kind is Kind.LUNG
    assert lung.length_mm == pytest.approx(6.0, abs=0.1)
    assert lung.depth_mm == pytest.approx(20.0, abs=0.1)
    assert (plan.points, plan.clear_mm) == (0.0, 0.0)


def test_the_lung_that_holds_the_target_is_crossed_at_the_price_of_its_angle() -> None:
    lung = (Kind.LUNG, "", slab(20.0, 110.0))
    straight = judge_plan(body(lung), (0.0, 0.0, 0.0), TARGET)
    assert straight.meets == ()
    assert straight.pleural_deg == pytest.approx(0.0, abs=2.0)
    tilted = judge_plan(body(lung), (60.0 * np.tan(np.radians(30.0)), 0.0, 0.0), TARGET)
    assert tilted.pleural_deg == pytest.approx(30.0, abs=2.0)
    assert 0.0 < tilted.points < straight.points


def test_a_path_that_lies_flat_is_none() -> None:
    entry = TARGET + np.array([60.0 * np.tan(np.radians(44.0)), -60.0, 0.0])
    assert judge_plan(body(), entry, TARGET).points > 0.0
    near = np.array([0.0, 20.0, 0.0])
    flat = judge_plan(body(), near + np.array([20.0 * np.tan(np.radians(68.0)), -20.0, 0]), near)
    assert flat.is_flat
    assert flat.points == 0.0


def test_the_skin_faces_out_of_a_round_body_too() -> None:
    shapes = [
        (Kind.AIR, "", lambda points: np.full(len(points), -50.0)),
        (Kind.FAT, "", ball((0.0, 40.0, 0.0), 40.0)),
    ]
    field = field_of_shapes(shapes, (-60.0, -20.0, -60.0), (121, 121, 121))
    for degrees in (0.0, 25.0, 60.0):
        normal = np.array([np.sin(np.radians(degrees)), -np.cos(np.radians(degrees)), 0.0])
        found = outward(field, np.array([0.0, 40.0, 0.0]) + 40.0 * normal)
        assert np.degrees(np.arccos(min(1.0, found @ normal))) < 2.0


def test_where_nobody_knows_what_lies_there_nobody_judges() -> None:
    nothing = (Kind.UNKNOWN, "", beyond((0, 1, 0), 15.0))
    with pytest.raises(PlanError, match="nobody labelled"):
        judge_plan(body(nothing), (0.0, 0.0, 0.0), TARGET)
    with pytest.raises(PlanError, match="skin"):
        judge_plan(body(), (0.0, 40.0, 0.0), TARGET)
