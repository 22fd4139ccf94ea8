"""The fulcrum from lines, from planes and from the trocar's ring."""

from types import SimpleNamespace

import numpy as np
import pytest

from app.arm.eyes.blob import ToolMiss
from app.arm.eyes.fulcrum import FulcrumStatus, ShaftLine, meet_lines, meet_planes
from app.arm.eyes.pictures import ToolRenderer, ToolScene
from app.arm.eyes.pose import AxisSight, ToolStatus
from app.arm.eyes.trocar import TrocarStatus, _Rays, _two_across, ring_outline, solve_trocar
from app.arm.eyes.watching import ToolEyes
from app.arm.laparoscopy import TrocarRing
from app.arm.studies.fulcrum import spiral
from app.core.arrays import unit
from tests.arm.tool_rig import OUTLINE, TOOL, TROCAR, models, pictures

FULCRUM = TROCAR.p_world
EYES = ToolEyes(models=models(), outline=OUTLINE)


def noisy_lines(rng, amplitude=0.35, count=10, sd=2e-4, turn=5e-4):
    lines = []
    for axis in spiral(amplitude, count, 0.3):
        d = unit(axis + rng.normal(0.0, turn, 3))
        across = np.eye(3) - np.outer(d, d)
        covariance = np.block(
            [[sd**2 * np.eye(3), np.zeros((3, 3))], [np.zeros((3, 3)), turn**2 * across]]
        )
        lines.append(ShaftLine(FULCRUM - 0.1 * axis + rng.normal(0.0, sd, 3), d, covariance))
    return lines


def noisy_sights(rng, amplitude=0.35, count=10, sd=5e-5, turn=5e-4):
    found = []
    for axis in spiral(amplitude, count, 0.3):
        for model in models():
            ends = model.T_camera_world @ (FULCRUM - np.outer([0.1, 0.05], axis))
            (x0, y0), (x1, y1) = ends[:, :2] / ends[:, 2:]
            angle = float(np.arctan2(y1 - y0, x1 - x0)) + rng.normal(0.0, turn)
            centre = np.array([x0, y0]) + rng.normal(0.0, sd, 2)
            spread = np.diag([sd**2, sd**2, turn**2])
            found.append(AxisSight(model.T_world_camera, centre, angle, spread))
    return found


WAYS = pytest.mark.parametrize(
    ("way", "drawn"), [(meet_lines, noisy_lines), (meet_planes, noisy_sights)]
)


@pytest.mark.long("machine")
@WAYS
def test_the_covariance_is_that_of_motions_drawn_anew(way, drawn):
    rng = np.random.default_rng(4)
    found = [way(drawn(rng)) for _ in range(500)]
    assert all(one.status is FulcrumStatus.FOUND for one in found)
    errors = np.array([one.p_world - FULCRUM for one in found])
    said = np.mean([one.covariance for one in found], axis=0)
    ratio = np.trace(np.cov(errors.T)) / np.trace(said)
    assert 0.6 < ratio < 1.15, "inflated where chance makes lines miss by more than they say"
    distances = [
        e @ np.linalg.solve(one.covariance, e) for e, one in zip(errors, found, strict=True)
    ]
    assert np.mean(np.array(distances) < 7.81) > 0.93


@WAYS
def test_lines_that_are_all_parallel_are_degenerate(way, drawn):
    found = way(drawn(np.random.default_rng(5), amplitude=0.0))
    assert found.status is FulcrumStatus.DEGENERATE
    assert not found.p_world.any()


@WAYS
def test_a_motion_within_the_noise_of_the_directions_is_degenerate(way, drawn):
    for seed in range(20):
        found = way(drawn(np.random.default_rng(seed), amplitude=2e-3))
        assert found.status is FulcrumStatus.DEGENERATE


@WAYS
def test_too_few_or_no_numbers_are_named(way, drawn):
    rng = np.random.default_rng(6)
    assert way([]).status is FulcrumStatus.DEGENERATE
    assert way(drawn(rng, count=1)).status is FulcrumStatus.DEGENERATE
    broken = drawn(rng)
    changed = {
        meet_lines: lambda one: ShaftLine(one.p_world * np.nan, one.axis_world, one.covariance),
        meet_planes: lambda one: AxisSight(one.T_world_camera, one.centre, np.nan, one.spread),
    }
    assert way([*broken[1:], changed[way](broken[0])]).status is FulcrumStatus.NOT_FINITE


def test_a_line_that_missed_is_left_out():
    lines = noisy_lines(np.random.default_rng(7))
    wrong = ShaftLine(lines[0].p_world + [0.03, 0.0, 0.0], lines[0].axis_world, lines[0].covariance)
    found = meet_lines([wrong, *lines[1:]])
    assert found.status is FulcrumStatus.FOUND
    assert found.left_out == 1
    assert np.linalg.norm(found.p_world - FULCRUM) < 5e-4


def test_lines_that_meet_nowhere_are_contradictory():
    rng = np.random.default_rng(8)
    lines = [
        ShaftLine(one.p_world + rng.normal(0.0, 0.03, 3), one.axis_world, one.covariance)
        for one in noisy_lines(rng)
    ]
    assert meet_lines(lines).status is FulcrumStatus.CONTRADICTORY


def test_one_camera_alone_finds_it_too():
    sights = noisy_sights(np.random.default_rng(9), count=20)[::2]
    found = meet_planes(sights)
    assert found.status is FulcrumStatus.DEGENERATE, "one camera gives a ray and no depth"


@pytest.mark.long("machine")
def test_the_fulcrum_is_found_in_pictures_to_half_a_millimetre_by_motion_and_by_the_trocar():
    poses = []
    for k, axis in enumerate(spiral(np.deg2rad(20.0), 6, 0.4)):
        seen = pictures(ToolScene.through(FULCRUM, axis, 0.08), seed=k)
        pose = EYES.tool(seen)
        assert pose.status is ToolStatus.FOUND
        poses.append(pose)
    moved, ring = EYES.fulcrum(poses), EYES.trocar(seen)
    assert moved.status is FulcrumStatus.FOUND
    assert ring.status is TrocarStatus.FOUND
    for found in (moved, ring):
        error = found.p_world - FULCRUM
        assert np.linalg.norm(error) < 0.5e-3
        assert error @ np.linalg.solve(found.covariance, error) < 16.3  # 99.9 %
    assert np.degrees(np.arccos(ring.normal_world @ TROCAR.normal_world)) < 4.0


# --- the ring -------------------------------------------------------------------------------------
def ring_points(centre, normal, radius=0.016, count=60):
    first, second = _two_across(unit(normal))
    turn = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)[:, None]
    ring = centre + radius * (np.cos(turn) * first + np.sin(turn) * second)
    return tuple(model.project(ring)[0] for model in models())


def test_exact_outlines_give_the_circle_to_the_last_digits():
    centre, normal = np.array([0.05, 0.02, 0.01]), unit([0.1, -0.3, 1.0])
    found = solve_trocar(models(), ring_points(centre, normal), 0.016)
    assert found.status is TrocarStatus.FOUND
    np.testing.assert_allclose(found.p_world, centre, atol=1e-9)
    np.testing.assert_allclose(found.normal_world, normal, atol=1e-6)
    assert found.radius == pytest.approx(0.016, abs=1e-9)


def test_the_derivatives_of_the_circles_distance_are_those_of_finite_differences():
    p, n, radius = np.array([0.05, 0.02, 0.01]), unit([0.1, -0.3, 1.0]), 0.015
    seen = [
        (model, model.undistort(uv)[0])
        for model, uv in zip(models(), ring_points(p + 0.001, unit(n + 0.05)), strict=True)
    ]
    rays, h = _Rays.of(seen), 1e-7
    by = rays._residual(p, n, radius)[1]
    sds = -1.0 / by[:, 5]
    for k in range(6):
        more, less = (rays._moved(p, n, radius, s * h * np.eye(6)[k]) for s in (1.0, -1.0))
        change = [(m * -1.0 / b[:, 5]) for m, b in (rays._residual(*more), rays._residual(*less))]
        slope = (change[0] - change[1]) / (2.0 * h) / sds
        np.testing.assert_allclose(slope, by[:, k], rtol=1e-4, atol=1e-3 * np.abs(by[:, k]).max())


@pytest.mark.long("machine")
def test_the_covariance_of_the_circle_is_that_of_outlines_drawn_anew():
    centre, rng = np.array([0.05, 0.02, 0.01]), np.random.default_rng(10)
    exact = ring_points(centre, [0.1, -0.3, 1.0])
    found = []
    for _ in range(300):
        noisy = tuple(uv + rng.normal(0.0, 0.3, uv.shape) for uv in exact)
        found.append(solve_trocar(models(), noisy, 0.016, systematic_px=1e-6))
    errors = np.array([one.p_world - centre for one in found])
    said = np.mean([one.covariance for one in found], axis=0)
    assert 0.7 < np.trace(np.cov(errors.T)) / np.trace(said) < 1.3


@pytest.mark.long("machine")
@pytest.mark.parametrize(
    ("trocar", "status"),
    [
        (None, TrocarStatus.NOTHING),
        (TrocarRing(FULCRUM, [0.0, 0.0, 1.0], 0.02, 0.04), TrocarStatus.NOT_A_RING),
    ],
)
def test_no_ring_and_one_of_another_size_are_named(trocar, status):
    scene = ToolScene(FULCRUM, [0.0, 0.0, -1.0], visible=False)
    images = tuple(ToolRenderer(model, TOOL, trocar).render(scene) for model in models())
    assert EYES.trocar(images).status is status


def test_a_ring_that_the_edge_cuts_is_named():
    image = np.full((200, 200, 3), 120, np.uint8)
    image[60:120, :40] = (205, 95, 30)
    assert ring_outline(image) is TrocarStatus.CUT


def test_the_calibration_adds_its_own_share_to_the_ring():
    share = SimpleNamespace(covariance=lambda p, seen: 1e-6 * np.eye(3))
    outlines = ring_points(np.array([0.05, 0.02, 0.01]), [0.1, -0.3, 1.0])
    plain = solve_trocar(models(), outlines, 0.016)
    wider = solve_trocar(models(), outlines, 0.016, uncertainty=share)
    np.testing.assert_allclose(wider.covariance - plain.covariance, 1e-6 * np.eye(3), atol=1e-15)


def test_pictures_without_a_tool_say_which_is_missing():
    empty = pictures(ToolScene(FULCRUM, [0.0, 0.0, -1.0], visible=False))
    assert isinstance(EYES.tool(empty), ToolMiss)
