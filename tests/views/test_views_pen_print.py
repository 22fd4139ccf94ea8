"""The pen's print: what is painted is what the tracker looks for, at true size."""

import numpy as np
import pytest
from PySide6.QtGui import QImage, QPainter

from app.core.errors import AcusError
from app.tracking.calibration.board_layout import PAPERS
from app.tracking.pen.body import load_pen
from app.tracking.pen.detector import MarkerDetector
from app.tracking.pen.net_layout import base_page, body_page
from app.views.pen.net_page import paint_page, write_pen

DOTS = 6.0  # per millimetre


def painted(page):
    width, height = round(page.width * DOTS), round(page.height * DOTS)
    image = QImage(width, height, QImage.Format.Format_RGB888)
    image.fill(0xFFFFFFFF)
    painter = QPainter(image)
    paint_page(painter, page, DOTS)
    painter.end()
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(height, image.bytesPerLine())
    return rows[:, : 3 * width].reshape(height, width, 3).copy()


@pytest.mark.parametrize("name", ["cube", "ring"])
def test_the_printed_net_shows_every_marker_at_its_true_size(application, name):
    pen = load_pen(name)
    page = body_page(pen.body, PAPERS["A4"])
    board = pen.body.board()
    found = MarkerDetector(board.dictionary).find(painted(page), set(range(50)))
    assert {s.id for s in found.markers} == {m.id for m in board.markers}
    for sighting in found.markers:
        edges = np.linalg.norm(np.diff(sighting.corners, axis=0), axis=1) / DOTS
        np.testing.assert_allclose(edges, pen.body.marker_mm, atol=0.05)
        assert sighting.corners[0][0] < sighting.corners[1][0], "upright: up is away from the tip"


def test_sides_that_are_neighbours_on_the_cube_are_neighbours_on_the_net(application):
    pen = load_pen("cube")
    page = body_page(pen.body, PAPERS["A4"])
    sides = [face for face in page.faces if face.id < 4]
    steps = np.diff([face.x for face in sides])
    np.testing.assert_allclose(steps, pen.body.edge_mm)
    top = page.faces[-1]
    assert (top.x, top.y) == (sides[0].x, sides[0].y - pen.body.edge_mm)
    assert len(page.crosses) == 2


def test_the_printed_sheet_has_its_markers_where_the_profile_has_them(application):
    pen = load_pen("cube")
    page = base_page(pen.base, PAPERS["A4"])
    board = pen.base.board()
    found = MarkerDetector(board.dictionary).find(painted(page), set(range(50)))
    assert {s.id for s in found.markers} == {m.id for m in board.markers}
    x, y, _, _ = page.crosses[0]
    for sighting in found.markers:
        centre = (sighting.corners.mean(axis=0) + 0.5) / DOTS
        true = board.find(sighting.id).corners.mean(axis=0) * 1e3
        np.testing.assert_allclose(centre, (x + true[0], y - true[1]), atol=0.1)


def test_the_pdf_has_two_pages_and_paper_that_is_too_small_is_named(application, tmp_path):
    pen = load_pen("cube")
    write_pen(tmp_path / "pen.pdf", pen, PAPERS["A4"])
    data = (tmp_path / "pen.pdf").read_bytes()
    assert data.startswith(b"%PDF")
    assert b"/Count 2" in data
    body = pen.body.model_copy(update={"edge_mm": 90.0, "marker_mm": 60.0})
    with pytest.raises(AcusError, match="does not fit on A4"):
        body_page(body, PAPERS["A4"])
