"""The cameras' fixes on their way to the loop and to the pose, and which of them are believed.

No depth is believed before ten more have agreed with it.

A marker that is mistaken for another thing gives one wrong depth, or a few; force and let-go would
follow it. So a first depth counts for nothing until `AGREEING` more have come, each within what a
hand can have moved the needle since the one before,

    |d - d'| <= v (t - t') + 4 (s + s'),

with the standard deviations s. A depth that is further away is refused, and from then on none is
believed until `AGREEING` new ones agree among themselves: nobody knows which of the two was right.
After `FORGOTTEN` without any the next is a first one again; until then, as on a slow computer,
t - t' counts as `TRACKER_HOLD` at most, so that a depth far from the last is confirmed anew.

What is not believed reaches neither the loop, whose interval is then the profile's whole range
(`device.control.depth_interval`), nor the pose. A depth that is wrong by the same amount in every
picture passes: no gate can see it.
"""

from __future__ import annotations

import threading
from dataclasses import dataclass
from math import isfinite, sqrt
from typing import TYPE_CHECKING, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.staleness import TRACKER_HOLD
from app.core.units import MILLIMETRE
from app.session.fusion import fix_depth, is_usable
from app.session.inputs import LoopInputs
from app.tracking.discrepancy import ENCODERS
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.motion.depth_filter import ConstantVelocity, DepthMotion

if TYPE_CHECKING:
    from app.device.control.loop import Loop

AGREEING: Final = 10
"""Depths that have to agree with a first one before it is believed."""

FORGOTTEN: Final = 1.0
"""Time without a depth [s] after which nothing is left to agree with."""

SIGMAS: Final = 4.0
"""Standard deviations within which a depth is taken to lie."""


class DepthGate:
    """Looks at one depth after the other; not thread-safe.

    Args:
        speed: fastest that a hand moves the needle along itself [m/s].

    Attributes:
        doubt: why the depth is not believed now, in the student's words; empty if it is.
    """

    def __init__(self, speed: float) -> None:
        self._speed = speed
        self._last: tuple[float, float, float] | None = None
        self._agreed = 0
        self._jump = 0.0
        self.doubt = ""

    def take(self, time: float, depth: float, variance: float) -> bool:
        """Look at a depth [m] of a `time` [s] with its variance [m²]; says whether it is believed.

        A depth that is no number is refused like one that jumps; times must not go back.
        """
        known = isfinite(depth) and isfinite(variance) and variance >= 0.0
        sigma = sqrt(variance) if known else 0.0
        if self._last is None or not time - self._last[0] <= FORGOTTEN:
            self._agreed = -1  # nothing to agree with
            self._jump = 0.0
        else:
            since, before, spread = self._last
            away = abs(depth - before)
            moved = self._speed * min(time - since, TRACKER_HOLD)
            if not (known and away <= moved + SIGMAS * (sigma + spread)):
                self._agreed, self._jump = -1, away if known else 0.0
        self._last = (time, depth, sigma) if known else None
        self._agreed = min(self._agreed + 1, AGREEING)
        self.doubt = self._why()
        return not self.doubt

    def _why(self) -> str:
        if self._agreed >= AGREEING:
            return ""
        count = sentence(
            "{agreed} of {agreeing} pictures agree so far", agreed=self._agreed, agreeing=AGREEING
        )
        if self._jump > 0.0:
            return sentence(
                "the cameras' depth jumped by {jump_mm:.0f} mm, faster than a hand"
                " moves a needle: {count}",
                jump_mm=self._jump / MILLIMETRE,
                count=count,
            )
        return sentence("the cameras have just found the marker: {count}", count=count)


UNSEEN: Final = 1.0
"""Variance of a depth that nobody measured [m²]: it may be anywhere."""

SILENCE: Final = 0.5
"""Age of the newest fix [s] from which the cameras count as silent."""


@dataclass(frozen=True, slots=True)
class DepthTrust:
    """How far a depth by the cameras may be trusted.

    Attributes:
        hand_speed: fastest that a hand moves the needle along itself [m/s]; of the profile.
        seen: whether the cameras see this needle. Simulated ones do not see a real robot's: their
            depth is a rehearsal, and the loop is told that it may be anywhere.
    """

    hand_speed: float = 0.12
    seen: bool = True


TRUST: Final = DepthTrust()
"""That of a profile which does not say how fast hands are."""


class Fixes:
    """Keeps the newest fix and the newest believed one; hands each believed depth to the loop once.

    `take` may be called from the tracker's thread and from the ticker alike.
    """

    def __init__(self, loop: Loop, inputs: LoopInputs, trust: DepthTrust = TRUST) -> None:
        self._loop = loop
        self._inputs = inputs
        self._seen = trust.seen
        self._gate = DepthGate(trust.hand_speed)
        self._lock = threading.Lock()
        self._newest: NeedleFix | None = None
        self._usable: NeedleFix | None = None
        self._motion = ConstantVelocity()  # by measurement: `acus study depth_motion`

    def take(self, fix: NeedleFix, fulcrum: FloatArray) -> None:
        """Look at a fix; one that is not newer than the last, or of no time, is passed over."""
        if not np.isfinite(fix.time):
            return
        with self._lock:
            if self._newest is not None and not fix.time > self._newest.time:
                return
            self._newest = fix
            if is_usable(fix):
                self._weigh(fix, fulcrum)

    def usable(self) -> NeedleFix | None:
        """Newest fix that is a measurement and believed, or None."""
        with self._lock:
            return self._usable

    @property
    def doubt(self) -> str:
        """Return why the depths of the cameras are not believed now; empty if they are."""
        with self._lock:
            return self._gate.doubt

    def motion(self, time: float) -> DepthMotion | None:
        """Return where the depth should be at `time` [s] by its filter; None before a fix."""
        with self._lock:
            return self._motion.at(time)

    def status(self, now: float) -> tuple[str, float]:
        """Status and residual [px] of the newest fix; empty and 0 before the first.

        After `SILENCE` without any fix there is no picture, whatever the last one said.
        """
        with self._lock:
            fix = self._newest
        if fix is None:
            return "", 0.0
        if now - fix.time > SILENCE:
            return FixStatus.NO_PICTURE.value, 0.0
        return str(fix.status), float(fix.residual_px)

    @property
    def encoder(self) -> str:
        """Return why, by cameras that see the needle, an encoder cannot be right; empty if it may
        be.
        """
        with self._lock:
            fix = self._newest
        if fix is None or not self._seen or fix.discrepancy.cause not in ENCODERS:
            return ""
        return fix.discrepancy.words

    def _weigh(self, fix: NeedleFix, fulcrum: FloatArray) -> None:
        """Believe a depth and tell the loop, or tell it that there is none."""
        device = self._loop.latest()
        if device.tick == 0 or not np.isfinite(device.axis).all():
            return
        norm = float(np.linalg.norm(device.axis))
        if not norm > 0.5:
            return
        depth, variance = fix_depth(fix, fulcrum, np.asarray(device.axis) / norm)
        if not self._gate.take(fix.time, depth, variance):
            self._usable = None
            self._inputs.untracked()
            return
        self._usable = fix
        self._inputs.tracked(depth, fix.time, variance if self._seen else UNSEEN)
        self._motion.take(fix.time, depth, variance)
