"""Error ellipsoids in patient coordinates: what slices and 3D view draw."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.core.confidence import chi_square_quantile
from app.core.units import MILLIMETRE

POINTS = 48
SMALLEST_MM = 1e-4
ERROR_SCALE = 10.0
"""The 3D view enlarges ellipsoids so much, and says so: true ones vanish inside the needle."""

LARGE_MM = 6.0
"""Ellipsoids with a longer half axis are drawn as they are: enlarged they hide the patient."""

PATIENCE = 30
"""Pictures after which another scale is taken: a tip not seen for a moment changes nothing."""


@dataclass(frozen=True, slots=True, eq=False)
class ErrorOverlay:
    """Where a point truly is with 95 %.

    Attributes:
        centre_mm: LPS, shape (3,).
        covariance_mm2: LPS, shape (3, 3).

    Raises:
        NumericalError: if a number is not finite.
    """

    centre_mm: FloatArray
    covariance_mm2: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "centre_mm", frozen(self.centre_mm, (3,), "centre_mm"))
        object.__setattr__(
            self, "covariance_mm2", frozen(self.covariance_mm2, (3, 3), "covariance_mm2")
        )

    @classmethod
    def of_world(
        cls, centre_mm: FloatArray, covariance: FloatArray, R_world_patient: FloatArray
    ) -> ErrorOverlay:
        """Bring a covariance in world [m²], shape (3, 3), to a point of the patient [mm]."""
        turned = R_world_patient.T @ covariance @ R_world_patient
        return cls(centre_mm, turned / MILLIMETRE**2)

    @property
    def scale(self) -> float:
        """How many times the 3D view enlarges it: `ERROR_SCALE`, or 1 if it is large itself."""
        largest = float(np.linalg.eigvalsh(self.covariance_mm2)[-1])
        return 1.0 if chi_square_quantile(0.95, 3) * largest > LARGE_MM**2 else ERROR_SCALE

    def outline_mm(self, across: FloatArray) -> FloatArray:
        """Outline of the ellipsoid seen along a plane's normal, from its centre, shape (48, 2).

        The shadow of the ellipsoid that holds the point with 95 % (chi-square with three degrees
        of freedom), not the smaller ellipse of two: what lies outside it is outside the ellipsoid.

        Args:
            across: plane coordinates of the three LPS axes [mm/mm], shape (2, 3).
        """
        values, vectors = np.linalg.eigh(across @ self.covariance_mm2 @ across.T)
        axes = vectors * np.sqrt(chi_square_quantile(0.95, 3) * np.maximum(values, SMALLEST_MM**2))
        turn = np.linspace(0.0, 2.0 * np.pi, POINTS, endpoint=False)
        outline: FloatArray = np.column_stack([np.cos(turn), np.sin(turn)]) @ axes.T
        return outline


class Enlargement:
    """The scale at which the 3D view draws the tip's error; it does not flicker.

    Attributes:
        scale: 1 or `ERROR_SCALE`; 0 while there is nothing to draw.
    """

    def __init__(self) -> None:
        self.scale, self._against = 0.0, 0

    def follow(self, error: ErrorOverlay | None) -> float:
        """Take the next picture's error; return the scale to draw it at."""
        wanted = 0.0 if error is None else error.scale
        self._against = 0 if wanted == self.scale else self._against + 1
        if self._against > PATIENCE or 0.0 in (wanted, self.scale):
            self.scale, self._against = wanted, 0
        return self.scale
