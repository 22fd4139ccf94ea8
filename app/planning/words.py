"""Rotations of the patient in the words that people use at a table."""

from __future__ import annotations

import numpy as np

from app.core.arrays import FloatArray
from app.core.units import DEGREE

_PLAIN = 10.0 * DEGREE
_SIDES = (("left side", "right side"), ("back", "front"), ("head", "feet"))
_AXES = ("left–right axis", "front–back axis", "head–foot axis")


def rotation_in_words(rotation_vector: FloatArray, R_world_patient: FloatArray) -> str:
    """Say a rotation of the patient: the angle, the axis, and which side comes up.

    Args:
        rotation_vector: about world axes [rad], shape (3,).
        R_world_patient: orientation of the patient before it, LPS → world, shape (3, 3).

    Returns:
        For instance `turn the patient 12.0° about the head–foot axis, left side up`.
    """
    angle = float(np.linalg.norm(rotation_vector))
    if angle < 1e-6 * DEGREE:
        return "leave the patient as is"
    axis = R_world_patient.T @ (rotation_vector / angle)
    words = f"turn the patient {angle / DEGREE:.1f}° about {_axis_words(axis)}"
    rising = rising_side(rotation_vector, R_world_patient)
    return f"{words}, {rising} up" if rising else words


def rising_side(rotation_vector: FloatArray, R_world_patient: FloatArray) -> str:
    """Name the side of the patient that such a rotation lifts; empty if it is about the vertical.

    A point p rises at (ω × p)_z = (ẑ × ω)·p, so the side that rises lies along ẑ × ω.
    """
    up = np.cross([0.0, 0.0, 1.0], rotation_vector)
    norm = float(np.linalg.norm(up))
    if norm < np.sin(_PLAIN) * float(np.linalg.norm(rotation_vector)):
        return ""
    side = R_world_patient.T @ (up / norm)
    order = np.argsort(-np.abs(side))
    named = [i for i in order if abs(side[i]) > np.sin(_PLAIN)]
    return " and ".join(_SIDES[i][0 if side[i] > 0.0 else 1] for i in named)


def _axis_words(axis: FloatArray) -> str:
    largest = int(np.argmax(np.abs(axis)))
    off = float(np.arctan2(np.linalg.norm(np.delete(axis, largest)), abs(axis[largest])))
    if off < _PLAIN:
        return f"the {_AXES[largest]}"
    left, posterior, superior = axis
    return f"the axis (L {left:.2f}, P {posterior:.2f}, S {superior:.2f}) through the entry"
