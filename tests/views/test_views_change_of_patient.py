"""Another patient: asked for first, the old one whole until the new one is there, then gone."""

import threading
from pathlib import Path
from types import MappingProxyType

import numpy as np
import pytest
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QComboBox,
    QLabel,
    QLineEdit,
    QListWidget,
    QMessageBox,
    QWidget,
)
from views_exercise_fakes import FakeTrainer as Recorder
from views_exercise_fakes import pose as pose_of
from views_exercise_fakes import snapshot as snapshot_of
from window_rig import FakeServices, plan

from app.core.events import Event
from app.exercises.guidance import GuidancePart, Purpose
from app.exercises.library import load_exercise
from app.imaging.body import find_body
from app.imaging.errors import ImagingError
from app.imaging.scan_order import ScanNeedle, ScanOrder
from app.imaging.structures.edit import brushed
from app.planning.measurements import Distance
from app.planning.patient import Patient
from app.planning.placement import Placement
from app.session.control_scan import ControlScan
from app.session.machine import State
from app.session.shown_views import Shown
from app.views.accuracy.feature import AccuracyFeature
from app.views.debrief.feature import DebriefFeature
from app.views.exercise.run import ExerciseRun
from app.views.kit.roles import Role
from app.views.plan.feature import PlanFeature
from app.views.robot.feature import RobotFeature
from app.views.series.feature import SeriesFeature
from app.views.shell.window import MainWindow
from app.views.slices.viewing import Tool

OLD, NEW = "CT-OLDER-7731", "CT-NEWER-0042"
PLANTED = ("7731", "77.7", "54:21", "1234", "98.7", "OLDPLAN", "oldvessel", "oldnote", "Scans: 3")
SEEN_LIVE = ("7731", "77.7", "54:21", "98.7", "OLDPLAN", "oldnote")
SEEN_BY_SCANS = ("7731", "54:21", "OLDPLAN", "oldnote", "Scans: 3", "3702")


@pytest.fixture
def volumes(volume):
    other = type(volume)(volume.hu.copy(), volume.affine_mm.copy(), volume.series)
    return volume, other


@pytest.fixture
def patients(volumes):
    return tuple(
        Patient(volume, find_body(volume), label)
        for volume, label in zip(volumes, (OLD, NEW), strict=True)
    )


def texts(window: QWidget, health: bool = True) -> dict[str, list[str]]:
    """All that a window says: what can be seen, panel by panel, what is hidden, and its values.

    Without past attempts and lists of files, which belong to no patient that is open; without
    `health` also without ages and rates, which change by themselves.
    """
    said: dict[str, list[str]] = {"seen": [window.windowTitle()], "hidden": []}
    pages = [
        window.start_page,
        window.feature(DebriefFeature).page,
        window.feature(DebriefFeature).sessions,
    ]
    if not health:
        shown = window.workspace
        pages += [
            shown.status,
            shown.rail._health,
            shown.rail._busy,
            window.feature(RobotFeature).panel,
            window.feature(AccuracyFeature).panel,  # of the time that a tick takes just now
            shown.tracker_panel,
            window.progress,
        ]
    side = window.workspace.side
    for tab in range(side.count()):
        side.setCurrentIndex(tab)
        for widget in window.centralWidget().findChildren(QWidget):
            if any(page is widget or page.isAncestorOf(widget) for page in pages):
                continue
            seen = widget.isVisible() and not widget.visibleRegion().isEmpty()
            said["seen" if seen else "hidden"] += words_of(widget)
    viewing, workspace = window.workspace.viewing, window.workspace
    said["values"] = [str(value) for value in (
        window.undo.can_undo, window.undo.can_redo, workspace.grid.maximised, viewing.needle,
        viewing.target_now_mm, viewing.draft, viewing.target_error, viewing.tool,
        window.conductor.controller.run, window.editor.path, window.editor.edit.placement,
        window.editors.measures.items, window.editors.structures.structures,
        workspace.scan_view.scan,
    )]  # fmt: skip
    return {key: sorted(found) for key, found in said.items()}


def words_of(widget: QWidget) -> list[str]:
    """Everything that one widget says."""
    said = [widget.toolTip(), widget.accessibleName(), widget.accessibleDescription()]
    if isinstance(widget, QLabel | QAbstractButton | QLineEdit):
        said.append(widget.text())
    elif isinstance(widget, QComboBox):
        said.append(widget.currentText())
    elif isinstance(widget, QListWidget):
        said += [widget.item(row).text() for row in range(widget.count())]
    elif isinstance(widget, QAbstractItemView) and widget.model() is not None:
        model = widget.model()
        said += [str(model.index(row, column).data()) for row in range(model.rowCount())
                 for column in range(model.columnCount())]  # fmt: skip
    for name in ("words", "legend", "note", "number"):
        value = getattr(widget, name, None)
        if isinstance(value, str | tuple):
            said.append(str(value))
    return [text for text in said if text]


def settled(window, settle):
    """The window with the bull's-eye, once surfaces and words are there."""
    window.workspace.show_bullseye(True)
    window.workspace.side.setCurrentIndex(0)
    assert settle(lambda: not window.conductor._surfaces.is_running)
    settle(timeout=0.4)
    return window


def fill(window, settle, live=True):
    """Fill every feature with what belongs to the old patient alone."""
    workspace = window.workspace
    plan(window)
    window.editor.set_placement(Placement(rotation_deg=(0.0, 0.0, 12.34)))
    assert settle(lambda: window.runs.run is not None and window.conductor.settled)
    window.editor.saved(Path("OLDPLAN.mrk.json"))
    placed = window.runs.run.placed
    where = pose_of(placed, 0.2, 0.0777, deflection=0.0987, deflection_sigma=1e-4)
    moment = snapshot_of(
        placed, pose=where, elapsed=3261.0, scans=3, state=State.HOLDING,
        p_target=placed.p_target + 0.004, slots={"axial_force": 1.234},
        phases=MappingProxyType({State.HOLDING: 3.0}), messages=("oldnote 7731",),
    )  # fmt: skip
    trainer = Recorder(placed, now=moment)
    run = ExerciseRun(trainer, placed, window.runs.run.profile, guidance=GuidancePart(),
                      shown=Shown(live=live))  # fmt: skip
    window.conductor._attach(run)
    workspace.show_exercise()
    for number in (1, 2, 3):
        order = ScanOrder(140.0, 3, 4.0)
        needle = ScanNeedle(np.array([5.0, -150.0, 140.0]), np.array([5.0, 0.0, 140.0]))
        scan = ControlScan(number, 3.0, order, needle, np.zeros(3), 1234.0)
        data = {"number": number} | scan.data()
        trainer.events.put(Event(3.0, "scan", "oldnote: control scan", data))
    tabs = workspace.side
    for tab in range(tabs.count()):
        tabs.setCurrentIndex(tab)
        settle(timeout=0.02)
        controller = window.conductor.controller
        workspace.tracker_panel._shown = window.feature(RobotFeature).panel._shown = -1e9
        controller._display._status_time = controller._display._figures_time = -1.0
        controller.poll()
    assert settle(lambda: not window.conductor.scans.is_busy)
    window.editors.measures.add(Distance((0.0, 0.0, 130.0), (3.0, 2.0, 131.0), "oldnote"))
    volume = window.conductor.patient.volume
    vessel = brushed(None, volume, (5.0, -5.0, 140.0), 4.0, True)
    window.editors.structures.put("oldvessel", *vessel)
    workspace.viewing.set_tool(Tool.ENTRY)
    pane = workspace.grid.pane("bullseye") if not live else workspace.panes[1]
    workspace.grid.toggle(pane)
    return trainer


@pytest.mark.long("journey")
@pytest.mark.parametrize("live", [True, False])
def test_nothing_of_the_old_patient_is_left_in_any_widget(
    application, tmp_path, patients, settle, destroy, live
):
    old, new = patients
    found = []
    for first in (None, old):
        window = MainWindow(FakeServices(tmp_path))
        destroy(window)
        window.show()
        window.conductor.set_exercise(load_exercise("first-insertion"))
        if first is not None:
            window.show_patient(first)
            fill(window, settle, live)
            before = " ".join(texts(window)["seen"] + texts(window)["hidden"])
            wanted = SEEN_LIVE if live else SEEN_BY_SCANS
            missing = [word for word in wanted if word not in before]
            assert missing == [], "the old patient is to be seen before"
        window.show_patient(new)
        found.append(texts(settled(window, settle)))
        window.editor.saved(Path("kept"))
        window.close()
    fresh, changed = found
    left = [(text, word) for texts_ in changed.values() for text in texts_ for word in PLANTED
            if word in text]  # fmt: skip
    assert left == [], left
    assert changed["values"] == fresh["values"]
    more = [text for text in changed["seen"] if text not in fresh["seen"]]
    assert more == [], more


@pytest.mark.long("journey")
def test_a_patient_without_a_plan_leaves_no_robot_of_the_last_one(
    window, patients, settle, services
):
    old, new = patients
    window.show_patient(old)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    window.show_patient(new)
    settle(timeout=0.5)
    assert window.runs.run is None
    assert len(services.opened) == 1  # none was built again for the plan that is gone
    assert services.opened[0].closed.wait(30.0)
    assert not window.workspace.exercise_panel.buttons.start.isEnabled()


@pytest.mark.long("journey")
def test_a_maximised_scan_does_not_make_the_next_ct_black(window, patients, settle):
    old, new = patients
    window.show_patient(old)
    window.workspace.show_bullseye(True)
    window.workspace.grid.toggle(window.workspace.grid.pane("bullseye"))
    assert not window.workspace.panes[0].isVisible()
    window.show_patient(new)
    assert window.workspace.panes[0].isVisible()
    assert settle(lambda: window.workspace.panes[0].canvas.is_settled)


# --- asking -----------------------------------------------------------------------------------
@pytest.fixture
def answers(monkeypatch):
    """Answer questions from a list, and keep what was asked."""
    asked, given = [], []

    def question(parent, title, text, *_):
        asked.append(text)
        return given.pop(0)

    monkeypatch.setattr(QMessageBox, "question", staticmethod(question))
    return asked, given


@pytest.fixture
def slow(monkeypatch, patients):
    """A phantom that is read only when it is let."""
    go = threading.Event()
    outcome: dict[str, object] = {"patient": patients[1]}

    def load(seed, progress):
        while not go.wait(0.01):
            progress.report(0.5, "reading")
        if "error" in outcome:
            raise outcome["error"]
        return outcome["patient"]

    monkeypatch.setattr("app.views.series.open_ct.load_phantom", load)
    yield go, outcome
    go.set()


def with_attempt(window, patient, settle):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    window.conductor.controller.begin("")
    assert settle(lambda: window.editor.locked)
    # The needle is told once the panes of the attempt have their pictures.
    assert settle(lambda: window.workspace.viewing.needle is not None)


@pytest.mark.long("journey")
def test_what_would_be_replaced_is_named_and_cancelling_changes_nothing(
    window, patients, settle, answers, slow
):
    asked, given = answers
    with_attempt(window, patients[0], settle)
    run, before = window.runs.run, window.editor.edit
    given.append(QMessageBox.StandardButton.Cancel)
    window.begin_exercise("thick-tissue")
    (text,) = asked
    assert OLD in text
    assert "attempt that is running" in text
    assert "unsaved changes" in text
    assert not window.open_ct.is_reading
    assert window.runs.run is run
    assert window.editor.edit == before
    assert window.conductor.exercise.id == "first-insertion"
    assert window.workspace.exercise_panel.exercise.currentData() == "first-insertion"


@pytest.mark.long("journey")
def test_a_student_is_asked_about_nothing_that_he_did_not_make(
    window, patients, settle, answers, slow
):
    asked, _ = answers
    window.roles.choose(Role.STUDENT)
    with_attempt(window, patients[0], settle)
    window.conductor.controller.run.trainer.state = State.ENDED
    assert settle(lambda: not window.editor.locked)
    assert window.editor.dirty  # his plan, which the attempt's record has
    window.begin_exercise("thick-tissue")
    assert window.open_ct.is_reading
    assert asked == []


@pytest.mark.long("journey")
def test_a_student_is_asked_about_his_plan_that_no_attempt_has_and_enter_keeps_it(
    window, patients, settle, monkeypatch, slow
):
    asked, box = [], QMessageBox.StandardButton

    def question(parent, title, text, choices, default):
        asked.append((text, choices, default))
        return default

    monkeypatch.setattr(QMessageBox, "question", staticmethod(question))
    window.roles.choose(Role.STUDENT)
    window.show_patient(patients[0])
    plan(window)
    before = window.editor.edit
    window.begin_exercise("thick-tissue")
    assert not window.open_ct.is_reading
    assert not window.context.shell.may_go()
    (text, *first), (_, *second) = asked
    assert OLD not in text
    assert "no attempt has" in text
    assert first == second == [box.Discard | box.Cancel, box.Cancel], "nothing is written"
    assert window.editor.edit == before


@pytest.mark.long("journey")
@pytest.mark.parametrize("role", [Role.INSTRUCTOR, Role.TECHNICIAN])
def test_enter_on_a_question_about_a_plan_writes_no_file(window, patients, monkeypatch, role):
    defaults, saved = [], []

    def question(parent, title, text, choices, default):
        defaults.append(default)
        return default

    monkeypatch.setattr(QMessageBox, "question", staticmethod(question))
    monkeypatch.setattr(window.feature(PlanFeature).files, "save", lambda: saved.append(1))
    window.roles.choose(role)
    window.show_patient(patients[0])
    plan(window)
    window.begin_exercise("thick-tissue")
    window.context.shell.may_go()
    assert defaults == [QMessageBox.StandardButton.Cancel] * 2
    assert saved == []
    assert not window.open_ct.is_reading


@pytest.mark.long("journey")
@pytest.mark.parametrize("end", ["fails", "is cancelled"])
def test_until_the_new_patient_is_there_the_old_one_is_whole(
    window, patients, settle, answers, slow, end
):
    _, given = answers
    go, outcome = slow
    with_attempt(window, patients[0], settle)
    run, before = window.runs.run, texts(window, health=False)
    given.append(QMessageBox.StandardButton.Discard)
    window.begin_exercise("thick-tissue")
    assert window.open_ct.is_reading
    settle(timeout=0.2)
    assert window.conductor.patient is patients[0]
    assert window.conductor.exercise.id == "first-insertion"
    assert window.runs.run is run
    assert run.trainer.state is State.ALIGNING  # it goes on
    if end == "fails":
        outcome["error"] = ImagingError("the CT cannot be read")
        go.set()
    else:
        window.open_ct._task.cancel()
    assert settle(lambda: not window.open_ct.is_reading)
    window.message_bar.clear()
    settle(timeout=0.1)
    after = texts(window, health=False)
    assert after["values"] == before["values"]
    then, now = before["seen"], after["seen"]
    other = [text for text in (*then, *now) if then.count(text) != now.count(text)]
    assert other == [], other
    assert window.workspace.exercise_panel.exercise.currentData() == "first-insertion"


@pytest.mark.long("journey")
def test_then_the_attempt_is_saved_and_the_new_patient_has_its_exercise(
    window, patients, settle, answers, slow
):
    _, given = answers
    go, _ = slow
    with_attempt(window, patients[0], settle)
    reasons = []
    window.runs.run.trainer.abort = reasons.append
    given.append(QMessageBox.StandardButton.Discard)
    window.begin_exercise("thick-tissue")
    go.set()
    assert settle(lambda: window.conductor.patient is patients[1])
    assert settle(lambda: reasons == ["another patient was opened"])  # beside the window
    assert window.conductor.exercise.id == "thick-tissue"
    assert not window.editor.locked
    assert window.pages.currentWidget() is window.workspace


@pytest.mark.long("journey")
def test_start_waits_while_a_patient_is_loaded_and_says_why(
    window, patients, settle, answers, slow
):
    _, given = answers
    go, outcome = slow
    window.show_patient(patients[0])
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    panel, run = window.workspace.exercise_panel, window.runs.run
    assert panel.buttons.start.isEnabled()
    given.append(QMessageBox.StandardButton.Discard)
    window.feature(SeriesFeature).open_phantom()
    assert not panel.buttons.start.isEnabled()
    assert "another patient" in panel.buttons.start.toolTip()
    assert "another patient" in panel._note.text()
    window.conductor._show_plan()
    assert not panel.buttons.start.isEnabled()
    window.conductor.controller.begin("")
    assert run.trainer.state is State.READY
    outcome["error"] = ImagingError("the CT cannot be read")
    go.set()
    assert settle(lambda: not window.open_ct.is_reading)
    assert panel.buttons.start.isEnabled()
    assert not panel._note.isVisible()


@pytest.mark.long("journey")
def test_another_exercise_of_the_same_patient_waits_for_the_attempt_to_end(
    window, patients, settle
):
    with_attempt(window, patients[0], settle)
    window.conductor.fits = lambda *_: True
    window.begin_exercise("thick-tissue")
    assert window.conductor.exercise.id == "first-insertion"
    assert "An attempt is running" in window.message_bar.text


@pytest.mark.long("journey")
def test_an_assessment_is_not_begun_on_another_patient_than_its_own(
    window, patient, settle
) -> None:
    exercise = load_exercise("first-insertion").model_copy(
        update={"purpose": Purpose.ASSESSMENT, "locks": None}
    )
    window.conductor.set_exercise(exercise)
    window.show_patient(patient)
    assert not window.conductor.fits(patient)
    plan(window)
    settle(timeout=0.3)
    panel = window.workspace.exercise_panel
    assert window.runs.run is None
    assert not panel.buttons.start.isEnabled()
    assert "made for another CT" in panel.buttons.start.toolTip()
    window.conductor.set_exercise(load_exercise("first-insertion"))
    plan(window)
    assert settle(lambda: window.runs.run is not None), "practice on one's own patient stays free"
