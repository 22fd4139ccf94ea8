"""Which model of a lens a calibration takes, and what it says of its lens and its pictures."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from calibration_rig import beside, camera, usual_rig
from lens_views import FISHEYE, FIVE, RATIONAL, SIZE, lens_views, projected

from app.core.transform import RigidTransform
from app.tracking.calibration.boards import parse_board
from app.tracking.calibration.formats.own import load_calibration, save_calibration
from app.tracking.calibration.mono import calibrate_mono
from app.tracking.calibration.ray_error import ray_sds
from app.tracking.calibration.run import calibrate_stereo
from app.tracking.calibration.sightings import project_with_derivatives
from app.tracking.calibration.verdict import Grade, Why, judge
from app.tracking.calibration.views import BoardView
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.lens import LensModel
from app.tracking.stereo.calibration_uncertainty import CalibrationUncertainty


@pytest.mark.long("statistics")
@pytest.mark.parametrize(
    ("lens", "model", "distance"),
    [
        (FIVE, LensModel.BROWN, 0.3),
        (RATIONAL, LensModel.RATIONAL, 0.2),
        (FISHEYE, LensModel.FISHEYE, 0.15),
    ],
)
def test_the_views_choose_the_model_of_the_lens(lens, model, distance) -> None:
    found = calibrate_mono(lens_views(lens, 18, 3, distance=distance))
    assert found.calibration.lens is model
    assert found.calibration.rms_px < 0.15  # corners with 0.1 px of noise per axis
    assert len(found.views) == 15, "views at the edges of a wide lens' picture are no outliers"
    told = [note for note in found.notes if "wider than the five-coefficient model" in note]
    assert bool(told) == (model is not LensModel.BROWN)
    still = found.calibration.model(RigidTransform.identity())
    rays = np.random.default_rng(5).uniform(-0.6, 0.6, (400, 2))
    points = np.column_stack([rays, np.ones(400)])
    assert np.abs(still.project_camera(points)[0] - projected(lens, points)).max() < 1.0


@pytest.mark.long("statistics")
def test_the_deviation_of_rays_holds_for_a_rational_lens() -> None:
    """Mean squared error over the stated variance, pooled; the model is the true one."""
    rays = np.random.default_rng(6).uniform(-0.7, 0.7, (60, 2))
    points = np.column_stack([rays, np.ones(60)])
    truth = projected(RATIONAL, points)
    squares = []
    for seed in range(4):
        found = calibrate_mono(
            lens_views(RATIONAL, 14, 40 + seed, distance=0.2), hold_back=0, lens=LensModel.RATIONAL
        )
        p = found.adjusted.state.parameters[0]
        still = found.calibration.model(RigidTransform.identity())
        error = still.project_camera(points)[0] - truth
        by = project_with_derivatives(points, p)[2]
        spread = np.einsum("nij,jk,nik->ni", by, found.calibration.parameter_covariance, by)
        squares.append(np.mean(error**2 / spread))
    assert 0.5 < np.mean(squares) < 2.0


def _wide_pairs(count: int, noise: float = 0.02) -> tuple[list[BoardView], list[BoardView]]:
    board, rng = parse_board("checkerboard:9x6:20mm"), np.random.default_rng(4)
    T_left_right = beside(0.06, 10.0, 0.2)
    left = lens_views(FISHEYE, 4 * count, 21, board="checkerboard:9x6:20mm", distance=0.2)
    mono = calibrate_mono(left, hold_back=0)
    pairs: tuple[list[BoardView], list[BoardView]] = ([], [])
    for view, T in zip(mono.views, mono.adjusted.state.poses, strict=True):
        p_left = T @ board.points
        p_right = T_left_right.inverse() @ p_left
        if p_right[:, 2].min() < 0.03:
            continue
        both = [projected(FISHEYE, p) for p in (p_left, p_right)]
        both = [uv + noise * rng.standard_normal(uv.shape) for uv in both]
        if all((uv > 5).all() and (uv < np.array(SIZE) - 5).all() for uv in both):
            for side, uv in enumerate(both):
                pairs[side].append(BoardView(board, view.ids, uv, SIZE, name=f"{side} {view.name}"))
    return pairs[0][:count], pairs[1][:count]


@pytest.mark.long("statistics")
def test_two_fisheye_cameras_are_calibrated_and_tell_how_sure_they_are(tmp_path: Path) -> None:
    left, right = _wide_pairs(12)
    found = calibrate_stereo(left, right)
    assert [c.lens for c in found.cameras] == [LensModel.FISHEYE] * 2
    assert found.covariance.shape == (22, 22)  # twice 4 and 4, and the pose
    apart = float(np.linalg.norm(beside(0.06, 10.0, 0.2).translation))
    assert found.baseline == pytest.approx(apart, rel=0.01)
    assert found.validation is not None
    assert found.validation.rms_mm < 1.0
    save_calibration(tmp_path / "c.yaml", found)
    again = load_calibration(tmp_path / "c.yaml")
    assert again == found
    uncertainty = CalibrationUncertainty(again)
    rays = np.array([np.eye(2) * 1e-7] * 2)
    spread = uncertainty.covariance(np.array([0.02, 0.01, 0.2]), rays)
    assert spread.shape == (3, 3)
    assert 1e-6 < np.sqrt(np.trace(spread)) < 2e-3


@pytest.mark.long("statistics")
def test_a_board_in_the_middle_of_the_pictures_is_not_called_good() -> None:
    rig = replace(usual_rig(), board=parse_board("checkerboard:9x6:8mm"), distance=0.3)
    rng, pairs = np.random.default_rng(9), ([], [])
    edge = 0.5 * (1.0 - np.sqrt(0.4)) * np.array(SIZE)
    for T in rig.poses(60, 9):
        views = [rig.view(model, T, 0.04, rng) for model in (rig.left, rig.right)]
        if all((v.pixels > edge).all() and (v.pixels < np.array(SIZE) - edge).all() for v in views):
            for side, view in enumerate(views):
                pairs[side].append(view.called(f"{side} {len(pairs[side])}"))
    found = calibrate_stereo(*pairs)
    assert found.validation is not None
    verdict = judge(found)
    assert verdict.why is Why.RAYS
    assert verdict.grade is Grade.USABLE
    assert "show it there too" in verdict.text
    middle = np.array([[300.0, 220.0], [340.0, 220.0], [340.0, 260.0], [300.0, 260.0]])
    assert judge(found, (), (middle, middle)).why is not Why.RAYS_BAD
    corner = np.array([[0.0, 0.0], [90.0, 0.0], [90.0, 70.0], [0.0, 70.0]])
    assert judge(found, (), (corner, corner)).grade is Grade.NOT_GOOD_ENOUGH
    assert judge(found, (), (corner, corner)).why is Why.RAYS_BAD


def test_the_deviation_of_rays_grows_where_no_corner_was() -> None:
    middle = calibrate_mono(lens_views(FIVE, 16, 7, board="checkerboard:9x6:10mm", share=0.3))
    grid = np.array(middle.calibration.ray_sd_px)
    assert grid[3, 4] < 0.3
    assert grid[[0, 0, -1, -1], [0, -1, 0, -1]].min() > 2.0
    model: CameraModel = camera("c", (534.0, 534.0, 322.0, 235.0), FIVE[1], SIZE)
    p = np.concatenate([model.intrinsics, model.distortion])
    assert not ray_sds(p, np.zeros((9, 9)), SIZE).any()


@pytest.mark.long("statistics")
@pytest.mark.parametrize("seed", [10, 12])
def test_a_board_that_moves_while_rows_are_read_names_the_rolling_shutter(seed: int) -> None:
    moving = calibrate_mono(lens_views(FIVE, 14, seed, speed=0.15), hold_back=0)
    assert moving.calibration.rolling_px is not None
    assert any("rolling shutter" in note for note in moving.notes)


@pytest.mark.parametrize("bowl", [0.0, 5e-4, 2e-3])
def test_a_still_board_names_no_rolling_shutter_flat_or_not(bowl: float) -> None:
    still = calibrate_mono(lens_views(FIVE, 14, 11, bowl=bowl), hold_back=0)
    assert still.calibration.rolling_px is None
    assert not any("rolling shutter" in note for note in still.notes)


def test_a_rolling_shutter_keeps_a_pair_from_being_called_good() -> None:
    rig = usual_rig()
    found = calibrate_stereo(*rig.pairs(12, 5))
    left, right = found.cameras
    cameras = (left.model_copy(update={"rolling_px": 0.3}), right)
    moved = found.model_copy(update={"cameras": cameras})
    verdict = judge(moved)
    assert (verdict.grade, verdict.why) == (Grade.USABLE, Why.ROLLING)
    assert "left (0.3 px)" in verdict.text
