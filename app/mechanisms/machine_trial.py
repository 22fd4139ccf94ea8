"""The trial of a machine, in a process of its own: see `core.trial`.

Its compiled stages get all states, its pose and dynamics odd joint angles.
"""

import json
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import is_stage
from app.core.errors import AcusError, ConfigurationError
from app.core.parameters import StageFunction
from app.core.trial_states import ODD, STATES, StageTrial
from app.core.trial_watch import CALL, Watch
from app.mechanisms import hand_motion, needle_motion
from app.mechanisms.profile import DeviceProfile, parse_profile
from app.mechanisms.profile.device import LONGEST_NEEDLE, untried_machine
from app.mechanisms.remote_centre import MACHINE_WRITES, MachinePose, RemoteCentre

_POSES: Final = 1000


def run(path: Path, argument: str, watch: Watch) -> dict[str, Any]:
    """Try the machine of a file with a profile of its kind, as JSON; see `core.trial.Trial`."""
    profile = parse_profile(json.loads(argument), str(path))
    watch.doing("machine()", CALL)
    machines = [untried_machine(mounted) for mounted in _mounted(profile)]
    if reason := _poses(path, machines[0], watch):
        return {"reason": reason}
    reason = ""
    for name, (function, arrays) in _stages(profile, machines, watch).items():
        if not is_stage(function):
            return {
                "reason": f"{path}: its stage {name!r} is not compiled; put @stage of core.compiled"
                " before it"
            }
        what, writes = f"its stage {name!r}", MACHINE_WRITES[name.split()[0]]
        reason = reason or StageTrial(path, what, function, arrays, writes, watch).reason()
    return {"reason": reason, "states": STATES}


def _mounted(profile: DeviceProfile) -> Iterator[DeviceProfile]:
    """Yield the profile as it is, and with each joint, the shortest and the longest needle."""
    yield profile
    for joint in profile.workspace.tilt_limit_deg:
        yield profile.with_joint(joint)
    for length in (1.01 * profile.shortest_needle, 0.99 * LONGEST_NEEDLE):
        with suppress(ConfigurationError):
            yield profile.with_needle(length)


def _stages(
    profile: DeviceProfile, machines: list[RemoteCentre], watch: Watch
) -> dict[str, tuple[StageFunction, list[FloatArray]]]:
    """Return the machine's stages by name, each with the arrays that it may get."""
    watch.doing("stages()", CALL)
    found: dict[str, tuple[StageFunction, list[FloatArray]]] = {}

    def add(name: str, function: StageFunction, array: FloatArray) -> None:
        numbers = np.ascontiguousarray(array, dtype=np.float64)
        found.setdefault(name, (function, []))[1].append(numbers)

    for machine in machines:
        stages = machine.stages()
        add("pose", stages.pose.function, stages.pose.parameters)
        if stages.dynamics is not None:
            add("dynamics", stages.dynamics.function, stages.dynamics.parameters)
        for part, several in (("watch", stages.watch), ("efforts", stages.efforts)):
            for k, stage in enumerate(several):
                add(f"{part} {k + 1}", stage.function, stage.parameters)
        add("plant", stages.plant, np.concatenate([_hand(profile), stages.plant_values]))
    return found


def _hand(profile: DeviceProfile) -> FloatArray:
    """Return what stands before a plant's own numbers: a needle, a hand that holds it, its bounds.

    `simulation.plant` makes it of a scene; here any plausible numbers do.
    """
    array = np.full(needle_motion.OWN, 0.1)
    at = needle_motion.AT
    array[at.length] = profile.needle_length
    array[[at.fx, at.fy, at.fz]] = profile.geometry.fulcrum
    array[at.hand_k], array[at.hand_most] = 200.0, 10.0
    array[at.depth_min], array[at.depth_max] = profile.depth_range
    array[[at.start_left, at.start_right]] = 1.0, 2.0
    array[[at.gx, at.gy, at.gz]] = profile.mounting.gravity
    array[needle_motion.MOTION + hand_motion.AT.held :] = 0.0
    return array


def _poses(path: Path, machine: RemoteCentre, watch: Watch) -> str:
    """Ask for poses and dynamics at odd joint angles; return what is wrong, or nothing."""
    rng = np.random.default_rng(3)
    for k in range(_POSES):
        q = rng.uniform(-np.pi, np.pi, 2) if k % 2 else rng.choice(ODD, 2)
        qd = rng.normal(size=2) if k % 3 else rng.choice(ODD, 2)
        watch.doing(f"pose({q.tolist()})", CALL)
        try:
            pose = machine.pose(q)
        except Exception as error:
            return (
                f"{path}: pose({q.tolist()}) raises {type(error).__name__}: {error}; say by its"
                " status that there is none (trial)"
            )
        if (
            not isinstance(pose, MachinePose)
            or not np.isfinite([*pose.axis, *pose.jacobian.flat]).all()
        ):
            return (
                f"{path}: pose({q.tolist()}) is {pose!r}; give a MachinePose of finite numbers"
                " (trial)"
            )
        watch.doing(f"dynamics({q.tolist()}, {qd.tolist()}, 0.05)", CALL)
        with suppress(AcusError):
            machine.jacobian_rate(q, qd)
            machine.dynamics(q, qd, 0.05)
    return ""
