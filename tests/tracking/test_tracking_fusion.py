"""Cameras' tip and robot's line become one tip; why they disagree is told apart."""

import numpy as np
import pytest

from app.session.fusion import DIRECTION_SIGMA, fuse_tip, line_covariance
from app.tracking.discrepancy import DiscrepancyCause, DiscrepancyMonitor, Evidence
from app.tracking.fix import FixStatus
from app.tracking.health import FixHealth
from app.tracking.markers.extractor import Centre
from app.tracking.markers.silhouette import centroid_shift
from app.tracking.solver import FixSolver, SeenMarker, systematic_px

FULCRUM = np.array([0.0, 0.16056, 0.090])
LINE = (0.2e-3) ** 2


def _axis(tilt, azimuth):
    across = np.sin(tilt)
    return np.array([across * np.cos(azimuth), across * np.sin(azimuth), -np.cos(tilt)])


def _skew_covariance():
    """Poor in one oblique direction, as of two cameras at a small angle."""
    direction = np.array([0.6, 0.5, 0.62])
    direction /= np.linalg.norm(direction)
    return 1e-9 * np.eye(3) + 2.5e-7 * np.outer(direction, direction)


@pytest.mark.long("statistics")
def test_the_fused_depth_and_tip_err_as_they_say_and_less_than_the_foot_of_the_perpendicular():
    rng, axis, depth = np.random.default_rng(1), _axis(0.4, 2.0), 0.07
    covariance = _skew_covariance()
    root, across = np.linalg.cholesky(covariance), np.eye(3) - np.outer(axis, axis)
    sd = np.sqrt(LINE + (depth * DIRECTION_SIGMA) ** 2)
    tips, depths, feet = [], [], []
    for _ in range(4000):
        truth = FULCRUM + depth * axis + sd * across @ rng.standard_normal(3)
        seen = truth + root @ rng.standard_normal(3)
        fused = fuse_tip(seen, covariance, FULCRUM, axis, LINE)
        assert fused.snapped
        tips.append(fused.p_tip - truth)
        depths.append(fused.depth - depth)
        feet.append((seen - FULCRUM) @ axis - depth)
    sample = np.array(tips).T @ np.array(tips) / len(tips)
    assert np.linalg.norm(sample - fused.covariance) < 0.08 * np.linalg.norm(fused.covariance)
    assert np.var(depths) == pytest.approx(fused.depth_variance, rel=0.08)
    assert np.var(depths) < 0.8 * np.var(feet)


def test_a_tip_on_the_line_stays_and_one_far_off_it_is_not_snapped():
    axis = _axis(0.2, 1.0)
    tip = FULCRUM + 0.05 * axis
    fused = fuse_tip(tip, 1e-9 * np.eye(3), FULCRUM, axis, LINE)
    np.testing.assert_allclose(fused.p_tip, tip, atol=1e-15)
    side = np.linalg.svd(axis[None])[2][1]
    for distance, snapped in ((0.8e-3, True), (1.2e-3, False)):
        fused = fuse_tip(tip + distance * side, 1e-9 * np.eye(3), FULCRUM, axis, LINE)
        assert fused.snapped is snapped
        assert np.linalg.norm(fused.beside) == pytest.approx(distance)
        assert fused.depth == pytest.approx(0.05, abs=1e-9)
        if not snapped:
            np.testing.assert_array_equal(fused.p_tip, tip + distance * side)


def test_a_tip_that_was_found_with_the_line_stays_as_it_was_found():
    axis = _axis(0.3, 0.5)
    covariance, side = _skew_covariance(), np.linalg.svd(axis[None])[2][1]
    tip = FULCRUM + 0.04 * axis + 1e-4 * side
    fused = fuse_tip(tip, covariance, FULCRUM, axis, None)
    np.testing.assert_array_equal(fused.p_tip, tip)
    np.testing.assert_array_equal(fused.covariance, covariance)
    assert fused.depth == pytest.approx(0.04)
    assert fused.depth_variance == pytest.approx(axis @ covariance @ axis)


@pytest.mark.parametrize("lost", [0, 1])
def test_with_one_camera_lost_the_ellipsoid_holds_the_fused_tip_as_often_as_it_says(wide, lost):
    rng, solver = np.random.default_rng(2), FixSolver(wide, FULCRUM)
    picture = np.hypot(0.05, systematic_px(wide))
    inside = []
    for _ in range(600):
        axis, depth = _axis(rng.uniform(0.0, 0.4), rng.uniform(0.0, 6.28)), rng.uniform(0.04, 0.08)
        across = np.eye(3) - np.outer(axis, axis)
        line = wide.line_sd_mm * 1e-3
        band = FULCRUM + depth * axis + across @ rng.normal(0.0, line, 3)
        pair = [
            SeenMarker(
                m.pixel(band) + rng.normal(0.0, picture, 2), 0.05**2 * np.eye(2), Centre.BAND
            )
            for m in wide.models
        ]
        pair[lost] = None
        fix = solver.solve(tuple(pair), axis, 0.0)
        fused = fuse_tip(fix.p_tip_world, fix.covariance, FULCRUM, axis, fix.line_variance)
        error = fused.p_tip - band - wide.needle.marker_offset * axis
        inside.append(error @ np.linalg.solve(fused.covariance, error) < 7.815)
    assert 0.92 < np.mean(inside) < 0.98


def test_the_line_knows_nothing_of_the_depth_and_less_of_the_place_the_deeper_it_is():
    axis = _axis(0.3, 0.5)
    near, far = (line_covariance(axis, depth, LINE) for depth in (0.0, 0.1))
    assert abs(axis @ near @ axis) < 1e-20
    assert np.trace(far) > np.trace(near)


# --- causes ---------------------------------------------------------------------------------------
def _story(cause, rng, n=200):
    """Evidence of one cause while the needle is moved through its depth and tilted."""
    monitor = DiscrepancyMonitor()
    for k in range(n):
        depth = 0.01 + 0.08 * (0.5 - 0.5 * np.cos(2.0 * np.pi * k / n))
        axis = _axis(0.25, 2.0 * np.pi * k / n)
        across = np.eye(3) - np.outer(axis, axis)
        force = across @ np.array([1.5 * np.cos(0.2 * k), 1.5 * np.sin(0.2 * k), 0.0])
        beside = across @ rng.normal(0.0, 0.1e-3, 3)
        epipolar = rng.normal()
        if cause == "bent by a force":
            beside += 0.2 * depth**2 * force
        elif cause == "bent for good":
            beside += across @ np.array([0.35, 0.1, 0.0]) * depth**2
            force = np.zeros(3)
        elif cause == "camera turned sideways":
            beside += across @ np.array([1.5e-3, -0.8e-3, 0.3e-3])
        elif cause == "camera turned upwards":
            epipolar += 6.0
        monitor.add(Evidence(depth, beside, 0.2e-3, epipolar, force))
    return monitor


@pytest.mark.parametrize(
    ("story", "cause"),
    [
        ("nothing", DiscrepancyCause.NONE),
        ("bent by a force", DiscrepancyCause.BENT_NEEDLE),
        ("bent for good", DiscrepancyCause.BENT_NEEDLE),
        ("camera turned sideways", DiscrepancyCause.BUMPED_CAMERA),
        ("camera turned upwards", DiscrepancyCause.BUMPED_CAMERA),
    ],
)
@pytest.mark.parametrize("seed", range(8))
def test_each_cause_leaves_its_own_trace(story, cause, seed):
    found = _story(story, np.random.default_rng(seed)).verdict()
    assert found.cause is cause
    assert bool(found.words) == (cause is not DiscrepancyCause.NONE)


def test_a_slipped_marker_is_told_by_touches_of_known_places_alone():
    monitor = _story("nothing", np.random.default_rng(0))
    monitor.touch(0.0512, 0.0500)
    assert monitor.verdict().cause is DiscrepancyCause.NONE
    monitor.touch(0.0311, 0.0300)
    found = monitor.verdict()
    assert found.cause is DiscrepancyCause.SLIPPED_MARKER
    assert found.size == pytest.approx(1.15e-3)
    assert "towards the tip" in found.words
    for _ in range(10):
        monitor.touch(0.0301, 0.0300)
    assert monitor.verdict().cause is DiscrepancyCause.NONE


def test_little_or_broken_evidence_gives_no_verdict():
    monitor = DiscrepancyMonitor()
    assert monitor.verdict().cause is DiscrepancyCause.NONE
    for _ in range(40):
        monitor.add(Evidence(0.05, np.full(3, 2e-3), 0.2e-3, 0.0, np.zeros(3)))
        monitor.add(Evidence(0.05, np.full(3, np.nan), 0.2e-3, 0.0, np.zeros(3)))
        monitor.add(Evidence(np.inf, np.zeros(3), 0.2e-3, 0.0, np.zeros(3)))
    assert monitor.verdict().cause is DiscrepancyCause.NONE
    monitor.touch(np.nan, 0.0)
    for _ in range(10):
        monitor.add(Evidence(0.05, np.full(3, 2e-3), 0.2e-3, 0.0, np.zeros(3)))
    assert monitor.verdict().cause is DiscrepancyCause.UNCLEAR  # at one depth no cause can be told
    monitor.clear()
    assert monitor.verdict().cause is DiscrepancyCause.NONE


def _fix(rig, solver, band, axis, nudge=0.0):
    pair = tuple(
        SeenMarker(
            m.pixel(band) + centroid_shift(m, rig.needle.shape, band, axis) + [0.0, i * nudge],
            2.5e-3 * np.eye(2),
        )
        for i, m in enumerate(rig.models)
    )
    return solver.solve(pair, axis, 0.0)


def test_a_needle_known_to_bend_is_measured_where_the_line_alone_would_refuse_it(wide):
    solver, told = FixSolver(wide, FULCRUM), []
    axis = _axis(0.1, 0.3)
    side = np.linalg.svd(axis[None])[2][1]
    health = FixHealth(0.01, lambda t: 1.0 * side, lambda kind, text: told.append((kind, text)))
    statuses = []
    for k in range(120):
        depth = 0.02 + 0.07 * (k % 40) / 40
        band = FULCRUM + depth * axis + 0.4 * depth**2 * side
        fix = health.judge(_fix(wide, solver, band, axis), axis)
        statuses.append(fix.status)
    assert FixStatus.INCONSISTENT in statuses
    assert FixStatus.INCONSISTENT not in statuses[60:]
    tip = FULCRUM + (depth + 0.01) * axis + 0.4 * (depth + 0.01) ** 2 * side
    assert np.linalg.norm(fix.p_tip_world - tip) < fix.radius()  # it bends beyond the band, too
    assert fix.discrepancy.cause is DiscrepancyCause.BENT_NEEDLE
    assert told[0][0] == "tracker"
    assert "bends" in told[0][1]
    assert len(told) == 1


def test_two_touches_tell_the_tracker_of_a_slipped_marker(wide):
    health = FixHealth(0.01, lambda t: None, lambda kind, text: None)
    solver, axis = FixSolver(wide, FULCRUM), _axis(0.2, 0.1)
    for known in (0.04, 0.05):
        health.monitor.touch(known + 0.002, known)
    for k in range(15):
        fix = health.judge(_fix(wide, solver, FULCRUM + (0.02 + 0.001 * k) * axis, axis), axis)
    assert fix.discrepancy.cause is DiscrepancyCause.SLIPPED_MARKER


def test_a_camera_that_is_bumped_while_it_runs_is_named(wide):
    solver, told = FixSolver(wide, FULCRUM), []
    health = FixHealth(0.01, lambda t: None, lambda kind, text: told.append(text))
    for k in range(60):
        axis = _axis(0.2, 0.1 * k)
        band = FULCRUM + (0.02 + 0.001 * k) * axis
        fix = health.judge(_fix(wide, solver, band, axis, nudge=1.5), axis)
    assert fix.discrepancy.cause is DiscrepancyCause.BUMPED_CAMERA
    assert "daily check" in told[0]
