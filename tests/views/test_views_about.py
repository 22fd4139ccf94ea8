import re
import time
from importlib.metadata import requires, version

import pytest
from PySide6.QtCore import QUrl
from PySide6.QtGui import QAction, QDesktopServices
from PySide6.QtWidgets import QApplication, QLabel, QScrollArea, QVBoxLayout, QWidget

from app import __version__
from app.views.kit.text import disclaimer
from app.views.robot.health_panel import HealthPanel
from app.views.shell import help as user_guide
from app.views.shell import window as shell_window
from app.views.shell.application import icon
from app.views.shell.help import AboutDialog, parts


@pytest.fixture
def parent(application):
    widget = QWidget()
    yield widget
    widget.deleteLater()


def test_about_says_version_disclaimer_and_that_qt_is_under_the_lgpl(parent):
    dialog = AboutDialog(parent)
    text = " ".join(label.text() for label in dialog.findChildren(QLabel))
    assert __version__ in text
    assert "<" not in text
    assert disclaimer() in text
    assert "Qt" in text
    assert "GNU Lesser General Public License (LGPL), version 3" in text


def test_about_lists_every_library_with_version_and_licence(parent):
    table = AboutDialog(parent).table
    end = time.monotonic() + 20.0
    while not table.rowCount() and time.monotonic() < end:
        QApplication.processEvents()
        time.sleep(0.01)
    rows = [
        [table.item(row, column).text() for column in range(3)] for row in range(table.rowCount())
    ]
    assert ["numpy", version("numpy")] in [row[:2] for row in rows]
    assert all(row[2] and row[2] != "not stated" for row in rows)
    assert "LGPL" in next(row[2] for row in rows if row[0].startswith("PySide6"))


def test_the_parts_are_all_that_the_program_requires_and_what_these_require():
    named = {part.name.lower().replace("_", "-") for part in parts()}
    needed = {
        re.split(r"[^\w.-]", line, maxsplit=1)[0].lower().replace("_", "-")
        for line in requires("acus")
        if "extra ==" not in line
    }
    assert needed <= named
    assert "llvmlite" in named  # of numba


def test_the_icon_can_be_drawn(application):
    assert not icon().pixmap(64, 64).toImage().isNull()
    assert icon().pixmap(64, 64).toImage().pixelColor(32, 60).alpha() == 255


def test_help_is_about_the_feature_that_a_widget_belongs_to(parent):
    assert user_guide.page_of(None) == user_guide.HOME
    assert user_guide.page_of(parent) == user_guide.HOME
    panel = HealthPanel.__new__(HealthPanel)
    QWidget.__init__(panel, parent)
    label = QLabel("a word on it", panel)
    assert user_guide.page_of(label) == user_guide.PAGES["robot"]
    panel.setLayout(QVBoxLayout())


def test_help_opens_the_built_site_at_the_heading(parent, monkeypatch, tmp_path):
    opened = []
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: bool(opened.append(url)) or True)
    monkeypatch.setattr(user_guide, "SITE", tmp_path)
    (tmp_path / "planning.html").write_text("a page")
    assert user_guide.show_help(parent, "planning.md#measuring") is None
    (url,) = opened
    assert url == QUrl.fromLocalFile(str(tmp_path / "planning.html")).resolved(QUrl("#measuring"))


def test_without_a_site_help_shows_the_page_as_it_is_written(parent, monkeypatch, tmp_path):
    monkeypatch.setattr(user_guide, "SITE", tmp_path)
    window = user_guide.show_help(parent, "planning.md#measuring")
    assert "HU probe" in window.browser.toPlainText()
    bar = window.browser.verticalScrollBar()
    assert bar.value() > 0.3 * bar.maximum()  # at the heading, which is not at the top
    window.close()


def test_without_site_and_sources_help_says_what_to_do(parent, monkeypatch, tmp_path):
    monkeypatch.setattr(user_guide, "SITE", tmp_path)
    monkeypatch.setattr(user_guide, "SOURCES", tmp_path)
    window = user_guide.show_help(parent, "planning.md")
    shown = [one.text() for one in window.findChildren(QLabel) if not one.isHidden()]
    assert any("make docs" in text and "docs/planning.md" in text for text in shown)
    window.close()


def test_f1_opens_the_page_about_what_has_the_keyboard(window, monkeypatch):
    asked = []
    monkeypatch.setattr(shell_window, "show_help", lambda parent, page: asked.append(page))
    (f1,) = [one for one in window.findChildren(QAction) if "F1" in _keys(one)]
    monkeypatch.setattr(QApplication, "focusWidget", lambda: window.workspace.bullseye)
    f1.trigger()
    assert asked == [user_guide.PAGES["exercise"]]
    (keys,) = [one for one in window.findChildren(QAction) if "?" in _keys(one)]
    assert keys.text() == "Keys and mouse"


def test_every_panel_has_a_page_of_its_own(window):
    side = window.workspace.side
    found = {}
    for index in range(side.count()):
        side.setCurrentIndex(index)
        panel = side.currentWidget()
        inner = panel.widget() if isinstance(panel, QScrollArea) else panel
        found[side.names()[index]] = user_guide.page_of(inner)
    assert user_guide.HOME not in found.values()
    assert found["Structures"] == user_guide.PAGES["structures"]
    assert found["Robot"] == user_guide.PAGES["robot"]


def _keys(action):
    return [key.toString() for key in action.shortcuts()]


def test_help_that_is_asked_for_again_is_the_window_that_is_open(parent, monkeypatch, tmp_path):
    monkeypatch.setattr(user_guide, "SITE", tmp_path)
    window = user_guide.show_help(parent, "planning.md")
    assert user_guide.show_help(parent, "planning.md") is window
    other = user_guide.show_help(parent, "pen.md")
    assert other is not window
    assert not window.isVisible()
    other.close()
