"""Hard cases of the velocity from encoders: rest, wraps, readings out of reach, late ticks."""

from collections.abc import Callable
from math import pi
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.device.control.velocity import DEFAULT_VELOCITY, FASTEST, VelocityMethod, velocity_stage
from app.mechanisms.pantograph.profile import load_pantograph
from app.studies.hard_cases.case import HardCase, analytic, answers

PROFILE: Final = load_pantograph("icube")
COUNT: Final = 2.0 * pi / PROFILE.encoder.counts_per_turn

_Way = Callable[..., Any]


def _ticks(stage: Any, angles: Any, dt: float = 1e-3, times: Any = None) -> list[float]:
    """Feed readings; velocities of the left joint, one after the other."""
    state, found = sv.empty_state(), []
    state[sv.DT], state[sv.Q_RIGHT] = dt, 0.5
    for k, angle in enumerate(angles):
        state[sv.TIME] = state[sv.Q_TIME] = 1.0 + k * dt if times is None else times[k]
        state[sv.Q_LEFT] = angle
        stage.function(state, stage.parameters)
        found.append(float(state[sv.QD_LEFT]))
    return found


def _of(method: VelocityMethod) -> Any:
    return velocity_stage(PROFILE, method)


def _velocities() -> tuple[HardCase, ...]:
    found = []
    quick = 2.0 + 0.2e-3 * np.arange(900)
    rest = np.concatenate([[2.5], np.full(20_000, 2.6)])
    wrap = 2.0 + 0.2e-3 * np.arange(600) + np.where(np.arange(600) >= 300, 2.0 * pi, 0.0)
    absurd = np.where(np.arange(1500) == 300, 1e308, 2.0 + 0.2e-3 * np.arange(1500))

    for method in VelocityMethod:
        found += [
            HardCase(
                subsystem="velocity",
                case=f"a decaying velocity ends in exact zero, by {method}",
                given="a step of 0.1 rad, then 20 s of rest",
                way=_of,
                found=lambda way, m=method: _ticks(way(m), rest)[-1],
                reference=analytic("rest", 0.0),
                unit="rad/s",
                bound=0.0,
                beyond=answers(
                    "the fastest that a joint turns", lambda m=method: _bounded_by_fastest(m)
                ),
            ),
        ]
    for case, angles, bound in (
        ("a steady 0.2 rad/s", quick, 1e-9),
        ("a steady 0.2 rad/s after the encoder wrapped", wrap, 1e-3),
        ("a steady 0.2 rad/s after one reading of 1e308", absurd, 1e-3),
    ):
        found.append(
            HardCase(
                subsystem="velocity",
                case=f"{case}, by the default method",
                given=f"{len(angles)} readings at 1 kHz",
                way=_of,
                found=lambda way, a=angles: _ticks(way(DEFAULT_VELOCITY), a)[-1],
                reference=analytic("0.2 rad/s", 0.2),
                unit="rad/s",
                bound=bound,
                beyond=answers("a clock that stands still keeps the velocity", _still_clock),
            )
        )
    found += [_late_tick(), _edge()]
    return tuple(found)


def _bounded_by_fastest(method: VelocityMethod) -> bool:
    rng = np.random.default_rng(0)
    return max(map(abs, _ticks(_of(method), rng.uniform(-3.0, 3.0, 500)))) <= FASTEST


def _still_clock() -> bool:
    stage = _of(DEFAULT_VELOCITY)
    moving = _ticks(stage, 2.0 + 0.2e-3 * np.arange(300))[-1]
    state = sv.empty_state()
    state[sv.QD_LEFT], state[sv.Q_LEFT], state[sv.TIME] = moving, 2.0, 1.299
    state[sv.Q_TIME], state[sv.Q_RIGHT] = 1.299, 0.5
    stage.function(state, stage.parameters)  # DT is zero
    return bool(state[sv.QD_LEFT] == moving)


def _late_tick() -> HardCase:
    gaps = np.where(np.isin(np.arange(900), (300, 301, 600)), 0.1, 1e-3)
    times = 1.0 + np.cumsum(gaps)
    angles = np.floor((2.0 + 0.2 * times) / COUNT + 0.5) * COUNT

    def worst(way: _Way) -> Any:
        stage, state, found = way(DEFAULT_VELOCITY), sv.empty_state(), 0.0
        state[sv.Q_RIGHT] = 0.5
        for k in range(900):
            state[sv.TIME] = state[sv.Q_TIME] = times[k]
            state[sv.DT], state[sv.Q_LEFT] = min(gaps[k], 5e-3), angles[k]
            stage.function(state, stage.parameters)
            found = max(found, abs(float(state[sv.QD_LEFT]))) if k > 250 else found
        return max(found - 0.2 - COUNT / 1e-3, 0.0)

    return HardCase(
        subsystem="velocity",
        case="ticks 100 ms late, their step clamped to 5 ms, show as no burst of speed",
        given="0.2 rad/s on an encoder of 20000 counts",
        way=_of,
        found=worst,
        reference=analytic("at most 0.2 rad/s and one count per tick", 0.0),
        unit="rad/s",
        bound=1e-9,
        beyond=answers("a clock that stands still keeps the velocity", _still_clock),
    )


def _edge() -> HardCase:
    # A joint at rest on the edge of a count: one count there and back at every reading.
    angles = 2.0 + COUNT * (np.arange(2000) % 2)

    def loud(way: _Way) -> Any:
        return max(map(abs, _ticks(way(DEFAULT_VELOCITY), angles)[100:]))

    return HardCase(
        subsystem="velocity",
        case="a joint at rest on the edge of a count, by the default method",
        given="one count there and back at 1 kHz",
        way=_of,
        found=loud,
        reference=analytic("rest", 0.0),
        unit="rad/s",
        bound=COUNT / 1e-3 / 10.0,  # a tenth of what a difference shows
        beyond=answers("a clock that stands still keeps the velocity", _still_clock),
    )


CASES: Final = _velocities()
"""All of them."""
