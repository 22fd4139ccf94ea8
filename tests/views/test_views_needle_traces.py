"""The needle's planes in the patient views: thin lines where they cut, and what the panes say."""

import numpy as np
import pytest

from app.planning.draft import DraftPlan
from app.planning.needle_overlay import NeedleOverlay
from app.views.slices.needle_source import Along, NeedlePlanes, fill_needle_menu
from app.views.slices.pane import SlicePane
from app.views.slices.panes import MPR_PANES, NEEDLE_PANES, PaneId
from app.views.slices.presets import default_window
from app.views.slices.readouts import needle_slice_words
from app.views.slices.viewing import Viewing


@pytest.fixture
def viewing(application, volume):
    viewing = Viewing(default_window())
    viewing.set_volume(volume)
    yield viewing
    viewing.pictures.close()


@pytest.fixture
def planes(viewing):
    planes = NeedlePlanes(viewing)
    planes.set_watched(True)
    viewing.set_seen(NEEDLE_PANES)
    return planes


@pytest.fixture(params=MPR_PANES, ids=str)
def pane(request, viewing, planes, destroy):
    pane = SlicePane(viewing, request.param)
    destroy(pane)
    pane.resize(400, 300)
    pane.canvas.show_volume()
    return pane


def oblique_needle(viewing):
    axis = np.array([0.5, 0.7, 0.4]) / np.linalg.norm([0.5, 0.7, 0.4])
    return NeedleOverlay(viewing.cursor_mm - 90.0 * axis, viewing.cursor_mm + 2.0 * axis)


def drawn(pane):
    pane.canvas.flush()
    return {name: line for name, line in pane.canvas.layers.traces.lines.items()
            if line.isVisible()}  # fmt: skip


def test_each_line_lies_in_both_planes(viewing, planes, pane):
    viewing.set_needle(oblique_needle(viewing))
    lines = drawn(pane)
    assert lines
    plane, index = pane.canvas.plane, pane.canvas.index
    for name, line in lines.items():
        for start, end in line.lines:
            for place in (start, end):
                point = plane.lps_mm(place.x(), place.y(), index)
                assert abs(viewing.frame(name).point(point)[2]) < 1e-6


def test_only_seen_panes_show_their_line_and_all_can_be_switched_off(viewing, planes, pane):
    viewing.set_needle(oblique_needle(viewing))
    everything = set(drawn(pane))
    viewing.set_seen([PaneId.PROBE])
    assert set(drawn(pane)) == everything & {PaneId.PROBE}
    viewing.set_seen(NEEDLE_PANES)
    viewing.set_shows_traces(False)
    assert not drawn(pane)
    viewing.set_shows_traces(True)
    assert set(drawn(pane)) == everything


def test_without_a_needle_there_are_no_lines(viewing, planes, pane):
    viewing.set_needle(oblique_needle(viewing))
    assert drawn(pane)
    viewing.set_needle(None)
    assert not drawn(pane)


def test_a_plane_that_is_nearly_the_slice_has_no_line(viewing, planes, pane):
    """Its line would run about the picture with every tremor of the hand."""
    tip = viewing.cursor_mm
    for tilt in np.radians([0.0, 1.0, 5.0]):
        axis = np.array([0.0, np.cos(tilt), np.sin(tilt)])
        viewing.set_needle(NeedleOverlay(tip - 90.0 * axis, tip))
        shown = drawn(pane)
        for name in NEEDLE_PANES:
            near = abs(viewing.frame(name).normal @ pane.canvas.plane.frame(0.0).normal)
            assert (name in shown) == (near < np.cos(np.radians(10.0)))


def test_the_menu_switches_the_lines(viewing, planes, pane):
    pane.menu_parts.append(lambda menu: fill_needle_menu(menu, planes, viewing))
    entry = next(one for one in pane.build_menu().actions() if "patient views" in one.text())
    assert entry.isChecked()
    entry.trigger()
    assert not viewing.shows_traces


def test_a_pane_along_the_path_speaks_of_the_target_not_of_a_tip(viewing, planes):
    middle = viewing.cursor_mm
    viewing.set_draft(DraftPlan(tuple(middle - [0.0, 15.0, 0.0]), tuple(middle + [3.0, 5.0, 0.0])))
    assert planes.laid_along is Along.PATH
    probe, beside = viewing.plane(PaneId.PROBE), viewing.plane(PaneId.IN_PLANE)
    assert needle_slice_words(probe, 0.0, planes.laid_along) == "at the target"
    ahead = needle_slice_words(probe, 6.0 / probe.step_mm, planes.laid_along)
    assert ahead == "6 mm ahead of the target"
    assert needle_slice_words(beside, 0.0, planes.laid_along) == "through the path"
    planes.hold()
    viewing.set_needle(oblique_needle(viewing))
    assert planes.laid_along is Along.PATH  # held: it is still the path that is shown
    planes.follow_needle()
    assert planes.laid_along is Along.NEEDLE
    planes.show_points(middle, middle + [9.0, 1.0, 0.0], (0.0, 0.0, 1.0))
    assert needle_slice_words(viewing.plane(PaneId.PROBE), 0.0, planes.laid_along) == (
        "at the 2nd point"
    )
