"""Steps a commissioning routine beside the window's other work, and keeps what it finds."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QObject, QTimer, Signal

from app.core.errors import AcusError
from app.device.commissioning.records import settle

if TYPE_CHECKING:
    from app.device.commissioning.bench import Bench
    from app.device.commissioning.results import RoutineName, RoutineReport
    from app.device.commissioning.routine import Routine

PERIOD_MS: Final = 10


class Runner(QObject):
    """At most one routine at a time; however it ends, the forces are off.

    Signals:
        reported(Report): what the routine says, at every change.
        kept(Step): a routine ended well and its result is in the record.
        failed(str): why it ended without a result, or why its result could not be kept.
    """

    reported = Signal(object)
    kept = Signal(object)
    failed = Signal(str)

    def __init__(self, bench: Bench, parent: QObject) -> None:
        super().__init__(parent)
        self._bench = bench
        self._routine: Routine | None = None
        self._step: RoutineName | None = None
        self._said: RoutineReport | None = None
        self._timer = QTimer(self, interval=PERIOD_MS)
        self._timer.timeout.connect(self.look)

    @property
    def running(self) -> bool:
        """Whether a routine runs."""
        return self._routine is not None

    def start(self, step: RoutineName) -> None:
        """Begin a routine; one that must not begin yet says why through `failed`."""
        self.cancel()
        try:
            self._routine = self._bench.routine(step)
        except AcusError as error:
            self.failed.emit(str(error))
            return
        self._step, self._said = step, None
        self._timer.start()
        self.look()

    def answer(self, value: float | None = None) -> None:
        """Give what the routine asks for; a refused answer is told and the question stays."""
        if self._routine is None:
            return
        try:
            self._routine.answer(value)
        except AcusError as error:
            self.failed.emit(str(error))

    def cancel(self) -> None:
        """End the routine with the forces off; idempotent."""
        self._timer.stop()
        routine, self._routine = self._routine, None
        if routine is not None:
            routine.cancel()

    def look(self) -> None:
        """Step the routine once."""
        routine = self._routine
        if routine is None:
            return
        try:
            report = routine.step(self._bench.clock.now())
        except AcusError as error:
            self.cancel()
            self.failed.emit(str(error))
            return
        except BaseException:
            self.cancel()
            raise
        if report != self._said:
            self._said = report
            self.reported.emit(report)
        if report.done:
            self._end(report)

    def _end(self, report: RoutineReport) -> None:
        self._timer.stop()
        self._routine = None
        if self._step is None:
            return
        try:
            failure = settle(self._bench, self._step, report)
        except AcusError as error:
            self.failed.emit(str(error))
            return
        if failure:
            self.failed.emit(failure)
        else:
            self.kept.emit(self._step)
