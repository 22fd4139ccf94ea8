"""Error ellipsoids in patient coordinates: what slices and 3D view draw."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from math import atan2, hypot, sqrt

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.core.confidence import chi_square_quantile
from app.core.units import MILLIMETRE

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
        """Return how many times the 3D view enlarges it: `ERROR_SCALE`, or 1 if it is large
        itself.
        """
        largest = float(np.linalg.eigvalsh(self.covariance_mm2)[-1])
        return 1.0 if chi_square_quantile(0.95, 3) * largest > LARGE_MM**2 else ERROR_SCALE

    def ellipse_mm(self, right: FloatArray, down: FloatArray) -> tuple[float, float, float]:
        """Half axes [mm] of the ellipsoid seen along a plane's normal, and the first one's angle.

        The shadow of the ellipsoid that holds the point with 95 % (chi-square with three degrees
        of freedom), not the smaller ellipse of two: what lies outside it is outside the ellipsoid.
        Of the covariance C in the plane, the squares of the half axes are those of the values
        (C₁₁ + C₂₂)/2 ± √((C₁₁ − C₂₂)²/4 + C₁₂²), the first along atan2(2 C₁₂, C₁₁ − C₂₂)/2.

        Args:
            right: unit vector of the plane, shape (3,).
            down: unit vector of the plane, perpendicular, shape (3,).

        Returns:
            The longer and the shorter half axis [mm], and the angle of the longer one from `right`
            towards `down` [rad].
        """
        across = self.covariance_mm2 @ right
        a, b = float(across @ right), float(across @ down)
        c = float(down @ self.covariance_mm2 @ down)
        middle, off = (a + c) / 2.0, hypot((a - c) / 2.0, b)
        far, near = (
            sqrt(_chi_square() * max(v, SMALLEST_MM**2)) for v in (middle + off, middle - off)
        )
        return far, near, 0.5 * atan2(2.0 * b, a - c)


@cache
def _chi_square() -> float:
    """Square of how many standard deviations of three hold a point with 95 %."""
    return chi_square_quantile(0.95, 3)


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
