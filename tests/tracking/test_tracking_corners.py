"""Corners in rendered pictures, against where they truly are."""

from dataclasses import replace

import cv2
import numpy as np
import pytest

from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.tracking.calibration.boards import Board, parse_board
from app.tracking.calibration.corners import find_corners, half_window
from app.tracking.calibration.views import BoardView, Rejection, RejectionReason
from app.tracking.errors import CalibrationError
from app.tracking.simulated.board import BoardRenderer
from tests.tracking.calibration_rig import Rig, small_rig, thesis_rig, usual_rig

CHARUCO = parse_board("charuco:9x7:20mm:15mm:DICT_5X5_100")


def facing(board: Board, distance: float, turn: tuple[float, float, float]) -> RigidTransform:
    rotation = rotation_exp(np.deg2rad(turn))
    return RigidTransform(rotation, [0.0, 0.0, distance] - rotation @ board.points.mean(axis=0))


def seen(rig: Rig, T: RigidTransform, **picture: float) -> BoardView | Rejection:
    image = BoardRenderer(rig.left, rig.board, 2).render(T, **picture)
    return find_corners(image, rig.board)


def errors(rig: Rig, view: BoardView | Rejection, T: RigidTransform) -> np.ndarray:
    """Distances to the truth [px], in whichever way round the board may lie."""
    assert isinstance(view, BoardView), view
    uv, _ = rig.left.project(T @ rig.board.points)
    ways = [np.linalg.norm(view.pixels - uv[order[view.ids]], axis=1) for order in rig.board.orders]
    return min(ways, key=lambda way: float(way.max()))


@pytest.mark.parametrize("turn", [(0, 0, 0), (35, -20, 10), (-10, 40, 95), (5, 5, 180)])
def test_corners_are_found_to_a_tenth_of_a_pixel_and_numbered_as_printed(turn: tuple) -> None:
    rig = usual_rig()
    T = facing(rig.board, 0.45, turn)
    away = errors(rig, seen(rig, T), T)
    assert np.sqrt((away**2).mean()) < 0.12


@pytest.mark.parametrize("turn", [(0, 51, 0), (0, -51, 20), (30, 45, 0)])
def test_the_thesis_board_is_found_at_the_slant_of_cameras_102_degrees_apart(turn: tuple) -> None:
    rig = thesis_rig()
    T = facing(rig.board, 0.15, turn)
    away = errors(rig, seen(rig, T, blur_px=1.0, noise_grey=4.0), T)
    assert np.sqrt((away**2).mean()) < 0.15


def test_in_a_small_picture_the_window_stays_within_the_squares() -> None:
    rig = small_rig()
    T = facing(rig.board, 0.5, (20, -20, 5))
    image = BoardRenderer(rig.left, rig.board, 3).render(T)
    view = find_corners(image, rig.board)
    assert isinstance(view, BoardView)
    assert 2 * view.window < view.square_px
    wide = find_corners(image, rig.board, window=11)
    ours, usual = (np.sqrt((errors(rig, v, T) ** 2).mean()) for v in (view, wide))
    assert ours < 0.15
    assert usual > 5.0 * ours  # what an 11 px window makes of ten pixel squares


def test_part_of_a_charuco_board_is_enough() -> None:
    rig = replace(usual_rig(), board=CHARUCO)
    T = RigidTransform.from_translation([0.09, -0.03, 0.0]) @ facing(CHARUCO, 0.3, (20, 10, 5))
    view = seen(rig, T)
    away = errors(rig, view, T)
    assert isinstance(view, BoardView)
    assert 6 <= view.ids.size < CHARUCO.count
    assert np.sqrt((away**2).mean()) < 0.2


def test_a_mirrored_charuco_picture_is_named() -> None:
    rig = replace(usual_rig(), board=CHARUCO)
    image = BoardRenderer(rig.left, CHARUCO, 2).render(facing(CHARUCO, 0.35, (10, 10, 0)))
    found = find_corners(image[:, ::-1].copy(), CHARUCO)
    assert isinstance(found, Rejection)
    assert found.reason is RejectionReason.MIRRORED


@pytest.mark.long("statistics")
def test_a_charuco_board_of_other_counts_is_named() -> None:
    rig = replace(usual_rig(), board=CHARUCO)
    image = BoardRenderer(rig.left, CHARUCO, 2).render(facing(CHARUCO, 0.35, (10, 10, 0)))
    found = find_corners(image, parse_board("charuco:6x11:20mm:15mm:DICT_5X5_100"))
    assert isinstance(found, Rejection)
    assert found.reason is RejectionReason.OTHER_BOARD
    inner = find_corners(image, parse_board("charuco:8x6:20mm:15mm:DICT_5X5_100"))
    assert isinstance(inner, Rejection)
    assert "fit charuco:9x7" in inner.text


@pytest.mark.long("statistics")
def test_a_board_larger_than_its_counts_say_is_named() -> None:
    rig = usual_rig()
    image = BoardRenderer(rig.left, rig.board, 2).render(facing(rig.board, 0.45, (20, 10, 5)))
    for counts in ("8x6", "7x5"):
        found = find_corners(image, parse_board(f"checkerboard:{counts}:25mm"))
        assert isinstance(found, Rejection), counts
        assert found.reason in (RejectionReason.OTHER_BOARD, RejectionReason.NO_BOARD)


@pytest.mark.long("statistics")
def test_a_board_on_edge_is_refused_or_not_seen() -> None:
    rig = usual_rig()
    found = seen(rig, facing(rig.board, 0.35, (0, 84, 0)))
    assert isinstance(found, Rejection)
    assert found.reason in (
        RejectionReason.EDGE_ON,
        RejectionReason.TOO_SMALL,
        RejectionReason.NO_BOARD,
        RejectionReason.BLURRED,
    )


@pytest.mark.long("statistics")
def test_the_width_of_the_edges_grows_with_blur_and_a_blurred_picture_is_refused() -> None:
    rig = usual_rig()
    T = facing(rig.board, 0.45, (20, -15, 5))
    widths = []
    for blur in (0.5, 1.5, 2.5):
        view = seen(rig, T, blur_px=blur)
        assert isinstance(view, BoardView)
        widths.append(view.sharpness)
    assert widths == sorted(widths)
    assert widths[2] == pytest.approx(2.56 * 2.5, rel=0.25)  # 10 to 90 % of a Gaussian's step
    blurred = seen(rig, T, blur_px=7.0)
    assert isinstance(blurred, Rejection)
    assert blurred.reason in (RejectionReason.BLURRED, RejectionReason.NO_BOARD)


@pytest.mark.parametrize("grey", [0, 120, 255])
def test_a_picture_without_a_board_is_a_rejection(grey: int) -> None:
    image = np.full((480, 640), grey, np.uint8)
    for board in (usual_rig().board, CHARUCO):
        found = find_corners(image, board)
        assert isinstance(found, Rejection)
        assert found.reason is RejectionReason.NO_BOARD


def test_colour_and_16_bit_pictures_give_the_same_corners() -> None:
    rig = usual_rig()
    image = BoardRenderer(rig.left, rig.board, 2).render(facing(rig.board, 0.45, (10, 10, 0)))
    grey = find_corners(image, rig.board)
    colour = find_corners(cv2.cvtColor(image, cv2.COLOR_GRAY2BGR), rig.board)
    deep = find_corners(image.astype(np.uint16) * 256, rig.board)
    for other in (colour, deep):
        assert isinstance(grey, BoardView)
        assert isinstance(other, BoardView)
        np.testing.assert_allclose(other.pixels, grey.pixels, atol=0.02)


@pytest.mark.parametrize(
    "image", [np.zeros((480, 640)), np.zeros((3, 3), np.uint8), np.zeros((9, 9, 9, 3), np.uint8)]
)
def test_an_array_that_is_no_picture_is_refused(image: np.ndarray) -> None:
    with pytest.raises(CalibrationError, match="is no picture"):
        find_corners(image, CHARUCO)


def test_the_window_follows_from_the_square_and_from_the_width_of_its_edges() -> None:
    board = usual_rig().board
    assert half_window(board, 30.0, 2.6) == 10  # sharp: a third of the square, as before
    assert half_window(board, 14.0, 4.6) == 6  # blurred: 1.5 edges
    assert half_window(board, 10.0, 4.6) == 5  # and never beyond half the square
    assert half_window(board, 80.0, 2.0) == 11
    assert half_window(CHARUCO, 40.0, 4.0) == 5  # no more than the white around the markers


@pytest.mark.long("statistics")
@pytest.mark.parametrize(("blur", "noise"), [(1.6, 8.0), (1.65, 2.0)])
def test_blurred_edges_on_small_squares_get_a_window_that_holds_them(
    blur: float, noise: float
) -> None:
    rig = usual_rig()
    ours, third = [], []
    for turn in ((10, 5, 5), (-20, 10, -15), (15, -25, 10)):
        T = facing(rig.board, 0.82, turn)
        image = BoardRenderer(rig.left, rig.board, 3).render(T, blur, noise)
        view, as_before = find_corners(image, rig.board), find_corners(image, rig.board, window=4)
        assert isinstance(view, BoardView)
        assert 12.0 < view.square_px < 17.0
        assert view.sharpness > 4.0
        ours.append(errors(rig, view, T))
        third.append(errors(rig, as_before, T))
    was, now = (np.sqrt(np.mean(np.concatenate(one) ** 2)) for one in (third, ours))
    assert now < 0.7 * was
    assert now < 0.3
