"""The room: projector mode, what is remembered, the operator's side, colours for everybody."""

import json
import threading
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication, QLabel, QLineEdit
from views_exercise_attempts import review
from window_rig import plan

from app.core.events import Event
from app.core.identifiers import HIDDEN
from app.exercises.reading import ReadingPart
from app.imaging.orthogonal import OrthogonalSlicer, View
from app.imaging.window import PRESETS, WindowLevel
from app.planning.placement import PatientOrientation
from app.views.debrief.feature import DebriefFeature
from app.views.exercise.feature import ExerciseFeature
from app.views.exercise.status import StatusCell, StatusStrip
from app.views.exercise.status_items import depth_item
from app.views.kit import theme
from app.views.kit.background import BackgroundTask
from app.views.kit.names import NAMES
from app.views.kit.themes import DARK, LIGHT, THEMES, restyled, translated
from app.views.plan.paths import PathsFeature
from app.views.robot.feature import RobotFeature
from app.views.robot.health_panel import _Line
from app.views.shell.remembered import SMALLEST
from app.views.shell.window import MainWindow
from app.views.slices.panes import PANE_MARKS, PaneId
from app.views.slices.plane import own_plane, presented
from app.views.slices.presentation import OperatorSide, Presentation, Slab, Turn, side_name, turns


@pytest.fixture
def desk_again(application):
    yield
    NAMES.hide(False)
    theme.apply_theme(application)


# --- themes -----------------------------------------------------------------------------------
@pytest.mark.parametrize("shown", THEMES.values(), ids=THEMES)
def test_the_colours_of_a_theme_are_all_different_so_that_they_map(shown):
    values = list(shown.colours().values())
    assert len(values) == len(set(values))
    other = LIGHT if shown is DARK else DARK
    assert [translated(translated(v, other), shown) for v in values] == values
    assert not set(values) & set(other.colours().values())


@pytest.mark.parametrize("shown", THEMES.values(), ids=THEMES)
def test_words_stand_out_from_what_they_stand_on(shown):
    """WCAG 2.1: at least 4.5 to 1."""
    grounds = (shown.background, shown.surface, shown.raised, shown.field)
    for name in ("text", "dim", "accent", "good", "warning", "bad", "entry", "target"):
        worst = min(contrast(getattr(shown, name), ground) for ground in grounds)
        assert worst >= 4.5, (name, worst)
    assert contrast(shown.on_accent, shown.accent) >= 4.5


def contrast(one, other):
    light, dark = sorted((luminance(one), luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def luminance(colour):
    return float(linear(colour) @ [0.2126, 0.7152, 0.0722])


def linear(colour):
    srgb = np.array([int(colour[n : n + 2], 16) for n in (1, 3, 5)]) / 255.0
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def test_style_sheets_change_colour_and_size_and_back():
    sheet = f"color: {DARK.accent}; font-size: 13px; background: #123456;"
    light = restyled(sheet, LIGHT, 1.3)
    assert light == f"color: {LIGHT.accent}; font-size: 17px; background: #123456;"
    assert restyled(light, DARK, 1 / 1.3) == sheet
    for size in range(8, 60):
        larger = restyled(f"font-size: {size}px", LIGHT, theme.LARGE)
        assert restyled(larger, DARK, 1 / theme.LARGE) == f"font-size: {size}px"


# --- projector --------------------------------------------------------------------------------
@pytest.mark.long("journey")
def test_projector_mode_is_light_large_and_without_names_and_ends(window, patient, desk_again):
    window.show_patient(patient)
    dark, small = QApplication.instance().styleSheet(), window.workspace.side.width()
    sheets = {w: w.styleSheet() for w in window.findChildren(QLineEdit) if w.styleSheet()}
    window.projector.set_all(True)
    assert window.projector.is_on
    assert LIGHT.surface in QApplication.instance().styleSheet()
    assert window.workspace.side.width() > small
    assert "CT-TEST" not in window.windowTitle()
    assert HIDDEN in window.windowTitle()
    titles = [pane.readouts.title.text() for pane in window.workspace.panes]
    assert not any("CT-TEST" in title for title in titles)
    assert window.workspace.exercise_panel.student.echoMode() is QLineEdit.EchoMode.Password
    window.projector.set_all(False)
    assert QApplication.instance().styleSheet() == dark
    assert {w: w.styleSheet() for w in sheets} == sheets
    assert "CT-TEST" in window.windowTitle()


def test_what_the_status_strip_said_in_usual_text_has_room_in_large_text(
    application, desk_again, settle
):
    strip = StatusStrip()
    strip.show_items((depth_item("tracked", 0.01),))
    strip.show()
    for large in (True, False, True):
        theme.apply_theme(application, DARK, theme.LARGE if large else 1.0)
        strip.resize(strip.minimumSizeHint())  # in a window without room to spare
        settle(timeout=0.1)
        for label in strip.findChildren(QLabel):
            needed = label.fontMetrics().horizontalAdvance(label.text())
            assert label.width() >= needed, (label.text(), large)
    strip.close()


@pytest.mark.parametrize(("width", "size"), [(SMALLEST[0], 1.0), (1180, theme.LARGE)])
def test_in_a_small_window_every_title_of_the_status_strip_is_whole(
    application, desk_again, settle, width, size
):
    theme.apply_theme(application, DARK, size)
    strip, item = StatusStrip(), depth_item("tracked", 0.01)
    titles = ("Screen and needle", "Robot loop", "Encoders", "Cameras", "Depth", "Heartbeat")
    said = "1012 Hz · late 0.04 / 0.12 ms · 0.2 % missed"
    strip.show_items([replace(item, title=one, text=said) for one in (*titles, "Recorder")])
    strip.setFixedWidth(width)
    strip.show()
    settle(timeout=0.1)
    cells = [cell for cell in strip.findChildren(StatusCell) if cell.isVisible()]
    assert len(cells) == 7
    for cell, after in pairwise(cells):
        assert cell.geometry().right() < after.geometry().left()
    assert strip.rect().contains(cells[-1].geometry())
    for cell in cells:
        assert not cell.findChildren(QLabel)[0].text().endswith("…")
        assert said in cell.toolTip()
    strip.close()


@pytest.mark.long("journey")
def test_in_the_smallest_window_work_beside_it_leaves_the_menus_free_in_large_text(
    application, window, desk_again, settle
):
    theme.apply_theme(application, DARK, theme.LARGE)
    window.resize(*SMALLEST)
    gate = threading.Event()
    task = BackgroundTask(window, lambda progress: gate.wait(20), print, print)
    try:
        window.progress.show_task(task.open(), "Starting robot and cameras: compiling the loop")
        settle(timeout=0.2)
        assert window.notices.isVisible()
        bar = window.menuBar()
        for action in bar.actions():
            assert not window.notices.geometry().intersects(bar.actionGeometry(action))
    finally:
        gate.set()
        settle(lambda: window.progress.count == 0)


def test_a_status_strip_without_room_ends_its_words_in_an_ellipsis(application, settle):
    strip, item = StatusStrip(), depth_item("tracked", 0.01)
    strip.show_items([replace(item, title=f"Screen and needle {n}") for n in range(7)])
    strip.setFixedWidth(400)
    strip.show()
    settle(timeout=0.1)
    labels = [label for label in strip.findChildren(QLabel) if label.isVisible()]
    for label in labels:
        assert label.width() >= label.fontMetrics().horizontalAdvance(label.text()), label.text()
    cut = [label for label in labels if label.text().endswith("…")]
    assert cut
    assert all(one.toolTip() == one.whole for one in cut)
    strip.setFixedWidth(4000)
    settle(timeout=0.1)
    assert not [label.text() for label in labels if label.text().endswith("…")]
    strip.close()


@pytest.mark.long("journey")
def test_titles_of_the_robots_health_are_whole_in_large_text(window, patient, desk_again, settle):
    window.show_patient(patient)
    plan(window)
    panel = window.feature(RobotFeature).panel
    window.feature(RobotFeature).show_health()
    assert settle(lambda: len(titles_of(panel)) > 0)
    for large in (False, True, False):
        window.projector.set_large(large)
        settle(timeout=0.1)
        for label in titles_of(panel):
            needed = label.fontMetrics().horizontalAdvance(label.text())
            assert label.width() >= needed, (label.text(), large)


def titles_of(panel):
    return [line._title for line in panel.findChildren(_Line) if line.isVisible()]


@pytest.mark.long("journey")
def test_pictures_stay_on_black_and_keep_their_colours(window, patient, desk_again):
    window.show_patient(patient)
    window.projector.set_light(True)
    pane = window.workspace.panes[0]
    assert pane.canvas.grab().toImage().pixelColor(0, pane.canvas.height() // 2).name() == "#000000"
    assert theme.on_image(LIGHT.good) == DARK.good
    assert theme.now(theme.ENTRY.colour) == LIGHT.entry


# --- remembered -------------------------------------------------------------------------------
def with_reading(shown, number, /, **reading):
    """Exercise of the list that says how it is read."""
    exercise = list(shown.feature(ExerciseFeature).exercises.values())[number]
    return exercise.model_copy(update={"reading": ReadingPart.model_validate(reading)})


def test_the_lock_is_kept_for_each_exercise_alone(window, patient):
    window.show_patient(patient)
    greys = window.workspace.viewing.greys
    first, second, *_ = window.feature(ExerciseFeature).exercises.values()
    window.conductor.set_exercise(first)
    greys.set(WindowLevel(800.0, 12.0))
    greys.set_locked(True)
    window.conductor.set_exercise(second)
    greys.set_locked(False)
    greys.set(WindowLevel(300.0, 30.0))
    window.conductor.set_exercise(first)
    assert greys.is_locked
    assert greys.common == WindowLevel(800.0, 12.0)
    window.conductor.set_exercise(second)
    assert not greys.is_locked
    assert greys.common == WindowLevel(300.0, 30.0)


@pytest.mark.long("journey")
def test_an_exercise_says_what_one_begins_with_and_later_what_one_left_counts(window, patient):
    window.show_patient(patient)
    workspace, greys = window.workspace, window.workspace.viewing.greys
    third = with_reading(window, 2, window="lung", layout="1+3")
    window.conductor.set_exercise(third)
    assert greys.common == PRESETS["Lung"]
    assert workspace.layout_name == "1+3"
    assert not greys.is_locked
    greys.set(WindowLevel(500.0, 5.0))
    workspace.show_layout("needle")
    window.conductor.set_exercise(window.feature(ExerciseFeature).exercises["first-insertion"])
    window.conductor.set_exercise(third)
    assert greys.common == WindowLevel(500.0, 5.0)
    assert workspace.layout_name == "needle"


@pytest.mark.long("journey")
def test_what_an_exercise_locks_can_be_changed_by_nobody_until_the_next(window, patient):
    window.show_patient(patient)
    workspace, greys, menu = window.workspace, window.workspace.viewing.greys, window.view_menu
    fixed = with_reading(window, 3, window="lung", layout="1+3", locked=True)
    window.conductor.set_exercise(fixed)
    greys.set_locked(False)
    greys.set(WindowLevel(500.0, 5.0))
    workspace.show_layout("2x2")
    workspace.panes[0].reset()
    menu._locked.trigger()
    menu.layouts["2x2"].trigger()
    assert greys.is_locked
    assert greys.common == PRESETS["Lung"]
    assert workspace.layout_name == "1+3"
    assert workspace.grid.shown.name == "1+3"
    assert menu._locked.isChecked()
    assert not menu._locked.isEnabled()
    assert not any(action.isEnabled() for action in menu.layouts.values())
    lock = [a for a in workspace.panes[0].build_menu().actions() if "Lock" in a.text()]
    assert not lock[0].isEnabled()
    window.conductor.set_exercise(window.feature(ExerciseFeature).exercises["first-insertion"])
    assert not greys.is_locked
    greys.set(WindowLevel(500.0, 5.0))
    workspace.show_layout("2x2")
    assert greys.common == WindowLevel(500.0, 5.0)
    assert workspace.layout_name == "2x2"
    window.conductor.set_exercise(fixed)  # whatever was remembered of it
    assert greys.common == PRESETS["Lung"]


@pytest.mark.long("journey")
def test_what_an_exercise_does_not_name_it_does_not_lock(window, patient):
    window.show_patient(patient)
    window.conductor.set_exercise(with_reading(window, 4, layout="1+3", locked=True))
    window.workspace.viewing.greys.set(WindowLevel(500.0, 5.0))
    assert window.workspace.viewing.greys.common == WindowLevel(500.0, 5.0)


@pytest.mark.long("journey")
def test_the_debrief_and_the_map_stay_readable_when_the_light_goes_on(window, patient, desk_again):
    window.show_patient(patient)
    page = window.feature(DebriefFeature).page
    page.show_review(review())
    window.workspace.messages.add_event(Event(1.0, "state", "holding"))
    window.projector.set_light(True)
    line = window.workspace.messages.item(0).foreground().color().name()
    assert contrast(line, LIGHT.field) >= 4.5
    words = [page.table.item(0, column).foreground().color().name() for column in range(4)]
    assert all(contrast(word, LIGHT.field) >= 4.5 for word in words), words
    key = window.feature(PathsFeature).panel._key.findChildren(QLabel)
    colours = [label.styleSheet().split("#")[1][:6] for label in key]
    assert all(contrast(f"#{colour}", LIGHT.background) >= 3.0 for colour in colours), colours
    assert len(set(colours)) == len(colours)


@pytest.mark.long("journey")
def test_each_exercise_is_read_as_it_was_read_before(window, patient):
    window.show_patient(patient)
    workspace, viewing = window.workspace, window.workspace.viewing
    first, second, *_ = window.feature(ExerciseFeature).exercises.values()
    window.conductor.set_exercise(first)
    workspace.show_layout("1+3")
    presentation = Presentation(Slab("mip", 8.0), Turn(1, True))
    viewing.set_presentation(PaneId.CORONAL, presentation)
    window.conductor.set_exercise(second)
    workspace.show_layout("2x2")
    viewing.set_presentation(PaneId.CORONAL, Presentation())
    window.conductor.set_exercise(first)
    assert workspace.layout_name == "1+3"
    assert viewing.presentation(PaneId.CORONAL) == presentation
    window.conductor.set_exercise(second)
    assert workspace.layout_name == "2x2"
    assert viewing.presentation(PaneId.CORONAL) == Presentation()


@pytest.mark.long("journey")
def test_scheme_hand_and_kept_windows_are_remembered(services, window, patient, destroy):
    window.show_patient(patient)
    window.view_menu.schemes["slicer"].trigger()
    window.workspace.set_left_handed(True)
    window.workspace.viewing.greys.keep("Mine", window.workspace.viewing.window)
    window.close()
    again = MainWindow(services)
    destroy(again)
    assert again.workspace.viewing.scheme.name == "slicer"
    assert again.workspace.is_left_handed
    assert "Mine" in again.workspace.viewing.greys.kept


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    "stored",
    [
        "",
        "no json",
        "[]",
        "{}",
        '{"window": [0, 1]}',
        json.dumps(
            {"window": [400, 40], "linked": True, "inverted": False, "layout": "9x9", "looks": {}}
        ),
    ],
)
def test_settings_that_cannot_be_used_are_left(services, window, destroy, stored):
    window.settings.setValue("reading", stored)
    window.settings.setValue("work", stored)
    window.settings.sync()
    again = MainWindow(services)
    destroy(again)
    assert again.workspace.layout_name == "2x2"


# --- operator's side --------------------------------------------------------------------------
def letters(volume, view, turn):
    plane = own_plane(OrthogonalSlicer(volume), view)
    return presented(plane, Presentation(turn=turn)).letters()


@pytest.mark.parametrize(("lies", "top"), [("SUPINE", "A"), ("PRONE", "P"), ("LEFT_DOWN", "R"),
                                           ("RIGHT_DOWN", "L")])  # fmt: skip
@pytest.mark.parametrize(
    "side", [OperatorSide.FEET, OperatorSide.HEAD, OperatorSide.LEFT, OperatorSide.RIGHT]
)
def test_what_is_up_on_the_table_is_on_top_of_the_axial_slice(volume, lies, top, side):
    turned = turns(side, PatientOrientation[lies])
    seen = letters(volume, View.AXIAL, turned[PaneId.AXIAL])
    assert seen[2] == top


@pytest.mark.parametrize("lies", [PatientOrientation.SUPINE, PatientOrientation.PRONE])
@pytest.mark.parametrize(("side", "near"), [
    (OperatorSide.FEET, "I"), (OperatorSide.HEAD, "S"), (OperatorSide.LEFT, "L"),
    (OperatorSide.RIGHT, "R"),
])  # fmt: skip
def test_what_is_near_the_operator_is_at_the_bottom_of_the_coronal_slice(volume, lies, side, near):
    turned = turns(side, lies)[PaneId.CORONAL]
    assert letters(volume, View.CORONAL, turned)[3] == near
    assert turned.mirrored is (lies is PatientOrientation.PRONE)  # seen from above: no other way


def test_from_the_head_left_and_right_change_places(volume):
    feet, head = (turns(side, PatientOrientation.SUPINE)[PaneId.AXIAL]
                  for side in (OperatorSide.FEET, OperatorSide.HEAD))  # fmt: skip
    assert letters(volume, View.AXIAL, feet)[:2] == ("R", "L")
    assert letters(volume, View.AXIAL, head)[:2] == ("L", "R")


@pytest.mark.long("journey")
def test_the_menu_turns_the_slices_and_back(window, patient):
    window.show_patient(patient)
    viewing, operator = window.workspace.viewing, window.view_menu.operator
    operator["right"].trigger()
    assert viewing.presentation(PaneId.CORONAL).turn == Turn(3)
    operator["convention"].trigger()
    assert not viewing.presentation(PaneId.CORONAL).turn
    assert all(side_name(side) for side in OperatorSide)


# --- colour blindness -------------------------------------------------------------------------
# Machado, Oliveira and Fernandes 2009, severity 1.0, on linear RGB.
BLINDNESS = {
    "protanopia": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216],
                   [-0.003882, -0.048116, 1.051998]],
    "deuteranopia": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
                     [-0.011820, 0.042940, 0.968881]],
    "tritanopia": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602],
                   [0.004733, 0.691367, 0.303900]],
}  # fmt: skip
SEEN_APART = 15.0
"""CIE 1976 difference from which thin lines and small marks are told apart by colour alone."""


def lab(rgb):
    xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
    ratio = xyz @ np.clip(rgb, 0.0, 1.0) / [0.9505, 1.0, 1.089]
    f = np.where(ratio > 0.008856, np.cbrt(ratio), 7.787 * ratio + 16.0 / 116.0)
    return np.array([116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])])


def difference(one, other, blindness):
    matrix = np.array(BLINDNESS[blindness]) if blindness else np.eye(3)
    return float(np.linalg.norm(lab(matrix @ linear(one)) - lab(matrix @ linear(other))))


def drawn_alike(one, other):
    return one.dash == other.dash and one.symbol is other.symbol and one.width == other.width


MARKS = {name: mark for name, mark in vars(theme).items() if isinstance(mark, theme.Mark)}
SURFACES = {"SKIN", "BONE", "ROBOT"}
"""Told apart by what they are in the 3D view, not by a mark of theirs."""


@pytest.mark.parametrize("blindness", ["", *BLINDNESS])
def test_marks_of_one_shape_and_dash_are_told_apart_by_their_colour(blindness):
    names = sorted(set(MARKS) - SURFACES)
    for number, first in enumerate(names):
        for second in names[number + 1 :]:
            one, other = MARKS[first], MARKS[second]
            if drawn_alike(one, other):
                apart = difference(one.colour, other.colour, blindness)
                assert apart >= SEEN_APART, (first, second, apart)


def test_the_planes_of_a_family_differ_in_their_dashes():
    for family in (list(PaneId)[:3], list(PaneId)[3:6]):
        dashes = [PANE_MARKS[pane].dash for pane in family]
        assert len(set(dashes)) == len(dashes)


@pytest.mark.parametrize("blindness", BLINDNESS)
def test_verdicts_have_each_its_own_symbol_whatever_their_colour(blindness):
    symbols = [symbol for _, symbol in theme.VERDICTS.values()]
    assert len(set(symbols)) == len(symbols)


@pytest.mark.long("journey")
@pytest.mark.parametrize("side", OperatorSide)
def test_a_turned_slice_is_shown_whole_and_in_the_middle(window, patient, settle, side):
    window.show_patient(patient)
    settle(timeout=0.2)
    viewing = window.workspace.viewing
    viewing.set_cursor(patient.volume.lps_mm((3.0, 3.0, 3.0)))  # far from the middle
    settle(timeout=0.1)
    window.view_menu.operator[side].trigger()
    settle(timeout=0.1)
    for pane in window.workspace.panes:
        canvas = pane.canvas
        left, top, width, height = canvas.plane.bounds_mm
        assert canvas.camera.x == pytest.approx(left + width / 2, abs=0.5), pane.pane
        assert canvas.camera.y == pytest.approx(top + height / 2, abs=0.5), pane.pane
