"""How the patient lies in front of the robot, and the plan in the robot's frame."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen, unit
from app.core.errors import NumericalError
from app.core.messages import sentence
from app.core.rotation import rotation_exp, rotation_log
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.planning.plan import Plan


class PatientOrientation(StrEnum):
    """How the patient lies on the table.

    World x points to the right motor, y away from the motors, z up. Head is always towards +y.
    """

    SUPINE = "supine"
    """On the back: L → +x, S → +y, A → +z."""
    PRONE = "prone"
    """On the belly: R → +x, S → +y, P → +z."""
    LEFT_DOWN = "left_down"
    """On the left side: A → +x, S → +y, R → +z."""
    RIGHT_DOWN = "right_down"
    """On the right side: P → +x, S → +y, L → +z."""

    @property
    def rotation(self) -> FloatArray:
        """Rotation LPS → world, shape (3, 3), read-only; columns: where L, P and S point."""
        left, posterior, superior = _COLUMNS[self]
        return frozen(np.column_stack([left, posterior, superior]))


_X, _Y, _Z = np.eye(3)
_COLUMNS = {
    PatientOrientation.SUPINE: (_X, -_Z, _Y),
    PatientOrientation.PRONE: (-_X, _Z, _Y),
    PatientOrientation.LEFT_DOWN: (-_Z, -_X, _Y),
    PatientOrientation.RIGHT_DOWN: (_Z, _X, _Y),
}


@dataclass(frozen=True, slots=True)
class Placement:
    """A patient orientation, then a free rotation about the fulcrum.

    The free rotation is a rotation vector: its direction is the axis in `world`, its length the
    angle in degrees. For one axis that is the familiar angle about x, y or z; for several there is
    no order to remember and no pose in which an angle is lost.

    Attributes:
        orientation: how the patient lies on the table.
        rotation_deg: free rotation vector about the world's axes [°], applied after `orientation`.

    Raises:
        NumericalError: if the rotation has not three finite numbers within ±360°.
    """

    orientation: PatientOrientation = PatientOrientation.SUPINE
    rotation_deg: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        x, y, z = frozen(self.rotation_deg, (3,), "rotation_deg").tolist()
        if max(abs(x), abs(y), abs(z)) > 360.0:
            raise NumericalError(
                sentence("rotation_deg ({x:g}, {y:g}, {z:g}) must be within ±360°", x=x, y=y, z=z)
            )
        object.__setattr__(self, "orientation", PatientOrientation(self.orientation))
        object.__setattr__(self, "rotation_deg", (x, y, z))

    @property
    def rotation(self) -> FloatArray:
        """Rotation LPS → world, shape (3, 3)."""
        free = rotation_exp(np.asarray(self.rotation_deg) * DEGREE)
        return free @ self.orientation.rotation

    def turned(self, rotation_vector: ArrayLike) -> Placement:
        """Return the placement after one more rotation about world axes [rad], shape (3,)."""
        turn = frozen(rotation_vector, (3,), "rotation vector")
        free = rotation_exp(turn) @ rotation_exp(np.asarray(self.rotation_deg) * DEGREE)
        x, y, z = (rotation_log(free) / DEGREE).tolist()
        return Placement(self.orientation, (x, y, z))

    def T_world_patient(self, plan: Plan, fulcrum: ArrayLike) -> RigidTransform:
        """Registration of the patient (LPS, metres) to the robot.

        The translation is t = P_I − R·P_entry, which puts the entry on the fulcrum for every
        rotation (t = P_I − P_entry of the thesis does so only for R = I).

        Args:
            plan: entry and target.
            fulcrum: P_I in world [m], shape (3,).
        """
        rotation = self.rotation
        entry = plan.entry_mm * MILLIMETRE
        return RigidTransform(rotation, frozen(fulcrum, (3,), "fulcrum") - rotation @ entry)


def placement_of(rotation: ArrayLike) -> Placement:
    """Return the placement of a rotation LPS → world: the orientation that needs least turning.

    Args:
        rotation: proper rotation, shape (3, 3).

    Raises:
        NumericalError: if it is none.
    """
    R_world_patient = frozen(rotation, (3, 3), "rotation")
    vectors = {
        one: rotation_log(R_world_patient @ one.rotation.T) / DEGREE for one in PatientOrientation
    }
    nearest = min(vectors, key=lambda one: float(np.linalg.norm(vectors[one])))
    x, y, z = vectors[nearest].tolist()
    return Placement(nearest, (x, y, z))


@dataclass(frozen=True, slots=True, eq=False)
class PlacedPlan:
    """The plan in `world`, in metres: what the loop, the views and the scoring use.

    Attributes:
        plan: the plan in patient coordinates.
        placement: how the patient lies.
        T_world_patient: registration; takes LPS metres.
        p_entry: entry, which is the fulcrum P_I, shape (3,) [m].
        p_target: target at rest, shape (3,) [m].
        axis: unit vector of the path from entry to target, shape (3,).
    """

    plan: Plan
    placement: Placement
    T_world_patient: RigidTransform
    p_entry: FloatArray
    p_target: FloatArray
    axis: FloatArray

    @classmethod
    def of(cls, plan: Plan, placement: Placement, fulcrum: ArrayLike) -> PlacedPlan:
        """Place `plan`; the path is turned by itself, so that far origins cost it no digits."""
        transform = placement.T_world_patient(plan, fulcrum)
        p_entry = frozen(fulcrum, (3,), "fulcrum")
        path = transform.rotate(plan.target_mm - plan.entry_mm) * MILLIMETRE
        return cls(
            plan, placement, transform, p_entry, frozen(p_entry + path), frozen(unit(path, "path"))
        )

    @property
    def length(self) -> float:
        """Distance from entry to target [m]."""
        return self.plan.length_mm * MILLIMETRE

    @property
    def tilt(self) -> float:
        """Angle between the path and straight down [rad], 0 ... π."""
        return float(np.arctan2(np.hypot(self.axis[0], self.axis[1]), -self.axis[2]))
