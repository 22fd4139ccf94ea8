"""Needles pushed in as somebody else's experiment did: the effects, driven along its protocol.

The needle goes straight along a motion of its tip at 1 kHz, through one tissue; what the effects
add to AXIAL_FORCE is what a load cell at its hub would read. An experiment is a function of values
of tissues and a protocol, gauges as such, speeds in mm/s, depths in mm, that gives one number in
the unit that its case names.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from math import cos
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.simulation import tissues
from app.simulation.clearing import clear
from app.simulation.effects import declaration, load, parameters_of
from app.simulation.needles import OUTER_DIAMETER
from app.simulation.scene import Binding, Needle, Scene, TissueLayer

ALONG: Final = ("puncture", "relaxation", "cutting", "shaft_friction")
"""Effects along the needle, in an order in which each finds what it reads."""

TICK: Final = 1e-3  # [s]

Protocol = Mapping[str, Any]
Layers = tuple[TissueLayer, ...]


class DrivenNeedle(NamedTuple):
    """What came of a motion, tick by tick: each effect's force [N], and what the state held."""

    depth: FloatArray
    force: Mapping[str, FloatArray]
    punctures: FloatArray
    indentation: FloatArray

    @property
    def total(self) -> FloatArray:
        """Return all forces together [N], shape (n,)."""
        return np.sum(list(self.force.values()), axis=0)

    @property
    def rupture(self) -> int:
        """Return the tick in which the first membrane gives way; the last if none does."""
        torn = np.flatnonzero(self.punctures > 0.0)
        return int(torn[0]) if len(torn) else len(self.depth) - 1


def ramp(begin_mm: float, end_mm: float, speed_mm_s: float) -> FloatArray:
    """Return depths [m], one a tick, from a depth to another at a speed."""
    ticks = max(round(abs(end_mm - begin_mm) / speed_mm_s / TICK), 1)
    return np.linspace(begin_mm, end_mm, ticks + 1)[1:] * MILLIMETRE


def insert(version: str, layers: Layers, gauge: int, depths: FloatArray) -> DrivenNeedle:
    """Move the tip of a needle through depths [m], one a tick, in tissue.

    Args:
        version: whose models compute it, a key of `simulation.tissues.MODELS`.
        layers: from depth 0 on.
        gauge: of the needle.
        depths: of its tip, shape (n,).
    """
    scene = Scene(layers=layers, needle=Needle(outer_diameter=OUTER_DIAMETER[gauge]))
    stages = []
    for name in ALONG:
        declared = declaration(name)
        model = declared.model(tissues.MODELS[version].get(name, ""))
        binding = Binding(scene, sv.PLANT_DEPTH, model)
        array = parameters_of(name, declared.checked({}), binding)
        stages.append((name, load(declared).step, array))
    state, none = sv.empty_state(), np.zeros(1)
    state[sv.AXIS_Z], state[sv.DT] = -1.0, TICK
    force = {name: np.empty(len(depths)) for name in ALONG}
    punctures, indentation = np.empty(len(depths)), np.empty(len(depths))
    for tick, depth in enumerate(depths):
        clear(state, none)
        state[sv.PLANT_DEPTH] = state[sv.DEPTH] = depth
        before = 0.0
        for name, step, array in stages:
            step(state, array)
            force[name][tick] = state[sv.AXIAL_FORCE] - before
            before = state[sv.AXIAL_FORCE]
        punctures[tick], indentation[tick] = state[sv.PUNCTURES], state[sv.INDENTATION]
    return DrivenNeedle(depths, force, punctures, indentation)


def _tissue(version: str, protocol: Protocol) -> TissueLayer:
    """Return the tissue 200 mm thick; what a version lacks is its liver."""
    return _layer(version, protocol["tissue"], 200.0)


def _layer(version: str, name: str, thickness_mm: float) -> TissueLayer:
    name = name if name in tissues.TISSUES[version] else "liver"
    return replace(tissues.tissue(name, version), thickness=thickness_mm * MILLIMETRE)


def _straight(version: str, protocol: Protocol, depth_mm: float, **changed: Any) -> DrivenNeedle:
    """Push in from the surface to a depth, as the protocol says or as `changed` does."""
    of = {**protocol, **changed}
    depths = ramp(0.0, depth_mm, of["speed_mm_s"])
    return insert(version, (_tissue(version, of),), int(of["gauge"]), depths)


DEEP: Final = 40.0
"""To where a membrane is pushed [mm]: each gives way before."""


def puncture_peak(version: str, protocol: Protocol) -> float:
    """Return the largest whole force until the membrane gives way [N]."""
    found = _straight(version, protocol, DEEP)
    return float(found.total[: found.rupture].max())


def puncture_share(version: str, protocol: Protocol) -> float:
    """Return the same over the force that is stated."""
    return puncture_peak(version, protocol) / _tissue(version, protocol).puncture_force


def puncture_by_speed(version: str, protocol: Protocol) -> float:
    """Return the same, at the speed over that at the slow one."""
    slow = {**protocol, "speed_mm_s": protocol["slow_mm_s"]}
    return puncture_peak(version, protocol) / puncture_peak(version, slow)


def dimple_by_speed(version: str, protocol: Protocol) -> float:
    """Return how far the tip has pushed in when the membrane gives way, fast over slow."""
    ways = []
    for speed in (protocol["speed_mm_s"], protocol["slow_mm_s"]):
        found = _straight(version, protocol, DEEP, speed_mm_s=speed)
        ways.append(found.indentation[found.rupture - 1])
    return float(ways[0] / ways[1])


def second_cut(version: str, protocol: Protocol) -> float:
    """Return cutting in the second insertion at one place over that in the first, at a depth."""
    depth, speed = protocol["depth_mm"], protocol["speed_mm_s"]
    once = ramp(0.0, depth, speed)
    path = np.concatenate([once, ramp(depth, -1.0, speed), ramp(-1.0, depth, speed)])
    found = insert(version, (_tissue(version, protocol),), int(protocol["gauge"]), path)
    late = len(once) - int(np.searchsorted(once, protocol["at_mm"] * MILLIMETRE))
    cut = found.force["cutting"]
    return float(cut[-late] / cut[len(once) - late])


def toughness(version: str, protocol: Protocol) -> float:
    """Return it [J/m²]."""
    return _tissue(version, protocol).toughness


def young_modulus(version: str, protocol: Protocol) -> float:
    """Return Young's modulus that the side stiffness of 18 G is [kPa]."""
    return tissues.MODULUS_PER_STIFFNESS * _tissue(version, protocol).side_stiffness / 1e3


def friction_before_puncture(version: str, protocol: Protocol) -> float:
    """Return the largest friction until the membrane gives way [N]."""
    found = _straight(version, protocol, DEEP)
    return float(np.abs(found.force["shaft_friction"][: found.rupture]).max())


def friction_slope(version: str, protocol: Protocol) -> float:
    """Return friction a length, between 40 and 80 mm [N/m]."""
    found = _straight(version, protocol, 80.0)
    friction, half = found.force["shaft_friction"], len(found.depth) // 2
    return float((friction[-1] - friction[half - 1]) / (40.0 * MILLIMETRE))


def friction_by_speed(version: str, protocol: Protocol) -> float:
    """Return friction a length, at the speed over that at the slow one."""
    slow = {**protocol, "speed_mm_s": protocol["slow_mm_s"]}
    return friction_slope(version, protocol) / friction_slope(version, slow)


def friction_by_gauge(version: str, protocol: Protocol) -> float:
    """Return friction at a depth, of the gauge over that of the one that it is held against."""
    depth = protocol["depth_mm"]
    thin = _straight(version, protocol, depth)
    thick = _straight(version, protocol, depth, gauge=protocol["against_gauge"])
    return float(thin.force["shaft_friction"][-1] / thick.force["shaft_friction"][-1])


def force_at_depth(version: str, protocol: Protocol) -> float:
    """Return the whole force at a depth [N]."""
    return float(_straight(version, protocol, protocol["depth_mm"]).total[-1])


def tip_force(version: str, protocol: Protocol) -> float:
    """Return what of it is not friction [N]."""
    found = _straight(version, protocol, protocol["depth_mm"])
    return float(found.total[-1] - found.force["shaft_friction"][-1])


def friction_share(version: str, protocol: Protocol) -> float:
    """Return friction over the whole force at a depth."""
    found = _straight(version, protocol, protocol["depth_mm"])
    return float(found.force["shaft_friction"][-1] / found.total[-1])


def cutting_share(version: str, protocol: Protocol) -> float:
    """Return cutting over the whole force at a depth."""
    found = _straight(version, protocol, protocol["depth_mm"])
    return float(found.force["cutting"][-1] / found.total[-1])


def held_share(version: str, protocol: Protocol) -> float:
    """Return the force after a rest over that after its first 10 ms."""
    way = ramp(0.0, protocol["depth_mm"], protocol["speed_mm_s"])
    path = np.concatenate([way, np.full(round(protocol["hold_s"] / TICK), way[-1])])
    total = insert(version, (_tissue(version, protocol),), int(protocol["gauge"]), path).total
    return float(total[-1] / total[len(way) + 9])


def wall_slope(version: str, protocol: Protocol) -> float:
    """Return the slope of the whole force over the depth, through a wall into an organ [N/cm]."""
    wall = (("skin", 2.0), ("fat", 20.0), ("muscle", 20.0), (protocol["tissue"], 200.0))
    layers = tuple(_layer(version, name, thickness_mm) for name, thickness_mm in wall)
    depths = ramp(0.0, protocol["depth_mm"], protocol["speed_mm_s"])
    total = insert(version, layers, int(protocol["gauge"]), depths).total
    return float(np.polyfit(depths, total, 1)[0]) / 100.0


def curvature(version: str, protocol: Protocol) -> float:
    """Return the curvature of the path of a bevelled tip [1/m], as the effect turns its tip."""
    gauge, medium = int(protocol["gauge"]), str(protocol["medium"])
    model = medium if "bevel" in tissues.MODELS[version] else ""
    scene = Scene(needle=Needle(outer_diameter=OUTER_DIAMETER[gauge]))
    declared = declaration("bevel")
    array = parameters_of("bevel", declared.checked({}), Binding(scene, model=model))
    state, depth = sv.empty_state(), 0.08
    state[sv.AXIS_Z], state[sv.DEPTH], state[sv.DEPTH_SOURCE] = -1.0, depth, 1.0
    load(declared).step(state, array)
    slope = float(np.linalg.norm(state[sv.TIP_SLOPE][:2]))
    return float(np.arcsin(slope)) / depth


def deflection(version: str, protocol: Protocol) -> float:
    """Return how far the tip lies beside its line at a depth [mm]: (1 - cos κL) / κ."""
    bent = curvature(version, protocol)
    return (1.0 - cos(bent * protocol["depth_mm"] * MILLIMETRE)) / bent / MILLIMETRE


def deflection_by_gauge(version: str, protocol: Protocol) -> float:
    """Return the same, of the gauge over that of the one that it is held against."""
    other = {**protocol, "gauge": protocol["against_gauge"]}
    return deflection(version, protocol) / deflection(version, other)


def breath_rest(_: str, protocol: Protocol) -> float:
    """Return the share of one breath in which the target is near its place at the end of it."""
    amplitude = protocol["amplitude_mm"] * MILLIMETRE
    given = dict.fromkeys(("anterior_posterior", "left_right"), 0.0)
    declared = declaration("breathing")
    values = declared.checked({**given, "superior_inferior": amplitude})
    array = parameters_of("breathing", values, Binding(Scene(), model=declared.model("")))
    state, period = sv.empty_state(), values["period"]
    ticks = round(period / TICK)
    shifts = np.empty(ticks)
    for tick in range(ticks):
        state[sv.TIME], state[sv.DT], state[sv.TICK] = tick * TICK, TICK, tick
        state[sv.TARGET_SHIFT] = 0.0
        load(declared).step(state, array)
        shifts[tick] = np.linalg.norm(state[sv.TARGET_SHIFT])
    return float(np.mean(shifts <= protocol["within_mm"] * MILLIMETRE))


EXPERIMENTS: Final[Mapping[str, Callable[[str, Protocol], float]]] = {
    function.__name__: function
    for function in (
        puncture_peak,
        puncture_share,
        puncture_by_speed,
        dimple_by_speed,
        second_cut,
        toughness,
        young_modulus,
        friction_before_puncture,
        friction_slope,
        friction_by_speed,
        friction_by_gauge,
        force_at_depth,
        tip_force,
        friction_share,
        cutting_share,
        held_share,
        wall_slope,
        curvature,
        deflection,
        deflection_by_gauge,
        breath_rest,
    )
}
"""Name in a case -> the experiment."""

PARAMETERS: Final = frozenset({"toughness", "young_modulus"})
"""Experiments that read a value of a tissue, and drive nothing."""
