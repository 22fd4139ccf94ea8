"""Which pictures of a board are kept, and what the person is told to do next."""

from dataclasses import replace

import numpy as np
import pytest
from board_pictures import board_picture, board_pose

from app.core.transform import RigidTransform
from app.tracking.calibration.boards import parse_board
from app.tracking.calibration.collector import ViewCollector
from app.tracking.calibration.corners import find_corners
from app.tracking.calibration.coverage import Attitude, Coverage
from app.tracking.calibration.views import BoardView, Rejection, RejectionReason
from app.tracking.errors import CalibrationError
from app.tracking.optics.camera_model import CameraModel

BOARD = parse_board("charuco:7x5:20mm:15mm:DICT_5X5_100")
CAMERA = CameraModel(
    "left",
    np.array([620.0, 620.0, 319.5, 239.5]),
    np.array([-0.1, 0.05, 0.0, 0.0, 0.0]),
    (640, 480),
    RigidTransform.identity(),
)
NOTHING = Rejection(RejectionReason.NO_BOARD, "no board is seen")


def view(
    distance: float = 0.4,
    x_deg: float = 0.0,
    y_deg: float = 0.0,
    roll_deg: float = 0.0,
    aside: tuple[float, float] = (0.0, 0.0),
    sharpness: float = 1.5,
) -> BoardView:
    T_camera_board = board_pose(BOARD, distance, x_deg, y_deg, roll_deg, aside)
    p_camera = T_camera_board @ BOARD.points
    uv, ok = CAMERA.project(p_camera)
    ids = np.flatnonzero(ok & CAMERA.sees(p_camera))
    return BoardView(BOARD, ids, uv[ids], CAMERA.image_size, sharpness=sharpness)


def attitude(*args: float, **kwargs: object) -> Attitude:
    found = Attitude.of(view(*args, **kwargs))  # type: ignore[arg-type]
    assert found is not None
    return found


def shown(collector: ViewCollector, *views: BoardView) -> list[bool]:
    """Show each view twice: once to be still, once to be kept."""
    answers = []
    for one in views:
        offers = [collector.consider((one,)) for _ in range(2)]
        answers.append(any(offer.kept for offer in offers))
    return answers


@pytest.mark.parametrize("angle", [-40.0, -20.0, 20.0, 40.0])
@pytest.mark.parametrize("roll", [0.0, 90.0, 200.0])
def test_the_tilt_is_told_with_its_side(angle: float, roll: float) -> None:
    to_right = attitude(0.4, y_deg=angle, roll_deg=roll).tilt_deg
    downwards = attitude(0.4, x_deg=angle, roll_deg=roll).tilt_deg
    assert to_right == pytest.approx((angle, 0.0), abs=4.0)
    assert downwards == pytest.approx((0.0, angle), abs=4.0)


def test_a_board_that_faces_the_camera_has_no_tilt_wherever_it_is() -> None:
    for aside in ((0.0, 0.0), (0.1, -0.05), (-0.1, 0.05)):
        assert np.hypot(*attitude(0.4, aside=aside).tilt_deg) < 12.0  # distortion bends it


def test_coverage_counts_corners_by_cell_and_names_bare_corners() -> None:
    one = view(0.4, aside=(-0.13, -0.08))
    found = Attitude.of(one)
    assert found is not None
    coverage = Coverage().adding(one, found)
    assert coverage.cells.sum() == one.ids.size
    assert "upper left" not in coverage.bare_corners()
    assert "lower right" in coverage.bare_corners()
    assert Coverage().covered == 0.0
    assert Coverage().growth == 1.0


def test_a_view_is_kept_only_once_the_board_is_still() -> None:
    collector = ViewCollector(BOARD, ["left"])
    assert collector.consider((view(),)).words == "hold the board still"
    moved = view(aside=(0.01, 0.0))
    assert collector.consider((moved,)).words == "hold the board still"
    assert collector.consider((moved,)).kept
    assert len(collector.kept) == 1


def test_pictures_of_a_folder_need_not_be_still() -> None:
    collector = ViewCollector(BOARD, ["left"], live=False)
    assert collector.consider((view(),)).kept


def test_a_view_like_one_already_kept_is_refused_with_what_to_do_instead() -> None:
    collector = ViewCollector(BOARD, ["left"])
    assert shown(collector, view()) == [True]
    offer = collector.consider((view(x_deg=3.0),))
    offer = collector.consider((view(x_deg=3.0),))
    assert not offer.kept
    assert "like one already kept: upper left corner of the picture not covered" in offer.words
    assert shown(collector, view(y_deg=20.0), view(0.3), view(roll_deg=40.0)) == [True] * 3


def test_a_blurred_view_is_refused() -> None:
    collector = ViewCollector(BOARD, ["left"])
    assert shown(collector, view(sharpness=1.8), view(y_deg=25.0, sharpness=3.5)) == [True, False]
    words = collector.consider((view(y_deg=25.0, sharpness=3.5),)).words
    assert "blurred, edges 3.5 px wide (at most 2.9)" in words


def test_what_is_missing_is_said_until_nothing_is() -> None:
    collector = ViewCollector(BOARD, ["left"], live=False)
    assert collector.missing == ("15 more pictures of the board, unlike those taken",)
    assert not collector.enough
    collector.consider((view(),))
    assert any("side towards the camera" in line for line in collector.missing)
    assert any("nearer to the camera" in line for line in collector.missing)
    for x, y in ((-0.1, -0.07), (0.1, -0.07), (-0.1, 0.07), (0.1, 0.07), (0.0, 0.0)):
        for x_deg, y_deg, distance in ((20, 0, 0.35), (-20, 0, 0.3), (0, 25, 0.4), (0, -25, 0.3)):
            collector.consider((view(distance, x_deg, y_deg, aside=(x, y)),))
    assert collector.missing == ()
    assert collector.enough
    assert collector.progress == 1.0


def test_progress_never_reaches_one_while_something_is_missing() -> None:
    collector = ViewCollector(BOARD, ["left"], live=False)
    last = 0.0
    for k in range(40):
        collector.consider((view(0.4, aside=(0.004 * k - 0.08, 0.0), roll_deg=16.0 * k),))
        assert last <= collector.progress < 1.0
        last = collector.progress
    assert any("tilt the board more" in line for line in collector.missing)


def test_two_cameras_count_pairs_and_keep_what_one_alone_sees() -> None:
    collector = ViewCollector(BOARD, ["left", "right"], live=False)
    assert collector.consider((view(), NOTHING)).kept
    assert collector.pairs == 0
    assert collector.kept[0][1] is None
    # The left camera knows this view, but both together do not yet.
    assert collector.consider((view(), view(aside=(0.05, 0.0)))).kept
    assert collector.pairs == 1
    assert not collector.consider((view(), view(aside=(0.05, 0.0)))).kept
    assert collector.missing[0] == (
        "11 more pairs: both cameras see the board, unlike in the pairs taken"
    )
    assert any(line.startswith("right: ") for line in collector.missing)


def test_what_was_kept_last_can_be_taken_back() -> None:
    collector = ViewCollector(BOARD, ["left"], live=False)
    collector.consider((view(),))
    collector.consider((view(y_deg=30.0),))
    collector.drop_last()
    assert len(collector.kept) == len(collector.coverage(0).views) == 1
    assert collector.consider((view(y_deg=30.0),)).kept
    ViewCollector(BOARD, ["left"]).drop_last()  # nothing to take back is no harm


def test_pictures_without_a_board_say_why() -> None:
    collector = ViewCollector(BOARD, ["left", "right"])
    assert collector.consider((NOTHING, None)).words == "left: no board is seen"
    assert collector.consider((None, None)).words == "no picture"
    with pytest.raises(CalibrationError, match="1 pictures were given; there are 2 cameras"):
        collector.consider((NOTHING,))
    with pytest.raises(CalibrationError, match="3 cameras were named"):
        ViewCollector(BOARD, ["a", "b", "c"])


@pytest.mark.long("statistics")
def test_rendered_pictures_are_found_kept_and_refused_when_blurred() -> None:
    collector = ViewCollector(BOARD, ["left"], live=False)
    pose = board_pose(BOARD, 0.35, 15.0, -20.0)
    assert collector.offer((board_picture(BOARD, CAMERA, pose),)).kept
    other = board_pose(BOARD, 0.3, -15.0, 20.0)
    offer = collector.offer((board_picture(BOARD, CAMERA, other, blur=1.6),))
    assert not offer.kept
    assert "blurred" in offer.words
    empty = np.full((480, 640), 120, np.uint8)
    assert "no ChArUco board" in collector.offer((empty,)).words


@pytest.mark.long("statistics")
def test_a_rendered_picture_shows_its_corners_where_the_model_says() -> None:
    errors = []
    for x_deg, y_deg, roll_deg in ((15.0, -20.0, 10.0), (0.0, 0.0, 33.0), (-25.0, 10.0, 120.0)):
        pose = board_pose(BOARD, 0.35, x_deg, y_deg, roll_deg)
        found = find_corners(board_picture(BOARD, CAMERA, pose), BOARD)
        assert isinstance(found, BoardView)
        truth, _ = CAMERA.project(pose @ found.points)
        errors.append(np.sqrt(np.mean((found.pixels - truth) ** 2)))
    assert max(errors) < 0.06  # 0.15 and more where a marker's corner falls into the window


def test_the_same_pictures_give_the_same_answers() -> None:
    views = [view(0.3 + 0.01 * k, x_deg=3.0 * k, aside=(0.004 * k, 0.0)) for k in range(12)]
    runs = []
    for _ in range(2):
        collector = ViewCollector(BOARD, ["left"])
        runs.append([collector.consider((one,)).words for one in (*views, *views)])
    assert runs[0] == runs[1]


def test_views_with_few_corners_on_one_line_are_left_out() -> None:
    one = view()
    line = replace(one, ids=one.ids[:4], pixels=np.column_stack([np.arange(4.0), np.zeros(4)]))
    assert Attitude.of(line) is None
    assert not ViewCollector(BOARD, ["left"], live=False).consider((line,)).kept
