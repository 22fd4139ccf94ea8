"""Where a research study stands: who is enrolled, which visits are due."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from datetime import date, datetime, timedelta
from pathlib import Path
from typing import Any

from app.research.attempts import attempts_of
from app.research.design import ResearchDesign
from app.research.ledger import Participant, digest_of_person, locked_at, participants_of
from app.research.research_study import ResearchStudy
from app.session.people import People


def status_of(study: ResearchStudy, people: People, records: Path) -> dict[str, Any]:
    """Return where a study stands, JSON-ready; the keys stand in docs/json.md.

    Args:
        study: of which.
        people: of this station.
        records: folder of the records.
    """
    entries = study.ledger.entries()
    everybody, locked = participants_of(entries), locked_at(entries)
    blind = study.design.blind_assessor and not locked
    counts = Counter(one.arm for one in everybody)
    salt = study.salt(people)
    made = Counter((a.participant, a.visit) for a in attempts_of(study, everybody, people, records))
    pseudonyms = {digest_of_person(salt, p.key): p.pseudonym for p in people.everybody()}
    arms = [{"arm": arm.name, "enrolled": counts[arm.name]} for arm in study.design.arms]
    return {
        "study": study.design.id,
        "title": study.design.title,
        "participants": study.design.participants,
        "enrolled": len(everybody),
        "left": sum(bool(one.left) for one in everybody),
        "blind": blind,
        "arms": [] if blind else arms,
        "locked": locked or None,
        "commitment": study.sealed["commitment"],
        "due": due(study.design, everybody, study.clock().date(), pseudonyms, made),
    }


def taking_part(study: ResearchStudy, people: People) -> list[str]:
    """Return the pseudonyms of who takes part at this station and has not left, in their order."""
    salt = study.salt(people)
    inside = {one.person for one in study.participants() if not one.left}
    found = [p.pseudonym for p in people.everybody() if digest_of_person(salt, p.key) in inside]
    return sorted(found, key=str.casefold)


def due(
    design: ResearchDesign,
    participants: list[Participant],
    today: date,
    pseudonyms: Mapping[str, str],
    made: Mapping[tuple[str, str], int],
) -> list[dict[str, Any]]:
    """Return the next visit of each participant who has not left, the one that closes first first.

    Args:
        design: of the study.
        participants: everybody.
        today: UTC.
        pseudonyms: at this station, by the digest of the student.
        made: attempts by code and visit.
    """
    found = []
    for one in participants:
        if one.left or one.person not in pseudonyms:
            continue
        day = (today - datetime.fromisoformat(one.enrolled).date()).days
        to_come = (v for v in design.visits if day <= v.day + v.after)
        visit = next((v for v in to_come if made.get((one.code, v.name), 0) < v.attempts), None)
        if visit is None:
            continue
        zero = datetime.fromisoformat(one.enrolled).date()
        closes = zero + timedelta(days=visit.day + visit.after)
        row = {
            "pseudonym": pseudonyms[one.person],
            "code": one.code,
            "visit": visit.name,
            "opens": (zero + timedelta(days=visit.day - visit.before)).isoformat(),
            "closes": closes.isoformat(),
            "open": visit.holds(day),
            "late": day > visit.day,
            "attempts": made.get((one.code, visit.name), 0),
            "wanted": visit.attempts,
        }
        found.append(row)
    return sorted(found, key=lambda row: (row["closes"], row["code"]))
