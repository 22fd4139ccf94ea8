"""What a student chooses for a control scan, in the panel, by mouse and keys."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from test_views_control_scan import guided, scan_event  # noqa: F401  (a fixture)

from app.exercises.guidance import GuidancePart, ScanChoice
from app.imaging.scan_look import ScanLook
from app.imaging.scan_order import ScanNeedle, ScanOrder
from app.session.control_scan import ControlScan
from app.views.debrief.page import cells
from app.views.exercise.scan_view import ScanView, caption

ASKED = GuidancePart(streak=True, tube_current=(20.0, 50.0, 100.0), leave_room_s=20.0,
                     gantry_tilt=True, interval_mm=8.0)  # fmt: skip


@pytest.fixture
def chosen(guided):  # noqa: F811
    """A window with a run whose exercise offers every choice, and its trainer."""
    window, trainer = guided
    run = replace(window.conductor.controller.run, guidance=ASKED)
    window.conductor._attach(run)
    window.workspace.show_exercise()
    return window, trainer


@pytest.mark.long("journey")
def test_a_plain_exercise_offers_nothing(guided) -> None:  # noqa: F811
    window, _ = guided
    window.workspace.show_exercise()
    assert not window.workspace.exercise_panel.scan.choices.isVisible()


@pytest.mark.long("journey")
def test_choices_go_with_the_pedal(chosen) -> None:
    window, trainer = chosen
    panel = window.workspace.exercise_panel
    choices = panel.scan.choices
    assert choices.isVisible()
    assert choices.choice == ScanChoice(50.0, leaves=True)
    trainer.begin()
    window.conductor.controller.poll()
    QTest.keyClick(choices.current, Qt.Key.Key_Down)
    QTest.keyClick(choices.leaves, Qt.Key.Key_Space)
    QTest.keyClick(choices.tilt, Qt.Key.Key_Up)
    panel.scan.table.setValue(141.0)
    panel.buttons.scan.click()
    ((_, order, choice),) = trainer.told("scan")
    assert choice == ScanChoice(100.0, leaves=False)
    assert (order.tilt_deg, order.interval_mm, order.centre_mm) == (2.5, 8.0, 141.0)
    for widget in (choices.current, choices.tilt, choices.leaves):
        assert widget.toolTip()


@pytest.mark.long("journey")
def test_the_dotted_lines_lean_with_the_gantry(chosen, settle) -> None:
    window, _ = chosen
    panel = window.workspace.exercise_panel.scan
    _, sagittal, _ = window.conductor.scans.ranges
    panel.choices.tilt.setValue(10.0)
    settle()
    (start, end), _ = sagittal.lines
    slope = abs((end.y() - start.y()) / (end.x() - start.x()))
    assert slope == pytest.approx(np.tan(np.radians(10.0)), abs=1e-3)


@pytest.mark.long("journey")
def test_the_table_goes_where_the_tilted_slice_meets_the_crosshair(chosen) -> None:
    window, _ = chosen
    panel = window.workspace.exercise_panel.scan
    panel.choices.tilt.setValue(-15.0)
    window.workspace.viewing.set_cursor((3.0, 40.0, 150.0))
    panel.here.click()
    met = panel.order.in_gantry(np.asarray(window.workspace.viewing.cursor_mm))
    assert met[2] == pytest.approx(panel.order.centre_mm, abs=0.06)  # the field has 0.1 mm


@pytest.mark.long("journey")
def test_the_wait_outside_is_seen_and_no_second_scan_is_taken(chosen) -> None:
    window, trainer = chosen
    panel, controller = window.workspace.exercise_panel, window.conductor.controller
    trainer.begin()
    controller.poll()
    assert panel.buttons.scan.isEnabled()
    trainer.now = replace(trainer.now, out_of_room=13.0)
    controller.poll()
    assert not panel.buttons.scan.isEnabled()
    assert panel.scan.choices.way.isVisible()
    assert panel.scan.choices.way.format() == "leaving: 13 s"
    trainer.now = replace(trainer.now, out_of_room=4.0)
    controller.poll()
    assert panel.scan.choices.way.format() == "coming back: 4 s"
    assert panel.scan.choices.way.value() == 800
    trainer.now = replace(trainer.now, out_of_room=None)
    controller.poll()
    assert not panel.scan.choices.way.isVisible()
    assert panel.buttons.scan.isEnabled()


@pytest.mark.long("journey")
def test_the_dose_of_the_hand_is_summed_beside_the_other(chosen, settle) -> None:
    window, trainer = chosen
    window.conductor.controller.begin("s")
    needle = ScanNeedle(np.array([5.0, -150.0, 140.0]), np.array([5.0, 0.0, 140.0]))
    order = ScanOrder(140.0, 3, 4.0, 8.0, 10.0, 5.0)
    scan = ControlScan(1, 3.0, order, needle, np.zeros(3), 3.85, False, ScanLook(),
                       ScanChoice(50.0), 2.5)  # fmt: skip
    data = {"number": 1} | scan.data()
    trainer.events.put(replace(scan_event(), data=data))
    view = window.workspace.scan_view
    assert settle(lambda: view.scan is not None)
    count = window.workspace.exercise_panel.scan.count.text()
    assert "hand 2 µSv (teaching estimate)" in count
    words = [tile.words for tile in view.wall.tiles[0]]
    assert words == ["S 148.0", "S 140.0", "S 132.0"][: len(words)]  # the head on the left
    assert "50 mA" in view._caption.text()
    assert "gantry tilted by 10°" in cells(scan, 3.0)[2]


@pytest.mark.long("journey")
def test_of_five_slices_those_about_the_tip_are_in_sight(window) -> None:
    view = ScanView(window.workspace.viewing)
    view.resize(700, 500)
    view.wall.resize(700, 500)  # three columns
    from test_views_scan_wall_ways import patient_of

    order = ScanOrder(140.0, 5, 4.0)
    needle = ScanNeedle(np.array([5.0, -150.0, 144.0]), np.array([5.0, 0.0, 144.0]))
    scan = ControlScan(1, 3.0, order, needle, np.zeros(3), 3.85)
    view.show_scan(scan.picture(patient_of((1, 0, 0, 0, 1, 0))), scan, 3.0)
    assert [tile.words for tile in view.wall.tiles[0]] == ["S 148.0", "S 144.0", "S 140.0"]
    assert caption(scan, 3.0).startswith("Control scan 1 at 0:03")


def test_the_caption_says_once_that_its_doses_are_estimates() -> None:
    needle = ScanNeedle(np.array([5.0, -150.0, 144.0]), np.array([5.0, 0.0, 144.0]))
    scan = ControlScan(1, 3.0, ScanOrder(140.0, 3, 3.0), needle, np.zeros(3), 3.85)
    plain = "Control scan 1 at 0:03 · 3 × 3 mm · 3.9 mGy·cm"
    assert caption(scan, 3.0) == f"{plain} (teaching estimate)"
    scan = replace(scan, hand_usv=2.5)
    assert caption(scan, 3.0) == f"{plain} · hand 2.5 µSv (teaching estimate)"
