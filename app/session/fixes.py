"""The cameras' fixes on their way to the loop and to the pose."""

import threading
from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.session.depth_gate import DepthGate
from app.session.inputs import LoopInputs
from app.session.measured import fix_depth, is_usable
from app.session.ports import FixPort, LoopPort
from app.tracking.fix import FixStatus
from app.tracking.motion.choice import depth_filter
from app.tracking.motion.depth_filter import DepthMotion

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

    def __init__(self, loop: LoopPort, inputs: LoopInputs, trust: DepthTrust = TRUST) -> None:
        self._loop = loop
        self._inputs = inputs
        self._seen = trust.seen
        self._gate = DepthGate(trust.hand_speed)
        self._lock = threading.Lock()
        self._newest: FixPort | None = None
        self._usable: FixPort | None = None
        self._motion = depth_filter()

    def take(self, fix: FixPort, fulcrum: FloatArray) -> None:
        """Look at a fix; one that is not newer than the last, or of no time, is passed over."""
        if not np.isfinite(fix.time):
            return
        with self._lock:
            if self._newest is not None and not fix.time > self._newest.time:
                return
            self._newest = fix
            if is_usable(fix):
                self._weigh(fix, fulcrum)

    def usable(self) -> FixPort | None:
        """Newest fix that is a measurement and believed, or None."""
        with self._lock:
            return self._usable

    @property
    def doubt(self) -> str:
        """Why the depths of the cameras are not believed now; empty if they are."""
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

    def _weigh(self, fix: FixPort, fulcrum: FloatArray) -> None:
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
