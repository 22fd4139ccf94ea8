"""Live links in the window: their lines in the status strip, and plans that peers send."""

import threading

import numpy as np
import pytest
from window_rig import plan

from app.exchange.live.journal import LinkHealth, LinkReport
from app.session.machine import State
from app.views.kit.verdict import Verdict
from app.views.links.feature import LinksFeature, link_item

STATUS = LinkReport("OpenIGTLink", "127.0.0.1:18944", 2, 50.0, LinkHealth.CONNECTED, "x is here")
ENTRY, TARGET = np.array([0.002, -0.018, 0.141]), np.array([0.002, 0.004, 0.141])


class Links:
    def __init__(self):
        self.take = None

    def statuses(self):
        return (STATUS,)

    def take_plans(self, take):
        self.take = take


@pytest.fixture
def links():
    return Links()


@pytest.fixture
def services(services, links):
    services.watchers = (links,)
    return services


@pytest.fixture
def send(links, settle, monkeypatch):
    """Send a plan from another thread, as a link does; returns the answer.

    It waits for a window that shows its first patient on a busy computer.
    """
    monkeypatch.setattr("app.views.links.feature.PATIENCE", 60.0)

    def sent(entry=ENTRY, target=TARGET):
        answers = []
        asking = threading.Thread(target=lambda: answers.append(links.take(entry, target)))
        asking.start()
        assert settle(lambda: bool(answers))
        asking.join()
        return answers[0]

    return sent


def test_a_link_is_a_line_with_its_peers_and_what_was_said_last():
    item = link_item(STATUS)
    assert (item.verdict, item.title, item.text) == (Verdict.GOOD, "OpenIGTLink", "2 · 50/s")
    assert "127.0.0.1:18944" in item.help
    assert "x is here" in item.help
    waiting = LinkReport("rosbridge", "", 0, 0.0, LinkHealth.WAITING, "")
    assert link_item(waiting).verdict is Verdict.IDLE


@pytest.mark.long("journey")
def test_without_links_there_is_no_line(window, links):
    feature = window.feature(LinksFeature)
    assert [item.title for item in feature.items(None)] == ["OpenIGTLink"]
    feature._links = []
    assert feature.items(None) == ()


@pytest.mark.long("journey")
def test_a_plan_of_a_peer_is_the_window_s_plan_and_can_be_undone(window, patient, send):
    window.show_patient(patient)
    assert send() == ""
    np.testing.assert_allclose(window.editor.edit.draft.entry_mm, 1e3 * ENTRY)
    np.testing.assert_allclose(window.editor.edit.draft.target_mm, 1e3 * TARGET)
    window.editor.undo()
    assert window.editor.edit.draft.entry_mm is None


@pytest.mark.long("journey")
def test_without_a_patient_nobody_takes_a_plan(window, send):
    assert send() == "no patient is open"


@pytest.mark.long("journey")
def test_points_that_are_no_plan_are_refused_with_the_reason(window, patient, send):
    window.show_patient(patient)
    assert "mm" in send(ENTRY, ENTRY)
    assert window.editor.edit.draft.entry_mm is None


@pytest.mark.long("journey")
def test_during_an_attempt_the_plan_stays(window, patient, services, settle, send):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    window.runs.run.trainer.state, before = State.INSERTING, window.editor.edit.draft
    assert "an attempt is running" in send()
    assert window.editor.edit.draft == before
    window.runs.run.trainer.state = State.READY


def test_a_window_that_closes_takes_no_more_plans(window, links):
    window.feature(LinksFeature).close()
    assert links.take is None
