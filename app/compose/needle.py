"""What simulated cameras see of a robot's needle, and the direction that its encoders measure."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.device.control import Loop
from app.mechanisms.profile import DeviceProfile
from app.tracking.simulated.scene import MarkerScene, Scene

UPRIGHT: Final = (0.0, 0.0, -1.0)
"""Needle direction at the start, hub to tip."""


def needle_scene(
    loop: Loop, profile: DeviceProfile, marker_offset: float, real: bool = False
) -> Scene:
    """Return what the cameras see: the true needle of the robot, not what its encoders say.

    Simulated cameras cannot see a real needle: its direction is then the measured one, its depth
    that of the simulated hand (GRIP_DEPTH).
    """
    machine = profile.machine

    def scene(time: float) -> MarkerScene:
        row = row_at(loop, time)
        if real:
            axis, depth = row[sv.AXIS], float(row[sv.GRIP_DEPTH])
            if not axis.any():  # before the first tick
                axis = np.array(UPRIGHT)
            return MarkerScene.from_tip(machine.centre + depth * axis, axis, marker_offset)
        depth = float(row[sv.PLANT_DEPTH])
        axis = machine.axis(row[sv.PLANT_Q])
        return MarkerScene.from_tip(machine.centre + depth * axis, axis, marker_offset)

    return scene


def row_at(loop: Loop, time: float) -> FloatArray:
    """Return the tick nearest before a monotonic time [s]: both pictures show one moment.

    The newest tick for a time to come, the oldest of the last tenth of a second for one long past.
    """
    newest = loop.latest()
    if newest.time <= time or newest.tick == 0:
        return newest.row
    rows = loop.rows(newest.tick - round(0.1 * loop.rate_hz))
    index = int(np.searchsorted(rows[:, sv.TIME], time, side="right")) - 1
    row: FloatArray = rows[max(index, 0)]
    return row


def measured_axis(loop: Loop) -> Callable[[float], FloatArray | None]:
    """Return what the tracker asks for the needle's direction: the encoders' at a time, or None."""

    def axis(time: float) -> FloatArray | None:
        row = row_at(loop, time)
        known = row[sv.TICK] > 0.0 and row[sv.KINEMATICS] == 0.0
        return row[sv.AXIS] if known else None

    return axis


def felt_force(loop: Loop) -> Callable[[float], FloatArray | None]:
    """Return what tells the tracker the robot's force at the hub [N] at a time, or None."""

    def force(time: float) -> FloatArray | None:
        row = row_at(loop, time)
        return row[sv.FELT] if row[sv.TICK] > 0.0 else None

    return force
