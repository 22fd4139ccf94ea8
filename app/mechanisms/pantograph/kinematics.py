"""Forward, inverse and differential kinematics of the five-bar, for one pose at a time."""

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.mechanisms.errors import MechanismError
from app.mechanisms.geometry import Geometry
from app.mechanisms.pantograph import kernels
from app.mechanisms.status import check

WORKING_MODE = (1, -1)
"""Elbows outwards: the thesis' own working mode."""


def pair(values: ArrayLike, name: str) -> tuple[float, float]:
    """Two plain numbers of an array of shape (2,).

    Raises:
        MechanismError: if the shape is another one.
    """
    array = np.asarray(values, dtype=np.float64)
    if array.shape != (2,):
        raise MechanismError(
            sentence(
                "{name} has shape {array_shape}; (2,) is needed", name=name, array_shape=array.shape
            )
        )
    return float(array[0]), float(array[1])


def forward(geometry: Geometry, q: ArrayLike, assembly: int = 1) -> FloatArray:
    """Tool point P3 [m], shape (2,), of the joint angles q [rad], shape (2,).

    Args:
        geometry: lengths of the mechanism.
        q: absolute motor angles (left, right) from +x, counterclockwise.
        assembly: +1 for cross(P2' - P2, P3 - P2) > 0 (as built), -1 for the mirrored closure.

    Raises:
        SingularError: if the elbows coincide.
        UnreachableError: if the elbows are more than 2 a2 apart.
        NotFiniteError: if an angle is NaN or infinite.
    """
    q1, q2 = pair(q, "q")
    status, x, y = kernels.forward_kernel(q1, q2, *geometry.links, float(assembly))
    check(status, f"joint angles q = ({q1}, {q2}) rad")
    return np.array([x, y])


def inverse(geometry: Geometry, p3: ArrayLike, mode: tuple[int, int] = WORKING_MODE) -> FloatArray:
    """Joint angles [rad], shape (2,), that bring the tool to `p3` [m], shape (2,), in a mode.

    `forward` of the answer gives `p3` back only where that mode closes in assembly +1.

    Raises:
        UnreachableError: if an arm does not reach.
        DegenerateError: if the point lies on a motor axis.
        NotFiniteError: if a coordinate is NaN or infinite.
    """
    x, y = pair(p3, "p3")
    status, q1, q2 = kernels.inverse_kernel(x, y, *geometry.links, float(mode[0]), float(mode[1]))
    check(status, f"tool point P3 = ({x}, {y}) m")
    return np.array([q1, q2])


def jacobian(geometry: Geometry, q: ArrayLike, assembly: int = 1) -> FloatArray:
    """Jacobian dP3/dq [m/rad], shape (2, 2): rows x, y; columns left, right.

    Raises:
        SingularError: if the distal links are in line, or the elbows coincide.
        UnreachableError: if the elbows are more than 2 a2 apart.
        NotFiniteError: if an angle is NaN or infinite.
    """
    q1, q2 = pair(q, "q")
    x, y = forward(geometry, q, assembly).tolist()
    status, *entries = kernels.jacobian_kernel(q1, q2, x, y, *geometry.links)
    check(status, f"Jacobian at q = ({q1}, {q2}) rad")
    return np.array(entries).reshape(2, 2)
