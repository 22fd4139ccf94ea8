"""What a student reaches in the window: every action is found by itself, whoever added it."""

import re

import pytest
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QAbstractButton, QApplication, QDialog, QFileDialog, QTabBar
from views_exercise_attempts import review

from app.core import paths
from app.session.people import People
from app.session.roster import RosterLine
from app.views.author.feature import AuthorFeature
from app.views.debrief.feature import DebriefFeature
from app.views.kit.access import ACCESS
from app.views.people.feature import PeopleFeature


def listed(texts):
    return frozenset(texts.split("|"))


STUDENTS_MAY = listed(
    # what is seen, and how
    "At the patient's feet|At the patient's head|On the patient's left|On the patient's right|"
    "Bull's-eye beside the slices|Bull's-eye|Legend of the bull's-eye|Crosshair to target|"
    "From behind|From the feet|From the front|From the head|From the needle|From the operator|"
    "From the patient's left|From the patient's right|Level the other way round|Whole patient|"
    "Cut along the needle|Slices|Organs|X-ray|Vessels|Surfaces|Skin|Bone|Lung|Light background|"
    "Motion of the target|Force along the needle|Needle on the slices|Camera pictures|3D view|"
    "Needle: in-plane and probe's-eye|One large and three|Two by two|"
    "Six: slices, needle's planes, 3D|One window for all panes|Straighten all planes|"
    "Slices follow the needle tip|Draw errors of target and tip|Invert grey|"
    "Lock window and level|As in 3D Slicer|As in OHIF|As radiologists read it|Full screen|"
    "Hide names|Large text|Light colours|Projector mode: all three|"
    "Left-handed: panel on the right|The hand moves the hub, not the tip|Back|Undo|Redo|"
    "Never|Always|With a real robot, and when the guard acts|Medium|Loud|Quiet|"
    "Sounds of the attempt|Details of the robot (technician's strip)|"
    # a patient, a plan and measurements of one's own
    "Open CT archive or file…|Open CT folder…|Series of the folder…|Phantom patient|New plan|"
    "Open plan (.mrk.json)…|Open plan…|Save plan as (.mrk.json)…|Save plan as…|Save plan|"
    "Place entry|Place target|Angle|Distance|HU probe|Region (mean)|List of measurements|"
    "Export measurements (.mrk.json)…|Export measurements…|"
    "Export position of the patient (.tfm)…|Import position of the patient (.tfm)…|"
    # the equipment, which no exercise is changed by
    "The robot holds the needle|Simulated cameras|Real cameras: choose…|Left camera…|"
    "Right camera…|A pen before a webcam: choose…|Pen and webcam: set up, measure, print…|Aim…|"
    "Calibrate…|Commissioning…|Daily check…|Registration check…|Robot's health|Set up…|"
    "Key for the forces: H…|Arm the simulated robot by a held key too|Measure the delay…|"
    "Cost of accuracy…|"
    # exercises to do, and what comes of them
    "Briefing of this exercise|Show me this exercise|Watch the arm do my plan|Past sessions|"
    "Workspace|Start page|"
    "Role|Student: practise, progress, help|"
    "Instructor: also patients, exercises, courses and results|"  # asks for the password
    "Technician: also robot, cameras, checks, effects and cost of accuracy|"
    "Progress and courses|Progress, students and courses|Curve|Attempts…|Sign in as a student…|"
    "Sign in as the instructor…|Sign out|Three-minute tour|User guide|Help on this part|"
    "Keys and mouse|Report a problem…|About Acus|Quit"
)
"""Texts of actions that are open to everybody: add one here only if it changes neither exercises,
people, courses nor attempts of others, and lets nothing of others leave."""

NOT_OURS = frozenset({"Export...", ""})
"""Texts of a library's own actions, in menus that the window does not show."""

BUTTONS_MAY = listed(
    "All metrics|Details|"
    "Back|Open|Again|Next|Sessions|Export CSV|Save report (PDF)|▶ Play|❚❚ Pause|Curve|Attempts…|"
    "Begin|Open its CT…|Scroll Left|Scroll Right"
)
"""Likewise of buttons on the pages of attempts and people; the debrief exports what it shows."""


def text_of(action):
    return re.sub(r"&(?=\S)", "", action.text()).split("\t")[0]


def files():
    """Everything in the user's folder that somebody could have changed."""
    cache = (".sqlite-wal", ".sqlite-shm", ".json")
    return {
        str(path): path.read_bytes()
        for path in paths.data().rglob("*")
        if path.is_file() and not path.name.endswith(cache)
    }


def usable(window):
    return {
        text_of(action)
        for action in window.findChildren(QAction)
        if action.isEnabled() and action.menu() is None and not action.isSeparator()
    }


def dialogs():
    return [w for w in QApplication.topLevelWidgets() if isinstance(w, QDialog) and w.isVisible()]


@pytest.fixture
def guarded(window, patient, settle, monkeypatch):
    """A window with a patient, an attempt, a student who is chosen, and a password that is set."""
    asked = []
    for name in ("getOpenFileName", "getSaveFileName", "getExistingDirectory"):
        monkeypatch.setattr(QFileDialog, name, lambda *a, **k: asked.append(a) or ("", ""))
    people, feature = People(), window.feature(PeopleFeature)
    ada, _ = people.add(RosterLine("Ada"))
    people.set_instructor("correct horse")
    ACCESS.sign_in(None, instructor=True)
    feature.look()
    feature.show()
    window.show_patient(patient)
    debrief = window.feature(DebriefFeature)
    debrief._controller._show(review(), "")
    assert settle(lambda: ACCESS.guarded and feature.page.students.table.rowCount() == 1)
    feature.page.students.table.selectRow(0)
    settle()
    yield window, ada, asked
    feature.close()


@pytest.mark.long("journey")
@pytest.mark.parametrize("signed_in", [False, True])
def test_no_action_that_a_student_may_not_use_is_enabled_or_does_anything(
    guarded, settle, signed_in
):
    window, ada, asked = guarded
    instructor = usable(window)
    ACCESS.sign_in(ada if signed_in else None)
    settle()
    student = usable(window)
    new = student - STUDENTS_MAY - NOT_OURS
    assert not new, f"open to students: close them, or add them to STUDENTS_MAY: {sorted(new)}"
    closed = instructor - student
    assert {"Make an exercise from the open patient…", "Comment…", "Back up everything…"} <= closed
    before = files()
    for action in window.findChildren(QAction):
        if text_of(action) in closed:
            action.setEnabled(True)  # as by a mistake somewhere else
            action.trigger()
            settle()
            assert not dialogs(), text_of(action)
            assert not asked, text_of(action)
    assert files() == before


@pytest.mark.long("journey")
@pytest.mark.parametrize("signed_in", [False, True])
def test_no_button_of_people_and_attempts_does_what_a_student_may_not(guarded, settle, signed_in):
    window, ada, asked = guarded
    ACCESS.sign_in(ada if signed_in else None)
    settle()
    debrief, before, tried = window.feature(DebriefFeature), files(), []
    pages = (debrief.page, debrief.sessions, window.feature(PeopleFeature).page)
    for page in pages if signed_in else pages[:2]:
        for button in page.findChildren(QAbstractButton):
            text = button.text().split(":")[0]
            if not text or text in BUTTONS_MAY or isinstance(button.parent(), QTabBar):
                continue
            assert not (button.isVisibleTo(page) and button.isEnabled()), text
            if button.isCheckable() or getattr(button, "menu", lambda: None)() is not None:
                continue
            button.setEnabled(True)
            button.click()
            settle()
            tried.append(text)
            assert not dialogs(), text
            assert not asked, text
    assert files() == before
    assert "Delete" in tried
    assert ("Erase…" in tried) == signed_in


@pytest.mark.long("journey")
def test_an_exercise_that_was_open_when_the_instructor_left_is_not_kept_by_whoever_comes(
    guarded, settle
):
    window, ada, _ = guarded
    feature, said = window.feature(AuthorFeature), []
    feature.failed.connect(said.append)
    feature.make()
    assert feature.dialog is not None
    ACCESS.sign_in(ada)
    before = files()
    assert not feature.keep()
    feature.export()
    assert files() == before
    assert "Only the instructor" in said[0]
    ACCESS.sign_in(None, instructor=True)
    feature._close_dialog()
