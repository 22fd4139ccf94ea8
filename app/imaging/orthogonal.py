"""Axial, sagittal and coronal slices of a volume of any orientation, without copying it.

The volume is looked at along the anatomical axis nearest to each of its own: axes are permuted and
flipped, never resampled. The screen follows the radiological convention: axial with the patient's
right on the left and anterior on top, coronal with right on the left and head up, sagittal with
anterior on the left and head up.
"""

from dataclasses import dataclass
from enum import StrEnum
from itertools import permutations
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray, frozen, unit
from app.core.messages import sentence
from app.imaging.errors import OutsideImageError
from app.imaging.volume import SHEAR_MM, Volume


class View(StrEnum):
    """The three orthogonal views."""

    AXIAL = "axial"
    SAGITTAL = "sagittal"
    CORONAL = "coronal"


@dataclass(frozen=True, slots=True)
class Letters:
    """Patient directions at the edges of a view, such as `R` or, for an oblique one, `RP`."""

    left: str
    right: str
    top: str
    bottom: str


@dataclass(frozen=True, slots=True)
class _Screen:
    """Patient axis (0 = L, 1 = P, 2 = S) of columns, rows and slices; whether rows go down it."""

    column: int
    row: int
    slice: int
    flipped_rows: bool


_SCREENS: Final = {
    View.AXIAL: _Screen(column=0, row=1, slice=2, flipped_rows=False),
    View.SAGITTAL: _Screen(column=1, row=2, slice=0, flipped_rows=True),
    View.CORONAL: _Screen(column=0, row=2, slice=1, flipped_rows=True),
}

_POSITIVE: Final = ("L", "P", "S")
_NEGATIVE: Final = ("R", "A", "I")
_SHOWN_COMPONENT: Final = 0.05
"""Share of a direction (sine of about 3°) from which a letter is shown for it."""


class OrthogonalSlicer:
    """Maps between the pixels of three views and the patient, and hands out their pictures.

    Columns and rows count pixels from the centre of the top left one; indices of slices ascend
    towards the patient's left (sagittal), back (coronal) and head (axial).
    """

    def __init__(self, volume: Volume) -> None:
        self._volume = volume
        axes, flips = nearest_axes(volume.direction)
        block = np.transpose(volume.hu, [2 - axis for axis in axes])  # to (l, p, s)
        steps = tuple(slice(None, None, -1 if flip else 1) for flip in flips)
        self._lps_block: NDArray[Any] = block[steps]
        self._affine = _reordered(volume, axes, flips)
        self._inverse = frozen(np.linalg.inv(self._affine))

    @property
    def volume(self) -> Volume:
        """The volume that is shown."""
        return self._volume

    def count(self, view: View) -> int:
        """Return the number of slices of a view."""
        return int(self._lps_block.shape[_SCREENS[View(view)].slice])

    def shape(self, view: View) -> tuple[int, int]:
        """Rows and columns of a view's pictures."""
        screen = _SCREENS[View(view)]
        return self._lps_block.shape[screen.row], self._lps_block.shape[screen.column]

    def image(self, view: View, index: int) -> NDArray[Any]:
        """Hounsfield values of a slice, shape (rows, columns), row 0 on top; no copy, read-only.

        Raises:
            OutsideImageError: if there is no such slice.
        """
        screen = _SCREENS[View(view)]
        if not 0 <= index < self.count(view):
            raise OutsideImageError(
                sentence(
                    "{view} slice {index} does not exist; slices 0 to {count} do",
                    view=View(view),
                    index=index,
                    count=self.count(view) - 1,
                )
            )
        ordered = np.transpose(self._lps_block, (screen.slice, screen.row, screen.column))
        plane: NDArray[Any] = ordered[index]
        return plane[::-1] if screen.flipped_rows else plane

    def images(self, view: View, first: int, last: int) -> NDArray[Any]:
        """Slices `first` up to `last`, which is left out; shape (slices, rows, columns), no copy.

        Raises:
            OutsideImageError: if there are no such slices.
        """
        screen = _SCREENS[View(view)]
        if not 0 <= first < last <= self.count(view):
            raise OutsideImageError(
                sentence(
                    "{view} slices {first} to {last} do not exist; slices 0 to {count} do",
                    view=View(view),
                    first=first,
                    last=last - 1,
                    count=self.count(view) - 1,
                )
            )
        ordered = np.transpose(self._lps_block, (screen.slice, screen.row, screen.column))
        planes: NDArray[Any] = ordered[first:last]
        return planes[:, ::-1] if screen.flipped_rows else planes

    def pixel_size_mm(self, view: View) -> tuple[float, float]:
        """Width (between columns) and height (between rows) of a pixel."""
        screen = _SCREENS[View(view)]
        return self._spacing(screen.column), self._spacing(screen.row)

    def slice_spacing_mm(self, view: View) -> float:
        """Distance between two slices of a view, along their normal."""
        screen = _SCREENS[View(view)]
        if not self._volume.is_sheared:
            return self._spacing(screen.slice)
        across, down = self._affine[:3, screen.column], self._affine[:3, screen.row]
        return abs(float(self._affine[:3, screen.slice] @ unit(np.cross(across, down))))

    def is_right_angled(self, view: View) -> bool:
        """Return whether rows and columns of a view are perpendicular, to 0.01 mm over the picture.

        Of a series with gantry tilt one view is not: its pictures are sheared.
        """
        screen = _SCREENS[View(view)]
        across, down = self._affine[:3, screen.column], self._affine[:3, screen.row]
        drift = abs(float(unit(across) @ down)) * self.shape(view)[0]
        return not self._volume.is_sheared or drift <= SHEAR_MM

    def straight_axes(self, view: View) -> tuple[FloatArray, FloatArray]:
        """Perpendicular unit vectors to the right and down the screen in a view's own plane.

        The direction in which the scanner's slices stack is kept, the other one turned to it.
        """
        screen = _SCREENS[View(view)]
        across = unit(self._affine[:3, screen.column])
        down = unit(self._affine[:3, screen.row]) * (-1.0 if screen.flipped_rows else 1.0)
        stacking = nearest_axes(self._volume.direction)[0].index(2)
        if screen.column == stacking:
            return across, unit(down - (down @ across) * across)
        return unit(across - (across @ down) * down), down

    def _spacing(self, axis: int) -> float:
        return float(np.linalg.norm(self._affine[:3, axis]))

    def to_lps_mm(self, view: View, index: float, column: float, row: float) -> FloatArray:
        """Patient point [mm], shape (3,), of a place in a view; the inverse of `from_lps_mm`."""
        screen = _SCREENS[View(view)]
        place = np.empty(3)
        place[screen.column] = column
        place[screen.row] = self._flip(screen, row)
        place[screen.slice] = index
        result: FloatArray = self._affine[:3, :3] @ place + self._affine[:3, 3]
        return result

    def from_lps_mm(self, view: View, lps_mm: ArrayLike) -> tuple[float, float, float]:
        """Slice index, column and row, as floats, of a patient point [mm], shape (3,)."""
        screen = _SCREENS[View(view)]
        place = self._inverse[:3, :3] @ np.asarray(lps_mm, np.float64) + self._inverse[:3, 3]
        row = self._flip(screen, float(place[screen.row]))
        return float(place[screen.slice]), float(place[screen.column]), row

    def _flip(self, screen: _Screen, row: float) -> float:
        return self._lps_block.shape[screen.row] - 1 - row if screen.flipped_rows else row

    def nearest_index(self, view: View, lps_mm: ArrayLike) -> int:
        """Slice of a view nearest to a patient point [mm], the outermost one beyond the volume."""
        index = self.from_lps_mm(view, lps_mm)[0]
        return int(min(max(round(index), 0), self.count(view) - 1))

    def letters(self, view: View) -> Letters:
        """Patient directions at the edges, from the geometry, dominant letter first."""
        screen = _SCREENS[View(view)]
        right = self._affine[:3, screen.column]
        down = self._affine[:3, screen.row] * (-1.0 if screen.flipped_rows else 1.0)
        return Letters(letters(-right), letters(right), letters(-down), letters(down))


def letters(direction: ArrayLike) -> str:
    """Letters of a patient direction, LPS, shape (3,), the dominant one first."""
    vector = np.asarray(direction, np.float64)
    vector = vector / np.linalg.norm(vector)
    order = np.argsort(-np.abs(vector), kind="stable")
    shown = [axis for axis in order if abs(vector[axis]) >= _SHOWN_COMPONENT]
    return "".join((_POSITIVE if vector[axis] > 0.0 else _NEGATIVE)[axis] for axis in shown)


def nearest_axes(direction: FloatArray) -> tuple[tuple[int, ...], tuple[bool, ...]]:
    """Voxel axis (0 = i, 1 = j, 2 = k) for each of L, P, S, and whether it runs the other way."""
    share = np.abs(direction)
    axes = max(permutations(range(3)), key=lambda p: sum(share[a, p[a]] for a in range(3)))
    return axes, tuple(bool(direction[a, axes[a]] < 0.0) for a in range(3))


def _reordered(volume: Volume, axes: tuple[int, ...], flips: tuple[bool, ...]) -> FloatArray:
    """Affine from indices along L, P, S to patient LPS [mm], shape (4, 4)."""
    affine = np.eye(4)
    affine[:3, 3] = volume.affine_mm[:3, 3]
    for a, (axis, flip) in enumerate(zip(axes, flips, strict=True)):
        step = volume.affine_mm[:3, axis]
        affine[:3, a] = -step if flip else step
        if flip:
            affine[:3, 3] += step * (volume.size[axis] - 1)
    return frozen(affine, (4, 4), "affine")
