"""What Acus tells by OpenIGTLink: its names, frames (RAS, millimetres, as Slicer has them), words.

| device | type | is |
|---|---|---|
| `NeedleToRas` | TRANSFORM | the straight needle: origin at its tip, +z out of it along the shaft |
| `NeedleTipToRas` | TRANSFORM | the tip, of a bent needle where it bends and as it goes on |
| `HubToRas` | TRANSFORM | the end in the hand, turned as the needle |
| `WorldToRas` | TRANSFORM | the robot's frame in the patient: how he lies |
| `Plan` | POINT | `Entry` and `Target` |
| `ControlScan` | IMAGE | the newest control scan, Hounsfield units |
| `Events` | STRING | what happens, a line each |
| `Acus` | STATUS | every second: 1 needle measured, 13 not measured now, 16 no needle |
"""

from __future__ import annotations

from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.exchange.live import igtl_messages as igtl
from app.exchange.moment import (
    LiveEvent,
    LiveMoment,
    LivePlan,
    LiveScan,
    Validity,
    needle_rotation,
)

F: Final = np.diag([-1.0, -1.0, 1.0])
"""LPS to RAS, and back."""

_LARGEST_MM: Final = 1e6


def ras_matrix(rotation: FloatArray, p_patient: FloatArray) -> FloatArray:
    """Return a pose in RAS [mm], shape (4, 4).

    Args:
        rotation: of its frame in the patient (LPS), shape (3, 3).
        p_patient: its origin, LPS [m], shape (3,).
    """
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = F @ rotation, F @ p_patient / MILLIMETRE
    return matrix


def poses(moment: LiveMoment, version: int) -> list[bytes]:
    """Return the messages of a moment: transforms of the needle.

    A version 1 header cannot say that a pose is not valid: then none is sent, and Slicer sees that
    it grows old. Version 2 has the last one with PLUS' words on it.
    """
    needle, plan = moment.needle, moment.plan
    if needle is None or plan is None:
        return []
    valid = needle.validity is Validity.OK
    if not valid and version < 2:
        return []
    to_patient = plan.T_world_patient.inverse()
    shaft = needle_rotation(to_patient.rotate(needle.axis))
    tip = needle_rotation(_unit(to_patient.rotate(needle.tip_axis)))
    matrices = {
        "NeedleToRas": ras_matrix(shaft, to_patient @ needle.p_straight),
        "NeedleTipToRas": ras_matrix(tip, to_patient @ needle.p_tip),
        "HubToRas": ras_matrix(shaft, to_patient @ needle.p_hub),
    }
    said = {"TransformValid": "1" if valid else "0", "TransformStatus": needle.validity.value}
    return [
        igtl.packed("TRANSFORM", name, needle.wall, igtl.transform(matrix), version, said)
        for name, matrix in matrices.items()
        if np.abs(matrix).max() < _LARGEST_MM
    ]


def planned(plan: LivePlan, wall: float, version: int) -> list[bytes]:
    """Return entry, target and how the patient lies."""
    found = tuple(
        igtl.NamedPoint(name, _place_mm(place), colour)
        for name, place, colour in (
            ("Entry", plan.p_entry, (0, 255, 0, 255)),
            ("Target", plan.p_target, (255, 0, 0, 255)),
        )
    )
    world = plan.T_world_patient.inverse()
    matrix = ras_matrix(world.rotation, world.translation)
    return [
        igtl.packed("POINT", "Plan", wall, igtl.points(found), version),
        igtl.packed("TRANSFORM", "WorldToRas", wall, igtl.transform(matrix), version),
    ]


def scanned(scan: LiveScan, version: int) -> bytes:
    """Return a control scan."""
    ijk_to_ras = np.diag([-1.0, -1.0, 1.0, 1.0]) @ scan.affine_mm
    return igtl.packed("IMAGE", "ControlScan", scan.wall, igtl.image(scan.hu, ijk_to_ras), version)


def happened(event: LiveEvent, version: int) -> bytes:
    """Return an event."""
    text = igtl.string(f"{event.kind}: {event.message}")
    return igtl.packed("STRING", "Events", event.wall, text, version, number=event.number)


def state(moment: LiveMoment, version: int) -> bytes:
    """Return how it is, the keep-alive."""
    needle = moment.needle
    code, name, words = igtl.STATUS_NOT_PRESENT, "NOT_PRESENT", "no needle is told of"
    if needle is not None and needle.validity is Validity.OK:
        code, name, words = igtl.STATUS_OK, "OK", moment.state
    elif needle is not None:
        code, name = igtl.STATUS_NOT_READY, "NOT_READY"
        words = f"{moment.state}: the needle is {needle.validity.value}"
    return igtl.packed("STATUS", "Acus", moment.wall, igtl.status(code, name, words), version)


def _place_mm(p_patient: FloatArray) -> tuple[float, float, float]:
    x, y, z = (F @ p_patient / MILLIMETRE).tolist()
    return x, y, z


def _unit(vector: FloatArray) -> FloatArray:
    found: FloatArray = vector / np.linalg.norm(vector)
    return found
