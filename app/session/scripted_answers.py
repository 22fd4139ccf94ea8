"""How scripted hands answer complications: an expert soon and rightly, a novice late.

The delays are estimates; none measured was found.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Final

from app.core.events import Event
from app.scoring.complications.answers import GuidelineRow, Kind, Reaction
from app.session.complication_case import KIND, ComplicationCase
from app.session.complications import Complications
from app.session.needle_now import NeedleNow
from app.simulation.hands import SUFFIX


@dataclass(frozen=True, slots=True)
class Manner:
    """How somebody answers.

    Attributes:
        delay: from when a complication, or a worse stage of it, is there until it is answered [s].
        is_right: whether by what the table calls right; else oxygen is given, which is not enough.
    """

    delay: float
    is_right: bool


MANNERS: Final = MappingProxyType(
    {
        "expert": Manner(8.0, True),
        "proficient": Manner(14.0, True),
        "competent": Manner(24.0, True),
        "beginner": Manner(40.0, False),
        "novice": Manner(60.0, False),
    }
)

WATCHED_S: Final = 100.0
"""A script stays so much longer where a complication can happen [s]."""


@dataclass(slots=True)
class ScriptedAnswers:
    """Answers the complications of one attempt.

    Attributes:
        manner: how.
    """

    manner: Manner
    _due: dict[Kind, tuple[int, float]] = field(default_factory=dict)
    _answered: dict[Kind, int] = field(default_factory=dict)

    @classmethod
    def of(cls, skill: str) -> ScriptedAnswers | None:
        """Return those of a skill by its name; None for none that is known."""
        manner = MANNERS.get(skill.removesuffix(SUFFIX))
        return None if manner is None else cls(manner)

    def look(self, rows: Sequence[GuidelineRow], now: float) -> Reaction | None:
        """Return what is answered at `now` [s] to the rows that hold; None for nothing yet."""
        for row in sorted(rows, key=lambda one: -one.severity):
            if row.severity <= self._answered.get(row.kind, 0):
                continue
            severity, due = self._due.get(row.kind, (0, 0.0))
            if row.severity > severity:
                due = now + self.manner.delay
                self._due[row.kind] = row.severity, due
            if now >= due:
                self._answered[row.kind] = row.severity
                return self._of(row)
        return None

    def _of(self, row: GuidelineRow) -> Reaction:
        if not self.manner.is_right:
            return Reaction.OXYGEN
        return next(answer for answer in Reaction if answer in row.right)


@dataclass(slots=True)
class ScriptedPatient:
    """A patient whose complications a scripted hand answers, where no trainer runs.

    Attributes:
        happens: complications of the attempt.
        answers: who answers them; None for nobody.
    """

    happens: Complications
    answers: ScriptedAnswers | None = None

    @classmethod
    def of(cls, case: ComplicationCase | None, skill: str, seed: int) -> ScriptedPatient | None:
        """Return the patient of an attempt; None where nothing can happen."""
        if case is None:
            return None
        return cls(Complications(case, seed), ScriptedAnswers.of(skill))

    def look(self, needle: NeedleNow, is_outer: bool, now: float) -> list[Event]:
        """Let time pass to `now` [s]; returns what the record would keep."""
        happened = self.happens.look(needle, is_outer, now)
        answer = None if self.answers is None else self.answers.look(self.happens.rows, now)
        if answer is not None:
            happened.append(self.happens.answer(answer))
        return [Event(now, KIND, one.words, one.data) for one in happened]
