"""The eyes where there is no answer, or nearly none: a name, never NaN, never a wild point."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.arm.eyes.blob import ToolBlob, ToolMiss, ToolMissReason, find_tool
from app.arm.eyes.fulcrum import (
    LARGEST_SD,
    FulcrumStatus,
    ShaftLine,
    meet_lines,
    meet_planes,
)
from app.arm.eyes.pictures import ToolScene
from app.arm.eyes.pose import AxisSight, ToolPose, ToolStatus, solve_tool
from app.arm.eyes.trocar import TrocarStatus, solve_trocar
from app.arm.eyes.watching import ToolEyes
from app.arm.hard_cases.tool import ellipse, whole
from app.core.arrays import unit
from app.tracking.simulated.obstacles import Highlight, highlight
from tests.arm.tool_rig import LYING, OUTLINE, TROCAR, models, pictures, renderers

FEW = settings(derandomize=True, deadline=None, max_examples=25)
MANY = settings(derandomize=True, deadline=None, max_examples=200)
EYES = ToolEyes(models=models(), outline=OUTLINE)
TOWARDS = st.tuples(*[st.floats(-1.0, 1.0)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1)


@pytest.mark.long("machine")
@MANY
@given(st.floats(1.0, 1.3), st.floats(-1.57, 1.57))
def test_a_blob_has_an_axis_that_is_right_or_none(ratio, angle):
    found = whole(ellipse(ratio, angle), 0.1)
    if found.angle is None:
        assert ratio < 1.02
        assert not found.spread[2].any()
    else:
        off = (found.angle - angle + np.pi / 2) % np.pi - np.pi / 2
        assert abs(off) < max(0.03, 6.0 * np.sqrt(found.spread[2, 2]))
    assert np.isfinite(found.spread).all()


@pytest.mark.long("machine")
@MANY
@given(st.lists(st.tuples(st.integers(-500, 500), st.integers(-500, 500)), min_size=1, max_size=12))
def test_any_pixels_have_finite_moments(pixels):
    found = whole(np.array(pixels, dtype=np.float64), 0.1)
    assert np.isfinite(found.centre).all()
    assert np.isfinite(found.covariance).all()
    assert np.isfinite(found.spread).all()
    assert found.angle is None or -np.pi / 2 < found.angle <= np.pi / 2


@pytest.mark.long("statistics")
@FEW
@given(
    st.tuples(st.floats(-0.3, 0.35), st.floats(-0.3, 0.4), st.floats(0.0, 0.3)),
    TOWARDS,
)
def test_wherever_the_tool_is_the_answer_is_near_it_or_has_a_name(place, towards):
    scene = ToolScene(np.array(place), towards)
    found = EYES.tool(pictures(scene))
    if isinstance(found, ToolMiss):
        return
    assert np.isfinite(found.covariance).all()
    if found.status is not ToolStatus.FOUND:
        assert not found.p_world.any()
        return
    sine = np.linalg.norm(np.cross(found.axis_world, scene.axis_world))
    said = np.sqrt(np.linalg.eigvalsh(found.covariance[3:, 3:])[-1])
    assert sine < max(np.deg2rad(1.5), 8.0 * said)
    if found.whole:
        true = scene.p_tip - (OUTLINE.length - OUTLINE.centre()) * scene.axis_world
        sd = np.sqrt(np.linalg.eigvalsh(found.covariance[:3, :3])[-1])
        assert np.linalg.norm(found.p_world - true) < max(5e-3, 8.0 * sd)


@pytest.mark.long("machine")
@FEW
@given(st.floats(0.03, 0.17), st.floats(1.0, 6.0), st.floats(100.0, 900.0), st.integers(0, 1))
def test_a_lamp_reflected_on_the_tool_moves_it_little_or_has_a_name(behind, sd_px, strength, which):
    scene = ToolScene(*LYING)
    plain = renderers()[which].render(scene)
    place = models()[which].project(scene.p_tip - behind * scene.axis_world)[0][0]
    lit = highlight(plain.copy(), Highlight(place, sd_px, strength), np.random.default_rng(0))
    before, after = find_tool(plain), find_tool(lit)
    assert isinstance(after, ToolBlob)
    assert np.linalg.norm(after.moments.centre - before.moments.centre) < 2.0
    assert abs(after.moments.angle - before.moments.angle) < np.deg2rad(1.0)


@pytest.mark.long("machine")
@FEW
@given(st.floats(-0.25, 0.25), st.floats(0.0, 3.1))
def test_two_tools_are_never_taken_for_one(aside, turn):
    first = ToolScene([0.1, 0.05, 0.009], [0.9, 0.3, 0.0])
    second = ToolScene([0.0, aside, 0.03], [np.cos(turn), np.sin(turn), 0.0])
    apart = abs(np.sin(turn - np.arctan2(0.3, 0.9))) > 0.4
    found = find_tool(pictures(replace(first, others=(second,)))[0])
    if isinstance(found, ToolMiss):
        assert found.reason in (ToolMissReason.TWO_TOOLS, ToolMissReason.NOT_STRAIGHT)
    else:
        assert not apart, "only what lies in one line, or hides the other, may pass for one"


@pytest.mark.long("machine")
@MANY
@given(st.floats(0.0, 0.3), st.integers(2, 9), st.floats(0.0, 1e-3), st.integers(0, 1000))
def test_lines_give_a_point_that_is_as_near_as_it_says_or_none(lean, count, turn_sd, seed):
    rng = np.random.default_rng(seed)
    fulcrum, lines, sights = np.array([0.15, 0.0, 0.0]), [], []
    for k in range(count):
        axis = unit([lean * np.cos(2.4 * k), lean * np.sin(2.4 * k), -1.0])
        d = unit(axis + rng.normal(0.0, turn_sd, 3))
        spread = np.zeros((6, 6))
        spread[3:, 3:] = turn_sd**2 * (np.eye(3) - np.outer(d, d))
        lines.append(ShaftLine(fulcrum - 0.1 * axis, d, spread))
        for model in models():
            ends = model.T_camera_world @ (fulcrum - np.outer([0.12, 0.08], axis))
            (x0, y0), (x1, y1) = ends[:, :2] / ends[:, 2:]
            angle = float(np.arctan2(y1 - y0, x1 - x0)) + rng.normal(0.0, turn_sd)
            middle = np.array([x0 + x1, y0 + y1]) / 2.0
            spread3 = np.diag([1e-12, 1e-12, turn_sd**2])
            sights.append(AxisSight(model.T_world_camera, middle, angle, spread3))
    for found in (meet_lines(lines), meet_planes(sights)):
        assert np.isfinite(found.p_world).all()
        if found.status is FulcrumStatus.FOUND:
            sd = np.sqrt(np.linalg.eigvalsh(found.covariance)[-1])
            assert sd <= LARGEST_SD
            assert np.linalg.norm(found.p_world - fulcrum) < 8.0 * sd + 1e-4
        else:
            assert not found.p_world.any()
            assert not found.covariance.any()


@pytest.mark.long("machine")
@MANY
@given(st.lists(st.tuples(*[st.floats(-10.0, 10.0)] * 3), min_size=0, max_size=6), TOWARDS)
def test_parallel_lines_are_degenerate_wherever_they_lie(places, towards):
    axis = unit(towards)
    lines = [ShaftLine(np.array(p), axis, np.zeros((6, 6))) for p in places]
    found = meet_lines(lines)
    assert found.status is FulcrumStatus.DEGENERATE
    assert not found.p_world.any()


@pytest.mark.long("statistics")
@MANY
@given(st.floats(0.0, 89.9), st.floats(0.0, 6.28), st.integers(0, 1000))
def test_a_ring_at_any_angle_is_right_or_has_a_name(tilt_deg, turn, seed):
    centre, tilt = TROCAR.p_world, np.deg2rad(tilt_deg)
    normal = np.array([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)])
    first = unit(np.cross(normal, [0.3, 0.5, 0.1]))
    angles = np.linspace(0.0, 2.0 * np.pi, 50, endpoint=False)[:, None]
    ring = centre + 0.016 * (np.cos(angles) * first + np.sin(angles) * np.cross(normal, first))
    rng = np.random.default_rng(seed)
    seen = tuple(m.project(ring)[0] + rng.uniform(-0.4, 0.4, (50, 2)) for m in models())
    found = solve_trocar(models(), seen, 0.016)
    if found.status is TrocarStatus.FOUND:
        sd = np.sqrt(np.linalg.eigvalsh(found.covariance)[-1])
        assert np.linalg.norm(found.p_world - centre) < max(8.0 * sd, 1e-3)
    else:
        assert found.status in (TrocarStatus.GRAZING, TrocarStatus.NOT_A_RING)
        assert not found.p_world.any()


@pytest.mark.parametrize("value", [0, 255])
def test_an_empty_picture_is_no_tool(value):
    assert find_tool(np.full((120, 160, 3), value, np.uint8)) == ToolMiss(ToolMissReason.NOTHING)


def test_a_picture_full_of_the_colour_is_cut_or_no_tool():
    image = np.empty((120, 160, 3), np.uint8)
    image[:] = (70, 190, 60)
    found = find_tool(image)
    assert isinstance(found, ToolMiss) or found.cut


def test_the_same_picture_twice_is_named():
    seen = pictures(ToolScene(*LYING))[0]
    same = (models()[0], models()[0])
    blob = find_tool(seen)
    found = solve_tool(same, (blob, blob))
    assert isinstance(found, ToolPose)
    assert found.status is ToolStatus.DEGENERATE
