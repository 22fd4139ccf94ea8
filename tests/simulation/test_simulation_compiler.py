"""The compiler: demand from the consumers, reasons, order, refusals."""

import subprocess
import sys
from pathlib import Path

import pytest

from app.simulation import effects
from app.simulation.bound_field import stand_in
from app.simulation.consumers import Consumer, DevicePort
from app.simulation.effects import declaration, effect_names
from app.simulation.errors import SimulationError
from app.simulation.plan import compile
from app.simulation.scene import Binding, EffectRequest, Scene, TissueLayer
from app.simulation.tissues import tissue_values

ALL = tuple(EffectRequest(n) for n in ("breathing", "shaft_friction", "lateral_tissue"))
REAL = DevicePort("icube")
SIMULATED = DevicePort("icube", simulated=True)
GAUGE = Consumer("view force_gauge shows it", ("axial_force",))
MOTION = Consumer("view target_motion shows it", ("target_shift_x",))


def names(scene: Scene, device: DevicePort, **asked: tuple[Consumer, ...]) -> set[str]:
    return {kept.name for kept in compile(scene, device, **asked).kept}


def test_a_device_that_pushes_sideways_gets_no_axial_friction() -> None:
    plan = compile(Scene(effects=ALL), REAL, views=(Consumer("view axial shows it", ()),))
    assert [kept.name for kept in plan.kept] == ["breathing", "lateral_tissue"]
    assert {d.name for d in plan.dropped} == {"shaft_friction"}
    why = next(d.why for d in plan.dropped if d.name == "shaft_friction")
    assert "the force along the needle" in why
    assert "icube renders lateral force" in why


def test_each_kind_of_consumer_keeps_what_it_reads() -> None:
    scene = Scene(effects=ALL)
    axial = DevicePort("three", frozenset({"lateral", "axial"}))
    assert "shaft_friction" in names(scene, axial)
    assert "shaft_friction" in names(scene, SIMULATED)
    assert "shaft_friction" in names(scene, REAL, views=(GAUGE,))
    assert "breathing" in names(scene, REAL, views=(MOTION,))
    assert "breathing" in names(scene, REAL, scoring=(MOTION,))
    needs = Consumer("metric tip_to_target scores it", ("target_shift_z",))
    assert "breathing" in names(scene, REAL, scoring=(needs,))


def test_a_device_without_force_and_without_views_simulates_nothing() -> None:
    plan = compile(Scene(effects=ALL), DevicePort("pointer", frozenset()))
    assert plan.kept == ()
    assert plan.stages() == []


def test_every_decision_says_why() -> None:
    plan = compile(Scene(effects=ALL), SIMULATED)
    assert all(kept.why.startswith("simulated: ") and kept.consumers for kept in plan.kept)
    assert all(dropped.why.startswith("dropped: ") for dropped in plan.dropped)


def test_an_effect_without_layers_or_on_another_organ_is_dropped() -> None:
    bare = compile(Scene(effects=ALL, layers=()), SIMULATED, views=(MOTION,))
    assert [kept.name for kept in bare.kept] == ["breathing"]
    request = EffectRequest("breathing", organ="liver")
    spine = Scene(effects=(request,), target_organ="spine")
    plan = compile(spine, SIMULATED, views=(MOTION,))
    assert plan.kept == ()
    assert "liver" in plan.dropped[0].why
    assert "spine" in plan.dropped[0].why


@pytest.mark.parametrize(
    ("request_", "message"),
    [
        (EffectRequest("tissue"), "there are ball_joint, bevel, bone_contact, "),
        (EffectRequest("../scene"), "there is no effect"),
        (EffectRequest("breathing", {"perod": 4.0}), "has no parameter 'perod'"),
        (EffectRequest("breathing", {"period": 0.0}), "period is 0.0; give 0.5 to 60 s"),
        (EffectRequest("breathing", {"period": float("nan")}), "period is nan"),
        (EffectRequest("breathing", {"period": True}), "period is True"),
        (EffectRequest("lateral_tissue", model="fem"), "has no model 'fem'; it has beam, winkler"),
    ],
)
def test_what_cannot_be_simulated_is_refused_by_name(request_: EffectRequest, message: str) -> None:
    with pytest.raises(SimulationError, match=message.replace("(", r"\(")):
        compile(Scene(effects=(request_,)), SIMULATED)


def test_an_effect_named_twice_is_refused() -> None:
    with pytest.raises(SimulationError, match="stands twice"):
        Scene(effects=(EffectRequest("breathing"), EffectRequest("breathing")))


def test_a_negative_layer_is_refused() -> None:
    with pytest.raises(SimulationError, match="thickness is -1"):
        TissueLayer("fat", -1.0)


def test_an_unknown_device_axis_is_refused() -> None:
    with pytest.raises(SimulationError, match="known axes are lateral, axial"):
        DevicePort("x", frozenset({"twist"}))


class Asked(dict[str, float]):
    """Parameters that note which of them were asked for."""

    def __init__(self, values: dict[str, float]) -> None:
        super().__init__(values)
        self.names: set[str] = set()

    def __getitem__(self, name: str) -> float:
        self.names.add(name)
        return super().__getitem__(name)


def scene_for(needs: tuple[str, ...]) -> Scene:
    """Return a scene that has what an effect cannot be bound without."""
    if "field" not in needs:
        return Scene()
    bound = stand_in()
    return Scene(tissues=tissue_values(bound.tissue.tissues), field=bound)


@pytest.mark.parametrize("name", effect_names())
def test_what_is_declared_is_what_the_effect_has(name: str) -> None:
    from app.simulation.effects import parameters_of

    declared = declaration(name)
    for parameter in declared.parameters.values():
        assert parameter.minimum <= parameter.default <= parameter.maximum
    asked = Asked(declared.checked({}))
    for model in declared.models:
        parameters_of(name, asked, Binding(scene_for(declared.needs), model=model))
    assert asked.names == set(declared.parameters)


DROPPED = """
import sys
from app.simulation.plan import compile
from app.simulation.consumers import DevicePort
from app.simulation.scene import EffectRequest, Scene

names = ("breathing", "shaft_friction", "lateral_tissue")
asked = tuple(EffectRequest(n, organ="lung" if n == "breathing" else "") for n in names)
scene = Scene(effects=asked, target_organ="liver")
plan = compile(scene, DevicePort("icube"))
compiled = [m for m in sys.modules if m.startswith("app.simulation.effects.")]
stages = [name for name, _, _ in plan.stages()]
loaded = [m for m in sys.modules if m.startswith("app.simulation.effects.")]
print(compiled, stages, loaded)
"""


@pytest.mark.long("machine")
def test_a_dropped_effect_is_not_even_imported() -> None:
    done = subprocess.run(
        [sys.executable, "-c", DROPPED], capture_output=True, text=True, check=True, timeout=110
    )
    assert done.stdout.strip() == (
        "[] ['clear_effects', 'lateral_tissue'] ['app.simulation.effects.lateral_tissue']"
    )


POISONED = """
raise RuntimeError("imported")

def parameters(values, binding):
    raise RuntimeError("asked for its parameters")

def step(state, parameters):
    raise RuntimeError("called")

DECLARATION = {
    "title": "Poison", "reads": (), "writes": ("axial_force",), "consumers": (), "needs": (),
    "models": {"one": "raises"}, "energy": ("active", "a test"), "cost_class": "A",
    "parameters": {"amount": (1.0, "N", 0.0, 2.0, "of poison")},
    "published": {"amount": (0.5, 0.9, "Paracelsus 1538")},
}
"""


@pytest.fixture
def poison(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> EffectRequest:
    (tmp_path / "poison.py").write_text(POISONED)
    monkeypatch.setattr(effects, "__path__", [*effects.__path__, str(tmp_path)])
    return EffectRequest("poison")


def test_a_dropped_effect_that_raises_wherever_it_is_touched_is_never_touched(poison) -> None:
    plan = compile(Scene(effects=(poison, EffectRequest("lateral_tissue"))), REAL)
    assert [dropped.name for dropped in plan.dropped] == ["poison"]
    assert [stage.name for stage in plan.stages()] == ["clear_effects", "lateral_tissue"]
    assert plan.energy_bound() > 0.0
    assert set(plan.warnings()) == {"lateral_tissue"}
    kept = compile(Scene(effects=(poison,)), SIMULATED)
    with pytest.raises(SimulationError, match="poison"):
        kept.stages()


def test_a_value_outside_its_published_range_is_said_with_its_source(poison) -> None:
    (kept,) = compile(Scene(effects=(poison,)), SIMULATED).kept
    assert kept.warnings == ("amount is 1 N; published are 0.5 to 0.9 (Paracelsus 1538)",)
    deep = EffectRequest("breathing", {"superior_inferior": 0.05, "period": 3.0})
    (kept,) = compile(Scene(effects=(deep,)), SIMULATED, views=(MOTION,)).kept
    assert [text.split(";")[0] for text in kept.warnings] == ["superior_inferior is 0.05 m"]


@pytest.mark.parametrize(
    ("row", "words"),
    [
        ('"other": (0.5, 0.9, "a")', "published names 'other', which is no parameter"),
        ('"amount": (0.9, 0.5, "a")', "published 'amount' is"),
        ('"amount": (0.5, 0.9, "")', "published 'amount' is"),
        ('"amount": (0.5, float, "a")', "not a literal"),
    ],
)
def test_a_published_range_that_cannot_be_is_refused_by_line(tmp_path, row, words) -> None:
    path = tmp_path / "poison.py"
    path.write_text(POISONED.replace('"amount": (0.5, 0.9, "Paracelsus 1538")', row))
    with pytest.raises(SimulationError, match=words) as caught:
        effects.KIND.read(path)
    assert "poison.py, line 1" in str(caught.value)


@pytest.mark.parametrize("name", effect_names())
def test_what_an_effect_sets_by_default_is_published(name: str) -> None:
    declared = declaration(name)
    assert declared.unpublished(declared.checked({})) == ()


def test_stages_have_fresh_memory_each_time() -> None:
    plan = compile(Scene(effects=ALL), SIMULATED, views=(MOTION,))
    one, two = plan.stages(), plan.stages()
    assert all(a[2] is not b[2] for a, b in zip(one, two, strict=True))
