"""A run of the tick with `core.state_vector` in another order of lines, without compiling.

Run as a program with `NUMBA_DISABLE_JIT=1`: reads orders (lists of slot names, as JSON) from
standard input; writes for each a digest of the run by slot name, or why it was refused.
"""

import hashlib
import json
import random
import re
import sys
import types
import warnings
from pathlib import Path

SOURCE = Path(__file__).parents[2] / "app" / "core" / "state_vector.py"
COUNTED = re.compile(
    r"^([A-Z][A-Z0-9_]*): Final = (?:next\(_next\)|_(?:input|sum|scene|machine)\(\)).*$", re.M
)
PART = re.compile(r"(?:(?<=J)_[XY][LR]|_?[XYZ]|_LEFT|_CROSS|_RIGHT|_[1-4])$")
TICKS = 40


def slots() -> list[str]:
    """Names of the slots in the order of their lines."""
    return [name for name in COUNTED.findall(SOURCE.read_text()) if name not in ("SLOTS", "INPUTS")]


def inputs() -> set[str]:
    """Names of the inputs: those above INPUTS."""
    return set(COUNTED.findall(SOURCE.read_text().split("\nINPUTS:")[0]))


def groups(names: list[str]) -> list[list[str]]:
    """Slots that stand together as the parts of a vector."""
    found: list[list[str]] = []
    for name in names:
        if found and PART.sub("", name) == PART.sub("", found[-1][0]):
            found[-1].append(name)
        else:
            found.append([name])
    return found


def shuffled(seed: int) -> list[str]:
    """Another order that keeps vectors together and inputs first."""
    rng, names, given = random.Random(seed), slots(), inputs()
    halves = [groups([n for n in names if (n in given) == first]) for first in (True, False)]
    for half in halves:
        rng.shuffle(half)
    return [name for half in halves for group in half for name in group]


def moved(name: str, before: str) -> list[str]:
    """The order with one line moved above another."""
    names = [n for n in slots() if n != name]
    names.insert(names.index(before), name)
    return names


def source_of(order: list[str]) -> str:
    """The file with its lines of slots in another order; all else stays where it is."""
    text = SOURCE.read_text()
    lines = {m[1]: m[0] for m in COUNTED.finditer(text) if m[1] in set(order)}
    following = iter(order)
    return COUNTED.sub(lambda m: lines[next(following)] if m[1] in lines else m[0], text)


def run(order: list[str]) -> str:
    """Digest of some ticks of guidance, tissue and a NaN, by slot name; or the refusal."""
    for name in [n for n in sys.modules if n == "app" or n.startswith("app.")]:
        del sys.modules[name]
    import app.core

    sv = types.ModuleType("app.core.state_vector")
    try:
        exec(compile(source_of(order), str(SOURCE), "exec"), sv.__dict__)
    except ImportError as refusal:
        return f"refused: {refusal}"
    sys.modules[sv.__name__] = app.core.state_vector = sv  # type: ignore[attr-defined]
    digest = hashlib.sha256()
    for row in _ticks(sv):
        for name in sorted(sv.INDEX):
            digest.update(float(row[sv.INDEX[name]]).hex().encode())
    return digest.hexdigest()


def _ticks(sv):
    from app.device.control import laws, machine_stages
    from app.device.links.simulated import simulated_link
    from app.mechanisms.profile import load_profile
    from app.simulation.consumers import Consumer, DevicePort
    from app.simulation.plan import compile as compile_scene
    from app.simulation.plant import initial_plant, plant_stage
    from app.simulation.scene import EffectRequest, Scene
    from app.simulation.trainee import trainee_stage

    laws.check_step = lambda module, law: None  # nothing is compiled here
    profile, axis = load_profile("icube"), (0.25, -0.15, -0.9)
    effects = tuple(EffectRequest(n) for n in ("lateral_tissue", "shaft_friction", "breathing"))
    port = DevicePort(profile.name, frozenset(a.value for a in profile.renders), simulated=True)
    plan = compile_scene(
        Scene(effects=effects), port, views=(Consumer("view of the target", ("target_shift_x",)),)
    )
    requests = {"fixture": {}, "cone_wall": {}, "impedance": {}, "compensation": {}}
    stages = machine_stages(
        profile,
        laws.stages_of(requests, profile),
        plan.stages(),
        simulated_link(profile, [plant_stage(profile, (0.0, 0.0, -1.0), 0.02)]),
        energy_bound=laws.energy_bound(requests, profile) + plan.energy_bound(),
    )
    state = sv.empty_state()
    for name, value in initial_plant(profile, (0.0, 0.0, -1.0), 0.02).items():
        state[sv.INDEX[name]] = value
    state[sv.PATH_X], state[sv.PATH_Y], state[sv.PATH_Z] = axis
    state[sv.HOMED], state[sv.FORCE_CAP], state[sv.ARMING] = 1.0, 5.0, 1.0
    state[sv.ASSISTANCE], state[sv.ENABLED], state[sv.DT] = 1.0, 1.0, 1e-3
    table = [trainee_stage(axis, 0.08, "novice", 3), *stages]
    for k in range(TICKS):
        state[sv.TIME] = state[sv.HEARTBEAT] = 10.0 + 1e-3 * k
        state[sv.TICK] = k
        state[sv.TRACKED_DEPTH], state[sv.TRACKED_TIME] = state[sv.PLANT_DEPTH], state[sv.TIME]
        kept = state[sv.ASSISTANCE]
        if k == TICKS - 5:
            state[sv.ASSISTANCE] = float("nan")
        for _, function, parameters in table:
            function(state, parameters)
        state[sv.ASSISTANCE] = kept
        yield state


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    print(json.dumps([run(order) for order in json.load(sys.stdin)]))
