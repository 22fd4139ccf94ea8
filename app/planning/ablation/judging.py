"""What zones do to a patient: the lesion's share, the margin about it, vessels near, what is burnt.

The lesion and its organ are what the tissue field has at the target. A margin is asked for within
the organ alone: what lies beyond its capsule need not be ablated (Sandu 2021, doi
10.3389/fonc.2021.623098, leaves it out too). No table of what a vessel cools away was found: great
vessels within 3 mm of the zone are named, and nothing is subtracted.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray, read_only
from app.imaging.field.naming import LUNG_VESSEL, SMALL_VESSEL
from app.imaging.field.tissue_field import STEPS_PER_MM, TissueField, TissueKind
from app.imaging.field.walking import holding
from app.planning.ablation.covering import (
    MOST_MM,
    depths_in_union,
    in_union,
    margins_mm,
    volumes,
)
from app.planning.ablation.zone import Zone
from app.planning.sampling import lesion_code

VESSEL_MM: Final = 3.0
"""A great vessel so near to the zone cools it: stated as a warning, not reckoned."""

REACHED_MM3: Final = 20.0
"""A tissue of which less lies in the zone is not reached: two voxels of a usual field."""

MAP_STEP_MM: Final = 1.5
"""Places of the lesion's surface at which the margin is kept lie about so far apart."""

_BESIDE: Final = 4  # voxels about the lesion within which depths are known
_SMALL: Final = frozenset({SMALL_VESSEL, LUNG_VESSEL})
_HARMED: Final = (
    TissueKind.SKIN,
    TissueKind.LUNG,
    TissueKind.GUT,
    TissueKind.HEART,
    TissueKind.BONE,
)
_NAMED: Final = frozenset({"diaphragm"})
_MOST_VOXELS: Final = 100  # to each side of the target that are searched for the lesion


@dataclass(frozen=True, slots=True, eq=False)
class _Signed:
    """Depth below a lesion's surface on the field's own voxels, trilinear between them.

    Inside it is the field's own distance, and outside too where that can be the lesion's wall;
    where another wall is nearer, it is the way to the nearest voxel of the lesion less its own.

    Attributes:
        depth_mm: of each voxel, shape (nz, ny, nx).
        affine_mm: its voxel (i, j, k) -> LPS, shape (4, 4).
        box_mm: corners that hold the lesion, each of shape (3,).
    """

    depth_mm: FloatArray
    affine_mm: FloatArray
    box_mm: tuple[FloatArray, FloatArray]

    @classmethod
    def of(cls, field: TissueField, code: int, target: FloatArray) -> _Signed:
        from scipy import ndimage  # the window is there before it

        to_voxel, shape = field.inverse_mm, np.array(field.labels.shape[::-1])
        ijk = np.rint(to_voxel[:3, :3] @ target + to_voxel[:3, 3]).astype(int)
        first = np.clip(ijk - _MOST_VOXELS, 0, shape - 1)
        last = np.clip(ijk + _MOST_VOXELS + 1, 1, shape)
        part = field.labels[first[2] : last[2], first[1] : last[1], first[0] : last[0]] == code
        pieces, _ = ndimage.label(part, np.ones((3, 3, 3), int))
        at = np.argwhere(pieces > 0)
        near = at[int(np.argmin(((at[:, ::-1] + first - ijk) ** 2).sum(axis=1)))]
        own = pieces == pieces[tuple(near)]
        inside = np.argwhere(own)
        low = np.maximum(inside.min(axis=0) - _BESIDE, 0)
        high = np.minimum(inside.max(axis=0) + _BESIDE + 1, own.shape)
        cut = tuple(slice(a, b) for a, b in zip(low, high, strict=True))
        own, begin = own[cut], low + first[::-1]
        held = field.distance[tuple(slice(a, a + n) for a, n in zip(begin, own.shape, strict=True))]
        distance = held / STEPS_PER_MM
        way, index = ndimage.distance_transform_edt(
            ~own, sampling=field.spacing_mm[::-1], return_indices=True
        )
        # No farther than by that voxel; and as far as the field says where it means this wall.
        most = np.maximum(way - distance[tuple(index)], 0.01)
        means_it = (most - distance < float(field.spacing_mm.max())) & (distance <= most)
        depth = np.where(own, distance, -np.where(means_it, distance, most))
        affine = np.array(field.affine_mm)
        affine[:3, 3] += affine[:3, :3] @ begin[::-1]
        corners = np.where(np.array(list(np.ndindex(2, 2, 2))), np.array(own.shape[::-1]) - 1, 0)
        places = corners @ affine[:3, :3].T + affine[:3, 3]
        return cls(read_only(depth), read_only(affine), (places.min(axis=0), places.max(axis=0)))

    def depths_mm(self, points_mm: FloatArray) -> FloatArray:
        """Return how deep places lie below the surface [mm], negative outside."""
        return self._between(self.depth_mm, points_mm)

    def surface_mm(self) -> FloatArray:
        """Return places of the surface, one for each voxel beside it, LPS, shape (n, 3)."""
        k, j, i = np.indices(self.depth_mm.shape).reshape(3, -1)
        close = np.abs(self.depth_mm.ravel()) < 1.1 * self._widest
        at = np.column_stack([i, j, k])[close]
        points = at @ self.affine_mm[:3, :3].T + self.affine_mm[:3, 3]
        slopes = np.gradient(self.depth_mm)[::-1]
        by_mm = np.linalg.inv(self.affine_mm[:3, :3])
        for _ in range(5):
            rise = np.stack([self._between(one, points) for one in slopes], axis=1) @ by_mm
            steep = np.maximum((rise * rise).sum(axis=1), 0.25)
            points = points - (self.depths_mm(points) / steep)[:, None] * rise
        return np.asarray(points[np.abs(self.depths_mm(points)) < 0.1])

    @property
    def _widest(self) -> float:
        return float(np.linalg.norm(self.affine_mm[:3, :3], axis=0).max())

    def _between(self, values: FloatArray, points_mm: FloatArray) -> FloatArray:
        from scipy import ndimage

        inverse = np.linalg.inv(self.affine_mm)
        ijk = np.asarray(points_mm, np.float64) @ inverse[:3, :3].T + inverse[:3, 3]
        found = ndimage.map_coordinates(values, ijk.T[::-1], order=1, mode="nearest")
        return np.asarray(found, np.float64)


@dataclass(frozen=True, slots=True, eq=False)
class Lesion:
    """The lesion at a target, and what holds it.

    Attributes:
        field: of the patient.
        code: of the lesion.
        held: codes of the lesion and its organ.
        box_mm: lowest and highest corner that holds it, each of shape (3,).
        surface_mm: places of its surface, LPS, shape (n, 3).
        volume_mm3: of it.
    """

    field: TissueField
    code: int
    held: NDArray[np.intp]
    box_mm: tuple[FloatArray, FloatArray]
    surface_mm: FloatArray
    volume_mm3: float
    _shape: _Signed

    @classmethod
    def at(cls, field: TissueField, target_mm: ArrayLike) -> Lesion:
        """Find it.

        Raises:
            PlanError: if nobody labelled a lesion at the target.
        """
        target = np.asarray(target_mm, np.float64)
        code = lesion_code(field, target)
        shape = _Signed.of(field, code, target)
        volume, _ = volumes(shape.depths_mm, (), shape.box_mm, cells=48)
        held = holding(field, target)
        return cls(field, code, held, shape.box_mm, read_only(shape.surface_mm()), volume, shape)

    def depths_mm(self, points_mm: FloatArray) -> FloatArray:
        """Return how deep places lie below the lesion's surface [mm], negative outside."""
        return self._shape.depths_mm(points_mm)

    def in_organ(self, points_mm: FloatArray) -> NDArray[np.bool_]:
        """Return which places belong to the lesion's organ, shape (n,).

        Vessels within it do: what runs there is left out of no margin.
        """
        looked = self.field.look_up(points_mm)
        vessels = [tissue.code for tissue in self.field.of_kind(TissueKind.VESSEL)]
        runs = np.isin(looked.code, vessels) & np.isin(looked.other, self.held)
        return np.isin(looked.code, self.held) | runs


@dataclass(frozen=True, slots=True, eq=False)
class Near:
    """Something in or near the zone.

    Attributes:
        name: of the tissue.
        kind: of it.
        distance_mm: from the zone; 0 where it reaches into it.
        volume_mm3: of it in the zone.
    """

    name: str
    kind: TissueKind
    distance_mm: float
    volume_mm3: float


@dataclass(frozen=True, slots=True, eq=False)
class Ablation:
    """What zones do.

    Attributes:
        zones: of the electrodes, in order.
        surface_mm: places of the lesion's surface, LPS, shape (n, 3).
        margin_mm: there, negative where not covered, shape (n,).
        least_mm: least margin, of surface and inside.
        share: of the lesion that is covered, 0 to 1.
        lesion_mm3: volume of the lesion.
        vessels: great vessels within 3 mm.
        reached: what else the zone reaches, beyond the organ and what fills the body wall.
    """

    zones: tuple[Zone, ...]
    surface_mm: FloatArray
    margin_mm: FloatArray
    least_mm: float
    share: float
    lesion_mm3: float
    vessels: tuple[Near, ...] = ()
    reached: tuple[Near, ...] = ()

    @property
    def where_mm(self) -> FloatArray:
        """Return where on the surface the margin is least, LPS, shape (3,)."""
        return np.asarray(self.surface_mm[int(np.argmin(self.margin_mm))])


def judge(lesion: Lesion, zones: Sequence[Zone], cells: int = 48) -> Ablation:
    """Say what zones do to a lesion and to what lies about it.

    Args:
        lesion: see `Lesion.at`.
        zones: of the electrodes.
        cells: of the integral along the lesion's longest side.
    """
    margins = margins_mm(lesion.surface_mm, zones, lesion.in_organ)
    whole, covered = volumes(lesion.depths_mm, zones, lesion.box_mm, cells)
    share = min(1.0, max(0.0, covered / whole)) if whole > 0.0 else 0.0
    least = min(float(margins.min()), _left_inside(lesion, zones))
    vessels, reached = _around(lesion, zones)
    at = _thinned(lesion.surface_mm, MAP_STEP_MM)
    at = np.union1d(at, [int(np.argmin(margins))])
    return Ablation(
        tuple(zones),
        read_only(lesion.surface_mm[at]),
        read_only(margins[at]),
        least,
        share,
        whole,
        vessels,
        reached,
    )


def _left_inside(lesion: Lesion, zones: Sequence[Zone]) -> float:
    """Return the margin of what is left inside the lesion: minus its distance from the zones."""
    grid, codes = _voxels(lesion.field, *lesion.box_mm)
    left = grid[(codes == lesion.code) & ~in_union(zones, grid)]
    if not len(left):
        return MOST_MM
    return max(float(depths_in_union(zones, left).min()), -MOST_MM)


def _voxels(
    field: TissueField, low: FloatArray, high: FloatArray
) -> tuple[FloatArray, NDArray[np.uint8]]:
    """Return the places, shape (n, 3), and codes of the field's voxels in a box; some beside it."""
    corners = np.where(np.array(list(np.ndindex(2, 2, 2))), high, low)
    ijk = corners @ field.inverse_mm[:3, :3].T + field.inverse_mm[:3, 3]
    shape = np.array(field.labels.shape[::-1])
    first = np.clip(np.floor(ijk.min(axis=0)).astype(int), 0, shape)
    last = np.clip(np.ceil(ijk.max(axis=0)).astype(int) + 1, 0, shape)
    part = field.labels[first[2] : last[2], first[1] : last[1], first[0] : last[0]]
    if not part.size:
        return np.empty((0, 3)), np.empty(0, np.uint8)
    k, j, i = np.indices(part.shape).reshape(3, -1)
    at = np.column_stack([i, j, k]) + first
    return at @ field.affine_mm[:3, :3].T + field.affine_mm[:3, 3], part.ravel()


def _around(lesion: Lesion, zones: Sequence[Zone]) -> tuple[tuple[Near, ...], tuple[Near, ...]]:
    """Return the vessels near the zones, and what else they reach, by the field's voxels."""
    if not zones:
        return (), ()
    field = lesion.field
    low = np.min([zone.box_mm[0] for zone in zones], axis=0) - VESSEL_MM
    high = np.max([zone.box_mm[1] for zone in zones], axis=0) + VESSEL_MM
    grid, codes = _voxels(field, low, high)
    voxel = abs(float(np.linalg.det(field.affine_mm[:3, :3])))
    vessels, reached = list[Near](), list[Near]()
    for code in np.unique(codes).tolist():
        tissue = field.tissues[code]
        name = tissue.name or tissue.kind.value
        places = grid[codes == code]
        if tissue.kind is TissueKind.VESSEL and name not in _SMALL:
            distance = -float(depths_in_union(zones, places).max())
            if distance <= VESSEL_MM:
                volume = float(in_union(zones, places).sum()) * voxel
                vessels.append(Near(name, tissue.kind, max(0.0, distance), volume))
        elif code not in lesion.held and _counts(tissue.kind, name):
            volume = float(in_union(zones, places).sum()) * voxel
            if volume >= REACHED_MM3:
                reached.append(Near(name, tissue.kind, 0.0, volume))
    reached += _beyond(field, zones)
    by_distance = sorted(vessels, key=lambda one: (one.distance_mm, one.name))
    return tuple(by_distance), tuple(sorted(reached, key=lambda one: -one.volume_mm3))


def _beyond(field: TissueField, zones: Sequence[Zone]) -> list[Near]:
    """Say whether zones leave the field, of which nobody knows anything."""
    whole = np.array(field.labels.shape[::-1]) - 1
    for zone in zones:
        corners = np.where(np.array(list(np.ndindex(2, 2, 2))), zone.box_mm[1], zone.box_mm[0])
        ijk = corners @ field.inverse_mm[:3, :3].T + field.inverse_mm[:3, 3]
        if (ijk < 0.0).any() or (ijk > whole).any():
            return [Near(TissueKind.UNKNOWN.value, TissueKind.UNKNOWN, 0.0, zone.volume_mm3)]
    return []


def _counts(kind: TissueKind, name: str) -> bool:
    if kind in (TissueKind.AIR, TissueKind.UNKNOWN):
        return True  # the zone leaves the body, or what anybody labelled
    return kind in _HARMED or kind is TissueKind.ORGAN or name in _NAMED


def _thinned(points: FloatArray, step_mm: float) -> NDArray[np.intp]:
    """Return the numbers of places of which no two lie in one cell of a grid."""
    cells = np.floor(points / step_mm).astype(int)
    return np.asarray(np.unique(cells, axis=0, return_index=True)[1])
