"""The board on paper: its size, its place, what is refused."""

import re
import shutil
import subprocess
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from PySide6.QtGui import QColor, QImage, QPainter

from app.tracking.calibration.board_layout import PAPERS, lay_out, paper_named
from app.tracking.calibration.boards import DEFAULT_BOARD, dark_rectangles, parse_board
from app.tracking.calibration.corners import find_corners
from app.tracking.calibration.views import BoardView
from app.tracking.errors import CalibrationError
from app.views.cameras.board_page import paint_sheet, write_board

DOTS_PER_MM = 8.0
BOARDS = [
    (DEFAULT_BOARD, "A4"),
    (DEFAULT_BOARD, "Letter"),
    ("charuco:5x7:35mm:26mm:DICT_4X4_50", "A3"),
    ("checkerboard:9x6:20mm", "A4"),
    ("checkerboard:5x8:22mm", "A4"),
]


def painted(spec: str, paper: str) -> NDArray[np.uint8]:
    board = parse_board(spec)
    sheet = lay_out(board, PAPERS[paper])
    width, height = (round(DOTS_PER_MM * side) for side in (sheet.width_mm, sheet.height_mm))
    image = QImage(width, height, QImage.Format.Format_Grayscale8)
    image.fill(QColor("white"))
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    paint_sheet(painter, board, sheet, DOTS_PER_MM)
    painter.end()
    rows = np.frombuffer(image.constBits(), dtype=np.uint8).reshape(height, image.bytesPerLine())
    return rows[:, :width].copy()


def measure(picture: NDArray[np.uint8], spec: str, dots_per_mm: float) -> None:
    """Hold every corner against its place on the sheet [mm]."""
    board = parse_board(spec)
    # A fourth of the dots is a picture like a camera's; the finder is made for those.
    small = cv2.resize(picture, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)
    view = find_corners(small, board)
    assert isinstance(view, BoardView), view
    assert view.ids.size == board.count
    pixels = 2.0 * view.pixels + 0.5  # centres of pixels twice as large
    found = (pixels + 0.5) / dots_per_mm
    expected = board.points[:, :2] * 1e3
    offset = (found - expected).mean(axis=0)
    np.testing.assert_allclose(found, expected + offset, atol=0.05)
    length = np.linalg.norm(found[-1] - found[0]) / np.linalg.norm(expected[-1] - expected[0])
    assert length == pytest.approx(1.0, abs=2e-4)


@pytest.mark.parametrize(("spec", "paper"), BOARDS)
def test_the_printed_board_is_found_at_its_true_size(spec: str, paper: str) -> None:
    measure(painted(spec, paper), spec, DOTS_PER_MM)


@pytest.mark.parametrize(("spec", "paper"), BOARDS[:3])
def test_the_pdf_has_the_papers_size_and_the_boards(tmp_path: Path, spec: str, paper: str) -> None:
    path = tmp_path / "board.pdf"
    sheet = write_board(path, parse_board(spec), PAPERS[paper])
    box = re.search(rb"/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]", path.read_bytes())
    assert box is not None
    size = [float(number) / 72.0 * 25.4 for number in box.groups()]
    assert size == pytest.approx([sheet.width_mm, sheet.height_mm], abs=0.2)  # whole points
    if shutil.which("pdftoppm") is None:
        return  # nothing else on this machine draws a PDF
    subprocess.run(["pdftoppm", "-r", "200", "-gray", str(path), str(tmp_path / "p")], check=True)
    drawn = cv2.imread(str(next(tmp_path.glob("p*.pgm"))), cv2.IMREAD_GRAYSCALE)
    measure(np.asarray(drawn, dtype=np.uint8), spec, 200.0 / 25.4)


def test_the_ruler_is_as_long_as_it_says() -> None:
    picture = painted(DEFAULT_BOARD, "A4")
    sheet = lay_out(parse_board(DEFAULT_BOARD), PAPERS["A4"])
    row = round((sheet.y_mm + sheet.pattern_mm[1] + 10.0) * DOTS_PER_MM)
    dark = np.flatnonzero(picture[row - 1 : row + 1].min(axis=0) < 128)
    assert (dark[-1] + 1 - dark[0]) / DOTS_PER_MM == pytest.approx(100.0, abs=0.35)


def test_a_board_that_does_not_fit_is_refused_and_the_largest_square_named() -> None:
    board = parse_board("charuco:12x9:30mm:22mm:DICT_5X5_100")
    with pytest.raises(CalibrationError, match=r"360 x 270 mm.*A4; squares of at most 19\.5 mm"):
        lay_out(board, PAPERS["A4"])
    with pytest.raises(CalibrationError, match=r"or take A3$"):
        lay_out(parse_board("charuco:12x9:25mm:18mm:DICT_5X5_100"), PAPERS["A4"])
    assert lay_out(parse_board("charuco:12x9:19.5mm:14mm:DICT_5X5_100"), PAPERS["A4"]).landscape
    with pytest.raises(CalibrationError, match="'A5'; there are A4, A3, Letter"):
        paper_named("A5")
    assert paper_named(" a3 ").name == "A3"


def test_a_file_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    (tmp_path / "f").write_text("")
    with pytest.raises(CalibrationError, match="cannot be written"):
        write_board(tmp_path / "f" / "b.pdf", parse_board(DEFAULT_BOARD), PAPERS["A4"])


def test_no_two_black_rectangles_overlap() -> None:
    found = dark_rectangles(parse_board(DEFAULT_BOARD))
    area = float((found[:, 2] * found[:, 3]).sum())
    cells = 9 * 6 * 0.02**2
    assert 0.5 * cells < area < 0.8 * cells
