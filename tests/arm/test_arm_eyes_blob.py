"""The tool in one picture: its pixels, their moments, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest

from app.arm.eyes.blob import ToolBlob, ToolMiss, ToolMissReason, find_tool, moments
from app.arm.eyes.pictures import TOOL_GREEN, ToolScene
from app.arm.hard_cases.tool import ellipse, whole
from app.tracking.simulated.obstacles import ORANGE, Patch, patch
from tests.arm.tool_rig import LYING, OUTLINE, models, pictures, renderers

SCENE = ToolScene(*LYING)


def test_centre_and_covariance_are_those_of_the_pixels_with_one_less_than_their_number():
    points = np.random.default_rng(1).normal(size=(50, 2)) @ [[3.0, 1.0], [0.0, 1.0]] + [
        200.0,
        90.0,
    ]
    found = whole(points)
    np.testing.assert_allclose(found.centre, points.mean(axis=0), rtol=1e-14)
    np.testing.assert_allclose(found.covariance, np.cov(points.T), rtol=1e-12)
    assert found.area == 50.0


@pytest.mark.parametrize("degrees", [-89.0, -45.0, -1.0, 0.0, 30.0, 60.0, 90.0])
def test_the_axis_is_the_eigenvector_of_the_larger_eigenvalue_in_half_a_turn(degrees):
    found = whole(ellipse(3.0, np.deg2rad(degrees)))
    assert -np.pi / 2 < found.angle <= np.pi / 2
    assert found.angle == pytest.approx(np.deg2rad(degrees), abs=2e-3)
    vector = np.linalg.eigh(found.covariance)[1][:, 1]
    assert abs(vector @ found.axis) == pytest.approx(1.0, abs=1e-12)


def test_a_vertical_axis_is_plus_ninety_degrees():
    assert whole(np.array([[2.0, 0.0], [2.0, 1.0], [2.0, 5.0]])).angle == np.pi / 2


@pytest.mark.long("machine")
def test_the_spread_of_centre_and_angle_is_that_of_outlines_drawn_anew():
    # Every piece of a bar's outline moves by itself: shares at its rim are drawn anew.
    rng, sd = np.random.default_rng(2), 0.2
    y, x = np.mgrid[0:12, 0:90].astype(np.float64)
    turn = np.deg2rad(20.0)
    points = np.column_stack([x.ravel(), y.ravel()]) @ [
        [np.cos(turn), np.sin(turn)],
        [-np.sin(turn), np.cos(turn)],
    ]
    rim = ((x == 0) | (x == 89) | (y == 0) | (y == 11)).ravel()
    ones = np.ones(len(points))
    said = moments(points, ones, ones, rim, sd)
    found = []
    for _ in range(4000):
        shares = 1.0 + np.where(rim, rng.normal(0.0, sd, len(points)), 0.0)
        one = moments(points, shares, ones, rim, sd)
        found.append([*one.centre, one.angle])
    measured = np.cov(np.array(found).T)
    scale = np.sqrt(np.outer(np.diag(said.spread), np.diag(said.spread)))
    np.testing.assert_allclose(measured / scale, said.spread / scale, atol=0.08)


@pytest.mark.long("machine")
def test_a_tool_is_found_with_hull_centre_and_axis():
    for model, image in zip(models(), pictures(SCENE), strict=True):
        found = find_tool(image)
        assert isinstance(found, ToolBlob)
        tip, end = model.project(SCENE.p_tip - np.outer([0.0, 0.2], SCENE.axis_world))[0]
        slope = np.arctan((end - tip)[1] / (end - tip)[0])
        assert found.moments.angle == pytest.approx(slope, abs=0.01)
        assert not found.cut
        low, high = found.hull.min(axis=0), found.hull.max(axis=0)
        assert (found.moments.centre > low).all()
        assert (found.moments.centre < high).all()
        assert np.abs(found.hull - tip).sum(axis=1).min() < 4.0


@pytest.mark.long("machine")
def test_shares_are_what_the_tool_covers_of_each_pixel_even_in_the_shade():
    renderer = renderers()[0]
    plain, (noisy, _) = renderer.render(SCENE), pictures(SCENE)
    with_less_light = np.asarray(0.5 * plain, np.uint8)
    areas = [find_tool(image).moments.area for image in (plain, noisy, with_less_light)]
    np.testing.assert_allclose(areas, areas[0], rtol=0.01)


def test_two_tools_are_refused_by_name():
    other = ToolScene([0.1, -0.12, 0.009], [0.9, 0.3, 0.0])
    found = find_tool(pictures(replace(SCENE, others=(other,)))[0])
    assert found == ToolMiss(ToolMissReason.TWO_TOOLS)


def test_two_tools_that_cross_are_refused_by_name():
    across = ToolScene([0.0, 0.12, 0.03], [-0.1, 1.0, 0.0])
    found = find_tool(pictures(replace(SCENE, others=(across,)))[0])
    assert found == ToolMiss(ToolMissReason.NOT_STRAIGHT)


def test_no_tool_is_refused_by_name():
    found = find_tool(pictures(replace(SCENE, visible=False))[0])
    assert found == ToolMiss(ToolMissReason.NOTHING)


def test_a_speck_of_the_colour_is_too_small():
    image = np.full((120, 160, 3), 120, np.uint8)
    image[50:56, 40:52] = TOOL_GREEN
    assert find_tool(image) == ToolMiss(ToolMissReason.TOO_SMALL)


def test_an_orange_thing_beside_it_is_no_second_tool():
    image = pictures(SCENE)[0]
    rng = np.random.default_rng(0)
    spoilt = patch(
        image.copy(), Patch(np.array([500.0, 400.0]), np.array([60.0, 12.0]), 20.0, ORANGE), rng
    )
    found, plain = find_tool(spoilt), find_tool(image)
    np.testing.assert_allclose(found.moments.centre, plain.moments.centre, atol=0.05)


def test_a_tool_that_the_edge_cuts_is_flagged():
    cut = ToolScene([-0.03, 0.33, 0.2], [0.25, -1.0, -0.1])
    found = find_tool(pictures(cut)[0])
    assert isinstance(found, ToolBlob)
    assert found.cut


def test_a_rod_seen_end_on_is_round_and_has_no_axis():
    eye = models()[0].centre
    view = (eye - [0.1, 0.0, 0.1]) / np.linalg.norm(eye - [0.1, 0.0, 0.1])
    found = find_tool(pictures(ToolScene([0.1, 0.0, 0.1], -view))[0])
    assert isinstance(found, ToolBlob)
    assert found.moments.angle is None
    assert found.moments.axis is None
    assert OUTLINE.length == pytest.approx(0.24)


@pytest.mark.parametrize("ratio", [1.0, 2.5, 8.0])
def test_the_elongation_is_length_over_width(ratio):
    rng = np.random.default_rng(2)
    turn = np.array([[0.8, -0.6], [0.6, 0.8]])
    points = rng.uniform(-1.0, 1.0, (20_000, 2)) * [ratio, 1.0] @ turn.T
    count = len(points)
    found = moments(points, np.ones(count), np.ones(count), np.ones(count, np.bool_), 0.1)
    assert found.elongation == pytest.approx(ratio, rel=0.02)
