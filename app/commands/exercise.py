"""`acus exercise`: what exercises there are; begin, check, carry one to another computer."""

from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final

import typer

from app.commands import completion
from app.commands.answer import Answer, Commands
from app.commands.doors import instructor
from app.commands.exercise_bands import Name, bands
from app.commands.exercise_mark import mark
from app.commands.reader_language import template
from app.commands.shown import Each
from app.core.messages import joined, sentence, sentence_of

if TYPE_CHECKING:
    from app.compose.skill_scores import SkillOutcome
    from app.core.progress import Progress
    from app.exchange.acusx import PackageManifest, UnpackedExercise

app = Commands(help="Exercises: list, new, validate, bands, mark, pack, trial.")

Uid = Annotated[str | None, typer.Option(help="SeriesInstanceUID, where several fit.")]


app.command()(bands)
app.command()(mark)

RANK = 190


def register(root: typer.Typer) -> None:
    """Add the group."""
    root.add_typer(app, name="exercise")


@app.command("list")
def list_exercises() -> Answer:
    """List all exercises, by level. With versions, files, and those that cannot be used."""
    from app.exercises.library import folders, library, versions

    known = library()
    rows: list[dict[str, Any]] = []
    for one in known:
        path = known.files[one.id]
        rows.append(
            {
                "id": one.id,
                "version": one.version,
                "versions": list(versions(one.id, known)),
                "level": one.level,
                "title": one.title,
                "purpose": one.purpose.value,
                "shipped": path.parent != folders()[1],
                "file": str(path),
            }
        )
    broken = [{"file": str(file.path), "reason": file.reason} for file in known.broken]
    shown = (
        Each(
            "exercises",
            template("{level}  {id}  version {version}  {title:~}{shipped:?|  (your own)}"),
        ),
        Each("broken", template("✖ cannot be used: {reason}")),
    )
    facts = {"exercises": rows, "broken": broken, "folder": str(folders()[1])}
    return Answer(facts, shown=shown)


@app.command()
def new(
    title: Annotated[str, typer.Argument(metavar="TITLE", help="One line for people.")],
    like: Annotated[
        str,
        typer.Option(
            "--from",
            metavar="EXERCISE",
            autocompletion=completion.exercises,
            help="Exercise to begin with.",
        ),
    ] = "first-insertion",
    ct: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder of the CT; needs --plan.")
    ] = None,
    series: Uid = None,
    plan: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Entry and target, .mrk.json.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Where to write; your folder otherwise.")
    ] = None,
) -> Answer:
    """Begin an exercise as a copy of another (instructor). On another CT and plan, if given."""
    from app.core.configuration import parse
    from app.core.errors import ConfigurationError
    from app.exercises.library import folders, load_exercise
    from app.exercises.schema import Exercise
    from app.exercises.writing import exercise_document, free_id, save, taken_ids, write_exercise

    instructor()
    if ct is not None and plan is None:
        raise ConfigurationError(
            sentence("--ct DIR needs --plan FILE: entry and target lie in that CT")
        )
    document = exercise_document(load_exercise(like))
    document |= {"id": free_id(title, taken_ids()), "version": 1, "title": title}
    if plan is not None:
        from app.exchange.markups import read_plan

        points = read_plan(plan)
        document["plan"] = {
            "entry_mm": points.entry_mm.tolist(),
            "target_mm": points.target_mm.tolist(),
            "name": points.name,
        }
    if ct is not None:
        from app.imaging.reading import load_ct

        digest = load_ct(ct, series).digest
        document["ct"] = {"folder": str(ct.resolve()), "series": series, "digest": digest}
        document.pop("structures", None)
        document.pop("target_organ", None)
    exercise = parse(document, Exercise, title)
    if out is None:
        exercise = save(exercise)
        out = folders()[1] / f"{exercise.id}.yaml"
    else:
        write_exercise(out, exercise)
    facts = {"id": exercise.id, "version": exercise.version, "file": str(out)}
    return Answer(facts, shown="{id}: {file}")


@app.command()
def validate(
    exercises: Annotated[
        list[str],
        typer.Argument(
            metavar="EXERCISE…",
            autocompletion=completion.exercises,
            help="Names or files of exercises.",
        ),
    ],
    physics: Annotated[
        bool,
        typer.Option(
            "--physics", help="Also that nothing that the patient calls for is absent: reads CTs."
        ),
    ] = False,
) -> Answer:
    """Check exercises to the last effect. Every mistake with its field and line; code 3 if any."""
    from app.compose.explaining import quick_explanation
    from app.compose.physics import calls_of
    from app.core.errors import AcusError
    from app.exercises.library import load_exercise

    rows: list[dict[str, Any]] = []
    for name in exercises:
        row: dict[str, Any] = {"exercise": name, "id": "", "version": None, "problems": []}
        rows.append(row)
        try:
            found = load_exercise(name)
        except AcusError as error:
            row["problems"] = [sentence_of(error)]
            continue
        wrong = quick_explanation(found)[1]
        row |= {"id": found.id, "version": found.version}
        row["problems"] = [
            joined("", (f"{name}: {field}: ", why, _line(name, field))) for field, why in wrong
        ]
        if physics and not wrong:
            try:
                calls, _ = calls_of(found)
            except AcusError as error:
                row["problems"] = [joined(": ", (name, sentence_of(error)))]
            else:
                row["problems"] = [
                    joined(": ", (name, call.words)) for call in calls if call.is_absent
                ]
    problems = Each("problems", "✖ {}", none=template("✔ {exercise}: {id}, version {version}"))
    fine = not any(row["problems"] for row in rows)
    return Answer({"exercises": rows}, yes=fine, shown=Each("exercises", problems))


@app.command()
def suggest(exercise: Name) -> Answer:
    """Print what an exercise lacks. Lines to add: what its CT, path and reach call for."""
    from app.compose.physics import calls_of, suggested_lines
    from app.exercises.called_for import additions
    from app.exercises.library import load_exercise

    chosen = load_exercise(exercise)
    calls, _ = calls_of(chosen)
    more = additions(calls, chosen)
    rows = [
        {
            "effect": call.effect,
            "reason": call.reason,
            "simulated": call.is_present,
            "without": call.without,
            "absent": call.is_absent,
        }
        for call in calls
    ]
    facts = {"id": chosen.id, "version": chosen.version, "called_for": rows, "add": more}
    absent = [joined("", (f"# {call.effect}: ", call.reason)) for call in calls if call.is_absent]
    nothing = [
        sentence(
            "# nothing is absent without a reason in {id}, version {version}",
            id=chosen.id,
            version=chosen.version,
        )
    ]
    return Answer(facts, [*absent, *suggested_lines(more)] or nothing)


@app.command()
def schema(
    out: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Where to write; printed otherwise.")
    ] = None,
) -> Answer:
    """Print the JSON Schema of an exercise file. Editors complete and check by it."""
    from app.exercises.writing import schema_document, schema_text

    if out is None:
        return Answer({"schema": schema_document(), "files": []}, [schema_text().rstrip()])
    from app.core.files import write_atomically

    write_atomically(out, schema_text())
    return Answer({"schema": schema_document(), "files": [str(out)]}, shown="{files}")


@app.command()
def pack(
    exercise: Name,
    out: Annotated[
        Path | None, typer.Option(metavar="FILE", help="File to write; NAME.acusx otherwise.")
    ] = None,
    with_ct: Annotated[
        bool, typer.Option("--with-ct", help="Put the CT in too, de-identified.")
    ] = False,
) -> Answer:
    """Make one file of an exercise (instructor). Plan, structures, CT's digest or the CT."""
    from app.commands.calibrate_parts import with_progress
    from app.compose.exercise_ct import read_ct
    from app.exchange.acusx import SUFFIX
    from app.exchange.acusx import pack as write
    from app.exercises.library import load_exercise

    instructor()
    chosen = load_exercise(exercise)
    target = out or Path(f"{chosen.id}{SUFFIX}")

    def work(progress: "Progress") -> "PackageManifest":
        volume = read_ct(chosen, progress.part(0.0, 0.3))
        return write(target, chosen, volume, with_ct, progress.part(0.3, 1.0))

    manifest = with_progress(work)
    facts = {"file": str(target), "manifest": manifest.model_dump(mode="json")}
    there = template("  CT {manifest.ct.digest:.12}… is in the file")
    absent = template("  CT {manifest.ct.digest:.12}… is not in the file")
    shown = (
        template("{file}: {manifest.id}, version {manifest.exercise_version}"),
        there if with_ct else absent,
    )
    return Answer(facts, shown=shown)


@app.command()
def unpack(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="An exercise's file, .acusx.")],
    ct: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder of its CT, if not in the file.")
    ] = None,
    series: Uid = None,
    name: Annotated[
        str, typer.Option("--as", metavar="NAME", help="Keep it under another name.")
    ] = "",
    replace: Annotated[
        bool, typer.Option("--replace", help="As a new version of the one of its name.")
    ] = False,
) -> Answer:
    """Take an exercise in from its file (instructor). Its CT must be the same, by its digest."""
    from app.commands.calibrate_parts import with_progress
    from app.exchange.acusx import unpack as read

    instructor()

    def work(progress: "Progress") -> "UnpackedExercise":
        return read(file, ct, series, name, replace, progress)

    found = with_progress(work)
    facts = {
        "id": found.exercise.id,
        "version": found.exercise.version,
        "known": found.known,
        "ct": None if found.ct is None else str(found.ct),
        "structures": [str(path) for path in found.structures],
    }
    return Answer(
        facts, shown=template("{id}, version {version} {known:?was there already|taken in}")
    )


WINDOW: Final = "window"
"""Script of those who sit at the window, beside those of skills."""


@app.command()
def trial(
    exercise: Name,
    seeds: Annotated[int, typer.Option(min=1, help="Attempts of each skill.")] = 20,
    script: Annotated[
        str,
        typer.Option(
            help="hand: as slow, uneven and far off as people are; quick: as in a demonstration; "
            "window: who drags and wheels in, and who plans and checks, at the window.",
        ),
    ] = "hand",
) -> Answer:
    """Try an exercise: what scripts of five skills score (instructor).

    Nothing is recorded. `--script window` tries two hands at the window instead.
    """
    from app.commands.calibrate_parts import with_progress
    from app.compose.skill_scores import ordered_seeds, ordered_share, risks_of, skill_outcomes
    from app.core.errors import AcusError
    from app.exercises.library import load_exercise
    from app.simulation.hands import Script

    instructor()
    if script not in (*Script, WINDOW):
        raise AcusError(
            sentence(
                "there is no script {script!r}; there are {scripts}",
                script=script,
                scripts=", ".join((*Script, WINDOW)),
            )
        )
    chosen = load_exercise(exercise)

    def work(progress: "Progress") -> "tuple[SkillOutcome, ...]":
        risks, rest = risks_of(chosen, progress.part(0.0, 0.2)), progress.part(0.2, 1.0)
        if script == WINDOW:
            from app.compose.pointer_trial import pointer_outcomes

            return pointer_outcomes(chosen, seeds, risks, rest)
        return skill_outcomes(chosen, seeds, risks=risks, progress=rest, script=Script(script))

    outcomes = with_progress(work)
    rows: list[dict[str, Any]] = []
    for one in outcomes:
        low, middle, high = one.quartiles or (None, None, None)
        rows.append(
            {
                "skill": one.skill,
                "median": middle,
                "lower_quartile": low,
                "upper_quartile": high,
                "share_passed": one.share_passed,
                "without_score": one.void,
                "duration_s": one.duration,
                "scores": [total if isfinite(total) else None for total in one.totals],
            }
        )
    facts = {"id": chosen.id, "version": chosen.version, "seeds": seeds, "skills": rows}
    facts["script"] = script
    facts |= {"ordered_seeds": ordered_seeds(outcomes), "ordered_share": ordered_share(outcomes)}
    row = template(
        "{skill:<12} {median:?{median:6.1f}  {lower_quartile:5.1f}{upper_quartile:6.1f}|"
        "     –            –}  {share_passed:4.0%}  {duration_s:3.0f} s"
        "{without_score:#  # without a score|  # without a score|}"
    )
    shown = (
        template("skill        median    quartiles  passed   time"),
        Each("skills", row),
        template("all skills in their order: {ordered_seeds:.0%} of the seeds"),
        template("neighbouring skills ordered right, any seed with any: {ordered_share:.0%}"),
        template("scripts, not people: what they score sets no pass mark"),
    )
    return Answer(facts, shown=shown)


def _line(name: str, field: str) -> str:
    """Say where a field stands in a file; nothing for an exercise that was named otherwise."""
    from app.core.configuration import line_of, read_text
    from app.exercises.library import library

    path = Path(name) if Path(name).is_file() else library().files.get(name)
    line = None if path is None else line_of(read_text(path), (field,))
    return sentence(" (line {line})", line=line) if line else ""
