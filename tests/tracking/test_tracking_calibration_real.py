"""Thirteen real pairs of a 9x6 board with published left intrinsics."""

from pathlib import Path

import numpy as np
import pytest

from app.tracking.calibration.boards import parse_board
from app.tracking.calibration.pairing import Pair, pair_folder
from app.tracking.calibration.pictures import read_views
from app.tracking.calibration.poses import usual_rms, usual_stereo_rms
from app.tracking.calibration.run import StereoResult, calibrate_pairs
from app.tracking.calibration.views import BoardView
from app.tracking.optics.lens import LensModel

BOARD = parse_board("checkerboard:9x6:25mm")
PUBLISHED_FX, PUBLISHED_CENTRE = 535.916, (342.283, 235.571)  # left_intrinsics.yml
Views = list[BoardView]


@pytest.fixture(scope="module")
def pairs(shared_data: Path) -> list[Pair]:
    folder = shared_data / "stereo_opencv"
    if not folder.is_dir():
        pytest.skip(f"no real pairs in {folder}: set ACUS_TEST_DATA")
    return list(pair_folder(folder).pairs)


def seen(pairs: list[Pair], window: int | None = None) -> tuple[Views, Views]:
    read = read_views([p for pair in pairs for p in (pair.left, pair.right)], BOARD, None, window)
    assert all(isinstance(view, BoardView) for view in read)
    return read[0::2], read[1::2]  # type: ignore[return-value]


@pytest.fixture(scope="module")
def views(pairs: list[Pair]) -> tuple[Views, Views]:
    return seen(pairs)


@pytest.fixture(scope="module")
def result(views: tuple[Views, Views]) -> StereoResult:
    return calibrate_pairs(*views)


def test_the_published_residuals_come_out_with_the_published_recipe(pairs: list[Pair]) -> None:
    left, right = seen(pairs, window=11)  # for all pictures, as the published recipe has it
    assert usual_rms(left) == pytest.approx(0.409, abs=0.003)
    assert usual_rms(right) == pytest.approx(0.459, abs=0.003)


def test_a_window_that_fits_the_squares_halves_the_residual(views: tuple[Views, Views]) -> None:
    for side in views:
        rms = usual_rms(side)
        assert rms is not None
        assert rms < 0.2


def test_the_left_camera_is_the_published_one(result: StereoResult) -> None:
    camera = result.calibration.cameras[0]
    assert camera.focal_px == pytest.approx((PUBLISHED_FX,) * 2, rel=0.005)
    assert camera.centre_px == pytest.approx(PUBLISHED_CENTRE, abs=2.0)
    assert camera.distortion[0] == pytest.approx(-0.28, abs=0.02)


def test_real_pictures_ask_for_five_coefficients_and_say_how_sure_each_is(
    result: StereoResult,
) -> None:
    for camera in result.calibration.cameras:
        assert camera.lens is LensModel.BROWN
        assert {"k1", "k2", "p1", "p2"} <= set(camera.estimated)
        sd = np.sqrt(np.diag(camera.parameter_covariance))
        estimated = [name in camera.estimated for name in camera.lens.coefficients]
        assert ((sd[4:] > 0.0) == estimated).all()
        assert camera.rolling_px is None


def test_boards_held_back_come_out_true(result: StereoResult) -> None:
    calibration = result.calibration
    assert calibration.baseline == pytest.approx(0.0834, abs=0.0005)
    assert calibration.rms_px < 0.25
    value = calibration.validation
    assert value is not None
    assert value.views == 2
    assert value.rms_mm < 0.4  # at 0.3 to 0.5 m with a baseline of 83 mm
    assert value.scale == pytest.approx(1.0, abs=0.002)
    assert value.epipolar_px < 0.3


@pytest.mark.long("statistics")
def test_corner_orders_that_differ_between_the_cameras_are_mended(
    views: tuple[Views, Views], result: StereoResult
) -> None:
    left, right = views
    other_end = np.arange(BOARD.count)[::-1]
    flipped = [v.reordered(other_end) if i in (0, 3, 6, 7) else v for i, v in enumerate(right)]
    mended = calibrate_pairs(left, flipped)
    assert set(mended.estimate.mended) == {right[i].name for i in (0, 3, 6, 7)}
    assert mended.calibration.rms_px == pytest.approx(result.calibration.rms_px, abs=1e-6)
    np.testing.assert_allclose(
        mended.calibration.pose.translation_mm, result.calibration.pose.translation_mm, atol=1e-4
    )


def test_the_published_stereo_residual_comes_out_with_the_published_recipe(
    pairs: list[Pair],
) -> None:
    left, right = seen(pairs, window=11)
    assert usual_stereo_rms(list(zip(left, right, strict=True))) == pytest.approx(0.448, abs=0.004)
