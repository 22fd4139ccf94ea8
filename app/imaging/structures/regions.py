"""Regions of closed contours, and the grids on which they are filled.

Contours on slices of the CT are filled on its own grid; others on one whose slices are their
planes.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import counted, sentence
from app.imaging.structures.contours import ONE_PLANE_MM, ContourPlane, gathered, stacked
from app.imaging.structures.errors import StructureFileError
from app.imaging.structures.structure import Colour, StructureKind
from app.imaging.volume import Volume

PLANAR_MM = 0.5
"""A contour whose points lie further than this off one plane is left out."""

ON_SLICE_MM = 0.25
"""Points this near to a plane of the CT's slices lie on it: coordinates are rounded."""

LARGEST_CONTOURS = 2**29
"""Most voxels of the box around one region."""

_LARGEST_PICTURE = 2**25
_SNAP_MM, _SNAP_SHARE = 0.15, 0.2


@dataclass(slots=True)
class ContourRegion:
    """One region of the file.

    Attributes:
        name: as the file says.
        lines: its usable closed contours, LPS [mm], each of shape (n, 3).
        odd: for each of them, whether it is of the type CLOSEDPLANAR_XOR.
        left_out: what its other contours are, and how many of them.
        colour, kind: as the file says, None where it says nothing.
        frame: FrameOfReferenceUID; empty where it has none.
    """

    name: str
    colour: Colour | None = None
    kind: StructureKind | None = None
    frame: str = ""
    lines: list[FloatArray] = field(default_factory=list)
    odd: list[bool] = field(default_factory=list)
    left_out: Counter[str] = field(default_factory=Counter)

    def notes(self) -> list[str]:
        """Say what was left out, a line for each reason."""
        return [
            counted(
                "{name}: {n} contour {reason} left out",
                "{name}: {n} contours {reason} left out",
                count,
                name=self.name,
                reason=reason,
            )
            for reason, count in self.left_out.items()
        ]


def newell(line: FloatArray) -> FloatArray:
    """Twice the area that a line encloses, as a vector along its normal (Newell's rule)."""
    centred = line - line.mean(axis=0)
    area: FloatArray = np.cross(centred, np.roll(centred, -1, axis=0)).sum(axis=0)
    return area


@dataclass(frozen=True, slots=True, eq=False)
class Layers:
    """Contours of one region in the coordinates of a grid whose slices are their planes.

    Attributes:
        origin_mm: of the grid, LPS.
        frame: columns are steps of the grid along columns, rows and slices [mm], shape (3, 3).
        lines: points (column, row), each of shape (n, 2).
        heights: of each line, in slices.
        odd: see `ContourRegion`.
        step_mm: distance of slices.
        on_slices: whether the grid is the CT's own.
    """

    origin_mm: FloatArray
    frame: FloatArray
    lines: tuple[FloatArray, ...]
    heights: FloatArray
    odd: tuple[bool, ...]
    step_mm: float
    on_slices: bool

    @classmethod
    def of(cls, region: ContourRegion, volume: Volume) -> Layers | None:
        """Find the grid; contours that are not flat on it are left out of the region.

        Returns:
            None if no contour is left.
        """
        if not region.lines:
            return None
        frame = np.array(volume.affine_mm[:3, :3])
        layers = cls._on(region, volume.origin_mm, frame, ON_SLICE_MM)
        if 2 * len(layers.lines) < len(region.lines):
            frame = _oblique(_normal(region.lines), float(volume.spacing_mm.min()))
            layers = cls._on(region, region.lines[0][0], frame, PLANAR_MM)
            on_slices = False
        else:
            on_slices = True
        bent = len(region.lines) - len(layers.lines)
        if bent:
            region.left_out["not flat, or not parallel to the others,"] += bent
        if not layers.lines:
            return None
        heights = layers.heights
        if on_slices:  # coordinates are rounded: a plane beside a slice is that slice
            snap = min(_SNAP_MM / layers.step_mm, _SNAP_SHARE)
            whole = np.rint(heights)
            heights = np.where(np.abs(heights - whole) <= snap, whole, heights)
        step = layers.step_mm
        return cls(layers.origin_mm, frame, layers.lines, heights, layers.odd, step, on_slices)

    @classmethod
    def _on(
        cls, region: ContourRegion, origin: FloatArray, frame: FloatArray, flat_mm: float
    ) -> Layers:
        normal = np.cross(frame[:, 0], frame[:, 1])
        normal /= np.linalg.norm(normal)
        rise = float(frame[:, 2] @ normal)
        step = abs(rise)
        back = np.linalg.inv(frame)
        lines, heights, odd = [], [], []
        for line, is_odd in zip(region.lines, region.odd, strict=True):
            place = (line - origin) @ back.T
            height = float(place[:, 2].mean())
            if np.abs(place[:, 2] - height).max() * step <= flat_mm:
                # back onto the plane along its normal, not along the slices' stacking
                shift = (place[:, 2] - height)[:, None] * (rise * back @ normal)
                lines.append((place - shift)[:, :2])
                heights.append(height)
                odd.append(is_odd)
        return cls(origin, frame, tuple(lines), np.array(heights), tuple(odd), step, True)

    def groups(self) -> list[NDArray[np.intp]]:
        """Return which lines share a plane, ascending."""
        return gathered(self.heights, ONE_PLANE_MM / self.step_mm)

    def filled(self, usual: float | None) -> tuple[NDArray[np.bool_], FloatArray, list[str]]:
        """Fill the contours.

        Args:
            usual: distance of planes in slices, where other regions tell it.

        Returns:
            Mask of shape (K, J, I), its voxel -> LPS [mm], and what there is to say.

        Raises:
            StructureFileError: if the region is too large.
        """
        ends = np.array([(line.min(axis=0), line.max(axis=0)) for line in self.lines])
        low = np.floor(ends[:, 0].min(axis=0)).astype(int) - 1
        high = np.ceil(ends[:, 1].max(axis=0)).astype(int) + 2
        shape = (int(high[1] - low[1]), int(high[0] - low[0]))
        slices = int(np.ptp(self.heights)) + 2
        if shape[0] * shape[1] > _LARGEST_PICTURE or (
            slices * shape[0] * shape[1] > LARGEST_CONTOURS
        ):
            raise StructureFileError(
                sentence(
                    "its contours spread over {columns} × {rows} × {slices} voxels",
                    columns=shape[1],
                    rows=shape[0],
                    slices=slices,
                )
            )
        pixel_mm = np.linalg.norm(self.frame[:, :2], axis=0)
        planes = [self._plane(group, low, shape, pixel_mm) for group in self.groups()]
        mask, first = stacked(planes, pixel_mm, self.step_mm, usual if self.on_slices else None)
        said = _remarks(planes)
        if not mask.any():
            mask = self._nearest(mask.shape, low, first)
            said.append("smaller than a voxel: the voxels at its contours' middles were taken")
        affine = np.eye(4)
        affine[:3, :3] = self.frame
        affine[:3, 3] = self.origin_mm + self.frame @ [low[0], low[1], first]
        return mask, affine, said

    def _plane(
        self, group: NDArray[np.intp], low: Any, shape: tuple[int, int], pixel_mm: FloatArray
    ) -> ContourPlane:
        lines = [self.lines[number] - low for number in group]
        height = float(np.mean(self.heights[group]))
        odd = any(self.odd[number] for number in group)
        return ContourPlane.of(height, lines, shape, pixel_mm, odd)

    def _nearest(self, shape: tuple[int, ...], low: Any, first: int) -> NDArray[np.bool_]:
        mask = np.zeros(shape, bool)
        for line, height in zip(self.lines, self.heights, strict=True):
            column, row = np.rint(line.mean(axis=0)).astype(int) - low
            mask[int(np.clip(np.rint(height) - first, 0, shape[0] - 1)), row, column] = True
        return mask


def _remarks(planes: Sequence[ContourPlane]) -> list[str]:
    said: list[str] = []
    if repeated := sum(plane.repeated for plane in planes):
        said.append(
            counted(
                "{n} contour that is in the file twice counted once",
                "{n} contours that are in the file twice counted once",
                repeated,
            )
        )
    if any(plane.crossed for plane in planes):
        said.append(sentence("contours that cross one another were joined"))
    return said


def usual_gap(layers: Iterable[Layers]) -> float | None:
    """Distance of planes in slices of the CT, by the regions that have enough of them."""
    gaps: list[float] = []
    for layer in layers:
        heights = [float(layer.heights[group].mean()) for group in layer.groups()]
        if layer.on_slices and len(heights) > 2:
            gaps += np.diff(heights).tolist()
    return float(np.median(gaps)) if gaps else None


def _normal(lines: Sequence[FloatArray]) -> FloatArray:
    """Return the normal of the planes, by Newell's rule over those contours that agree."""
    areas = np.array([newell(line) for line in lines])
    for _ in range(3):
        largest = areas[np.argmax((areas * areas).sum(axis=1))]
        total = (areas * np.sign(areas @ largest)[:, None]).sum(axis=0)
        normal: FloatArray = total / np.linalg.norm(total)
        along = np.abs(areas @ normal) / np.linalg.norm(areas, axis=1)
        agreeing = along >= np.median(along) - 1e-3
        if agreeing.all():
            break
        areas = areas[agreeing]
    return normal


def _oblique(normal: FloatArray, pixel_mm: float) -> FloatArray:
    """Return a grid's steps across a normal: square pixels, slices one millimetre apart."""
    side = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
    side /= np.linalg.norm(side)
    return np.column_stack([pixel_mm * side, pixel_mm * np.cross(normal, side), normal])
