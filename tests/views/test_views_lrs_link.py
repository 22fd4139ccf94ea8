"""The record store in the window: off until it is named, quiet, and patient when it is away."""

import random
import sys
import time
from pathlib import Path

import pytest
from PySide6.QtWidgets import QLabel
from test_views_people import record

sys.path.append(str(Path(__file__).parents[1] / "exchange"))
from lrs_server import ScriptedLrs, answer

from app.exchange.lrs import Backoff, LrsPlace, place_of_lrs, put_lrs
from app.session.audit import entries
from app.session.people import People
from app.session.roster import RosterLine
from app.views.kit.access import ACCESS
from app.views.people.feature import PeopleFeature

HOME = "https://training.hospital.example"


@pytest.fixture
def feature(window):
    yield window.feature(PeopleFeature)
    window.feature(PeopleFeature).close()


def student():
    return People().add(RosterLine("Ada"))[0].key


@pytest.mark.long("journey")
def test_nothing_is_sent_until_a_store_is_named(window, feature, settle):
    folder = feature.context.services.sessions()
    record(folder, "a", student(), 72.0)
    feature.lrs.quietly()
    assert feature.lrs._task is None
    assert not (People().folder / "statements").exists()


@pytest.mark.long("journey")
def test_a_store_is_looked_at_kept_and_told(window, feature, settle):
    folder = feature.context.services.sessions()
    record(folder, "a", student(), 72.0)
    feature.show()
    with ScriptedLrs(answer(401)) as server:
        feature.lrs.connect_lrs()
        dialog = feature.dialog
        for line, text in zip(dialog.lines, ("somewhere", HOME, "acus", "secret"), strict=True):
            line.setText(text)
        dialog.save()
        assert "is no address" in dialog.note.text()
        dialog.lines[0].setText(server.url)
        dialog.save()
        assert settle(lambda: feature.dialog is not None and feature.dialog is not dialog)
        dialog = feature.dialog  # again, with what was typed and what is wrong with it
        assert "give name and password again" in dialog.note.text()
        assert dialog.lines[0].text() == server.url
        assert place_of_lrs() is None
        dialog.save()
        assert settle(lambda: feature.dialog is not None and feature.dialog is not dialog)
        assert feature.dialog.findChild(QLabel).text() == "1 statement sent."
        feature.dialog.close()
    assert [one["actor"]["account"]["name"] for one in server.held.values()] == ["Ada"]
    assert feature.page.board.lrs.text().startswith("Record store: told at ")
    assert place_of_lrs() == LrsPlace(server.url, HOME, "acus", "secret")
    feature.lrs.connect_lrs()
    feature.dialog.lines[0].clear()
    feature.dialog.save()
    assert settle(lambda: place_of_lrs() is None)
    assert settle(lambda: not feature.page.board.lrs.text())


@pytest.mark.long("journey")
def test_it_is_told_quietly_but_not_while_an_attempt_runs(window, feature, settle):
    folder = feature.context.services.sessions()
    record(folder, "a", student(), 72.0)
    running = [True]
    feature.lrs._busy = lambda: running[0]
    with ScriptedLrs() as server:
        put_lrs(LrsPlace(server.url, HOME))
        feature.lrs.quietly()
        assert feature.lrs._task is None
        running[0] = False
        feature.lrs.quietly()
        feature.lrs.quietly()  # too fast: one at a time
        assert settle(lambda: feature.page.board.lrs.text().startswith("Record store"))
        assert len(server.posts()) == 1
        feature.lrs.quietly()  # nothing is new
        assert settle(lambda: feature.lrs._task is None)
        assert len(server.posts()) == 1
        record(folder, "b", People().find("Ada").key, 80.0)
        feature.lrs.soon()
        feature.lrs.quietly()
        assert settle(lambda: len(server.held) == 2)
    assert [(one.who, one.what) for one in entries()][-1] == ("program", "statements sent")


@pytest.mark.long("journey")
def test_a_store_that_is_away_is_left_alone_for_a_while(window, feature, settle):
    folder = feature.context.services.sessions()
    record(folder, "a", student(), 72.0)
    feature.show()
    feature.lrs._backoff = Backoff(60.0, 3600.0, random.Random(1))
    with ScriptedLrs(answer(503, Retry_After="7200")) as server:
        put_lrs(LrsPlace(server.url, HOME, "acus", "secret"))
        feature.lrs.quietly()
        board = feature.page.board
        assert settle(lambda: board.lrs.text().endswith("1 statement waits to be sent."))
        assert "secret" not in board.lrs.text()
        assert settle(lambda: feature.lrs._task is None)
        assert feature.lrs._not_before - time.monotonic() > 7000.0
        feature.lrs.quietly()
        assert feature.lrs._task is None
        feature.lrs.now()  # whoever asks for it does not wait
        assert settle(lambda: len(server.held) == 1)
        assert settle(lambda: feature.dialog is not None)
        feature.dialog.close()
    assert feature.lrs._not_before == 0.0


@pytest.mark.long("journey")
def test_the_record_store_is_the_instructors(window, feature, settle):
    People().set_instructor("correct horse battery")
    feature.look()
    settle(lambda: not ACCESS.may_manage)
    said = []
    feature.failed.connect(said.append)
    feature.lrs.now()
    feature.lrs.connect_lrs()
    assert len(said) == 2
    assert feature.dialog is None
