"""The workspace in an attempt: shares of the window, what is put away, and that it comes back."""

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from attempt_windows import begun, judged
from PySide6.QtCore import QRectF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QScrollArea

from app.core import state_vector as sv
from app.imaging.window import WindowLevel
from app.planning.draft import DraftPlan
from app.session.machine import State
from app.session.shown_views import Shown
from app.views.exercise.attempt_rail import AttemptRail, RailFigures
from app.views.exercise.breath_strip import BreathStrip
from app.views.exercise.live import LiveFigures
from app.views.exercise.scan_wall import ScanPicture, ScanWall
from app.views.kit import theme

FIGURES = LiveFigures(State.INSERTING, 83.0, 0.0888, True, 0.0, 0.0, 0.0888, 0.4, True, 5.0, 3)

SIZES = [(1366, 768), (1920, 1080), (2560, 1440)]


@pytest.mark.long("journey")
@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("large", [False, True])
def test_in_an_attempt_the_ct_has_its_share_of_the_window(window, patient, settle, size, large):
    try:
        window.projector.set(large=large)
        window.resize(*size)
        begun(window, patient)
        assert judged(window, large=large) == []
    finally:
        window.conductor.controller.abort()
        theme.apply_theme(QApplication.instance())


@pytest.mark.long("journey")
def test_the_shares_hold_at_every_scale_of_the_screen():
    screens = [(factor, *size) for factor in (1.0, 1.25, 1.5, 2.0) for size in SIZES]
    script = Path(__file__).with_name("attempt_windows.py")
    told = subprocess.run(
        [sys.executable, str(script), json.dumps(screens)],
        capture_output=True, text=True, timeout=600, check=False,
    )  # fmt: skip
    assert told.returncode == 0, told.stderr
    lines = [json.loads(line) for line in told.stdout.splitlines() if line.startswith("{")]
    assert len(lines) == len(screens)
    for line, (factor, _, _) in zip(lines, screens, strict=True):
        assert line["ratio"] == factor
        assert line["wrong"] == []


@pytest.mark.long("journey")
def test_everything_that_was_put_away_comes_back_as_it_was(window, patient, settle):
    window.resize(1366, 768)
    workspace = window.workspace
    begun(window, patient, start=False)
    workspace.show_layout("1+3")
    workspace.show_bullseye(True)
    workspace.side.setCurrentIndex(2)
    window.show()
    settle(timeout=0.1)
    looks = lambda: (  # noqa: E731
        workspace.grid.shown, workspace.side.currentIndex(), workspace.side.isVisible(),
        workspace.status.isVisible(), workspace.next_step.isVisible(), workspace.rail.isVisible(),
        workspace.disclaimer.isVisible(), workspace.bullseye.source.isVisible(),
        workspace.exercise_panel.buttons.start.isVisibleTo(workspace.exercise_panel),
        workspace.exercise_panel.isAncestorOf(workspace.exercise_panel.tools),
    )  # fmt: skip
    before = looks()
    workspace.room.begin()
    settle(timeout=0.1)
    assert not workspace.side.isVisible()
    assert workspace.rail.isAncestorOf(workspace.exercise_panel.buttons)
    assert workspace.exercise_panel.buttons.end.isVisible()
    workspace.room.toggle_panels()
    settle(timeout=0.1)
    assert workspace.side.isVisible()
    workspace.room.toggle_panels()
    workspace.show_layout("6-up")
    workspace.room.end()
    settle(timeout=0.1)
    assert looks() == before


@pytest.mark.long("journey")
def test_the_exercises_own_layout_is_the_one_of_the_attempt(window, patient, settle):
    begun(window, patient, start=False)
    workspace = window.workspace
    workspace.room.begin("2x2")
    assert workspace.grid.shown.panes[:3] == ("axial", "sagittal", "coronal")
    workspace.room.end()
    workspace.room.begin()
    assert workspace.grid.shown.panes[:2] == ("in_plane", "in_plane_90")
    workspace.room.end()


@pytest.mark.long("journey")
def test_without_bullseye_and_3d_the_ct_has_all_of_it(window, patient, settle):
    begun(window, patient, start=False)
    workspace = window.workspace
    workspace.has_more_than_scan = False
    workspace.scene.set_off("not here")
    workspace.room.begin()
    assert workspace.grid.shown.panes == ("in_plane", "in_plane_90")
    assert workspace.grid.shown.columns == 20
    workspace.room.end()


@pytest.mark.parametrize("has_hand", [True, False])
def test_where_a_script_is_watched_by_scans_no_cell_is_empty(window, patient, has_hand):
    workspace = window.workspace
    begun(window, patient, start=False)
    workspace.show_views(Shown(live=False), has_hand)
    workspace.room.begin()
    assert ("bullseye" in workspace.grid.shown.panes) == has_hand
    workspace.room.end()


@pytest.mark.parametrize("width", [900, 1024, 1366])
def test_the_bar_of_a_low_rail_covers_no_word(application, width):
    rail = AttemptRail()
    rail.suit_window(width)
    rail.resize(rail.width(), 330)
    rail.order.say("Aim 3 mm further towards the head and the patient's right")
    rail.show_figures(FIGURES)
    rail.show()
    QApplication.processEvents()
    area = rail.findChild(QScrollArea)
    assert area.verticalScrollBar().isVisible()
    assert area.widget().width() == area.viewport().width()
    for label in area.widget().findChildren(QLabel):
        if label.isVisible() and label.text():
            assert label.mapTo(area, label.rect().topRight()).x() < area.viewport().width()
            assert label.wordWrap() or label.sizeHint().width() <= label.width() + 1
    words = rail.order.fontMetrics().boundingRect(
        rail.order.contentsRect().adjusted(8, 0, -8, 0), Qt.TextFlag.TextWordWrap, rail.order.text()
    )
    assert words.height() <= rail.order.height()


def test_the_way_back_from_a_scan_is_seen_on_a_low_rail_without_scrolling(application):
    """Seen: below a procedure's steps it was off the screen, and the live CT lost."""
    rail = AttemptRail()
    rail.suit_window(1366)
    rail.pictures.setText("Live pictures (C)")
    rail.pictures.show()
    rail.resize(rail.width(), 330)
    rail.show()
    QApplication.processEvents()
    assert rail.pictures.visibleRegion().boundingRect() == rail.pictures.rect()


def test_scan_end_and_abort_are_seen_on_a_low_rail_however_much_stands_above(window, patient):
    begun(window, patient, start=False)
    panel, room = window.workspace.exercise_panel, window.workspace.room
    buttons = panel.tools.buttons
    room.begin()
    room.rail.resize(room.rail.width(), 330)
    pressed = (buttons.scan, buttons.end, buttons.abort)
    assert not buttons.isHidden()
    assert not room.rail.findChild(QScrollArea).isAncestorOf(buttons)
    assert {panel.tools.isAncestorOf(one) for one in pressed} == {False}
    room.end()
    assert {panel.tools.isAncestorOf(one) for one in pressed} == {True}
    assert panel.tools.layout().indexOf(buttons) == panel.tools.layout().indexOf(panel.enable) - 1


def test_the_rail_names_a_drill_in_one_line_and_else_has_no_line_for_it(application):
    rail = AttemptRail()
    rail.suit_window(1366)
    assert rail.drill.isHidden()
    rail.set_drill("Drill: a long way through the ribs to the liver, breathing")
    rail.resize(rail.width(), 700)
    rail.show()
    QApplication.processEvents()
    assert rail.drill.isVisible()
    assert rail.drill.text().startswith("Drill: a long")
    assert rail.drill.height() < 2 * rail.drill.fontMetrics().lineSpacing()
    assert rail.drill.geometry().bottom() < rail.order.geometry().top()
    rail.set_drill("")
    assert rail.drill.isHidden()


@pytest.mark.long("journey")
def test_the_menu_ticks_the_layout_that_the_attempt_shows(window, patient):
    begun(window, patient, start=False)
    workspace, layouts = window.workspace, window.view_menu.layouts

    def ticked():
        return [str(name) for name, action in layouts.items() if action.isChecked()]

    assert ticked() == ["2x2"]
    workspace.room.begin()
    assert workspace.grid.shown.panes[:2] == ("in_plane", "in_plane_90")
    assert ticked() == []
    workspace.show_layout("1+3")
    assert ticked() == ["1+3"]
    workspace.room.end()
    assert ticked() == ["2x2"]


# --- the control scan -------------------------------------------------------------------------
def wall_of(volume, *captions):
    wall = ScanWall()
    wall.resize(880, 700)
    wall.set_window(WindowLevel(400.0, 40.0))
    for caption in captions:
        wall.add(ScanPicture(volume, caption))
    return wall


def test_the_new_scan_stands_over_the_last_one_slice_by_slice(volume, destroy):
    wall = wall_of(volume, "first", "second", "third")
    destroy(wall)
    assert wall.captions == ("third", "second")
    above, below = wall.tiles
    assert len(above) == len(below) >= 2
    assert [tile.words for tile in above] == [tile.words for tile in below]


@pytest.mark.parametrize("size", [(880, 700), (420, 240)])
def test_every_slice_of_a_scan_says_directions_window_and_length_and_nothing_twice(
    volume, destroy, size
):
    wall = wall_of(volume, "first")
    destroy(wall)
    wall.resize(*size)
    wall.show()
    QApplication.processEvents()
    for tile in wall.tiles[0]:
        words = tile.readouts
        # a CT is read from the feet: the patient's right is on the left, the front is up
        sides = [letter.text() for letter in words.letters]
        assert sides[:2] == ["R", "L"]
        if size[0] > 800:
            assert sides[2:] == ["A", "P"]
            assert words.window.text() == "W 400  L 40"
            # a bar of round length that the tile's own scale agrees with
            assert words.ruler.isVisible()
        places = [one.geometry() for one in words.everything if not one.is_empty]
        for number, place in enumerate(places):
            assert tile.rect().contains(place)
            assert not any(place.intersects(other) for other in places[number + 1 :])


def test_the_letters_of_a_scan_are_painted_and_gone_with_the_slice(volume, destroy):
    wall = wall_of(volume, "first")
    destroy(wall)
    wall.show()
    QApplication.processEvents()
    tile = wall.tiles[0][0]
    shot = tile.grab().toImage()
    place = tile.readouts.letters[0].geometry()
    colours = {
        shot.pixelColor(x, y).name()
        for x in range(place.left(), place.right())
        for y in range(place.top(), place.bottom())
    }
    assert theme.IMAGE_WARNING in colours
    tile.show_slice(None, 0, WindowLevel(400.0, 40.0), QRectF(0.0, 0.0, 10.0, 10.0))
    assert all(one.is_empty for one in tile.readouts.everything)


def shifted(volume, millimetres):
    moved = volume.affine_mm.copy()
    moved[2, 3] += millimetres
    return replace(volume, affine_mm=moved)


def test_beside_a_slice_that_the_scan_before_has_not_nothing_is_shown(volume, destroy):
    step = float(volume.spacing_mm[2])
    for share, is_there in ((0.4, True), (0.0, True), (volume.size[2] + 1.0, False)):
        wall = wall_of(shifted(volume, share * step), "first")
        destroy(wall)
        wall.add(ScanPicture(volume, "second"))
        above, below = wall.tiles
        assert all(tile.words for tile in above)
        assert all(bool(tile.words) is is_there for tile in below)


def test_a_click_opens_a_slice_of_the_newest_scan_and_none_of_the_one_before(volume, destroy):
    wall = wall_of(volume, "first", "second")
    destroy(wall)
    wall.show()
    opened = []
    wall.slice_wanted.connect(opened.append)
    above, below = wall.tiles
    for tile in below:
        assert tile.toolTip() == ""
        assert tile.cursor().shape() is Qt.CursorShape.ArrowCursor
        QTest.mouseClick(tile, Qt.MouseButton.LeftButton)
    assert opened == []
    QTest.mouseClick(above[-1], Qt.MouseButton.LeftButton)
    assert "alone" in above[-1].toolTip()
    assert len(opened) == 1


def test_a_tile_is_zoomed_on_the_path_and_shows_its_ends(volume, destroy):
    wall = wall_of(volume, "first")
    destroy(wall)
    entry, target = volume.lps_mm((10, 8, 5)), volume.lps_mm((12, 20, 6))
    wall.look_at(DraftPlan(tuple(entry), tuple(target)))
    wall.show()
    QApplication.processEvents()
    tile = wall.tiles[0][0]
    for end in (entry, target):
        x, y = tile.to_pixels().map(float(end[0]), float(end[1]))
        assert 0.1 * tile.width() < x < 0.9 * tile.width()
        assert 0.1 * tile.height() < y < 0.9 * tile.height()


# --- the breath -------------------------------------------------------------------------------
class Told:
    """A moment with a breath [m]."""

    def __init__(self, time, moved):
        row = np.zeros(sv.BREATH_Z + 1)
        row[sv.BREATH_Z] = moved
        self.time, self.device = time, type("Device", (), {"row": row})()


def test_the_breath_strip_is_there_from_the_beginning_or_never(application):
    strip = BreathStrip()
    for breathes in (True, False):
        strip.begin(0.002, breathes)
        assert strip.isHidden() is not breathes
        strip.show_snapshot(Told(0.0, 0.012))
        assert strip.isHidden() is not breathes


def test_just_outside_its_band_the_breath_is_not_said_to_be_within_it(application):
    strip = BreathStrip()
    strip.begin(0.002, True)
    strip.show_snapshot(Told(0.0, 0.0022))
    assert not strip.in_gate
    assert "2.2 mm away" in strip.words


def test_the_breath_strip_knows_its_gate(application):
    strip = BreathStrip()
    strip.begin(0.002, True)
    for tick in range(50):
        strip.show_snapshot(Told(0.1 * tick, 0.0))
    assert strip.in_gate
    lowest = np.inf
    for tick in range(50, 130):
        strip.show_snapshot(Told(0.1 * tick, 0.012 * np.sin(0.1 * tick) ** 4))
        lowest = min(lowest, strip.points.last().y())
    assert not strip.isHidden()
    assert lowest < strip.level(strip.gate) < strip.level(0.0)
    strip.show_snapshot(Told(14.0, 0.012))
    assert not strip.in_gate
    assert "12.0 mm" in strip.words
    strip.show_snapshot(Told(14.1, 0.001))
    assert "push" in strip.words


@pytest.mark.long("journey")
def test_what_a_scan_is_ordered_with_fits_the_rail(window, patient, settle):
    window.resize(1366, 768)
    begun(window, patient, start=False)
    workspace = window.workspace
    workspace.room.begin(live=False)
    workspace.exercise_panel.scan.show()
    settle(timeout=0.1)
    scan, rail = workspace.exercise_panel.scan, workspace.rail
    assert scan.isVisible()
    assert scan.minimumSizeHint().width() <= rail.width() - 16
    for part in (scan.table, scan.feet, scan.head, scan.here, scan.slices, scan.count):
        assert rail.rect().contains(part.mapTo(rail, part.rect().bottomRight()))
    workspace.room.end()
    settle(timeout=0.1)
    assert workspace.exercise_panel.isAncestorOf(scan)


@pytest.mark.long("journey")
def test_a_pane_that_had_the_whole_room_has_it_again_after_the_attempt(window, patient, settle):
    begun(window, patient, start=False)
    workspace = window.workspace
    pane = workspace.panes[0]
    workspace.grid.toggle(pane)
    workspace.room.begin()
    assert workspace.grid.maximised is None
    workspace.room.end()
    assert workspace.grid.maximised is pane


@pytest.mark.long("journey")
def test_the_rail_of_an_attempt_begins_at_its_top(window, settle):
    window.show_workspace()
    window.show()
    window.resize(1024, 500)
    room, bar = window.workspace.room, window.workspace.rail._area.verticalScrollBar()
    room.begin()
    assert settle(lambda: bar.maximum() > 0)
    bar.setValue(bar.maximum())
    room.end()
    room.begin()
    assert settle(lambda: bar.maximum() > 0)
    assert bar.value() == 0


def test_with_all_panels_no_figure_no_order_and_no_stage_stands_twice(window, patient, settle):
    """Seen: time, depth, force, stages and the order, once in the rail and once beside it."""
    window.resize(1366, 768)
    begun(window, patient, start=False)
    workspace, panel = window.workspace, window.workspace.exercise_panel
    window.show()
    workspace.room.begin()
    workspace.room.toggle_panels()
    settle(timeout=0.1)
    shown = {key for key, label in panel.readouts._values.items() if label.isVisible()}
    assert panel.isVisible()
    assert workspace.rail.isVisible()
    assert not shown & set(RailFigures.SHOWN)
    assert {"angle", "lateral"} <= shown
    assert not panel.readouts.force.isVisible()
    assert not panel.steps.isVisible()
    assert not workspace.next_step.isVisible()
    assert not workspace.disclaimer.isVisible()
    workspace.room.end()
    settle(timeout=0.1)
    back = [panel.readouts._values[key] for key in RailFigures.SHOWN]
    assert all(part.isVisibleTo(panel) for part in (panel.steps, panel.readouts.force, *back))


def test_the_rail_is_as_wide_inside_with_a_scroll_bar_as_without(application):
    rail = AttemptRail()  # a width that follows the bar had an order's height call it without end
    rail.suit_window(1366)
    rail.show()
    area = rail.findChild(QScrollArea)
    widths = set()
    for height in (200, 2000):
        rail.resize(rail.width(), height)
        QApplication.processEvents()
        assert area.verticalScrollBar().isVisible() is (height == 200)
        widths.add(area.widget().width())
    assert len(widths) == 1
    rail.close()
