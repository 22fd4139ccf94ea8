"""Makes the pictures of a student's way: start page, briefing, demonstration, tour.

`python -m tools.student_pictures FOLDER`; part of `make docs-pictures`.
"""

import os
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from PySide6.QtWidgets import QApplication

from app.compose.desktop import Desktop
from app.session.machine import State
from app.views.exercise.feature import ExerciseFeature
from app.views.shell.application import start
from app.views.shell.window import MainWindow

PATIENCE_S = 600.0
SIZE = (1366, 768)


def wait(application: QApplication, until: Callable[[], bool]) -> None:
    """Let the window live until something is so."""
    end = time.monotonic() + PATIENCE_S
    while not until():
        if time.monotonic() > end:
            raise TimeoutError("the window did not come so far")
        application.processEvents()
        time.sleep(0.01)


def main(folder: Path) -> None:
    """Make them all."""
    application = start(offscreen=True)
    with tempfile.TemporaryDirectory() as sessions:
        window = MainWindow(Desktop(sessions=Path(sessions)))
        window.resize(*SIZE)
        window.show()

        def keep(name: str) -> None:
            application.processEvents()
            window.grab().save(str(folder / f"student-{name}.png"))

        facts, count = window.start_facts, len(window.start_page.map.places)
        wait(application, lambda: facts.pictured >= count)
        window.start_page.tour.click()
        window.tour.move(2)
        wait(application, lambda: window.conductor.settled)
        keep("tour")
        window.tour.end()
        keep("start")
        window.conductor.exercise_wanted.emit("first-insertion")
        beginning = window.feature(ExerciseFeature).beginning
        wait(application, lambda: beginning.page.isVisible())
        keep("briefing")
        beginning.page.show_me.click()
        controller = window.conductor.controller

        def inserting() -> bool:
            run = controller.run
            if run is None or not run.demonstrates:
                return False
            snapshot = run.trainer.snapshot()
            way = snapshot.offset.remaining / run.placed.length
            return snapshot.state is State.INSERTING and way < 0.6

        wait(application, inserting)
        keep("demonstration")
        beginning.stop()
        wait(application, lambda: not controller.is_running)
        window.close()
    application.processEvents()


if __name__ == "__main__":
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    main(Path(sys.argv[1]))
