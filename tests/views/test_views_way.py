"""What lies on the planned way is said as soon as it is known, and that it is not known before."""

import re
import threading

import pytest
from window_rig import plan

from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Cancelled
from app.exercises.library import load_exercise
from app.imaging.errors import ImagingError
from app.imaging.field.making import field_of
from app.planning.draft import DraftPlan
from app.views.kit import theme
from app.views.plan.feature import PlanFeature
from app.views.plan.verdict import WayState
from app.views.slices.viewing import Tool

BESIDE = (-8.0, 5.0, 140.0)
"""A target beside the rod of bone, with the entry above it."""


@pytest.fixture
def panel(window, patient):
    window.show_patient(patient)
    return window.feature(PlanFeature).panel


def told(panel):
    return panel.verdict.text()


@pytest.mark.long("journey")
def test_a_rod_of_bone_on_the_way_is_warned_of_without_any_map(window, panel, settle):
    plan(window)
    assert told(panel) == "…  The robot can follow; what lies on the way is being looked up…"
    assert theme.GOOD not in panel.verdict.styleSheet()
    assert settle(lambda: "on the way at" in told(panel))
    first = re.fullmatch(r"▲  bone on the way at (\d+) mm", told(panel).splitlines()[0])
    # by the numbers of `conftest.box_volume` the rod begins 16 mm below the skin
    assert int(first[1]) == pytest.approx(16, abs=1)
    assert theme.WARNING in panel.verdict.styleSheet()
    assert "The robot can follow this path." in told(panel)


@pytest.mark.long("journey")
def test_another_entry_is_judged_at_once_and_a_free_way_is_said(window, panel, settle):
    window.editor.place(Tool.ENTRY, (-8.0, -18.0, 140.0), True)
    window.editor.place(Tool.TARGET, BESIDE, True)
    assert settle(lambda: "No bone" in told(panel))
    assert told(panel).startswith("✔")
    made = window.feature(PlanFeature).way._tissues
    window.editor.place(Tool.ENTRY, (-7.0, -18.0, 140.0), True)
    assert window.feature(PlanFeature).way.way.state is WayState.KNOWN
    assert window.feature(PlanFeature).way._tissues is made


@pytest.mark.long("journey")
def test_a_way_that_cannot_be_looked_up_is_told_with_the_reason(window, panel, settle, monkeypatch):
    def fails(*_, **__):
        raise ImagingError("no memory for it")

    monkeypatch.setattr("app.imaging.field.making.field_of", fails)
    plan(window)
    assert settle(lambda: "not known: no memory for it" in told(panel))
    assert told(panel).startswith("▲")


@pytest.fixture
def somebody_loads():
    """Somebody who loads modules for as long as the test lasts, as a robot that starts does."""
    held, done = threading.Event(), threading.Event()

    def load():
        with ONE_AT_A_TIME:
            held.set()
            done.wait(60.0)

    thread = threading.Thread(target=load)
    thread.start()
    assert held.wait(10.0)
    yield
    done.set()
    thread.join(10.0)


@pytest.mark.long("journey")
def test_the_way_is_known_while_a_robot_still_loads(window, panel, settle, request):
    request.getfixturevalue("somebody_loads")
    plan(window)
    assert settle(lambda: "on the way at" in told(panel))


@pytest.mark.long("journey")
def test_a_way_that_waits_for_the_program_to_load_says_so(
    window, panel, settle, request, monkeypatch
):
    monkeypatch.setattr("app.core.loading.is_loaded", lambda _: False)
    monkeypatch.setattr("app.views.plan.way.SILENT_S", 0.1)
    request.getfixturevalue("somebody_loads")
    plan(window)
    assert settle(lambda: "for the program to load" in told(panel))
    assert told(panel).startswith("…  The robot can follow")


@pytest.mark.long("journey")
def test_a_look_up_that_was_stopped_is_asked_for_again(window, panel, settle, monkeypatch):
    honest, calls = field_of, []

    def stopped_once(*given, **named):
        calls.append(1)
        if len(calls) == 1:
            raise Cancelled("by somebody else")
        return honest(*given, **named)

    monkeypatch.setattr("app.imaging.field.making.field_of", stopped_once)
    plan(window)
    assert settle(lambda: "on the way at" in told(panel))
    assert len(calls) == 2


@pytest.mark.long("journey")
def test_another_patient_and_the_end_of_the_window_take_the_look_up_away(
    window, panel, patient, settle, monkeypatch
):
    begun, gate = threading.Event(), threading.Event()

    def slow(*_, progress, **__):
        begun.set()
        while not gate.wait(0.01):
            progress.check()

    monkeypatch.setattr("app.imaging.field.making.field_of", slow)
    plan(window)
    assert settle(begun.is_set)
    window.editor.start(DraftPlan())
    assert window.feature(PlanFeature).way._task is None
    assert window.feature(PlanFeature).way.way.state is WayState.NOBODY_ASKS
    gate.set()


def test_the_plan_that_an_exercise_gives_is_not_looked_up_and_a_changed_one_is(
    window, patient, monkeypatch
):
    window.conductor.set_exercise(load_exercise("first-insertion"))
    monkeypatch.setattr(window.conductor, "fits", lambda *_: True)
    window.show_patient(patient)
    way = window.feature(PlanFeature).way
    window.editor.start(DraftPlan((5.0, -18.5, 140.0), (5.0, 5.0, 140.0), "given"))
    assert window.editor.verdict.placed is not None
    assert way.way.state is WayState.NOBODY_ASKS
    window.editor.place(Tool.ENTRY, (-8.0, -18.0, 140.0), True)
    assert way.way.state is WayState.LOOKING
