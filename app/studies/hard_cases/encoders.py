"""Hard cases of the encoders: a jump that comes within reach of a motion, a swing at the bound."""

from collections.abc import Callable
from math import pi, radians
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.device.control.plausibility import Plausibility, is_wrap, plausibility_stage
from app.studies.hard_cases.case import HardCase, analytic, answers

COUNT: Final = 2.0 * pi / 20_000

_Way = Callable[[FloatArray, FloatArray], None]


def _read(way: _Way, angles: Any) -> FloatArray:
    """Left angles that are left of readings a millisecond apart [rad], shape (n,)."""
    memory, state, found = Plausibility(COUNT).stage().parameters, sv.empty_state(), []
    state[sv.HOMED] = 1.0
    for k, angle in enumerate(angles):
        state[sv.TIME] = state[sv.Q_TIME] = 10.0 + 1e-3 * k
        state[sv.Q_LEFT] = angle
        way(state, memory)
        found.append(float(state[sv.Q_LEFT]))
    return np.array(found)


def _slipped() -> HardCase:
    jump = np.concatenate([np.zeros(20), np.full(15, radians(3.6))])

    def faults() -> bool:
        memory, state = Plausibility(COUNT).stage().parameters, sv.empty_state()
        state[sv.HOMED] = 1.0
        for k, angle in enumerate([*np.zeros(20), *np.full(21, radians(3.6))]):
            state[sv.Q_TIME], state[sv.Q_LEFT] = 10.0 + 1e-3 * k, angle
            plausibility_stage(state, memory)
        return bool(state[sv.ENCODER_FAULT] != 0.0)

    return HardCase(
        subsystem="cables and encoders",
        case="an encoder that slips by 3.6° in a millisecond and stays there is not believed",
        given="at rest at 1 kHz, 15 ms after the slip",
        way=plausibility_stage,
        found=lambda way: float(np.abs(_read(way, jump)).max()),
        reference=analytic("where it was", 0.0),
        unit="rad",
        bound=1e-15,
        beyond=answers("after 20 ms it is a fault until homing", faults),
    )


def _wrapped() -> HardCase:
    wrap = np.concatenate([np.zeros(20), np.full(5, 65536.0 * COUNT), np.zeros(5)])
    return HardCase(
        subsystem="cables and encoders",
        case="five readings that are 2¹⁶ counts off are missing ones",
        given="at rest at 1 kHz, 20 000 counts a turn",
        way=plausibility_stage,
        found=lambda way: float(np.abs(_read(way, wrap)).max()),
        reference=analytic("where it was", 0.0),
        unit="rad",
        bound=1e-15,
        beyond=answers(
            "half of 2⁸ counts is called no wrap", lambda: not is_wrap(128.0 * COUNT, COUNT)
        ),
    )


CASES: Final = (_slipped(), _wrapped())
"""What is believed of encoders."""
