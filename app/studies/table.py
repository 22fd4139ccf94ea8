"""A study's result as a table for people, and as CSV and JSON for programs."""

import csv
import io
from typing import Any

from rich.markup import escape
from rich.table import Table

from app.studies.findings import Findings, Sheet, SurveyResult
from app.studies.rule import departure, sweet_spot
from app.studies.study import Point, Result, duration

_COLUMNS = (
    "way",
    "family",
    "setting",
    "error",
    "seconds",
    "within_perception",
    "within_deadline",
    "noticed",
    "failure",
)


def summary_table(result: Result) -> Table:
    """Return each way at its worst over all settings."""
    study = result.study
    table = Table(
        title=escape(study.title), caption=escape(_caption(result)), caption_justify="left"
    )
    for heading in ("way", study.error_label, "time", "felt or seen?", "in time?", "worst in"):
        table.add_column(
            escape(heading), justify="left" if heading in ("way", "worst in") else "right"
        )
    for point in result.summary():
        table.add_row(*_row(point))
    return table


def _row(point: Point) -> tuple[str, ...]:
    return (
        point.way,
        f"{point.error:.3g}",
        duration(point.seconds),
        "no" if point.within_perception else "yes",
        "yes" if point.within_deadline else "no",
        point.setting,
    )


def _caption(result: Result) -> str:
    study = result.study
    lines = [
        f"Reference: {study.reference}",
        f"Deadline: {study.deadline.label}. Noticed from: {study.perception.label}.",
        default_line(result),
    ]
    lines += [f"Failed: {line}" for line in failure_lines(result)]
    return "\n".join(lines)


def default_line(result: Result) -> str:
    """Return which way the program uses and why; and why it is not the sweet spot, if so."""
    study, apart = result.study, departure(result)
    text = f"Default: {study.default}" + (f", {study.because}" if study.because else "")
    return text + (f". Exception: {apart}" if apart else "")


def failure_lines(result: Result) -> list[str]:
    """Return one line per failing way: no answer, too coarse, too slow."""
    lines = [f"{f.way} in {f.setting}: {f.reason}" for f in result.failures]
    if result.too_coarse():
        lines.append(f"error noticed: {', '.join(result.too_coarse())}")
    if result.too_slow():
        lines.append(f"deadline missed: {', '.join(result.too_slow())}")
    return lines


def document(result: Result) -> dict[str, Any]:
    """Return the result for JSON; the keys stand in docs/json.md."""
    study = result.study
    return {
        "study": study.name,
        "title": study.title,
        "question": study.question,
        "reference": study.reference,
        "error_label": study.error_label,
        "default": study.default,
        "because": study.because,
        "sweet_spot": sweet_spot(result),
        "exception": departure(result),
        "deadline_s": study.deadline.value,
        "deadline_label": study.deadline.label,
        "perception": study.perception.value,
        "perception_label": study.perception.label,
        "ways": [
            {"way": way.name, "family": way.family, "description": way.description}
            for way in study.ways
        ],
        "points": [
            {name: getattr(point, name) for name in _COLUMNS[:-1]} for point in result.points
        ],
        "failures": [
            {"way": f.way, "setting": f.setting, "reason": f.reason} for f in result.failures
        ],
        "too_coarse": list(result.too_coarse()),
        "too_slow": list(result.too_slow()),
        **(findings_document(result.findings) if result.findings is not None else {}),
    }


def survey_document(result: SurveyResult) -> dict[str, Any]:
    """Return a survey's result for JSON; the keys stand in docs/json.md."""
    survey = result.survey
    return {
        "study": survey.name,
        "title": survey.title,
        "reference": survey.reference,
        **findings_document(result.findings),
    }


def findings_document(findings: Findings) -> dict[str, Any]:
    """Return the further tables for JSON: by name, as a list of rows by heading."""
    return {
        "tables": {
            sheet.name: [dict(zip(sheet.columns, row, strict=True)) for row in sheet.rows]
            for sheet in findings.sheets
        },
        "lines": list(findings.lines),
    }


def sheet_table(sheet: Sheet) -> Table:
    """Return a sheet for people, numbers to three digits."""
    table = Table(title=escape(sheet.title))
    for column in sheet.columns:
        table.add_column(escape(column))
    for row in sheet.rows:
        table.add_row(*(f"{cell:.4g}" if isinstance(cell, float) else str(cell) for cell in row))
    return table


def sheet_csv(sheet: Sheet) -> str:
    """Return a sheet as CSV with a heading."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(sheet.columns)
    writer.writerows(sheet.rows)
    return stream.getvalue()


def csv_text(result: Result) -> str:
    """Return all points, and the failures with their reason, as CSV with a heading."""
    stream = io.StringIO()
    writer = csv.DictWriter(stream, _COLUMNS, lineterminator="\n")
    writer.writeheader()
    for entry in document(result)["points"]:
        writer.writerow({**entry, "failure": ""})
    for failure in result.failures:
        writer.writerow({"way": failure.way, "setting": failure.setting, "failure": failure.reason})
    return stream.getvalue()
