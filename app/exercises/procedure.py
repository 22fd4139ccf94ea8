"""Steps of an intervention that an exercise asks for beside the needle's way to its target.

Each is a part of its own; what an exercise does not name is neither simulated nor shown nor judged.
"""

from __future__ import annotations

from typing import Annotated, Any, Final

import numpy as np
from pydantic import (
    Field,
    SerializerFunctionWrapHandler,
    model_serializer,
    model_validator,
)

from app.core.arrays import FloatArray
from app.core.configuration import Strict
from app.core.messages import sentence, sentence_of
from app.exercises.ablation import AblationPart
from app.imaging.skin_grid import GridSpec
from app.planning.errors import PlanError
from app.planning.placement import Placement
from app.planning.sampling import Throw

OF_PROCEDURES: Final = {
    "anaesthetic": frozenset({"anaesthetic_gap", "pierced_by_anaesthetic"}),
    "ablation": frozenset(
        {
            "ablated_share",
            "electrode_spacing",
            "least_margin",
            "vessels_near_zone",
            "zone_reaches",
        }
    ),
    "grid": frozenset({"entry_mark_error"}),
    "biopsy": frozenset({"diagnostic_samples", "lesion_in_sample", "throw_hits", "hub_open_time"}),
    "complications": frozenset({"complication_noticed", "complication_answer"}),
    "checklist": frozenset({"checklist_done"}),
    "rollover": frozenset({"rollover_time"}),
}
"""Metrics that a part of the procedure alone can give."""


class AnaestheticPart(Strict):
    """Local anaesthetic before the needle: down to the membrane, not through it.

    Attributes:
        most_deposits: so many times it can be given.
    """

    most_deposits: Annotated[int, Field(ge=1, le=20)] = 6


class ThrowPart(Strict):
    """One setting of the biopsy gun; see `planning.sampling.Throw`.

    Attributes:
        throw_mm: how far its needle runs ahead of the outer needle's tip.
        notch_mm: length of the notch.
        dead_tip_mm: from the notch's end to the needle's.
    """

    throw_mm: Annotated[float, Field(gt=0.0, le=40.0)]
    notch_mm: Annotated[float, Field(gt=0.0)]
    dead_tip_mm: Annotated[float, Field(gt=0.0)]

    @model_validator(mode="after")
    def _fits(self) -> ThrowPart:
        try:
            self.throw()
        except PlanError as error:
            raise ValueError(sentence_of(error)) from error
        return self

    def throw(self, radius_mm: float = 0.4) -> Throw:
        """Return it as the value that planning uses."""
        return Throw(self.throw_mm, self.notch_mm, self.dead_tip_mm, radius_mm)


class BiopsyPart(Strict):
    """A coaxial needle with stylet, and the gun that goes through it.

    Attributes:
        throws: settings of the gun that may be chosen, the first at the beginning.
        core_mm: diameter of the core.
        diagnostic_mm: a core with so much lesion in it suffices for a diagnosis.
        most_samples: so many times the gun can be fired.
    """

    throws: Annotated[tuple[ThrowPart, ...], Field(min_length=1, max_length=4)] = (
        ThrowPart(throw_mm=20.0, notch_mm=14.0, dead_tip_mm=6.0),
        ThrowPart(throw_mm=10.0, notch_mm=6.0, dead_tip_mm=4.0),
    )
    core_mm: Annotated[float, Field(gt=0.0, le=4.0)] = 0.8
    diagnostic_mm: Annotated[float, Field(gt=0.0, le=40.0)] = 3.0
    most_samples: Annotated[int, Field(ge=1, le=20)] = 6

    @model_validator(mode="after")
    def _can_be_diagnostic(self) -> BiopsyPart:
        longest = max(part.notch_mm for part in self.throws)
        if self.diagnostic_mm > longest:
            raise ValueError(
                sentence(
                    "diagnostic_mm {diagnostic_mm:g} is more than the longest notch holds, "
                    "{longest:g} mm: no sample could suffice",
                    diagnostic_mm=self.diagnostic_mm,
                    longest=longest,
                )
            )
        return self

    def throw(self, number: int) -> Throw:
        """Return one of the gun's settings."""
        return self.throws[number].throw(0.5 * self.core_mm)


class ComplicationsPart(Strict):
    """Complications that happen by lot, at published odds given what is done.

    Attributes:
        emphysema: whether the patient has it; None where that is not known.
        pneumothorax: whether one can happen.
        bleeding: whether the lung can bleed.
    """

    emphysema: bool | None = None
    pneumothorax: bool = True
    bleeding: bool = True

    @model_validator(mode="after")
    def _something_can_happen(self) -> ComplicationsPart:
        if not (self.pneumothorax or self.bleeding):
            raise ValueError(
                sentence("neither pneumothorax nor bleeding can happen: leave complications out")
            )
        return self


class GridPart(Strict):
    """A grid of metal lines on the skin, by which the student finds and marks the entry.

    Attributes:
        lines: how many, an odd number: the middle one lies above the target.
        spacing_mm: from line to line along the skin.
        length_mm: of the lines, the target's level in their middle.
    """

    lines: Annotated[int, Field(ge=3, le=31)] = 13
    spacing_mm: Annotated[float, Field(ge=2.0, le=30.0)] = 10.0
    length_mm: Annotated[float, Field(ge=20.0, le=300.0)] = 150.0

    @model_validator(mode="after")
    def _has_a_middle(self) -> GridPart:
        if self.lines % 2 == 0:
            raise ValueError(
                sentence("lines: {lines}: an odd number has a line in the middle", lines=self.lines)
            )
        return self

    def spec(self, target_mm: FloatArray, placement: Placement) -> GridSpec:
        """Return the grid on a patient who lies so, above a target, LPS [mm], shape (3,)."""
        x, y, z = (float(value) for value in target_mm)
        up = placement.rotation.T @ np.array([0.0, 0.0, 1.0])
        length = float(np.hypot(up[0], up[1]))
        side = (float(up[0]) / length, float(up[1]) / length) if length > 1e-6 else (0.0, -1.0)
        return GridSpec((x, y, z), side, self.lines, self.spacing_mm, self.length_mm)


MOST_INR: Final = 1.8
LEAST_PLATELETS: Final = 50.0
"""Beyond these coagulation is corrected before a procedure with a high risk of bleeding: INR 1.5 to
1.8 or less, platelets of 50 · 10⁹/l or more (Society of Interventional Radiology 2019)."""


class ChecklistPart(Strict):
    """What is checked before any needle: consent, and the patient's coagulation.

    Attributes:
        inr: of the patient; no needle goes in above `MOST_INR`.
        platelets: of the patient [10⁹/l]; nor below `LEAST_PLATELETS`.
    """

    inr: Annotated[float, Field(gt=0.0)] = 1.0
    platelets: Annotated[float, Field(gt=0.0, le=2000.0)] = 230.0

    @model_validator(mode="after")
    def _within_limits(self) -> ChecklistPart:
        if self.inr > MOST_INR:
            raise ValueError(
                sentence(
                    "inr {inr:g}: above {most:g} coagulation is corrected before a needle goes in; "
                    "give a patient with {most:g} or less",
                    inr=self.inr,
                    most=MOST_INR,
                )
            )
        if self.platelets < LEAST_PLATELETS:
            raise ValueError(
                sentence(
                    "platelets {platelets:g} · 10⁹/l: below {least:g} they are given before a "
                    "needle goes in; give a patient with {least:g} or more",
                    platelets=self.platelets,
                    least=LEAST_PLATELETS,
                )
            )
        return self


class RolloverPart(Strict):
    """The patient is turned puncture side down once the needle is out."""


class ProcedurePart(Strict):
    """What belongs to the intervention; None for each step that the exercise does without.

    Attributes:
        grid: metal lines on the skin, by which the entry is marked.
        anaesthetic: local anaesthetic first, by a needle of its own.
        biopsy: samples through a coaxial needle.
        complications: what can happen to the lung, and has to be noticed and answered.
        ablation: electrodes left in place one after another, then the generator.
        checklist: consent and coagulation, before any needle.
        rollover: the patient is turned puncture side down once the needle is out.
    """

    grid: GridPart | None = None
    anaesthetic: AnaestheticPart | None = None
    biopsy: BiopsyPart | None = None
    complications: ComplicationsPart | None = None
    ablation: AblationPart | None = None
    checklist: ChecklistPart | None = None
    rollover: RolloverPart | None = None

    @model_serializer(mode="wrap")
    def _as_before(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        """Leave out what is younger than the rest and not asked for: older records stay equal."""
        document: dict[str, Any] = handler(self)
        for name in ("checklist", "rollover"):
            if getattr(self, name) is None:
                document.pop(name, None)
        return document

    @model_validator(mode="after")
    def _turned_after_something(self) -> ProcedurePart:
        if self.rollover is not None and self.biopsy is None and self.ablation is None:
            raise ValueError(
                sentence(
                    "procedure: rollover is after samples or an ablation: add biopsy or ablation, "
                    "or leave it out"
                )
            )
        return self

    @model_validator(mode="after")
    def _one_tool_at_a_time(self) -> ProcedurePart:
        if self.biopsy is not None and self.ablation is not None:
            raise ValueError(
                sentence("procedure: samples and ablation are two exercises: leave one out")
            )
        return self

    @property
    def has_steps(self) -> bool:
        """Return whether anything is done during the attempt."""
        return any((self.anaesthetic, self.biopsy, self.checklist))

    @model_validator(mode="after")
    def _asks_for_something(self) -> ProcedurePart:
        if not any(getattr(self, name) is not None for name in type(self).model_fields):
            raise ValueError(
                sentence(
                    "procedure names no step; there are {names}",
                    names=", ".join(type(self).model_fields),
                )
            )
        return self
