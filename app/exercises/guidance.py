"""How an exercise guides: by pictures, live or by control scans alone, and by the robot.

The robot's assistance may change from attempt to attempt: by a schedule, or as a student does well.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from math import sqrt
from typing import Annotated, Any, Final

from pydantic import (
    Field,
    SerializerFunctionWrapHandler,
    model_serializer,
    model_validator,
)

from app.core.configuration import FieldText, Strict
from app.core.messages import sentence, sentence_of
from app.imaging.errors import ScanOrderError
from app.imaging.scan_look import BreathPicture, NeedleEnds, ScanLook
from app.imaging.scan_order import (
    FEWEST,
    MOST,
    THICKEST_MM,
    THINNEST_MM,
    ScanOrder,
    check_interval,
)

DialShare = Annotated[float, Field(ge=-1.0, le=1.0)]
Points = Annotated[float, Field(ge=0.0, le=100.0)]
TubeCurrent = Annotated[float, Field(gt=0.0, le=1000.0)]
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

    kind: Annotated[FadingKind, FieldText("Over the attempts")]
    dials: Annotated[
        tuple[DialShare, ...],
        Field(max_length=MOST_DIALS),
        FieldText("Dials of the 1st, 2nd, … attempt"),
    ] = ()
    least: Annotated[DialShare, FieldText("Dial never falls below")] = 0.0
    step: Annotated[float, Field(gt=0.0, le=1.0), FieldText("Step of the dial")] = 0.2
    good: Annotated[Points, FieldText("Good from a total of")] = 80.0
    poor: Annotated[Points, FieldText("Poor below a total of")] = 60.0
    probe_every: Annotated[
        int,
        Field(ge=0, le=100),
        FieldText("Every so many attempts a probe without help; 0: none"),
    ] = 0

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


PLANNING_MA: Final = 150.0
"""Tube current of the planning CT where the exercise does not say another [mA]."""

PLANNING_NOISE_HU: Final = 4.0
"""Noise of a slice of 5 mm at that current: 3.5 to 4.6 HU in the livers of built-in patients."""

NOISE_SLICE_MM: Final = 5.0

HAND_USV_PER_MAS: Final = 0.22e3 / (24.2 * 90.0)
"""Dose of the hand beside the slice for each milliampere second [µSv/mAs], a teaching estimate:
medians of 138 interventions, 0.22 mSv in 24.2 s at 90 mA, 120 kV (Rogits 2013, Röfo 185:1081)."""

ROTATION_S: Final = 0.5
"""A control scan is one turn of the tube [s], as of that scanner."""


@dataclass(frozen=True, slots=True)
class ScanChoice:
    """What the student chooses for a control scan beside its slices.

    Attributes:
        tube_current_ma: of the tube [mA]; None where the exercise leaves no choice.
        leaves: whether the student leaves the room for it.
    """

    tube_current_ma: float | None = None
    leaves: bool = False


class GuidancePart(Strict):
    """Pictures during the attempt.

    Attributes:
        mode: what is seen of the needle; by default live in practice, control scans in an
            assessment.
        slices: of one control scan, 3 to 5; the student may choose others within these.
        slice_mm: their thickness.
        streak: whether the metal leaves a streak in them.
        dose_per_slice: notional dose-length product of one slice [mGy·cm]: a teaching estimate;
            where the tube current is chosen, at the planning CT's.
        interval_mm: from slice to slice; None for slices without a gap.
        needle_ends: `drawn`: the tip as it is ground, a leaving shaft tapering, each with its own
            dark band; `plain` draws both ends alike.
        breath: `layers`: organs and lung move by their shares, the wall rests; `whole` moves all.
        tube_current: that the student chooses from [mA]; none for no choice, and no noise.
        planning_ma: tube current of the planning CT [mA], which noise and dose go by.
        planning_noise_hu: its noise in a slice of 5 mm [HU].
        leave_room_s: leaving the room and entering it again take so long together [s]; the
            student may stay, and his hand gets its dose. None: nobody asks.
        gantry_tilt: whether the student may tilt the gantry.
    """

    mode: GuidanceMode | None = None
    slices: Annotated[int, Field(ge=FEWEST, le=MOST), FieldText("Slices of a control scan")] = (
        FEWEST
    )
    slice_mm: Annotated[
        float, Field(ge=THINNEST_MM, le=THICKEST_MM), FieldText("Thickness of a slice")
    ] = 5.0
    streak: Annotated[bool, FieldText("Metal leaves a streak in control scans")] = False
    dose_per_slice: Annotated[
        float,
        Field(ge=0.0, le=1e3),
        FieldText("Dose of a slice, a teaching estimate", unit="mGy·cm"),
    ] = DOSE_PER_SLICE
    interval_mm: float | None = None
    needle_ends: NeedleEnds = NeedleEnds.PLAIN
    breath: BreathPicture = BreathPicture.WHOLE
    tube_current: Annotated[tuple[TubeCurrent, ...], Field(max_length=8)] = ()
    planning_ma: TubeCurrent = PLANNING_MA
    planning_noise_hu: Annotated[float, Field(ge=0.0, le=100.0)] = PLANNING_NOISE_HU
    leave_room_s: Annotated[float, Field(gt=0.0, le=600.0)] | None = None
    gantry_tilt: bool = False

    @model_validator(mode="after")
    def _can_be_scanned(self) -> GuidancePart:
        try:
            check_interval(self.slice_mm, self.interval_mm)
        except ScanOrderError as error:
            raise ValueError(sentence_of(error)) from error
        if len(set(self.tube_current)) < len(self.tube_current):
            raise ValueError(sentence("tube_current names a current twice"))
        return self

    @model_serializer(mode="wrap")
    def _as_before(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        """Leave out what is younger than the rest and not asked for: older records stay equal."""
        document: dict[str, Any] = handler(self)
        for name in _YOUNGER:
            if getattr(self, name) == type(self).model_fields[name].default:
                document.pop(name, None)
        return document

    def order(self, centre_mm: float, pivot_mm: float = 0.0) -> ScanOrder:
        """Return the scan that is proposed about a table position [mm].

        `pivot_mm` is the height of the gantry's axis on the patient, where it may be tilted.
        """
        pivot = pivot_mm if self.gantry_tilt else 0.0
        return ScanOrder(centre_mm, self.slices, self.slice_mm, self.interval_mm, pivot_mm=pivot)

    @property
    def choice(self) -> ScanChoice:
        """Return what is proposed: the middle current, and to leave where that can be done."""
        currents = sorted(self.tube_current)
        current = currents[len(currents) // 2] if currents else None
        return ScanChoice(current, self.leave_room_s is not None)

    def check(self, order: ScanOrder, choice: ScanChoice) -> None:
        """Refuse what the exercise does not offer.

        Raises:
            ScanOrderError: naming the value and what would be valid.
        """
        current = choice.tube_current_ma
        if self.tube_current and current not in self.tube_current:
            raise ScanOrderError(
                sentence(
                    "a tube current of {current} mA: the exercise offers {currents} mA",
                    current="?" if current is None else f"{current:g}",
                    currents=", ".join(f"{ma:g}" for ma in self.tube_current),
                )
            )
        if not self.tube_current and current is not None:
            raise ScanOrderError(
                sentence(
                    "a tube current of {current:g} mA: the exercise leaves no choice of it",
                    current=current,
                )
            )
        if choice.leaves and self.leave_room_s is None:
            raise ScanOrderError(sentence("the exercise has no time for leaving the room"))
        if order.tilt_deg != 0.0 and not self.gantry_tilt:
            raise ScanOrderError(
                sentence(
                    "a gantry tilted by {tilt_deg:g}°: the exercise keeps it straight",
                    tilt_deg=order.tilt_deg,
                )
            )

    def dose(self, order: ScanOrder, choice: ScanChoice | None = None) -> float:
        """Notional dose-length product of a scan [mGy·cm]: a teaching estimate.

        It is proportional to the tube current, where one is chosen.
        """
        current = None if choice is None else choice.tube_current_ma
        whole = order.slices * self.dose_per_slice
        return whole if current is None else whole * current / self.planning_ma

    def hand_dose(self, choice: ScanChoice) -> float | None:
        """Dose of the operator's hand [µSv]: a teaching estimate; None where nobody asks for it.

        It is 0 for who leaves the room.
        """
        if self.leave_room_s is None and not self.tube_current:
            return None
        current = choice.tube_current_ma or self.planning_ma
        return 0.0 if choice.leaves else HAND_USV_PER_MAS * current * ROTATION_S

    def noise(self, choice: ScanChoice) -> float:
        """Return what is added to the planning CT's own noise [HU]: together they go as 1/√mA.

        A current above the planning CT's adds nothing: what its picture has cannot be taken away.
        """
        current = choice.tube_current_ma
        if current is None:
            return 0.0
        more = max(0.0, self.planning_ma / current - 1.0) * NOISE_SLICE_MM / self.slice_mm
        return self.planning_noise_hu * sqrt(more)

    def look(
        self, choice: ScanChoice, target_mm: tuple[float, float, float], seed: int
    ) -> ScanLook:
        """Return what the pictures of a scan look like.

        Args:
            choice: of the student.
            target_mm: of the plan, LPS.
            seed: of the noise.
        """
        noise = self.noise(choice)
        return ScanLook(
            self.streak,
            self.needle_ends,
            self.breath,
            target_mm if self.breath is BreathPicture.LAYERS else None,
            noise,
            seed if noise > 0.0 else 0,
        )


_YOUNGER: Final = (
    "interval_mm",
    "needle_ends",
    "breath",
    "tube_current",
    "planning_ma",
    "planning_noise_hu",
    "leave_room_s",
    "gantry_tilt",
)
