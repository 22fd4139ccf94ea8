"""Hard cases of tissue along the needle: jumps, rests, one place twice, a field's worst."""

from collections.abc import Callable
from itertools import pairwise
from math import exp, inf, nan
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.simulation import tissues
from app.simulation.effects import cutting, puncture, relaxation, shaft_friction
from app.simulation.scene import Binding, Scene, TissueLayer
from app.studies.hard_cases.case import HardCase, analytic, answers
from app.studies.hard_cases.scene import bound_to, memory_of

_Way = Callable[..., Any]

MEMBRANE: Final = TissueLayer(
    "membrane", 0.2, puncture_force=2.0, indentation_hardening=5e4, relaxation_share=0.6
)


def in_field(*values: TissueLayer, model: str) -> Binding:
    """Return a binding to a simulated needle in a field of these tissues, by code."""
    return Binding(Scene(tissues=values, field=object()), sv.PLANT_DEPTH, model)


def go(way: _Way, memory: FloatArray, depth: float, dt: float = 1e-3, **slots: float) -> Any:
    """Return the state after a tick at a depth [m], of a needle that stands upright."""
    state = sv.empty_state()
    state[sv.AXIS_Z], state[sv.PLANT_DEPTH], state[sv.DT] = -1.0, depth, dt
    for name, value in slots.items():
        state[sv.INDEX[name]] = value
    way(state, memory)
    return state


def _force(way: _Way, memory: FloatArray, depth: float, **slots: float) -> float:
    return float(go(way, memory, depth, **slots)[sv.AXIAL_FORCE])


def _torn_in_a_tick() -> HardCase:
    # A tick that goes far beyond a membrane leaves no more than what tears it.

    def most(way: _Way) -> Any:
        worst = 0.0
        for phase in np.linspace(1e-6, 0.05, 40):
            memory = memory_of("puncture", binding=bound_to(MEMBRANE, model="rate"))
            depths = (-0.01, phase, 0.06, 0.06, -0.01, 0.06)
            worst = max(worst, *(_force(way, memory, depth) for depth in depths))
        return max(worst - 2.0 / (0.6 + 0.4 * exp(-0.25)) * 1.001, 0.0)

    return HardCase(
        subsystem="effects",
        case="a membrane that a tick goes far beyond holds no more than what tears it",
        given="60 mm a tick, 40 phases, through a membrane of 2 N, in and out and in",
        way=puncture.step,
        found=most,
        reference=analytic("at most the force of the slowest push, 2.2 N", 0.0),
        unit="N",
        bound=0.0,
        beyond=answers("bounded at depths of 1e300 m and NaN, and in any field", _any_field),
    )


def _any_field() -> bool:
    values = (0.0, 1.0, -1.0, 7.0, 1e300, nan, inf)
    laws = (("puncture", puncture, "rate"), ("cutting", cutting, "track"))
    more = (("relaxation", relaxation, "standing"), ("shaft_friction", shaft_friction, "inserted"))
    rng = np.random.default_rng(3)
    names = ("tissue", "wall", "channel", "carried_x", "carried_z", "indentation")
    for name, module, model in (*laws, *more):
        memory = memory_of(name, binding=in_field(tissues.MUSCLE, MEMBRANE, model=model))
        with np.errstate(all="ignore"):
            for _ in range(300):
                slots = dict(zip(names, rng.choice(values, len(names)), strict=True))
                depth = float(rng.choice((*values, 0.01, 0.05, 0.051)))
                if not np.isfinite(_force(module.step, memory, depth, **slots)):
                    return False
        slots = {"tissue": 1.0, "wall": 1.0}
        if not np.isfinite(_force(module.step, memory, 0.05, **slots)):
            return False
    return True


def _cut_once() -> HardCase:
    def again(way: _Way) -> Any:
        memory = memory_of("cutting", binding=bound_to(tissues.LIVER, model="track"))
        once = np.arange(0.0, 0.08, 1e-5)
        back = np.arange(0.08, -0.001, -1e-5)
        for depth in np.concatenate([once, back]):
            _force(way, memory, depth)
        return max(_force(way, memory, depth) for depth in once[:-2])

    return HardCase(
        subsystem="effects",
        case="the second way into one hole cuts nothing",
        given="80 mm in, out and in again",
        way=cutting.step,
        found=again,
        reference=analytic("no force: toughness is the difference of both", 0.0),
        unit="N",
        bound=1e-9,
        beyond=answers("bounded at depths of 1e300 m and NaN, and in any field", _any_field),
    )


def _same_sums() -> HardCase:
    # In and out by any steps the sums along the shaft are those of the straight way in.
    edge = 31.0 / 1024.0
    binding = bound_to(
        TissueLayer("a", edge, friction=5.0, static_friction=5.0),
        TissueLayer("b", 0.2, friction=20.0, static_friction=20.0),
        model="inserted",
    )

    def drift(way: _Way) -> Any:
        memory = memory_of("shaft_friction", {"relaxing_share": 0.0}, binding)
        rng = np.random.default_rng(5)
        turns = (0.0, *rng.uniform(-0.01, 0.09, 200), 0.0, 0.06)
        for place, turn in pairwise(turns):
            for depth in np.linspace(place, turn, 40):
                _force(way, memory, depth)
        for depth in np.linspace(0.06, 0.0601, 20):
            _force(way, memory, depth)
        still = _force(way, memory, 0.0601, dt=1e-3)
        for _ in range(200):
            still = _force(way, memory, 0.0601)
        return still

    return HardCase(
        subsystem="effects",
        case="friction of what is inserted does not drift over many ways in and out",
        given="200 random turns between two tissues, then 60.1 mm",
        way=shaft_friction.step,
        found=drift,
        reference=analytic("5 · 30.3 + 20 · 29.8 mN", 5.0 * edge + 20.0 * (0.0601 - edge)),
        unit="N",
        bound=1e-9,
        beyond=answers("bounded at depths of 1e300 m and NaN, and in any field", _any_field),
    )


def _long_rest() -> HardCase:
    def tiny(way: _Way) -> Any:
        memory = memory_of("relaxation", binding=bound_to(tissues.LIVER, model="standing"))
        for depth in np.arange(-0.001, 0.03, 1e-4):
            _force(way, memory, depth)
        for _ in range(20_000):
            go(way, memory, 0.0299, dt=1.0)
        live = np.abs(memory[np.isfinite(memory) & (memory != 0.0)])
        return float((live < 1e-300).sum())

    return HardCase(
        subsystem="effects",
        case="hours of rest leave no subnormal force in what relaxes",
        given="30 mm into liver, then 20000 s",
        way=relaxation.step,
        found=tiny,
        reference=analytic("no number below 1e-300", 0.0),
        unit="numbers",
        bound=0.0,
        beyond=answers("bounded at depths of 1e300 m and NaN, and in any field", _any_field),
    )


CASES: Final = (_torn_in_a_tick(), _cut_once(), _same_sums(), _long_rest())
"""Effects along the needle, as they were measured."""
