"""`acus transform`: where the patient lies in front of the robot, to and from 3D Slicer."""

from pathlib import Path
from typing import Annotated

import typer

from app.commands.answer import Answer, Commands
from app.commands.reader_language import template
from app.core.errors import ConfigurationError
from app.core.messages import sentence

app = Commands(help="Rigid transforms as .tfm files of ITK and 3D Slicer.")


RANK = 70


def register(root: typer.Typer) -> None:
    """Add `transform` to the command line."""
    root.add_typer(app, name="transform")


@app.command()
def export(
    plan: Annotated[Path, typer.Argument(metavar="PLAN", help="Plan, .mrk.json.")],
    out: Annotated[Path, typer.Option(help="File to write, .tfm.")],
    orientation: Annotated[
        str, typer.Option(help="supine, prone, left_down or right_down.")
    ] = "supine",
    rotate: Annotated[
        str, typer.Option(metavar="X,Y,Z", help="Free rotation vector, world axes [°].")
    ] = "0,0,0",
    device: Annotated[str, typer.Option(help="Device profile, for its fulcrum.")] = "icube",
) -> Answer:
    """Write the transform from robot to patient (LPS), for a plan.

    In Slicer, models of the robot under this transform stand where they stand in Acus.
    """
    from app.commands.answers import numbers
    from app.exchange.markups import read_plan
    from app.exchange.transforms import write_tfm
    from app.mechanisms.profile import load_profile
    from app.planning.placement import PatientOrientation, Placement

    valid = [one.value for one in PatientOrientation]
    if orientation not in valid:
        raise ConfigurationError(
            sentence(
                "--orientation {orientation!r}: use {valid}",
                orientation=orientation,
                valid=", ".join(valid),
            )
        )
    x, y, z = numbers(rotate, "--rotate", 3)
    placement = Placement(PatientOrientation(orientation), (x, y, z))
    fulcrum = load_profile(device).fulcrum
    write_tfm(out, placement.T_world_patient(read_plan(plan), fulcrum).inverse())
    return Answer({"files": [out]}, shown=template("{files}: from world (robot) to patient (LPS)"))


@app.command()
def show(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Transform, .tfm.")],
) -> Answer:
    """Show the rigid transform of a file. To its parent, as Slicer shows it; or why it is none."""
    import numpy as np

    from app.core.rotation import rotation_log
    from app.exchange.transforms import read_tfm

    T_to_from = read_tfm(file)
    matrix = T_to_from.matrix()
    matrix[:3, 3] *= 1e3
    angle = float(np.degrees(np.linalg.norm(rotation_log(T_to_from.rotation))))
    rows = ["  ".join(f"{value:12.6f}" for value in row + 0.0) for row in matrix]
    return Answer(
        {"to_parent_mm": matrix.tolist(), "angle_deg": angle},
        [
            *rows,
            sentence("turns by {angle:.3f}°, millimetres, LPS as in the file", angle=angle),
        ],
    )
