"""The force at the hand, and whether a gauge measured it or the torques only suggest it."""

from dataclasses import dataclass
from math import isfinite

import numpy as np
from numpy.typing import ArrayLike

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.device.state import Limiter
from app.session.snapshot import Snapshot
from app.views.kit.text import tr

_UNKNOWN = 0.06
"""Length of the interval [m] from which a depth says nothing of the force: simulated cameras that
do not see a real robot's needle, or one camera that hardly does."""


@dataclass(frozen=True, slots=True)
class Felt:
    """Force at the hand [N], never negative, and where it comes from.

    Attributes:
        force: magnitude [N]; 0 where the robot says nothing.
        measured: whether the board's gauge measured it; else it is estimated from the torques.
        at_most: whether it is only the largest that it can be, because nobody measures the depth.
    """

    force: float
    measured: bool
    at_most: bool = False


def felt(snapshot: Snapshot) -> Felt:
    """Take the gauge's force where the board has one, else the estimate from the torques sent.

    The same torques are another force at every depth: where none is measured, the force is the
    largest that it can be.
    """
    device = snapshot.device
    if device is None:
        return Felt(0.0, False)
    measured = bool(device.row[sv.GAUGE] > 0.0)
    doubt = float(device.row[sv.DEPTH_MOST] - device.row[sv.DEPTH_LEAST])
    at_most = not measured and (not snapshot.pose.measured or doubt > _UNKNOWN)
    force = abs(float(device.row[sv.GAUGE_FORCE])) if measured else _norm(device.felt)
    force = max(force, float(device.row[sv.FELT_MOST])) if at_most else force
    return Felt(force if isfinite(force) else 0.0, measured, at_most)


def force_limit(snapshot: Snapshot, device_limit: float) -> float:
    """Return the largest force at the hand now [N]: the device's own limit, or what it is
    cleared for where that is less. Where nobody asks a device for its clearance, a cap of 0 in
    the loop says that none has been set yet.
    """
    if snapshot.clearance is not None:
        return min(device_limit, float(snapshot.clearance.force_cap))
    cap = float(snapshot.device.row[sv.FORCE_CAP]) if snapshot.device is not None else 0.0
    return min(device_limit, cap) if cap > 0.0 else device_limit


@dataclass(frozen=True, slots=True)
class GuidanceLimit:
    """Largest force that can be had where the needle is now, where that is less than the limit.

    Attributes:
        force: at the hand, along the force that is wanted [N].
        reason: why it is not more, in the student's words.
    """

    force: float
    reason: str

    @property
    def words(self) -> str:
        """Say it under the force bar."""
        return tr("guidance limited to {n:.1f} N here", n=self.force)


def guidance_limit(snapshot: Snapshot, limit: float) -> GuidanceLimit | None:
    """Return what holds the guidance below `limit` [N] here; None where nothing does, or where
    the loop does not say.
    """
    if snapshot.device is None:
        return None
    row = snapshot.device.row
    force = float(row[sv.GUIDANCE_LIMIT])
    if not 0.0 < force < _NOTICED * limit:
        return None
    return GuidanceLimit(force, _limit_reason(row))


_NOTICED = 0.98  # of the limit: anything nearer to it is not felt
_UNMEASURED = 0.0  # DEPTH_SOURCE without a fix


def _limit_reason(row: FloatArray) -> str:
    by = int(row[sv.GUIDANCE_LIMITED_BY])
    if by == Limiter.TORQUE:
        return tr("the needle sticks out far, and the motors cannot push harder at so long a lever")
    if row[sv.DEPTH_SOURCE] == _UNMEASURED:
        return tr(
            "the depth is not measured; the robot keeps within its limits for every depth, and "
            "where the needle sticks out furthest no more than this reaches your hand"
        )
    if by == Limiter.DEPTH:
        doubt = 0.5 * float(row[sv.DEPTH_MOST] - row[sv.DEPTH_LEAST]) / MILLIMETRE
        return tr(
            "the depth is known only to ± {mm:.0f} mm, and the force stays within its limit for "
            "all of that",
            mm=doubt,
        )
    return tr("the lever is light here: a stronger push could not be stopped in time if you let go")


def force_words(force: Felt) -> str:
    """Say a force and where it comes from, or that it is only a bound."""
    if force.at_most:
        return tr("at most {force:.1f} N", force=force.force)
    return tr("{force:.1f} N {origin}", force=force.force, origin=origin_word(force.measured))


def origin_word(measured: bool) -> str:
    """Say in one word where a force comes from."""
    return tr("measured") if measured else tr("estimated")


def origin_help(measured: bool, at_most: bool = False) -> str:
    """Say what the words mean."""
    if at_most:
        return tr(
            "The depth is not measured, and the force at the hand depends on it: this is the "
            "largest that it can be, estimated from the motor torques; what you feel may be less."
        )
    if measured:
        return tr("Force at the hand, measured by the robot's own gauge, across the needle.")
    return tr(
        "Force at the hand, estimated from the motor torques that are sent: no force sensor says "
        "what really arrives."
    )


def _norm(vector: ArrayLike) -> float:
    return float(np.linalg.norm(vector))
