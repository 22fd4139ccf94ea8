"""Robot and cameras that are both simulated rest while nobody wants them; real ones never do.

A simulated robot ticks a thousand times a second and two cameras draw thirty pictures: most of a
core, for a needle that nobody looks at. The rule: they rest only where robot and cameras are
simulated and time is the wall's, never while an attempt is prepared or runs, and only as long as
nobody wants them. Whoever moves the hand, gives an order, begins an attempt, changes the plan or
looks at the pictures wants them, and they run again before he is served. With a real robot or real
cameras nothing rests: the loop, its safety and its heartbeat are as they always are.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from app.core.clock import Clock


class Resting:
    """Stops and starts the parts of one trainer; all its methods may be called from any thread.

    Args:
        may: whether they may rest at all.
        clock: of the run.
        needed: whether they may not rest now: an attempt runs, or they were never started.
        stop: stops them; not called while `needed`.
        start: starts them again.

    Attributes:
        may: as given.
    """

    def __init__(
        self,
        may: bool,
        clock: Clock,
        needed: Callable[[], bool],
        stop: Callable[[], None],
        start: Callable[[], None],
    ) -> None:
        self.may = may
        self._clock, self._needed, self._stop, self._start = clock, needed, stop, start
        self._turn = threading.RLock()
        self._rests = self._ended = False
        self._wanted = clock.now()

    @property
    def rests(self) -> bool:
        """Return whether they rest now: what was published last stays as it is."""
        return self._rests

    @property
    def unwanted(self) -> float:
        """Return since when nobody has wanted them [s]."""
        return max(0.0, self._clock.now() - self._wanted)

    def rest(self) -> bool:
        """Let them rest; waits for their threads. Returns whether they do."""
        with self._turn:
            if not self.may or self._ended or self._needed():
                return False
            if not self._rests:
                self._rests = True
                self._stop()
            return True

    def want(self) -> None:
        """Want them: they run when this returns. Takes a moment only where they rested.

        Raises:
            AcusError: whatever keeps one from starting; they rest on then.
        """
        self._wanted = self._clock.now()
        if self._rests:
            with self.awake():
                pass

    @contextmanager
    def awake(self) -> Iterator[None]:
        """Have them run, and keep them from resting until it ends.

        Raises:
            AcusError: whatever keeps one from starting; they rest on then.
        """
        with self._turn:
            self._wanted = self._clock.now()
            if self._rests and not self._ended:
                self._start()
                self._rests = False
            yield

    def end(self) -> None:
        """Neither stop nor start anything any more; waits for whoever does; idempotent."""
        with self._turn:
            self._ended = True
