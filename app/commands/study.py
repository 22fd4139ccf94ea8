"""`acus study`: error against time of the ways to compute the same thing."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from app.studies.study import Result


def register(app: typer.Typer) -> None:
    """Add `acus study`."""
    app.command("study")(study)


def study(
    name: Annotated[str, typer.Argument(help="name of a study, or `list`")],
    out: Annotated[
        Path | None, typer.Option(help="folder for table (CSV, JSON) and picture")
    ] = None,
    json: Annotated[bool, typer.Option("--json", help="print JSON instead of a table")] = False,
    repeats: Annotated[int, typer.Option(min=1, help="timings per way and setting")] = 9,
) -> None:
    """Run a study and print error against time; `acus study list` names them."""
    if name == "list":
        _list(json)
        return
    from json import dumps

    from rich.console import Console

    from app.studies.runner import run
    from app.studies.table import document, summary_table

    result = run(name, repeats)
    if json:
        typer.echo(dumps(document(result), indent=2))
    else:
        Console().print(summary_table(result))
    if out is not None:
        for path in _write(result, out):
            typer.echo(f"wrote {path}", err=True)


def _list(json: bool) -> None:
    from json import dumps

    from app.studies.runner import find_study, study_names

    found = [find_study(name) for name in study_names()]
    if json:
        rows = [{"name": s.name, "title": s.title, "question": s.question} for s in found]
        typer.echo(dumps(rows, indent=2))
        return
    for item in found:
        typer.echo(f"{item.name:24} {item.question}")


def _write(result: "Result", out: Path) -> list[Path]:
    from json import dumps

    from app.core.files import write_atomically
    from app.studies.plot import draw
    from app.studies.table import csv_text, document

    name = result.study.name
    table, data = out / f"{name}.csv", out / f"{name}.json"
    write_atomically(table, csv_text(result))
    write_atomically(data, dumps(document(result), indent=2))
    return [table, data, draw(result, out / f"{name}.png")]
