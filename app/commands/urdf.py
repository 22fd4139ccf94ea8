"""`acus urdf`: a device profile as URDF or MJCF, and a profile with the lengths of a URDF."""

from pathlib import Path
from typing import Annotated

import typer

from app.commands.answer import Answer, Commands
from app.commands.reader_language import local
from app.core.messages import sentence

app = Commands(help="Device profiles to and from URDF, and to MJCF.")


RANK = 170


def register(root: typer.Typer) -> None:
    """Add `urdf` to the command line."""
    root.add_typer(app, name="urdf")


@app.command("export")
def export(
    out: Annotated[Path, typer.Option(metavar="FILE", help="URDF to write.")],
    profile: Annotated[str, typer.Option(help="Device profile: name or file.")] = "icube",
    origin: Annotated[
        str, typer.Option(help="Where `world` stands: left-motor (as ICube's) or midpoint.")
    ] = "left-motor",
    meshes: Annotated[
        bool, typer.Option("--meshes", help="Draw the parts as meshes: STL files beside FILE.")
    ] = False,
) -> Answer:
    """Write a profile as URDF. The loop is cut at the right arm's end."""
    from app.core.errors import ConfigurationError
    from app.exchange import mjcf
    from app.exchange.text_export import write_bytes, write_text
    from app.exchange.urdf import Origin, write_urdf
    from app.exchange.urdf_meshes import stl_files
    from app.mechanisms.pantograph.profile import as_pantograph
    from app.mechanisms.profile import load_profile

    device = load_profile(profile)
    if device.kind in mjcf.kinds():
        raise ConfigurationError(
            sentence(
                "device {name} is of kind {kind}, whose loops and cables no URDF can hold; use"
                " `acus urdf mjcf`",
                name=device.name,
                kind=device.kind,
            )
        )
    try:
        where = Origin(origin)
    except ValueError:
        names = ", ".join(Origin)
        raise ConfigurationError(
            sentence("--origin {origin!r}; valid names: {names}", origin=origin, names=names)
        ) from None
    pantograph = as_pantograph(device)
    write_text(out, write_urdf(pantograph, where, out.stem if meshes else None))
    parts = stl_files(pantograph, out.stem) if meshes else {}
    for name, content in parts.items():
        write_bytes(out.parent / name, content)
    files = [out, *(out.parent / name for name in parts)]
    place = where.value.replace("-", " ")
    named = {"file": out, "profile": profile, "place": place, "count": len(parts)}
    line = sentence("{file}: {profile}, world at the {place}", **named)
    if parts:
        line = sentence(
            "{file}: {profile}, world at the {place}, {count} meshes beside it", **named
        )
    return Answer({"files": files}, [line])


@app.command("mjcf")
def write_mjcf(
    out: Annotated[Path, typer.Option(metavar="FILE", help="MJCF to write.")],
    profile: Annotated[str, typer.Option(help="Device profile: name or file.")],
) -> Answer:
    """Write a profile as MJCF, with its loops and cables."""
    from app.exchange import mjcf
    from app.exchange.text_export import write_text
    from app.mechanisms.profile import load_profile

    text = mjcf.write_mjcf(load_profile(profile))
    write_text(out, text)
    cables = text.count("<spatial ")
    return Answer({"files": [out], "cables": cables}, [f"{out}: {profile}, {cables} cables"])


@app.command("import")
def import_profile(
    file: Annotated[
        Path, typer.Argument(metavar="FILE", help="URDF, or xacro of literal numbers.")
    ],
    out: Annotated[Path, typer.Option(metavar="PROFILE.yaml", help="Profile to write.")],
    like: Annotated[str, typer.Option(help="Profile that gives all other values.")] = "icube",
) -> Answer:
    """Write a device profile with the link lengths of a URDF.

    All else is taken from another profile.
    """
    import yaml

    from app.core.errors import ConfigurationError
    from app.exchange.text_export import write_text
    from app.exchange.urdf import profile_like, read_geometry
    from app.mechanisms.pantograph.profile import load_pantograph

    if out.suffix not in (".yaml", ".yml"):
        raise ConfigurationError(sentence("--out {out}: a device profile is a .yaml file", out=out))
    document = profile_like(load_pantograph(like), read_geometry(file), out.stem)
    head = sentence(
        "# Lengths from {file}, all else from the profile {like}. SI units.",
        file=file.name,
        like=like,
    )
    write_text(
        out, local(head) + "\n" + yaml.safe_dump(document, sort_keys=False, allow_unicode=True)
    )
    lengths = document["geometry"]
    shown = ", ".join(f"{name} {lengths[name]}" for name in lengths if name != "provenance")
    return Answer({"files": [out], "geometry": lengths}, [f"{out}: {shown} m"])
