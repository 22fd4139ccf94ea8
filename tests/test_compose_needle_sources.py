"""What may stand in for robot and cameras is found by being there, and a record of what is gone is
refused."""

import numpy as np
import pytest

from app.compose.needle_sources import KIND, needle_source, open_preview, recorded_table
from app.exercises.library import load_exercise
from app.exercises.scene import device_of, placed_plan_of
from app.planning.plan import Plan
from app.tracking.errors import TrackingError

FILE = """
DECLARATION = {"title": "A stick", "noun": "a stick"}


def source(pictures):
    return lambda profile: (pictures, profile)


def replay_table(exercise, placed, profile, skill, seed, simulated):
    return skill, seed, simulated
"""
ROBOT = {"name": "icube", "simulated": "yes", "kind": "simulated"}


@pytest.fixture
def stick(monkeypatch, tmp_path):
    monkeypatch.setenv("ACUS_NEEDLE_SOURCES", str(tmp_path))
    (tmp_path / "stick.py").write_text(FILE)


@pytest.fixture
def replayed():
    exercise = load_exercise("first-insertion")
    plan = Plan(np.array([0.0, -100.0, 0.0]), np.array([15.0, -35.0, 10.0]), "test")
    profile = device_of(exercise)
    placed = placed_plan_of(exercise, profile, plan)
    return lambda device: recorded_table({"device": device}, exercise, placed, profile, "novice", 7)


@pytest.mark.usefixtures("stick")
def test_a_file_of_one_s_own_stands_in_for_the_robot_and_replays_its_records(replayed):
    assert KIND.find("stick").noun == "a stick"
    assert needle_source("stick", "usb:1")("icube") == ("usb:1", "icube")
    assert replayed({"name": "stick", "stick": "yes"}) == ("novice", 7, True)
    assert replayed({"name": "stick", "stick": "no"}) == ("novice", 7, False)


@pytest.mark.usefixtures("stick")
def test_what_has_no_page_opens_none():
    with pytest.raises(TrackingError, match=r"stick\.py has no function preview"):
        open_preview("stick", None)


def test_a_source_that_is_not_there_is_refused_with_those_that_are(replayed):
    with pytest.raises(TrackingError, match="no needle source 'stick'; there are"):
        needle_source("stick", "simulated")
    with pytest.raises(TrackingError, match="no needle source 'stick'; there are"):
        replayed({"name": "stick", "stick": "yes"})


def test_the_record_of_a_robot_is_no_source_s_whatever_its_name_is(replayed):
    assert replayed(ROBOT) is None
    assert replayed({**ROBOT, "name": "simulated"}) is None
    assert replayed({}) is None
