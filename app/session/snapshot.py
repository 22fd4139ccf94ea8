"""What the window shows: one frozen value per tick."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite
from typing import TYPE_CHECKING

from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.device.readiness import ForceClearance
from app.device.state import DeviceState
from app.planning.off_path import Offset
from app.session.machine import State
from app.session.needle import DepthSource, NeedlePose
from app.session.recorder import RecordingStatus

if TYPE_CHECKING:
    from app.device.control.timing import Timing
    from app.tracking.statistics import TrackerStatistics


@dataclass(frozen=True, slots=True, eq=False)
class Snapshot:
    """Everything about the running trainer at one moment.

    Attributes:
        time: moment [s].
        state: the attempt's state.
        reason: why it was aborted; empty otherwise.
        elapsed: time since the attempt began [s]; stands still once it is over.
        phases: time spent per state [s].
        pose: needle, world, predicted to the moment of display (`predicted` says how far); what is
            recorded and scored is the measured one, `measured_pose`.
        offset: from the tip to the target.
        p_target: target now, with its motion [m], shape (3,).
        device: newest state of the loop; None before its first tick.
        timing: lateness of the loop, as it reports it; None before it was asked.
        tracker: statistics of the tracker, as it reports them; None without one.
        fix_status: newest status of the tracker; empty before the first fix.
        scans: control scans taken.
        assistance: dial, 0...1.
        armed: whether forces are armed.
        recording: how the record stands; None before the first attempt.
        messages: what the student should know, one line each, most urgent first.
        held_arming: whether the forces are on only while a key or pedal is held.
        clearance: how much force the device is cleared for; None where nobody is asked.
        withdrawal: what happens, or is to be done, before the attempt can begin with the needle out
            of the skin; empty otherwise.
        may_confirm: whether the student may say that the needle is out.
        measured_pose: the pose as measured, behind by its age; None in snapshots made by hand.
    """

    time: float
    state: State
    reason: str
    elapsed: float
    phases: Mapping[State, float]
    pose: NeedlePose
    offset: Offset
    p_target: FloatArray
    device: DeviceState | None
    timing: Timing | None
    tracker: TrackerStatistics | None
    fix_status: str
    scans: int
    assistance: float
    armed: bool
    recording: RecordingStatus | None
    messages: tuple[str, ...]
    held_arming: bool = False
    clearance: ForceClearance | None = None
    measured_pose: NeedlePose | None = None
    withdrawal: str = ""
    may_confirm: bool = False


_FIX_TEXT = {
    "out_of_view": "marker out of view",
    "no_picture": "a camera's picture is late",
    "not_yet_visible": "the marker has not come out of the tube yet",
    "one_camera": "marker seen by one camera only",
    "inconsistent": "the cameras disagree about the marker",
    "no_orientation": "the cameras see the marker, but the robot gives no direction",
}


def unmeasured(pose: NeedlePose) -> str:
    """Say that nobody measures the depth now, why, and what follows from it."""
    why = f" ({pose.doubt})" if pose.doubt else ""
    if not (isfinite(pose.depth_least) and isfinite(pose.depth_most)):
        return f"depth not measured{why}"
    low, high = pose.depth_least / MILLIMETRE, pose.depth_most / MILLIMETRE
    return (
        f"depth not measured{why}: it may be anywhere from {low:.0f} to {high:.0f} mm, and the "
        "force is held back for the worst of it"
    )


def advice(
    pose: NeedlePose,
    fix_status: str,
    fault: str,
    reason: str,
    recording: RecordingStatus | None,
    held_back: str = "",
    waits: str = "",
) -> tuple[str, ...]:
    """Messages for the student, most urgent first.

    Args:
        pose: newest pose.
        fix_status: newest status of the tracker; empty before the first fix.
        fault: name of the device's fault; empty if there is none.
        reason: why the attempt was aborted; empty otherwise.
        recording: how the record stands.
        held_back: why the device is not cleared for full force; empty if it is.
        waits: why the attempt waits; empty if it does not.
    """
    found = []
    if reason:
        found.append(f"attempt aborted: {reason}")
    if waits:
        found.append(waits)
    if fault:
        found.append(f"no force: {fault}")
    if held_back:
        found.append(held_back)
    if recording is not None and recording.failure:
        found.append(recording.failure)
    if pose.reason:
        found.append(pose.reason)
    if fix_status in _FIX_TEXT:
        found.append(_FIX_TEXT[fix_status])
    if pose.bends:
        found.append(f"the needle bends: its tip is {pose.deflection * 1e3:.1f} mm off its line")
    if pose.depth_source is DepthSource.ONE_CAMERA:
        found.append("depth from one camera and the needle's line: less exact")
    elif pose.depth_source is DepthSource.HELD:
        found.append(f"depth held for {pose.depth_age * 1e3:.0f} ms")
    elif pose.depth_source is DepthSource.MODEL:
        found.append(unmeasured(pose))
    if recording is not None and recording.lost_rows:
        found.append(f"{recording.lost_rows} ticks of the loop were not recorded")
    return tuple(found)
