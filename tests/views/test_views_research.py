"""Research studies in the window: due visits, questionnaires answered by a person at the window."""

from datetime import UTC, datetime

import pytest
import yaml
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QRadioButton, QSlider

from app.core import paths
from app.research import begin
from app.research.questionnaires import find_questionnaire
from app.session.people import People
from app.session.roster import RosterLine
from app.views.kit.access import ACCESS
from app.views.research.feature import ResearchFeature
from app.views.research.questionnaire import QuestionnaireDialog
from app.views.research.studies_dialog import StudiesDialog, StudyLook


@pytest.fixture
def study(tmp_path):
    example = yaml.safe_load((paths.resources() / "research" / "design.yaml").read_text())
    changes = {
        "randomisation": {"method": "blocks", "block_sizes": [4]},
        "visits": [{"name": "pre", "day": 0}, {"name": "post", "day": 30}],
    }
    path = tmp_path / "design.yaml"
    path.write_text(yaml.safe_dump(example | changes))
    people = People()
    people.take_roster([RosterLine(name) for name in ("Ada", "Bob", "Cleo")])
    begun = begin(path, people, 5, lambda: datetime.now(UTC))
    for name in ("Ada", "Bob"):
        begun.enrol(people.find(name), {}, "XY", people)
    return begun


@pytest.fixture
def feature(study, window):
    ACCESS.sign_in(None, instructor=True)
    yield window.feature(ResearchFeature)
    ACCESS.sign_in(None)


def opened(feature, settle):
    feature.entry.trigger()
    assert settle(lambda: isinstance(feature.dialog, StudiesDialog))
    return feature.dialog


def texts(table):
    return [[table.item(r, c).text() for c in range(6)] for r in range(table.rowCount())]


@pytest.mark.long("journey")
def test_who_is_due_is_listed_and_only_who_takes_part_can_answer(feature, settle):
    dialog = opened(feature, settle)
    rows = texts(dialog.table)
    assert [row[1:3] for row in rows] == [["Ada", "pre"], ["Bob", "pre"]]
    assert all(row[5] == "0 of 1" for row in rows)
    assert dialog.table.item(0, 0).font().bold()  # open today
    assert [dialog.student.itemText(n) for n in range(dialog.student.count())] == ["Ada", "Bob"]
    offered = [dialog.questionnaire.itemText(n) for n in range(dialog.questionnaire.count())]
    assert offered == ["NASA Task Load Index", "Realism of the trainer", "System Usability Scale"]


@pytest.mark.long("journey")
def test_a_row_that_is_chosen_is_who_answers(feature, settle):
    dialog = opened(feature, settle)
    assert dialog.visit.currentText() == "pre"  # of the first that is open
    dialog.table.selectRow(1)
    assert (dialog.student.currentText(), dialog.visit.currentText()) == ("Bob", "pre")


def test_no_visit_is_chosen_by_chance_where_none_is_open(window):
    due = {"pseudonym": "Ada", "visit": "late", "opens": "2099-01-01", "closes": "2099-01-09"}
    due |= {"open": False, "late": False, "attempts": 0, "wanted": 1}
    status = {"study": "s", "enrolled": 1, "participants": 4, "left": 0, "due": [due]}
    dialog = StudiesDialog(
        [StudyLook(status, ("Ada",), ("pre", "late"))], {"sus": "Usability"}, window
    )
    asked = []
    dialog.wanted.connect(lambda a, b, c, d: asked.append((a, b, c, d)))
    assert dialog.visit.currentText() == ""
    assert not dialog.ask.isEnabled()
    assert dialog.table.item(0, 5).text() == "0 of 1, not open yet"
    dialog.visit.setCurrentText("pre")
    dialog.ask.click()
    assert asked == [("s", "Ada", "pre", "sus")]
    dialog.deleteLater()


@pytest.mark.long("journey")
def test_answers_by_the_keyboard_are_in_the_ledger_with_their_score(study, feature, settle):
    listed = opened(feature, settle)
    listed.table.selectRow(1)
    listed.questionnaire.setCurrentText("System Usability Scale")
    listed.ask.click()
    dialog = feature.dialog
    assert isinstance(dialog, QuestionnaireDialog)
    for row in dialog.rows:
        buttons = row.findChildren(QRadioButton)
        buttons[4 if row.item.reversed is False else 0].setFocus()
        QTest.keyClick(buttons[4 if row.item.reversed is False else 0], Qt.Key.Key_Space)
    assert dialog.save()
    (entry,) = [one for one in study.ledger.entries() if one["kind"] == "answered"]
    assert entry["visit"] == "pre"
    assert entry["values"]["sus"] == 100.0
    assert {p.code: p.arm for p in study.participants()}.keys() >= {entry["code"]}


@pytest.mark.long("journey")
def test_an_item_without_an_answer_is_named_and_nothing_is_kept(study, feature, settle):
    feature.answer("assistance-study", "Ada", "pre", "sus")
    dialog = feature.dialog
    for row in dialog.rows[:-2]:
        row.findChildren(QRadioButton)[2].click()
    assert not dialog.save()
    assert "9, 10" in dialog.note.text()
    assert not [one for one in study.ledger.entries() if one["kind"] == "answered"]


@pytest.mark.long("journey")
def test_a_slider_counts_only_once_it_was_touched(feature, settle):
    feature.answer("assistance-study", "Ada", "pre", "nasa-tlx")
    dialog = feature.dialog
    assert dialog.answers == {}
    slider = dialog.rows[0].findChild(QSlider)
    QTest.keyClick(slider, Qt.Key.Key_Right)
    assert dialog.answers == {"mental": 55.0}
    slider.sliderPressed.emit()
    assert dialog.answers == {"mental": 55.0}


@pytest.mark.long("journey")
def test_answers_are_not_lost_by_one_cancel(feature, settle):
    feature.answer("assistance-study", "Ada", "pre", "sus")
    dialog = feature.dialog
    dialog.rows[0].findChildren(QRadioButton)[1].click()
    dialog.reject()
    assert feature.dialog is dialog
    assert "not kept yet" in dialog.note.text()
    dialog.reject()
    assert feature.dialog is None


@pytest.mark.long("journey")
def test_the_same_questionnaire_twice_is_refused_before_anything_is_answered(
    study, feature, settle
):
    said = []
    feature.failed.connect(said.append)
    feature.answer("assistance-study", "Ada", "pre", "sus")
    for row in feature.dialog.rows:
        row.findChildren(QRadioButton)[2].click()
    assert feature.dialog.save()
    feature.answer("assistance-study", "Ada", "pre", "sus")
    assert feature.dialog is None
    assert "answered sus at pre already" in str(said[0])
    assert len([one for one in study.ledger.entries() if one["kind"] == "answered"]) == 1


@pytest.mark.long("journey")
def test_the_instructor_who_signs_in_hears_how_many_visits_are_due(study, window, settle):
    told = []
    window.feature(ResearchFeature).noted.connect(told.append)
    ACCESS.sign_in(None, instructor=True)
    assert settle(lambda: bool(told))
    assert told[0].startswith("2 visits of studies are due")
    assert "The last day for 2." in told[0]
    ACCESS.sign_in(None)


@pytest.mark.long("journey")
def test_every_shipped_questionnaire_fits_the_dialog(feature, window):
    for name in ("sus", "nasa-tlx", "realism"):
        feature.answer("assistance-study", "Ada", "pre", name)
        rows = feature.dialog.rows
        assert [row.item.name for row in rows] == [i.name for i in find_questionnaire(name).items]
        feature.dialog.reject()
