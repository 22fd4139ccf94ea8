"""A real robot, connected: its link, what is known of it, and how much force it is cleared for.
For the window: where robots may be, and one on the bench.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from app.core import state_vector as sv
from app.core.loading import ONE_AT_A_TIME
from app.core.messages import sentence
from app.core.progress import Progress
from app.device.commissioning.records import load_record
from app.device.control.corrections import Corrections
from app.device.errors import LinkError
from app.device.links.inverse3 import robot_link
from app.device.links.inverse_service import PREFIX, answering, refuse_inverse3
from app.device.links.link import DeviceLink
from app.device.readiness import ForceClearance, Readiness
from app.mechanisms.profile import DeviceProfile
from app.views.shell.services import RobotPort

if TYPE_CHECKING:
    from app.device.commissioning.bench import Bench


_PATIENCE: Final = 120.0
_LOOK: Final = 0.05
_ANSWERS: Final = 1.0


def robot_ports() -> tuple[RobotPort, ...]:
    """Return the serial ports of this computer; opens none."""
    from app.device.links.port import ports

    found = [(port.path, port.description) for port in ports()]
    return tuple(RobotPort(path, f"{said} ({path})" if said else path) for path, said in found)


def served_robots() -> tuple[RobotPort, ...]:
    """Return the Inverse3 of this computer's Haply service, if it answers; waits for that."""
    device = answering(_ANSWERS)
    if device is None:
        return ()
    return (RobotPort(PREFIX, " ".join(filter(None, ("Haply Inverse3", device, f"({PREFIX})")))),)


def open_bench(port: str, profile: DeviceProfile, progress: Progress) -> Bench:
    """Open the robot at a port for commissioning and wait for its first joint angles.

    Raises:
        DeviceError: if nobody answers, somebody else does, its record cannot be used, or it is an
            Inverse3.
        Cancelled: if `progress` was cancelled; nothing stays open then.
    """
    refuse_inverse3(port)
    progress.report(0.1, sentence("loading the routines"))
    with ONE_AT_A_TIME:  # kernels: behind the window, not before it
        from app.device.commissioning.bench import Bench
        from app.device.links.serial_link import SerialLink
    progress.report(0.3, sentence("greeting the board"))
    bench = Bench(SerialLink(port, profile), profile)
    bench.open()
    try:
        end = bench.clock.now() + _PATIENCE
        while bench.loop.latest().row[sv.Q_TIME] == 0.0:
            progress.report(0.6, sentence("waiting for joint angles"))
            if bench.clock.now() > end:
                raise LinkError(
                    sentence(
                        "the robot at {port} was greeted but sends no joint angles; see"
                        " `acus device test {port}`",
                        port=port,
                    )
                )
            bench.advance(_LOOK)
    except BaseException:
        bench.close()
        raise
    return bench


@dataclass(frozen=True, slots=True)
class Robot:
    """A robot whose link is open.

    Attributes:
        link: to the robot.
        profile: its numbers.
        corrections: of its encoders and its gauge, from its record.
        readiness: what has been commissioned on it.
    """

    link: DeviceLink
    profile: DeviceProfile
    corrections: Corrections
    readiness: Readiness

    @classmethod
    def connect(cls, link: DeviceLink, profile: DeviceProfile) -> Robot:
        """Open a link and read the record of who answers.

        Raises:
            LinkError: if nobody answers, or somebody else.
            RecordError: if the device's record is damaged.
        """
        link.open()
        try:
            record = load_record(link.info())
        except BaseException:
            link.close()
            raise
        corrections = Corrections(record.offsets(link.info().boot), record.gauge())
        return cls(link, profile, corrections, record.readiness())

    def clearance(self) -> ForceClearance:
        """Return how much force the robot is cleared for now; another power cycle takes it away."""
        return self.readiness.clearance(self.link.info(), self.profile)

    def metadata(self) -> dict[str, str]:
        """Facts of the robot for the head of a record."""
        info, clearance = self.link.info(), self.clearance()
        return {
            "name": self.profile.name,
            "simulated": "yes" if info.simulated else "no",
            "kind": info.kind,
            "serial": info.serial,
            "boot": str(info.boot),
            "firmware": info.firmware,
            "protocol": info.protocol,
            "force_cap": f"{clearance.force_cap:g}",
            "clearance": clearance.reason or "full",
        }

    def close(self) -> None:
        """Let go of the robot, after its loop has ended at zero torque; idempotent."""
        self.link.close()


def connect(port: str | None, profile: DeviceProfile) -> Robot | None:
    """Connect to the robot on a serial port, or at a Haply service; None without one.

    Raises:
        LinkError: if the port cannot be used or nobody answers; says what to do.
        RecordError: if the device's record is damaged.
    """
    return Robot.connect(robot_link(port, profile), profile) if port is not None else None
