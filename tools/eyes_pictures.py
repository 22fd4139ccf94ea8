"""Makes the pictures of cameras, registration and daily check; part of `make docs-pictures`.

`python -m tools.eyes_pictures FOLDER` opens the window in memory on simulated robot and cameras.
"""

import sys
import tempfile
from math import radians
from pathlib import Path

from app.compose.desktop import Desktop
from app.views.checks.feature import ChecksFeature
from app.views.shell.application import start
from app.views.shell.window import MainWindow
from app.views.slices.camera import SliceCamera
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
    seen(window)


def seen(window: MainWindow) -> None:
    """Wait until the cameras have the needle and the status strip says so."""
    run = window.conductor.controller.run

    def well() -> bool:
        if run is None:
            return False
        snapshot = run.trainer.snapshot()
        age = None if snapshot.tracker is None else snapshot.tracker.age
        return snapshot.pose.measured and age is not None and age < 0.5

    pause(1.0)
    wait(well, 120.0)
    pause(0.3)
    wait(well, 120.0)


def tracker(window: MainWindow, folder: Path) -> None:
    """Both pictures with everything that can be drawn over them."""
    window.workspace.show_cameras()
    panel = window.workspace.tracker_panel
    for name in ("mask", "region"):
        panel.set_overlay(name, True)
    seen(window)
    keep(panel, folder / "eyes-tracker.png")


def daily_check(window: MainWindow, folder: Path) -> None:
    """Make the daily check, its point touched by the simulated tip."""
    window.feature(ChecksFeature).open_daily()
    page = window.feature(ChecksFeature).daily
    if page is None:
        raise RuntimeError("the daily check did not open")
    page.move_tip.click()
    pause(3.0)
    page.touch.click()
    wait(lambda: not page.toucher.active, 90.0)
    pause(1.0)
    page.keep.click()
    pause(0.3)
    keep(page, folder / "eyes-daily-check.png")
    page.close()


def registration(window: MainWindow, folder: Path) -> None:
    """All fiducials of the plate touched by the simulated tip; then what students see."""
    window.feature(ChecksFeature).open_registration()
    dialog = window.feature(ChecksFeature).registration
    if dialog is None:
        raise RuntimeError("the registration check did not open")
    for row in range(len(dialog.plate.names)):
        dialog.table.selectRow(row)
        dialog.buttons["move"].click()
        pause(3.0)
        dialog.touch()
        wait(lambda: not dialog.toucher.active, 90.0)
    keep(dialog, folder / "eyes-registration.png")
    dialog.save()
    dialog.close()
    window.view_menu.cursor_to_target()
    pause(2.0)
    for pane in window.workspace.panes:
        canvas = pane.canvas
        if canvas.plane is not None:
            at = canvas.plane.point(window.workspace.viewing.cursor_mm, canvas.index)
            canvas.set_camera(SliceCamera(at.x, at.y, 24.0))
    window.workspace.show_exercise()
    seen(window)
    keep(window, folder / "eyes-agreement.png")


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
            daily_check(window, folder)
            registration(window, folder)
        finally:
            window.editor.saved(Path("kept"))
            window.close()
    application.quit()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
