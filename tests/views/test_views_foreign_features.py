"""A feature of somebody else's that raises costs itself alone: the window opens and closes."""

import sys
from pathlib import Path

import pytest

from app.core import plugin_folders
from app.views.shell.feature import Feature
from app.views.shell.features import FEATURES
from app.views.shell.window import MainWindow

HERE = Path(sys.modules[__name__].__file__)


class CannotBeMade(Feature):
    """Ends the program where it is made."""

    def __init__(self, context):
        super().__init__(context)
        raise SystemExit(4)


class Refuses(Feature):
    """Raises wherever the window asks it something."""

    asked: list[str]

    def __init__(self, context):
        super().__init__(context)
        self.asked = []

    def _raise(self, method):
        self.asked.append(method)
        raise RuntimeError(f"no {method}")

    def over(self):
        self._raise("over")

    def watching(self):
        self._raise("watching")

    def forget(self):
        self._raise("forget")

    def suit_room(self):
        self._raise("suit_room")

    def unsaved(self):
        self._raise("unsaved")

    def may_go(self):
        self._raise("may_go")

    def opens(self, path):
        self._raise("opens")

    def close(self):
        self._raise("close")


class ForgetsToAnswer(Feature):
    """Returns nothing where the window needs an answer."""

    def may_go(self):
        return None

    def unsaved(self):
        return None


@pytest.fixture
def window_with(application, services, destroy):
    """Open a window that has further features."""

    def open_window(*more):
        window = MainWindow(services, (*FEATURES, *more))
        destroy(window)
        window.show()
        return window

    yield open_window
    plugin_folders.refused.pop(HERE, None)


@pytest.mark.long("journey")
def test_one_that_cannot_be_made_is_left_out_and_named(window_with):
    window = window_with(CannotBeMade)
    assert len(window.features) == len(FEATURES)
    reason = f"{HERE}: feature CannotBeMade: its constructor does not work: SystemExit: 4"
    assert window.message_bar.text == plugin_folders.refused[HERE] == reason
    assert window.close()


@pytest.mark.long("journey")
def test_one_that_raises_wherever_it_is_asked_keeps_no_window_open(window_with, tmp_path):
    window = window_with(Refuses)
    feature = window.features[-1]
    window.show_shortcuts()
    window.open_dropped(tmp_path)
    window._suit_room()
    window._forget_patient()
    assert window.may_go()
    assert "may_go() does not work: RuntimeError: no may_go" in window.message_bar.text
    assert window.close()
    assert feature.asked[-2:] == ["may_go", "close"]
    assert {"over", "watching", "forget", "suit_room", "opens"} <= set(feature.asked)
    assert "close() does not work: RuntimeError: no close" in plugin_folders.refused[HERE]


def test_one_that_gives_no_answer_is_answered_for(window_with):
    window = window_with(ForgetsToAnswer)
    assert window.may_go()
    assert "may_go() does not work: TypeError: gives None; give bool" in window.message_bar.text
    assert window.close()


def test_features_of_the_program_are_not_guarded_and_raise_as_they_are(window_with, monkeypatch):
    window = window_with()
    assert all("may_go" not in vars(feature) for feature in window.features)
