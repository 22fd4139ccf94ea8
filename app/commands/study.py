"""`acus study`: error against time of the ways to compute the same thing."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands import completion
from app.commands.answer import Answer

if TYPE_CHECKING:
    from rich.console import Console

    from app.studies.findings import SurveyResult
    from app.studies.study import Result

PIPE_WIDTH = 160
"""Columns of a table that is not read on a terminal."""


def register(app: typer.Typer) -> None:
    """Add `acus study`."""
    app.command("study")(study)


def study(
    name: Annotated[
        str, typer.Argument(help="name of a study, or `list`", autocompletion=completion.studies)
    ],
    inputs: Annotated[
        list[Path] | None,
        typer.Argument(metavar="[DIR]...", help="folders, for a study that reads some"),
    ] = None,
    out: Annotated[
        Path | None, typer.Option(help="folder for table (CSV, JSON) and picture")
    ] = None,
    repeats: Annotated[int, typer.Option(min=1, help="timings per way and setting")] = 9,
) -> Answer:
    """Run a study, or `list` them: error against time."""
    if name == "list":
        return _list()
    from rich.console import Console

    from app.studies.errors import StudyError
    from app.studies.findings import Survey
    from app.studies.runner import examine, find_study, run
    from app.studies.study import Result
    from app.studies.table import document, survey_document

    chosen = find_study(name)
    given = tuple(inputs or ())
    result: Result | SurveyResult
    if isinstance(chosen, Survey):
        result = examine(chosen, inputs=given)
    elif given:
        raise StudyError(f"study {name} takes no folders; leave {given[0]} out")
    else:
        result = run(chosen, repeats)
    data = document(result) if isinstance(result, Result) else survey_document(result)
    if out is not None:
        for path in _write(name, result, data, out):
            typer.echo(f"wrote {path}", err=True)
    console = Console()
    if not console.is_terminal:  # a pipe or a file has no edge at which figures must be cut
        console = Console(width=max(console.width, PIPE_WIDTH))
    return Answer(data, lambda: _print(result, console))


def _print(result: "Result | SurveyResult", console: "Console") -> None:
    from app.studies.study import Result
    from app.studies.table import sheet_table, summary_table

    if isinstance(result, Result):
        console.print(summary_table(result))
    if result.findings is not None:
        for sheet in result.findings.sheets:
            console.print(sheet_table(sheet))
        for line in result.findings.lines:
            console.print(line)


def _list() -> Answer:
    from app.studies.errors import StudyError
    from app.studies.runner import declaration, study_names

    rows = []
    for name in study_names():
        try:
            title, question = (found := declaration(name)).title, found.question
        except StudyError as error:
            title, question = name, f"cannot be used: {error}"
        rows.append({"name": name, "title": title, "question": question})
    lines = [f"{row['name']:24} {row['question']}" for row in rows]
    return Answer({"studies": rows}, lines, first_form=rows)


def _write(
    name: str, result: "Result | SurveyResult", data: dict[str, Any], out: Path
) -> list[Path]:
    from json import dumps

    from app.core.files import write_atomically
    from app.studies.plot import draw, draw_figure
    from app.studies.study import Result
    from app.studies.table import csv_text, sheet_csv

    tables = {name: csv_text(result)} if isinstance(result, Result) else {}
    figures = result.findings.figures if result.findings is not None else ()
    for sheet in result.findings.sheets if result.findings is not None else ():
        tables[f"{name}-{sheet.name}"] = sheet_csv(sheet)
    written = [out / f"{stem}.csv" for stem in tables]
    for path, text in zip(written, tables.values(), strict=True):
        write_atomically(path, text)
    write_atomically(out / f"{name}.json", dumps(data, indent=2))
    written.append(out / f"{name}.json")
    if isinstance(result, Result):
        written.append(draw(result, out / f"{name}.png"))
    return written + [draw_figure(f, out / f"{name}-{f.name}.png") for f in figures]
