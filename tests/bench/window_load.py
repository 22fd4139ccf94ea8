"""The real window, off-screen, for benchmarks: opened, running an exercise, under load."""

import time
from collections.abc import Callable

from PySide6.QtCore import QEventLoop, QTimer
from PySide6.QtWidgets import QApplication

from app.compose.desktop import Desktop
from app.session.needle import DepthSource
from app.views.shell.application import start
from app.views.shell.window import MainWindow
from app.views.slices.panes import PaneId


def pump(until: Callable[[], bool], limit: float) -> bool:
    """Let Qt work until something is so, or the time [s] is up; returns whether it is so."""
    application = QApplication.instance()
    assert application is not None
    end = time.monotonic() + limit
    while not until() and time.monotonic() < end:
        application.processEvents(QEventLoop.ProcessEventsFlag.AllEvents, 20)
        time.sleep(0.001)
    return until()


class Session:
    """A window with an exercise in it.

    Args:
        services: what the window asks for; by default with a scripted hand.
        offscreen: draw into memory, without a display.
    """

    def __init__(self, services: Desktop | None = None, offscreen: bool = True) -> None:
        self.application = start(offscreen)
        self.window = MainWindow(services or Desktop(skill="expert", seed=1))
        self.window.resize(1400, 900)
        self.window.show()
        pump(self.window.isVisible, 5.0)

    def tracked(self) -> bool:
        """Whether robot and cameras run and the needle is measured."""
        run = self.window.conductor.controller.run
        if run is None:
            return False
        return run.trainer.snapshot().pose.depth_source is DepthSource.TRACKED

    def open_exercise(self, limit: float = 300.0) -> None:
        """Open the first exercise and wait until the needle is live."""
        self.window.begin_exercise("first-insertion")
        if not pump(self.tracked, limit):
            raise SystemExit(f"the exercise did not run within {limit:g} s")

    def load(self) -> list[QTimer]:
        """Scroll the axial view and turn the 3D view as fast as the window can."""
        viewing, scene = self.window.workspace.viewing, self.window.workspace.scene
        count = 0

        def scroll() -> None:
            nonlocal count
            count += 1
            viewing.show_slice(PaneId.AXIAL, 20 + count % 200)

        def turn() -> None:
            scene.set_orbit(scene.orbit.turned(3.0, 0.0))

        timers = []
        for action, period in ((scroll, 16), (turn, 30)):
            timer = QTimer(interval=period)
            timer.timeout.connect(action)
            timer.start()
            timers.append(timer)
        return timers

    def close(self) -> None:
        """End everything."""
        self.window.editor.start(None)
        self.window.close()
