"""An effect is added just the way docs/extending.md says: the file on the page, nothing else."""

from pathlib import Path

import numpy as np
import pytest
from extending_page import example

from app.core import state_vector as sv
from app.simulation import effects
from app.simulation.consumers import DevicePort
from app.simulation.effects import declaration, effect_names
from app.simulation.errors import SimulationError
from app.simulation.plan import compile
from app.simulation.scene import EffectRequest, Scene


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(effects, "__path__", [*effects.__path__, str(tmp_path)])
    return tmp_path


def shakes_as_the_page_says() -> None:
    assert "hand_tremor" in effect_names()
    scene = Scene(effects=(EffectRequest("hand_tremor", {"amplitude": 0.3}),))
    plan = compile(scene, DevicePort("icube"))
    assert plan.kept[0].parameters == {"amplitude": 0.3, "frequency": 9.0}
    state = sv.empty_state()
    state[sv.TIME] = 0.01
    for _, function, parameters in plan.stages():
        function(state, parameters)
    assert state[sv.FORCE_X] == pytest.approx(0.3 * np.sin(2.0 * np.pi * 0.09))


@pytest.mark.long("machine")
def test_an_effect_in_the_users_own_folder_is_found_just_the_way_the_page_says(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ACUS_EFFECTS", str(tmp_path))
    name, code = example("How to add an effect")
    (tmp_path / name).write_text(code, encoding="utf-8")
    shakes_as_the_page_says()


@pytest.mark.long("machine")
def test_an_effect_in_a_folder_appended_to_the_path_is_found_too(folder: Path) -> None:
    name, code = example("How to add an effect")
    (folder / name).write_text(code, encoding="utf-8")
    shakes_as_the_page_says()


@pytest.mark.parametrize(
    ("code", "message"),
    [
        ("x = 1\n", "has no DECLARATION"),
        ("DECLARATION = {'title': f()}\n", "is not a literal"),
        ("DECLARATION = {'title': ''}\n", "must have exactly the keys"),
        ("def\n", "cannot be read"),
    ],
)
def test_a_broken_effect_file_is_named(folder: Path, code: str, message: str) -> None:
    (folder / "broken.py").write_text(code, encoding="utf-8")
    with pytest.raises(SimulationError, match=message):
        declaration("broken")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            '("force",)',
            '("force_w",)',
            r"line 16: writes: 'force_w' is not .*near: .*force_x",
        ),
        ("def parameters", "def values", r"has no function parameters\(\)"),
        ("(0.2, ", "('low', [0], ", r"line 23: parameter 'amplitude' is \('low'.* give \{name: "),
        ('("active"', '("free"', r"energy is \('free', .*one of potential, dissipative, active"),
    ],
)
def test_a_wrong_declaration_is_named(folder: Path, old: str, new: str, message: str) -> None:
    name, code = example("How to add an effect")
    assert old in code
    (folder / name).write_text(code.replace(old, new), encoding="utf-8")
    with pytest.raises(SimulationError, match=message):
        declaration("hand_tremor")


@pytest.mark.long("machine")
@pytest.mark.parametrize(
    ("added", "message"),
    [
        ("    state[sv.ENABLED] = 2.0\n", "line 49: step.. writes enabled, which it does not"),
        ("    while state[sv.TIME] > 0.0:\n        pass\n", "in state 0 .* did not return within"),
        ("    p[int(state[sv.TIME])] = 1.0\n", "line 49: step.. raises IndexError"),
        ("    p[7] = 1.0\n", "index 7 is out of bounds for axis 0 with size 2; the state has"),
    ],
)
def test_an_effect_of_somebody_else_that_could_do_harm_is_refused(
    folder: Path, added: str, message: str
) -> None:
    name, code = example("How to add an effect")
    (folder / name).write_text(code + added, encoding="utf-8")
    scene = Scene(effects=(EffectRequest("hand_tremor", {"amplitude": 0.3}),))
    with pytest.raises(SimulationError, match=message):
        compile(scene, DevicePort("icube")).stages()
