"""How an exercise guides: by pictures, live or by control scans alone, and by the robot.

The robot's assistance may change from attempt to attempt: by a schedule, or as a student does well.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Annotated, Final

from pydantic import Field, model_validator

from app.core.configuration import Strict
from app.core.messages import sentence
from app.imaging.scan_order import FEWEST, MOST, THICKEST_MM, THINNEST_MM, ScanOrder

DialShare = Annotated[float, Field(ge=-1.0, le=1.0)]
Points = Annotated[float, Field(ge=0.0, le=100.0)]
MOST_DIALS = 50


class FadingKind(StrEnum):
    """What the assistance follows."""

    SCHEDULE = "schedule"
    """The number of the attempt."""
    PERFORMANCE = "performance"
    """The scores of the attempts before."""


class FadingPart(Strict):
    """How the dial at the start changes over a student's attempts at this exercise.

    Attributes:
        kind: `schedule` or `performance`.
        dials: of a schedule: at the 1st, 2nd, … guided attempt; the last one stays.
        least: of performance: the dial never falls below this.
        step: of performance: how far the dial falls after an attempt that reached `good`, and rises
            again, up to the exercise's `assistance`, after one below `poor`.
        good: of performance: total of a score from which an attempt was done well.
        poor: of performance: total below which it was not.
        probe_every: every so many attempts one is a probe: without assistance, and without any view
            that tells where the needle is; 0 for none.
    """

    kind: FadingKind
    dials: Annotated[tuple[DialShare, ...], Field(max_length=MOST_DIALS)] = ()
    least: DialShare = 0.0
    step: Annotated[float, Field(gt=0.0, le=1.0)] = 0.2
    good: Points = 80.0
    poor: Points = 60.0
    probe_every: Annotated[int, Field(ge=0, le=100)] = 0

    @model_validator(mode="after")
    def _goes_together(self) -> FadingPart:
        if self.kind is FadingKind.SCHEDULE and not self.dials:
            raise ValueError(
                sentence("dials: a schedule needs at least one, such as [0.7, 0.4, 0]")
            )
        if self.kind is FadingKind.PERFORMANCE and self.dials:
            raise ValueError(
                sentence("dials go with kind: schedule; performance follows the scores")
            )
        if self.poor > self.good:
            raise ValueError(
                sentence(
                    "poor ({poor:g}) must not lie above good ({good:g})",
                    poor=self.poor,
                    good=self.good,
                )
            )
        if self.probe_every == 1:
            raise ValueError(
                sentence("probe_every: 1 would make every attempt a probe; give 0, or 2 and up")
            )
        return self


@dataclass(frozen=True, slots=True)
class StartingDial:
    """What one attempt begins with.

    Attributes:
        share: of the assistance, -1 … 1.
        is_probe: whether it is a probe: nothing guides, and nothing tells where the needle is.
    """

    share: float
    is_probe: bool = False


def starting_dial(
    assistance: float, fading: FadingPart | None, totals: Sequence[float | None]
) -> StartingDial:
    """Return what the next attempt of a student begins with.

    Args:
        assistance: of the exercise: the dial without fading, and where performance begins.
        fading: of the exercise; None keeps the dial.
        totals: scores of the student's attempts at this exercise so far, oldest first; None for
            one without a score, which counts as an attempt and moves nothing.
    """
    if fading is None:
        return StartingDial(assistance)
    number = len(totals) + 1
    every = fading.probe_every
    if every and number % every == 0:
        return StartingDial(0.0, is_probe=True)
    guided = [total for place, total in enumerate(totals, 1) if not every or place % every]
    if fading.kind is FadingKind.SCHEDULE:
        return StartingDial(fading.dials[min(len(guided), len(fading.dials) - 1)])
    dial = assistance
    for total in guided:
        if total is None:
            continue
        if total >= fading.good:
            dial = max(min(fading.least, assistance), dial - fading.step)
        elif total < fading.poor:
            dial = min(assistance, dial + fading.step)
    return StartingDial(round(dial, 9))


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
