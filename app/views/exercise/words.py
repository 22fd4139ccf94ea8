"""What the pad says in words: how to turn the needle, and how far there is to go."""

import numpy as np
from numpy.typing import ArrayLike

from app.views.exercise.pad_geometry import PathFrame
from app.views.text import tr

STRAIGHT_DEG = 0.1
"""Corrections below this [°] are not asked for: five encoder counts."""


def towards(letters: str) -> str:
    """Patient direction of a letter group in words: `L` → "patient left (L)".

    Only the largest share is spelt out: the pad's edges show the rest.
    """
    words = {
        "L": tr("patient left"),
        "R": tr("patient right"),
        "A": tr("front"),
        "P": tr("back"),
        "S": tr("head"),
        "I": tr("feet"),
    }
    return f"{words[letters[0]]} ({letters})"


def corrections(frame: PathFrame, needle_tilts: ArrayLike) -> tuple[str, str]:
    """How to turn the tip onto the path: in the plane of the slice, and out of it.

    Args:
        frame: axes of the pad.
        needle_tilts: the needle's tilts against the path [rad], shape (2,).
    """
    right, up = np.degrees(np.asarray(needle_tilts, dtype=np.float64)).tolist()
    left_letters, right_letters, top, bottom = frame.letters
    first, second = (
        (tr("In plane"), tr("Out of plane")) if frame.axial else (tr("Sideways"), tr("Up / down"))
    )
    return (
        _correction(first, -right, right_letters, left_letters),
        _correction(second, -up, top, bottom),
    )


def _correction(name: str, angle_deg: float, positive: str, negative: str) -> str:
    if abs(angle_deg) < STRAIGHT_DEG:
        return tr("{name}: ✔ on path", name=name)
    where = towards(positive if angle_deg > 0.0 else negative)
    return tr(
        "{name}: tip {angle:.1f}° towards {where}", name=name, angle=abs(angle_deg), where=where
    )


def remaining(depth: float, target_depth: float, tolerance: float) -> str:
    """Millimetres to the target, or beyond it."""
    gap_mm = 1e3 * (target_depth - depth)
    if abs(gap_mm) <= 1e3 * tolerance:
        return tr("✔ at target ({gap:+.1f} mm)", gap=-gap_mm)
    if gap_mm > 0.0:
        return tr("{gap:.1f} mm to go", gap=gap_mm)
    return tr("▲ {gap:.1f} mm too deep", gap=-gap_mm)
