"""Results of a group leave: tidy and wide tables, a gradebook that Moodle imports, and JSON.

Tables are CSV (RFC 4180, UTF-8 with byte order mark); with `semicolons` as Excel opens them on
computers whose decimal sign is the comma. Who made an attempt is told by pseudonym; a name that was
typed without signing in stands as it was typed, with an empty pseudonym.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any, Final

from app.core.disclaimer import DISCLAIMER
from app.core.errors import writing
from app.core.files import write_atomically
from app.core.json_values import finite
from app.core.progress import Progress
from app.core.words import printable
from app.exchange.csv_export import table_text, write_csv
from app.exchange.errors import ExportError
from app.exchange.moodle import MoodleChoice, moodle_text
from app.scoring.competence import competence_words
from app.scoring.conditions import comparison_groups
from app.scoring.errors import ReliabilityError
from app.session.accounts import Account
from app.session.audit import note
from app.session.board import ProgressBoard
from app.session.index import Indexed
from app.session.people import Person, Remarks
from app.session.reliability import agreement_document, course_reliability

TIDY: Final = (
    "pseudonym",
    "groups",
    "recorded_as",
    "attempt",
    "started_utc",
    "exercise",
    "version",
    "state",
    "hand",
    "signature",
    "void",
    "comparison_group",
    "comment",
    "metric",
    "value",
    "unit",
    "band",
    "sd",
    "note",
)
"""Columns of the tidy table: a row for each metric of each attempt; `score_total` is one."""

_OF_CELL: Final = ("attempts", "best", "last", "trend", "passed", "days_since", "competence")
_DAY: Final = 86400.0
_REPORT: Final = 100


class ResultsFormat(StrEnum):
    """Form in which results leave."""

    TIDY = "tidy"
    WIDE = "wide"
    MOODLE = "moodle"
    JSON = "json"


@dataclass(frozen=True)
class Results:
    """What leaves.

    Attributes:
        board: students by exercises.
        attempts: all that are told, oldest first.
        people: by key, which is what records name.
        remarks: by attempt.
        names: names by key where the instructor wants them in the files.
        accounts: what other programs call students, by key.
        titles: of exercises, by id.
    """

    board: ProgressBoard
    attempts: Sequence[Indexed]
    people: Mapping[str, Person]
    remarks: Mapping[str, Remarks]
    names: Mapping[str, str]
    accounts: Mapping[str, Mapping[Account, str]] = field(default_factory=dict)
    titles: Mapping[str, str] = field(default_factory=dict)


def results_text(
    results: Results,
    form: ResultsFormat,
    semicolons: bool = False,
    progress: Progress | None = None,
    gradebook: MoodleChoice | None = None,
    translate: Callable[[str], str] = str,
) -> str:
    """Return a file's text.

    Args:
        results: what leaves.
        form: of the file.
        semicolons: between cells; with decimal commas, but for Moodle.
        progress: reports, and may cancel.
        gradebook: how Moodle's is written; user names and the best by default.
        translate: a sentence into the language of the feedback.

    Raises:
        Cancelled: if that was asked for.
        ExportError: if Moodle could not tell whose a row of the gradebook is.
    """
    progress = progress or Progress()
    if form is ResultsFormat.TIDY:
        return table_text(_tidy(results, progress), semicolons)
    if form is ResultsFormat.WIDE:
        return table_text(_wide(results), semicolons)
    if form is ResultsFormat.MOODLE:
        progress.check()
        told = (results.accounts, results.titles, results.remarks, semicolons, translate)
        return moodle_text(results.board, gradebook or MoodleChoice(), *told)
    document = results_document(results, progress)
    text = json.dumps(finite(document), indent=1, ensure_ascii=False, allow_nan=False)
    return printable(text) + "\n"  # JSON's own escapes: it reads as it was


def write_results(path: Path, text: str) -> None:
    """Write a file whole or not at all; a table with the byte order mark for spreadsheets.

    Raises:
        ExportError: if it cannot be written.
    """
    note("results written")
    if path.suffix.lower() == ".csv":
        write_csv(path, text)
        return
    with writing(path, ExportError):
        write_atomically(path, text)


def results_document(results: Results, progress: Progress | None = None) -> dict[str, Any]:
    """Return everything as a JSON-ready mapping; the keys stand in docs/json.md."""
    progress = progress or Progress()
    attempts = []
    for number, (one, group) in enumerate(_grouped(results)):
        if number % _REPORT == 0:
            progress.report(number / len(results.attempts), one.id)
        person, said = results.people.get(one.student), results.remarks.get(one.id, Remarks())
        attempts.append(
            one.summary.document()
            | {
                "pseudonym": person.pseudonym if person else "",
                "comparison_group": group,
                "void": said.uncounted,
                "comment": said.comment,
                "released": said.released,
            }
        )
    return {
        "students": [_student(person, results) for person in results.board.students],
        "exercises": [item.model_dump(mode="json") for item in results.board.items],
        "board": board_rows(results.board),
        "attempts": attempts,
        "reliability": _reliability(results.board),
        "note": DISCLAIMER,
    }


def _reliability(board: ProgressBoard) -> dict[str, Any] | None:
    """Return how far the scores of a board can be relied on; None where that is not known."""
    try:
        result = course_reliability(board)
    except ReliabilityError:
        return None
    agreement = [agreement_document(one) for one in result.agreement]
    return {"decision": result.decision(), "agreement": agreement, "notes": list(result.notes)}


def board_rows(board: ProgressBoard) -> list[dict[str, Any]]:
    """Return the cells of a board as JSON-ready mappings, student by student."""
    return [
        {"pseudonym": person.pseudonym, "exercise": item.exercise, "version": item.version}
        | board.cells[person.key, item.exercise].document()
        | {"competence": competence_document(board, person.key, item.exercise)}
        for person in board.students
        for item in board.items
    ]


def competence_document(board: ProgressBoard, key: str, exercise: str) -> dict[str, Any] | None:
    """Return how a student stands at a skill, JSON-ready, with its `words`; None without any."""
    standing = board.competence(key, exercise)
    if standing is None:
        return None
    words = competence_words(standing, board.attempts_left(key, exercise))
    return standing.document() | {"words": words}


def _tidy(results: Results, progress: Progress) -> Iterator[Sequence[object]]:
    yield TIDY if not results.names else ("name", *TIDY)
    for number, (one, group) in enumerate(_grouped(results)):
        if number % _REPORT == 0:
            progress.report(number / len(results.attempts), one.id)
        person = results.people.get(one.student)
        said = results.remarks.get(one.id, Remarks())
        score = one.summary.score or {}
        void = said.uncounted or score.get("void_reason") or ""
        name = (results.names.get(person.key, "") if person else "",) if results.names else ()
        head = (
            *name,
            person.pseudonym if person else "",
            " ".join(person.groups) if person else "",
            one.student,
            one.id,
            one.started,
            one.exercise,
            one.version,
            one.state,
            one.conditions.hands,  # `arm` and `script` are nobody's, whoever watched
            one.verdict,
            void,
            group,
            said.comment,
        )
        total = ("score_total", one.total, "percent", _passed(one), score.get("total_sd"))
        yield (*head, *total, DISCLAIMER)
        for row in score.get("rows", ()):
            metric = (row["name"], row["value"], row["unit"], row["band"], row.get("sd"))
            yield (*head, *metric, DISCLAIMER)


def _wide(results: Results) -> Iterator[Sequence[object]]:
    board = results.board
    columns = [f"{item.exercise}_{name}" for item in board.items for name in _OF_CELL]
    name = ("name",) if results.names else ()
    yield (*name, "pseudonym", "groups", *columns, "note")
    for person in board.students:
        cells: list[object] = []
        for item in board.items:
            cell = board.cells[person.key, item.exercise]
            days = None if cell.since is None else cell.since.total_seconds() / _DAY
            passed = cell.passed if cell.attempts else None
            standing = board.competence(person.key, item.exercise)
            state = None if standing is None else standing.state.value
            cells += [cell.attempts, cell.best, cell.last, cell.trend, passed, days, state]
        known = (results.names.get(person.key, ""),) if results.names else ()
        yield (*known, person.pseudonym, " ".join(person.groups), *cells, DISCLAIMER)


def _grouped(results: Results) -> Iterator[tuple[Indexed, int | None]]:
    """Yield attempts with the group within which scores may be compared; None without one."""
    known = [one.conditions if one.total is not None else None for one in results.attempts]
    yield from zip(results.attempts, comparison_groups(known), strict=True)


def _student(person: Person, results: Results) -> dict[str, Any]:
    found = {"pseudonym": person.pseudonym, "groups": list(person.groups)}
    return found | ({"name": results.names.get(person.key, "")} if results.names else {})


def _passed(item: Indexed) -> str:
    return "" if item.passed is None else ("passed" if item.passed else "not passed")
