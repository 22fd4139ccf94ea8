"""Ablation during an attempt: electrodes left in place one after another, then the generator.

The shaft in the robot stands for the electrode at hand. Once it is left in place, its pose is kept
where the tissue about it rests, and the hand draws the robot's needle back for the next one. What
is ablated follows from where the electrodes truly are, by the row of the generator's table.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.exercises.ablation import LEAST_APART_MM, AblationPart, electrode_plans
from app.imaging.field.tissue_field import TissueField
from app.planning.ablation.generators import GeneratorTable
from app.planning.ablation.judging import Ablation, Lesion, judge
from app.planning.errors import PlanError
from app.planning.placement import PlacedPlan
from app.scoring.ablation import AblationMark
from app.session.errors import ProcedureNotPossibleError
from app.simulation.bound_field import BoundField

if TYPE_CHECKING:
    from app.exercises.procedure import ProcedurePart

ABLATE: Final = "ablate"
PLACE: Final = "place_electrode"


@dataclass(frozen=True, slots=True, eq=False)
class Electrode:
    """An electrode that was left in place.

    Attributes:
        tip_mm: where the tissue about it rests, LPS, shape (3,).
        axis: unit direction in which its tip points, shape (3,).
        depth_mm: of the tip below the skin.
    """

    tip_mm: FloatArray
    axis: FloatArray
    depth_mm: float

    @property
    def entry_mm(self) -> FloatArray:
        """Return where a straight shaft would leave the skin, LPS, shape (3,)."""
        return np.asarray(self.tip_mm - self.depth_mm * self.axis)


def electrode_at(
    p_tip: FloatArray,
    tip_axis: FloatArray,
    depth: float,
    p_target: FloatArray,
    aim: PlacedPlan,
    field: TissueField | None,
) -> Electrode:
    """Return the electrode of a needle, where the tissue about it rests.

    Args:
        p_tip: tip [m], shape (3,).
        tip_axis: direction in which it goes on, in world, shape (3,).
        depth: of the tip [m].
        p_target: target at hand now [m], shape (3,).
        aim: path to that target.
        field: of the patient's tissue.

    Raises:
        ProcedureNotPossibleError: without a field.
    """
    if field is None:
        raise ProcedureNotPossibleError(
            sentence("nothing tells which tissue lies where: use tissue: field in the exercise")
        )
    bound = BoundField(field, aim.T_world_patient, aim.p_target)
    shift = p_target - aim.p_target
    shift = np.where(np.isfinite(shift), shift, 0.0)
    to_patient = aim.T_world_patient.inverse()
    tip_mm = to_patient @ bound.at_rest(p_tip[None], shift[None])[0] / MILLIMETRE
    way = to_patient.rotate(tip_axis)
    return Electrode(read_only(tip_mm), read_only(way / np.linalg.norm(way)), depth / MILLIMETRE)


@dataclass(frozen=True, slots=True, eq=False)
class AblationState:
    """How an attempt stands with its electrodes.

    Attributes:
        part: what the exercise asks for.
        table: of the generator.
        plans: path of each electrode, in world.
        lesion: what is to be ablated.
        planned: what the planned electrodes would ablate.
        electrodes: those in place, in order.
        reached: what was ablated; None before.
        row: of the table that the generator was set to; None before.
    """

    part: AblationPart
    table: GeneratorTable
    plans: tuple[PlacedPlan, ...]
    lesion: Lesion
    planned: Ablation
    electrodes: tuple[Electrode, ...] = ()
    reached: Ablation | None = None
    row: int | None = None

    @classmethod
    def of(
        cls, part: ProcedurePart | None, placed: PlacedPlan, field: TissueField | None
    ) -> AblationState | None:
        """Return how every attempt begins; None where the exercise ablates nothing.

        Without a field nobody knows where the lesion is: then nothing can be ablated either.

        Raises:
            AcusError: if two electrodes are at one place, or nobody labelled a lesion.
        """
        if part is None or part.ablation is None or field is None:
            return None
        asked = part.ablation
        plans, table = electrode_plans(asked, placed), asked.table()
        row = table.number_of(asked.power_w, asked.minutes)
        at = placed.plan.target_mm if asked.lesion_mm is None else np.array(asked.lesion_mm)
        lesion = Lesion.at(field, at)
        zones = [
            table.zone(row, one.plan.target_mm, one.plan.target_mm - one.plan.entry_mm)
            for one in plans
        ]
        return cls(asked, table, plans, lesion, judge(lesion, zones))

    @property
    def number(self) -> int:
        """Return the number of the electrode at hand, from 1; of the last once all are placed."""
        return min(len(self.electrodes) + 1, len(self.plans))

    @property
    def aim(self) -> PlacedPlan:
        """Return the path of the electrode at hand."""
        return self.plans[self.number - 1]

    @property
    def all_placed(self) -> bool:
        """Return whether every electrode is in place."""
        return len(self.electrodes) >= len(self.plans)

    @property
    def planned_row(self) -> int:
        """Return the row of the table that the exercise plans."""
        return self.table.number_of(self.part.power_w, self.part.minutes)

    def refusal(self, step: str) -> str:
        """Return why a step cannot follow now; empty if it can."""
        if self.reached is not None:
            return sentence("the lesion was ablated already: the attempt can be ended")
        if step == PLACE and self.all_placed:
            return sentence("all {count} electrodes are in place", count=len(self.plans))
        if step == ABLATE and not self.all_placed:
            return sentence(
                "{count} of {of} electrodes are in place: place the others first",
                count=len(self.electrodes),
                of=len(self.plans),
            )
        return ""

    def place(self, electrode: Electrode) -> tuple[AblationState, dict[str, object]]:
        """Leave an electrode in place; returns how it stands then, and the event's data.

        Raises:
            ProcedureNotPossibleError: if one is there already.
        """
        for number, other in enumerate(self.electrodes, start=1):
            apart = float(np.linalg.norm(electrode.tip_mm - other.tip_mm))
            if apart < LEAST_APART_MM:
                raise ProcedureNotPossibleError(
                    sentence(
                        "electrode {electrode} is {apart:.1f} mm from here: two at one place "
                        "ablate one zone; draw back and go at least {least:g} mm beside it",
                        electrode=number,
                        apart=apart,
                        least=LEAST_APART_MM,
                    )
                )
        target = self.aim.plan.target_mm
        off = float(np.linalg.norm(electrode.tip_mm - target))
        data: dict[str, object] = {
            "number": self.number,
            "of": len(self.plans),
            "depth_mm": electrode.depth_mm,
            "tip_lps_mm": electrode.tip_mm.tolist(),
            "axis_lps": electrode.axis.tolist(),
            "target_lps_mm": target.tolist(),
            "off_mm": off,
        }
        return replace(self, electrodes=(*self.electrodes, electrode)), data

    def ablate(self, row: int) -> tuple[AblationState, dict[str, object]]:
        """Ablate by a row of the table; returns how it stands then, and the event's data.

        Raises:
            ProcedureNotPossibleError: if the table has no such row.
        """
        if not 0 <= row < len(self.table.rows):
            raise ProcedureNotPossibleError(
                sentence(
                    "row {row} of the generator's table: there are 0 to {most}",
                    row=row,
                    most=len(self.table.rows) - 1,
                )
            )
        try:
            zones = [self.table.zone(row, one.tip_mm, one.axis) for one in self.electrodes]
        except PlanError as error:
            raise ProcedureNotPossibleError(str(error)) from error
        reached = judge(self.lesion, zones)
        state = replace(self, reached=reached, row=row)
        setting = self.table.rows[row]
        data: dict[str, object] = {
            "generator": str(self.table.title),
            "ex_vivo": self.table.ex_vivo,
            "power_w": setting.power_w,
            "minutes": setting.minutes,
            "wanted_mm": self.part.margin_mm,
            "planned": _document(self.planned),
            "reached": _document(reached),
            "spacing_error_mm": state.spacing_error_mm,
            "map": _map(self.planned, reached),
        }
        return state, data

    @property
    def spacing_error_mm(self) -> float:
        """Return the largest error of a distance between two tips; 0 with fewer than two."""
        tips = np.array([one.tip_mm for one in self.electrodes]).reshape(-1, 3)
        targets = np.array([plan.plan.target_mm for plan in self.plans[: len(tips)]])
        worst = 0.0
        for k in range(len(tips)):
            for n in range(k):
                is_apart = float(np.linalg.norm(tips[k] - tips[n]))
                planned = float(np.linalg.norm(targets[k] - targets[n]))
                worst = max(worst, abs(is_apart - planned))
        return worst


def mark_of(data: dict[str, Any]) -> AblationMark:
    """Read from an event what scoring sees of an ablation.

    Raises:
        LookupError, TypeError, ValueError, TrajectoryError: if it is damaged.
    """
    reached, planned = data["reached"], data["planned"]
    return AblationMark(
        least_margin_mm=float(reached["least_margin_mm"]),
        planned_margin_mm=float(planned["least_margin_mm"]),
        share=float(reached["share"]),
        vessels=tuple(str(one["name"]) for one in reached["vessels"]),
        reached=tuple(str(one["name"]) for one in reached["reached"]),
        spacing_error_mm=float(data["spacing_error_mm"]),
    )


def _document(ablation: Ablation) -> dict[str, object]:
    return {
        "least_margin_mm": round(ablation.least_mm, 3),
        "least_at_lps_mm": np.round(ablation.where_mm, 2).tolist(),
        "share": round(ablation.share, 5),
        "lesion_mm3": round(ablation.lesion_mm3, 1),
        "vessels": [
            {"name": one.name, "distance_mm": round(one.distance_mm, 2)} for one in ablation.vessels
        ],
        "reached": [
            {"name": one.name, "volume_mm3": round(one.volume_mm3, 1)} for one in ablation.reached
        ],
        "zones": [
            {
                "centre_lps_mm": np.round(zone.centre_mm, 3).tolist(),
                "axis_lps": np.round(zone.axis, 6).tolist(),
                "long_mm": 2.0 * zone.half_long_mm,
                "short_mm": 2.0 * zone.half_short_mm,
            }
            for zone in ablation.zones
        ],
    }


def _map(planned: Ablation, reached: Ablation) -> dict[str, object]:
    """Return the margins at the same places of the lesion's surface, planned and reached."""
    same = planned.surface_mm
    nearest = ((reached.surface_mm[None] - same[:, None]) ** 2).sum(axis=2).argmin(axis=1)
    return {
        "at_lps_mm": np.round(same, 1).tolist(),
        "planned_mm": np.round(planned.margin_mm, 1).tolist(),
        "reached_mm": np.round(reached.margin_mm[nearest], 1).tolist(),
    }


def electrode_words(state: AblationState) -> str:
    """Say that an electrode was left in place, which `state` has counted already."""
    return sentence(
        "electrode {electrode} of {of} left in place",
        electrode=len(state.electrodes),
        of=len(state.plans),
    )


def shaft(electrodes: tuple[Electrode, ...]) -> FloatArray:
    """Return the shafts from the skin to the tip, LPS [mm], shape (n, 2, 3)."""
    lines = [np.stack([one.entry_mm, one.tip_mm]) for one in electrodes]
    return read_only(np.array(lines, dtype=np.float64).reshape(-1, 2, 3))
