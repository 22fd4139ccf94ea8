"""A CT with air in the pleural space and blood in the lung: how control scans show complications.

The lung falls back towards a point at its hilum, on the side to which gravity pulls: every place
x of it goes to c + s (x - c), with s³ the volume that is left (the cubes of Light's index, share =
1 - s³). What it leaves is air, most where the chest is uppermost. Lung that takes less room
is denser: its air goes, its tissue stays. A solid lesion keeps size and density: it moves with the
lung and turns with it. Chest wall, heart and the other lung stay. Blood is a ground glass about the
needle's way, a consolidation next to it where there is much.

Everything is bounded: a share is taken between 0 and `MOST`, and whatever is not finite is refused.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import ndimage

from app.core.arrays import FloatArray, frozen
from app.imaging.field.tissue_field import TissueField, TissueKind
from app.imaging.inside import MOST, Inside, left_over, middle_mm
from app.imaging.volume import Volume

AIR_HU: Final = -1000.0
SOLID_HU: Final = -350.0
"""What is denser in the lung keeps its density: vessels, lesions."""

GLASS_HU, BLOOD_HU = -480.0, 20.0
"""Ground glass, and blood that fills the lung."""

TURN_RAD: Final = 0.5
"""A lesion turns by so much for each whole hemithorax: a teaching estimate."""

LESION_MM: Final = 8.0
"""Tissue so near about a lesion moves with it as one; further out it shrinks with the lung."""

CLOSING_MM: Final = 6.0
"""Vessels and lesions in the lung up to twice so thick belong to it."""

WITHIN: Final = (TissueKind.LUNG, TissueKind.AIR, TissueKind.VESSEL)
SLICE_MARGIN_MM: Final = 2.0


def cavity(
    field: TissueField, is_left: bool, lesion_mm: ArrayLike, range_mm: tuple[float, float]
) -> LungGrid:
    """Return what moves as one lung between two heights: 1 in it and in what lies in it, else 0.

    Args:
        field: of the patient's tissue.
        is_left: which lung.
        lesion_mm: in the lesion that goes along with it, LPS, shape (3,).
        range_mm: LPS z between which it is wanted.
    """
    lesion = int(field.codes_at(frozen(lesion_mm, (3,), "lesion_mm")[None])[0])
    rounds = max(1, round(CLOSING_MM / float(field.spacing_mm.min())))
    layers = np.arange(field.labels.shape[0])
    z = layers * field.affine_mm[2, 2] + field.affine_mm[2, 3]
    margin = CLOSING_MM + 2.0 * float(field.spacing_mm[2])
    wanted = layers[(z >= min(range_mm) - margin) & (z <= max(range_mm) + margin)]
    if not len(wanted):
        return LungGrid(np.zeros((1, 1, 1), np.float32), field.affine_mm)
    labels = field.labels[wanted[0] : wanted[-1] + 1]
    lung = np.isin(labels, [tissue.code for tissue in field.of_kind(TissueKind.LUNG)])
    middle = (middle_mm(field) - field.affine_mm[0, 3]) / max(field.affine_mm[0, 0], 1e-9)
    lung &= (np.arange(labels.shape[2]) > middle) == is_left
    boxes = ndimage.find_objects(lung.astype(np.int8))
    if not boxes:
        return LungGrid(np.zeros((1, 1, 1), np.float32), field.affine_mm)
    box = tuple(slice(max(0, p.start - rounds - 1), p.stop + rounds + 1) for p in boxes[0])
    ball = ndimage.generate_binary_structure(3, 1)
    padded = np.pad(lung[box], rounds, mode="edge")  # the lung goes on where the range ends
    closed = ndimage.binary_closing(padded, ball, iterations=rounds)
    cut = tuple(slice(rounds, -rounds) for _ in range(3))
    within = [t.code for t in field.tissues if t.kind in WITHIN] + [lesion]
    whole = lung[box] | (closed[cut] & np.isin(labels[box], within))
    corner = np.array([box[2].start, box[1].start, box[0].start + int(wanted[0])], np.float64)
    affine = field.affine_mm.copy()
    affine[:3, 3] += affine[:3, :3] @ corner
    return LungGrid(whole.astype(np.float32), affine)


def changed_ct(
    volume: Volume,
    field: TissueField | None,
    inside: Inside | None,
    range_mm: tuple[float, float] | None = None,
) -> Volume:
    """Return the CT with what complications have changed; the same volume where they have nothing.

    Args:
        volume: the patient's CT.
        field: of the patient's tissue, for where the lung is; None changes nothing.
        inside: what has changed.
        range_mm: LPS z between which it is wanted; None for all of it.
    """
    if inside is None or field is None or not inside.changes:
        return volume
    rows = _rows(volume, range_mm)
    if not len(rows):
        return volume
    hu = np.array(volume.hu)
    ends = _heights(volume, rows[[0, -1]]).ravel()
    before = inside.centre_mm[2] + (ends - inside.centre_mm[2]) / left_over(inside.share)
    z = [*ends.tolist(), *before.tolist(), float(inside.lesion_mm[2])]
    lung = cavity(field, inside.is_left, inside.lesion_mm, (min(z), max(z)))
    box = _pixels(volume, lung, rows)
    for k in rows.tolist():
        _change_slice(hu, k, box, volume, lung, inside)
    return replace(volume, hu=hu)


@dataclass(frozen=True, eq=False)
class LungGrid:
    """Values on a grid: array of shape (K, J, I), and voxel (i, j, k) -> LPS [mm]."""

    values: NDArray[np.float32]
    affine_mm: FloatArray

    @cached_property
    def inverse_mm(self) -> FloatArray:
        """LPS [mm] -> voxel (i, j, k), shape (4, 4)."""
        return np.asarray(np.linalg.inv(self.affine_mm))


def _pixels(volume: Volume, lung: LungGrid, rows: NDArray[np.intp]) -> tuple[slice, slice]:
    """Return rows and columns of the CT about the lung."""
    k, j, i = lung.values.shape
    ends = np.array([[a, b, c] for a in (0, i - 1) for b in (0, j - 1) for c in (0, k - 1)])
    places = ends @ lung.affine_mm[:3, :3].T + lung.affine_mm[:3, 3]
    at = places @ volume.inverse_mm[:3, :3].T + volume.inverse_mm[:3, 3]
    low = np.floor(at.min(axis=0)).astype(int) - 1
    high = np.ceil(at.max(axis=0)).astype(int) + 2
    return slice(max(0, low[1]), max(0, high[1])), slice(max(0, low[0]), max(0, high[0]))


def _change_slice(
    hu: NDArray[Any],
    k: int,
    box: tuple[slice, slice],
    volume: Volume,
    lung: LungGrid,
    inside: Inside,
) -> None:
    part = hu[k][box]
    rows, columns = np.mgrid[: part.shape[0], : part.shape[1]]
    ijk = np.stack(
        [columns.ravel() + box[1].start, rows.ravel() + box[0].start, np.full(part.size, k)], axis=1
    )
    places = volume.lps_mm(ijk)
    own = _sampled(lung.values, places, lung)
    touched = own > 0.0
    if not touched.any():
        return
    source = _before(places[touched], inside)
    values = _sampled(volume.hu, source, volume, AIR_HU)
    grown = np.minimum(-1000.0 + (values + 1000.0) / left_over(inside.share) ** 3, SOLID_HU)
    values = np.where(values < SOLID_HU, np.maximum(values, grown), values)
    if inside.way_mm is not None and inside.blood_mm > 0.0:
        values = _bled(values, source, inside.way_mm, inside)
    share = own[touched]
    if inside.share > 0.0:
        moved = _sampled(lung.values, source, lung)
        values = moved * values + (1.0 - moved) * AIR_HU
    before = part.reshape(-1)[touched].astype(np.float64)
    new = np.clip(share * values + (1.0 - share) * before, -1024.0, 3071.0)
    flat = part.reshape(-1)
    flat[touched] = np.rint(new).astype(hu.dtype)
    hu[k][box] = flat.reshape(part.shape)


def _before(places: FloatArray, inside: Inside) -> FloatArray:
    """Return where the tissue at places lay before, shape (n, 3)."""
    s = left_over(inside.share)
    shrunk = inside.centre_mm + (places - inside.centre_mm) / s
    if inside.share <= 0.0:
        return shrunk
    lesion = inside.lesion_mm + inside.displacement_mm
    away = places - lesion
    turn = TURN_RAD * min(MOST, inside.share) * (1.0 if inside.is_left else -1.0)
    cosine, sine = np.cos(turn), np.sin(turn)
    turned = away @ np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    solid = inside.lesion_mm + turned
    far = np.linalg.norm(away, axis=1)
    share = np.clip(2.0 - far / LESION_MM, 0.0, 1.0)
    share = share * share * (3.0 - 2.0 * share)
    return np.asarray(share[:, None] * solid + (1.0 - share[:, None]) * shrunk)


def _bled(values: FloatArray, source: FloatArray, way: FloatArray, inside: Inside) -> FloatArray:
    """Return values with blood about the needle's way, shape (n,)."""
    along = way[1] - way[0]
    length2 = max(float(along @ along), 1e-9)
    share = np.clip((source - way[0]) @ along / length2, 0.0, 1.0)
    far = np.linalg.norm(source - way[0] - share[:, None] * along, axis=1) / inside.blood_mm
    glass = np.clip(1.5 * (1.0 - far), 0.0, 1.0)
    blood = np.clip(2.0 * (0.5 - far), 0.0, 1.0) if inside.dense else np.zeros_like(far)
    shown = np.where(values < GLASS_HU, values + glass * (GLASS_HU - values), values)
    return np.asarray(np.where(shown < BLOOD_HU, shown + blood * (BLOOD_HU - shown), shown))


def _sampled(
    array: NDArray[Any], places: FloatArray, grid: Volume | LungGrid, outside: float = 0.0
) -> FloatArray:
    """Return an array between its voxels, by LPS places, shape (n, 3) -> (n,)."""
    ijk = places @ grid.inverse_mm[:3, :3].T + grid.inverse_mm[:3, 3]
    found = ndimage.map_coordinates(
        array, ijk[:, ::-1].T, output=np.float64, order=1, mode="constant", cval=outside
    )
    return np.asarray(found)


def _rows(volume: Volume, range_mm: tuple[float, float] | None) -> NDArray[np.intp]:
    """Return the slices of a CT that lie between two heights, as many as may touch them."""
    numbers = np.arange(volume.size[2])
    if range_mm is None:
        return numbers
    z = _heights(volume, numbers)
    step = float(volume.spacing_mm[2]) + SLICE_MARGIN_MM
    low, high = min(range_mm) - step, max(range_mm) + step
    return np.flatnonzero((z.max(axis=1) >= low) & (z.min(axis=1) <= high))


def _heights(volume: Volume, numbers: NDArray[np.intp]) -> FloatArray:
    """Return LPS z at the corners of slices, shape (n, 4)."""
    i, j, _ = volume.size
    corners = [(0, 0), (i - 1, 0), (0, j - 1), (i - 1, j - 1)]
    z = volume.affine_mm[2]
    return np.array([[z @ (a, b, k, 1.0) for a, b in corners] for k in numbers.tolist()])
