"""When simulated robot and cameras rest, and that the window looks at them less meanwhile."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QCursor

from app.core.errors import AcusError
from app.session.machine import RUNNING, State
from app.session.resting import Resting
from app.session.snapshot import Snapshot
from app.views.exercise.run import ExerciseRun
from app.views.kit.background import run_in_background

UNSEEN_S: Final = 3.0
"""Nobody sees the views of the exercise: they rest after this [s]."""

ENDED_S: Final = 5.0
"""The attempt is over, and nobody has moved the pointer since [s]."""

STILL_S: Final = 20.0
"""Before an attempt, and nobody has moved anything [s]."""

CURSOR_S: Final = 0.25
"""The pointer is asked for this often [s]: the display answers it anew each time."""

SETTLES_S: Final = 0.5
"""After a rest nothing is shown until a picture has told the depth, for this long at most [s]."""


UNMEASURED: Final = 3.0
"""So many times as long before an attempt whose needle no picture has shown yet: it may come."""


def patience(seen: bool, state: State, breathes: bool, measured: bool = True) -> float | None:
    """Return how long nobody must have wanted robot and cameras until they rest [s].

    Args:
        seen: whether the views of the exercise may be seen.
        state: of the attempt.
        breathes: whether the patient breathes: who watches that moves nothing.
        measured: whether the pictures tell the depth.

    Returns:
        None where they never do: an attempt is prepared or runs, or there is something to watch.
    """
    if state in RUNNING:
        return None
    if not seen:
        return UNSEEN_S
    if state in (State.ENDED, State.ABORTED):
        return ENDED_S
    if breathes:
        return None
    return STILL_S if measured else UNMEASURED * STILL_S


class Rester(QObject):
    """Watches one run after the other, by being asked at every poll.

    Attributes:
        seen: asked whether the views of the exercise may be seen.
        watched: asked whether somebody else watches robot and cameras now.

    Signals:
        changed(rests: bool): they began to rest, or run again.
        failed(Exception): they could not be started again.
    """

    changed = Signal(bool)
    failed = Signal(object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.seen: Callable[[], bool] = lambda: True
        self.watched: list[Callable[[], bool]] = []
        self._resting: Resting | None = None
        self._breathes = self._rests = self._asked = self._settles = False
        self._pointer, self._saw, self._looked, self._woke = (0, 0), False, -CURSOR_S, 0.0

    def begin(self, run: ExerciseRun | None) -> None:
        """Serve another run, or none."""
        self._resting = None if run is None else run.resting
        self._breathes = run is not None and run.breathes
        self._asked = self._settles = False
        self._set_rests(False)

    def stir(self) -> None:
        """Have them run from now on: somebody is about to need them."""
        if self._resting is None:
            return
        try:
            self._resting.want()
        except AcusError as error:
            self.failed.emit(error)
            return
        self._set_rests(False)

    def rests(self, snapshot: Snapshot, now: float) -> bool:
        """Return whether there is nothing to be shown: they rest, or have just begun to run.

        Args:
            snapshot: newest.
            now: time of the poll [s].
        """
        resting = self._resting
        if resting is None or not resting.may:
            return False
        if self._is_wanted(now):
            self.stir()
        elif self._rests and not resting.rests:  # somebody else wanted them
            self._set_rests(False)
        if self._rests:
            return True
        if self._settles:
            self._settles, self._woke = False, now
        if now - self._woke < SETTLES_S and not snapshot.pose.measured:
            return snapshot.state not in RUNNING
        measured = snapshot.pose.measured
        self._let_rest(resting, patience(self._saw, snapshot.state, self._breathes, measured))
        return False

    def _let_rest(self, resting: Resting, due: float | None) -> None:
        if due is None or self._asked or resting.unwanted <= due:
            return
        self._asked = True
        run_in_background(
            self,
            lambda _: resting.rest(),
            lambda rests: self._take(resting, rests),
            lambda error: self._take(resting, False, error),
        )

    def _is_wanted(self, now: float) -> bool:
        """Return whether somebody watches, comes back, or has moved the pointer over the views."""
        if 0.0 <= now - self._looked < CURSOR_S and not self._rests:
            return False
        self._looked = now
        seen, saw = self.seen(), self._saw
        place, before = QCursor.pos().toTuple(), self._pointer
        self._saw, self._pointer = seen, place
        if any(watches() for watches in self.watched):
            return True
        return seen and (not saw or place != before)

    def _take(self, resting: Resting, rests: bool, error: Exception | None = None) -> None:
        if resting is not self._resting:
            return
        self._asked = False
        if error is not None:
            self.failed.emit(error)
        self._set_rests(rests and resting.rests)

    def _set_rests(self, rests: bool) -> None:
        if rests != self._rests:
            self._rests, self._settles = rests, not rests
            self.changed.emit(rests)
