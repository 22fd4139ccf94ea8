"""What the tensegrity needle holder is made of: lengths, how joints are read, cables, bars, masses.

Plain values without compiled code, so that a profile is read without it.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from math import atan, cos, degrees, isfinite, pi, radians, sin, sqrt, tan
from typing import Final

from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
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
                    sentence(
                        "geometry: {name} is {length} m; a positive length is needed",
                        name=name,
                        length=getattr(self, name),
                    )
                )
        for name in ("first_tilt", "second_tilt"):
            if not abs(getattr(self, name)) <= radians(89.0):
                raise MechanismError(
                    sentence(
                        "geometry: {name} is {degrees:.6g}°; a base joint"
                        " stands within ±89° of its horizontal axis",
                        name=name,
                        degrees=degrees(getattr(self, name)),
                    )
                )
        if self.reading not in tuple(JointReading):
            raise MechanismError(
                sentence(
                    "geometry: reading is {reading!r}; there are {joint_reading}",
                    reading=self.reading,
                    joint_reading=", ".join(JointReading),
                )
            )
        apart, (first, second) = self.apart, self.largest
        if not _LEAST_APART <= apart <= pi - _LEAST_APART:
            raise MechanismError(
                sentence(
                    "geometry: the base joints lie {degrees:.3g}° apart as seen from the"
                    " remote centre; they span no sphere within 2° of 0° or 180°: lower a tilt",
                    degrees=degrees(apart),
                )
            )
        if first + second <= apart:
            raise MechanismError(
                sentence(
                    "geometry: the bars reach {first_reach_deg:.4g}° and "
                    "{second_reach_deg:.4g}°, the"
                    " base joints are {apart_deg:.4g}° apart: no pose closes both pantographs;"
                    " lengthen f1 or f2",
                    first_reach_deg=degrees(first),
                    second_reach_deg=degrees(second),
                    apart_deg=degrees(apart),
                )
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


@dataclass(frozen=True, slots=True)
class Cables:
    """Elastic law and limits of the four cables, alike for all; every value is *assumed*.

    Attributes:
        stiffness: k0 of a cable from joint to winch [N/m]; the default is that of 1.5 m of steel
            rope of 1 mm.
        stiffening: c [1/m] of dt/dx = k0 + c t; 0 is a spring of constant stiffness, more a cable
            that stiffens with tension.
        least: smallest tension, at which a cable still runs on its pulleys [N].
        most: largest tension [N].

    Raises:
        MechanismError: if a value is not finite, the stiffness not positive, the stiffening
            negative, or the limits do not leave 0 ≤ least < most.
    """

    stiffness: float = 20e3
    stiffening: float = 0.0
    least: float = 2.0
    most: float = 60.0

    def __post_init__(self) -> None:
        for name in ("stiffness", "stiffening", "least", "most"):
            if not isfinite(getattr(self, name)):
                raise MechanismError(
                    sentence(
                        "cables: {name} is {quantity}; give a number",
                        name=name,
                        quantity=getattr(self, name),
                    )
                )
        if not self.stiffness > 0.0 or self.stiffening < 0.0:
            raise MechanismError(
                sentence(
                    "cables: stiffness {stiffness} N/m, stiffening {stiffening} 1/m; the"
                    " first must be positive, the second 0 or more",
                    stiffness=self.stiffness,
                    stiffening=self.stiffening,
                )
            )
        if not 0.0 <= self.least < self.most:
            raise MechanismError(
                sentence(
                    "cables: tensions from {least} to {most} N; a cable pulls, so the least"
                    " is 0 or more, and below the most",
                    least=self.least,
                    most=self.most,
                )
            )

    @property
    def law(self) -> tuple[float, float, float, float]:
        """(k0, c, least, most): what the kernels take."""
        return self.stiffness, self.stiffening, self.least, self.most


@dataclass(frozen=True, slots=True)
class CurvedBars:
    """Material and section of the bars, square; all *assumed*: printed plastic, 12 mm.

    Attributes:
        modulus: Young's modulus E [Pa].
        shear_modulus: G [Pa].
        width: of the section [m].

    Raises:
        MechanismError: if a value is not positive and finite.
    """

    modulus: float = 2.0e9
    shear_modulus: float = 0.74e9
    width: float = 0.012

    def __post_init__(self) -> None:
        for name in ("modulus", "shear_modulus", "width"):
            value = getattr(self, name)
            if not (isfinite(value) and value > 0.0):
                raise MechanismError(
                    sentence(
                        "bars: {name} is {quantity}; a positive number is needed",
                        name=name,
                        quantity=value,
                    )
                )


@dataclass(frozen=True, slots=True)
class GuideMasses:
    """What the needle holder weighs, all *assumed*: printed bars of 12 mm and a guide of 80 g.

    Attributes:
        density: mass of a bar by its length [kg/m].
        guide_mass: of the guide [kg].
        guide_centre: of its mass, from O towards T [m].
        guide_inertia: about its own middle, across its axis [kg·m²].

    Raises:
        MechanismError: if a value is negative or not finite.
    """

    density: float = 0.17
    guide_mass: float = 0.08
    guide_centre: float = 0.134
    guide_inertia: float = 2.0e-5

    def __post_init__(self) -> None:
        for name in ("density", "guide_mass", "guide_centre", "guide_inertia"):
            if not (isfinite(getattr(self, name)) and getattr(self, name) >= 0.0):
                raise MechanismError(
                    sentence(
                        "masses: {name} is {mass}; a number from 0 on is needed",
                        name=name,
                        mass=getattr(self, name),
                    )
                )

    @property
    def along(self) -> tuple[float, float]:
        """Return Σ m r² [kg·m²] and Σ m r [kg·m] of the guide along t."""
        first = self.guide_mass * self.guide_centre
        return first * self.guide_centre + self.guide_inertia, first
