"""Inverse kinematics by iteration: damped least squares (Levenberg and Marquardt), within limits.

For comparison with the closed form, and for the pose nearest to one that is out of reach. A step
solves (J Jᵀ + λ) y = e, Δq = Jᵀ y; it is taken if the error falls, and λ follows. A joint at a
limit that the error pushes outwards is held there for the step.
"""

from dataclasses import dataclass
from math import atan2, pi, sqrt
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.arm.mechanics.kernels import Three, forward_kernel, jacobian_kernel
from app.arm.mechanics.kinematics import pose_arrays, seven
from app.arm.mechanics.profile import JOINTS, ArmProfile
from app.core.arrays import FloatArray, frozen
from app.core.compiled import njit
from app.core.transform import RigidTransform

STEPS: Final = 200
"""Most steps from one start."""

CLOSED: Final = 1e-11
"""Error at which a pose is reached [m], with turns weighed by `TURN_LENGTH`."""

TURN_LENGTH: Final = 0.25
"""What a turn by one radian counts as [m]."""

WORK: Final = (19, JOINTS)
"""Shape of the kernel's scratch."""


@dataclass(frozen=True, slots=True, eq=False)
class Iterated:
    """What the iteration ended with.

    Attributes:
        q: joint angles [rad], shape (7,).
        steps: how many it took.
        error: what is left [m], with turns weighed by `TURN_LENGTH`.
        closed: whether the pose is reached.
    """

    q: FloatArray
    steps: int
    error: float
    closed: bool


@njit
def _product(a: FloatArray, b: FloatArray, i: int, j: int) -> float:
    # Entry of a bᵀ.
    return a[i, 0] * b[j, 0] + a[i, 1] * b[j, 1] + a[i, 2] * b[j, 2]


@njit
def twist_kernel(
    rotation: FloatArray,
    position: FloatArray,
    to_rotation: FloatArray,
    to_position: FloatArray,
    out: FloatArray,
) -> float:
    """Fill shift and rotation vector (6,) from one pose to another, in the base's axes.

    Returns the size of it [m], turns weighed by `TURN_LENGTH`.
    """
    for i in range(3):
        out[i] = to_position[i] - position[i]
    a, b = to_rotation, rotation
    # E = R_to Rᵀ turns by θ about n: ½ (E - Eᵀ) holds sin θ n, the trace 1 + 2 cos θ.
    out[3] = 0.5 * (_product(a, b, 2, 1) - _product(a, b, 1, 2))
    out[4] = 0.5 * (_product(a, b, 0, 2) - _product(a, b, 2, 0))
    out[5] = 0.5 * (_product(a, b, 1, 0) - _product(a, b, 0, 1))
    trace = _product(a, b, 0, 0) + _product(a, b, 1, 1) + _product(a, b, 2, 2) - 1.0
    sine = sqrt(out[3] * out[3] + out[4] * out[4] + out[5] * out[5])
    if sine > 1e-9:
        scale = atan2(sine, 0.5 * trace) / sine
        out[3] *= scale
        out[4] *= scale
        out[5] *= scale
    elif trace < 0.0:  # half a turn: any axis takes the first step
        out[3], out[4], out[5] = pi, 0.0, 0.0
    total = 0.0
    for i in range(3):
        total += out[i] * out[i] + (TURN_LENGTH * out[3 + i]) ** 2
    return sqrt(total)


@njit
def _solve_six(a: FloatArray, b: FloatArray) -> None:
    # Cholesky of a symmetric positive matrix (6, 6), in place; b becomes the solution.
    for j in range(6):
        for i in range(j, 6):
            value = a[i, j]
            for k in range(j):
                value -= a[i, k] * a[j, k]
            a[i, j] = sqrt(max(value, 1e-300)) if i == j else value / a[j, j]
    for i in range(6):
        for k in range(i):
            b[i] -= a[i, k] * b[k]
        b[i] /= a[i, i]
    for i in range(5, -1, -1):
        for k in range(i + 1, 6):
            b[i] -= a[k, i] * b[k]
        b[i] /= a[i, i]


@njit
def iterate_kernel(
    to_rotation: FloatArray,
    to_position: FloatArray,
    lengths: Three,
    lower: FloatArray,
    upper: FloatArray,
    steps: int,
    q: FloatArray,
    work: FloatArray,
) -> tuple[float, int]:
    """Move joint angles (7,) in place towards a pose, within limits: (error [m], steps taken).

    `work` is scratch of shape `WORK`. Ends when the pose is reached, or nothing falls any more.
    """
    jacobian, product = work[0:6], work[6:12, :6]
    rotation, position = work[12:15, :3], work[15, :3]
    twist, trial, step = work[16, :6], work[17], work[18]
    at = (0.0, 0.0, 0.0)
    for k in range(JOINTS):
        q[k] = max(lower[k], min(upper[k], q[k]))
    forward_kernel(q, lengths, rotation, position)
    error = twist_kernel(rotation, position, to_rotation, to_position, twist)
    damping = 1e-3
    for count in range(steps):
        if error <= CLOSED or damping > 1e8:
            return error, count
        jacobian_kernel(q, lengths, at, jacobian)
        for i in range(3):
            twist[3 + i] *= TURN_LENGTH
            for k in range(JOINTS):
                jacobian[3 + i, k] *= TURN_LENGTH
        for k in range(JOINTS):
            push = 0.0
            for i in range(6):
                push += jacobian[i, k] * twist[i]
            if (q[k] >= upper[k] and push > 0.0) or (q[k] <= lower[k] and push < 0.0):
                for i in range(6):
                    jacobian[i, k] = 0.0
        for i in range(6):
            for j in range(6):
                value = damping if i == j else 0.0
                for k in range(JOINTS):
                    value += jacobian[i, k] * jacobian[j, k]
                product[i, j] = value
        _solve_six(product, twist)
        largest = 0.0
        for k in range(JOINTS):
            step[k] = 0.0
            for i in range(6):
                step[k] += jacobian[i, k] * twist[i]
            largest = max(largest, abs(step[k]))
        shorten = 1.0 if largest <= 1.0 else 1.0 / largest
        for k in range(JOINTS):
            trial[k] = max(lower[k], min(upper[k], q[k] + shorten * step[k]))
        forward_kernel(trial, lengths, rotation, position)
        found = twist_kernel(rotation, position, to_rotation, to_position, twist)
        if found < error:
            error, damping = found, max(0.2 * damping, 1e-12)
            for k in range(JOINTS):
                q[k] = trial[k]
        else:
            damping *= 5.0
            forward_kernel(q, lengths, rotation, position)
            twist_kernel(rotation, position, to_rotation, to_position, twist)
    return error, steps


def starts(arm: ArmProfile, count: int) -> FloatArray:
    """Joint angles spread evenly over the limits, shape (count, 7); the first is their middle.

    Kronecker's sequence on the powers of the root of x⁸ = x + 1: the same in every run.
    """
    root = 1.0
    for _ in range(60):
        root = (1.0 + root) ** 0.125
    shares = np.mod(0.5 + np.outer(np.arange(count), root ** -np.arange(1.0, JOINTS + 1)), 1.0)
    result: FloatArray = arm.lower + shares * (arm.upper - arm.lower)
    return result


def iterate(
    arm: ArmProfile, pose: RigidTransform, start: ArrayLike, steps: int = STEPS
) -> Iterated:
    """Damped least squares from `start` [rad], shape (7,), within the joint limits.

    It may end beside the pose: at a limit, or where the error has another minimum; `closed` says.

    Raises:
        MechanismError: as `forward`.
    """
    q = seven(start, "start").copy()
    rotation, position = pose_arrays(pose)
    error, taken = iterate_kernel(
        rotation, position, arm.lengths, arm.lower, arm.upper, steps, q, np.empty(WORK)
    )
    return Iterated(frozen(q), int(taken), float(error), bool(error <= CLOSED))
