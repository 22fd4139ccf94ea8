"""The steps of an intervention as scoring sees them: deposits, samples, an open hub."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import Final

from app.core.messages import sentence
from app.imaging.field.tissue_field import TissueKind
from app.scoring.ablation import AblationMark
from app.scoring.complications.marks import ComplicationMarks
from app.scoring.errors import MetricUnavailableError, TrajectoryError
from app.scoring.met import BY_TIP, Met


@dataclass(frozen=True, slots=True)
class Deposit:
    """Local anaesthetic that was given once.

    Attributes:
        time: monotonic time [s].
        depth_mm: of the tip.
        gap_mm: from the tip to the membrane that is to be left whole, along the needle; negative
            beyond it, None where no such membrane is known.

    Raises:
        TrajectoryError: if a number is not finite.
    """

    time: float
    depth_mm: float
    gap_mm: float | None

    def __post_init__(self) -> None:
        _check(self.time, self.depth_mm, self.gap_mm or 0.0)


@dataclass(frozen=True, slots=True)
class SampleMark:
    """One sample of the biopsy gun.

    Attributes:
        time: monotonic time [s].
        lesion_mm: length of lesion in the core.
        is_diagnostic: whether that suffices, by the exercise.
        hits: what the throw met and should not have, in words.
        aside_mm: distance of the core's middle line from the lesion's target; None if not known.

    Raises:
        TrajectoryError: if a number is not finite.
    """

    time: float
    lesion_mm: float
    is_diagnostic: bool
    hits: tuple[str, ...] = ()
    aside_mm: float | None = None

    def __post_init__(self) -> None:
        _check(self.time, self.lesion_mm, self.aside_mm or 0.0)


NOT_TURNED_S: Final = 600.0
"""Counts as the time after which a patient was turned whom nobody turned."""


@dataclass(frozen=True, slots=True)
class TurningMark:
    """How the patient was turned after the needle was out.

    Attributes:
        last: moment of the last sample, or of the ablation [s]; None without.
        out: moment at which the needle had left the body for good [s]; None while it is in.
        turned: moment at which the patient was turned [s]; None where nobody did.

    Raises:
        TrajectoryError: if a number is not finite.
    """

    last: float | None = None
    out: float | None = None
    turned: float | None = None

    def __post_init__(self) -> None:
        _check(self.last or 0.0, self.out or 0.0, self.turned or 0.0)

    @property
    def wait(self) -> float:
        """Return how long it took from the needle's end in the body [s]."""
        if self.turned is None or self.out is None:
            return NOT_TURNED_S
        return max(0.0, self.turned - self.out)


@dataclass(frozen=True, slots=True)
class ProcedureMarks:
    """What was done beside moving the needle.

    Attributes:
        deposits: local anaesthetic, in order.
        samples: of the gun, in order.
        open_s: time for which the outer needle lay in the body with its hub open to air [s].
        needle_from: moment from which the needle of the exercise itself was held [s]; None where it
            was from the beginning.
        met_before: what the needle for local anaesthetic met.
        complications: that happened, and what was done about them; None where none can.
        ablation: by the electrodes that were left in place; None where nothing was ablated.
        entry_error_mm: way along the skin from the planned to the marked entry; None without.
        turning: of the patient, needle out; None where the exercise does not ask for it.
        checked: share of the checklist that was done before any needle, 0 to 1.
    """

    deposits: tuple[Deposit, ...] = ()
    samples: tuple[SampleMark, ...] = ()
    open_s: float = 0.0
    needle_from: float | None = None
    met_before: tuple[Met, ...] = ()
    complications: ComplicationMarks | None = None
    ablation: AblationMark | None = None
    entry_error_mm: float | None = None
    turning: TurningMark | None = None
    checked: float = 0.0

    def ablated(self) -> AblationMark:
        """Return what was ablated.

        Raises:
            MetricUnavailableError: if nothing was.
        """
        if self.ablation is None:
            raise MetricUnavailableError(sentence("nothing was ablated"))
        return self.ablation

    @property
    def pierced(self) -> tuple[Met, ...]:
        """Return where the needle for local anaesthetic went through pleura or capsule."""
        return tuple(
            one
            for one in self.met_before
            if one.by == BY_TIP and one.counts and (one.kind == TissueKind.LUNG or one.holds_target)
        )


def _check(*numbers: float) -> None:
    if not all(map(isfinite, numbers)):
        raise TrajectoryError(
            sentence("a step of the procedure at {time} s: a number is not finite", time=numbers[0])
        )
