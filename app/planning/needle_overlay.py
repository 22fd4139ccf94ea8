"""The live needle in patient coordinates: what slices and 3D view draw."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from app.core.arrays import FloatArray, frozen, read_only
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.planning.error_overlay import ErrorOverlay


@dataclass(frozen=True, slots=True, eq=False)
class NeedleOverlay:
    """The needle's shaft in LPS [mm].

    Attributes:
        start_mm: hub end of the shaft, shape (3,), read-only.
        tip_mm: tip, shape (3,), read-only.
        valid: whether direction and depth may be trusted; drawn hollow otherwise.
        error: round the tip; None where nobody tells.
        curve_mm: points of a bent shaft from the hub end to the tip, shape (n, 3), read-only; None
            for a straight one.
        points_mm: corners of the drawn shaft from the hub end to the tip, shape (n, 3), read-only.

    Raises:
        NumericalError: if a coordinate is not finite.
    """

    start_mm: FloatArray
    tip_mm: FloatArray
    valid: bool = True
    error: ErrorOverlay | None = None
    curve_mm: FloatArray | None = None
    points_mm: FloatArray = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "start_mm", frozen(self.start_mm, (3,), "start_mm"))
        object.__setattr__(self, "tip_mm", frozen(self.tip_mm, (3,), "tip_mm"))
        if self.curve_mm is not None:
            shape = (len(self.curve_mm), 3)
            object.__setattr__(self, "curve_mm", frozen(self.curve_mm, shape, "curve_mm"))
        points = self.curve_mm
        if points is None:  # asked for by every layer of every pane
            points = read_only(np.stack([self.start_mm, self.tip_mm]))
        object.__setattr__(self, "points_mm", points)

    @property
    def tip_direction(self) -> FloatArray:
        """Return where the tip points, not of unit length, shape (3,)."""
        result: FloatArray = self.points_mm[-1] - self.points_mm[-2]
        return result

    @classmethod
    def of_world(
        cls,
        p_tip: FloatArray,
        axis: FloatArray,
        length: float,
        T_world_patient: RigidTransform,
        valid: bool = True,
        covariance: FloatArray | None = None,
        curve: FloatArray | None = None,
    ) -> NeedleOverlay:
        """Bring a pose in world into the patient.

        Args:
            p_tip: tip in world [m], shape (3,).
            axis: unit direction from hub to tip in world, shape (3,).
            length: of the shaft [m].
            T_world_patient: registration of the patient.
            valid: whether the pose may be trusted.
            covariance: of the tip in world [m²], shape (3, 3); None where nobody tells.
            curve: points of the bent part in world [m] from the entry to the tip, shape (n, 3);
                None for a straight needle. The shaft outside is straight.
        """
        T_patient_world = T_world_patient.inverse()
        p_start = p_tip - length * axis
        if curve is not None:
            inside = float(np.linalg.norm(np.diff(curve, axis=0), axis=1).sum())
            p_start = curve[0] - max(length - inside, 0.0) * axis
        tip, start = T_patient_world @ [p_tip, p_start]
        bent = None
        if curve is not None:
            bent = np.vstack([start, T_patient_world @ curve]) / MILLIMETRE
        error = None
        if covariance is not None:
            error = ErrorOverlay.of_world(tip / MILLIMETRE, covariance, T_world_patient.rotation)
        return cls(start / MILLIMETRE, tip / MILLIMETRE, valid, error, bent)
