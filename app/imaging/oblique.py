"""Oblique slices: any plane through a volume as a picture, compiled, without the interpreter lock.

Row 0 is on top and column 0 on the left; what lies outside the volume (beyond the edges of its
outermost voxels) gets one given value. Between the centres of the outermost voxels and their edges
the edge value goes on, as in `interpolation`.
"""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, frozen
from app.core.compiled import njit
from app.core.errors import NumericalError
from app.core.messages import sentence
from app.imaging.interpolation import Interpolation
from app.imaging.volume import Volume

OUTSIDE_HU: Final = -1024.0
"""Default value of pixels outside the volume: below air."""


@dataclass(frozen=True, slots=True, eq=False)
class Plane:
    """A rectangle of pixels somewhere in the patient.

    Attributes:
        corner_mm: centre of pixel (column 0, row 0) in LPS, shape (3,).
        across_mm: from one column to the next, shape (3,).
        down_mm: from one row to the next, shape (3,).
        columns, rows: size of the picture.

    Raises:
        NumericalError: if a vector is not finite, or the picture has no pixels.
    """

    corner_mm: FloatArray
    across_mm: FloatArray
    down_mm: FloatArray
    columns: int
    rows: int

    def __post_init__(self) -> None:
        for name in ("corner_mm", "across_mm", "down_mm"):
            object.__setattr__(self, name, frozen(getattr(self, name), (3,), name))
        if self.columns < 1 or self.rows < 1:
            raise NumericalError(
                sentence(
                    "a picture of {columns} x {rows} pixels has no pixels",
                    columns=self.columns,
                    rows=self.rows,
                )
            )

    @classmethod
    def centred(
        cls,
        centre_mm: FloatArray,
        right: FloatArray,
        down: FloatArray,
        pixel_mm: float,
        columns: int,
        rows: int,
    ) -> "Plane":
        """Picture of square pixels around a point; `right` and `down` are unit vectors in LPS."""
        across, below = np.asarray(right) * pixel_mm, np.asarray(down) * pixel_mm
        corner = np.asarray(centre_mm) - across * (columns - 1) / 2 - below * (rows - 1) / 2
        return cls(corner, across, below, columns, rows)

    def points_mm(self) -> FloatArray:
        """Centres of all pixels in LPS, shape (rows, columns, 3)."""
        down = np.arange(self.rows)[:, None, None] * self.down_mm
        across = np.arange(self.columns)[None, :, None] * self.across_mm
        result: FloatArray = self.corner_mm + down + across
        return result


def picture_of(plane: Plane, out: NDArray[np.float32] | None) -> NDArray[np.float32]:
    """Return `out` if it fits the plane, or a new picture if there is none, shape (rows, columns).

    Raises:
        NumericalError: if `out` has another shape or type.
    """
    shape = (plane.rows, plane.columns)
    picture = np.empty(shape, np.float32) if out is None else out
    if picture.shape != shape or picture.dtype != np.float32 or not picture.flags.c_contiguous:
        raise NumericalError(
            sentence(
                "out is {picture_dtype} of shape {picture_shape}; "
                "contiguous float32 of shape {shape} is needed",
                picture_dtype=picture.dtype,
                picture_shape=picture.shape,
                shape=shape,
            )
        )
    return picture


def oblique_image(
    volume: Volume,
    plane: Plane,
    interpolation: Interpolation = Interpolation.TRILINEAR,
    outside_hu: float = OUTSIDE_HU,
    out: NDArray[np.float32] | None = None,
) -> NDArray[np.float32]:
    """Slice a volume along any plane.

    Args:
        volume: the CT.
        plane: which pixels.
        interpolation: nearest, trilinear or cubic (Catmull-Rom).
        outside_hu: value of pixels outside the volume.
        out: picture to write into, float32, shape (rows, columns); made if None.

    Returns:
        Hounsfield values, float32, shape (rows, columns).

    Raises:
        NumericalError: if `out` has another shape or type.
    """
    picture = picture_of(plane, out)
    linear = volume.inverse_mm[:3, :3]
    start = volume.voxel(plane.corner_mm)
    kernel = _KERNELS[Interpolation(interpolation)]
    hu = np.ascontiguousarray(volume.hu)  # as it is read: no copy
    kernel(hu, start, linear @ plane.across_mm, linear @ plane.down_mm, outside_hu, picture)
    return picture


# Each kernel has a short way for pixels whose whole neighbourhood lies in the volume (unsigned flat
# indices: no wrap-around to test, single precision) and a careful one for the rest.


@njit
def _outside(i: float, j: float, k: float, hu: NDArray[Any]) -> bool:
    return not (
        -0.5 <= i <= hu.shape[2] - 0.5
        and -0.5 <= j <= hu.shape[1] - 0.5
        and -0.5 <= k <= hu.shape[0] - 0.5
    )


@njit
def _clamp(index: int, size: int) -> int:
    return min(max(index, 0), size - 1)


@njit
def _nearest(
    hu: NDArray[Any],
    start: FloatArray,
    across: FloatArray,
    down: FloatArray,
    outside: float,
    out: NDArray[np.float32],
) -> None:
    for row in range(out.shape[0]):
        i0, j0, k0 = start[0] + row * down[0], start[1] + row * down[1], start[2] + row * down[2]
        for column in range(out.shape[1]):
            i, j, k = i0 + column * across[0], j0 + column * across[1], k0 + column * across[2]
            if _outside(i, j, k, hu):
                out[row, column] = outside
                continue
            out[row, column] = hu[
                np.uint64(_clamp(int(np.floor(k + 0.5)), hu.shape[0])),
                np.uint64(_clamp(int(np.floor(j + 0.5)), hu.shape[1])),
                np.uint64(_clamp(int(np.floor(i + 0.5)), hu.shape[2])),
            ]


@njit
def _base(at: float, size: int) -> tuple[int, int, float]:
    """Voxel below and above a position within [0, size - 1], and the fraction between them."""
    at = min(max(at, 0.0), size - 1.0)
    low = min(int(at), max(size - 2, 0))
    return low, min(low + 1, size - 1), at - low


@njit
def _trilinear_at(hu: NDArray[Any], i: float, j: float, k: float) -> float:
    """Value anywhere in the volume, edges included."""
    i0, i1, fi = _base(i, hu.shape[2])
    j0, j1, fj = _base(j, hu.shape[1])
    k0, k1, fk = _base(k, hu.shape[0])
    near = (1.0 - fj) * ((1.0 - fi) * hu[k0, j0, i0] + fi * hu[k0, j0, i1])
    near += fj * ((1.0 - fi) * hu[k0, j1, i0] + fi * hu[k0, j1, i1])
    far = (1.0 - fj) * ((1.0 - fi) * hu[k1, j0, i0] + fi * hu[k1, j0, i1])
    far += fj * ((1.0 - fi) * hu[k1, j1, i0] + fi * hu[k1, j1, i1])
    return (1.0 - fk) * near + fk * far


@njit
def _between(flat: NDArray[Any], at: int, fraction: float) -> Any:
    """Value between a voxel and the next of its row."""
    low = np.float32(flat[np.uint64(at)])
    return low + fraction * (np.float32(flat[np.uint64(at + 1)]) - low)


@njit
def _trilinear(
    hu: NDArray[Any],
    start: FloatArray,
    across: FloatArray,
    down: FloatArray,
    outside: float,
    out: NDArray[np.float32],
) -> None:
    size_k, size_j, size_i = hu.shape
    flat, slab = hu.ravel(), size_i * size_j
    for row in range(out.shape[0]):
        i0, j0, k0 = start[0] + row * down[0], start[1] + row * down[1], start[2] + row * down[2]
        for column in range(out.shape[1]):
            i, j, k = i0 + column * across[0], j0 + column * across[1], k0 + column * across[2]
            if 0.0 <= i < size_i - 1 and 0.0 <= j < size_j - 1 and 0.0 <= k < size_k - 1:
                a, b, c = int(i), int(j), int(k)
                fi, fj, fk = np.float32(i - a), np.float32(j - b), np.float32(k - c)
                at = c * slab + b * size_i + a
                near, below = _between(flat, at, fi), _between(flat, at + size_i, fi)
                far, last = _between(flat, at + slab, fi), _between(flat, at + slab + size_i, fi)
                near += fj * (below - near)
                out[row, column] = near + fk * (far + fj * (last - far) - near)
            elif _outside(i, j, k, hu):
                out[row, column] = outside
            else:
                out[row, column] = _trilinear_at(hu, i, j, k)


@njit
def _weights(t: float) -> tuple[float, float, float, float]:
    """Catmull-Rom weights of the voxels -1, 0, 1, 2."""
    a = 0.5 * t * (-1.0 + t * (2.0 - t))
    b = 0.5 * (2.0 + t * t * (-5.0 + 3.0 * t))
    c = 0.5 * t * (1.0 + t * (4.0 - 3.0 * t))
    return a, b, c, 0.5 * t * t * (t - 1.0)


@njit
def _cubic_at(hu: NDArray[Any], i: float, j: float, k: float) -> float:
    """Value anywhere in the volume; beyond an edge its voxel is taken again."""
    size_k, size_j, size_i = hu.shape
    i0, _, fi = _base(i, size_i)
    j0, _, fj = _base(j, size_j)
    k0, _, fk = _base(k, size_k)
    wi, wj, wk = _weights(fi), _weights(fj), _weights(fk)
    total = 0.0
    for c in range(4):
        for b in range(4):
            for a in range(4):
                total += (wk[c] * wj[b] * wi[a]) * hu[
                    _clamp(k0 - 1 + c, size_k),
                    _clamp(j0 - 1 + b, size_j),
                    _clamp(i0 - 1 + a, size_i),
                ]
    return total


@njit
def _row_of_four(
    flat: NDArray[Any], at: int, w: tuple[np.float32, np.float32, np.float32, np.float32]
) -> Any:
    """Weighted sum of four voxels of a row, the first at `at`."""
    total = w[0] * np.float32(flat[np.uint64(at)]) + w[1] * np.float32(flat[np.uint64(at + 1)])
    total += w[2] * np.float32(flat[np.uint64(at + 2)])
    return total + w[3] * np.float32(flat[np.uint64(at + 3)])


@njit
def _cubic(
    hu: NDArray[Any],
    start: FloatArray,
    across: FloatArray,
    down: FloatArray,
    outside: float,
    out: NDArray[np.float32],
) -> None:
    size_k, size_j, size_i = hu.shape
    flat, slab = hu.ravel(), size_i * size_j
    for row in range(out.shape[0]):
        i0, j0, k0 = start[0] + row * down[0], start[1] + row * down[1], start[2] + row * down[2]
        for column in range(out.shape[1]):
            i, j, k = i0 + column * across[0], j0 + column * across[1], k0 + column * across[2]
            if 1.0 <= i < size_i - 2 and 1.0 <= j < size_j - 2 and 1.0 <= k < size_k - 2:
                a, b, c = int(i), int(j), int(k)
                u, wj, wk = _weights(i - a), _weights(j - b), _weights(k - c)
                wi = np.float32(u[0]), np.float32(u[1]), np.float32(u[2]), np.float32(u[3])
                total = 0.0
                for m in range(4):
                    at = (c - 1 + m) * slab + (b - 1) * size_i + a - 1
                    plane = wj[0] * _row_of_four(flat, at, wi)
                    plane += wj[1] * _row_of_four(flat, at + size_i, wi)
                    plane += wj[2] * _row_of_four(flat, at + 2 * size_i, wi)
                    total += wk[m] * (plane + wj[3] * _row_of_four(flat, at + 3 * size_i, wi))
                out[row, column] = total
            elif _outside(i, j, k, hu):
                out[row, column] = outside
            else:
                out[row, column] = _cubic_at(hu, i, j, k)


_KERNELS: Final[dict[Interpolation, Any]] = {
    Interpolation.NEAREST: _nearest,
    Interpolation.TRILINEAR: _trilinear,
    Interpolation.CUBIC: _cubic,
}
