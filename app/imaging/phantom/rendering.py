"""The phantom on a scanner's grid: what every slice shares, then its blur and noise."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from app.imaging.phantom import trunk
from app.imaging.phantom.canvas import AIR, Canvas
from app.imaging.phantom.grid import Grid
from app.imaging.phantom.patient import Patient
from app.imaging.phantom.shapes import Field, cover
from app.imaging.phantom.vessels import vasculature

_HALF_X, _HALF_Y = 170.0, 120.0
"""The body fits between these model coordinates [mm]."""

_NOISE_TILE: Final = 1024


@dataclass(frozen=True, eq=False)
class Scan:
    """A patient on a scanner's grid.

    Attributes:
        patient: who.
        rows: rows and columns of a slice.
        pixel_mm: distance between pixels.
    """

    patient: Patient
    rows: int
    pixel_mm: float

    def slice_hu(self, z_mm: float, index: int) -> NDArray[np.int16]:
        """Hounsfield values of the slice at patient height z [mm], shape (rows, rows).

        Args:
            z_mm: LPS height.
            index: number of the slice, which seeds its noise.
        """
        rows, columns = self._body_box
        image = self._room.copy()
        body = Canvas(self.grid, z_mm / self.patient.scale[2], image[rows, columns])
        body.paint_all()
        return self._measured(image, index)

    def _measured(self, image: Field, index: int) -> NDArray[np.int16]:
        """Blur and noise of a scanner with a soft kernel."""
        sharp = ndimage.gaussian_filter(image, 0.45 / self.pixel_mm, mode="nearest", truncate=3.0)
        rng = np.random.default_rng([self.patient.seed, 1000 + index])
        row, column = rng.integers(0, max(1, _NOISE_TILE - self.rows), 2)
        window = self._noise[row : row + self.rows, column : column + self.rows]
        sharp += window * (self._noise_profile * (-1.0 if rng.random() < 0.5 else 1.0))
        return np.clip(np.rint(sharp), -1024.0, 3071.0).astype(np.int16)

    def axis(self, axis: int) -> Field:
        """Model coordinates of the columns (0) or rows (1), shape (rows,)."""
        steps = np.arange(self.rows, dtype=np.float32) - (self.rows - 1) / 2
        result: Field = (steps * (self.pixel_mm / self.patient.scale[axis])).astype(np.float32)
        return result

    @cached_property
    def _body_box(self) -> tuple[slice, slice]:
        def span(axis: Field, half: float) -> slice:
            first, last = np.searchsorted(axis, (-half, half))
            return slice(int(first), int(last))

        return span(self.axis(1), _HALF_Y), span(self.axis(0), _HALF_X)

    @cached_property
    def grid(self) -> Grid:
        """The part of the grid that holds the body."""
        rows, columns = self._body_box
        return Grid(
            self.patient, self.axis(0)[None, columns], self.axis(1)[rows, None],
            self.pixel_mm, vasculature(self.patient),
        )  # fmt: skip

    @cached_property
    def _room(self) -> Field:
        """Air and the table."""
        image = np.full((self.rows, self.rows), AIR, np.float32)
        x, y = self.axis(0)[None, :], self.axis(1)[:, None]
        top = trunk.HALF_DEPTH_BACK + 7.0 - 26.0 * (x / 190.0) ** 2
        for depth, half, hu in ((1.2, 1.2, -380.0), (16.0, 13.0, -955.0), (31.0, 1.2, -420.0)):
            share = cover(np.abs(y - top - depth) - half, self.pixel_mm)
            image += share * (np.float32(hu) - image)
        return image

    @cached_property
    def _noise(self) -> Field:
        """Correlated noise of the patient's standard deviation; each slice shows a part of it."""
        white: Any = self.patient.generator(7).standard_normal((_NOISE_TILE,) * 2, np.float32)
        noise = ndimage.gaussian_filter(white, min(0.7 / self.pixel_mm, 2.0), mode="wrap")
        return noise * np.float32(self.patient.noise_hu / noise.std())

    @cached_property
    def _noise_profile(self) -> Field:
        """Noise is strongest in the middle of the body and falls off into the air."""
        rho = np.hypot(self.axis(0)[None, :], self.axis(1)[:, None])
        return (0.45 + 0.75 * np.exp(-((rho / 120.0) ** 2))).astype(np.float32)
