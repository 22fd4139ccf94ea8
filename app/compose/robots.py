"""Real robots for the window: where they may be, and one on the bench."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from app.core import state_vector as sv
from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.device.errors import LinkError
from app.mechanisms.profile import DeviceProfile
from app.views.shell.services import RobotPort

if TYPE_CHECKING:
    from app.device.commissioning.bench import Bench

_PATIENCE: Final = 120.0
_LOOK: Final = 0.05


def robot_ports() -> tuple[RobotPort, ...]:
    """Return the serial ports of this computer; opens none."""
    from app.device.links.port import ports

    found = [(port.path, port.description) for port in ports()]
    return tuple(RobotPort(path, f"{said} ({path})" if said else path) for path, said in found)


def open_bench(port: str, profile: DeviceProfile, progress: Progress) -> Bench:
    """Open the robot at a port for commissioning and wait for its first joint angles.

    Raises:
        DeviceError: if nobody answers, somebody else does, or its record cannot be used.
        Cancelled: if `progress` was cancelled; nothing stays open then.
    """
    progress.report(0.1, "loading the routines")
    with ONE_AT_A_TIME:  # kernels: behind the window, not before it
        from app.device.commissioning.bench import Bench
        from app.device.links.serial_link import SerialLink
    progress.report(0.3, "greeting the board")
    bench = Bench(SerialLink(port, profile), profile)
    bench.open()
    try:
        end = bench.clock.now() + _PATIENCE
        while bench.loop.latest().row[sv.Q_TIME] == 0.0:
            progress.report(0.6, "waiting for joint angles")
            if bench.clock.now() > end:
                raise LinkError(
                    f"the robot at {port} was greeted but sends no joint angles; see"
                    f" `acus device test {port}`"
                )
            bench.advance(_LOOK)
    except BaseException:
        bench.close()
        raise
    return bench
