"""`acus pen`: a needle without a robot, printed and seen by one webcam."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from app.tracking.pen.body import PenProfile

Name = Annotated[str, typer.Option("--pen", help="A pen's name or the path of its file.")]
Edge = Annotated[
    float | None,
    typer.Option("--edge", metavar="MM", help="Edge of a face, where it is not the profile's."),
]
app = typer.Typer(help="A pen with printed markers before a webcam (docs/pen.md).")


def register(root: typer.Typer) -> None:
    """Add the group."""
    root.add_typer(app, name="pen")


@app.command("list")
def list_pens(
    as_json: Annotated[bool, typer.Option("--json", help="JSON instead of text.")] = False,
) -> None:
    """Name the pens that come with the program, and whether their tips are measured."""
    from app.tracking.pen.body import shipped_pens
    from app.tracking.pen.settings import PenSettings

    rows = []
    for name in shipped_pens():
        pen = PenSettings(pen=name).profile()
        rows.append({"name": name, "description": pen.description, "tip": _tip(pen)})
    if as_json:
        typer.echo(json.dumps(rows, indent=2))
        return
    for row in rows:
        typer.echo(f"{row['name']:8} {row['description']}; {row['tip']}")


@app.command("print")
def print_pen(
    out: Annotated[Path, typer.Option(help="PDF to write.")],
    pen: Name = "cube",
    edge: Edge = None,
    paper: Annotated[str, typer.Option(help="A4, A3 or Letter.")] = "A4",
) -> None:
    """Write cube or ring with its tabs, and the sheet, as a PDF at true size."""
    from app.tracking.pen.body import load_pen
    from app.views.cameras.board_layout import paper_named
    from app.views.pen.net_page import write_pen

    profile = load_pen(pen) if edge is None else load_pen(pen).resized(edge)
    write_pen(out, profile, paper_named(paper))
    typer.echo(
        f"wrote {out}: print it at 100 %, check the line of 100 mm, cut, fold, glue (docs/pen.md)"
    )


def _tip(pen: PenProfile) -> str:
    return "tip measured" if pen.tip.calibrated else "tip by the drawing: `acus pen calibrate`"


@app.command("calibrate")
def calibrate(
    source: Annotated[
        str | None,
        typer.Option(help="usb:0, folder:PATH or video:PATH; default: as remembered."),
    ] = None,
    pen: Name = "cube",
    edge: Edge = None,
    lens: Annotated[
        Path | None, typer.Option(help="Calibration of the webcam's lens; default: remembered.")
    ] = None,
    seconds: Annotated[float, typer.Option(min=1.0, help="How long to look at most.")] = 60.0,
    roll: Annotated[
        str | None,
        typer.Option(
            metavar="SOURCE",
            help="Then measure the shaft: the webcam again, or pictures of the pen being rolled "
            "about itself in a groove (usb:0, folder:PATH).",
        ),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="JSON instead of text.")] = False,
) -> None:
    """Measure the tip: stand it in a dimple before the webcam and rock the pen to every side.

    With --roll the shaft's direction is measured too: lay the pen into a groove and roll it by a
    quarter turn or more. Without, the shaft is taken to run through the middle of the cube.
    """
    from app.compose.pen_calibration import calibrate_pen, measure_shaft
    from app.tracking.pen.kept import save_pen
    from app.tracking.pen.settings import load_settings, save_settings, with_source

    settings = load_settings().model_copy(update={"pen": pen, "edge_mm": edge})
    settings = settings if source is None else with_source(settings, source)
    settings = settings if lens is None else settings.model_copy(update={"calibration": lens})
    if not as_json:
        typer.echo("stand the tip in a dimple on the sheet and rock the pen to every side …")

    def tell(text: str) -> None:
        typer.echo(text, err=True)

    found = calibrate_pen(settings, seconds, tell)
    if roll is not None:
        tell("now lay the pen into a groove and roll it about itself by a quarter turn or more …")
        found = measure_shaft(with_source(settings, roll), found, seconds, tell)
    path = save_pen(found.pen, settings.kept_name)
    save_settings(settings)
    if as_json:
        document = {
            "tip_mm": found.pen.tip.position_mm,
            "tip_sd_mm": found.tip.sd_mm,
            "rms_mm": found.tip.rms * 1e3,
            "poses": found.tip.poses,
            "left_out": found.tip.left_out,
            "held_back_rms_mm": None if found.check is None else found.check.rms * 1e3,
            "axis_sd_deg": found.axis.sd_deg,
            "axis_by": found.axis.source,
            "file": str(path),
        }
        typer.echo(json.dumps(document, indent=2))
        return
    typer.echo(found.words)
    typer.echo(f"kept in {path}")
