"""How an exercise guides by pictures: the needle live, or control scans alone."""

from enum import StrEnum
from typing import Annotated, Final

from pydantic import Field

from app.core.configuration import Strict
from app.imaging.scan_order import FEWEST, MOST, THICKEST_MM, THINNEST_MM, ScanOrder

DOSE_PER_SLICE: Final = 3.85
"""Notional dose-length product of one 5 mm slice [mGy·cm]: CTDIvol 7.7 mGy, the diagnostic
reference level of a liver biopsy's acquisitions (Siomou 2023, doi 10.3390/jimaging9120267)."""


class GuidanceMode(StrEnum):
    """What the student sees of the needle."""

    LIVE = "live"
    """The needle, all the time."""
    CONTROL_CT = "control_ct"
    """The slices of the control scans that the student takes, and nothing else."""


class Purpose(StrEnum):
    """What an exercise is for."""

    PRACTICE = "practice"
    ASSESSMENT = "assessment"


class GuidancePart(Strict):
    """Pictures during the attempt.

    Attributes:
        mode: what is seen of the needle; by default live in practice, control scans in an
            assessment.
        slices: of one control scan, 3 to 5; the student may choose others within these.
        slice_mm: their thickness.
        streak: whether the metal leaves a streak in them.
        dose_per_slice: notional dose-length product of one slice [mGy·cm]: a teaching estimate.
    """

    mode: GuidanceMode | None = None
    slices: Annotated[int, Field(ge=FEWEST, le=MOST)] = FEWEST
    slice_mm: Annotated[float, Field(ge=THINNEST_MM, le=THICKEST_MM)] = 5.0
    streak: bool = False
    dose_per_slice: Annotated[float, Field(ge=0.0, le=1e3)] = DOSE_PER_SLICE

    def order(self, centre_mm: float) -> ScanOrder:
        """Return the scan that is proposed about a table position [mm]."""
        return ScanOrder(centre_mm, self.slices, self.slice_mm)

    def dose(self, order: ScanOrder) -> float:
        """Notional dose-length product of a scan [mGy·cm]: a teaching estimate."""
        return order.slices * self.dose_per_slice
