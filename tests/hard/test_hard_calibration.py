"""Views from which a camera cannot be had, or hardly: each a named error or a bounded answer."""

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.planning.registration.check import RegistrationCheck, check_points
from app.planning.registration.errors import RegistrationError
from app.planning.registration.plate import load_plate
from app.planning.registration.points import NamedPoints
from app.planning.registration.words import troubles
from app.tracking.calibration.boards import Board
from app.tracking.calibration.bundle import adjust, with_free
from app.tracking.calibration.checks import check_baseline
from app.tracking.calibration.corners import find_corners
from app.tracking.calibration.mono import calibrate_mono
from app.tracking.calibration.pairing import Pair
from app.tracking.calibration.pictures import read_view
from app.tracking.calibration.poses import board_pose, rigid_fit
from app.tracking.calibration.run import calibrate_pairs
from app.tracking.calibration.sets import mono_set, stereo_set
from app.tracking.calibration.sightings import AdjustedState, SeenBoard
from app.tracking.calibration.validation import triangulated
from app.tracking.calibration.views import BoardView, Rejection, RejectionReason
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import PARAMETERS, StereoCalibration
from app.tracking.simulated.board import BoardRenderer
from tests.tracking.calibration_rig import Rig, usual_rig

NOISE = 0.1


@pytest.fixture(scope="module")
def rig() -> Rig:
    return usual_rig()


def views_at(rig: Rig, poses: list[RigidTransform]) -> list[BoardView]:
    rng = np.random.default_rng(0)
    return [rig.view(rig.left, T, NOISE, rng) for T in poses]


def tilted(rig: Rig, turn: tuple[float, float, float], place: list[float]) -> RigidTransform:
    rotation = rotation_exp(np.deg2rad(turn))
    return RigidTransform(rotation, np.array(place) - rotation @ rig.board.points.mean(axis=0))


def test_views_all_in_parallel_planes_do_not_determine_the_focal_length(rig: Rig) -> None:
    places = [[0.03 * (i % 3 - 1), 0.03 * (i // 3 - 1), 0.4 + 0.02 * i] for i in range(8)]
    poses = [tilted(rig, (0, 0, 0), place) for place in places]
    with pytest.raises(CalibrationError, match=r"do not determine the focal length|no camera"):
        calibrate_mono(views_at(rig, poses), "left", 0)


@pytest.mark.long("statistics")
def test_the_same_tilted_view_again_and_again_is_refused_or_its_uncertainty_is_huge(
    rig: Rig,
) -> None:
    poses = [tilted(rig, (25, 0, 0), [0.0, 0.0, 0.4])] * 8
    try:
        result = calibrate_mono(views_at(rig, poses), "left", 0)
    except CalibrationError:
        return
    error = abs(result.adjusted.state.parameters[0, 0] - 534.0)
    assert error < 5.0 * result.adjusted.sd()[0]


def test_two_views_only_are_refused_by_number(rig: Rig) -> None:
    poses = [tilted(rig, (25, 10, 0), [0, 0, 0.4]), tilted(rig, (-20, 15, 0), [0, 0, 0.4])]
    with pytest.raises(CalibrationError, match="at least 3"):
        calibrate_mono(views_at(rig, poses), "left")
    pair = [views_at(rig, poses)] * 2
    with pytest.raises(CalibrationError, match="at least 3"):
        calibrate_pairs(*pair)


def test_a_view_with_pixels_that_are_not_numbers_is_refused(rig: Rig) -> None:
    pixels = np.full((54, 2), np.nan)
    with pytest.raises(CalibrationError, match="one finite pixel"):
        BoardView(rig.board, np.arange(54), pixels, (640, 480), name="nan.png")


def test_a_corner_number_that_is_not_on_the_board_is_refused(rig: Rig) -> None:
    with pytest.raises(CalibrationError, match="corner 54"):
        BoardView(rig.board, np.array([3, 54]), np.zeros((2, 2)), (640, 480))


def test_corners_on_one_line_or_in_one_point_give_no_pose_and_no_nan(rig: Rig) -> None:
    p = np.array([534.0, 534.0, 342.0, 235.0, 0, 0, 0, 0, 0])
    for pixels in (np.zeros((54, 2)), np.column_stack([np.arange(54.0), np.zeros(54)])):
        view = BoardView(rig.board, np.arange(54), pixels, (640, 480))
        try:
            T, error = board_pose(view, p)
        except CalibrationError:
            continue
        assert np.isfinite(T.matrix()).all()
        assert np.isfinite(error)


def test_fewer_measurements_than_unknowns_are_refused(rig: Rig) -> None:
    (view,) = views_at(rig, [tilted(rig, (20, 10, 0), [0, 0, 0.4])])
    start = AdjustedState(
        np.array([[534.0, 534, 342, 235, 0, 0, 0, 0, 0]]),
        RigidTransform.identity(),
        (tilted(rig, (20, 10, 0), [0, 0, 0.4]),),
    )
    seen = [SeenBoard(0, 0, view.points[:5], view.pixels[:5])]
    with pytest.raises(CalibrationError, match="cannot determine 15 unknowns"):
        adjust(seen, start, with_free(PARAMETERS))


def test_what_the_views_do_not_determine_has_a_huge_but_finite_standard_deviation(
    rig: Rig,
) -> None:
    T = tilted(rig, (0, 0, 0), [0, 0, 0.4])  # facing the camera: focal length against distance
    (view,) = views_at(replace(rig, left=replace(rig.left, distortion=np.zeros(5))), [T])
    p = np.array([[534.0, 534.0, 342.0, 235.0, 0, 0, 0, 0, 0]])
    seen = [SeenBoard(0, 0, view.points, view.pixels)]
    free = with_free(("fx", "fy", "cx", "cy"))
    result = adjust(seen, AdjustedState(p, RigidTransform.identity(), (T,)), free)
    assert np.isfinite(result.covariance).all()
    assert result.sd()[0] > 50.0


def test_a_first_estimate_behind_the_camera_is_refused(rig: Rig) -> None:
    (view,) = views_at(rig, [tilted(rig, (20, 10, 0), [0, 0, 0.4])])
    p = np.array([[534.0, 534.0, 342.0, 235.0, 0, 0, 0, 0, 0]])
    start = AdjustedState(
        p, RigidTransform.identity(), (RigidTransform.from_translation([0, 0, -0.4]),)
    )
    with pytest.raises(CalibrationError, match="behind a camera"):
        adjust([SeenBoard(0, 0, view.points, view.pixels)], start, with_free(("fx",)))


def test_parallel_rays_are_refused(rig: Rig) -> None:
    pixels = np.array([[342.0, 235.0]])
    straight = replace(rig.left, distortion=np.zeros(5))
    beside = replace(straight, T_world_camera=RigidTransform.from_translation([0.1, 0.0, 0.0]))
    with pytest.raises(CalibrationError, match="parallel"):
        triangulated(straight, beside, pixels, pixels)


def test_identical_cameras_at_one_place_are_refused(rig: Rig) -> None:
    rng = np.random.default_rng(3)
    poses = rig.poses(8, 5)
    both = [[rig.view(rig.left, T, NOISE, rng) for T in poses] for _ in range(2)]
    with pytest.raises(CalibrationError, match="one place"):
        calibrate_pairs(*both, hold_back=0)


def test_a_rigid_fit_of_a_mirrored_set_is_a_rotation_never_a_reflection() -> None:
    rng = np.random.default_rng(0)
    points = rng.normal(size=(20, 3))
    T = rigid_fit(points, points * [-1.0, 1.0, 1.0])
    assert np.linalg.det(T.rotation) == pytest.approx(1.0)


@pytest.mark.parametrize("content", [b"", b"\x89PNG\r\n\x1a\n nothing", b"hello"])
def test_a_corrupt_picture_is_a_rejection_by_name(content: bytes, tmp_path: Path, rig: Rig) -> None:
    path = tmp_path / "left1.png"
    path.write_bytes(content)
    found = read_view(path, rig.board)
    assert isinstance(found, Rejection)
    assert (found.reason, found.name) == (RejectionReason.UNREADABLE, "left1.png")


def test_half_a_picture_is_a_rejection_or_a_view_never_an_exception(
    tmp_path: Path, rig: Rig
) -> None:
    image = BoardRenderer(rig.left, rig.board, 1).render(tilted(rig, (10, 5, 0), [0, 0, 0.45]))
    data = cv2.imencode(".jpg", image)[1].tobytes()
    path = tmp_path / "half.jpg"
    path.write_bytes(data[: len(data) // 2])
    assert isinstance(read_view(path, rig.board), Rejection | BoardView)


def test_pictures_without_a_board_say_so_once(tmp_path: Path, rig: Rig) -> None:
    pairs = []
    for i in range(3):
        files = [tmp_path / f"{side}{i}.png" for side in ("left", "right")]
        for path in files:
            cv2.imwrite(str(path), np.full((120, 160), 90, np.uint8))
        pairs.append(Pair(str(i), *files))
    with pytest.raises(CalibrationError, match="in none of 6 pictures"):
        stereo_set(pairs, rig.board)
    with pytest.raises(CalibrationError, match="in none of 3 pictures"):
        mono_set("left", [pair.left for pair in pairs], rig.board)


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 2**32 - 1), st.sampled_from([(64, 80), (120, 160), (17, 400)]))
def test_noise_shows_no_board(seed: int, size: tuple[int, int]) -> None:
    image = np.random.default_rng(seed).integers(0, 256, size).astype(np.uint8)
    board = usual_rig().board
    assert isinstance(find_corners(image, board, thorough=False), Rejection)


# --- a print at 97 % ---------------------------------------------------------------------------
PRINTED = 0.97
PLATE = load_plate("stepped-plate")


def named(points: np.ndarray) -> NamedPoints:
    return NamedPoints(PLATE.names, points, np.zeros((len(points), 3, 3)))


def calibrated(rig: Rig, believed: Board) -> StereoCalibration:
    """Calibration by a board that was printed at 97 %, and is believed to be another."""
    printed = replace(rig.board, square=PRINTED * rig.board.square)
    views = replace(rig, board=printed).pairs(16, 4, NOISE)
    left, right = ([replace(view, board=believed) for view in side] for side in views)
    return calibrate_pairs(left, right, hold_back=4).calibration


@pytest.fixture(scope="module")
def shrunk(rig: Rig) -> StereoCalibration:
    return calibrated(rig, rig.board)


def test_no_figure_of_the_calibration_itself_shows_a_print_at_97_percent(
    rig: Rig, shrunk: StereoCalibration
) -> None:
    right = calibrated(rig, replace(rig.board, square=PRINTED * rig.board.square))
    assert shrunk.rms_px == pytest.approx(right.rms_px, rel=1e-6)
    checked, true = shrunk.validation, right.validation
    assert checked is not None
    assert true is not None
    assert checked.scale == pytest.approx(true.scale, abs=1e-6)
    assert checked.rms_mm == pytest.approx(true.rms_mm / PRINTED, rel=1e-3)
    assert shrunk.baseline == pytest.approx(0.083 / PRINTED, rel=0.005)


def test_a_print_at_97_percent_is_caught_by_the_ruler_and_by_the_plate_that_is_touched(
    rig: Rig, shrunk: StereoCalibration
) -> None:
    ruler = check_baseline(shrunk, 83.0)
    assert not ruler.passed
    assert "squares of 24.2" in ruler.text
    T_left_plate = RigidTransform(rotation_exp([-2.4, 0.3, 0.2]), np.array([0.0, 0.0, 0.40]))
    true = T_left_plate @ PLATE.touch
    rng = np.random.default_rng(5)  # a touch is the mean of a second's pictures
    seen = [
        camera.project(true)[0] + NOISE / 30**0.5 * rng.standard_normal((len(true), 2))
        for camera in (rig.left, rig.right)
    ]
    left, right = shrunk.cameras
    T_right_left = shrunk.pose.transform
    models = left.model(RigidTransform.identity()), right.model(T_right_left.inverse())
    touched = triangulated(models[0], models[1], seen[0], seen[1])
    check = RegistrationCheck.of(PLATE, named(touched))
    assert check.world.scale.value == pytest.approx(1.0 / PRINTED, abs=0.01)
    assert check.world.scale.wrong
    assert not check.trusted
    (trouble,) = troubles(check)
    assert "too long" in trouble
    assert "line of 100 mm" in trouble
    with pytest.raises(RegistrationError):
        check.agreement(true.mean(axis=0))


@pytest.mark.long("statistics")
@pytest.mark.parametrize(("scale", "least", "most"), [(1.0, 0, 0), (1.0 / 0.97, 190, 200)])
def test_careful_touches_show_a_print_at_97_percent_and_never_call_a_true_one_wrong(
    scale: float, least: int, most: int
) -> None:
    rng = np.random.default_rng(8)
    sigma = PLATE.localisation_mm * 1e-3 / 3**0.5
    found = 0
    for _ in range(200):
        pose = RigidTransform(rotation_exp(rng.uniform(-3, 3, 3)), rng.uniform(-0.3, 0.3, 3))
        points = scale * (pose @ PLATE.touch) + sigma * rng.standard_normal(PLATE.touch.shape)
        found += check_points(PLATE, PLATE.touch, named(points)).scale.wrong
    assert least <= found <= most


def test_one_misplaced_point_is_called_that_and_no_wrong_scale() -> None:
    for index in range(len(PLATE.names)):
        points = PLATE.touch.copy()
        points[index] += 0.2 * (points[index] - points.mean(axis=0))
        check = check_points(PLATE, PLATE.touch, named(points))
        assert not check.scale.wrong
