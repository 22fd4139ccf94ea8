"""Pictures of a calibration board with known truth, through a camera with lens distortion."""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.transform import RigidTransform
from app.tracking.calibration.boards import Board, BoardKind
from app.tracking.optics.camera_model import CameraModel

_DARK, _BRIGHT, _TABLE = 40.0, 215.0, 120.0
_MARGIN = 0.5
"""White rim around the squares, in squares."""

_TEXTURE = 48
"""Pixels of a square in the texture of a ChArUco board."""


@dataclass(frozen=True)
class BoardRenderer:
    """Draws a board as one camera sees it.

    Every pixel averages `supersample`² rays; each goes through the lens backwards to the plane of
    the board. A picture is then blurred by a Gaussian and given noise.

    Attributes:
        model: the camera; its place in the world does not matter.
        board: what is drawn.
        supersample: rays per pixel along each axis.
    """

    model: CameraModel
    board: Board
    supersample: int = 3

    def render(
        self,
        T_camera_board: RigidTransform,
        blur_px: float = 0.6,
        noise_grey: float = 2.0,
        rng: np.random.Generator | None = None,
    ) -> NDArray[np.uint8]:
        """Draw a picture, uint8 (h, w).

        Args:
            T_camera_board: pose of the board; what lies behind the camera is not drawn.
            blur_px: standard deviation of the picture of a point.
            noise_grey: standard deviation of a grey value.
            rng: source of the noise; a fixed one if None.
        """
        width, height = self.model.image_size
        grey = np.full((height, width), _TABLE)
        box = self._box(T_camera_board)
        if box is not None:
            grey[box] = self._average(T_camera_board, box)
        if blur_px > 0.0:
            grey = cv2.GaussianBlur(grey, (0, 0), blur_px)
        rng = rng or np.random.default_rng(0)
        grey = grey + noise_grey * rng.standard_normal(grey.shape)
        result: NDArray[np.uint8] = np.clip(np.rint(grey), 0, 255).astype(np.uint8)
        return result

    def _box(self, T_camera_board: RigidTransform) -> tuple[slice, slice] | None:
        """Rows and columns in which the board can be; None if it is outside the picture."""
        reach = np.array([self.board.columns, self.board.rows]) + _MARGIN
        t = np.linspace(0.0, 1.0, 20)[:, None]
        corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]], dtype=np.float64)
        corners = corners * (reach + 1.0 + _MARGIN) - 1.0 - _MARGIN
        outline = np.concatenate([a + t * (b - a) for a, b in pairwise(corners)])
        points = np.column_stack([outline * self.board.square, np.zeros(len(outline))])
        uv, ok = self.model.project_camera(T_camera_board @ points)
        width, height = self.model.image_size
        if not ok.all():  # partly behind the camera or beyond the fold: look everywhere
            return slice(0, height), slice(0, width)
        low = np.clip(np.floor(uv.min(axis=0)) - 1, 0, (width, height)).astype(int)
        high = np.clip(np.ceil(uv.max(axis=0)) + 2, 0, (width, height)).astype(int)
        if (high <= low).any():
            return None
        return slice(low[1], high[1]), slice(low[0], high[0])

    def _average(self, T_camera_board: RigidTransform, box: tuple[slice, slice]) -> FloatArray:
        """Grey values of the pixels of a box, each the mean over its rays."""
        s = self.supersample
        rows, columns = (
            (np.arange((side.stop - side.start) * s) + 0.5) / s - 0.5 + side.start for side in box
        )
        grid = np.stack(np.meshgrid(columns, rows), axis=-1).reshape(-1, 2)
        rays, found = self.model.undistort(grid)
        xy, hit = self._on_board(np.column_stack([rays, np.ones(len(rays))]), T_camera_board)
        shade = self._shade(xy.reshape(len(rows), len(columns), 2)).ravel()
        values = np.where(found & hit, shade, _TABLE)
        means: FloatArray = values.reshape(len(rows) // s, s, len(columns) // s, s).mean((1, 3))
        return means

    def _on_board(
        self, rays: FloatArray, T_camera_board: RigidTransform
    ) -> tuple[FloatArray, NDArray[np.bool_]]:
        """Find where rays meet the board's plane [squares from the first corner], and which do."""
        normal = T_camera_board.rotation[:, 2]
        along = rays @ normal
        safe = np.where(np.abs(along) > 1e-9, along, 1.0)
        depth = (T_camera_board.translation @ normal) / safe
        points = rays * depth[:, None] - T_camera_board.translation
        xy = points @ T_camera_board.rotation[:, :2] / self.board.square
        reach = np.array([self.board.columns, self.board.rows]) + _MARGIN
        hit = (np.abs(along) > 1e-9) & (depth > 0.0)
        hit &= (xy > -1.0 - _MARGIN).all(axis=1) & (xy < reach).all(axis=1)
        return xy, hit

    def _shade(self, xy: FloatArray) -> FloatArray:
        """Grey value of board points [squares], (h, w, 2) -> (h, w)."""
        inside = (xy > -1.0).all(axis=2)
        inside &= (xy[..., 0] < self.board.columns) & (xy[..., 1] < self.board.rows)
        if self.board.kind is BoardKind.CHECKERBOARD:
            dark = 0.5 + 0.5 * _wave(xy[..., 0]) * _wave(xy[..., 1])
        else:
            place = np.clip(((xy + 1.0) * _TEXTURE).astype(np.int64), 0, None)
            rows = np.minimum(place[..., 1], self._texture.shape[0] - 1)
            columns = np.minimum(place[..., 0], self._texture.shape[1] - 1)
            dark = (self._texture[rows, columns] < 128).astype(np.float64)
        return np.where(inside, _BRIGHT + dark * (_DARK - _BRIGHT), _BRIGHT)

    @cached_property
    def _texture(self) -> NDArray[np.uint8]:
        size = ((self.board.columns + 1) * _TEXTURE, (self.board.rows + 1) * _TEXTURE)
        result: NDArray[np.uint8] = self.board.charuco().generateImage(size)
        return result


def _wave(x: FloatArray) -> FloatArray:
    """Alternate between 1 and -1 from square to square, linear within one ray's width of an edge.

    So a ray counts the part of its little square that is dark, and edges lie where they are.
    """
    down, across = np.gradient(x)
    width = np.maximum(np.hypot(down, across), 1e-12)
    nearest = np.rint(x)
    step = np.clip(2.0 * (x - nearest) / width, -1.0, 1.0)
    result: FloatArray = np.where(nearest % 2 == 0, step, -step)
    return result
