"""Makes the pictures of cameras, registration and morning check; part of `make docs-pictures`.

`python -m tools.eyes_pictures FOLDER` opens the window in memory on simulated robot and cameras.
"""

import sys
import tempfile
from math import radians
from pathlib import Path

from app.compose import Desktop
from app.views.application import start
from app.views.window import MainWindow
from tools.robot_pictures import keep, pause, wait


def running(window: MainWindow) -> None:
    """Begin an exercise and push the needle in by 50 mm, tilted a little."""
    window.begin_exercise("first-insertion")
    wait(lambda: window.conductor.controller.run is not None)
    run = window.conductor.controller.run
    wait(lambda: run is not None and run.trainer.snapshot().pose.valid)
    source = window.workspace.bullseye.source
    for _ in range(30):
        source.moved.emit(lambda hand: hand.advance(0.0022))
        source.moved.emit(lambda hand: hand.tilt(radians(0.2), radians(0.1)))
        pause(0.05)
    pause(1.0)


def tracker(window: MainWindow, folder: Path) -> None:
    """Both pictures with everything that can be drawn over them."""
    window.workspace.show_cameras()
    panel = window.workspace.tracker_panel
    for name in ("mask", "region"):
        panel.set_overlay(name, True)
    pause(1.0)
    keep(window, folder / "eyes-cameras.png")
    keep(panel, folder / "eyes-tracker.png")


def main(folder: Path) -> None:
    """Make them all."""
    application = start(offscreen=True)
    with tempfile.TemporaryDirectory() as sessions:
        window = MainWindow(Desktop(sessions=Path(sessions)))
        window.resize(1366, 768)
        window.show()
        try:
            running(window)
            tracker(window, folder)
        finally:
            window.editor.saved(Path("kept"))
            window.close()
    application.quit()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
