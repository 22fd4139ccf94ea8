"""The needle where it is in the patient, and what comes of it there: a deposit, a sample."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.imaging.field.tissue_field import TissueField
from app.planning.errors import PlanError
from app.planning.membrane import membrane_on
from app.planning.placement import PlacedPlan
from app.planning.sampling import AtRest, core
from app.scoring.procedure import Deposit, SampleMark
from app.session.errors import ProcedureNotPossibleError
from app.session.needle_now import NeedleNow
from app.simulation.bound_field import BoundField

if TYPE_CHECKING:
    from app.exercises.procedure import BiopsyPart


@dataclass(frozen=True, slots=True, eq=False)
class PlacedNeedle:
    """The needle in the patient, LPS [mm], and where the tissue about it rests."""

    depth_mm: float
    tip_mm: FloatArray
    way: FloatArray
    target_mm: FloatArray
    target_now_mm: FloatArray
    at_rest: AtRest
    fallen_mm: FloatArray | None = None

    @property
    def aside_mm(self) -> float:
        """Return how far beside the target, where the breath has it, the line passes."""
        away = self.target_now_mm - self.tip_mm
        return float(np.linalg.norm(away - float(away @ self.way) * self.way))


def needle_in(
    look: NeedleNow | None, placed: PlacedPlan, field: TissueField | None
) -> PlacedNeedle:
    """Return the needle of a look where it is in the patient.

    Raises:
        ProcedureNotPossibleError: without a look, or a field of the patient's tissue.
    """
    if look is None or field is None:
        raise ProcedureNotPossibleError(
            sentence("nothing tells which tissue lies where: use tissue: field in the exercise")
        )
    bound = BoundField(field, placed.T_world_patient, placed.p_target)
    shift = look.p_target - placed.p_target
    shift = np.where(np.isfinite(shift), shift, 0.0)
    to_world, to_patient = placed.T_world_patient, placed.T_world_patient.inverse()

    def at_rest(places_mm: FloatArray) -> FloatArray:
        p_world = np.asarray(to_world @ (places_mm * MILLIMETRE))
        resting = bound.at_rest(p_world, np.broadcast_to(shift, p_world.shape))
        return np.asarray(to_patient @ resting / MILLIMETRE)

    way = to_patient.rotate(look.tip_axis)
    return PlacedNeedle(
        look.depth / MILLIMETRE,
        to_patient @ look.p_tip / MILLIMETRE,
        way / np.linalg.norm(way),
        to_patient @ placed.p_target / MILLIMETRE,
        to_patient @ (placed.p_target + shift) / MILLIMETRE,
        at_rest,
        look.fallen_mm,
    )


def deposit_of(field: TissueField | None, needle: PlacedNeedle, time: float) -> Deposit:
    """Return local anaesthetic given here, with the way left to pleura or capsule."""
    gap = None
    if field is not None:
        entry = needle.tip_mm - needle.depth_mm * needle.way
        membrane = membrane_on(field, entry, needle.way, needle.target_mm)
        if membrane is not None:
            gap = membrane.depth_mm - needle.depth_mm
    return Deposit(time, needle.depth_mm, gap)


def sample_of(
    biopsy: BiopsyPart | None,
    field: TissueField | None,
    needle: PlacedNeedle,
    throw: int,
    notch_deg: float,
    time: float,
) -> tuple[SampleMark, dict[str, object]]:
    """Take a sample by a setting of the gun; returns what it is, and the event's data.

    Raises:
        ProcedureNotPossibleError: if there is no such setting, or nobody marked a lesion.
    """
    if biopsy is None or field is None:
        raise ProcedureNotPossibleError(sentence("this exercise takes no samples"))
    if not 0 <= throw < len(biopsy.throws):
        raise ProcedureNotPossibleError(
            sentence(
                "setting {setting} of the gun: there are 0 to {most}",
                setting=throw,
                most=len(biopsy.throws) - 1,
            )
        )
    chosen = biopsy.throw(throw)
    try:
        tips = [needle.tip_mm]
        if needle.fallen_mm is not None:  # or where the last scan showed the lesion: the better
            tips.append(needle.tip_mm - needle.fallen_mm)
        cores = [
            core(field, tip, needle.way, chosen, needle.target_mm, notch_deg, needle.at_rest)
            for tip in tips
        ]
        taken = max(cores, key=lambda one: one.lesion_mm)
    except PlanError as error:
        raise ProcedureNotPossibleError(str(error)) from error
    mark = SampleMark(
        time,
        taken.lesion_mm,
        taken.lesion_mm >= biopsy.diagnostic_mm,
        tuple(hit.sentence for hit in taken.hits),
        needle.aside_mm,
    )
    return mark, {
        "throw_mm": chosen.throw_mm,
        "notch_mm": chosen.notch_mm,
        "notch_deg": notch_deg,
        "lesion_mm": taken.lesion_mm,
        "lesion_share": taken.lesion_share,
        "aside_mm": needle.aside_mm,
        "is_diagnostic": mark.is_diagnostic,
        "hits": [str(hit) for hit in mark.hits],
    }
