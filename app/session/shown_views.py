"""What the window may tell and show: by the exercise's views, or nothing but the control scans.

One value decides, at one place. `ExerciseController` asks it for the snapshot that everybody else
gets: where control scans guide, that snapshot holds no pose, no offset, no joint angle and no
force, so whoever watches, now or later, has nothing to give away. Every view asks it whether the
exercise shows it.
"""

from __future__ import annotations

from dataclasses import dataclass, is_dataclass, replace
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray, read_only
from app.device.state import DeviceState
from app.exercises.guidance import GuidanceMode
from app.exercises.parts import TELLING, ViewName
from app.exercises.schema import Exercise
from app.planning.off_path import NOWHERE
from app.planning.placement import PlacedPlan
from app.session.curves import offset
from app.session.machine import State
from app.session.needle import DOWN, NeedlePose
from app.session.snapshot import Snapshot

HARMLESS: Final = (
    sv.ENABLED,
    sv.HEARTBEAT,
    sv.HOMED,
    sv.FORCE_CAP,
    sv.TIME,
    sv.DT,
    sv.TICK,
    sv.LATENESS,
    sv.MISSED,
    sv.TICK_COST,
    sv.INPUT_FAULT,
    sv.LINK_STATUS,
    sv.LINK_REPLIES,
    sv.LINK_ERRORS,
    sv.LINK_LOST,
    sv.ROUND_TRIP,
    sv.BOARD_ERROR,
    sv.Q_TIME,
    sv.SAFETY_SCALE,
    sv.LET_GO_SCALE,
    sv.LET_GO,
    sv.ARMING,
    sv.FAULT,
    sv.BREATH_X,
    sv.BREATH_Y,
    sv.BREATH_Z,
)
"""Slots of the loop's state that tell how robot and patient are, and nothing of where the needle
is: a belt round the body tells the breath in any room.
"""

HIDDEN_STATES: Final = (State.ALIGNING, State.INSERTING, State.HOLDING)
"""States that the program reads from the needle's place; shown as one."""


class _WithoutNeedle:
    """State of the loop without anything about the needle (`device.state.DeviceState`)."""

    def __init__(self, device: DeviceState) -> None:
        row = np.zeros_like(device.row)
        row[list(HARMLESS)] = device.row[list(HARMLESS)]
        self.row: FloatArray = read_only(row)
        self.time, self.tick, self.fault = float(row[sv.TIME]), device.tick, device.fault
        nowhere, nothing = read_only(np.full(3, np.nan)), read_only(np.zeros(3))
        self.axis = self.tip = self.hub = nowhere
        self.force = self.guide = self.felt = nothing
        self.q: FloatArray = read_only(np.full(2, np.nan))
        self.qd = self.torque = read_only(np.zeros(2))
        self.depth = float("nan")
        self.force_measured, self.measured_force = False, 0.0


WITHOUT_NUMBERS: Final = 2
"""From this level on orders say which way, and no longer how far."""

CT_LEADS: Final = 3
"""From this level on nobody orders: the student steers by the CT and by control scans."""


@dataclass(frozen=True, slots=True)
class Shown:
    """What may be told.

    Attributes:
        live: whether the needle is shown while it moves.
        views: what is shown of it; with `live` False none of those that tell.
        orders: whether the line over the views says how to move the needle.
        numbers: whether it says by how much.
    """

    live: bool = True
    views: frozenset[ViewName] = frozenset(ViewName)
    orders: bool = True
    numbers: bool = True

    @classmethod
    def of_exercise(cls, exercise: Exercise) -> Shown:
        """Return what an exercise shows: its views, and by its level what help in words is left.

        Targets that are to be touched keep their words: nothing else says which is the next.
        """
        live = exercise.guidance_mode is GuidanceMode.LIVE
        level = 1 if exercise.touch is not None else exercise.level
        orders, numbers = level < CT_LEADS, level < WITHOUT_NUMBERS
        return cls(live, frozenset(exercise.shown_views), orders, numbers)

    def shows(self, view: ViewName) -> bool:
        """Return whether this view is on."""
        return view in self.views and (self.live or view not in TELLING)

    def of(self, snapshot: Snapshot, placed: PlacedPlan) -> Snapshot:
        """Return the snapshot that may be shown; where the target's motion is not, it is at rest,
        and all distances are to the target at rest.
        """
        if not self.live:
            return without_needle(snapshot)
        rest = snapshot.at_rest(placed)
        if self.shows(ViewName.TARGET_MOTION) or not (snapshot.p_target != rest.p_target).any():
            return snapshot
        still = offset(snapshot.pose, rest.p_target, rest)
        return replace(snapshot, p_target=rest.p_target, offset=still)

    def tells(self, kind: str, state: object) -> bool:
        """Return whether an event of this kind, with this state among its data, may be listed."""
        return self.live or not (kind in ("state", "depth") and state in _TELLING)


_TELLING: Final = (None, State.INSERTING.value, State.HOLDING.value)


def without_needle(snapshot: Snapshot) -> Snapshot:
    """Take everything about the needle, and what follows from it, out of a snapshot."""
    pose = snapshot.pose
    nobody = NeedlePose(
        p_tip=read_only(np.zeros(3)),
        axis=DOWN,
        depth=0.0,
        time=pose.time,
        orientation_age=pose.orientation_age,
        depth_age=pose.depth_age,
        depth_source=pose.depth_source,
        valid=False,
        covariance=read_only(np.zeros((3, 3))),
        reason="control scans only",
    )
    state = State.INSERTING if snapshot.state in HIDDEN_STATES else snapshot.state
    device: Any = None if snapshot.device is None else _WithoutNeedle(snapshot.device)
    tracker = snapshot.tracker
    if is_dataclass(tracker) and not isinstance(tracker, type):
        tracker = replace(tracker, discrepancy="")  # it says by how much the needle is elsewhere
    return replace(
        snapshot,
        state=state,
        phases=MappingProxyType({}),
        pose=nobody,
        measured_pose=None,
        offset=NOWHERE,
        p_target=read_only(np.zeros(3)),
        device=device,
        tracker=tracker,
        messages=(),
    )
