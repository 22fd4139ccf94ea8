"""Another language between two attempts: the window is built anew, patient and plan stay."""

import pytest
from PySide6.QtWidgets import QApplication, QMenu
from shiboken6 import isValid
from views_exercise_attempts import review
from window_rig import plan

from app.exercises.library import load_exercise
from app.session.people import People
from app.session.roster import RosterLine
from app.views.debrief.feature import DebriefFeature
from app.views.exercise.feature import ExerciseFeature
from app.views.kit import language
from app.views.kit.access import ACCESS
from app.views.kit.roles import Role
from app.views.people.feature import PeopleFeature
from app.views.shell.language import Rebuilding, fill_language_menu
from app.views.shell.window import MainWindow

GERMAN = """<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de_DE"><context><name></name>
<message><source>&amp;File</source><translation>&amp;Datei</translation></message>
<message><source>An attempt is running: end it before another language is chosen</source>
<translation>Zuerst den Versuch beenden</translation></message>
</context></TS>
"""


@pytest.fixture
def german(tmp_path, monkeypatch, application):
    """A folder of languages with German in it."""
    monkeypatch.setenv("ACUS_CACHE", str(tmp_path / "cache"))
    (tmp_path / "acus_de.ts").write_text(GERMAN)
    monkeypatch.setattr("app.core.language.folder", lambda: tmp_path)
    yield
    language.use_language(application, "en")


@pytest.fixture
def rebuilding(application, german, services, destroy, settle):
    result = Rebuilding(lambda: MainWindow(services))
    result.window.show()
    yield result
    result.close()
    result.window.editor.saved(None)
    destroy(result.window)
    settle()
    result.deleteLater()


def menus(window):
    return [action.text() for action in window.menuBar().actions()]


def entries(menu):
    return [(action.text(), action.isChecked()) for action in menu.actions()]


@pytest.mark.long("journey")
def test_the_menu_lists_each_language_by_its_own_name(window, german):
    menu, changes = QMenu(window), []
    fill_language_menu(menu, window.settings, changes.append)
    assert [text for text, _ in entries(menu)][1:] == ["English", "Deutsch"]
    assert [on for _, on in entries(menu)] == [True, False, False]
    menu.actions()[2].trigger()
    assert changes == ["de"]
    language.choose(window.settings, "de")
    fill_language_menu(menu, window.settings, changes.append)
    assert [on for _, on in entries(menu)] == [False, False, True]


@pytest.mark.long("journey")
def test_another_language_keeps_patient_plan_and_exercise(patient, rebuilding, settle):
    window = rebuilding.window
    window.show_patient(patient)
    plan(window)
    drawn, taken = window.editor.edit.draft, window.conductor.exercise
    rebuilding.change("de")
    new = rebuilding.window
    assert new is not window
    assert "&Datei" in menus(new)
    assert new.isVisible()
    assert new.conductor.patient is patient
    assert new.editor.edit.draft == drawn
    assert new.editor.dirty  # it was not saved, and still is not
    assert new.conductor.exercise.id == taken.id
    assert language.chosen(new.settings) == "de"
    settle()
    assert not isValid(window)
    rebuilding.change("en")
    assert "&File" in menus(rebuilding.window)
    assert rebuilding.window.editor.edit.draft == drawn


@pytest.mark.long("journey")
@pytest.mark.parametrize("attempted", [True, False])
def test_another_language_knows_what_was_briefed_and_whether_the_plan_was_attempted(
    patient, rebuilding, attempted
):
    window, exercise = rebuilding.window, load_exercise("plan-it-yourself")
    window.conductor.set_exercise(exercise)
    window.feature(ExerciseFeature).beginning.trust(exercise.id)
    window.show_patient(patient)
    plan(window)
    if attempted:
        window.editor.note_attempt()
    rebuilding.change("de")
    new = rebuilding.window
    assert new.feature(ExerciseFeature).beginning.is_briefed(exercise)
    assert new.editor.attempted is attempted


@pytest.mark.long("journey")
def test_the_words_of_the_debrief_have_their_share_in_another_language(rebuilding, settle):
    debrief = rebuilding.window.feature(DebriefFeature)
    debrief._controller._read(review)
    assert settle(lambda: rebuilding.window.pages.currentWidget() is debrief.page)
    rebuilding.change("de")
    new = rebuilding.window
    page = new.feature(DebriefFeature).page
    assert settle(lambda: page.review is not None)
    new.resize(1600, 900)
    assert settle(lambda: page.width() >= 1500)
    assert page._splitter.sizes()[0] >= 430
    page._splitter.moveSplitter(600, 1)  # whoever drags it keeps it
    new.resize(1700, 900)
    assert settle(lambda: page.width() >= 1600)
    assert page._splitter.sizes()[0] == pytest.approx(600, abs=20)


@pytest.mark.long("journey")
def test_another_language_shows_the_debrief_that_was_shown(rebuilding, settle):
    debrief = rebuilding.window.feature(DebriefFeature)
    shown = review()
    debrief._controller._read(lambda: shown)
    assert settle(lambda: rebuilding.window.pages.currentWidget() is debrief.page)
    rebuilding.change("de")
    new = rebuilding.window
    page = new.feature(DebriefFeature).page
    assert new.pages.currentWidget() is page
    assert settle(lambda: page.review is not None)
    assert page.review.id == shown.id
    assert new.pages.currentWidget() is page
    new.feature(DebriefFeature).show_sessions()
    rebuilding.change("en")
    last = rebuilding.window
    assert last.pages.currentWidget() is last.feature(DebriefFeature).sessions


def test_in_an_attempt_the_language_stays_and_the_window_says_so(patient, rebuilding):
    window = rebuilding.window
    window.show_patient(patient)
    plan(window)
    window.editor.set_locked(True)
    rebuilding.change("de")
    assert rebuilding.window is window
    assert "end it before another language" in window.message_bar.text
    assert language.chosen(window.settings) == ""
    window.editor.set_locked(False)


def test_whoever_says_no_to_unsaved_work_keeps_window_plan_and_language(
    patient, rebuilding, monkeypatch
):
    window = rebuilding.window
    window.show_patient(patient)
    plan(window)
    monkeypatch.setattr(window.features[-1], "may_go", lambda: False)
    rebuilding.change("de")
    assert rebuilding.window is window
    assert window.isVisible()
    assert window.editor.dirty
    assert language.chosen(window.settings) == ""
    assert QApplication.instance().quitOnLastWindowClosed()


@pytest.mark.long("journey")
def test_each_is_asked_once_about_unsaved_work(patient, rebuilding, monkeypatch):
    asked = []
    feature = rebuilding.window.features[-1]
    monkeypatch.setattr(feature, "may_go", lambda: not asked.append(1))
    rebuilding.change("de")
    assert asked == [1]


@pytest.mark.long("journey")
def test_choosing_what_is_chosen_does_nothing(rebuilding):
    window = rebuilding.window
    rebuilding.change("")
    assert rebuilding.window is window
    assert QApplication.instance().quitOnLastWindowClosed()


@pytest.mark.long("journey")
def test_choosing_by_name_what_the_computer_has_is_remembered_and_builds_nothing(rebuilding):
    window = rebuilding.window
    rebuilding.change(language.code_for(""))
    assert rebuilding.window is window
    assert language.chosen(window.settings) == language.code_for("")
    rebuilding.change("")
    assert rebuilding.window is window
    assert language.chosen(window.settings) == ""


@pytest.mark.long("journey")
@pytest.mark.parametrize("role", Role)
def test_everybody_chooses_the_language_in_the_menu_of_views(rebuilding, role, settle):
    for choice in ("de", "en"):  # in the first window, and in the one that takes its place
        window = rebuilding.window
        for one in (*Role, role):
            window.roles.choose(one)
        titles = [action.text() for action in window.view_menu._menu.actions()]
        assert titles.count("Language") == 1
        rebuilding.change(choice)
        settle(lambda window=window: not isValid(window))


@pytest.mark.long("journey")
@pytest.mark.parametrize("who", ["instructor", "student"])
def test_whoever_is_signed_in_stays_so_in_another_language(rebuilding, settle, who):
    """Seen: the instructor chose German, and was a student on the start page."""
    people = People()
    people.set_instructor("correct horse battery")
    person, _ = people.add(RosterLine("Ada", pin="271828"))
    if who == "instructor":
        ACCESS.sign_in(None, instructor=True)
    else:
        ACCESS.sign_in(person)
    window, role = rebuilding.window, ACCESS.role
    window.feature(PeopleFeature).show()
    try:
        rebuilding.change("de")
        settle(lambda: not isValid(window))
        settle(lambda: ACCESS.guarded)
        assert ACCESS.instructor == (who == "instructor")
        assert (ACCESS.student is not None) == (who == "student")
        assert ACCESS.role is role
        new = rebuilding.window
        assert settle(lambda: new.pages.currentWidget() is new.feature(PeopleFeature).page)
    finally:
        ACCESS.sign_in(None)
