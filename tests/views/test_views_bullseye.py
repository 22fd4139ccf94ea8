"""The bull's-eye in the whole window: its size, the mouse through the window, what is held."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from views_exercise_fakes import FakeTrainer as Recorder
from views_exercise_fakes import pose as pose_of
from views_exercise_fakes import snapshot as snapshot_of

from app.exercises.library import load_exercise
from app.planning.placement import PatientOrientation, Placement
from app.session.curves import offset
from app.session.machine import State
from app.views.exercise.run import ExerciseRun
from app.views.kit import theme
from app.views.reading.layouts import LAYOUTS
from app.views.slices.viewing import Tool

LEFT = Qt.MouseButton.LeftButton
ENTRIES = {
    PatientOrientation.SUPINE: (5.0, -18.0, 140.0),
    PatientOrientation.PRONE: (5.0, 16.0, 140.0),
    PatientOrientation.LEFT_DOWN: (-12.0, 5.0, 140.0),
    PatientOrientation.RIGHT_DOWN: (22.0, 5.0, 140.0),
}
"""On the side that lies upwards [mm]."""


@pytest.fixture
def at_work(window, patient, settle):
    """Show a needle outside the skin of a patient who lies somehow; returns the window."""

    def show(lies=PatientOrientation.SUPINE):
        window.conductor.set_exercise(load_exercise("first-insertion"))
        window.show_patient(patient)
        window.editor.set_placement(Placement(orientation=lies))
        window.editor.place(Tool.ENTRY, ENTRIES[lies], True)
        window.editor.place(Tool.TARGET, (5.0, 5.0, 140.0), True)
        assert settle(lambda: window.runs.run is not None)
        run = window.runs.run
        placed = run.placed
        where = pose_of(placed, 0.0, -0.01)
        moment = snapshot_of(placed, pose=where, offset=offset(where, placed.p_target, placed))
        trainer = Recorder(placed, now=moment)
        window.conductor._attach(ExerciseRun(trainer, placed, run.profile, interactive=True))
        window.conductor.controller._timer.stop()
        window.workspace.show_exercise()
        window.conductor.controller.poll()
        settle(timeout=0.05)
        window.trainer = trainer
        return window

    return show


def ends(bullseye):
    """Where the tip and the hub of the wanted needle are drawn, to the right and upwards [px]."""
    scene, direction = bullseye._scene, bullseye.hand.direction
    area, frame = bullseye.pad.area, scene.frame
    for sign in (1.0, -1.0):
        point = sign * scene.target_depth * direction
        place = scene.scale.place_of_offset([point @ frame.right, point @ frame.up])
        at = area.point(place)
        yield np.array([at.x(), -at.y()])


@pytest.mark.long("journey")
@pytest.mark.parametrize("lies", list(PatientOrientation))
@pytest.mark.parametrize("hub", [False, True])
def test_the_mouse_in_the_window_takes_the_chosen_end_where_it_goes_however_the_patient_lies(
    at_work, lies, hub
):
    window = at_work(lies)
    bullseye = window.workspace.bullseye
    bullseye.source.set_moves_hub(hub)
    middle = bullseye.pad.mapTo(window, bullseye.pad.rect().center())
    handle = window.windowHandle()
    for way in ((40, 0), (-40, 0), (0, 40), (0, -40)):
        before = list(ends(bullseye))
        there = middle + QPoint(way[0], -way[1])
        QTest.mousePress(handle, LEFT, pos=middle)
        QTest.mouseMove(handle, there)
        QTest.mouseRelease(handle, LEFT, pos=there)
        QApplication.processEvents()
        tip, end = (now - was for now, was in zip(ends(bullseye), before, strict=True))
        moved, other = (end, tip) if hub else (tip, end)
        assert float(moved @ way) / 40.0 > 5.0
        assert float(other @ way) < 0.0


@pytest.mark.long("journey")
def test_the_bullseye_is_the_largest_instrument_of_the_exercise_on_a_small_screen(
    application, at_work, settle
):
    window = at_work()
    workspace, widest = window.workspace, {}
    for size in ((1366, 768), (1920, 1080)):
        window.resize(*size)
        for name in LAYOUTS:
            workspace.show_layout(name)
            settle(timeout=0.05)
            cell = workspace.needle_cell.size()
            others = [
                pane.size()
                for pane in workspace.grid._panes.values()
                if pane.isVisible() and not pane.isAncestorOf(workspace.needle_cell)
            ]
            area = cell.width() * cell.height()
            assert all(one.width() * one.height() < area for one in others), name
            assert min(min(one.width(), one.height()) for one in others) >= 195, name
            widest[size, name] = 2.0 * workspace.bullseye.pad.area.radius
    assert widest[(1366, 768), "2x2"] >= 280.0
    assert widest[(1920, 1080), "2x2"] >= 450.0


@pytest.mark.long("journey")
def test_the_legend_is_hidden_and_shown_and_the_choice_outlives_the_window(at_work, settle):
    window = at_work()
    window.resize(1366, 768)
    settle(timeout=0.05)
    bullseye, menu = window.workspace.bullseye, window.view_menu
    assert bullseye._marks.isVisible()
    assert "right button: push" in bullseye.source._help.text()
    bullseye.legend.click()
    assert not bullseye._marks.isVisible()
    assert not bullseye.source._help.isVisible()
    assert "dot" in bullseye.legend.toolTip()
    assert not menu.legend.isChecked()
    menu.hub.trigger()
    window.workspace.status.set_detailed(True)
    state = window.remembered._work()
    assert (state["legend"], state["moves_hub"], state["detailed"]) == (False, True, True)
    menu.legend.trigger()
    assert bullseye._marks.isVisible()
    window.remembered._set_work(state)
    assert not bullseye._marks.isVisible()


@pytest.mark.long("journey")
@pytest.mark.parametrize("after", [State.PAUSED, State.ENDED, State.ABORTED])
def test_a_key_that_is_held_while_the_attempt_pauses_or_ends_moves_nothing_more(at_work, after):
    window = at_work()
    controller, bullseye = window.conductor.controller, window.workspace.bullseye
    trainer = window.trainer
    trainer.now = replace(trainer.now, state=State.ALIGNING)
    controller.poll()
    QTest.keyPress(bullseye.pad, Qt.Key.Key_PageDown)
    assert bullseye.pad.feed.is_held
    trainer.now = replace(trainer.now, state=State.INSERTING)
    controller.poll()
    assert bullseye.pad.feed.is_held  # what is held takes the needle through the skin
    trainer.now = replace(trainer.now, state=after)
    controller.poll()
    assert not bullseye.pad.feed.is_held
    before = bullseye.hand.depth
    QTest.qWait(400)
    assert bullseye.hand.depth == before
    QTest.keyRelease(bullseye.pad, Qt.Key.Key_PageDown)


@pytest.mark.long("journey")
def test_large_text_at_the_smallest_size_cuts_no_word_of_the_bullseye(application, at_work, settle):
    window = at_work()
    try:
        window.projector.set(large=True)
        window.resize(1366, 768)
        settle(timeout=0.1)
        bullseye = window.workspace.bullseye
        for label in bullseye._words:
            room = label.contentsRect()
            flags = Qt.TextFlag.TextWordWrap
            needed = label.fontMetrics().boundingRect(room, flags, label.text())
            assert not label.isVisible() or needed.height() <= room.height() + 1, label.text()
        assert 2.0 * bullseye.pad.area.radius >= 200.0
    finally:
        theme.apply_theme(application)
