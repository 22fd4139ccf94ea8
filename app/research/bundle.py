"""The bundle of a research study: all that a reader needs to check it, in one file, naming nobody.

A ZIP archive of plain files: tidy tables (CSV, RFC 4180, UTF-8), the codebook of their columns, the
flow of participants, design and analysis plan, the opened list of allocations, exercises, versions,
and of each attempt its series and its score; `manifest.json` holds the SHA-256 of every file. The
same study gives the same bytes.
"""

from __future__ import annotations

import csv
import hashlib
import hmac
import io
import json
import os
import platform
import re
import zipfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
import yaml

from app import __version__
from app.core import paths
from app.core.disclaimer import DISCLAIMER
from app.core.errors import AcusError
from app.core.files import beside, replace, step
from app.core.messages import sentence
from app.core.progress import Progress
from app.core.words import printable
from app.exercises.writing import exercise_text
from app.research.allocation_list import allocation_lists, open_hidden
from app.research.attempts import StudyAttempt, attempts_of, consort_rows
from app.research.bundle_figures import bundle_figures, matplotlib_version
from app.research.bundle_tables import parquet_files
from app.research.codebook import CODEBOOK, TABLES, codebook_rows, metric_rows
from app.research.errors import ResearchError
from app.research.ledger import ANSWERED, Participant, participants_of
from app.research.research_study import ResearchStudy, days_between
from app.research.series import attempt_document, series_table
from app.scoring.version import SCORING_VERSION
from app.session.facts import PLAN
from app.session.people import People
from app.session.recording import read_recording
from app.session.station import StationKey
from app.session.store import find
from app.session.verify import judged_by, verify

FORM: Final = "acus-research-bundle/1"
MANIFEST: Final = "manifest.json"
_TIME: Final = (1980, 1, 1, 0, 0, 0)
_PACKED: Final = (".gz", ".parquet")
_SHORTEST: Final = 3
"""A pseudonym of fewer letters is a word of its own in any text."""

Rows = Iterable[Sequence[object]]


@dataclass(frozen=True, slots=True)
class Bundled:
    """What was written.

    Attributes:
        participants: how many.
        attempts: how many.
        series: of how many attempts a series is in it.
        without: what is not in it because a package is not installed, one line each.
        digest: SHA-256 of the manifest, which holds those of all files: state it where the study
            is published.
    """

    participants: int
    attempts: int
    series: int
    digest: str
    without: tuple[str, ...] = ()


def write_bundle(
    study: ResearchStudy,
    people: People,
    records: Path,
    out: Path,
    progress: Progress | None = None,
) -> Bundled:
    """Write the bundle of a study, whole or not at all.

    Raises:
        ResearchError: if arms are hidden still, an arm has no student, a text names one, or the
            file cannot be written; says what to do.
        Cancelled: if that was asked for.
    """
    progress = progress or Progress()
    entries = study.ledger.entries()
    everybody = participants_of(entries)
    _check_ready(study, everybody)
    attempts = attempts_of(study, everybody, people, records)
    salt = study.salt(people)
    codes = {one.attempt.id: _code(salt, one.attempt.id) for one in attempts}
    files: dict[str, bytes] = {}
    for number, one in enumerate(attempts):
        progress.report(number / len(attempts), codes[one.attempt.id])
        files |= _attempt_files(records, one, codes[one.attempt.id])
    with_series = {code for code in codes.values() if f"series/{code}.csv.gz" in files}
    files |= _tables(study, entries, everybody, attempts, codes, with_series)
    files |= _documents(study, people)
    without = []
    for make in (parquet_files, bundle_figures):
        try:
            files |= make(files)
        except ResearchError as error:  # its package is not installed
            without.append(str(error))
    _check_private(files, people)
    manifest = {
        "form": FORM,
        "study": study.design.id,
        "software": __version__,
        "files": {name: hashlib.sha256(data).hexdigest() for name, data in sorted(files.items())},
        "note": DISCLAIMER,
    }
    files[MANIFEST] = _json(manifest)
    _write(out, files)
    digest = hashlib.sha256(files[MANIFEST]).hexdigest()
    series = sum(name.startswith("series/") for name in files)
    return Bundled(len(everybody), len(attempts), series, digest, tuple(without))


def table_bytes(columns: Sequence[str], rows: Rows) -> bytes:
    """Return a table as CSV, numbers with all their digits; R and pandas read it as it is."""
    stream = io.StringIO(newline="")
    lines = csv.writer(stream, lineterminator="\r\n")
    lines.writerow(columns)
    lines.writerows([_cell(value) for value in row] for row in rows)
    return stream.getvalue().encode()


def _cell(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(int(value))
    if isinstance(value, float):
        return repr(value) if np.isfinite(value) else ""
    return " ".join(printable(str(value)).split())


def _json(document: Any) -> bytes:
    return (json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False) + "\n").encode()


def _code(salt: bytes, attempt: str) -> str:
    return "A-" + hmac.digest(salt, attempt.encode(), "sha256").hex()[:12]


def _check_ready(study: ResearchStudy, everybody: Sequence[Participant]) -> None:
    if study.blind():
        raise ResearchError(
            sentence(
                "the assessor of {study} is blind, and the bundle shows the arms: lock the data "
                "first, `acus research lock`",
                study=study.design.id,
            )
        )
    for arm in study.design.arms:
        if not any(one.arm == arm.name for one in everybody):
            raise ResearchError(
                sentence("arm {arm} has no student: enrol some before the bundle", arm=arm.name)
            )


def _attempt_files(records: Path, made: StudyAttempt, code: str) -> dict[str, bytes]:
    """Return series and score of an attempt; nothing of one that has no score to compute."""
    try:
        recording = read_recording(find(records, made.attempt.id))
        standing = verify(recording).standing
        if standing is None:
            return {}
        trajectory = recording.trajectory()
        tolerances, rules = judged_by(recording, standing)
    except AcusError:
        return {}
    plan = recording.metadata[PLAN]
    document = attempt_document(trajectory, plan, standing, tolerances, rules)
    return {
        f"series/{code}.csv.gz": series_table(trajectory),
        f"attempts/{code}.json": _json(document),
    }


def _tables(
    study: ResearchStudy,
    entries: Sequence[Mapping[str, Any]],
    everybody: Sequence[Participant],
    attempts: Sequence[StudyAttempt],
    codes: Mapping[str, str],
    with_series: set[str],
) -> dict[str, bytes]:
    withdrawn = {one.code for one in everybody if one.withdrawn}
    arms = {one.code: one.arm for one in everybody}
    rows: dict[str, Rows] = {
        "participants.csv": [_participant(one) for one in everybody],
        "attempts.csv": [
            _attempt(one, arms[one.participant], codes[one.attempt.id], with_series)
            for one in attempts
        ],
        "metrics.csv": _metrics(attempts, codes),
        "answers.csv": _answers(entries, withdrawn),
        "consort.csv": consort_rows(study.design, everybody, attempts),
        "metrics_codebook.csv": metric_rows(),
    }
    found = {
        name: table_bytes([column.name for column in TABLES[name]], lines)
        for name, lines in rows.items()
    }
    return found | {"codebook.csv": table_bytes(CODEBOOK, codebook_rows(__version__))}


def _participant(person: Participant) -> Sequence[object]:
    return (
        person.code,
        person.arm,
        person.stratum,
        person.slot + 1,
        person.consent["version"],
        bool(person.left),
        days_between(person.enrolled, person.left_on) if person.left else None,
        person.left,
        person.withdrawn,
    )


def _attempt(made: StudyAttempt, arm: str, code: str, with_series: set[str]) -> Sequence[object]:
    attempt, c = made.attempt, made.attempt.conditions
    result, dial = attempt.summary.score or {}, c.assistance
    return (
        code,
        made.participant,
        arm,
        made.visit,
        made.day,
        made.number,
        attempt.exercise,
        attempt.version,
        attempt.state,
        attempt.duration,
        attempt.total,
        result.get("total_sd"),
        attempt.passed,
        result.get("void_reason", ""),
        c.hands,
        c.kind.value,
        c.device,
        dial.start if dial else None,
        dial.mean if dial else None,
        c.software,
        c.calibration,
        c.agreement_mm,
        c.scoring_version,
        f"series/{code}.csv.gz" if code in with_series else "",
    )


def _metrics(
    attempts: Sequence[StudyAttempt], codes: Mapping[str, str]
) -> Iterator[Sequence[object]]:
    for one in attempts:
        for row in (one.attempt.summary.score or {}).get("rows", ()):
            cells = (row.get(name) for name in ("value", "unit", "sd", "utility", "band", "note"))
            yield codes[one.attempt.id], row["name"], *cells


def _answers(
    entries: Sequence[Mapping[str, Any]], withdrawn: set[str]
) -> Iterator[Sequence[object]]:
    for one in entries:
        if one["kind"] == ANSWERED and one["code"] not in withdrawn:
            head = (one["code"], one["visit"], one["questionnaire"], one["version"])
            for item, value in one["values"].items():
                yield *head, item, value


def _documents(study: ResearchStudy, people: People) -> dict[str, bytes]:
    design = study.design
    hidden = open_hidden(study.sealed, StationKey.of(people.folder))
    allocation = {
        "commitment": study.sealed["commitment"],
        "seed": hidden.seed.hex(),
        "nonce": hidden.nonce.hex(),
        "arms": [arm.name for arm in design.arms],
        "lists": allocation_lists(design, hidden.seed),
    }
    text = yaml.safe_dump(design.document(), sort_keys=False, allow_unicode=True)
    versions = {
        "acus": __version__,
        "scoring": SCORING_VERSION,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "machine": platform.machine(),
    }
    with suppress(ResearchError):
        versions["matplotlib"] = matplotlib_version()
    files = {
        "design.yaml": text.encode(),
        "analysis_plan.txt": (design.analysis_plan.rstrip() + "\n").encode(),
        "allocation.json": _json(allocation),
        "software.json": _json(versions),
        "README.txt": _README.encode(),
    }
    for arm in design.arms:
        exercise = study.exercise(arm.name)
        files[f"exercises/{exercise.id}.yaml"] = _without_folders(exercise_text(exercise)).encode()
    return files


def _without_folders(text: str) -> str:
    """Return a text without the folders of this user, which name the account."""
    return text.replace(str(paths.data()), "DATA").replace(str(Path.home()), "HOME")


def _check_private(files: Mapping[str, bytes], people: People) -> None:
    """Refuse a bundle in whose texts a student's key, name or pseudonym stands.

    Raises:
        ResearchError: naming the file.
    """
    everybody = people.everybody(names=True)
    words = {text for one in everybody for text in (one.pseudonym, one.name) if text}
    sought = [re.escape(one.key) for one in everybody]
    sought += [re.escape(word) for word in words if len(word) >= _SHORTEST]
    if not sought:
        return
    pattern = re.compile(rf"(?<!\w)(?:{'|'.join(sought)})(?!\w)", re.IGNORECASE)
    for name, data in files.items():
        if name.endswith(_PACKED):
            continue  # numbers and phases alone, or what stands in a table of text too
        if pattern.search(data.decode()):
            raise ResearchError(
                sentence(
                    "a student's name or pseudonym stands in {file} of the bundle: take it out of "
                    "the design or of the reasons for leaving; nothing was written",
                    file=name,
                )
            )


def _write(out: Path, files: Mapping[str, bytes]) -> None:
    part = beside(out)
    try:
        step("write", part)
        with part.open("xb") as stream:
            with zipfile.ZipFile(stream, "w") as archive:
                for name, data in sorted(files.items()):
                    info = zipfile.ZipInfo(name, _TIME)
                    info.external_attr = 0o644 << 16
                    packed = name.endswith(_PACKED)
                    info.compress_type = zipfile.ZIP_STORED if packed else zipfile.ZIP_DEFLATED
                    archive.writestr(info, data)
            stream.flush()
            os.fsync(stream.fileno())
        replace(part, out)
    except OSError as error:
        raise ResearchError(
            sentence("cannot write {path}: {reason}", path=out, reason=error.strerror or error)
        ) from error
    finally:
        part.unlink(missing_ok=True)


_README: Final = f"""A research study with Acus, as tables. {DISCLAIMER}

participants.csv, attempts.csv, metrics.csv (one row for each metric of each attempt), answers.csv,
consort.csv: what each column means stands in codebook.csv, what each metric means in
metrics_codebook.csv. Empty cells are not known. Days count from enrolment; there are no dates.

series/CODE.csv.gz is an attempt over time, attempts/CODE.json its plan, tolerances and score:
together they give the score again. parquet/ holds the same tables with their types and all series
in one, figures/ is drawn from the tables (both where their packages were installed).
allocation.json opens the list of allocations: SHA-256 of nonce and list is the commitment that was
registered. manifest.json holds the SHA-256 of every file.
`acus research verify FILE` checks all of it.

R:       attempts <- read.csv("attempts.csv")
pandas:  attempts = pandas.read_csv("attempts.csv")
"""
