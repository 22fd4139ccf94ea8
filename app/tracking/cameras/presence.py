"""Whether what a source names is there now: asked when it is chosen, not only when it is opened."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from app.tracking.cameras.ports import CameraPort, find_port
from app.tracking.cameras.source import Kind, parse_source
from app.tracking.errors import CameraError


def missing(source: str, ports: Sequence[CameraPort]) -> str:
    """Say that what a source names is not there now, and what is; empty if it is.

    Args:
        source: as `parse_source` takes it.
        ports: cameras that are plugged in.

    Raises:
        CameraError: if it has another form.
    """
    origin = parse_source(source)
    if origin.kind is Kind.USB:
        try:
            find_port(origin.place, ports)
        except CameraError as error:
            return str(error)
    if origin.kind is Kind.FOLDER and not Path(origin.place).is_dir():
        return f"there is no folder {origin.place}"
    if origin.kind is Kind.VIDEO and not Path(origin.place).is_file():
        return f"there is no video {origin.place}"
    return ""
