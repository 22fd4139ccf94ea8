"""Where a student stands at a skill by his attempts: not yet competent, competent, or relapsed.

The learning test runs until it signals "competent"; from the next attempt on the watching test runs
until it signals "relapse"; then the learning test begins anew at 0.

**Gaps.** Tests count attempts, not days. What weeks without practice do to a skill is not known, so
no score decays; but what was shown before a gap (`CompetenceRule.gap_days`) says less of what is so
after it. While a student is learning, a gap sets his score back to 0: he is not called competent
by what he could do weeks ago. That only lowers scores, so that the share of false alarms, counted
from his first attempt, is still kept. Whoever is competent stays so through a gap, and is watched
more closely after it: the score of the watching test is raised to half its limit
(`design.head_start`), from where fewer failures signal a relapse. Both errors are in `Design`.

What is said of somebody's competence, in a line.
"""

from __future__ import annotations

import datetime
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from math import ceil
from typing import Any

from app.core.messages import Sentence, counted, sentence
from app.scoring.competence.cusum import CompetenceError
from app.scoring.competence.design import Design, design, head_start
from app.scoring.competence.forecast import LAST, Forecast, forecast
from app.scoring.competence.rule import RULE, CompetenceRule


class CompetenceState(StrEnum):
    """What the tests say by now."""

    NOT_YET = "not yet"
    COMPETENT = "competent"
    RELAPSE = "relapse"


@dataclass(frozen=True, slots=True)
class CompetenceChange:
    """A signal: the attempt, counted from 1, with which somebody became competent or relapsed."""

    attempt: int
    state: CompetenceState


@dataclass(frozen=True, slots=True)
class Competence:
    """How a student stands at a skill.

    Attributes:
        state: by the last attempt.
        attempts: how many there are.
        changes: signals, oldest first.
        scores: after each attempt, as a part of the limit of the test that was running; 1 and more
            where it signalled.
        false_alarm: of the newest "competent": at most so many of those who are not would have got
            it by then (`Design.false_alarm_by`); None without one.
        fewest: attempts that are needed at least to be called competent, all passed; 0 for
            whoever is.
        forecast: how many it may really take; None for whoever is competent, or has no attempt.
    """

    state: CompetenceState
    attempts: int
    changes: tuple[CompetenceChange, ...]
    scores: tuple[float, ...]
    false_alarm: float | None
    fewest: int
    forecast: Forecast | None

    def document(self) -> dict[str, Any]:
        """JSON-ready mapping; the keys stand in docs/json.md."""
        likely = self.forecast
        return {
            "state": self.state.value,
            "attempts": self.attempts,
            "changes": [{"attempt": one.attempt, "state": one.state.value} for one in self.changes],
            "false_alarm": self.false_alarm,
            "fewest_more": self.fewest,
            "likely_more": None if likely is None else [likely.low, likely.high],
        }


class _Walk:
    """The tests as they go: state, score, attempts since the learning test began."""

    __slots__ = ("learning", "plan", "score", "state")

    def __init__(self, plan: Design) -> None:
        self.plan = plan
        self.state = CompetenceState.NOT_YET
        self.score = 0.0
        self.learning = 0

    def rest(self) -> None:
        """Go on after a gap."""
        if self.state is CompetenceState.COMPETENT:
            self.score = max(self.score, head_start(self.plan.watch_limit))
        else:
            self.score = 0.0

    def attempt(self, passed: bool) -> float:
        """Take an attempt in; return the score as a part of the limit of the test that ran."""
        plan, watched = self.plan, self.state is CompetenceState.COMPETENT
        weights, limit = (
            (plan.watching, plan.watch_limit) if watched else (plan.learning, plan.limit)
        )
        self.score = score = weights.after(self.score, passed)
        self.learning += not watched
        if score >= limit:
            self.score = 0.0
            self.state = CompetenceState.RELAPSE if watched else CompetenceState.COMPETENT
            self.learning = 0 if watched else self.learning
        return score / limit


def competence(
    passed: Sequence[bool],
    times: Sequence[datetime.datetime] = (),
    now: datetime.datetime | None = None,
    rule: CompetenceRule = RULE,
) -> Competence:
    """Return how a student stands at a skill.

    Args:
        passed: of each attempt that counts, oldest first.
        times: of each attempt, to tell gaps; empty tells none.
        now: to tell a gap since the last attempt.
        rule: rates and errors.

    Raises:
        CompetenceError: if there are times, but not of each attempt, or if no test keeps the rule.
    """
    if times and len(times) != len(passed):
        raise CompetenceError(
            sentence(
                "{times} times for {attempts} attempts: give one for each, or none",
                times=len(times),
                attempts=len(passed),
            )
        )
    plan, gap = design(rule), datetime.timedelta(days=rule.gap_days)
    walk, changes, scores = _Walk(plan), [], []
    for number, one in enumerate(passed, 1):
        if times and number > 1 and times[number - 1] - times[number - 2] >= gap:
            walk.rest()
        before = walk.state
        scores.append(walk.attempt(bool(one)))
        if walk.state is not before:
            changes.append(CompetenceChange(number, walk.state))
    if times and now is not None and now - times[-1] >= gap:
        walk.rest()
    competent = walk.state is CompetenceState.COMPETENT
    missing = plan.limit - walk.score
    return Competence(
        state=walk.state,
        attempts=len(passed),
        changes=tuple(changes),
        scores=tuple(scores),
        false_alarm=plan.false_alarm_by(walk.learning) if competent else None,
        fewest=0 if competent else max(1, ceil(missing / plan.learning.gain - 1e-9)),
        forecast=forecast(plan, walk.score, passed[-LAST:]) if passed and not competent else None,
    )


def competence_words(standing: Competence, left: int | None = None) -> Sentence:
    """Say how somebody stands: since which attempt, with which error, how many more.

    Args:
        standing: of a student at a skill.
        left: attempts that a course still allows at most; None where it does not limit them.
    """
    if standing.state is CompetenceState.COMPETENT:
        alarm = standing.false_alarm if standing.false_alarm is not None else 1.0
        return sentence(
            "competent after {attempts} (false alarm ≤ {percent} %)",
            attempts=counted("{n} attempt", "{n} attempts", standing.changes[-1].attempt),
            percent=min(100, ceil(100.0 * alarm - 1e-9)),
        )
    more = _more(standing, left)
    if standing.state is CompetenceState.RELAPSE:
        return sentence(
            "relapse after attempt {attempt}: {more}",
            attempt=standing.changes[-1].attempt,
            more=more,
        )
    return sentence("not yet: {more}", more=more)


def _more(standing: Competence, left: int | None) -> Sentence:
    """Say how many attempts more there are at least, and within what they may lie."""
    fewest, likely = standing.fewest, standing.forecast
    if left is not None and fewest > left:
        return sentence(
            "at least {fewest} more, and the course allows {left}", fewest=fewest, left=left
        )
    if likely is None:
        return sentence("at least {fewest} more", fewest=fewest)
    if likely.low is None:
        return sentence("at least {fewest} more (hardly, as the last ones went)", fewest=fewest)
    if likely.high is None:
        return sentence("at least {fewest} more ({low} or more)", fewest=fewest, low=likely.low)
    return sentence(
        "at least {fewest} more ({low} to {high})",
        fewest=fewest,
        low=likely.low,
        high=likely.high,
    )
