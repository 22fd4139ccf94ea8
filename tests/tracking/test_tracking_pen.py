"""The pen: what is printed, corners, poses, the needle and its error."""

import dataclasses

import numpy as np
import pytest

from app.core.configuration import parse
from app.core.errors import ConfigurationError
from app.core.transform import RigidTransform
from app.tracking.confidence import chi_square_quantile
from app.tracking.fix import FixStatus
from app.tracking.optics.camera_model import CameraModel
from app.tracking.pen.body import BodyProfile, PenProfile, load_pen, shipped_pens
from app.tracking.pen.detector import MarkerDetector
from app.tracking.pen.errors import PenError
from app.tracking.pen.locator import BoardLocator
from app.tracking.pen.needle import PenTip, solve_needle
from app.tracking.pen.pose import PoseStatus, parameter_jacobians, projection_jacobians
from app.tracking.pen.step import PenStep
from app.tracking.pen.webcam import guessed_webcam
from tests.tracking.pen_rig import (
    BASE,
    BODY,
    DOWN,
    ENTRY,
    PEN,
    TIP,
    camera,
    picture,
    renderer,
    scene,
    sighting,
    step,
    webcam,
)

MODEL = camera()
SCENE, AXIS = scene()
BODY_POSE = MODEL.T_camera_world @ SCENE.T_world_body
BASE_POSE = MODEL.T_camera_world @ PEN.base.pose(ENTRY)


@pytest.fixture(scope="module")
def draw():
    return renderer(MODEL)


@pytest.mark.parametrize("name", shipped_pens())
def test_every_marker_looks_out_of_its_face_and_reads_clockwise_from_outside(name):
    body = load_pen(name).body.board()
    for marker in body.markers:
        right, down = marker.corners[1] - marker.corners[0], marker.corners[3] - marker.corners[0]
        np.testing.assert_allclose(np.cross(down, right) / marker.side**2, marker.normal, atol=1e-9)
        assert marker.corners.mean(axis=0) @ marker.normal > 0.0, "outside of the middle"


def test_neighbouring_sides_of_the_cube_share_an_edge_of_the_net():
    edge, side = PEN.body.edge_mm * 1e-3, PEN.body.marker_mm * 1e-3
    first, second = BODY.markers[:2]
    right = (first.corners[1] - first.corners[0]) / side
    np.testing.assert_allclose(second.normal, right, atol=1e-12)
    middle = first.corners.mean(axis=0) + 0.5 * edge * (first.normal * 0.0 + right)
    left = (second.corners[0] - second.corners[1]) / side
    np.testing.assert_allclose(middle, second.corners.mean(axis=0) + 0.5 * edge * left, atol=1e-12)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"marker_mm": 39.0}, "white"),
        ({"sides": 6}, "top needs 4"),
        ({"edge_mm": -1.0}, "edge_mm"),
    ],
)
def test_a_cube_that_cannot_be_read_is_refused_with_the_reason(change, words):
    with pytest.raises(ConfigurationError, match=words):
        parse(PEN.body.model_dump() | change, BodyProfile, "test")


def test_cube_and_sheet_with_the_same_ids_are_refused():
    base = PEN.base.model_copy(update={"first_id": 2})
    with pytest.raises(ConfigurationError, match="first_id"):
        parse(PEN.model_dump() | {"base": base.model_dump()}, PenProfile, "test")


def test_an_unknown_pen_is_named_with_those_that_there_are():
    with pytest.raises(PenError, match="cube, ring"):
        load_pen("wand")


@pytest.mark.long("statistics")
def test_corners_are_found_to_a_few_hundredths_of_a_pixel_with_an_honest_covariance(draw):
    detector, wanted = MarkerDetector(PEN.body.dictionary), set(range(50))
    errors, chi = [], []
    for seed in range(12):
        found = detector.find(picture(draw, SCENE, seed).image, wanted)
        for s in found.markers:
            marker, pose = BODY.find(s.id), BODY_POSE
            if marker is None:
                marker, pose = BASE.find(s.id), BASE_POSE
            error = (s.corners - MODEL.project_camera(pose @ marker.corners)[0]).ravel()
            errors.append(error)
            chi.append(error @ np.linalg.solve(s.covariance + 0.05**2 * np.eye(8), error))
    assert np.sqrt(np.mean(np.square(errors))) < 0.06
    assert np.mean(chi) / 8.0 < 1.2


def test_the_jacobians_of_the_projection_agree_with_differences():
    points = BODY_POSE @ BODY.markers[2].corners
    analytic, step_ = projection_jacobians(MODEL, points), 1e-6
    for axis in range(3):
        shift = step_ * np.eye(3)[axis]
        high, low = (MODEL.project_camera(points + s * shift)[0] for s in (1, -1))
        np.testing.assert_allclose(analytic[:, :, axis], (high - low) / (2 * step_), rtol=1e-5)
    values = np.concatenate([MODEL.intrinsics, MODEL.distortion])
    by_parameter = parameter_jacobians(MODEL, points)
    for k in range(9):
        h = np.zeros(9)
        h[k] = 1e-5 * max(1.0, abs(values[k]))
        high, low = (
            CameraModel("x", v[:4], v[4:], MODEL.image_size, MODEL.T_world_camera)
            for v in (values + h, values - h)
        )
        slope = (high.project_camera(points)[0] - low.project_camera(points)[0]) / (2 * h[k])
        np.testing.assert_allclose(by_parameter[:, :, k], slope, rtol=1e-5, atol=1e-6)


@pytest.mark.long("statistics")
@pytest.mark.parametrize(
    ("board", "pose", "ids", "build"),
    [
        (BODY, BODY_POSE, (2, 3, 4), 0.0),
        (BODY, BODY_POSE, (2, 3), 2e-4),
        (BASE, BASE_POSE, (20, 24, 33, 37), 1e-4),
    ],
)
def test_the_covariance_of_a_pose_holds_in_trials(board, pose, ids, build):
    rng = np.random.default_rng(3)
    locator = BoardLocator(dataclasses.replace(board, build_sd=build))
    distances = []
    for _ in range(60):
        seen = [sighting(MODEL, pose, m, rng, 0.1, build) for m in board.markers if m.id in ids]
        found = locator.locate(MODEL, seen)
        assert found.status is PoseStatus.FOUND
        error = (found.T_camera_board @ pose.inverse()).log()
        distances.append(error @ np.linalg.solve(found.covariance, error))
    inside = np.mean(np.array(distances) < chi_square_quantile(0.95, 6))
    assert 0.90 <= inside <= 0.99
    assert 0.85 < np.mean(distances) / 6.0 < 1.15


def test_the_sensitivity_to_the_lens_agrees_with_differences():
    rng = np.random.default_rng(0)
    seen = [sighting(MODEL, BODY_POSE, m, rng, 1e-9) for m in BODY.markers if m.id in (2, 3, 4)]
    seen = [dataclasses.replace(s, covariance=0.01 * np.eye(8)) for s in seen]
    locator = BoardLocator(BODY)
    here = locator.locate(MODEL, seen)
    values = np.concatenate([MODEL.intrinsics, MODEL.distortion])
    for k in range(9):
        h = np.zeros(9)
        h[k] = 0.2 if k < 4 else 5e-4
        moved = CameraModel("x", *np.split(values + h, [4]), MODEL.image_size, MODEL.T_world_camera)
        there = locator.locate(moved, seen)
        slope = (there.T_camera_board @ here.T_camera_board.inverse()).log() / h[k]
        np.testing.assert_allclose(here.sensitivity[:, k], slope, atol=0.01 * np.abs(slope).max())


@pytest.mark.long("statistics")
def test_the_needle_s_ellipsoid_holds_with_print_tip_and_lens_uncertain():
    rng = np.random.default_rng(5)
    lens = np.diag([3.0, 3.0, 2.0, 2.0, 0.01, 0.01, 5e-4, 5e-4, 0.0]) ** 2
    tip, truth = PenTip.of(PEN.tip), SCENE.T_world_body @ TIP
    tips, depths = [], []
    for _ in range(60):
        values = np.concatenate([MODEL.intrinsics, MODEL.distortion])
        values = values + np.sqrt(np.diag(lens)) * rng.normal(size=9)
        wrong = CameraModel("x", *np.split(values, [4]), MODEL.image_size, MODEL.T_world_camera)
        poses = [
            BoardLocator(board).locate(
                wrong,
                [sighting(MODEL, T, m, rng, 0.05, board.build_sd) for m in board.markers
                 if m.id in ids],
            )
            for board, T, ids in ((BODY, BODY_POSE, (2, 3, 4)), (BASE, BASE_POSE, range(20, 38, 2)))
        ]  # fmt: skip
        drawn = rng.multivariate_normal(np.zeros(6), tip.covariance)
        pen = PenTip(tip.p_tip + drawn[:3], tip.axis + drawn[3:], tip.covariance)
        needle = solve_needle(*poses, PEN.base.pose(ENTRY), pen, lens)
        error = needle.p_tip - truth
        tips.append(error @ np.linalg.solve(needle.tip_covariance, error))
        depth, variance = needle.depth(ENTRY)
        depths.append((depth - 0.05) ** 2 / variance)
    assert 0.90 <= np.mean(np.array(tips) < chi_square_quantile(0.95, 3)) <= 0.99
    assert 0.7 < np.mean(depths) < 1.3


def test_a_rendered_picture_gives_the_needle_within_its_radius(draw):
    seen = step(MODEL).observe(picture(draw, SCENE))
    assert seen.fix.status is FixStatus.VALID
    error = np.linalg.norm(seen.needle.p_tip - SCENE.p_tip)
    assert error < 2.0e-3, (
        "an exact print: 0.05 px of corner noise is about a millimetre at the tip"
    )
    assert error < seen.needle.tip_radius()
    np.testing.assert_allclose(seen.fix.depth, 0.05, atol=1.5e-3)
    assert "95 %" in seen.needle.words


def test_the_distance_beside_the_entry_is_measured(draw):
    missed, axis = scene(beside=(6e-3, 0.0, 0.0))
    seen = step(MODEL).observe(picture(draw, missed))
    across = 6e-3 * (np.array([1.0, 0.0, 0.0]) - axis[0] * axis)
    np.testing.assert_allclose(seen.beside, across, atol=1.5e-3)
    assert 0.0 < seen.beside_sd < 6e-3


def test_the_webcam_may_stand_elsewhere_in_the_next_picture(draw):
    moved = camera((-150, 520, 420), (0, 160, 130))
    known = step(MODEL)
    first = known.observe(picture(draw, SCENE)).needle
    second = known.observe(picture(renderer(moved), SCENE)).needle
    np.testing.assert_allclose(second.T_world_camera.translation, moved.centre, atol=3e-3)
    np.testing.assert_allclose(first.p_tip, second.p_tip, atol=3e-3)


def test_a_guessed_lens_is_said_and_widens_the_ellipsoid(draw):
    frame = picture(draw, SCENE)
    sharp = step(MODEL).observe(frame).needle
    guess = PenStep(PEN, None, ENTRY)
    seen = guess.observe(frame)
    assert seen.fix.status is FixStatus.VALID
    assert "GUESSED" in guess.webcam.words
    assert seen.needle.tip_radius() > sharp.tip_radius()
    assert np.linalg.norm(seen.needle.p_tip - SCENE.p_tip) < seen.needle.tip_radius()


def test_pictures_of_another_size_than_the_calibration_are_refused_with_both_sizes(draw):
    other = PenStep(PEN, guessed_webcam((1280, 720)), ENTRY)
    with pytest.raises(PenError, match=r"640x480.*1280x720"):
        other.observe(picture(draw, SCENE))


def test_the_tip_of_the_scene_is_the_tip_of_the_body():
    np.testing.assert_allclose(SCENE.T_world_body @ TIP, SCENE.p_tip, atol=1e-12)
    np.testing.assert_allclose(SCENE.T_world_body.rotate(DOWN), AXIS, atol=1e-12)
    assert isinstance(SCENE.T_world_body, RigidTransform)
    assert webcam(MODEL).guessed is False
