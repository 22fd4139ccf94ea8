"""A computer that is too busy for an attempt: the display becomes lighter first, then time slower.

What is measured is how late the window's own looks come, not a guess from the load of the machine.
The hand, the slices and the record need the time more than the 3D view: it stands still, and the
window looks half as often, until the looks have been on time for a while. A display that becomes
full again may be what made the computer late, so each time it was too early the wait is doubled.
"""

from __future__ import annotations

from collections import deque
from typing import Final

LATE_S: Final = 0.030
"""Looks that come so late on the mean make the display lighter [s]: below 22 pictures a second."""

OVER_S: Final = 2.0
"""The mean is over this long [s]: a garbage collection or a dialog is no busy computer."""

CALM_S: Final = 0.008
"""Looks that come no later than this on the mean are on time [s]."""

WAIT_S: Final = 5.0
"""They have been on time for so long when the display becomes full again [s]."""

LONGEST_S: Final = 60.0
"""The same at most, after many times that were too early [s]."""

RELAPSE_S: Final = 20.0
"""Late again so soon after the display was full again: that was too early [s]."""


class BusyWatch:
    """Judges looks one after the other.

    Attributes:
        is_light: whether less is to be drawn now.
    """

    def __init__(self) -> None:
        self.is_light = False
        self._looks: deque[tuple[float, float]] = deque()
        self._calm_since: float | None = None
        self._full_since, self._wait = -RELAPSE_S, WAIT_S

    def begin(self) -> None:
        """Begin another attempt with everything drawn; how long was too early is remembered."""
        self._looks.clear()
        self.is_light, self._calm_since = False, None

    def note(self, now: float, passed: float, period: float) -> None:
        """Judge a look.

        Args:
            now: its time [s].
            passed: since the look before [s].
            period: after which it was due [s].
        """
        looks = self._looks
        looks.append((now, max(0.0, passed - period)))
        while now - looks[0][0] > OVER_S:
            looks.popleft()
        late = sum(late for _, late in looks) / len(looks)
        if not self.is_light:
            if late > LATE_S and now - looks[0][0] > 0.5 * OVER_S:
                self._lighten(now)
        elif late > CALM_S:
            self._calm_since = None
        else:
            self._calm_since = now if self._calm_since is None else self._calm_since
            if now - self._calm_since >= self._wait:
                self.is_light, self._full_since = False, now
                looks.clear()

    def _lighten(self, now: float) -> None:
        relapsed = now - self._full_since < RELAPSE_S
        self._wait = min(2.0 * self._wait, LONGEST_S) if relapsed else WAIT_S
        self.is_light, self._calm_since = True, None
        self._looks.clear()


NOTICED: Final = 0.9
"""From this share of the wall's speed on a slowed world is spoken of: less is not felt."""


class WorldPace:
    """Tells how fast a simulated world goes on, which waits for a busy computer."""

    def __init__(self) -> None:
        self._looks: deque[tuple[float, float]] = deque()
        self._share = 1.0

    def begin(self) -> None:
        """Forget what was; the world is as fast as the wall."""
        self._looks.clear()
        self._share = 1.0

    def note(self, now: float, time: float) -> float:
        """Return the share of the wall's speed over the last seconds, in tenths; 1 for all of it.

        Args:
            now: time of the wall [s].
            time: that of the world [s].
        """
        looks = self._looks
        looks.append((now, time))
        while now - looks[0][0] > OVER_S:
            looks.popleft()
        passed = now - looks[0][0]
        if passed > 0.5 * OVER_S:
            share = (time - looks[0][1]) / passed
            # More than half a tenth, so that the words do not flicker between two shares.
            if abs(share - self._share) > 0.075 or (share > NOTICED) != (self._share > NOTICED):
                self._share = 1.0 if share > NOTICED else max(0.1, round(share, 1))
        return self._share
