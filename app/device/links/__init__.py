"""Wire protocols and ports; a link brings joint angles in and carries torques out."""

from app.device.links.link import Link
from app.device.links.simulated import SimulatedEncoders, simulated_link

__all__ = ["Link", "SimulatedEncoders", "simulated_link"]
