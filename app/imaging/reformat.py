"""Where a plane lies in the patient and which way it is read: the value behind every slice view.

Numbers only: nothing here is compiled, so that a window may use it before anything heavy is loaded.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen, unit
from app.core.errors import NumericalError
from app.core.messages import sentence
from app.core.rotation import rotation_exp
from app.imaging.orthogonal import Letters, letters

if TYPE_CHECKING:
    from app.imaging.oblique import Plane

_ORTHONORMAL_TOLERANCE = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """A plane in the patient with a direction of reading; LPS, millimetres.

    Coordinates (x, y) count from `origin_mm` to the right and downwards on the screen.

    Attributes:
        origin_mm: where (0, 0) lies, shape (3,), read-only.
        right, down: unit vectors of the screen, perpendicular, shape (3,), read-only.
        normal: `right × down`, into the screen, unit, shape (3,), read-only.

    Raises:
        NumericalError: if `right` and `down` are not perpendicular unit vectors, or a value is not
            finite.
    """

    origin_mm: FloatArray
    right: FloatArray
    down: FloatArray
    normal: FloatArray = field(init=False)

    def __post_init__(self) -> None:
        for name in ("origin_mm", "right", "down"):
            object.__setattr__(self, name, frozen(getattr(self, name), (3,), name))
        axes = np.stack([self.right, self.down])
        if np.abs(axes @ axes.T - np.eye(2)).max() > _ORTHONORMAL_TOLERANCE:
            raise NumericalError(
                sentence(
                    "right {right} and down {down} are not perpendicular unit vectors",
                    right=self.right.tolist(),
                    down=self.down.tolist(),
                )
            )
        (a, b, c), (u, v, w) = self.right.tolist(), self.down.tolist()  # np.cross is slow on threes
        normal = (b * w - c * v, c * u - a * w, a * v - b * u)
        object.__setattr__(self, "normal", frozen(normal))

    @classmethod
    def of(cls, origin_mm: ArrayLike, right: ArrayLike, down: ArrayLike) -> Frame:
        """Make a frame of two directions; `down` is turned within their plane to a right angle.

        Raises:
            NumericalError: if a direction has no length, or both are parallel.
        """
        across, below = unit(right, "right"), unit(down, "down")
        if np.linalg.norm(np.cross(across, below)) < 1e-9:
            raise NumericalError(
                sentence(
                    "right {across} and down {below} are parallel",
                    across=across.tolist(),
                    below=below.tolist(),
                )
            )
        return cls(np.asarray(origin_mm), across, unit(below - (below @ across) * across))

    def point(self, lps_mm: ArrayLike) -> tuple[float, float, float]:
        """Place x, y and signed distance along the normal [mm] of a patient point, shape (3,)."""
        offset = np.asarray(lps_mm, np.float64) - self.origin_mm
        x, y = float(offset @ self.right), float(offset @ self.down)
        return x, y, float(offset @ self.normal)

    def lps_mm(self, x: float, y: float, offset_mm: float = 0.0) -> FloatArray:
        """Patient point [mm], shape (3,), of a place; the inverse of `point`."""
        return self.origin_mm + x * self.right + y * self.down + offset_mm * self.normal

    def moved(self, offset_mm: float) -> Frame:
        """Go along the normal by so much."""
        return self.at(self.origin_mm + offset_mm * self.normal)

    def at(self, origin_mm: ArrayLike) -> Frame:
        """Lay the same directions through another point [mm]: they need not be checked again.

        Raises:
            NumericalError: if the point is not finite.
        """
        made = object.__new__(Frame)
        object.__setattr__(made, "origin_mm", frozen(origin_mm, (3,), "origin_mm"))
        for name in ("right", "down", "normal"):
            object.__setattr__(made, name, getattr(self, name))
        return made

    def turned(self, axis: ArrayLike, angle: float, about_mm: ArrayLike) -> Frame:
        """Turn about an axis through a patient point [mm], whose (x, y) stay what they are.

        Args:
            axis: direction in LPS, shape (3,).
            angle: by the right-hand rule [rad].
            about_mm: the point, shape (3,).
        """
        turn, pivot = rotation_exp(angle * unit(axis, "axis")), np.asarray(about_mm, np.float64)
        origin = pivot + turn @ (self.origin_mm - pivot)
        return Frame.of(origin, turn @ self.right, turn @ self.down)

    def quarter(self, turns: int, mirrored: bool = False) -> Frame:
        """Turn what is seen clockwise by quarters; `mirrored` swaps left and right before that."""
        right, down = (-self.right if mirrored else self.right), self.down
        for _ in range(turns % 4):
            right, down = -down, right
        return Frame(self.origin_mm, right, down)

    def letters(self) -> Letters:
        """Patient directions at the edges, dominant letter first."""
        sides = (-self.right, self.right, -self.down, self.down)
        return Letters(*(letters(side) for side in sides))

    def pixels(
        self, left: float, top: float, pixel_mm: float, columns: int, rows: int, offset_mm: float
    ) -> Plane:
        """Picture of square pixels.

        Args:
            left: outer edge of the first column [mm].
            top: outer edge of the first row [mm].
            pixel_mm: size of a pixel.
            columns: width of the picture.
            rows: height of the picture.
            offset_mm: distance of the picture from this plane along the normal.
        """
        from app.imaging.oblique import Plane  # compiled: loaded since there is a volume

        half = 0.5 * pixel_mm
        corner = self.lps_mm(left + half, top + half, offset_mm)
        return Plane(corner, pixel_mm * self.right, pixel_mm * self.down, columns, rows)


def trace(this: Frame, other: Frame) -> tuple[float, float, float, float] | None:
    """Line in which another plane cuts this one; None where they are parallel.

    Returns:
        A point x, y [mm] of the line, the nearest to this plane's origin, and the line's unit
        direction dx, dy.
    """
    normal = other.normal
    a, b = float(normal @ this.right), float(normal @ this.down)
    steepness = float(np.hypot(a, b))
    if steepness < 1e-6:
        return None
    # a x + b y = c on the line
    a, b = a / steepness, b / steepness
    c = float(normal @ (other.origin_mm - this.origin_mm)) / steepness
    return a * c, b * c, -b, a
