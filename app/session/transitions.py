"""What moves an attempt by itself: the phase that a pose means, and pauses.

Phases have hysteresis, so that noise moves nothing.

Three things pause an attempt. *Cameras*: inside the body no picture has told the depth for `LOST`
seconds; outside the body nothing pauses for it, nor while the marker is still inside the tube.
*Window*: the window has given no sign of life for as long as the loop allows (`HEARTBEAT`): it is
busy or blocked, and nobody sees what the needle does. *Hand*: the loop has cut the force because
the needle moved as if nobody held it, but the simulated hand holds it: its springs let the needle
swing (a hand that is really there says so itself, by a switch that it holds, or ends the attempt).
Forces are off, clock and simulated hand stand still; the attempt goes on where it was once the
cause has been gone for `BACK` seconds without a break.

What the cameras cost the student may void a score (`Rules.maximum_pause`); a busy window and a
simulated hand are the program's own trouble and cost nothing.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Final

from app.core.events import Event as Told
from app.core.messages import sentence
from app.core.staleness import HEARTBEAT
from app.session.machine import IN_BODY, AttemptEvent, State
from app.session.needle import NeedlePose
from app.tracking.fix import FixStatus


@dataclass(frozen=True, slots=True)
class Thresholds:
    """When a phase changes.

    Attributes:
        insert_depth: depth from which the needle counts as inserted [m].
        withdraw_depth: depth below which it counts as withdrawn [m]; the gap to `insert_depth`
            is the hysteresis.
        hold_rate: mean axial speed below which the needle stands still [m/s].
        hold_time: how long it must stand still [s].
        hold_distance: how near to the target the tip must be to count as holding [m].
        move_distance: change of depth that ends a hold [m].
    """

    insert_depth: float = 0.002
    withdraw_depth: float = 0.0
    hold_rate: float = 0.001
    hold_time: float = 1.0
    hold_distance: float = 0.015
    move_distance: float = 0.002


DEFAULT: Final = Thresholds()


@dataclass(frozen=True, slots=True)
class Classifier:
    """What the classifier remembers between poses.

    Attributes:
        window: (time [s], depth [m]) of the poses of the last `hold_time`, oldest first.
        held_depth: depth at which the present hold began [m].
    """

    window: tuple[tuple[float, float], ...] = ()
    held_depth: float = 0.0


def classify(
    memory: Classifier,
    state: State,
    time: float,
    depth: float | None,
    distance: float,
    limits: Thresholds = DEFAULT,
) -> tuple[Classifier, AttemptEvent | None]:
    """Look at the needle at one moment.

    A depth that the cameras do not vouch for moves nothing and breaks a beginning hold. The speed
    is judged as the spread of the depth over the whole window, so that camera noise at one pose
    (0.1 mm in 1/30 s is 3 mm/s) counts for nothing.

    Args:
        memory: what the last call returned.
        state: the attempt's state.
        time: moment of the newest pose [s].
        depth: its depth [m]; None where the cameras do not vouch for it.
        distance: from the tip to the target [m].
        limits: thresholds.

    Returns:
        The new memory, and the event that the pose means, if any.
    """
    if depth is None:
        return replace(memory, window=()), None
    memory = _remember(memory, time, depth, limits)
    if state is State.ALIGNING:
        return memory, AttemptEvent.INSERT if depth > limits.insert_depth else None
    if state not in IN_BODY:
        return memory, None
    if depth < limits.withdraw_depth:
        return Classifier(), AttemptEvent.WITHDRAW
    if state is State.INSERTING:
        return _begin_hold(memory, distance, limits)
    if abs(depth - memory.held_depth) > limits.move_distance:
        return Classifier(), AttemptEvent.INSERT
    return memory, None


def _remember(memory: Classifier, time: float, depth: float, limits: Thresholds) -> Classifier:
    """Append the pose; of those older than the window keep one, so that the window spans it."""
    window = memory.window
    if window and window[-1][0] >= time:  # the clock stood still: the newest counts
        window = window[: bisect_left(window, time, key=_time)]
    window = (*window, (time, depth))
    first = bisect_right(window, time - limits.hold_time + 1e-9, key=_time) - 1
    return replace(memory, window=window[max(first, 0) :])


def _time(entry: tuple[float, float]) -> float:
    return entry[0]


def _begin_hold(
    memory: Classifier, distance: float, limits: Thresholds
) -> tuple[Classifier, AttemptEvent | None]:
    (began, _), (time, depth) = memory.window[0], memory.window[-1]
    spans = time - began >= limits.hold_time - 1e-9
    if not (spans and distance < limits.hold_distance):
        return memory, None
    depths = [depth for _, depth in memory.window]
    if max(depths) - min(depths) < limits.hold_rate * limits.hold_time:
        return replace(memory, held_depth=depth), AttemptEvent.HOLD
    return memory, None


KIND: Final = "pause"
"""Kind of the events that tell of a pause: its beginning, and its end with how long it lasted."""

LOST: Final = 1.0
"""Time without a measured depth in the body until the attempt pauses [s]; the 0.2 s for which a
depth is held are not yet without."""

BACK: Final = 0.5
"""Time for which the cause must be gone until it goes on [s]."""


UNSEEN: Final = frozenset({FixStatus.OUT_OF_VIEW, FixStatus.ONE_CAMERA, FixStatus.INCONSISTENT})
"""What is said of pictures that came in time and do not show the marker as it should be."""


class PauseCause(StrEnum):
    """Why an attempt waits."""

    CAMERAS = "cameras"
    COMPUTER = "computer"
    WINDOW = "window"
    HAND = "hand"


PAUSED_WORDS: Final = {
    PauseCause.CAMERAS: sentence(
        "paused: for a second no picture has told how deep the needle is in the body; forces are "
        "off and the clock stands still; show the marker to the cameras, or let the computer catch "
        "up"
    ),
    PauseCause.COMPUTER: sentence(
        "paused: this computer was too slow to draw what its own simulated cameras see; forces are "
        "off and the clock stands still; close other programs"
    ),
    PauseCause.WINDOW: sentence(
        "paused: the window stood still for a second, as this computer is busy; forces are off and "
        "the clock stands still; close other programs; the attempt goes on by itself"
    ),
    PauseCause.HAND: sentence(
        "paused: the needle swung in the simulated hand as if nobody held it, so its force was "
        "cut; the clock stands still and the attempt goes on by itself"
    ),
}
_UNSEEN_WORDS: Final = sentence(
    "paused: the simulated cameras do not see the needle where it is; forces are off and the clock "
    "stands still; move it back a little"
)


def paused_words(cause: PauseCause, simulated: bool = False) -> str:
    """Say why an attempt waits; nobody can show a marker to `simulated` cameras."""
    return _UNSEEN_WORDS if simulated and cause is PauseCause.CAMERAS else PAUSED_WORDS[cause]


RESUMED_WORDS: Final = {
    PauseCause.CAMERAS: sentence(
        "the cameras see the marker again: the attempt goes on, forces come back; a switch that "
        "must be held has to be pressed again"
    ),
    PauseCause.COMPUTER: sentence(
        "the simulated cameras' pictures come again: the attempt goes on, forces come back; a "
        "switch that must be held has to be pressed again"
    ),
    PauseCause.WINDOW: sentence(
        "the window answers again: the attempt goes on, forces come back; a switch that must be "
        "held has to be pressed again"
    ),
    PauseCause.HAND: sentence(
        "the needle is at rest in the hand: the attempt goes on, forces come back"
    ),
}
_OWN_TROUBLE: Final = (PauseCause.WINDOW, PauseCause.HAND)


class _Watched:
    """One cause: since when it has been there, and since when it has been gone."""

    def __init__(self) -> None:
        self._there: float | None = None
        self._gone: float | None = None

    def note(self, there: bool, gone: bool, now: float) -> None:
        self._there = (now if self._there is None else self._there) if there else None
        self._gone = (now if self._gone is None else self._gone) if gone else None

    def lasts(self, now: float, time: float) -> bool:
        return self._there is not None and now - self._there >= time

    def over(self, now: float) -> bool:
        return self._gone is not None and now - self._gone >= BACK


class Pauses:
    """Watches one attempt.

    Attributes:
        cause: of the present pause, or of the last one; None before the first.
    """

    def __init__(self) -> None:
        self.cause: PauseCause | None = None
        self._watched = {cause: _Watched() for cause in PauseCause}
        self._inside = True
        self._began = 0.0

    def judge(
        self,
        state: State,
        pose: NeedlePose,
        fix_status: str,
        silence: float = 0.0,
        swings: bool = False,
        simulated: bool = False,
    ) -> AttemptEvent | None:
        """Return what a moment means for the attempt, if anything.

        A pose that is not valid is the robot's trouble, and no reason to blame the cameras.
        `silence`: since the window's last sign of life [s]; `swings`: whether the force was cut
        though the simulated hand holds the needle. `simulated` cameras always deliver: pictures
        that do not come, or show the needle as it was too long ago, are the computer's trouble.
        """
        now = pose.time
        blamed = pose.valid and fix_status != FixStatus.NOT_YET_VISIBLE
        cameras = self._watched[PauseCause.CAMERAS]
        cameras.note(not pose.measured and blamed, pose.measured, now)
        self._watched[PauseCause.COMPUTER].note(False, pose.measured, now)
        busy = silence > HEARTBEAT
        own = {PauseCause.WINDOW: busy, PauseCause.HAND: swings}
        for cause, there in own.items():
            self._watched[cause].note(there, not there, now)
        if state is State.PAUSED:
            if self.cause is None or not self._watched[self.cause].over(now):
                return None
            return AttemptEvent.RESUME if self._inside else AttemptEvent.WITHDRAW
        inside = state in IN_BODY
        if inside or state is State.ALIGNING:
            for cause, there in own.items():
                if there:
                    return self._pause(cause, inside, now)
        if inside and cameras.lasts(now, LOST):
            late = simulated and fix_status not in UNSEEN
            cause = PauseCause.COMPUTER if late else PauseCause.CAMERAS
            return self._pause(cause, inside, now)
        return None

    def lasted(self, now: float) -> float:
        """Return how long the present pause has lasted [s]."""
        return max(0.0, now - self._began)

    def _pause(self, cause: PauseCause, inside: bool, now: float) -> AttemptEvent:
        self.cause, self._inside, self._began = cause, inside, now
        return AttemptEvent.PAUSE


def excused(events: Iterable[Told]) -> float:
    """Time that an attempt waited for the program itself [s], from its events."""
    return _waited(events, _OWN_TROUBLE)


def waited_for_computer(events: Iterable[Told]) -> float:
    """Time that an attempt waited for pictures that this computer had to draw [s]."""
    return _waited(events, (PauseCause.COMPUTER,))


def _waited(events: Iterable[Told], causes: Sequence[PauseCause]) -> float:
    total = 0.0
    for event in events:
        duration = event.data.get("duration_s")
        if (
            event.kind == KIND
            and event.data.get("cause") in causes
            and isinstance(duration, int | float)
        ):
            total += max(0.0, float(duration))
    return total
