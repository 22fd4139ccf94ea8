"""How a patient lies at another breath than the planning CT's: organs move, his wall stays.

Every place has a share of the target's displacement, as the simulated tissue moves
(`simulation.bound_field`): 1 at the target, less towards the spine; in the lung from the base to 0
at the apex; 0 in the wall of the body. What lies between organs, as fat does, goes along with them.
Within `RAMP_MM` of the wall the share falls to 0: what slides along it in the patient is sheared
here, so that the displacement is smooth. Ribs go along a little, and more the farther to the front:
the simulated needle feels them at rest, so that a picture shows them by up to `RIBS` of the
displacement beside where they are felt.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from app.core.arrays import FloatArray, frozen, read_only
from app.imaging.field import FieldError, TissueField, TissueKind
from app.imaging.interpolation import interpolate
from app.imaging.volume import Volume

MOVING = (
    TissueKind.ORGAN,
    TissueKind.VESSEL,
    TissueKind.GUT,
    TissueKind.HEART,
    TissueKind.LUNG,
)
"""What goes along with breathing."""

RIBS = 0.1
"""Share of the ribs in front, an estimate; none at the spine."""

AT_SPINE = 0.5
LIMITS = (0.5, 1.2)
"""Share at the spine, and the least and most of all organs."""

INFLATED = 2.0
"""The lung's share at most, below a target in it."""

RAMP_MM = 6.0
"""So near to the wall an organ is held back."""

GAP_MM = 15.0
"""What lies between organs, with so much room at most, goes along."""

SOFT_MM = 4.0
"""Deviation of the bell by which shares are smoothed."""

SHALLOW_MM = 30.0
"""Nearer to the spine, or in a lung no higher, place makes no difference."""

SPACING_MM = 3.0
"""Of the grid on which shares are given."""

_LEAST = 1e-3
_STEPS = 3


@dataclass(frozen=True, slots=True, eq=False)
class BreathShares:
    """Share of the target's displacement by place.

    Attributes:
        inside: how far the wall lets a place go, 0 in it to 1, shape (nz, ny, nx), read-only.
        shares: of what rests at a place, where nothing holds it, likewise.
        ribs: of bone at a place, likewise.
        inverse_mm: LPS [mm] -> voxel (i, j, k), shape (4, 4).
    """

    inside: NDArray[np.float32]
    shares: NDArray[np.float32]
    ribs: NDArray[np.float32]
    inverse_mm: FloatArray

    def resting(self, lps_mm: FloatArray, shift_mm: FloatArray) -> FloatArray:
        """Return where what is at points now rests, LPS [mm], shape (n, 3).

        The wall is looked up where a point is, for it stays; the organ where it came from.
        """
        resting, share = lps_mm.copy(), self._at(self.ribs, lps_mm)
        inside = self._at(self.inside, lps_mm)
        free = np.flatnonzero(inside > 0.0)
        place, own = lps_mm[free], np.ones(len(free))
        for _ in range(_STEPS):  # smooth by place: each step is ten times nearer
            own = self._at(self.shares, place - own[:, None] * shift_mm)
        share[free] += inside[free] * own
        moved = np.flatnonzero(share > _LEAST)
        resting[moved] -= share[moved, None] * shift_mm
        return resting

    def _at(self, values: NDArray[np.float32], lps_mm: FloatArray) -> FloatArray:
        """Read values at points [mm], shape (n, 3) -> (n,); 0 beyond the grid."""
        kji = (lps_mm @ self.inverse_mm[:3, :3].T + self.inverse_mm[:3, 3])[:, ::-1]
        read = ndimage.map_coordinates(values, kji.T, order=1, mode="constant", cval=0.0)
        return np.asarray(read, np.float64)


def shares_of(field: TissueField, target_mm: FloatArray) -> BreathShares:
    """Return the shares in a field of tissue about a target at rest, LPS [mm], shape (3,)."""
    kinds = [tissue.kind for tissue in field.tissues]
    labels, spacing = field.labels, field.spacing_mm[::-1]

    def where(*wanted: TissueKind) -> NDArray[np.bool_]:
        return np.isin(labels, [code for code, kind in enumerate(kinds) if kind in wanted])

    moving, lung, bone = where(*MOVING), where(TissueKind.LUNG), where(TissueKind.BONE)
    stays = where(TissueKind.BONE, TissueKind.SKIN, TissueKind.MUSCLE, TissueKind.AIR)
    _, y, z = _places(labels.shape, field.affine_mm)
    share, ribs = np.ones(labels.shape, np.float32), np.zeros(labels.shape, np.float32)
    if bone.any():
        behind, front = float(np.percentile(y[bone], 90.0)), float(y[bone].min())
        way = behind - float(target_mm[1])
        if way >= SHALLOW_MM:
            share = np.clip(1.0 + (AT_SPINE - 1.0) * (y - target_mm[1]) / way, *LIMITS)
        rising = np.clip((behind - y) / max(behind - front, SHALLOW_MM), 0.0, 1.0)
        ribs = np.where(bone, RIBS * rising, 0.0)
    if lung.any() and float(np.ptp(z[lung])) >= SHALLOW_MM:
        apex, height = float(z[lung].max()), float(np.ptp(z[lung]))
        inside = _nearest(lung, field.inverse_mm, target_mm)
        reference = max(apex - float(target_mm[2]) if inside else height, SHALLOW_MM)
        share = np.where(lung, share * np.clip((apex - z) / reference, 0.0, INFLATED), share)
    cavity = _closed(moving, spacing) & ~stays
    away = ndimage.distance_transform_edt(cavity, sampling=spacing)
    held = float(_value(away, field.inverse_mm, target_mm))
    ramp = max(1.0, min(RAMP_MM, held))  # a target near the wall goes along all the same

    def soft(values: NDArray[Any]) -> NDArray[np.float32]:
        return np.asarray(
            ndimage.gaussian_filter(values.astype(np.float32), SOFT_MM / spacing), np.float32
        )

    smooth = soft(share * cavity) / np.maximum(soft(cavity), 1e-3)  # nothing of the wall in it
    smooth = np.where(soft(cavity) > 1e-3, smooth, share)
    walls = read_only(np.clip(away / ramp, 0.0, 1.0).astype(np.float32))
    inverse = frozen(field.inverse_mm, (4, 4))
    return BreathShares(walls, read_only(smooth), read_only(ribs.astype(np.float32)), inverse)


def _closed(mask: NDArray[np.bool_], spacing: FloatArray) -> NDArray[np.bool_]:
    """Fill what lies between the parts of a mask, up to `GAP_MM` from them."""
    grown = ndimage.distance_transform_edt(~mask, sampling=spacing) <= GAP_MM
    filled: NDArray[np.bool_] = (
        ndimage.distance_transform_edt(np.pad(grown, 1, mode="edge"), sampling=spacing) > GAP_MM
    )[1:-1, 1:-1, 1:-1]
    return filled | mask


Target = tuple[float, float, float]

_MADE: WeakKeyDictionary[Volume, tuple[Target, BreathShares]] = WeakKeyDictionary()
"""Of each CT that is still open, what was asked for last."""


def shares_of_ct(volume: Volume, target_mm: Target) -> BreathShares | None:
    """Return the shares in a CT; None where its tissue cannot be told: then all of it moves."""
    from app.imaging.field.making import field_of

    there = _MADE.get(volume)
    if there is not None and there[0] == target_mm:
        return there[1]
    try:
        shares = shares_of(field_of(volume, spacing_mm=SPACING_MM), np.array(target_mm))
    except FieldError:
        return None
    _MADE[volume] = target_mm, shares
    return shares


def _places(
    shape: tuple[int, ...], affine: FloatArray
) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.float32]]:
    """Return x, y and z of every voxel, LPS [mm], shape (nz, ny, nx) each."""
    k, j, i = np.meshgrid(*(np.arange(n, dtype=np.float32) for n in shape), indexing="ij")
    rows = affine[:3].astype(np.float32)
    x, y, z = (row[0] * i + row[1] * j + row[2] * k + row[3] for row in rows)
    return x, y, z


def _voxel(inverse: FloatArray, place_mm: FloatArray) -> FloatArray:
    ijk: FloatArray = inverse[:3, :3] @ place_mm + inverse[:3, 3]
    return ijk


def _value(values: NDArray[np.float64], inverse: FloatArray, place_mm: FloatArray) -> float:
    return float(interpolate(values, _voxel(inverse, place_mm)[None])[0])


def _nearest(mask: NDArray[np.bool_], inverse: FloatArray, place_mm: FloatArray) -> bool:
    last = np.array(mask.shape[::-1]) - 1
    i, j, k = np.clip(np.rint(_voxel(inverse, place_mm)).astype(int), 0, last).tolist()
    return bool(mask[k, j, i])
