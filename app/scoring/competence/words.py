"""What is said of somebody's competence, in a line."""

from __future__ import annotations

from math import ceil

from app.core.messages import Sentence, counted, sentence
from app.scoring.competence.following import Competence, CompetenceState


def competence_words(standing: Competence) -> Sentence:
    """Say how somebody stands: since which attempt, with which error, how many more."""
    if standing.state is CompetenceState.COMPETENT:
        alarm = standing.false_alarm if standing.false_alarm is not None else 1.0
        return sentence(
            "competent after {attempts} (false alarm ≤ {percent} %)",
            attempts=counted("{n} attempt", "{n} attempts", standing.changes[-1].attempt),
            percent=min(100, ceil(100.0 * alarm - 1e-9)),
        )
    more = _more(standing)
    if standing.state is CompetenceState.RELAPSE:
        return sentence(
            "relapse after attempt {attempt}: {more}",
            attempt=standing.changes[-1].attempt,
            more=more,
        )
    return sentence("not yet: {more}", more=more)


def _more(standing: Competence) -> Sentence:
    """Say how many attempts more there are at least, and within what they may lie."""
    fewest, likely = standing.fewest, standing.forecast
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
