"""Two cameras from pairs whose truth is known: corner orders, outliers, swaps, scale."""

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from app.core.progress import Cancelled, Progress
from app.core.transform import RigidTransform
from app.tracking.calibration import stereo
from app.tracking.calibration.boards import parse_board
from app.tracking.calibration.checks import check_baseline, check_second_board
from app.tracking.calibration.corner_order import CornerAgreement, PosedPair, agree
from app.tracking.calibration.pairing import pair_folder
from app.tracking.calibration.pictures import read_views
from app.tracking.calibration.run import StereoResult, calibrate_pairs, calibrate_stereo
from app.tracking.calibration.sets import none_seen, stereo_set
from app.tracking.calibration.stereo import estimate_stereo, mirrored_view
from app.tracking.calibration.views import BoardView
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import StereoCalibration
from app.tracking.simulated.board import BoardRenderer
from tests.tracking.calibration_rig import Rig, small_rig, thesis_rig, usual_rig

NOISE = 0.1
Views = list[BoardView]


@pytest.fixture(scope="module")
def rig() -> Rig:
    return usual_rig()


@pytest.fixture(scope="module")
def pairs(rig: Rig) -> tuple[Views, Views]:
    return rig.pairs(12, 1, NOISE)


@pytest.fixture(scope="module")
def result(pairs: tuple[Views, Views]) -> StereoResult:
    return calibrate_pairs(*pairs)


def twist_error(calibration: StereoCalibration, rig: Rig) -> tuple[np.ndarray, np.ndarray]:
    twist = (calibration.pose.transform @ rig.T_right_left.inverse()).log()
    return twist, np.sqrt(np.diag(calibration.pose.pose_covariance))


def turned(views: Views, which: set[int]) -> Views:
    order = np.arange(views[0].board.count)[::-1]
    return [view.reordered(order) if i in which else view for i, view in enumerate(views)]


@pytest.mark.long("statistics")
def test_the_pose_is_within_its_stated_uncertainty(result: StereoResult, rig: Rig) -> None:
    error, sd = twist_error(result.calibration, rig)
    assert (np.abs(error) < 4.0 * sd).all()
    assert (sd[:3] < 0.5e-3).all()


def test_boards_held_back_come_out_true(result: StereoResult) -> None:
    value = result.calibration.validation
    assert value is not None
    assert value.views == 2
    assert value.points == 2 * 54
    assert value.scale == pytest.approx(1.0, abs=0.002)
    assert value.rms_mm < 1.2  # depth: z²/(f b) x 0.14 px is 0.5 mm at 0.4 m, 0.8 mm at 0.5 m
    assert value.epipolar_px < 3.0 * NOISE
    assert sum(r.role == "held_back" for r in result.residuals) == 2


@pytest.mark.long("statistics")
def test_corner_orders_that_flip_in_eight_of_34_pairs_are_mended() -> None:
    rig = thesis_rig()  # 5x7 corners: the picture alone cannot tell
    left, right = rig.pairs(34, 2, NOISE)
    flipped = {1, 4, 9, 13, 20, 21, 28, 33}
    straight = calibrate_pairs(left, right, hold_back=0)
    mended = calibrate_pairs(left, turned(right, flipped), hold_back=0)
    assert set(mended.estimate.mended) == {f"r{i}" for i in flipped}
    assert any("8 of 34 pairs" in note for note in mended.calibration.notes)
    assert mended.calibration.rms_px == pytest.approx(straight.calibration.rms_px, rel=1e-4)
    error, sd = twist_error(mended.calibration, rig)
    assert (np.abs(error) < 4.0 * sd).all()


def test_a_flip_of_most_pairs_is_mended_as_well() -> None:
    rig = thesis_rig()
    left, right = rig.pairs(9, 5, NOISE)
    calibration = calibrate_pairs(left, turned(right, set(range(7))), hold_back=0).calibration
    error, sd = twist_error(calibration, rig)
    assert (np.abs(error) < 4.0 * sd).all()


def test_an_ambiguous_board_that_was_hardly_moved_is_refused() -> None:
    rig = thesis_rig()
    poses = rig.poses(1, 3)
    rng = np.random.default_rng(0)
    # Both cameras know their own lens from elsewhere; the pairs are six times the same place.
    single, other = rig.pairs(9, 4, NOISE)
    left = [rig.view(rig.left, poses[0], NOISE, rng) for _ in range(6)]
    right = [rig.view(rig.right, poses[0], NOISE, rng) for _ in range(6)]
    nothing: list[BoardView | None] = [None] * 9
    with pytest.raises(CalibrationError, match="half a turn"):
        calibrate_stereo([*left, *single, *nothing], [*right, *nothing, *other], hold_back=0)


def test_views_of_one_camera_alone_help_its_own_parameters(
    rig: Rig, pairs: tuple[Views, Views]
) -> None:
    few_left, few_right = (views[:5] for views in pairs)
    more, _ = rig.pairs(12, 44, NOISE)
    without = calibrate_stereo(few_left, few_right, hold_back=0)
    with_more = calibrate_stereo([*few_left, *more], [*few_right, *[None] * 12], hold_back=0)
    focal_sd = [
        float(np.sqrt(c.cameras[0].parameter_covariance[0, 0])) for c in (without, with_more)
    ]
    assert focal_sd[1] < 0.8 * focal_sd[0]


def test_a_pair_that_was_not_taken_together_is_named(pairs: tuple[Views, Views]) -> None:
    left, right = list(pairs[0]), list(pairs[1])
    right[3] = right[7].called("late")
    found = calibrate_pairs(left, right, hold_back=0)
    assert [r.name for r in found.residuals if r.role == "outlier"] == ["l3 + late"]
    assert any("late" in note for note in found.calibration.notes)


def test_pairs_in_the_wrong_order_are_refused(pairs: tuple[Views, Views]) -> None:
    left, right = pairs
    with pytest.raises(CalibrationError, match="do not agree on where the cameras stand"):
        calibrate_pairs(left, [*right[1:], right[0]], hold_back=0)


def test_pictures_mirrored_on_one_side_are_found_out(pairs: tuple[Views, Views]) -> None:
    left, right = pairs
    with pytest.raises(CalibrationError, match="mirrored"):
        calibrate_pairs(left, [mirrored_view(view) for view in right], hold_back=0)


def test_one_camera_used_twice_is_refused(pairs: tuple[Views, Views]) -> None:
    with pytest.raises(CalibrationError, match="both come from one camera"):
        calibrate_pairs(pairs[0], pairs[0])


def test_swapped_cameras_are_said(pairs: tuple[Views, Views]) -> None:
    left, right = pairs
    notes = calibrate_pairs(right, left, hold_back=0).calibration.notes
    assert any("may be swapped" in note for note in notes)


def test_a_small_rig_is_calibrated() -> None:
    rig = small_rig()
    calibration = calibrate_stereo(*rig.pairs(10, 1, 0.05))
    error, sd = twist_error(calibration, rig)
    assert (np.abs(error) < 4.0 * sd).all()


def test_a_wrong_board_size_keeps_the_residual_and_is_caught_by_a_known_length(
    pairs: tuple[Views, Views], rig: Rig, result: StereoResult
) -> None:
    wrong = parse_board("checkerboard:9x6:30mm")
    left, right = (
        [BoardView(wrong, v.ids, v.pixels, v.image_size, name=v.name) for v in views]
        for views in pairs
    )
    calibration = calibrate_stereo(left, right)
    assert calibration.rms_px == pytest.approx(result.calibration.rms_px, rel=1e-6)
    assert calibration.validation is not None
    assert calibration.validation.scale == pytest.approx(1.0, abs=0.002)  # cannot tell by itself
    check = check_baseline(calibration, 83.0)
    assert not check.passed
    assert check.ratio == pytest.approx(1.2, abs=0.01)
    assert "25" in check.text
    second = [(a, b) for a, b in zip(*rig.pairs(3, 70, NOISE), strict=True)]
    assert not check_second_board(calibration, second).passed
    assert check_baseline(result.calibration, 83.0).passed
    assert check_second_board(result.calibration, second).passed


def test_a_calibration_can_be_cancelled(pairs: tuple[Views, Views]) -> None:
    progress = Progress()
    progress.cancel()
    with pytest.raises(Cancelled):
        calibrate_pairs(*pairs, progress=progress)


@pytest.mark.long("statistics")
def test_small_blurred_pictures_are_calibrated_from_disk_to_within_what_is_stated(
    tmp_path: Path,
) -> None:
    rig, rng = small_rig(), np.random.default_rng(1)
    for i, T in enumerate(rig.poses(9, 21)):
        for model in (rig.left, rig.right):
            picture = BoardRenderer(model, rig.board, 2).render(
                model.T_camera_world @ T, 0.9, 4.0, rng
            )
            cv2.imwrite(str(tmp_path / f"{model.name}{i}.png"), picture)
    found = stereo_set(pair_folder(tmp_path).pairs, rig.board, hold_back=0)
    assert len(found.result.estimate.pairs) >= 7
    error, sd = twist_error(found.calibration, rig)
    assert (np.abs(error) < 4.0 * sd).all()
    assert found.calibration.rms_px < 0.3


@pytest.mark.long("statistics")
def test_too_few_pairs_are_refused_with_the_commonest_reason(tmp_path: Path) -> None:
    rig = usual_rig()
    for i, T in enumerate(rig.poses(3, 21)):
        for model in (rig.left, rig.right):
            picture = BoardRenderer(model, rig.board, 2).render(model.T_camera_world @ T)
            seen = model is rig.left or i == 0
            cv2.imwrite(str(tmp_path / f"{model.name}{i}.png"), picture if seen else 0 * picture)
    reason = r"1 of 3 pairs show the board to both .* right1\.png: .*check the counts"
    with pytest.raises(CalibrationError, match=reason):
        stereo_set(pair_folder(tmp_path).pairs, rig.board)


def test_pictures_of_no_use_are_refused_with_each_reason(tmp_path: Path) -> None:
    (tmp_path / "a.png").write_text("no picture")
    cv2.imwrite(str(tmp_path / "b.png"), np.zeros((480, 640), np.uint8))
    read = read_views([tmp_path / "a.png", tmp_path / "b.png"], usual_rig().board)
    assert "a.png: " in none_seen(read)
    assert "; b.png: " in none_seen(read)


def test_pictures_of_two_sizes_are_remarked(rig: Rig, pairs: tuple[Views, Views]) -> None:
    left, right = pairs
    half = [BoardView(v.board, v.ids, (v.pixels - 0.5) / 2, (320, 240), name=v.name) for v in right]
    notes = calibrate_pairs(left, half, hold_back=0).calibration.notes
    assert any("left 640x480, right 320x240" in note for note in notes)
    assert not any("sizes" in note for note in calibrate_pairs(left, right).calibration.notes)


def test_pairs_that_the_rough_stage_left_out_come_back_when_they_fit(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    rig = usual_rig()
    left, right = rig.pairs(10, 17)
    right[8] = right[8].reordered(np.arange(rig.board.count)[::-1])
    whole = estimate_stereo(list(zip(left, right, strict=True)))

    def rough(pairs: list[PosedPair], camera: np.ndarray) -> CornerAgreement:
        found = agree(pairs, camera)
        errors = found.errors.copy()
        errors[[1, 4, 8]] = 3.0 * found.near
        ways = tuple(0 if i == 8 else way for i, way in enumerate(found.ways))
        return replace(found, errors=errors, ways=ways)

    monkeypatch.setattr(stereo, "agree", rough)
    found = estimate_stereo(list(zip(left, right, strict=True)))
    assert [row.role for row in found.residuals] == ["used"] * 10
    assert found.mended == whole.mended == ("r8",)
    assert found.rms_px == pytest.approx(whole.rms_px, rel=1e-6)
    np.testing.assert_allclose(found.adjusted.covariance, whole.adjusted.covariance, rtol=1e-3)


def test_no_pair_is_left_out_that_fits_better_than_one_that_is_used() -> None:
    rig = usual_rig()
    left, right = rig.pairs(12, 23)
    late = rig.pairs(12, 24)[1]
    right[3] = late[3].called("r3")
    found = estimate_stereo(list(zip(left, right, strict=True)))
    rows = {
        role: [r.rms_px for r in found.residuals if r.role == role] for role in ("used", "outlier")
    }
    assert len(rows["outlier"]) == 1
    assert max(rows["used"]) < min(rows["outlier"])


def moved(rig: Rig, count: int, seed: int) -> tuple[list[BoardView], list[BoardView]]:
    """Pairs not taken at the same moment: the board moves between them by 0.3 mm and 0.1°."""
    rng = np.random.default_rng(seed)
    spread = np.array([3e-4] * 3 + [2e-3] * 3)
    left, right = [], []
    for i, T in enumerate(rig.poses(count, seed)):
        later = RigidTransform.exp(spread * rng.standard_normal(6)) @ T
        left.append(rig.view(rig.left, T, 0.07, rng).called(f"l{i}"))
        right.append(rig.view(rig.right, later, 0.07, rng).called(f"r{i}"))
    return left, right


@pytest.mark.long("statistics")
def test_pairs_that_do_not_belong_together_are_said_and_their_uncertainty_holds() -> None:
    rig = usual_rig()
    off, factors = [], []
    for seed in range(8):
        left, right = moved(rig, 10, 40 + seed)
        found = estimate_stereo(list(zip(left, right, strict=True)))
        assert max(found.left.calibration.rms_px, found.right.calibration.rms_px) < 0.12
        assert found.rms_px > 2.0 * 0.1
        assert any("do not belong together" in note for note in found.notes)
        pose = found.adjusted.state.T_right_left
        twist = (rig.T_right_left @ pose.inverse()).log()
        off.append(twist / np.sqrt(np.diag(found.adjusted.covariance[18:, 18:])))
        factors.append(found.together.sd_factor)
    assert min(factors) > 4.0
    assert 0.5 < np.sqrt(np.mean(np.square(off))) < 2.0  # it was 5 and more


def test_pairs_taken_together_are_not_said_to_be_apart() -> None:
    rig = usual_rig()
    left, right = rig.pairs(10, 30, noise=0.1)
    found = estimate_stereo(list(zip(left, right, strict=True)))
    assert found.together.sd_factor == 1.0
    assert not any("together" in note for note in found.notes)
