"""`acus pen`: a needle without a robot, printed and seen by one webcam."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from app.commands.answer import Answer, Commands
from app.commands.shown import Each
from app.core.messages import sentence

if TYPE_CHECKING:
    from app.tracking.pen.body import PenProfile

Name = Annotated[str, typer.Option("--pen", help="A pen's name or the path of its file.")]
Edge = Annotated[
    float | None,
    typer.Option("--edge", metavar="MM", help="Edge of a face, where it is not the profile's."),
]
app = Commands(help="A pen with printed markers before a webcam.")


RANK = 160


def register(root: typer.Typer) -> None:
    """Add the group."""
    root.add_typer(app, name="pen")


@app.command("list")
def list_pens() -> Answer:
    """List the pens, and whether their tips are measured."""
    from app.tracking.pen.body import shipped_pens
    from app.tracking.pen.settings import PenSettings

    rows = []
    for name in shipped_pens():
        pen = PenSettings(pen=name).profile()
        rows.append({"name": name, "description": pen.description, "tip": _tip(pen)})
    return Answer({"pens": rows}, shown=Each("pens", "{name:8} {description}; {tip}"))


@app.command("print")
def print_pen(
    out: Annotated[Path, typer.Option(help="PDF to write.")],
    pen: Name = "cube",
    edge: Edge = None,
    paper: Annotated[str, typer.Option(help="A4, A3 or Letter.")] = "A4",
) -> Answer:
    """Write a pen's cube or ring and the sheet as a PDF."""
    from app.tracking.calibration.board_layout import paper_named
    from app.tracking.pen.body import load_pen
    from app.views.pen.net_page import write_pen

    profile = load_pen(pen) if edge is None else load_pen(pen).resized(edge)
    write_pen(out, profile, paper_named(paper))
    words = sentence("print it at 100 %, check the line of 100 mm, cut, fold, glue (docs/pen.md)")
    return Answer({"files": [out]}, shown="wrote {files}: " + words)


def _tip(pen: PenProfile) -> str:
    return (
        sentence("tip measured")
        if pen.tip.calibrated
        else sentence("tip by the drawing: `acus pen calibrate`")
    )


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
) -> Answer:
    """Measure the tip of a pen. Stand it in a dimple before the webcam and rock it about.

    With --roll the shaft's direction is measured too: lay the pen into a groove and roll it by a
    quarter turn or more. Without, the shaft is taken to run through the middle of the cube.
    """
    from app.compose.pen import calibrate_pen, measure_shaft
    from app.tracking.pen.settings import load_settings, save_pen, save_settings, with_source

    settings = load_settings().model_copy(update={"pen": pen, "edge_mm": edge})
    settings = settings if source is None else with_source(settings, source)
    settings = settings if lens is None else settings.model_copy(update={"calibration": lens})

    def tell(text: str) -> None:
        typer.echo(text, err=True)

    tell(sentence("stand the tip in a dimple on the sheet and rock the pen to every side …"))
    found = calibrate_pen(settings, seconds, tell)
    if roll is not None:
        tell(
            sentence(
                "now lay the pen into a groove and roll it about itself by a quarter turn or more …"
            )
        )
        found = measure_shaft(with_source(settings, roll), found, seconds, tell)
    path = save_pen(found.pen, settings.kept_name)
    save_settings(settings)
    facts = {
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
    return Answer(facts, [found.words, sentence("kept in {path}", path=path)])
