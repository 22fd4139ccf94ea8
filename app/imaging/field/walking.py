"""What a path meets in a tissue field: one tissue after the other, parted where the rule says."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray
from app.core.messages import joined as joined_text
from app.core.messages import sentence
from app.imaging.field.tissue_field import TissueField, TissueKind

STEP_MM: Final = 0.2
"""A path is looked at in steps of this; what it only grazes for less may be missed."""

_Places = Callable[[FloatArray], FloatArray]
_HALVINGS: Final = 7  # a boundary is placed to 2 µm between two steps


@dataclass(frozen=True, slots=True, eq=False)
class Crossed:
    """A stretch of one tissue on a path.

    Attributes:
        code: of the tissue.
        begin_mm, end_mm: along the path.
        begin, end: the two places, LPS [mm], shape (3,).
        angle_deg: between the path and the normal of the boundary where it begins, 0 straight in
            and 90 along it; 0 at the path's own beginning.
    """

    code: int
    begin_mm: float
    end_mm: float
    begin: FloatArray
    end: FloatArray
    angle_deg: float

    @property
    def length_mm(self) -> float:
        """Length of the stretch [mm]."""
        return self.end_mm - self.begin_mm


def walk(field: TissueField, points_mm: ArrayLike, step_mm: float = STEP_MM) -> list[Crossed]:
    """Return what a path of straight pieces meets, in order and without gaps.

    Args:
        field: of the patient.
        points_mm: corners of the path, LPS, shape (n, 3); two that are one are no path.
        step_mm: see `STEP_MM`.
    """
    corners = np.asarray(points_mm, np.float64).reshape(-1, 3)
    lengths = np.linalg.norm(np.diff(corners, axis=0), axis=1)
    moved = np.concatenate([[True], lengths > 1e-9])
    corners = corners[moved]
    along = np.concatenate([[0.0], np.cumsum(lengths[moved[1:]])])
    if len(corners) < 2:
        return []
    steps = max(1, int(np.ceil(along[-1] / step_mm)))
    at = np.linspace(0.0, along[-1], steps + 1)

    def places(distance: FloatArray) -> FloatArray:
        return np.stack([np.interp(distance, along, corners[:, a]) for a in range(3)], axis=1)

    codes = field.codes_at(places(at))
    change = np.flatnonzero(codes[1:] != codes[:-1])
    low, high = at[change].copy(), at[change + 1].copy()
    before = codes[change]
    for _ in range(_HALVINGS if len(change) else 0):
        middle = 0.5 * (low + high)
        still = field.codes_at(places(middle)) == before
        low, high = np.where(still, middle, low), np.where(still, high, middle)
    edges = np.concatenate([[0.0], 0.5 * (low + high), [along[-1]]])
    ends = places(edges)
    angles = np.concatenate([[0.0], _angles(field, places, low)])
    own = np.concatenate([codes[:1], codes[change + 1]])
    return [
        Crossed(
            int(own[n]),
            float(edges[n]),
            float(edges[n + 1]),
            ends[n],
            ends[n + 1],
            float(angles[n]),
        )
        for n in range(len(own))
    ]


def _angles(field: TissueField, places: _Places, low: FloatArray) -> FloatArray:
    """Angles between a path and the boundaries' normals just before these places [degrees]."""
    if not len(low):
        return np.empty(0)
    here = places(low)
    way = places(low + 0.05) - here
    length = np.linalg.norm(way, axis=1)
    looked = field.look_up(here)
    cosine = np.abs((way * looked.normal).sum(axis=1)) / np.maximum(length, 1e-12)
    known = (length > 1e-9) & looked.normal.any(axis=1)
    return np.where(known, np.degrees(np.arccos(np.clip(cosine, 0.0, 1.0))), 0.0)


def joined(
    crossed: list[Crossed], codes: set[int], gap_mm: float, through: set[int]
) -> list[Crossed]:
    """Return the stretches of some codes as one each, joined over gaps.

    Args:
        crossed: of `walk`.
        codes: which tissues, taken as one.
        gap_mm: a gap is none where it is shorter.
        through: nor where it is of these codes alone, however long.
    """
    result: list[Crossed] = []
    gap_only = True
    for part in crossed:
        if part.code not in codes:
            gap_only = gap_only and part.code in through
            continue
        last = result[-1] if result else None
        if last is not None and (gap_only or part.begin_mm - last.end_mm < gap_mm):
            result[-1] = Crossed(
                last.code, last.begin_mm, part.end_mm, last.begin, part.end, last.angle_deg
            )
        else:
            result.append(part)
        gap_only = True
    return result


def holding(field: TissueField, target_mm: ArrayLike) -> NDArray[np.intp]:
    """Return the codes of what a target lies in: its own tissue, and what holds that around it.

    A lesion lies in the liver, a nodule in the lung: what fills most of a sphere's surface about it
    once that has left the target's own tissue.
    """
    target = np.asarray(target_mm, np.float64)
    own = int(field.codes_at(target[None])[0])
    codes = {own}
    ways = directions()
    for radius in (4.0, 8.0, 12.0, 16.0, 20.0):
        around = field.codes_at(target + radius * ways)
        others = around[(around != own)]
        if len(others) > 0.5 * len(ways):
            counts = np.bincount(others)
            most = int(np.argmax(counts))
            if counts[most] > 0.6 * len(others):
                codes.add(most)
            break
    kinds = {field.tissues[code].kind for code in codes} - {TissueKind.UNKNOWN}
    small = {code for code in codes if field.tissues[code].kind is not TissueKind.UNKNOWN}
    if TissueKind.LUNG in kinds:  # both lungs are one tissue, whatever their labels are called
        small |= {tissue.code for tissue in field.of_kind(TissueKind.LUNG)}
    return np.array(sorted(small), np.intp)


def directions(count: int = 96) -> FloatArray:
    """Return directions spread evenly, shape (count, 3) (Fibonacci)."""
    n = np.arange(count) + 0.5
    polar, round_ = np.arccos(1.0 - 2.0 * n / count), np.pi * (1.0 + 5.0**0.5) * n
    across = np.sin(polar)
    return np.stack([across * np.cos(round_), across * np.sin(round_), np.cos(polar)], axis=1)


def words(field: TissueField, points_mm: ArrayLike, least_mm: float = 0.3) -> str:
    """Say what a path meets: "skin 2.0 mm, fat 8.1 mm, rib 8.5 mm"."""
    parts = [part for part in walk(field, points_mm) if part.length_mm >= least_mm]
    lengths: list[tuple[str, float]] = []
    for part in parts:
        name = field.tissues[part.code].words
        if lengths and lengths[-1][0] == name:
            lengths[-1] = (name, lengths[-1][1] + part.length_mm)
        else:
            lengths.append((name, part.length_mm))
    return joined_text(
        ", ",
        (
            sentence("{tissue} {length:.1f} mm", tissue=name, length=length)
            for name, length in lengths
        ),
    )
