"""Touching targets one after the other: what counts as a touch, by what the program can know.

The tip touches a target where the cameras measured it within the target's radius, and go on to do
so for the dwell time. Time is that of the measurements: while a depth is only held, nothing is
added, and where nobody measures it any more, or a measurement lies outside, the dwell begins anew.
So a lost camera touches nothing, and a guess never does. Only the current target can be touched.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
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

TASK: Final = "touch_task"
"""Kind of the event that says what is to be touched, as an attempt begins."""

KIND: Final = "touch"
"""Kind of the events of touches, one each."""

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
        """Return whether all were touched."""
        return self.touched >= len(self.task)

    @property
    def number(self) -> int:
        """Number of the current target, from 1; of the last one once all were touched."""
        return min(self.touched + 1, len(self.task))

    @property
    def aim(self) -> PlacedPlan:
        """The path to the current target."""
        return self.task.plans[self.number - 1]

    @property
    def marks(self) -> TargetMarks:
        """All targets, as they are drawn."""
        return TargetMarks(self.task.points_mm, self.touched)


@dataclass(frozen=True, slots=True, eq=False)
class TargetMarks:
    """Targets as views draw them.

    Attributes:
        points_mm: where they lie, DICOM LPS [mm], shape (n, 3).
        touched: how many were touched, in their order.
    """

    points_mm: FloatArray
    touched: int

    def same(self, other: TargetMarks | None) -> bool:
        """Return whether another one is drawn alike."""
        return (
            other is not None
            and self.touched == other.touched
            and np.array_equal(self.points_mm, other.points_mm)
        )

    @property
    def present(self) -> int:
        """Number of the target to be touched next, from 1; of the last one once all were."""
        return min(self.touched + 1, len(self.points_mm))


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
    """Return when the cameras measured a pose's depth [s]; None where they do not vouch for it."""
    return pose.time - pose.depth_age if pose.measured else None


def begin_words(state: TouchState) -> tuple[str, dict[str, object]]:
    """Words and data of the event with which an attempt begins."""
    task = state.task
    targets = [plan.plan.target_mm.tolist() for plan in task.plans]
    words = f"touch {len(task)} targets in their order" if len(task) > 1 else "touch the target"
    return words, {
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
        if event.kind == TASK:
            of, times = _number(event.data, "of"), []
        elif event.kind == KIND and _number(event.data, "touched") == len(times) + 1:
            times.append(event.time)
    try:
        return Touches(of, tuple(times)) if of > 0 else None
    except TrajectoryError:
        return Touches(of, ())


def marks_at(events: Iterable[Event], time: float) -> TargetMarks | None:
    """Return the targets as they stood at a moment of an attempt [s]; None where there were none.

    Nor where a damaged record does not say where they lie.
    """
    points, touched = np.zeros((0, 3)), 0
    for event in events:
        if event.kind == TASK:
            try:
                points = np.array(event.data["targets_lps_mm"], dtype=np.float64).reshape(-1, 3)
            except (LookupError, TypeError, ValueError):
                return None
        elif event.kind == KIND and event.time <= time:
            touched += 1
    if not len(points) or not np.isfinite(points).all():
        return None
    return TargetMarks(points, min(touched, len(points)))


def radius_of(events: Iterable[Event]) -> float:
    """Radius within which targets were touched [m], by the events; 0 where there were none."""
    for event in events:
        radius = event.data.get("radius_mm")
        if event.kind == TASK and isinstance(radius, int | float) and 0.0 < radius < 1e3:
            return float(radius) * MILLIMETRE
    return 0.0


def _number(data: Any, name: str) -> int:
    """Return a whole number of an event's data; 0 where there is none."""
    value = data.get(name)
    return value if isinstance(value, int) and not isinstance(value, bool) else 0
