"""The tick of a robot that is being commissioned: no force law, only the service stage."""

from app.device.control.corrections import Corrections
from app.device.control.depth_interval import DepthInterval
from app.device.control.governor import SpeedGovernor
from app.device.control.kinematics import Kinematics
from app.device.control.safety import Safety
from app.device.control.service import Service
from app.device.control.table import Table
from app.device.control.transmission import Transmission
from app.device.control.velocity import VelocityFilter
from app.device.links.link import Link
from app.mechanisms.profile import DeviceProfile


def commissioning_table(
    profile: DeviceProfile, link: Link, corrections: Corrections | None = None
) -> Table:
    """Table of a tick: link read, corrections, velocity, kinematics, service, transmission,
    speed governor, safety, link write.

    Args:
        profile: the robot's numbers.
        link: the robot's two ends.
        corrections: of its encoders and gauge; nothing is corrected by default.
    """
    return Table.of(
        [
            *link.read,
            (corrections or Corrections()).stage(),
            VelocityFilter().stage(),
            DepthInterval.of(profile).stage(),
            Kinematics.of(profile).stage(),
            Service().stage(),
            Transmission.of(profile).stage(),
            SpeedGovernor.of(profile).stage(),
            Safety.of(profile).stage(),
        ],
        link.write,
    )
