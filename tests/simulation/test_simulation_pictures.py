"""Effects on camera pictures: kept where simulated cameras are, and never part of the tick."""

import subprocess
import sys

import pytest

from app.simulation import effects
from app.simulation.consumers import DevicePort
from app.simulation.effects import declaration, effect_names
from app.simulation.errors import SimulationError
from app.simulation.plan import compile
from app.simulation.scene import EffectRequest, Scene

NAMES = tuple(name for name in effect_names() if declaration(name).pictures)
SIMULATED = DevicePort("icube", simulated=True)
REAL = DevicePort("icube")


def scene(*more: str) -> Scene:
    return Scene(effects=tuple(EffectRequest(name) for name in (*NAMES, *more)))


def test_there_are_five_with_a_choice_of_models_each() -> None:
    assert NAMES == ("camera_blur", "camera_dropout", "camera_jpeg", "camera_light", "camera_tone")
    assert all(len(declaration(name).models) >= 2 for name in NAMES)


def test_the_tracker_in_simulated_pictures_consumes_them_and_nothing_is_in_the_tick() -> None:
    plan = compile(scene(), SIMULATED)
    assert [kept.name for kept in plan.kept] == list(NAMES)
    assert all("the tracker measures in pictures" in kept.why for kept in plan.kept)
    assert plan.stages() == []
    assert plan.energy_bound() == 0.0
    assert set(plan.warnings()) == set(NAMES)
    together = compile(scene("lateral_tissue"), SIMULATED)
    assert [stage.name for stage in together.stages()] == ["clear_effects", "lateral_tissue"]


def test_of_real_cameras_they_are_dropped_with_the_reason() -> None:
    plan = compile(scene(), REAL)
    assert plan.kept == ()
    assert plan.pictures() == {}
    assert all("the cameras are real" in dropped.why for dropped in plan.dropped)


def test_a_real_robot_before_simulated_cameras_keeps_them() -> None:
    plan = compile(scene(), DevicePort("icube", pictures=True))
    assert [kept.name for kept in plan.kept] == list(NAMES)


def test_their_parameters_are_the_models_number_and_the_declared_ones_in_order() -> None:
    asked = EffectRequest("camera_dropout", {"share": 0.2}, "single")
    arrays = compile(Scene(effects=(asked,)), SIMULATED).pictures()
    assert arrays["camera_dropout"].tolist() == [1.0, 0.2, 6.0]


CODE = """
import sys
from app.simulation.plan import compile
from app.simulation.consumers import DevicePort
from app.simulation.scene import EffectRequest, Scene

names = ("camera_blur", "camera_dropout", "camera_light", "lateral_tissue")
plan = compile(Scene(effects=tuple(map(EffectRequest, names))), DevicePort("x", pictures=True))
plan.stages(), plan.pictures()
print([m for m in sys.modules if "camera" in m or "cv2" in m])
"""


@pytest.mark.long("statistics")
def test_the_simulation_imports_neither_them_nor_opencv() -> None:
    done = subprocess.run(
        [sys.executable, "-c", CODE], capture_output=True, text=True, check=True, timeout=110
    )
    assert done.stdout.strip() == "[]"


OTHERS = """
DECLARATION = {
    "title": "Fog", "pictures": True, "reads": (), "writes": (), "consumers": (), "needs": (),
    "models": {"one": "grey"}, "energy": ("dissipative", "none"), "cost_class": "C",
    "parameters": {},
}
"""


def test_a_file_that_is_not_the_programs_own_cannot_act_on_pictures(tmp_path, monkeypatch) -> None:
    (tmp_path / "fog.py").write_text(OTHERS)
    monkeypatch.setattr(effects, "__path__", [*effects.__path__, str(tmp_path)])
    assert "only the program's own" in effects.refused()[tmp_path / "fog.py"]
    (tmp_path / "fog.py").write_text(OTHERS.replace('"pictures": True,', ""))
    with pytest.raises(SimulationError, match="no function"):
        declaration("fog")
