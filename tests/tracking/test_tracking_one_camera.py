"""The tip while one camera is lost, and the marker that has not left the tube."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.tracking.agreement import Continuity
from app.tracking.fix import FixStatus
from app.tracking.health import NEVER, Hiding
from app.tracking.markers.silhouette import centroid_shift
from app.tracking.one_camera_fix import LEAST_ANGLE, RayStatus, point_on_line
from app.tracking.optics.rig import NeedleProfile, load_rig
from app.tracking.solver import FixSolver, SeenMarker

FULCRUM = np.array([0.0, 0.16056, 0.090])
NOISE = 0.05  # px


def _axis(tilt_deg, azimuth_deg):
    tilt, azimuth = np.deg2rad([tilt_deg, azimuth_deg])
    across = np.sin(tilt)
    return np.array([across * np.cos(azimuth), across * np.sin(azimuth), -np.cos(tilt)])


def _sighting(rig, camera, p_band, axis, rng=None, noise=NOISE):
    model = rig.models[camera]
    uv = model.pixel(p_band) + centroid_shift(model, rig.needle.shape, p_band, axis)
    error = rng.normal(0.0, noise, 2) if rng is not None else np.zeros(2)
    return SeenMarker(uv + error, noise**2 * np.eye(2))


@pytest.mark.parametrize("camera", [0, 1])
@pytest.mark.parametrize("name", ["wide", "thesis"])
def test_one_ray_and_the_line_give_the_tip_with_a_covariance_that_monte_carlo_confirms(
    name, camera, request
):
    rig = request.getfixturevalue(name)
    solver, rng = FixSolver(rig, FULCRUM), np.random.default_rng(3)
    axis, depth = _axis(20.0, 60.0), 0.07
    fixes, tips = [], []
    for _ in range(500):
        beside = rng.normal(0.0, rig.line_sd_mm * 1e-3, 3)
        beside -= (beside @ axis) * axis  # the robot's line is off by what the rig promises
        tips.append(FULCRUM + beside + depth * axis)
        band = tips[-1] - rig.needle.marker_offset * axis
        noise = np.hypot(NOISE, rig.systematic_px)
        sighting = _sighting(rig, camera, band, axis, rng, noise)
        sighting = SeenMarker(sighting.uv, NOISE**2 * np.eye(2))
        pair = (sighting, None) if camera == 0 else (None, sighting)
        fixes.append(solver.solve(pair, axis, 0.0))
    assert all(fix.status is FixStatus.ONE_CAMERA and fix.usable for fix in fixes)
    errors = np.array([f.p_tip_world - tip for f, tip in zip(fixes, tips, strict=True)])
    sample, predicted = errors.T @ errors / len(errors), fixes[0].covariance
    assert np.linalg.norm(sample - predicted) < 0.15 * np.linalg.norm(predicted)


def test_one_camera_is_coarser_than_two(wide):
    axis = _axis(10.0, 200.0)
    band = FULCRUM + 0.05 * axis
    both = tuple(_sighting(wide, camera, band, axis) for camera in (0, 1))
    solver = FixSolver(wide, FULCRUM)
    two, one = solver.solve(both, axis, 0.0), solver.solve((both[0], None), axis, 0.0)
    assert two.status is FixStatus.VALID
    assert one.radius() > two.radius()
    assert abs(one.depth - two.depth) < 1e-6
    assert one.missing == ("right",)
    assert "needle's line" in one.reason


def test_a_camera_that_looks_along_the_needle_tells_no_depth(wide):
    model = wide.models[0]
    axis = model.centre - FULCRUM
    axis = -axis / np.linalg.norm(axis)
    band = FULCRUM + 0.05 * axis
    sighting = SeenMarker(model.pixel(band), 1e-3 * np.eye(2))
    fix = FixSolver(wide, FULCRUM).solve((sighting, None), axis, 0.0)
    assert fix.status is FixStatus.ONE_CAMERA
    assert not fix.usable
    assert "along the needle" in fix.reason


def test_a_sighting_off_the_needles_line_contradicts_it(wide):
    axis = _axis(10.0, 200.0)
    sighting = _sighting(wide, 0, FULCRUM + 0.05 * axis + [0.01, 0.01, 0.0], axis)
    fix = FixSolver(wide, FULCRUM).solve((sighting, None), axis, 0.0)
    assert fix.status is FixStatus.INCONSISTENT
    assert "beside the needle's line" in fix.reason


@pytest.mark.parametrize("degrees", [0.0, 1e-9, 5.0, 14.9, 15.1, 90.0, 179.0])
def test_the_refusal_of_parallel_rays_is_sharp_and_never_jumps_to_infinity(wide, degrees):
    model = wide.models[0]
    middle = model.T_world_camera @ np.array([0.0, 0.0, 0.4])
    angle = np.deg2rad(degrees)
    axis = model.T_world_camera.rotation @ np.array([np.sin(angle), 0.0, np.cos(angle)])
    found = point_on_line(model.T_camera_world, np.zeros(2), 1e-8 * np.eye(2), (middle, axis), 4e-8)
    refused = np.sin(angle) < np.sin(LEAST_ANGLE)
    assert found.status is (RayStatus.ALONG_THE_SHAFT if refused else RayStatus.FOUND)
    assert np.isfinite(found.covariance).all()
    if not refused:
        assert np.abs(found.p_world - middle).max() < 1e-9


def test_one_camera_is_believed_only_where_it_goes_on_with_what_both_saw(wide):
    solver, continuity = FixSolver(wide, FULCRUM), Continuity()
    axis = _axis(10.0, 200.0)

    def fix(time, depth, cameras):
        band = FULCRUM + depth * axis
        seen = [_sighting(wide, i, band, axis) if i in cameras else None for i in (0, 1)]
        return continuity.judge(solver.solve((seen[0], seen[1]), axis, time))

    alone = fix(0.0, 0.05, (0,))
    assert not alone.usable
    assert alone.status is FixStatus.ONE_CAMERA
    assert "both have seen it" in alone.reason
    assert fix(0.1, 0.05, (0, 1)).usable
    assert fix(0.2, 0.052, (0,)).usable
    assert not fix(0.233, 0.09, (0,)).usable  # 38 mm in a thirtieth of a second
    assert fix(0.266, 0.053, (1,)).usable
    assert fix(1.2, 0.053, (1,)).usable
    assert not fix(2.5, 0.053, (1,)).usable
    assert fix(2.6, 0.09, (0, 1)).usable


@settings(derandomize=True, deadline=None, max_examples=60)
@given(*[st.floats(-2000.0, 3000.0)] * 2, st.sampled_from([0, 1]), st.booleans())
def test_any_pixel_of_one_camera_gives_a_finite_fix_with_a_reason(u, v, camera, poor):
    rig = load_rig("thesis" if poor else "wide")
    sighting = SeenMarker(np.array([u, v]), np.eye(2) * 1e-3)
    pair = (sighting, None) if camera == 0 else (None, sighting)
    fix = FixSolver(rig, FULCRUM).solve(pair, _axis(30.0, 50.0), 0.0)
    assert np.isfinite(fix.p_tip_world).all()
    assert np.isfinite(fix.covariance).all()
    assert fix.reason
    assert fix.status in (FixStatus.ONE_CAMERA, FixStatus.INCONSISTENT)


def _profile(rig, **changes):
    return NeedleProfile.model_validate(rig.needle.model_dump() | changes)


def test_a_marker_that_was_last_seen_at_the_tube_is_not_yet_visible_and_elsewhere_it_is_lost(wide):
    solver = FixSolver(wide, FULCRUM)
    hiding = Hiding(_profile(wide, hidden_mm=(-60.0, 12.0)))
    unseen = solver.solve((None, None), _axis(0.0, 0.0), 0.0)
    assert hiding.judge(unseen).status is FixStatus.NOT_YET_VISIBLE
    for depth, status in ((0.06, FixStatus.OUT_OF_VIEW), (0.025, FixStatus.NOT_YET_VISIBLE)):
        axis = _axis(10.0, 30.0)
        band = FULCRUM + (depth - wide.needle.marker_offset) * axis
        pair = tuple(_sighting(wide, camera, band, axis) for camera in (0, 1))
        assert hiding.judge(solver.solve(pair, axis, 0.0)).usable
        assert hiding.judge(unseen).status is status
    open_rig = Hiding(wide.needle)
    assert open_rig.judge(unseen).status is FixStatus.OUT_OF_VIEW


def test_a_marker_that_is_never_seen_is_asked_for_after_a_while_and_once(wide):
    told = []
    solver = FixSolver(wide, FULCRUM)
    hiding = Hiding(_profile(wide, hidden_mm=(-60.0, 12.0)), lambda *said: told.append(said))
    for time in np.arange(0.0, 40.0, 0.5):
        fix = hiding.judge(solver.solve((None, None), _axis(0.0, 0.0), float(time)))
        hidden = fix.status is FixStatus.NOT_YET_VISIBLE
        assert hidden == (time <= NEVER)
        assert hidden or "push the needle in" in fix.reason
    assert [kind for kind, _ in told] == ["tracker"]
    assert "not seen yet" in told[0][1]
    hiding.clear()
    unseen = solver.solve((None, None), _axis(0.0, 0.0), 100.0)
    assert hiding.judge(unseen).status is FixStatus.NOT_YET_VISIBLE


def test_a_hidden_range_in_the_wrong_order_is_refused(wide):
    with pytest.raises(ValueError, match="smaller depth first"):
        _profile(wide, hidden_mm=(10.0, -10.0))
