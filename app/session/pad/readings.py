"""From a snapshot of the trainer to the hand and to the line that the pad's dot stands for."""

from __future__ import annotations

from app.core import state_vector as sv
from app.device.state import DeviceState
from app.session.pad.geometry import downward
from app.session.pad.hand import HandPose
from app.session.pad.view import NeedleLine
from app.session.snapshot import Snapshot


def hand_pose(snapshot: Snapshot) -> HandPose | None:
    """Return where the loop has the simulated hand now; None where the robot does not tell."""
    device = snapshot.device
    if not isinstance(device, DeviceState):
        return None
    x, y, depth, holds = device.row[[sv.HAND_X, sv.HAND_Y, sv.HAND_DEPTH, sv.HAND_HOLDS]].tolist()
    return HandPose(downward(x, y), depth, bool(holds))


def needle_line(snapshot: Snapshot) -> NeedleLine | None:
    """Return the needle as the dot needs it; None while there is no valid pose."""
    pose = snapshot.pose
    if not pose.valid:
        return None
    return NeedleLine(pose.axis, snapshot.offset, pose.depth, pose.measured)
