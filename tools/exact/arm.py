"""The arm in many digits: plain products of rotations, law of cosines, arccosines."""

from typing import Any

import mpmath  # type: ignore[import-untyped]
import numpy as np
from mpmath import acos, atan2, cos, matrix, mpf, sin, sqrt

from app.arm.mechanics import forward, load_arm
from tools.exact import exact

FOLDER = "app/arm/hard_cases"

ARM = load_arm()


def lengths() -> tuple[Any, Any, Any]:
    """d1, d3, d5 as the doubles they are."""
    return mpf(ARM.pedestal), mpf(ARM.upper_arm), mpf(ARM.forearm)


def rz(angle: Any) -> Any:
    """Turn about z."""
    return matrix([[cos(angle), -sin(angle), 0], [sin(angle), cos(angle), 0], [0, 0, 1]])


def ry(angle: Any) -> Any:
    """Turn about y."""
    return matrix([[cos(angle), 0, sin(angle)], [0, 1, 0], [-sin(angle), 0, cos(angle)]])


def elbow_down(x: Any, y: Any, z: Any) -> tuple[Any, Any, Any]:
    """θ1, θ2, θ4 with θ3 = 0 and θ4 > 0, by the law of cosines."""
    d1, a, b = lengths()
    rise, aside = z - d1, sqrt(x**2 + y**2)
    square = aside**2 + rise**2
    lean = acos((a**2 + square - b**2) / (2 * a * sqrt(square)))
    return atan2(y, x), atan2(aside, rise) + lean, acos((square - a**2 - b**2) / (2 * a * b))


def decoupled(x: Any, y: Any, z: Any, *entries: Any) -> list[Any]:
    """Joint angles with θ3 = 0, θ1 = atan2(y, x), θ4 > 0 and θ6 > 0."""
    first, second, fourth = elbow_down(x, y, z)
    hand = matrix([list(entries[3 * i : 3 * i + 3]) for i in range(3)])
    m = (rz(first) * ry(second - fourth)).T * hand
    sixth = atan2(sqrt(m[0, 2] ** 2 + m[1, 2] ** 2), m[2, 2])
    return [
        first,
        second,
        mpf(0),
        fourth,
        atan2(m[1, 2], m[0, 2]),
        sixth,
        atan2(m[2, 1], -m[2, 0]),
    ]


def across(axis: Any, vector: Any) -> Any:
    """Part of a vector across a unit axis."""
    along = (axis.T * vector)[0]
    return vector - axis * along


def given_pose(q: list[float]) -> list[float]:
    """Position and rotation, row by row, in doubles."""
    there = forward(ARM, q)
    return [*there.translation.tolist(), *there.rotation.ravel().tolist()]


_BESIDE = [1e-9 * 0.6, 1e-9 * 0.8, 0.9, *given_pose([0.3, 0.2, 0.1, 0.9, 0.4, 0.6, 0.2])[3:]]


@exact("arm, wrist centre 1 nm from the first axis", "law of cosines, arccosines", *_BESIDE)
def _(*given: Any) -> Any:
    return decoupled(*given)


@exact(
    "arm, sixth joint 1e-8 rad from aligned",
    "product of rotations",
    *given_pose([0.3, 0.7, 0.0, 0.9, 0.4, 1e-8, 0.2]),
)
def _(*given: Any) -> Any:
    return [decoupled(*given)[5]]


for short in (1e-6, 1e-12):
    away = (ARM.upper_arm + ARM.forearm) * (1.0 - short) * np.array([0.48, 0.64, 0.6])
    away[2] += ARM.pedestal

    @exact(
        f"arm, wrist centre {short:g} short of stretched",
        "law of cosines",
        *away.tolist(),
    )
    def _(x: Any, y: Any, z: Any) -> Any:
        return list(elbow_down(x, y, z))[1:]


@exact(
    "arm angle, elbow 1e-9 rad from stretched",
    "between the places of two elbows",
    *[0.3, 0.7, 0.5, 1e-9, 0.4, 0.6, 0.2],
)
def _(*q: Any) -> Any:
    _, a, b = lengths()
    up = matrix([0, 0, 1])
    shoulder = rz(q[0]) * ry(q[1]) * rz(q[2])
    elbow = a * shoulder * up
    wrist = elbow + b * shoulder * ry(-q[3]) * up
    first, second, _ = elbow_down(wrist[0], wrist[1], wrist[2] + lengths()[0])
    axis = wrist / mpmath.norm(wrist)
    zero = across(axis, a * rz(first) * ry(second) * up)
    here = across(axis, elbow)
    normal = matrix(
        [
            zero[1] * here[2] - zero[2] * here[1],
            zero[2] * here[0] - zero[0] * here[2],
            zero[0] * here[1] - zero[1] * here[0],
        ]
    )
    return [atan2((axis.T * normal)[0], (zero.T * here)[0])]
