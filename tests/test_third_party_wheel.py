"""A stranger's wheel adds a machine with all that goes with it; a broken one breaks nothing."""

import json
import os
import shutil
import subprocess
import sys
import sysconfig
import venv
from importlib.util import find_spec
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
SOURCES = Path(__file__).parent / "data" / "third_party"

pytestmark = [
    pytest.mark.long("journey"),
    pytest.mark.timeout(900),
    pytest.mark.skipif(find_spec("hatchling") is None, reason="hatchling is not installed"),
]

PLAY = """
import sys
from pathlib import Path

import numpy as np

from app.compose.cameras import AttachedCameras
from app.compose.trainer import TrainerSetup, _context, build_loop, device_of
from app.compose.exercise_field import trial_plan
from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.exercises.library import load_exercise
from app.exercises.scene import placed_plan_of
from app.session.ct_facts import CtFacts
from app.session.trainer import Trainer
from app.simulation.trainee import ScriptPhase
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.optics.rig import load_rig

exercise, clock = load_exercise("gimbal-lesion"), VirtualClock(50.0)
profile = device_of(exercise)
placed = placed_plan_of(exercise, profile, trial_plan(exercise))
setup = TrainerSetup(exercise, placed, CtFacts("ct-1"), "expert", 3, Path(sys.argv[1]), clock)
loop = build_loop(setup, profile)


def measure(now):
    state = loop.latest()
    tip = placed.p_entry + state.row[sv.PLANT_DEPTH] * state.axis
    pixels = (np.zeros(2), np.zeros(2))
    trainer.on_fix(NeedleFix(tip, 1e-9 * np.eye(3), now, FixStatus.VALID, pixels, 0.0))


context = _context(setup, profile, AttachedCameras((), load_rig(exercise.rig), {}), None)
trainer = Trainer(loop, None, placed, exercise, context, clock, measure, dial=exercise.assistance)
loop.open()
trainer.heartbeat()
trainer.step(300)
trainer.begin("tester")
while clock.now() < 120.0 and trainer.result is None:
    if trainer.step(20).device.row[sv.TRAINEE_PHASE] == ScriptPhase.DONE:
        break
result = trainer.result or trainer.end()
loop.close()
print(Path(result.record).stem)
for row in result.score.rows:
    print(row.name, row.value)
"""
"""An attempt of the scripted expert in virtual time, with its record: its id, and its score."""


class Computer:
    """A new environment with what this one has and the wheel of one third party.

    Attributes:
        python: its interpreter.
        folder: where its programs keep what they write.
    """

    def __init__(self, folder, name):
        source, self.folder = folder / "source", folder
        shutil.copytree(SOURCES / name, source)
        build = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "-o", str(folder)]
        _done([*build, str(source)], folder, os.environ)
        (wheel,) = folder.glob("*.whl")
        venv.create(folder / "env")
        binaries = folder / "env" / ("Scripts" if os.name == "nt" else "bin")
        self.python = str(binaries / "python")
        pip = [sys.executable, "-m", "pip", "--python", self.python, "install", "--quiet"]
        _done([*pip, "--no-index", "--no-deps", str(wheel)], folder, os.environ)
        ask = "import sysconfig; print(sysconfig.get_path('purelib'))"
        packages = Path(_done([self.python, "-c", ask], folder, os.environ).stdout.strip())
        ours = repr(sysconfig.get_path("purelib"))
        packages.joinpath("ours.pth").write_text(f"{ROOT}\nimport site; site.addsitedir({ours})\n")

    def run(self, *words, code=0):
        """Run Python, and return what it printed."""
        own = {f"ACUS_{name.upper()}": str(self.folder / name) for name in ("data", "settings")}
        own |= {"ACUS_SESSIONS": str(self.folder / "sessions"), "QT_QPA_PLATFORM": "offscreen"}
        environment = {name: v for name, v in os.environ.items() if name != "PYTHONPATH"} | own
        return _done([self.python, "-P", *words], self.folder, environment, code).stdout

    def acus(self, *words, code=0):
        """Run a command, and return what it printed."""
        return self.run("-m", "app", *words, code=code)


def _done(command, folder, environment, code=0):
    done = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == code, f"{command}: {done.stdout[-3000:]}{done.stderr[-3000:]}"
    return done


@pytest.fixture(scope="module")
def gimbal(tmp_path_factory):
    return Computer(tmp_path_factory.mktemp("gimbal"), "acus_gimbal")


@pytest.fixture(scope="module")
def broken(tmp_path_factory):
    return Computer(tmp_path_factory.mktemp("broken"), "acus_broken")


def test_what_the_wheel_adds_is_listed(gimbal):
    lines = gimbal.acus("plugin", "list").splitlines()
    for line in (
        "✔ machine gimbal: A gimbal as a machine",
        "✔ device profile bench-gimbal: Two rings over the skin",
        "✔ feature rings: Angles of the rings",
        "✔ exercise gimbal-lesion: Through two rings",
        "✔ study gimbal_inverse: Angles of the rings",
        "✔ effect ring_hum: Hum of the rings",
        "✔ metric widest_turn: Widest turn of the rings",
    ):
        assert any(one.startswith(line) for one in lines), (line, lines)
    assert not any(line.startswith("✖") for line in lines)
    assert "gimbal-lesion" in gimbal.acus("exercise", "list")


def test_an_attempt_with_the_machine_is_recorded_scored_and_replayed_to_the_bit(gimbal):
    (gimbal.folder / "sessions").mkdir(exist_ok=True)
    record, *score = gimbal.run("-c", PLAY, str(gimbal.folder / "sessions")).splitlines()
    values = dict(line.split() for line in score)
    assert 0.0 < float(values["widest_turn"]) < 60.0
    answer = json.loads(gimbal.acus("session", "replay", record, "--check", "--json"))
    assert answer["answer"] is True
    assert answer["facts"]["identical"] is True


def test_the_exercise_says_that_the_effect_of_the_wheel_is_simulated(gimbal):
    facts = json.loads(gimbal.acus("explain", "gimbal-lesion", "--json"))["facts"]
    assert facts["device"] == "bench-gimbal"
    assert "ring_hum" in [one["effect"] for one in facts["simulated"]]
    assert facts["refused"] == []


def test_the_study_of_the_wheel_answers(gimbal):
    facts = json.loads(gimbal.acus("study", "gimbal_inverse", "--quick", "--json"))["facts"]
    assert "closed form" in json.dumps(facts)


def test_the_window_has_the_panel_of_the_wheel_behind_that_of_the_robot(gimbal):
    ask = "from app.views.shell.features import FEATURES; print(*(f.__name__ for f in FEATURES))"
    names = gimbal.run("-c", ask).split()
    assert names[names.index("RobotFeature") + 1] == "RingsFeature"


def test_a_wheel_of_which_nothing_works_breaks_nothing_and_is_named(broken):
    assert "Open the trainer." in broken.acus("--help")
    listed = broken.acus("exercise", "list")
    assert "first-insertion" in listed
    assert "broken-exercise.yaml" in listed
    assert "no-such-device" in listed
    refused = json.loads(broken.acus("plugin", "list", "--json", code=3))["facts"]["plugins"]
    assert all(one["refused"] for one in refused)
    names = {Path(one["file"]).name for one in refused}
    kinds = (
        *("laws", "effects", "metrics", "extractors", "studies", "features", "views"),
        *("demonstrations", "hard_cases", "commands", "comparisons"),
    )
    assert names == {
        *(f"broken_{kind}.py" for kind in kinds),
        *("broken_register.py", "broken_text.py", "crank", "broken-crank.yaml"),
        *("broken-exercise.yaml", "broken-device.yaml", "acus_nowhere"),
    }
    purpose = [one for one in refused if "broken on purpose" in one["refused"]]
    assert len(purpose) >= 10


def test_everything_else_goes_on_beside_a_broken_wheel(broken):
    facts = json.loads(broken.acus("explain", "first-insertion", "--json"))["facts"]
    assert facts["device"] == "icube"
    assert len(facts["refused"]) > 5
    assert "velocity" in broken.acus("study", "list")
    assert "kinematics" in broken.run(
        "-c", "from app.studies.hard import cases; print(cases()[0].subsystem)"
    )
    ask = "from app.views.shell.features import FEATURES; print(*(f.__name__ for f in FEATURES))"
    assert "PeopleFeature" in broken.run("-c", ask)
