"""The command to hold the breath: button, key, words, and the line of the next step."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from app.session.snapshot import BreathHold
from app.views.exercise.panel import BreathCommand
from app.views.exercise.steps import breath_words

HELD = BreathHold(asked=True, held=True, left=12.4)


@pytest.fixture
def command(application):
    command = BreathCommand()
    command.show()
    yield command
    command.close()


def test_it_is_there_only_where_the_patient_can_be_told(command):
    command.show_breath(None, True)
    assert not command.isVisible()
    command.show_breath(BreathHold(), False)
    assert command.isVisible()
    assert not command.button.isEnabled()


def test_button_and_key_say_and_ask_the_other_of_what_is(command):
    asked = []
    command.asked.connect(asked.append)
    command.show_breath(BreathHold(), True)
    assert command.button.accessibleName() == "Hold the breath (A)"
    command.button.click()
    command.show_breath(HELD, True)
    assert command.button.accessibleName() == "Let breathe (A)"
    command.activateWindow()
    assert QTest.qWaitForWindowActive(command)
    QTest.keyClick(command, Qt.Key.Key_A)
    assert asked == [True, False]


@pytest.mark.parametrize(
    ("breath", "words"),
    [
        (BreathHold(), "Have the breath held (A): Push"),
        (BreathHold(asked=True), "Wait: he breathes out and holds"),
        (HELD, "Held, 12 s left: Push"),
        (
            BreathHold(asked=True, spent=True),
            "The patient breathes freely (A releases, A asks again): Push",
        ),
    ],
)
def test_the_line_says_how_he_stands_and_what_to_do(breath, words):
    assert breath_words(breath, "Push", True) == words


def test_who_breathes_by_himself_is_not_said_to_be_held(command):
    command.show_breath(BreathHold(asked=True, spent=True), True)
    assert command.button.accessibleName() == "Release (A)"
    assert command._words.text() == "breathes by himself"
    command.show_breath(BreathHold(), True)
    assert command.button.accessibleName() == "Hold the breath (A)"


def test_who_only_watches_is_not_told_to_command():
    spent = BreathHold(asked=True, spent=True)
    assert breath_words(spent, "Push", False) == "He breathes by himself: Push"
    assert breath_words(BreathHold(), "Push", False) == "Push"
