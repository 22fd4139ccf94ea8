"""The live needle in patient coordinates: what slices and 3D view draw."""

from __future__ import annotations

from dataclasses import dataclass

from app.core.arrays import FloatArray, frozen
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.views.error_overlay import ErrorOverlay


@dataclass(frozen=True, slots=True, eq=False)
class NeedleOverlay:
    """The needle's shaft in LPS [mm].

    Attributes:
        start_mm: hub end of the shaft, shape (3,), read-only.
        tip_mm: tip, shape (3,), read-only.
        valid: whether direction and depth may be trusted; drawn hollow otherwise.
        error: round the tip; None where nobody tells.

    Raises:
        NumericalError: if a coordinate is not finite.
    """

    start_mm: FloatArray
    tip_mm: FloatArray
    valid: bool = True
    error: ErrorOverlay | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "start_mm", frozen(self.start_mm, (3,), "start_mm"))
        object.__setattr__(self, "tip_mm", frozen(self.tip_mm, (3,), "tip_mm"))

    @classmethod
    def of_world(
        cls,
        p_tip: FloatArray,
        axis: FloatArray,
        length: float,
        T_world_patient: RigidTransform,
        valid: bool = True,
        covariance: FloatArray | None = None,
    ) -> NeedleOverlay:
        """Bring a pose in world into the patient.

        Args:
            p_tip: tip in world [m], shape (3,).
            axis: unit direction from hub to tip in world, shape (3,).
            length: of the shaft [m].
            T_world_patient: registration of the patient.
            valid: whether the pose may be trusted.
            covariance: of the tip in world [m²], shape (3, 3); None where nobody tells.
        """
        T_patient_world = T_world_patient.inverse()
        tip, start = T_patient_world @ [p_tip, p_tip - length * axis]
        error = None
        if covariance is not None:
            error = ErrorOverlay.of_world(tip / MILLIMETRE, covariance, T_world_patient.rotation)
        return cls(start / MILLIMETRE, tip / MILLIMETRE, valid, error)
