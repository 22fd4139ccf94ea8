"""Survey: do the tests of competence keep the errors that they state?

Virtual students attempt, each attempt failing with a rate that only the survey knows. Their scores
are computed here, from the ratio of likelihoods and without the Markov chain that set the limits.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.progress import Progress
from app.scoring.competence import Design, design
from app.scoring.competence.cusum import learning_weights, watching_weights
from app.scoring.competence.design import NEAR, head_start
from app.scoring.competence.forecast import INTERVAL, LAST, forecast
from app.scoring.competence.rule import RULE, CompetenceRule
from app.scoring.competence.run_lengths import mean_run_length, signalled_by
from app.studies.findings import Cell, Figure, Findings, Sheet, Survey

DECLARATION: Final[dict[str, Any]] = {
    "title": "Competence: LC-CUSUM, then CUSUM",
    "question": "Are as few called competent wrongly, or missed, as is stated, and how late?",
    "reference": "virtual students whose failure rate is known; error rates of R's package cusum",
}

STUDENTS: Final = 100_000
QUICK: Final = 10_000
_SEED: Final = 2029
_ERRORS: Final = 4.0
"""A simulated share may lie so many standard errors from the exact one."""


def _rule(acceptable: float, unacceptable: float, missed: float) -> CompetenceRule:
    return CompetenceRule(acceptable=acceptable, unacceptable=unacceptable, missed=missed)


RULES: Final = (
    ("the default", RULE),
    ("ERCP, Wani 2016", _rule(0.10, 0.20, 0.20)),
    ("epidural, Sivaprakasam 2010", _rule(0.15, 0.30, 0.10)),
    ("gastrostomy, PMC4188705", _rule(0.05, 0.15, 0.10)),
    ("hysteroscopy, Issat 2017", _rule(0.03, 0.10, 0.20)),
    ("fetoscopic laser, Papanna 2011", _rule(0.18, 0.30, 0.20)),
    ("in fewer attempts", _rule(0.10, 0.50, 0.10)),
)
"""Failure rates that were published with a test, and the default."""


@dataclass(frozen=True, slots=True)
class PublishedError:
    """A share of false signals that others simulated.

    Attributes:
        source: where it stands.
        failure_rate: of the null hypothesis.
        odds_ratio: of the alternative: above 1 watches, below 1 learns.
        attempts, limit: of the test.
        share: that was printed.
        runs: that it was simulated with.
    """

    source: str
    failure_rate: float
    odds_ratio: float
    attempts: int
    limit: float
    share: float
    runs: int

    def exact(self) -> float:
        """Return the share by this program's chain."""
        odds = self.odds_ratio * self.failure_rate / (1.0 - self.failure_rate)
        other = odds / (1.0 + odds)
        weights = (
            watching_weights(self.failure_rate, other)
            if self.odds_ratio > 1.0
            else learning_weights(other, self.failure_rate)
        )
        return float(signalled_by(weights, self.limit, self.failure_rate, self.attempts)[-1])

    def error(self) -> float:
        """Return the standard error of the simulation that was printed."""
        return float(np.sqrt(self.share * (1.0 - self.share) / self.runs))


PUBLISHED: Final = (
    PublishedError("cusum 0.4, test of alpha", 0.05, 2.0, 100, 2.96, 0.038, 10_000),
    PublishedError("cusum 0.2, test of alpha", 0.05, 2.0, 100, 2.96, 0.039, 10_000),
    PublishedError("cusum, test of alpha, improvement", 0.10, 0.5, 100, 2.96, 0.026, 10_000),
    PublishedError("cusum, README", 0.05, 2.0, 100, 2.712558, 0.05, 1_000),
    PublishedError("cusum, test of the limit", 0.05, 2.0, 100, 2.80, 0.05, 10_000),
)
"""Of the R package cusum (Hubig, lhubig/cusum): what its pages and tests print."""

TRUTHS: Final = ((0.8, 0.05, 3.0), (0.8, 0.05, 6.0), (0.8, 0.05, 12.0), (0.6, 0.10, 8.0))
"""Hidden failure rates: first, last, and in how many attempts what is between falls to 1/e."""


def signals(
    null: float,
    alternative: float,
    limit: float,
    rates: FloatArray,
    students: int,
    rng: np.random.Generator,
    start: float = 0.0,
) -> FloatArray:
    """Return with which attempt each virtual student gets a signal; inf where none did.

    Args:
        null: failure rate of the hypothesis that holds until there is a signal.
        alternative: that of the other one.
        limit: h.
        rates: true failure rate of each attempt, shape (n,).
        students: how many.
        rng: draws who fails.
        start: score before the first attempt.
    """
    failing = np.log(alternative / null)
    passing = np.log((1.0 - alternative) / (1.0 - null))
    score = np.full(students, start)
    when = np.full(students, np.inf)
    for number, rate in enumerate(rates, 1):
        score = np.maximum(0.0, score + np.where(rng.random(students) < rate, failing, passing))
        when[(score >= limit) & np.isinf(when)] = number
    return when


def errors(students: int, rng: np.random.Generator, progress: Progress) -> Sheet:
    """Return asked, exact and simulated errors of each rule, and whether they hold."""
    rows = []
    for place, (name, rule) in enumerate(RULES):
        progress.report(place / len(RULES), name)
        plan = design(rule)
        low, high = rule.acceptable, rule.unacceptable
        ahead = np.ones(plan.attempts)
        learning, watching = (high, low, plan.limit), (low, high, plan.watch_limit)
        shares = (
            np.isfinite(signals(*learning, high * ahead, students, rng)).mean(),
            np.isinf(signals(*learning, low * ahead, students, rng)).mean(),
            np.isfinite(signals(*watching, low * ahead, students, rng)).mean(),
        )
        exact = (plan.false_alarm, plan.missed, plan.false_relapse)
        asked = (rule.false_alarm, rule.missed, rule.false_alarm)
        rows.append(
            (
                *(name, low, high, plan.limit, plan.attempts),
                *(rule.false_alarm, _figure(plan.false_alarm), _figure(shares[0])),
                *(rule.missed, _figure(plan.missed), _figure(shares[1])),
                *(plan.watch_limit, _figure(plan.false_relapse), _figure(shares[2])),
                _verdict(asked, exact, shares, students),
            )
        )
    columns = (
        *("rates of", "p0", "p1", "h", "N"),
        *("alpha asked", "alpha", "alpha simulated"),
        *("beta asked", "beta", "beta simulated"),
        *("h of relapse", "false relapse", "false relapse simulated", "holds"),
    )
    return Sheet("errors", "Errors asked, exact and simulated", columns, tuple(rows))


def _verdict(
    asked: tuple[float, ...], exact: tuple[float, ...], shares: tuple[float, ...], students: int
) -> str:
    """Say whether errors hold; `coarse` where steps of the score let one lie further below."""
    for wanted, known, seen in zip(asked, exact, shares, strict=True):
        error = np.sqrt(known * (1.0 - known) / students)
        if known > wanted:
            return "above what was asked"
        if abs(seen - known) > _ERRORS * error + 1.0 / students:
            return "simulated otherwise"
    near = all(wanted - known <= NEAR for wanted, known in zip(asked[:2], exact[:2], strict=True))
    return "yes" if near else "yes, coarse"


def published() -> Sheet:
    """Return printed shares of false signals beside this program's."""
    rows = []
    for one in PUBLISHED:
        exact, error = one.exact(), one.error()
        holds = abs(exact - one.share) <= 2.0 * error + 0.0005
        rows.append(
            (
                *(one.source, one.failure_rate, one.odds_ratio, one.attempts, one.limit),
                *(one.share, round(error, 4), _figure(exact), "yes" if holds else "no"),
            )
        )
    columns = (
        *("source", "failure rate", "odds ratio", "N", "h"),
        *("printed", "its standard error", "here, exact", "holds"),
    )
    return Sheet("published", "False signals that others printed", columns, tuple(rows))


def learning_curves(students: int, rng: np.random.Generator) -> Sheet:
    """Return how late students who are learning are called competent, after they are."""
    plan = design()
    rows = []
    for first, last, scale in TRUTHS:
        attempts = np.arange(10 * plan.attempts)
        rates = last + (first - last) * np.exp(-attempts / scale)
        when = signals(RULE.unacceptable, RULE.acceptable, plan.limit, rates, students, rng)
        better = int(np.argmax(rates < RULE.unacceptable)) + 1
        good = np.flatnonzero(rates <= RULE.acceptable + 0.02)
        low, middle, high = np.quantile(when, (0.1, 0.5, 0.9), method="inverted_cdf")
        rows.append(
            (
                *(f"{first:g} to {last:g}, 1/e in {scale:g}", better),
                int(good[0]) + 1 if len(good) else "-",
                _figure((when < better).mean()),
                *(int(low), int(middle), int(high)),
            )
        )
    columns = (
        *(
            "failure rate",
            "below p1 from",
            "within 0.02 of p0 from",
            "called before it is below p1",
        ),
        *("called, 10 %", "called, median", "called, 90 %"),
    )
    return Sheet("learning", "Students who learn: attempt of the signal", columns, tuple(rows))


def relapses(students: int, rng: np.random.Generator) -> Sheet:
    """Return how late a relapse is seen, with and without a gap before it."""
    plan, rows = design(), list[tuple[Cell, ...]]()
    for name, start in (("practising", 0.0), ("after a gap", head_start(plan.watch_limit))):
        rates = np.full(10 * plan.attempts, RULE.unacceptable)
        low, high, limit = RULE.acceptable, RULE.unacceptable, plan.watch_limit
        when = signals(low, high, limit, rates, students, rng, start)
        false = plan.false_relapse_after_gap if start else plan.false_relapse
        seen = np.quantile(when, (0.1, 0.5, 0.9), method="inverted_cdf")
        mean = mean_run_length(plan.watching, plan.watch_limit, RULE.acceptable)
        between: Cell = "-" if start else round(mean)
        rows.append((name, _figure(false), between, *(int(number) for number in seen)))
    columns = (
        *("student", f"false relapse in {plan.attempts}", "mean attempts to a false one"),
        *("seen, 10 %", "seen, median", "seen, 90 %"),
    )
    return Sheet("relapses", "A relapse to p1: attempts until it is seen", columns, tuple(rows))


def forecasts(students: int, rng: np.random.Generator) -> Sheet:
    """Return how often the interval of "attempts more" holds, by failure rate.

    Of the last row rates are drawn from what the forecast supposes of them before any attempt: its
    share is that which the interval states, or more, since attempts are whole numbers.
    """
    plan, rows = design(), list[tuple[Cell, ...]]()
    for rate in (0.05, 0.1, 0.2, 0.3, 0.4, None):
        counts = []
        for before in (8, 16):
            rates = rng.beta(0.5, 0.5, students) if rate is None else np.full(students, rate)
            held = [_foretold(plan, before, one, rng) for one in rates]
            known = [one for one in held if one is not None]
            counts.append(_figure(sum(known) / len(known)))
        shown: Cell = "drawn" if rate is None else rate
        rows.append((shown, *counts))
    columns = ("failure rate", "after 8 attempts", "after 16 attempts")
    title = f"Forecasts of attempts more that held ({INTERVAL:.0%} stated)"
    return Sheet("forecasts", title, columns, tuple(rows))


def _foretold(plan: Design, before: int, rate: float, rng: np.random.Generator) -> bool | None:
    """Return whether the forecast of one student held; None if he was competent before it."""
    failed = rng.random(before + 3 * plan.attempts) < rate
    score = 0.0
    for one in failed[:before]:
        score = plan.learning.after(score, not one)
        if score >= plan.limit:
            return None
    likely = forecast(plan, score, list(~failed[:before][-LAST:]))
    number = _more(plan, score, failed[before:])
    low, high = likely.low or np.inf, likely.high or np.inf
    return bool(low <= number <= high)


def _more(plan: Design, score: float, failed: np.ndarray[Any, np.dtype[np.bool_]]) -> float:
    """Return after how many attempts the learning test signals; inf beyond what is looked at."""
    for number, one in enumerate(failed, 1):
        score = plan.learning.after(score, not one)
        if score >= plan.limit:
            return number
    return np.inf


def _measured(students: int, progress: Progress | None) -> Findings:
    rng = np.random.default_rng(_SEED)
    table = errors(students, rng, progress or Progress())
    others = published()
    learned, relapsed = learning_curves(students, rng), relapses(students, rng)
    foretold = forecasts(students // 50, rng)
    holding = [str(row[-1]).startswith("yes") for row in (*table.rows, *others.rows)]
    shares = [float(share) for share in foretold.rows[-1][1:]]
    lines = (
        f"{sum(holding)} of {len(holding)} errors hold, over {students} virtual students each.",
        *(f"{row[0]}: {row[-1]}" for row in table.rows if row[-1] != "yes"),
    )
    return Findings(
        (table, others, learned, relapsed, foretold),
        (Figure("errors", lambda figure: _draw(figure, table.rows), (8.0, 4.5)),),
        lines,
        all(holding) and min(shares) >= INTERVAL - 0.03,
    )


def _draw(figure: Any, rows: tuple[tuple[Cell, ...], ...]) -> None:
    """Draw errors that were asked, exact and simulated, a rule a line."""
    axes = figure.subplots(1, 2, sharey=True)
    places = list(range(len(rows), 0, -1))
    for one, title, first in ((axes[0], "alpha", 5), (axes[1], "beta", 8)):
        for column, marker in ((first, "|"), (first + 1, "o"), (first + 2, "x")):
            one.plot([row[column] for row in rows], places, marker, markersize=8)
        one.set(xlabel=f"{title}: asked (|), exact (o), simulated (x)", xlim=(0.0, None))
    axes[0].set_yticks(places, [str(row[0]) for row in rows], fontsize=8)
    figure.tight_layout()


def _figure(share: float) -> float:
    return round(float(share), 4)


def _measure(progress: Progress | None = None, inputs: tuple[Any, ...] = ()) -> Findings:
    return _measured(STUDENTS, progress)


def _first_look(progress: Progress | None = None, inputs: tuple[Any, ...] = ()) -> Findings:
    return _measured(QUICK, progress)


STUDY: Final = Survey(measure=_measure, quick=_first_look)
"""Errors of the two tests, how late they signal, and whether the forecast holds."""
