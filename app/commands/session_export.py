"""`acus session export`: scores and attempts as CSV, bag and DICOM objects."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from app.commands.answer import Answer
from app.commands.doors import instructor
from app.commands.reader_language import template
from app.commands.record_options import RecordsFolder
from app.commands.shown import Each
from app.core.messages import sentence
from app.core.progress import Progress

if TYPE_CHECKING:
    from app.exercises.schema import Exercise
    from app.imaging.volume import Volume


def export(
    out: Annotated[
        Path | None, typer.Option("--out", help="CSV file, or folder of a bag, to write.")
    ] = None,
    ids: Annotated[
        list[str] | None,
        typer.Argument(metavar="[ID]...", help="Session ids; none means all."),
    ] = None,
    folder: RecordsFolder = None,
    trajectory: Annotated[
        bool, typer.Option("--trajectory", help="One attempt over time instead of the scores.")
    ] = False,
    ros2: Annotated[
        bool, typer.Option("--ros2", help="One attempt as a bag of ROS 2 (docs/sessions.md).")
    ] = False,
    dicom: Annotated[
        Path | None,
        typer.Option("--dicom", help="Folder for one attempt as SEG, RTSTRUCT, GSPS and SR."),
    ] = None,
    ct: Annotated[
        Path | None, typer.Option("--ct", help="With --dicom: the CT's folder, if it moved.")
    ] = None,
) -> Answer:
    """Export scores or one attempt: CSV, bag, DICOM (instructor)."""
    from app.exchange.csv_export import write_csv
    from app.session.store import records_folder

    if dicom is None and ct is not None:
        raise typer.BadParameter(sentence("--ct goes with --dicom FOLDER"))
    instructor()
    place = records_folder(folder)
    if dicom is not None and out is None and not ros2:
        if trajectory:
            raise typer.BadParameter(sentence("--dicom and --trajectory exclude each other"))
        return _objects(_record(place, ids, "dicom"), dicom, ct)
    if out is None or dicom is not None:
        raise typer.BadParameter(
            sentence("give --out FILE for CSV or a bag, or --dicom FOLDER for DICOM")
        )
    if ros2:
        from app.exchange.ros2_bag import write_bag
        from app.session.recording import read_recording

        messages = write_bag(read_recording(_record(place, ids, "ros2")), out)
        return Answer(
            {"files": [out], "rows": messages},
            shown=template("{rows:#1 message|# messages} written to {files}"),
        )
    text, rows = _trajectory(place, ids) if trajectory else _scores(place, ids)
    if out.suffix.lower() != ".csv":
        raise typer.BadParameter(sentence("--out {out}: only .csv can be written", out=out))
    write_csv(out, text)
    return Answer(
        {"files": [out], "rows": rows}, shown=template("{rows:#1 row|# rows} written to {files}")
    )


def _record(folder: Path, ids: list[str] | None, option: str) -> Path:
    """Return the record of the one attempt that an option takes."""
    from app.session.store import find

    if ids is None or len(ids) != 1:
        raise typer.BadParameter(sentence("--{option} takes exactly one session id", option=option))
    return find(folder, ids[0])


def _scores(folder: Path, ids: list[str] | None) -> tuple[str, int]:
    from app.exchange.csv_export import score_table
    from app.session.store import computed

    summaries = computed(folder, list(dict.fromkeys(ids or [])))
    return score_table(summaries), len(summaries)


def _trajectory(folder: Path, ids: list[str] | None) -> tuple[str, int]:
    from app.exchange.csv_export import trajectory_table
    from app.session.recording import read_recording

    recording = read_recording(_record(folder, ids, "trajectory"))
    return trajectory_table(recording), len(recording.samples.time)


def _objects(record: Path, folder: Path, ct: Path | None) -> Answer:
    """Write an attempt as DICOM objects; `ct`: folder of its CT, that of the exercise without."""
    from app.commands.calibrate_parts import with_progress
    from app.exchange.attempt_dicom import attempt_facts, ct_of, exercise_of, structures_of
    from app.imaging.results import write_results
    from app.session.recording import read_recording
    from app.session.summary import derive

    recording = read_recording(record)
    told, exercise = attempt_facts(recording, derive(recording)), exercise_of(recording)

    def write(progress: Progress) -> tuple[tuple[Path, ...], "Volume", int]:
        volume = ct_of(recording, _ct(ct, exercise, progress.part(0.0, 0.5)))
        structures = structures_of(exercise, volume, progress.part(0.5, 0.7))
        return (
            write_results(folder, told, volume, structures, progress.part(0.7, 1.0)),
            volume,
            len(structures),
        )

    files, volume, structures = with_progress(write)
    notes = []
    if not structures:
        notes.append(sentence("no structures: no SEG, and the structure set has the points alone"))
    if told.tip_mm is None:
        notes.append(sentence("nothing measured where the tip ended: it is in no object"))
    made = exercise is not None and exercise.ct.folder is None and ct is None
    if made:
        notes.append(
            sentence("the built-in patient's CT is in {folder}", folder=_folder_of(volume))
        )
    facts = {
        "files": list(files),
        "structures": structures,
        "ct": str(_folder_of(volume)),
        "notes": notes,
    }
    shown = (
        template("{files}: {structures:#1 structure|# structures}"),
        Each("notes", template("note  {}")),
    )
    return Answer(facts, shown=shown)


def _ct(folder: Path | None, exercise: "Exercise | None", progress: Progress) -> "Volume":
    from app.compose.exercise_ct import read_ct
    from app.exchange.errors import ExportError
    from app.imaging.reading import load_ct

    if folder is not None:
        return load_ct(folder, progress=progress)
    if exercise is None:
        raise ExportError(
            sentence(
                "this station has the exercise of the attempt no more: give the folder of its CT "
                "by --ct"
            )
        )
    return read_ct(exercise, progress)


def _folder_of(volume: "Volume") -> Path:
    return volume.series.files[0].parent
