"""The needle's panes: what they follow, how they are drawn, and what they cost unseen."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from app.planning.draft import DraftPlan
from app.planning.needle_overlay import NeedleOverlay
from app.views.slices.layers import FADED, FAINTEST, fading
from app.views.slices.needle_source import Along, NeedlePlanes, fill_needle_menu
from app.views.slices.pane import SlicePane
from app.views.slices.panes import NEEDLE_PANES, PaneId
from app.views.slices.presets import default_window
from app.views.slices.readouts import needle_slice_words
from app.views.slices.two_points import TwoPoints
from app.views.slices.viewing import Tool, Viewing


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
    return planes


@pytest.fixture
def pane(viewing, planes, settle, destroy):
    pane = SlicePane(viewing, PaneId.IN_PLANE)
    destroy(pane)
    pane.resize(400, 300)
    pane.show()
    settle()
    return pane


def needle_at(viewing, offset=(0.0, 0.0, 0.0), axis=(0.0, 1.0, 0.0), valid=True):
    tip = viewing.cursor_mm + np.asarray(offset)
    axis = np.asarray(axis) / np.linalg.norm(axis)
    return NeedleOverlay(tip - 100.0 * axis, tip, valid)


def plan(viewing):
    middle = viewing.cursor_mm
    return DraftPlan(tuple(middle - [0.0, 15.0, 0.0]), tuple(middle + [3.0, 5.0, 0.0]))


def test_without_needle_and_path_there_is_no_plane(viewing, planes):
    assert all(viewing.plane(pane) is None for pane in NEEDLE_PANES)


def test_without_a_needle_the_planned_path_is_shown(viewing, planes):
    draft = plan(viewing)
    viewing.set_draft(draft)
    assert planes.shows_path
    for end in (draft.entry_mm, draft.target_mm):
        for pane in (PaneId.IN_PLANE, PaneId.IN_PLANE_90):
            assert viewing.plane(pane).point(end, 0.0).distance == pytest.approx(0.0, abs=1e-9)
    assert viewing.plane(PaneId.PROBE).point(draft.target_mm, 0.0).distance == pytest.approx(0.0)


def test_the_planes_follow_the_live_needle_beyond_their_dead_band(viewing, planes):
    viewing.set_draft(plan(viewing))
    viewing.set_needle(needle_at(viewing))
    assert not planes.shows_path
    first = viewing.plane(PaneId.PROBE)
    viewing.set_needle(needle_at(viewing, (0.1, 0.0, 0.1)))
    assert viewing.plane(PaneId.PROBE) is first
    viewing.set_needle(needle_at(viewing, (2.0, 0.0, 1.0)))
    assert viewing.plane(PaneId.PROBE) is not first
    assert_allclose(planes.frame.tip_mm, viewing.cursor_mm + [2.0, 0.0, 1.0])


def test_a_pose_that_is_not_measured_leaves_the_planes_where_they_are(viewing, planes):
    viewing.set_needle(needle_at(viewing))
    frame = planes.frame
    viewing.set_needle(needle_at(viewing, (9.0, 0.0, 0.0), valid=False))
    assert planes.frame is frame


def test_held_planes_stay_until_they_follow_again(viewing, planes):
    viewing.set_needle(needle_at(viewing))
    planes.hold()
    frame = planes.frame
    viewing.set_needle(needle_at(viewing, (9.0, 0.0, 0.0)))
    assert planes.frame is frame
    assert planes.words() == "held"
    planes.follow_needle()
    assert_allclose(planes.frame.tip_mm, viewing.cursor_mm + [9.0, 0.0, 0.0])


def test_a_needle_that_is_taken_away_leaves_nothing_behind(viewing, planes):
    """Where control scans guide, no pane may tell where the needle was last seen."""
    viewing.set_needle(needle_at(viewing))
    viewing.set_needle(None)
    assert planes.frame is None
    assert all(viewing.plane(pane) is None for pane in NEEDLE_PANES)


def test_unseen_panes_cost_nothing(viewing, planes, monkeypatch):
    planes.set_watched(False)
    laid = []
    monkeypatch.setattr(viewing, "set_frame", lambda *_: laid.append(1))
    for n in range(10):
        viewing.set_needle(needle_at(viewing, (float(n), 0.0, 0.0)))
    assert not laid
    planes.set_watched(True)
    assert laid


def test_the_picture_comes_at_the_panes_own_pixels(viewing, planes, pane, settle):
    viewing.set_needle(needle_at(viewing, (0.3, 0.2, 0.1), (0.1, 1.0, 0.2)))
    assert settle(lambda: pane.canvas.is_settled)
    feed, canvas = pane.canvas.feed, pane.canvas
    left, top, width, height = feed.bounds_mm
    rows, columns = feed.hu.shape
    assert width / columns == pytest.approx(max(1.0 / canvas.camera.scale, 1.0 / 4.0))
    assert height / rows == pytest.approx(width / columns)
    column, row = columns // 2, rows // 2
    at = left + (column + 0.5) * width / columns, top + (row + 0.5) * height / rows
    expected = viewing.volume.hu_at(canvas.plane.lps_mm(*at, canvas.index))
    assert feed.hu[row, column] == pytest.approx(expected, abs=0.5)


def test_of_many_wishes_only_the_newest_is_drawn(viewing, planes, pane, settle):
    for n in range(50):
        viewing.set_needle(needle_at(viewing, (0.5 * n - 10.0, 0.0, 0.0)))
    assert settle(lambda: pane.canvas.is_settled)
    assert pane.canvas.feed.wish.plane is pane.canvas.plane


def test_the_tip_stays_in_the_middle_of_a_pane_that_follows(viewing, planes, pane):
    for n in range(3):
        viewing.set_needle(needle_at(viewing, (2.0 * n, 1.0, 0.0)))
        at = pane.canvas.plane.point(viewing.needle.tip_mm, 0.0)
        place = pane.canvas.pixel_at(at.x, at.y)
        middle = pane.canvas.rect().center()
        assert abs(place.x() - middle.x()) < 2
        assert abs(place.y() - middle.y()) < 2


def test_ticks_stand_every_ten_millimetres_ahead_of_the_tip(viewing, planes, pane):
    viewing.set_needle(needle_at(viewing))
    pane.canvas.flush()
    ticks = pane.canvas.layers.ticks.item.ticks
    assert len(ticks) >= 5
    tip = pane.canvas.plane.point(viewing.needle.tip_mm, 0.0)
    for number, tick in enumerate(ticks, start=1):
        assert (tick.x() - tip.x, tick.y() - tip.y) == pytest.approx((0.0, 10.0 * number))


def test_the_target_has_its_tolerance_in_true_size(viewing, planes, pane):
    viewing.set_tolerances((6.0, 12.0))
    viewing.set_draft(plan(viewing))
    pane.canvas.flush()
    inner, outer = pane.canvas.layers.disc.rings
    assert inner.isVisible()
    assert outer.isVisible()
    assert inner.boundingRect().width() == pytest.approx(12.0, rel=0.01)
    assert outer.boundingRect().width() == pytest.approx(24.0, rel=0.01)


def test_what_is_off_the_slice_fades_with_its_distance():
    alphas = [fading(distance, 2.0) for distance in (2.0, 10.0, 30.0, 50.0, 200.0)]
    assert alphas[0] == FADED
    assert alphas[-1] == alphas[-2] == FAINTEST
    assert alphas == sorted(alphas, reverse=True)


def test_where_a_slice_of_the_probe_stands_is_said(viewing, planes):
    viewing.set_needle(needle_at(viewing))
    plane = viewing.plane(PaneId.PROBE)
    assert needle_slice_words(plane, 0.0) == "at the tip"
    assert "ahead" in needle_slice_words(plane, 15.0 / plane.step_mm)
    assert "15 mm" in needle_slice_words(plane, 15.0 / plane.step_mm)
    beside = viewing.plane(PaneId.IN_PLANE)
    assert "mm S" in needle_slice_words(beside, 5.0)


def test_two_clicked_points_give_a_plane_without_any_needle(viewing, planes):
    source = TwoPoints(viewing, planes, planes)
    viewing.set_tool(Tool.PLANE)
    viewing.clicked_pane = PaneId.AXIAL
    a, b = viewing.cursor_mm + [0.0, 2.0, 0.0], viewing.cursor_mm + [8.0, 5.0, 0.0]
    viewing.point_placed.emit(Tool.PLANE, tuple(a), True)
    assert viewing.point_refused  # the tool stays for the second point
    assert planes.frame is None
    viewing.point_placed.emit(Tool.PLANE, tuple(b + 3.0), True)
    viewing.point_placed.emit(Tool.PLANE, tuple(b), False)
    assert planes.along is Along.POINTS
    plane = viewing.plane(PaneId.IN_PLANE)
    for point in (a, b, b + [0.0, 0.0, 7.0]):
        assert plane.point(point, 0.0).distance == pytest.approx(0.0, abs=1e-9)
    planes.follow_needle()
    assert source.points == []


def test_points_on_one_spot_are_refused_in_words(viewing, planes):
    said = []
    planes.refused.connect(said.append)
    planes.show_points(viewing.cursor_mm, viewing.cursor_mm, (0.0, 0.0, 1.0))
    assert "apart" in said[0]


def test_the_menu_offers_what_is_possible(viewing, planes, pane):
    pane.menu_parts.append(lambda menu: fill_needle_menu(menu, planes, viewing))
    entries = {action.text(): action for action in pane.build_menu().actions()}
    assert entries["Follow the needle"].isChecked()
    assert not entries["Hold here"].isEnabled()
    assert not entries["Along the planned path"].isEnabled()
    viewing.set_draft(plan(viewing))
    entries = {action.text(): action for action in pane.build_menu().actions()}
    entries["Along the planned path"].trigger()
    assert planes.along is Along.PATH


def test_in_a_narrow_pane_the_lower_letter_gives_way_to_the_words(viewing, planes, pane, settle):
    viewing.set_needle(needle_at(viewing))
    letter, words = pane.readouts.letters[3], pane.readouts.slice
    pane.resize(600, 300)
    settle(lambda: pane.canvas.is_settled)
    middle = pane.canvas.width() / 2
    assert abs(letter.geometry().center().x() - middle) <= 3  # where there is room
    pane.resize(230, 300)
    settle(lambda: pane.canvas.is_settled)
    assert "through the needle" in words.text()
    assert not letter.geometry().intersects(words.geometry())
    assert pane.canvas.rect().contains(letter.geometry())
    pane.resize(600, 300)
    settle(lambda: pane.canvas.is_settled)
    assert abs(letter.geometry().center().x() - pane.canvas.width() / 2) <= 3
