"""The robot in the window: chosen, changed, commissioned, told of."""

import threading
from pathlib import Path

import pytest
from window_rig import plan

from app.views.robot.feature import RobotFeature
from app.views.robot.wizard_pages import ConnectionPage
from app.views.shell.services import RobotPort
from app.views.shell.window import MainWindow


@pytest.mark.long("journey")
def test_another_robot_ends_the_run_and_begins_one_on_it(window, patient, services, settle):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    window.feature(RobotFeature).menu.robots.aboutToShow.emit()
    texts = [action.text() for action in window.feature(RobotFeature).menu.robots.actions()]
    assert texts == [
        "Simulated robot", "icube A17 on /dev/ttyACM0", "", "Other port…",
        "No robot: pen and webcam…",
    ]  # fmt: skip
    window.feature(RobotFeature).menu.robots.actions()[1].trigger()
    assert services.opened[0].closed.wait(30.0)
    assert settle(lambda: window.runs.run is not None)
    assert len(services.opened) == 2
    assert services.opened[1].setup.robot.port == "/dev/ttyACM0"
    assert services.opened[1].setup.robot.held_arming
    assert not window.workspace.exercise_panel.enable.isHidden()
    assert window.feature(RobotFeature).settings.port == "/dev/ttyACM0"


def test_a_robot_that_was_chosen_is_offered_though_it_is_gone(window, services):
    window.feature(RobotFeature).choose("/dev/ttyACM0")
    services.ports = ()
    assert [robot.title for robot in window.feature(RobotFeature).ports()] == [
        "/dev/ttyACM0 – not plugged in"
    ]
    window.feature(RobotFeature).choose("")


def titles(window):
    menu = window.feature(RobotFeature).menu.robots
    return [action.text() for action in menu.actions() if action.isCheckable()]


def test_a_robot_of_a_service_is_offered_once_it_answers_and_the_list_waits_for_nothing(
    window, services, settle
):
    services.served = (RobotPort("haply:", "Haply Inverse3 049D (haply:)"),)
    services.may_answer.clear()
    menu = window.feature(RobotFeature).menu.robots
    menu.aboutToShow.emit()
    menu.aboutToShow.emit()
    assert "Haply Inverse3 049D (haply:)" not in titles(window)
    assert "icube A17 on /dev/ttyACM0" in titles(window)
    services.may_answer.set()
    assert settle(lambda: "Haply Inverse3 049D (haply:)" in titles(window))
    (asked,) = services.served_asked
    assert asked is not threading.current_thread()
    services.served = ()
    menu.aboutToShow.emit()
    assert settle(lambda: "Haply Inverse3 049D (haply:)" not in titles(window))


def test_a_service_that_is_used_is_left_alone_and_never_called_unplugged(window, services):
    window.feature(RobotFeature).choose("haply:")
    window.feature(RobotFeature).menu.robots.aboutToShow.emit()
    assert services.served_asked == []
    assert "haply:" in titles(window)
    window.feature(RobotFeature).choose("")


@pytest.mark.long("journey")
def test_choosing_a_robot_again_tries_again(window, patient, services, settle):
    services.refuses = "there is no port"
    window.feature(RobotFeature).choose("/dev/ttyACM0")
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: "no port" in window.message_bar.text)
    empty = window.feature(RobotFeature).panel._empty
    assert "No robot is running" in empty.text()
    services.refuses = ""
    window.feature(RobotFeature).choose("/dev/ttyACM0")
    assert "starting" in empty.text()
    assert settle(lambda: window.runs.run is not None)
    assert window.message_bar.isHidden()
    assert "starting" not in empty.text()
    window.feature(RobotFeature).choose("")


@pytest.mark.long("journey")
def test_a_robot_is_taken_for_once_without_being_remembered(window, patient, services, settle):
    window.feature(RobotFeature).choose("/dev/ttyACM0")
    window.equipment.take("/tmp/robot")
    assert window.feature(RobotFeature).settings.port == "/dev/ttyACM0"
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    assert services.opened[-1].setup.robot.port == "/tmp/robot"
    window.feature(RobotFeature).choose("")
    assert window.feature(RobotFeature).port == ""


@pytest.mark.long("journey")
def test_a_pen_takes_the_robot_s_place_until_a_robot_is_chosen(window, patient, services, settle):
    window.equipment.take_pen("usb:0")
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    chosen = services.opened[-1].setup.robot
    assert (chosen.pen, chosen.port, chosen.held_arming) == ("usb:0", "", False)
    window.feature(RobotFeature).choose("")
    assert window.feature(RobotFeature).pen == ""


@pytest.mark.long("journey")
def test_holding_can_be_practised_on_the_simulated_robot(window, patient, services, settle):
    window.feature(RobotFeature).set_practise_holding(True)
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    assert services.opened[0].setup.robot.held_arming
    assert window.feature(RobotFeature).menu.holding.isChecked()
    window.feature(RobotFeature).set_practise_holding(False)
    assert settle(lambda: len(services.opened) == 2)


@pytest.mark.long("journey")
def test_the_robot_stays_while_an_attempt_runs(window, patient, services, settle):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    window.workspace.exercise_panel.buttons.start.click()
    assert settle(lambda: window.editor.locked)
    window.feature(RobotFeature).choose("/dev/ttyACM0")
    window.feature(RobotFeature).commission()
    assert "end it first" in window.message_bar.text
    assert window.feature(RobotFeature).settings.port == ""
    assert services.benches == []


@pytest.mark.long("journey")
def test_the_wizard_has_the_robot_for_itself_and_gives_it_back(window, patient, services, settle):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    window.feature(RobotFeature).choose("/dev/ttyACM0")
    assert settle(lambda: len(services.opened) == 2 and window.runs.run is not None)
    window.feature(RobotFeature).commission()
    assert settle(lambda: window.feature(RobotFeature).wizard is not None)
    assert services.opened[1].closed.is_set()
    assert window.runs.run is None
    assert isinstance(window.feature(RobotFeature).wizard.page, ConnectionPage)
    window.feature(RobotFeature).wizard.reject()
    assert services.benches[0].closed == 1
    assert settle(lambda: window.runs.run is not None)
    assert len(services.opened) == 3


def test_the_simulated_robot_needs_no_commissioning(window, patient, services):
    window.show_patient(patient)
    window.feature(RobotFeature).commission()
    assert "needs no commissioning" in window.message_bar.text
    assert services.benches == []


@pytest.mark.long("journey")
def test_a_robot_that_does_not_open_is_told_and_the_run_comes_back(
    window, patient, services, settle
):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    window.feature(RobotFeature).choose("/dev/ttyACM0")
    assert settle(lambda: len(services.opened) == 2 and window.runs.run is not None)
    services.refuses = "nobody answers on /dev/ttyACM0: check cable and power"
    window.feature(RobotFeature).commission()
    assert settle(lambda: "nobody answers" in window.message_bar.text)
    services.refuses = ""
    assert window.feature(RobotFeature).wizard is None


@pytest.mark.long("journey")
def test_the_robots_health_stands_beside_the_panes(window, patient, services, settle):
    window.show_patient(patient)
    plan(window)
    window.feature(RobotFeature).show_health()
    panel = window.feature(RobotFeature).panel
    assert settle(lambda: panel.groups != ())
    assert window.workspace.side.currentWidget() is panel
    window.editor.saved(Path("kept"))
    window.show_patient(patient)
    assert settle(lambda: panel.groups == ())


@pytest.mark.long("journey")
def test_the_hand_is_remembered(services, window, destroy):
    box = window.workspace.bullseye.source.box
    box.setCurrentIndex(1)
    box.activated.emit(1)
    window.settings.sync()
    again = MainWindow(services)
    destroy(again)
    assert again.workspace.bullseye.source.name == "tablet"
