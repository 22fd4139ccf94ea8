"""Workspace in cones of tilt against the independent table (docs/errata.md), hub points by name."""

import numpy as np
import pytest
from mechanisms.hub_region import HubRegion, locate, survey
from scipy.optimize import minimize

from app.mechanisms.errors import MechanismError
from app.mechanisms.pantograph import (
    Geometry,
    inverse,
    jacobian,
    needle_at,
)
from app.mechanisms.profile import load_profile
from app.studies.references.workspace import torque_per_newton

PROFILE = load_profile("icube")
GEOMETRY = PROFILE.pantograph
_EXACT = {"xatol": 1e-12, "fatol": 1e-15, "maxiter": 4000}


@pytest.mark.long("statistics")
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
    assert found.torque_printed == pytest.approx(0.60041, abs=1e-5)
    assert found.torque == pytest.approx(0.596545, abs=1e-6)


@pytest.mark.long("statistics")
def test_the_largest_torque_is_found_between_the_rings_of_the_grid():
    """An optimiser of its own, with angles and Jacobian by the public functions, agrees."""

    def torque(offset):
        needle = needle_at(GEOMETRY, GEOMETRY.fulcrum[:2] + offset)
        across = np.eye(3) - np.outer(needle.axis, needle.axis)
        columns = jacobian(GEOMETRY, inverse(GEOMETRY, needle.p3))
        lever = (GEOMETRY.needle_length - needle.l_in) / needle.l_in
        return 5.0 * lever * max(np.linalg.norm(across[:, :2] @ c) for c in columns.T)

    grid = np.linspace(-0.012, 0.012, 49)
    start = max(((x, y) for x in grid for y in grid), key=torque)
    best = minimize(lambda at: -torque(at), start, method="Nelder-Mead", options=_EXACT)
    assert np.abs(best.x) == pytest.approx([1.3e-3, 5.0e-3], abs=1e-4)
    for tilt_deg in (5.0, 30.0, 39.0, 45.0, 60.0):
        assert survey(GEOMETRY, np.radians(tilt_deg)).torque == pytest.approx(-best.fun, abs=1e-9)


def test_a_wider_cone_never_needs_less_torque():
    tilts = np.radians([0.01, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 30.0, 39.0, 45.0, 60.0])
    found = [survey(GEOMETRY, tilt) for tilt in tilts]
    for value in ("torque", "torque_printed"):
        assert np.diff([getattr(f, value) for f in found]).min() >= -1e-9


@pytest.mark.parametrize(
    ("depth_mm", "upright", "cone", "force"),
    [(-30.0, 1.241, 1.250, 2.40), (0.0, 1.079, 1.087, 2.76), (90.0, 0.593, 0.598, 5.02)],
)
def test_five_newtons_need_more_torque_the_higher_the_tip_stands(depth_mm, upright, cone, force):
    l_out = GEOMETRY.needle_length - 1e-3 * depth_mm
    assert 5.0 * torque_per_newton(GEOMETRY, l_out) == pytest.approx(upright, abs=6e-4)
    needed = torque_per_newton(GEOMETRY, l_out, PROFILE.tilt_limit)
    assert 5.0 * needed == pytest.approx(cone, abs=6e-4)
    assert PROFILE.limits.joint_torque / needed == pytest.approx(force, abs=5e-3)


def test_a_torque_for_no_lever_or_no_cone_is_refused():
    for l_out, tilt in ((0.0, 0.1), (np.nan, 0.1), (0.1, 2.0), (0.1, -0.1), (0.1, np.nan)):
        with pytest.raises(MechanismError, match="must be above 0"):
            torque_per_newton(GEOMETRY, l_out, tilt)
    far = Geometry(0.01, 0.012, 0.085, GEOMETRY.fulcrum, 0.2)
    with pytest.raises(MechanismError, match="no tool point within 30° of tilt is reached"):
        torque_per_newton(far, 0.1, np.radians(30.0))


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
    assert inside.region is HubRegion.INSIDE
    assert np.degrees(inside.tilt) == pytest.approx(20.0)
    assert inside.depth == pytest.approx(0.08)
    assert place(above(42.0, 0.12)).region is HubRegion.BEYOND_TILT
    assert place(above(20.0, 0.02)).region is HubRegion.BEYOND_DEPTH
    assert place(above(80.0, 0.12)).region is HubRegion.UNREACHABLE
    assert place(GEOMETRY.fulcrum).region is HubRegion.AT_FULCRUM
    assert place(above(90.0, 0.1)).region is HubRegion.BELOW_FULCRUM
    assert place(above(150.0, 0.1)).region is HubRegion.BELOW_FULCRUM
    assert place((0.0, np.nan, 0.2)).region is HubRegion.NOT_FINITE
