"""Collects a touch for a page: looks at the cameras' fixes for a second."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer, Signal

from app.session.checks.facts import TouchFacts
from app.session.touch import DURATION, Touch, TouchCollector, TouchError
from app.views.exercise.run import ExerciseRun
from app.views.kit.text import tr, translated

PERIOD_MS = 15
PATIENCE = 3.0
"""Without enough new fixes the touch ends after so many times its duration."""


class Toucher(QObject):
    """One touch at a time.

    Signals:
        progressed(float): 0…1.
        touched(Touch): a touch is done.
        failed(str): it cannot be used; says why and what to do.
    """

    progressed = Signal(float)
    touched = Signal(object)
    failed = Signal(str)

    def __init__(self, run: Callable[[], ExerciseRun | None], parent: QObject) -> None:
        super().__init__(parent)
        self._run = run
        self._collector = TouchCollector()
        self._left = 0
        self._timer = QTimer(self, interval=PERIOD_MS)
        self._timer.timeout.connect(self._poll)

    @property
    def active(self) -> bool:
        """Return whether a touch is being measured."""
        return self._timer.isActive()

    def start(self) -> None:
        """Begin; a touch that runs begins anew."""
        run = self._run()
        if run is None or run.inspect is None:
            self.failed.emit(tr("No cameras run: choose an exercise and a patient first."))
            return
        self._collector = TouchCollector()
        self._left = int(PATIENCE * DURATION * 1e3 / PERIOD_MS)
        self.progressed.emit(0.0)
        self._timer.start()

    def stop(self) -> None:
        """Give up; idempotent."""
        self._timer.stop()

    def _poll(self) -> None:
        run = self._run()
        fix = run.inspect(False, False).fix if run is not None and run.inspect else None
        if fix is not None:
            self._collector.add(fix)
        self._left -= 1
        self.progressed.emit(self._collector.share)
        if self._collector.share < 1.0 and self._left > 0 and run is not None:
            return
        self._timer.stop()
        try:
            touch: Touch = self._collector.touch()
        except TouchError as error:
            self.failed.emit(translated(error))
        else:
            self.touched.emit(touch)


def move_there(run: ExerciseRun, point: object) -> None:
    """Let the simulated hand bring the tip to a point of the world [m], shape (3,)."""
    import numpy as np

    from app.core.arrays import unit

    way = np.asarray(point, dtype=np.float64) - run.profile.fulcrum
    x, y, _ = unit(way).tolist()
    run.trainer.hand(x, y, float(np.linalg.norm(way)))


def tell_tracker(run: ExerciseRun | None, touch: TouchFacts) -> None:
    """Let the tracker know the depths along the needle: its marker may have slipped."""
    from app.core.arrays import unit

    if run is None or run.touched is None:
        return
    fulcrum = run.profile.fulcrum
    along = unit(touch.p_known - fulcrum)
    measured, known = ((p - fulcrum) @ along for p in (touch.p_measured, touch.p_known))
    run.touched(float(measured), float(known))
