"""USB cameras by the port they are plugged into: two of the same make differ by nothing else.

Linux only: `/sys/class/video4linux` names the port of each video node. A camera has several nodes;
the one with index 0 gives pictures. Elsewhere cameras have numbers only (`usb:0`).
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from app.core.messages import sentence
from app.tracking.errors import CameraError

SYSTEM = Path("/sys/class/video4linux")
DEVICES = Path("/dev")


@dataclass(frozen=True, slots=True)
class CameraPort:
    """A camera that is plugged in.

    Attributes:
        port: of the bus, e.g. `1-1.2`: bus 1, hub port 1, its port 2; what people name it by.
        interface: of the USB device, e.g. `1-1.2:1.0`; one device may hold two cameras.
        node: what to open, e.g. `/dev/video0`.
        title: what it says it is.
        paths: its names in `/dev/v4l/by-path`, which hold across changes of bus numbers too.
    """

    port: str
    interface: str
    node: str
    title: str
    paths: tuple[str, ...] = ()


def camera_ports(system: Path = SYSTEM, devices: Path = DEVICES) -> tuple[CameraPort, ...]:
    """Return the cameras that are plugged in now, sorted by port; opens none."""
    names = _by_path(devices / "v4l" / "by-path")
    found: list[tuple[str, str, str, tuple[str, ...]]] = []
    for entry in system.glob("video*") if system.is_dir() else ():
        if _text(entry / "index") not in ("0", ""):
            continue  # metadata of the same camera
        device = entry / "device"
        interface = device.resolve().name if device.exists() else entry.name
        node = str(devices / entry.name)
        found.append((interface, node, _text(entry / "name"), names.get(entry.name, ())))
    interfaces = [entry[0] for entry in found]
    return tuple(
        CameraPort(_port(interface, interfaces), interface, node, title, paths)
        for interface, node, title, paths in sorted(found)
    )


def find_port(place: str, ports: Sequence[CameraPort]) -> str | int:
    """Return what to open for `usb:PLACE`: a node, or a number where the system has no ports.

    Args:
        place: a port (`1-1.2`), a name in `/dev/v4l/by-path`, a node or a number of one.
        ports: what is plugged in.

    Raises:
        CameraError: if nothing is plugged in there; names what is.
    """
    for port in ports:
        if place in (port.port, port.interface, *port.paths):
            return port.node
    if place.startswith("/dev/") and Path(place).exists():
        return place
    if place.isdecimal():
        if not sys.platform.startswith("linux"):
            return int(place)
        node = f"video{int(place)}"
        match = [port.node for port in ports if Path(port.node).name == node]
        if match:
            return match[0]
    raise CameraError(
        sentence(
            "no camera at usb:{place}; {plugged_in}", place=place, plugged_in=plugged_in(ports)
        )
    )


def plugged_in(ports: Sequence[CameraPort]) -> str:
    """Say which cameras there are."""
    if not ports:
        return sentence("none is plugged in: check the cable, and `acus camera list`")
    return sentence("plugged in are: ") + ", ".join(
        f"usb:{port.port} ({port.title})" for port in ports
    )


def _port(interface: str, interfaces: Sequence[str]) -> str:
    port = interface.partition(":")[0]
    shared = sum(other.partition(":")[0] == port for other in interfaces) > 1
    return interface if shared else port


def _by_path(folder: Path) -> dict[str, tuple[str, ...]]:
    names: dict[str, tuple[str, ...]] = {}
    for link in sorted(folder.iterdir()) if folder.is_dir() else ():
        node = link.resolve().name
        names[node] = (*names.get(node, ()), link.name)
    return names


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace").strip()
    except OSError:
        return ""  # unplugged this moment, or not told by this kernel
