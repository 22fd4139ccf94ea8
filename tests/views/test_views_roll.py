"""Keys that turn a bevelled needle: only there, for as long as they are held, and what is said."""

from math import radians

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMainWindow

from app.views.exercise.pad_canvas import PadCanvas
from app.views.exercise.panel import BevelNote


@pytest.fixture
def window(application):
    window = QMainWindow()
    pad = PadCanvas(window)
    window.setCentralWidget(pad)
    place = QAction("Place entry", window)
    place.setShortcut(QKeySequence("E"))
    window.menuBar().addMenu("Plan").addAction(place)
    window.show()
    window.activateWindow()
    assert QTest.qWaitForWindowActive(window)
    pad.setFocus()
    yield window, pad, place
    window.close()


def test_q_and_e_are_the_menus_where_no_needle_is_bevelled_and_turn_it_where_one_is(window):
    _, pad, place = window
    turned, placed = [], []
    pad.rolled.connect(turned.append)
    place.triggered.connect(lambda: placed.append(1))
    QTest.keyClick(pad, Qt.Key.Key_E)
    assert (turned, placed) == ([], [1])
    pad.rolls = True
    QTest.keyClick(pad, Qt.Key.Key_E)
    QTest.keyClick(pad, Qt.Key.Key_Q)
    QTest.keyClick(pad, Qt.Key.Key_Q, Qt.KeyboardModifier.ShiftModifier)
    assert turned == pytest.approx([radians(4.5), -radians(4.5), -radians(0.9)])
    assert placed == [1]
    QTest.keyClick(pad, Qt.Key.Key_E, Qt.KeyboardModifier.ControlModifier)
    assert len(turned) == 3


def test_what_is_held_goes_on_and_ends_with_the_key_or_the_focus(window):
    _, pad, _ = window
    pad.rolls = True
    QTest.keyPress(pad, Qt.Key.Key_E)
    assert pad.turn.is_held
    QTest.keyRelease(pad, Qt.Key.Key_E)
    assert not pad.turn.is_held
    QTest.keyPress(pad, Qt.Key.Key_Q)
    pad.let_go()
    assert not pad.turn.is_held


def test_the_panel_says_how_far_it_is_turned(application):
    note = BevelNote()
    note.show_roll(None, True)
    assert not note.isVisible()
    note.show_roll(radians(450.0), True)
    assert note.text() == "Bevel turned by 90°  ·  Q, E in the pad turn it"
    note.show_roll(radians(-45.0), False)
    assert note.text() == "Bevel turned by -45°"
    note.close()
