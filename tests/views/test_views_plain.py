"""Foreign names are shown as they stand: no label, tip or box of the window reads markup."""

import ast
import dataclasses
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint
from PySide6.QtGui import Qt, QTextDocument
from PySide6.QtWidgets import QApplication, QLabel, QLineEdit, QToolTip, QWidget

import app
from app.core.plugin_folders import folders
from app.exercises.library import load_exercise
from app.imaging.series import Ignored, Listing
from app.session.course import Course, CourseItem
from app.session.people import People
from app.session.roster import RosterLine
from app.views.kit.form import Form
from app.views.kit.parts import PlainLabel, message_box
from app.views.kit.text import literal
from app.views.people.feature import PeopleFeature
from app.views.series.browser import SeriesBrowser

APP = Path(app.__file__).parent
VIEWS = APP / "views"
SOURCES = (VIEWS, *(folder.path for folder in folders() if folder.is_own))
"""Where the window's words stand: folders of plug-ins have views and features too."""
NAMES = ("<b>Ada</b>", "<img src='/etc/passwd'>Ada", "<a href='file:///x'>here</a>", "<h1>x")
TEXT_OF = {
    **dict.fromkeys(("setToolTip", "setStatusTip", "setWhatsThis", "setLabelText"), -1),
    **{"question": 2, "showText": 1, "QProgressDialog": 0, "getText": 2},
}
"""What shows markup, by name, and which argument is the text."""
OWN_WORDS = {"author/feature.py"}
"""Files that ask with words of the program's own that stand in a variable."""
RICH = {
    "accuracy/diagram.py": "its key has colours; each family in it is escaped",
    "accuracy/sweep_tab.py": "so has the key of its lines; each value in it is escaped",
}
"""Files of a label with markup, each with its reason."""


def calls():
    """Every call in the views: file, node, and the name of what is called."""
    for path in (path for place in SOURCES for path in sorted(place.rglob("*.py"))):
        name = path.relative_to(VIEWS if path.is_relative_to(VIEWS) else APP).as_posix()
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call):
                called = node.func
                yield name, node, getattr(called, "attr", getattr(called, "id", ""))


def literal_words(node):
    """Whether a text is the program's own words, with nothing filled in, or goes through a door."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        return node.func.id in ("literal", "escape") or (node.func.id == "tr" and not node.keywords)
    if isinstance(node, ast.IfExp):
        return literal_words(node.body) and literal_words(node.orelse)
    if isinstance(node, ast.BinOp):
        return literal_words(node.left) and literal_words(node.right)
    if isinstance(node, ast.BoolOp):
        return all(map(literal_words, node.values))
    return isinstance(node, ast.Constant)


@pytest.mark.long("journey")
def test_every_label_is_plain():
    made = [f"{file}:{node.lineno}" for file, node, name in calls() if name == "QLabel"]
    assert [one for one in made if one.partition(":")[0] not in RICH] == []
    kinds = [
        f"{path.name}: {node.name}"
        for place in SOURCES
        for path in place.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.ClassDef)
        and any(getattr(base, "id", "") == "QLabel" for base in node.bases)
    ]
    assert kinds == ["parts.py: PlainLabel"]


@pytest.mark.long("journey")
def test_what_looks_for_markup_itself_is_given_literal_words():
    raw = []
    for file, node, name in calls():
        place = TEXT_OF.get(name)
        if place is not None and not literal_words(node.args[place]):
            own = isinstance(node.args[place], ast.Name) and file in OWN_WORDS
            raw += [] if own else [f"{file}:{node.lineno} {name}"]
        elif name == "QMessageBox" and file != "kit/parts.py":
            raw.append(f"{file}:{node.lineno} {name}: kit.parts.message_box makes one")
        elif name == "addRow" and isinstance(node.args[0], ast.Call | ast.JoinedStr):
            raw.append(f"{file}:{node.lineno} {name}: kit.form.Form adds one")
    assert raw == []


@pytest.mark.parametrize("name", [*NAMES, "a < b & c > d", "plain", "two\nlines <i>x</i>"])
def test_literal_words_are_read_back_as_they_stand(name):
    shown = QTextDocument()
    if Qt.mightBeRichText(literal(name)):
        shown.setHtml(literal(name))
    else:
        shown.setPlainText(literal(name))
    assert shown.toPlainText() == name


def unlike_plain(widget: QWidget) -> list[str]:
    """Labels of a widget that would read markup, and tips that would."""
    labels = [
        f"{type(one).__name__} {one.text()!r}"
        for one in widget.findChildren(QLabel)
        if one.textFormat() != Qt.TextFormat.PlainText and one.objectName() not in OF_BOXES
    ]
    tips = [
        f"{type(one).__name__} tip {one.toolTip()!r}"
        for one in widget.findChildren(QWidget)
        if Qt.mightBeRichText(one.toolTip()) and not one.toolTip().startswith("<qt>")
    ]
    return labels + tips


OF_BOXES = ("qt_msgbox_label", "qt_msgboxex_icon_label", "qt_msgbox_informativelabel")
"""Labels that Qt makes: they are given literal words."""


def shows(widget: QWidget, name: str) -> bool:
    """Whether a label shows a text with these very characters."""
    return any(name in one.text() for one in widget.findChildren(PlainLabel))


@pytest.mark.long("journey")
def test_the_whole_window_has_no_label_that_reads_markup(window, services, patient, settle):
    exercise = load_exercise("first-insertion").model_copy(update={"title": NAMES[0]})
    services.exercises = lambda: (exercise,)
    window.begin_exercise(exercise.id)
    window.show_patient(patient)
    settle()
    assert [one for one in unlike_plain(window) if "span style" not in one] == []


@pytest.mark.parametrize("name", NAMES)
def test_the_series_browser_shows_a_folders_and_a_series_names_as_they_stand(
    application, volume, name
):
    folder = Path("x") / name.replace("/", "∕")
    series = dataclasses.replace(volume.series, label=name, notes=(name,))
    browser = SeriesBrowser(Listing(folder, (series,), (Ignored(folder / "a", name),)))
    assert shows(browser, name)
    assert unlike_plain(browser) == []
    browser.reject()


@pytest.mark.parametrize("name", NAMES[:2])
def test_a_box_that_asks_shows_the_name_as_it_stands(application, name):
    box = message_box(None, "title", f"Erase {name}?", f"of {name}\nfor good")
    label = box.findChild(QLabel, "qt_msgbox_label")
    more = box.findChild(QLabel, "qt_msgbox_informativelabel")
    for one, words in ((label, f"Erase {name}?"), (more, f"of {name}\nfor good")):
        document = QTextDocument()
        document.setHtml(one.text())
        assert document.toPlainText() == words
    box.deleteLater()


@pytest.mark.long("journey")
@pytest.mark.parametrize("name", NAMES)
def test_a_student_and_a_course_are_named_as_they_stand(window, settle, name):
    feature = window.feature(PeopleFeature)
    People().add(RosterLine("Ada", name=name))
    exercise = load_exercise("first-insertion")
    Course(id="c", title=name, items=(CourseItem(exercise=exercise.id),)).save()
    feature.show()
    assert settle(lambda: feature._look is not None and bool(feature._look.courses))
    assert unlike_plain(feature.page) == []
    feature.release_course(feature._look.courses[0])
    read = QTextDocument()
    read.setHtml(feature.dialog.findChild(QLabel, "qt_msgbox_label").text())
    assert f"results of {name}?" in read.toPlainText()
    feature.close()


def test_a_tip_shows_a_name_as_it_stands(application, settle):
    """As the eye sees it: Qt's own tip, with what it would make of a raw name beside it."""
    shown = QWidget()
    for text, reads in ((NAMES[0], True), (literal(NAMES[0]), False)):
        QToolTip.showText(QPoint(0, 0), text, shown)
        (tip,) = (
            one
            for one in QApplication.topLevelWidgets()
            if one.metaObject().className() == "QTipLabel" and one.isVisible()
        )
        document = QTextDocument()
        document.setHtml(tip.text())
        assert (document.toPlainText() == NAMES[0]) is not reads
        QToolTip.hideText()
        tip.close()
    shown.deleteLater()


def test_a_title_of_a_form_leads_to_its_field(application):
    page, line = Form(), QLineEdit()
    page.row("&Pen <b>x</b>", line)
    (title,) = page.findChildren(QLabel)
    assert (title.text(), title.buddy()) == ("&Pen <b>x</b>", line)
    assert title.textFormat() == Qt.TextFormat.PlainText
    page.deleteLater()
