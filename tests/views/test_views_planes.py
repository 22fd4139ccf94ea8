"""Planes of any direction in the panes: places, scrolling, traces, added layers and grips."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent

from app.imaging.orthogonal import View
from app.imaging.reformat import Frame
from app.views.plan.editor import PlanEditor
from app.views.slices.crosshair import CrossLine
from app.views.slices.pane import SlicePane
from app.views.slices.panes import MPR_PANES, PaneId, others
from app.views.slices.plane import own_plane, reformat_plane
from app.views.slices.presets import default_window
from app.views.slices.slab import chord, crossing
from app.views.slices.turning import LineGrip, StartingPlanes, is_turned, straighten, turn_planes
from app.views.slices.viewing import Tool, Viewing

TILT = np.radians(20.0)


@pytest.fixture
def viewing(application, volume):
    viewing = Viewing(default_window())
    viewing.set_volume(volume)
    return viewing


@pytest.fixture
def make_pane(viewing, volume, settle, destroy):
    def make(pane):
        made = SlicePane(viewing, pane)
        destroy(made)
        made.resize(400, 300)
        made.show()
        made.canvas.show_volume()
        settle()
        return made

    return make


def tilted(viewing, pane=PaneId.CORONAL):
    return viewing.plane(pane).frame(0.0).turned([0.0, 0.0, 1.0], TILT, viewing.cursor_mm)


@pytest.mark.parametrize("view", list(View))
def test_a_reformat_along_the_volumes_axes_equals_its_slices(viewing, volume, view):
    straight = own_plane(viewing.slicer, view)
    plane = reformat_plane(volume, straight.frame(0.0), PaneId(view), straight.ahead)
    for index in (0, 3, straight.count - 1):
        point = straight.lps_mm(11.0, 7.0, index)
        at = plane.point(point, plane.index_at(point))
        assert_allclose((at.x, at.y, at.distance), (11.0, 7.0, 0.0), atol=1e-9)
        width, height = viewing.slicer.pixel_size_mm(view)
        rows, columns = straight.image(index).shape
        if width == height:
            picture = plane.pixels(plane.index_at(point), (0.0, 0.0), width, columns, rows)
            assert_allclose(picture, straight.image(index), atol=1e-3)
    assert plane.letters() == straight.letters()
    assert plane.towards(1.0) == straight.towards(1.0)


def test_a_turned_plane_keeps_the_crosshair_where_it_is(viewing):
    before = viewing.plane(PaneId.CORONAL).point(viewing.cursor_mm, 0.0)
    viewing.set_frame(PaneId.CORONAL, tilted(viewing))
    after = viewing.plane(PaneId.CORONAL).point(viewing.cursor_mm, 0.0)
    assert_allclose((after.x, after.y), (before.x, before.y), atol=1e-9)


def test_scrolling_a_turned_plane_moves_the_crosshair_along_its_normal(viewing, volume):
    viewing.set_frame(PaneId.CORONAL, tilted(viewing))
    plane, start = viewing.plane(PaneId.CORONAL), viewing.cursor_mm
    index = viewing.index(PaneId.CORONAL)
    viewing.show_slice(PaneId.CORONAL, index + 2)
    assert viewing.index(PaneId.CORONAL) == pytest.approx(index + 2)
    assert_allclose(viewing.cursor_mm, start + 2 * plane.step_mm * plane.ahead, atol=1e-9)
    for end in (-1e9, 1e9):
        viewing.show_slice(PaneId.CORONAL, end)
        assert volume.contains(viewing.cursor_mm)


def test_going_back_shows_the_volumes_own_slices(viewing):
    viewing.set_frame(PaneId.AXIAL, tilted(viewing, PaneId.AXIAL))
    assert not viewing.plane(PaneId.AXIAL).is_native
    viewing.set_frame(PaneId.AXIAL, None)
    assert viewing.plane(PaneId.AXIAL).is_native


def test_a_needle_pane_stands_off_its_own_plane(viewing, make_pane):
    pane = make_pane(PaneId.PROBE)
    assert pane.canvas.plane is None
    frame = Frame(viewing.cursor_mm, np.eye(3)[0], np.eye(3)[1])
    viewing.set_frame(PaneId.PROBE, frame)
    assert pane.canvas.plane is not None
    cursor = viewing.cursor_mm
    viewing.show_slice(PaneId.PROBE, 2)
    assert viewing.index(PaneId.PROBE) == 2
    assert_allclose(viewing.cursor_mm, cursor)
    assert viewing.frame(PaneId.PROBE).point(cursor)[2] == pytest.approx(-2 * 2.0)
    viewing.set_frame(PaneId.PROBE, None)
    assert pane.canvas.plane is None
    assert not pane.grab().isNull()


def test_the_crosshair_turns_with_the_other_plane(viewing, make_pane):
    pane = make_pane(PaneId.AXIAL)
    lines = [i for i in pane.canvas.drawing.shapes if isinstance(i, CrossLine) and i.isVisible()]
    assert len(lines) == 2
    rects = sorted((line.boundingRect() for line in lines), key=lambda rect: rect.width())
    assert rects[0].width() < 2.0 < rects[0].height()
    viewing.set_frame(PaneId.CORONAL, tilted(viewing))
    pane.canvas.flush()
    frame = viewing.frame(PaneId.CORONAL)
    line = pane.canvas.layers.crosshair._lines[PaneId.CORONAL]
    start, end = line.lines[0]
    run, fall = end.x() - start.x(), end.y() - start.y()
    assert abs(np.arctan(fall / run)) == pytest.approx(TILT, abs=1e-6)
    plane = pane.canvas.plane
    for point in (start, end):
        offset = frame.point(plane.lps_mm(point.x(), point.y(), pane.canvas.index))[2]
        assert abs(offset) < 1e-6


@pytest.mark.parametrize("pane", MPR_PANES)
def test_each_pane_shows_the_two_others(pane):
    assert pane not in others(pane)
    assert len(set(others(pane))) == 2


def test_a_chord_ends_at_the_rectangle():
    assert chord((1.0, 1.0), (1.0, 0.0), (0.0, 0.0, 4.0, 2.0)) == (-1.0, 3.0)
    first, last = chord((1.0, 5.0), (1.0, 0.0), (0.0, 0.0, 4.0, 2.0))
    assert first > last
    assert crossing((0, 0, 1, 0), (2, 3, 0, 1)) == (2, 0)
    assert crossing((0, 0, 1, 0), (2, 3, 1, 0)) is None


class RecordingLayer:
    def __init__(self):
        self.placed, self.hidden = [], 0

    def place(self, plane, index, scale):
        self.placed.append((plane.pane, index, scale))

    def hide(self):
        self.hidden += 1


def test_an_added_layer_is_placed_with_every_slice_and_zoom(viewing, make_pane):
    pane, layer = make_pane(PaneId.AXIAL), RecordingLayer()
    pane.canvas.add_layer(layer)
    pane.canvas.flush()
    assert len(layer.placed) == 1
    viewing.show_slice(PaneId.AXIAL, 1)
    pane.canvas.flush()
    assert layer.placed[-1][:2] == (PaneId.AXIAL, 1.0)
    pane.canvas.set_camera(pane.canvas.camera.zoomed(2.0, 0.0, 0.0))
    pane.canvas.flush()
    assert layer.placed[-1][2] == pane.canvas.camera.scale
    count = len(layer.placed)
    pane.canvas.refresh()
    pane.canvas.refresh()
    pane.canvas.flush()
    assert len(layer.placed) == count + 1


class RecordingGrip:
    def __init__(self, takes):
        self.takes, self.events = takes, []

    def grab(self, position, event):
        self.events.append("grab")
        return self.takes

    def drag(self, position):
        self.events.append("drag")

    def drop(self, position):
        self.events.append("drop")

    def hover(self, position):
        return self.takes


@pytest.mark.parametrize("takes", [True, False])
def test_a_grip_has_the_left_button_only_if_it_takes_hold(viewing, make_pane, takes):
    pane, grip = make_pane(PaneId.AXIAL), RecordingGrip(takes)
    pane.gestures.add_grip(grip)
    before = viewing.window
    kinds = (QEvent.Type.MouseButtonPress, QEvent.Type.MouseMove, QEvent.Type.MouseButtonRelease)
    handlers = (pane.gestures.press, pane.gestures.move, pane.gestures.release)
    for kind, handler, x in zip(kinds, handlers, (200.0, 240.0, 240.0), strict=True):
        place = QPointF(x, 150.0)
        left = Qt.MouseButton.LeftButton
        handler(QMouseEvent(kind, place, place, left, left, Qt.KeyboardModifier.NoModifier))
    assert grip.events == (["grab", "drag", "drop"] if takes else ["grab"])
    assert (viewing.window == before) is takes


def test_the_plan_takes_no_points_of_other_tools(application):
    editor = PlanEditor()
    editor.place(Tool.NAVIGATE, (1.0, 2.0, 3.0), True)
    assert editor.edit.draft.target_mm is None
    assert not editor.can_undo


# --- turning by the lines ---------------------------------------------------------------------


@pytest.fixture
def axial(make_pane):
    pane = make_pane(PaneId.AXIAL)
    pane.gestures.add_grip(LineGrip(pane.canvas))
    return pane


def drag_line(pane, angle, radius=120.0, start=0.0):
    """Drag the flat line round the crosshair by an angle on the screen [rad]."""
    canvas = pane.canvas
    at = canvas.plane.point(canvas.viewing.cursor_mm, canvas.index)
    middle = canvas.pixel_at(at.x, at.y)

    def place(turn):
        return middle + QPointF(radius * np.cos(turn), radius * np.sin(turn))

    left, none = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    kinds = (QEvent.Type.MouseButtonPress, QEvent.Type.MouseMove, QEvent.Type.MouseButtonRelease)
    handlers = (pane.gestures.press, pane.gestures.move, pane.gestures.release)
    for kind, handler, turn in zip(kinds, handlers, (start, angle, angle), strict=True):
        handler(QMouseEvent(kind, place(turn), place(turn), left, left, none))


def normals(viewing):
    return np.stack([viewing.frame(pane).normal for pane in MPR_PANES])


def test_dragging_a_line_turns_the_two_other_planes_about_the_crosshair(viewing, axial):
    before, cursor, window = normals(viewing), viewing.cursor_mm, viewing.window
    drag_line(axial, TILT)
    after = normals(viewing)
    assert_allclose(after[0], before[0], atol=1e-12)
    assert_allclose(np.abs(after @ after.T), np.eye(3), atol=1e-9)
    assert after[2] @ before[2] == pytest.approx(np.cos(TILT), abs=1e-6)
    assert_allclose(viewing.cursor_mm, cursor)
    assert viewing.window == window
    # the coronal plane now lies where the mouse went: clockwise on the screen
    frame, plane = viewing.frame(PaneId.CORONAL), axial.canvas.plane
    at = plane.point(cursor, axial.canvas.index)
    on_line = plane.lps_mm(
        at.x + 20.0 * np.cos(TILT), at.y + 20.0 * np.sin(TILT), axial.canvas.index
    )
    assert abs(frame.point(on_line)[2] - frame.point(cursor)[2]) < 1e-6


def test_every_order_of_turns_leaves_the_planes_at_right_angles(viewing, make_pane):
    panes = [make_pane(pane) for pane in MPR_PANES]
    for pane in panes:
        pane.gestures.add_grip(LineGrip(pane.canvas))
    for number, angle in enumerate((0.4, -0.3, 1.1, 0.2, -0.9, 0.5)):
        pane = panes[number % 3]
        start = StartingPlanes.of(viewing, others(pane.pane))
        turn_planes(viewing, start, viewing.frame(pane.pane).normal, angle)
    after = normals(viewing)
    assert_allclose(np.abs(after @ after.T), np.eye(3), atol=1e-9)
    assert is_turned(viewing)
    straighten(viewing)
    assert not is_turned(viewing)
    assert_allclose(np.abs(normals(viewing) @ normals(viewing).T), np.eye(3), atol=1e-9)


def test_a_line_that_is_put_back_shows_the_volumes_own_slices(viewing, axial):
    drag_line(axial, 0.005)
    assert not is_turned(viewing)


def test_near_the_crosshair_and_beside_the_lines_the_left_button_sets_the_window(viewing, axial):
    drag_line(axial, 0.5, radius=20.0)
    assert not is_turned(viewing)
    drag_line(axial, 1.2, start=0.7)
    assert not is_turned(viewing)


def test_a_tool_goes_before_the_lines(viewing, axial):
    viewing.set_tool(Tool.TARGET)
    drag_line(axial, TILT)
    assert not is_turned(viewing)


def test_the_crosshair_stays_at_its_pixel_while_its_pane_turns(viewing, make_pane, settle):
    pane = make_pane(PaneId.CORONAL)

    def pixel():
        at = pane.canvas.plane.point(viewing.cursor_mm, pane.canvas.index)
        return pane.canvas.pixel_at(at.x, at.y)

    before = pixel()
    start = StartingPlanes.of(viewing, others(PaneId.AXIAL))
    turn_planes(viewing, start, viewing.frame(PaneId.AXIAL).normal, TILT)
    after = pixel()
    assert (after.x(), after.y()) == pytest.approx((before.x(), before.y()), abs=1e-6)
    assert settle(lambda: pane.canvas.is_settled)
    assert "20° oblique" in pane.readouts.slice.text()
    viewing.pictures.close()
