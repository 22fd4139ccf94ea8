"""The steps of an intervention during an attempt: which may follow which, and what each leaves.

The shaft in the robot stands for every needle in turn: first that for local anaesthetic, then the
outer needle with its stylet, which makes room for the biopsy gun. Each step is an event of the
record, with the needle as it was then; scoring reads these back.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TYPE_CHECKING, Final

from app.core.messages import sentence
from app.exercises.procedure import LEAST_PLATELETS, MOST_INR
from app.imaging.field.tissue_field import TissueField
from app.planning.errors import PlanError
from app.planning.placement import PlacedPlan
from app.planning.plan import Plan
from app.planning.sampling import SamplePlan, plan_sample
from app.scoring.procedure import SampleMark
from app.session import ablation as ablating
from app.session.ablation import AblationState
from app.session.errors import ProcedureNotPossibleError
from app.session.needle_in_patient import deposit_of, needle_in, sample_of
from app.session.needle_now import NeedleNow

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
    CONSENT = "consent"
    COAGULATION = "coagulation"
    ROLL_OVER = "roll_over"


OF_ABLATION: Final = (Step.PLACE_ELECTRODE, Step.ABLATE)

CHECKS: Final = (Step.CONSENT, Step.COAGULATION)
"""The checklist, in its order; nothing is held for it."""

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
    Step.CONSENT: sentence("the patient knows the risks and agrees"),
    Step.COAGULATION: sentence("coagulation checked"),
    Step.ROLL_OVER: sentence("the patient is turned, puncture side down"),
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
    **dict.fromkeys(CHECKS, tuple(ToolInHand)),
    Step.ROLL_OVER: (ToolInHand.STYLET, ToolInHand.ELECTRODE),
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
        checked: what of the checklist was done, in order.
        rolled: whether the patient was turned, which ends what is done with needles.
    """

    part: ProcedurePart
    tool: ToolInHand
    deposits: int = 0
    samples: tuple[SampleMark, ...] = ()
    plans: tuple[SamplePlan, ...] = ()
    ablation: AblationState | None = None
    checked: tuple[Step, ...] = ()
    rolled: bool = False

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

    @property
    def checks_left(self) -> bool:
        """Return whether the checklist is still to be done, and no needle was used yet."""
        used = self.deposits or self.samples or (self.ablation and self.ablation.electrodes)
        return self.part.checklist is not None and not used and len(self.checked) < len(CHECKS)

    def refusal(self, step: Step) -> str:
        """Return why a step cannot follow now; empty if it can."""
        if step in OF_ABLATION and self.ablation is None:
            return sentence("this exercise ablates nothing")
        if step in CHECKS:
            return self._refused_check(step)
        if self.rolled:
            return sentence("the patient was turned: nothing more is done with the needle")
        if step is Step.ROLL_OVER and (refused := self._refused_turn()):
            return refused
        gun = step not in (Step.TAKE_NEEDLE, Step.INJECT, Step.ROLL_OVER, *OF_ABLATION)
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

    def _refused_check(self, step: Step) -> str:
        if self.part.checklist is None:
            return sentence("this exercise has no checklist")
        return sentence("that was checked already") if step in self.checked else ""

    def _refused_turn(self) -> str:
        if self.part.rollover is None:
            return sentence("in this exercise the patient is not turned")
        if self.part.biopsy is not None and not self.samples:
            return sentence("no sample was taken: the patient is turned after the last one")
        if self.ablation is not None and self.ablation.reached is None:
            return sentence("nothing was ablated: the patient is turned after that")
        return ""


def _own_tool(part: ProcedurePart) -> ToolInHand:
    """Return what the exercise's own needle is."""
    return ToolInHand.STYLET if part.ablation is None else ToolInHand.ELECTRODE


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
    if step is not Step.ABLATE and step not in CHECKS:
        _require_place(step, look)
    data: dict[str, object] = {"version": VERSION, "step": step.value}
    if step in CHECKS:
        state = replace(state, checked=(*state.checked, step))
        return state, check_words(state.part, step), data | _checked(state.part, step)
    if step is Step.ROLL_OVER:
        return replace(state, rolled=True), STEP_WORDS[step], data
    if step in OF_ABLATION:
        state, words, more = _of_ablation(state, step, look, field, throw)
        return state, words, data | more
    tool = _own_tool(state.part) if step is Step.TAKE_NEEDLE else _TO.get(step, state.tool)
    state = replace(state, tool=tool)
    words = STEP_WORDS[step]
    if step not in (Step.INJECT, Step.FIRE):
        return state, words, data
    needle = needle_in(look, placed, field)
    data |= {
        "depth_mm": needle.depth_mm,
        "tip_lps_mm": needle.tip_mm.tolist(),
        "axis_lps": needle.way.tolist(),
    }
    if step is Step.INJECT:
        deposit = deposit_of(field, needle, time)
        data |= {"gap_mm": deposit.gap_mm}
        state = replace(state, deposits=state.deposits + 1)
        return state, words, data
    mark, more = sample_of(state.part.biopsy, field, needle, throw, notch_deg, time)
    data |= more
    state = replace(state, samples=(*state.samples, mark))
    return state, words, data


def check_words(part: ProcedurePart, step: Step) -> str:
    """Say what a step of the checklist found: of coagulation the patient's values."""
    checklist = part.checklist
    if step is not Step.COAGULATION or checklist is None:
        return STEP_WORDS[step]
    return sentence(
        "coagulation checked: INR {inr:g} (at most {most:g}), platelets {platelets:g} · 10⁹/l "
        "(at least {least:g})",
        inr=checklist.inr,
        most=MOST_INR,
        platelets=checklist.platelets,
        least=LEAST_PLATELETS,
    )


def _checked(part: ProcedurePart, step: Step) -> dict[str, object]:
    if step is not Step.COAGULATION or part.checklist is None:
        return {}
    return {"inr": part.checklist.inr, "platelets": part.checklist.platelets}


def begin_data(state: ProcedureState) -> dict[str, object]:
    """Return the data of the event that an attempt with steps begins with."""
    asked = {"rollover": True} if state.part.rollover is not None else {}
    return asked | {
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
    if step is Step.ROLL_OVER and not outside:
        raise ProcedureNotPossibleError(
            sentence("the needle is still in the body: draw it out, then turn the patient")
        )
    if step not in (Step.TAKE_NEEDLE, Step.ROLL_OVER) and outside:
        raise ProcedureNotPossibleError(sentence("the tip is outside the skin: insert it first"))


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
