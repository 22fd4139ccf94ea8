"""Lines that are typed into: Esc clears a search, a name takes spaces and says what it refuses."""

import pytest

pytest.importorskip("PySide6")

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QToolTip


@pytest.fixture
def start(window, settle):
    window.activateWindow()
    assert settle(window.isActiveWindow)
    return window.start_page


def test_esc_clears_the_search_and_shows_all_exercises_again(window, start):
    QTest.keyClicks(start.search, "kidney")
    shown = [place for place in start.map.places.values() if not place.isHidden()]
    assert 0 < len(shown) < len(start.map.places)
    QTest.keyClick(start.search, Qt.Key.Key_Escape)
    assert start.search.text() == ""
    assert not any(place.isHidden() for place in start.map.places.values())
    QTest.keyClick(start.search, Qt.Key.Key_Escape)  # there is nothing to clear
    assert window.pages.currentWidget() is start


@pytest.mark.parametrize("where", ["start page", "panel"])
def test_a_name_takes_a_space_as_an_underscore_and_says_what_it_refuses(window, start, where):
    line = start.who.line if where == "start page" else window.workspace.exercise_panel.student
    line.clear()
    QTest.keyClicks(line, "anna b 7")
    assert line.text() == "anna_b_7"
    assert line.hasAcceptableInput()
    line.clear()
    line.insert(" anna b ")
    assert line.text().startswith("anna_b")
    QToolTip.hideText()
    QTest.keyClicks(line, "/")
    assert "/" not in line.text()
    assert "a space becomes _" in QToolTip.text()
    QToolTip.hideText()
    line.clear()
