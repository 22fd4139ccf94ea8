"""Wire protocols and ports; a link brings joint angles in and carries torques out."""

from app.device.links.link import BoardInfo, DeviceLink, Link, LinkStatus
from app.device.links.simulated import SimulatedEncoders, SimulatedLink, simulated_link

__all__ = [
    "BoardInfo",
    "DeviceLink",
    "Link",
    "LinkStatus",
    "SimulatedEncoders",
    "SimulatedLink",
    "simulated_link",
]
