"""Routines by small pulses of torque: the sign check and the latency; the friction builds on them.

The sign check: does the torque of each motor turn its own joint, and the right way? The latency:
the wire's round trip, and the time from a torque step to the onset of motion.
"""

from typing import ClassVar, Final

import numpy as np
from numpy.typing import ArrayLike

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.messages import joined, sentence
from app.device.commissioning.results import RobotLatency, RoutineName, Side, Signs
from app.device.commissioning.routine import Part, Routine, Script
from app.device.control.loop import Loop
from app.device.errors import CommissioningError
from app.mechanisms.profile import DeviceProfile

LARGEST: Final = 0.03
"""Where a ramp ends [N·m]."""

HALF: Final = 0.5
"""Value of the input HOMED while signs are being checked: 0.03 N·m and 0.3 N at most."""

HALF_FORCE: Final = 0.3
"""Largest force at the hand meanwhile [N]."""

SIDES: Final = (Side.LEFT, Side.RIGHT)

_CALM: Final = 0.25


LET_GO_AND_CONFIRM: Final = (
    "take the needle out, or stand it upright, let go, keep your hands away and confirm"
)
"""What is asked before the joints are pushed: a leaning needle would topple."""

_CONTROL: Final = 12.0  # [1/s] of the control below: slow against the steps' 100 Hz
_NEAR: Final = 0.03  # [rad]
_PATIENCE: Final = 2.0
_WINDOW: Final = 0.03  # [s] over which a speed is taken


class PulseRoutine(Routine):
    """A routine that pushes single joints."""

    def _holding(self, joint: int, goal: float) -> float:
        """Torque [N·m] that holds a joint at an angle [rad] softly; needs checked signs."""
        inertia = self._inertia(joint)
        error = goal - float(self._loop.latest().q[joint])
        torque = inertia * _CONTROL * (_CONTROL * error - 1.4 * self._speed(joint))
        return float(np.clip(torque, -LARGEST, LARGEST))

    def _go_back(self, pose: FloatArray, message: str) -> Part:
        """Bring the joints near a pose [rad], shape (2,), softly, and leave them at rest there."""
        end = self._now + _PATIENCE
        near = 0
        while near < 10 and self._now < end:
            self._torque(self._holding(0, float(pose[0])), self._holding(1, float(pose[1])))
            state = yield from self._say(message)
            slow = max(abs(self._speed(0)), abs(self._speed(1))) < 0.05
            near = near + 1 if slow and np.abs(state.q - pose).max() < _NEAR else 0
        self._torque()
        yield from self._wait(_CALM, message)

    def _speed(self, joint: int) -> float:
        """Speed of a joint over the last moment [rad/s]."""
        newest = self._loop.latest().tick
        rows = self._loop.rows(max(newest - round(_WINDOW * self._profile.rate_hz), 0))
        span = rows[-1, sv.TIME] - rows[0, sv.TIME] if len(rows) > 1 else 0.0
        if not span > 0.0:
            return 0.0
        return float((rows[-1, sv.Q_LEFT + joint] - rows[0, sv.Q_LEFT + joint]) / span)

    def _inertia(self, joint: int) -> float:
        """Inertia of a joint alone in the present pose, by the profile [kg·m²]."""
        state = self._loop.latest().row
        return float(state[(sv.INERTIA_LEFT, sv.INERTIA_RIGHT)[joint]])

    def _ramp(
        self,
        side: Side,
        sign: float,
        rate: float,
        enough: float,
        message: str,
        own_only: bool = False,
    ) -> Part:
        """Ramp one motor's torque up at a rate [N·m/s] until a joint has moved by `enough` [rad].

        With `own_only` the joint of that motor must have moved.

        Returns:
            Movement of both joints [rad], shape (2,), zeros if it never was enough, and the ticks
            of the ramp, shape (n, SLOTS).
        """
        which = [index(side)] if own_only else [0, 1]
        yield from self._wait(_CALM, message)
        state = self._loop.latest()
        since, start, begin = state.tick, state.q.copy(), self._now
        moved, last = np.zeros(2), 0.0
        while np.abs(moved[which]).max() < enough and last < LARGEST:
            last = min(rate * (self._now - begin), LARGEST)
            self._push(side, sign * last)
            state = yield from self._say(message)
            moved = state.q - start
        rows = self._loop.rows(since)
        self._torque()
        yield from self._wait(_CALM, message)
        return (moved if np.abs(moved[which]).max() >= enough else np.zeros(2)), rows

    def _push(self, side: Side, torque: float) -> None:
        """Torque [N·m] on one motor, nothing on the other."""
        left = side is Side.LEFT
        self._torque(torque if left else 0.0, 0.0 if left else torque)


def torque_slot(side: Side) -> int:
    """Slot of the torque sent to a joint."""
    return sv.TORQUE_LEFT if side is Side.LEFT else sv.TORQUE_RIGHT


def index(side: Side) -> int:
    """Place of a joint in a pair."""
    return 0 if side is Side.LEFT else 1


_RATE: Final = 0.04  # [N·m/s]
_COUNTS: Final = 8.0
_TURN: Final = 0.05  # [rad] that the user turns a link at least
_OUTWARDS: Final = {Side.LEFT: 1.0, Side.RIGHT: -1.0}  # counter-clockwise from above is positive


class SignRoutine(PulseRoutine):
    """First the encoders by hand, then each motor by small pulses in both directions.

    Args:
        loop, profile: as in `Routine`.
        by_hand: ask the user to turn each link. Without it a motor and its encoder that are
            reversed together are not seen: for boards without hardware only.
    """

    NAME: ClassVar[RoutineName] = RoutineName.SIGNS
    TITLE: ClassVar[str] = "Sign check"

    def __init__(self, loop: Loop, profile: DeviceProfile, by_hand: bool = True) -> None:
        super().__init__(loop, profile)
        self._by_hand = by_hand

    def _script(self) -> Script:
        self._disarm()
        if self._by_hand:
            for side in SIDES:
                yield from self._turned(side)
        self._progress = 0.4
        yield from self._ask(LET_GO_AND_CONFIRM)
        yield from self._arm(HALF, HALF_FORCE)
        response = np.zeros((2, 2))
        for side in SIDES:
            for sign in (1.0, -1.0):
                message = f"pulse on the {side} motor, {'forwards' if sign > 0 else 'backwards'}"
                enough = _COUNTS * self._count
                moved, _ = yield from self._ramp(side, sign, _RATE, enough, message)
                response[index(side)] += 0.5 * sign * moved
                self._progress += 0.15
        if problems := diagnose(response):
            raise CommissioningError(
                sentence("{title}: ", title=self.TITLE) + joined("; ", problems)
            )
        (ll, lr), (rl, rr) = response.tolist()
        return Signs(response=((ll, lr), (rl, rr)), by_hand=self._by_hand)

    def _turned(self, side: Side) -> Part:
        """Have one link turned outwards by hand and look at the encoders."""
        before = yield from self._at_rest("hold the needle still")
        yield from self._ask(
            f"turn the {side} motor's link outwards by hand, by about 10°, hold it there and"
            " confirm; the other link stays as still as it can"
        )
        after = yield from self._at_rest("hold it there")
        self._progress += 0.15
        moved, own = after - before, index(side)
        if problem := hand_problem(side, moved, own):
            raise CommissioningError(
                sentence("{title}: {problem}", title=self.TITLE, problem=problem)
            )


def hand_problem(side: Side, moved: ArrayLike, own: int) -> str:
    """Say what is wrong if the link of one side was turned outwards and the encoders moved so.

    Args:
        side: the link that the user turned.
        moved: change of (left, right) joint angle [rad], shape (2,).
        own: place of that side in `moved`.
    """
    turned = np.asarray(moved, dtype=np.float64)
    if not np.abs(turned).max() >= _TURN:
        return sentence(
            "no encoder saw the {side} link move (at least {turn_deg:.0f}° were asked"
            " for): check the encoder's cable and supply",
            side=side,
            turn_deg=np.degrees(_TURN),
        )
    if abs(turned[own]) < abs(turned[1 - own]):
        return sentence(
            "the other encoder moved more when the {side} link was turned: the encoders of "
            "left and right are swapped (exchange their plugs), or the wrong link was turned",
            side=side,
        )
    if turned[own] * _OUTWARDS[side] < 0.0:
        return sentence(
            "the {side} encoder counts backwards: exchange its channels A and B, or reverse "
            "it in the board's settings",
            side=side,
        )
    return ""


def diagnose(response: ArrayLike) -> list[str]:
    """Say what is wrong with the motors; empty if each turns its own joint the right way.

    Args:
        response: movement [rad] of (left, right) joint by a pulse on the left (row 0) and right
            (row 1) motor, shape (2, 2); a row of zeros where nothing moved.
    """
    moved = np.asarray(response, dtype=np.float64)
    strongest = [int(np.argmax(np.abs(row))) for row in moved]
    idle = [side for side in SIDES if not np.abs(moved[index(side)]).max() > 0.0]
    if len(idle) == 2:
        return [
            sentence(
                "no motor moves anything: check the switch of the motor supply, the amplifiers' "
                "enable and the motor cables, and that nothing blocks the needle"
            )
        ]
    if idle:
        return [
            sentence(
                "the {motor} motor moves nothing up to 0.03 N·m: its joint is blocked, or "
                "its amplifier has no power or no enable",
                motor=idle[0],
            )
        ]
    if strongest == [1, 0]:
        return [sentence("the motors are swapped: exchange the motor cables of left and right")]
    if strongest[0] == strongest[1]:
        other = SIDES[1 - strongest[0]]
        return [
            sentence(
                "both motors move the same encoder: the {other} encoder does not count, its "
                "joint is blocked, or both motors are wired to one amplifier",
                other=other,
            )
        ]
    return [
        sentence(
            "the {side} motor turns backwards: exchange its two leads, or reverse it in the "
            "board's settings",
            side=side,
        )
        for side in SIDES
        if moved[index(side), index(side)] < 0.0
    ]


_LISTEN: Final = 2.0  # [s]
_STEPS: Final = 6
_TORQUE: Final = 0.02  # [N·m]
_STEP_PATIENCE: Final = 0.4
_STEP_COUNTS: Final = 40.0
_FIT_FROM, _FIT_TO = 4.0, 40.0  # counts between which the motion is fitted


class LatencyRoutine(PulseRoutine):
    """Listen to the wire, then a few torque steps on the left motor, forth and back."""

    NAME: ClassVar[RoutineName] = RoutineName.LATENCY
    TITLE: ClassVar[str] = "Latency"

    def _script(self) -> Script:
        self._disarm()
        yield from self._ask(LET_GO_AND_CONFIRM)
        since = self._loop.latest().tick
        yield from self._wait(_LISTEN, "listening to the wire")
        trips, lost = round_trips(self._loop.rows(since))
        self._progress = 0.4
        yield from self._arm(1.0, 1.0)
        pose, times = self._loop.latest().q.copy(), []
        for k in range(_STEPS):
            times.append((yield from self._jump(1.0 if k % 2 == 0 else -1.0)))
            yield from self._go_back(pose, "going back")
            self._progress += 0.1
        return RobotLatency(
            round_trip=trips,
            lost=lost,
            dead_time=float(np.median(times)),
            dead_time_spread=float(np.std(times)),
        )

    def _jump(self, sign: float) -> Part:
        """One torque step; returns its dead time [s]."""
        state = self._loop.latest()
        since, start, begin = state.tick, float(state.q[0]), self._now
        self._push(Side.LEFT, sign * _TORQUE)
        while abs(float(state.q[0]) - start) < _STEP_COUNTS * self._count:
            state = yield from self._say("torque step on the left joint")
            if self._now - begin > _STEP_PATIENCE:
                raise CommissioningError(
                    sentence(
                        "{title}: the left joint does not follow a step of {torque:g} N·m; run"
                        " the sign check, and take the needle out",
                        title=self.TITLE,
                        torque=_TORQUE,
                    )
                )
        rows = self._loop.rows(since)
        return dead_time(
            rows[:, sv.TIME], rows[:, sv.TORQUE_LEFT], rows[:, sv.Q_LEFT] - start, self._count
        )


def round_trips(rows: FloatArray) -> tuple[tuple[float, float, float], float]:
    """Median, 99 % and largest round trip [s], and the share of lost commands, (n, SLOTS).

    Zeros where there is no wire, so no round trip.
    """
    trips = rows[:, sv.ROUND_TRIP]
    trips = trips[np.isfinite(trips) & (trips > 0.0)]
    if len(trips) == 0:
        return (0.0, 0.0, 0.0), 0.0
    median, high, largest = np.percentile(trips, (50, 99, 100)).tolist()
    lost = float(rows[-1, sv.LINK_LOST] - rows[0, sv.LINK_LOST])
    replies = float(rows[-1, sv.LINK_REPLIES] - rows[0, sv.LINK_REPLIES])
    return (median, high, largest), lost / max(lost + replies, 1.0)


def dead_time(time: FloatArray, torque: FloatArray, moved: FloatArray, count: float) -> float:
    """Time [s] from the first torque to where the motion's parabola begins; not below zero.

    A constant torque on a resting joint gives q = α (t - t₀)²/2: the root of the angle is a line
    over time, whose zero is t₀. So neither the inertia nor the encoder's resolution counts.

    Args:
        time: [s], shape (n,).
        torque: sent [N·m], shape (n,).
        moved: angle from rest [rad], shape (n,).
        count: one encoder count [rad].

    Raises:
        CommissioningError: if there is no motion to fit.
    """
    sent = np.flatnonzero(torque != 0.0)
    way = np.abs(moved)
    used = (way >= _FIT_FROM * count) & (way <= _FIT_TO * count)
    if len(sent) == 0 or used.sum() < 3:
        raise CommissioningError(
            sentence(
                "Latency: too few readings between rest and motion; is the link slow or the step "
                "lost?"
            )
        )
    slope, offset = np.polyfit(time[used] - time[sent[0]], np.sqrt(way[used]), 1)
    if not slope > 0.0:
        raise CommissioningError(
            sentence("Latency: the joint does not speed up under a constant torque")
        )
    return max(float(-offset / slope), 0.0)
