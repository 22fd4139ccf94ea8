"""Views of a series with gantry tilt: to scale, right-angled, every point where it lies."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from app.imaging.volume import Volume
from app.views.slices.pane import SlicePane
from app.views.slices.panes import MPR_PANES, PaneId
from app.views.slices.presets import default_window
from app.views.slices.viewing import Viewing


@pytest.fixture
def viewing(application, volume):
    affine = np.array(volume.affine_mm)
    affine[:3, 2] += (
        0.25 * np.linalg.norm(affine[:3, 2]) * affine[:3, 1] / np.linalg.norm(affine[:3, 1])
    )
    viewing = Viewing(default_window())
    viewing.set_volume(Volume(volume.hu, affine, volume.series))
    return viewing


def test_only_the_view_that_would_be_sheared_is_interpolated(viewing):
    native = {pane for pane in MPR_PANES if viewing.plane(pane).is_native}
    assert native == {PaneId.AXIAL, PaneId.CORONAL}


@pytest.mark.parametrize("pane", MPR_PANES)
def test_distances_on_the_screen_are_distances_in_the_patient(viewing, pane):
    plane = viewing.plane(pane)
    random = np.random.default_rng(3)
    middle = viewing.cursor_mm
    index = plane.index_at(middle)
    for a, b in random.uniform(-9.0, 9.0, (20, 2, 3)):
        one, other = plane.point(middle + a, index), plane.point(middle + b, index)
        shown = np.array([one.x - other.x, one.y - other.y, one.distance - other.distance])
        assert np.linalg.norm(shown) == pytest.approx(np.linalg.norm(a - b), abs=1e-6)


@pytest.mark.parametrize("pane", MPR_PANES)
def test_a_click_lies_where_the_voxel_under_it_lies(viewing, pane):
    plane, volume = viewing.plane(pane), viewing.volume
    index = plane.index_at(viewing.cursor_mm)
    picture = plane.image(index)
    left, top, width, height = plane.bounds_mm
    rows, columns = picture.shape
    checked = 0
    for row, column in ((rows // 2, columns // 2), (rows // 3, columns // 2)):
        x, y = left + (column + 0.5) * width / columns, top + (row + 0.5) * height / rows
        point = plane.lps_mm(x, y, index)
        at = plane.point(point, index)
        assert_allclose((at.x, at.y, at.distance), (x, y, 0.0), atol=1e-6)
        value = volume.hu_at(point)
        if value is not None:
            assert picture[row, column] == pytest.approx(value, abs=0.5)
            checked += 1
    assert checked


def test_lines_of_the_other_planes_cross_at_the_crosshair(viewing):
    for pane in MPR_PANES:
        distance = viewing.frame(pane).point(viewing.cursor_mm)[2]
        assert distance == pytest.approx(0.0, abs=1e-9)


def test_the_corner_says_what_is_not_as_in_the_files(viewing, volume, destroy, settle):
    pane = SlicePane(viewing, PaneId.AXIAL)
    destroy(pane)
    pane.resize(500, 400)
    pane.show()
    series = replace(volume.series, tilt_deg=14.04, modality="MR")
    tilted, made = viewing.volume, ("resampled from slices 1.7 to 2.3 mm apart to 2 mm",)
    for shown, words in (
        (Volume(tilted.hu, tilted.affine_mm, series), "gantry tilt 14.0°"),
        (Volume(volume.hu, volume.affine_mm, series, made), "≈ resampled from slices"),
        (Volume(volume.hu, volume.affine_mm, series, (), ""), "MR: no Hounsfield units"),
    ):
        viewing.set_volume(shown)
        settle()
        assert words in pane.readouts.title.text()
