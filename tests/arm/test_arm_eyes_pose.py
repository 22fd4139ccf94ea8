"""The tool in the robot's frame: derivatives, covariance, outlines, and what cannot be solved."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from app.arm.eyes import pose as pose_module
from app.arm.eyes.blob import find_tool
from app.arm.eyes.pictures import ToolScene, tool_outline
from app.arm.eyes.pose import (
    AxisSight,
    TipEnd,
    ToolOutline,
    ToolStatus,
    axis_sight,
    solve_tool,
)
from app.arm.eyes.watching import ToolEyes
from app.arm.laparoscopy import ToolBody
from app.core.arrays import angle_between, unit
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from tests.arm.tool_rig import LYING, OUTLINE, TOOL, TROCAR, models, pictures

ROD = ToolBody(handle_diameter=0.010)
SCENES = [
    ToolScene(*LYING),
    ToolScene([0.0, -0.1, 0.009], [-0.6, -0.8, 0.0]),
    ToolScene.through(TROCAR.p_world, [0.2, 0.1, -1.0], 0.08),
]


def eyes_of(tool=TOOL, outline=True):
    return ToolEyes(models=models(), outline=tool_outline(tool) if outline else None)


def sights(shift=(0.0,) * 6):
    """What both cameras see of a line, changed by `shift`."""
    p_world, axis = np.array([0.08, 0.02, 0.03]), unit([0.7, 0.4, -0.3])
    found = []
    for k, model in enumerate(models()):
        ends = model.T_camera_world @ (p_world + np.outer([-0.05, 0.05], axis))
        (x0, y0), (x1, y1) = ends[:, :2] / ends[:, 2:]
        middle = model.T_camera_world @ p_world
        seen = np.array([*(middle[:2] / middle[2]), np.arctan((y1 - y0) / (x1 - x0))])
        seen += shift[3 * k : 3 * k + 3]
        spread = np.diag([1e-8, 1e-8, 1e-7])
        found.append(AxisSight(model.T_world_camera, seen[:2], float(seen[2]), spread))
    return p_world, axis, tuple(found)


def test_the_line_is_where_both_planes_meet():
    p_world, axis, seen = sights()
    line = pose_module._intersection(*seen)
    assert abs(line.axis @ axis) == pytest.approx(1.0, abs=1e-14)
    np.testing.assert_allclose(line.places, [p_world, p_world], atol=1e-14)


def test_the_derivatives_of_the_line_are_those_of_finite_differences():
    line = pose_module._intersection(*sights()[2])
    h = 1e-6
    for k in range(6):
        more, less = (
            pose_module._intersection(*sights(sign * h * np.eye(6)[k])[2]) for sign in (1.0, -1.0)
        )
        np.testing.assert_allclose((more.axis - less.axis) / (2 * h), line.axis_by[:, k], atol=1e-7)
        change = (more.places - less.places) / (2 * h)
        np.testing.assert_allclose(change, line.places_by[:, :, k], atol=1e-7)


@pytest.mark.long("machine")
def test_the_covariance_is_that_of_sights_drawn_anew():
    line = pose_module._intersection(*sights()[2])
    rng = np.random.default_rng(3)
    drawn = rng.multivariate_normal(np.zeros(6), line.spread, 4000)
    found = np.array(
        [
            np.concatenate([one.places[0], one.axis])
            for one in (pose_module._intersection(*sights(shift)[2]) for shift in drawn)
        ]
    )
    by = np.vstack([line.places_by[0], line.axis_by])
    said, measured = by @ line.spread @ by.T, np.cov(found.T)
    scale = np.sqrt(np.outer(np.diag(said), np.diag(said)))
    np.testing.assert_allclose(measured / scale, said / scale, atol=0.08)


@pytest.mark.long("machine")
@pytest.mark.parametrize("scene", SCENES)
def test_the_tool_is_found_to_a_millimetre_and_a_fifth_of_a_degree_with_its_tip(scene):
    found = eyes_of().tool(pictures(scene))
    assert found.status is ToolStatus.FOUND
    true = scene.p_tip - (OUTLINE.length - OUTLINE.centre(scene.hidden)) * scene.axis_world
    assert np.linalg.norm(found.p_world - true) < 1.2e-3
    assert angle_between(found.tip_axis_world, scene.axis_world) < np.deg2rad(0.2)
    off = np.concatenate([found.p_world - true, found.tip_axis_world - scene.axis_world])
    sign = 1.0 if found.tip is TipEnd.AHEAD else -1.0
    off[3:] *= sign
    assert off @ np.linalg.pinv(found.covariance, rcond=1e-9) @ off < 20.5  # 99.9 % of five


@pytest.mark.long("machine")
def test_a_plain_rod_has_a_line_and_no_telling_which_end_is_the_tip():
    scene = ToolScene(*LYING)
    found = eyes_of(ROD).tool(pictures(scene, tool=ROD))
    assert found.status is ToolStatus.FOUND
    assert found.tip is TipEnd.UNKNOWN
    assert found.tip_axis_world is None
    sine = np.linalg.norm(np.cross(found.axis_world, scene.axis_world))
    assert sine < np.sin(np.deg2rad(0.3))


def test_without_its_outline_the_centre_is_said_to_be_less_certain():
    seen = pictures(SCENES[1])
    known, unknown = eyes_of().tool(seen), eyes_of(outline=False).tool(seen)
    assert np.trace(unknown.covariance[:3, :3]) > 1.5 * np.trace(known.covariance[:3, :3])
    np.testing.assert_allclose(unknown.axis_world, known.axis_world, atol=1e-12)


def test_the_line_of_a_cut_tool_counts_and_its_centre_is_uncertain_along_it():
    scene = ToolScene([-0.03, 0.33, 0.2], [0.25, -1.0, -0.1])
    found = eyes_of().tool(pictures(scene))
    assert found.status is ToolStatus.FOUND
    assert not found.whole
    assert np.linalg.norm(np.cross(found.axis_world, scene.axis_world)) < np.deg2rad(2.0)


def test_one_camera_sees_the_axis_by_itself():
    image = pictures(SCENES[0])[0]
    both = eyes_of().tool(pictures(SCENES[0]))
    alone = axis_sight(models()[0], find_tool(image))
    assert alone.angle == both.sights[0].angle
    np.testing.assert_array_equal(alone.centre, both.sights[0].centre)


def test_the_calibration_adds_its_own_share():
    gain = SimpleNamespace(joint=lambda points, seen: 1e-6 * np.eye(6))
    blobs = tuple(find_tool(image) for image in pictures(SCENES[0]))
    plain = solve_tool(models(), blobs, OUTLINE)
    wider = solve_tool(models(), blobs, OUTLINE, uncertainty=gain)
    added = wider.covariance - plain.covariance
    np.testing.assert_allclose(added[:3, :3], 0.5e-6 * np.eye(3), atol=1e-12)
    axis = plain.axis_world
    across = np.eye(3) - np.outer(axis, axis)
    np.testing.assert_allclose(added[3:, 3:], 2e-6 / plain.length**2 * across, atol=1e-12)


def test_a_tool_seen_end_on_by_one_camera_is_round():
    eye = models()[0].centre
    place = np.array([0.1, 0.0, 0.1])
    found = eyes_of().tool(pictures(ToolScene(place, unit(place - eye))))
    assert found.status is ToolStatus.ROUND


def test_a_tool_in_the_plane_of_both_cameras_is_degenerate():
    left, right = (model.centre for model in models())
    place = np.array([0.05, 0.0, 0.05])
    along = unit(right - left)
    found = eyes_of().tool(pictures(ToolScene(place + 0.1 * along, along)))
    assert found.status is ToolStatus.DEGENERATE
    assert not found.p_world.any()


def test_pictures_of_different_tools_are_inconsistent():
    axis = unit([0.3, 1.0, 0.0])
    first = find_tool(pictures(ToolScene([0.1, 0.08, 0.009], axis))[0])
    second = find_tool(pictures(ToolScene([0.1, 0.08, 0.009] + 0.05 * axis, axis))[1])
    assert solve_tool(models(), (first, second)).status is ToolStatus.INCONSISTENT


def test_the_pose_turns_with_the_robots_frame():
    T = RigidTransform(rotation_exp([0.3, -0.2, 0.5]), np.array([0.4, -1.0, 0.2]))
    moved = tuple(replace(model, T_world_camera=T @ model.T_world_camera) for model in models())
    blobs = tuple(find_tool(image) for image in pictures(SCENES[0]))
    here, there = (solve_tool(m, blobs, OUTLINE) for m in (models(), moved))
    np.testing.assert_allclose(there.p_world, T @ here.p_world, atol=1e-12)
    np.testing.assert_allclose(there.axis_world, T.rotate(here.axis_world), atol=1e-12)
    turn = np.kron(np.eye(2), T.rotation)
    np.testing.assert_allclose(there.covariance, turn @ here.covariance @ turn.T, atol=1e-15)


def test_the_outline_of_a_rod_seen_from_above_its_middle_keeps_its_centre():
    rod = ToolOutline.rod(0.2, 0.005)
    assert rod.centre() == pytest.approx(0.1, abs=1e-9)
    assert rod.centre(view=(0.1, 0.5)) == pytest.approx(0.1, abs=1e-9)
    assert rod.centre(view=(1.0, 0.5)) < 0.1, "it reaches out further where it is seen more aslant"


def test_the_outline_of_a_cone_is_that_of_a_triangle():
    cone = ToolOutline(np.array([0.0, 0.3]), np.array([0.01, 0.0]))
    assert cone.centre() == pytest.approx(0.1, rel=1e-4)
    assert cone.centre(hidden=0.15) == pytest.approx(0.2 / 3.0, rel=1e-3)
