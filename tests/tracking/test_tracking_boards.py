"""Boards as values and as lines of text."""

import numpy as np
import pytest

from app.tracking.calibration.boards import BoardKind, parse_board
from app.tracking.errors import CalibrationError


@pytest.mark.parametrize(
    "spec",
    ["checkerboard:9x6:25mm", "checkerboard:5x7:5mm", "charuco:9x6:20mm:15mm:DICT_5X5_100"],
)
def test_a_board_reads_the_line_it_writes(spec: str) -> None:
    assert parse_board(spec).spec == spec


def test_a_checkerboard_counts_inner_corners_and_charuco_counts_squares() -> None:
    checkerboard = parse_board("checkerboard:9x6:2.5cm")
    assert (checkerboard.count, checkerboard.square) == (54, pytest.approx(0.025))
    np.testing.assert_allclose(checkerboard.points[10], [0.025, 0.025, 0.0])
    charuco = parse_board("charuco:9x6:0.02m:15mm:5x5_100")
    assert (charuco.kind, charuco.columns, charuco.rows) == (BoardKind.CHARUCO, 8, 5)


@pytest.mark.parametrize(
    ("spec", "orders"),
    [
        ("checkerboard:9x6:25mm", 1),
        ("checkerboard:5x7:5mm", 2),
        ("checkerboard:8x6:5mm", 2),
        ("checkerboard:6x6:5mm", 4),
        ("checkerboard:7x7:5mm", 2),
        ("charuco:6x8:20mm:15mm:DICT_5X5_100", 1),
    ],
)
def test_a_board_knows_in_how_many_ways_it_may_lie(spec: str, orders: int) -> None:
    board = parse_board(spec)
    assert len(board.orders) == orders
    assert board.ambiguous is (orders > 1)
    for order in board.orders:  # a turn of the print, never a mirror image
        moved = board.points[order, :2]
        first, across, down = moved[0], moved[1], moved[board.columns]
        assert np.linalg.det([across - first, down - first]) > 0.0


@pytest.mark.parametrize(
    ("spec", "words"),
    [
        ("9x6:25mm", "checkerboard:COLSxROWS:SQUARE"),
        ("checkerboard:9x6:25", "with its unit"),
        ("checkerboard:9by6:25mm", "COLSxROWS"),
        ("checkerboard:1x6:25mm", "at least 2x2"),
        ("checkerboard:9x6:0mm", "0.1 mm"),
        ("checkerboard:9x6:25mm:15mm", "checkerboard:COLSxROWS:SQUARE"),
        ("charuco:9x6:20mm:25mm:DICT_5X5_100", "must be smaller"),
        ("charuco:9x6:20mm:15mm:DICT_9X9_100", "DICT_5X5_100"),
        ("charuco:20x20:20mm:15mm:DICT_4X4_50", "larger dictionary"),
    ],
)
def test_a_line_that_is_no_board_is_refused_with_what_to_write(spec: str, words: str) -> None:
    with pytest.raises(CalibrationError, match=words):
        parse_board(spec)
