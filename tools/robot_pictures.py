"""Makes the pictures of the robot in the user guide; part of `make docs-pictures`.

`python -m tools.robot_pictures FOLDER` opens the window in memory, holds the enabling switch of the
simulated robot, looks at its health, and opens the wizard on an emulated board.
"""

import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import radians
from pathlib import Path

from PySide6.QtWidgets import QApplication, QWidget

from app.compose.desktop import Desktop
from app.core.progress import Progress
from app.mechanisms.profile import load_profile
from app.views.exercise.energy_gauge import GaugeMode
from app.views.robot.feature import RobotFeature
from app.views.robot.wizard import CommissioningWizard
from app.views.shell.application import start
from app.views.shell.window import MainWindow

ROOT = Path(__file__).resolve().parents[1]

PATIENCE = 600.0
"""A first start compiles every kernel [s]."""


def wait(until: Callable[[], bool], timeout: float = PATIENCE) -> None:
    """Let the window live until something is so."""
    end = time.monotonic() + timeout
    while not until():
        if time.monotonic() > end:
            raise TimeoutError("the window did not get where the picture is taken")
        QApplication.processEvents()
        time.sleep(0.005)


def pause(seconds: float) -> None:
    """Let the window live for a while."""
    end = time.monotonic() + seconds
    wait(lambda: time.monotonic() > end)


def keep(widget: QWidget, path: Path) -> None:
    """Write a picture of a widget."""
    if not widget.grab().save(str(path)):
        raise OSError(f"cannot write {path}")


def attempt(window: MainWindow, folder: Path) -> None:
    """Push against the simulated robot with the switch held; gauge and health."""
    window.feature(RobotFeature).set_practise_holding(True)
    window.feature(RobotFeature).set_gauge(GaugeMode.SHOWN)
    window.begin_exercise("first-insertion")
    wait(lambda: window.conductor.controller.run is not None)
    wait(lambda: window.conductor.settled)  # surfaces in 3D too
    panel, workspace = window.workspace.exercise_panel, window.workspace
    run = window.conductor.controller.run
    wait(lambda: run is not None and run.trainer.snapshot().pose.measured)
    panel.start_requested.emit("demo")
    pause(0.5)
    panel.enable.pressed.emit()
    panel.assistance.slider.setValue(-40)
    for _ in range(40):
        workspace.bullseye.source.moved.emit(lambda hand: hand.tilt(radians(0.05), 0.0))
        pause(0.05)
    workspace.show_exercise()
    pause(0.3)
    keep(panel, folder / "robot-energy-gauge.png")
    window.feature(RobotFeature).show_health()
    pause(2.0)
    keep(window, folder / "robot-health.png")
    panel.enable.released.emit()
    window.conductor.controller.abort()


@contextmanager
def emulated_board() -> Iterator[str]:
    """Start an emulated robot, parked at its stops, and yield its port."""
    with tempfile.TemporaryDirectory() as folder:
        port = Path(folder) / "robot"
        orders = [
            sys.executable,
            "-m",
            "app",
            "device",
            "emulate",
            "--parked",
            "--link",
            str(port),
            "--serial",
            "A17-0042",
        ]
        with subprocess.Popen(
            orders, cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True
        ) as board:
            try:
                wait(port.exists)
                yield str(port)
            finally:
                board.terminate()


def commissioning(folder: Path) -> None:
    """Begin the homing of an emulated board."""
    with emulated_board() as port:
        bench = Desktop().open_robot(port, load_profile("icube"), Progress())
        wizard = CommissioningWizard(bench)
        try:
            wizard.show()
            wizard.show_page(1)
            wizard.routines[0].start.click()
            wait(wizard.routines[0].confirm.isEnabled, 30.0)
            keep(wizard, folder / "robot-wizard.png")
        finally:
            wizard.close()


def main(folder: Path) -> None:
    """Make them all."""
    application = start(offscreen=True)
    with tempfile.TemporaryDirectory() as sessions:
        window = MainWindow(Desktop(sessions=Path(sessions)))
        window.resize(1400, 900)
        window.show()
        try:
            attempt(window, folder)
        finally:
            window.editor.saved(Path("kept"))
            window.close()
    commissioning(folder)
    application.quit()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
