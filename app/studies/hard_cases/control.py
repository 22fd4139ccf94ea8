"""Hard cases of the force path: laws, governor, guard; all that must end bounded."""

from collections.abc import Callable
from math import inf, nan, pi, sin, sqrt
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.device.control.depth_interval import interval_kernel
from app.device.control.governor import SpeedGovernor
from app.device.control.law_kernels import across_kernel, damper_share, hill_kernel, spring_kernel
from app.device.control.passivity import PassivityGuard, damping_for
from app.device.control.speed_bounds import counted, stoppable
from app.device.control.vectors import norm_kernel, shrink_kernel
from app.mechanisms.pantograph.profile import load_pantograph
from app.studies.hard_cases.case import HardCase, analytic, answers, digits

PROFILE: Final = load_pantograph("icube")

_Way = Callable[..., Any]


# --- force laws -----------------------------------------------------------------------------------
def _across() -> HardCase:
    reference = digits("part of the path across a needle 1e-9 rad from it")

    return HardCase(
        subsystem="force laws",
        case="direction and angle from a needle to a path 2e-9 rad beside it",
        given="needle (0, 0, -1), path (1e-9, -2e-9, -1)",
        way=across_kernel,
        found=lambda way: way(*reference.given),
        reference=reference,
        unit="1",
        bound=1e-15,
        relative=True,
        beyond=answers(
            "exactly no force on the path",
            lambda: across_kernel(0.0, 0.0, -1.0, 0.0, 0.0, -1.0) == (0.0, 0.0, 0.0, 0.0),
        ),
    )


def _springs() -> tuple[HardCase, ...]:
    found = []
    for words in ("1e-9 rad", "90°", "1e-9 rad short of 180°"):
        reference = digits(f"energy of a saturated spring at {words}")
        found.append(
            HardCase(
                subsystem="force laws",
                case=f"energy that the attraction stores at {words}",
                given="28.6 N/rad, 5 N",
                way=spring_kernel,
                found=lambda way, v=reference.given: way(*v)[1],
                reference=reference,
                unit="1",
                bound=1e-15,
                relative=True,
                beyond=answers(
                    "no force against the path, where no direction is better",
                    lambda: spring_kernel(pi, 28.6, 5.0)[0] * sin(pi) < 1e-15,
                ),
            )
        )
    return tuple(found)


def _stiff() -> HardCase:
    angles = (1e-300, 1e-12, 1e-3, 1.0, pi / 2, 2.0, pi)

    def most(way: _Way) -> Any:
        return max(way(a, k, 5.0)[0] * abs(sin(a)) for a in angles for k in (1e3, 1e8, 1e300))

    return HardCase(
        subsystem="force laws",
        case="an attraction of up to 1e300 N/rad gives no more than its limit",
        given="errors of 1e-300 rad to π, 5 N",
        way=spring_kernel,
        found=most,
        reference=analytic("the limit, 5 N", 5.0),
        unit="N",
        bound=1e-14,
        beyond=answers(
            "no force without a limit", lambda: spring_kernel(1.0, 10.0, 0.0) == (0.0, 0.0)
        ),
    )


def _hills() -> tuple[HardCase, ...]:
    found = []
    for words, rest in (("1e-6 of its reach", 1e-6), ("half its reach", 0.5)):
        reference = digits(f"hill {words} from its end")
        angle = 0.4 * (1.0 - rest)
        # Relative to each number's own size; 1 - ε/r has lost what ε has of it.
        own = [float(v) for v in reference.value]
        found.append(
            HardCase(
                subsystem="force laws",
                case=f"force and energy of the repulsion, {words} from its end",
                given="30 N/rad, reach 0.4 rad",
                way=hill_kernel,
                found=lambda way, a=angle, o=own: np.array(way(a, 0.4, 30.0)) / o,
                reference=analytic(reference.how, (1.0, 1.0)),
                unit="1",
                bound=2e-15 / rest,
                beyond=answers(
                    "exactly nothing at its end", lambda: hill_kernel(0.4, 0.4, 30.0) == (0.0, 0.0)
                ),
            )
        )
    return tuple(found)


def _damper() -> HardCase:
    reference = digits("share of a damper against a force just within its limit")

    return HardCase(
        subsystem="force laws",
        case="share of a damper of 1e6 N against a force 1e-7 N below the limit",
        given="f = (4.9999999, 1e-5, 0) N, b = (-1e6, 2, 3) N, 5 N",
        way=damper_share,
        found=lambda way: way(*reference.given),
        reference=reference,
        unit="1",
        bound=1e-15,
        relative=True,
        beyond=answers(
            "nothing of a damper that is no number",
            lambda: damper_share(1.0, 0.0, 0.0, nan, 0.0, 0.0, 5.0) == 0.0,
        ),
    )


# --- governor and safety --------------------------------------------------------------------------
def _stoppable() -> tuple[HardCase, ...]:
    found = []
    for words, bound in (("plenty of", 1e-14), ("hardly any", 1e-9)):
        reference = digits(f"acceleration that can be stopped in {words} room")
        found.append(
            HardCase(
                subsystem="governor",
                case=f"acceleration that can be stopped in {words} room for speed",
                given=f"{reference.given[0]:g} rad/s, doubt 6e-4 rad, 2 ms",
                way=stoppable,
                found=lambda way, v=reference.given: way(*v),
                reference=reference,
                unit="1",
                bound=bound,  # √(δ + T r) - √δ has lost the digits that T r is smaller by
                relative=True,
                beyond=answers(
                    "none where there is no room", lambda: stoppable(-1.0, 6e-4, 2e-3) == 0
                ),
            )
        )
    return tuple(found)


def _kept_bound() -> HardCase:
    # The promise itself: what can be stopped is stopped within the room, for any room.
    rooms = [0.0, 1e-300, 1e-12, 1e-3, 1.0, 1e3]

    def excess(way: _Way) -> Any:
        found = [(r, way(r, 6e-4, 2e-3)) for r in rooms]
        return max(2.0 * sqrt(6e-4 * a) + 2e-3 * a - r for r, a in found)

    return HardCase(
        subsystem="governor",
        case="the speed after noticing stays within the room, from 0 to 1000 rad/s",
        given="doubt 6e-4 rad, 2 ms",
        way=stoppable,
        found=lambda way: max(excess(way), 0.0),
        reference=analytic("2 √(δ a) + a T - room ≤ 0", 0.0),
        unit="rad/s",
        bound=1e-12,
        beyond=answers("none where there is no room", lambda: stoppable(-inf, 6e-4, 2e-3) == 0.0),
    )


def _counted() -> HardCase:
    """Travel that counts is continuous where the force turns from along to against."""
    steps = 1e-9 * np.array([-2.0, -1.0, 0.0, 1.0, 2.0])

    def jumps(way: _Way) -> Any:
        return np.abs(np.diff([way(along, 0.1) for along in steps])).max() / 1e-9

    return HardCase(
        subsystem="governor",
        case="travel that counts does not jump where motion turns against the force",
        given="travel along the force from -2e-9 to 2e-9 rad, 0.1 rad aside",
        way=counted,
        found=lambda way: max(jumps(way) - 100.0, 0.0),
        reference=analytic("steps of at most 100 times the input's", 0.0),
        unit="1",
        bound=0.0,
        beyond=answers("all of it along the force", lambda: counted(0.1, 0.1) == 0.1),
    )


def _untold() -> HardCase:
    # A pose whose acceleration cannot be told lets no torque through.

    def sent(way: _Way) -> Any:
        stage = way(SpeedGovernor.of(PROFILE))
        state = sv.empty_state()
        for tick in range(3):
            state[sv.TIME] = state[sv.Q_TIME] = 100.0 + tick * 1e-3
            state[sv.DT], state[sv.ENABLED], state[sv.L_OUT] = 1e-3, 1.0, 0.1
            state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = 0.1, -0.1
            state[sv.AXIS_X] = nan
            stage.function(state, stage.parameters)
        return [state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT]]

    return HardCase(
        subsystem="governor",
        case="no torque where the needle's direction is no number",
        given="axis x is NaN, ±0.1 N·m asked for",
        way=SpeedGovernor.stage,
        found=sent,
        reference=analytic("zero torque", (0.0, 0.0)),
        unit="N·m",
        bound=0.0,
        beyond=answers("the depth unknown: its whole range", _whole_range),
    )


def _whole_range() -> bool:
    return interval_kernel(nan, 0.0, 0.0, -0.03, 0.12, 0.5, 0.2, 0.1) == (-0.03, 0.12)


def _huge() -> tuple[HardCase, ...]:
    reference = digits("length of a force of 1e200 N")
    return (
        HardCase(
            subsystem="governor",
            case="length of a force of 1e201 N",
            given="(3e200, -4e200, 1.2e201) N",
            way=norm_kernel,
            found=lambda way: way(*reference.given),
            reference=reference,
            unit="1",
            bound=1e-15,
            relative=True,
            beyond=answers("a force that is no number has no length", _no_length),
        ),
        HardCase(
            subsystem="governor",
            case="a force of 1e200 N is brought to 5 N",
            given="(3e200, -4e200, 0) N",
            way=shrink_kernel,
            found=lambda way: 5e200 * way(3e200, -4e200, 0.0, 5.0),
            reference=analytic("the limit", 5.0),
            unit="N",
            bound=1e-15,
            beyond=answers(
                "as it is within the limit", lambda: shrink_kernel(3.0, 0.0, 0.0, 5.0) == 1.0
            ),
        ),
    )


def _no_length() -> bool:
    return bool(np.isnan(norm_kernel(nan, 0.0, 0.0)))


def _resting_governor() -> HardCase:
    """Minutes after the last push nothing of it may be left that is too small to be cheap."""

    def tiny(way: _Way) -> Any:
        stage = way(SpeedGovernor.of(PROFILE))
        state, pose = sv.empty_state(), PROFILE.machine.stages().pose
        state[sv.Q] = PROFILE.machine.usable((0.0, 0.0, -1.0))
        pose.function(state, pose.parameters)
        state[[sv.AXIS_Z, sv.L_IN, sv.L_OUT, sv.DEPTH]] = -1.0, 0.09, 0.1, 0.1
        state[[sv.DEPTH_LEAST, sv.DEPTH_MOST, sv.DEPTH_SOURCE]] = 0.1, 0.1, 1.0
        state[sv.ENABLED], state[sv.DT] = 1.0, 5e-3
        for tick in range(30_000):
            state[sv.TIME] = state[sv.Q_TIME] = 1.0 + 5e-3 * tick
            state[[sv.TORQUE_LEFT, sv.TORQUE_RIGHT]] = 0.01 if tick < 40 else 0.0
            stage.function(state, stage.parameters)
            state[[sv.SENT_LEFT, sv.SENT_RIGHT]] = state[[sv.TORQUE_LEFT, sv.TORQUE_RIGHT]]
        live = np.abs(stage.parameters[stage.parameters != 0.0])
        return float((live < 1e-300).sum())

    return HardCase(
        subsystem="governor",
        case="two and a half minutes after a push no subnormal number is left of it",
        given="0.01 N·m for 0.2 s, then nothing, ticks of 5 ms",
        way=SpeedGovernor.stage,
        found=tiny,
        reference=analytic("no number below 1e-300", 0.0),
        unit="numbers",
        bound=0.0,
        beyond=answers("the depth unknown: its whole range", _whole_range),
    )


# --- guard ----------------------------------------------------------------------------------------
def _extracting() -> HardCase:
    # A hand takes 0.1 N·m times what it turns, forever: the tank must run dry and stay so.
    bound, torque, speed, dt = 0.05, 0.1, 5.0, 1e-3

    def given_out(way: _Way) -> Any:
        stage = way(PassivityGuard.of(PROFILE, bound))
        state, work = sv.empty_state(), 0.0
        state[sv.DT], state[sv.ENABLED] = dt, 1.0
        state[sv.LIMIT_SCALE] = state[sv.LET_GO_SCALE] = 1.0
        for tick in range(3000):
            turn = speed * dt * (1.0 if tick else 0.0)
            work += state[sv.SENT_LEFT] * turn
            state[sv.Q_LEFT], state[sv.QD_LEFT] = tick * speed * dt, speed
            state[sv.Q_TIME] = state[sv.TIME] = tick * dt
            state[[sv.TORQUE_LEFT, sv.TORQUE_RIGHT]] = torque, 0.0
            stage.function(state, stage.parameters)
            state[[sv.SENT_LEFT, sv.SENT_RIGHT]] = state[[sv.TORQUE_LEFT, sv.TORQUE_RIGHT]]
        return max(work - bound, 0.0)

    return HardCase(
        subsystem="guard",
        case="a hand that draws energy out for 3 s gets no more than was declared",
        given="0.1 N·m with 5 rad/s, 50 mJ declared",
        way=PassivityGuard.stage,
        found=given_out,
        reference=analytic("work at the port - declared energy ≤ 0", 0.0),
        unit="J",
        bound=1e-9,
        beyond=answers("no declared energy is no torque", _nothing_declared),
    )


def _nothing_declared() -> bool:
    stage = PassivityGuard.of(PROFILE, 0.0).stage()
    state = sv.empty_state()
    state[sv.DT], state[sv.ENABLED] = 1e-3, 1.0
    state[sv.LIMIT_SCALE] = state[sv.LET_GO_SCALE] = 1.0
    for tick in range(200):
        state[sv.Q_TIME] = state[sv.TIME] = tick * 1e-3
        state[sv.TORQUE_LEFT] = 0.1
        stage.function(state, stage.parameters)
    return bool(state[sv.TORQUE_LEFT] == 0.0)


def _damping() -> HardCase:
    """Damping that takes a debt out within one tick: b |q̇|² T = debt, but never beyond `most`."""
    speed2, step = 1e-6, 1e-3
    debt = 2e-12
    return HardCase(
        subsystem="guard",
        case="damping that takes out a debt of 2 pJ at 1 mrad/s",
        given="1 ms, at most 0.01 N·m·s/rad",
        way=damping_for,
        found=lambda way: way(debt, speed2, step, 0.01),
        reference=analytic("debt / (|q̇|² T)", debt / (speed2 * step)),
        unit="1",
        bound=1e-15,
        relative=True,
        beyond=answers(
            "the most there is, at rest", lambda: damping_for(1.0, 0.0, 1e-3, 0.01) <= 0.01
        ),
    )


def _late_reading() -> HardCase:
    """While readings are missing, the torque that was held is charged with the most it can do."""
    bound = 0.05

    def ends(way: _Way) -> Any:
        stage = way(PassivityGuard.of(PROFILE, bound))
        state = sv.empty_state()
        state[sv.DT], state[sv.ENABLED] = 1e-3, 1.0
        state[sv.LIMIT_SCALE] = state[sv.LET_GO_SCALE] = 1.0
        left = 0.0
        for tick in range(400):
            state[sv.TIME] = tick * 1e-3
            if tick < 100:
                state[sv.Q_TIME] = state[sv.TIME]
            if tick == 399:  # after 0.3 s without one, a reading far away
                state[sv.Q_TIME], state[sv.Q_LEFT] = state[sv.TIME], 3.0
            state[[sv.TORQUE_LEFT, sv.TORQUE_RIGHT]] = 0.1, 0.0
            stage.function(state, stage.parameters)
            state[[sv.SENT_LEFT, sv.SENT_RIGHT]] = state[[sv.TORQUE_LEFT, sv.TORQUE_RIGHT]]
            left = float(state[sv.TORQUE_LEFT])
        return left

    return HardCase(
        subsystem="guard",
        case="a joint found 3 rad away after 0.3 s without a reading stops the force",
        given="0.1 N·m held meanwhile, 50 mJ declared",
        way=PassivityGuard.stage,
        found=ends,
        reference=analytic("zero torque: the tank is charged with the most", 0.0),
        unit="N·m",
        bound=1e-12,
        beyond=answers("no declared energy is no torque", _nothing_declared),
    )


CASES: Final = (
    _across(),
    *_springs(),
    _stiff(),
    *_hills(),
    _damper(),
    *_stoppable(),
    _kept_bound(),
    _counted(),
    _untold(),
    *_huge(),
    _resting_governor(),
    _extracting(),
    _damping(),
    _late_reading(),
)
"""Force laws, governor and safety, guard."""
