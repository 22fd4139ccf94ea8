"""`acus camera`: which cameras there are, which are used, whether they are well and see enough."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

Json = Annotated[bool, typer.Option("--json", help="Print JSON (docs/json.md).")]
Cameras = Annotated[
    str | None,
    typer.Option(
        "--cameras",
        help="A settings file, left=SOURCE,right=SOURCE or simulated; default: as remembered.",
    ),
]


def register(app: typer.Typer) -> None:
    """Add `acus camera …`."""
    group = typer.Typer(help="Cameras: list, choose, look at, aim, measure (docs/cameras.md).")
    group.command("list")(list_cameras)
    group.command("use")(use)
    group.command("show")(show)
    group.command("aim")(aim)
    group.command("latency")(latency)
    app.add_typer(group, name="camera", no_args_is_help=True)


def list_cameras(as_json: Json = False) -> None:
    """List the cameras that are plugged in, by port, and what is chosen."""
    from app.tracking.cameras.ports import camera_ports
    from app.tracking.cameras.settings import load_settings

    ports, settings = camera_ports(), load_settings()
    if as_json:
        _print_json(
            {
                "plugged_in": [
                    {"source": f"usb:{p.port}", "title": p.title, "node": p.node,
                     "by_path": list(p.paths)} for p in ports
                ],
                "chosen": settings.model_dump(mode="json"),
            }
        )  # fmt: skip
        return
    for port in ports:
        typer.echo(f"usb:{port.port:<12} {port.title}  {port.node}")
    if not ports:
        typer.echo("no camera is plugged in")
    for side, camera in (("left", settings.left), ("right", settings.right)):
        typer.echo(f"{side:<6} {camera.source}")


def use(
    left: Annotated[str, typer.Option(help="Source of the left camera.")] = "",
    right: Annotated[str, typer.Option(help="Source of the right camera.")] = "",
    rig: Annotated[str, typer.Option(help="Rig profile: a name or a YAML file.")] = "",
    size: Annotated[str, typer.Option(metavar="WIDTHxHEIGHT", help="Of the pictures.")] = "",
    rate: Annotated[float | None, typer.Option(help="Pictures per second.")] = None,
    exposure_ms: Annotated[float | None, typer.Option(help="Held, of both cameras.")] = None,
    calibration: Annotated[
        str, typer.Option(help="File of a calibration; `active` for the one in use.")
    ] = "",
    forget_colour: Annotated[
        bool, typer.Option("--forget-colour", help="Forget the marker's learned colour.")
    ] = False,
) -> None:
    """Choose the cameras of the trainer and remember them; only what is given changes.

    A SOURCE is usb:PORT, usb:0, folder:PATH, video:PATH or simulated.
    """
    from app.core.configuration import parse
    from app.tracking.cameras.ports import camera_ports
    from app.tracking.cameras.presence import missing
    from app.tracking.cameras.settings import (
        CameraSettings,
        load_settings,
        save_settings,
        with_sources,
    )
    from app.tracking.optics.rig import load_rig

    given = {side: text for side, text in (("left", left), ("right", right)) if text}
    document = with_sources(load_settings(), given).model_dump(mode="json")
    if rig:
        load_rig(rig)
        document["rig"] = rig
    if size:
        document["size"] = _size(size)
    if rate is not None:
        document["rate_hz"] = rate
    if exposure_ms is not None:
        document["left"]["exposure_ms"] = document["right"]["exposure_ms"] = exposure_ms
    if calibration:
        document["calibration"] = None if calibration == "active" else calibration
    if forget_colour:
        document["marker_colour"] = None
    settings = parse(document, CameraSettings, "acus camera use")
    typer.echo(f"left {settings.left.source}, right {settings.right.source}")
    typer.echo(f"saved in {save_settings(settings)}")
    for side in given:
        if lack := missing(getattr(settings, side).source, camera_ports()):
            typer.echo(f"warning: {side}: {lack}; saved all the same, for when it is", err=True)


def show(
    cameras: Cameras = None,
    source: Annotated[str, typer.Option(help="Look at this one source only.")] = "",
    seconds: Annotated[float, typer.Option(min=0.2, max=600.0, help="How long.")] = 2.0,
    out: Annotated[Path | None, typer.Option(help="Folder for a picture of each.")] = None,
    as_json: Json = False,
) -> None:
    """Look at the cameras: size, rate, repeats, settings, light; are left and right swapped?"""
    from app.commands.camera_report import colour_line, report_document, report_lines
    from app.compose.camera_check import look
    from app.tracking.cameras.settings import load_settings, parse_cameras

    settings = load_settings() if cameras is None else parse_cameras(cameras)
    found = look(settings, source, seconds)
    if out is not None:
        found.write_pictures(out)
    if as_json:
        _print_json(
            {
                "cameras": [report_document(report) for report in found.reports],
                "skew_ms": found.skew_ms,
                "order": found.order,
                "marker_colour": settings.model_dump(mode="json")["marker_colour"],
            }
        )
        return
    for report in found.reports:
        for line in report_lines(report):
            typer.echo(line)
    if found.skew_ms is not None:
        typer.echo(f"skew (right after left): {found.skew_ms:.1f} ms")
    if found.order:
        typer.echo(found.order)
    typer.echo(colour_line(settings))


def aim(
    cameras: Cameras = None,
    rig: Annotated[
        str, typer.Option(help="Ask about a rig profile as it is designed, without cameras.")
    ] = "",
    device: Annotated[str, typer.Option(help="Device profile: where the fulcrum is.")] = "icube",
    depths: Annotated[
        str, typer.Option(metavar="MIN,MAX", help="Depths [mm]; default: the rig's range.")
    ] = "",
    tilt: Annotated[
        float | None, typer.Option(help="Largest tilt [degrees]; default: the rig's range.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option(help="Folder for both pictures with the cone drawn in.")
    ] = None,
    as_json: Json = False,
) -> None:
    """Say which share of the needle's cone both cameras see, and where it is lost."""
    from app.compose.camera_check import aim_of
    from app.tracking.cameras.settings import CameraSettings, load_settings, parse_cameras

    settings = load_settings() if cameras is None else parse_cameras(cameras)
    if rig:
        settings = CameraSettings(rig=rig)
    found = aim_of(settings, device, _range(depths, tilt))
    if out is not None:
        found.write_pictures(settings, out)
    cone = found.cone
    if as_json:
        _print_json(
            {
                "share": cone.share,
                "cameras": dict(zip(cone.names, cone.shares, strict=True)),
                "losses": list(cone.losses()),
                "basis": found.basis,
            }
        )
        return
    typer.echo(f"both cameras see {100.0 * cone.share:.0f} % of the needle's cone ({found.basis})")
    for line in cone.losses():
        typer.echo(line)


def latency(
    side: Annotated[str, typer.Option(help="With --display: left or right.")] = "left",
    display: Annotated[
        bool, typer.Option("--display", help="Measure: blink a patch on this screen.")
    ] = False,
    as_json: Json = False,
) -> None:
    """Print the measured latency of the cameras, or measure one before this screen."""
    from app.tracking.cameras.settings import load_settings

    if display:
        from app.commands.camera_latency import measure

        measure(side)
    settings = load_settings()
    known = {"left": settings.left, "right": settings.right}
    if as_json:
        _print_json({s: {"latency_ms": c.latency_ms, "sd_ms": c.latency_sd_ms}
                     for s, c in known.items()})  # fmt: skip
        return
    for name, camera in known.items():
        told = "not measured; use --display" if camera.latency_ms is None else (
            f"{camera.latency_ms:.1f} ms, spread {camera.latency_sd_ms or 0.0:.1f} ms"
        )  # fmt: skip
        typer.echo(f"{name:<6} {camera.source}: {told}")


def _range(depths: str, tilt: float | None) -> dict[str, float]:
    from app.tracking.errors import CameraError

    given = {} if tilt is None else {"tilt_max_deg": tilt}
    if not depths:
        return given
    try:
        lowest, highest = (float(part) for part in depths.split(","))
    except ValueError as error:
        raise CameraError(f"{depths!r} is no range of depths; give for example -30,120") from error
    return given | {"depth_min_mm": lowest, "depth_max_mm": highest}


def _size(text: str) -> tuple[int, int]:
    from app.tracking.errors import CameraError

    width, x, height = text.lower().partition("x")
    if not (x and width.isdecimal() and height.isdecimal()):
        raise CameraError(f"{text!r} is no size of a picture; give for example 640x480")
    return int(width), int(height)


def _print_json(document: object) -> None:
    from json import dumps

    typer.echo(dumps(document, indent=2))
