"""Defects of the hand's hard cases: what takes little for nothing, half a condition for a whole."""

from dataclasses import replace
from math import atan2, cos, nan, sin, sqrt
from typing import Any

import numpy as np

from app.arm.hand import (
    Contacts,
    FingerPose,
    HandFinger,
    HandGeometry,
    force_closure,
    forward,
    inverse,
    positively_spanned,
    wrenches,
)
from app.arm.hard_cases.hand import pressed
from app.core.arrays import FloatArray
from tests.hard.defects import Defect


def kept_turn(geometry: HandGeometry, p: Any, finger: HandFinger) -> FingerPose:
    # Whatever is within a micrometre of the axis is on it.
    return inverse(geometry, np.where(np.abs(p) < 1e-6, 0.0, p), finger)


def printed_joints(geometry: HandGeometry, p: Any) -> FloatArray:
    # 3.2.2 as it is printed: the root of 1 - c².
    rho, z = p[0] - geometry.knuckle, p[2]
    l2, l3 = geometry.proximal, geometry.distal
    c = (rho * rho + z * z - l2 * l2 - l3 * l3) / (2.0 * l2 * l3)
    inner = atan2(sqrt(1.0 - c * c) if c <= 1.0 else nan, c)
    lead = atan2(l3 * sin(inner), l2 + l3 * cos(inner))
    return np.array([0.0, atan2(z, rho) - lead, inner])


def by_differences(geometry: HandGeometry, q: Any) -> FloatArray:
    steps = 1e-7 * np.eye(3)
    return np.column_stack(
        [(forward(geometry, q + h) - forward(geometry, q - h)) / 2e-7 for h in steps]
    )


def spread_of_zeros(geometry: HandGeometry, p: Any, finger: HandFinger, _: float) -> FingerPose:
    return inverse(geometry, p, finger, phi1_now=atan2(p[1], p[0]))


def least_friction(contacts: Contacts, **given: Any) -> Any:
    # Friction below a hundredth taken for one, so that no cone degenerates.
    return force_closure(replace(contacts, friction=max(contacts.friction, 0.01)), **given)


def single(contacts: Contacts, **_: Any) -> Any:
    # Normals of single precision.
    return force_closure(replace(contacts, normals=contacts.normals.astype(np.float32)))


def rank_alone(contacts: Contacts, **_: Any) -> Any:
    found = force_closure(contacts)
    return replace(found, closed=found.rank == 6)


def weights_alone(contacts: Contacts, **_: Any) -> Any:
    found = force_closure(contacts)
    return replace(found, closed=positively_spanned(wrenches(contacts).rays))


DEFECTS = {
    "kinematics": {
        "joints of a finger whose point is on its spread axis": Defect(
            "spread by the arc tangent of zeros", spread_of_zeros
        ),
        "joints of a finger whose point is 1 nm beside its spread axis": Defect(
            "a point within 1 µm is on the axis", kept_turn
        ),
        "joints of a finger where the arccos would be of 1 + 2.2e-16": Defect(
            "root of 1 - c², as equation 3.2.2 is printed", printed_joints
        ),
        "Jacobian of a finger whose point is 11 µm beside its spread axis": Defect(
            "central differences of 1e-7 rad", by_differences
        ),
    },
    "grasping": {
        **dict.fromkeys(
            (
                "margin of two opposed contacts with friction 1e-9",
                "the hand on a cylinder without friction",
            ),
            Defect("friction below 0.01 taken for 0.01", least_friction),
        ),
        "margin where the line of two contacts is 1e-9 rad inside a cone": Defect(
            "normals of single precision", single
        ),
        "three contacts on one line, which none of them can turn": Defect(
            "positive weights, without the rank", weights_alone
        ),
        "contacts whose normals are parallel, and all push one way": Defect(
            "rank, without positive weights", rank_alone
        ),
        "a firm grasp of something as stiff as 1e9 N/m": Defect(
            "the gain for something a hundred times as soft", lambda _: pressed(100.0)
        ),
    },
}
