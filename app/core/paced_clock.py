"""Virtual time that follows the computer's, and waits for whoever has not done his part yet.

In a run where robot, cameras and hand are all simulated, a slow computer must slow the world down,
not drop what it has no time for: the hand that the program leads is judged, not the computer. The
loop lets time pass (`grant`, `advance`); cameras, tracker and trainer each hold it at the moment
by which they have to be done (`TimeHold`). Time never runs faster than the wall's, and what was
lost is not caught up.
"""

import threading
import time
from collections.abc import Callable
from typing import Final

import numpy as np

BEHIND: Final = 0.1
"""Time makes up for no more than this [s] after a pause of the computer."""

BATCH: Final = 0.01
"""So much time passes at once at most [s]: inputs of the hand come in between."""

LEAST: Final = 0.002
"""Shorter stretches are not waited for one by one [s]."""

PATIENCE: Final = 30.0
"""Whoever holds time for longer than this without a word is waited for no more [s, wall]."""

_LOOK: Final = 0.05


class TimeHold:
    """One part's word until when time may go on without it; from its making on it holds nothing."""

    def __init__(self, clock: "PacedClock", name: str) -> None:
        self.name = name
        self._clock = clock
        self.limit = float("inf")

    def until(self, moment: float) -> None:
        """Let time go on to a moment [s] and no farther."""
        self._clock.set_limit(self, moment)

    def release(self) -> None:
        """Hold nothing any more."""
        self._clock.set_limit(self, float("inf"))


class PacedClock:
    """A clock whose time the loop lets pass; all its methods may be called from any thread.

    Args:
        begin: time at first [s]; by default that of the wall.
        wall: the computer's own time [s]; one that runs n times as fast stands for a computer that
            is n times as slow.
    """

    def __init__(
        self, begin: float | None = None, wall: Callable[[], float] = time.monotonic
    ) -> None:
        self._wall = wall
        self._now = wall() if begin is None else begin
        self._offset = wall() - self._now
        self._passing = threading.Condition()
        self._holds: list[TimeHold] = []
        self._runs = False
        self._held_since: float | None = None
        self._lost = 0.0

    def now(self) -> float:
        """Return the time [s]."""
        return self._now

    @property
    def lost(self) -> float:
        """Time of the wall by which this one has fallen behind while it ran [s]."""
        return self._lost

    def sleep(self, duration: float) -> None:
        """Wait until `duration` [s] have passed; while nobody lets time pass, for a moment."""
        self.sleep_until(self._now + duration)

    def sleep_until(self, moment: float) -> None:
        """Wait until a moment [s]; while nobody lets time pass, for an instant at most.

        Whoever holds time until then sleeps so, and not for a duration: between asking how long and
        sleeping time may have come to that moment, and would then wait for him, and he for time.
        """
        with self._passing:
            if not self._runs:
                self._passing.wait(min(max(moment - self._now, 0.0), _LOOK))
            while self._runs and self._now < moment - 1e-9:
                self._passing.wait(_LOOK)

    def wait_for(
        self, condition: threading.Condition, predicate: Callable[[], bool], duration: float
    ) -> bool:
        """Wait, as `Condition.wait_for` does, for at most `duration` [s] of this time."""
        end = self._now + duration
        while not predicate():
            if self._now >= end or not self._runs:
                return condition.wait_for(predicate, 0.0 if self._runs else duration)
            condition.wait(LEAST)
        return True

    # --- who holds time ---------------------------------------------------------------------------
    def hold(self, name: str) -> TimeHold:
        """Return a word of one part's own."""
        hold = TimeHold(self, name)
        with self._passing:
            self._holds.append(hold)
        return hold

    def set_limit(self, hold: TimeHold, moment: float) -> None:
        """Take a part's word; see `TimeHold`."""
        with self._passing:
            if hold.limit <= self._now + LEAST:  # another that is heard says nothing of this one
                self._held_since = None
            hold.limit = moment
            self._passing.notify_all()

    # --- who lets it pass -------------------------------------------------------------------------
    def start(self) -> None:
        """Let time go on from where it stands."""
        with self._passing:
            self._runs, self._held_since = True, None
            self._offset = self._wall() - self._now
            self._passing.notify_all()

    def stop(self) -> None:
        """Let time stand; whoever sleeps wakes."""
        with self._passing:
            self._runs = False
            self._passing.notify_all()

    def grant(self, step: float) -> float:
        """Wait a moment at most; return how much time may pass now [s], 0 for none yet.

        Args:
            step: least time that can pass [s].
        """
        with self._passing:
            limit = min((hold.limit for hold in self._holds), default=float("inf"))
            room = self._room(limit, step)
            may = min(self._due() - self._now, room, BATCH)
            if may + 1e-9 >= max(step, min(LEAST, room)):
                self._held_since = None
                return may + 1e-9
            if room < step:
                self._give_up_on_the_dead()
                self._passing.wait(_LOOK / 10.0)
                return 0.0
        time.sleep(LEAST / 2.0)
        return 0.0

    def advance(self, duration: float) -> None:
        """Let `duration` [s] have passed."""
        with self._passing:
            self._now += duration
            self._passing.notify_all()

    def _room(self, limit: float, step: float) -> float:
        """Return how much time may pass until a limit, in whole steps: the last goes past it."""
        left = limit - self._now - 1e-9
        return left if left > BATCH else max(0.0, float(np.ceil(left / step)) * step)

    def _due(self) -> float:
        """Return where the wall's time would have this one, after what is not made up for."""
        due = self._wall() - self._offset
        lost = due - self._now - BEHIND
        if lost > 0.0:
            self._offset += lost
            self._lost += lost
            due -= lost
        return due

    def _give_up_on_the_dead(self) -> None:
        now = time.monotonic()
        if self._held_since is None:
            self._held_since = now
        elif now - self._held_since > PATIENCE:
            for hold in self._holds:
                if hold.limit <= self._now + LEAST:
                    hold.limit = float("inf")
            self._held_since = None
