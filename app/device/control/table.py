"""The loop's table: which compiled functions run in a tick, in order, with their parameters."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

from app.core.arrays import FloatArray
from app.device.control.depth_interval import DepthInterval
from app.device.control.governor import SpeedGovernor
from app.device.control.kinematics import Kinematics
from app.device.control.passivity import PassivityGuard
from app.device.control.protection import protected
from app.device.control.safety import Safety
from app.device.control.transmission import Transmission
from app.device.control.velocity import VelocityMethod, velocity_stage
from app.device.links.link import Link
from app.mechanisms.pantograph import ForceLaw
from app.mechanisms.profile import DeviceProfile


class Stage(NamedTuple):
    """One step of a tick.

    Attributes:
        name: what faults, costs and `acus explain` call it.
        function: compiled with `core.compiled.stage`.
        parameters: its constants and its memory, shape (n,); belongs to this stage of this loop.
    """

    name: str
    function: Any
    parameters: FloatArray


@dataclass(frozen=True, slots=True)
class Table:
    """Stages of a tick in order.

    Attributes:
        compute: everything up to and including safety.
        write: the stages that carry the torques out; run once more at zero torque when a loop ends.
    """

    compute: tuple[Stage, ...]
    write: tuple[Stage, ...] = ()

    @classmethod
    def of(
        cls, compute: Iterable[tuple[str, Any, FloatArray]], write: Iterable[Any] = ()
    ) -> "Table":
        """Build a table from (name, function, parameters) triples."""
        return cls(tuple(Stage(*s) for s in compute), tuple(Stage(*s) for s in write))

    def __iter__(self) -> Iterator[Stage]:
        """All stages in the order of the tick."""
        return iter(self.compute + self.write)

    def __len__(self) -> int:
        """Count the stages of a tick."""
        return len(self.compute) + len(self.write)


def pantograph_stages(
    profile: DeviceProfile,
    laws: Iterable[tuple[str, Any, FloatArray]],
    effects: Iterable[tuple[str, Any, FloatArray]],
    link: Link,
    force_law: ForceLaw = ForceLaw.VIRTUAL_WORK,
    velocity: VelocityMethod | None = None,
    energy_bound: float | None = None,
) -> Table:
    """Table of a needle pantograph: link read, velocity, depth, kinematics, force laws, effects,
    transmission, speed governor, passivity guard, safety, link write.

    Laws and effects stand between two stages that keep all that is not theirs to write.

    Args:
        profile: the robot's numbers.
        laws: force laws such as the virtual fixture, as (name, function, parameters).
        effects: simulated effects, likewise; both add to `FORCE_*`.
        link: where joint angles come from and torques go to.
        force_law: how a force at the hand becomes joint torques.
        velocity: how joint velocities come from encoder angles, if not as the profile says.
        energy_bound: what laws and effects declare to store together [J]; the guard lets no more
            out. None leaves the guard out, for tables whose forces declare nothing.

    Raises:
        DeviceError: if the bound is no finite number of 0 or more.
    """
    guard = [] if energy_bound is None else [PassivityGuard.of(profile, energy_bound).stage()]
    return Table.of(
        [
            *link.read,
            velocity_stage(profile, velocity),
            DepthInterval.of(profile).stage(),
            Kinematics.of(profile).stage(),
            *protected([*laws, *effects]),
            Transmission.of(profile, force_law).stage(),
            SpeedGovernor.of(profile).stage(),
            *guard,
            Safety.of(profile).stage(),
        ],
        link.write,
    )
