"""The simulated hand stands still while an attempt is paused, whatever moves it.

The clock stands in a pause, so a needle that went on would go for nothing. As a pause begins the
hand stays where it is, not where it was wanted; what mouse, wheel, keys, touch, pen, gamepad or a
program ask of it meanwhile is dropped, and nothing of that is made up for afterwards. One pause is
ended by the needle itself: where the cameras do not see it, it may go back to where they last did,
and out, but no deeper than it has been and to no other side.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from app.core import state_vector as sv
from app.device.state import DeviceState
from app.session.inputs import LoopInputs
from app.session.needle import NeedlePose
from app.session.transitions import PauseCause

REMEMBERED: Final = 0.5
"""So far back it is known where the hand was [s]: older than any picture that is still used."""


@dataclass(frozen=True, slots=True)
class HandPlace:
    """Where a hand is: its direction (x, y), its depth [m], and whether it holds the needle."""

    x: float
    y: float
    depth: float
    holds: bool


@dataclass(frozen=True, slots=True)
class _Pinned:
    """The hand in a pause: where it began, where it is, and where the cameras last saw the needle;
    None where nothing may move it.
    """

    began: HandPlace
    at: HandPlace
    seen: HandPlace | None


class StillHand:
    """Passes the hand on to the loop, but for a pause; `follow` has the trainer's lock."""

    def __init__(self, inputs: LoopInputs) -> None:
        self._inputs = inputs
        self._held: _Pinned | None = None
        self._seen: HandPlace | None = None
        self._places: deque[tuple[float, HandPlace]] = deque()

    def move(self, x: float, y: float, depth: float, holds: bool) -> bool:
        """Move the hand to (x, y), depth [m]; returns whether it went there, or part of the way.

        Raises:
            NumericalError: if a value is not finite.
        """
        held, wanted = self._held, HandPlace(x, y, depth, holds)
        if held is None:
            self._write(wanted)
            return True
        if held.seen is None or not np.isfinite((x, y, depth)).all():
            return False
        at = _on_the_way_back(held.began, held.seen, wanted)
        self._held = replace(held, at=at)
        self._write(at)
        return True

    def follow(
        self,
        cause: PauseCause | None,
        device: DeviceState | None,
        pose: NeedlePose,
        simulated: bool,
        away: bool = False,
    ) -> None:
        """Look once: let the hand stand as a pause begins, and obey again once it is over.

        Args:
            cause: of the pause; None while there is none.
            device: as the loop has it now; None where it does not tell.
            pose: of the needle now.
            simulated: whether the hand is a simulated one, whose own place the loop knows.
            away: whether nobody is at the needle: then too the hand stands where it is.
        """
        if cause is None and not away:
            self._held = None
            if device is not None:
                self._remember(pose, _place(device, simulated))
            return
        held = self._held
        if held is None:
            if device is None:
                return
            at = _place(device, simulated)
            seen = (self._seen or at) if cause is PauseCause.CAMERAS else None
            held = self._held = _Pinned(at, at, seen)
        self._write(held.at)  # again and again: somebody may have moved it as the pause began

    def _remember(self, pose: NeedlePose, place: HandPlace) -> None:
        """Keep where the hand was when the cameras took what the depth is measured by."""
        places = self._places
        while places and places[0][0] < pose.time - REMEMBERED:
            places.popleft()
        places.append((pose.time, place))
        if pose.measured:
            taken = pose.time - pose.depth_age
            self._seen = next((one for at, one in reversed(places) if at <= taken), places[0][1])

    def forget(self) -> None:
        """Obey again, with nothing known of where the needle was seen: another attempt."""
        self._held = self._seen = None
        self._places.clear()

    def _write(self, place: HandPlace) -> None:
        self._inputs.hand(place.x, place.y, place.depth, place.holds)


def _place(device: DeviceState, simulated: bool) -> HandPlace:
    """Return where the hand is: by its own motion, or where it is wanted if it has none."""
    wanted = device.row[[sv.HAND_X, sv.HAND_Y, sv.HAND_DEPTH]]
    grip = device.row[[sv.GRIP_X, sv.GRIP_Y, sv.GRIP_DEPTH]]
    x, y, depth = (grip if simulated and np.isfinite(grip).all() else wanted).tolist()
    return HandPlace(x, y, depth, bool(device.row[sv.HAND_HOLDS] > 0.5))


def _on_the_way_back(began: HandPlace, seen: HandPlace, wanted: HandPlace) -> HandPlace:
    """Return the place nearest to `wanted` that leads back to where the needle was last seen."""
    start, way = np.array([began.x, began.y]), np.array([seen.x - began.x, seen.y - began.y])
    length = float(way @ way)
    share = 0.0
    if length > 1e-12:
        share = float(np.clip((np.array([wanted.x, wanted.y]) - start) @ way / length, 0.0, 1.0))
    x, y = (start + share * way).tolist()
    return HandPlace(x, y, min(wanted.depth, max(began.depth, seen.depth)), wanted.holds)
