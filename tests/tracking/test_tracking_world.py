"""The world frame from a board at a known place."""

from dataclasses import replace

import numpy as np
import pytest
from calibration_samples import sample

from app.core.transform import RigidTransform
from app.tracking.calibration.applies import require_cameras
from app.tracking.calibration.board_pose import Pair, board_rays, fit_pose
from app.tracking.calibration.boards import Board, parse_board
from app.tracking.calibration.placed_board import PlacedBoard, place
from app.tracking.calibration.views import BoardView
from app.tracking.calibration.world import find_world, with_world
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import StereoCalibration
from app.tracking.optics.rig import RigProfile, load_rig
from app.tracking.stereo.calibration_uncertainty import CalibrationUncertainty

BOARD = parse_board("charuco:7x5:15mm:11mm:DICT_5X5_100")
FULCRUM = np.array([[0.0, 0.16056, 0.09]])


@pytest.fixture(scope="module")
def rig() -> RigProfile:
    return load_rig("wide")


@pytest.fixture(scope="module")
def calibration(rig: RigProfile) -> StereoCalibration:
    return sample(rig).model_copy(update={"world": None})


def laid(rz: float = 0.0, dx: float = 0.0, tilt: float = 60.0) -> RigidTransform:
    """Put a board near the needle, its print tilted up towards the cameras (they look along -y)."""
    return place(-38.0 + dx, 175.0, 20.0, 180.0 - tilt, 0.0, rz)


def seen(
    rig: RigProfile,
    T_world_board: RigidTransform,
    noise: float = 0.0,
    seed: int = 0,
    board: Board = BOARD,
    scale: float = 1.0,
) -> Pair:
    rng = np.random.default_rng(seed)
    views = []
    for model in rig.models:
        uv, ok = model.project(T_world_board @ (scale * board.points))
        ids = np.flatnonzero(ok & model.sees(T_world_board @ (scale * board.points)))
        assert ids.size > 8, "the test's board is out of the picture"
        pixels = uv[ids] + noise * rng.normal(size=(ids.size, 2))
        name = f"{model.name}{seed}.png"
        views.append(BoardView(board, ids, pixels, model.image_size, name=name))
    return views[0], views[1]


def test_a_board_without_noise_gives_the_cameras_places_exactly(
    rig: RigProfile, calibration: StereoCalibration
) -> None:
    T_world_board = laid()
    world = find_world(
        calibration, [PlacedBoard(T_world_board, (seen(rig, T_world_board),))], watched=FULCRUM
    )
    for centre, model in zip(world.centres, rig.models, strict=True):
        np.testing.assert_allclose(centre, model.centre, atol=1e-8)
    assert world.scale == pytest.approx(1.0, abs=1e-8)
    assert world.rms_px < 1e-6
    # 0.3 mm, and 0.15° about the board's origin some 80 mm away.
    assert world.watched_sd_mm == pytest.approx(0.35, abs=0.06)
    assert world.remarks == ()


def test_one_camera_alone_is_enough_and_says_nothing_of_the_scale(
    rig: RigProfile, calibration: StereoCalibration
) -> None:
    T_world_board = laid()
    left, right = seen(rig, T_world_board)
    for pair in ((left, None), (None, right)):
        world = find_world(calibration, [PlacedBoard(T_world_board, (pair,))])
        np.testing.assert_allclose(world.centres[0], rig.models[0].centre, atol=1e-6)
        assert world.scale is None


def test_the_jacobian_is_that_of_finite_differences(
    rig: RigProfile, calibration: StereoCalibration
) -> None:
    from app.tracking.calibration.board_pose import _system

    T_world_board = laid()
    found = board_rays(calibration, [seen(rig, T_world_board, 0.5)])
    pose = rig.models[0].T_camera_world @ T_world_board
    T_right_left = calibration.pose.transform
    system = _system(found, T_right_left, pose, 1.0)
    assert system is not None
    for k in range(7):
        step = np.zeros(7)
        step[k] = 1e-6
        ends = [
            _system(found, T_right_left, RigidTransform.exp(s * step[:6]) @ pose, 1.0 + s * step[6])
            for s in (1.0, -1.0)
        ]
        assert ends[0] is not None
        assert ends[1] is not None
        slope = -(ends[0][0] - ends[1][0]) / 2e-6  # the residual is observed minus predicted
        np.testing.assert_allclose(system[1][:, k], slope, rtol=1e-5, atol=1e-3)


@pytest.mark.long("statistics")
def test_the_covariance_says_how_far_the_estimates_scatter(
    rig: RigProfile, calibration: StereoCalibration
) -> None:
    T_world_board = laid()
    truth = rig.models[0].T_world_camera
    twists, spreads = [], []
    for seed in range(60):
        board = PlacedBoard(T_world_board, (seen(rig, T_world_board, 0.3, seed),))
        world = find_world(calibration, [board], place_sd_mm=1e-4, place_sd_deg=1e-5)
        twists.append((world.pose.transform @ truth.inverse()).log())
        spreads.append(world.pose.pose_covariance)
    squared = [t @ np.linalg.solve(c, t) for t, c in zip(twists, spreads, strict=True)]
    assert np.mean(squared) == pytest.approx(6.0, rel=0.25)  # chi-squared with 6 degrees of freedom


@pytest.mark.long("statistics")
def test_what_the_board_was_laid_off_by_is_in_the_covariance(
    rig: RigProfile, calibration: StereoCalibration
) -> None:
    rng = np.random.default_rng(3)
    truth = rig.models[0].T_world_camera
    said = laid()
    squared = []
    for seed in range(60):
        turn = RigidTransform.exp([0, 0, 0, *(np.radians(0.4) * rng.normal(size=3))])
        at_board = RigidTransform.from_translation(said.translation)
        really = (
            RigidTransform.from_translation(1e-3 * rng.normal(size=3))
            @ at_board @ turn @ at_board.inverse() @ said
        )  # fmt: skip
        board = PlacedBoard(said, (seen(rig, really, 0.02, seed),))
        world = find_world(calibration, [board], place_sd_mm=1.0, place_sd_deg=0.4)
        twist = (world.pose.transform @ truth.inverse()).log()
        squared.append(twist @ np.linalg.solve(world.pose.pose_covariance, twist))
    assert np.mean(squared) == pytest.approx(6.0, rel=0.25)


def test_several_places_are_better_than_one(
    rig: RigProfile, calibration: StereoCalibration
) -> None:
    boards = [
        PlacedBoard(place_, (seen(rig, place_, 0.2, seed), seen(rig, place_, 0.2, seed + 10)))
        for seed, place_ in enumerate((laid(), laid(rz=8.0), laid(dx=10.0)))
    ]
    one, all_ = find_world(calibration, boards[:1]), find_world(calibration, boards)
    np.testing.assert_allclose(all_.centres[1], rig.models[1].centre, atol=2e-3)
    assert np.trace(all_.pose.pose_covariance) < 0.5 * np.trace(one.pose.pose_covariance)
    assert all_.disagreement_mm < 3.0
    assert len(all_.by_picture) == 12


def test_a_board_of_another_size_than_said_is_refused(
    rig: RigProfile, calibration: StereoCalibration
) -> None:
    T_world_board = laid()
    board = PlacedBoard(T_world_board, (seen(rig, T_world_board, 0.1, scale=1.025),))
    with pytest.raises(CalibrationError, match=r"measures 1\.02.*measure a square"):
        find_world(calibration, [board])


def test_a_board_that_moved_between_the_pictures_is_refused_and_the_picture_named(
    rig: RigProfile, calibration: StereoCalibration
) -> None:
    T_world_board = laid()
    moved = seen(rig, laid(dx=3.0), 0.1, 9)
    still = [seen(rig, T_world_board, 0.1, seed) for seed in range(3)]
    with pytest.raises(CalibrationError, match=r"worst in (left|right)9\.png"):
        find_world(calibration, [PlacedBoard(T_world_board, (*still, moved))])


def test_a_board_said_to_lie_face_down_is_refused(
    rig: RigProfile, calibration: StereoCalibration
) -> None:
    pair = seen(rig, laid())
    with pytest.raises(CalibrationError, match="faces down"):
        find_world(calibration, [PlacedBoard(place(0, 0, 0, 0.0), (pair,))])


def test_exchanged_pictures_are_refused(rig: RigProfile, calibration: StereoCalibration) -> None:
    T_world_board = laid()
    left, right = seen(rig, T_world_board)
    with pytest.raises(CalibrationError):
        find_world(calibration, [PlacedBoard(T_world_board, ((right, left),))])


def test_a_board_that_can_lie_two_ways_round_needs_a_rough_place_of_the_cameras(
    rig: RigProfile, calibration: StereoCalibration
) -> None:
    board = parse_board("checkerboard:7x5:10mm")
    T_world_board = laid()
    left, right = seen(rig, T_world_board, 0.1, board=board)
    assert left is not None
    placed = PlacedBoard(T_world_board, ((left.reordered(board.orders[1]), right),))
    with pytest.raises(CalibrationError, match="half a turn"):
        find_world(calibration, [placed])
    nominal = RigidTransform.exp([0.02, 0.02, 0.0, 0, 0, 0.1]) @ rig.models[0].T_world_camera
    world = find_world(calibration, [placed], expected=nominal)
    np.testing.assert_allclose(world.centres[0], rig.models[0].centre, atol=2e-3)


def test_a_place_that_cannot_be_is_remarked_on(
    rig: RigProfile, calibration: StereoCalibration
) -> None:
    pair = seen(rig, laid())
    wrong = RigidTransform.from_translation([0.0, 0.0, -0.5]) @ laid()
    world = find_world(calibration, [PlacedBoard(wrong, (pair,))], watched=FULCRUM)
    assert sum("below the robot's plane" in remark for remark in world.remarks) == 2
    assert sum("does not see" in remark for remark in world.remarks) == 2


def test_a_picture_of_another_size_is_refused_by_name(
    rig: RigProfile, calibration: StereoCalibration
) -> None:
    left, right = seen(rig, laid())
    assert left is not None
    other = replace(left, image_size=(1280, 720))
    with pytest.raises(CalibrationError, match=r"left0\.png has 1280x720.*left was.*640x480"):
        find_world(calibration, [PlacedBoard(laid(), ((other, right),))])
    with pytest.raises(CalibrationError, match="one picture"):
        find_world(calibration, [])
    with pytest.raises(CalibrationError, match="no picture shows"):
        fit_pose(calibration, board_rays(calibration, [(None, None)]))


def test_other_swapped_and_resized_cameras_are_refused_by_name(
    calibration: StereoCalibration,
) -> None:
    size = (640, 480)
    require_cameras(calibration, ("left", "right"), (size, size))
    with pytest.raises(CalibrationError, match=r"swapped.*exchange"):
        require_cameras(calibration, ("right", "left"), (size, size))
    with pytest.raises(CalibrationError, match="of the cameras left, right; in use are a, b"):
        require_cameras(calibration, ("a", "b"), (size, size))
    with pytest.raises(CalibrationError, match="camera right has 320x240"):
        require_cameras(calibration, ("left", "right"), (size, (320, 240)))


def test_the_calibration_with_a_world_is_a_new_one(
    rig: RigProfile, calibration: StereoCalibration
) -> None:
    T_world_board = laid()
    world = find_world(calibration, [PlacedBoard(T_world_board, (seen(rig, T_world_board),))])
    placed = with_world(calibration, world, BOARD.spec)
    assert placed.id != calibration.id
    assert calibration.id in placed.notes[-1]
    points = np.array([[0.0, 0.16, 0.03]])
    for ours, theirs in zip(rig.calibrated(placed).models, rig.models, strict=True):
        np.testing.assert_allclose(ours.project(points)[0], theirs.project(points)[0], atol=1e-4)


def test_the_frame_moves_with_the_cameras_as_finite_differences_say(
    rig: RigProfile, calibration: StereoCalibration
) -> None:
    boards = [
        PlacedBoard(T, (seen(rig, T, 0.1, seed),)) for seed, T in enumerate((laid(), laid(rz=8.0)))
    ]
    told = find_world(calibration, boards).by_cameras
    right = calibration.cameras[1]
    for column, changed in (
        (9, {"focal_px": (right.focal_px[0] + 0.5, right.focal_px[1])}),
        (12, {"centre_px": (right.centre_px[0], right.centre_px[1] + 0.5)}),
        (13, {"distortion": (right.distortion[0] + 0.5, *right.distortion[1:])}),
    ):
        cameras = (calibration.cameras[0], right.model_copy(update=changed))
        before = find_world(calibration, boards).pose.transform
        after = find_world(calibration.model_copy(update={"cameras": cameras}), boards)
        twist = (after.pose.transform @ before.inverse()).log() / 0.5
        np.testing.assert_allclose(twist, told[:, column], rtol=0.1, atol=2e-6)
    for axis in range(6):
        step = np.zeros(6)
        step[axis] = 1e-4
        pose = RigidTransform.exp(step) @ calibration.pose.transform
        moved = calibration.model_copy(update={"pose": type(calibration.pose).of(pose)})
        after = find_world(moved, boards).pose.transform
        twist = (after @ find_world(calibration, boards).pose.transform.inverse()).log() / 1e-4
        np.testing.assert_allclose(twist, told[:, 18 + axis], rtol=0.05, atol=2e-3)


def test_frame_and_cameras_together_say_less_than_taken_as_independent(
    rig: RigProfile, calibration: StereoCalibration
) -> None:
    T_world_board = laid()
    world = find_world(
        calibration,
        [PlacedBoard(T_world_board, (seen(rig, T_world_board),))],
        place_sd_mm=0.01,
        place_sd_deg=0.01,
    )
    placed = with_world(calibration, world, "board")
    middle = T_world_board @ BOARD.points.mean(axis=0)
    spreads = np.array([1e-9 * np.eye(2)] * 2)
    known = CalibrationUncertainty(placed).covariance(middle, spreads)
    apart = placed.model_copy(update={"world_by_cameras": None})
    independent = CalibrationUncertainty(apart).covariance(middle, spreads)
    assert np.trace(known) < 0.25 * np.trace(independent)
