"""Which recorded attempts belong to a research study, and the flow of participants they make.

The flow is that of the diagram of CONSORT 2010 (Schulz et al., BMJ 340:c332).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from app.core.progress import Progress
from app.research.design import ResearchDesign
from app.research.ledger import Participant, digest_of_person
from app.research.research_study import ResearchStudy, days_between
from app.session.index import Index, Indexed
from app.session.people import People


@dataclass(frozen=True, slots=True)
class StudyAttempt:
    """An attempt of a study.

    Attributes:
        participant: code.
        visit: name; empty outside of every window.
        day: after enrolment.
        number: within participant and visit, from 1.
        attempt: as this station lists it.
    """

    participant: str
    visit: str
    day: int
    number: int
    attempt: Indexed


def attempts_of(
    study: ResearchStudy,
    participants: Sequence[Participant],
    people: People,
    records: Path,
    progress: Progress | None = None,
) -> list[StudyAttempt]:
    """Return the attempts of participants at the exercise of their arm, since their enrolment.

    By code, then in time. Attempts of no person, drills, and those that this station does not vouch
    for are left out, and so are all of whoever withdrew the data.

    Raises:
        DatabaseError, SessionError: if the index cannot be read.
        Cancelled: if that was asked for.
    """
    salt = study.salt(people)
    by_person = {one.person: one for one in participants if not one.withdrawn}
    digests = {p.key: digest_of_person(salt, p.key) for p in people.everybody()}
    known = {key: by_person[digest] for key, digest in digests.items() if digest in by_person}
    if not known:
        return []
    exercises = {arm.name: study.exercise(arm.name).id for arm in study.design.arms}
    index = Index(records)
    index.refresh(progress)
    counts: Counter[tuple[str, str]] = Counter()
    found = []
    for one in index.attempts(list(known)):
        person = known[one.student]
        by_hand = one.conditions.by_person and not one.conditions.drill
        if not (one.stands and by_hand and one.exercise == exercises[person.arm]):
            continue
        if one.time < datetime.fromisoformat(person.enrolled):
            continue
        if person.left and one.time > datetime.fromisoformat(person.left_on):
            continue
        day = days_between(person.enrolled, one.time.isoformat())
        visit = study.design.visit_of(day)
        place = (person.code, visit.name if visit else "")
        counts[place] += 1
        found.append(StudyAttempt(*place, day, counts[place], one))
    return sorted(found, key=lambda one: (one.participant, one.attempt.started))


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
