"""Student, instructor and technician: for each of them only what is his exists in the window."""

import contextlib
import re
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QShortcut
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QComboBox,
    QDialog,
    QLabel,
    QListWidget,
    QMenu,
    QTableWidget,
    QWidget,
)
from views_exercise_attempts import review
from window_rig import plan

from app.session.people import People
from app.session.roster import RosterLine
from app.views.accuracy.feature import AccuracyFeature
from app.views.checks.feature import ChecksFeature
from app.views.debrief.feature import DebriefFeature
from app.views.exercise.feature import ExerciseFeature
from app.views.exercise.readouts import ForceBar
from app.views.kit.access import ACCESS
from app.views.kit.roles import EVERYBODY, STAFF, Role
from app.views.people.feature import PeopleFeature
from app.views.robot.feature import RobotFeature
from app.views.shell.feature import Feature
from app.views.shell.features import FEATURES
from app.views.shell.help import HelpWindow
from app.views.shell.window import MainWindow

FORBIDDEN = re.compile(
    r"encoder|heartbeat|fréchet|LDLJ|\bDTW\b|guidance limited to|held, \d+ ms old", re.IGNORECASE
)

MENUS = {
    Role.STUDENT: ["File", "View", "Sessions", "Help"],
    Role.INSTRUCTOR: ["File", "Edit", "View", "Measure", "Sessions", "Help"],
    Role.TECHNICIAN: [
        "File", "Edit", "View", "Measure", "Robot", "Cameras", "Pen", "Checks", "Sessions", "Help",
    ],
}  # fmt: skip
PANELS = {
    Role.STUDENT: (),
    Role.INSTRUCTOR: ("Plan", "Exercise", "Measure", "Structures"),
    Role.TECHNICIAN: ("Plan", "Exercise", "Cameras", "Robot", "Measure", "Structures", "Effects"),
}
TECHNICAL = ["Daily check…", "Cost of accuracy…", "Commissioning…", "Calibrate…", "Robot's health"]
AUTHORING = [
    "Open CT folder…", "Make an exercise from the open patient…", "Back up everything…",
    "Show this attempt as the demonstration", "Lock window and level", "List of measurements",
    "Watch the arm do my plan",
]  # fmt: skip
PRACTICE = ["Start page", "Briefing of this exercise", "Past sessions", "Help on this part", "Quit"]


@pytest.fixture(autouse=True)
def nobody_is_signed_in():
    yield
    ACCESS.take_role(Role.TECHNICIAN)


@pytest.fixture
def student(window):
    window.roles.choose(Role.STUDENT)
    return window


def text_of(action):
    return re.sub(r"&(?=\S)", "", action.text()).split("\t")[0]


def menus(window):
    return [text_of(one) for one in window.menuBar().actions() if one.isVisible()]


def reachable(window):
    """Texts of all entries that can be reached from the menu bar."""
    found, open_menus = [], [one.menu() for one in window.menuBar().actions() if one.isVisible()]
    while open_menus:
        for action in open_menus.pop().actions():
            inner = action.menu()
            if isinstance(inner, QMenu):
                open_menus.append(inner)
            elif not action.isSeparator() and action.isVisible():
                found.append(text_of(action))
    return found


def words(root):
    """All that is to be read on a widget: texts, entries, cells, what it paints."""
    for widget in (root, *root.findChildren(QWidget)):
        if not widget.isVisible():
            continue
        yield widget.toolTip()
        yield widget.accessibleName()
        if isinstance(widget, QLabel | QAbstractButton):
            yield widget.text()
        elif isinstance(widget, QComboBox):
            yield from (widget.itemText(n) for n in range(widget.count()))
        elif isinstance(widget, QListWidget):
            yield from (
                f"{i.text()} {i.toolTip()}" for i in map(widget.item, range(widget.count()))
            )
        elif isinstance(widget, QTableWidget):
            cells = [(r, c) for r in range(widget.rowCount()) for c in range(widget.columnCount())]
            yield from (item.text() for cell in cells if (item := widget.item(*cell)) is not None)


def forbidden(window):
    return sorted({text for text in words(window) if FORBIDDEN.search(text)})


@pytest.mark.long("journey")
@pytest.mark.parametrize("role", list(Role))
def test_each_role_has_its_menus_and_panels(window, role):
    window.roles.choose(role)
    assert menus(window) == MENUS[role]
    assert window.workspace.side.names() == PANELS[role]


@pytest.mark.long("journey")
@pytest.mark.parametrize("role", list(Role))
def test_a_walk_over_all_entries_meets_only_those_of_the_role(window, role):
    everything = reachable(window)
    window.roles.choose(role)
    there = reachable(window)
    assert set(there) <= set(everything)
    assert all(text in there for text in PRACTICE)
    assert all((text in there) == (role is Role.TECHNICIAN) for text in TECHNICAL)
    assert all((text in there) == (role in STAFF) for text in AUTHORING if text in everything)
    window.roles.choose(Role.TECHNICIAN)
    assert reachable(window) == everything, "all of it is back, in its order"


def entries(*holders):
    """Return the actions of menu bar, menus and widgets, as the role has them."""
    found, holders = [], list(holders)
    while holders:
        for action in holders.pop().actions():
            inner = action.menu()
            if isinstance(inner, QMenu):
                holders.append(inner)
            elif action not in found:
                found.append(action)
    return found


def lies_in(thing, widgets):
    """Return whether the parent of an action or a shortcut is in one of some widgets."""
    parent = thing.parent()
    while parent is not None and parent not in widgets:
        parent = parent.parent()
    return parent is not None


def recorded(window):
    """Let every action and shortcut of a window do nothing but be in the list that is returned."""
    done = []
    for thing in (*window.findChildren(QAction), *window.findChildren(QShortcut)):
        action = isinstance(thing, QAction)
        names = ("triggered", "toggled") if action else ("activated", "activatedAmbiguously")
        for name in names:
            with contextlib.suppress(SystemError, RuntimeError):
                getattr(thing, name).disconnect()
        for name in names[:1] if action else names:
            getattr(thing, name).connect(lambda *_, thing=thing: done.append(thing))
    return done


@pytest.mark.long("journey")
@pytest.mark.parametrize("role", list(Role))
def test_no_key_of_what_a_role_does_not_have_does_anything(window, role, settle):
    everything, done = entries(window.menuBar(), window), recorded(window)
    window.roles.choose(role)
    window.show_workspace()
    window.activateWindow()
    settle()
    had, side = entries(window.menuBar(), window), window.workspace.side
    foreign = [
        side._panels.widget(index) for index in range(side.count()) if index not in side.there
    ]
    owned = window.context.shell.owned
    pages = [window.pages.widget(index) for index in range(window.pages.count())]
    foreign += [page for page in pages if not owned.has_page(page)]
    actions, shortcuts = window.findChildren(QAction), window.findChildren(QShortcut)
    lacking = [one for one in everything if one not in had]
    lacking += [one for one in (*actions, *shortcuts) if lies_in(one, foreign)]
    keys = {
        sequence.toString(): sequence
        for thing in (*actions, *shortcuts)
        for sequence in (thing.shortcuts() if isinstance(thing, QAction) else thing.keys())
    }
    keys.pop("", None)
    assert len(keys) > 40
    canvas = window.workspace.panes[0].canvas
    for text in sorted(keys):
        for thing in (*actions, *shortcuts):  # nothing is off because of where the work stands
            thing.setEnabled(True)
        QTest.keySequence(canvas, keys[text])
    assert {"F1", "E"} <= {text for one in done for text in of_keys(one)}, (
        "keys do reach the window"
    )
    assert [one for one in done if one in lacking] == []
    keyed = {text for one in lacking for text in of_keys(one)}
    assert (keyed >= {"F8", "F9"}) == (role is not Role.TECHNICIAN)
    assert ("Ctrl+O" in keyed) == (role is Role.STUDENT)


def of_keys(thing):
    """Return the key sequences of an action or a shortcut as texts."""
    sequences = thing.shortcuts() if isinstance(thing, QAction) else thing.keys()
    return [sequence.toString() for sequence in sequences]


def test_a_student_has_at_most_four_menus_and_no_tabs(student):
    assert len(menus(student)) <= 4
    student.show_workspace()
    side = student.workspace.side
    names = [one for one in side.findChildren(QAbstractButton) if one.objectName() == "side-name"]
    assert names
    assert not [one.text() for one in names if one.isVisible()]


def test_a_student_switches_no_camera_pictures_that_the_window_does_not_have(student):
    shown = {"Camera pictures", "3D view"} & set(reachable(student))
    assert shown == {"3D view"}


@pytest.mark.long("journey")
def test_no_technical_word_meets_a_student_on_his_way(student, patient, settle):
    assert forbidden(student) == []
    student.show_patient(patient)
    plan(student)
    assert settle(lambda: student.runs.run is not None)
    student.show_workspace()
    settle(timeout=0.3)
    assert forbidden(student) == []
    assert not any(bar._detailed for bar in student.findChildren(ForceBar))
    student.workspace.exercise_panel.buttons.start.click()
    settle(timeout=0.3)
    assert student.conductor.controller.is_running
    assert forbidden(student) == []
    student.conductor.controller.abort()
    student.feature(DebriefFeature)._controller._show(review(), "")
    settle()
    assert student.feature(DebriefFeature).page.isVisible()
    assert forbidden(student) == []


@pytest.mark.long("journey")
def test_the_details_show_a_student_what_the_words_leave_out(student, patient, settle):
    student.show_patient(patient)
    plan(student)
    assert settle(lambda: student.runs.run is not None)
    student.show_workspace()
    student.workspace.status.set_detailed(True)
    settle(timeout=0.3)
    assert any("Encoder" in text for text in forbidden(student))


@pytest.mark.long("journey")
def test_the_table_of_a_debrief_is_whole_in_its_details(student):
    page = student.feature(DebriefFeature).page
    page.show_review(review())
    counted = page.table.rowCount()
    page.details.setChecked(True)
    whole = page.table.rowCount()
    student.roles.choose(Role.INSTRUCTOR)
    assert counted <= whole == page.table.rowCount()
    assert not page.details.isVisibleTo(page)


@pytest.mark.long("journey")
def test_the_role_is_refused_in_an_attempt_with_a_sentence(window, patient, settle):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    window.feature(ExerciseFeature).beginning.trust(window.conductor.exercise.id)
    window.workspace.exercise_panel.buttons.start.click()
    assert window.conductor.controller.is_running
    window.roles.choose(Role.STUDENT)
    assert window.roles.role is Role.TECHNICIAN
    assert "An attempt is running" in window.message_bar.text
    assert window.roles.actions[Role.TECHNICIAN].isChecked()
    window.conductor.controller.abort()


@pytest.mark.long("journey")
def test_the_role_is_remembered_where_no_password_is_set(application, services, destroy, window):
    window.roles.choose(Role.INSTRUCTOR)
    window.editor.saved(None)
    window.close()
    other = MainWindow(services)
    destroy(other)
    assert other.roles.role is Role.INSTRUCTOR


@pytest.mark.long("journey")
def test_who_chose_nothing_is_a_student(application, services, destroy, monkeypatch):
    monkeypatch.delenv("ACUS_ROLE")
    window = MainWindow(services)
    destroy(window)
    assert window.roles.role is Role.STUDENT
    assert not ACCESS.may_manage


@pytest.mark.long("journey")
def test_a_password_opens_the_other_roles_and_they_close_behind_the_instructor(window, settle):
    people, feature = People(), window.feature(PeopleFeature)
    people.set_instructor("correct horse")
    feature.look()
    assert settle(lambda: ACCESS.guarded)
    assert window.roles.role is Role.STUDENT
    window.roles.choose(Role.TECHNICIAN)
    assert window.roles.role is Role.STUDENT, "the password is asked first"
    (line,) = feature.dialog.lines
    line.setText("correct horse")
    feature.dialog.save()
    assert settle(lambda: window.roles.role is Role.TECHNICIAN)
    window.roles.choose(Role.STUDENT)
    assert not ACCESS.instructor
    assert window.roles.role is Role.STUDENT
    feature.close()


@pytest.mark.long("journey")
def test_who_signs_in_as_a_student_is_one(window, settle):
    ada, _ = People().add(RosterLine("Ada"))
    ACCESS.sign_in(ada)
    assert window.roles.role is Role.STUDENT
    assert not window.start_page.who.isVisibleTo(window.start_page)
    ACCESS.sign_in(None)
    assert window.roles.role is Role.TECHNICIAN


@pytest.mark.long("journey")
def test_a_name_of_ones_choice_is_recorded_and_remembered(student):
    line = student.start_page.who.line
    assert line.isVisible()
    line.setText("Kestrel")
    line.editingFinished.emit()
    assert student.workspace.exercise_panel.student.text() == "Kestrel"
    assert student.settings.value("student/name") == "Kestrel"


@pytest.mark.long("journey")
def test_the_keyboard_reaches_the_role(window, settle):
    assert window.roles.button.focusPolicy() is Qt.FocusPolicy.StrongFocus
    (key,) = [one for one in window.actions() if text_of(one) == "Role"]
    assert key.shortcut().toString() == "Ctrl+Alt+R"
    assert window.roles.button.isVisible()
    assert window.roles.button.menu().actions()[0].text().startswith("Student")


def test_a_page_that_the_role_does_not_have_is_left_and_not_shown(window):
    accuracy = QWidget()
    with window.context.shell.made_for(frozenset({Role.TECHNICIAN})):
        window.context.shell.add_page(accuracy)
    window.context.shell.show_page(accuracy)
    assert window.pages.currentWidget() is accuracy
    window.roles.choose(Role.STUDENT)
    assert window.pages.currentWidget() is window.start_page
    window.context.shell.show_page(accuracy)
    assert window.pages.currentWidget() is window.start_page


def test_every_feature_says_for_whom_it_is_and_a_foreign_one_is_not_a_students():
    assert Feature.roles == STAFF
    own = [one for one in FEATURES if one.__module__.startswith("app.")]
    assert [one.__name__ for one in own if "roles" not in vars(one)] == []
    assert all(one.roles <= EVERYBODY for one in own)
    assert RobotFeature.roles == ChecksFeature.roles == {Role.TECHNICIAN}


def test_a_feature_that_declares_nothing_is_there_for_instructor_and_technician(
    application, services, destroy
):
    class Foreign(Feature):
        def __init__(self, context):
            super().__init__(context)
            context.shell.menu("&Foreign").addAction("Do it")
            context.shell.add_panel(QWidget(), "Foreign")

    Foreign.__module__ = "acus_foreign.features.it"
    window = MainWindow(services, (*FEATURES, Foreign))
    destroy(window)
    for role in Role:
        window.roles.choose(role)
        assert ("Foreign" in menus(window)) == (role in STAFF)
        assert ("Foreign" in window.workspace.side.names()) == (role in STAFF)


@pytest.mark.long("journey")
def test_a_students_window_opens_no_dropped_ct(student, monkeypatch):
    opened = []
    monkeypatch.setattr(student.open_ct, "open_folder", opened.append)
    student.open_dropped(Path("somewhere"))
    assert opened == []
    student.roles.choose(Role.INSTRUCTOR)
    student.open_dropped(Path("somewhere"))
    assert opened == [Path("somewhere")]


@pytest.mark.long("journey")
def test_what_was_said_to_a_technician_is_not_said_to_the_student_after_him(window):
    window.message_bar.show_error("run acus device emulate")
    window.roles.choose(Role.STUDENT)
    assert window.message_bar.isHidden()


def test_a_dialog_of_the_role_before_closes_with_it_and_a_page_of_help_stays(window):
    window.roles.choose(Role.TECHNICIAN)
    checks = window.feature(ChecksFeature)
    checks.open_daily()
    page = HelpWindow("user-guide", "", window)
    page.show()
    assert checks.daily.isVisible()
    window.roles.choose(Role.STUDENT)
    assert not checks.daily.isVisible()
    assert page.isVisible()
    page.close()
    window.roles.choose(Role.TECHNICIAN)
    checks.open_daily()
    assert checks.daily.isVisible()


@pytest.mark.long("journey")
def test_a_dialog_that_waits_for_an_answer_stays_when_the_role_changes(window):
    window.roles.choose(Role.TECHNICIAN)
    dialog = QDialog(window)
    dialog.open()
    window.roles.choose(Role.STUDENT)
    assert dialog.isVisible()
    dialog.close()
    dialog.deleteLater()


def test_a_page_of_the_role_before_is_left_with_it(window):
    window.roles.choose(Role.TECHNICIAN)
    accuracy = window.feature(AccuracyFeature)
    accuracy.open_page()
    assert window.pages.currentWidget() is accuracy.page
    window.roles.choose(Role.STUDENT)
    assert window.pages.currentWidget() is not accuracy.page
    accuracy.open_page()
    assert window.pages.currentWidget() is not accuracy.page


@pytest.mark.long("journey")
@pytest.mark.parametrize("end", ["finished", "gone"])
def test_a_message_that_an_attempt_runs_goes_with_the_attempt(window, monkeypatch, end):
    window.roles.choose(Role.TECHNICIAN)
    controller = window.conductor.controller
    monkeypatch.setattr(type(controller), "is_running", True)
    window.roles.choose(Role.STUDENT)
    assert "end it before the role is changed" in window.message_bar.text
    assert not window.message_bar.isHidden()
    monkeypatch.setattr(type(controller), "is_running", False)
    if end == "finished":
        controller.finished.emit(None)
    else:
        window.runs.gone.emit()
    assert window.message_bar.isHidden()


def test_two_windows_that_insist_on_their_own_roles_end(application):
    heard = []

    def insist(role):
        def follow():
            heard.append(role)
            ACCESS.take_role(role)

        return follow

    listeners = [insist(Role.STUDENT), insist(Role.INSTRUCTOR)]
    for listener in listeners:
        ACCESS.changed.connect(listener)
    ACCESS.take_role(Role.STUDENT)
    for listener in listeners:
        ACCESS.changed.disconnect(listener)
    assert ACCESS.role is Role.STUDENT
    assert len(heard) == len(listeners)
