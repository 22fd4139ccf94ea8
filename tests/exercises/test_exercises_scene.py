import numpy as np
import pytest

from app.compose.declared_views import declared_views
from app.core.errors import ConfigurationError
from app.exercises.library import load_exercise
from app.exercises.parts import PlanPoints
from app.exercises.scene import (
    compile_exercise,
    device_of,
    metric_consumers,
    placed_plan_of,
    plan_of,
    scene_of,
)
from app.exercises.schema import Exercise
from app.planning.plan import Plan
from app.simulation.errors import SimulationError

POINTS = {"entry_mm": (0.0, -90.0, 300.0), "target_mm": (5.0, -20.0, 305.0)}


def exercise(**changes: object) -> Exercise:
    return Exercise.model_validate({"id": "mine", "title": "Mine", "plan": POINTS} | changes)


def fate(name: str, simulated: bool) -> tuple[list[str], dict[str, str]]:
    chosen = load_exercise(name)
    plan = compile_exercise(chosen, device_of(chosen), declared_views(), simulated)
    return sorted(kept.name for kept in plan.kept), {d.name: d.why for d in plan.dropped}


def test_a_plan_given_by_points_is_used_as_it_stands() -> None:
    assert plan_of(exercise()) == Plan(POINTS["entry_mm"], POINTS["target_mm"])  # type: ignore[arg-type]
    assert isinstance(exercise().plan, PlanPoints)


def test_the_placed_plan_starts_at_the_fulcrum_of_the_device() -> None:
    chosen = exercise(placement={"orientation": "prone", "rotation_deg": [5.0, 0.0, 0.0]})
    profile = device_of(chosen)
    placed = placed_plan_of(chosen, profile)
    np.testing.assert_array_equal(placed.p_entry, profile.fulcrum)
    other = placed_plan_of(chosen, profile, plan_of(chosen).with_target((0.0, -50.0, 300.0)))
    assert other.length == pytest.approx(0.040)


def test_the_joint_of_the_exercise_sets_the_tilt_limit() -> None:
    assert device_of(exercise()).tilt_limit_deg == 39.0
    assert device_of(exercise(joint="old")).tilt_limit_deg == 45.0
    with pytest.raises(ConfigurationError, match="valid names: new, old"):
        device_of(exercise(joint="third"))


def test_the_scene_carries_layers_placement_and_needle_in_si() -> None:
    layers = [{"name": "skin", "thickness_mm": 3.0, "side_stiffness_kpa": 60.0}]
    chosen = exercise(layers=layers, placement={"orientation": "left_down"})
    scene = scene_of(chosen, device_of(chosen))
    assert scene.layers[0].thickness == pytest.approx(0.003)
    assert scene.layers[0].side_stiffness == pytest.approx(60e3)
    assert scene.needle.length == 0.200
    np.testing.assert_array_equal(scene.R_world_patient, chosen.placement.placement().rotation)


def test_an_exercise_without_layers_has_those_of_the_simulation() -> None:
    chosen = exercise()
    assert len(scene_of(chosen, device_of(chosen)).layers) > 1


def test_scored_metrics_are_consumers_of_what_they_read() -> None:
    chosen = exercise(tolerances={"depth_error": {"expert": 1, "good": 2, "pass": 3}})
    (consumer,) = metric_consumers(chosen)
    assert consumer.label == "“Depth error” scores it"
    assert "target_shift_x" in consumer.reads


def test_breathing_of_an_organ_that_the_target_is_not_in_is_dropped() -> None:
    effects = {"lateral_tissue": {}, "breathing": {"organ": "lung"}}
    chosen = exercise(effects=effects, target_organ="liver")
    plan = compile_exercise(chosen, device_of(chosen), declared_views())
    assert "lateral_tissue" in {effect.name for effect in plan.kept}
    assert "acts on lung, and the target lies in liver" in plan.dropped[0].why


def test_friction_along_the_needle_is_dropped_on_a_robot_that_cannot_push_that_way() -> None:
    kept, dropped = fate("first-insertion", simulated=False)
    assert kept == ["lateral_tissue"]
    assert "nobody asks for that" in dropped["shaft_friction"]


def test_breathing_is_kept_where_view_and_metrics_consume_it() -> None:
    kept, _ = fate("breathing-liver", simulated=False)
    assert kept == ["breathing", "lateral_tissue"]


def test_breathing_is_dropped_where_neither_hand_nor_view_nor_metric_consumes_it() -> None:
    tolerances = {"planned_target_error": {"expert": 1, "good": 2, "pass": 3}}
    chosen = exercise(effects={"breathing": {"organ": "liver"}}, tolerances=tolerances)
    plan = compile_exercise(chosen, device_of(chosen), declared_views(), simulated=False)
    assert plan.kept == ()
    assert "nobody" in plan.dropped[0].why
    kept, _ = fate("thick-tissue", simulated=False)  # its force gauge shows all along the needle
    along = ["cutting", "puncture", "relaxation", "shaft_friction"]
    assert kept == sorted(["lateral_tissue", *along])


def test_an_unknown_effect_or_parameter_is_refused_with_the_names_that_exist() -> None:
    chosen = exercise(effects={"earthquake": None})
    with pytest.raises(SimulationError, match="no effect 'earthquake'; there are ball_joint"):
        compile_exercise(chosen, device_of(chosen), declared_views())
    chosen = exercise(effects={"breathing": {"parameters": {"speed": 1.0}}})
    with pytest.raises(SimulationError, match=r"no parameter 'speed'; it has .*period"):
        compile_exercise(chosen, device_of(chosen), declared_views())
