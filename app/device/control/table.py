"""The loop's table: which compiled functions run in a tick, in order, with their parameters.

What force laws and effects cannot change, whatever they write, is all but what is theirs to write.
They may come from anybody: before them the whole state is kept; after them everything but the sums
that they add to and what effects say of the scene is taken from what was kept. Inputs (ENABLED,
FORCE_CAP, HOMED, HEARTBEAT), time, kinematics and the slots of governor, guard and safety are
therefore the loop's own when the stages behind them look. What laws may write goes through all the
limits behind them; a value there that is not finite holds the force at zero.

Stages of a machine that is not the program's own, its simulated plant among them, stand between two
such stages too, and write what `MachineStages` says of each. What they make of the torques that
safety has let through is one share of both, 0 to 1: no larger, and never the other way. What they
ask of cables and winches is finite and within the profile's limits, and winches stand while safety
holds the force at zero.
"""

from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
from math import isfinite
from typing import Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.messages import sentence
from app.core.parameters import Stage
from app.device.control.depth_interval import DepthInterval
from app.device.control.governor import SpeedGovernor
from app.device.control.kinematics import Kinematics
from app.device.control.law import KIND
from app.device.control.passivity import PassivityGuard
from app.device.control.plausibility import Plausibility
from app.device.control.safety import Safety
from app.device.control.transmission import Transmission
from app.device.control.velocity import VelocityMethod, velocity_stage
from app.device.errors import DeviceError
from app.device.links.link import Link
from app.mechanisms.lever import ForceLaw
from app.mechanisms.profile import DeviceProfile
from app.mechanisms.profile.device import is_own
from app.mechanisms.remote_centre import MACHINE_WRITES, MachineStages

_THEIRS: Final = sv.SUMS + sv.SCENE
_SIZE: Final = sv.SLOTS + len(_THEIRS)

SCRATCH: Final = ("keep", "give back")
"""Names of stages whose arrays hold nothing from one tick to the next."""

AROUND_MACHINE: Final = {
    part: (f"keep for {part}", f"give back after {part}") for part in MACHINE_WRITES
}
"""Part of somebody else's machine -> names of the two stages around it, likewise."""


WITHOUT_MEMORY: Final = ("machine", "dynamics")
"""Names of a machine's stages: their arrays are what its profile says, and nothing else."""


SINCE: Final = ("plausibility", "unsteady_hand")
"""Names of stages that older records' tables do not have: their ticks are recomputed without."""


@stage
def keep_stage(state: FloatArray, p: FloatArray) -> None:
    """Keep the state."""
    for slot in range(sv.SLOTS):
        p[slot] = state[slot]


@stage
def give_back_stage(state: FloatArray, p: FloatArray) -> None:
    """Take the state back, but for what laws and effects may write."""
    place = sv.SLOTS
    for slot in _THEIRS:
        p[place] = state[slot]
        place += 1
    for slot in range(sv.SLOTS):
        state[slot] = p[slot]
    place = sv.SLOTS
    for slot in _THEIRS:
        state[slot] = p[place]
        place += 1


@njit
def _give_back_others(state: FloatArray, p: FloatArray) -> None:
    first = sv.SLOTS + 1
    for place in range(first, first + int(p[sv.SLOTS])):
        slot = int(p[place])
        p[slot] = state[slot]
    for slot in range(sv.SLOTS):
        state[slot] = p[slot]


@stage
def give_back_others_stage(state: FloatArray, p: FloatArray) -> None:
    """Take the state back, but for the slots that p names.

    p holds the state, how many slots there are, and their numbers.
    """
    _give_back_others(state, p)


_FORCES: Final = tuple(range(sv.FORCE.start, sv.FORCE.stop)) + tuple(
    range(sv.GUIDE.start, sv.GUIDE.stop)
)
_TOLD: Final = tuple(
    sv.INDEX[name]
    for vector in ("felt", "felt_most", "guidance_limit", "guidance_limited_by", "shortfall")
    for name in sv.slots_named(vector)
)


@njit
def _share(now: float, before: float) -> float:
    """Share of a number that is left of it, 0 to 1; 0 where it has turned round or is NaN."""
    if before == 0.0:
        return 1.0
    share = now / before
    return min(share, 1.0) if share > 0.0 else 0.0


@stage
def give_back_efforts_stage(state: FloatArray, p: FloatArray) -> None:
    """Do as `give_back_others_stage`, and bound what is asked of motors, cables and winches.

    p holds, behind what that stage needs, the largest tension [N] and the fastest speed of reeling
    in [m/s].
    """
    most, fastest = p[len(p) - 2], p[len(p) - 1]
    left, right = p[sv.TORQUE_LEFT], p[sv.TORQUE_RIGHT]
    share = min(_share(state[sv.TORQUE_LEFT], left), _share(state[sv.TORQUE_RIGHT], right))
    state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = share * left, share * right
    for slot in _FORCES:
        state[slot] = _share(state[slot], p[slot]) * p[slot]
    for slot in _TOLD:
        if not isfinite(state[slot]):
            state[slot] = p[slot]
    state[sv.HOLDING] = 1.0 if state[sv.HOLDING] > 0.5 else 0.0
    if not p[sv.SAFETY_SCALE] > 0.0:
        fastest = 0.0
    for k in range(4):
        tension, rate = state[sv.TENSION_1 + k], state[sv.REEL_RATE_1 + k]
        state[sv.TENSION_1 + k] = min(max(tension, 0.0), most) if isfinite(tension) else 0.0
        state[sv.REEL_RATE_1 + k] = min(max(rate, -fastest), fastest) if isfinite(rate) else 0.0
    _give_back_others(state, p)


def protected(stages: Iterable[Stage]) -> list[Stage]:
    """Return laws and effects between the two stages, which share one array; none stay none."""
    inner = list(stages)
    memory = np.zeros(_SIZE)
    keep, back = (
        Stage(name, function, memory)
        for name, function in zip(SCRATCH, (keep_stage, give_back_stage), strict=True)
    )
    return [keep, *inner, back] if inner else []


def _guarded(part: str, stages: Iterable[Stage], profile: DeviceProfile) -> list[Stage]:
    """Return stages of a machine; somebody else's between two that keep what is not theirs."""
    inner = list(stages)
    if not inner or is_own(profile.kind):
        return inner
    theirs, back = sorted(MACHINE_WRITES[part]), give_back_others_stage
    limits: list[float] = []
    if part == "efforts":
        _, most = profile.tension_range or (0.0, 0.0)
        limits, back = [most, profile.fastest_reel], give_back_efforts_stage
        if not all(isfinite(limit) and limit >= 0.0 for limit in limits):
            raise DeviceError(
                sentence(
                    "device {profile_name}: its largest tension is {most} N and its fastest reel"
                    " {profile_fastest_reel} m/s; give finite numbers of 0 or more",
                    profile_name=profile.name,
                    most=most,
                    profile_fastest_reel=profile.fastest_reel,
                )
            )
    memory = np.concatenate([np.zeros(sv.SLOTS), [len(theirs)], theirs, limits])
    before, after = AROUND_MACHINE[part]
    return [Stage(before, keep_stage, memory), *inner, Stage(after, back, memory)]


def _guarded_plant(stages: Iterable[Stage], profile: DeviceProfile) -> list[Stage]:
    """Return a link's write stages, with what moves somebody else's simulated machine guarded."""
    return [
        guarded
        for stage in (Stage(*given) for given in stages)
        for guarded in (_guarded("plant", [stage], profile) if stage.name == "plant" else [stage])
    ]


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
    def of(cls, compute: Iterable[Stage], write: Iterable[Stage] = ()) -> "Table":
        """Build a table from (name, function, parameters) triples."""
        return cls(tuple(Stage(*s) for s in compute), tuple(Stage(*s) for s in write))

    def continued(
        self, fresh: "Table", changed: Collection[str] = ()
    ) -> tuple["Table", tuple[tuple[Stage, Stage], ...]]:
        """Return `fresh` with the memory of this table, so that a run can go on with it.

        A stage of one name, one function and one length of array in both keeps its array, unless
        `changed` names it.

        Args:
            fresh: the table to go on with.
            changed: names of stages that begin anew although they look the same.

        Returns:
            The table; and of stages of one name whose array is not kept, the old and the new one.
        """
        old = {stage.name: stage for stage in self}
        ended: list[tuple[Stage, Stage]] = []

        def kept(stage: Stage) -> Stage:
            before = old.get(stage.name)
            if before is None:
                return stage
            same = before.function is stage.function or before.function == stage.function
            if (
                same
                and stage.name not in changed
                and len(before.parameters) == len(stage.parameters)
            ):
                return before
            ended.append((before, stage))
            return stage

        compute = tuple(kept(stage) for stage in fresh.compute)
        return Table(compute, tuple(kept(stage) for stage in fresh.write)), tuple(ended)

    def __iter__(self) -> Iterator[Stage]:
        """All stages in the order of the tick."""
        return iter(self.compute + self.write)

    def __len__(self) -> int:
        """Count the stages of a tick."""
        return len(self.compute) + len(self.write)


def judged(link: Link, profile: DeviceProfile, corrections: Iterable[Stage]) -> list[Stage]:
    """Return a link's read stages, the judgement of what they read, and its corrections."""
    test = [Plausibility.of(profile).stage()] if link.read else []
    return [*link.read, *test, *corrections]


_DYNAMICS: Final = frozenset(
    name
    for vector in ("mass", "bias", "drift", "weight", "links_potential")
    for name in sv.slots_named(vector)
)
"""Slots that a machine's stage of its dynamics writes; computed only where a law reads one."""


def _dynamics(machine: MachineStages, laws: Iterable[Stage], device: str) -> list[Stage]:
    """Return the machine's stage of its dynamics if one of these laws reads what it writes."""
    known = KIND.names()
    readers = [
        law.name
        for law in laws
        if law.name in known and not _DYNAMICS.isdisjoint(KIND.find(law.name).reads)
    ]
    if not readers:
        return []
    if machine.dynamics is None:
        raise DeviceError(
            sentence(
                "law {law_name!r} needs the dynamics of the machine, and {device} states none",
                law_name=readers[0],
                device=device,
            )
        )
    return [machine.dynamics]


def machine_stages(
    profile: DeviceProfile,
    laws: Iterable[Stage],
    effects: Iterable[Stage],
    link: Link,
    force_law: ForceLaw = ForceLaw.VIRTUAL_WORK,
    velocity: VelocityMethod | None = None,
    energy_bound: float | None = None,
    before: Iterable[Stage] = (),
    corrections: Iterable[Stage] = (),
) -> Table:
    """Table of a machine that points a needle: link read, plausibility of what was read, velocity,
    depth, the machine's pose, kinematics, its dynamics where a law reads them, force laws, effects,
    transmission, speed governor, passivity guard, safety, the machine's efforts, link write.

    Laws and effects stand between two stages that keep all that is not theirs to write. A link
    without read stages is a record's: what it was given was judged when it was read.

    Args:
        profile: the robot's numbers.
        laws: force laws such as the virtual fixture, as (name, function, parameters).
        effects: simulated effects, likewise; both add to `FORCE_*`.
        link: where joint angles come from and torques go to.
        force_law: how a force at the hand becomes joint torques.
        velocity: how joint velocities come from encoder angles, if not as the profile says.
        energy_bound: what laws and effects declare to store together [J]; the guard lets no more
            out. None leaves the guard out, for tables whose forces declare nothing.
        before: stages before the link's: whoever moves the needle.
        corrections: of what the link reads, on readings that are believed.

    Raises:
        DeviceError: if the bound is no finite number of 0 or more, a law needs dynamics that the
            machine does not state, or somebody else's machine has a stage of a name that another
            has (memory goes from table to table by names), or no finite limits of its cables.
    """
    machine, laws = profile.machine.stages(), [Stage(*law) for law in laws]
    guard = [] if energy_bound is None else [PassivityGuard.of(profile, energy_bound).stage()]
    table = Table.of(
        [
            *before,
            *judged(link, profile, corrections),
            velocity_stage(profile, velocity),
            DepthInterval.of(profile).stage(),
            *_guarded("pose", [machine.pose], profile),
            *_guarded("watch", machine.watch, profile),
            Kinematics.of(profile).stage(),
            *_guarded("dynamics", _dynamics(machine, laws, profile.name), profile),
            *protected([*laws, *effects]),
            Transmission.of(profile, force_law).stage(),
            SpeedGovernor.of(profile).stage(),
            *guard,
            Safety.of(profile).stage(),
            *_guarded("efforts", machine.efforts, profile),
        ],
        _guarded_plant(link.write, profile),
    )
    if not is_own(profile.kind):
        names = [stage.name for stage in table]
        theirs = [machine.pose, *machine.watch, *filter(None, [machine.dynamics]), *machine.efforts]
        for name in (stage.name for stage in theirs if names.count(stage.name) > 1):
            raise DeviceError(
                sentence(
                    "machine {profile_kind!r}: its stage is named {name!r}, and so is another of "
                    "the loop; give it a name of its own",
                    profile_kind=profile.kind,
                    name=name,
                )
            )
    return table
