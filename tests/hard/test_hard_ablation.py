"""Ablation where its geometry is delicate: balls, needles, discs, places on the axis."""

import numpy as np
import pytest

from app.imaging.field import TissueKind
from app.planning.ablation.covering import MOST_MM, margins_mm, volumes
from app.planning.ablation.judging import Lesion, judge
from app.planning.ablation.zone import Zone
from app.planning.errors import PlanError
from tests.ablation_rig import liver

UP = np.array([0.0, 0.0, 1.0])


@pytest.mark.parametrize(
    ("long", "short"), [(10.0, 10.0), (10.0, 10.0 - 1e-9), (60.0, 0.5), (0.5, 60.0), (1e-3, 1e-3)]
)
def test_distances_are_finite_and_right_at_the_middle_on_the_axis_and_far_away(long, short):
    zone = Zone(np.zeros(3), UP, long, short)
    at = np.array(
        [
            [0.0, 0.0, 0.0],
            [0.0, 0.0, long],
            [0.0, 0.0, -long],
            [short, 0.0, 0.0],
            [0.0, 0.0, long + 5.0],
            [0.0, short + 5.0, 0.0],
            [1e-13, 0.0, 1e-13],
            [3e5, 0.0, 0.0],
            [0.0, 0.0, 1e-9 * long],
        ]
    )
    depth, nearest = zone.depths_mm(at), zone.nearest_mm(at)
    assert np.isfinite(depth).all()
    assert np.isfinite(nearest).all()
    # The middle's nearest place is at the end of the shorter half axis.
    right = [min(long, short), 0.0, 0.0, 0.0, -5.0, -5.0]
    assert depth[:6] == pytest.approx(right, abs=1e-6 * max(long, short))
    assert depth[7] == pytest.approx(short - 3e5, rel=1e-9)
    on = (nearest[:, 2] / long) ** 2 + (np.hypot(*nearest[:, :2].T) / short) ** 2
    assert on == pytest.approx(np.ones(len(at)), abs=1e-6)


def test_the_depth_does_not_jump_across_the_axis():
    zone = Zone(np.zeros(3), UP, 22.0, 15.0)
    heights = np.linspace(-25.0, 25.0, 41)
    for off in (1e-14, 1e-10, 1e-6):
        beside = np.column_stack([np.full(41, off), np.zeros(41), heights])
        on = np.column_stack([np.zeros((41, 2)), heights])
        assert np.abs(zone.depths_mm(beside) - zone.depths_mm(on)).max() < 2e-6


def test_zones_that_are_one_or_touch_or_miss_leave_the_margin_of_one():
    ball = Zone(np.zeros(3), UP, 15.0, 15.0)
    points = Zone(np.zeros(3), UP, 10.0, 10.0).surface_mm(2.0)
    alone = margins_mm(points, [ball])
    assert alone == pytest.approx(np.full(len(points), 5.0), abs=1e-6)
    same = margins_mm(points, [ball, ball])
    assert same == pytest.approx(alone, abs=1e-6)
    within = margins_mm(points, [ball, Zone(np.zeros(3), UP, 3.0, 3.0)])
    assert within == pytest.approx(alone, abs=1e-6)
    touching = margins_mm(points, [ball, Zone(np.array([0.0, 0.0, 30.0]), UP, 15.0, 15.0)])
    assert touching == pytest.approx(alone, abs=0.02)
    far = margins_mm(points, [Zone(np.array([0.0, 0.0, 500.0]), UP, 15.0, 15.0)])
    assert (far == -MOST_MM).all()
    assert (margins_mm(points, []) == -MOST_MM).all()


def test_two_zones_that_are_one_cover_as_much_as_one():
    lesion = Zone(np.zeros(3), UP, 10.0, 10.0)
    zone = Zone(np.array([6.0, 0.0, 0.0]), UP, 9.0, 9.0)
    _, once = volumes(lesion.about_mm, [zone], lesion.box_mm)
    _, twice = volumes(lesion.about_mm, [zone, zone], lesion.box_mm)
    assert twice == pytest.approx(once, rel=1e-12)
    whole, none = volumes(lesion.about_mm, [], lesion.box_mm)
    assert none == 0.0
    assert whole == pytest.approx(lesion.volume_mm3, rel=1e-4)


@pytest.mark.long("statistics")
def test_zones_outside_the_body_and_the_field_are_told_and_break_nothing():
    lesion = Lesion.at(liver(), (0.0, 0.0, 0.0))
    for off in (45.0, 90.0, 1e5):
        away = judge(lesion, [Zone(np.array([0.0, 0.0, off]), UP, 20.0, 15.0)])
        assert away.share == 0.0
        assert away.least_mm < -10.0
        assert TissueKind.UNKNOWN in {one.kind for one in away.reached}
        assert np.isfinite(away.margin_mm).all()


@pytest.mark.long("statistics")
def test_a_hole_that_zones_leave_inside_the_lesion_is_no_margin():
    lesion = Lesion.at(liver(), (0.0, 0.0, 0.0))
    ring = [
        Zone(14.0 * np.array([np.cos(turn), np.sin(turn), 0.0]), UP, 30.0, 11.5)
        for turn in np.arange(6) * np.pi / 3.0
    ]
    hollow = judge(lesion, ring)
    assert hollow.share < 1.0
    # At the lesion's poles, 10 mm from the middle, the zones are a little thinner.
    thin = 11.5 * np.sqrt(1.0 - (10.5 / 30.0) ** 2)
    assert hollow.least_mm == pytest.approx(thin - 14.0, abs=0.1)


def test_no_lesion_and_no_direction_are_refused_by_name():
    with pytest.raises(PlanError, match="nobody marked a lesion"):
        Lesion.at(liver(), (300.0, 0.0, 0.0))
    with pytest.raises(PlanError, match="no direction"):
        Zone(np.zeros(3), np.zeros(3), 10.0, 5.0)
    with pytest.raises(PlanError, match="above 0"):
        Zone(np.zeros(3), UP, 10.0, np.nan)
