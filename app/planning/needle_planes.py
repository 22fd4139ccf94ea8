"""The needle's own planes: in-plane, in-plane 90° and probe's-eye, steady for every direction.

A needle fixes two of its planes only up to a roll about itself. The roll is taken from the patient:
`y` is the part of a reference direction (superior) across the needle, so that the in-plane view is
the plane through the needle nearest to the CT's axial slices. Where the needle runs along the body
superior says nothing, and anterior takes over. No choice of roll can be continuous over all
directions, so a needle that follows the hand carries its last roll along (parallel transport) and
turns towards the reference no faster than `ROLL_PER_TURN` times its own turn: a small movement of
the needle never turns the picture by much, whatever its direction.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from math import atan2, radians

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, angle_between, frozen, unit
from app.core.errors import NumericalError
from app.core.messages import sentence
from app.core.rotation import rotation_exp
from app.core.transform import rotation_between
from app.imaging.reformat import Frame

LEAVE_SUPERIOR, BACK_TO_SUPERIOR = 0.95, 0.90
"""Shares |axis · superior| above which anterior takes over, and below which superior comes back."""

ROLL_PER_TURN = 4.0
"""Roll [rad] that a turn of the needle by 1 rad may bring on top.

Along a circle of latitude superior turns tan(latitude) times as fast as the needle: 3.04 at
`LEAVE_SUPERIOR`. So the reference is followed exactly wherever it holds, and approached after a
change of reference.
"""

SHORTEST_MM = 1.0
"""Two points nearer than this give no direction that one could mean."""


class Reference(StrEnum):
    """What the roll comes from."""

    SUPERIOR = "S"
    ANTERIOR = "A"
    GIVEN = "given"


_DIRECTIONS = {
    Reference.SUPERIOR: frozen([0.0, 0.0, 1.0]),
    Reference.ANTERIOR: frozen([0.0, -1.0, 0.0]),
}


@dataclass(frozen=True, slots=True, eq=False)
class NeedleFrame:
    """Tip, axis and roll of a needle in the patient; `x = axis × y`, LPS.

    Attributes:
        tip_mm: where the planes meet, shape (3,), read-only.
        axis: unit direction from hub to tip, shape (3,), read-only.
        x: unit, across the needle within the in-plane view, shape (3,), read-only.
        y: unit, across the needle and out of the in-plane view, shape (3,), read-only.
        reference: what the roll comes from.
    """

    tip_mm: FloatArray
    axis: FloatArray
    x: FloatArray
    y: FloatArray
    reference: Reference


def frame_of(tip_mm: ArrayLike, axis: ArrayLike) -> NeedleFrame:
    """Lay a frame along a needle that nothing is known about yet.

    Args:
        tip_mm: LPS, shape (3,).
        axis: direction from hub to tip, LPS, shape (3,), of any length.

    Raises:
        NumericalError: if a value is not finite, or the axis has no length.
    """
    along = unit(axis, "needle axis")
    reference = _reference(Reference.SUPERIOR, along)
    return _frame(tip_mm, along, _across(_DIRECTIONS[reference], along), reference)


def follow(
    last: NeedleFrame | None,
    tip_mm: ArrayLike,
    axis: ArrayLike,
    dead_mm: float = 0.3,
    dead_deg: float = 0.3,
) -> NeedleFrame:
    """Take the needle's next pose.

    Args:
        last: frame so far; None at first.
        tip_mm: LPS, shape (3,).
        axis: direction from hub to tip, LPS, shape (3,), of any length.
        dead_mm: the tip stays while it moves no more than this.
        dead_deg: the directions stay while the axis turns no more than this.

    Returns:
        The next frame; `last` itself within both dead bands.

    Raises:
        NumericalError: if a value is not finite, or the axis has no length.
    """
    along, tip = unit(axis, "needle axis"), frozen(tip_mm, (3,), "tip_mm")
    if last is None:
        return frame_of(tip, along)
    turn = angle_between(last.axis, along)
    if turn > radians(dead_deg):
        return _turned(last, tip, along, turn)
    if np.linalg.norm(tip - last.tip_mm) > dead_mm:
        return replace(last, tip_mm=tip)
    return last


def through(a_mm: ArrayLike, b_mm: ArrayLike, normal: ArrayLike) -> NeedleFrame:
    """Lay planes through two points without any needle.

    The in-plane view contains both points and the direction `normal`: that of the view they were
    chosen in, so that it cuts this view along the line between them.

    Args:
        a_mm: first point, LPS, shape (3,).
        b_mm: second point, where the planes meet, LPS, shape (3,).
        normal: LPS, shape (3,); where it runs along the line itself, the roll is a needle's.

    Raises:
        NumericalError: if the points are nearer than `SHORTEST_MM`, or a value is not finite.
    """
    start, end = frozen(a_mm, (3,), "a_mm"), frozen(b_mm, (3,), "b_mm")
    length = float(np.linalg.norm(end - start))
    if length < SHORTEST_MM:
        raise NumericalError(
            sentence(
                "the two points are {length:.2f} mm apart; choose points at least "
                "{shortest_mm:g} mm apart for a plane through them",
                length=length,
                shortest_mm=SHORTEST_MM,
            )
        )
    along, viewed = unit(end - start), unit(normal, "normal")
    if np.linalg.norm(np.cross(along, viewed)) < 1e-3:
        return frame_of(end, along)
    x = _across(viewed, along)
    return _frame(end, along, np.cross(x, along), Reference.GIVEN)


def in_plane(needle: NeedleFrame) -> Frame:
    """View that contains the needle, pointing down, and lies as flat as it can in the axial CT."""
    return Frame(needle.tip_mm, needle.x, needle.axis)


def in_plane_90(needle: NeedleFrame) -> Frame:
    """View that contains the needle, pointing down, at a right angle to the in-plane one."""
    return Frame(needle.tip_mm, needle.y, needle.axis)


def probe(needle: NeedleFrame, ahead_mm: float = 0.0) -> Frame:
    """View along the needle, so far ahead of its tip; `y` (towards the head) is on top."""
    return Frame(needle.tip_mm + ahead_mm * needle.axis, needle.x, -needle.y)


def _turned(last: NeedleFrame, tip: FloatArray, along: FloatArray, turn: float) -> NeedleFrame:
    reference = last.reference
    carried = _across(rotation_between(last.axis, along) @ last.y, along)
    if reference is Reference.GIVEN:
        return _frame(tip, along, carried, reference)
    reference = _reference(reference, along)
    wanted = _across(_DIRECTIONS[reference], along)
    missing = atan2(float(np.cross(carried, wanted) @ along), float(carried @ wanted))
    most = ROLL_PER_TURN * turn
    roll = min(max(missing, -most), most)
    y = wanted if roll == missing else rotation_exp(roll * along) @ carried
    return _frame(tip, along, y, reference)


def _reference(last: Reference, along: FloatArray) -> Reference:
    share = abs(float(along @ _DIRECTIONS[Reference.SUPERIOR]))
    limit = LEAVE_SUPERIOR if last is Reference.SUPERIOR else BACK_TO_SUPERIOR
    return Reference.ANTERIOR if share > limit else Reference.SUPERIOR


def _across(direction: FloatArray, along: FloatArray) -> FloatArray:
    """Part of a direction across another one, unit."""
    return unit(direction - (direction @ along) * along)


def _frame(
    tip_mm: ArrayLike, along: FloatArray, y: FloatArray, reference: Reference
) -> NeedleFrame:
    across = _across(y, along)
    x = unit(np.cross(along, across))
    return NeedleFrame(
        frozen(tip_mm, (3,), "tip_mm"), frozen(along), frozen(x), frozen(across), reference
    )
