"""What the kept views of one camera cover: places in the picture, distances, tilts."""

from dataclasses import dataclass
from functools import cached_property
from math import acos, degrees
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.tracking.calibration.grid import local_axes, mapped, plane_map
from app.tracking.calibration.views import BoardView

COLUMNS: Final = 8
ROWS: Final = 6
"""Cells of the coverage map."""


@dataclass(frozen=True, slots=True)
class Attitude:
    """How a board lies before a camera, from its corners alone.

    Attributes:
        centre: of the board in the picture, parts of width and height.
        size: square root of a square's area, parts of the picture's diagonal.
        turn_deg: direction of the board's columns in the picture.
        tilt_deg: to the right and downwards: positive where the right or the lower side of the
            board is the nearer one, (2,).
    """

    centre: tuple[float, float]
    size: float
    turn_deg: float
    tilt_deg: tuple[float, float]

    @classmethod
    def of(cls, view: BoardView) -> "Attitude | None":
        """Attitude in a view; None if its corners lie on one line."""
        homography = plane_map(view.board, view.ids, view.pixels)
        if homography is None:
            return None
        board = view.board
        middle = np.array([[board.columns - 1, board.rows - 1]]) / 2.0
        axes = local_axes(homography, middle)[0]
        size = np.array(view.image_size, dtype=np.float64)
        x, y = (mapped(homography, middle)[0] + 0.5) / size
        turn = float(np.degrees(np.arctan2(axes[1, 0], axes[0, 0])))
        area = float(np.sqrt(abs(np.linalg.det(axes))) / np.linalg.norm(size))
        return cls(
            (float(x), float(y)), area, turn, _tilt(homography, axes, np.append(middle[0], 1.0))
        )

    def alike(self, other: "Attitude") -> bool:
        """Return whether two views teach nearly the same."""
        moved = np.hypot(self.centre[0] - other.centre[0], self.centre[1] - other.centre[1])
        tilted = np.hypot(
            self.tilt_deg[0] - other.tilt_deg[0], self.tilt_deg[1] - other.tilt_deg[1]
        )
        turned = abs((self.turn_deg - other.turn_deg + 180.0) % 360.0 - 180.0)
        grown = max(self.size, other.size) / max(1e-9, min(self.size, other.size))
        return bool(moved < 0.1 and tilted < 8.0 and turned < 15.0 and grown < 1.2)


def _tilt(homography: FloatArray, axes: FloatArray, middle: FloatArray) -> tuple[float, float]:
    """Tilt [deg] towards picture right and down.

    How much from the foreshortening (ratio of singular values = cosine); which way from where the
    squares grow, along the axis in which they are short. `middle` is the board's, homogeneous.
    """
    u, values, _ = np.linalg.svd(axes)
    angle = degrees(acos(min(1.0, float(values[1] / values[0]))))
    short = u[:, 1]
    # Depth is proportional to w = h31·x + h32·y + h33 on the board; its slope along the picture.
    slope = np.linalg.solve(axes.T, homography[2, :2]) * np.sign(homography[2] @ middle)
    nearer = -np.sign(float(slope @ short)) or 1.0
    return float(angle * nearer * short[0]), float(angle * nearer * short[1])


@dataclass(frozen=True, eq=False)
class Coverage:
    """Of one camera.

    Attributes:
        views: kept, in order.
        attitudes: of them.
    """

    views: tuple[BoardView, ...] = ()
    attitudes: tuple[Attitude, ...] = ()

    def adding(self, view: BoardView, attitude: Attitude) -> "Coverage":
        """Return the coverage with one more view."""
        return Coverage((*self.views, view), (*self.attitudes, attitude))

    def knows(self, attitude: Attitude) -> bool:
        """Return whether a kept view is nearly the same."""
        return any(attitude.alike(known) for known in self.attitudes)

    @cached_property
    def cells(self) -> NDArray[np.int64]:
        """Corners found in each cell of the picture, shape (ROWS, COLUMNS)."""
        found = np.zeros((ROWS, COLUMNS), dtype=np.int64)
        for view in self.views:
            parts = (view.pixels + 0.5) / np.array(view.image_size)
            column = np.clip((parts[:, 0] * COLUMNS).astype(int), 0, COLUMNS - 1)
            row = np.clip((parts[:, 1] * ROWS).astype(int), 0, ROWS - 1)
            np.add.at(found, (row, column), 1)
        found.setflags(write=False)
        return found

    @property
    def covered(self) -> float:
        """Share of the cells that hold a corner."""
        return float((self.cells > 0).mean())

    @property
    def growth(self) -> float:
        """Largest over smallest size of the board; 1 without views."""
        sizes = [attitude.size for attitude in self.attitudes]
        return max(sizes) / min(sizes) if sizes else 1.0

    def tilts(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Smallest and largest tilt to the right, and downwards [deg]."""
        if not self.attitudes:
            return (0.0, 0.0), (0.0, 0.0)
        values = np.array([attitude.tilt_deg for attitude in self.attitudes])
        low, high = values.min(axis=0).tolist(), values.max(axis=0).tolist()
        return (low[0], high[0]), (low[1], high[1])

    def bare_corners(self) -> tuple[str, ...]:
        """Names of the picture's corners near which no corner of the board was seen."""
        seen = self.cells > 0
        places = {
            "upper left": seen[:2, :2],
            "upper right": seen[:2, -2:],
            "lower left": seen[-2:, :2],
            "lower right": seen[-2:, -2:],
        }
        return tuple(name for name, part in places.items() if not part.any())
