"""An exercise made in the window: the form, its messages, undo, trying, keeping, files."""

import threading
from dataclasses import replace

import numpy as np
import pytest
from dicom_factory import SERIES, Slices
from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtGui import QKeyEvent, QKeySequence, QShortcut
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QCheckBox, QFileDialog, QMessageBox
from window_rig import plan

from app.core import paths
from app.core.errors import AcusError
from app.exchange.acusx import pack
from app.exercises.library import folders, load_exercise, versions
from app.exercises.parts import OwnPlan, PlanPoints
from app.exercises.schema import Exercise
from app.imaging.reading import load_ct
from app.imaging.structures.files import read_structures
from app.imaging.structures.structure import Structure, StructureKind, StructureSet
from app.imaging.window import WindowLevel
from app.planning.placement import PatientOrientation, Placement
from app.views.author.feature import AuthorFeature
from app.views.slices.viewing import Tool


@pytest.fixture
def opened(window, patient, settle, tmp_path):
    """A CT of one's own is open, with a plan."""
    folder = tmp_path / "given"
    folder.mkdir()
    window.show_patient(replace(patient, folder=folder))
    plan(window)
    settle()
    return window


@pytest.fixture
def author(opened):
    yield opened.feature(AuthorFeature)
    opened.feature(AuthorFeature).forget()  # the form goes unasked


@pytest.fixture
def form(author):
    author.make()
    assert author.dialog is not None
    return author.dialog


def write(line, text):
    line.setFocus()
    line.selectAll()
    QTest.keyClicks(line, text)


def said(dialog):
    return dialog.note.text()


@pytest.mark.long("journey")
def test_a_few_clicks_make_an_exercise_of_what_is_open(opened, author, form, settle):
    assert form.isVisible()
    assert not form.keep.isEnabled()
    assert form.keep.toolTip() == "Title: is empty: type something"
    write(form.task.name, "Lung, left")
    assert form.keep.isEnabled()
    QTest.mouseClick(form.keep, Qt.MouseButton.LeftButton)
    assert "“lung-left”, version 1" in said(form)
    kept = load_exercise("lung-left")
    assert isinstance(kept.plan, PlanPoints)
    assert kept.plan.plan() == opened.editor.edit.draft.plan()
    assert kept.ct.digest == opened.conductor.patient.volume.digest
    assert kept.ct.folder == opened.conductor.patient.folder
    panel = opened.conductor.views.panel.exercise
    assert panel.findData("lung-left") >= 0
    assert opened.start_page.map.places["lung-left"].title.text() == "Lung, left"


@pytest.mark.long("journey")
def test_an_exercise_with_something_of_everything_takes_fewer_than_forty_clicks(
    opened, author, settle
):
    clicks = 4  # Place E and a place, Place T and a place

    def click(widget, x=None):
        nonlocal clicks
        clicks += 1
        at = widget.rect().center() if x is None else QPoint(x, widget.rect().center().y())
        QTest.mouseClick(widget, Qt.MouseButton.LeftButton, pos=at)

    def go_to(page):
        nonlocal clicks
        clicks += 1
        at = form.list.visualItemRect(form.list.item(page)).center()
        QTest.mouseClick(form.list.viewport(), Qt.MouseButton.LeftButton, pos=at)
        assert form.pages.currentIndex() == page

    clicks += 3  # File, Exercise, its first entry
    author.make()
    form = author.dialog
    write(form.task.name, "All of it")
    click(form.task.level)
    QTest.keyClick(form.task.level, Qt.Key.Key_Up)
    click(form.task.briefing.viewport())
    QTest.keyClicks(form.task.briefing, "Go slowly.")
    go_to(2)
    click(form.help.way)
    form.help.way.hidePopup()  # the choice by key
    QTest.keyClick(form.help.way, Qt.Key.Key_Down)
    form.help.way.activated.emit(form.help.way.currentIndex())
    click(form.help.laws.boxes["cone_wall"], 8)
    go_to(3)
    for box in form.sight.fields["views",].findChildren(QCheckBox)[3:5]:
        click(box, 8)
    for box in form.sight.fields["locks",].findChildren(QCheckBox)[:2]:
        click(box, 8)
    go_to(4)
    for name in ("shaft_friction", "lateral_tissue", "breathing"):
        click(form.effects.parts.boxes[name], 8)
    go_to(5)
    row = list(form.score.metrics).index("target_error")
    at = form.score.bands.visualItemRect(form.score.bands.item(row, 0))
    clicks += 1
    place = QPoint(at.left() + 12, at.center().y())
    QTest.mouseClick(form.score.bands.viewport(), Qt.MouseButton.LeftButton, pos=place)
    go_to(6)
    assert "✔" in form.review.verdict.text()
    click(form.attempt)
    click(form.keep)
    kept = load_exercise("all-of-it")
    assert (kept.level, kept.description) == (2, "Go slowly.")
    assert kept.fading is not None
    assert set(kept.laws) == {"fixture", "cone_wall"}
    assert set(kept.effects) == {"shaft_friction", "lateral_tissue", "breathing"}
    assert {"cameras", "force_gauge"} <= {view.value for view in kept.views}
    assert len(kept.locked) == 2
    assert "target_error" in kept.tolerances
    assert clicks <= 40


def test_without_a_ct_it_says_what_to_do(window, settle):
    errors = []
    author = window.feature(AuthorFeature)
    author.failed.connect(errors.append)
    author.make()
    assert author.dialog is None
    assert "open one first" in errors[0]


@pytest.mark.long("journey")
def test_every_mistake_is_said_at_its_field_and_at_its_page(form, author):
    write(form.task.name, "X")
    form.show_page(5)
    author.editor.put("tolerances", "angle_error", "good", value="two")
    note = next(one for where, one in form.score._notes if where == ("tolerances",))
    assert note.isVisibleTo(form.score)
    assert "Angle error, good" in note.text()
    assert [mark.value for mark, _ in form.marks()] == ["good"] * 5 + ["bad", "bad"]
    assert form.list.item(5).text().startswith("✖")
    assert not form.attempt.isEnabled()
    assert author.editor.exercise is None
    author.editor.undo()
    assert not note.isVisibleTo(form.score)
    assert form.keep.isEnabled()


@pytest.mark.long("journey")
def test_typed_letters_are_one_step_and_undo_and_redo_go_through_all(form, author):
    write(form.task.name, "One")
    form.task.level.setValue(4)
    form.task.briefing.setPlainText("Look first.\nThen go.")
    form.undo.click()
    assert form.task.briefing.toPlainText() == ""
    form.undo.click()
    assert form.task.level.value() == 1
    form.undo.click()
    assert form.task.name.text() == ""
    assert not form.undo.isEnabled()
    for _ in range(3):
        form.redo.click()
    assert author.editor.get("level") == 4
    assert author.editor.get("description") == "Look first.\nThen go."


@pytest.mark.long("journey")
def test_the_types_set_path_pictures_and_dial(form, author):
    write(form.task.name, "X")
    box = form.task.kind
    for place, words in ((1, "own"), (2, "scans"), (0, "follow")):
        box.setCurrentIndex(place)
        box.activated.emit(place)
        assert box.currentData() == words
        judged = "plan_score" in author.editor.get("tolerances", default={})
        assert judged == (words == "own"), "a plan counts where the student makes it"
        assert not author.editor.problems_at("tolerances")
    form.undo.click()
    assert author.editor.get("guidance", "mode") == "control_ct"
    assert author.editor.exercise.shown_views == ("three_d",)
    form.undo.click()
    assert isinstance(author.editor.exercise.plan, OwnPlan)
    form.undo.click()
    assert isinstance(author.editor.exercise.plan, PlanPoints)


@pytest.mark.long("journey")
def test_path_and_position_are_taken_anew_from_the_window(opened, form, author):
    write(form.task.name, "X")
    form.show_page(1)
    opened.editor.set_placement(Placement(PatientOrientation.PRONE, (0.0, 0.0, 10.0)))
    form.patient.take.click()
    assert author.editor.exercise.placement.placement() == opened.editor.edit.placement
    assert "prone" in form.patient.where.text()


@pytest.mark.long("journey")
def test_window_and_slab_are_taken_from_the_axial_pane(opened, form, author):
    write(form.task.name, "X")
    form.show_page(3)
    opened.workspace.viewing.greys.set(WindowLevel(1234.0, -567.0))
    form.sight.take.click()
    reading = author.editor.exercise.reading
    assert reading.window_level == WindowLevel(1234.0, -567.0)
    assert reading.slab.thickness_mm == 0.0
    assert "W 1234  L -567" in [
        form.sight.fields["reading", "window"].itemText(n)
        for n in range(form.sight.fields["reading", "window"].count())
    ]
    form.sight.fields["reading", "locked"].click()
    assert author.editor.exercise.reading.locked
    form.undo.click()
    form.undo.click()
    assert author.editor.exercise.reading.window is None


@pytest.mark.long("journey")
def test_structures_of_risk_are_written_and_go_along(opened, author, settle):
    volume = opened.conductor.patient.volume
    mask = np.zeros(volume.hu.shape, bool)
    mask[10:14, 20:24, 20:24] = True
    drawn = (Structure.of("vessel", mask, volume, StructureKind.VESSEL),
             Structure.of("other", mask, volume, StructureKind.OTHER))  # fmt: skip
    opened.editors.structures.add(StructureSet(drawn))
    author.make()
    form = author.dialog
    write(form.task.name, "Past it")
    form.show_page(1)
    rows = form.patient.risks
    assert [rows.item(n, 0).text() for n in range(rows.rowCount())] == ["vessel", "other"]
    box = rows.cellWidget(1, 1)
    assert isinstance(box, QCheckBox)
    box.click()
    rows.cellWidget(1, 2).setValue(7.0)
    form.keep.click()
    kept = load_exercise("past-it")
    assert dict(kept.structures[0].risks) == {"vessel": 3.0, "other": 7.0}
    assert kept.structures[0].file.is_file()
    assert kept.tolerances["risk_breach"].required


@pytest.fixture
def painted(opened, author):
    """An exercise with a structure of risk that was painted in the window."""
    volume = opened.conductor.patient.volume
    mask = np.zeros(volume.hu.shape, bool)
    mask[10:14, 20:24, 20:24] = True
    drawn = Structure.of("vessel", mask, volume, StructureKind.VESSEL)
    opened.editors.structures.add(StructureSet((drawn,)))
    author.make()
    write(author.dialog.task.name, "Past it")
    return author.dialog


@pytest.mark.long("journey")
def test_a_kept_exercise_with_a_painted_structure_goes_on_living(painted, author):
    for _ in range(2):  # kept, and kept again without a change
        painted.keep.click()
        assert author.editor.problems == ()
        assert all(b.isEnabled() for b in (painted.keep, painted.attempt, painted.export))
    assert versions("past-it") == (1,)
    painted.task.level.setValue(5)
    painted.keep.click()
    assert versions("past-it") == (1, 2)
    painted.copy.click()
    painted.keep.click()
    assert load_exercise("past-it-copy").structures[0].file.is_file()


@pytest.mark.long("journey")
def test_what_is_painted_after_keeping_is_in_the_next_version(opened, painted, author):
    painted.keep.click()
    book = opened.editors.structures
    first = load_exercise("past-it").structures[0].file
    mask = np.ones((3, 3, 3), bool)
    book.put("vessel", mask, (2, 2, 2))
    assert "not kept yet" in author.unsaved()
    painted.keep.click()
    second = load_exercise("past-it").structures[0].file
    volume = opened.conductor.patient.volume
    assert versions("past-it") == (1, 2)
    assert read_structures(first, volume).find("vessel").mask.sum() == 64
    assert read_structures(second, volume).find("vessel").mask.sum() == 27
    assert author.unsaved() == ""


@pytest.mark.long("journey")
def test_a_painted_structure_of_risk_that_was_removed_is_no_reason_to_lose_its_file(
    opened, painted, author
):
    painted.keep.click()
    opened.editors.structures.remove("vessel")
    painted.task.level.setValue(4)
    painted.keep.click()
    volume = opened.conductor.patient.volume
    kept = load_exercise("past-it")
    assert read_structures(kept.structures[0].file, volume).find("vessel").mask.any()


@pytest.mark.long("journey")
def test_effects_say_live_why_they_are_simulated_or_left_out_and_what_they_cost(
    form, author, settle
):
    write(form.task.name, "X")
    form.show_page(4)
    form.effects.parts.boxes["breathing"].click()
    why = form.effects.parts._why["breathing"]
    assert why.text().startswith("✔")
    form.effects.parts.values[
        "breathing",
        next(iter(key for name, key in form.effects.parts.values if name == "breathing")),
    ].textEdited.emit("x")
    assert not form.keep.isEnabled()
    author.editor.undo()
    assert settle(lambda: "each tick" in form.effects.cost.text())


def kept_while_measured(form, author, services, settle, monkeypatch, explain):
    """Keep an exercise while it is measured; returns what is said at once, and lets that end."""
    goes_on, may_end = threading.Event(), threading.Event()

    def slowly(exercise):
        goes_on.set()
        may_end.wait(30.0)
        return explain(exercise)

    monkeypatch.setattr(services, "explain_exercise", slowly)
    write(form.task.name, "Lung, left")
    author._cost_timer.setInterval(1)
    try:
        assert settle(goes_on.is_set)
        QTest.mouseClick(form.keep, Qt.MouseButton.LeftButton)
        at_once = said(form)
    finally:
        may_end.set()
    return at_once


@pytest.mark.long("journey")
def test_who_keeps_an_exercise_before_it_is_checked_is_told_so_and_then_what_it_lacks(
    form, author, services, settle, monkeypatch
):
    call = {"effect": "bone_contact", "reason": "no needle goes through rib at 12 mm"}
    call |= {"absent": True, "simulated": False, "without": "", "cost_ns": 20.0}
    result = {"simulated": [], "laws": [], "called_for": [call], "add": {}}
    words = kept_while_measured(form, author, services, settle, monkeypatch, lambda _: result)
    assert words.startswith("▲ Kept as “lung-left”, version 1. Not checked yet")
    assert settle(lambda: "Not checked" not in said(form))
    lacks = "The patient calls for more: bone_contact."
    assert said(form) == f"▲ Kept as “lung-left”, version 1. {lacks}"


@pytest.mark.long("journey")
def test_an_exercise_that_cannot_be_checked_is_kept_with_the_reason(
    form, author, services, settle, monkeypatch
):
    def fails(_):
        raise AcusError("the tissue is not known")

    words = kept_while_measured(form, author, services, settle, monkeypatch, fails)
    assert "Not checked yet" in words
    assert settle(lambda: "cannot be checked: the tissue is not known" in said(form))
    words = "It cannot be measured: the tissue is not known"
    assert settle(lambda: form.effects.cost.text() == words)  # measured once more after Keep


@pytest.mark.long("journey")
def test_who_keeps_an_exercise_that_was_checked_hears_of_no_doubt(form, author, settle):
    author._cost_timer.setInterval(1)
    write(form.task.name, "Lung, left")
    assert settle(lambda: "each tick" in form.effects.cost.text())
    QTest.mouseClick(form.keep, Qt.MouseButton.LeftButton)
    assert said(form).endswith("Kept as “lung-left”, version 1.")


@pytest.mark.long("journey")
def test_what_the_patient_calls_for_is_listed_and_added_by_one_click(form, author):
    write(form.task.name, "X")
    author.editor.put("effects", value={"lateral_tissue": {}})
    call = {"effect": "bone_contact", "reason": "no needle goes through rib at 12 mm"}
    call |= {"absent": True, "simulated": False, "without": "", "cost_ns": 20.0}
    more = {"tissue": "field", "effects": {"bone_contact": {}}}
    form.effects.show_cost({"simulated": [], "laws": [], "called_for": [call], "add": more})
    assert "rib at 12 mm" in form.effects.calls.text()
    form.effects.complete.click()
    exercise = author.editor.exercise
    assert set(exercise.effects) == {"lateral_tissue", "bone_contact"}
    assert exercise.tissue.value == "field"
    author.editor.undo()
    assert set(author.editor.exercise.effects) == {"lateral_tissue"}
    form.effects.show_cost({"simulated": [], "laws": [], "called_for": [], "add": {}})
    assert not form.effects.complete.isVisibleTo(form)


@pytest.mark.long("journey")
def test_an_effect_is_of_an_organ_and_computed_in_a_way_that_is_chosen(form, author):
    write(form.task.name, "X")
    form.show_page(4)
    form.effects.parts.boxes["breathing"].click()
    write(form.effects.parts.organs["breathing"], "lung")
    author.editor.put("target_organ", value="liver")
    assert form.effects.parts._why["breathing"].text().startswith("✖")
    assert author.editor.exercise.effects["breathing"].organ == "lung"
    name, way = next(iter(form.effects.parts.ways.items()))
    form.effects.parts.boxes[name].setChecked(False)
    if name not in author.editor.exercise.effects:
        form.effects.parts.boxes[name].click()
    way.setCurrentIndex(1)
    way.activated.emit(1)
    assert author.editor.exercise.effects[name].model == way.currentData()


@pytest.mark.long("journey")
def test_bands_are_edited_in_the_table_and_their_rings_drawn_on_the_ct(opened, form, author):
    write(form.task.name, "X")
    form.show_page(5)
    row = list(form.score.metrics).index("lateral_error")
    form.score.bands.item(row, 3).setText("9")
    assert author.editor.exercise.tolerances["lateral_error"].pass_ == 9.0
    assert opened.workspace.viewing.tolerances_mm == pytest.approx((0.6, 9.0))
    other = list(form.score.metrics).index("peak_force")
    form.score.bands.item(other, 0).setCheckState(Qt.CheckState.Checked)
    assert "peak_force" in author.editor.exercise.tolerances
    author.may_go = lambda: True
    form.may_close = lambda: True
    form.reject()
    assert opened.workspace.viewing.tolerances_mm == pytest.approx((0.6, 2.7))


@pytest.mark.long("journey")
def test_fading_is_chosen_and_its_mistakes_are_said(form, author):
    write(form.task.name, "X")
    form.show_page(2)
    form.help.way.setCurrentIndex(1)
    form.help.way.activated.emit(1)
    assert author.editor.exercise.fading.dials == (0.7, 0.4, 0.2, 0.0)
    assert form.help.dials.isVisibleTo(form.help)
    assert not form.help.fields["fading", "good"].isVisibleTo(form.help)
    write(form.help.dials, "0.5, zero")
    assert not form.keep.isEnabled()
    write(form.help.dials, "0.5, 0")
    assert author.editor.exercise.fading.dials == (0.5, 0.0)
    write(form.help.dials, "0,1; 0,0")  # as a German writes two of them
    assert author.editor.exercise.fading.dials == (0.1, 0.0)


@pytest.mark.long("journey")
def test_it_can_be_tried_without_being_kept(opened, form, author, settle):
    write(form.task.name, "Tried")
    form.task.level.setValue(7)
    form.attempt.click()
    assert opened.conductor.exercise.title == "Tried"
    assert settle(lambda: opened.runs.run is not None)
    assert opened.services.opened[-1].setup.exercise.level == 7
    assert opened.conductor.views.panel.exercise.currentText() == "Tried (not kept)"
    assert not (folders()[1] / "tried.yaml").exists()


@pytest.mark.long("journey")
def test_a_changed_exercise_is_a_new_version_and_a_copy_another_exercise(opened, form, author):
    write(form.task.name, "Mine")
    form.keep.click()
    form.task.level.setValue(5)
    assert "next version" in form.task.kept.text()
    form.keep.click()
    assert versions("mine") == (1, 2)
    assert load_exercise("mine@1").level == 1
    form.copy.click()
    form.keep.click()
    assert load_exercise("mine-copy").level == 5
    assert load_exercise("mine").version == 2


@pytest.mark.long("journey")
def test_an_exercise_that_comes_with_acus_is_copied_before_it_is_changed(opened, author):
    author.change()
    assert "this is a copy" in said(author.dialog)
    assert author.editor.get("id") == "first-insertion-copy"


@pytest.mark.long("journey")
def test_the_present_exercise_is_changed_where_it_is_ones_own(opened, form, author):
    write(form.task.name, "Mine")
    form.keep.click()
    form.attempt.click()
    author.change()
    assert author.dialog.task.name.text() == "Mine"
    assert author.editor.saved == load_exercise("mine")
    author.dialog.task.level.setValue(6)
    author.dialog.keep.click()
    assert load_exercise("mine").version == 2


@pytest.mark.long("journey")
def test_one_that_is_not_kept_is_asked_about(opened, form, author, monkeypatch):
    write(form.task.name, "Mine")
    answers = [QMessageBox.StandardButton.Cancel, QMessageBox.StandardButton.Save]
    monkeypatch.setattr(QMessageBox, "question", staticmethod(lambda *_: answers.pop(0)))
    form.reject()
    assert form.isVisible()
    assert "not kept yet" in author.unsaved()
    form.close()
    assert author.dialog is None
    assert load_exercise("mine").title == "Mine"


@pytest.mark.long("journey")
def test_with_the_patient_the_form_goes(opened, form, patient):
    opened.show_patient(patient)
    assert opened.feature(AuthorFeature).dialog is None


@pytest.mark.long("journey")
def test_an_exercise_is_exported_and_imported_elsewhere(
    opened, form, author, settle, tmp_path, monkeypatch
):
    write(form.task.name, "Mine")
    form.keep.click()
    path = tmp_path / "mine.acusx"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", staticmethod(lambda *_: (str(path), "")))
    monkeypatch.setattr(
        QMessageBox, "question", staticmethod(lambda *_: QMessageBox.StandardButton.No)
    )
    form.export.click()
    assert settle(path.is_file)
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "other"))
    asked, errors = [], []
    monkeypatch.setattr(
        QFileDialog, "getExistingDirectory", staticmethod(lambda *_: asked.append(1) or "")
    )
    author.failed.connect(errors.append)
    opened.open_dropped(path)
    assert settle(lambda: bool(asked))
    assert errors == [
        "mine.acusx does not hold its CT: choose the folder of the CT that the exercise was made on"
    ]


@pytest.mark.long("journey")
def test_an_exercise_on_the_ct_that_is_open_is_imported_without_asking_for_it(
    window, patient, author, settle, tmp_path, monkeypatch
):
    folder = tmp_path / "open"
    Slices().write(folder)
    Slices(series="1.2.3.9", offsets=(0.0, 2.5, 5.0, 7.5)).write(folder, prefix="t")
    volume = load_ct(folder, SERIES)
    exercise = Exercise.model_validate(
        {
            "id": "mine", "title": "Mine", "description": "of the open CT",
            "ct": {"folder": folder, "series": SERIES, "digest": volume.digest},
            "plan": {"entry_mm": [1.0, -2.0, 3.0], "target_mm": [1.0, 20.0, 3.0]},
        }
    )  # fmt: skip
    pack(tmp_path / "mine.acusx", exercise, volume)
    author._conductor.patient = replace(patient, volume=volume, folder=folder)
    monkeypatch.setattr(
        QFileDialog, "getExistingDirectory", staticmethod(lambda *_: pytest.fail("asked"))
    )
    errors = []
    author.failed.connect(errors.append)
    author.import_from(tmp_path / "mine.acusx")
    assert settle(lambda: bool(errors) or (paths.data() / "exercises" / "mine.yaml").is_file())
    assert not errors


@pytest.mark.long("journey")
def test_another_ct_in_the_exercises_folder_is_said(opened, form, author, settle):
    write(form.task.name, "Mine")
    form.keep.click()
    errors, conductor = [], opened.conductor
    conductor.failed.connect(errors.append)
    other = replace(conductor.patient.volume, hu=conductor.patient.volume.hu + np.int16(1))
    opened.context.services.exercises()
    conductor.set_exercise(load_exercise("mine"))
    conductor.set_patient(replace(conductor.patient, volume=other))
    assert "not the one the exercise was made on" in str(errors[0])


def edit_cell(box, row, place, text):
    box.table.item(row, place).setText(text)


@pytest.mark.long("journey")
def test_the_ct_fills_the_layers_along_the_path_and_undo_takes_it_back(author, form):
    write(form.task.name, "Layered")
    form.show_page(4)
    form.effects.layers.from_ct.click()
    layers = author.editor.exercise.layers
    assert layers[0].name == "skin"
    assert layers[0].puncture_force == 1.5
    assert len(layers) >= 2
    assert "layers along the path: skin" in said(form)
    assert form.effects.layers.table.rowCount() == len(layers)
    form.undo.click()
    assert author.editor.exercise.layers == ()
    box = form.effects.fields["layers_from",]
    box.setCurrentIndex(1)
    box.activated.emit(1)
    assert author.editor.exercise.layers_from == "ct"


@pytest.mark.long("journey")
def test_layers_of_tissue_are_a_table_each_change_of_which_undo_takes_back(author, form):
    write(form.task.name, "Layered")
    form.show_page(4)
    box = form.effects.layers
    assert (box.none.isHidden(), box.table.isHidden()) == (False, True)
    box.more.click()
    edit_cell(box, 0, 0, "fat")
    edit_cell(box, 0, 1, "12,5")
    box.more.click()
    edit_cell(box, 1, 0, "liver")
    edit_cell(box, 1, 3, "8")
    layers = author.editor.exercise.layers
    assert [(one.name, one.thickness_mm, one.friction) for one in layers] == [
        ("fat", 12.5, 10.57), ("liver", 20.0, 8.0),
    ]  # fmt: skip
    assert box.table.item(0, 3).text() == "10.57"  # what holds where nothing is given
    box.up.click()
    assert [one.name for one in author.editor.exercise.layers] == ["liver", "fat"]
    assert box.table.currentRow() == 0
    assert (box.up.isEnabled(), box.down.isEnabled()) == (False, True)
    edit_cell(box, 0, 1, "thick")
    assert author.editor.exercise is None
    assert "thickness_mm" in author.editor.problems[0].name
    for _ in range(3):
        form.undo.click()
    assert [one.name for one in author.editor.exercise.layers] == ["fat", "liver"]
    assert box.table.item(1, 3).text() == "10.57"
    form.redo.click()
    assert box.table.item(1, 3).text() == "8"
    for _ in range(2):
        box.table.setCurrentCell(0, 0)
        box.less.click()
    assert author.editor.exercise.layers == ()
    assert box.table.isHidden()


ROWS = [
    {"skill": "novice", "scores": [40.0, None, 50.0], "share_passed": 0.0},
    {"skill": "expert", "scores": [98.0, 99.0, 100.0], "share_passed": 1.0},
]


@pytest.mark.long("journey")
def test_what_skills_would_score_is_tried_while_the_page_is_looked_at_and_left_on_a_change(
    author, form, settle, monkeypatch
):
    begun, left = [], []
    monkeypatch.setattr(author.trial, "begin", begun.append)
    monkeypatch.setattr(author.trial, "cancel", lambda: left.append(len(begun)))
    author._trial_timer.setInterval(10)
    write(form.task.name, "Tried")
    settle(lambda: False, 0.1)
    assert begun == []  # nobody looks at the page
    form.show_page(5)
    assert settle(lambda: len(begun) == 1)
    assert "trying" in form.score.tried.text()
    author.trial.found.emit(ROWS, 1)
    assert form.score.skills.scores == {"novice": [40.0, 50.0], "expert": [98.0, 99.0, 100.0]}
    assert "novice 40, 50" in form.score.skills.accessibleDescription()
    assert not form.score.skills.grab().isNull()
    assert "1 attempt of each skill" in form.score.tried.text()
    before = len(left)
    author.editor.put("title", value="Other words")
    settle(lambda: False, 0.1)
    assert (len(begun), len(left)) == (1, before)  # words change no score
    author.editor.put("assistance", value=0.3)
    assert len(left) == before + 1
    assert settle(lambda: len(begun) == 2)
    assert begun[1].assistance == 0.3
    author.trial.failed.emit("no path")
    assert "no path" in form.score.tried.text()


@pytest.mark.long("journey")
def test_a_trial_that_is_left_ends_its_process_and_says_nothing(author, form, settle):
    write(form.task.name, "Left")
    said = []
    author.trial.found.connect(lambda *found: said.append(found))
    author.trial.failed.connect(said.append)
    author.trial.begin(author.editor.exercise)
    process = author.trial._process
    assert author.trial.running
    assert process.waitForStarted(5000)
    author.trial.cancel()
    assert not author.trial.running
    process.waitForFinished(5000)
    settle(lambda: False, 0.1)
    assert said == []


@pytest.mark.long("journey")
def test_a_plan_that_an_exercise_holds_is_not_asked_for_any_more(opened, form, author):
    plan = author.context.editors.plan
    assert plan.dirty
    write(form.task.name, "X")
    form.keep.click()
    assert not plan.dirty
    plan.place(Tool.TARGET, (6.0, 4.0, 140.0), True)
    assert plan.dirty


@pytest.mark.long("journey")
def test_the_author_chooses_how_unsteady_the_simulated_hand_is(author, form):
    write(form.task.name, "X")
    form.show_page(3)
    box = form.sight.fields["unsteady_hand",]
    assert box.currentText() == "As the exercise's level has it"
    for title, unsteady in (("Steady", 0), ("Unsteady as at level 3", 3)):
        box.setCurrentIndex(box.findText(title))
        box.activated.emit(box.currentIndex())
        assert author.editor.exercise.unsteady_hand == unsteady
        assert author.editor.exercise.hand_level == unsteady
    box.setCurrentIndex(0)
    box.activated.emit(0)
    exercise = author.editor.exercise
    assert exercise.unsteady_hand is None
    assert exercise.hand_level == exercise.level


def choose(box, value):
    """Choose what a box holds under a value, as a hand does."""
    box.setCurrentIndex(box.findData(value))
    box.activated.emit(box.currentIndex())


@pytest.mark.long("journey")
def test_an_assessment_is_shown_with_the_locks_and_views_that_it_has(author, form):
    write(form.task.name, "X")
    author.editor.put("views", value=["bullseye", "three_d", "live_overlay"])
    form.show_page(3)
    sight = form.sight
    free = [box.isEnabled() for box in (*sight.views.values(), *sight.locks.values())]
    assert all(free)
    assert sight.views["bullseye"].isChecked()
    choose(form.task.purpose, "assessment")
    exercise = author.editor.exercise
    ticked = {value for value, box in sight.views.items() if box.isChecked()}
    assert ticked == {view.value for view in exercise.shown_views} == {"three_d"}
    assert {value for value, box in sight.locks.items() if box.isChecked()} == {
        lock.value for lock in exercise.locked
    }
    assert not any(box.isEnabled() for box in sight.locks.values())
    assert "control scans alone" in sight.views["bullseye"].toolTip()
    sight.views["three_d"].click()  # what is not shown here is kept for practice
    assert "bullseye" in author.editor.get("views")
    choose(form.task.purpose, "practice")
    assert sight.views["bullseye"].isChecked()
    assert sight.views["bullseye"].isEnabled()
    assert not any(box.isChecked() for box in sight.locks.values())


@pytest.mark.long("journey")
def test_bone_before_the_target_is_said_with_its_depth_and_layers_end_there(author, form):
    write(form.task.name, "X")
    path = author.editor.exercise.plan.plan()
    skin = {"name": "skin", "thickness_mm": 2.0}
    bone = {"name": "bone", "thickness_mm": 3.0, "rigid": True}
    author.editor.put("layers", value=[skin, bone])
    form.show_page(6)
    said = form.review.verdict.text()
    assert said.startswith("▲ The exercise can be used, but: Bone is in the way at 2 mm")
    assert f"before the target at {path.length_mm:.0f} mm" in said
    deep = skin | {"thickness_mm": path.length_mm + 1.0}
    author.editor.put("layers", value=[deep, bone])
    assert form.review.verdict.text() == "✔ The exercise can be used."


@pytest.mark.long("journey")
def test_layers_from_a_ct_with_bone_on_the_path_come_with_a_warning(author, form):
    write(form.task.name, "X")
    form.effects.layers.from_ct.click()
    layers = author.editor.get("layers")
    length = author.editor.exercise.plan.plan().length_mm
    before = sum(layer["thickness_mm"] for layer in layers[:-1])
    assert layers[-1]["rigid"]
    assert before < length
    assert f"▲ {len(layers)} layers along the path" in said(form)
    assert f"Bone is in the way at {before:.0f} mm" in said(form)


@pytest.mark.long("journey")
def test_the_keys_of_undo_are_the_forms_wherever_the_cursor_is(author, form):
    write(form.task.name, "Title")
    form.task.briefing.setFocus()
    QTest.keyClicks(form.task.briefing, "Typed")
    assert author.editor.get("description") == "Typed"
    control, shift = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
    for field in (form.task.briefing, form.task.name):
        for key, modifiers in (
            (Qt.Key.Key_Z, control),
            (Qt.Key.Key_Y, control),
            (Qt.Key.Key_Z, control | shift),
        ):
            press = QKeyEvent(QEvent.Type.ShortcutOverride, key, modifiers)
            QApplication.sendEvent(field, press)
            assert not press.isAccepted()  # else the field would undo letters of its own
        press = QKeyEvent(QEvent.Type.ShortcutOverride, Qt.Key.Key_C, control)
        QApplication.sendEvent(field, press)
        assert press.isAccepted()
    undo = next(one for one in form.findChildren(QShortcut) if one.key() == QKeySequence("Ctrl+Z"))
    undo.activated.emit()
    assert form.task.briefing.toPlainText() == ""


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    ("where", "value", "words"),
    [
        (("title",), "x" * 121, "Title: is too long: at most 120 characters"),
        (
            ("effects", "lateral_tissue", "parameters", "stiffness"),
            "soft",
            "'soft' is no number: type one, such as 2.5",
        ),
        (
            ("layers",),
            [{"name": "x", "thickness_mm": "a"}],
            "row 1, thickness mm: 'a' is no number",
        ),
        (("tolerances", "angle_error", "good"), "z", "Angle error, good: 'z' is no number"),
        (("level",), 11, "Level (1 easiest): 11 is too large: at most 9"),
    ],
)
def test_what_is_wrong_is_said_of_the_field_as_the_form_calls_it(author, form, where, value, words):
    write(form.task.name, "X")
    author.editor.put(*where, value=value)
    form.show_page(6)
    assert words in form.review.verdict.text()
    assert "Input should" not in form.review.verdict.text()
    assert "String should" not in form.keep.toolTip()
