"""Touching targets one after the other: what counts as a touch, by what the program can know.

The tip touches a target where the cameras measured it within the target's radius, and go on to do
so for the dwell time. Time is that of the measurements: while a depth is only held, nothing is
added, and where nobody measures it any more, or a measurement lies outside, the dwell begins anew.
So a lost camera touches nothing, and a guess never does. Only the current target can be touched.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import isfinite
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.events import Event
from app.core.units import MILLIMETRE
from app.planning.placement import PlacedPlan
from app.scoring.errors import TrajectoryError
from app.scoring.touches import Touches
from app.session.needle import NeedlePose

if TYPE_CHECKING:
    from app.exercises.touching import TouchTask

KIND: Final = "touch"
"""Kind of the events: one as the attempt begins, then one for each touch."""

FRESH: Final = 1e-6
"""Measurements whose times differ by less are one [s]."""


@dataclass(frozen=True, slots=True, eq=False)
class TouchState:
    """How an attempt stands with its targets.

    Attributes:
        task: what is to be touched.
        touched: how many were, in their order.
        dwelt: for how long the tip has been at the current target, by measurements [s].
    """

    task: TouchTask
    touched: int = 0
    dwelt: float = 0.0

    @property
    def done(self) -> bool:
        """Whether all were touched."""
        return self.touched >= len(self.task)

    @property
    def number(self) -> int:
        """Number of the current target, from 1; of the last one once all were touched."""
        return min(self.touched + 1, len(self.task))

    @property
    def aim(self) -> PlacedPlan:
        """The path to the current target."""
        return self.task.plans[self.number - 1]


class Touching:
    """Judges measurements one after the other; the trainer holds the lock.

    Attributes:
        state: how it stands now.
    """

    def __init__(self, task: TouchTask) -> None:
        self._task = task
        self.begin()

    def begin(self) -> None:
        """Begin an attempt: nothing is touched."""
        self.state = TouchState(self._task)
        self._since: float | None = None
        self._last = -np.inf

    def take(self, p_tip: FloatArray, measured: float | None) -> bool:
        """Take what is known of the tip; returns whether the current target was touched by it.

        Args:
            p_tip: the tip [m], shape (3,).
            measured: when the cameras measured it [s]; None where they do not vouch for it.
        """
        if self.state.done:
            return False
        if measured is None:
            return self._break_off()
        if measured <= self._last + FRESH:
            return False  # the same measurement, held: nothing new is known
        self._last = measured
        away = float(np.linalg.norm(p_tip - self.state.aim.p_target))
        if not away <= self._task.radius:
            return self._break_off()
        if self._since is None:
            self._since = measured
        dwelt = measured - self._since
        if dwelt < self._task.dwell - FRESH:
            self.state = replace(self.state, dwelt=dwelt)
            return False
        self._since = None
        self.state = replace(self.state, touched=self.state.touched + 1, dwelt=0.0)
        return True

    def _break_off(self) -> bool:
        self._since = None
        if self.state.dwelt > 0.0:
            self.state = replace(self.state, dwelt=0.0)
        return False


def measured_at(pose: NeedlePose) -> float | None:
    """When the cameras measured a pose's depth [s]; None where they do not vouch for it."""
    return pose.time - pose.depth_age if pose.measured else None


def begin_words(state: TouchState) -> tuple[str, dict[str, object]]:
    """Words and data of the event with which an attempt begins."""
    task = state.task
    targets = [plan.plan.target_mm.tolist() for plan in task.plans]
    words = f"touch {len(task)} targets in their order" if len(task) > 1 else "touch the target"
    return words, {
        "touched": 0,
        "of": len(task),
        "targets_lps_mm": targets,
        "radius_mm": task.radius / MILLIMETRE,
        "dwell_s": task.dwell,
    }


def touch_words(state: TouchState, pose: NeedlePose) -> tuple[str, dict[str, object]]:
    """Words and data of the event of a touch, which `state` has counted already."""
    task, number = state.task, state.touched
    words = f"target {number} of {len(task)} touched"
    away = float(np.linalg.norm(pose.p_tip - task.plans[number - 1].p_target))
    return words, {
        "touched": number,
        "of": len(task),
        "tip_m": pose.p_tip.tolist(),
        "off_mm": away / MILLIMETRE,
        "measured_ago_s": pose.depth_age,
    }


def touches_of(events: Iterable[Event]) -> Touches | None:
    """Return what was touched by the events of an attempt; None where nothing was to be.

    An event of a damaged record counts as none, and so do those after it.
    """
    of, times = 0, list[float]()
    for event in events:
        if event.kind != KIND:
            continue
        touched, count = _number(event.data, "touched"), _number(event.data, "of")
        if touched == 0 and count is not None:
            of, times = count, []
        elif touched == len(times) + 1 and isfinite(event.time):
            times.append(event.time)
    try:
        return Touches(of, tuple(times)) if of > 0 else None
    except TrajectoryError:
        return Touches(of, ())


def _number(data: Any, name: str) -> int | None:
    value = data.get(name)
    return value if isinstance(value, int) and not isinstance(value, bool) else None
