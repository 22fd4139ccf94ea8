"""Makes the picture of a replay with its ghost: two scripted attempts on the chest CT.

`python -m tools.debrief_pictures FOLDER`; part of `make docs-pictures`. Without the shared data it
says so and makes none.
"""

import os
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from PySide6.QtWidgets import QApplication

from app.compose.desktop import Desktop
from app.compose.trainer import TrainerSetup, build_rig
from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.exercises.library import load_exercise
from app.exercises.scene import device_of, placed_plan_of
from app.imaging.volume import Volume
from app.planning.paths import demonstration_plan
from app.planning.patient import Patient
from app.session.ct_facts import CtFacts
from app.session.store import list_sessions
from app.session.trainer import Trainer
from app.tracking.fix import FixStatus, NeedleFix
from app.views.debrief.feature import DebriefFeature
from app.views.shell.application import start
from app.views.shell.window import MainWindow
from tools.docs_pictures import CHEST

START_S, LONGEST_S, ARRIVED = 100.0, 90.0, 9.0
PATIENCE_S = 300.0


def attempt(volume: Volume, patient: Patient, skill: str, seed: int, sessions: Path) -> None:
    """Let a scripted trainee insert the needle in virtual time, and record it."""
    exercise, clock = load_exercise("thick-tissue"), VirtualClock(START_S)
    plan = demonstration_plan(volume, patient.body)
    placed = placed_plan_of(exercise, device_of(exercise), plan)
    ct = replace(CtFacts.of_volume(volume), digest=volume.digest)
    setup = TrainerSetup(
        exercise, placed, ct=ct, skill=skill, seed=seed, sessions=sessions, clock=clock
    )
    rig = build_rig(setup)

    def measure(now: float) -> None:
        state = rig.loop.latest()
        tip = rig.profile.fulcrum + state.row[sv.PLANT_DEPTH] * state.axis
        pixels = (np.zeros(2), np.zeros(2))
        fix = NeedleFix(tip, 1e-9 * np.eye(3), now, FixStatus.VALID, pixels, 0.0)
        trainer.on_fix(fix)

    context = rig.trainer._context  # noqa: SLF001 - what a record's head says, without cameras
    trainer = Trainer(rig.loop, None, placed, exercise, context, clock, measure)
    rig.loop.open()
    trainer.step()
    trainer.begin("ada")
    while clock.now() < START_S + LONGEST_S:
        device = trainer.step().device
        if device is not None and device.row[sv.TRAINEE_PHASE] == ARRIVED:
            break
    trainer.end()
    rig.loop.close()


def wait(application: QApplication, until: Callable[[], bool]) -> None:
    """Let the window live until something is so.

    Raises:
        TimeoutError: if it never is.
    """
    end = time.monotonic() + PATIENCE_S
    while not until():
        if time.monotonic() > end:
            raise TimeoutError(f"nothing has happened for {PATIENCE_S:g} s")
        application.processEvents()
        time.sleep(0.01)


def main(folder: Path) -> None:
    """Make the picture."""
    if not CHEST.is_dir():
        print(f"no chest CT in {CHEST}: no picture of a replay", file=sys.stderr)
        return
    with tempfile.TemporaryDirectory() as sessions:
        application, window = start(), MainWindow(Desktop(sessions=Path(sessions)))
        window.resize(1366, 768)
        window.show()
        window.open_ct.open_folder(CHEST)
        conductor, page = window.conductor, window.feature(DebriefFeature).page
        wait(application, lambda: conductor.patient is not None)
        wait(application, lambda: window.workspace.scene.surfaces is not None)
        patient = conductor.patient
        if patient is None:
            return
        for seed in (5, 2):
            attempt(patient.volume, patient, "novice", seed, Path(sessions))
        newest = max(list_sessions(Path(sessions)), key=lambda summary: summary.started)
        window.feature(DebriefFeature).sessions.open_requested.emit(newest)
        wait(application, lambda: page.views.has_ct and page.bar.ghost.count() > 2)
        page.bar.along.setCurrentIndex(1)
        page.bar.ghost.setCurrentIndex(2)
        page.bar.by.setCurrentIndex(1)
        page.replayer.seek(0.97 * page.replayer.end)
        end = time.monotonic() + 3.0  # the other attempt is read meanwhile
        wait(application, lambda: page.views.is_settled and time.monotonic() > end)
        window.grab().save(str(folder / "debrief-ghost.png"))
        window.editor.saved(Path("kept"))
        window.close()


if __name__ == "__main__":
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    main(Path(sys.argv[1]))
