"""Hard cases of the pen: each ends with a bounded answer or a status that says why, never NaN."""

import dataclasses

import numpy as np
import pytest

from app.core.transform import RigidTransform
from app.tracking.cameras.camera import CameraFrame
from app.tracking.fix import FixStatus
from app.tracking.pen.board import MarkerBoard
from app.tracking.pen.detector import MarkerSighting
from app.tracking.pen.edges import measure_squares
from app.tracking.pen.locator import BoardLocator
from app.tracking.pen.pose import PoseStatus
from app.tracking.simulated.pen_scene import PenScene
from tests.tracking.pen_rig import (
    BASE,
    BODY,
    ENTRY,
    PEN,
    camera,
    picture,
    renderer,
    scene,
    sighting,
    step,
)

MODEL = camera()


@pytest.fixture(scope="module")
def draw():
    return renderer(MODEL)


def facing(distance, turn=(0.0, 0.0, 0.0)):
    """T_camera_body with the cube's first side straight towards the camera, then turned."""
    front = np.array([[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]])
    turned = RigidTransform.exp([0.0, 0.0, 0.0, *turn]).rotation @ front
    return RigidTransform(turned, np.array([0.0, 0.0, distance]))


def seen(pose, ids, sd=0.05, seed=0, board=BODY):
    rng = np.random.default_rng(seed)
    return [sighting(MODEL, pose, m, rng, sd) for m in board.markers if m.id in ids]


def test_a_single_face_straight_ahead_is_refused_or_right_but_never_a_guess():
    locator, names = BoardLocator(BODY, 0.05), set()
    for seed in range(40):
        rng = np.random.default_rng(seed)
        pose = facing(rng.uniform(0.4, 1.2), rng.normal(0.0, 0.08, 3))
        found = locator.locate(MODEL, seen(pose, (0,), 0.1, seed))
        names.add(found.status)
        if found.status is PoseStatus.FOUND:
            error = (found.T_camera_board @ pose.inverse()).log()
            assert error @ np.linalg.solve(found.covariance, error) < 60.0
        else:
            assert found.status is PoseStatus.AMBIGUOUS
            assert "two poses" in found.reason
    assert PoseStatus.AMBIGUOUS in names


def test_a_single_face_seen_from_the_side_and_near_is_decided():
    pose = facing(0.3, (0.0, 0.7, 0.0))
    found = BoardLocator(BODY, 0.02).locate(MODEL, seen(pose, (0,), 0.02))
    assert found.status is PoseStatus.FOUND
    assert np.linalg.norm((found.T_camera_board @ pose.inverse()).log()[3:]) < 0.05


def test_the_hole_settles_which_of_two_poses_it_is_where_the_shaft_goes_through_it(draw):
    what, _ = scene((0.0, 0.0), depth=-0.015)
    seen = step(MODEL).observe(picture(draw, what))
    assert [m.id for m in seen.sightings.markers if m.id < 5] == [3]
    assert seen.fix.status is FixStatus.VALID
    assert np.linalg.norm(seen.needle.p_tip - what.p_tip) < seen.needle.tip_radius()
    lifted, _ = scene((0.0, 0.0), depth=-0.015, beside=(0.03, 0.0, 0.0))
    beside = step(MODEL).observe(picture(draw, lifted))
    if beside.fix.status is FixStatus.VALID:  # by the picture alone
        np.testing.assert_allclose(np.linalg.norm(beside.beside), 0.03, atol=3e-3)
    else:
        assert "two poses" in beside.fix.reason


def test_a_second_face_settles_what_one_leaves_open():
    pose = facing(0.8, (0.0, 0.5, 0.0))
    both = [0, *(m.id for m in BODY.markers[1:4] if visible(pose, m))]
    found = BoardLocator(BODY, 0.05).locate(MODEL, seen(pose, both[:2], 0.1))
    assert found.status is PoseStatus.FOUND
    assert np.linalg.norm((found.T_camera_board @ pose.inverse()).log()[3:]) < 0.1


def visible(pose, marker):
    return pose.rotate(marker.normal) @ (pose @ marker.corners.mean(axis=0)) < 0.0


def test_a_cube_edge_on_is_found_and_its_covariance_holds():
    pose = facing(0.5, (0.0, np.pi / 4, 0.0))
    ids = [m.id for m in BODY.markers if visible(pose, m)]
    assert len(ids) >= 2
    found = BoardLocator(BODY, 0.05).locate(MODEL, seen(pose, ids))
    error = (found.T_camera_board @ pose.inverse()).log()
    assert error @ np.linalg.solve(found.covariance, error) < 30.0


def test_a_face_edge_on_in_the_picture_is_not_measured():
    sliver = np.array([[[100.0, 100.0], [104.0, 100.5], [104.0, 160.0], [100.0, 159.5]]])
    assert measure_squares(np.full((240, 320), 200, np.uint8), sliver) == [None]


@pytest.mark.parametrize("x", [-1.0, 0.0, 300.0])
def test_a_marker_at_the_border_is_not_measured(x):
    corners = np.array([[[x, 50.0], [x + 60, 50.0], [x + 60, 110.0], [x, 110.0]]])
    assert measure_squares(np.full((240, 320), 200, np.uint8), corners) == [None]


def test_a_cube_half_outside_the_picture_gives_a_status_or_a_right_needle(draw):
    for lean in (0.3, 0.6, 0.9):
        cut, _ = scene((0.0, -lean), depth=-0.05)
        seen = step(MODEL).observe(picture(draw, cut))
        if seen.fix.status is FixStatus.VALID:
            assert np.linalg.norm(seen.needle.p_tip - cut.p_tip) < seen.needle.tip_radius()
        else:
            assert seen.fix.reason


def test_one_id_twice_in_the_picture_is_named(draw):
    what, _ = scene()
    image = picture(draw, what).image.copy()
    image[20:120, 20:140] = image[75:175, 280:400]  # the cube once more
    seen = step(MODEL).observe(CameraFrame(image, 1.0))
    assert seen.fix.status is FixStatus.INCONSISTENT
    assert "twice" in seen.fix.reason


def test_a_mirrored_picture_is_named(draw):
    what, _ = scene()
    image = np.ascontiguousarray(picture(draw, what).image[:, ::-1])
    seen = step(MODEL).observe(CameraFrame(image, 1.0))
    assert seen.fix.status is FixStatus.INCONSISTENT
    assert "mirrored" in seen.fix.reason


def test_faces_of_two_cubes_are_inconsistent():
    here, there = facing(0.5, (0.0, 0.6, 0.0)), facing(0.7, (0.3, -0.4, 0.5))
    mixed = seen(here, (0,)) + seen(there, (1,)) if visible(there, BODY.markers[1]) else None
    if mixed is None:
        mixed = seen(here, (0,)) + seen(there, (3,))
    found = BoardLocator(BODY, 0.05).locate(MODEL, mixed)
    assert found.status is PoseStatus.INCONSISTENT


def test_a_cube_of_another_size_is_inconsistent_where_two_faces_show_it():
    pose = facing(0.4, (0.0, 0.7, 0.0))
    ids = [m.id for m in BODY.markers if visible(pose, m)]
    smaller = PEN.body.model_copy(update={"marker_mm": 24.0}).board()
    found = BoardLocator(BODY, 0.05).locate(MODEL, seen(pose, ids, board=smaller))
    assert found.status is PoseStatus.INCONSISTENT
    assert "another size" in found.reason


def test_no_sheet_in_view_is_named_and_gives_no_needle(draw):
    what, _ = scene()
    image = picture(draw, what).image.copy()
    image[205:] = 120
    seen = step(MODEL).observe(CameraFrame(image, 1.0))
    assert seen.fix.status is FixStatus.NO_ORIENTATION
    assert "sheet" in seen.fix.reason
    assert seen.needle is None


def test_no_cube_and_an_empty_picture_are_out_of_view(draw):
    tip = scene()[0].p_tip
    seen = step(MODEL).observe(picture(draw, PenScene(None, tip)))
    assert seen.fix.status is FixStatus.OUT_OF_VIEW
    for grey in (0, 128, 255):
        blank = CameraFrame(np.full((480, 640, 3), grey, np.uint8), 1.0)
        assert step(MODEL).observe(blank).fix.status is FixStatus.OUT_OF_VIEW


def test_noise_alone_gives_no_needle():
    rng = np.random.default_rng(0)
    known = step(MODEL)
    for _ in range(10):
        image = rng.integers(0, 256, (480, 640, 3), dtype=np.uint8)
        assert known.observe(CameraFrame(image, 1.0)).fix.status is FixStatus.OUT_OF_VIEW


def test_corners_that_are_no_numbers_are_left_out():
    pose = facing(0.4, (0.0, 0.7, 0.0))
    broken = MarkerSighting(0, np.full((4, 2), np.nan), np.eye(8))
    endless = MarkerSighting(1, np.zeros((4, 2)), np.full((8, 8), np.inf))
    locator = BoardLocator(BODY, 0.05)
    assert locator.locate(MODEL, [broken, endless]).status is PoseStatus.UNSEEN
    good = seen(pose, [m.id for m in BODY.markers if visible(pose, m)])
    found = locator.locate(MODEL, [broken, *good[1:], good[0]])
    assert found.status is PoseStatus.FOUND
    assert np.isfinite(found.covariance).all()


@pytest.mark.parametrize(
    "corners",
    [
        np.zeros((4, 2)),
        np.column_stack([np.linspace(100, 400, 4), np.linspace(100, 300, 4)]),
        np.array([[100.0, 100.0], [200.0, 200.0], [200.0, 100.0], [100.0, 200.0]]),
        np.array([[1e9, 0.0], [1e9, 1.0], [0.0, 1e9], [1.0, 1e9]]),
    ],
)
def test_corners_that_no_square_can_have_give_a_status(corners):
    found = BoardLocator(BODY, 0.05).locate(MODEL, [MarkerSighting(0, corners, 0.01 * np.eye(8))])
    assert found.status in (PoseStatus.INCONSISTENT, PoseStatus.AMBIGUOUS)
    assert np.isfinite(found.covariance).all()


def test_a_sheet_seen_almost_flat_is_refused_or_honest():
    for height in (20.0, 40.0, 80.0):
        low = camera((0, 760, 90 + height), (0, 160, 90))
        pose = low.T_camera_world @ PEN.base.pose(ENTRY)
        rng = np.random.default_rng(1)
        markers = [sighting(low, pose, m, rng, 0.2) for m in BASE.markers]
        found = BoardLocator(BASE, 0.05).locate(low, markers)
        if found.status is PoseStatus.FOUND:
            error = (found.T_camera_board @ pose.inverse()).log()
            assert error @ np.linalg.solve(found.covariance, error) < 30.0
        else:
            assert found.status is PoseStatus.AMBIGUOUS


def test_a_board_with_one_marker_has_the_same_rules():
    single = MarkerBoard("tag", BODY.dictionary, BODY.markers[:1])
    found = BoardLocator(dataclasses.replace(single), 0.05).locate(MODEL, seen(facing(0.6), (0,)))
    assert found.status is PoseStatus.AMBIGUOUS
