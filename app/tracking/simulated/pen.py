"""Pictures of a pen with printed markers over its sheet, with known truth.

Every pixel is sampled nine times: ray, plane of a printed face, place on the print. Distortion is
therefore exact; edges have the blur of the pixel and of the lens.

Sampling printed markers: rays of all samples, where they meet a print, its grey values.
"""

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.transform import RigidTransform
from app.tracking.cameras.camera import Image
from app.tracking.optics.camera_model import CameraModel
from app.tracking.pen.board import Marker, MarkerBoard, marker_cells
from app.tracking.simulated.background import LIGHT_WORLD
from app.tracking.simulated.pen_scene import PenScene

SUPERSAMPLING = 3
TEXELS = 8
"""Texels per cell of a marker."""

PAD = 2
"""White round a marker in its texture, in cells."""

BLACK, WHITE = 32.0, 215.0

Plain = NDArray[np.float32]


def places(rays: Plain, corners: FloatArray, normal: FloatArray) -> tuple[Plain, Plain]:
    """Return where rays meet a print: 0 to 1 from its first corner to the right and downwards."""
    origin, x, y = corners[0], corners[1] - corners[0], corners[3] - corners[0]
    away = rays @ normal[:2].astype(np.float32) + np.float32(normal[2])
    scale = np.float32(normal @ origin) / away
    points = np.concatenate([rays, np.ones_like(rays[..., :1])], axis=-1) * scale[..., None]
    points -= origin.astype(np.float32)
    return points @ (x / (x @ x)).astype(np.float32), points @ (y / (y @ y)).astype(np.float32)


def printed(marker: Marker, dictionary: str) -> Plain:
    """Grey values of a printed marker with white round it; edges fall between texels."""
    cells = np.pad(marker_cells(dictionary, marker.id), PAD, constant_values=True)
    texels = np.kron(cells, np.ones((TEXELS, TEXELS)))
    return np.where(texels > 0.5, WHITE, BLACK).astype(np.float32)


def fine_rays(model: CameraModel) -> Plain:
    """Normalised coordinates of all samples, float32 (3 height, 3 width, 2).

    Undistorted on the pixels' centres and interpolated between: the map is smooth.
    """
    width, height = model.image_size
    v, u = np.mgrid[-1 : height + 1, -1 : width + 1]
    pixels = np.column_stack([u.ravel(), v.ravel()]).astype(np.float64)
    rays, found = model.undistort(pixels)
    rays[~found] = 1e3
    coarse = rays.reshape(height + 2, width + 2, 2).astype(np.float32)
    places = (np.arange(SUPERSAMPLING) - 0.5 * (SUPERSAMPLING - 1)) / SUPERSAMPLING
    x = (np.arange(width)[:, None] + places).ravel() + 1.0
    y = (np.arange(height)[:, None] + places).ravel() + 1.0
    grid = np.meshgrid(x.astype(np.float32), y.astype(np.float32))
    return np.asarray(cv2.remap(coarse, grid[0], grid[1], cv2.INTER_LINEAR))


_SHAFT = (60.0, 90.0, 130.0)
_TABLE = 118.0
_SURROUND = 1.3
_MARGIN = 0.012
"""White of the sheet round its markers [m]."""
_EDGE = 8
"""Pixels at a part's rim that its blur spoils."""

Grey = NDArray[np.uint8]


class PenRenderer:
    """Draws the sheet and the pen as one camera sees them; no noise, no time.

    The sheet is drawn once, the pen only where it is. Not for two threads at once.

    Args:
        model: the camera, with its pose in world.
        body: markers of cube or ring.
        base: markers of the sheet.
        T_world_base: pose of the sheet.
        face: edge of a face of the body [m].
        blur_px: standard deviation of the lens' blur.
        seed: of the table's mottling.
    """

    def __init__(
        self,
        model: CameraModel,
        body: MarkerBoard,
        base: MarkerBoard,
        T_world_base: RigidTransform,
        face: float,
        blur_px: float = 0.7,
        seed: int = 0,
    ) -> None:
        self.model = model
        self._body, self._face, self._blur = body, face, blur_px
        self._prints = {m.id: printed(m, body.dictionary) for m in body.markers}
        self._rays = fine_rays(model)
        self._background = self._table(seed)
        pose = model.T_camera_world @ T_world_base
        self._sheet(pose, base)
        for marker in base.markers:
            side = marker.side * _SURROUND
            self._draw(self._background, marker, pose, printed(marker, base.dictionary), side)
        self._empty = self._coarse(self._background)

    def render(self, scene: PenScene) -> Image:
        """Picture of a scene without noise, uint8 (height, width, 3), writable."""
        picture = self._empty.copy()
        if scene.T_world_body is not None:
            self._body_into(picture, scene.T_world_body, scene.p_tip)
        return np.repeat(picture[..., None], 3, axis=2)

    def _body_into(self, picture: Grey, T_world_body: RigidTransform, p_tip: FloatArray) -> None:
        """Draw the pen where it is and blur that part; the rest is as without it."""
        pose, end = self.model.T_camera_world @ T_world_body, self.model.T_camera_world @ p_tip
        points = pose @ np.concatenate([marker.corners for marker in self._body.markers])
        part = self._part(np.vstack([points, end]))
        if part is None:
            return
        fine = self._background
        rows, columns = (slice(p.start * SUPERSAMPLING, p.stop * SUPERSAMPLING) for p in part)
        kept = fine[rows, columns].copy()
        self._shaft(fine, pose.translation, end)
        for marker in self._body.markers:
            self._draw(fine, marker, pose, self._prints[marker.id], self._face)
        drawn = self._coarse(fine[rows, columns])
        self._restore(rows, columns, kept)
        inner = tuple(
            slice(_EDGE if p.start > 0 else 0, -_EDGE if p.stop < limit else None)
            for p, limit in zip(part, picture.shape, strict=True)
        )
        picture[part][inner] = drawn[inner]

    def _part(self, p_camera: FloatArray) -> tuple[slice, slice] | None:
        """Rows and columns of the picture that points and their surroundings take."""
        uv, ok = self.model.project_camera(p_camera)
        if not ok.all():
            return None
        width, height = self.model.image_size
        rim = _EDGE + 0.6 * self._face / float(p_camera[:, 2].min()) * self.model.intrinsics[0]
        low = np.clip(np.floor(uv.min(axis=0) - rim), 0, (width, height)).astype(int)
        high = np.clip(np.ceil(uv.max(axis=0) + rim), 0, (width, height)).astype(int)
        if (high - low < 2 * _EDGE + 2).any():
            return None
        return slice(low[1], high[1]), slice(low[0], high[0])

    def _restore(self, rows: slice, columns: slice, stored: Plain) -> None:
        self._background[rows, columns] = stored

    def _coarse(self, fine: Plain) -> Grey:
        """Bring samples to pixels and blur them."""
        size = (fine.shape[1] // SUPERSAMPLING, fine.shape[0] // SUPERSAMPLING)
        picture = cv2.resize(fine, size, interpolation=cv2.INTER_AREA)
        if self._blur > 0.0:
            picture = cv2.GaussianBlur(picture, (0, 0), self._blur)
        return np.clip(picture + 0.5, 0.0, 255.0).astype(np.uint8)

    def _table(self, seed: int) -> Plain:
        width, height = self.model.image_size
        rng = np.random.default_rng(seed)
        coarse = rng.normal(0.0, 6.0, (height // 16 + 2, width // 16 + 2)).astype(np.float32)
        size = (width * SUPERSAMPLING, height * SUPERSAMPLING)
        return np.asarray(_TABLE + cv2.resize(coarse, size, interpolation=cv2.INTER_CUBIC))

    def _sheet(self, pose: RigidTransform, base: MarkerBoard) -> None:
        """Draw the white of the sheet, shaded like its markers."""
        corners = np.concatenate([marker.corners for marker in base.markers])
        low, high = corners.min(axis=0) - _MARGIN, corners.max(axis=0) + _MARGIN
        (x0, y0), (x1, y1) = low[:2], high[:2]
        outline = np.array([(x0, y0, 0.0), (x1, y0, 0.0), (x1, y1, 0.0), (x0, y1, 0.0)])
        uv, ok = self.model.project_camera(pose @ outline)
        if ok.all():
            shade = WHITE * (0.55 + 0.45 * max(0.0, self._light(pose.rotation[:, 2])))
            fine = np.rint((uv + 0.5) * SUPERSAMPLING - 0.5).astype(np.int32)
            cv2.fillConvexPoly(self._background, fine, shade)

    def _draw(
        self, fine: Plain, marker: Marker, pose: RigidTransform, paper: Plain, side: float
    ) -> None:
        """Draw a printed face if the camera sees its front."""
        normal = pose.rotate(marker.normal)
        corners = pose @ (
            marker.corners.mean(axis=0)
            + (marker.corners - marker.corners.mean(axis=0)) * (side / marker.side)
        )
        if corners[:, 2].min() < 0.01 or normal @ corners.mean(axis=0) >= 0.0:
            return
        box = self._box(corners)
        if box is None:
            return
        rows, columns = box
        rays = self._rays[rows, columns]
        u, v = places(rays, pose @ marker.corners, normal)
        reach = 0.5 * (side / marker.side - 1.0)
        inside = (u >= -reach) & (u < 1.0 + reach) & (v >= -reach) & (v < 1.0 + reach)
        cells = paper.shape[0] // TEXELS - 2 * PAD
        x, y = ((place * cells + PAD) * TEXELS - 0.5 for place in (u, v))
        colour = cv2.remap(paper, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        light = 0.55 + 0.45 * max(0.0, self._light(normal))
        fine[rows, columns][inside] = (light * colour)[inside]

    def _light(self, normal: FloatArray) -> float:
        return float(LIGHT_WORLD[:3] @ self.model.T_world_camera.rotate(normal))

    def _box(self, corners: FloatArray) -> tuple[slice, slice] | None:
        uv, ok = self.model.project_camera(corners)
        if not ok.all():
            return None
        width, height = self.model.image_size
        low = np.clip(np.floor(uv.min(axis=0)) - 2, 0, (width, height)).astype(int)
        high = np.clip(np.ceil(uv.max(axis=0)) + 3, 0, (width, height)).astype(int)
        if (high <= low).any():
            return None
        low, high = low * SUPERSAMPLING, high * SUPERSAMPLING
        return slice(low[1], high[1]), slice(low[0], high[0])

    def _shaft(self, fine: Plain, start: FloatArray, end: FloatArray) -> None:
        uv, ok = self.model.project_camera(np.array([start, end]))
        if not ok.all():
            return
        ends = np.rint((uv + 0.5) * SUPERSAMPLING - 0.5).astype(int)
        thick = 0.004 * self.model.intrinsics[0] / max(start[2], 0.05) * SUPERSAMPLING
        a, b = (tuple(int(np.clip(c, -20000, 20000)) for c in end_) for end_ in ends)
        cv2.line(fine, a, b, _SHAFT[1], max(1, round(thick)))
