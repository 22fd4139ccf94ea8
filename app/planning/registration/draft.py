"""A registration check while it is being made, and a measured place of the patient put to use."""

from dataclasses import dataclass, replace

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import counted, sentence_of
from app.core.rotation import rotation_log
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.planning.placement import Placement
from app.planning.plan import Plan
from app.planning.registration.check import RegistrationCheck
from app.planning.registration.errors import RegistrationError
from app.planning.registration.plate import FiducialPlate
from app.planning.registration.points import NamedPoints
from app.planning.registration.record import FoundPoint, points_of
from app.planning.registration.rigid import FEWEST


@dataclass(frozen=True, slots=True)
class CheckDraft:
    """Points so far; a value, so that `UndoHistory` undoes single touches.

    Attributes:
        touched: in world, in the order of touching.
        picked: in the CT (LPS).
    """

    touched: tuple[FoundPoint, ...] = ()
    picked: tuple[FoundPoint, ...] = ()

    def with_touch(self, name: str, p_world: FloatArray, covariance: FloatArray) -> "CheckDraft":
        """Take a touch [m], [m²]; one of the same fiducial is replaced."""
        return replace(self, touched=_with(self.touched, name, p_world, covariance))

    def with_pick(self, name: str, centre_mm: FloatArray) -> "CheckDraft":
        """Take a bead's centre in the CT (LPS, mm); one of the same fiducial is replaced."""
        point = centre_mm * MILLIMETRE
        return replace(self, picked=_with(self.picked, name, point, np.zeros((3, 3))))

    def without(self, name: str) -> "CheckDraft":
        """Forget what was found of a fiducial."""
        return CheckDraft(
            tuple(one for one in self.touched if one.name != name),
            tuple(one for one in self.picked if one.name != name),
        )

    def check(self, plate: FiducialPlate) -> RegistrationCheck | str:
        """Return the check that the points give, or in words what is still missing."""
        lacking = FEWEST - len(self.touched)
        if lacking > 0:
            return counted("touch {n} more fiducial", "touch {n} more fiducials", lacking)
        lacking = FEWEST - len(self.picked)
        if self.picked and lacking > 0:
            return counted(
                "pick {n} more bead in the CT, or none",
                "pick {n} more beads in the CT, or none",
                lacking,
            )
        try:
            picked = points_of(self.picked) if self.picked else None
            return RegistrationCheck.of(plate, points_of(self.touched), picked)
        except RegistrationError as error:
            return sentence_of(error)


def _with(
    points: tuple[FoundPoint, ...], name: str, point: FloatArray, covariance: FloatArray
) -> tuple[FoundPoint, ...]:
    found = NamedPoints((name,), point[None], covariance[None])
    return (*(one for one in points if one.name != name), *FoundPoint.all_of(found))


def measured_placement(
    T_world_patient: RigidTransform, plan: Plan, placement: Placement, fulcrum: FloatArray
) -> tuple[Plan, Placement, float]:
    """Plan and placement whose T_world_patient is the measured one.

    The needle passes the fulcrum, wherever the patient lies: the entry moves to the point of the
    patient that lies there. With it the computed t = P_I - R·entry is that of the measured one.

    Args:
        T_world_patient: measured.
        plan: the target stays.
        placement: gives the orientation's name; the free rotation is what is left.
        fulcrum: P_I in world [m], shape (3,).

    Returns:
        The plan, the placement, and how far the entry moved [mm].
    """
    entry = T_world_patient.inverse() @ fulcrum / MILLIMETRE
    free = T_world_patient.rotation @ placement.orientation.rotation.T
    x, y, z = (rotation_log(free) / DEGREE).tolist()
    moved = float(np.linalg.norm(entry - plan.entry_mm))
    return plan.with_entry(entry), Placement(placement.orientation, (x, y, z)), moved
