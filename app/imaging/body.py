"""Body and skin of a patient in a CT: what is inside, and where a line or a click meets the skin.

The body is the largest connected piece of anything denser than air, without the table, and with
its lungs and bowel filled. It is found on a coarse grid (about 2.5 mm), which takes a fraction of
a second; the skin itself is then placed to a fraction of a voxel in the full data.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import ndimage
from scipy.spatial import cKDTree

from app.core.arrays import FloatArray, frozen, read_only, unit
from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.errors import InvalidEntryError
from app.imaging.interpolation import interpolate
from app.imaging.orthogonal import nearest_axes
from app.imaging.volume import Volume

SKIN_HU: Final = -400.0
"""Hounsfield value that divides air from tissue, half way to within 10 %."""

GRID_MM: Final = 2.5
"""Spacing of the coarse grid, as near as whole voxels allow."""

SNAP_MM: Final = 10.0
"""A point this near to the skin is taken to mean the skin."""

_TABLE_MM: Final = 5.0
_REFINE_MM: Final = 6.0
_STEP_MM: Final = 0.25
_ITERATIONS: Final = 6

_PAD: Final = 4
_ROUNDING: Final = 1e-9

_CORNERS: Final = np.argwhere(np.ones((3, 3, 3), bool)) - 1.0
_AROUND: Final = np.vstack(
    [radius * v / np.linalg.norm(v) for radius in (3.0, 6.0) for v in _CORNERS if v.any()]
)
"""Points around one, evenly to all sides, shape (52, 3) [mm]."""

Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Body:
    """The body in a volume.

    Attributes:
        volume: the CT.
        factors: voxels per cell of the coarse grid along i, j, k; cell centres lie on voxels
            0, f, 2f, ...
        coarse: shape (K', J', I'), True inside, read-only.
        skin_level: value that divides air from tissue; `SKIN_HU` but for volumes without a unit.
    """

    volume: Volume
    factors: tuple[int, int, int]
    coarse: Mask
    skin_level: float = SKIN_HU

    @cached_property
    def _soft(self) -> NDArray[np.float32]:
        return read_only(self.coarse.astype(np.float32))

    @cached_property
    def _skin_tree(self) -> Any:
        kji = np.argwhere(self.coarse & ~ndimage.binary_erosion(self.coarse, border_value=1))
        return cKDTree(self.volume.lps_mm(kji[:, ::-1] * self.factors))

    def share(self, lps_mm: ArrayLike) -> FloatArray:
        """Return how much of the surroundings of each point [mm] is body, shape (n, 3) -> (n,), 0
        to 1.
        """
        ijk = self.volume.voxel(lps_mm)
        inside = ((ijk >= -0.5) & (ijk <= np.array(self.volume.size) - 0.5)).all(axis=1)
        share = np.zeros(len(ijk))
        if inside.any():
            share[inside] = interpolate(self._soft, ijk[inside] / self.factors)
        return share

    def nearest_cell_mm(self, lps_mm: ArrayLike) -> tuple[float, FloatArray]:
        """Distance [mm] to the nearest cell of the skin, and its centre [mm], shape (3,).

        Raises:
            InvalidEntryError: if the volume holds no body.
        """
        if not self._skin_tree.n:
            raise InvalidEntryError(
                sentence("there is no body in this CT, so there is no skin"), np.inf
            )
        distance, index = self._skin_tree.query(np.asarray(lps_mm, np.float64))
        centre: FloatArray = self._skin_tree.data[index]
        return float(distance), centre


def find_body(volume: Volume, progress: Progress | None = None) -> Body:
    """Find the body; takes a few tenths of a second on a large CT, so keep the result.

    Raises:
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    i, j, k = (
        max(1, min(round(GRID_MM / s), n))
        for s, n in zip(volume.spacing_mm, volume.size, strict=True)
    )
    progress.report(0.0, sentence("looking for the body"))
    level = _skin_level(volume, volume.hu[::k, ::j, ::i])
    tissue = volume.hu[::k, ::j, ::i] > level
    cell_mm = volume.affine_mm[:3, :3] * (i, j, k)
    opened = ndimage.binary_opening(np.pad(tissue, _PAD, mode="edge"), _ball(cell_mm))
    progress.report(0.4, sentence("taking the table away"))
    body = _largest(opened[_PAD:-_PAD, _PAD:-_PAD, _PAD:-_PAD])
    progress.report(0.7, sentence("filling the lungs"))
    axis = 2 - nearest_axes(volume.direction)[0][2]  # array axis that runs along the patient
    body = _filled(body, axis)
    progress.report(1.0, sentence("body found"))
    return Body(volume, (i, j, k), read_only(body), level)


def _skin_level(volume: Volume, coarse: NDArray[Any]) -> float:
    """Value between air and tissue: known in Hounsfield units, else what parts the values best.

    Otsu, A threshold selection method from gray-level histograms, IEEE Trans. SMC 9 (1979) 62.
    """
    if volume.unit == "HU":
        return SKIN_HU
    counts, edges = np.histogram(coarse, bins=256)
    middles, below = (edges[:-1] + edges[1:]) / 2.0, np.cumsum(counts)
    above, mass = below[-1] - below, np.cumsum(counts * middles)
    with np.errstate(divide="ignore", invalid="ignore"):  # classes without a voxel
        between = below * above * (mass / below - (mass[-1] - mass) / above) ** 2
    if np.ptp(coarse) == 0:  # one value: neither air nor tissue
        return float("inf")
    best = np.flatnonzero(between >= np.nanmax(between) * (1.0 - 1e-9))  # between two peaks: many
    return float(edges[best[0] + 1] + edges[best[-1] + 1]) / 2.0


def _ball(cell_mm: FloatArray) -> Mask:
    """Structuring element of radius `_TABLE_MM`, axes (k, j, i).

    Args:
        cell_mm: vectors between cells along i, j, k as columns, right-angled or not, shape (3, 3).
    """
    across = 1.0 / np.linalg.norm(np.linalg.inv(cell_mm), axis=1)  # between planes of cells
    reach = np.minimum(np.floor(_TABLE_MM / across + _ROUNDING), _PAD).astype(int)
    grid = np.meshgrid(*(np.arange(-r, r + 1) for r in reach[::-1]), indexing="ij")
    offsets = np.stack(grid[::-1], axis=-1) @ cell_mm.T
    ball: Mask = (offsets**2).sum(axis=-1) <= _TABLE_MM**2 + _ROUNDING
    return ball


def _largest(mask: Mask) -> Mask:
    labels, count = ndimage.label(mask)
    if count == 0:
        return np.zeros_like(mask)
    sizes = np.bincount(labels.ravel())
    sizes[0] = 0
    largest: Mask = labels == int(np.argmax(sizes))
    return largest


def _filled(mask: Mask, axis: int) -> Mask:
    """Fill what each plane across an axis encloses, all planes in one pass."""
    joined = ndimage.generate_binary_structure(3, 1)
    joined[(slice(None),) * axis + ([0, 2],)] = False  # neighbours within a plane only
    pieces, count = ndimage.label(~mask, joined)
    is_open = np.zeros(count + 1, bool)
    for across in {0, 1, 2} - {axis}:  # what reaches the edge of its plane is outside
        is_open[np.moveaxis(pieces, across, 0)[[0, -1]]] = True
    is_open[0] = False  # the mask itself
    return ~is_open[pieces]


def body_mask(volume: Volume, body: Body | None = None) -> Mask:
    """Body on the volume's own grid, shape (K, J, I), the skin exact to a voxel, read-only.

    Args:
        volume: the CT.
        body: of that volume, where it has been found already.
    """
    found = body or find_body(volume)
    structure = np.ones((3, 3, 3), bool)
    inner = ndimage.binary_erosion(found.coarse, structure, border_value=1)
    outer = ndimage.binary_dilation(found.coarse, structure)
    cells = [
        np.minimum((np.arange(n) + f // 2) // f, m - 1)
        for n, f, m in zip(volume.hu.shape, found.factors[::-1], inner.shape, strict=True)
    ]
    mask = np.empty(volume.hu.shape, bool)
    rows = np.ix_(cells[1], cells[2])
    for cell in range(len(inner)):  # slab by slab: no second array of the volume's size
        slab = np.flatnonzero(cells[0] == cell)
        surely, maybe = inner[cell][rows], outer[cell][rows]
        for k in slab:
            np.greater(volume.hu[k], found.skin_level, out=mask[k])
            mask[k] &= maybe
            mask[k] |= surely
    return read_only(mask)


def is_inside(body: Body, lps_mm: ArrayLike) -> bool:
    """Return whether a point [mm], shape (3,), lies in the body (to about half a cell, 1.3 mm)."""
    return bool(body.share(np.asarray(lps_mm, np.float64)[None])[0] >= 0.5)


def skin_entry(body: Body, outside_lps: ArrayLike, inside_lps: ArrayLike) -> FloatArray:
    """Return where a line from outside first meets the skin [mm], shape (3,), to a fraction of a
    voxel.

    Args:
        body: the body.
        outside_lps: start of the line [mm], in the air.
        inside_lps: its end [mm].

    Raises:
        InvalidEntryError: if the line starts in the body or never meets it.
    """
    start, end = frozen(outside_lps, (3,), "outside"), frozen(inside_lps, (3,), "inside")
    if is_inside(body, start):
        depth = body.nearest_cell_mm(start)[0]
        raise InvalidEntryError(
            sentence("the line starts in the body, {depth:.1f} mm from the skin", depth=depth),
            depth,
        )
    length = float(np.linalg.norm(end - start))
    along = np.linspace(0.0, length, max(2, int(np.ceil(length / _STEP_MM)) + 1))
    direction = unit(end - start, "line") if length > 0.0 else np.zeros(3)
    inside = body.share(start + along[:, None] * direction) >= 0.5
    if not inside.any():
        distance = body.nearest_cell_mm(end)[0]
        raise InvalidEntryError(
            sentence(
                "the line never meets the body; its end is {distance:.1f} mm from the skin",
                distance=distance,
            ),
            distance,
        )
    coarse = float(along[int(np.argmax(inside))])
    return start + _refined(body, start, direction, coarse) * direction


def _refined(body: Body, start: FloatArray, direction: FloatArray, coarse: float) -> float:
    """Distance along a line at which tissue begins, nearest to the coarse answer [mm]."""
    along = coarse + np.arange(-_REFINE_MM, _REFINE_MM + _STEP_MM, _STEP_MM)
    volume = body.volume
    values = interpolate(volume.hu, volume.voxel(start + along[:, None] * direction))
    values = values - body.skin_level
    rising = np.flatnonzero((values[:-1] <= 0.0) & (values[1:] > 0.0))
    if not rising.size:
        return coarse
    n = rising[int(np.argmin(np.abs(along[rising] - coarse)))]
    return float(along[n] - values[n] * (along[n + 1] - along[n]) / (values[n + 1] - values[n]))


def nearest_skin(body: Body, lps_mm: ArrayLike) -> FloatArray:
    """Point of the skin nearest to a point [mm], shape (3,), to a fraction of a voxel.

    Raises:
        InvalidEntryError: if the volume holds no body.
    """
    point = frozen(lps_mm, (3,), "point")
    _, cell = body.nearest_cell_mm(point)
    outward = _outward(body, cell)
    skin = _along_normal(body, cell, outward)
    for _ in range(_ITERATIONS):  # to the foot of the perpendicular on the skin's tangent plane
        outward = _outward(body, skin)
        foot = point + float(np.dot(skin - point, outward)) * outward
        nearer = _along_normal(body, foot, outward)
        if np.linalg.norm(nearer - point) >= np.linalg.norm(skin - point):
            break
        skin = nearer
    return skin


def _along_normal(body: Body, near: FloatArray, outward: FloatArray) -> FloatArray:
    """Skin on the normal through a point next to it; the point itself at the volume's cut faces."""
    begin, end = near + (_REFINE_MM + GRID_MM) * outward, near - _REFINE_MM * outward
    if not outward.any() or is_inside(body, begin) or not is_inside(body, end):
        return near
    return skin_entry(body, begin, end)


def _outward(body: Body, point: FloatArray) -> FloatArray:
    """Direction out of the body at its skin, unit vector, or zero where there is none."""
    share = body.share(point + _AROUND)
    inward = share @ _AROUND  # centre of mass of the body around the point
    return unit(-inward) if float(np.abs(inward).max()) > 1e-6 else np.zeros(3)


def snap_to_skin(body: Body, lps_mm: ArrayLike, tolerance_mm: float = SNAP_MM) -> FloatArray:
    """Take a click as an entry: the skin next to it [mm], shape (3,).

    Raises:
        InvalidEntryError: if the skin is further away than `tolerance_mm`; carries the distance.
    """
    point = frozen(lps_mm, (3,), "entry")
    skin = nearest_skin(body, point)
    distance = float(np.linalg.norm(skin - point))
    if distance <= tolerance_mm:
        return skin
    where = "under the skin" if is_inside(body, point) else "outside the body"
    raise InvalidEntryError(
        sentence(
            "the entry lies {distance:.1f} mm {where}; click within {tolerance_mm:g} mm of the "
            "skin",
            distance=distance,
            where=where,
            tolerance_mm=tolerance_mm,
        ),
        distance,
    )
