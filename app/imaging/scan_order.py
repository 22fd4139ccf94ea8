"""A control scan as values: which slices, where the needle is, what of it can be seen in them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import pairwise
from math import cos, isfinite, radians, sin

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.core.errors import NumericalError
from app.core.messages import sentence
from app.imaging.errors import ScanOrderError
from app.imaging.volume import Volume

FEWEST, MOST = 3, 5
"""Slices of one control scan."""

THINNEST_MM, THICKEST_MM = 0.5, 10.0
"""Thickness of a slice."""

SHORTEST_MM = 1e-5
"""Pieces of a bent needle below this have no direction."""

WIDEST_MM = 50.0
"""Distance from the middle of a slice to that of the next."""

MOST_TILT_DEG = 30.0
"""Gantries tilt by so much either way."""

NEEDLE_RADIUS_MM = 0.635
"""Half the outer diameter of an 18 gauge needle (ISO 9626: 1.27 mm)."""


@dataclass(frozen=True, slots=True)
class ScanOrder:
    """Axial slices about one position of the table, adjacent or with gaps, straight or tilted.

    A tilted gantry turns the whole stack about the line through (`pivot_mm`, `centre_mm`) that
    runs from the patient's right to his left.

    Attributes:
        centre_mm: middle of the stack along the patient's axis: LPS z, towards the head [mm].
        slices: how many.
        slice_mm: thickness of one [mm].
        interval_mm: from the middle of a slice to that of the next [mm]; None for adjacent ones.
        tilt_deg: of the gantry; positive where the front of the slices leans towards the head [°].
        pivot_mm: height of the gantry's axis on the patient: LPS y [mm]; only a tilt asks for it.

    Raises:
        ScanOrderError: naming the value and what would be valid.
    """

    centre_mm: float
    slices: int = FEWEST
    slice_mm: float = 5.0
    interval_mm: float | None = None
    tilt_deg: float = 0.0
    pivot_mm: float = 0.0

    def __post_init__(self) -> None:
        if not isfinite(self.centre_mm):
            raise ScanOrderError(
                sentence("the table position {centre_mm} is not a number", centre_mm=self.centre_mm)
            )
        if not FEWEST <= self.slices <= MOST:
            raise ScanOrderError(
                sentence(
                    "{slices} slices: a scan has {fewest} to {most}",
                    slices=self.slices,
                    fewest=FEWEST,
                    most=MOST,
                )
            )
        if not THINNEST_MM <= self.slice_mm <= THICKEST_MM:
            raise ScanOrderError(
                sentence(
                    "slices of {slice_mm:g} mm: {thinnest_mm:g} to {thickest_mm:g} mm are valid",
                    slice_mm=self.slice_mm,
                    thinnest_mm=THINNEST_MM,
                    thickest_mm=THICKEST_MM,
                )
            )
        check_interval(self.slice_mm, self.interval_mm)
        check_tilt(self.tilt_deg)
        if not isfinite(self.pivot_mm):
            raise ScanOrderError(
                sentence("the gantry's height {pivot_mm} is not a number", pivot_mm=self.pivot_mm)
            )

    @property
    def step_mm(self) -> float:
        """Distance from the middle of a slice to that of the next [mm]."""
        return self.slice_mm if self.interval_mm is None else self.interval_mm

    @property
    def middles_mm(self) -> FloatArray:
        """Middle of each slice across the gantry, from the feet to the head, shape (slices,).

        Without a tilt that is along z.
        """
        steps = np.arange(self.slices) - (self.slices - 1) / 2
        return frozen(self.centre_mm + steps * self.step_mm)

    @property
    def range_mm(self) -> tuple[float, float]:
        """Lower and upper face of the stack across the gantry."""
        half = self.slices * self.slice_mm / 2
        if self.interval_mm is not None:
            half = ((self.slices - 1) * self.interval_mm + self.slice_mm) / 2
        return self.centre_mm - half, self.centre_mm + half

    @property
    def to_gantry(self) -> FloatArray:
        """Turn from LPS to the gantry's frame about its pivot, shape (3, 3); its z is across."""
        c, s = cos(radians(self.tilt_deg)), sin(radians(self.tilt_deg))
        return frozen(np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]))

    def in_gantry(self, points_mm: FloatArray) -> FloatArray:
        """Return points in the frame in which the slices are straight, LPS [mm], (..., 3)."""
        if self.tilt_deg == 0.0:
            return points_mm
        pivot = np.array([0.0, self.pivot_mm, self.centre_mm])
        turned: FloatArray = pivot + (points_mm - pivot) @ self.to_gantry.T
        return turned

    def in_patient(self, points_mm: FloatArray) -> FloatArray:
        """Return points of the gantry's frame in the patient, LPS [mm], shape (..., 3)."""
        if self.tilt_deg == 0.0:
            return points_mm
        pivot = np.array([0.0, self.pivot_mm, self.centre_mm])
        turned: FloatArray = pivot + (points_mm - pivot) @ self.to_gantry
        return turned

    def holds(self, across_mm: float) -> bool:
        """Return whether a place across the gantry lies in a slice, and not in a gap [mm]."""
        away = np.abs(self.middles_mm - across_mm)
        return bool((away <= self.slice_mm / 2).any())

    def moved(self, step_mm: float) -> ScanOrder:
        """Return the order with the table moved, positive towards the head."""
        return replace(self, centre_mm=self.centre_mm + step_mm)


def check_interval(slice_mm: float, interval_mm: float | None) -> None:
    """Refuse slices that lie in each other or too far apart.

    Raises:
        ScanOrderError: naming the gap.
    """
    if interval_mm is None or slice_mm <= interval_mm <= WIDEST_MM:
        return
    raise ScanOrderError(
        sentence(
            "slices of {slice_mm:g} mm every {interval_mm:g} mm leave a gap of {gap:g} mm: 0 mm "
            "is the least, and {widest:g} mm the farthest from slice to slice",
            slice_mm=slice_mm,
            interval_mm=interval_mm,
            gap=interval_mm - slice_mm,
            widest=WIDEST_MM,
        )
    )


def check_tilt(tilt_deg: float) -> None:
    """Refuse a tilt that no gantry has.

    Raises:
        ScanOrderError: naming the tilt.
    """
    if not -MOST_TILT_DEG <= tilt_deg <= MOST_TILT_DEG:
        raise ScanOrderError(
            sentence(
                "a gantry tilted by {tilt_deg:g}°: -{most:g}° to {most:g}° are valid",
                tilt_deg=tilt_deg,
                most=MOST_TILT_DEG,
            )
        )


class ScanTip(StrEnum):
    """How the needle's end is drawn."""

    FLAT = "flat"
    """Cut off square."""
    CONE = "cone"
    """Pointed all round, as a trocar's stylet."""
    BEVEL = "bevel"
    """Ground from one side, which faces the patient's front."""


CONE_LENGTHS = 2.0
"""Length of a pointed tip over the diameter: a full angle of 28°, an estimate."""

BEVEL_DEG = 25.0
"""Angle of a bevel to the shaft, as of a Chiba needle: an estimate."""


@dataclass(frozen=True, slots=True, eq=False)
class ScanNeedle:
    """The metal in the scanner: a cylinder, straight or bent, DICOM LPS [mm].

    Attributes:
        hub_mm: end of the shaft in the hand, shape (3,).
        tip_mm: tip, shape (3,).
        radius_mm: of the shaft.
        corners_mm: of a bent shaft from hub to tip, both among them, shape (n, 3); None for a
            straight one.
        tip: how its end is drawn.
        hollow: whether the stylet is out, so that the bore is empty.
        inner_radius_mm: of the bore, which only a hollow needle shows.

    Raises:
        NumericalError: if a coordinate is not finite, the shaft has no length, or no radius, or
            its bore is as wide as itself.
    """

    hub_mm: FloatArray
    tip_mm: FloatArray
    radius_mm: float = NEEDLE_RADIUS_MM
    corners_mm: FloatArray | None = None
    tip: ScanTip = ScanTip.FLAT
    hollow: bool = False
    inner_radius_mm: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "hub_mm", frozen(self.hub_mm, (3,), "hub_mm"))
        object.__setattr__(self, "tip_mm", frozen(self.tip_mm, (3,), "tip_mm"))
        if self.corners_mm is not None:
            shape = (len(self.corners_mm), 3)
            object.__setattr__(self, "corners_mm", frozen(self.corners_mm, shape, "corners_mm"))
        if not self.length_mm > 1e-6:
            raise NumericalError(
                sentence(
                    "the needle's hub and tip are both at {tip_mm}", tip_mm=self.tip_mm.tolist()
                )
            )
        if not 0.0 < self.radius_mm < 1e3:
            raise NumericalError(
                sentence(
                    "a needle of radius {radius_mm} mm cannot be drawn", radius_mm=self.radius_mm
                )
            )
        if not 0.0 <= self.inner_radius_mm < self.radius_mm:
            raise NumericalError(
                sentence(
                    "a bore of radius {inner} mm does not fit a needle of radius {radius_mm} mm",
                    inner=self.inner_radius_mm,
                    radius_mm=self.radius_mm,
                )
            )

    @property
    def bore_mm(self) -> float:
        """Radius of what is empty in the shaft [mm]: 0 with the stylet in."""
        return self.inner_radius_mm if self.hollow else 0.0

    @property
    def tip_length_mm(self) -> float:
        """Length of what is ground off at the tip [mm]; 0 for a flat end."""
        if self.tip is ScanTip.CONE:
            return 2.0 * self.radius_mm * CONE_LENGTHS
        if self.tip is ScanTip.BEVEL:
            return 2.0 * self.radius_mm / float(np.tan(radians(BEVEL_DEG)))
        return 0.0

    @property
    def face(self) -> FloatArray:
        """Direction across the shaft to which a bevel faces: the patient's front, shape (3,)."""
        front = np.array([0.0, -1.0, 0.0])
        across = front - (front @ self.axis) * self.axis
        if float(np.linalg.norm(across)) < 1e-3:
            across = np.array([0.0, 0.0, 1.0]) - self.axis[2] * self.axis
        result: FloatArray = across / np.linalg.norm(across)
        return result

    def seen_from(self, order: ScanOrder) -> ScanNeedle:
        """Return the needle in the gantry's frame: itself without a tilt."""
        if order.tilt_deg == 0.0:
            return self
        corners = None if self.corners_mm is None else order.in_gantry(self.corners_mm)
        return replace(
            self,
            hub_mm=order.in_gantry(self.hub_mm),
            tip_mm=order.in_gantry(self.tip_mm),
            corners_mm=corners,
        )

    @property
    def pieces(self) -> tuple[ScanNeedle, ...]:
        """Straight pieces from hub to tip: itself, where it is straight."""
        if self.corners_mm is None:
            return (self,)
        made = [
            replace(self, hub_mm=start, tip_mm=end, corners_mm=None, tip=ScanTip.FLAT)
            for start, end in pairwise(self.corners_mm)
            if np.linalg.norm(end - start) > SHORTEST_MM
        ]
        return (*made[:-1], *(replace(last, tip=self.tip) for last in made[-1:]))

    @property
    def length_mm(self) -> float:
        """Length of the shaft."""
        return float(np.linalg.norm(self.tip_mm - self.hub_mm))

    @property
    def axis(self) -> FloatArray:
        """Unit direction from hub to tip, shape (3,)."""
        direction: FloatArray = (self.tip_mm - self.hub_mm) / self.length_mm
        return direction

    def within(self, low_mm: float, high_mm: float) -> tuple[FloatArray, FloatArray] | None:
        """Return the ends of its middle line between two axial planes, hub end first.

        None if it does not come between them.
        """
        if self.corners_mm is not None:
            ends = [part for piece in self.pieces if (part := piece.within(low_mm, high_mm))]
            return (ends[0][0], ends[-1][1]) if ends else None
        start, end = float(self.hub_mm[2]), float(self.tip_mm[2])
        if max(start, end) < low_mm or min(start, end) > high_mm:
            return None
        if abs(end - start) < 1e-9:
            return self.hub_mm, self.tip_mm
        shares = np.clip([(z - start) / (end - start) for z in (low_mm, high_mm)], 0.0, 1.0)
        first, last = (self.hub_mm + s * (self.tip_mm - self.hub_mm) for s in sorted(shares))
        return first, last


class Seen(StrEnum):
    """How much of the needle a scan shows."""

    TIP = "tip"
    """The tip lies in one of the slices."""
    BETWEEN = "between"
    """The tip lies in a gap between two of the slices."""
    SHAFT = "shaft"
    """The shaft crosses the slices, the tip lies elsewhere."""
    NOTHING = "nothing"
    """The needle does not touch the slices."""


def seen(order: ScanOrder, needle: ScanNeedle) -> Seen:
    """Say how much of a needle the slices of an order show, by its middle line."""
    low, high = order.range_mm
    needle = needle.seen_from(order)
    tip = float(needle.tip_mm[2])
    if low <= tip <= high:
        return Seen.TIP if order.interval_mm is None or order.holds(tip) else Seen.BETWEEN
    if order.interval_mm is None:
        return Seen.NOTHING if needle.within(low, high) is None else Seen.SHAFT
    half = order.slice_mm / 2
    shown = any(needle.within(z - half, z + half) is not None for z in order.middles_mm)
    return Seen.SHAFT if shown else Seen.NOTHING


def middle_of(volume: Volume) -> FloatArray:
    """Return the middle of a CT, where the gantry's axis ran, LPS [mm], shape (3,)."""
    return volume.lps_mm((np.array(volume.size) - 1.0) / 2.0)
