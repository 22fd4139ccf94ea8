"""A grid of metal lines on the skin, as a scan shows it and as table and laser find it.

The lines run from head to feet on the side that lies up, `spacing_mm` apart along the skin, and are
numbered from the patient's right to his left (seen from his feet). A place on the skin is then the
table position (LPS z), a line, and so many millimetres beside it along the skin.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from math import hypot
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
from app.imaging.errors import InvalidEntryError
from app.imaging.interpolation import interpolate
from app.imaging.scan_order import ScanNeedle
from app.imaging.volume import Volume

if TYPE_CHECKING:
    from app.imaging.body import Body

Place = tuple[float, float, float]

WIRE_MM = 0.6
"""Radius of a line's wire; of each fifth line's, that it can be counted, `FIFTH_MM`."""
FIFTH_MM = 1.1

_RAY_MM = 300.0
_COARSE_MM = 1.0
_NEAR_MM = 4.0
_FINE_MM = 0.25
_ACROSS_MM = 1.0
_BEYOND_MM = 60.0
_ALONG_MM = 2.0
_STEEPEST = 5.0  # the skin falls away by more for each millimetre across: there the grid ends


@dataclass(frozen=True, slots=True)
class GridSpec:
    """Where a grid lies and how fine it is.

    Attributes:
        centre_mm: place in the patient above which its middle line lies, LPS.
        up: direction that lies up on the table, across the patient: unit vector (x, y) of LPS.
        lines: how many, an odd number: the middle one lies above `centre_mm`.
        spacing_mm: from line to line along the skin.
        length_mm: of the lines.
    """

    centre_mm: Place
    up: tuple[float, float] = (0.0, -1.0)
    lines: int = 13
    spacing_mm: float = 10.0
    length_mm: float = 150.0

    @property
    def across(self) -> FloatArray:
        """Direction in which the numbers grow, LPS, shape (3,)."""
        return np.array([-self.up[1], self.up[0], 0.0])

    @property
    def rising(self) -> FloatArray:
        """Direction that lies up, LPS, shape (3,)."""
        return np.array([self.up[0], self.up[1], 0.0])

    def document(self) -> dict[str, object]:
        """Return JSON-ready values; `spec_of` reads them back."""
        return {
            "centre_mm": list(self.centre_mm),
            "up": list(self.up),
            "lines": self.lines,
            "spacing_mm": self.spacing_mm,
            "length_mm": self.length_mm,
        }


def spec_of(document: Mapping[str, Any]) -> GridSpec:
    """Read `GridSpec.document` back.

    Raises:
        LookupError, TypeError, ValueError: if it is damaged.
    """
    x, y, z = map(float, document["centre_mm"])
    up_x, up_y = map(float, document["up"])
    return GridSpec(
        (x, y, z),
        (up_x, up_y),
        int(document["lines"]),
        float(document["spacing_mm"]),
        float(document["length_mm"]),
    )


@dataclass(frozen=True, slots=True)
class GridPlace:
    """A place on the skin as it is found with the grid.

    Attributes:
        table_mm: table position: LPS z.
        line: its number, from 1.
        offset_mm: beside the line along the skin, positive towards the next number.
    """

    table_mm: float
    line: int
    offset_mm: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class SkinProfile:
    """The skin across the patient at one table position.

    Attributes:
        across_mm: beside the middle line, straight, shape (n,), ascending.
        rising_mm: height above `centre_mm` there, shape (n,).
        along_mm: the same place along the skin from the middle line, shape (n,).
    """

    across_mm: FloatArray
    rising_mm: FloatArray
    along_mm: FloatArray


class SkinGrid:
    """The lines of a grid on the skin of one CT."""

    def __init__(self, body: Body, spec: GridSpec) -> None:
        self.spec = spec
        self._body = body
        self._known = lru_cache(maxsize=256)(self._profile)

    @property
    def range_mm(self) -> tuple[float, float]:
        """Return from where to where the lines run along the patient [mm]."""
        half = self.spec.length_mm / 2
        return self.spec.centre_mm[2] - half, self.spec.centre_mm[2] + half

    def point(self, place: GridPlace) -> FloatArray:
        """Return the place on the skin, LPS [mm], shape (3,).

        Raises:
            InvalidEntryError: if the grid has no such line, or does not reach there.
        """
        if not 1 <= place.line <= self.spec.lines:
            raise InvalidEntryError(
                sentence(
                    "grid line {line}: there are 1 to {lines}",
                    line=place.line,
                    lines=self.spec.lines,
                ),
                0.0,
            )
        along = self._along(place.line) + place.offset_mm
        return self._point(place.table_mm, along)

    def place(self, point_mm: FloatArray) -> GridPlace:
        """Return how a point of the skin is found with the grid.

        Raises:
            InvalidEntryError: if the grid does not reach there.
        """
        z = float(point_mm[2])
        along = self._beside(point_mm)
        number = round(along / self.spec.spacing_mm + (self.spec.lines + 1) / 2)
        line = min(max(number, 1), self.spec.lines)
        return GridPlace(z, line, along - self._along(line))

    def distance_mm(self, first_mm: FloatArray, second_mm: FloatArray) -> float:
        """Return the way along the skin between two points of it [mm].

        Across by the grid's lines, along by the length of a line between the two table positions.
        """
        a, b = self._beside(first_mm), self._beside(second_mm)
        z = np.array([float(first_mm[2]), float(second_mm[2])])
        steps = max(2, int(abs(z[1] - z[0]) / _ALONG_MM) + 1)
        way = np.array([self._point(at, 0.5 * (a + b)) for at in np.linspace(z[0], z[1], steps)])
        return hypot(b - a, float(np.linalg.norm(np.diff(way, axis=0), axis=1).sum()))

    def wires(self, low_mm: float, high_mm: float) -> tuple[ScanNeedle, ...]:
        """Return the lines as metal on the skin between two table positions [mm]."""
        begin, end = self.range_mm
        low, high = max(low_mm, begin), min(high_mm, end)
        if high - low < 1e-3:
            return ()
        places = np.linspace(low, high, max(2, int((high - low) / _ALONG_MM) + 1))
        made = []
        for line in range(1, self.spec.lines + 1):
            radius = FIFTH_MM if line % 5 == 0 else WIRE_MM
            lifted = radius * self.spec.rising
            try:
                points = [self._point(z, self._along(line)) + lifted for z in places]
            except InvalidEntryError:
                continue  # no skin under it here
            corners = np.array(points)
            made.append(ScanNeedle(corners[0], corners[-1], radius, corners))
        return tuple(made)

    def line_mm(self, line: int, step_mm: float) -> list[FloatArray]:
        """Return one line on the skin of the CT, in pieces where there is none under it between.

        Args:
            line: its number, from 1.
            step_mm: from point to point along the patient.

        Returns:
            Pieces, each of shape (n, 3) with n ≥ 2, LPS [mm].
        """
        low, high = self.range_mm
        places = np.linspace(low, high, max(2, round((high - low) / step_mm) + 1)).tolist()
        return self._pieces([GridPlace(z, line) for z in places])

    def across_mm(self, table_mm: float) -> FloatArray | None:
        """Return the grid's width across the skin at a table position, LPS [mm], shape (n, 3).

        None where there is no skin of the CT.
        """
        half = self.spec.spacing_mm / 2
        places = [
            GridPlace(table_mm, line, offset)
            for line in range(1, self.spec.lines + 1)
            for offset in (-half, 0.0)
        ]
        return max(self._pieces(places[1:]), key=len, default=None)

    # --- inside -----------------------------------------------------------------------------------
    def _pieces(self, places: list[GridPlace]) -> list[FloatArray]:
        """Return the points of places that follow each other, torn where one is not on the CT."""
        volume, pieces = self._body.volume, list[list[FloatArray]]([[]])
        for place in places:
            try:
                at = self.point(place)
            except InvalidEntryError:
                pieces.append([])
                continue
            voxel = volume.voxel(at[None])[0]
            if (voxel < 0.0).any() or (voxel > np.array(volume.size) - 1.0).any():
                pieces.append([])
            else:
                pieces[-1].append(at)
        return [np.array(piece) for piece in pieces if len(piece) > 1]

    def _along(self, line: int) -> float:
        return (line - (self.spec.lines + 1) / 2) * self.spec.spacing_mm

    def _beside(self, point_mm: FloatArray) -> float:
        profile = self._known(round(float(point_mm[2]), 3))
        centre = np.array(self.spec.centre_mm)
        u = float((point_mm - centre) @ self.spec.across)
        if not profile.across_mm[0] <= u <= profile.across_mm[-1]:
            raise InvalidEntryError(sentence("the grid does not reach there"), 0.0)
        return float(np.interp(u, profile.across_mm, profile.along_mm))

    def _point(self, z: float, along: float) -> FloatArray:
        profile = self._known(round(float(z), 3))
        if not profile.along_mm[0] <= along <= profile.along_mm[-1]:
            raise InvalidEntryError(
                sentence("there is no skin under the grid {mm:.0f} mm beside its middle", mm=along),
                0.0,
            )
        u = float(np.interp(along, profile.along_mm, profile.across_mm))
        height = float(np.interp(u, profile.across_mm, profile.rising_mm))
        centre = np.array([*self.spec.centre_mm[:2], z])
        return frozen(centre + u * self.spec.across + height * self.spec.rising)

    def _profile(self, z: float) -> SkinProfile:
        """Look for the skin from above at one table position.

        Raises:
            InvalidEntryError: if there is none under the middle line.
        """
        spec, volume = self.spec, self._body.volume
        half = 0.5 * spec.lines * spec.spacing_mm + _BEYOND_MM
        across = np.arange(-half, half + _ACROSS_MM, _ACROSS_MM)
        heights = np.arange(_RAY_MM, -_RAY_MM, -_COARSE_MM)
        middle = np.array([*spec.centre_mm[:2], z])
        starts = middle + across[:, None] * spec.across
        points = starts[:, None] + heights[None, :, None] * spec.rising
        inside = self._body.share(points.reshape(-1, 3)).reshape(points.shape[:2]) >= 0.5
        coarse = np.where(inside.any(axis=1), heights[inside.argmax(axis=1)], np.nan)
        near = np.arange(_NEAR_MM, -_NEAR_MM, -_FINE_MM)
        places = np.nan_to_num(coarse)[:, None] + near[None]
        fine = starts[:, None] + places[..., None] * spec.rising
        values = interpolate(volume.hu, volume.voxel(fine.reshape(-1, 3))).reshape(places.shape)
        values = values - self._body.skin_level
        rising: NDArray[np.bool_] = (values[:, :-1] <= 0.0) & (values[:, 1:] > 0.0)
        which = rising.argmax(axis=1)
        rows = np.arange(len(across))
        before, after = values[rows, which], values[rows, which + 1]
        with np.errstate(divide="ignore", invalid="ignore"):
            exact = places[rows, which] + _FINE_MM * before / (after - before)
        height = np.where(rising.any(axis=1), exact, coarse)
        return _about_middle(across, height)


def _about_middle(across: FloatArray, height: FloatArray) -> SkinProfile:
    """Keep the skin that hangs together about the middle line.

    Raises:
        InvalidEntryError: if there is none.
    """
    middle = int(np.argmin(np.abs(across)))
    good = np.isfinite(height)
    if not good[middle]:
        raise InvalidEntryError(sentence("there is no skin under the grid's middle line"), 0.0)
    steep = np.abs(np.diff(height)) > _STEEPEST * _ACROSS_MM
    broken = np.concatenate([[False], steep]) | ~good
    first, last = middle, middle
    while first > 0 and good[first - 1] and not broken[first]:
        first -= 1
    while last + 1 < len(across) and not broken[last + 1]:
        last += 1
    u, h = across[first : last + 1], height[first : last + 1]
    along = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(u), np.diff(h)))])
    return SkinProfile(u, h, along - float(np.interp(0.0, u, along)))


_MADE: WeakKeyDictionary[Volume, SkinGrid] = WeakKeyDictionary()
"""Of each CT that is still open, the grid that was asked for last."""


def grid_on(volume: Volume, spec: GridSpec) -> SkinGrid:
    """Return a grid on the skin of a CT; its body is looked for once."""
    there = _MADE.get(volume)
    if there is None or there.spec != spec:
        from app.imaging.body import find_body  # scipy: loaded since there is a patient

        there = SkinGrid(find_body(volume), spec)
        _MADE[volume] = there
    return there
