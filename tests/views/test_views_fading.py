"""Assistance that fades over a student's attempts, in the window."""

from dataclasses import replace

import pytest
from window_rig import plan

from app.exercises.library import load_exercise
from app.exercises.parts import ViewName
from app.exercises.schema import Exercise
from app.session import index
from app.session.people import Person
from app.views.kit.access import ACCESS

ALL = {"live_overlay", "bullseye", "three_d", "cameras"}
FADING = {"kind": "performance", "step": 0.3, "probe_every": 3}


@pytest.fixture
def exercise():
    document = load_exercise("first-insertion").model_dump(mode="json", by_alias=True)
    return Exercise.model_validate(document | {"fading": FADING})


@pytest.fixture
def opened(window, patient, settle):
    window.show_patient(replace(patient, phantom_seed=1))
    plan(window)
    settle()
    return window


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    ("totals", "dial", "views"),
    [
        ([], 0.7, ALL),
        ([95.0], 0.4, ALL),
        ([95.0, 95.0], 0.0, {"three_d"}),
        ([95.0, 95.0, 10.0], 0.1, ALL),
    ],
)
def test_the_next_attempt_begins_with_the_dial_that_the_last_ones_earned(
    totals, dial, views, opened, exercise, settle, monkeypatch
):
    asked = []
    monkeypatch.setattr(index, "totals_of", lambda *what: asked.append(what) or totals)
    opened.conductor.views.panel.set_student("s-7")
    opened.conductor.set_exercise(exercise)
    assert settle(lambda: len(asked) == 1)
    assert settle(lambda: opened.conductor.exercise.assistance == pytest.approx(dial))
    assert {one.value for one in opened.conductor.exercise.shown_views} == views
    assert asked[0][1:] == ("s-7", exercise.id, exercise.version)
    assert opened.conductor.exercise.fading == exercise.fading


@pytest.mark.long("journey")
def test_of_a_student_who_is_signed_in_the_attempts_under_the_own_key_are_looked_up(
    opened, exercise, settle, monkeypatch
):
    asked = []
    monkeypatch.setattr(index, "totals_of", lambda *what: asked.append(what) or [])
    ACCESS.sign_in(Person("p-0123456789ab", "Ada"))
    try:
        opened.conductor.set_exercise(exercise)
        assert settle(lambda: bool(asked))
    finally:
        ACCESS.sign_in(None)
    assert asked[0][1] == "p-0123456789ab"


@pytest.mark.long("journey")
def test_start_waits_until_the_attempts_are_looked_up(opened, exercise, settle, monkeypatch):
    monkeypatch.setattr(index, "totals_of", lambda *_: [])
    waited = []
    monkeypatch.setattr(opened.conductor.controller, "set_waiting", waited.append)
    opened.conductor.set_exercise(exercise)
    assert settle(lambda: len(waited) == 2)
    assert "Start has to wait" in waited[0]
    assert waited[1] == ""


@pytest.mark.long("journey")
def test_without_fading_nothing_is_looked_up(opened, settle, monkeypatch):
    asked = []
    monkeypatch.setattr(index, "totals_of", lambda *what: asked.append(what) or [])
    opened.conductor.set_exercise(load_exercise("first-insertion"))
    settle()
    assert asked == []
    assert ViewName.BULLSEYE in opened.conductor.exercise.views


def test_a_folder_without_records_counts_no_attempts(tmp_path):
    (tmp_path / "sessions").mkdir()
    assert index.totals_of(tmp_path / "sessions", "s-7", "first-insertion", 1) == []
