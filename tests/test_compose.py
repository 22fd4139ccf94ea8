"""The composed trainer in virtual time: the same parts as in the window, without threads."""

import json
from functools import cache

import numpy as np
import pytest

from app.compose.trainer import TrainerSetup, build_loop, build_trainer, device_of, loop_table
from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.exercises.scene import placed_plan_of
from app.planning.placement import PatientOrientation, PlacedPlan, Placement
from app.planning.plan import Plan
from app.session.ct_facts import CtFacts
from app.session.machine import State
from app.session.recording import read_recording
from app.session.trainer import Trainer
from app.tracking.fix import FixStatus, NeedleFix
from tests.layered import layered

PLAN = Plan(np.array([0.0, -100.0, 0.0]), np.array([15.0, -35.0, 10.0]), "test")


def run(skill, exercise="first-insertion", seed=3, assistance=0.7, seconds=60.0, plan=PLAN):
    """A whole attempt on the composed loop, the depth measured without cameras."""
    chosen = layered(exercise)
    profile = device_of(chosen)
    placed = placed_plan_of(chosen, profile, plan)
    clock = VirtualClock(100.0)
    loop = build_loop(TrainerSetup(chosen, placed, skill=skill, seed=seed, clock=clock), profile)

    def measure(now):
        state = loop.latest()
        tip = profile.fulcrum + state.row[sv.PLANT_DEPTH] * state.axis
        pixels = (np.zeros(2), np.zeros(2))
        trainer.on_fix(NeedleFix(tip, 1e-9 * np.eye(3), now, FixStatus.VALID, pixels, 0.0))

    trainer = Trainer(loop, None, placed, chosen, clock=clock, advance=measure, dial=assistance)
    loop.open()
    trainer.step()
    trainer.begin("tester")
    states, felt = [], []
    while clock.now() < 100.0 + seconds:
        snapshot = trainer.step()
        states.append(snapshot.state)
        felt.append(np.linalg.norm(snapshot.device.felt))
        if snapshot.device.row[sv.TRAINEE_PHASE] == 9.0:
            break
    result = trainer.end()
    loop.close()
    return result, states, felt


@cache
def guided(skill):
    """The usual attempt of a skill, which several tests look at."""
    return run(skill)


@pytest.mark.parametrize("skill", ["expert", "novice"])
def test_a_guided_attempt_goes_through_all_states_and_reaches_the_target(skill):
    result, states, felt = guided(skill)
    assert states[0] is State.ALIGNING
    assert {State.ALIGNING, State.INSERTING, State.HOLDING} <= set(states)
    assert result.state is State.ENDED
    assert result.score is not None
    assert result.score.row("lateral_error").value < 5.0
    assert max(felt) <= 5.0 + 1e-9


def test_the_expert_scores_more_than_the_novice():
    assert guided("expert")[0].score.total > guided("novice")[0].score.total


@pytest.mark.long("machine")
def test_the_same_seed_is_the_same_attempt_to_the_last_digit():
    first, again = guided("novice")[0], run("novice")[0]
    np.testing.assert_array_equal(first.trajectory.tip, again.trajectory.tip)
    assert first.score.total == again.score.total


def test_without_guidance_no_force_of_the_fixture_is_felt():
    result = run("expert", assistance=0.0)[0]
    assert np.abs(result.trajectory.guide).max() == 0.0


@pytest.mark.parametrize("exercise", ["against-repulsion", "past-the-vessel"])
def test_a_harder_exercise_can_be_finished_and_its_forces_are_felt(exercise):
    chosen = layered(exercise)
    result, states, felt = run("expert", exercise, assistance=chosen.assistance, plan=None)
    assert {State.ALIGNING, State.INSERTING, State.HOLDING} <= set(states)
    assert result.state is State.ENDED
    assert result.score.passed
    assert np.abs(result.trajectory.guide).max() > 0.1
    assert max(felt) <= 5.0 + 1e-9


def test_breathing_follows_the_way_the_patient_lies():
    exercise = layered("breathing-liver")
    profile = device_of(exercise)
    for orientation, up in ((PatientOrientation.SUPINE, 1.0), (PatientOrientation.PRONE, -1.0)):
        plan = PLAN if up > 0 else Plan(-PLAN.entry_mm, -PLAN.target_mm, "prone")
        placed = PlacedPlan.of(plan, Placement(orientation), profile.fulcrum)
        clock = VirtualClock(100.0)
        loop = build_loop(TrainerSetup(exercise, placed, clock=clock), profile)
        loop.open()
        loop.step(8000)
        shift = loop.rows()[:, sv.TARGET_SHIFT]
        loop.close()
        assert np.ptp(shift[:, 1]) > 5e-3, "head-foot, along world y"
        anterior = shift[np.argmax(np.abs(shift[:, 2])), 2] * up
        assert abs(anterior) > 1e-3, "anterior-posterior, along world z"


def test_the_table_of_a_real_run_has_the_safety_after_all_forces():
    exercise = layered("thick-tissue")
    profile = device_of(exercise)
    placed = placed_plan_of(exercise, profile, PLAN)
    names = [s.name for s in loop_table(TrainerSetup(exercise, placed, skill="novice"), profile)]
    assert names.index("trainee") == 0
    assert names[-2:] == ["safety", "plant"]
    assert names.index("fixture") < names.index("lateral_tissue") < names.index("transmission")


def test_no_record_names_the_folder_or_the_series_of_a_ct(tmp_path):
    exercise = layered("first-insertion")
    ct = exercise.ct.model_copy(
        update={"phantom": None, "folder": tmp_path / "Doe_Jane_19600101", "series": "1.2.840.9"}
    )
    exercise = exercise.model_copy(update={"ct": ct, "plan": "phantom_default"})
    profile = device_of(exercise)
    placed = placed_plan_of(layered("first-insertion"), profile, PLAN)
    trainer = build_trainer(
        TrainerSetup(
            exercise,
            placed,
            ct=CtFacts("ct-1"),
            sessions=tmp_path / "kept",
            clock=VirtualClock(100.0),
        )
    )
    trainer.begin("tester")
    trainer.abort()
    (path,) = (tmp_path / "kept").glob("*.mcap")
    recording = read_recording(path)
    head = repr(recording.metadata) + "".join(
        data.decode() for data in recording.attachments.values()
    )
    assert recording.metadata["ct"] == {"pseudonym": "ct-1"}
    assert json.loads(recording.attachments["exercise.json"])["id"] == exercise.id
    assert "Doe" not in head
    assert "1.2.840.9" not in head
