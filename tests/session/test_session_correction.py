"""The largest turn of a needle in the tissue, and what it would have cost earlier."""

import json
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from app.session.drill_choice import exercise_in
from app.session.recording import open_recording
from app.session.review import correction, review, side_force

MACHINES = Path(__file__).parents[1] / "data" / "records-machines"


def moments(turn_deg, at=0.06, seconds=1.0):
    """Ten seconds from the skin to 80 mm; the needle turns about y once, while it is at a depth."""
    time = np.arange(0.0, 10.0, 0.01)
    depth = 0.008 * time
    share = np.clip((time - at / 0.008) / seconds + 0.5, 0.0, 1.0)
    angle = np.radians(turn_deg) * share
    axis = np.column_stack([np.sin(angle), 0.0 * angle, -np.cos(angle)])
    return SimpleNamespace(time=time, depth=depth, axis=axis), np.ones(len(time), bool)


def test_a_turn_is_found_with_its_depth_and_angle():
    found = correction(*moments(3.0), None)
    assert np.degrees(found.angle) == pytest.approx(3.0, abs=1e-6)
    assert found.depth == pytest.approx(0.06, abs=0.005)
    assert found.earlier == pytest.approx(found.depth / 3.0)
    assert found.share is None


def test_in_even_tissue_a_rigid_needle_takes_the_cube_of_the_depth():
    length = 0.2
    found = correction(*moments(3.0), lambda depth: 2e4 * depth**3 / 3.0 / (length - depth))
    ratio = (1.0 / 27.0) * (length - found.depth) / (length - found.earlier)
    assert found.share == pytest.approx(ratio)


def test_a_hand_that_is_steady_made_no_correction():
    assert correction(*moments(0.8), None) is None


def test_what_turns_slowly_or_before_the_skin_is_none():
    assert correction(*moments(3.0, seconds=9.0), None) is None
    assert correction(*moments(5.0, at=0.003, seconds=0.2), None) is None


def test_a_turn_that_no_camera_vouches_for_is_none():
    samples, measured = moments(3.0)
    measured[samples.depth > 0.05] = False
    assert correction(samples, measured, None) is None


def test_the_force_is_that_of_the_attempts_own_tissue_and_needle():
    recording = open_recording(MACHINES / "icube-fixture-tissue.mcap")
    force = side_force(recording, exercise_in(recording))
    assert force(0.0) == 0.0
    depths = [0.01, 0.02, 0.04, 0.06, 0.09]
    assert np.all(np.diff([force(depth) for depth in depths]) > 0.0)
    softer = json.loads(recording.attachments["exercise.json"])
    softer["effects"]["lateral_tissue"]["parameters"] = {"stiffness_scale": 0.5}
    attachments = dict(recording.attachments) | {"exercise.json": json.dumps(softer).encode()}
    other = SimpleNamespace(attachments=attachments)
    half = side_force(other, exercise_in(other))
    assert 0.4 < half(0.06) / force(0.06) < 0.9  # the needle bends less in softer tissue


def test_without_tissue_or_with_another_versions_exercise_nothing_is_said_of_force():
    recording = open_recording(MACHINES / "haply-2diy-fixture.mcap")
    said = json.loads(recording.attachments["exercise.json"])
    said["effects"].pop("lateral_tissue", None)
    for text in (json.dumps(said).encode(), b"{}", b"[]", b"no json"):
        attachments = dict(recording.attachments) | {"exercise.json": text}
        other = SimpleNamespace(attachments=attachments)
        assert side_force(other, exercise_in(other)) is None
    empty = SimpleNamespace(attachments={})
    assert side_force(empty, exercise_in(empty)) is None


@pytest.mark.long("journey")
def test_every_record_of_the_machines_is_reviewed_with_it():
    for path in sorted(MACHINES.glob("*.mcap")):
        found = review(open_recording(path)).correction
        assert found is None or 0.0 < found.earlier < found.depth
