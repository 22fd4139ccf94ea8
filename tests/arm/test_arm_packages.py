"""Exercises without the arm import none of its packages: each use in a fresh process."""

import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = ("mujoco", "ompl", "ruckig", "pinocchio", "coal", "eaik")

EVERY_MODULE = """
from importlib import import_module
from pkgutil import walk_packages
import app.arm, app.commands, app.compose, app.views
for room in (app.arm, app.commands, app.compose, app.views):
    for module in walk_packages(room.__path__, f"{room.__name__}."):
        import_module(module.name)
"""

EVERY_EXERCISE = """
from app.compose.explaining import explanation
from app.exercises.library import library
from app.exercises.scene import device_of
apart = {}  # one of each machine, kind of task and source of tissue: the others take the same ways
for one in library():
    device = device_of(one)
    apart.setdefault((device.kind, bool(one.touch), one.layers_from), one)
assert len(library()) > 5
assert len(apart) >= 3
for one in apart.values():
    explanation(one)
"""

A_TRIAL = """
from app.compose.exercise_field import trial_plan
from app.compose.trial import attempt
from app.exercises.library import load_exercise
from app.exercises.scene import device_of, placed_plan_of
from app.exercises.tissue import in_layers
one = in_layers(load_exercise("first-insertion"))
placed = placed_plan_of(one, device_of(one), trial_plan(one))
assert attempt(one, placed, "expert", 1).score.total > 0.0
"""

A_TRAINER = """
from pathlib import Path
from app.compose.trainer import CtFacts, TrainerSetup, build_trainer
from app.compose.exercise_field import trial_plan
from app.core.clock import VirtualClock
from app.exercises.library import load_exercise
from app.exercises.scene import device_of, placed_plan_of
from app.exercises.tissue import in_layers
one = in_layers(load_exercise("first-insertion"))
placed = placed_plan_of(one, device_of(one), trial_plan(one))
folder = Path("sessions").absolute()
trainer = build_trainer(
    TrainerSetup(one, placed, ct=CtFacts("ct-1"), sessions=folder, clock=VirtualClock(100.0))
)
trainer.begin("tester")
trainer.abort()
assert any(folder.glob("*.mcap"))
"""

THE_WINDOW = """
from app.compose.desktop import HEAVY_MODULES, Desktop
from app.core.loading import load_modules
from app.core.progress import Progress
from app.views.shell.application import start
from app.views.shell.window import MainWindow
application = start(offscreen=True)
load_modules(HEAVY_MODULES, Progress())
window = MainWindow(Desktop())
window.show()
application.processEvents()
"""

COMMANDS = """
from app.__main__ import main
for words in (["explain", "first-insertion"], ["study", "list"], ["exercise", "list"], ["--help"]):
    sys.argv = ["acus", *words]
    try:
        main()
    except SystemExit as ended:
        assert not ended.code, words
"""

USES = {
    "every module of window, commands and arm": EVERY_MODULE,
    "every exercise loaded and explained": EVERY_EXERCISE,
    "a trial": A_TRIAL,
    "a trainer": A_TRAINER,
    "the window": THE_WINDOW,
    "commands": COMMANDS,
}


def imported(code, folder):
    """Packages of the arm that a fresh process has imported after some lines."""
    told = (
        f"print('imported:', *sorted({{n.split('.')[0] for n in sys.modules}} & {set(PACKAGES)}))"
    )
    environment = os.environ | {
        "ACUS_SETTINGS": str(folder),
        "QT_QPA_PLATFORM": "offscreen",
        "PYTHONPATH": str(ROOT),
    }
    found = subprocess.run(
        [sys.executable, "-c", f"import sys\n{code}\n{told}"],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        cwd=folder,
        timeout=250,
    )
    assert found.returncode == 0, found.stderr
    return found.stdout.splitlines()[-1].removeprefix("imported:").split()


@pytest.mark.long("journey")
@pytest.mark.parametrize("code", USES.values(), ids=USES)
def test_it_imports_none_of_them(code, tmp_path):
    assert imported(code, tmp_path) == []


@pytest.mark.long("journey")
@pytest.mark.parametrize("package", [one for one in PACKAGES if find_spec(one)])
def test_one_that_is_imported_is_told(package, tmp_path):
    assert package in imported(f"import {package}", tmp_path)
