from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtTest import QSignalSpy

from app.core.errors import NumericalError
from app.imaging.orthogonal import View
from app.imaging.window import PRESETS, WindowLevel
from app.planning.draft import DraftPlan
from app.planning.needle_overlay import NeedleOverlay
from app.views.slices.bindings import OHIF, SLICER
from app.views.slices.camera import SliceCamera, ruler
from app.views.slices.items import MarkItem, SegmentItem
from app.views.slices.pane import SlicePane
from app.views.slices.panes import PaneId
from app.views.slices.pictures import Picture
from app.views.slices.plane import own_plane
from app.views.slices.presets import default_window, keyed_window, menu_windows
from app.views.slices.slab import PlanePoint, pieces
from app.views.slices.viewing import Tool, Viewing

LEFT, MIDDLE, RIGHT = (Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton,
                       Qt.MouseButton.RightButton)  # fmt: skip
NONE = Qt.KeyboardModifier.NoModifier
finite = st.floats(-300.0, 300.0)


@pytest.fixture
def viewing(application, volume):
    viewing = Viewing(default_window())
    viewing.set_volume(volume)
    return viewing


@pytest.fixture
def pane(viewing, volume, settle, destroy):
    pane = SlicePane(viewing, PaneId.AXIAL)
    destroy(pane)
    pane.resize(400, 300)
    pane.show()
    viewing.set_volume(volume)
    settle()
    return pane


def mouse(pane, kind, at, button=LEFT, modifiers=NONE):
    port = pane.canvas
    place = QPointF(*at)
    held = Qt.MouseButton.NoButton if kind is QEvent.Type.MouseButtonRelease else button
    event = QMouseEvent(kind, place, port.mapToGlobal(place), button, held, modifiers)
    handler = {
        QEvent.Type.MouseButtonPress: pane.canvas.mousePressEvent,
        QEvent.Type.MouseMove: pane.canvas.mouseMoveEvent,
        QEvent.Type.MouseButtonRelease: pane.canvas.mouseReleaseEvent,
    }[kind]
    handler(event)


def drag(pane, start, end, button=LEFT, modifiers=NONE):
    mouse(pane, QEvent.Type.MouseButtonPress, start, button, modifiers)
    mouse(pane, QEvent.Type.MouseMove, end, button, modifiers)
    mouse(pane, QEvent.Type.MouseButtonRelease, end, button, modifiers)


def wheel(pane, delta, modifiers=NONE):
    at = QPointF(100.0, 100.0)
    event = QWheelEvent(at, at, QPoint(), QPoint(0, delta), Qt.MouseButton.NoButton, modifiers,
                        Qt.ScrollPhase.NoScrollPhase, False)  # fmt: skip
    pane.canvas.wheelEvent(event)


def press(pane, key):
    pane.keyPressEvent(QKeyEvent(QEvent.Type.KeyPress, key, NONE))


@given(finite, finite, st.floats(0.1, 50.0), st.floats(0.2, 5.0), finite, finite)
@settings(derandomize=True, deadline=None, max_examples=60)
def test_zooming_keeps_the_point_under_the_mouse(x, y, scale, factor, px, py):
    camera = SliceCamera(x, y, scale)
    zoomed = camera.zoomed(factor, px, py)
    before = ((px - camera.x) * camera.scale, (py - camera.y) * camera.scale)
    after = ((px - zoomed.x) * zoomed.scale, (py - zoomed.y) * zoomed.scale)
    assert_allclose(after, before, atol=1e-6 * (1 + np.abs(before).max()))


def test_a_camera_refuses_what_is_not_finite():
    with pytest.raises(NumericalError, match="camera"):
        SliceCamera(float("nan"), 0.0, 1.0)


@given(st.floats(0.05, 200.0))
@settings(derandomize=True, deadline=None, max_examples=60)
def test_the_ruler_is_round_and_fits(scale):
    length = ruler(scale, 110.0)
    assert length * scale <= 110.0
    mantissa = length / 10.0 ** np.floor(np.log10(length) + 1e-9)
    assert min(abs(mantissa - m) for m in (1.0, 2.0, 5.0)) < 1e-6


@given(*[finite] * 6, st.floats(0.5, 5.0))
@settings(derandomize=True, deadline=None, max_examples=100)
def test_the_pieces_of_a_segment_join_up_and_lie_on_their_side_of_the_slab(x, y, d, u, v, e, half):
    parts = pieces(PlanePoint(x, y, d), PlanePoint(u, v, e), half)
    assert 1 <= len(parts) <= 3
    assert_allclose(parts[0].start, (x, y), atol=1e-6)
    assert_allclose(parts[-1].end, (u, v), atol=1e-6)
    for first, second in pairwise(parts):
        assert first.end == second.start
        assert first.inside != second.inside


def test_a_segment_in_the_slice_is_one_solid_piece():
    parts = pieces(PlanePoint(0, 0, 1.0), PlanePoint(5, 5, -1.0), 2.0)
    assert [part.inside for part in parts] == [True]


@pytest.mark.parametrize("view", list(View))
def test_the_middle_of_a_pixel_is_half_a_pixel_from_its_edge(viewing, view):
    plane = own_plane(viewing.slicer, view)
    point = plane.point(viewing.slicer.to_lps_mm(view, 3, 0, 0), 3)
    width, height = viewing.slicer.pixel_size_mm(view)
    assert_allclose((point.x, point.y, point.distance), (width / 2, height / 2, 0.0), atol=1e-9)


@pytest.mark.parametrize("view", list(View))
def test_plane_and_patient_coordinates_are_inverse_of_each_other(viewing, view):
    plane = own_plane(viewing.slicer, view)
    back = plane.point(plane.lps_mm(12.3, 7.7, 5.0), 5.0)
    assert_allclose((back.x, back.y, back.distance), (12.3, 7.7, 0.0), atol=1e-9)


def test_distance_is_told_with_the_patients_side(viewing):
    plane = own_plane(viewing.slicer, View.AXIAL)
    above = viewing.slicer.to_lps_mm(View.AXIAL, 8, 0, 0)
    assert plane.point(above, 5).distance == pytest.approx(6.0)
    assert plane.towards(6.0) == "S"
    assert plane.towards(-6.0) == "I"


def test_the_wheel_scrolls_one_slice_and_moves_the_crosshair(pane, viewing):
    before, z = pane.canvas.index, viewing.cursor_mm[2]
    wheel(pane, 120)
    assert pane.canvas.index == before + 1
    assert viewing.cursor_mm[2] == pytest.approx(z + 2.0, abs=1.0 + 1e-9)


def test_parts_of_a_wheel_notch_add_up(pane):
    before = pane.canvas.index
    for _ in range(4):
        wheel(pane, 30)
    assert pane.canvas.index == before + 1


def test_scrolling_stops_at_the_ends(pane, viewing):
    press(pane, Qt.Key.Key_End)
    assert pane.canvas.index == viewing.slicer.count(View.AXIAL) - 1
    wheel(pane, 120)
    assert pane.canvas.index == viewing.slicer.count(View.AXIAL) - 1
    press(pane, Qt.Key.Key_Home)
    assert pane.canvas.index == 0
    press(pane, Qt.Key.Key_PageUp)
    assert pane.canvas.index == 10


@pytest.mark.parametrize(("scheme", "sign"), [(OHIF, -1), (SLICER, 1)])
def test_dragging_right_widens_and_the_scheme_says_which_way_raises(pane, viewing, scheme, sign):
    viewing.set_scheme(scheme)
    drag(pane, (200, 150), (230, 130))
    assert viewing.window.width > default_window().width
    assert sign * (viewing.window.level - default_window().level) > 0
    before = viewing.window.level
    viewing.level_reversed = True
    drag(pane, (200, 150), (200, 130))
    assert sign * (viewing.window.level - before) < 0


def test_middle_drag_pans_and_right_drag_zooms(pane):
    start = pane.canvas.camera
    drag(pane, (200, 150), (220, 150), MIDDLE)
    assert pane.canvas.camera.x == pytest.approx(start.x - 20 / start.scale)
    drag(pane, (200, 150), (200, 100), RIGHT)
    assert pane.canvas.camera.scale > start.scale


def test_ctrl_drag_pans_and_ctrl_wheel_zooms(pane):
    start = pane.canvas.camera
    drag(pane, (200, 150), (210, 150), LEFT, Qt.KeyboardModifier.ControlModifier)
    assert pane.canvas.camera.x < start.x
    wheel(pane, 120, Qt.KeyboardModifier.ControlModifier)
    assert pane.canvas.camera.scale > start.scale


def test_a_right_click_in_place_asks_for_the_menu_with_the_files_own_window(pane, viewing):
    spy = QSignalSpy(pane.gestures.menu_wanted)
    pane.gestures.menu_wanted.disconnect(pane.show_menu)
    drag(pane, (200, 150), (201, 150), RIGHT)
    assert spy.count() == 1
    texts = [action.text() for action in pane.build_menu().actions()]
    assert texts[0].startswith("From DICOM  300 / 30")
    assert len(menu_windows(viewing.volume)) == len(PRESETS) + 1


def test_shift_and_move_puts_the_crosshair_under_the_mouse(pane, viewing):
    mouse(pane, QEvent.Type.MouseMove, (150, 120), Qt.MouseButton.NoButton,
          Qt.KeyboardModifier.ShiftModifier)  # fmt: skip
    assert_allclose(viewing.cursor_mm, pane.canvas.lps_at(QPointF(150, 120)), atol=1e-6)


def test_the_crosshair_stays_inside_the_volume(viewing):
    viewing.set_cursor([1e6, -1e6, 0.0])
    assert viewing.volume.contains(viewing.cursor_mm)


def test_a_click_with_the_tool_places_the_point_and_gives_the_tool_back(pane, viewing):
    spy = QSignalSpy(viewing.point_placed)
    viewing.set_tool(Tool.TARGET)
    mouse(pane, QEvent.Type.MouseButtonPress, (180, 140))
    mouse(pane, QEvent.Type.MouseMove, (185, 140))
    mouse(pane, QEvent.Type.MouseButtonRelease, (185, 140))
    assert [spy.at(n)[2] for n in range(spy.count())] == [True, False]
    assert_allclose(spy.at(0)[1], pane.canvas.lps_at(QPointF(180, 140)), atol=1e-9)
    assert viewing.tool is Tool.NAVIGATE


def test_a_mark_is_dragged_by_its_own_middle(pane, viewing):
    target = pane.canvas.lps_at(QPointF(200, 150))
    viewing.set_draft(DraftPlan(target_mm=tuple(target)))
    spy = QSignalSpy(viewing.point_placed)
    drag(pane, (205, 150), (225, 150))
    assert spy.at(0)[0] is Tool.TARGET
    assert_allclose(spy.at(0)[1], pane.canvas.lps_at(QPointF(220, 150)), atol=1e-9)


def test_escape_stops_placing(pane, viewing):
    viewing.set_tool(Tool.ENTRY)
    press(pane, Qt.Key.Key_Escape)
    assert viewing.tool is Tool.NAVIGATE


def test_digits_choose_presets_and_space_goes_back(pane, viewing):
    press(pane, Qt.Key.Key_2)
    assert viewing.window == keyed_window(2) == PRESETS["Lung"]
    press(pane, Qt.Key.Key_Space)
    assert viewing.window == default_window()


def test_letters_and_readouts_come_from_the_geometry(pane, viewing):
    assert [overlay.text() for overlay in pane.readouts.letters] == ["R", "L", "A", "P"]
    assert "CT-TEST" in pane.readouts.title.text()
    assert "W 400  L 40" in pane.readouts.window.text()
    pane.readouts.show_cursor(viewing.cursor_mm)
    assert "700 HU" in pane.readouts.cursor.text()
    pane.readouts.show_cursor(np.array([1e4, 0.0, 0.0]))
    assert "outside" in pane.readouts.cursor.text()


def test_no_readout_is_clipped_in_a_small_pane(pane, settle):
    pane.resize(330, 290)
    settle()
    inside = pane.canvas.rect()
    r = pane.readouts
    shown = (r.title, r.window, r.slice, *r.letters)
    assert all(inside.contains(overlay.geometry()) for overlay in shown)
    assert not r.title.geometry().intersects(r.window.geometry())
    assert inside.contains(r.ruler.geometry())


def test_pixels_are_square_millimetres(pane):
    corner, across, down = (pane.canvas.pixel_at(x, y) for x, y in ((0, 0), (40, 0), (0, 40)))
    assert abs((across.x() - corner.x()) - (down.y() - corner.y())) <= 1


def visible_segments(pane):
    return [i for i in pane.canvas.drawing.shapes if isinstance(i, SegmentItem) and i.isVisible()]


def test_the_needle_is_cut_at_the_slab(pane, viewing):
    middle = viewing.cursor_mm
    viewing.set_needle(NeedleOverlay(middle + [0, 0, 30.0], middle + [0, 0.5, -30.0]))
    pane.canvas.flush()
    assert len(visible_segments(pane)) == 3
    viewing.set_needle(NeedleOverlay(middle + [10, 0, 0], middle))
    pane.canvas.flush()
    assert len(visible_segments(pane)) == 1
    viewing.set_needle(None)
    pane.canvas.flush()
    assert not visible_segments(pane)


def test_setting_the_needle_leaves_the_image_alone(pane, viewing):
    before = pane.canvas.feed.picture
    for n in range(10):
        viewing.set_needle(NeedleOverlay(viewing.cursor_mm + [9.0, n, 0], viewing.cursor_mm))
        pane.canvas.flush()
    assert pane.canvas.feed.picture is before


def test_slices_follow_the_tip_with_a_dead_band(viewing):
    viewing.set_follows_tip(True)
    tip = viewing.cursor_mm + [4.0, 3.0, 6.0]
    viewing.set_needle(NeedleOverlay(tip + [0, -50, 0], tip))
    assert_allclose(viewing.cursor_mm, tip, atol=1e-9)
    viewing.set_needle(NeedleOverlay(tip + [0, -50, 0], tip + 0.1))
    assert_allclose(viewing.cursor_mm, tip, atol=1e-9)
    viewing.set_needle(NeedleOverlay(tip, tip + 5.0, valid=False))
    assert_allclose(viewing.cursor_mm, tip, atol=1e-9)


def test_entry_and_target_are_shown_in_every_view(viewing, destroy):
    panes = [SlicePane(viewing, PaneId(view)) for view in View]
    for pane in panes:
        destroy(pane)
        pane.resize(300, 200)
        pane.canvas.show_volume()
    middle = viewing.cursor_mm
    viewing.set_draft(DraftPlan(tuple(middle - [0, 20, 0]), tuple(middle)))
    for pane in panes:
        pane.canvas.flush()
        marks = [i for i in pane.canvas.drawing.shapes
                 if isinstance(i, MarkItem) and i.isVisible()]  # fmt: skip
        assert len(marks) == 2


def test_an_equal_window_is_not_announced_again(viewing):
    spy = QSignalSpy(viewing.window_changed)
    viewing.set_window(WindowLevel(400, 40))
    assert spy.count() == 0


def test_the_value_under_a_resting_mouse_follows_the_slice(pane, viewing):
    pane.readouts.show_cursor(viewing.cursor_mm)
    before = pane.readouts.cursor.text()
    viewing.show_slice(pane.pane, 0)
    pane.canvas.flush()
    assert "-1000 HU" in pane.readouts.cursor.text()
    assert pane.readouts.cursor.text() != before
    pane.readouts.clear_cursor()
    viewing.show_slice(pane.pane, 3)
    pane.canvas.flush()
    assert pane.readouts.cursor.text() == ""


def test_a_fast_window_drag_makes_grey_values_only_for_what_is_painted(
    pane, viewing, settle, monkeypatch
):
    settle(lambda: pane.canvas.is_settled)
    made, make = [], Picture.of
    monkeypatch.setattr(Picture, "of", lambda wish: made.append(wish.window) or make(wish))
    for width in range(300, 320):
        viewing.set_window(WindowLevel(width, 40))
    assert settle(lambda: pane.canvas.is_settled)
    assert made == [WindowLevel(319, 40)]
    assert pane.canvas.feed.picture.wish.window == made[0]


def test_the_tips_distance_is_left_out_where_the_plans_names_need_the_room(pane, viewing):
    pane.resize(330, 290)
    middle = viewing.cursor_mm
    viewing.set_draft(DraftPlan(tuple(middle - [0, 3.0, 9.0]), tuple(middle)))
    viewing.set_needle(NeedleOverlay(middle - [0, 100.0, 0], middle - [0, 1.0, 9.0]))
    pane.canvas.flush()
    marks = [i for i in pane.canvas.drawing.shapes if isinstance(i, MarkItem) and i.isVisible()]
    rects = [
        mark.label_rect.translated(pane.canvas.pixel_at(mark.x(), mark.y()))
        for mark in marks
        if mark.label_rect is not None
    ]
    assert len(rects) >= 2
    for number, rect in enumerate(rects):
        assert pane.canvas.rect().toRectF().contains(rect)
        assert not any(rect.intersects(other) for other in rects[number + 1 :])
