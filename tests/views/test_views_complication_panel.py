"""The panel of the patient: vital signs, and answers by keyboard and mouse."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget

from app.scoring.complications.answers import Reaction
from app.scoring.complications.course import Vitals
from app.session.complications import ComplicationsState
from app.views.exercise.procedure_panel import ComplicationPanel


@pytest.fixture
def page(application):
    page = QWidget()
    page.panel = ComplicationPanel(page)
    page.panel.listen(page)
    page.show()
    page.activateWindow()
    QApplication.processEvents()
    yield page
    page.close()


def test_nothing_is_shown_where_nothing_can_happen(page) -> None:
    page.panel.show_patient(None, True)
    assert not page.panel.isVisible()


def test_the_monitor_is_shown_and_the_answers_so_far(page) -> None:
    shown = page.panel
    shown.show_patient(ComplicationsState(Vitals(91, 104, 4, True), ("give oxygen: wrong",)), True)
    assert shown.isVisible()
    assert "91 %" in shown.vitals.text()
    assert "104/min" in shown.vitals.text()
    assert "coughs" in shown.vitals.text()
    assert shown.given.text() == "give oxygen: wrong"
    assert [shown.choice.itemData(n) for n in range(shown.choice.count())] == list(Reaction)


def test_the_longest_answer_does_not_widen_the_rail(page) -> None:
    page.panel.show_patient(ComplicationsState(Vitals()), True)
    assert page.panel.choice.minimumSizeHint().width() < 200


def test_keys_and_mouse_say_that_something_is_wrong_and_do_what_is_chosen(page) -> None:
    shown, noticed, answered = page.panel, [], []
    shown.noticed.connect(lambda: noticed.append(True))
    shown.answered.connect(answered.append)
    shown.show_patient(ComplicationsState(Vitals()), True)
    shown.choice.setCurrentIndex(list(Reaction).index(Reaction.DRAIN))
    QTest.mouseClick(shown.notice, Qt.MouseButton.LeftButton)
    QTest.mouseClick(shown.answer, Qt.MouseButton.LeftButton)
    assert (len(noticed), answered) == (1, [Reaction.DRAIN])
    for shortcut, _ in shown._keys:  # a window without a display is seldom the active one
        shortcut.activated.emit()
    assert (len(noticed), answered) == (2, [Reaction.DRAIN] * 2)
    assert [s.key().toString() for s, _ in shown._keys] == ["Shift+J", "Ctrl+Shift+J"]


def test_nothing_can_be_answered_outside_an_attempt(page) -> None:
    shown = page.panel
    shown.show_patient(ComplicationsState(Vitals()), False)
    assert not shown.notice.isEnabled()
    assert not shown.answer.isEnabled()
    assert not shown.choice.isEnabled()
    assert not any(shortcut.isEnabled() for shortcut, _ in shown._keys)
