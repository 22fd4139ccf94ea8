"""`acus study`: error against time of the ways to compute the same thing."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands import completion
from app.commands.answer import Answer
from app.commands.reader_language import tell
from app.core.messages import joined, sentence

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rich.console import Console

    from app.studies.findings import SurveyResult
    from app.studies.study import Result

PIPE_WIDTH = 160
"""Columns of a table that is not read on a terminal."""


RANK = 220


def register(app: typer.Typer) -> None:
    """Add `acus study`."""
    app.command("study")(study)


def _completed(incomplete: str) -> list[str]:
    """Return the studies that begin so, and `list`."""
    from app.studies.runner import study_names

    return completion.fitting(("list", *study_names()), incomplete)


def study(
    name: Annotated[
        str,
        typer.Argument(help="name of a study, `list` or `all`", autocompletion=_completed),
    ],
    inputs: Annotated[
        list[Path] | None,
        typer.Argument(metavar="[DIR]...", help="folders, for a study that reads some"),
    ] = None,
    out: Annotated[
        Path | None, typer.Option(help="folder for tables (CSV, JSON) and pictures (PNG, SVG)")
    ] = None,
    repeats: Annotated[int, typer.Option(min=1, help="timings per way and setting")] = 9,
    quick: Annotated[
        bool, typer.Option("--quick", help="two timings only, less of a survey")
    ] = False,
    fresh: Annotated[
        bool, typer.Option("--fresh", help="`all`: keep nothing of a run that was broken off")
    ] = False,
    write: Annotated[
        bool, typer.Option("--write", help="keep the table with the program (app/studies/tables)")
    ] = False,
    exercise: Annotated[
        list[str] | None, typer.Option(metavar="NAME", help="`adversary`: exercises; else all")
    ] = None,
    evaluations: Annotated[
        int | None, typer.Option(min=1, help="`adversary`: attempts at each exercise")
    ] = None,
    seed: Annotated[
        int | None, typer.Option(min=0, help="`adversary`: of search and noise")
    ] = None,
    paths: Annotated[
        int | None, typer.Option("--paths", min=1, help="`tissue_field`: random needles")
    ] = None,
    full: Annotated[
        bool, typer.Option("--full", help="`tissue_field`: 10 000 random needles, half an hour")
    ] = False,
) -> Answer:
    """Run a study, or `all`, or `list` them: error against time."""
    options = {"exercise": exercise, "evaluations": evaluations, "seed": seed, "paths": paths}
    options["full"] = full or None
    asked = {key: value for key, value in options.items() if value is not None}
    _refuse_options(name, asked)
    if name == "list":
        return _list()
    if quick:
        from app.studies.batch import QUICK

        repeats = QUICK
    if name == "all":
        return _all(out, repeats, fresh, write, quick)
    from app.commands.output import console as open_console
    from app.studies.findings import Survey
    from app.studies.runner import examine, find_study, run
    from app.studies.study import Result
    from app.studies.table import document, survey_document

    chosen = find_study(name)
    given = tuple(inputs or ())
    result: Result | SurveyResult
    if isinstance(chosen, Survey):
        from app.commands.calibrate_parts import with_progress

        result = with_progress(
            lambda progress: examine(chosen, progress, given, quick, lent, asked)
        )
    else:
        result = run(chosen, repeats, lend=lent)
    if write and isinstance(result, Result):
        from app.studies.kept import keep, place

        tell(sentence("wrote {file}", file=keep(result, repeats, place(name))), err=True)
    data = document(result) if isinstance(result, Result) else survey_document(result)
    if out is not None:
        from app.studies.files import write as write_files

        for path in write_files(result, out, repeats, quick=quick):
            tell(sentence("wrote {file}", file=path), err=True)
    console = open_console()
    if not console.is_terminal:  # a pipe or a file has no edge at which figures must be cut
        console = open_console(width=max(console.width, PIPE_WIDTH))
    passed = result.findings.passed if result.findings is not None else None
    return Answer(data, lambda: _print(result, console), yes=passed)


def _refuse_options(name: str, asked: "Mapping[str, object]") -> None:
    """Refuse what is asked of a study that does not take it, before anything is run."""
    from app.studies.errors import StudyError
    from app.studies.findings import Survey
    from app.studies.runner import find_study

    if not asked:
        return
    chosen = None if name in ("list", "all") else find_study(name)
    takes = chosen.options if isinstance(chosen, Survey) else ()
    for option in asked:
        if option not in takes:
            raise StudyError(
                sentence("study {name} takes no --{option}; leave it out", name=name, option=option)
            )


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


def lent(name: str) -> Any:
    """Return what a study borrows from a room above it, by `module:name`."""
    from importlib import import_module

    module, _, attribute = name.partition(":")
    return getattr(import_module(module), attribute)


def _all(out: Path | None, repeats: int, fresh: bool, write: bool, quick: bool) -> Answer:
    from app.commands.calibrate_parts import with_progress
    from app.core import paths
    from app.studies.batch import Done, StudyOutcome, run_all
    from app.studies.kept import keep, place
    from app.studies.runner import study_names
    from app.studies.study import Result

    where = out or paths.data() / "studies"

    def told(done: Done) -> None:
        typer.echo(f"{done.name}: {done.outcome}{done.text and ': ' + done.text}", err=True)
        if write and isinstance(done.result, Result):
            keep(done.result, repeats, place(done.name))

    found = with_progress(
        lambda progress: run_all(study_names(), where, repeats, fresh, progress, told, lent, quick)
    )
    broken = [done for done in found if done.outcome is StudyOutcome.BROKEN]
    rows = [{"study": d.name, "outcome": d.outcome.value, "text": d.text} for d in found]
    lines: list[str] = [f"{row['study']:24} {row['outcome']:10} {row['text']}" for row in rows]
    lines.append(sentence("tables and pictures are in {folder}", folder=where))
    return Answer({"studies": rows, "folder": str(where)}, lines, crashed=bool(broken))


def _list() -> Answer:
    from app.studies.errors import StudyError
    from app.studies.runner import declaration, study_names

    rows = []
    for name in study_names():
        try:
            title, question = (found := declaration(name)).title, found.question
        except StudyError as error:
            title, question = name, sentence("cannot be used: {error}", error=error)
        rows.append({"name": name, "title": title, "question": question})
    lines = [joined(" ", (f"{row['name']:24}", row["question"])) for row in rows]
    return Answer({"studies": rows}, lines)
