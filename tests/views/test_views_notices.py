"""Messages and progress: said without moving anything, gone when they are no longer true."""

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, QRect, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QLabel, QMainWindow, QWidget

from app.core.events import Event
from app.session.withdrawal import KIND, WORDS, Start
from app.views.shell.message_bar import PAUSE, REFUSAL, ROBOT, MessageBar, Notices
from app.views.shell.window import tell_pause
from app.views.slices.pane import SlicePane
from app.views.slices.panes import PaneId
from app.views.slices.presets import default_window
from app.views.slices.viewing import Tool, Viewing


@pytest.fixture
def window(application, destroy):
    window = QMainWindow()
    destroy(window)
    for name in ("File", "Edit", "View", "Sessions", "Help"):
        window.menuBar().addMenu(name)
    window.setCentralWidget(QWidget())
    window.bar = MessageBar(window)
    window.strip = QWidget(window)
    window.strip.setMinimumHeight(30)
    window.strip.hide()
    window.notices = Notices(window, (window.strip, window.bar))
    window.resize(1200, 700)
    window.show()
    application.processEvents()
    return window


def test_a_message_moves_nothing_and_leaves_the_menus_free(window, application):
    before = window.centralWidget().geometry()
    window.bar.show_error("the entry lies 11.1 mm outside the body; click within 10 mm of the skin")
    window.strip.show()
    application.processEvents()
    assert window.notices.isVisible()
    assert window.centralWidget().geometry() == before
    menus = [window.menuBar().actionGeometry(action) for action in window.menuBar().actions()]
    assert not any(window.notices.geometry().intersects(menu) for menu in menus)
    assert window.notices.geometry().right() == window.width() - 1
    text = window.bar._text
    assert text.height() >= text.heightForWidth(text.width())


@pytest.mark.parametrize("words", ["the folder is not readable " * 9, "cannot write"])
def test_a_message_never_covers_the_next_step_and_no_line_of_it_is_cut(window, application, words):
    step = QLabel("Push 71 mm deeper", window.centralWidget())
    step.setGeometry(380, 0, 820, 32)
    step.show()
    notices = Notices(window, (window.strip, window.bar), step)
    window.strip.setMinimumHeight(0)
    window.strip.hide()
    window.bar.show_error(words)
    application.processEvents()
    where = QRect(step.mapTo(window, QPoint(0, 0)), step.size())
    assert not notices.geometry().intersects(where)
    menus = [window.menuBar().actionGeometry(action) for action in window.menuBar().actions()]
    assert not any(notices.geometry().intersects(menu) for menu in menus)
    text = window.bar._text
    assert text.height() >= text.heightForWidth(text.width())
    assert (notices.y() == 0) == (len(words) < 20)
    step.hide()
    application.processEvents()
    assert notices.y() == 0


def test_a_message_makes_room_for_menus_that_come_while_it_is_shown(window, application):
    menus = window.menuBar().actions()
    for action in menus[2:]:
        window.menuBar().removeAction(action)
    window.bar.show_error("An attempt is running: end it before the role is changed")
    application.processEvents()
    before = window.notices.x()
    window.menuBar().addActions(menus[2:])
    application.processEvents()
    application.processEvents()
    there = [window.menuBar().actionGeometry(action) for action in menus]
    assert max(one.right() for one in there) > before
    assert not any(window.notices.geometry().intersects(one) for one in there)


def test_nothing_is_left_when_all_is_said(window, application):
    window.bar.show_note("Saved plan.mrk.json")
    window.bar.hide()
    application.processEvents()
    assert not window.notices.isVisible()


def test_a_long_message_is_whole_on_more_lines(window, application):
    window.bar.show_error("the folder is not readable " * 9)
    application.processEvents()
    assert window.notices.height() > 1.5 * window.bar._text.fontMetrics().height()
    assert window.rect().contains(window.notices.geometry())


def test_a_note_goes_by_itself_and_an_error_stays(window):
    window.bar.show_note("Saved")
    assert window.bar._note.isActive()
    window.bar.show_error("cannot write")
    assert not window.bar._note.isActive()


def test_a_refusal_goes_with_the_next_change_and_an_error_does_not(window):
    window.bar.show_until(REFUSAL, "too far from the skin")
    window.bar.forget(REFUSAL)
    assert window.bar.isHidden()
    window.bar.show_error("cannot write")
    window.bar.forget(REFUSAL)
    assert not window.bar.isHidden()


def test_what_kept_the_robot_away_goes_when_it_is_there_and_nothing_else_does(window):
    window.bar.show_until(ROBOT, "/dev/ttyACM0: no board answers")
    window.bar.forget(REFUSAL)
    assert not window.bar.isHidden()
    window.bar.forget(ROBOT)
    assert window.bar.isHidden()
    window.bar.show_until(ROBOT, "/dev/ttyACM0: no board answers")
    window.bar.show_error("cannot write")
    window.bar.forget(ROBOT)
    assert not window.bar.isHidden()


def test_what_covers_a_message_that_is_still_true_gives_it_back(window):
    window.bar.show_until(ROBOT, "/dev/ttyACM0: no board answers")
    window.bar.show_note("Saved plan.mrk.json")
    window.bar._note.timeout.emit()
    assert window.bar.text == "/dev/ttyACM0: no board answers"
    window.bar.show_until(REFUSAL, "too far from the skin")
    window.bar.forget(ROBOT)
    assert window.bar.text == "too far from the skin"
    window.bar.forget(REFUSAL)
    assert window.bar.isHidden()


def test_a_message_that_was_closed_is_not_shown_again(window):
    window.bar.show_until(ROBOT, "/dev/ttyACM0: no board answers")
    window.bar._close.click()
    assert window.bar.isHidden()
    window.bar.show_note("Saved")
    window.bar._note.timeout.emit()
    assert window.bar.isHidden()


def test_another_patient_clears_the_bar_but_for_an_attempt_that_waits(window):
    window.bar.show_until(PAUSE, "paused")
    window.bar.show_until(ROBOT, "/dev/ttyACM0: no board answers")
    window.bar.clear()
    assert window.bar.text == "paused"
    window.bar.forget(PAUSE)
    assert window.bar.isHidden()


@pytest.mark.parametrize(
    "over",
    [
        Event(1.0, KIND, "the needle is out", {"how": "simulated"}),
        Event(1.0, "abort", "aborted: by the user", {"state": "aborted"}),
    ],
)
def test_that_the_needle_is_withdrawn_is_no_success_and_is_said_until_it_is_out(window, over):
    tell_pause(window.bar, Event(0.0, KIND, WORDS[Start.SIMULATED], {}))
    assert window.bar._symbol.text() == "▲"
    window.bar.show_note("Saved")
    window.bar._note.timeout.emit()  # however long it takes
    assert window.bar.text == WORDS[Start.SIMULATED]
    assert window.bar._symbol.text() == "▲"
    tell_pause(window.bar, over)
    assert window.bar.isHidden()


@pytest.mark.parametrize("refused", [True, False])
def test_the_tool_stays_for_another_try_when_the_point_was_refused(volume, destroy, refused):
    viewing = Viewing(default_window())
    viewing.set_volume(volume)
    pane = SlicePane(viewing, PaneId.AXIAL)
    destroy(pane)
    pane.resize(400, 300)
    viewing.set_volume(volume)
    viewing.point_placed.connect(lambda *_: viewing.refuse_point() if refused else None)
    viewing.set_tool(Tool.ENTRY)
    at, left = QPointF(200, 150), Qt.MouseButton.LeftButton
    none, kinds = Qt.KeyboardModifier.NoModifier, QEvent.Type
    pane.canvas.mousePressEvent(QMouseEvent(kinds.MouseButtonPress, at, at, left, left, none))
    pane.canvas.mouseReleaseEvent(QMouseEvent(kinds.MouseButtonRelease, at, at, left, left, none))
    assert viewing.tool is (Tool.ENTRY if refused else Tool.NAVIGATE)
