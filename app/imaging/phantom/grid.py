"""Pixels that all slices of the phantom share, with what is computed for them once."""

from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from app.imaging.phantom import trunk
from app.imaging.phantom.patient import Patient
from app.imaging.phantom.shapes import Field
from app.imaging.phantom.vessels import Vasculature

ANGLES: Final = 4096
"""Length of tables over the angle around the axis."""

_TILE: Final = 96
_TILE_MM: Final = 1.1

Box = tuple[slice, slice]


@dataclass(frozen=True, eq=False)
class Grid:
    """Pixels that all slices share, in model coordinates [mm].

    Attributes:
        patient: whose body it is.
        x: of the columns, shape (1, columns).
        y: of the rows, shape (rows, 1).
        pixel_mm: distance between pixels in the patient.
        tubes: vessels and gut.
    """

    patient: Patient
    x: Field
    y: Field
    pixel_mm: float
    tubes: Vasculature

    @cached_property
    def rho(self) -> Field:
        """Distance from the axis, shape (rows, columns)."""
        return np.hypot(self.x, self.y)

    @cached_property
    def angle(self) -> NDArray[np.intp]:
        """Place of every pixel in a table over theta."""
        theta = np.arctan2(self.y, self.x)
        return np.rint((theta + np.pi) / (2.0 * np.pi) * (ANGLES - 1)).astype(np.intp)

    @cached_property
    def dome(self) -> Field:
        """Height of the diaphragm over every pixel."""
        return trunk.diaphragm_height(self.patient, self.x, self.y).astype(np.float32)

    @cached_property
    def p(self) -> Field:
        """Share of the way from spine to sternum of every pixel."""
        return np.abs(np.arctan2(self.x, self.y)) / np.float32(np.pi)

    @cached_property
    def _texture(self) -> Field:
        """Periodic random field of unit variance."""
        white = self.patient.generator(6).standard_normal((_TILE,) * 3, dtype=np.float32)
        field = ndimage.gaussian_filter(white, 1.3, mode="wrap")
        field += 3.2 * ndimage.gaussian_filter(white[::-1], 3.5, mode="wrap")
        tile: Field = field / field.std()
        return tile

    def texture_at(self, z: float) -> Field:
        """Mottling of tissue in the slice at z, unit variance, shape (rows, columns)."""

        def cell(axis: Field) -> NDArray[np.intp]:
            return np.floor(axis / _TILE_MM).astype(np.intp) % _TILE

        plane = self._texture[int(np.floor(z / _TILE_MM)) % _TILE]
        return plane[cell(self.y), cell(self.x)]

    def box(self, x0: float, x1: float, y0: float, y1: float) -> Box:
        """Pixels between model coordinates."""
        columns = np.searchsorted(self.x[0], (x0, x1))
        rows = np.searchsorted(self.y[:, 0], (y0, y1))
        return slice(int(rows[0]), int(rows[1])), slice(int(columns[0]), int(columns[1]))
