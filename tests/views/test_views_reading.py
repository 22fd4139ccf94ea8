"""Reading: bindings, greys, slabs, turns, cine, keyboard."""

from itertools import product

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QAction, QKeyEvent
from PySide6.QtWidgets import QLabel, QScrollArea
from test_views_slices import drag, press, wheel

from app.imaging.orthogonal import OrthogonalSlicer, View
from app.imaging.reformat import Frame
from app.imaging.window import PRESETS, WindowLevel
from app.views.shell import shortcuts
from app.views.shell.shortcuts import ShortcutSheet, groups
from app.views.slices.bindings import (
    OHIF,
    RESERVED,
    SCHEMES,
    SLICER,
    Action,
    action_words,
    key_name,
    key_rows,
)
from app.views.slices.camera import SliceCamera
from app.views.slices.pane import SlicePane
from app.views.slices.panes import MPR_PANES, PaneId
from app.views.slices.plane import own_plane, presented
from app.views.slices.presentation import KINDS, Presentation, Slab, Turn
from app.views.slices.presets import KEYED, best_window, default_window, menu_windows
from app.views.slices.viewing import Tool, Viewing

CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
NONE = Qt.KeyboardModifier.NoModifier
TURNS = [Turn(quarters, mirrored) for quarters, mirrored in product(range(4), (False, True))]


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


# --- bindings ---------------------------------------------------------------------------------
@pytest.mark.parametrize("scheme", SCHEMES.values(), ids=SCHEMES)
def test_no_scheme_uses_a_key_of_the_attempt_in_a_slice(scheme):
    assert not {key.split("+")[-1] for key in scheme.keys} & set(RESERVED)


@pytest.mark.parametrize("scheme", SCHEMES.values(), ids=SCHEMES)
def test_every_action_stands_in_the_sheet_with_its_keys(scheme):
    text = "  ".join(keys for keys, _ in key_rows(scheme))
    shown = set(text.split())
    for key in scheme.keys:
        plain = key.replace("Up", "↑").replace("Down", "↓") if "Pg" not in key else key
        plain = plain.replace("Left", "←").replace("Right", "→")
        assert plain in shown, key


def test_every_action_has_a_key_in_the_first_scheme_and_words():
    assert set(OHIF.keys.values()) == set(Action)
    assert len(action_words()) < len(Action)  # some share a row
    assert len(groups(OHIF)) == len(groups(SLICER)) == 5


def test_shift_is_left_out_where_only_the_keyboard_needs_it():
    plus = QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_Plus, SHIFT)
    assert key_name(plus) == "+"
    assert key_name(QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_R, SHIFT)) == "Shift+R"


def test_the_left_drag_of_slicer_with_shift_pans_and_of_ohif_moves_the_crosshair(pane, viewing):
    start, cursor = pane.canvas.camera, viewing.cursor_mm
    drag(pane, (200, 150), (220, 150), Qt.MouseButton.LeftButton, SHIFT)
    assert_allclose(viewing.cursor_mm, pane.canvas.lps_at(QPointF(220, 150)), atol=1e-6)
    viewing.set_cursor(cursor)
    viewing.set_scheme(SLICER)
    drag(pane, (200, 150), (220, 150), Qt.MouseButton.LeftButton, SHIFT)
    assert pane.canvas.camera.x == pytest.approx(start.x - 20 / start.scale)
    assert_allclose(viewing.cursor_mm, cursor)


def test_a_box_is_shown_in_its_best_window(pane, viewing):
    plane = pane.canvas.plane
    at = [plane.point(viewing.volume.lps_mm(ijk), pane.canvas.index)
          for ijk in ((28.5, 28.5, 20), (35.5, 33.5, 20))]  # fmt: skip
    first, last = (pane.canvas.pixel_at(p.x, p.y) for p in at)
    drag(pane, first.toTuple(), last.toTuple(), Qt.MouseButton.LeftButton, CTRL | SHIFT)
    assert viewing.window == WindowLevel(1.0, 700.0)  # bone only
    drag(pane, (100, 100), (102, 101), Qt.MouseButton.LeftButton, CTRL | SHIFT)
    assert viewing.window == WindowLevel(1.0, 700.0)  # a click is no box
    assert best_window(np.zeros((0, 3))) is None


def test_z_lets_the_left_button_zoom_until_escape(pane, viewing):
    press(pane, Qt.Key.Key_Z)
    before, window = pane.canvas.camera.scale, viewing.window
    drag(pane, (200, 150), (200, 100))
    assert pane.canvas.camera.scale > before
    press(pane, Qt.Key.Key_Escape)
    drag(pane, (200, 150), (230, 150))
    assert viewing.window != window


def test_keys_of_slicer_scroll_where_those_of_ohif_go_to_the_next_pane(pane, viewing):
    gone = []
    pane.leave_wanted.connect(gone.append)
    before = pane.canvas.index
    press(pane, Qt.Key.Key_Right)
    assert gone == [True]
    viewing.set_scheme(SLICER)
    press(pane, Qt.Key.Key_F)
    press(pane, Qt.Key.Key_Right)
    assert pane.canvas.index == before + 2
    press(pane, Qt.Key.Key_B)
    assert pane.canvas.index == before + 1


def test_a_pane_claims_its_keys_before_the_menus_but_not_those_of_the_attempt(pane):
    def claims(key):
        event = QKeyEvent(QEvent.Type.ShortcutOverride, key, NONE)
        event.ignore()
        pane.event(event)
        return event.isAccepted()

    assert claims(Qt.Key.Key_R)
    assert not any(claims(key) for key in (Qt.Key.Key_S, Qt.Key.Key_E, Qt.Key.Key_Return))


def test_entry_and_target_are_placed_without_a_mouse(pane, viewing):
    placed = []
    viewing.point_placed.connect(lambda *what: placed.append(what))
    press(pane, Qt.Key.Key_Return)
    assert not placed
    viewing.set_tool(Tool.TARGET)
    x = viewing.cursor_mm[0]
    pane.keyPressEvent(QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_Right, CTRL))
    press(pane, Qt.Key.Key_Return)
    assert placed[0][0] is Tool.TARGET
    assert placed[0][1][0] == pytest.approx(x + 1.0)
    assert viewing.tool is Tool.NAVIGATE


# --- greys ------------------------------------------------------------------------------------
def test_the_digits_are_those_of_ohif_and_0_is_the_files_own(pane, viewing):
    for digit, name in enumerate(KEYED, start=1):
        press(pane, Qt.Key(Qt.Key.Key_0 + digit))
        assert viewing.window == PRESETS[name]
    assert KEYED[:4] == ("Soft tissue", "Lung", "Bone", "Brain")
    press(pane, Qt.Key.Key_0)
    assert viewing.window == WindowLevel(300, 30)
    assert set(KEYED) == set(PRESETS)


def test_a_locked_window_stays_whatever_one_does(pane, viewing):
    viewing.greys.set_locked(True)
    before = viewing.window
    drag(pane, (200, 150), (260, 100))
    press(pane, Qt.Key.Key_3)
    press(pane, Qt.Key.Key_Space)
    assert viewing.window == before
    pane.canvas.flush()
    assert "locked" in pane.readouts.window.text()
    viewing.greys.set_locked(False)
    press(pane, Qt.Key.Key_3)
    assert viewing.window == PRESETS["Bone"]


def test_panes_have_one_window_or_each_its_own(viewing, destroy):
    one, other = (SlicePane(viewing, pane) for pane in MPR_PANES[:2])
    for pane in (one, other):
        destroy(pane)
    viewing.greys.set_linked(False)
    viewing.set_window(PRESETS["Lung"], one.pane)
    assert viewing.greys.of(one.pane) == PRESETS["Lung"]
    assert viewing.greys.of(other.pane) == default_window()
    viewing.greys.set_linked(True)
    assert viewing.greys.of(one.pane) == default_window()


def test_inverting_swaps_bright_and_dark(pane, viewing):
    pane.canvas.flush()
    middle = pane.canvas.rect().center()
    plain = pane.canvas.feed.picture.image.pixelColor(middle).red()
    press(pane, Qt.Key.Key_I)
    pane.canvas.flush()
    assert pane.canvas.feed.picture.image.pixelColor(middle).red() == 255 - plain
    assert "inverted" in pane.readouts.window.text()


def test_a_window_can_be_kept_by_name_and_forgotten(pane, viewing):
    viewing.greys.keep("Mine", WindowLevel(500, 100))
    assert menu_windows(viewing.volume, viewing.greys.kept)[-1] == (
        "Mine", "", WindowLevel(500, 100)
    )  # fmt: skip
    assert any(action.text().startswith("Mine") for action in pane.build_menu().actions())
    viewing.greys.forget("Mine")
    assert not viewing.greys.kept


# --- turns ------------------------------------------------------------------------------------
@pytest.mark.long("journey")
@pytest.mark.parametrize("turn", TURNS, ids=str)
@pytest.mark.parametrize("view", list(View))
def test_places_letters_and_pixels_of_a_turned_pane_belong_together(volume, view, turn):
    plane = own_plane(OrthogonalSlicer(volume), view)
    turned = presented(plane, Presentation(turn=turn))
    lps = volume.lps_mm([[20, 10, 7], [5, 40, 30], [50, 3, 20]])
    for point in lps:
        index = plane.index_at(point)
        at = turned.point(point, index)
        assert_allclose(turned.lps_mm(at.x, at.y, index + at.distance / turned.step_mm), point,
                        atol=1e-9)  # fmt: skip
        assert_allclose(turned.frame(index).point(point)[:2], (at.x, at.y), atol=1e-9)
        image = turned.image(index)
        rows, columns = image.shape
        row = int(at.y / turned.extent_mm[1] * rows)
        column = int(at.x / turned.extent_mm[0] * columns)
        assert image[row, column] == volume.hu_at(point, "nearest")
    letters = turned.frame(3).letters()
    assert turned.letters() == (letters.left, letters.right, letters.top, letters.bottom)


def test_a_quarter_to_the_right_puts_what_was_on_top_to_the_right(pane, viewing):
    assert pane.canvas.plane.letters() == ("R", "L", "A", "P")
    press(pane, Qt.Key.Key_R)
    assert pane.canvas.plane.letters() == ("P", "A", "R", "L")
    pane.canvas.flush()
    assert [overlay.text() for overlay in pane.readouts.letters] == ["P", "A", "R", "L"]
    press(pane, Qt.Key.Key_L)
    press(pane, Qt.Key.Key_M)
    assert pane.canvas.plane.letters() == ("L", "R", "A", "P")
    press(pane, Qt.Key.Key_V)
    assert pane.canvas.plane.letters() == ("L", "R", "P", "A")
    pane.canvas.flush()
    assert "turned 180°" in pane.readouts.title.text()  # both mirrors together
    press(pane, Qt.Key.Key_M)
    pane.canvas.flush()
    assert "mirrored" in pane.readouts.title.text()


@pytest.mark.parametrize("turn", TURNS, ids=str)
def test_flipping_twice_and_turning_four_times_changes_nothing(turn):
    for upright in (False, True):
        assert turn.flipped(upright).flipped(upright) == turn
    assert turn.turned(1).turned(3) == turn
    assert turn.flipped().flipped(upright=True) == turn.turned(2)


def test_the_crosshair_and_the_marks_follow_a_turned_pane(pane, viewing):
    viewing.set_presentation(pane.pane, Presentation(turn=Turn(1)))
    at = pane.canvas.plane.point(viewing.cursor_mm, pane.canvas.index)
    place = pane.canvas.pixel_at(at.x, at.y)
    assert_allclose(pane.canvas.lps_at(place)[:2], viewing.cursor_mm[:2], atol=1e-9)


# --- slabs ------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("kind", "reduce"), [("mean", np.mean), ("mip", np.max), ("minip", np.min)]
)
@pytest.mark.parametrize("view", list(View))
def test_a_slab_of_whole_slices_is_what_numpy_makes_of_them(volume, view, kind, reduce):
    plane = own_plane(OrthogonalSlicer(volume), view)
    slab = presented(plane, Presentation(Slab(kind, 5 * plane.step_mm)))
    block = np.stack([plane.image(index) for index in range(8, 13)]).astype(np.float64)
    assert_allclose(slab.image(10), reduce(block, axis=0), atol=1e-3)
    assert slab.half_slab_mm >= 2.5 * plane.step_mm


def test_a_slab_at_the_end_of_the_volume_takes_the_slices_that_there_are(volume):
    plane = own_plane(OrthogonalSlicer(volume), View.AXIAL)
    slab = presented(plane, Presentation(Slab("mip", 100.0)))
    assert_allclose(slab.image(0), np.max([plane.image(i) for i in range(26)], axis=0))


def test_the_wheel_with_shift_thickens_and_the_reader_is_told(pane, viewing):
    wheel(pane, 120, SHIFT)
    assert viewing.presentation(pane.pane).slab == Slab("mean", 1.0)
    wheel(pane, 5 * 120, SHIFT)
    press(pane, Qt.Key.Key_K)
    pane.canvas.flush()
    assert "MIP 6 mm" in pane.readouts.title.text()
    wheel(pane, -20 * 120, SHIFT)
    assert not viewing.presentation(pane.pane).slab
    press(pane, Qt.Key.Key_K)
    assert viewing.presentation(pane.pane).slab.thickness_mm == 10.0
    press(pane, Qt.Key.Key_Space)
    assert not viewing.presentation(pane.pane).slab


def test_the_kinds_go_round():
    slab = Slab("mean", 5.0)
    seen = [slab := slab.next_kind() for _ in KINDS]
    assert [one.kind for one in seen] == ["mip", "minip", "mean"]


# --- cine -------------------------------------------------------------------------------------
def test_cine_runs_there_and_back_until_something_is_touched(pane, viewing):
    press(pane, Qt.Key.Key_C)
    assert pane.cine.is_running
    last = pane.canvas.plane.count - 1
    viewing.show_slice(pane.pane, last - 1)
    seen = []
    for _ in range(3):
        pane.cine.advance()
        seen.append(pane.canvas.index)
    assert seen == [last, last - 1, last - 2]
    pane.cine.eventFilter(pane.canvas, QEvent(QEvent.Type.Wheel))
    assert not pane.cine.is_running


# --- keyboard ---------------------------------------------------------------------------------
@pytest.mark.long("journey")
def test_the_arrows_go_through_the_panes_and_the_menu_key_opens_the_menu(window, patient, settle):
    window.show_patient(patient)
    window.activateWindow()
    panes = window.workspace.panes
    panes[0].setFocus()
    panes[0].leave_wanted.emit(True)
    assert panes[1].canvas is window.focusWidget()
    panes[1].leave_wanted.emit(False)
    assert panes[0].canvas is window.focusWidget()


@pytest.mark.long("journey")
def test_schemes_are_chosen_in_the_menu_and_change_its_keys(window):
    view = window.view_menu
    assert view.follow.shortcut().toString() == "F"
    view.schemes["slicer"].trigger()
    assert window.workspace.viewing.scheme is SLICER
    assert view.follow.shortcut().toString() == "Shift+F"


def test_the_sheet_of_keys_fits_a_small_screen(window):
    window.show_shortcuts()
    sheet = window.findChild(ShortcutSheet)
    wanted = sheet.findChild(QScrollArea).widget().sizeHint()
    assert wanted.width() <= 1280
    assert wanted.height() <= 768 - 120
    sheet.reject()


def test_a_sheet_of_longer_words_stands_in_one_column(application, monkeypatch):
    longer = [
        (heading, [(f"{key} {key}", f"{words} {words}") for key, words in rows])
        for heading, rows in groups(OHIF)
    ]
    monkeypatch.setattr(shortcuts, "groups", lambda *_: longer)
    sheet = ShortcutSheet(OHIF)
    page = sheet.findChild(QScrollArea).widget()
    sheet.show()
    tables = [part.x() for part in page.findChildren(QLabel) if part.text() in dict(longer)]
    assert len(tables) == len(longer)
    assert len(set(tables)) == 1
    sheet.close()
    sheet.deleteLater()


@pytest.mark.long("journey")
@pytest.mark.parametrize("scheme", SCHEMES.values(), ids=SCHEMES)
def test_no_key_of_the_menus_is_taken_by_a_pane(window, scheme):
    window.workspace.viewing.set_scheme(scheme)
    keys = {
        key.toString()
        for action in window.findChildren(QAction)
        for key in action.shortcuts()
        if action.shortcutContext() is not Qt.ShortcutContext.WidgetShortcut  # of another page
    }
    digits = {str(number) for number in range(10)}
    assert not keys & (set(scheme.keys) | digits)


# --- the needle's panes -----------------------------------------------------------------------
def test_slab_and_turn_work_along_oblique_planes_too(viewing):
    frame = Frame.of(viewing.cursor_mm, [0.8, 0.6, 0.0], [0.0, 0.0, -1.0])
    viewing.set_frame(PaneId.IN_PLANE, frame)
    plane = viewing.plane(PaneId.IN_PLANE)
    viewing.set_presentation(PaneId.IN_PLANE, Presentation(Slab("mip", 6.0), Turn(1)))
    turned = viewing.plane(PaneId.IN_PLANE)
    assert turned.half_slab_mm == 3.0
    left, right, top, bottom = plane.letters()
    assert turned.letters() == (bottom, top, left, right)
    point = viewing.cursor_mm + [3.0, 2.0, 5.0]
    before, after = plane.point(point, 0.0), turned.point(point, 0.0)
    assert (after.x, after.y) == pytest.approx((-before.y, before.x))
    assert after.distance == pytest.approx(before.distance)
    assert turned.image(0.0).max() >= plane.image(0.0).max() - 1e-3
    viewing.set_frame(PaneId.IN_PLANE, frame)  # the needle moved: it is read at as before
    assert viewing.plane(PaneId.IN_PLANE).half_slab_mm == 3.0


@pytest.mark.long("journey")
def test_the_words_in_the_corners_stay_where_they_are_while_the_view_is_panned(
    window, patient, settle
):
    window.show_patient(patient)
    settle(timeout=0.3)
    pane = window.workspace.panes[0]
    words = (pane.readouts.title, pane.readouts.slice, pane.readouts.window, *pane.readouts.letters)
    camera = pane.canvas.camera.zoomed(2.0, pane.canvas.camera.x, pane.canvas.camera.y)
    pane.canvas.set_camera(camera)
    settle(timeout=0.1)
    before = [overlay.pos() for overlay in words]
    for right, down in ((30.0, -20.0), (-55.0, 40.0), (3.0, 0.0)):
        pane.canvas.set_camera(SliceCamera(camera.x - right, camera.y - down, 1.3 * camera.scale))
        settle(timeout=0.1)
        pane.canvas.set_camera(SliceCamera(camera.x + right, camera.y + down, camera.scale))
        settle(timeout=0.1)
        assert [overlay.pos() for overlay in words] == before
