"""The needle at a moment, as the steps of a procedure and complications see it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from app.core.arrays import FloatArray
from app.session.needle import NeedlePose


class Looked(Protocol):
    """An observation of robot and cameras, as far as this needs it."""

    @property
    def pose(self) -> NeedlePose:
        """Return the needle's."""

    @property
    def p_target(self) -> FloatArray:
        """Return where the target is [m], shape (3,)."""


@dataclass(frozen=True, slots=True, eq=False)
class NeedleNow:
    """The needle at a moment, in world.

    Attributes:
        p_tip: tip [m], shape (3,).
        tip_axis: direction in which it goes on, shape (3,).
        depth: of the tip [m].
        p_target: target now [m], shape (3,).
        measured: whether the cameras vouch for it.
        fallen_mm: how far the last control scan showed the target displaced, LPS, shape (3,); None
            where it did not.
    """

    p_tip: FloatArray
    tip_axis: FloatArray
    depth: float
    p_target: FloatArray
    measured: bool
    fallen_mm: FloatArray | None = None

    @classmethod
    def of(cls, look: Looked | None, fallen_mm: FloatArray | None = None) -> NeedleNow | None:
        """Return that of an observation; None without one."""
        if look is None:
            return None
        pose = look.pose
        return cls(pose.p_tip, pose.tip_axis, pose.depth, look.p_target, pose.measured, fallen_mm)
