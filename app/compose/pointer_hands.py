"""Two scripted people at the window: one who only drags and wheels, one who plans and checks.

Both see what the screen shows at the exercise's level, a fifth of a second late: the one dot of the
pad, or the needle on the slices, the way left, the order, the breath. They move the hand that mouse
and wheel move (`session.pad.hand`); nothing else is known to them. They are scripts: no
person has been measured against them.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import hypot, inf
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.exercises.parts import ViewName
from app.planning.placement import PlacedPlan
from app.session.pad.hand import PadHand
from app.session.pad.readings import needle_line
from app.session.pad.view import PadScene
from app.session.shown_views import Shown
from app.session.snapshot import NextSteps, Snapshot, StepKind, excursion

LATE: Final = 0.2
"""Time from what happens on the screen to the hand that answers it [s]."""

LOOK: Final = 0.02
"""From one look and movement to the next [s]."""

PAD_PX: Final = 100.0
"""Radius of the pad on the screen [px]."""

CT_PX_MM: Final = 1.0
"""A pixel of the CT on the screen [mm]."""

CLICK_MM: Final = 1.0
FINE_CLICK_MM: Final = 0.2
"""Depth by a click of the wheel, and with the key for fine movements [mm]."""

REMEMBERED: Final = 3.0
"""So far back it is known what was seen [s]."""

DRAG: Final = 1.5
"""Speed of the mouse [radii of the pad in a second]."""


@dataclass(frozen=True, slots=True)
class Sight:
    """The part of the screen that both look at, at one moment; nothing else of the needle.

    Attributes:
        time: moment [s].
        dot: place of the pad's dot, (2,), in radii of the pad: where the needle's line passes the
            target; without a pad, as the slices show it.
        remaining: to the target [mm]: the rail's figure; without it, as the slices show it.
        order: the next step as the line says it, none from the level on where nobody orders.
        rests: whether the breath strip is within its band; true where nothing breathes.
    """

    time: float
    dot: FloatArray
    remaining: float
    order: StepKind
    rests: bool


class Eyes:
    """Reads snapshots as the window shows them."""

    def __init__(
        self, shown: Shown, placed: PlacedPlan, scene: PadScene, steps: NextSteps, gate: float
    ) -> None:
        """`gate`: half width of the breath strip's band [m]."""
        self._shown, self._placed, self._scene = shown, placed, scene
        self._steps, self._gate = steps, gate
        self._figure: float | None = None

    def read(self, snapshot: Snapshot) -> Sight | None:
        """Return what is there to be read; None where no needle is shown."""
        shown = self._shown.of(snapshot, self._placed)
        line = needle_line(shown)
        pad = self._shown.shows(ViewName.BULLSEYE)
        if line is None or not (pad or self._shown.shows(ViewName.LIVE_OVERLAY)):
            return None
        dot, remaining = line.dot(self._scene), line.offset.remaining / MILLIMETRE
        if pad:
            dot = _grid(dot, 1.0 / PAD_PX)
            if line.measured:  # else the rail has no figure: the last one is remembered
                self._figure = round(remaining, 1)
        else:
            dot, self._figure = self._on_slices(dot), CT_PX_MM * round(remaining / CT_PX_MM)
        if self._figure is None:
            return None
        order = self._steps.of(shown, self._shown.live, self._shown.orders).kind
        rests = (excursion(snapshot) or 0.0) <= self._gate
        return Sight(snapshot.time, dot, self._figure, order, rests)

    def _on_slices(self, dot: FloatArray) -> FloatArray:
        """Return the dot where the needle's line passes the target to a pixel of the CT."""
        scale, length_mm = self._scene.scale, self._scene.scale.length / MILLIMETRE
        return scale.place(_grid(scale.tilts(dot) * length_mm, CT_PX_MM) / length_mm)


def _grid(values: FloatArray, step: float) -> FloatArray:
    result: FloatArray = step * np.round(values / step)
    return result


class Desk:
    """Screen and hand of somebody who sits at the window.

    Attributes:
        hand: that mouse and wheel move.
        ring: radius of the innermost ring on the pad.
        hold_breath: tells the patient to hold the breath or to breathe; None where he is not told.
    """

    def __init__(
        self, hand: PadHand, ring: float, hold_breath: Callable[[bool], None] | None
    ) -> None:
        self.hand, self.ring, self.hold_breath = hand, ring, hold_breath
        self._screens: deque[Sight] = deque(maxlen=round(REMEMBERED / LOOK))

    def show(self, screen: Sight | None) -> None:
        """Show the next moment."""
        if screen is not None:
            self._screens.append(screen)

    @property
    def seen(self) -> Sight:
        """Return what is seen now: as it was a fifth of a second ago."""
        latest = self._screens[-1].time
        late = [one for one in self._screens if one.time <= latest - LATE + 1e-9]
        return late[-1] if late else self._screens[0]

    def watched(self, duration: float) -> Sight:
        """Return what was seen on average over a `duration` [s]; the last order."""
        seen = self.seen
        some = [one for one in self._screens if seen.time - duration < one.time <= seen.time]
        return Sight(
            seen.time,
            np.mean([one.dot for one in some], axis=0),
            float(np.mean([one.remaining for one in some])),
            seen.order,
            all(one.rests for one in some),
        )

    @property
    def rested(self) -> float:
        """Return how long the breath has been seen to rest [s]; infinite where it was always so."""
        now = self.seen
        moving = [one.time for one in self._screens if one.time <= now.time and not one.rests]
        return now.time - moving[-1] if moving else inf


Moves = Iterator[None]
"""All that somebody does, one look after the other; he ends the attempt when it is over."""


def _wait(seconds: float) -> Moves:
    for _ in range(round(seconds / LOOK)):
        yield


def _drag(desk: Desk, way: FloatArray) -> Moves:
    pieces = max(1, round(hypot(*way) / (DRAG * LOOK)))
    for _ in range(pieces):
        desk.hand.drag(way / pieces)
        yield


def _wheel(
    desk: Desk, way_mm: float, click_mm: float, looks: int, only_at_rest: bool = False
) -> Moves:
    for _ in range(round(abs(way_mm) / click_mm)):
        if only_at_rest and not desk.seen.rests:
            return
        desk.hand.advance(float(np.copysign(click_mm * MILLIMETRE, way_mm)))
        for _ in range(looks):
            yield


def hasty_hand(desk: Desk) -> Moves:
    """Drag the dot straight to the middle and wheel in until the depth is right: no second look."""
    yield from _wait(0.5)
    for _ in range(4):
        yield from _drag(desk, -desk.seen.dot)
        yield from _wait(0.5)
        if hypot(*desk.seen.dot) <= desk.ring:
            break
    for _ in range(6):
        if desk.seen.order in (StepKind.HOLD, StepKind.FINISH):
            break
        yield from _wheel(desk, desk.seen.remaining, CLICK_MM, 3)
        yield from _wait(0.6)
        if abs(desk.seen.remaining) < 0.5 * CLICK_MM:
            break
    yield from _wait(1.2)


STROKE_MM: Final = 10.0
"""So far the careful hand pushes before it looks again [mm]."""

FRESH: Final = 0.5
"""A rest of the breath that has just begun is not older [s]: there is time to act in it."""


def careful_hand(desk: Desk) -> Moves:
    """Look at the plan, align, and go in by short strokes while the breath rests, each checked."""
    yield from _wait(2.0)
    yield from _align(desk, tries=12)
    for _ in range(60):
        if desk.watched(0.3).remaining <= 1.0:
            break
        yield from _align(desk, tries=1)
        stroke = min(STROKE_MM, desk.watched(0.3).remaining)
        yield from _wheel(desk, stroke, FINE_CLICK_MM, 2, only_at_rest=True)
        yield from _wait(0.5)
    for _ in range(12):
        yield from _align(desk, tries=1)
        yield from _wheel(desk, desk.watched(0.3).remaining, FINE_CLICK_MM, 1, only_at_rest=True)
        yield from _await_breath(desk)
        yield from _wait(0.4)
        seen = desk.watched(0.3)
        if abs(seen.remaining) < 0.6 and hypot(*seen.dot) < desk.ring and seen.rests:
            break


def _align(desk: Desk, tries: int) -> Moves:
    """Bring the dot to the middle by small corrections, each looked at."""
    for _ in range(tries):
        yield from _await_breath(desk)
        yield from _wait(0.3)
        seen = desk.watched(0.3)
        if hypot(*seen.dot) < 0.5 * desk.ring:
            return
        yield from _drag(desk, -0.7 * seen.dot)
        yield from _wait(0.3)


def _await_breath(desk: Desk) -> Moves:
    """Have the breath held where it can be, and wait until it has just come to rest."""
    if desk.hold_breath is not None:
        desk.hold_breath(True)
    for _ in range(round(8.0 / LOOK)):
        if desk.seen.rests and not FRESH < desk.rested < REMEMBERED - LATE - 2.0 * LOOK:
            return
        yield


HANDS: Final[dict[str, Callable[[Desk], Moves]]] = {
    "hasty": hasty_hand,
    "careful": careful_hand,
}
"""Both by name."""
