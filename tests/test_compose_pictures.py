"""Effects on pictures from the exercise to the cameras: handed over, or dropped; in a trial."""

import numpy as np
import pytest

from app.compose import trial
from app.compose.effect_models import with_model
from app.compose.exercise_field import trial_plan
from app.compose.explaining import explanation
from app.compose.trainer import pictures_of
from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.exercises.errors import ExerciseError
from app.exercises.library import load_exercise
from app.exercises.parts import EffectPart
from app.exercises.scene import compile_exercise, device_of, placed_plan_of, scene_of
from app.tracking.optics.rig import load_rig
from app.tracking.simulated import picture_effects
from app.tracking.simulated.cameras import simulated_cameras
from app.tracking.simulated.delivery import from_srgb
from app.tracking.simulated.sampled import BOTH, SampledDepth, Spoiled
from app.tracking.simulated.scene import MarkerScene
from tests.layered import layered


def asking(**effects):
    exercise = layered("first-insertion")
    parts = {name: EffectPart(parameters=values) for name, values in effects.items()}
    return exercise.model_copy(update={"effects": parts})


def test_an_exercise_without_them_has_the_pictures_that_its_rig_delivers():
    exercise = load_exercise("first-insertion")
    asked = pictures_of(exercise, device_of(exercise))
    assert {name: values.tolist() for name, values in asked.items()} == {
        "camera_tone": [0.0, 4000.0, 8.0],
        "camera_jpeg": [0.0, 90.0],
    }
    plain = exercise.model_copy(update={"rig": "thesis"})
    assert pictures_of(plain, device_of(plain)).keys() == asked.keys()


def test_an_exercise_can_ask_for_another_delivery():
    part = EffectPart(parameters={"quality": 80.0}, model="4:2:2")
    exercise = load_exercise("first-insertion")
    exercise = exercise.model_copy(update={"effects": {"camera_jpeg": part}})
    asked = pictures_of(exercise, device_of(exercise))
    assert asked["camera_jpeg"].tolist() == [1.0, 80.0]
    assert asked["camera_tone"].tolist() == [0.0, 4000.0, 8.0]


def test_real_cameras_deliver_by_themselves_and_the_loop_computes_nothing_of_it():
    exercise = load_exercise("first-insertion")
    real = compile_exercise(exercise, device_of(exercise), _views(), simulated=False)
    assert real.pictures() == {}
    assert not [one for one in real.dropped if one.name.startswith("camera")]
    simulated = compile_exercise(exercise, device_of(exercise), _views())
    assert not [stage for stage in simulated.stages() if stage.name.startswith("camera")]


def test_what_is_asked_for_reaches_the_cameras_as_light():
    exercise = asking(camera_light={"level": 0.1, "gradient": 0.0, "flicker": 0.0})
    rig, clock = load_rig("wide"), VirtualClock(1.0)
    scene = MarkerScene(np.array([0.0, 0.16, 0.2]), np.array([0.0, 0.0, -1.0]))
    means = []
    for one in (load_exercise("first-insertion"), exercise):
        chain = picture_effects.picture_effects(pictures_of(one, device_of(one)))
        camera, _ = simulated_cameras(rig, lambda _: scene, clock, 1, chain)
        camera.open()
        means.append(float(from_srgb(camera.read().image / 255.0).mean()))
    assert means[1] == pytest.approx(0.1 * means[0], rel=0.1)


def test_a_poisoned_effect_on_pictures_is_never_called_where_it_is_dropped(monkeypatch):
    def poison(*_):
        raise RuntimeError("called")

    monkeypatch.setitem(picture_effects._BY_NAME, "camera_dropout", (poison, poison))
    exercise = asking(camera_dropout={})
    real = compile_exercise(exercise, device_of(exercise), _views(), simulated=False)
    assert picture_effects.picture_effects(real.pictures()) == ()
    with pytest.raises(RuntimeError, match="called"):
        picture_effects.picture_effects(pictures_of(exercise, device_of(exercise)))


def _views():
    from app.compose.declared_views import declared_views

    return declared_views()


@pytest.mark.long("machine")
def test_explain_says_by_whom_they_are_used_and_their_time_for_each_picture():
    exercise = asking(camera_blur={}, ball_joint={})
    found = {one["effect"]: one for one in explanation(exercise)["simulated"]}
    blur, joint = found["camera_blur"], found["ball_joint"]
    assert "the tracker measures in pictures of simulated cameras" in blur["why"]
    assert blur["picture_ns"] > 0.0
    assert min(found[name]["picture_ns"] for name in ("camera_tone", "camera_jpeg")) > 0.0
    assert (blur["cost_ns"], blur["model_costs_ns"]) == (0.0, {})
    assert joint["picture_ns"] is None
    real = explanation(exercise, simulated=False)
    assert "the cameras are real" in {d["effect"]: d["why"] for d in real["dropped"]}["camera_blur"]
    (joint,) = real["simulated"]
    assert any("own joints are felt" in text for text in joint["warnings"])


def test_their_model_cannot_be_changed_while_the_cameras_run():
    with pytest.raises(ExerciseError, match="before the attempt"):
        with_model(asking(camera_blur={}), "camera_blur", "box")


def test_the_scene_knows_the_mounted_joint():
    exercise = load_exercise("first-insertion").model_copy(update={"joint": "old"})
    assert scene_of(exercise, device_of(exercise)).joint == "old"


def test_in_the_loop_a_lost_picture_hides_and_a_dim_one_is_noisier():
    table = np.full((1, 3, 2), 1e-4)
    cameras = SampledDepth(table, 0.05, 1.0, 1 / 30, 0.01, 0, 1.0)

    def seen(spoiled):
        stage, state, times = cameras.stage(3, spoiled), sv.empty_state(), set()
        state[sv.PLANT_DEPTH] = 0.05
        for k in range(30_000):
            state[sv.TIME] = 1.0 + 1e-3 * k
            stage.function(state, stage.parameters)
            times.add(float(state[sv.TRACKED_TIME]))
        return len(times)

    assert BOTH == 0
    clear = seen(None)
    assert seen(Spoiled()) == clear
    half = Spoiled.by({"camera_dropout": np.array([0.0, 0.5, 30.0])}, 0.7)
    # Both have to be lost for a depth to be missing: a quarter, in few long bursts.
    assert 0.5 * clear < seen(half) < 0.9 * clear


@pytest.mark.long("machine")
def test_a_trial_is_what_it_was_without_them_and_another_with_them():
    def score(exercise):
        placed = placed_plan_of(exercise, device_of(exercise), trial_plan(exercise))
        return trial.Trials(exercise, placed).score("competent", 2)

    plain, dim = score(asking()), score(asking(camera_light={"level": 0.35}))
    assert plain.score is not None
    assert dim.score is not None
    assert plain.score.total != dim.score.total
