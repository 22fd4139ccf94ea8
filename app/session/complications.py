"""Complications of an attempt: they happen by lot given what is done, run, and are answered.

The lots are drawn by the seeds of exercise and attempt and stand in the record, as does everything
that is done; so the record alone gives the same complication again. What nobody has told the
student yet is recorded and not told.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.imaging.inside import Inside
from app.scoring.complications.answers import (
    ANSWER_WORDS,
    AnswerWorth,
    GuidelineRow,
    Kind,
    Reaction,
    row_of_air,
    row_of_blood,
)
from app.scoring.complications.course import (
    BLEEDING_S,
    BLEEDS,
    DELAY_S,
    Bleeding,
    Leak,
    Vitals,
    vitals,
)
from app.scoring.complications.factors import THICK_GAUGE, Facts
from app.scoring.complications.lots import Lots
from app.scoring.complications.risk import calibrated
from app.session.complication_case import ComplicationCase, known_facts
from app.session.lung_watch import STEP_MM, LungWatch
from app.session.needle_now import NeedleNow

VERSION: Final = 1

NEVER: Final = float("inf")

LOOK_S: Final = 0.2
"""A tip that stands still is looked at so often, as the tissue about it breathes [s]."""

VERDICT_WORDS: Final = {
    AnswerWorth.RIGHT: sentence("right"),
    AnswerWorth.HELPS: sentence("it helps, but something else is called for"),
    AnswerWorth.WRONG: sentence("wrong"),
    AnswerWorth.NOTHING_THERE: sentence("there is no complication"),
}
ONSET_WORDS: Final = {
    Kind.PNEUMOTHORAX: sentence("a pneumothorax begins"),
    Kind.BLEEDING: sentence("the lung bleeds"),
}


@dataclass(frozen=True, slots=True)
class Happening:
    """Something for the record.

    Attributes:
        words: one line for people.
        data: of the event.
        is_told: whether the student is told at once.
    """

    words: str
    data: dict[str, object]
    is_told: bool = False


@dataclass(frozen=True, slots=True)
class ComplicationsState:
    """What the student sees of complications.

    Attributes:
        vitals: of the patient, as the monitor shows them.
        answers: what was answered so far, in words, with what it was worth.
        noticed: how often somebody said that something is wrong.
    """

    vitals: Vitals
    answers: tuple[str, ...] = ()
    noticed: int = 0


def attempt_seed(session_id: str, is_assessment: bool) -> int:
    """Return the seed of an attempt: one for all in an assessment, else its own."""
    if is_assessment:
        return 0
    return int.from_bytes(hashlib.sha256(session_id.encode()).digest()[:4], "big")


class Complications:
    """Complications of one attempt; not thread-safe.

    Time that an attempt waits for the program does not pass for the patient.
    """

    def __init__(self, case: ComplicationCase, attempt: int) -> None:
        """Draw the lots of an attempt; the same for the same seeds."""
        self._case, self._attempt = case, attempt
        self._lots = Lots.of(case.seed, attempt)
        self._watch = LungWatch(case.field, case.placed.plan.target_mm)
        self._clock = 0.0
        self._seen: float | None = None
        self._facts: Facts | None = None
        self._probability = 0.0
        self._thick_in = self._oxygen = self._rolled = False
        self._onset = {Kind.PNEUMOTHORAX: NEVER, Kind.BLEEDING: NEVER}
        self._leak: Leak | None = None
        self._bleeding: Bleeding | None = None
        self._way: FloatArray | None = None
        self._severity: dict[Kind, int] = {}
        self._state = ComplicationsState(Vitals())
        self._shown: FloatArray | None = None
        self._aspirations = 0
        self._looked: tuple[FloatArray, float] | None = None

    @property
    def state(self) -> ComplicationsState:
        """Return what the student sees."""
        emphysema = self._case.part.emphysema is True
        now = vitals(self._leak, self._bleeding, self._clock, emphysema, self._oxygen)
        return replace(self._state, vitals=now)

    @property
    def share(self) -> float:
        """Return how much of the hemithorax is air now, by volume."""
        return 0.0 if self._leak is None else self._leak.at(self._clock)

    @property
    def rim_mm(self) -> float:
        """Return the largest depth of that air now."""
        shape = self._case.shape
        return 0.0 if shape is None else shape.rim_mm(self.share)

    @property
    def rows(self) -> tuple[GuidelineRow, ...]:
        """Return the rows of the table of answers that hold now."""
        found = []
        if self._leak is not None and self.share > 0.0:
            symptoms = self.state.vitals.has_symptoms
            found.append(row_of_air(self.rim_mm, symptoms, self._leak.in_vain))
        if self._bleeding is not None:
            found.append(row_of_blood(self._bleeding.higher, self._bleeding.coughs))
        return tuple(found)

    def begin(self) -> Happening:
        """Return what the record keeps at the beginning."""
        lots = self._lots.document()
        return self._happening("", "begin", seed=self._case.seed, attempt=self._attempt, lots=lots)

    def look(
        self, needle: NeedleNow | None, is_outer: bool, now: float, waits: bool = False
    ) -> list[Happening]:
        """Let time pass to `now` [s] and see what the needle does; `is_outer`: which one it is."""
        if self._seen is not None and not waits:
            self._clock += max(0.0, now - self._seen)
        self._seen = now
        found: list[Happening] = []
        if needle is not None and needle.measured and not waits:
            found += self._follow(needle, is_outer)
        found += self._begin_what_is_due()
        found += self._tell_stages()
        return found

    def fired(self, needle: NeedleNow | None) -> None:
        """Take in that a sample was taken."""
        if self._case.samples and needle is not None:
            self._may_bleed(needle)

    def rolled_over(self) -> None:
        """Take in that the patient lies puncture side down: what leaks there stops, or slows."""
        self._rolled = True
        if self._leak is not None:
            self._leak = self._leak.turned(self._clock)

    def notice(self) -> Happening:
        """Say that something is wrong."""
        self._state = replace(self._state, noticed=self._state.noticed + 1)
        there = bool(self.rows)
        words = sentence("you say that something is wrong")
        return self._happening(words, "notice", is_told=True, there=there)

    def answer(self, answer: Reaction) -> Happening:
        """Answer what there is, or nothing."""
        row, verdict, kinds = self._judge(answer)
        share, rim_mm = self.share, self.rim_mm
        words = sentence(
            "{answer}: {verdict}", answer=ANSWER_WORDS[answer], verdict=VERDICT_WORDS[verdict]
        )
        if row is not None and verdict is not AnswerWorth.RIGHT:
            words = sentence("{answer} ({row})", answer=words, row=row.words)
        self._act(answer)
        self._state = replace(
            self._state,
            answers=(*self._state.answers, words),
            noticed=self._state.noticed + 1,
        )
        return self._happening(
            words,
            "answer",
            is_told=True,
            answer=answer.value,
            verdict=verdict.value,
            kinds=[kind.value for kind in kinds],
            row="" if row is None else row.name,
            source="" if row is None else row.source,
            share=share,
            rim_mm=rim_mm,
        )

    def scanned(self) -> Inside | None:
        """Return what a control scan shows now; None where it shows nothing of complications."""
        shape, plan = self._case.shape, self._case.placed.plan
        if shape is None:
            return None
        blood = 0.0 if self._bleeding is None else self._bleeding.at(self._clock)
        inside = Inside(
            self.share,
            shape.centre_mm,
            plan.target_mm,
            shape.is_left,
            blood if self._way is not None else 0.0,
            self._way,
            self._bleeding is not None and self._bleeding.higher,
        )
        self._shown = inside.displacement_mm if inside.share > 0.0 else None
        return inside if inside.changes else None

    @property
    def fallen_mm(self) -> FloatArray | None:
        """Return how far the last control scan showed the target displaced, LPS, shape (3,)."""
        return self._shown

    # --- what happens -----------------------------------------------------------------------------
    def _follow(self, needle: NeedleNow, is_outer: bool) -> list[Happening]:
        case, watch = self._case, self._watch
        depth = needle.depth / MILLIMETRE
        to_patient = case.placed.T_world_patient.inverse()
        rough = to_patient @ needle.p_tip / MILLIMETRE
        if not self._is_to_be_looked_at(rough, depth):
            return []
        tip = self._at_rest(needle) if depth > 0.0 else rough
        changed = watch.look(tip, depth)
        self._thick_in |= is_outer and watch.in_lung and case.gauge <= THICK_GAUGE
        if watch.in_lung and is_outer and not case.samples:
            self._may_bleed(needle)
        facts = known_facts(case, watch, self._thick_in)
        if facts is None or not case.part.pneumothorax or (not changed and facts == self._facts):
            return []
        if facts == self._facts:
            return []
        self._facts = facts
        self._probability = max(self._probability, calibrated().probability(facts))
        if self._lots.air < self._probability and self._onset[Kind.PNEUMOTHORAX] == NEVER:
            low, high = DELAY_S
            self._onset[Kind.PNEUMOTHORAX] = self._clock + low + self._lots.delay * (high - low)
        return [
            self._happening(
                sentence("odds of a pneumothorax"),
                "risk",
                probability=self._probability,
                facts=facts.document(),
            )
        ]

    def _is_to_be_looked_at(self, rough_mm: FloatArray, depth_mm: float) -> bool:
        """Return whether the tip has moved, or the tissue about it for a while."""
        place, when = self._looked or (None, -NEVER)
        if depth_mm <= 0.0:
            self._looked = None
            return place is not None
        rests = place is not None and float(np.linalg.norm(rough_mm - place)) < STEP_MM
        if rests and self._clock - when < LOOK_S:
            return False
        self._looked = rough_mm, self._clock
        return True

    def _may_bleed(self, needle: NeedleNow) -> None:
        if (
            not self._case.part.bleeding
            or self._watch.entry_mm is None
            or self._onset[Kind.BLEEDING] < NEVER
            or self._bleeding is not None
            or not self._watch.in_lung
            or self._lots.blood >= BLEEDS
        ):
            return
        low, high = BLEEDING_S
        self._onset[Kind.BLEEDING] = self._clock + low + self._lots.bleeding * (high - low)
        self._way = np.stack([self._watch.entry_mm, self._at_rest(needle)])

    def _begin_what_is_due(self) -> list[Happening]:
        found = []
        if self._leak is None and self._clock >= self._onset[Kind.PNEUMOTHORAX]:
            leak = Leak.of(self._lots, self._clock)
            self._leak = leak = leak.turned(self._clock) if self._rolled else leak
            found.append(
                self._happening(
                    ONSET_WORDS[Kind.PNEUMOTHORAX],
                    "onset",
                    kind=Kind.PNEUMOTHORAX.value,
                    end_share=leak.end,
                    time_s=leak.time,
                    needs_drain=leak.needs_drain,
                    probability=self._probability,
                )
            )
        if self._bleeding is None and self._clock >= self._onset[Kind.BLEEDING]:
            self._bleeding = bled = Bleeding.of(self._lots, self._clock)
            found.append(
                self._happening(
                    ONSET_WORDS[Kind.BLEEDING],
                    "onset",
                    kind=Kind.BLEEDING.value,
                    radius_mm=bled.radius_mm,
                    higher=bled.higher,
                    coughs=bled.coughs,
                )
            )
        return found

    def _tell_stages(self) -> list[Happening]:
        found = []
        for row in self.rows:
            if row.severity > self._severity.get(row.kind, 0):
                self._severity[row.kind] = row.severity
                kind, name, rim_mm = row.kind.value, row.name, self.rim_mm
                found.append(
                    self._happening(
                        row.words, "stage", kind=kind, row=name, share=self.share, rim_mm=rim_mm
                    )
                )
        return found

    # --- what is done about it --------------------------------------------------------------------
    def _judge(self, answer: Reaction) -> tuple[GuidelineRow | None, AnswerWorth, list[Kind]]:
        """Return the row that an answer is judged by, what it is worth, and what it answers.

        It is judged by the worst of what there is. What is not wrong there answers all else too
        for which it is right.
        """
        rows = self.rows
        if not rows:
            return None, AnswerWorth.NOTHING_THERE, []
        order, most = list(AnswerWorth), max(row.severity for row in rows)
        worst = [row for row in rows if row.severity == most]
        row = min(worst, key=lambda one: order.index(one.verdict(answer)))
        verdict = row.verdict(answer)
        others = [
            one.kind
            for one in rows
            if one is not row
            and verdict is not AnswerWorth.WRONG
            and one.verdict(answer) is AnswerWorth.RIGHT
        ]
        return row, verdict, [row.kind, *others]

    def _act(self, answer: Reaction) -> None:
        leak, now = self._leak, self._clock
        self._oxygen |= answer is Reaction.OXYGEN
        if leak is None:
            return
        if answer is Reaction.ASPIRATE:
            lot = (self._lots.aspiration + 0.618 * self._aspirations) % 1.0  # each its own
            self._aspirations += 1
            self._leak = leak.aspirated(now, self.rim_mm, lot)
        elif answer is Reaction.DRAIN:
            self._leak = leak.drained(now)
        elif answer is Reaction.TURN:
            self._leak = leak.turned(now)

    def _at_rest(self, needle: NeedleNow) -> FloatArray:
        placed = self._case.placed
        shift = needle.p_target - placed.p_target
        shift = np.where(np.isfinite(shift), shift, 0.0)
        resting = self._case.bound.at_rest(needle.p_tip[None], shift[None])[0]
        return np.asarray(placed.T_world_patient.inverse() @ resting / MILLIMETRE)

    def _happening(self, words: str, step: str, is_told: bool = False, **data: object) -> Happening:
        known: dict[str, object] = {"version": VERSION, "step": step, "patient_s": self._clock}
        return Happening(words, known | data, is_told)
