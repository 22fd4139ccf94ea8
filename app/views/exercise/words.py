"""What the pad says in words: how to turn the needle, and how far there is to go."""

import numpy as np
from numpy.typing import ArrayLike

from app.planning.off_path import Offset
from app.session.pad.geometry import PathFrame
from app.views.kit.text import tr

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


def lateral(frame: PathFrame, offset: Offset) -> str:
    """How far the tip is off the path, and to which side.

    Args:
        frame: of the path to the target as it is now.
        offset: of the tip from it.
    """
    length = 1e3 * offset.lateral
    if length < 0.05:
        return tr("off the path: 0.0 mm")
    right, up = 1e3 * float(offset.across @ frame.right), 1e3 * float(offset.across @ frame.up)
    left_letters, right_letters, top, bottom = frame.letters
    parts = ((abs(right), right_letters if right > 0.0 else left_letters),
             (abs(up), top if up > 0.0 else bottom))  # fmt: skip
    sides = "  ".join(f"{letters} {size:.1f}" for size, letters in parts if size >= 0.05)
    return tr("off the path: {length:.1f} mm  ({sides})", length=length, sides=sides)


def ct_words(frame: PathFrame, direction: ArrayLike) -> str:
    """Angles of the needle against the axial slices, and those of the path."""
    needle, path = frame.ct_angles(direction), frame.ct_angles(frame.axis)
    return tr(
        "CT angles: in plane {a:+.1f}° (path {b:+.1f}°)\nout of plane {c:+.1f}° (path {d:+.1f}°)",
        a=needle[0], b=path[0], c=needle[1], d=path[1],
    )  # fmt: skip


def remaining(offset: Offset, across: float, along: float) -> str:
    """Millimetres to the target, or beyond it; at it only within both tolerances [m]."""
    gap_mm = 1e3 * offset.remaining
    if offset.arrived(across, along):
        return tr("✔ at target ({gap:+.1f} mm)", gap=-gap_mm)
    if abs(offset.remaining) <= along:
        return tr("beside the target")
    if gap_mm > 0.0:
        return tr("{gap:.1f} mm to go", gap=gap_mm)
    return tr("▲ {gap:.1f} mm too deep", gap=-gap_mm)
