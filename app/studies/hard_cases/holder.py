"""Hard cases of the needle holder in the loop: what fails of its cables and encoders, how soon."""

from collections.abc import Callable
from typing import Any, Final, cast

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.device.faults import Fault
from app.mechanisms.profile import load_profile
from app.mechanisms.tensegrity.efforts import watch_stage
from app.mechanisms.tensegrity.profile import TensegrityProfile
from app.studies.hard_cases.case import HardCase, analytic, answers

PROFILE: Final = cast(TensegrityProfile, load_profile("tensegrity"))
_STARTED: Final = 150  # ticks after which all cables have been taut for long enough
_LATEST: Final = 20
"""Ticks of a millisecond from what shows to the end of the force."""

_Way = Callable[[FloatArray, FloatArray], None]
_Failing = Callable[[FloatArray, int], None]


def _run(way: _Way, fails: _Failing, ticks: int = 60) -> tuple[float, float]:
    """Return the fault that is named, and how many ticks after the first of 20 it was."""
    machine = PROFILE.machine
    stages, state = machine.stages(), sv.empty_state()
    (watch,) = stages.watch
    q = machine.usable((0.15, -0.2, -0.96))
    state[sv.DT], state[sv.ENABLED] = 1e-3, 1.0
    for tick in range(_STARTED + ticks):
        state[sv.TIME] = state[sv.Q_TIME] = 5.0 + 1e-3 * tick
        state[sv.Q], state[sv.CABLE], state[sv.TENSION], state[sv.REEL] = q, 12.0, 12.0, 0.0
        if tick >= _STARTED:
            fails(state, tick - _STARTED)
        stages.pose.function(state, stages.pose.parameters)
        way(state, watch.parameters)
        if state[sv.MACHINE_FAULT] != 0.0:
            return float(state[sv.MACHINE_FAULT]), max(float(tick - _STARTED - _LATEST), 0.0)
    return 0.0, float(ticks)


def _torn(state: FloatArray, since: int) -> None:
    state[sv.CABLE_2] = 0.0


def _runs(state: FloatArray, since: int) -> None:
    # Its motor's current says what it said before; the reel takes in what nothing holds.
    state[sv.REEL_3] = PROFILE.winches.fastest * 1e-3 * (since + 1)


def _hangs(state: FloatArray, since: int) -> None:
    state[sv.CABLE_1], state[sv.REEL_1] = 0.0, -2e-3


def _sticks(state: FloatArray, since: int) -> None:
    # Both cables of the first joint have gone along with 0.06 rad; its encoder has not.
    from app.mechanisms.tensegrity import lengths

    bars, q = PROFILE.geometry.bars, np.array(state[sv.Q])
    moved = lengths(bars, q + np.array([0.06, 0.0])) - lengths(bars, q)
    state[sv.REEL_1], state[sv.REEL_2] = -moved[0], -moved[1]


def _silent(state: FloatArray, since: int) -> None:
    state[sv.Q_TIME] -= 1e-3 * (since + 1)


def _goes_on() -> bool:
    return _run(watch_stage, lambda state, since: None) == (0.0, 60.0)


def _case(case: str, given: str, fails: _Failing, fault: Fault) -> HardCase:
    def found(way: _Way) -> Any:
        return _run(way, fails)

    return HardCase(
        subsystem="cables and encoders",
        case=case,
        given=given,
        way=watch_stage,
        found=found,
        reference=analytic(f"{fault.name}, no later than 20 ms", (float(fault), 0.0)),
        unit="fault, ms beyond 20",
        bound=0.0,
        beyond=answers("while nothing fails, no fault", _goes_on),
    )


CASES: Final = (
    _case(
        "a torn cable whose tension is measured",
        "no tension at 0 mm from its stretch",
        _torn,
        Fault.CABLE_BROKEN,
    ),
    _case(
        "a torn cable whose motor's current says that it pulls",
        "the reel runs in at 0.25 m/s",
        _runs,
        Fault.CABLE_BROKEN,
    ),
    _case("a cable that hangs", "no tension, 2 mm too long", _hangs, Fault.CABLE_SLACK),
    _case(
        "an encoder that sticks while both of its cables move",
        "0.06 rad between them",
        _sticks,
        Fault.ENCODER_LOST,
    ),
    _case(
        "an encoder that is not read any more",
        "readings that grow old",
        _silent,
        Fault.ENCODER_LOST,
    ),
)
"""What ends the force of a machine with cables."""
