"""Attempts as statements of the Experience API (xAPI 1.0.3 by ADL; 2.0, IEEE 9274.1.1, alike).

A statement says who (an account by pseudonym), did what (passed, failed, or completed where there
is no verdict), at which exercise, with which score, for how long and when. Its id is made of the
attempt's, so a statement that is made twice is the same, and a store that has it takes no second
one. Ids begin with an address that the hospital or university owns; nothing need answer there.

Results keep the rules of cmi5 (section 9.5): a score and `success` with passed and failed alone,
`completion` with completed alone, whole points, a duration; the pass mark as `masteryscore` where
the verdict follows from it. No LMS starts Acus, so a statement claims no registration, no session
and not the category of cmi5. What was measured is an extension whose name ends in its unit.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from datetime import UTC, datetime
from typing import Any, Final
from urllib.parse import quote
from uuid import NAMESPACE_URL, uuid5

from app.core.disclaimer import DISCLAIMER
from app.core.json_values import finite
from app.core.messages import sentence
from app.core.progress import Progress
from app.core.words import printable
from app.exchange.errors import ExportError
from app.exchange.results import Results
from app.scoring.conditions import DeviceKind
from app.session.index import Indexed
from app.session.people import Person, Remarks
from app.session.statement_queue import QueuedStatement

VERBS: Final = {
    True: "http://adlnet.gov/expapi/verbs/passed",
    False: "http://adlnet.gov/expapi/verbs/failed",
    None: "http://adlnet.gov/expapi/verbs/completed",
}
"""Verbs of ADL's vocabulary by whether an attempt passes; None without a score."""

VOIDED: Final = "http://adlnet.gov/expapi/verbs/voided"
SIMULATION: Final = "http://adlnet.gov/expapi/activities/simulation"
MASTERY: Final = "https://w3id.org/xapi/cmi5/context/extensions/masteryscore"

_UNITS: Final = str.maketrans({"%": "percent", "°": "deg", "²": "2", "³": "3"})

_HOME: Final = re.compile(r"https?://[A-Za-z0-9.-]+(:\d+)?(/[A-Za-z0-9._~/-]*)?")
_REPORT: Final = 100


def checked_home(address: str) -> str:
    """Return an address that ids may begin with, without a slash at its end.

    Raises:
        ExportError: if it is none.
    """
    if not _HOME.fullmatch(address):
        raise ExportError(
            sentence(
                "{address!r} cannot begin the ids of statements: give an address that you own, "
                "such as https://training.hospital.example",
                address=address,
            )
        )
    return address.rstrip("/")


def statements(
    results: Results, home: str, course: str = "", progress: Progress | None = None
) -> list[QueuedStatement]:
    """Return a statement for each attempt that was ended by a student and stands.

    Left out are void ones, what is beyond a course's limit, drills, what the arm, a script or an
    emulated robot did, and what was aborted.

    Args:
        results: attempts, people, remarks and titles.
        home: address that ids begin with.
        course: id of the course that they belong to.
        progress: reports, and may cancel.

    Raises:
        Cancelled: if that was asked for.
        ExportError: if the address cannot begin an id.
    """
    home, progress = checked_home(home), progress or Progress()
    found = []
    for number, attempt in enumerate(results.attempts):
        if number % _REPORT == 0:
            progress.report(number / len(results.attempts), attempt.id)
        person = results.people.get(attempt.student)
        uncounted = results.remarks.get(attempt.id, Remarks()).uncounted
        if person is not None and not uncounted and _is_told(attempt):
            document = statement(attempt, person, home, results.titles, course)
            found.append(QueuedStatement(person.key, document))
    return found


def voiding_statements(results: Results, home: str) -> dict[str, QueuedStatement]:
    """Return what takes back the statement of each attempt that no longer counts, by its id.

    A statement that was sent cannot be changed, only voided (xAPI-Data 2.3.2), and not be sent
    again under its id: once voided it stays so, whatever is said of the attempt later.

    Raises:
        ExportError: if the address cannot begin an id.
    """
    home, found = checked_home(home), {}
    actor = {"objectType": "Agent", "account": {"homePage": home, "name": "instructor"}}
    for attempt in results.attempts:
        person = results.people.get(attempt.student)
        if person is None or not results.remarks.get(attempt.id, Remarks()).uncounted:
            continue
        voided = _id(home, attempt)
        found[voided] = QueuedStatement(
            person.key,
            {
                "id": str(uuid5(NAMESPACE_URL, f"{home}/voided/{voided}")),
                "actor": actor,
                "verb": {"id": VOIDED, "display": {"en": "voided"}},
                "object": {"objectType": "StatementRef", "id": voided},
            },
        )
    return found


def statement(
    attempt: Indexed, person: Person, home: str, titles: Mapping[str, str], course: str = ""
) -> dict[str, Any]:
    """Return the statement of an attempt, JSON-ready; arguments as of `statements`."""
    title = titles.get(attempt.exercise, "") or attempt.exercise
    exercise = f"{home}/exercises/{quote(attempt.exercise, safe='')}/versions/{attempt.version}"
    passed = attempt.passed if attempt.total is not None else None
    result: dict[str, Any] = {"duration": f"PT{max(0.0, attempt.duration):.2f}S"}
    context: dict[str, Any] = {"platform": "Acus"}  # its version would make it another statement
    told = json.loads(attempt.document).get("score") or {}
    if attempt.total is None or passed is None:
        result["completion"] = True
    else:
        points = min(100.0, max(0.0, attempt.total))
        scaled = round(points / 100.0, 4)
        score = {"scaled": scaled, "raw": round(points), "min": 0, "max": 100}
        result |= {"score": score, "success": passed}
        mark = told.get("rules", {}).get("pass_mark")
        if mark is not None and (scaled >= round(mark / 100.0, 4)) is passed:
            context["extensions"] = {MASTERY: round(mark / 100.0, 4)}
    if measured := _measured(told.get("rows", ()), home):
        result["extensions"] = measured
    if course:
        parent = {"objectType": "Activity", "id": f"{home}/courses/{quote(course, safe='')}"}
        context["contextActivities"] = {"parent": [parent]}
    verb = VERBS[passed]
    document: dict[str, Any] = {
        "id": _id(home, attempt),
        "actor": {
            "objectType": "Agent",
            "account": {"homePage": home, "name": printable(person.pseudonym)},
        },
        "verb": {"id": verb, "display": {"en": verb.rpartition("/")[2]}},
        "object": {
            "objectType": "Activity",
            "id": exercise,
            "definition": {
                "type": SIMULATION,
                "name": {"en": printable(title)},
                "description": {"en": DISCLAIMER},
            },
        },
        "result": finite(result),
        "context": context,
    }
    started = attempt.time
    if started > datetime.fromtimestamp(0.0, UTC):  # else the record does not say
        moment = started.astimezone(UTC).isoformat(timespec="milliseconds")
        document["timestamp"] = moment.replace("+00:00", "Z")
    return document


def statements_text(queued: Sequence[QueuedStatement], array: bool) -> str:
    """Return statements as a JSON array, or as one a line."""
    documents = [one.statement for one in queued]
    if array:
        return json.dumps(documents, indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    return "".join(_lines(documents))


def _lines(documents: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    for document in documents:
        yield json.dumps(document, ensure_ascii=False, allow_nan=False) + "\n"


def _measured(rows: Sequence[Mapping[str, Any]], home: str) -> dict[str, float]:
    """Return the values of a score's rows by IRIs that end in their units."""
    found = {}
    for row in rows:
        if row["value"] is not None:
            words = f"{row['name']} {row['unit']}".translate(_UNITS).lower()
            name = re.sub(r"[^a-z0-9]+", "-", words).strip("-").replace("-scans-scans", "-scans")
            found[f"{home}/extensions/{name}"] = float(f"{row['value']:.4g}")
    return found


def _id(home: str, attempt: Indexed) -> str:
    """Return the id of an attempt's statement: the same whenever it is made."""
    return str(uuid5(NAMESPACE_URL, f"{home}/attempts/{quote(attempt.id, safe='')}"))


def _is_told(attempt: Indexed) -> bool:
    under = attempt.conditions
    return (
        attempt.state == "ended"
        and attempt.stands
        and under.by_person
        and not under.drill
        and under.kind is not DeviceKind.EMULATED
    )
