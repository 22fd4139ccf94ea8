"""The flow of participants, as the diagram of CONSORT 2010 has it (Schulz et al., BMJ 340:c332)."""

from __future__ import annotations

from collections.abc import Sequence

from app.research.attempts import StudyAttempt
from app.research.design import ResearchDesign
from app.research.ledger import Participant


def consort_rows(
    design: ResearchDesign,
    participants: Sequence[Participant],
    attempts: Sequence[StudyAttempt],
) -> list[tuple[str, str, int]]:
    """Return stage, arm and number of participants, over all arms and for each.

    `randomised`, `began` (an attempt at least), `attended: VISIT`, `left`, `withdrawn` (of those
    who left: their data are not used) and `analysed` (a scored attempt in the last visit's window).
    Who was asked and not enrolled is not known here.
    """
    reached: dict[str, set[str]] = {"began": {one.participant for one in attempts}}
    for visit in design.visits:
        there = {one.participant for one in attempts if one.visit == visit.name}
        reached[f"attended: {visit.name}"] = there
    last = design.visits[-1].name
    analysed = {
        one.participant for one in attempts if one.visit == last and one.attempt.total is not None
    }
    stages = {
        "randomised": {one.code for one in participants},
        **reached,
        "left": {one.code for one in participants if one.left},
        "withdrawn": {one.code for one in participants if one.withdrawn},
        "analysed": analysed,
    }
    arms = {one.code: one.arm for one in participants}
    found = []
    for stage, codes in stages.items():
        found.append((stage, "all", len(codes)))
        for arm in design.arms:
            found.append((stage, arm.name, sum(arms[code] == arm.name for code in codes)))
    return found
