"""The pose that is shown: where the tip will be when the light of the screen is seen.

A depth is old when it comes (capture, transfer, search) and older when it is seen. For the views it
is moved on to the moment of display, at the rate of its filter, by at most `FARTHEST`. The record,
the score and the force laws use the measured pose: a prediction overshoots where the hand stops.
"""

from dataclasses import replace
from typing import Final

import numpy as np

from app.core.arrays import read_only
from app.session.needle import DepthSource, NeedlePose
from app.tracking.motion.depth_filter import HAND_SPEED, DepthMotion

DISPLAY_LATENCY: Final = 0.030
"""From a pose to the light of the screen [s]: declared, one frame of 60 Hz and the panel's own."""

FARTHEST: Final = 0.100
"""No depth is predicted further than this beyond its capture [s]."""


def moment(pose: NeedlePose) -> float:
    """Time that the shown depth should stand for [s]."""
    captured = pose.time - pose.depth_age
    return min(pose.time + DISPLAY_LATENCY, captured + FARTHEST)


def shown(pose: NeedlePose, motion: DepthMotion | None) -> NeedlePose:
    """Return the pose with the depth of `motion`, which stands for `moment(pose)`.

    Only a depth that cameras measured is moved; any other pose is returned as it is. The pose's
    variance allows for a hand that nothing followed since the picture; the filter did follow it.
    """
    by_cameras = pose.measured and pose.depth_source is not DepthSource.NONE
    if motion is None or not by_cameras:
        return pose
    change = motion.depth - pose.depth
    bend, moved = pose.bend, pose.p_straight + change * pose.axis
    along = np.outer(pose.tip_axis, pose.tip_axis)
    present = float(pose.axis @ pose.covariance @ pose.axis)
    followed = min(pose.depth_age, FARTHEST)
    aged = HAND_SPEED**2 * (pose.depth_age**2 - (pose.depth_age - followed) ** 2)
    growth = max(motion.variance - present, -min(aged, present))
    return replace(
        pose,
        p_tip=read_only(moved if bend is None else moved + bend.at(motion.depth)),
        depth=motion.depth,
        rate=motion.rate,
        predicted=max(0.0, motion.time - (pose.time - pose.depth_age)),
        covariance=read_only(pose.covariance + growth * along),
    )
