"""Cameras from views whose truth is known: estimates, their covariance, what is dropped."""

from dataclasses import replace

import cv2
import numpy as np
import pytest

from app.core.transform import RigidTransform
from app.studies.coverage_trials.chain import board_poses
from app.studies.coverage_trials.scene import scene
from app.tracking.calibration.bundle import adjust, with_free
from app.tracking.calibration.mono import calibrate_mono
from app.tracking.calibration.poses import board_pose, first_estimate
from app.tracking.calibration.sightings import (
    AdjustedState,
    SeenBoard,
    project,
    project_with_derivatives,
)
from app.tracking.calibration.validation import triangulated
from app.tracking.calibration.views import BoardView
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import PARAMETERS
from app.tracking.optics.lens import LensModel
from app.tracking.simulated.opencv import opencv_pixels
from tests.tracking.calibration_rig import Rig, camera, thesis_rig, usual_rig

PLAIN = ("fx", "fy", "cx", "cy", "k1", "k2")
NOISE = 0.1


def truth(rig: Rig) -> np.ndarray:
    return np.concatenate([rig.left.intrinsics, rig.left.distortion])


def sightings(views: list[BoardView], side: int = 0) -> list[SeenBoard]:
    return [SeenBoard(i, side, view.points, view.pixels) for i, view in enumerate(views)]


def test_the_derivatives_are_those_of_the_projection_and_the_projection_the_cameras() -> None:
    rng = np.random.default_rng(0)
    points = rng.uniform(-0.1, 0.1, (6, 3)) + [0.0, 0.0, 0.5]
    p = np.array([500.0, 510.0, 320.0, 240.0, -0.3, 0.1, 1e-3, -2e-3, 0.05])
    uv, by_point, by_parameter = project_with_derivatives(points, p)
    model = camera("c", tuple(p[:4]), tuple(p[4:]), (640, 480))
    np.testing.assert_allclose(uv, model.project(points)[0], atol=1e-10)
    for i, step in enumerate(np.eye(3) * 1e-6):
        slope = (project(points + step, p) - project(points - step, p)) / 2e-6
        np.testing.assert_allclose(by_point[:, :, i], slope, rtol=1e-6, atol=1e-4)
    for i, step in enumerate(np.eye(9) * 1e-5):
        slope = (project(points, p + step) - project(points, p - step)) / 2e-5
        np.testing.assert_allclose(by_parameter[:, :, i], slope, rtol=1e-6, atol=1e-6)


def test_estimate_and_standard_deviations_are_opencvs() -> None:
    views, _ = usual_rig().pairs(8, 1, NOISE)
    start = first_estimate(views)
    ours = adjust(sightings(views), start, with_free(PARAMETERS))
    points = [view.points.astype(np.float32) for view in views]
    pixels = [view.pixels.astype(np.float32) for view in views]
    rms, matrix, _, _, _, sd, _, _ = cv2.calibrateCameraExtended(
        points, pixels, (640, 480), None, None
    )
    assert ours.rms_px == pytest.approx(rms, rel=1e-5)
    assert ours.state.parameters[0, 0] == pytest.approx(matrix[0, 0], abs=0.01)
    np.testing.assert_allclose(ours.sd(), sd.ravel()[:9], rtol=1e-3)


def test_an_adjustment_goes_on_where_parameters_make_up_for_each_other() -> None:
    """k4 does nearly what k1 to k3 do together: a damped step from their optimum hardly moves."""
    rig, longer = usual_rig(), LensModel.RATIONAL
    poses, lens = rig.poses(8, 2), np.array([-0.29, 0.11, 0.0, 0.0, 0.0])
    rng, K = np.random.default_rng(2), np.array([[534.0, 0, 325], [0, 534.0, 243], [0, 0, 1.0]])
    pixels = [opencv_pixels(rig.board.points, T, K, lens) for T in poses]
    seen = [
        SeenBoard(i, 0, rig.board.points, uv + rng.normal(0.0, NOISE, uv.shape))
        for i, uv in enumerate(pixels)
    ]
    near = AdjustedState(
        np.array([[534.0, 534.0, 325.0, 243.0, *lens]]), RigidTransform.identity(), tuple(poses)
    )
    five = adjust(seen, near, with_free(PARAMETERS)).state
    estimates = []
    for start, k4 in ((five, 0.0), (near, 0.6)):
        p = np.zeros((1, len(longer.parameters)))
        p[:, :9] = start.parameters
        p[:, 4] += k4
        p[:, longer.parameters.index("k4")] = k4
        free = with_free((*PARAMETERS, "k4"), 1, longer)
        found = adjust(seen, AdjustedState(p, start.T_right_left, start.poses), free)
        estimates.append(found.state.parameters[0, longer.parameters.index("k4")])
    assert estimates[0] == pytest.approx(estimates[1], abs=0.05)  # of -2.7


def test_the_covariance_of_one_camera_is_that_of_repeated_trials() -> None:
    rig, trials = usual_rig(), 80
    poses = rig.poses(7, 2)
    rng = np.random.default_rng(5)
    start = AdjustedState(truth(rig)[None], RigidTransform.identity(), tuple(poses))
    found, distances = [], []
    keep = [PARAMETERS.index(name) for name in PLAIN]
    for _ in range(trials):
        views = [rig.view(rig.left, T, NOISE, rng) for T in poses]
        result = adjust(sightings(views), start, with_free(PLAIN))
        error = (result.state.parameters[0] - truth(rig))[keep]
        covariance = result.covariance[np.ix_(keep, keep)]
        distances.append(error @ np.linalg.solve(covariance, error))
        found.append(error / np.sqrt(np.diag(covariance)))
    spread = np.sqrt(np.mean(np.square(found), axis=0))
    np.testing.assert_allclose(spread, 1.0, atol=0.25)  # 3 standard errors of 80 trials
    assert np.mean(distances) == pytest.approx(len(keep), rel=0.2)


@pytest.mark.long("statistics")
def test_the_covariance_of_two_cameras_pose_is_that_of_repeated_trials() -> None:
    rig, trials = usual_rig(), 60
    poses = rig.poses(6, 3)
    rng = np.random.default_rng(6)
    cameras = np.array(
        [np.concatenate([m.intrinsics, m.distortion]) for m in (rig.left, rig.right)]
    )
    start = AdjustedState(cameras, rig.T_right_left, tuple(poses))
    distances = []
    for _ in range(trials):
        seen = [
            SeenBoard(i, side, rig.board.points, rig.view(model, T, NOISE, rng).pixels)
            for i, T in enumerate(poses)
            for side, model in enumerate((rig.left, rig.right))
        ]
        result = adjust(seen, start, with_free(PLAIN, 2))
        twist = (result.state.T_right_left @ rig.T_right_left.inverse()).log()
        distances.append(twist @ np.linalg.solve(result.covariance[18:, 18:], twist))
    assert np.mean(distances) == pytest.approx(6.0, rel=0.22)


def test_what_narrow_views_cannot_tell_is_dropped_and_the_camera_stays_true() -> None:
    rig = thesis_rig()  # 33 by 25 degrees: k3 is uncertain by tens
    left, _ = rig.pairs(14, 4, 0.15)
    result = calibrate_mono(left, "left", 0)
    dropped = {one.name: one for one in result.dropped}
    assert set(dropped) == {"k3"}
    assert dropped["k3"].sd > 3.0
    assert result.calibration.estimated == PARAMETERS[:8]
    sd = result.adjusted.sd()
    error = result.adjusted.state.parameters[0] - truth(rig)
    assert (np.abs(error[:4]) < 4.0 * sd[:4]).all()
    assert any("k3" in note and "±" in note for note in result.notes)


@pytest.mark.long("statistics")
@pytest.mark.parametrize("tangential", [0.0, 4e-4])
def test_standard_deviations_hold_whatever_the_tangential_coefficients_are(tangential) -> None:
    """The corners are OpenCV's; nobody tells the calibration which coefficients the lens has."""
    rig, rng, squares = thesis_rig(), np.random.default_rng(11), []
    true = np.array([1070.0, 1070.0, 319.5, 239.5, -0.11, 0.14, tangential, -tangential, 0.0])
    matrix = np.array([[true[0], 0.0, true[2]], [0.0, true[1], true[3]], [0.0, 0.0, 1.0]])
    for trial in range(20):
        views = []
        for T in rig.poses(10, trial):
            turn, _ = cv2.Rodrigues(T.rotation)
            uv, _ = cv2.projectPoints(rig.board.points, turn, T.translation, matrix, true[4:])
            pixels = uv[:, 0] + rng.normal(0.0, NOISE, (rig.board.count, 2))
            views.append(BoardView(rig.board, np.arange(rig.board.count), pixels, (640, 480)))
        found = calibrate_mono(views, "left", 0)
        kept = [PARAMETERS.index(name) for name in found.calibration.estimated]
        error = (found.adjusted.state.parameters[0] - true)[kept]
        covariance = found.adjusted.covariance[np.ix_(kept, kept)]
        squares.append(error @ np.linalg.solve(covariance, error) / len(kept))
    assert np.mean(squares) == pytest.approx(1.0, abs=0.25)  # 3 standard errors of 160 squares


@pytest.mark.long("statistics")
def test_standard_deviations_hold_for_a_rational_lens_that_nobody_named() -> None:
    """What means the same in every model: focal lengths and centre, and rays where boards were."""
    true, rng = scene("usual", "rational"), np.random.default_rng(3)
    right, linear, rays, models = true.cameras[1], [], [], []
    for trial in range(20):
        poses = board_poses("usual", "rational", trial % 10)
        found = calibrate_mono([true.view(1, T, rng) for T in poses], "right", 0)
        p, covariance = found.adjusted.state.parameters[0], found.adjusted.covariance
        models.append(found.calibration.lens)
        error = p[:4] - right.matrix[[0, 1, 0, 1], [0, 1, 2, 2]]
        linear.append(error @ np.linalg.solve(covariance[:4, :4], error) / 4.0)
        for T in poses:
            p_world = T @ true.board.points[[rng.integers(true.board.count)]]
            uv, _, by = project_with_derivatives(right.T_camera_world @ p_world, p)
            error = uv[0] - right.pixels(p_world)[0]
            rays.append(error @ np.linalg.solve(by[0] @ covariance @ by[0].T, error) / 2.0)
    assert models.count(LensModel.RATIONAL) >= 18
    assert np.mean(linear) == pytest.approx(1.0, abs=0.47)  # 3 standard errors of 80 squares
    assert np.mean(rays) == pytest.approx(1.0, abs=0.47)  # rays of one camera err together


def test_a_wide_lens_is_calibrated_though_opencvs_start_loses_its_way() -> None:
    true, poses = scene("usual", "rational"), board_poses("usual", "rational", 0)
    rng = np.random.default_rng(0)
    views = [true.view(1, T, rng) for T in poses]
    points = [view.points.astype(np.float32) for view in views]
    pixels = [view.pixels.astype(np.float32) for view in views]
    assert cv2.calibrateCamera(points, pixels, (640, 480), None, None)[0] > 1.0
    found = calibrate_mono(views, "right", 0)
    assert found.calibration.rms_px == pytest.approx(NOISE * np.sqrt(2.0), rel=0.1)
    assert found.calibration.focal_px[0] == pytest.approx(true.cameras[1].matrix[0, 0], rel=0.01)


def test_coefficients_that_matter_are_kept() -> None:
    lens = (-0.35, 0.2, 0.004, -0.003, -0.08)
    wide = camera("left", (420.0, 421.0, 318.0, 242.0), lens, (640, 480))
    usual = usual_rig()
    rig = Rig(wide, usual.right, usual.board, 0.25)
    left, _ = rig.pairs(16, 8, 0.05, 40.0)
    result = calibrate_mono(left, "left", 0)
    assert {"k1", "k2", "p1", "p2"} <= set(result.calibration.estimated)
    sd = result.adjusted.sd()
    error = result.adjusted.state.parameters[0] - truth(rig)
    assert (np.abs(error[[0, 1, 2, 3, 6, 7]]) < 4.0 * sd[[0, 1, 2, 3, 6, 7]]).all()


def test_a_view_that_does_not_belong_is_named_and_left_out() -> None:
    left, _ = usual_rig().pairs(10, 3, NOISE)
    rng = np.random.default_rng(1)
    bad = left[4]
    left[4] = BoardView(
        bad.board,
        bad.ids,
        bad.pixels + rng.normal(0, 2.0, bad.pixels.shape),
        bad.image_size,
        name="shaken.png",
    )
    result = calibrate_mono(left, "left", 0)
    assert [r.name for r in result.residuals if r.role == "outlier"] == ["shaken.png"]
    assert any("shaken.png" in note for note in result.notes)
    assert result.calibration.rms_px == pytest.approx(NOISE * np.sqrt(2), rel=0.15)


def test_views_held_back_are_fitted_afterwards() -> None:
    left, _ = usual_rig().pairs(12, 9, NOISE)
    result = calibrate_mono(left, "left", 3)
    assert sum(r.role == "held_back" for r in result.residuals) == 3
    assert result.calibration.views == 9
    assert result.held_back_rms_px == pytest.approx(NOISE * np.sqrt(2), rel=0.3)


def test_too_few_views_and_views_of_different_sizes_are_refused() -> None:
    left, _ = usual_rig().pairs(4, 9, NOISE)
    with pytest.raises(CalibrationError, match="2 usable views"):
        calibrate_mono(left[:2], "left")
    other = BoardView(left[0].board, left[0].ids, left[0].pixels, (1280, 960))
    with pytest.raises(CalibrationError, match=r"1280x960 .1 of 5 are not 640x480"):
        calibrate_mono([other, *left], "left")


@pytest.mark.long("statistics")
def test_lenses_and_pose_err_together_as_the_joint_covariance_says() -> None:
    rig, trials = usual_rig(), 40
    poses = rig.poses(6, 3)
    rng = np.random.default_rng(7)
    p_left = np.array([[0.02, 0.01, 0.42]])
    pixels = [model.project(p_left)[0] for model in (rig.left, rig.right)]
    cameras = np.array(
        [np.concatenate([m.intrinsics, m.distortion]) for m in (rig.left, rig.right)]
    )
    start = AdjustedState(cameras, rig.T_right_left, tuple(poses))
    points, joint = [], np.zeros((24, 24))
    for _ in range(trials):
        seen = [
            SeenBoard(i, side, rig.board.points, rig.view(model, T, NOISE, rng).pixels)
            for i, T in enumerate(poses)
            for side, model in enumerate((rig.left, rig.right))
        ]
        result = adjust(seen, start, with_free(PLAIN, 2))
        points.append(_triangulated(rig, result.state, pixels))
        joint += result.covariance / trials
    gain = np.empty((3, 24))
    for i in range(24):
        step = np.zeros(24)
        step[i] = 1e-6
        there, back = (_triangulated(rig, _moved(start, s), pixels) for s in (step, -step))
        gain[:, i] = (there - back) / 2e-6
    blocks = np.zeros((24, 24))
    for block in (slice(0, 9), slice(9, 18), slice(18, 24)):
        blocks[block, block] = joint[block, block]
    found = float(np.sqrt(np.trace(np.cov(np.array(points).T))))
    together, apart = (float(np.sqrt(np.trace(gain @ s @ gain.T))) for s in (joint, blocks))
    assert found == pytest.approx(together, rel=0.3)
    assert apart > 2.0 * together  # what independent blocks would say


def _moved(state: AdjustedState, step: np.ndarray) -> AdjustedState:
    cameras = state.parameters + step[:18].reshape(2, 9)
    return AdjustedState(cameras, RigidTransform.exp(step[18:]) @ state.T_right_left, state.poses)


def _triangulated(rig: Rig, state: AdjustedState, pixels: list[np.ndarray]) -> np.ndarray:
    left, right = (
        camera("c", tuple(p[:4]), tuple(p[4:]), (640, 480), pose)
        for p, pose in zip(state.parameters, (None, state.T_right_left.inverse()), strict=True)
    )
    return triangulated(left, right, *pixels)[0]


@pytest.mark.long("statistics")
def test_no_pose_keeps_refined_corners_where_the_unrefined_ones_fit_better() -> None:
    rig, rng = usual_rig(), np.random.default_rng(16)
    poses = rig.poses(10, 4)
    views = []
    for i, T in enumerate(poses):
        good, bad = rig.view(rig.left, T, 0.1, rng), rig.view(rig.left, T, 0.6, rng)
        first, second = (bad, good) if i in (2, 7) else (good, bad)
        views.append(replace(first, unrefined=second.pixels, window=4, name=f"view {i}"))
    result = calibrate_mono(views, "left", hold_back=2)
    taken = [i for i, view in enumerate(result.chosen) if view is not views[i]]
    assert taken == [2, 7]
    assert any("unrefined" in note and "view 2, view 7" in note for note in result.notes)
    p = result.calibration.intrinsics, result.calibration.distortion
    for view in result.chosen:
        other = view.without_refinement()
        assert board_pose(view, np.concatenate(p))[1] <= board_pose(other, np.concatenate(p))[1]
    plain = calibrate_mono([replace(view, unrefined=None) for view in views], "left", hold_back=2)
    assert result.calibration.rms_px < 0.2
    assert plain.calibration.rms_px > 1.5 * result.calibration.rms_px or any(
        "left out" in note for note in plain.notes
    )
