"""Tiles of a control scan against the patient's geometry, whichever way the CT's files run.

A landmark is put into the CT at a place of the patient, and looked for among the painted pixels.
Directions of rows and columns are those of DICOM PS3.3, C.7.6.2 (Image Orientation (Patient)); the
axes are the patient's: x to his left, y to his back, z to his head.
"""

import numpy as np
import pytest
from conftest import series_of
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from app.imaging.scan_order import ScanOrder
from app.imaging.scanned import scan_image
from app.imaging.volume import Volume
from app.imaging.window import WindowLevel
from app.planning.draft import DraftPlan
from app.views.exercise.scan_wall import ScanPicture, ScanWall

WAYS = {
    "head first supine": (1, 0, 0, 0, 1, 0),
    "head first prone": (-1, 0, 0, 0, -1, 0),
    "feet first supine": (-1, 0, 0, 0, 1, 0),
    "feet first prone": (1, 0, 0, 0, -1, 0),
    "lying on the right side": (0, -1, 0, 1, 0, 0),
}
MIDDLE = np.array([5.0, -8.0, 130.0])
MARK = MIDDLE + (14.0, -10.0, 10.0)
"""To the patient's left, in front of the middle, towards the head [mm]."""
STEP = (1.0, 1.0, 2.0)


def patient_of(way: tuple[int, ...]) -> Volume:
    """Water about `MIDDLE` and a ball of bone at `MARK`, in a CT whose files run another way."""
    row, column = np.array(way[:3], float), np.array(way[3:], float)
    turned = np.column_stack([row, column, np.cross(row, column)]) * STEP
    size = np.array([96, 96, 40])
    corner = MIDDLE - turned @ (0.5 * (size - 1.0))
    indices = np.indices(size[::-1]).reshape(3, -1)[::-1]
    places = (turned @ indices).T + corner
    near = np.linalg.norm(places - MARK, axis=1) < 4.0
    hu = np.where(near, 900, 0).astype(np.int16).reshape(size[::-1])
    affine = np.eye(4)
    affine[:3, :3], affine[:3, 3] = turned, corner
    return Volume(hu, affine, series_of(hu))


@pytest.fixture
def shown(application, destroy):
    """Return the tiles of a scan of a patient, from the left, painted."""

    def show(volume):
        wall = ScanWall()
        destroy(wall)
        wall.resize(900, 500)
        wall.set_window(WindowLevel(400.0, 40.0))
        ends = (MIDDLE - (20.0, 20.0, 0.0), MIDDLE + (20.0, 20.0, 0.0))
        wall.look_at(DraftPlan(*(tuple(end.tolist()) for end in ends)))
        wall.add(ScanPicture(scan_image(volume, ScanOrder(MIDDLE[2], 5, 5.0)), "scan"))
        wall.show()
        QApplication.processEvents()
        return wall.tiles[0]

    return show


def grey(tile) -> np.ndarray:
    """Pixels of a tile as they are painted, shape (rows, columns)."""
    image = tile.grab().toImage().convertToFormat(QImage.Format.Format_Grayscale8)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return rows[:, : image.width()].copy()


def white(tile) -> np.ndarray:
    """Columns and rows of what is white about the middle, where no words stand, shape (n, 2)."""
    seen = grey(tile)
    edge = np.array(seen.shape) // 5
    inner = np.zeros(seen.shape, bool)
    inner[edge[0] : -edge[0], edge[1] : -edge[1]] = True
    return np.argwhere(inner & (seen > 200))[:, ::-1].astype(float)


@pytest.mark.parametrize("way", WAYS)
def test_what_lies_to_the_left_and_in_front_is_painted_at_the_letters_l_and_a(shown, way):
    tiles = shown(patient_of(WAYS[way]))
    assert len(tiles) == 3
    marked = [tile for tile in tiles if len(white(tile)) > 20]
    assert marked == list(tiles[:1]), "the head is on the left, and the mark is there alone"
    tile = marked[0]
    left, right, top, bottom = (one.text() for one in tile.readouts.letters)
    assert (left, right, top, bottom) == ("R", "L", "A", "P")
    middle = 0.5 * np.array([tile.width(), tile.height()])
    scale = min(tile.width(), tile.height()) / 100.0  # the path, and 30 mm on every side
    expected = middle + scale * (MARK - MIDDLE)[:2]
    assert white(tile).mean(axis=0) == pytest.approx(expected, abs=0.7 * scale)


@pytest.mark.parametrize("way", ["head first supine", "feet first prone"])
def test_a_tile_says_where_along_the_patient_it_lies(shown, way):
    heights = [130.0 + 5.0 * n for n in (1, 0, -1)]
    words = [tile.words for tile in shown(patient_of(WAYS[way]))]
    for said, height in zip(words, heights, strict=True):
        assert f"{height:.0f}" in said


def test_the_bar_of_a_tile_is_as_long_as_it_says(shown):
    tile = shown(patient_of(WAYS["head first supine"]))[0]
    number, unit = tile.readouts.ruler.text().split()
    length_mm = float(number) * {"mm": 1.0, "cm": 10.0}[unit]
    box = tile.readouts.ruler.geometry()
    part = grey(tile)[box.top() : box.bottom() + 1, box.left() : box.right() + 1]
    bright = (part > 180).astype(int)
    longest = max(
        (len(run) for row in bright for run in "".join(map(str, row)).split("0")), default=0
    )
    assert longest * 100.0 / min(tile.width(), tile.height()) == pytest.approx(length_mm, rel=0.1)


def test_beside_a_slice_stands_the_one_of_the_same_place_of_the_scan_before(shown, destroy):
    volume = patient_of(WAYS["feet first supine"])
    wall = ScanWall()
    destroy(wall)
    wall.resize(900, 700)
    for centre in (130.0, 135.0):  # the second lies one slice further up
        picture = scan_image(volume, ScanOrder(centre, 5, 5.0))
        wall.add(ScanPicture(picture, f"at {centre}"))
    above, below = wall.tiles
    assert [tile.words for tile in above] == [tile.words for tile in below]
    assert all(tile.words for tile in above)


def test_a_click_opens_the_slice_that_was_clicked(shown, application):
    tiles = shown(patient_of(WAYS["head first supine"]))
    wall, opened = tiles[0].parentWidget(), []
    wall.slice_wanted.connect(opened.append)
    for tile in tiles:
        QTest.mouseClick(tile, Qt.MouseButton.LeftButton)
    assert opened == [3, 2, 1], "the head is on the left, and slices are counted from the feet"
