"""Hard cases of integrators: steps that are stiff, long, coupled or broken."""

from collections.abc import Callable
from functools import partial
from typing import Any, Final

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.mechanisms.needle_motion import dry
from app.mechanisms.profile import load_profile
from app.simulation import dry_friction
from app.simulation.plant import SimulatedHand, initial_plant, plant_stage
from app.studies.hard_cases.case import HardCase, analytic, answers, digits

PROFILE: Final = load_profile("icube")
_Way = Callable[..., Any]


def _called(given: tuple[float, ...], way: _Way) -> Any:
    return way(*given)


def _dahl() -> tuple[HardCase, ...]:
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
        )
        for words in ("1e-12 m", "0.3 mm", "0.3 mm, as stiff as 5e8 N/m")
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
    )


def _coupled() -> HardCase:
    reference = digits("dry friction of two coupled joints")
    a11, a12, a22, b1, b2, most = reference.given

    def found(way: _Way) -> Any:
        return way(a11, a12, a22, b1, b2, -5.0, 5.0, most)

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


CASES: Final = (*_dahl(), _held_tick(), _coupled(), *_stiff_hand())
"""All of them."""
