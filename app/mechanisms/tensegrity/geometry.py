"""Lengths of the spherical tensegrity needle holder, and how its joints are read."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from math import atan, cos, degrees, pi, radians, sin, sqrt, tan
from typing import Final

from app.core.arrays import FloatArray, frozen
from app.mechanisms.errors import MechanismError

Bars = tuple[float, float, float, float, float, float, float, float, float]
"""What the kernels take: (gain1, gain2, fold, cos θ10, sin θ10, cos θ20, sin θ20, cos γ/2,
sin γ/2).

`gain` is tan(s/fold) with s the largest half angle of a pantograph, `fold` the number of rhombi
between A and T, γ the angle between the axes OA1 and OA2.
"""

_LEAST_APART: Final = radians(2.0)


class JointReading(StrEnum):
    """Which spherical linkage stands between a base joint A and the guide's joint T.

    The paper's figures are needed to tell and its text says both (errata C9). `RHOMBUS` is its
    equation 1: one rhombus A, B, T, D of side s = atan(f/R). `SCISSOR` is what its points B to F
    and its cables suggest: two rhombi of side s/2 that meet at C. Both reach 2 s; between, their
    angles θ differ by up to 13.8°.
    """

    RHOMBUS = "rhombus"
    SCISSOR = "scissor"


@dataclass(frozen=True, slots=True)
class TensegrityGeometry:
    """Two spherical pantographs that hold a needle guide over a remote centre O, the origin.

    x0, y0, z0 are the machine's own axes, z0 upwards. The base joints stand at
    A1 = R1 (cos θ10, 0, sin θ10) and A2 = R2 (0, cos θ20, sin θ20); the guide's joint T lies on the
    ray t from O, and the needle's direction from hub to tip is -t. Each pantograph lives on its own
    sphere (errata C3). The defaults are the paper's lengths; it does not give θ10 and θ20: 25° and
    30° are *assumed*, for they cover its 40° cone whether 40° is the full or the half angle.

    Attributes:
        first_radius: R1 [m].
        second_radius: R2 [m].
        first_reach: f1 = |A1 G1| [m]; half the largest θ1 is atan(f1/R1).
        second_reach: f2 [m].
        first_tilt: θ10, elevation of A1 over x0 [rad].
        second_tilt: θ20, elevation of A2 over y0 [rad].
        reading: which linkage the joints make.
        bars: what the kernels take; follows from the others.

    Raises:
        MechanismError: if a length is not positive and finite, a tilt is not within ±89°, the base
            joints lie within 2° of one line through O, or no pose is left that both pantographs
            reach.
    """

    first_radius: float = 0.1339
    second_radius: float = 0.1335
    first_reach: float = 0.200
    second_reach: float = 0.1816
    first_tilt: float = radians(25.0)
    second_tilt: float = radians(30.0)
    reading: JointReading = JointReading.RHOMBUS
    bars: Bars = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        for name in ("first_radius", "second_radius", "first_reach", "second_reach"):
            if not 0.0 < getattr(self, name) < float("inf"):
                raise MechanismError(
                    f"geometry: {name} is {getattr(self, name)} m; a positive length is needed"
                )
        for name in ("first_tilt", "second_tilt"):
            if not abs(getattr(self, name)) <= radians(89.0):
                raise MechanismError(
                    f"geometry: {name} is {degrees(getattr(self, name)):.6g}°; a base joint"
                    " stands within ±89° of its horizontal axis"
                )
        if self.reading not in tuple(JointReading):
            raise MechanismError(
                f"geometry: reading is {self.reading!r}; there are {', '.join(JointReading)}"
            )
        apart, (first, second) = self.apart, self.largest
        if not _LEAST_APART <= apart <= pi - _LEAST_APART:
            raise MechanismError(
                f"geometry: the base joints lie {degrees(apart):.3g}° apart as seen from the"
                " remote centre; they span no sphere within 2° of 0° or 180°: lower a tilt"
            )
        if first + second <= apart:
            raise MechanismError(
                f"geometry: the bars reach {degrees(first):.4g}° and {degrees(second):.4g}°, the"
                f" base joints are {degrees(apart):.4g}° apart: no pose closes both pantographs;"
                " lengthen f1 or f2"
            )
        (side1, side2), half = self.sides, 0.5 * apart
        object.__setattr__(
            self,
            "bars",
            (
                tan(side1),
                tan(side2),
                float(self.rhombi),
                cos(self.first_tilt),
                sin(self.first_tilt),
                cos(self.second_tilt),
                sin(self.second_tilt),
                cos(half),
                sin(half),
            ),
        )

    @property
    def sides(self) -> tuple[float, float]:
        """Angle of one bar as seen from O [rad]: s = atan(f/R), or half of it with `SCISSOR`."""
        fold = self.rhombi
        return (
            atan(self.first_reach / self.first_radius) / fold,
            atan(self.second_reach / self.second_radius) / fold,
        )

    @property
    def rhombi(self) -> int:
        """Number of rhombi between A and T."""
        return 2 if self.reading is JointReading.SCISSOR else 1

    @property
    def largest(self) -> tuple[float, float]:
        """Largest θ1 and θ2 [rad], where β = 0: 2 atan(f/R) in both readings."""
        return (
            2.0 * atan(self.first_reach / self.first_radius),
            2.0 * atan(self.second_reach / self.second_radius),
        )

    @property
    def apart(self) -> float:
        """Angle γ between OA1 and OA2 [rad]."""
        s1, s2 = sin(self.first_tilt), sin(self.second_tilt)
        return pi / 2.0 - atan(s1 * s2 / sqrt(1.0 - (s1 * s2) ** 2))

    @property
    def bases(self) -> FloatArray:
        """Unit vectors a1, a2 to the base joints in machine axes, shape (2, 3)."""
        t1, t2 = self.first_tilt, self.second_tilt
        return frozen([[cos(t1), 0.0, sin(t1)], [0.0, cos(t2), sin(t2)]])

    @property
    def radii(self) -> tuple[float, float]:
        """R1 and R2 [m]."""
        return self.first_radius, self.second_radius
