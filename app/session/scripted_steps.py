"""The other hand of a scripted trainee: does the procedure's steps where the script stops for them.

The script says by its phase what it stands still for (`simulation.procedure_script`); the steps
follow each other at a person's pace. Nobody else's hand has these phases.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.bend import Bend
from app.core.events import Event
from app.imaging.field import TissueField
from app.planning.placement import PlacedPlan
from app.session.ablation import AblationState
from app.session.errors import ProcedureNotPossibleError
from app.session.needle import FROM_CAMERAS
from app.session.needle_now import NeedleNow
from app.session.procedure import (
    CHECKS,
    KIND,
    ProcedureState,
    Step,
    ToolInHand,
    begin_data,
    perform,
)
from app.session.scripted_answers import WATCHED_S, ScriptedPatient
from app.simulation.electrode_script import ElectrodePhase
from app.simulation.procedure_script import StopPhase

if TYPE_CHECKING:
    from app.exercises.procedure import ProcedurePart
    from app.session.samples import Samples

PACE: Final = 1.2
"""Time from one step to the next [s]: an estimate; none measured was found."""

OF_A_SAMPLE: Final = (Step.STYLET_OUT, Step.GUN_IN, Step.FIRE, Step.GUN_OUT, Step.STYLET_IN)
SAMPLES: Final = 2
"""A script takes so many, the notch turned by half between them."""

Perform = Callable[[Step, int, float], ProcedureState]


def sampling_time(part: ProcedurePart) -> float:
    """Return how long a script stays for its samples, and to watch the patient [s]."""
    watched = 0.0 if part.complications is None else WATCHED_S
    if part.biopsy is None:
        return watched
    return PACE * (len(OF_A_SAMPLE) * min(SAMPLES, part.biopsy.most_samples) + 2) + watched


@dataclass(slots=True)
class ScriptedSteps:
    """Does the steps of one attempt.

    Attributes:
        part: what the exercise asks for.
        ablation: how an attempt begins with its electrodes; None without.
        phase: of the script, as it was looked at last.
    """

    part: ProcedurePart
    ablation: AblationState | None = None
    phase: float = 0.0
    _left: list[tuple[Step, int, float]] = field(default_factory=list)
    _next: float = 0.0
    _begun: bool = False

    @property
    def waits(self) -> bool:
        """Return whether a step is still to be done in this phase."""
        return bool(self._left)

    def look(self, phase: float, now: float, perform: Perform) -> None:
        """Do what is due at `now` [s] in a phase of the script.

        What is refused is left out; the checklist is tried again, as it may be too early for it.
        """
        if phase != self.phase:
            self.phase, self._left = phase, [*self._left_of_checks(), *self._of(phase)]
            self._next = now + PACE
        if not self._left or now < self._next:
            return
        step, setting, notch_deg = self._left.pop(0)
        self._next = now + PACE
        try:
            perform(step, setting, notch_deg)
        except ProcedureNotPossibleError:
            if step in CHECKS:
                self._left.insert(0, (step, setting, notch_deg))

    def _left_of_checks(self) -> list[tuple[Step, int, float]]:
        """Return what of the checklist is to be done before all else."""
        if self.part.checklist is None:
            return []
        if not self._begun:
            self._begun = True
            return [(step, 0, 0.0) for step in CHECKS]
        return [one for one in self._left if one[0] in CHECKS]

    def _of(self, phase: float) -> list[tuple[Step, int, float]]:
        if phase == StopPhase.INJECT:
            return [(Step.INJECT, 0, 0.0)]
        if phase == StopPhase.TURN:
            return [(Step.ROLL_OVER, 0, 0.0)]
        if phase == StopPhase.CHANGE:
            return [(Step.TAKE_NEEDLE, 0, 0.0)]
        if phase == ElectrodePhase.PLACE:
            return [(Step.PLACE_ELECTRODE, 0, 0.0)]
        if phase == ElectrodePhase.ABLATE and self.ablation is not None:
            return [(Step.ABLATE, self.ablation.planned_row, 0.0)]
        if phase == StopPhase.SAMPLE and self.part.biopsy is not None:
            count = min(SAMPLES, self.part.biopsy.most_samples)
            return [(step, 0, 180.0 * (n % 2)) for n in range(count) for step in OF_A_SAMPLE]
        return []


@dataclass(frozen=True, slots=True, eq=False)
class StepsDone:
    """What came of the steps of an attempt that ran without a trainer.

    Attributes:
        events: as they would be in the record.
        aside: from the plan's target to the one at hand at each sample [m], shape (n, 3); None
            where that is the same throughout.
    """

    events: tuple[Event, ...]
    aside: FloatArray | None


def steps_of_rows(
    part: ProcedurePart,
    samples: Samples,
    phases: FloatArray,
    placed: PlacedPlan,
    field: TissueField | None,
    ablation: AblationState | None = None,
    patient: ScriptedPatient | None = None,
) -> StepsDone:
    """Do the steps of a script at the samples of an attempt that ran without a trainer.

    Args:
        part: what the exercise asks for.
        samples: of the attempt.
        phases: of the script at each sample, shape (n,).
        placed: the plan.
        field: of the patient's tissue.
        patient: complications and who answers them; None where none can happen.
        ablation: how it begins with electrodes; None without.
    """
    state, events = ProcedureState.at_begin(part, ablation=ablation), list[Event]()
    steps = ScriptedSteps(part, ablation)
    aside = np.zeros((len(phases), 3))
    seen = np.isin(samples.depth_source, FROM_CAMERAS) & samples.valid
    events.append(Event(float(samples.time[0]), KIND, state.words, begin_data(state)))
    for row, phase in enumerate(phases.tolist()):
        if state.ablation is not None:
            aside[row] = state.ablation.aim.p_target - placed.p_target
        if patient is None and phase == steps.phase and not steps.waits:
            continue
        bend = None if samples.bend is None else Bend.of_numbers(samples.bend[row])
        axis, depth = samples.axis[row], float(samples.depth[row])
        needle = NeedleNow(
            samples.tip[row],
            axis if bend is None else axis + bend.slope_at(depth),
            depth,
            samples.target[row] + aside[row],
            bool(seen[row]),
            None if patient is None else patient.happens.fallen_mm,
        )
        time = float(samples.time[row])

        def act(
            step: Step, throw: int, deg: float, needle: NeedleNow = needle, time: float = time
        ) -> ProcedureState:
            nonlocal state
            state, words, data = perform(state, step, needle, placed, field, throw, deg, time)
            events.append(Event(time, KIND, words, data))
            if patient is not None and step is Step.FIRE:
                patient.happens.fired(needle)
            if patient is not None and step is Step.ROLL_OVER:
                patient.happens.rolled_over()
            return state

        if patient is not None:
            is_outer = state.tool is not ToolInHand.ANAESTHETIC
            events.extend(patient.look(needle, is_outer, time))
        steps.look(phase, time, act)
    return StepsDone(tuple(events), None if ablation is None else aside)
