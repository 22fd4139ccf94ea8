"""Signing in, what students do not reach, and the page of students, courses and progress."""

import json
import os
from datetime import UTC, datetime, timedelta
from types import MappingProxyType

import pytest
from PySide6.QtCore import QDate, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox, QFileDialog, QLineEdit, QPlainTextEdit

from app.exercises.guidance import Purpose
from app.exercises.library import load_exercise
from app.scoring.competence import CompetenceRule
from app.scoring.conditions import Conditions
from app.session.course import Course, CourseError, courses, find_course
from app.session.header import SessionHeader
from app.session.people import People
from app.session.recorder import Recorder
from app.session.recording import read_recording
from app.session.results_file import write_results as gathering_results
from app.session.roster import RosterLine
from app.session.sidecar import file_digest, write_summary
from app.session.signature import signature_file, signed
from app.session.station import StationKey
from app.session.stations import set_name
from app.session.summary import Summary
from app.views.author.feature import AuthorFeature
from app.views.debrief.feature import DebriefFeature
from app.views.debrief.sessions import NOTE, SCORE, SIGNED, STUDENT
from app.views.exercise.feature import ExerciseFeature
from app.views.kit.access import ACCESS, Known
from app.views.people.board import GROUP_PDF, STUDENT_PDF, since_words
from app.views.people.course_form import CourseDialog
from app.views.people.dialogs import EntryDialog
from app.views.people.feature import PeopleFeature


@pytest.fixture
def feature(window):
    yield window.feature(PeopleFeature)
    window.feature(PeopleFeature).close()


def record(folder, name, student, total=80.0, version=1, sign=True):
    folder.mkdir(parents=True, exist_ok=True)
    key = StationKey.of() if sign else None
    path = folder / f"{name}.mcap"
    path.write_bytes(b"not opened: the sidecar is enough")
    score = {"total": total, "passed": True, "void_reason": "", "rows": []}
    now = datetime.now(UTC).isoformat()
    summary = Summary(name, now, student, "first-insertion", state="ended",
                      score=MappingProxyType(score),
                      conditions=Conditions("first-insertion", version))  # fmt: skip
    write_summary(path, summary)
    if key is not None:
        signature_file(path).write_text(signed(path, file_digest(path), summary, {}, key))


def fill(dialog, *texts):
    for line, text in zip(dialog.lines, texts, strict=True):
        line.setText(text)
    dialog.save()


def shown(window, settle):
    sessions = window.feature(DebriefFeature).sessions
    sessions.refresh()
    settle(lambda: sessions.model.rowCount() > 0)
    return sessions


def students(sessions):
    model = sessions.model
    return [model.index(row, STUDENT).data() for row in range(model.rowCount())]


@pytest.mark.long("journey")
def test_without_a_password_everything_is_open_as_before(window, feature):
    assert ACCESS.may_manage
    assert not window.feature(DebriefFeature).sessions.delete_button.isHidden()
    feature.show()
    assert feature.page.tabs.isTabVisible(1)


@pytest.mark.long("journey")
@pytest.mark.parametrize("leave", ["back", "sign out"])
def test_who_leaves_the_page_without_a_patient_comes_to_the_start_page(
    window, feature, settle, leave
):
    ACCESS.learn(Known(guarded=True))
    ACCESS.sign_in(None, instructor=True)
    feature.show()
    assert feature.page.isVisible()
    if leave == "back":
        feature.page.closed.emit()
    else:
        ACCESS.sign_in(None)
    assert window.pages.currentWidget() is window.start_page


@pytest.mark.long("journey")
def test_a_student_signs_in_and_the_record_will_name_a_key(window, feature, settle):
    person, pin = People().add(RosterLine("Ada"))
    panel = feature.context.conductor.views.panel
    panel.set_student("typed")
    feature.sign_in_student()
    dialog = feature.dialog
    fill(dialog, "Ada", "000000")
    assert dialog.isVisible()
    assert "pseudonym or PIN is wrong" in dialog.note.text()
    assert dialog.focusWidget() is dialog.lines[1]
    assert dialog.lines[1].selectedText()  # typed over at once
    assert [line.text() for line in dialog.lines] == ["Ada", "000000"]
    fill(dialog, "ada", pin)
    assert ACCESS.student == person
    assert (panel.student.text(), panel.student.isEnabled()) == ("Ada", False)
    begun = []
    panel.start_requested.connect(begun.append)
    panel.buttons.start_requested.emit()
    assert begun == [person.key]
    ACCESS.sign_in(None)
    assert (panel.student.text(), panel.student.isEnabled()) == ("typed", True)


@pytest.mark.long("journey")
def test_the_first_password_shows_a_recovery_key_and_closes_what_students_must_not_reach(
    window, feature, settle
):
    folder = feature.context.services.sessions()
    person, _ = People().add(RosterLine("Ada"))
    for name, student in (("a", person.key), ("b", "typed")):
        record(folder, name, student)
    feature.sign_in_instructor()
    fill(feature.dialog, "correct horse", "another horse")
    assert "not the same" in feature.dialog.note.text()
    fill(feature.dialog, "correct horse", "correct horse")
    key = feature.dialog.findChild(QPlainTextEdit).toPlainText()
    assert len(key) == 39
    shown_once = feature.dialog
    QTest.keyClick(shown_once, Qt.Key.Key_Escape)
    shown_once.close()
    assert feature.dialog is shown_once
    assert shown_once.isVisible()
    assert "this once only" in shown_once.asked.text()
    shown_once.written.setChecked(True)
    QTest.keyClick(shown_once, Qt.Key.Key_Escape)
    assert feature.dialog is None
    assert "signed in as the instructor" in window.windowTitle()
    assert "instructor" in feature.context.conductor.views.panel.student.placeholderText()
    settle(lambda: ACCESS.guarded)
    sessions = shown(window, settle)
    settle(lambda: sessions.model.rowCount() == 2)
    assert not sessions.delete_button.isHidden()
    ACCESS.sign_in(None)
    assert not ACCESS.may_manage
    assert sessions.delete_button.isHidden()
    assert sessions.export.isHidden()
    assert not any(one.isEnabled() for one in window.feature(AuthorFeature)._actions)
    assert students(sessions) == ["typed"]
    assert sessions.model.rowCount() == 1
    sessions.table.selectAll()
    sessions.delete_selected()
    assert (folder / "b.mcap").exists()
    feature.show()
    assert not feature.page.isVisible()
    ACCESS.sign_in(person)
    assert students(sessions) == ["Ada"]
    feature.show()
    assert feature.page.isVisible()
    assert [feature.page.tabs.isTabVisible(k) for k in range(3)] == [True, False, True]
    assert feature.page.courses.new.isHidden()
    feature.sign_in_instructor()
    fill(feature.dialog, "wrong")
    assert "password is wrong" in feature.dialog.note.text()
    fill(feature.dialog, "correct horse")
    assert ACCESS.may_manage


@pytest.mark.long("journey")
def test_the_list_says_what_the_signature_says(window, feature, settle):
    record(feature.context.services.sessions(), "a", "typed", sign=False)
    sessions = shown(window, settle)
    assert sessions.model.index(0, SIGNED).data() == "• unsigned"


@pytest.mark.long("journey")
def test_students_come_by_hand_and_by_roster(window, feature, settle, tmp_path):
    feature.show()
    feature.page.students.add.click()
    assert isinstance(feature.dialog, EntryDialog)
    fill(feature.dialog, "../x", "", "", "")
    assert "cannot be a pseudonym" in feature.dialog.note.text()
    fill(feature.dialog, "Ada", "Lovelace", "1843", "A, B")
    settle(lambda: feature.page.students.table.rowCount() == 1)
    assert feature.page.students.table.item(0, 2).text() == "Lovelace"
    (tmp_path / "r.csv").write_text("pseudonym,group\nBob,A\nBob,A\n")
    feature.take_roster(tmp_path / "r.csv")
    settle(lambda: feature.dialog is not None and feature.dialog.windowTitle() == "Roster")
    assert "line 3" in feature.dialog.findChild(QPlainTextEdit).toPlainText()
    feature.dialog.close()
    (tmp_path / "r.csv").write_text("pseudonym,group\nBob,A\nCy,B\n")
    feature.take_roster(tmp_path / "r.csv")
    settle(lambda: feature.page.students.table.rowCount() == 3)
    settle(lambda: feature.dialog is not None and feature.dialog.windowTitle() == "PINs")
    pins = feature.dialog.findChild(QPlainTextEdit).toPlainText().split()
    assert People().sign_in("Bob", pins[1]).groups == ("A",)


@pytest.mark.long("journey")
def test_a_course_is_made_in_a_form_that_says_what_is_wrong(window, feature, settle):
    feature.show()
    feature.page.courses.new.click()
    dialog = feature.dialog
    assert isinstance(dialog, CourseDialog)
    assert dialog.focusWidget() is dialog.id
    dialog.title.setText("Autumn")
    dialog.id.setText("Autumn 2026!")
    dialog.save()
    assert "✖ File name: 'Autumn 2026!' cannot be used: small letters" in dialog.note.text()
    dialog.id.setText("autumn")
    dialog.title.setText("x" * 121)
    dialog.save()
    assert "✖ Title: is too long: at most 120 characters" in dialog.note.text()
    assert dialog.focusWidget() is dialog.title
    dialog.title.setText("Autumn")
    dialog.groups.setText("A, B")
    dialog.save()
    assert "Groups: no student is in A; there are none yet" in dialog.note.text()
    dialog._known = ("B", "C")
    dialog.save()
    assert "Groups: no student is in A; there are: B and C" in dialog.note.text()
    assert dialog.focusWidget() is dialog.groups
    dialog._known = ("A", "B")
    dialog.add.click()
    day = dialog.items.cellWidget(0, 4)
    assert isinstance(day, QLineEdit)
    day.setText("soon")
    dialog.save()
    title = dialog.items.item(0, 0).text()
    assert f"✖ {title}, Opens: 'soon' is no day: write year-month-day" in dialog.note.text()
    assert dialog.focusWidget() is day
    day.setText("2099-02-01")
    dialog.items.cellWidget(0, 5).setText("2099-01-01")
    dialog.save()
    assert f"✖ {title}: closes on 2099-01-01, before it opens" in dialog.note.text()
    assert "Value error" not in dialog.note.text()
    dialog.items.cellWidget(0, 5).setText("")
    day.setText("2099-01-01")
    dialog.save()
    course = courses()[0][0]
    assert (course.title, course.groups, len(course.items)) == ("Autumn", ("A", "B"), 1)
    tree = feature.page.courses.tree
    settle(lambda: tree.topLevelItemCount() == 1)
    tree.setCurrentItem(tree.topLevelItem(0))
    feature.page.courses.edit.click()
    assert feature.dialog.course() == course


@pytest.mark.long("journey")
def test_a_student_may_not_begin_before_an_exercise_opens(window, feature, settle):
    _, pin = People().add(RosterLine("Ada"))
    known = next(iter(feature._exercises()))
    text = {"id": "c", "title": "C", "items": [{"exercise": known, "opens": "2099-01-01"}]}
    Course.model_validate(text).save()
    feature.sign_in_student()
    fill(feature.dialog, "Ada", pin)
    settle(lambda: bool(ACCESS.refusal(known)))
    assert ACCESS.refusal(known) == "it opens on 2099-01-01"
    ACCESS.sign_in(None)
    assert ACCESS.refusal(known) == ""


@pytest.mark.long("journey")
def test_the_board_shows_the_curve_and_is_exported(window, feature, settle, tmp_path):
    person, _ = People().add(RosterLine("Ada"))
    record(feature.context.services.sessions(), "a", person.key, 72.0)
    feature.show()
    board = feature.page.board
    settle(lambda: board.board is not None and bool(board.board.items))
    assert board.table.item(0, 0).text() == "Ada"
    board.table.cellDoubleClicked.emit(0, 1)
    assert "Ada" in feature.dialog.windowTitle()
    feature.dialog.close()
    feature.export("json", tmp_path / "r.json")
    settle(lambda: (tmp_path / "r.json").exists())
    document = json.loads((tmp_path / "r.json").read_text())
    assert document["students"][0]["pseudonym"] == "Ada"


@pytest.mark.long("journey")
def test_the_board_and_the_curve_say_who_is_competent(window, feature, settle):
    """Twelve passes: the tenth makes him competent, by ten times log(0.9/0.6) against 3.89."""
    person, _ = People().add(RosterLine("Ada"))
    for n in range(12):
        record(feature.context.services.sessions(), f"a{n}", person.key, 90.0)
    feature.show()
    board = feature.page.board
    settle(lambda: board.board is not None and bool(board.board.items))
    assert "★ competent" in board.table.item(0, 1).text()
    assert "competent after 10 attempts (false alarm ≤ 5 %)" in board.table.item(0, 1).toolTip()
    assert "LC-CUSUM" in board.hint.toolTip()
    board.table.cellDoubleClicked.emit(0, 1)
    assert feature.dialog.competence.text() == "competent after 10 attempts (false alarm ≤ 5 %)"
    feature.dialog.plot.grab()
    feature.dialog.close()


@pytest.mark.long("journey")
def test_a_course_that_is_edited_keeps_the_rates_of_its_file(feature):
    rule = CompetenceRule(acceptable=0.05, unacceptable=0.5)
    feature.edit_course(Course(id="c", title="C", competence=rule))
    dialog = feature.dialog
    assert dialog.course().competence == rule
    dialog.rates.unacceptable.setValue(30.0)
    dialog.rates.unacceptable.editingFinished.emit()
    assert dialog.course().competence == CompetenceRule(acceptable=0.05, unacceptable=0.3)
    assert dialog.rates.note.text().startswith("told apart in ")
    dialog.close()


@pytest.mark.long("journey")
def test_a_course_whose_rates_make_no_test_is_refused_in_the_form(feature):
    feature.edit_course(Course(id="c", title="C"))
    dialog = feature.dialog
    dialog.rates.unacceptable.setValue(5.0)
    dialog.rates.unacceptable.editingFinished.emit()
    assert dialog.rates.note.text() == "no number of attempts tells these apart"
    with pytest.raises(CourseError, match=r"Competence: .*it must be more"):
        dialog.course()
    dialog.close()


@pytest.mark.long("journey")
def test_who_was_erased_is_shown_as_erased(window, feature, settle):
    person, _ = People().add(RosterLine("Ada"))
    People().add(RosterLine("Bob"))
    feature.look()
    settle(lambda: ACCESS.shown(person.key) == "Ada")
    record(feature.context.services.sessions(), "a", person.key)
    said = []
    feature.noted.connect(said.append)
    feature._erase("Ada", with_records=False)
    settle(lambda: ACCESS.shown(person.key) != "Ada")
    assert settle(lambda: bool(said))
    assert said == ["Ada was erased; records deleted: 0, kept as nobody's: 1"]
    assert ACCESS.shown(person.key) == "(erased)"


@pytest.mark.long("journey")
def test_an_exercise_is_put_into_a_course_with_its_own_purpose(feature):
    feature.edit_course(None)
    dialog = feature.dialog
    for row, (name, purpose) in enumerate(
        (("scans-only", "assessment"), ("first-insertion", "practice"))
    ):
        assert load_exercise(name).purpose.value == purpose
        dialog.add_item(name)
        assert dialog.items.cellWidget(row, 3).currentData() == purpose


@pytest.mark.long("journey")
def test_an_exercise_that_was_just_made_can_be_put_into_a_course(feature, monkeypatch):
    made = load_exercise("first-insertion").model_copy(update={"id": "made", "title": "Just made"})
    there = feature.context.services.exercises()
    monkeypatch.setattr(feature.context.services, "exercises", lambda: (*there, made))
    feature.edit_course(None)
    offered = [
        box.itemText(row)
        for box in feature.dialog.findChildren(QComboBox)
        for row in range(box.count())
    ]
    assert "Just made" in offered
    feature.dialog.close()


def choose_rows(sessions, *names):
    sessions.table.clearSelection()
    sessions._choose(set(names))


def cell(sessions, name, column):
    model = sessions.model
    rows = {model._summaries[row].id: row for row in range(model.rowCount())}
    return model.index(rows[name], column).data()


@pytest.mark.long("journey")
def test_the_instructor_goes_from_the_board_to_the_attempts_says_things_and_the_student_reads_them(
    window, feature, settle
):
    folder = feature.context.services.sessions()
    ada, _ = People().add(RosterLine("Ada"))
    bob, _ = People().add(RosterLine("Bob"))
    for name, student in (("a", ada.key), ("b", ada.key), ("c", bob.key)):
        record(folder, name, student)
    People().set_instructor("correct horse")
    ACCESS.sign_in(None, instructor=True)
    feature.look()
    feature.show()
    board = feature.page.board
    assert settle(lambda: board.board is not None and len(board.board.students) == 2)
    board.table.setCurrentCell(0, 1)
    board.buttons[1].click()
    sessions = window.feature(DebriefFeature).sessions
    assert window.pages.currentWidget() is sessions
    assert settle(lambda: sorted(one.id for one in sessions.model._summaries) == ["a", "b"])
    assert sessions.everything.text().startswith("Ada: First insertion")
    says = sessions.remarks
    choose_rows(sessions, "a", "b")
    says.comment.trigger()
    says.dialog.text.setPlainText("  Look at the\nangle first ")
    says.dialog.save()
    assert settle(lambda: "angle first" in cell(sessions, "b", NOTE))
    choose_rows(sessions, "a")
    says.void.trigger()
    dialog = says.dialog
    assert not dialog.save()
    assert "Say why" in dialog.note.text()
    dialog.text.setPlainText("the cable was loose")
    dialog.save()
    assert settle(lambda: cell(sessions, "a", SCORE) == "void")
    assert "the cable was loose" in cell(sessions, "a", NOTE)
    assert not says.void.isEnabled()
    sessions.back.click()
    assert window.pages.currentWidget() is feature.page
    assert settle(lambda: board.board.cells[ada.key, "first-insertion"].attempts == 1)
    assert "1 void" in board.table.item(0, 1).text()
    assert "the cable was loose" in board.table.item(0, 1).toolTip()
    ACCESS.sign_in(ada)
    feature.look()
    window.feature(DebriefFeature).show_sessions()
    assert settle(lambda: sorted(one.id for one in sessions.model._summaries) == ["a", "b"])
    assert cell(sessions, "a", SCORE) == "void"
    assert says.button.isHidden()
    choose_rows(sessions, "a")
    assert not any(action.isEnabled() for action in says.all)
    says.ask_void()
    assert says.dialog is None
    sessions.show_only(lambda _: True, "all")
    window.feature(DebriefFeature)._back = feature.show
    ACCESS.sign_in(None)
    sessions.back.click()  # the board is closed to who is here now
    assert not sessions.isVisible()
    window.feature(DebriefFeature).show_sessions()
    ACCESS.sign_in(None, instructor=True)
    assert settle(lambda: sessions.model.rowCount() == 3)
    choose_rows(sessions, "a", "b")
    says.count.trigger()
    assert settle(lambda: cell(sessions, "a", SCORE) == "✔ 80")
    assert People().remarks()["a"].comment == "Look at the\nangle first"


@pytest.mark.long("journey")
def test_what_is_deleted_is_listed_apart_and_brought_back_after_the_window_was_closed(
    window, feature, settle
):
    folder = feature.context.services.sessions()
    for name in ("a", "b"):
        record(folder, name, "typed")
    sessions = shown(window, settle)
    assert settle(lambda: sessions.model.rowCount() == 2)
    choose_rows(sessions, "a")
    sessions.delete_button.click()
    assert settle(lambda: sessions.model.rowCount() == 1)
    sessions._deleted = []  # as in another window
    sessions.trash.click()
    assert settle(lambda: [one.id for one in sessions.model._summaries] == ["a"])
    assert cell(sessions, "a", NOTE) == "29 days left"
    tip = sessions.model.index(0, NOTE).data(Qt.ItemDataRole.ToolTipRole)
    assert "can be brought back for 29 days" in tip
    assert sessions.delete_button.isHidden()
    choose_rows(sessions, "a")
    assert not sessions.open_button.isEnabled()
    sessions.bring_back.click()
    assert settle(lambda: sessions.model.rowCount() == 0)
    assert "Nothing that was deleted" in sessions._count.text()
    sessions.trash.click()
    assert settle(lambda: sessions.model.rowCount() == 2)


@pytest.mark.long("journey")
def test_a_student_begins_the_next_exercise_of_a_course_and_reads_why_another_is_refused(
    window, feature, settle
):
    ada, _ = People().add(RosterLine("Ada"))
    People().set_instructor("correct horse")
    names = ("first-insertion", "thick-tissue", "breathing-liver")
    version = feature._exercises()[names[0]].version
    record(feature.context.services.sessions(), "a", ada.key, 91.0, version)
    items = [
        {"exercise": names[0], "attempts": 1},
        {"exercise": names[1], "closes": "2020-01-01"},
        {"exercise": names[2], "attempts": 2, "purpose": "assessment"},
    ]
    for item in items:
        item["version"] = feature._exercises()[item["exercise"]].version
    Course.model_validate({"id": "c", "title": "Autumn", "items": items}).save()
    ACCESS.sign_in(ada)
    feature.look()
    feature.show()
    tab, wanted, said = feature.page.courses, [], []
    feature.page.tabs.setCurrentWidget(tab)
    assert settle(lambda: tab.tree.topLevelItemCount() == 1)
    rows = [tab.tree.topLevelItem(0).child(row) for row in range(3)]
    assert [row.text(0) for row in rows] == [feature._exercises()[name].title for name in names]
    assert rows[0].text(2) == "0 of 1 left"
    assert "passed" in rows[0].text(4)
    assert "best 91" in rows[0].text(4)
    assert "until 2020-01-01" in rows[1].text(3)
    assert "next" in rows[2].text(4)
    feature.context.conductor.exercise_wanted.connect(wanted.append)
    feature.failed.connect(said.append)
    tab.begin.click()
    assert wanted == [names[2]]
    for row, why in ((0, "the one attempt is used"), (1, "it closed on 2020-01-01")):
        tab.tree.setCurrentItem(rows[row])
        tab.begin.click()
        assert why in said[-1]
    assert wanted == [names[2]]
    People().remark("a", void="the cable was loose")  # gives the attempt back
    feature.refresh()
    assert settle(lambda: tab.tree.topLevelItem(0).child(0).text(2) == "1 of 1 left")


@pytest.mark.long("journey")
def test_an_assessment_of_a_course_is_begun_by_its_students_and_the_instructor_alone(
    window, feature, settle
):
    people, name = People(), "first-insertion"
    people.set_instructor("correct horse")
    ada, _ = people.add(RosterLine("Ada", groups=("A",)))
    bob, _ = people.add(RosterLine("Bob", groups=("B",)))
    exercise = feature._exercises()[name]
    item = {"exercise": name, "attempts": 1, "purpose": "assessment", "version": exercise.version}
    Course.model_validate({"id": "c", "title": "Autumn", "groups": ["A"], "items": [item]}).save()
    feature.look()
    assert settle(lambda: ACCESS.guarded and bool(ACCESS.refusal(name)))
    beginning = window.feature(ExerciseFeature).beginning
    page = beginning.page
    beginning.brief(name)  # nobody is signed in
    assert not page.begin.isEnabled()
    assert "Any number" not in page.attempts.text()
    assert "an assessment of the course Autumn" in page.attempts.text()
    assert "Sign in as a student who takes it" in page.attempts.text()
    assert (
        "Autumn" in feature.context.conductor.controller.refusal() or not window.conductor.exercise
    )
    ACCESS.sign_in(bob)
    feature.look()
    assert settle(lambda: "which you do not take" in ACCESS.refusal(name))
    beginning.brief(name)
    assert settle(lambda: "which you do not take" in page.attempts.text())
    assert not page.begin.isEnabled()
    ACCESS.sign_in(ada)
    feature.look()
    assert settle(lambda: not ACCESS.refusal(name))
    beginning.brief(name)
    assert settle(lambda: "The one attempt is left." in page.attempts.text())
    assert page.begin.isEnabled()
    record(feature.context.services.sessions(), "a", ada.key, 91.0, exercise.version)
    feature.look()
    assert settle(lambda: "the one attempt is used" in ACCESS.refusal(name))
    ACCESS.sign_in(None)
    assert "assessment" in ACCESS.refusal(name)
    ACCESS.sign_in(None, instructor=True)
    assert ACCESS.refusal(name) == ""


@pytest.mark.long("journey")
def test_the_instructor_releases_all_results_of_a_course_at_once(window, feature, settle):
    ada, _ = People().add(RosterLine("Ada"))
    item = {"exercise": "first-insertion", "purpose": "assessment"}
    Course.model_validate({"id": "c", "title": "Autumn", "items": [item]}).save()
    for name in ("a", "b"):
        record(feature.context.services.sessions(), name, ada.key)
    feature.show()
    tab = feature.page.courses
    assert settle(lambda: tab.tree.topLevelItemCount() == 1)
    assert "2 results wait" in tab.tree.topLevelItem(0).text(4)
    tab.release.click()
    box = feature.dialog
    assert "Release 2 results of Autumn?" in box.text()
    next(one for one in box.buttons() if one.text() == "Release").click()
    assert settle(lambda: not tab.release.isEnabled())
    assert all(People().remarks()[name].released for name in ("a", "b"))


@pytest.mark.long("journey")
def test_reports_of_the_group_and_of_the_student_chosen_are_written(
    window, feature, settle, tmp_path
):
    person, _ = People().add(RosterLine("Ada"))
    record(feature.context.services.sessions(), "a", person.key, 72.0)
    feature.show()
    board = feature.page.board
    settle(lambda: board.board is not None and bool(board.board.items))
    said = []
    feature.failed.connect(said.append)
    feature.choose_export(STUDENT_PDF)
    assert "Choose a student" in str(said[0])
    feature.export(GROUP_PDF, tmp_path / "group.pdf")
    board.table.setCurrentCell(0, 0)
    feature.export(STUDENT_PDF, tmp_path / "ada.pdf")
    assert settle(lambda: (tmp_path / "group.pdf").exists() and (tmp_path / "ada.pdf").exists())
    for name in ("group.pdf", "ada.pdf"):
        assert (tmp_path / name).read_bytes().startswith(b"%PDF")


@pytest.mark.long("journey")
def test_a_gradebook_is_asked_for_by_identifier_and_rule_and_says_what_chance_does(
    window, feature, settle, tmp_path, monkeypatch
):
    person, _ = People().add(RosterLine("Ada", accounts={"email": "ada@x.example"}))
    People().add(RosterLine("Bob"))
    folder = feature.context.services.sessions()
    for number in range(12):
        record(folder, f"a{number:02d}", person.key, 60.0 + 10.0 * (number % 2))
    feature.show()
    board = feature.page.board
    settle(lambda: board.board is not None and bool(board.board.items))
    feature.choose_export("moodle")
    form = feature.dialog
    rows = {where[0]: field for where, field in form.form.fields.items()}
    assert "place" not in rows
    assert "who tries more often is graded higher" in form.note.text()
    rows["rule"].setCurrentIndex(rows["rule"].findData("mean"))
    assert "does not rise with the number of attempts" in form.note.text()
    rows["identifier"].setCurrentIndex(rows["identifier"].findData("email"))
    assert not form.save()
    assert "no email is known of Bob" in form.note.text()
    rows["identifier"].setCurrentIndex(rows["identifier"].findData("username"))
    rows["feedback"].setChecked(True)
    path = tmp_path / "grades.csv"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(path), ""))
    assert form.save()
    assert settle(path.exists)
    heading, ada, bob = path.read_text(encoding="utf-8-sig").splitlines()
    title = load_exercise("first-insertion").title
    assert heading == f'username,"{title}, v1","{title}, v1 (Feedback)"'
    assert ada == "Ada,66.67,mean of the last 3 attempts; passed"
    assert bob == "Bob,,"


@pytest.mark.long("journey")
def test_the_place_of_a_report_is_asked_for_and_offers_the_station_s_name(
    window, feature, settle, tmp_path, monkeypatch
):
    set_name("Theatre 2")
    person, _ = People().add(RosterLine("Ada"))
    record(feature.context.services.sessions(), "a", person.key, 72.0)
    feature.show()
    board = feature.page.board
    settle(lambda: board.board is not None and bool(board.board.items))
    feature.choose_export(GROUP_PDF)
    form = feature.dialog
    assert form.form.fields[("place",)].text() == "Theatre 2"
    assert ("identifier",) not in form.form.fields
    path = tmp_path / "group.pdf"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(path), ""))
    assert form.save()
    assert settle(path.exists)


@pytest.mark.long("journey")
def test_results_of_a_station_are_written_and_brought_together_in_the_window(
    window, feature, settle, tmp_path, monkeypatch
):
    folder = feature.context.services.sessions()
    with monkeypatch.context() as other:  # another station, that wrote its results
        other.setenv("ACUS_DATA", str(tmp_path / "other"))
        set_name("Theatre 2")
        record(tmp_path / "records", "b", "Bob", 80.0)
        gathering_results(tmp_path / "b.acus", tmp_path / "records")
    feature.show()
    feature.stations.gather([tmp_path / "b.acus"])
    assert settle(lambda: feature.dialog is not None)
    asked = feature.dialog
    assert asked.text() == "Let these stations in?"
    assert "Theatre 2, which is not known here" in asked.informativeText()
    next(b for b in asked.buttons() if b.text() == "Let them in").click()
    assert settle(lambda: feature.dialog is not None and feature.dialog is not asked)
    text = feature.dialog.findChild(QPlainTextEdit).toPlainText()
    assert text == "Theatre 2: 1 attempt added, 0 here already"
    feature.dialog.close()
    assert (folder / "b.mcap").exists()
    said = []
    feature.noted.connect(said.append)
    record(folder, "a", "Ada", 72.0)
    feature.stations.write_results(tmp_path / "a.acus")
    assert settle(lambda: bool(said))
    assert said[0] == f"1 attempt saved in {tmp_path / 'a.acus'}"
    feature.stations.write_course(tmp_path / "c.acus")
    assert settle(lambda: len(said) > 1)
    assert (tmp_path / "c.acus").stat().st_mode & 0o777 == 0o600


@pytest.mark.long("journey")
def test_stations_are_the_instructors(window, feature, settle, tmp_path):
    People().set_instructor("correct horse battery")
    feature.look()
    settle(lambda: not ACCESS.may_manage)
    said = []
    feature.failed.connect(said.append)
    feature.stations.gather([tmp_path / "b.acus"])
    feature.stations.write_results(tmp_path / "a.acus")
    feature.stations.choose_files()
    assert len(said) == 3
    assert not (tmp_path / "a.acus").exists()


def left_of_an_attempt(services, student):
    """What a killed program left of an attempt."""
    now = datetime.now(UTC)
    header = SessionHeader("k1", now, 0.0, student, "first-insertion", "First insertion")
    recorder = Recorder(services.sessions(), header)
    recorder.open()
    recorder._file.abandon()
    path = recorder.status().path
    os.utime(path, (now.timestamp() - 900.0,) * 2)
    return path


@pytest.fixture
def killed(services):
    return left_of_an_attempt(services, "typed")


@pytest.fixture
def killed_of_ada(services):
    person, _ = People().add(RosterLine("Ada"))
    return left_of_an_attempt(services, person.key)


@pytest.mark.long("journey")
def test_an_interrupted_attempt_is_offered_at_the_start_and_kept_in_the_list_if_nobody_answers(
    killed, window, feature, settle
):
    debrief = window.feature(DebriefFeature)
    assert settle(lambda: debrief.interruptions.box is not None)
    box = debrief.interruptions.box
    assert "First insertion" in box.informativeText()
    buttons = {one.text(): one for one in box.buttons()}
    assert sorted(buttons) == ["Discard", "Later", "Recover"]
    buttons["Later"].click()
    assert settle(lambda: debrief.interruptions.box is None)
    assert killed.exists()
    sessions = shown(window, settle)
    assert "cut off" in cell(sessions, "k1", NOTE)
    choose_rows(sessions, "k1")
    assert not sessions.recover.isHidden()
    sessions.recover.click()
    assert settle(lambda: "interrupted after 0 s" in cell(sessions, "k1", NOTE))
    choose_rows(sessions, "k1")
    assert sessions.recover.isHidden()
    assert cell(sessions, "k1", SCORE) == ""


@pytest.mark.long("journey")
def test_a_student_may_recover_but_not_discard_and_reads_no_name(
    killed_of_ada, window, feature, settle
):
    debrief, people, killed = window.feature(DebriefFeature), People(), killed_of_ada
    people.set_instructor("correct horse")
    key = people.find("Ada").key
    feature.look()
    assert settle(lambda: ACCESS.guarded and ACCESS.owner(key))
    if debrief.interruptions.box is not None:
        debrief.interruptions.box.close()
        settle()
    debrief.interruptions._offered.clear()
    debrief.interruptions._looks = 0
    debrief.interruptions.look()
    assert settle(lambda: debrief.interruptions.box is not None)
    box = debrief.interruptions.box
    assert "a student" in box.informativeText()
    buttons = {one.text(): one for one in box.buttons()}
    assert buttons["Discard"].isHidden()
    debrief.sessions.discard_these(["k1"])
    assert killed.exists()
    buttons["Recover"].click()
    assert settle(lambda: read_recording(killed).complete)


@pytest.mark.long("journey")
def test_another_pin_is_drawn_only_after_a_question(window, feature, settle):
    """Seen: a click beside the button that was meant, and the PIN of a student was another one."""
    people = People()
    people.add(RosterLine("Ada", pin="271828"))
    feature.show()
    students = feature.page.students
    assert settle(lambda: bool(students.people))
    students.table.selectRow(0)
    feature.new_pin()
    asked = feature.dialog
    assert asked.text() == "Draw another PIN for Ada?"
    asked.defaultButton().click()  # Cancel
    assert people.sign_in("Ada", "271828").pseudonym == "Ada"
    feature.new_pin()
    next(b for b in feature.dialog.buttons() if b.text() == "Draw a PIN").click()
    assert settle(lambda: feature.dialog is not None and hasattr(feature.dialog, "layout"))
    text = feature.dialog.findChild(QPlainTextEdit).toPlainText()
    assert people.sign_in("Ada", text.split()[-1]).pseudonym == "Ada"
    feature.dialog.done(0)


@pytest.mark.parametrize(
    ("minutes", "words"),
    [
        (1.5, "just now"),
        (15.0, "15 min ago"),
        (59.9, "59 min ago"),
        (75.0, "1 h ago"),
        (1500.0, "1 d ago"),
    ],
)
def test_how_long_ago_an_attempt_was_is_told_in_the_unit_of_its_size(minutes, words):
    assert since_words(timedelta(minutes=minutes)) == words


def test_a_new_course_begins_with_a_plan_that_ships(window, feature, settle):
    feature.show()
    feature.page.courses.new.click()
    dialog = feature.dialog
    dialog.plan.setCurrentIndex(1)
    dialog.first.setDate(QDate(2026, 12, 7))
    dialog._fill()
    assert dialog.id.text() == "lung-biopsy-in-six-units-2026-12"
    assert dialog.items.rowCount() == 6
    assert dialog.items.cellWidget(5, 4).text() == "2027-01-11"
    course = dialog.course()
    assert course.ordered
    assert course.items[5].purpose is Purpose.ASSESSMENT
    assert course.items[5].attempts == 2
    dialog.id.setText("mine")
    dialog._fill()
    assert dialog.id.text() == "mine", "what was typed stays"
    assert dialog.items.rowCount() == 6, "in place of what was there"
    dialog.save()
    assert find_course("mine").items[3].exercise == "lung-biopsy"
