"""What points a needle at a remote centre of motion: the one interface of all machines.

A machine has two joints q and turns the needle's direction d (unit vector, hub to tip) about a
point that stands still in world, the remote centre; along the needle it does nothing. A machine is
a folder in `mechanisms` with

- `profile.py`: its sections of a device profile, and `PROFILE`, the class that reads one,
- `machine.py`: `machine(profile)`, which returns its `RemoteCentre`,

and a profile in `resources/devices` whose `kind` is the folder's name. Nothing else knows it:
planning, loop, simulation, views and records ask a `RemoteCentre`. docs/extending.md shows one.

The loop does not call these methods. It takes the machine's compiled stages (`MachineStages`) into
its table beside laws and effects; there the needle's direction is said by the tool point P3 where
its line crosses z = 0 (`lever`), which turns a force at the hub into joint torques by virtual work.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.core import state_vector as sv
from app.core.arrays import FloatArray, cross, frozen, unit
from app.core.messages import sentence
from app.core.parameters import Stage, StageFunction
from app.mechanisms.errors import MechanismError
from app.mechanisms.status import Status, check

REGULAR: Final = "regular"
"""Name of a pose that is not singular."""


@dataclass(frozen=True, slots=True, eq=False)
class MachinePose:
    """Where the needle points at joint angles, and how it turns with them.

    Attributes:
        status: whether it does; without `OK` the arrays are zeros.
        singularity: name of the singularity here, `regular` if it is none; a pose that only loses
            a direction exists and is `OK`.
        measure: how far from singular: 0 there; a sine or the like [-].
        axis: needle direction d, hub to tip, shape (3,).
        jacobian: dd/dq [1/rad], shape (3, 2), across the needle.
    """

    status: Status
    singularity: str
    measure: float
    axis: FloatArray
    jacobian: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class JointBranch:
    """One answer to which joint angles point the needle somewhere.

    Attributes:
        name: of the branch: a working mode, or a side.
        status: whether it has an answer.
        q: joint angles [rad], shape (2,); zeros without one.
        mounted: whether `pose(q)` is this direction again in the assembly that the machine is built
            in: only such a branch can be used.
    """

    name: str
    status: Status
    q: FloatArray
    mounted: bool


@dataclass(frozen=True, slots=True, eq=False)
class DynamicTerms:
    """Terms of M q̈ + h + g + friction = τ at one state.

    Attributes:
        mass: M [kg·m²], shape (2, 2).
        velocity: h(q, q̇) [N·m], shape (2,).
        gravity: g(q) [N·m], shape (2,).
        friction: of the joints [N·m], shape (2,).
    """

    mass: FloatArray
    velocity: FloatArray
    gravity: FloatArray
    friction: FloatArray


class PartKind(StrEnum):
    """What a drawn rod is: a link or a base keep their length, a cable does not."""

    LINK = "link"
    BASE = "base"
    CABLE = "cable"


@dataclass(frozen=True, slots=True)
class DrawnRod:
    """A straight part of the machine between two of its named points."""

    start: str
    end: str
    part: PartKind = PartKind.LINK


@dataclass(frozen=True, slots=True, eq=False)
class MachineDrawing:
    """What there is to see of a machine.

    Attributes:
        points: name -> place in world [m], shape (3,).
        rods: what joins them, in an order that stays; cables in the order of their actuators.
        reading: which reading of an ambiguous paper is drawn; empty where there is one.
    """

    points: Mapping[str, FloatArray]
    rods: tuple[DrawnRod, ...]
    reading: str = ""

    def ends(self) -> list[tuple[FloatArray, FloatArray]]:
        """Return the ends of every rod [m]."""
        return [(self.points[rod.start], self.points[rod.end]) for rod in self.rods]


@dataclass(frozen=True, slots=True, eq=False)
class MachineStages:
    """A machine's compiled part of a tick, each `void(state, parameters)`.

    Attributes:
        pose: writes KINEMATICS from Q_*, and where it is OK P3_*, J_* and INERTIA_*.
        dynamics: writes MASS_*, BIAS_*, DRIFT_*, WEIGHT_* and LINKS_POTENTIAL, for the laws that
            read them; None where a machine has none: such a law is refused.
        plant: moves the simulated machine by DT (see `needle_motion`).
        plant_values: its own numbers and memory behind what all machines have, shape (n,).
        watch: writes MACHINE_FAULT, before the laws; none where the machine has nothing of its own
            that can fail.
        efforts: turns TORQUE_* into what its actuators are told, after safety; none where they are
            on the joints themselves.
    """

    pose: Stage
    dynamics: Stage | None
    plant: StageFunction
    plant_values: FloatArray
    watch: tuple[Stage, ...] = ()
    efforts: tuple[Stage, ...] = ()


def _slots(*names: str) -> frozenset[int]:
    return frozenset(sv.INDEX[slot] for name in names for slot in sv.slots_named(name))


MACHINE_WRITES: Final = {
    "pose": _slots("kinematics", "p3", "jacobian", "inertia"),
    "watch": _slots("machine_fault"),
    "dynamics": _slots("mass", "bias", "drift", "weight", "links_potential"),
    "efforts": _slots(
        *("torque", "felt", "felt_most", "guidance_limit", "guidance_limited_by", "force", "guide"),
        *("shortfall", "tension", "reel_rate", "holding"),
    ),
    "plant": frozenset(sv.MACHINE) - _slots("machine_fault", "encoder_fault", "unbelieved")
    | _slots("plant_q", "plant_qd", "plant_depth", "plant_depth_rate", "pull", "push", "grip")
    | _slots("grip_depth"),
}
"""What each stage of a machine may write, by its name in `MachineStages`: slots."""


class RemoteCentre(ABC):
    """A machine of one profile.

    Args:
        centre: remote centre in world [m], shape (3,).

    Attributes:
        joint_ranges: least and largest angle of both joints [rad], open intervals.
    """

    joint_ranges: tuple[tuple[float, float], tuple[float, float]]

    def __init__(self, centre: FloatArray) -> None:
        self.centre = centre

    @abstractmethod
    def pose(self, q: ArrayLike) -> MachinePose:
        """Pose at joint angles q [rad], shape (2,); its status says where there is none."""

    @abstractmethod
    def joints(self, axis: ArrayLike) -> tuple[JointBranch, ...]:
        """All branches of joint angles for a needle direction, shape (3,), the usual one first."""

    @abstractmethod
    def jacobian_rate(self, q: ArrayLike, qd: ArrayLike) -> FloatArray:
        """Time derivative of `MachinePose.jacobian` at q̇ [rad/s]: shape (3, 2).

        Raises:
            MechanismError: where there is no pose.
        """

    @abstractmethod
    def drawn(self, q: ArrayLike | None) -> MachineDrawing:
        """Return what there is to see at q; without usable angles, what does not move."""

    @abstractmethod
    def dynamics(
        self, q: ArrayLike, qd: ArrayLike, depth: float, depth_rate: float = 0.0
    ) -> DynamicTerms:
        """Terms of the motion at q̇ [rad/s], the needle's tip at `depth` [m] moving along.

        Raises:
            MechanismError: where there is no pose.
        """

    @abstractmethod
    def stages(self) -> MachineStages:
        """Return its part of a tick; its arrays belong to one loop."""

    def axis(self, q: ArrayLike) -> FloatArray:
        """Needle direction, hub to tip, shape (3,).

        Raises:
            MechanismError: where there is no pose; of the family that the status names.
        """
        return self._valid(q).axis

    def jacobian(self, q: ArrayLike) -> FloatArray:
        """dd/dq [1/rad], shape (3, 2).

        Raises:
            MechanismError: as `axis`.
        """
        return self._valid(q).jacobian

    def usable(self, axis: ArrayLike) -> FloatArray:
        """Joint angles [rad], shape (2,), that point the needle along `axis`, as it is built.

        Raises:
            MechanismError: if none do; says why.
        """
        branches = self.joints(axis)
        for branch in branches:
            if branch.mounted:
                return branch.q
        said = ", ".join(f"{b.name}: {b.status.name.lower()}" for b in branches)
        raise MechanismError(
            sentence(
                "no joint angles point the needle along {axis} ({branches})",
                axis=np.asarray(axis).tolist(),
                branches=said,
            )
        )

    def holds(self, axis: ArrayLike) -> bool:
        """Return whether the machine can point the needle there."""
        return any(branch.mounted for branch in self.joints(axis))

    def joint_torques(self, q: ArrayLike, moment: ArrayLike) -> FloatArray:
        """Joint torques [N·m], shape (2,), of a moment on the needle about the centre, shape (3,).

        By virtual work: the needle turns at ω = d x ḋ, so τ = (d x dd/dq)ᵀ m; what turns the needle
        about itself drops out.

        Raises:
            MechanismError: as `axis`.
        """
        pose = self._valid(q)
        turns = np.column_stack([cross(pose.axis, column) for column in pose.jacobian.T])
        return frozen(turns.T @ np.asarray(moment, dtype=np.float64))

    def moment(self, q: ArrayLike, torques: ArrayLike) -> FloatArray:
        """Moment on the needle [N·m], shape (3,), across it, that joint torques, shape (2,), make.

        Raises:
            MechanismError: as `axis`; also where the joints leave a direction free.
        """
        pose = self._valid(q)
        turns = np.column_stack([cross(pose.axis, column) for column in pose.jacobian.T])
        gram = turns.T @ turns
        if not np.linalg.cond(gram) < 1e24:
            check(
                Status.SINGULAR, f"moment at q = {np.asarray(q).tolist()} rad: {pose.singularity}"
            )
        return frozen(turns @ np.linalg.solve(gram, np.asarray(torques, dtype=np.float64)))

    def _valid(self, q: ArrayLike) -> MachinePose:
        pose = self.pose(q)
        what = f"joint angles q = {np.asarray(q, dtype=np.float64).tolist()} rad"
        check(pose.status, what if pose.singularity == REGULAR else f"{what}: {pose.singularity}")
        return pose


def tool_point(centre: FloatArray, axis: ArrayLike) -> tuple[float, float]:
    """Return where a needle along `axis` through the remote centre crosses z = 0 [m].

    Raises:
        MechanismError: if it does not point down.
    """
    direction = unit(axis, "axis")
    if not direction[2] < 0.0:
        raise MechanismError(
            sentence(
                "needle direction {direction} does not point down", direction=direction.tolist()
            )
        )
    x, y, _ = centre - direction * centre[2] / direction[2]
    return float(x), float(y)


def axis_rates(axis: FloatArray, l_in: float, rates: FloatArray) -> FloatArray:
    """dd/dq of dP3/dq, shape (2, 2): (I - d dᵀ)[:, :2] J / L_in, shape (3, 2)."""
    across = (np.eye(3) - np.outer(axis, axis))[:, :2]
    return frozen(across @ rates / l_in)


def axis_second_rates(
    axis: FloatArray, l_in: float, rates: FloatArray, second: FloatArray, qd: FloatArray
) -> FloatArray:
    """Time derivative of `axis_rates`; `second` is that of dP3/dq, shape (2, 2).

    With P = I - d dᵀ: d/dt (P J / L) = (P J̇ - (ḋ dᵀ + d ḋᵀ) J - P J L̇ / L) / L, L̇ = d·Ṗ3.
    """
    flat = np.vstack([rates, np.zeros(2)])
    flat_second = np.vstack([second, np.zeros(2)])
    across = np.eye(3) - np.outer(axis, axis)
    velocity = flat @ qd
    turning = across @ velocity / l_in
    lengthening = float(axis @ velocity)
    change = np.outer(turning, axis) + np.outer(axis, turning)
    whole = across @ flat_second - change @ flat - across @ flat * (lengthening / l_in)
    return frozen(whole / l_in)
