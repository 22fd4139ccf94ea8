"""A gimbal as a machine: d = (-sin q2, sin q1 cos q2, -cos q1 cos q2)."""

from math import atan2, cos, hypot, pi, sin

import numpy as np

from app.core.arrays import frozen, unit
from app.core.compiled import njit, stage
from app.core.parameters import Stage
from app.mechanisms.direct_drive import direct_drive, nothing_behind
from app.mechanisms.needle_motion import OWN, SUBSTEP, move_needle
from app.mechanisms.remote_centre import (
    DrawnRod,
    JointBranch,
    MachineDrawing,
    MachineStages,
    PartKind,
)
from app.mechanisms.status import NOT_FINITE, OK, Status
from app.mechanisms.turning import (
    RodMachine,
    plant_terms,
    tool_of,
    write_dynamics,
    write_pose,
)


@njit
def axis_of(p, own, q1, q2):
    """Needle direction and its rates by both joints."""
    if not abs(q1) + abs(q2) < 100.0:
        return NOT_FINITE, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    c1, s1, c2, s2 = cos(q1), sin(q1), cos(q2), sin(q2)
    return OK, -s2, s1 * c2, -c1 * c2, 0.0, c1 * c2, s1 * c2, -c2, -s1 * s2, c1 * s2


@njit
def rates_of(p, own, q1, q2, v1, v2):
    """How those rates change at joint speeds."""
    c1, s1, c2, s2 = cos(q1), sin(q1), cos(q2), sin(q2)
    cross_y, cross_z = -c1 * s2, -s1 * s2
    return (
        0.0,
        -s1 * c2 * v1 + cross_y * v2,
        c1 * c2 * v1 + cross_z * v2,
        s2 * v2,
        cross_y * v1 - s1 * c2 * v2,
        cross_z * v1 + c1 * c2 * v2,
    )


@stage
def pose_stage(state, parameters):
    """Write what `MachineStages.pose` must."""
    write_pose(state, parameters, axis_of)


@stage
def dynamics_stage(state, parameters):
    """Write what `MachineStages.dynamics` must."""
    write_dynamics(state, parameters, axis_of, rates_of)


@njit
def pose_of(p, q1, q2):
    """Pose of the simulated gimbal."""
    return tool_of(p, OWN, q1, q2, axis_of)


@njit
def terms(state, p, pose):
    """Motion of the simulated gimbal."""
    return plant_terms(state, p, axis_of, rates_of)


@stage
def plant_stage(state, parameters):
    """Move the simulated gimbal."""
    move_needle(state, parameters, SUBSTEP, pose_of, terms, direct_drive, nothing_behind)


class Gimbal(RodMachine):
    """Two rings with a motor on each axis."""

    joint_ranges = ((-0.5 * pi, 0.5 * pi), (-0.5 * pi, 0.5 * pi))

    def __init__(self, profile):
        part = profile.inertia
        super().__init__(profile, (part.outer_inertia, part.inner_inertia), (0.0, 0.0))
        self.radius = part.radius

    def kernels(self):
        """Return the two functions above."""
        return axis_of, rates_of

    def joints(self, axis):
        """One branch: the inner ring is turned by less than a right angle."""
        x, y, z = unit(axis, "axis").tolist()
        fine = z < 0.0
        q = [atan2(y, -z), atan2(-x, hypot(y, z))] if fine else [0.0, 0.0]
        status = Status.OK if fine else Status.UNREACHABLE
        return (JointBranch("upright", status, frozen(q), mounted=fine),)

    def drawn(self, q):
        """Draw the outer axis and, turned, the inner one."""
        across = np.array([self.radius, 0.0, 0.0])
        points = {"left": frozen(self.centre - across), "right": frozen(self.centre + across)}
        rods = (DrawnRod("left", "right", PartKind.BASE),)
        if q is None:
            return MachineDrawing(points, rods)
        inner = self.radius * np.array([0.0, cos(q[0]), sin(q[0])])
        points |= {"near": frozen(self.centre - inner), "far": frozen(self.centre + inner)}
        return MachineDrawing(points, (*rods, DrawnRod("near", "far")))

    def stages(self):
        """Motors on the joints themselves."""
        values = np.array(self.values)
        return MachineStages(
            pose=Stage("machine", pose_stage, values),
            dynamics=Stage("dynamics", dynamics_stage, values),
            plant=plant_stage,
            plant_values=values,
        )


def machine(profile):
    """Return the machine of a profile."""
    return Gimbal(profile)
