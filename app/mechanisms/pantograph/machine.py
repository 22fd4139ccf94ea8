"""The needle pantograph as a machine that points a needle at a remote centre."""

from math import pi

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
from app.core.parameters import Stage, packed
from app.mechanisms.errors import MechanismError
from app.mechanisms.lever import axis_kernel
from app.mechanisms.pantograph import kernels, stages
from app.mechanisms.pantograph.dynamics import dynamic_terms
from app.mechanisms.pantograph.kinematics import pair
from app.mechanisms.pantograph.posture import (
    WORKING_MODES,
    Singularity,
    branches,
    jacobian_rate,
    singularity,
)
from app.mechanisms.pantograph.profile import PantographProfile
from app.mechanisms.profile import DeviceProfile
from app.mechanisms.remote_centre import (
    REGULAR,
    DrawnRod,
    DynamicTerms,
    JointBranch,
    MachineDrawing,
    MachinePose,
    MachineStages,
    PartKind,
    RemoteCentre,
    axis_rates,
    axis_second_rates,
    tool_point,
)
from app.mechanisms.status import Status

_MODE_NAMES = ("elbows outwards", "both elbows left", "elbows inwards", "both elbows right")
"""Of `WORKING_MODES`, in their order."""

_BASE = DrawnRod("left motor", "right motor", PartKind.BASE)
_PROXIMAL = (DrawnRod("left motor", "left elbow"), DrawnRod("right motor", "right elbow"))
_DISTAL = (DrawnRod("left elbow", "tool point"), DrawnRod("right elbow", "tool point"))


class Pantograph(RemoteCentre):
    """A five-bar whose tool point holds the needle in z = 0, below the remote centre."""

    joint_ranges = ((0.0, 2.0 * pi), (-pi, pi))

    def __init__(self, profile: PantographProfile) -> None:
        super().__init__(profile.fulcrum)
        self.geometry, self.model = profile.pantograph, profile.dynamic_model

    def pose(self, q: ArrayLike) -> MachinePose:
        """MachinePose in the assembly as built; `SINGULAR` where the distal links are in line."""
        q1, q2 = pair(q, "q")
        status, x, y = kernels.forward_kernel(q1, q2, *self.geometry.links, 1.0)
        rates = [0.0] * 4
        if status == Status.OK:
            status, *rates = kernels.jacobian_kernel(q1, q2, x, y, *self.geometry.links)
        if status != Status.OK:
            kind = Singularity.PARALLEL if status == Status.SINGULAR else REGULAR
            return MachinePose(
                Status(status), kind, 0.0, frozen(np.zeros(3)), frozen(np.zeros((3, 2)))
            )
        *axis, l_in = axis_kernel(x, y, *self.geometry.fulcrum_xyz)
        direction = frozen(axis)
        found = singularity(self.geometry, q)
        measure = min(map(abs, (found.serial_left, found.serial_right, found.parallel)))
        turning = axis_rates(direction, l_in, np.array(rates).reshape(2, 2))
        return MachinePose(Status.OK, found.kind, measure, direction, turning)

    def joints(self, axis: ArrayLike) -> tuple[JointBranch, ...]:
        """All four working modes, elbows outwards first: the one that the robot is built in."""
        try:
            point = tool_point(self.centre, axis)
        except MechanismError:
            nowhere = frozen(np.zeros(2))
            return tuple(
                JointBranch(name, Status.UNREACHABLE, nowhere, mounted=False)
                for name in _MODE_NAMES
            )
        return tuple(
            JointBranch(
                name,
                branch.status,
                branch.q,
                branch.status is Status.OK
                and branch.mode == WORKING_MODES[0]
                and branch.assembly >= 0,
            )
            for name, branch in zip(_MODE_NAMES, branches(self.geometry, point), strict=True)
        )

    def jacobian_rate(self, q: ArrayLike, qd: ArrayLike) -> FloatArray:
        """Rate of dd/dq; see `RemoteCentre`."""
        self._valid(q)
        x, y = kernels.forward_kernel(*pair(q, "q"), *self.geometry.links, 1.0)[1:]
        *axis, l_in = axis_kernel(x, y, *self.geometry.fulcrum_xyz)
        entries = kernels.jacobian_kernel(*pair(q, "q"), x, y, *self.geometry.links)[1:]
        rates, second = np.array(entries).reshape(2, 2), jacobian_rate(self.geometry, q, qd)
        return axis_second_rates(frozen(axis), l_in, rates, second, np.array(pair(qd, "qd")))

    def drawn(self, q: ArrayLike | None) -> MachineDrawing:
        """Draw base, driven links, and where the links close the passive ones."""
        geometry = self.geometry
        half = geometry.base / 2.0
        points = {"left motor": frozen([-half, 0.0, 0.0]), "right motor": frozen([half, 0.0, 0.0])}
        angles = np.full(2, np.nan) if q is None else np.asarray(q, dtype=np.float64)
        if not np.isfinite(angles).all():
            return MachineDrawing(points, (_BASE,))
        arms = geometry.proximal * np.column_stack([np.cos(angles), np.sin(angles), [0.0, 0.0]])
        points["left elbow"] = frozen(points["left motor"] + arms[0])
        points["right elbow"] = frozen(points["right motor"] + arms[1])
        status, x, y = kernels.forward_kernel(*angles.tolist(), *geometry.links, 1.0)
        if status != Status.OK:  # a pose in which the links do not close: show the driven ones
            return MachineDrawing(points, (_BASE, *_PROXIMAL))
        points["tool point"] = frozen([x, y, 0.0])
        return MachineDrawing(points, (_BASE, *_PROXIMAL, *_DISTAL))

    def dynamics(
        self, q: ArrayLike, qd: ArrayLike, depth: float, depth_rate: float = 0.0
    ) -> DynamicTerms:
        """Links, tool, rotors and needle; see `pantograph.dynamics`."""
        return dynamic_terms(self.model, q, qd, depth, depth_rate)

    def stages(self) -> MachineStages:
        """Motors on the joints themselves: nothing stands between safety and the wire."""
        a1, a2, base = self.geometry.links
        part = self.model.inertia
        pose = packed(
            stages.AT,
            a1=a1,
            a2=a2,
            base=base,
            driven=part.driven,
            passive=part.passive,
            coupling=part.coupling,
            tool=part.tool,
        )
        values = self.model.values
        return MachineStages(
            pose=Stage("machine", stages.pose_stage, pose),
            dynamics=Stage("dynamics", stages.dynamics_stage, np.array(values)),
            plant=stages.plant_stage,
            plant_values=values,
        )


def machine(profile: DeviceProfile) -> RemoteCentre:
    """Return the machine of a profile.

    Raises:
        MechanismError: if the profile is of another kind.
    """
    if not isinstance(profile, PantographProfile):
        raise MechanismError(
            sentence(
                "device {profile_name} is a {profile_kind}, no pantograph",
                profile_name=profile.name,
                profile_kind=profile.kind,
            )
        )
    return Pantograph(profile)
