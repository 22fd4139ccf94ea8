"""The steps of an intervention during an attempt: which may follow which, and what each leaves.

The shaft in the robot stands for every needle in turn: first that for local anaesthetic, then the
outer needle with its stylet, which makes room for the biopsy gun. Each step is an event of the
record, with the needle as it was then; scoring reads these back.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.events import Event
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.imaging.field.tissue_field import TissueField
from app.planning.errors import PlanError
from app.planning.membrane import membrane_on
from app.planning.placement import PlacedPlan
from app.planning.plan import Plan
from app.planning.sampling import AtRest, SamplePlan, core, plan_sample
from app.scoring.ablation import AblationMark
from app.scoring.errors import TrajectoryError
from app.scoring.met import Met
from app.scoring.procedure import Deposit, ProcedureMarks, SampleMark
from app.session import ablation as ablating
from app.session.ablation import AblationState
from app.session.complications import marks_of_complications
from app.session.errors import ProcedureNotPossibleError
from app.session.needle_now import NeedleNow
from app.session.samples import Samples
from app.simulation.bound_field import BoundField

if TYPE_CHECKING:
    from app.exercises.procedure import ProcedurePart

KIND: Final = "procedure"
"""Kind of the event."""

VERSION: Final = 1

MARKED: Final = "mark_entry"
"""Step of the event that says where the entry was marked, before the needle is touched."""


class ToolInHand(StrEnum):
    """What the shaft in the robot stands for."""

    ANAESTHETIC = "anaesthetic"
    """The needle for local anaesthetic."""
    STYLET = "stylet"
    """The outer needle, closed by its stylet."""
    OPEN = "open"
    """The outer needle, open to air."""
    GUN = "gun"
    """The outer needle with the biopsy gun in it, cocked."""
    FIRED = "fired"
    """The same after its throw."""
    ELECTRODE = "electrode"
    """An electrode for ablation."""


class Step(StrEnum):
    """What can be done."""

    INJECT = "inject"
    TAKE_NEEDLE = "take_needle"
    STYLET_OUT = "stylet_out"
    STYLET_IN = "stylet_in"
    GUN_IN = "gun_in"
    FIRE = "fire"
    GUN_OUT = "gun_out"
    PLACE_ELECTRODE = ablating.PLACE
    ABLATE = ablating.ABLATE


OF_ABLATION: Final = (Step.PLACE_ELECTRODE, Step.ABLATE)


STEP_WORDS: Final = {
    Step.INJECT: sentence("local anaesthetic given"),
    Step.TAKE_NEEDLE: sentence("the outer needle is taken"),
    Step.STYLET_OUT: sentence("stylet out: the hub is open"),
    Step.STYLET_IN: sentence("stylet in"),
    Step.GUN_IN: sentence("biopsy gun in"),
    Step.FIRE: sentence("biopsy gun fired"),
    Step.GUN_OUT: sentence("biopsy gun out: the hub is open"),
    Step.PLACE_ELECTRODE: sentence("electrode left in place"),
    Step.ABLATE: sentence("the generator has ablated"),
}

_FROM: Final = {
    Step.INJECT: (ToolInHand.ANAESTHETIC,),
    Step.TAKE_NEEDLE: (ToolInHand.ANAESTHETIC,),
    Step.STYLET_OUT: (ToolInHand.STYLET,),
    Step.STYLET_IN: (ToolInHand.OPEN,),
    Step.GUN_IN: (ToolInHand.OPEN,),
    Step.FIRE: (ToolInHand.GUN,),
    Step.GUN_OUT: (ToolInHand.GUN, ToolInHand.FIRED),
    Step.PLACE_ELECTRODE: (ToolInHand.ELECTRODE,),
    Step.ABLATE: (ToolInHand.ELECTRODE,),
}
_TO: Final = {
    Step.TAKE_NEEDLE: ToolInHand.STYLET,
    Step.STYLET_OUT: ToolInHand.OPEN,
    Step.STYLET_IN: ToolInHand.STYLET,
    Step.GUN_IN: ToolInHand.GUN,
    Step.FIRE: ToolInHand.FIRED,
    Step.GUN_OUT: ToolInHand.OPEN,
}
TOOL_WORDS: Final = {
    ToolInHand.ANAESTHETIC: sentence("needle for local anaesthetic"),
    ToolInHand.STYLET: sentence("outer needle with its stylet"),
    ToolInHand.OPEN: sentence("outer needle, open to air"),
    ToolInHand.GUN: sentence("outer needle with the biopsy gun, cocked"),
    ToolInHand.FIRED: sentence("outer needle with the biopsy gun, fired"),
    ToolInHand.ELECTRODE: sentence("electrode"),
}


@dataclass(frozen=True, slots=True)
class ProcedureState:
    """How an attempt stands with its steps.

    Attributes:
        part: what the exercise asks for.
        tool: what the shaft stands for now.
        deposits: how often local anaesthetic was given.
        samples: what each sample was, in order.
        plans: where to stop for each setting of the gun by the planned path, and what its throw
            would run into there; empty where nothing can tell.
        ablation: how it stands with electrodes; None where none are asked for.
    """

    part: ProcedurePart
    tool: ToolInHand
    deposits: int = 0
    samples: tuple[SampleMark, ...] = ()
    plans: tuple[SamplePlan, ...] = ()
    ablation: AblationState | None = None

    @classmethod
    def at_begin(
        cls,
        part: ProcedurePart,
        plan: Plan | None = None,
        field: TissueField | None = None,
        ablation: AblationState | None = None,
    ) -> ProcedureState:
        """Return the state with which an attempt begins, on a planned path in a field."""
        plans: tuple[SamplePlan, ...] = ()
        if part.biopsy is not None and plan is not None and field is not None:
            throws = [part.biopsy.throw(number) for number in range(len(part.biopsy.throws))]
            with suppress(PlanError):  # firing says why
                plans = tuple(
                    plan_sample(field, plan.entry_mm, plan.target_mm, throw) for throw in throws
                )
        tool = _own_tool(part) if part.anaesthetic is None else ToolInHand.ANAESTHETIC
        return cls(part, tool, plans=plans, ablation=ablation)

    @property
    def words(self) -> str:
        """Return what is held, in words."""
        return TOOL_WORDS[self.tool]

    @property
    def possible(self) -> tuple[Step, ...]:
        """Return which steps may follow, as far as needles and numbers are concerned."""
        return tuple(step for step in Step if not self.refusal(step))

    def refusal(self, step: Step) -> str:
        """Return why a step cannot follow now; empty if it can."""
        if step in OF_ABLATION and self.ablation is None:
            return sentence("this exercise ablates nothing")
        gun = step not in (Step.TAKE_NEEDLE, Step.INJECT, *OF_ABLATION)
        if gun and self.part.biopsy is None:
            return sentence("this exercise takes no samples")
        if self.tool not in _FROM[step]:
            return sentence(
                "not possible now: held is the {tool}",
                tool=TOOL_WORDS[self.tool],
            )
        if step in OF_ABLATION and self.ablation is not None:
            return self.ablation.refusal(step.value)
        anaesthetic, biopsy = self.part.anaesthetic, self.part.biopsy
        if step is Step.INJECT and anaesthetic and self.deposits >= anaesthetic.most_deposits:
            return sentence("the syringe is empty after {count} times", count=self.deposits)
        if step is Step.GUN_IN and biopsy and len(self.samples) >= biopsy.most_samples:
            return sentence(
                "{count} samples were taken: the exercise allows no more", count=len(self.samples)
            )
        return ""


def _own_tool(part: ProcedurePart) -> ToolInHand:
    """Return what the exercise's own needle is."""
    return ToolInHand.STYLET if part.ablation is None else ToolInHand.ELECTRODE


@dataclass(frozen=True, slots=True, eq=False)
class _PlacedNeedle:
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


def perform(
    state: ProcedureState,
    step: Step,
    look: NeedleNow | None,
    placed: PlacedPlan,
    field: TissueField | None,
    throw: int = 0,
    notch_deg: float = 0.0,
    time: float = 0.0,
) -> tuple[ProcedureState, str, dict[str, object]]:
    """Do a step.

    Args:
        state: as it stands.
        step: what is done.
        look: the needle now; None where nobody has seen it yet.
        placed: the plan, for where the patient lies.
        field: of the patient's tissue.
        throw: which of the gun's settings, for `FIRE`; which row of the generator's table, for
            `ABLATE`.
        notch_deg: direction of the notch, for `FIRE`.
        time: monotonic time [s].

    Returns:
        How it stands then; what is told; the event's data.

    Raises:
        ProcedureNotPossibleError: says why, and what to do; nothing has changed then.
    """
    if refusal := state.refusal(step):
        raise ProcedureNotPossibleError(refusal)
    if step is not Step.ABLATE:
        _require_place(step, look)
    data: dict[str, object] = {"version": VERSION, "step": step.value}
    if step in OF_ABLATION:
        state, words, more = _of_ablation(state, step, look, field, throw)
        return state, words, data | more
    tool = _own_tool(state.part) if step is Step.TAKE_NEEDLE else _TO.get(step, state.tool)
    state = replace(state, tool=tool)
    words = STEP_WORDS[step]
    if step not in (Step.INJECT, Step.FIRE):
        return state, words, data
    needle = _needle(look, placed, field)
    data |= {
        "depth_mm": needle.depth_mm,
        "tip_lps_mm": needle.tip_mm.tolist(),
        "axis_lps": needle.way.tolist(),
    }
    if step is Step.INJECT:
        deposit = _deposit(field, needle, time)
        data |= {"gap_mm": deposit.gap_mm}
        state = replace(state, deposits=state.deposits + 1)
        return state, words, data
    mark, more = _sample(state, field, needle, throw, notch_deg, time)
    data |= more
    state = replace(state, samples=(*state.samples, mark))
    return state, words, data


def marks_of(
    events: Sequence[Event],
    samples: Samples,
    met: tuple[Met, ...] | None,
    placed: PlacedPlan | None = None,
) -> ProcedureMarks | None:
    """Return what scoring sees of the steps; None where the record has none.

    Damaged events are left out; without `placed`, complications are.
    """
    steps = [(event, _step(event)) for event in events if event.kind == KIND]
    if not steps:
        return None
    deposits: list[Deposit] = []
    taken: list[SampleMark] = []
    needle_from: float | None = None
    open_from: float | None = None
    ablated: AblationMark | None = None
    opened: list[tuple[float, float]] = []
    error: float | None = None
    for event, step in steps:
        data: dict[str, Any] = dict(event.data)
        with suppress(LookupError, TypeError, ValueError, TrajectoryError):
            if event.data.get("step") == MARKED:
                error = float(data["error_mm"])
            if step is Step.INJECT:
                gap = data["gap_mm"]
                deposits.append(
                    Deposit(
                        event.time, float(data["depth_mm"]), None if gap is None else float(gap)
                    )
                )
            elif step is Step.FIRE:
                taken.append(_mark(event.time, data))
            elif step is Step.ABLATE:
                ablated = ablating.mark_of(data)
        if step is Step.TAKE_NEEDLE:
            needle_from = event.time
        if step in (Step.STYLET_OUT, Step.GUN_OUT) and open_from is None:
            open_from = event.time
        elif step in (Step.STYLET_IN, Step.GUN_IN) and open_from is not None:
            opened.append((open_from, event.time))
            open_from = None
    if open_from is not None:
        opened.append((open_from, np.inf))
    begins = any(event.data.get("tool") == ToolInHand.ANAESTHETIC.value for event, _ in steps)
    if begins and needle_from is None:
        needle_from = np.inf  # it was never taken
    before = tuple(one for one in met or () if needle_from is not None and one.time < needle_from)
    happened = None
    if placed is not None and len(samples.time):
        happened = marks_of_complications(events, placed, float(samples.time[-1]))
    return ProcedureMarks(
        tuple(deposits),
        tuple(taken),
        _open_time(opened, samples),
        needle_from,
        before,
        happened,
        ablated,
        error,
    )


def shown_events(events: Iterable[Event]) -> tuple[Event, ...]:
    """Leave out the steps that a time axis has no room for: those without tissue."""
    shown = (Step.INJECT.value, Step.FIRE.value)
    return tuple(one for one in events if one.kind != KIND or one.data.get("step") in shown)


def begin_data(state: ProcedureState) -> dict[str, object]:
    """Return the data of the event that an attempt with steps begins with."""
    return {
        "version": VERSION,
        "step": "",
        "tool": state.tool.value,
        "plans": [
            {
                "throw_mm": plan.throw.throw_mm,
                "stop_mm": plan.stop_mm,
                "lesion_mm": plan.lesion_mm,
                "hits": [str(hit.sentence) for hit in plan.hits],
            }
            for plan in state.plans
        ],
    }


def _step(event: Event) -> Step | None:
    with suppress(ValueError):
        return Step(str(event.data.get("step", "")))
    return None


def _mark(time: float, data: dict[str, Any]) -> SampleMark:
    return SampleMark(
        time,
        float(data["lesion_mm"]),
        data["is_diagnostic"] is True,
        tuple(str(hit) for hit in data["hits"]),
        float(data["aside_mm"]) if "aside_mm" in data else None,
    )


def _open_time(opened: Iterable[tuple[float, float]], samples: Samples) -> float:
    """Return for how long the hub was open with the tip in the body [s]."""
    spans = np.diff(samples.time, append=samples.time[-1:]) if len(samples.time) else np.empty(0)
    inside = samples.depth > 0.0
    total = 0.0
    for begin, end in opened:
        total += float(spans[inside & (samples.time >= begin) & (samples.time < end)].sum())
    return total


def _require_place(step: Step, look: NeedleNow | None) -> None:
    if look is None or not look.measured:
        raise ProcedureNotPossibleError(
            sentence(
                "not done: the needle's depth is not measured now; let both cameras see the marker "
                "and do it again"
            )
        )
    outside = look.depth <= 0.0
    if step is Step.TAKE_NEEDLE and not outside:
        raise ProcedureNotPossibleError(
            sentence("the needle for local anaesthetic is still in the body: draw it out first")
        )
    if step is not Step.TAKE_NEEDLE and outside:
        raise ProcedureNotPossibleError(sentence("the tip is outside the skin: insert it first"))


def _needle(look: NeedleNow | None, placed: PlacedPlan, field: TissueField | None) -> _PlacedNeedle:
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
    return _PlacedNeedle(
        look.depth / MILLIMETRE,
        to_patient @ look.p_tip / MILLIMETRE,
        way / np.linalg.norm(way),
        to_patient @ placed.p_target / MILLIMETRE,
        to_patient @ (placed.p_target + shift) / MILLIMETRE,
        at_rest,
        look.fallen_mm,
    )


def _of_ablation(
    state: ProcedureState,
    step: Step,
    look: NeedleNow | None,
    field: TissueField | None,
    row: int,
) -> tuple[ProcedureState, str, dict[str, object]]:
    ablation = state.ablation
    if ablation is None or look is None:
        raise ProcedureNotPossibleError(sentence("this exercise ablates nothing"))
    if step is Step.ABLATE:
        ablation, data = ablation.ablate(row)
        return replace(state, ablation=ablation), STEP_WORDS[step], data
    of_needle = look.p_tip, look.tip_axis, look.depth, look.p_target
    ablation, data = ablation.place(ablating.electrode_at(*of_needle, ablation.aim, field))
    return replace(state, ablation=ablation), ablating.electrode_words(ablation), data


def _deposit(field: TissueField | None, needle: _PlacedNeedle, time: float) -> Deposit:
    gap = None
    if field is not None:
        entry = needle.tip_mm - needle.depth_mm * needle.way
        membrane = membrane_on(field, entry, needle.way, needle.target_mm)
        if membrane is not None:
            gap = membrane.depth_mm - needle.depth_mm
    return Deposit(time, needle.depth_mm, gap)


def _sample(
    state: ProcedureState,
    field: TissueField | None,
    needle: _PlacedNeedle,
    throw: int,
    notch_deg: float,
    time: float,
) -> tuple[SampleMark, dict[str, object]]:
    biopsy = state.part.biopsy
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
