"""Where a path goes through the chest wall: ribs above and below, intercostal vessels, the spine.

A rib's border is the place of its bone that is nearest to the path, above or below it: `up` is the
patient's, along the wall. The distance is that of the path from a voxel of the bone, less the
voxel's own from the bone's surface.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from app.core.arrays import FloatArray
from app.imaging.field.tissue_field import (
    STEPS_PER_MM,
    UNKNOWN,
    FieldTissue,
    TissueField,
    TissueKind,
)
from app.planning.lung_path.values import LOOK_MM, PROTECTED_FROM_MM, Place

INTERCOSTAL: Final = "intercostal"
"""What names of intercostal vessels hold."""

_ASIDE: Final = float(np.tan(np.radians(50.0)))  # a rib runs across the path, not along `up`
_MET_MM: Final = 0.3  # a rib so near is met: on which side it lies, its own middle tells
_RIB_MM: Final = 8.0  # bone no farther from a place on a rib is of that rib
_SLAB_MM: Final = 25.0
_THICK_MM: Final = 6.0  # bone that is deeper than this lies in a vertebral body
_FRONT_MM: Final = 45.0  # of the vertebral bodies, before their middle or the canal
_LEAST_VOXELS: Final = 20


@dataclass(frozen=True, slots=True)
class Borders:
    """Distances from the ribs [mm] and their nearest places, LPS; None is not known, or none."""

    below_mm: float | None = None
    above_mm: float | None = None
    below_at: Place | None = None
    above_at: Place | None = None


def rib_codes(field: TissueField) -> list[int]:
    """Return the codes of ribs and their cartilage; of all bone where nobody named ribs."""
    bones = field.of_kind(TissueKind.BONE)
    ribs = [one.code for one in bones if one.name.casefold().startswith("rib")]
    named = [one.code for one in field.tissues if _is_cartilage(one)]
    return named + (ribs or [one.code for one in bones])


def rib_borders(field: TissueField, entry: FloatArray, inner: FloatArray) -> Borders:
    """Return how far a path from the skin to the pleura stays from the ribs above and below."""
    found = _near(field, rib_codes(field), entry, inner)
    if found is None:
        return Borders()
    places, surface = found
    if not len(places):
        return Borders(LOOK_MM, LOOK_MM)
    foot = _feet(places, entry, inner)
    away = places - foot
    way = (inner - entry) / np.linalg.norm(inner - entry)
    up = np.array([0.0, 0.0, 1.0]) - way[2] * way
    up /= max(float(np.linalg.norm(up)), 1e-9)
    high, aside = away @ up, np.abs(away @ np.cross(way, up))
    gap = np.maximum(np.linalg.norm(away, axis=1) - surface, 0.0)
    nearest = int(gap.argmin())
    sides: dict[float, tuple[float | None, Place | None]] = {}
    free = np.full(len(places), True)
    if gap[nearest] < _MET_MM:
        own = _piece(field, places, nearest)
        about = own & (np.linalg.norm(away, axis=1) < _RIB_MM)
        most = 1.0 if high[about].mean() > 0.0 else -1.0
        sides[most] = float(gap[nearest]), _tuple(places[nearest])
        free = ~own
    for sign in {-1.0, 1.0} - set(sides):
        among = np.flatnonzero(free & (sign * high > 0.0) & (aside < _ASIDE * np.abs(high)))
        n = among[gap[among].argmin()] if len(among) else -1
        reach = LOOK_MM if n < 0 else float(gap[n])
        if _ends(field, inner if n < 0 else foot[n], sign * up, reach):
            sides[sign] = None, None
        elif n < 0 or gap[n] >= LOOK_MM:
            sides[sign] = LOOK_MM, None
        else:
            out = away[n] / max(float(np.linalg.norm(away[n])), 1e-9)
            sides[sign] = float(gap[n]), _tuple(foot[n] + gap[n] * out)
    (below, below_at), (above, above_at) = sides[-1.0], sides[1.0]
    return Borders(below, above, below_at, above_at)


def _ends(field: TissueField, place: FloatArray, way: FloatArray, reach_mm: float) -> bool:
    """Tell whether what is labelled ends on the way to where a rib may be."""
    steps = np.arange(0.0, reach_mm, 1.0)[:, None]
    return bool((field.codes_at(place + steps * way) == UNKNOWN).any())


def _piece(field: TissueField, places: FloatArray, number: int) -> NDArray[np.bool_]:
    """Return which voxels hang together with one of them; where all do, those of its rib about."""
    ijk = np.rint(places @ field.inverse_mm[:3, :3].T + field.inverse_mm[:3, 3]).astype(int)
    ijk -= ijk.min(axis=0)
    solid = np.zeros(ijk.max(axis=0) + 1, bool)
    solid[tuple(ijk.T)] = True
    numbers = ndimage.label(solid)[0][tuple(ijk.T)]
    own = np.asarray(numbers == numbers[number])
    near = np.linalg.norm(places - places[number], axis=1) < 2.0 * _RIB_MM
    return np.asarray(own & near) if own.all() else own


def intercostal_mm(field: TissueField, entry: FloatArray, inner: FloatArray) -> float | None:
    """Return how far a path from skin to pleura stays from intercostal vessels; None: not known."""
    vessels = [
        one.code
        for one in field.of_kind(TissueKind.VESSEL)
        if INTERCOSTAL in one.name.casefold().replace("_", " ")
    ]
    found = _near(field, vessels, entry, inner, are_thin=True)
    if found is None:
        return None
    places, surface = found
    if not len(places):
        return LOOK_MM
    gap = np.linalg.norm(places - _feet(places, entry, inner), axis=1) - surface
    return float(np.clip(gap.min(), 0.0, LOOK_MM))


def spine_mm(field: TissueField, place: FloatArray) -> tuple[float, bool] | None:
    """Return how far a place lies from the spine's mid-line [mm], and whether beside or behind it.

    By what is named spine, vertebra or spinal canal, else by bone as thick as vertebral bodies
    alone are. None where there is none at this height.
    """
    middle = _spine_at(field, float(place[2]))
    if middle is None:
        return None
    across = place[:2] - middle
    if across[1] > -_FRONT_MM:
        return float(abs(across[0])), True
    return float(np.hypot(*across)), False


def is_protected(spine: tuple[float, bool] | None, borders: Borders) -> bool | None:
    """Tell whether a rib's border covers the artery; None where spine or rib is not known."""
    if spine is None or borders.below_mm is None:
        return None
    away, is_behind = spine
    return not (is_behind and away < PROTECTED_FROM_MM)


def _spine_at(field: TissueField, z_mm: float) -> FloatArray | None:
    """Return the spine's middle at a height, LPS x and y [mm]."""
    named = [one.code for one in field.tissues if _is_spine(one)]
    corners = field.affine_mm
    step = corners[2, 2]
    if abs(step) < 1e-9:
        return None
    layers = (z_mm + np.array([-_SLAB_MM, _SLAB_MM]) - corners[2, 3]) / step
    low, high = np.clip(np.sort(layers), 0, field.labels.shape[0] - 1).astype(int)
    slab = field.labels[low : high + 1]
    chosen = np.isin(slab, named) if named else np.zeros(slab.shape, bool)
    if chosen.sum() < _LEAST_VOXELS:
        bone = np.isin(slab, [one.code for one in field.of_kind(TissueKind.BONE)])
        if not bone.any():
            return None
        deep = ndimage.distance_transform_edt(bone, sampling=field.spacing_mm[::-1])
        chosen = np.asarray(deep) > _THICK_MM
        if chosen.sum() < _LEAST_VOXELS:
            return None
    k, j, i = np.nonzero(chosen)
    ijk = np.column_stack([i, j, k + low])
    places = ijk @ corners[:3, :3].T + corners[:3, 3]
    middle: FloatArray = np.array([0.5 * (places[:, 0].min() + places[:, 0].max()), 0.0])
    middle[1] = places[:, 1].mean()
    return middle


def _is_cartilage(tissue: FieldTissue) -> bool:
    return tissue.name.casefold().replace("_", " ").startswith(("cartilage", "costal cartilage"))


def _is_spine(tissue: FieldTissue) -> bool:
    words = tissue.name.casefold().replace("_", " ")
    return words.startswith(("spinal canal", "vertebra", "spine"))


def _near(
    field: TissueField,
    codes: list[int],
    entry: FloatArray,
    inner: FloatArray,
    are_thin: bool = False,
) -> tuple[FloatArray, FloatArray] | None:
    """Return voxels of some codes about a path, LPS, and how deep they lie in them [mm].

    None where no voxel of the whole field has one of the codes. Of what is thin no voxel lies
    deeper than the nearest voxel that is none: boundaries beside it may mislead a field's distance.
    """
    ends = np.array([entry, inner])
    ijk = ends @ field.inverse_mm[:3, :3].T + field.inverse_mm[:3, 3]
    room = np.ceil((LOOK_MM + 3.0) / field.spacing_mm)
    size = np.array(field.labels.shape)
    first = np.clip(np.floor(ijk.min(axis=0) - room)[::-1], 0, size - 1).astype(int)
    last = np.clip(np.ceil(ijk.max(axis=0) + room)[::-1] + 1, first + 1, size).astype(int)
    box = tuple(slice(a, b) for a, b in zip(first.tolist(), last.tolist(), strict=True))
    chosen = np.isin(field.labels[box], codes)
    if not chosen.any():
        if not codes or not np.isin(field.labels, codes).any():
            return None
        return np.zeros((0, 3)), np.zeros(0)
    at: NDArray[np.intp] = np.argwhere(chosen)
    places = (at + first)[:, ::-1] @ field.affine_mm[:3, :3].T + field.affine_mm[:3, 3]
    deep = field.distance[box][chosen] / STEPS_PER_MM
    if are_thin:
        outside = ndimage.distance_transform_edt(chosen, sampling=field.spacing_mm[::-1])
        deep = np.minimum(deep, np.asarray(outside)[chosen])
    return places, deep


def _feet(places: FloatArray, entry: FloatArray, inner: FloatArray) -> FloatArray:
    """Return the place of a segment that is nearest to each of some places, shape (n, 3)."""
    way = inner - entry
    share = np.clip((places - entry) @ way / max(float(way @ way), 1e-12), 0.0, 1.0)
    feet: FloatArray = entry + share[:, None] * way
    return feet


def _tuple(place: FloatArray) -> Place:
    x, y, z = place.tolist()
    return x, y, z
