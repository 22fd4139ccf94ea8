"""The end of the window while an attempt runs: asked for, and nothing that was recorded is lost."""

import pytest
from PySide6.QtCore import Qt, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMessageBox
from window_rig import plan, state

from app.session.index import Index
from app.session.interrupted import interrupted
from app.session.machine import State
from app.views.kit.parts import ask


@pytest.fixture
def asked(monkeypatch):
    """What was asked in boxes with buttons of their own; each is answered as `press` says."""
    boxes = []

    def answer(box):
        boxes.append((box.text(), box.informativeText(), box.defaultButton().text()))
        press(box)

    def press(box):
        box.defaultButton().click()

    def by(name):
        nonlocal press

        def press(box):
            next(one for one in box.buttons() if one.text() == name).click()

    boxes_by = type("Asked", (list,), {"by": staticmethod(by)})
    boxes = boxes_by()
    monkeypatch.setattr(QMessageBox, "exec", answer)
    return boxes


@pytest.fixture
def under_way(window, patient, settle):
    window.show_patient(patient)
    plan(window)
    window.editor.saved(None)
    assert settle(lambda: window.runs.run is not None)
    window.runs.run.trainer.begin()
    assert settle(lambda: window.editor.locked)
    return window


@pytest.mark.long("journey")
def test_closing_the_window_in_an_attempt_asks_and_enter_stays(under_way, asked):
    assert not under_way.close()
    assert [words for words, *_ in asked] == ["An attempt is running. End it and quit?"]
    assert "recorded so far stays" in asked[0][1]
    assert asked[0][2] == "Go on with the attempt"
    assert state(under_way) is State.ALIGNING
    assert under_way.isVisible()


@pytest.mark.long("journey")
def test_the_key_asks_too_and_who_confirms_leaves(under_way, asked, services):
    asked.by("End it and quit")
    under_way.activateWindow()
    QApplication.processEvents()
    QTest.keyClick(under_way, Qt.Key.Key_Q, Qt.KeyboardModifier.ControlModifier)
    assert len(asked) == 1
    assert not under_way.isVisible()
    assert services.opened[0].run.trainer.state is State.ABORTED
    assert services.opened[0].closed.is_set()


@pytest.mark.long("journey")
def test_between_attempts_nothing_is_asked(under_way, asked, settle):
    under_way.runs.run.trainer.state = State.ENDED
    assert settle(lambda: not under_way.editor.locked)
    assert under_way.close()
    assert asked == []


@pytest.mark.parametrize("key", [Qt.Key.Key_Escape, Qt.Key.Key_Return])
def test_escape_and_enter_give_the_answers_that_they_are_told_to(application, monkeypatch, key):
    shown = QMessageBox.show

    def exec_(box):
        shown(box)
        QTimer.singleShot(0, lambda: QTest.keyClick(box, key))
        while box.isVisible():
            application.processEvents()

    monkeypatch.setattr(QMessageBox, "exec", exec_)
    answer = ask(None, "T", "Words?", "", ("first", "second", "third"), default=1, escape=2)
    assert answer == (2 if key == Qt.Key.Key_Escape else 1)


@pytest.mark.long("journey")
def test_what_was_recorded_stays_and_the_next_start_has_nothing_to_mend(
    real, asked, settle, tmp_path
):
    real.editor.saved(None)
    real.workspace.show_exercise()
    panel = real.workspace.exercise_panel
    assert settle(panel.buttons.start.isEnabled)
    panel.buttons.start.click()
    assert settle(lambda: real.conductor.controller.is_running)
    settle(lambda: False, 0.5)
    asked.by("End it and quit")
    folder = tmp_path / "sessions"
    assert real.close()
    index = Index(folder)
    index.refresh()
    (attempt,) = index.attempts()
    assert attempt.state == State.ABORTED.value
    left, _ = interrupted(folder)
    assert left == [], "nothing to be mended at the next start"


@pytest.mark.long("journey")
def test_nobody_leaves_an_attempt_for_the_start_page_while_its_clock_runs(under_way):
    under_way.show_workspace()
    under_way.show_start()
    assert under_way.pages.currentWidget() is not under_way.start_page
    assert "end it before you go to the start page" in under_way.message_bar.text


@pytest.mark.long("journey")
def test_while_an_ended_attempt_is_scored_the_window_says_so_and_takes_no_order(under_way, settle):
    buttons = under_way.workspace.exercise_panel.buttons
    assert buttons.end.isEnabled()
    under_way.conductor.controller.ending.emit(True)
    settle(timeout=0.3)
    assert not any(one.isEnabled() for one in (buttons.start, buttons.scan, buttons.end))
    assert under_way.workspace.next_step.text() == "Ended: the score is being worked out"
    under_way.conductor.controller.ending.emit(False)
    assert settle(buttons.end.isEnabled)
