"""A control scan as values: which slices, where the needle is, what of it can be seen in them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import pairwise
from math import isfinite

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.core.errors import NumericalError
from app.core.messages import sentence
from app.imaging.errors import ScanOrderError

FEWEST, MOST = 3, 5
"""Slices of one control scan."""

THINNEST_MM, THICKEST_MM = 0.5, 10.0
"""Thickness of a slice."""

SHORTEST_MM = 1e-5
"""Pieces of a bent needle below this have no direction."""

NEEDLE_RADIUS_MM = 0.635
"""Half the outer diameter of an 18 gauge needle (ISO 9626: 1.27 mm)."""


@dataclass(frozen=True, slots=True)
class ScanOrder:
    """Adjacent axial slices about one position of the table.

    Attributes:
        centre_mm: middle of the stack along the patient's axis: LPS z, towards the head [mm].
        slices: how many.
        slice_mm: thickness of one, and distance to the next [mm].

    Raises:
        ScanOrderError: naming the value and what would be valid.
    """

    centre_mm: float
    slices: int = FEWEST
    slice_mm: float = 5.0

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

    @property
    def middles_mm(self) -> FloatArray:
        """Middle of each slice along z, from the feet to the head, shape (slices,)."""
        steps = np.arange(self.slices) - (self.slices - 1) / 2
        return frozen(self.centre_mm + steps * self.slice_mm)

    @property
    def range_mm(self) -> tuple[float, float]:
        """Lower and upper face of the stack along z."""
        half = self.slices * self.slice_mm / 2
        return self.centre_mm - half, self.centre_mm + half

    def moved(self, step_mm: float) -> ScanOrder:
        """Return the order with the table moved, positive towards the head."""
        return replace(self, centre_mm=self.centre_mm + step_mm)


@dataclass(frozen=True, slots=True, eq=False)
class ScanNeedle:
    """The metal in the scanner: a cylinder with flat ends, straight or bent, DICOM LPS [mm].

    Attributes:
        hub_mm: end of the shaft in the hand, shape (3,).
        tip_mm: tip, shape (3,).
        radius_mm: of the shaft.
        corners_mm: of a bent shaft from hub to tip, both among them, shape (n, 3); None for a
            straight one.

    Raises:
        NumericalError: if a coordinate is not finite, the shaft has no length, or no radius.
    """

    hub_mm: FloatArray
    tip_mm: FloatArray
    radius_mm: float = NEEDLE_RADIUS_MM
    corners_mm: FloatArray | None = None

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

    @property
    def pieces(self) -> tuple[ScanNeedle, ...]:
        """Straight pieces from hub to tip: itself, where it is straight."""
        if self.corners_mm is None:
            return (self,)
        return tuple(
            ScanNeedle(start, end, self.radius_mm)
            for start, end in pairwise(self.corners_mm)
            if np.linalg.norm(end - start) > SHORTEST_MM
        )

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
    SHAFT = "shaft"
    """The shaft crosses the slices, the tip lies elsewhere."""
    NOTHING = "nothing"
    """The needle does not touch the slices."""


def seen(order: ScanOrder, needle: ScanNeedle) -> Seen:
    """Say how much of a needle the slices of an order show, by its middle line."""
    low, high = order.range_mm
    if low <= float(needle.tip_mm[2]) <= high:
        return Seen.TIP
    return Seen.NOTHING if needle.within(low, high) is None else Seen.SHAFT
