"""What an exercise locks can be changed by nobody, by no way; every attempt begins as it says."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from window_rig import plan

from app.compose.trainer import TrainerSetup, build_trainer
from app.core.clock import VirtualClock
from app.exercises.guidance import GuidanceMode, GuidancePart, Purpose, StartingDial
from app.exercises.library import load_exercise
from app.exercises.locks import EVERY_LOCK, HandName, Lock
from app.exercises.reading import ReadingPart
from app.exercises.scene import device_of, placed_plan_of
from app.exercises.schema import Exercise
from app.exercises.tissue import in_layers
from app.imaging.window import PRESETS, WindowLevel
from app.planning.plan import Plan
from app.session.errors import ControlLockedError
from app.views.slices.panes import PaneId
from app.views.slices.presentation import Presentation, Slab

PLAN = Plan(np.array([0.0, -100.0, 0.0]), np.array([15.0, -35.0, 10.0]), "test")


@pytest.fixture
def opened(window, patient, settle, monkeypatch):
    """Open an exercise on the small patient, which stands for its own, with a run."""
    monkeypatch.setattr(window.conductor, "_why_not_here", lambda: "")

    def open_(exercise):
        window.conductor.set_exercise(exercise)
        window.show_patient(patient)
        if window.conductor._editor.edit.draft.target_mm is None:
            plan(window)
        assert settle(lambda: window.runs.run is not None and window.conductor.settled)
        window.conductor.controller._timer.stop()
        window.workspace.show_exercise()
        settle(timeout=0.05)
        return window

    return open_


def wheel(widget, notches):
    at = QPointF(widget.rect().center())
    event = QWheelEvent(
        at, QPointF(widget.mapToGlobal(at.toPoint())), QPoint(0, 0), QPoint(0, 120 * notches),
        Qt.MouseButton.NoButton, Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase,
        False,
    )  # fmt: skip
    QApplication.sendEvent(widget, event)


# --- assistance -------------------------------------------------------------------------------
@pytest.mark.long("journey")
def test_the_dial_of_against_repulsion_cannot_be_turned_in_the_window(opened):
    window = opened(load_exercise("against-repulsion"))
    panel = window.workspace.exercise_panel
    slider = panel.assistance.slider
    turned = []
    panel.assistance_changed.connect(turned.append)
    slider.setFocus()
    QTest.keyClick(slider, Qt.Key.Key_Right)
    QTest.keyClick(slider, Qt.Key.Key_Home)
    QTest.mouseDClick(slider, Qt.MouseButton.LeftButton)
    QTest.mouseClick(slider, Qt.MouseButton.LeftButton, pos=QPoint(slider.width() - 3, 8))
    wheel(slider, 5)
    assert turned == []
    assert panel.assistance.share == -0.5
    assert "Against repulsion" in panel.assistance.toolTip()
    assert "fixed" in panel._dial_title.text()


def trainer_of(exercise, folder):
    placed = placed_plan_of(exercise, device_of(exercise), PLAN)
    setup = TrainerSetup(in_layers(exercise), placed, sessions=folder, clock=VirtualClock(10.0))
    trainer = build_trainer(setup)
    trainer._loop.open()
    return trainer


@pytest.mark.long("journey")
def test_the_trainer_itself_refuses_to_turn_a_locked_dial(tmp_path):
    trainer = trainer_of(load_exercise("against-repulsion"), tmp_path)
    trainer.step()
    with pytest.raises(ControlLockedError, match=r"keeps the assistance at -0\.5"):
        trainer.assistance(0.65)
    assert trainer.step().assistance == -0.5


@pytest.mark.long("journey")
@pytest.mark.parametrize("probe", [False, True])
def test_the_trainer_refuses_help_where_control_scans_guide_and_in_a_probe(tmp_path, probe):
    exercise = load_exercise("first-insertion")
    by_scans = GuidancePart(mode=GuidanceMode.CONTROL_CT)
    exercise = (
        exercise.beginning_with(StartingDial(0.0, is_probe=True))
        if probe
        else exercise.model_copy(update={"guidance": by_scans, "assistance": 0.0})
    )
    trainer = trainer_of(exercise, tmp_path)
    trainer.step()
    trainer.begin()
    with pytest.raises(ControlLockedError, match="keeps the assistance at 0"):
        trainer.assistance(0.88)
    assert trainer.step().assistance == 0.0
    trainer.close()


@pytest.mark.long("journey")
def test_the_controller_says_that_a_dial_is_locked_and_shows_what_it_is(opened, tmp_path):
    window = opened(load_exercise("against-repulsion"))
    controller, run = window.conductor.controller, window.runs.run
    trainer = trainer_of(load_exercise("against-repulsion"), tmp_path)
    trainer.step()
    run.trainer.assistance, run.trainer.snapshot = trainer.assistance, trainer.snapshot
    said = []
    controller.failed.connect(said.append)
    controller.set_assistance(0.65)
    assert "keeps the assistance" in said[0]
    assert window.workspace.exercise_panel.assistance.share == -0.5
    assert trainer.snapshot().assistance == -0.5


@pytest.mark.long("journey")
def test_a_free_dial_says_so_and_every_attempt_begins_with_the_exercises(opened, tmp_path):
    window = opened(load_exercise("first-insertion"))
    panel = window.workspace.exercise_panel
    assert "free to turn" in panel._dial_title.text()
    panel.assistance.slider.setValue(-100)
    window.conductor.controller.begin("")
    assert panel.assistance.share == 0.7
    trainer = trainer_of(load_exercise("first-insertion"), tmp_path)
    trainer.step()
    trainer.assistance(-1.0)
    trainer.begin("tester")
    assert trainer.step().assistance == 0.7
    trainer.assistance(0.2)
    trainer.step()
    trainer.end()
    trainer.begin("tester")
    assert trainer.step().assistance == 0.7
    trainer.abort()


# --- reading ----------------------------------------------------------------------------------
def reading_of(window):
    workspace = window.workspace
    greys = workspace.viewing.greys
    windows = {pane: greys.of(pane) for pane in PaneId}
    slabs = {pane: workspace.viewing.presentation(pane).slab for pane in PaneId}
    return windows, slabs, workspace.layout_name


@pytest.mark.long("journey")
def test_an_assessment_keeps_window_slab_and_layout_whatever_one_does(opened, settle):
    window = opened(load_exercise("scans-only"))
    workspace, viewing, greys = (
        window.workspace,
        window.workspace.viewing,
        window.workspace.viewing.greys,
    )
    before = reading_of(window)
    assert before == (
        dict.fromkeys(PaneId, PRESETS["Soft tissue"]), dict.fromkeys(PaneId, Slab()), "2x2"
    )  # fmt: skip
    pane = workspace.panes[0]
    pane.canvas.setFocus()
    for key in "0123456789tTiIbB[]pP":
        QTest.keyClicks(pane.canvas, key)
    if greys.is_inverted:
        greys.set_inverted(False)
    viewing.set_tool(viewing.tool.NAVIGATE)
    greys.set_locked(False)
    greys.set_linked(False)
    viewing.set_window(WindowLevel(77.0, 7.0), PaneId.AXIAL)
    viewing.set_window(WindowLevel(77.0, 7.0))
    viewing.set_presentation(PaneId.AXIAL, Presentation(Slab("mip", 20.0)))
    pane.actions_of.next_kind()
    pane.actions_of.reset()
    workspace.show_layout("6-up")
    for action in window.view_menu.layouts.values():
        assert not action.isEnabled()
        action.trigger()
    assert "assessment" in window.view_menu.layouts["needle"].toolTip()
    window.view_menu._locked.trigger()
    assert reading_of(window) == before
    greys.set_linked(True)


@pytest.mark.long("journey")
def test_an_attempt_begins_with_the_window_slab_and_layout_of_its_exercise(opened):
    part = ReadingPart.model_validate(
        {"window": "lung", "slab": {"kind": "mip", "thickness_mm": 10}, "layout": "1+3"}
    )
    window = opened(load_exercise("first-insertion").model_copy(update={"reading": part}))
    workspace, viewing = window.workspace, window.workspace.viewing
    viewing.set_window(WindowLevel(77.0, 7.0))
    viewing.set_presentation(PaneId.AXIAL, Presentation())
    workspace.show_layout("needle")
    window.conductor.controller.begin("")
    assert viewing.window == PRESETS["Lung"]
    assert {viewing.presentation(pane).slab for pane in PaneId} == {Slab("mip", 10.0)}
    assert workspace.layout_name == "1+3"
    viewing.set_window(WindowLevel(77.0, 7.0))
    assert viewing.window == WindowLevel(77.0, 7.0)  # not locked: only the beginning is the same


@pytest.mark.long("journey")
def test_leaving_an_assessment_gives_everything_back(opened):
    window = opened(load_exercise("scans-only"))
    window = opened(load_exercise("first-insertion"))
    viewing, source = window.workspace.viewing, window.workspace.bullseye.source
    viewing.set_presentation(PaneId.AXIAL, Presentation(Slab("mip", 20.0)))
    assert viewing.presentation(PaneId.AXIAL).slab == Slab("mip", 20.0)
    assert not viewing.greys.is_locked
    assert source.box.isEnabled()
    assert window.view_menu.layouts["needle"].isEnabled()


# --- hand -------------------------------------------------------------------------------------
@pytest.mark.long("journey")
def test_a_locked_hand_is_the_exercises_and_no_other_can_be_chosen(opened):
    window = opened(load_exercise("first-insertion"))
    source = window.workspace.bullseye.source
    source.set_source("tablet")
    source.gain.setCurrentIndex(source.gain.findData("fine"))
    window.conductor.set_exercise(load_exercise("scans-only"))
    assert (source.name, source.gain.currentData()) == ("mouse", "direct")
    assert not source.box.isEnabled()
    assert not source.gain.isEnabled()
    assert "assessment" in source.box.toolTip()
    source.set_source("tablet")
    source.set_locked(False)
    source.set_interactive(True)
    assert source.name == "mouse"
    assert not source.box.isEnabled()
    window.conductor.set_exercise(load_exercise("first-insertion"))
    assert (source.name, source.gain.currentData()) == ("tablet", "fine")


@pytest.mark.long("journey")
def test_an_attempt_begins_with_the_hand_that_its_exercise_names(opened):
    named = load_exercise("first-insertion").model_copy(update={"hand": HandName.TABLET})
    window = opened(named)
    source = window.workspace.bullseye.source
    source.set_source("mouse")
    window.conductor.controller.begin("")
    assert source.name == "tablet"


# --- the file ---------------------------------------------------------------------------------
def test_an_assessment_locks_all_and_an_old_file_in_practice_nothing():
    assert load_exercise("scans-only").locked == EVERY_LOCK
    old = Exercise.model_validate({"id": "a", "title": "A"})
    assert old.locked == frozenset()
    assert old.model_copy(update={"purpose": Purpose.ASSESSMENT}).locked == EVERY_LOCK
    with pytest.raises(ValueError, match="views, hand is missing"):
        Exercise.model_validate(
            {"id": "a", "title": "A", "purpose": "assessment", "locks": ["assistance", "reading"]}
        )
    with pytest.raises(ValueError, match="'assistance', 'views', 'reading', 'hand' or 'models'"):
        Exercise.model_validate({"id": "a", "title": "A", "locks": ["dial"]})
    assert Lock.ASSISTANCE in load_exercise("against-repulsion").locked
