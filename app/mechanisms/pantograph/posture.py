"""Postures of the five-bar: working modes, assemblies, passive joints, singular poses."""

from dataclasses import dataclass
from enum import StrEnum
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.mechanisms.geometry import Geometry
from app.mechanisms.pantograph import differential, kernels
from app.mechanisms.pantograph.kinematics import forward, pair
from app.mechanisms.status import NOT_FINITE, OK, Status, check

WORKING_MODES: Final = ((1, -1), (1, 1), (-1, 1), (-1, -1))
"""All working modes (left, right); +1 turns the driven link counterclockwise of the line from its
motor to P3. The first, elbows outwards, is the thesis' own."""

ASSEMBLIES: Final = (1, -1)
"""Both closures of the same joint angles; +1 is the robot as built."""


class Singularity(StrEnum):
    """Kind of a singular configuration.

    `SERIAL_*` (type 1): that arm is stretched or folded. `PARALLEL` (type 2): the distal links are
    in line; elbows that coincide count as that.
    """

    REGULAR = "regular"
    SERIAL_LEFT = "serial_left"
    SERIAL_RIGHT = "serial_right"
    SERIAL_BOTH = "serial_both"
    PARALLEL = "parallel"


@dataclass(frozen=True, slots=True)
class SingularityMeasure:
    """Distance of a pose from singular, as sines, and what it is called.

    Attributes:
        serial_left: sin(θ2 - θ1), left arm.
        serial_right: sin(θ2' - θ1'), right arm.
        parallel: sin(θ2' - θ2).
        kind: the singularity within the tolerance asked for.
    """

    serial_left: float
    serial_right: float
    parallel: float
    kind: Singularity


@dataclass(frozen=True, slots=True)
class PassiveAngles:
    """Angles of the distal links [rad], in (-π, π].

    Attributes:
        left_absolute, right_absolute: from +x (θ2, θ2').
        left_relative, right_relative: from the driven link of the same arm (errata B4).
    """

    left_absolute: float
    right_absolute: float
    left_relative: float
    right_relative: float


@dataclass(frozen=True, slots=True, eq=False)
class Branch:
    """One answer of the inverse kinematics.

    Attributes:
        mode: working mode (left, right).
        status: `OK`, or why this mode has no answer.
        q: joint angles [rad], shape (2,); zero without an answer.
        assembly: closure in which `forward(q)` gives the tool point back: +1, -1, or 0 where both
            do (or none, without an answer).
    """

    mode: tuple[int, int]
    status: Status
    q: FloatArray
    assembly: int


def branches(geometry: Geometry, p3: ArrayLike) -> tuple[Branch, ...]:
    """Inverse kinematics in all four working modes, in the order of `WORKING_MODES`."""
    x, y = pair(p3, "p3")
    found = []
    for mode in WORKING_MODES:
        status, q1, q2 = kernels.inverse_kernel(x, y, *geometry.links, *map(float, mode))
        assembly = 0.0
        if status == OK:
            lengths = geometry.proximal, geometry.base
            assembly = differential.assembly_kernel(q1, q2, x, y, *lengths)
        found.append(Branch(mode, Status(status), frozen([q1, q2]), int(assembly)))
    return tuple(found)


def working_mode(geometry: Geometry, q: ArrayLike, assembly: int) -> tuple[int, int]:
    """Working mode (left, right) of joint angles q [rad], shape (2,), in an assembly.

    0 stands for an arm that is exactly stretched or folded: both its modes meet there.

    Raises:
        MechanismError: as `forward`.
    """
    left, right, _ = differential.singularity_kernel(*_pose(geometry, q, assembly), *geometry.links)
    return -int(np.sign(left)), -int(np.sign(right))


def passive_angles(geometry: Geometry, q: ArrayLike, assembly: int = 1) -> PassiveAngles:
    """Angles of the distal links at q [rad], shape (2,).

    Raises:
        MechanismError: as `forward`.
    """
    pose = _pose(geometry, q, assembly)
    return PassiveAngles(*differential.passive_kernel(*pose, *geometry.links))


def singularity(
    geometry: Geometry, q: ArrayLike, assembly: int = 1, tolerance: float = 1e-6
) -> SingularityMeasure:
    """Return how far from singular q [rad], shape (2,), is; named if a sine is within `tolerance`.

    A pose that is singular in both ways is called `PARALLEL`, the one that no motor can hold.

    Raises:
        MechanismError: as `forward`, but not where the elbows coincide.
    """
    q1, q2 = pair(q, "q")
    status, x, y = kernels.forward_kernel(q1, q2, *geometry.links, float(assembly))
    if status == Status.SINGULAR:
        return SingularityMeasure(0.0, 0.0, 0.0, Singularity.PARALLEL)
    check(status, f"joint angles q = ({q1}, {q2}) rad")
    left, right, parallel = differential.singularity_kernel(q1, q2, x, y, *geometry.links)
    return SingularityMeasure(left, right, parallel, _kind(left, right, parallel, tolerance))


def jacobian_rate(geometry: Geometry, q: ArrayLike, qd: ArrayLike, assembly: int = 1) -> FloatArray:
    """Time derivative of the Jacobian at q [rad] and q̇ [rad/s], shapes (2,): shape (2, 2).

    Raises:
        SingularError: if the distal links are in line, or the elbows coincide.
        MechanismError: as `forward`.
    """
    q1, q2, x, y = _pose(geometry, q, assembly)
    v1, v2 = pair(qd, "qd")
    status, *entries = differential.jacobian_rate_kernel(q1, q2, v1, v2, x, y, *geometry.links)
    what = "joint rates" if status == NOT_FINITE else "Jacobian's rate"
    check(status, f"{what} at q = ({q1}, {q2}) rad, q̇ = ({v1}, {v2}) rad/s")
    return np.array(entries).reshape(2, 2)


def dexterity(jacobian: ArrayLike) -> float:
    """Reciprocal condition number of a Jacobian (2, 2): 1 isotropic, 0 singular."""
    (a, b), (c, d) = np.asarray(jacobian, dtype=np.float64)
    return float(differential.dexterity_kernel(a, b, c, d))


def _pose(geometry: Geometry, q: ArrayLike, assembly: int) -> tuple[float, float, float, float]:
    q1, q2 = pair(q, "q")
    x, y = forward(geometry, q, assembly).tolist()
    return q1, q2, x, y


def _kind(left: float, right: float, parallel: float, tolerance: float) -> Singularity:
    if abs(parallel) <= tolerance:
        return Singularity.PARALLEL
    serial = abs(left) <= tolerance, abs(right) <= tolerance
    return {
        (False, False): Singularity.REGULAR,
        (True, False): Singularity.SERIAL_LEFT,
        (False, True): Singularity.SERIAL_RIGHT,
        (True, True): Singularity.SERIAL_BOTH,
    }[serial]
