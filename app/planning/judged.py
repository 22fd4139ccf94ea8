"""Values of a judged path: what counts how much, what it meets, and the planner's verdict.

Records, scores and debriefs read them; nothing here computes, so that reading loads no solver.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from app.imaging.field.tissue_field import TissueKind
from app.planning.lung_path.values import LungPathReport


@dataclass(frozen=True, slots=True)
class Weights:
    """What counts how much, and what is not allowed.

    Attributes:
        length, angle, clearance: weights of the parts of the cost.
        longest_mm: path; the device's depth limit counts where it is shorter.
        flattest_deg: angle between path and the skin's normal.
        most_bone_mm: length of path through bone.
        most_lung_mm, most_vessel_mm, most_gut_mm, most_heart_mm: through these, where a tissue
            field tells of them and the target does not lie in them; looked at each millimetre.
        pleura: weight of the angle at which the lung is entered that holds the target.
        free_mm: structures further away than their warning distance by this cost nothing, nor do
            bone, lung, vessels, gut and heart of the tissue field that are further away than this.
    """

    length: float = 1.0
    angle: float = 1.0
    clearance: float = 2.0
    longest_mm: float = 120.0
    flattest_deg: float = 65.0
    most_bone_mm: float = 1.5
    most_lung_mm: float = 1.5
    most_vessel_mm: float = 0.5
    most_gut_mm: float = 0.5
    most_heart_mm: float = 0.5
    pleura: float = 1.0
    free_mm: float = 10.0


WEIGHTS: Final = Weights()
"""As the map of entries weighs."""


@dataclass(frozen=True, slots=True)
class WayHindrance:
    """One tissue on the way.

    Attributes:
        name: of the tissue, as its field calls it.
        kind: what it is.
        depth_mm: along the way, from the entry to where it begins.
        length_mm: of the way in it, all its stretches together.
        is_sure: whether the field is.
    """

    name: str
    kind: TissueKind
    depth_mm: float
    length_mm: float
    is_sure: bool = True


@dataclass(frozen=True, slots=True)
class JudgedPlan:
    """What a planner says of one straight path.

    Attributes:
        points: 0 to 100 as the map of entries has them; 0 where the path must not be.
        length_mm: of the path.
        angle_deg: between path and the skin's normal, 0 straight in.
        clear_mm: distance from the nearest that the path should not meet; 0 where it meets it,
            infinite without any.
        nearest: what that is, in words; empty without any.
        nearest_mm: depth along the path at which it is nearest.
        meets: bone, lung, vessels, gut and heart on the path, more than is allowed of them.
        pleural_deg: between path and the pleura's normal; None where the lung is not entered.
        is_long, is_flat: whether the path is longer, or lies flatter to the skin, than is allowed.
        lung: the path report of a lung biopsy; None where nobody asked, or it misses the lung.
    """

    points: float
    length_mm: float
    angle_deg: float
    clear_mm: float
    nearest: str = ""
    nearest_mm: float = 0.0
    meets: tuple[WayHindrance, ...] = ()
    pleural_deg: float | None = None
    is_long: bool = False
    is_flat: bool = False
    lung: LungPathReport | None = None
