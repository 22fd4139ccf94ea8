"""A control scan as a picture: a few axial slices of the CT with the needle in them as metal.

What a scanner would show, and no more. A slice is the mean of the CT over its thickness. The
needle fills each voxel by the share of it that its cylinder takes (partial volume), so that a shaft
that merely grazes a slice is faint, one that leaves it obliquely tapers over d / sin(angle), and a
tip outside the range changes nothing. The plain streak is a likeness, not physics: the dark band
with bright sides that a scanner makes beyond both ends of a needle lying in the slice; the longer
the piece in the slice, the darker (beam hardening and photon starvation; Barrett and Keat 2004,
RadioGraphics 24:1679). `dark_band` has the one that tells a tip from a shaft, `breath_layers` how
another breath than the planning CT's moves what is seen.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import ceil
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray, frozen
from app.imaging.dark_band import add_bands
from app.imaging.orthogonal import nearest_axes
from app.imaging.scan_look import BreathPicture, NeedleEnds, ScanLook
from app.imaging.scan_order import ScanNeedle, ScanOrder, ScanTip
from app.imaging.volume import Volume

if TYPE_CHECKING:
    from app.imaging.breath_layers import BreathShares
    from app.imaging.oblique import Plane
    from app.imaging.skin_grid import GridSpec

METAL_HU = 12000.0
"""Steel on a scale without an end, by order of magnitude: a shaft that fills a quarter of a voxel
is as bright as the picture can be."""

LAST_HU = 3071.0
"""End of a 12 bit scanner's scale: whatever is brighter looks like this."""

AIR_HU = -1024.0
SUBSLICE_MM = 1.0
"""A slice is the mean of planes no farther apart than this."""

LARGEST = 1024
"""Pixels along one side of a picture; a CT with more is shown coarser."""

FINE = 6
"""A pixel that the needle may touch is looked at in so many parts each way."""

FINE_MM = 0.25
"""And in so thin layers."""

STREAK_HU = 450.0
STREAK_LENGTH_MM = 40.0
STREAK_WIDTH_MM = 3.0
STREAK_PIECE_MM = 25.0
"""Depth, length and width of the dark band, and the piece of needle that gives 63 % of it."""


NOISE_BLUR_PX = 0.7
"""A scanner's soft kernel joins the noise of neighbouring pixels by so much (deviation of a bell);
what is added keeps its standard deviation."""

_EDGE_PX = 8


def scan_image(
    volume: Volume,
    order: ScanOrder,
    needle: ScanNeedle | None = None,
    streak: bool = False,
    shift_mm: ArrayLike = (0.0, 0.0, 0.0),
    look: ScanLook | None = None,
) -> Volume:
    """Take a control scan.

    Args:
        volume: the patient's CT.
        order: which slices.
        needle: where the needle is, LPS; None for a scan without one.
        streak: whether the metal leaves its streak, where no `look` says it.
        shift_mm: how far the patient's target has moved since the CT, LPS, shape (3,). All of the
            picture moves by it, skin and bones too, unless `look` wants layers; the needle does
            not.
        look: ends of the needle, noise and what breathing moves; None for the plain picture.

    Returns:
        Slices of `order`, int16, slices towards the head; pixels along L and P, or as far turned
        as the gantry is tilted.

    Raises:
        NumericalError: if `shift_mm` is not finite.
    """
    look = look or ScanLook(streak)
    grid = _grid(volume, order)
    shift, shares = frozen(shift_mm, (3,), "shift_mm"), None
    if look.breath is BreathPicture.LAYERS and look.target_mm is not None and shift.any():
        from app.imaging.breath_layers import shares_of_ct

        shares = shares_of_ct(volume, look.target_mm)
    hu = _tissue(volume, order, grid, shift, shares)
    if needle is not None:
        seen = needle.seen_from(order)
        if look.ends is NeedleEnds.PLAIN:
            seen = replace(seen, tip=ScanTip.FLAT, hollow=False)
        if look.streak and look.ends is NeedleEnds.DRAWN:
            for k, middle in enumerate(order.middles_mm):
                add_bands(hu[k], seen, float(middle), order.slice_mm, grid)
        elif look.streak:
            _add_streaks(hu, order, seen, grid)
        _add_metal(hu, order, seen, grid)
    if look.grid is not None:
        _add_wires(hu, order, grid, volume, look.grid)
    if look.noise_hu > 0.0:
        _add_noise(hu, look)
    picture = np.clip(np.rint(hu), AIR_HU, LAST_HU).astype(np.int16)
    size = (picture.shape[2], picture.shape[1], picture.shape[0])
    spacing = (grid[0, 0], grid[1, 1], grid[2, 2])
    direction = order.to_gantry.T + 0.0  # no negative zeros
    if order.tilt_deg != 0.0:
        turned = np.eye(4)
        turned[:3, :3] = direction * np.array(spacing)
        turned[:3, 3] = order.in_patient(grid[:3, 3])
        grid = turned
    x, y, z = grid[:3, 3].tolist()
    series = replace(
        volume.series,
        size=size,
        spacing_mm=spacing,
        origin_mm=(x, y, z),
        direction=tuple(direction.ravel().tolist()),
        slices=(),
    )
    return Volume(picture, grid, series)


def _add_wires(
    hu: NDArray[np.float32],
    order: ScanOrder,
    grid: FloatArray,
    volume: Volume,
    spec: GridSpec,
) -> None:
    """Draw the lines of a grid on the skin: dots of metal in every slice that they reach."""
    from app.imaging.skin_grid import grid_on

    corners = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    ends = volume.lps_mm(corners * (np.array(volume.size) - 1.0))
    lean = abs(np.sin(np.radians(order.tilt_deg))) * float(np.ptp(ends[:, 1]))
    low, high = order.range_mm
    for wire in grid_on(volume, spec).wires(low - lean, high + lean):
        _add_metal(hu, order, wire.seen_from(order), grid)


def _add_noise(hu: NDArray[np.float32], look: ScanLook) -> None:
    """Add the noise of a lower tube current, neighbouring pixels joined as by a soft kernel."""
    from scipy import ndimage

    for k, layer in enumerate(hu):
        rng = np.random.default_rng([look.noise_seed, k])
        shape = (layer.shape[0] + 2 * _EDGE_PX, layer.shape[1] + 2 * _EDGE_PX)
        noise = ndimage.gaussian_filter(rng.standard_normal(shape), NOISE_BLUR_PX)
        noise = noise[_EDGE_PX:-_EDGE_PX, _EDGE_PX:-_EDGE_PX] / _blurred()
        hu[k] += (look.noise_hu * noise).astype(np.float32)


def _blurred() -> float:
    """Return the standard deviation that is left of white noise of 1 behind the kernel."""
    from scipy import ndimage

    point = np.zeros(2 * _EDGE_PX + 1)
    point[_EDGE_PX] = 1.0
    line = ndimage.gaussian_filter1d(point, NOISE_BLUR_PX)
    return float(line @ line)


def _grid(volume: Volume, order: ScanOrder) -> FloatArray:
    """Affine of the scan: the CT's own pixels where it is straight, else as fine, shape (4, 4)."""
    axes, _ = nearest_axes(volume.direction)
    corners = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    ends = volume.lps_mm(corners * (np.array(volume.size) - 1.0))
    low, high = ends.min(axis=0), ends.max(axis=0)
    spacing = [float(volume.spacing_mm[axes[a]]) for a in (0, 1)]
    pixel = [max(s, (high[a] - low[a]) / (LARGEST - 1)) for a, s in enumerate(spacing)]
    affine = np.diag([*pixel, order.step_mm, 1.0])
    affine[:3, 3] = (low[0], low[1], order.middles_mm[0])
    return affine


def _counts(volume: Volume, grid: FloatArray) -> tuple[int, int]:
    """Columns and rows that reach across the CT."""
    corners = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    ends = volume.lps_mm(corners * (np.array(volume.size) - 1.0))
    reach = ends.max(axis=0) - ends.min(axis=0)
    return round(float(reach[0] / grid[0, 0])) + 1, round(float(reach[1] / grid[1, 1])) + 1


def _tissue(
    volume: Volume,
    order: ScanOrder,
    grid: FloatArray,
    shift_mm: FloatArray,
    shares: BreathShares | None = None,
) -> NDArray[np.float32]:
    """Mean of the CT over each slice, shape (slices, rows, columns)."""
    from app.imaging.oblique import Plane, oblique_image  # compiled: only who scans waits for it

    columns, rows = _counts(volume, grid)
    layers = max(1, ceil(order.slice_mm / SUBSLICE_MM - 1e-9))
    offsets = ((np.arange(layers) + 0.5) / layers - 0.5) * order.slice_mm
    hu = np.zeros((order.slices, rows, columns), np.float32)
    layer = np.empty((rows, columns), np.float32)
    right, down = (grid[:3, axis] @ order.to_gantry for axis in (0, 1))

    def plane_at(z_mm: float) -> Plane:
        corner = order.in_patient(np.array([grid[0, 3], grid[1, 3], z_mm]))
        return Plane(corner - still_mm, right, down, columns, rows)

    still_mm = shift_mm if shares is None else np.zeros(3)
    for k, middle in enumerate(order.middles_mm):
        breath = None if shares is None else _Breath.of(plane_at(middle), shares, shift_mm)
        for offset in offsets:
            plane = plane_at(middle + offset)
            oblique_image(volume, plane, outside_hu=AIR_HU, out=layer)
            if breath is not None:
                breath.move(layer, volume, plane)
            hu[k] += layer / layers
    return hu


@dataclass(frozen=True, slots=True, eq=False)
class _Breath:
    """What has moved in the middle of a slice, and so in all of it.

    Attributes:
        moved: numbers of the pixels, shape (n,).
        back_mm: from a pixel to where what it shows rests, LPS, shape (n, 3).
    """

    moved: NDArray[np.intp]
    back_mm: FloatArray

    @classmethod
    def of(cls, plane: Plane, shares: BreathShares, shift_mm: FloatArray) -> _Breath:
        """Look at the pixels of a plane."""
        points = plane.points_mm().reshape(-1, 3)
        back = shares.resting(points, shift_mm) - points
        moved = np.flatnonzero(back.any(axis=1))
        return cls(moved, back[moved])

    def move(self, layer: NDArray[np.float32], volume: Volume, plane: Plane) -> None:
        """Put what has moved into a plane where it lies now; what rests is there."""
        from scipy import ndimage

        resting = plane.points_mm().reshape(-1, 3)[self.moved] + self.back_mm
        kji = volume.voxel(resting)[:, ::-1].T
        values = ndimage.map_coordinates(
            volume.hu, kji, np.float32, order=1, mode="constant", cval=AIR_HU
        )
        layer.reshape(-1)[self.moved] = values


def _add_metal(
    hu: NDArray[np.float32], order: ScanOrder, needle: ScanNeedle, grid: FloatArray
) -> None:
    """Fill each voxel by the share of it that lies in the needle's cylinder."""
    layers = max(FINE, ceil(order.slice_mm / FINE_MM))
    for k, middle in enumerate(order.middles_mm):
        half = order.slice_mm / 2
        total = np.zeros(hu.shape[1:])
        for piece in needle.pieces:
            rows, columns = _candidates(hu.shape[1:], piece, grid, (middle - half, middle + half))
            if len(rows):
                total[rows, columns] += _share(
                    rows, columns, float(middle), layers, order, piece, grid
                )
        rows, columns = np.nonzero(total)
        share, tissue = np.minimum(total[rows, columns], 1.0), hu[k, rows, columns]
        hu[k, rows, columns] = tissue + share * (METAL_HU - tissue)


def _candidates(
    shape: tuple[int, ...], needle: ScanNeedle, grid: FloatArray, faces: tuple[float, float]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows and columns of the pixels that the needle may touch between two axial planes."""
    reach = needle.radius_mm + float(np.hypot(grid[0, 0], grid[1, 1]))
    piece = needle.within(faces[0] - needle.radius_mm, faces[1] + needle.radius_mm)
    nobody: NDArray[np.intp] = np.empty(0, np.intp)
    if piece is None:
        return nobody, nobody
    ends = (np.array(piece)[:, :2] - grid[:2, 3]) / (grid[0, 0], grid[1, 1])
    wide = np.array([reach / grid[0, 0], reach / grid[1, 1]])
    limits = (shape[1] - 1, shape[0] - 1)
    low = np.clip(np.floor(ends.min(axis=0) - wide), 0, limits).astype(int)
    high = np.clip(np.ceil(ends.max(axis=0) + wide), 0, limits).astype(int)
    rows, columns = np.mgrid[low[1] : high[1] + 1, low[0] : high[0] + 1]
    at = np.stack([columns, rows], axis=-1) * (grid[0, 0], grid[1, 1]) + grid[:2, 3]
    near = _distance(at, piece[0][:2], piece[1][:2]) <= reach + needle.radius_mm
    return rows[near], columns[near]


def _distance(points: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Distance of points in a plane from a segment, shape (..., 2) -> (...)."""
    along = end - start
    length2 = float(along @ along)
    share = np.zeros(points.shape[:-1])
    if length2 > 1e-12:
        share = np.clip((points - start) @ along / length2, 0.0, 1.0)
    result: FloatArray = np.linalg.norm(points - start - share[..., None] * along, axis=-1)
    return result


def _share(
    rows: NDArray[np.intp],
    columns: NDArray[np.intp],
    middle: float,
    layers: int,
    order: ScanOrder,
    needle: ScanNeedle,
    grid: FloatArray,
) -> NDArray[np.float64]:
    """Share of each voxel in the needle's cylinder, 0…1, shape (n,)."""
    parts = (np.arange(FINE) + 0.5) / FINE - 0.5
    depths = ((np.arange(layers) + 0.5) / layers - 0.5) * order.slice_mm
    inside = np.zeros(len(rows))
    x0, y0 = grid[0, 3] + columns * grid[0, 0], grid[1, 3] + rows * grid[1, 1]
    for depth in depths:
        for dy in parts:
            for dx in parts:
                offset = np.stack(
                    [
                        x0 + dx * grid[0, 0],
                        y0 + dy * grid[1, 1],
                        np.full(len(rows), middle + depth),
                    ],
                    axis=1,
                )
                offset -= needle.hub_mm
                along = offset @ needle.axis
                across2 = np.einsum("ij,ij->i", offset, offset) - along**2
                hit = (along >= 0.0) & (along <= needle.length_mm)
                hit &= across2 <= needle.radius_mm**2
                if needle.tip is not ScanTip.FLAT or needle.bore_mm > 0.0:
                    hit &= _ground(offset, along, across2, needle)
                inside += hit
    return inside / (layers * FINE * FINE)


def _ground(
    offset: FloatArray, along: FloatArray, across2: FloatArray, needle: ScanNeedle
) -> NDArray[np.bool_]:
    """Return which places are metal at a pointed or bevelled tip, and beside an empty bore."""
    left = needle.length_mm - along
    metal: NDArray[np.bool_] = across2 >= needle.bore_mm**2
    if needle.tip is ScanTip.CONE:
        metal &= np.sqrt(across2) <= needle.radius_mm * np.minimum(left / needle.tip_length_mm, 1.0)
    if needle.tip is ScanTip.BEVEL:
        high = offset @ needle.face + needle.radius_mm  # 0 where the point is
        metal &= high / (2.0 * needle.radius_mm) <= left / needle.tip_length_mm
    return metal


def _add_streaks(
    hu: NDArray[np.float32], order: ScanOrder, needle: ScanNeedle, grid: FloatArray
) -> None:
    """Darken what lies beyond both ends of the needle's piece in each slice."""
    rows, columns = np.mgrid[0 : hu.shape[1], 0 : hu.shape[2]]
    x, y = grid[0, 3] + columns * grid[0, 0], grid[1, 3] + rows * grid[1, 1]
    for k, middle in enumerate(order.middles_mm):
        piece = needle.within(middle - order.slice_mm / 2, middle + order.slice_mm / 2)
        if piece is None:
            continue
        start, end = piece[0][:2], piece[1][:2]
        length = float(np.linalg.norm(end - start))
        if length < 1.0:  # upright in the slice: a dot has no direction to streak along
            continue
        along = (end - start) / length
        depth = STREAK_HU * (1.0 - np.exp(-length / STREAK_PIECE_MM))
        for tail, way in ((end, along), (start, -along)):
            s = (x - tail[0]) * way[0] + (y - tail[1]) * way[1]
            across = ((x - tail[0]) * way[1] - (y - tail[1]) * way[0]) / STREAK_WIDTH_MM
            profile = (1.0 - 2.0 * across**2) * np.exp(-(across**2))
            faded = np.where(s > 0.0, np.exp(-np.maximum(s, 0.0) / STREAK_LENGTH_MM), 0.0)
            hu[k] -= (depth * profile * faded).astype(np.float32)
