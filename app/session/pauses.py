"""When an attempt pauses because no camera sees the needle, and when it goes on.

Inside the body, a depth that no camera has measured for `LOST` seconds pauses the attempt: forces
off, the clock stands still. It goes on by itself once the depth has been measured for `BACK`
seconds without a break. Outside the body nothing pauses, nor while the marker is still inside the
tube.
"""

from typing import Final

from app.session.machine import Event, State
from app.session.needle import NeedlePose
from app.tracking.fix import FixStatus

LOST: Final = 1.0
"""Time without a measured depth in the body until the attempt pauses [s]; the 0.2 s for which a
depth is held are not yet without."""

BACK: Final = 0.5
"""Time of measured depth until it goes on [s]."""

PAUSED_WORDS: Final = (
    "paused: for a second no picture has told how deep the needle is in the body; forces are off "
    "and the clock stands still; show the marker to the cameras, or let the computer catch up"
)
RESUMED_WORDS: Final = (
    "the cameras see the marker again: the attempt goes on, forces come back; a switch that must "
    "be held has to be pressed again"
)


class Pauses:
    """Watches the depth of one attempt."""

    def __init__(self) -> None:
        self._lost: float | None = None
        self._back: float | None = None

    def look(self, state: State, pose: NeedlePose, fix_status: str) -> Event | None:
        """Return what a pose means for the attempt, if anything.

        A pose that is not valid is the robot's trouble, and no reason to blame the cameras.
        """
        if pose.measured:
            self._lost = None
            self._back = pose.time if self._back is None else self._back
        else:
            self._back = None
            if pose.valid and fix_status != FixStatus.NOT_YET_VISIBLE:
                self._lost = pose.time if self._lost is None else self._lost
            else:
                self._lost = None
        if state is State.PAUSED:
            back = self._back is not None and pose.time - self._back >= BACK
            return Event.RESUME if back else None
        in_body = state in (State.INSERTING, State.HOLDING)
        lost = self._lost is not None and pose.time - self._lost >= LOST
        return Event.PAUSE if in_body and lost else None
