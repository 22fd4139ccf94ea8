"""`acus calibrate export|import|board`: files for and from other programs, boards to print."""

from pathlib import Path
from typing import Annotated

import typer

from app.commands.answer import Answer
from app.commands.calibrate_history import Id
from app.commands.calibrate_parts import app
from app.core.errors import AcusError

BoardOption = Annotated[
    str, typer.Option("--board", metavar="SPEC", help="Board to print; see `calibrate views`.")
]


class ExchangeError(AcusError):
    """An option of the exchange commands that cannot be understood."""


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
    from app.tracking.calibration.history import CalibrationHistory

    history = CalibrationHistory()
    calibration = history.load(history.find(calibration_id).id)
    if kind == "yaml":
        files = [out]
        save_calibration(out, calibration)
    elif kind == "ros":
        files = list(ros_paths(out, calibration))
        write_ros(files[0], files[1], calibration)
    else:
        raise ExchangeError(f"--format {kind}: only yaml and ros can be written")
    written = [str(path) for path in files]
    return Answer(
        {"id": calibration.id, "files": written},
        [f"{calibration.id} written to {', '.join(written)}"],
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
) -> Answer:
    """Read another program's calibration and use it from now on."""
    from app.commands.calibrate_history import calibration_lines
    from app.tracking.calibration.formats.reading import read_calibration
    from app.tracking.calibration.formats.said import length, picture_size
    from app.tracking.calibration.history import CalibrationHistory

    calibration = read_calibration(
        files,
        unit=length(unit) if unit is not None else None,
        image_size=picture_size(size) if size is not None else None,
    )
    path = CalibrationHistory().keep(calibration)
    return Answer(
        {"file": str(path), "calibration": calibration.model_dump(mode="json")},
        [*calibration_lines(calibration), f"in use from now on; kept as {path}"],
    )


@app.command("board", hidden=True)
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
        raise ExchangeError(f"--out {out}: only .pdf can be written")
    known = parse_board(board)
    sheet = write_board(out, known, paper_named(paper))
    width, height = sheet.pattern_mm
    facts = {
        "file": str(out),
        "board": known.spec,
        "paper": sheet.paper.name,
        "landscape": sheet.landscape,
        "pattern_mm": [width, height],
        "ambiguous": known.ambiguous,
    }
    lines = [f"{known.spec}, {width:g} x {height:g} mm on {sheet.paper.name}: {out}"]
    if known.ambiguous:
        lines.append(
            "note: this board looks the same after half a turn; a ChArUco board, or one with an "
            "odd and an even count of corners, does not"
        )
    lines.append("print at 100 %, not fitted to the page, and measure the line of 100 mm")
    return Answer(facts, lines)
