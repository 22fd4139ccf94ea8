"""`acus camera`: which cameras there are, which are used, whether they are well and see enough."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands.answer import Answer, Commands
from app.commands.reader_language import tell, template
from app.commands.shown import Each
from app.core.messages import joined, listed, sentence

if TYPE_CHECKING:
    from app.tracking.cameras.settings import CameraSettings
    from app.tracking.cameras.survey import CameraReport

Cameras = Annotated[
    str | None,
    typer.Option(
        "--cameras",
        help="A settings file, left=SOURCE,right=SOURCE or simulated; default: as remembered.",
    ),
]


RANK = 130


def register(app: typer.Typer) -> None:
    """Add `acus camera …`."""
    group = Commands(help="Cameras: choose, test, aim, measure.")
    group.command("list")(list_cameras)
    group.command("use")(use)
    group.command("test")(examine)
    group.command("aim")(aim)
    group.command("latency")(latency)
    app.add_typer(group, name="camera")


def list_cameras() -> Answer:
    """List the cameras that are plugged in, and the chosen."""
    from app.tracking.cameras.ports import camera_ports
    from app.tracking.cameras.settings import load_settings

    ports, settings = camera_ports(), load_settings()
    plugged_in = [
        {
            "source": f"usb:{port.port}",
            "title": port.title,
            "node": port.node,
            "by_path": list(port.paths),
        }
        for port in ports
    ]
    return Answer(
        {"plugged_in": plugged_in, "chosen": settings.model_dump(mode="json")},
        shown=(
            Each(
                "plugged_in",
                "{source:<16} {title}  {node}",
                none=sentence("no camera is plugged in"),
            ),
            "left   {chosen.left.source}",
            "right  {chosen.right.source}",
        ),
    )


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
) -> Answer:
    """Choose the cameras and remember them. Only what is given changes.

    A SOURCE is usb:PORT, usb:0, folder:PATH, video:PATH or simulated.
    """
    from app.core.configuration import parse
    from app.tracking.cameras.ports import camera_ports
    from app.tracking.cameras.settings import (
        CameraSettings,
        load_settings,
        save_settings,
        with_sources,
    )
    from app.tracking.cameras.survey import missing
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
    file, warnings = save_settings(settings), []
    for side in given:
        if lack := missing(getattr(settings, side).source, camera_ports()):
            warnings.append(
                sentence("{side}: {lack}; saved all the same, for when it is", side=side, lack=lack)
            )
            tell(sentence("warning: {warning}", warning=warnings[-1]), err=True)
    return Answer(
        {"chosen": settings.model_dump(mode="json"), "file": file, "warnings": warnings},
        shown=(
            "left {chosen.left.source}, right {chosen.right.source}",
            template("saved in {file}"),
        ),
    )


def examine(
    cameras: Cameras = None,
    source: Annotated[str, typer.Option(help="Look at this one source only.")] = "",
    seconds: Annotated[float, typer.Option(min=0.2, max=600.0, help="How long.")] = 2.0,
    out: Annotated[Path | None, typer.Option(help="Folder for a picture of each.")] = None,
) -> Answer:
    """Measure what the cameras deliver. Size, rate, repeats, light; left and right swapped?"""
    from app.compose.camera_check import survey_cameras
    from app.tracking.cameras.settings import load_settings, parse_cameras

    settings = load_settings() if cameras is None else parse_cameras(cameras)
    found = survey_cameras(settings, source, seconds)
    if out is not None:
        found.write_pictures(out)
    lines = [line for report in found.reports for line in report_lines(report)]
    if found.skew_ms is not None:
        lines.append(sentence("skew (right after left): {skew:.1f} ms", skew=found.skew_ms))
    if found.order:
        lines.append(found.order)
    facts = {
        "cameras": [report_document(report) for report in found.reports],
        "skew_ms": found.skew_ms,
        "order": found.order,
        "marker_colour": settings.model_dump(mode="json")["marker_colour"],
    }
    return Answer(facts, [*lines, colour_line(settings)])


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
) -> Answer:
    """Say how much of the needle's cone both cameras see."""
    from app.compose.camera_check import aim_of
    from app.tracking.cameras.settings import CameraSettings, load_settings, parse_cameras

    settings = load_settings() if cameras is None else parse_cameras(cameras)
    if rig:
        settings = CameraSettings(rig=rig)
    found = aim_of(settings, device, _range(depths, tilt))
    if out is not None:
        found.write_pictures(settings, out)
    cone = found.cone
    facts = {
        "share": cone.share,
        "cameras": dict(zip(cone.names, cone.shares, strict=True)),
        "losses": list(cone.losses()),
        "basis": found.basis,
    }
    seen = template("both cameras see {share:.0%} of the needle's cone ({basis})")
    return Answer(facts, shown=(seen, Each("losses")))


def latency(
    side: Annotated[str, typer.Option(help="With --display: left or right.")] = "left",
    display: Annotated[
        bool, typer.Option("--display", help="Measure: blink a patch on this screen.")
    ] = False,
) -> Answer:
    """Print the cameras' latency, or measure it on this screen."""
    from app.tracking.cameras.settings import load_settings

    if display:
        _measure(side)
    settings = load_settings()
    known = {"left": settings.left, "right": settings.right}
    facts, lines = {}, []
    for name, camera in known.items():
        facts[name] = {"latency_ms": camera.latency_ms, "sd_ms": camera.latency_sd_ms}
        told: str = sentence("not measured; use --display")
        if camera.latency_ms is not None:
            told = f"{camera.latency_ms:.1f} ms, spread {camera.latency_sd_ms or 0.0:.1f} ms"
        lines.append(f"{name:<6} {camera.source}: {told}")
    return Answer(facts, lines)


def _range(depths: str, tilt: float | None) -> dict[str, float]:
    from app.tracking.errors import CameraError

    given = {} if tilt is None else {"tilt_max_deg": tilt}
    if not depths:
        return given
    try:
        lowest, highest = (float(part) for part in depths.split(","))
    except ValueError as error:
        raise CameraError(
            sentence("{depths!r} is no range of depths; give for example -30,120", depths=depths)
        ) from error
    return given | {"depth_min_mm": lowest, "depth_max_mm": highest}


def _size(text: str) -> tuple[int, int]:
    from app.tracking.errors import CameraError

    width, x, height = text.lower().partition("x")
    if not (x and width.isdecimal() and height.isdecimal()):
        raise CameraError(
            sentence("{size!r} is no size of a picture; give for example 640x480", size=text)
        )
    return int(width), int(height)


def _measure(side: str) -> None:
    """Open the test for the `left` or `right` camera and keep what the user keeps.

    Raises:
        CameraError: if the camera is simulated, or there is no such side.
        NoDisplayError: without a screen, or with one that is drawn into memory only.
    """
    import os

    from app.compose.desktop import Desktop
    from app.tracking.cameras.settings import SIDES, load_settings, save_settings, with_latency
    from app.tracking.errors import CameraError
    from app.views.cameras.latency_dialog import LatencyDialog
    from app.views.shell.application import NoDisplayError, start

    if side not in SIDES:
        raise CameraError(
            sentence(
                "there is no {side!r} camera; there are {sides}",
                side=side,
                sides=listed(SIDES),
            )
        )
    settings = load_settings()
    if settings.simulated:
        raise CameraError(
            sentence(
                "the cameras are simulated and have no latency to measure; choose real ones with "
                "`acus camera use`"
            )
        )
    if os.environ.get("QT_QPA_PLATFORM") == "offscreen":
        raise NoDisplayError(
            sentence("the test needs a real screen that a camera can look at; there is none")
        )
    application = start()
    dialog = LatencyDialog(settings, side, Desktop(), lambda: None)
    dialog.measured.connect(
        lambda name, found: save_settings(with_latency(settings, name, found.median, found.sd))
    )
    dialog.finished.connect(lambda _: application.quit())
    dialog.show()
    application.exec()
    dialog.closed()()


def report_lines(report: CameraReport) -> list[str]:
    """Return what a camera delivered, a line each, for people."""
    figures = report.figures
    times = {True: sentence("the driver's"), False: sentence("of the delivery, less the latency")}
    lines: list[str] = [
        sentence(
            "{name}: {width}x{height}, {rate:.1f} pictures/s, jitter {jitter_ms:.1f} ms, "
            "{repeated:.1f} % repeated",
            name=report.name,
            width=report.size[0],
            height=report.size[1],
            rate=figures.rate,
            jitter_ms=1e3 * figures.jitter,
            repeated=100.0 * figures.repeated_share,
        ),
        sentence(
            "  brightness {brightness:.0f} of 255, {saturated:.1f} % overexposed, "
            "noise {noise:.1f} grey values",
            brightness=report.brightness,
            saturated=100.0 * report.saturated,
            noise=report.noise,
        ),
    ]
    if report.driver_time is not None:
        lines.append(
            sentence(
                "  capture times: {times}; {age_ms:.0f} ms to delivery",
                times=times[report.driver_time],
                age_ms=1e3 * report.age,
            )
        )
    lines += [joined("", ("  ", text)) for text in report.settings]
    return lines + [joined("", ("  ! ", text)) for text in report.advice()]


def colour_line(settings: CameraSettings) -> str:
    """Return which colour of the marker is looked for, for people."""
    colour = settings.marker_colour
    if colour is None:
        return sentence("marker's colour: the usual red (the tracker panel's Learn takes another)")
    blue, green, red = colour.bgr
    return sentence(
        "marker's colour: learned, red {red:.0f} green {green:.0f} blue {blue:.0f}, within "
        "{angle:.0f}° (`acus camera use --forget-colour` goes back to the usual red)",
        red=red,
        green=green,
        blue=blue,
        angle=colour.angle_deg,
    )


def report_document(report: CameraReport) -> dict[str, Any]:
    """Return it for `--json` (docs/json.md)."""
    figures = report.figures
    return {
        "name": report.name,
        "size": list(report.size),
        "rate_hz": figures.rate,
        "jitter_ms": 1e3 * figures.jitter,
        "repeated": figures.repeated,
        "backwards": figures.backwards,
        "repeated_share": figures.repeated_share,
        "brightness": report.brightness,
        "saturated_share": report.saturated,
        "noise_grey": report.noise,
        "driver_time": report.driver_time,
        "settings": list(report.settings),
        "advice": list(report.advice()),
    }
