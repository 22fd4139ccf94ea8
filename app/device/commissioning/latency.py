"""Latency: the wire's round trip, and the time from a torque step to the onset of motion."""

from typing import ClassVar, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.device.commissioning.errors import CommissioningError
from app.device.commissioning.pulses import LET_GO_AND_CONFIRM, PulseRoutine
from app.device.commissioning.results import Latency as Found
from app.device.commissioning.results import Side, Step
from app.device.commissioning.routine import Part, Script

_LISTEN: Final = 2.0  # [s]
_STEPS: Final = 6
_TORQUE: Final = 0.02  # [N·m]
_PATIENCE: Final = 0.4
_COUNTS: Final = 40.0
_FIT_FROM, _FIT_TO = 4.0, 40.0  # counts between which the motion is fitted


class Latency(PulseRoutine):
    """Listen to the wire, then a few torque steps on the left motor, forth and back."""

    NAME: ClassVar[Step] = Step.LATENCY
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
        return Found(
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
        while abs(float(state.q[0]) - start) < _COUNTS * self._count:
            state = yield from self._say("torque step on the left joint")
            if self._now - begin > _PATIENCE:
                raise CommissioningError(
                    f"{self.TITLE}: the left joint does not follow a step of {_TORQUE:g} N·m; run"
                    " the sign check, and take the needle out"
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
            "Latency: too few readings between rest and motion; is the link slow or the step lost?"
        )
    slope, offset = np.polyfit(time[used] - time[sent[0]], np.sqrt(way[used]), 1)
    if not slope > 0.0:
        raise CommissioningError("Latency: the joint does not speed up under a constant torque")
    return max(float(-offset / slope), 0.0)
