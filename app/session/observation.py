"""Robot and cameras as one tick of the trainer sees them, gathered once and used by all."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf
from typing import TYPE_CHECKING, Final

import numpy as np

from app.core import state_vector as slots
from app.core.arrays import FloatArray, read_only
from app.core.events import Event, EventQueue
from app.core.messages import sentence
from app.device.faults import Fault
from app.device.state import DeviceState
from app.planning.off_path import Offset
from app.planning.placement import PlacedPlan
from app.session.curves import offset
from app.session.errors import NotReadyError
from app.session.fixes import TRUST, DepthTrust, Fixes
from app.session.fusion import fuse, moment, predicted
from app.session.inputs import LoopInputs
from app.session.machine import State
from app.session.needle import DOWN, DepthSource, NeedlePose
from app.session.sample import Sample
from app.session.snapshot import BreathHold
from app.simulation.scene import SETTLING
from app.tracking.fix import NeedleFix

if TYPE_CHECKING:
    from app.device.control.loop import Loop
    from app.device.control.timing import Timing
    from app.tracking.needle_tracker import NeedleTracker
    from app.tracking.statistics import TrackerStatistics


STILL: Final = 0.1
"""A target that has not moved at all for this long rests [s]; a breathing one always moves."""

LOOP_LIMIT: Final = 0.5
"""Age of the loop's newest state [s] from which the loop counts as dead."""

SILENCE: Final = 1.0
"""A robot that has not answered for this long [s] ends the attempt; shorter silence only takes the
force away until the person lets go and arms again."""

GRACE: Final = 0.1
"""A fault left over from before arming is forgiven this long after the beginning [s]."""


@dataclass(frozen=True, slots=True, eq=False)
class Observation:
    """One look at robot and cameras.

    Attributes:
        time: moment [s].
        pose: fused pose, as measured: it is recorded and scored.
        offset: from the tip to the target.
        p_target: target now, with its motion [m], shape (3,).
        device: newest state of the loop; None before its first tick.
        fix_status: newest status of the tracker; empty before the first fix.
        residual_px: its residual [px].
        shown: the pose predicted to the moment of display, for the views only.
        shown_offset: from its tip to the target.
        encoder: why an encoder cannot be right, by the cameras; empty if it may be.
    """

    time: float
    pose: NeedlePose
    offset: Offset
    p_target: FloatArray
    device: DeviceState | None
    fix_status: str
    residual_px: float
    shown: NeedlePose
    shown_offset: Offset
    encoder: str = ""

    @property
    def device_fault(self) -> str:
        """Return why the device holds its force at zero; empty if it does not."""
        if self.device is None or int(self.device.fault) == 0:
            return ""
        code = self.device.fault
        return str(getattr(code, "message", f"fault {int(code)} of the device"))

    @property
    def swings(self) -> bool:
        """Return whether the force was cut as if nobody held the needle, while the state says
        otherwise.

        Only a simulated hand is known to the state.
        """
        device = self.device
        if device is None or int(device.fault) != Fault.LET_GO:
            return False
        return float(device.row[slots.HAND_HOLDS]) > 0.5

    @staticmethod
    def _can_be_armed_again(device: DeviceState) -> bool:
        """Return whether the fault is one that ends by letting go of the switch and holding it
        again.
        """
        silence = device.time - float(device.row[slots.Q_TIME])
        return int(device.fault) == Fault.LET_GO or (
            int(device.fault) == Fault.LINK_LOST and silence <= SILENCE
        )

    def fatal(self, began: float, held_arming: bool = False, simulated: bool = False) -> str:
        """Return why an attempt that began at `began` [s] cannot go on; empty if it can.

        With `held_arming` a fault that ends when the person arms again is no reason; with a
        `simulated` hand a needle that swings in it is none either, the attempt pauses for it.
        """
        if self.device is None:
            return "" if self.time - began < LOOP_LIMIT else sentence("the loop does not run")
        age = self.time - self.device.time
        if age > LOOP_LIMIT:
            return sentence("the loop has stopped: its newest state is {age:.1f} s old", age=age)
        if self.device.time <= began + GRACE:
            return ""
        if self.encoder:
            return self.encoder
        if simulated and self.swings:
            return ""
        if held_arming and self._can_be_armed_again(self.device):
            return ""
        if int(self.device.fault) == Fault.HEARTBEAT_LOST:
            return ""  # the attempt pauses until the window answers, see `pauses`
        return self.device_fault

    def sample(self, state: State, inputs: LoopInputs) -> Sample:
        """Return what is recorded of it."""
        return Sample(
            time=self.time,
            state=state,
            pose=self.pose,
            device=self.device,
            p_target=self.p_target,
            fix_status=self.fix_status,
            residual_px=self.residual_px,
            assistance=inputs.assistance,
            enabled=inputs.armed,
        )


def observe(
    state: DeviceState | None,
    fixes: Fixes,
    placed: PlacedPlan,
    now: float,
    last: NeedlePose | None,
    missing: str = "the robot has not reported yet",
) -> Observation:
    """Fuse the newest values into one observation at `now` [s].

    `last` is the pose before; `missing` says why there is no `state`.
    """
    device = state if state is not None and state.tick > 0 else None
    if device is None:
        pose = _no_device(placed, now, last, missing)
    else:
        pose = fuse(device, fixes.usable(), now, last, fixes.doubt)
    p_target = _target(placed, device)
    status, residual = fixes.status(now)
    away = offset(pose, p_target, placed)
    seen = predicted(pose, fixes.motion(moment(pose)))
    seen_away = away if seen is pose else offset(seen, p_target, placed)
    return Observation(
        now, pose, away, p_target, device, status, residual, seen, seen_away, fixes.encoder
    )


def _target(placed: PlacedPlan, device: DeviceState | None) -> FloatArray:
    """Return where a plan's target is with the motion that the loop gives it [m], shape (3,)."""
    if device is None or not np.isfinite(shift := device.row[slots.TARGET_SHIFT]).all():
        return placed.p_target
    return read_only(placed.p_target + shift)


def _no_device(placed: PlacedPlan, now: float, last: NeedlePose | None, missing: str) -> NeedlePose:
    """Pose without a robot: the last one, else hanging at the fulcrum; not valid."""
    return NeedlePose(
        p_tip=last.p_tip if last else placed.p_entry,
        axis=last.axis if last else DOWN,
        depth=last.depth if last else 0.0,
        time=now,
        orientation_age=0.0,
        depth_age=0.0,
        depth_source=DepthSource.NONE,
        valid=False,
        covariance=last.covariance if last else read_only(np.zeros((3, 3))),
        bend=last.bend if last else None,
        reason=missing,
        trusted_depth=last.trusted_depth if last else None,
    )


STATISTICS_PERIOD: Final = 0.25
"""Statistics of loop and tracker are taken this often [s]; they cost more than a look."""


class RobotAndCameras:
    """Loop and tracker: opened, observed and closed together.

    Attributes:
        seen: newest observation; None before the first.
        timing: lateness of the loop, as it reported it last.
        statistics: of the tracker, as it reported them last; None without one.
    """

    def __init__(
        self,
        loop: Loop,
        tracker: NeedleTracker | None,
        inputs: LoopInputs,
        trust: DepthTrust = TRUST,
    ) -> None:
        self.seen: Observation | None = None
        self.timing: Timing | None = None
        self.statistics: TrackerStatistics | None = None
        self._loop = loop
        self._tracker = tracker
        self._fixes = Fixes(loop, inputs, trust)
        self._measured = -inf

    def open(self) -> None:
        """Start loop and tracker.

        Raises:
            AcusError: whatever keeps one from starting.
        """
        self._loop.open()
        if self._tracker is not None:
            self._tracker.open()

    def close(self) -> None:
        """Stop both; idempotent."""
        if self._tracker is not None:
            self._tracker.close()
        self._loop.close()

    def require_ticks(self, failed: bool) -> None:
        """Refuse what must not begin without a running loop, or after a `failed` ticker.

        Raises:
            NotReadyError: saying which.
        """
        if self._loop.latest().tick == 0:
            raise NotReadyError(
                sentence("the robot is still starting: begin once it reports its pose")
            )
        if failed:
            raise NotReadyError(
                sentence("the program has had a fault: close the exercise, open it again")
            )

    def take(self, fix: NeedleFix, placed: PlacedPlan) -> None:
        """Take a fix."""
        self._fixes.take(fix, placed.p_entry)

    def observe(self, placed: PlacedPlan, now: float) -> Observation:
        """Observe at `now` [s].

        Raises:
            AcusError: if the loop has ended; `observe_nothing` then keeps why.
        """
        stamped = self._tracker.latest.read() if self._tracker is not None else None
        if stamped is not None:
            self.take(stamped.value, placed)
        last = self.seen.pose if self.seen is not None else None
        self.seen = observe(self._loop.latest(), self._fixes, placed, now, last)
        return self.seen

    def aim(self, placed: PlacedPlan) -> None:
        """See what was observed last against another target from now on."""
        if (seen := self.seen) is not None:
            target = _target(placed, seen.device)
            self.seen = replace(
                seen,
                p_target=target,
                offset=offset(seen.pose, target, placed),
                shown_offset=offset(seen.shown, target, placed),
            )

    def observe_nothing(self, placed: PlacedPlan, now: float, reason: str) -> None:
        """Observe that the robot says nothing, and why."""
        last = self.seen.pose if self.seen is not None else None
        self.seen = observe(None, self._fixes, placed, now, last, reason)

    def newest(self, placed: PlacedPlan, now: float) -> Observation:
        """Return the newest observation, with statistics that are not too old."""
        if abs(now - self._measured) >= STATISTICS_PERIOD:
            self._measured = now
            self.timing = self._loop.timing()
            self.statistics = self._tracker.statistics() if self._tracker is not None else None
        return self.seen or observe(None, self._fixes, placed, now, None)

    def tracker_events(self, own: EventQueue) -> list[Event]:
        """Take what the tracker tells; a queue that is the trainer's `own` is drained already."""
        if self._tracker is None or self._tracker.events is own:
            return []
        return list(self._tracker.events.drain())


class BreathWatch:
    """Tells how a breath-hold stands from what the loop was asked and where the target is.

    Args:
        longest: time that this patient can hold the breath [s].
    """

    def __init__(self, longest: float) -> None:
        self.now = BreathHold()
        self._longest = longest
        self._place: tuple[float, ...] = ()
        self._rests_since = inf

    def observe(self, device: DeviceState | None, time: float) -> str:
        """Take the loop's newest state at `time` [s]; returns what has changed, in words."""
        if device is None:
            return ""
        place = tuple(device.row[slots.TARGET_SHIFT].tolist())
        if place != self._place:
            self._place, self._rests_since = place, time
        before, asked = self.now, float(device.row[slots.HOLD_BREATH]) > 0.5
        held = asked and time - self._rests_since >= STILL
        # The organ has taken its place within the hold, so that the hold began before it rested.
        left = self._longest - SETTLING - (time - self._rests_since)
        spent = asked and not held and (before.held or before.spent)
        self.now = BreathHold(asked, held, max(0.0, left) if held else 0.0, spent)
        return self._change(before)

    def _change(self, before: BreathHold) -> str:
        now = self.now
        if now.held and not before.held:
            return sentence(
                "the patient holds the breath, for {now_left:.0f} s at most", now_left=now.left
            )
        if now.spent and not before.spent:
            return sentence(
                "the patient could hold no longer and breathes: release him, and ask again"
            )
        if now.asked != before.asked:
            return (
                sentence("the patient is told to hold")
                if now.asked
                else sentence("the patient may breathe")
            )
        return ""
