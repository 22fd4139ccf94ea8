"""Attempts that lie in the source tree, in the window: offered once, and brought when asked."""

import shutil
from pathlib import Path

import pytest
from PySide6.QtWidgets import QMessageBox
from session_fakes import Bench
from window_rig import FakeServices

from app.core import paths
from app.session.store import records
from app.views.debrief.feature import DebriefFeature
from app.views.shell.window import MainWindow


@pytest.fixture
def tree(tmp_path, monkeypatch):
    folder = tmp_path / "tree" / "sessions"
    bench = Bench(folder)
    bench.run(0.1)
    for _ in range(2):
        bench.trainer.begin("S1")
        bench.run(0.5, 0.06)
        bench.trainer.end()
    shutil.copy(min(folder.glob("*.mcap")), folder / "20200101-000000-ffff.mcap")
    monkeypatch.setattr(paths, "tree_sessions", lambda: folder)
    return folder


@pytest.fixture
def window(application, destroy):
    window = MainWindow(FakeServices(paths.own_sessions()))
    destroy(window)
    window.show()
    yield window
    window.editor.saved(Path("kept"))


def told(window):
    return "" if window.message_bar.isHidden() else window.message_bar.text


@pytest.mark.long("journey")
def test_attempts_in_the_tree_are_told_and_come_when_asked_for_once(
    tree, window, settle, monkeypatch
):
    gathering = window.feature(DebriefFeature).gathering
    assert settle(lambda: gathering.entry.isVisible())
    assert f"Earlier attempts lie in {tree} (2)" in told(window)
    assert len(records(tree)) == 3, "nothing came by itself"
    answers, asked = [QMessageBox.StandardButton.No, QMessageBox.StandardButton.Yes], []

    def answer(*words, **_):
        asked.append(words[2])
        return answers[len(asked) - 1]

    monkeypatch.setattr(QMessageBox, "question", answer)
    gathering.entry.trigger()
    settle(lambda: False, 0.2)
    assert len(records(tree)) == 3
    gathering.entry.trigger()
    gathering.entry.trigger()  # too fast: it is on its way
    assert settle(lambda: not gathering.entry.isVisible())
    assert len(asked) == 2
    assert str(tree) in asked[0]
    assert str(paths.own_sessions()) in asked[0]
    assert [path.name for path in records(tree)] == ["20200101-000000-ffff.mcap"]
    assert len(records(paths.own_sessions())) == 2
    assert "2 attempts have come" in told(window)
    sessions = window.feature(DebriefFeature).sessions
    assert settle(lambda: sessions.model.rowCount() == 2)


@pytest.mark.long("journey")
def test_what_cannot_come_is_said_and_can_be_asked_for_again(tree, window, settle, monkeypatch):
    gathering = window.feature(DebriefFeature).gathering
    assert settle(lambda: gathering.entry.isVisible())
    yes = QMessageBox.StandardButton.Yes
    monkeypatch.setattr(QMessageBox, "question", lambda *_, **__: yes)

    def full(*_):
        raise OSError(28, "No space left on device", "somewhere")

    with monkeypatch.context() as away:
        away.setattr("app.session.elsewhere.shutil.copyfile", full)
        gathering.entry.trigger()
        assert settle(lambda: "No space left" in told(window))
    assert len(records(tree)) == 3
    assert records(paths.own_sessions()) == []
    gathering.entry.trigger()
    assert settle(lambda: len(records(paths.own_sessions())) == 2)


@pytest.mark.long("journey")
def test_without_any_there_is_no_entry_and_no_word(window, settle):
    settle(lambda: False, 0.5)
    assert not window.feature(DebriefFeature).gathering.entry.isVisible()
    assert told(window) == ""
