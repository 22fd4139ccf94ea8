"""Hard cases of effects: stiff, fast, still, minutes of rest."""

from collections.abc import Callable, Mapping
from math import cos, nan, sin
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.simulation.effects import (
    breathing,
    declaration,
    lateral_tissue,
    parameters_of,
    shaft_friction,
)
from app.simulation.errors import SimulationError
from app.simulation.scene import Binding, Scene, TissueLayer
from app.studies.hard_cases.case import HardCase, analytic, answers, digits, named

_Way = Callable[..., Any]


def memory_of(
    name: str, given: Mapping[str, float] | None = None, binding: Binding | None = None
) -> FloatArray:
    """Return a fresh parameters array of an effect; what is given is not held to its range."""
    defaults = {key: row.default for key, row in declaration(name).parameters.items()}
    values: Any = defaults | dict(given or {})
    return parameters_of(name, values, binding or Binding(Scene()))


def bound_to(*layers: TissueLayer, model: str = "") -> Binding:
    """Return a binding to a simulated needle in layers."""
    return Binding(Scene(layers=layers), sv.PLANT_DEPTH, model)


# --- side stiffness -------------------------------------------------------------------------------
def _press(way: _Way, memory: FloatArray, tilt: float, depth: float, l_out: float = 0.1) -> Any:
    """Force at the hub of a needle tilted by an angle in a channel laid straight down."""
    state = sv.empty_state()
    for angle in (0.0, tilt):
        state = sv.empty_state()
        state[sv.AXIS_X], state[sv.AXIS_Z] = sin(angle), -cos(angle)
        state[sv.DEPTH], state[sv.L_OUT], state[sv.DEPTH_SOURCE] = depth, l_out, 1.0
        way(state, memory)
    return state


def _tissue(*layers: TissueLayer, model: str = "winkler") -> FloatArray:
    return memory_of("lateral_tissue", binding=bound_to(*layers, model=model))


def _deep() -> HardCase:
    reference = digits("side force of tissue 120 mm deep, tilted by 1e-6 rad")
    k, depth, tilt, l_out = reference.given

    def found(way: _Way) -> Any:
        state = _press(way, _tissue(TissueLayer("x", 0.2, k)), tilt, depth, l_out)
        return np.linalg.norm(state[sv.FORCE])

    return HardCase(
        subsystem="effects",
        case="side force 120 mm deep where the needle is tilted by 1e-6 rad",
        given="20 kPa, L_out = 80 mm, rigid needle",
        way=lateral_tissue.step,
        found=found,
        reference=reference,
        unit="1",
        bound=1e-9,  # ε / 1e-6: the channel's direction is a difference
        relative=True,
        beyond=answers("no force at the skin", _nothing_at_the_skin),
    )


def _nothing_at_the_skin() -> bool:
    memory = _tissue(TissueLayer("x", 0.2, 1e6))
    return not any(
        _press(lateral_tissue.step, memory, 0.3, depth)[sv.FORCE].any()
        for depth in (0.0, -0.03, -1e300)
    )


def _thin() -> HardCase:
    plain = _press(lateral_tissue.step, _tissue(TissueLayer("b", 0.1, 2e4)), 0.1, 0.08)[sv.FORCE]
    layers = TissueLayer("a", 0.0, 1e6), TissueLayer("b", 0.1, 2e4), TissueLayer("c", 0.0, 1e6)

    def found(way: _Way) -> Any:
        return _press(way, _tissue(*layers), 0.1, 0.08)[sv.FORCE]

    return HardCase(
        subsystem="effects",
        case="layers of no thickness count for nothing",
        given="0 mm of 1 MPa before and behind 100 mm of 20 kPa",
        way=lateral_tissue.step,
        found=found,
        reference=analytic("the force of the middle layer alone", plain),
        unit="N",
        bound=0.0,
        beyond=named(SimulationError, lambda: _tissue(TissueLayer("x", 1e3))),
    )


def _grazing() -> HardCase:
    # The tip goes back and forth over a boundary by 1 µm: the force may not chatter.

    def chatter(way: _Way) -> Any:
        memory = _tissue(TissueLayer("a", 0.05, 1e4), TissueLayer("b", 0.1, 1e5))
        _press(way, memory, 0.0, 0.05)
        state, forces = sv.empty_state(), []
        for k in range(400):
            state = sv.empty_state()
            state[sv.AXIS_X], state[sv.AXIS_Z] = sin(0.1), -cos(0.1)
            state[sv.DEPTH], state[sv.L_OUT] = 0.05 + 1e-6 * (-1) ** k, 0.1
            state[sv.DEPTH_SOURCE] = 1.0
            way(state, memory)
            forces.append(float(state[sv.FORCE_X]))
        return max(np.abs(np.diff(forces)).max() / abs(forces[0]) - 1e-3, 0.0)

    return HardCase(
        subsystem="effects",
        case="grazing the boundary of two layers does not chatter",
        given="50 mm deep ± 1 µm between 10 and 100 kPa, 400 times",
        way=lateral_tissue.step,
        found=chatter,
        reference=analytic("steps of at most 1e-3 of the force", 0.0),
        unit="1",
        bound=0.0,
        beyond=answers("no force at the skin", _nothing_at_the_skin),
    )


def _gripped() -> HardCase:
    # A hub at the fulcrum: the lever is gone, the force may not grow beyond its shortest one.
    memory = _tissue(TissueLayer("x", 0.2, 2e4))
    right = float(np.linalg.norm(_press(lateral_tissue.step, memory, 0.1, 0.12, 0.02)[sv.FORCE]))

    def found(way: _Way) -> Any:
        state = _press(way, _tissue(TissueLayer("x", 0.2, 2e4)), 0.1, 0.12, 0.0)
        return np.linalg.norm(state[sv.FORCE])

    return HardCase(
        subsystem="effects",
        case="a hub at the fulcrum has the force of the shortest lever",
        given="L_out = 0, 120 mm deep, tilted by 0.1 rad",
        way=lateral_tissue.step,
        found=found,
        reference=analytic("the force at L_out = 20 mm", right),
        unit="N",
        bound=1e-12,
        beyond=answers("no force at the skin", _nothing_at_the_skin),
    )


# --- friction along the needle --------------------------------------------------------------------
def _rub(way: _Way, memory: FloatArray, depth: float, dt: float = 1e-3) -> float:
    state = sv.empty_state()
    state[sv.PLANT_DEPTH], state[sv.DT] = depth, dt
    way(state, memory)
    return float(state[sv.AXIAL_FORCE])


def _rub_all(way: _Way, memory: FloatArray, depth: float, steps: tuple[float, ...]) -> float:
    return [_rub(way, memory, depth, dt) for dt in steps][-1]


def _rubbing(stiffness: float) -> FloatArray:
    layer = TissueLayer("x", 9.0, viscous_friction=0.0)
    given = {"presliding_stiffness": stiffness}
    return memory_of("shaft_friction", given, bound_to(layer, model="dahl"))


def _fast() -> tuple[HardCase, ...]:
    found = []
    for stiffness in (1e6, 1e9):
        for dt in (1e-3, 5e-3):
            found.append(
                HardCase(
                    subsystem="effects",
                    case=f"friction at 300 mm/s, {stiffness:g} N/m², steps of {1e3 * dt:g} ms",
                    given="from 50 mm on, 300 ticks",
                    way=shaft_friction.step,
                    found=lambda way, s=stiffness, h=dt: _beyond_level(way, s, h),
                    reference=analytic("|F| - g(v) ≤ 0, F ≥ 0", 0.0),
                    unit="N",
                    bound=1e-12,
                    beyond=answers("bounded at depths of 1e300 m and NaN", _any_depth),
                )
            )
    return tuple(found)


def _beyond_level(way: _Way, stiffness: float, dt: float) -> float:
    memory, worst = _rubbing(stiffness), 0.0
    for k in range(300):
        depth = 0.05 + 0.3 * dt * k
        force = _rub(way, memory, depth, dt)
        worst = max(worst, force - 18.45 * depth, -force)
    return worst


def _any_depth() -> bool:
    memory = memory_of("shaft_friction", binding=bound_to(TissueLayer("x", 0.1)))
    depths = (0.0, -1.0, 0.0, 5e-324, 1e-320, 1e300, 0.0, -1e300, nan, 0.05)
    return all(np.isfinite(_rub(shaft_friction.step, memory, depth)) for depth in depths)


def _still_needle() -> HardCase:
    # A tick of no duration and one without travel leave the force as it is.

    def drift(way: _Way) -> Any:
        memory = memory_of(
            "shaft_friction",
            binding=bound_to(TissueLayer("x", 0.2, viscous_friction=0.0), model="dahl"),
        )
        for k in range(100):
            _rub(way, memory, 0.05 + 1e-5 * k)
        held = _rub(way, memory, 0.05099)
        return _rub_all(way, memory, 0.05099, (0.0, 1e-3, 5e-3) * 1000) - held

    return HardCase(
        subsystem="effects",
        case="friction of a needle at rest holds and does not creep",
        given="3000 ticks of 0, 1 and 5 ms without travel",
        way=shaft_friction.step,
        found=drift,
        reference=analytic("no change", 0.0),
        unit="N",
        bound=0.0,
        beyond=answers("bounded at depths of 1e300 m and NaN", _any_depth),
    )


def _subnormal_rest() -> HardCase:
    """Ten minutes of rest leave no subnormal number in any memory, which would cost 20 times."""

    def tiny(way: _Way) -> Any:
        memory = memory_of(
            "shaft_friction", binding=Binding(Scene(layers=(TissueLayer("x", 0.2),)))
        )
        state = sv.empty_state()
        for k in range(30_000):
            state[sv.DEPTH], state[sv.DT], state[sv.AXIAL_FORCE] = (
                0.05 + 1e-5 * min(k, 99),
                1e-3,
                0.0,
            )
            way(state, memory)
        live = np.abs(memory[memory != 0.0])
        return float((live < 1e-300).sum())

    return HardCase(
        subsystem="effects",
        case="a measured depth at rest leaves no subnormal speed behind",
        given="1 m/s, then 30 s of rest; smoothed over 30 ms",
        way=shaft_friction.step,
        found=tiny,
        reference=analytic("no number below 1e-300", 0.0),
        unit="numbers",
        bound=0.0,
        beyond=answers("bounded at depths of 1e300 m and NaN", _any_depth),
    )


# --- breathing ------------------------------------------------------------------------------------
def _late_breath() -> HardCase:
    reference = digits("breath after twelve days")
    time, period, amplitude = reference.given

    def found(way: _Way) -> Any:
        given = {"superior_inferior": amplitude, "anterior_posterior": 0.0, "left_right": 0.0}
        memory = memory_of("breathing", given | {"period": period}, bound_to())
        state = sv.empty_state()
        for at in (0.0, time):
            state[sv.TARGET_SHIFT] = 0.0
            state[sv.TIME] = at
            way(state, memory)
        return np.linalg.norm(state[sv.TARGET_SHIFT])

    def lost() -> bool:
        memory, state = memory_of("breathing", binding=bound_to()), sv.empty_state()
        state[sv.TIME] = nan
        breathing.step(state, memory)
        return not state[sv.TARGET_SHIFT].any()

    return HardCase(
        subsystem="effects",
        case="where the target is after twelve days of breathing",
        given="t = 1000000.7 s, period 4 s, 11.9 mm",
        way=breathing.step,
        found=found,
        reference=reference,
        unit="m",
        bound=1e-12,  # of the phase, ε · 250000 breaths
        beyond=answers("no shift at a time that is no number", lost),
    )


def varying_breaths(**more: float) -> FloatArray:
    """Return a fresh parameters array of breaths that vary by 40 %, and lag."""
    given = {"depth_variation": 0.4, "period_variation": 0.4, "anterior_lag": 1.2}
    return memory_of("breathing", given | more, bound_to(model="varying"))


def _border_of_breaths() -> HardCase:
    def at(way: _Way, memory: FloatArray, time: float) -> FloatArray:
        state = sv.empty_state()
        state[sv.TIME] = time
        way(state, memory)
        return state[sv.TARGET_SHIFT].copy()

    def jump(way: _Way) -> float:
        memory, most = varying_breaths(), 0.0
        at(way, memory, 0.0)
        ends = memory[-2 * breathing.BREATHS : -breathing.BREATHS]
        for end in (*ends, ends[-1] + ends[0]):  # the last one: where the tile repeats
            step = at(way, memory, end + 1e-9) - at(way, memory, end - 1e-9)
            most = max(most, float(np.linalg.norm(step)))
        return most

    def rested() -> bool:
        memory = varying_breaths()
        times = (0.0, nan, 1e300, -1e300, 5e-324)
        return bool(np.isfinite([at(breathing.step, memory, time) for time in times]).all())

    return HardCase(
        subsystem="effects",
        case="breaths that vary go over into each other without a jump",
        given="256 borders and where they repeat, 40 % variation, a lag of 1.2 rad, ± 1 ns",
        way=breathing.step,
        found=jump,
        reference=analytic("no step beyond the organ's speed times 2 ns", 0.0),
        unit="m",
        bound=2e-10,
        beyond=answers("bounded at times of 1e300 s and NaN", rested),
    )


CASES: Final = (
    _deep(),
    _thin(),
    _grazing(),
    _gripped(),
    *_fast(),
    _still_needle(),
    _subnormal_rest(),
    _late_breath(),
    _border_of_breaths(),
)
"""Effects."""
