"""`acus calibrate list|show|use|undo|redo|reject|export|import|print`: what was kept, boards."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands.answer import Answer
from app.commands.calibrate_parts import app, lens_named
from app.commands.reader_language import template
from app.commands.shown import Each
from app.core.errors import ConfigurationError
from app.core.messages import sentence

if TYPE_CHECKING:
    from app.tracking.calibration.history import CalibrationHistory, KeptCalibration
    from app.tracking.optics.calibration import StereoCalibration

BoardOption = Annotated[
    str, typer.Option("--board", metavar="SPEC", help="Board to print; see `calibrate views`.")
]
Id = Annotated[str, typer.Argument(metavar="ID", help="Id of the calibration, or its beginning.")]


@app.command("list")
def list_() -> Answer:
    """List all calibrations. Newest first, and which one is in use."""
    history = _history()
    documents = [entry_document(history, entry) for entry in reversed(history.entries())]
    row = template(
        "{in_use:?*| } {id:28} {problem:?{problem}|"
        "{cameras.0.image_size.0}x{cameras.0.image_size.1}, "
        "{cameras.1.image_size.0}x{cameras.1.image_size.1}  {rms_px:.2f} px  "
        "{validation_rms_mm:?{validation_rms_mm:.3f} mm held back|not checked on views held back}"
        "  {world:?world|no world}{found_bad:?  FOUND BAD: {found_bad}}}"
    )
    facts = {"folder": str(history.folder), "calibrations": documents}
    return Answer(
        facts, shown=Each("calibrations", row, none=template("no calibrations in {folder}"))
    )


@app.command("show")
def show(calibration_id: Id) -> Answer:
    """Show one calibration. Cameras, residuals, validation, notes."""
    history = _history()
    entry = history.find(calibration_id)
    calibration = history.load(entry.id)
    content = calibration.model_dump(mode="json")
    lines = calibration_lines(calibration)
    if entry.rejected is not None:
        lines.append(
            sentence(
                "found bad     {day}: {reason}",
                day=entry.rejected.date.date(),
                reason=entry.rejected.reason,
            )
        )
    in_use = sentence("  (in use)") if entry.active else ""
    lines.append(sentence("file          {path}{in_use}", path=entry.path, in_use=in_use))
    return Answer(entry_document(history, entry) | {"calibration": content}, lines)


@app.command("use")
def use(calibration_id: Id) -> Answer:
    """Use a kept calibration from now on."""
    history = _history()
    history.use(calibration_id)
    return _in_use(history)


@app.command("undo")
def undo() -> Answer:
    """Go back to the calibration used before. Nothing is deleted."""
    history = _history()
    history.undo()
    return _in_use(history)


@app.command("redo")
def redo() -> Answer:
    """Take back an undo."""
    history = _history()
    history.redo()
    return _in_use(history)


@app.command("reject")
def reject(
    calibration_id: Id,
    why: Annotated[str, typer.Option("--why", help="What is wrong with it; attempts say it.")],
) -> Answer:
    """Mark a calibration as bad. It is not used, its attempts are flagged."""
    history = _history()
    history.reject(calibration_id, why)
    return _in_use(history)


@app.command("export")
def export(
    calibration_id: Id,
    out: Annotated[Path, typer.Option("--out", help="File (yaml) or folder (ros) to write.")],
    kind: Annotated[
        str, typer.Option("--format", help="yaml (one file, everything) or ros (camera_info pair).")
    ] = "yaml",
) -> Answer:
    """Write a calibration to other files."""
    from app.tracking.calibration.formats.own import save_calibration
    from app.tracking.calibration.formats.ros import ros_paths, write_ros

    history = _history()
    calibration = history.load(history.find(calibration_id).id)
    if kind == "yaml":
        files = [out]
        save_calibration(out, calibration)
    elif kind == "ros":
        files = list(ros_paths(out, calibration))
        write_ros(files[0], files[1], calibration)
    else:
        raise ConfigurationError(
            sentence("--format {kind}: only yaml and ros can be written", kind=kind)
        )
    written = [str(path) for path in files]
    return Answer(
        {"id": calibration.id, "files": written}, shown=template("{id} written to {files}")
    )


@app.command("import")
def import_(
    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="FILES",
            help="One YAML of Acus; or left and right YAML of ICube or ROS; or the folder of "
            "TemugeB's text files; or intrinsics.yml and extrinsics.yml of OpenCV's stereo_calib.",
        ),
    ],
    unit: Annotated[
        str | None,
        typer.Option(
            "--unit", help="Unit of TemugeB's and OpenCV's files, the board's: e.g. 1cm, 25.4mm."
        ),
    ] = None,
    size: Annotated[
        str | None,
        typer.Option("--size", help="Picture size of TemugeB's and OpenCV's files: e.g. 1280x720."),
    ] = None,
    lens: Annotated[
        str | None,
        typer.Option(help="equidistant for OpenCV's files of fisheye lenses: they look alike."),
    ] = None,
) -> Answer:
    """Read another program's calibration and use it from now on."""
    from app.tracking.calibration.formats.reading import length, picture_size, read_calibration

    calibration = read_calibration(
        files,
        unit=length(unit) if unit is not None else None,
        image_size=picture_size(size) if size is not None else None,
        lens=lens_named(lens),
    )
    path = _history().keep(calibration)
    return Answer(
        {"file": str(path), "calibration": calibration.model_dump(mode="json")},
        [
            *calibration_lines(calibration),
            sentence("in use from now on; kept as {path}", path=path),
        ],
    )


@app.command("print")
def board_(
    out: Annotated[Path, typer.Option("--out", help="PDF file to write.")],
    board: BoardOption = "charuco:9x6:20mm:15mm:DICT_5X5_100",
    paper: Annotated[str, typer.Option("--paper", help="A4, A3 or Letter.")] = "A4",
) -> Answer:
    """Write a board as PDF at true size; print it at 100 %."""
    from app.tracking.calibration.board_layout import paper_named
    from app.tracking.calibration.boards import parse_board
    from app.views.cameras.board_page import write_board

    if out.suffix.lower() != ".pdf":
        raise ConfigurationError(sentence("--out {out}: only .pdf can be written", out=out))
    known = parse_board(board)
    sheet = write_board(out, known, paper_named(paper))
    facts = {
        "file": str(out),
        "board": known.spec,
        "paper": sheet.paper.name,
        "landscape": sheet.landscape,
        "pattern_mm": list(sheet.pattern_mm),
        "ambiguous": known.ambiguous,
    }
    shown = (
        template("{board}, {pattern_mm.0:g} x {pattern_mm.1:g} mm on {paper}: {file}"),
        template(
            "{ambiguous:?note: this board looks the same after half a turn; a ChArUco board, or "
            "one with an odd and an even count of corners, does not}"
        ),
        sentence("print at 100 %, not fitted to the page, and measure the line of 100 mm"),
    )
    return Answer(facts, shown=shown)


def entry_document(history: "CalibrationHistory", entry: "KeptCalibration") -> dict[str, Any]:
    """One calibration as JSON; a file that cannot be read says why in `problem`."""
    from app.core.errors import AcusError

    document: dict[str, Any] = {
        "id": entry.id,
        "file": str(entry.path),
        "kept": entry.kept.isoformat() if entry.kept is not None else None,
        "in_use": entry.active,
        "found_bad": entry.rejected.reason if entry.rejected is not None else "",
        "problem": "",
    }
    try:
        calibration = history.load(entry.id)
    except AcusError as error:
        return document | {"problem": str(error)}
    validation = calibration.validation
    return document | {
        "created": calibration.created.isoformat(),
        "board": calibration.board,
        "cameras": [
            {"name": c.name, "image_size": list(c.image_size), "rms_px": c.rms_px}
            for c in calibration.cameras
        ],
        "baseline_mm": calibration.baseline * 1e3,
        "rms_px": calibration.rms_px,
        "validation_rms_mm": validation.rms_mm if validation is not None else None,
        "world": calibration.world is not None,
        "uncertainty_known": calibration.uncertainty_known,
    }


def calibration_lines(calibration: "StereoCalibration") -> list[str]:
    """Return what a calibration says, for people, one line each."""
    lines: list[str] = [
        sentence("id            {id}", id=calibration.id),
        sentence(
            "created       {created:%Y-%m-%d %H:%M} {zone}",
            created=calibration.created,
            zone=f"{calibration.created:%Z}",
        ),
        sentence("board         {board}", board=calibration.board or sentence("not known")),
    ]
    for camera in calibration.cameras:
        width, height = camera.image_size
        (fx, fy), (cx, cy) = camera.focal_px, camera.centre_px
        names = " ".join(camera.lens.coefficients)
        bends = " ".join(f"{value:.4g}" for value in camera.distortion)
        lens = f"f {fx:.2f} {fy:.2f}  c {cx:.2f} {cy:.2f}  {names} {bends}"
        lines.append(
            sentence(
                "{camera:13} {width}x{height}  {lens}  {rms_px:.3f} px, {views} views",
                camera=camera.name,
                width=width,
                height=height,
                lens=lens,
                rms_px=camera.rms_px,
                views=camera.views,
            )
        )
    lines.append(
        sentence(
            "pair          {rms_px:.3f} px, baseline {baseline_mm:.2f} mm",
            rms_px=calibration.rms_px,
            baseline_mm=calibration.baseline * 1e3,
        )
    )
    if (checked := calibration.validation) is not None:
        lines.append(
            sentence(
                "held back     {views} pairs: {rms_mm:.3f} mm RMS, largest {max_mm:.3f} mm, "
                "scale {scale:.5f} ± {scale_sd:.5f}",
                views=checked.views,
                rms_mm=checked.rms_mm,
                max_mm=checked.max_mm,
                scale=checked.scale,
                scale_sd=checked.scale_sd,
            )
        )
    if not calibration.uncertainty_known:
        lines.append(
            sentence(
                "uncertainty   the calibration's own uncertainty is not known: every stated radius "
                "leaves it out"
            )
        )
    world = sentence("known") if calibration.world else sentence("not known")
    lines.append(sentence("world         {known}", known=world))
    return lines + [sentence("note          {note}", note=note) for note in calibration.notes]


def _history() -> "CalibrationHistory":
    from app.tracking.calibration.history import CalibrationHistory

    return CalibrationHistory()


def _in_use(history: "CalibrationHistory") -> Answer:
    active = history.active()
    facts = {"in_use": None if active is None else active.id}
    return Answer(facts, shown=template("{in_use:?in use: {in_use}|no calibration is in use}"))
