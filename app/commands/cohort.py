"""`acus cohort`: many attempts on many processors, into one table."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands import completion
from app.commands.answer import Answer, Commands
from app.commands.doors import instructor
from app.commands.reader_language import template
from app.commands.record_options import RecordsFolder
from app.core.errors import ConfigurationError
from app.core.messages import sentence

if TYPE_CHECKING:
    from app.cohort import RunOutcome, SweepGrid

RANK = 215

Out = Annotated[Path, typer.Option("--out", metavar="FILE", help="Table to write, .parquet.")]
Scheduler = Annotated[
    str,
    typer.Option(
        "--scheduler",
        metavar="ADDRESS",
        help="Dask scheduler: tls://HOST:8786; tcp:// on this computer alone.",
    ),
]
Local = Annotated[
    int | None,
    typer.Option(
        "--local", metavar="N", min=1, help="Processes of this computer; 1 needs no Dask."
    ),
]
Price = Annotated[
    float | None,
    typer.Option("--price", min=0.0, help="Of an hour of one processor: says the money."),
]
Attempts = Annotated[
    float, typer.Option("--attempts", min=1.0, help="What so many attempts would cost.")
]


def register(root: typer.Typer) -> None:
    """Add the group."""
    group = Commands(help="Many attempts on many processors: rescore, sweep.")
    group.command("rescore")(rescore)
    group.command("sweep")(sweep)
    root.add_typer(group, name="cohort")


def rescore(
    out: Out,
    exercise: Annotated[
        str,
        typer.Option(
            "--exercise",
            metavar="EXERCISE",
            autocompletion=completion.exercises,
            help="Attempts of this one, by its bands; a name or a file.",
        ),
    ] = "",
    folder: RecordsFolder = None,
    scheduler: Scheduler = "",
    local: Local = None,
    attempts: Attempts = 1e6,
    price: Price = None,
) -> Answer:
    """Score stored attempts anew (instructor).

    By the bands and rules that their exercises have now; nothing stored is changed. What is done
    is kept beside FILE: the same command goes on there.
    """
    from app.cohort import crew_of
    from app.cohort import rescore as work
    from app.commands.calibrate_parts import with_progress
    from app.exercises.library import load_exercise
    from app.session.store import records_folder

    instructor()
    crew = crew_of(scheduler, _processes(scheduler, local))
    chosen = load_exercise(exercise) if exercise else None
    place = records_folder(folder)
    return _answer(
        with_progress(lambda progress: work(place, out, crew, chosen, progress)), attempts, price
    )


def sweep(
    out: Out,
    exercise: Annotated[
        str,
        typer.Argument(
            metavar="[EXERCISE]",
            autocompletion=completion.exercises,
            help="Name, name@version, or file; or give --grid.",
        ),
    ] = "",
    grid: Annotated[
        Path | None,
        typer.Option("--grid", metavar="FILE", help="YAML that says all (docs/cohort.md)."),
    ] = None,
    skills: Annotated[
        list[str] | None, typer.Option("--skill", help="Again for each; else all five.")
    ] = None,
    seeds: Annotated[int | None, typer.Option(min=1, help="Attempts of each; else 20.")] = None,
    devices: Annotated[
        list[str] | None, typer.Option("--device", help="Machine; again for each.")
    ] = None,
    registration: Annotated[
        list[float] | None,
        typer.Option("--registration", metavar="MM", help="Error; again for each."),
    ] = None,
    noise: Annotated[
        list[float] | None,
        typer.Option("--noise", metavar="FACTOR", help="Of the cameras; again for each."),
    ] = None,
    breathing: Annotated[
        list[float] | None,
        typer.Option("--breathing", metavar="MM", help="Amplitude; again for each."),
    ] = None,
    tissue: Annotated[
        list[str] | None, typer.Option("--tissue", help="field or layers; again for each.")
    ] = None,
    effects: Annotated[
        list[str] | None,
        typer.Option("--effect", metavar="NAME.PARAMETER=VALUE,…", help="Again for each."),
    ] = None,
    scheduler: Scheduler = "",
    local: Local = None,
    attempts: Attempts = 1e6,
    price: Price = None,
) -> Answer:
    """Try an exercise over a grid of conditions (instructor).

    Scripts do it in virtual time, and nothing is recorded. What is done is kept beside FILE: the
    same command goes on there.
    """
    from app.cohort import SweepGrid, crew_of
    from app.cohort import sweep as work
    from app.commands.calibrate_parts import with_progress

    instructor()
    crew = crew_of(scheduler, _processes(scheduler, local))
    given = {
        "skills": tuple(skills or ()),
        "seeds": seeds,
        "devices": tuple(devices or ()),
        "registration_error_mm": tuple(registration or ()),
        "tracking_noise": tuple(noise or ()),
        "breathing_mm": tuple(breathing or ()),
        "tissue": tuple(tissue or ()),
        "effects": _axes(effects or []),
    }
    chosen = _grid(SweepGrid, exercise, grid, given)
    return _answer(
        with_progress(lambda progress: work(chosen, out, crew, progress)), attempts, price
    )


def _processes(scheduler: str, local: int | None) -> int:
    if scheduler and local is not None:
        raise ConfigurationError(
            sentence("--scheduler has its own workers, --local those of here: give one of them")
        )
    return local or 1


def _grid(
    kind: "type[SweepGrid]", exercise: str, file: Path | None, given: dict[str, Any]
) -> "SweepGrid":
    named = [name for name, values in given.items() if values]
    if file is not None and (exercise or named):
        raise ConfigurationError(
            sentence("--grid says all: leave the exercise and the other options of the grid out")
        )
    if file is not None:
        return kind.read(file)
    if not exercise:
        raise ConfigurationError(sentence("name an exercise, or give --grid FILE"))
    return kind.given(exercise=exercise, **given)


def _axes(effects: list[str]) -> dict[str, tuple[float, ...]]:
    axes = {}
    for text in effects:
        name, _, values = text.partition("=")
        try:
            axes[name] = tuple(float(value) for value in values.split(","))
        except ValueError as error:
            raise ConfigurationError(
                sentence(
                    "--effect {option}: write NAME.PARAMETER=VALUE,VALUE, as "
                    "puncture.force_scale=1,1.5",
                    option=text,
                )
            ) from error
    return axes


def _answer(done: "RunOutcome", attempts: float, price: float | None) -> Answer:
    cost = done.cost.document(attempts, max(done.workers, 1), price)
    facts = {
        "out": str(done.out),
        "rows": done.rows,
        "parts": done.parts,
        "done_before": done.done_before,
        "workers": done.workers,
        "seconds": done.seconds,
        "cost": cost,
    }
    shown = (
        template("{rows:#1 attempt|# attempts} in {out}"),
        template("{parts:#1 part|# parts}, of which {done_before} were there; {seconds:.0f} s"),
        template("an attempt costs {cost.attempt_s:.3g} s of a processor"),
        template(
            "{cost.attempts:.3g} attempts would cost {cost.core_hours:.3g} hours of a processor"
        ),
        template("{cost.price:?at {cost.price:g} an hour: {cost.money:.3g}|}"),
    )
    return Answer(facts, shown=shown)
