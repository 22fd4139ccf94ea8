"""How long the window's thread is held at a time while a patient, an attempt or a debrief opens.

    python -m tests.bench.bench_holds

A timer of 2 ms notes the longest time between two of its turns: whatever else the window's thread
does between them holds it. `computing` is the processor time of that thread in the longest one, and
the figure to compare where the machine is busy with other programs; the goal is 50 ms at a time.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Final

from PySide6.QtCore import QEventLoop, Qt, QTimer

from tests.bench.window_load import Session, pump

GOAL_MS: Final = 50.0


class Holds:
    """Notes how long the window's thread is held."""

    def __init__(self) -> None:
        self._timer = QTimer(interval=2, timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._note)
        self._last = (0.0, 0.0)
        self.wall = self.computing = 0.0
        self.over = 0

    def __enter__(self) -> Holds:
        self._last = (time.perf_counter(), time.thread_time())
        self._timer.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._note()
        self._timer.stop()

    def _note(self) -> None:
        now = (time.perf_counter(), time.thread_time())
        wall, computing = now[0] - self._last[0], now[1] - self._last[1]
        self._last = now
        self.wall, self.computing = max(self.wall, wall), max(self.computing, computing)
        self.over += computing > 1e-3 * GOAL_MS


def run(name: str, begin: Callable[[], object], until: Callable[[], bool], limit: float) -> None:
    """Do one thing in a real event loop and print what it held."""
    with Holds() as holds:
        done: list[bool] = []
        loop = QEventLoop()
        end = time.monotonic() + limit
        check = QTimer(interval=20)

        def ask() -> None:
            if until() or time.monotonic() > end:
                done.append(until())
                loop.quit()

        check.timeout.connect(ask)
        QTimer.singleShot(0, begin)
        QTimer.singleShot(30, check.start)
        started = time.monotonic()
        loop.exec()
    state = "" if done[-1] else "  (did not end in time)"
    print(
        f"{name:34}{1e3 * holds.wall:9.0f}{1e3 * holds.computing:11.0f}{holds.over:7}"
        f"{time.monotonic() - started:9.1f}{state}"
    )


def main() -> None:
    """Open everything once, then once more."""
    session = Session()
    window = session.window
    from app.views.debrief.feature import DebriefFeature

    debrief = window.feature(DebriefFeature)
    pages, controller = window.pages, window.conductor.controller

    def began() -> bool:
        run = controller.run
        return run is not None and run.trainer.snapshot().recording is not None

    print(f"{'longest hold [ms]':34}{'wall':>9}{'computing':>11}{'> 50':>7}{'all [s]':>9}")
    for turn in ("first", "second"):
        run(
            f"patient and exercise, {turn}", lambda: window.begin_exercise("first-insertion"),
            session.tracked, 300.0,
        )  # fmt: skip
        run(
            f"attempt begins, {turn}",
            lambda: controller.begin(""),
            began,
            20.0,
        )
        pump(lambda: False, 2.0)
        run(
            f"attempt ends, debrief, {turn}", controller.end,
            lambda: pages.currentWidget() is debrief.page, 60.0,
        )  # fmt: skip
        run(f"list of sessions, {turn}", debrief.show_sessions, lambda: True, 5.0)
    session.close()


if __name__ == "__main__":
    print(Path(__file__).name)
    main()
