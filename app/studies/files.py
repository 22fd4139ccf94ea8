"""What a study found, as files: JSON, CSV and pictures."""

import json
from pathlib import Path
from typing import Any, Final

from app.core.files import write_atomically
from app.studies.findings import SurveyResult
from app.studies.kept import kept_document, measured
from app.studies.plot import draw, draw_figure
from app.studies.study import Result
from app.studies.table import csv_text, sheet_csv, survey_document

PICTURES: Final = ("png", "svg")
"""Forms of every picture."""


def write(
    result: Result | SurveyResult,
    folder: Path,
    repeats: int,
    pictures: bool = True,
    quick: bool = False,
) -> list[Path]:
    """Write tables and pictures of a result, its JSON last; return the paths.

    Args:
        result: of a study.
        folder: made if it is not there.
        repeats: timings per way and setting.
        pictures: whether to draw.
        quick: whether a survey was asked to do less; its JSON says so if it did.

    Raises:
        StudyError: if a picture cannot be written, or matplotlib is not installed.
        OSError: if a table cannot.
    """
    findings = result.findings
    name = result.study.name if isinstance(result, Result) else result.survey.name
    tables = {name: csv_text(result)} if isinstance(result, Result) else {}
    for sheet in findings.sheets if findings is not None else ():
        tables[f"{name}-{sheet.name}"] = sheet_csv(sheet)
    written = []
    for stem, text in tables.items():
        written.append(folder / f"{stem}.csv")
        write_atomically(written[-1], text)
    for kind in PICTURES if pictures else ():
        if isinstance(result, Result):
            written.append(draw(result, folder / f"{name}.{kind}"))
        for figure in findings.figures if findings is not None else ():
            written.append(draw_figure(figure, folder / f"{name}-{figure.name}.{kind}"))
    data: dict[str, Any] = (
        kept_document(result, repeats)
        if isinstance(result, Result)
        else survey_document(result)
        | {"measured": measured(1) | {"quick": quick and result.survey.quick is not None}}
    )
    written.append(folder / f"{name}.json")
    write_atomically(written[-1], json.dumps(data, indent=2, ensure_ascii=False) + "\n")
    return written
