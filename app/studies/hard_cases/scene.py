"""Hard cases of effects and integrators: stiff, fast, still, broken ticks, minutes of rest."""

from collections.abc import Callable, Mapping
from functools import partial
from math import cos, nan, sin
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.mechanisms.needle_motion import dry
from app.mechanisms.profile import load_profile
from app.simulation import dry_friction
from app.simulation.effects import (
    breathing,
    declaration,
    lateral_tissue,
    parameters_of,
    shaft_friction,
)
from app.simulation.errors import SimulationError
from app.simulation.plant import SimulatedHand, initial_plant, plant_stage
from app.simulation.scene import Binding, Scene, TissueLayer
from app.studies.hard_cases.case import Defect, HardCase, analytic, answers, digits, named

PROFILE: Final = load_profile("icube")
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

    def at_the_tip(state: FloatArray, parameters: FloatArray) -> None:
        # The whole layer's stiffness as if it stood at the tip: d³, not d³/3.
        lateral_tissue.step(state, parameters)
        state[sv.FORCE] *= 3.0

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
        defect=Defect("d³ instead of d³/3", at_the_tip),
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

    def thick(state: FloatArray, parameters: FloatArray) -> None:
        lateral_tissue.step(state, parameters)
        state[sv.FORCE] += 1e-3

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
        defect=Defect("they count with 1 mN", thick),
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

    def switching(state: FloatArray, parameters: FloatArray) -> None:
        lateral_tissue.step(state, parameters)
        state[sv.FORCE] *= 10.0 if state[sv.DEPTH] > 0.05 else 1.0

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
        defect=Defect("the deeper layer's stiffness for the whole needle", switching),
    )


def _gripped() -> HardCase:
    # A hub at the fulcrum: the lever is gone, the force may not grow beyond its shortest one.
    memory = _tissue(TissueLayer("x", 0.2, 2e4))
    right = float(np.linalg.norm(_press(lateral_tissue.step, memory, 0.1, 0.12, 0.02)[sv.FORCE]))

    def found(way: _Way) -> Any:
        state = _press(way, _tissue(TissueLayer("x", 0.2, 2e4)), 0.1, 0.12, 0.0)
        return np.linalg.norm(state[sv.FORCE])

    def unbounded(state: FloatArray, parameters: FloatArray) -> None:
        lateral_tissue.step(state, parameters)
        state[sv.FORCE] *= 0.02 / max(state[sv.L_OUT], 1e-9)

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
        defect=Defect("moment over L_out", unbounded),
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


def _explicit(stiffness: float) -> Callable[[FloatArray, FloatArray], None]:
    """Dahl by explicit Euler: unstable for |v| > 2 g / (σ T)."""
    memory = {"force": 0.0, "depth": nan}

    def step(state: FloatArray, parameters: FloatArray) -> None:
        depth = float(state[sv.PLANT_DEPTH])
        travel = depth - memory["depth"] if memory["depth"] == memory["depth"] else 0.0
        memory["depth"], level = depth, 10.57 * depth
        rate = stiffness * depth * (travel - abs(travel) * memory["force"] / level)
        memory["force"] = float(np.clip(memory["force"] + rate, -1e200, 1e200))
        state[sv.AXIAL_FORCE] += memory["force"]

    return step


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
                    defect=Defect("explicit Euler", _explicit(stiffness)),
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

    def creeping(state: FloatArray, parameters: FloatArray) -> None:
        for _ in range(2):
            state[sv.AXIAL_FORCE] = 0.0
            shaft_friction.step(state, parameters)
            state[sv.PLANT_DEPTH] -= 1e-12

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
        defect=Defect("a depth that trembles by 1 pm", creeping),
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

    def decaying(state: FloatArray, parameters: FloatArray) -> None:
        parameters[:] = 1e-310

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
        defect=Defect("nothing is snapped to zero", decaying),
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

    def single(state: FloatArray, parameters: FloatArray) -> None:
        kept = state[sv.TIME]
        state[sv.TIME] = np.float32(kept)
        breathing.step(state, parameters)
        state[sv.TIME] = kept

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
        defect=Defect("time in single precision", single),
    )


def _border_of_breaths() -> HardCase:
    given = {"depth_variation": 0.4, "period_variation": 0.4, "anterior_lag": 1.2}
    binding = bound_to(model="varying")

    def at(way: _Way, memory: FloatArray, time: float) -> FloatArray:
        state = sv.empty_state()
        state[sv.TIME] = time
        way(state, memory)
        return state[sv.TARGET_SHIFT].copy()

    def jump(way: _Way) -> float:
        memory, most = memory_of("breathing", given, binding), 0.0
        at(way, memory, 0.0)
        ends = memory[-2 * breathing.BREATHS : -breathing.BREATHS]
        for end in (*ends, ends[-1] + ends[0]):  # the last one: where the tile repeats
            step = at(way, memory, end + 1e-9) - at(way, memory, end - 1e-9)
            most = max(most, float(np.linalg.norm(step)))
        return most

    def forgetful() -> Callable[[FloatArray, FloatArray], None]:
        other, looks = memory_of("breathing", given | {"draws": 2.0}, binding), [0]

        def step(state: FloatArray, parameters: FloatArray) -> None:
            looks[0] += 1
            breathing.step(state, parameters if looks[0] % 2 else other)

        return step

    def rested() -> bool:
        memory = memory_of("breathing", given, binding)
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
        defect=Defect("each look draws its own breaths", forgetful()),
    )


# --- integrators ----------------------------------------------------------------------------------
def _called(given: tuple[float, ...], way: _Way) -> Any:
    return way(*given)


def _dahl() -> tuple[HardCase, ...]:
    def euler(force: float, travel: float, level: float, stiffness: float) -> float:
        return force + stiffness * travel * (1.0 - force / level)

    def backward(force: float, travel: float, level: float, stiffness: float) -> float:
        return (force + stiffness * travel) / (1.0 + stiffness * travel / level) + 1e-12

    return tuple(
        HardCase(
            subsystem="integrators",
            case=f"exponential step of Dahl's friction over {words}",
            given="f = 0.2 N, g = 1 N",
            way=dry_friction.dahl,
            found=partial(_called, digits(f"Dahl friction after {words}").given),
            reference=digits(f"Dahl friction after {words}"),
            unit="N",
            bound=1e-15,
            beyond=answers(
                "no friction without a level",
                lambda: dry_friction.dahl(1.0, 1.0, 0.0, 1e5) == 0.0,
            ),
            defect=Defect(text, way),
        )
        for words, text, way in (
            ("1e-12 m", "implicit Euler", backward),
            ("0.3 mm", "explicit Euler", euler),
            ("0.3 mm, as stiff as 5e8 N/m", "explicit Euler", euler),
        )
    )


def _held_tick() -> HardCase:
    # A thousand steps are one: the exact step has no step size.

    def found(way: _Way) -> Any:
        force = 0.2
        for _ in range(1000):
            force = way(force, 3e-7, 1.0, 1e4)
        return force

    return HardCase(
        subsystem="integrators",
        case="a thousand steps of Dahl's friction are one",
        given="0.3 mm in steps of 0.3 µm, σ = 1e4 N/m, g = 1 N",
        way=dry_friction.dahl,
        found=found,
        reference=analytic("one step of 0.3 mm", dry_friction.dahl(0.2, 3e-4, 1.0, 1e4)),
        unit="N",
        bound=1e-13,
        beyond=answers(
            "no friction without a level", lambda: dry_friction.dahl(1.0, 1.0, 0.0, 1e5) == 0.0
        ),
        defect=Defect("implicit Euler", lambda f, x, g, s: (f + s * x) / (1.0 + s * x / g)),
    )


def _coupled() -> HardCase:
    reference = digits("dry friction of two coupled joints")
    a11, a12, a22, b1, b2, most = reference.given

    def found(way: _Way) -> Any:
        return way(a11, a12, a22, b1, b2, -5.0, 5.0, most)

    def one_by_one(*v: float) -> tuple[float, float]:
        a11, _, a22, b1, b2, _, _, most = v
        return (b1 + most) / a11, (b2 - most) / a22

    return HardCase(
        subsystem="integrators",
        case="dry friction of two joints that are coupled to 95 %",
        given="A = (2, 1.9; 1.9, 2)e-3 kg·m², impulses 1 and 2 mN·m·s",
        way=dry,
        found=found,
        reference=reference,
        unit="1",
        bound=1e-13,
        relative=True,
        beyond=answers(
            "joints that friction can hold rest exactly",
            lambda: dry(2e-3, 0.0, 2e-3, 1e-7, -1e-7, 0.0, 0.0, 4e-6) == (0.0, 0.0),
        ),
        defect=Defect("each joint on its own", one_by_one),
    )


def _plant(hand: SimulatedHand, dt: float) -> tuple[FloatArray, Any]:
    stage = plant_stage(PROFILE, depth=0.05, hand=hand)
    state = sv.empty_state()
    for name, value in initial_plant(PROFILE, (0.0, 0.0, -1.0), 0.05).items():
        state[sv.INDEX[name]] = value
    state[sv.DT], state[sv.HAND_HOLDS], state[sv.HAND_DEPTH] = dt, 1.0, 0.05
    return state, stage


def _stiff_hand() -> tuple[HardCase, ...]:
    # A spring of 5e5 N/m, pushed 10 µm aside: it may come back, never further away.
    hand = SimulatedHand(axial_stiffness=5e5, axial_damping=0.0, strongest=1e6)

    def furthest(way: _Way, dt: float) -> Any:
        state, stage = _plant(hand, dt)
        run = way(stage)
        for _ in range(20):
            run(state, stage.parameters)
        start = state[sv.PLANT_DEPTH]
        state[sv.PLANT_DEPTH] = start + 1e-5
        away = []
        for _ in range(200):
            run(state, stage.parameters)
            away.append(abs(state[sv.PLANT_DEPTH] - start))
        return [max(max(away) / 1e-5 - 1.0, 0.0), max(away[-1] / 1e-5 - 0.2, 0.0)]

    def own(stage: Any) -> Any:
        return stage.function

    def explicit(stage: Any) -> Any:
        # The same mass and spring by explicit Euler, in the same substeps.

        def step(state: FloatArray, parameters: FloatArray) -> None:
            for _ in range(max(1, round(state[sv.DT] / 0.5e-3))):
                stretch = 0.05 - state[sv.PLANT_DEPTH]
                depth = state[sv.PLANT_DEPTH] + 0.5e-3 * state[sv.PLANT_DEPTH_RATE]
                state[sv.PLANT_DEPTH_RATE] += 0.5e-3 * 5e5 * stretch / 0.05
                state[sv.PLANT_DEPTH] = float(np.clip(depth, -1e100, 1e100))

        return step

    return tuple(
        HardCase(
            subsystem="integrators",
            case=f"a hand of 5e5 N/m without damping, at ticks of {1e3 * dt:g} ms",
            given="the needle 10 µm beside where the hand holds it",
            way=own,
            found=lambda way, h=dt: furthest(way, h),
            reference=analytic("never further away, and back to the seal's friction", (0.0, 0.0)),
            unit="1",
            bound=0.0,
            beyond=answers("a tick of 1e9 s is one of 5 ms", _clamped),
            defect=Defect("explicit Euler", explicit),
        )
        for dt in (1e-3, 5e-3)
    )


def _clamped() -> bool:
    ends = []
    for dt in (1e9, 5e-3):
        state, stage = _plant(SimulatedHand(), dt)
        state[sv.HAND_X] = 0.2
        for _ in range(3):
            stage.function(state, stage.parameters)
        ends.append(state[sv.PLANT_Q].tolist())
    return bool(ends[0] == ends[1])


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
    *_dahl(),
    _held_tick(),
    _coupled(),
    *_stiff_hand(),
)
"""Effects and integrators."""
