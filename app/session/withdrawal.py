"""Every attempt begins with the tip outside the skin: who brings it out, and how that is known.

A simulated needle goes back by itself, through the same simulated hand and at a hand's speed: out
of the skin along itself, then upright to where it waits for a first attempt, wherever the last one
or the student left it. Where a person moves the hand it goes to the start that the attempt has
(`session.beginnings`), is unsteady from there on, and the attempt waits until it moves: the clock
is the student's. A real one the student withdraws: the attempt begins once
the whole interval that holds the depth lies outside; where nothing measures it there, once the
student says that the needle is out. What was said and not measured is recorded so, and a depth
inside the skin within `REFUTES` seconds refutes it.
"""

from dataclasses import dataclass
from enum import StrEnum
from math import hypot, isfinite
from typing import Final

from app.core import state_vector as sv
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.device.state import DeviceState
from app.session.beginnings import SeededStart
from app.session.inputs import LoopInputs
from app.session.needle import NeedlePose

KIND: Final = "withdrawal"
"""Kind of the events that tell of it; `how` in their data is a `OutsideBy`."""

INSIDE: Final = -0.002
"""Depth from which a simulated needle is brought out before an attempt [m]."""

OUT: Final = -0.010
"""Depth at which it is out [m]."""

WAITS: Final = -0.015
"""Depth to which its hand goes: where a needle waits, upright, for its first attempt [m]."""

ARRIVED: Final = 1e-3
"""So near its start the simulated hand has arrived: horizontally a share of 1, along it [m]."""

MOVED: Final = 1.5e-3
"""So far from its start the student's hand has moved: horizontally a share of 1."""

MOVED_ALONG: Final = 0.5 * MILLIMETRE
"""The same along the needle [m]."""

PATIENCE: Final = 30.0
"""Time after which a simulated needle that does not come out ends the attempt [s]."""

WELL: Final = 0.03
"""Width of the interval [m] up to which a depth is measured well enough to be called inside."""

REFUTES: Final = 2.0
"""A depth inside the skin refutes what was confirmed up to this long after the beginning [s]."""


class Start(StrEnum):
    """How a trainer sees to it that the tip is outside."""

    ANYWHERE = "anywhere"  # not at all: for parts that have no skin
    SIMULATED = "simulated"
    REAL = "real"


class OutsideBy(StrEnum):
    """How it is known that the tip is outside."""

    SIMULATED = "simulated"
    MEASURED = "measured"
    CONFIRMED = "confirmed"


class Outside(StrEnum):
    """Whether the tip is outside the skin."""

    YES = "yes"
    NO = "no"
    UNKNOWN = "unknown"


WORDS: Final = {
    Start.SIMULATED: sentence(
        "the needle is being withdrawn: the attempt begins once it is at its start"
    ),
    Outside.NO: sentence(
        "withdraw the needle first: the attempt begins once its tip is out of the skin"
    ),
    Outside.UNKNOWN: sentence(
        "nothing measures how deep the needle is: take it out of the skin, then press "
        "“The needle is out”"
    ),
}


def tip_outside(pose: NeedlePose) -> Outside:
    """Say whether the tip is outside the skin, with all that its depth may be.

    A depth that is measured well and not wholly outside counts as inside.
    """
    least, most = pose.depth_least, pose.depth_most
    if not (pose.valid and isfinite(least) and isfinite(most)):
        return Outside.UNKNOWN
    if most < 0.0:
        return Outside.YES
    measured = pose.measured and most - least < WELL
    return Outside.NO if least > 0.0 or measured else Outside.UNKNOWN


@dataclass(frozen=True, slots=True)
class WithdrawalStep:
    """What a look came to: not yet out, out (`known`), or given up (`failure`)."""

    known: OutsideBy | None = None
    failure: str = ""


class Withdrawal:
    """Brings the tip out before an attempt, or waits until it is out; the trainer holds the lock.

    Attributes:
        active: whether the tip is being brought out.
        words: what the student should know; empty while nothing is to be done.
        asks: whether the student may say that the needle is out.
        ready: whether all is in place and only the student's first movement is waited for.
    """

    def __init__(self, inputs: LoopInputs, start: Start = Start.ANYWHERE) -> None:
        self._inputs, self._start = inputs, start
        self._since = 0.0
        self._confirmed: float | None = None
        self._said = self._led = False
        self._begins: SeededStart | None = None
        self._moved = False
        self.active, self.asks, self.ready, self.words = False, False, False, ""

    @property
    def simulated(self) -> bool:
        """Return whether the hand that holds the needle is a simulated one."""
        return self._start is Start.SIMULATED

    @property
    def moves_hand(self) -> bool:
        """Return whether it is moving the simulated hand."""
        return self.active and self._start is Start.SIMULATED and not self.ready

    def begin(
        self,
        device: DeviceState | None,
        pose: NeedlePose,
        now: float,
        led: bool = False,
        begins: SeededStart | None = None,
    ) -> OutsideBy | None:
        """Begin before an attempt: how it is known that the tip is out already, or None.

        `led`: whether somebody leads the simulated hand who brings it to where he begins himself:
        only a needle inside the skin is brought out then. `begins`: where a simulated hand begins
        that a person moves, whose first movement begins the attempt; None for upright, and at once.
        """
        self._since, self._confirmed, self._said, self._led = now, None, False, led
        self._begins = begins if self._start is Start.SIMULATED else None
        self._moved = False
        self.active, self.asks, self.ready, self.words = False, False, False, ""
        self._inputs.unsteady(0, 0)
        if self._start is Start.SIMULATED:
            if self._begins is None and (device is None or self._stands(device, INSIDE)):
                return OutsideBy.SIMULATED
            self.active = True  # before the hand moves: nobody else may move it from now on
            if device is not None:
                self._bring_out(device)
            self.words = WORDS[Start.SIMULATED]
        elif self._start is Start.REAL:
            if tip_outside(pose) is Outside.YES:
                return OutsideBy.MEASURED
            self.active = True
            self._ask(tip_outside(pose))
        else:
            return OutsideBy.SIMULATED
        return None

    def advance(self, device: DeviceState | None, pose: NeedlePose, now: float) -> WithdrawalStep:
        """Look once more while the tip is being brought out."""
        if self._start is Start.SIMULATED:
            if self.ready:
                return self._out(OutsideBy.SIMULATED) if self._moved else WithdrawalStep()
            if device is not None and self._stands(device, OUT):
                if self._begins is None:
                    return self._out(OutsideBy.SIMULATED)
                self._inputs.unsteady(self._begins.level, self._begins.seed)
                self.ready, self.words = True, ""  # the next step says so
                return WithdrawalStep()
            if now - self._since > PATIENCE:
                self.stop()
                return WithdrawalStep(
                    failure=sentence("the simulated needle did not come to its start")
                )
            if device is not None and _depth(device) <= OUT:
                self._bring_out(device)
            return WithdrawalStep()
        outside = tip_outside(pose)
        if outside is Outside.YES:
            return self._out(OutsideBy.MEASURED)
        if self._said and outside is Outside.UNKNOWN:
            self._confirmed = now
            return self._out(OutsideBy.CONFIRMED)
        self._ask(outside)
        return WithdrawalStep()

    def follow(self, x: float, y: float, depth: float) -> None:
        """Hear where the student wants the hand: what is away from the start begins the attempt."""
        if self.ready and self._begins is not None:
            aside = hypot(x - self._begins.x, y - self._begins.y)
            self._moved = self._moved or aside > MOVED or abs(depth - WAITS) > MOVED_ALONG

    def act(self) -> OutsideBy:
        """Hear that the student does what needs no needle: that begins the attempt as moving does.

        Returns:
            How it is known that the needle is out: it stands ready at its start.
        """
        self.stop()
        return OutsideBy.SIMULATED

    def confirm(self) -> None:
        """Take the student's word that the needle is out; counts only where nothing measures it."""
        self._said = self.active and self.asks

    def refuted(self, pose: NeedlePose, now: float) -> str:
        """Return why an attempt that began on the student's word cannot count; empty if it can."""
        if self._confirmed is None:
            return ""
        if now - self._confirmed > REFUTES:
            self._confirmed = None
            return ""
        if not (pose.measured and pose.depth > 0.0 and tip_outside(pose) is Outside.NO):
            return ""
        return sentence(
            "the cameras saw the tip {pose_depth_mm:.0f} mm inside the skin "
            "{now:.1f} s after you said that the needle is out; withdraw it and "
            "begin again",
            pose_depth_mm=pose.depth / MILLIMETRE,
            now=now - self._confirmed,
        )

    def stop(self) -> None:
        """Stop waiting; the hand obeys its window again."""
        self.active, self.asks, self.ready, self.words = False, False, False, ""
        self._said = False

    @property
    def _place(self) -> tuple[float, float]:
        """Direction of the hand where an attempt begins."""
        return (0.0, 0.0) if self._begins is None else (self._begins.x, self._begins.y)

    def _out(self, known: OutsideBy) -> WithdrawalStep:
        self.stop()
        return WithdrawalStep(known)

    def _ask(self, outside: Outside) -> None:
        self.asks = outside is Outside.UNKNOWN
        self.words = WORDS[Outside.UNKNOWN if self.asks else Outside.NO]
        self._said = self._said and self.asks

    def _stands(self, device: DeviceState, out: float) -> bool:
        """Return whether the tip is no deeper than `out` [m], and the hand where an attempt
        begins.
        """
        if _depth(device) > out:
            return False
        x, y, depth = device.row[[sv.GRIP_X, sv.GRIP_Y, sv.GRIP_DEPTH]].tolist()
        aside = hypot(x - self._place[0], y - self._place[1])
        return self._led or (aside < ARRIVED and abs(depth - WAITS) < ARRIVED)

    def _bring_out(self, device: DeviceState) -> None:
        """Let the hand draw the needle back along itself; once it is out, to its start."""
        x, y = device.row[[sv.GRIP_X, sv.GRIP_Y]].tolist()
        if _depth(device) <= OUT and not self._led:
            x, y = self._place
        self._inputs.hand(x, y, WAITS, True)


def _depth(device: DeviceState) -> float:
    return float(device.row[sv.PLANT_DEPTH])
