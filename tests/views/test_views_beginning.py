"""From the wish to begin an exercise to its attempt, through the whole window."""

import pytest

pytest.importorskip("PySide6")

from PySide6.QtCore import QCoreApplication, QEvent, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDialog, QLineEdit, QPushButton
from window_rig import choose, press, state

from app.core import state_vector as sv
from app.exercises.library import load_exercise
from app.planning.plan import Plan
from app.session.machine import State
from app.session.motion import ShownMotion
from app.views.debrief.feature import DebriefFeature
from app.views.exercise.beginning import LINGER_S, TRAINEE_DONE, BeginWish
from app.views.exercise.briefing import aid_words, locked_words, scored_words
from app.views.exercise.feature import ExerciseFeature
from app.views.kit.roles import Role
from app.views.shell.role_switch import RoleSwitch

PHANTOM = Plan((-70.0, -109.0, 180.0), (-70.0, -20.0, 180.0), "phantom")


@pytest.mark.long("journey")
def test_begin_on_the_start_page_shows_the_briefing_and_enter_begins_the_attempt(
    window, beginning, settle
):
    choose(window, "first-insertion")
    assert window.pages.currentWidget() is beginning.page
    assert beginning.page.title.text() == "First insertion"
    assert "Off the path" in beginning.page.scored.text()
    assert window.conductor.patient is None  # nothing is opened for one who only reads
    press(window, Qt.Key.Key_Return)
    assert settle(lambda: state(window) is State.ALIGNING)
    assert window.pages.currentWidget() is window.workspace
    assert "bullseye" in window.workspace.grid.shown.panes
    assert beginning.wish is BeginWish.NOTHING


@pytest.mark.long("journey")
def test_enter_pressed_twice_begins_one_attempt(window, beginning, settle, services):
    choose(window, "first-insertion")
    press(window, Qt.Key.Key_Return)
    QTest.keyClick(beginning.page, Qt.Key.Key_Return)
    beginning.begin()
    assert settle(lambda: state(window) is State.ALIGNING)
    assert len(services.opened) == 1


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    ("key", "wanted"),
    [
        (Qt.Key.Key_Return, "begin_wanted"),
        (Qt.Key.Key_L, "look_wanted"),
        (Qt.Key.Key_D, "show_wanted"),
        (Qt.Key.Key_Escape, "back_wanted"),
    ],
)
def test_the_keys_of_the_briefing_work_wherever_the_focus_is_but_in_a_text(
    window, beginning, key, wanted
):
    choose(window, "first-insertion")
    page, heard = beginning.page, []
    for name in ("begin_wanted", "look_wanted", "show_wanted", "back_wanted"):
        getattr(page, name).disconnect()
    getattr(page, wanted).connect(lambda: heard.append(wanted))
    role = window.findChild(RoleSwitch).button
    role.setFocus()
    QTest.keyClick(role, key)
    assert heard == [wanted]
    QTest.keyClick(window, key)  # and where nothing has it
    assert heard == [wanted] * 2
    field = QLineEdit(window)
    field.show()
    field.setFocus()
    QTest.keyClick(field, key)
    assert heard == [wanted] * 2
    field.hide()
    page.hide()
    QTest.keyClick(role, key)
    assert heard == [wanted] * 2


@pytest.mark.long("journey")
def test_behind_an_open_dialog_the_briefing_has_no_keys(window, beginning):
    choose(window, "first-insertion")
    page, heard = beginning.page, []
    page.begin_wanted.disconnect()
    page.begin_wanted.connect(lambda: heard.append(1))
    role = window.findChild(RoleSwitch).button

    def enter():
        kind, none = QEvent.Type.KeyPress, Qt.KeyboardModifier.NoModifier
        QCoreApplication.sendEvent(role, QKeyEvent(kind, Qt.Key.Key_Return, none))

    dialog = QDialog(window)
    dialog.open()
    enter()
    assert heard == []
    dialog.close()
    enter()
    assert heard == [1]
    dialog.deleteLater()


@pytest.mark.long("journey")
def test_the_briefing_takes_its_own_keys_alone_and_none_of_another_window(window, beginning):
    choose(window, "first-insertion")
    page, heard = beginning.page, []
    page.look_wanted.disconnect()
    page.look_wanted.connect(lambda: heard.append(1))
    kind, none = QEvent.Type.KeyPress, Qt.KeyboardModifier.NoModifier
    event = QKeyEvent(kind, Qt.Key.Key_Z, none)
    QCoreApplication.sendEvent(window.findChild(RoleSwitch).button, event)
    assert not event.isAccepted()
    other = QPushButton()
    other.show()
    QTest.keyClick(other, Qt.Key.Key_L)
    assert heard == []
    other.close()
    other.deleteLater()


@pytest.mark.long("journey")
def test_back_returns_to_the_start_page_and_nothing_begins_later(window, beginning, settle):
    choose(window, "first-insertion")
    press(window, Qt.Key.Key_Escape)
    assert window.pages.currentWidget() is window.start_page
    settle(lambda: False, 0.4)
    assert window.conductor.patient is None


@pytest.mark.long("journey")
def test_looking_around_first_starts_nothing_until_f5_which_asks_nothing_more(
    window, beginning, settle
):
    choose(window, "first-insertion")
    press(window, Qt.Key.Key_L)
    assert settle(lambda: window.workspace.exercise_panel.buttons.start.isEnabled())
    settle(lambda: False, 0.4)
    assert state(window) is State.READY
    press(window, Qt.Key.Key_F5)
    assert settle(lambda: state(window) is State.ALIGNING)


@pytest.mark.long("journey")
def test_f5_on_an_exercise_taken_from_the_list_shows_its_briefing_first(window, beginning, settle):
    window.feature(ExerciseFeature).begin("first-insertion")
    assert settle(lambda: window.workspace.exercise_panel.buttons.start.isEnabled())
    press(window, Qt.Key.Key_F5)
    assert window.pages.currentWidget() is beginning.page
    assert state(window) is State.READY
    press(window, Qt.Key.Key_Escape)
    assert window.pages.currentWidget() is window.workspace  # where one came from
    press(window, Qt.Key.Key_F5)
    press(window, Qt.Key.Key_F5)
    assert settle(lambda: state(window) is State.ALIGNING)


@pytest.mark.long("journey")
@pytest.mark.promise("docs/user-guide.md: an assessment always has its briefing")
def test_do_not_show_again_holds_for_that_exercise_and_never_for_an_assessment(
    window, beginning, settle
):
    choose(window, "first-insertion")
    beginning.page.skip.setChecked(True)
    press(window, Qt.Key.Key_L)
    assert settle(lambda: window.pages.currentWidget() is window.workspace)
    window.show_start()
    choose(window, "thick-tissue")
    assert window.pages.currentWidget() is beginning.page
    press(window, Qt.Key.Key_Escape)
    choose(window, "first-insertion")
    assert window.pages.currentWidget() is window.workspace
    window.conductor.controller.abort()
    window.show_start()
    settle(lambda: not window.editor.locked)
    beginning.exercise = load_exercise("scans-only")
    beginning.page.show_exercise(beginning.exercise, None)
    assert beginning.page.skip.isHidden()
    window.settings.setValue("briefing/skip/scans-only", "true")
    assert not beginning._is_known(beginning.exercise)


@pytest.mark.long("journey")
def test_the_reason_over_the_buttons_of_the_briefing_is_shown_whole(window, beginning, settle):
    choose(window, "plan-it-yourself")
    window.resize(1366, 768)
    note = beginning.page.why_not
    assert note.isVisible()
    assert settle(lambda: note.height() >= note.heightForWidth(note.width()) > 0)


@pytest.mark.long("journey")
def test_an_exercise_that_the_student_plans_leads_to_the_plan(window, beginning, settle):
    choose(window, "plan-it-yourself")
    assert not beginning.page.show_me.isEnabled()
    assert "plan" in beginning.page.begin.text()
    press(window, Qt.Key.Key_Return)
    assert settle(lambda: window.pages.currentWidget() is window.workspace)
    assert settle(lambda: beginning.wish is BeginWish.NOTHING)
    assert state(window) is None


@pytest.mark.long("journey")
def test_a_demonstration_runs_apart_ends_by_itself_and_leaves_no_attempt(
    window, beginning, settle, services
):
    finished = []
    window.conductor.controller.finished.connect(finished.append)
    choose(window, "first-insertion")
    press(window, Qt.Key.Key_D)
    assert settle(lambda: state(window) is State.ALIGNING)
    assert services.opened[-1].setup.demonstrates
    assert beginning.bar.isVisible()
    run = window.conductor.controller.run
    trainer, shown = run.trainer, run.trainer.snapshot

    def done():
        seen = shown()
        seen.device.row[sv.TRAINEE_PHASE] = TRAINEE_DONE
        return seen

    def end():
        trainer.state, trainer.result = State.ENDED, object()

    trainer.snapshot, trainer.end = done, end
    assert settle(lambda: window.pages.currentWidget() is beginning.page, LINGER_S + 10.0)
    assert settle(lambda: window.runs.run is not None and not window.runs.run.demonstrates)
    assert not finished
    assert not beginning.bar.isVisible()
    press(window, Qt.Key.Key_Return)
    assert settle(lambda: state(window) is State.ALIGNING)
    assert not window.conductor.controller.run.demonstrates


@pytest.mark.long("journey")
def test_a_demonstration_can_be_stopped_at_any_time(window, beginning, settle, services):
    choose(window, "first-insertion")
    press(window, Qt.Key.Key_D)
    assert settle(lambda: state(window) is State.ALIGNING)
    trainer = window.conductor.controller.run.trainer

    def abort(reason=""):
        trainer.state, trainer.result = State.ABORTED, object()

    trainer.abort = abort
    press(window, Qt.Key.Key_Escape)
    assert window.pages.currentWidget() is beginning.page
    press(window, Qt.Key.Key_Return)  # at once, while the expert is still being stopped
    assert settle(lambda: state(window) is State.ALIGNING)
    assert not window.conductor.controller.run.demonstrates


@pytest.mark.long("journey")
def test_another_patient_ends_a_demonstration(window, beginning, settle, patient):
    choose(window, "first-insertion")
    press(window, Qt.Key.Key_D)
    assert settle(lambda: state(window) is State.ALIGNING)
    window.show_patient(patient)
    settle(lambda: False, 0.3)
    assert not beginning.is_showing
    assert not beginning.bar.isVisible()


@pytest.mark.long("journey")
def test_somebody_who_goes_elsewhere_meanwhile_finds_no_attempt_begun(window, beginning, settle):
    choose(window, "first-insertion")
    window.services.refuses = "the robot is away"
    press(window, Qt.Key.Key_Return)
    assert settle(lambda: beginning.wish is BeginWish.NOTHING)
    window.services.refuses = ""
    window.show_workspace()
    settle(lambda: False, 0.3)
    assert state(window) in (None, State.READY)


def test_the_words_say_what_counts_what_helps_and_what_is_locked():
    first, scans = load_exercise("first-insertion"), load_exercise("scans-only")
    assert scored_words(first)[0] == (
        "Off the path: best up to 0.6 mm, passes up to 2.7 mm; must be kept"
    )
    assert scored_words(first)[-1] == "75 of 100 points pass."
    assert aid_words(first, Role.STUDENT)[0] == "The robot guides with 70 %."
    assert locked_words(first) == ["Nothing: you may change help, views and layout."]
    assert "control scans alone" in " ".join(aid_words(scans, Role.STUDENT))
    assert "what moves the hand" in locked_words(scans)[0]


def test_the_briefing_promises_a_student_no_view_that_only_technicians_have():
    exercise = load_exercise("plan-it-yourself")
    assert "cameras" in exercise.shown_views
    for role, has_cameras in ((Role.STUDENT, False), (Role.TECHNICIAN, True)):
        words = aid_words(exercise, role)[-1]
        assert words.startswith("Shown: Needle on the slices")
        assert ("Camera pictures" in words) is has_cameras


@pytest.mark.long("journey")
def test_enter_pressed_once_too_often_does_not_end_the_attempt(window, beginning, settle):
    ended = []
    window.workspace.exercise_panel.buttons.end_requested.connect(lambda: ended.append(1))
    choose(window, "first-insertion")
    press(window, Qt.Key.Key_Return)
    assert settle(lambda: state(window) is State.ALIGNING)
    settle()
    press(window, Qt.Key.Key_Return)
    assert not ended
    assert state(window) is State.ALIGNING


@pytest.mark.long("journey")
def test_again_from_the_debrief_begins_at_once_and_another_exercise_is_briefed(
    window, beginning, settle
):
    choose(window, "first-insertion")
    press(window, Qt.Key.Key_Return)
    assert settle(lambda: state(window) is State.ALIGNING)
    window.conductor.controller.run.trainer.state = State.ENDED
    debrief = window.feature(DebriefFeature)
    debrief.show()
    settle(lambda: not window.editor.locked)
    debrief.begin_wanted.emit("first-insertion")
    assert settle(lambda: state(window) is State.ALIGNING)
    assert window.pages.currentWidget() is window.workspace
    window.conductor.controller.run.trainer.state = State.ENDED
    settle(lambda: not window.editor.locked)
    debrief.begin_wanted.emit("thick-tissue")
    assert window.pages.currentWidget() is beginning.page
    assert beginning.page.title.text() == "Thick tissue"


@pytest.mark.long("journey")
def test_a_demonstration_says_when_it_is_a_recorded_attempt(window, beginning, settle, monkeypatch):
    monkeypatch.setattr(ShownMotion, "kept", lambda *_: "somebody's")
    beginning.brief("first-insertion")
    beginning.show_me()
    assert settle(lambda: "recorded attempt" in beginning.bar.words.text())
    window_rect = window.rect()
    assert window_rect.contains(beginning.bar.geometry())
    assert beginning.bar.y() > window_rect.height() - 60  # no view lies there
