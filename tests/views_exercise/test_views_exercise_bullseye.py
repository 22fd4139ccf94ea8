from dataclasses import replace
from itertools import combinations
from math import radians

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, QSizeF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QWidget
from views_exercise_fakes import FakeTrainer, run, snapshot

from app.core import state_vector as sv
from app.core.arrays import angle_between
from app.device.state import DeviceState
from app.session.pad.hand import HandPose
from app.session.pad.readings import hand_pose, needle_line
from app.views.exercise.bullseye import Bullseye
from app.views.exercise.pad_canvas import PadArea, free_corner, is_inside
from app.views.kit import theme


@pytest.fixture
def pad(qt):
    exercise = run(FakeTrainer())
    widget = Bullseye()
    widget.resize(560, 470)
    widget.set_scene(exercise.scene(), interactive=True)
    widget.show_view(needle_line(snapshot()))
    widget.show()
    qt.processEvents()
    yield widget
    widget.close()
    widget.deleteLater()


def wheel(widget, notches, modifiers=Qt.KeyboardModifier.NoModifier):
    at = QPointF(20, 20)
    event = QWheelEvent(
        at, at, QPoint(0, 0), QPoint(0, 120 * notches), Qt.MouseButton.NoButton, modifiers,
        Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    widget.pad.wheelEvent(event)


def test_the_hand_takes_the_needle_without_a_jump(pad):
    view = needle_line(snapshot())
    assert np.allclose(pad.hand.direction, view.direction)
    assert pad.hand.depth == pytest.approx(view.depth)
    assert pad.hand.holds


def test_a_drag_to_the_right_tilts_the_tip_to_the_right_and_release_keeps_it(pad):
    before = pad._hand.tilts.copy()
    QTest.mousePress(pad.pad, Qt.MouseButton.LeftButton, pos=QPoint(100, 100))
    QTest.mouseMove(pad.pad, QPoint(140, 100))
    after = pad._hand.tilts.copy()
    QTest.mouseRelease(pad.pad, Qt.MouseButton.LeftButton, pos=QPoint(140, 100))
    assert after[0] > before[0]
    assert np.allclose(pad._hand.tilts, after)
    QTest.mouseMove(pad.pad, QPoint(40, 40))
    assert np.allclose(pad._hand.tilts, after)


def test_a_drag_moves_the_ghost_by_the_gain_times_the_mouse(pad):
    scene = pad._scene
    pad.source.gain.setCurrentIndex(2)
    before = scene.scale.place(pad._hand.tilts)
    pad.pad.dragged.emit(0.1, -0.05)
    assert np.allclose(scene.scale.place(pad._hand.tilts), np.add(before, (0.1, -0.05)), atol=1e-12)


@pytest.mark.parametrize(
    ("notches", "modifier", "step"),
    [
        (1, Qt.KeyboardModifier.NoModifier, 0.001),
        (-2, Qt.KeyboardModifier.NoModifier, -0.002),
        (1, Qt.KeyboardModifier.ShiftModifier, 0.0002),
    ],
)
def test_the_wheel_moves_a_millimetre_and_with_shift_a_fifth(pad, notches, modifier, step):
    before = pad.hand.depth
    wheel(pad, notches, modifier)
    assert pad.hand.depth - before == pytest.approx(step)


def test_half_notches_of_a_touchpad_add_up(pad):
    before = pad.hand.depth
    wheel(pad, 0.5)
    assert pad.hand.depth == before
    wheel(pad, 0.5)
    assert pad.hand.depth - before == pytest.approx(0.001)


@pytest.mark.parametrize(
    ("key", "axis", "sign"),
    [
        (Qt.Key.Key_Left, 0, -1), (Qt.Key.Key_Right, 0, 1),
        (Qt.Key.Key_Up, 1, 1), (Qt.Key.Key_Down, 1, -1),
    ],
)  # fmt: skip
def test_arrow_keys_tilt_by_a_fifth_of_a_degree_and_finer_with_shift(pad, key, axis, sign):
    before = pad._hand.tilts.copy()
    QTest.keyClick(pad.pad, key)
    coarse = pad._hand.tilts.copy()
    QTest.keyClick(pad.pad, key, Qt.KeyboardModifier.ShiftModifier)
    assert coarse[axis] - before[axis] == pytest.approx(sign * radians(0.2))
    assert pad._hand.tilts[axis] - coarse[axis] == pytest.approx(sign * radians(0.05))


def test_page_keys_push_and_pull_and_home_goes_back_to_the_needle(pad):
    before = pad.hand.depth
    QTest.keyClick(pad.pad, Qt.Key.Key_PageDown)
    assert pad.hand.depth - before == pytest.approx(0.001)
    QTest.keyClick(pad.pad, Qt.Key.Key_PageUp, Qt.KeyboardModifier.ShiftModifier)
    assert pad.hand.depth - before == pytest.approx(0.0008)
    QTest.keyClick(pad.pad, Qt.Key.Key_Up)
    QTest.keyClick(pad.pad, Qt.Key.Key_Home)
    assert pad.hand.depth == pytest.approx(before)
    assert angle_between(pad.hand.direction, pad._view.direction) < 1e-12


def test_intents_are_thinned_to_a_hundred_a_second_and_the_last_one_arrives(pad, qt):
    QTest.qWait(30)
    seen = []
    pad.hand_moved.connect(seen.append)
    for _ in range(200):
        pad.pad.tilted.emit(0.0001, 0.0)
    assert seen == []
    QTest.qWait(60)
    assert len(seen) == 1
    assert np.allclose(seen[0].direction, pad.hand.direction)


def test_the_hand_stays_inside_the_cone_and_the_depth_range_and_answers_at_once(pad):
    limits = pad._scene.limits
    for _ in range(60):
        pad.pad.dragged.emit(0.5, 0.2)
        pad.pad.advanced.emit(0.05)
    assert angle_between(pad.hand.direction, (0, 0, -1)) <= limits.tilt + 1e-9
    assert pad.hand.depth == pytest.approx(limits.deepest)
    pad.pad.advanced.emit(-0.001)
    assert pad.hand.depth == pytest.approx(limits.deepest - 0.001)
    before = pad.hand.direction
    pad.pad.dragged.emit(-0.05, -0.02)
    assert angle_between(pad.hand.direction, before) > radians(0.1)


def test_without_a_simulated_hand_the_mouse_moves_nothing(qt):
    widget = Bullseye()
    widget.set_scene(run().scene(), interactive=False)
    widget.show_view(needle_line(snapshot()))
    widget.pad.dragged.emit(0.5, 0.5)
    assert widget.hand is None


def test_a_depth_that_is_only_the_models_never_moves_the_hand(qt):
    widget = Bullseye()
    widget.set_scene(run().scene(), interactive=True)
    guess = replace(needle_line(snapshot()), measured=False, depth=0.11)
    widget.show_view(guess)
    assert widget.hand is None
    widget.take_hand(HandPose(np.array([0.0, 0.0, -1.0]), -0.015, True))
    widget.show_view(guess)
    widget.pad.homed.emit()
    assert widget.hand.depth == pytest.approx(-0.015)
    assert angle_between(widget.hand.direction, guess.direction) < 1e-12


def test_the_hand_goes_on_from_where_the_loop_has_it():
    row = np.zeros(sv.SLOTS)
    row[[sv.HAND_X, sv.HAND_Y, sv.HAND_DEPTH, sv.HAND_HOLDS]] = 0.1, -0.2, -0.015, 1.0
    hand = hand_pose(snapshot(device=DeviceState.from_row(row)))
    assert np.allclose(hand.direction[:2], (0.1, -0.2))
    assert hand.direction[2] < 0.0
    assert (hand.depth, hand.holds) == (-0.015, True)


def test_a_pad_without_a_plan_is_drawn_and_ignores_the_mouse(qt):
    widget = Bullseye()
    widget.resize(400, 400)
    widget.pad.dragged.emit(0.5, 0.5)
    widget.show_view(needle_line(snapshot()))
    assert not widget.grab().isNull()


def test_the_words_name_the_plane_the_angle_and_the_side(pad):
    text = pad._in_plane.text() + pad._out_of_plane.text()
    assert "°" in text
    assert "plane" in text
    assert "push" in pad._remaining.text()
    assert "off the path" in pad._lateral.text()
    assert "CT angles: in plane" in pad._angles.text()


def test_places_beyond_the_rim_are_drawn_on_it():
    area = PadArea.inside(400, 300, 30)
    far = area.point((30.0, 40.0)) - area.centre
    assert np.hypot(far.x(), far.y()) == pytest.approx(area.radius)


def test_a_blind_bullseye_tells_neither_offset_nor_angles(pad):
    pad.hide_needle(True)
    assert not any(label.isVisibleTo(pad) for label in pad._words)


@pytest.mark.parametrize("size", [(60.0, 17.0), (44.0, 24.0)])
@pytest.mark.parametrize("pixels", [180.0, 260.0, 420.0])
def test_the_sizes_of_the_rings_stand_beside_each_other(pixels, size):
    area, taken = PadArea.inside(pixels, pixels, 30.0), []
    for radius in (0.21, 0.14, 0.44, 0.68):
        box = free_corner(area, radius, QSizeF(*size), taken)
        if box is not None:
            assert not any(box.intersects(other) for other in taken)
            assert is_inside(box, area)  # words across the rim are hard to read
            taken.append(box)
    assert len(taken) >= (3 if pixels > 180.0 else 2)  # smaller letters find room for the rest


@pytest.mark.parametrize("large", [False, True])
@pytest.mark.parametrize("pixels", [90, 130, 180, 260])
def test_words_on_an_empty_pad_stay_within_its_rim(pad, qt, pixels, large):
    try:
        theme.apply_theme(qt, size=theme.LARGE if large else 1.0)
        pad.hide_needle(True)
        pad.pad.setMinimumSize(pixels, pixels)
        pad.pad.resize(pixels, pixels)
        picture = pad.pad.grab().toImage()
        area = pad.pad.area
        for x in range(picture.width()):
            for y in range(picture.height()):
                if np.hypot(x - area.centre.x(), y - area.centre.y()) > area.radius + 3.0:
                    assert picture.pixelColor(x, y) == picture.pixelColor(0, 0)
        assert "not shown" in pad.pad.toolTip()
    finally:
        theme.apply_theme(qt)


@pytest.mark.parametrize("large", [False, True])
def test_on_the_smallest_pad_every_ring_has_its_size_written(pad, qt, large):
    try:
        theme.apply_theme(qt, size=theme.LARGE if large else 1.0)
        pad.pad.resize(180, 180)
        pad.pad.grab()
        assert pad.pad.toolTip() == ""
    finally:
        theme.apply_theme(qt)


def test_sizes_of_rings_without_room_are_in_the_tooltip(pad, qt):
    pad.pad.setMinimumSize(60, 60)
    pad.pad.resize(100, 100)
    pad.pad.grab()
    assert "40 mm" in pad.pad.toolTip()
    pad.pad.resize(400, 400)
    pad.pad.grab()
    assert pad.pad.toolTip() == ""


def words_are_whole(label):
    """Whether a label's words, wrapped, fit the room that it has."""
    flags = Qt.TextFlag.TextWordWrap
    room = label.contentsRect()
    needed = label.fontMetrics().boundingRect(room, flags, label.text())
    return needed.height() <= room.height() + 1 and needed.width() <= room.width() + 1


@pytest.mark.parametrize(("width", "height"), [(495, 390), (440, 380), (700, 480)])
def test_in_a_small_cell_no_word_is_cut(pad, qt, width, height):
    pad.resize(width, height)
    qt.processEvents()
    assert (pad.width(), pad.height()) == (width, height)
    assert all(words_are_whole(label) for label in pad._words if label.isVisible())
    assert pad.pad.height() >= 180


@pytest.mark.parametrize(("width", "height"), [(495, 390), (440, 380), (681, 446), (700, 480)])
def test_no_word_is_cut_where_the_depth_is_not_measured(pad, qt, width, height):
    pad.resize(width, height)
    pad.show_view(replace(needle_line(snapshot()), measured=False))
    qt.processEvents()
    assert "not measured" in pad._source.text()
    assert all(words_are_whole(label) for label in pad._words if label.isVisible())


@pytest.mark.parametrize(("width", "height"), [(495, 430), (400, 420), (340, 430)])
def test_no_word_is_cut_in_large_text_where_the_depth_is_not_measured(pad, qt, width, height):
    try:
        theme.apply_theme(qt, size=theme.LARGE)
        pad.resize(width, height)
        pad.suit_text()
        pad.show_view(replace(needle_line(snapshot()), measured=False))
        qt.processEvents()
        assert all(words_are_whole(label) for label in pad._words if label.isVisible())
    finally:
        theme.apply_theme(qt)


@pytest.mark.parametrize("large", [False, True])
@pytest.mark.parametrize("measured", [False, True])
@pytest.mark.parametrize(
    ("width", "height"), [(525, 338), (525, 310), (394, 366), (394, 310), (430, 420), (900, 600)]
)
def test_in_a_cell_of_any_height_words_cover_neither_pad_nor_each_other(
    pad, qt, width, height, measured, large
):
    cell = QWidget()
    try:
        theme.apply_theme(qt, size=theme.LARGE if large else 1.0)
        pad.suit_text()
        pad.setParent(cell)
        cell.resize(1000, 700)
        cell.show()
        pad.show()
        pad.setGeometry(0, 0, width, height)
        view = needle_line(snapshot())
        pad.show_view(replace(view, measured=measured))
        qt.processEvents()
        assert pad.size().toTuple() == (width, height)
        shown = [*pad._words, pad.pad, pad.depth_bar, pad.source]
        places = [one.geometry() for one in shown if one.isVisible()]
        for place in places:
            assert pad.rect().contains(place)
        for one, other in combinations(places, 2):
            assert not one.intersects(other)
        assert all(words_are_whole(label) for label in pad._words if label.isVisible())
        assert pad.pad.height() >= 130
        assert ("towards" in pad._in_plane.text()) == (pad._in_plane.toolTip() == "")
    finally:
        pad.setParent(None)
        cell.deleteLater()
        theme.apply_theme(qt)
