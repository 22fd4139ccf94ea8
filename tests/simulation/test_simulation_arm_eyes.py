"""The arm's scene before the eyes: found by pictures only, fetched, brought; shown by the demo."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from app.compose.arm import NOISE, cameras, demonstrate, look, pictures, tool_body
from app.core.transform import RigidTransform
from app.simulation.arm import ArmScene, CarryError, CarryFailure, RunningScene
from app.simulation.errors import SimulationError
from app.tracking.simulated.tool import ToolProfile, eyes
from app.tracking.tool.eyes import ToolEyes

ROOT = Path(__file__).resolve().parents[2]
PROFILE = ToolProfile()
MODELS = cameras()
WATCHING = ToolEyes(models=MODELS, outline=PROFILE.outline, noise_grey=NOISE)


def acus(*words, code=""):
    """Run the command line, or lines of code."""
    call = ["-c", code] if code else ["-m", "app", *words]
    return subprocess.run(
        [sys.executable, *call], capture_output=True, text=True, check=False, cwd=ROOT, timeout=250
    )


def test_the_eyes_find_tool_and_trocar_in_the_pictures_of_the_scene():
    found = []
    for seed in range(5):
        scene = ArmScene.seeded(seed, tool_body(PROFILE))
        pair = pictures(scene, scene.T_world_tool, MODELS, PROFILE, seed)
        found.append(look(scene, scene.T_world_tool, pair, WATCHING).errors)
    median = {name: np.median([errors[name] for errors in found]) for name in found[0]}
    assert median["tool_across_mm"] < 1.0
    assert median["tool_along_mm"] < 1.0
    assert median["tool_axis_deg"] < 1.0
    assert median["fulcrum_mm"] < 0.5


def test_pictures_repeat_themselves_and_hold_the_scene():
    scene = ArmScene.seeded(2, tool_body(PROFILE))
    first = pictures(scene, scene.T_world_tool, MODELS, PROFILE, 2)
    again = pictures(scene, scene.T_world_tool, MODELS, PROFILE, 2)
    assert all((a == b).all() for a, b in zip(first, again, strict=True))
    far = RigidTransform(scene.T_world_tool.rotation, np.array([0.0, 3.0, 0.0]))
    other = pictures(scene, far, MODELS, PROFILE, 2)
    with pytest.raises(CarryError, match="no tool: nothing in the tool's colour") as caught:
        look(scene, far, other, WATCHING)
    assert caught.value.failure is CarryFailure.NOT_SEEN


def test_a_tool_in_line_with_both_cameras_is_not_reached_for():
    scene = ArmScene.seeded(24, tool_body(PROFILE))
    beside = eyes(distance=0.9)
    pair = pictures(scene, scene.T_world_tool, beside, PROFILE, 24)
    watching = ToolEyes(models=beside, outline=PROFILE.outline, noise_grey=NOISE)
    with pytest.raises(CarryError, match="move a camera out of its line") as caught:
        look(scene, scene.T_world_tool, pair, watching)
    assert caught.value.failure is CarryFailure.NOT_SEEN


def test_the_tool_is_fetched_and_brought_by_pictures_alone(tmp_path):
    pytest.importorskip("mujoco", reason="needs the extra arm: pip install 'acus[arm]'")
    told = []
    shown = demonstrate(1, tmp_path, told.append)
    assert shown.failure is None, shown.message
    assert [phase.name for phase in shown.phases] == ["approach", "grasp", "lift", "bring"]
    assert shown.phases[-1].errors["axis_from_fulcrum_mm"] < 2.0
    assert shown.phases[-1].errors["axis_deg"] < 3.0
    assert shown.real_time > 0.0
    report = json.loads((tmp_path / "report.json").read_text())
    assert report["note"] == "Simulation only: nothing here drives a real arm."
    names = [phase["name"] for phase in report["phases"]]
    assert names == ["look", "approach", "grasp", "lift", "bring"]
    assert report["failure"] is None
    files = {path.name for path in tmp_path.glob("*.png")}
    assert {"0-look-left.png", "0-look-right.png"} <= files
    if not any(line.startswith("no pictures of the arm") for line in told):
        assert {"1-approach.png", "2-grasp.png", "3-lift.png", "4-bring.png"} <= files
    assert any("times real time" in line for line in told)


def test_the_pictures_of_the_arm_show_it():
    pytest.importorskip("mujoco", reason="needs the extra arm: pip install 'acus[arm]'")
    with RunningScene(ArmScene.seeded(1)) as running:
        try:
            image = running.picture((320, 240))
        except SimulationError as error:
            pytest.skip(str(error))
        running.move(running.scene.home + np.radians([20.0, 30.0, 0.0, 0.0, 0.0, 0.0, 0.0]))
        moved = running.picture((320, 240))
    assert image.shape == (240, 320, 3)
    assert image.std() > 10.0
    assert (np.abs(image.astype(int) - moved).max(axis=2) > 30).mean() > 0.01


def test_without_the_extra_the_command_says_which_to_install():
    code = (
        "import sys; sys.modules['mujoco'] = None;"
        "sys.argv = ['acus', 'demo', '--device', 'arm', '--headless'];"
        "from app.__main__ import main; main()"
    )
    found = acus(code=code)
    assert found.returncode == 2
    assert found.stdout.strip() == "Simulation only: nothing here drives a real arm."
    assert "pip install 'acus[arm]'" in found.stderr
    assert len(found.stderr.strip().splitlines()) == 1


def test_what_the_arm_cannot_show_is_refused():
    found = acus("demo", "--device", "arm", "--pen")
    assert found.returncode == 2
    assert "leave out --pen and --cameras" in found.stderr


def test_an_exercise_without_the_arm_imports_no_package_of_it():
    code = (
        "import sys\n"
        "from app.compose.trial import attempt, trial_plan\n"
        "from app.exercises.library import load_exercise\n"
        "from app.exercises.scene import device_of, placed_plan_of\n"
        "import app.simulation.arm, app.compose.arm\n"
        "one = load_exercise('first-insertion')\n"
        "found = attempt(one, placed_plan_of(one, device_of(one), trial_plan(one)), 'expert', 1)\n"
        "heavy = ('mujoco', 'ompl', 'ruckig', 'pinocchio', 'coal', 'eaik')\n"
        "print(found.score.total > 0, [name for name in heavy if name in sys.modules])"
    )
    found = acus(code=code)
    assert found.stdout.strip() == "True []", found.stderr
