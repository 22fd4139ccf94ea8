"""What `acus camera show` prints about a camera."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import typer

if TYPE_CHECKING:
    from app.tracking.cameras.settings import CameraSettings
    from app.tracking.cameras.survey import CameraReport


def register(app: typer.Typer) -> None:
    """Add nothing: this file helps `acus camera show`."""


def report_lines(report: CameraReport) -> list[str]:
    """Return what a camera delivered, a line each, for people."""
    figures = report.figures
    times = {True: "the driver's", False: "of the delivery, less the latency"}
    lines = [
        f"{report.name}: {report.size[0]}x{report.size[1]}, {figures.rate:.1f} pictures/s, "
        f"jitter {1e3 * figures.jitter:.1f} ms, {100.0 * figures.repeated_share:.1f} % repeated",
        f"  brightness {report.brightness:.0f} of 255, "
        f"{100.0 * report.saturated:.1f} % overexposed",
    ]
    if report.driver_time is not None:
        lines.append(
            f"  capture times: {times[report.driver_time]}; {1e3 * report.age:.0f} ms to delivery"
        )
    lines += [f"  {text}" for text in report.settings]
    return lines + [f"  ! {text}" for text in report.advice()]


def colour_line(settings: CameraSettings) -> str:
    """Return which colour of the marker is looked for, for people."""
    colour = settings.marker_colour
    if colour is None:
        return "marker's colour: the usual red (the tracker panel's Learn takes another)"
    blue, green, red = colour.bgr
    return (
        f"marker's colour: learned, red {red:.0f} green {green:.0f} blue {blue:.0f}, within "
        f"{colour.angle_deg:.0f}° (`acus camera use --forget-colour` goes back to the usual red)"
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
        "driver_time": report.driver_time,
        "settings": list(report.settings),
        "advice": list(report.advice()),
    }
