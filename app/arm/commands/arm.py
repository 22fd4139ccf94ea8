"""`acus arm`: the simulated arm for other programs."""

from pathlib import Path
from typing import Annotated

import typer

from app.commands.answer import Answer, Commands

RANK = 175


def register(root: typer.Typer) -> None:
    """Add `acus arm`."""
    group = Commands(help="The simulated arm for other programs.")
    group.command("urdf")(urdf)
    root.add_typer(group, name="arm")


def urdf(
    out: Annotated[Path, typer.Option(metavar="FILE", help="URDF to write.")],
    arm: Annotated[str, typer.Option(help="Arm profile: name or file.")] = "iiwa14",
) -> Answer:
    """Write an arm as URDF, where it stands and with what it holds."""
    from app.arm.mechanics import load_arm, published_arm
    from app.arm.mechanics.published import write_arm_urdf
    from app.exchange.text_export import write_text

    profile = load_arm(arm)
    write_text(out, write_arm_urdf(profile, published_arm()))
    return Answer({"files": [out]}, [f"{out}: {profile.name}, 7 joints"])
