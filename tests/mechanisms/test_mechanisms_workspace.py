"""Workspace in cones of tilt against the independent table (docs/errata.md), hub points by name."""

import numpy as np
import pytest

from app.mechanisms.errors import MechanismError
from app.mechanisms.pantograph import Geometry, Region, locate, survey
from app.mechanisms.profile import load_profile

PROFILE = load_profile("icube")
GEOMETRY = PROFILE.pantograph


@pytest.mark.parametrize(
    ("tilt_deg", "radius_mm", "left", "right", "condition", "lever"),
    [
        (30, 52.0, (117.0, 181.6), (-1.5, 63.0), 1.61, (0.925, 1.222)),
        (39, 72.9, (104.2, 200.0), (-20.0, 75.8), 1.75, (0.727, 1.222)),
        (45, 90.0, (91.5, 220.6), (-40.6, 88.5), 2.43, (0.571, 1.222)),
    ],
)
def test_the_workspace_is_that_of_the_independent_table(
    tilt_deg, radius_mm, left, right, condition, lever
):
    """Their grid is coarser: half a degree and one percent of room."""
    found = survey(GEOMETRY, np.radians(tilt_deg))
    assert found.share == 1.0
    assert found.no_grip == 0.0
    assert found.radius * 1e3 == pytest.approx(radius_mm, abs=0.05)
    assert np.degrees(found.q_left) == pytest.approx(left, abs=0.55)
    assert np.degrees(found.q_right) == pytest.approx(right, abs=0.55)
    assert found.worst_condition == pytest.approx(condition, rel=0.01)
    assert found.lever == pytest.approx(lever, abs=1e-3)
    assert found.torque_printed == pytest.approx(0.599, abs=2e-3)
    assert 0.593 < found.torque < 0.597


def test_a_third_of_the_sixty_degree_cone_is_out_of_reach():
    found = survey(GEOMETRY, np.radians(60.0))
    assert 1.0 - found.share == pytest.approx(0.32, abs=0.01)
    assert found.worst_condition > 30.0


def test_the_vertical_needs_the_known_torque_for_five_newtons():
    found = survey(GEOMETRY, np.radians(0.01))
    assert found.torque == pytest.approx(0.593, abs=5e-4)
    assert found.torque_printed == pytest.approx(found.torque, rel=1e-3)  # the laws agree there


def test_a_survey_that_reaches_nothing_or_of_no_cone_is_refused():
    far = Geometry(0.01, 0.012, 0.085, GEOMETRY.fulcrum, 0.2)
    with pytest.raises(MechanismError, match="no tool point within 30° of tilt is reached"):
        survey(far, np.radians(30.0))
    for tilt in (0.0, np.pi / 2, np.nan):
        with pytest.raises(MechanismError, match="a cone needs more than 0"):
            survey(GEOMETRY, tilt)


def test_a_hub_point_is_located_by_name():
    def place(hub):
        return locate(GEOMETRY, hub, PROFILE.tilt_limit, PROFILE.depth_range)

    def above(tilt_deg, l_out):
        tilt = np.radians(tilt_deg)
        return GEOMETRY.fulcrum + l_out * np.array([np.sin(tilt), 0.0, np.cos(tilt)])

    inside = place(above(20.0, 0.12))
    assert inside.region is Region.INSIDE
    assert np.degrees(inside.tilt) == pytest.approx(20.0)
    assert inside.depth == pytest.approx(0.08)
    assert place(above(42.0, 0.12)).region is Region.BEYOND_TILT
    assert place(above(20.0, 0.02)).region is Region.BEYOND_DEPTH
    assert place(above(80.0, 0.12)).region is Region.UNREACHABLE
    assert place(GEOMETRY.fulcrum).region is Region.AT_FULCRUM
    assert place(above(90.0, 0.1)).region is Region.BELOW_FULCRUM
    assert place(above(150.0, 0.1)).region is Region.BELOW_FULCRUM
    assert place((0.0, np.nan, 0.2)).region is Region.NOT_FINITE
