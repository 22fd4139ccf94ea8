"""What the simulated cameras see behind the needle: the housing, traced once per camera.

The surroundings are axis-aligned boxes, traced into the picture (compiled): every pixel is the mean
over rays spread as the lens spreads a point. Half a second of work per camera, done once per rig
and kept on disk.
"""

import hashlib
import io
import logging
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from app.core import paths
from app.core.arrays import FloatArray, unit
from app.core.compiled import njit
from app.core.files import write_atomically
from app.tracking.optics.camera_model import CameraModel
from app.tracking.simulated.delivery import WHITE, from_srgb, light_of, srgb

FINE = 55
COARSE = 13
"""Rays of a pixel at the band and elsewhere; Fibonacci numbers."""

_STEPS = {13: 8, 34: 21, 55: 34, 89: 55, 610: 377}
"""Fibonacci numbers and those before them: lattices without gaps."""


def sample_pattern(blur_px: float, samples: int = FINE) -> FloatArray:
    """Offsets of the rays of one pixel [px], shape (samples, 2), of mean 0 and SD `blur_px`.

    Points of a Fibonacci lattice, of which no two share a row or a column, through the inverse of
    the Gaussian. `samples` is one of 13, 34, 55, 89, 610.
    """
    i = np.arange(samples)
    levels = ndtri((i + 0.5) / samples)
    pattern = np.column_stack([levels, levels[(i * _STEPS[samples] + samples // 3) % samples]])
    scaled: FloatArray = blur_px * pattern / pattern.std(axis=0)
    return scaled


@njit
def _box_hit(o: Any, d: Any, box: Any) -> Any:
    """Ray against an axis-aligned box (slab test): (distance, axis of the face), or (inf, 0)."""
    near, far, axis = -np.inf, np.inf, 0
    for k in range(3):
        inverse = 1.0 / (d[k] if abs(d[k]) > 1e-12 else 1e-12)
        first, second = (box[k] - o[k]) * inverse, (box[k + 3] - o[k]) * inverse
        if first > second:
            first, second = second, first
        if first > near:
            near, axis = first, k
        far = min(far, second)
    return (near, axis) if 0.0 < near <= far else (np.inf, 0)


@njit
def trace_boxes(
    image: Any, rays: Any, pattern: Any, rotation: Any, o: Any, boxes: Any, colours: Any, light: Any
) -> None:
    """Paint axis-aligned boxes of the world into a float picture (H, W, 3), in place.

    `rotation` and `o` are the camera's pose; `boxes` (n, 6) low and high corners [m]; `light` and
    the shading as in `draw_needle`, but in world. Between boxes the picture stays as it was.
    """
    d, one = np.empty(3), np.empty(3)
    n = pattern.shape[0]
    for v in range(image.shape[0]):
        for u in range(image.shape[1]):
            one[:] = 0.0
            x, y = rays[v + 1, u + 1, 0], rays[v + 1, u + 1, 1]
            xu = rays[v + 1, u + 2, 0] - x
            yv = rays[v + 2, u + 1, 1] - y
            for i in range(n):
                dx, dy = x + pattern[i, 0] * xu, y + pattern[i, 1] * yv
                for k in range(3):
                    d[k] = rotation[k, 0] * dx + rotation[k, 1] * dy + rotation[k, 2]
                best, which, face = np.inf, -1, 0
                for b in range(boxes.shape[0]):
                    t, axis = _box_hit(o, d, boxes[b])
                    if t < best:
                        best, which, face = t, b, axis
                if which < 0:
                    for k in range(3):
                        one[k] += image[v, u, k]
                    continue
                facing = -light[face] if d[face] > 0.0 else light[face]
                haze = 1.0 / (1.0 + (best / 1.2) ** 2)  # less light further back
                glow = (light[3] + light[4] * max(0.0, facing)) * (0.35 + 0.65 * haze)
                for k in range(3):
                    one[k] += colours[which, k] * glow
            for k in range(3):
                image[v, u, k] = one[k] / n


Traced = NDArray[np.float32]

_KEPT: Final = 12

_log = logging.getLogger(__name__)


def kept_or_traced(
    parts: tuple[bytes, ...], shape: tuple[int, ...], trace: Callable[[], Traced]
) -> Traced:
    """Return what `trace` returned for the same parts before, from the user's cache, or trace now.

    Args:
        parts: everything the picture depends on, besides the code that traces it.
        shape: what the picture must have; a file that is damaged is traced again.
        trace: makes the picture.
    """
    folder = paths.cache() / "backgrounds"
    path = folder / f"{_digest(parts)}.npy"
    kept = _read(path, shape)
    if kept is not None:
        return kept
    traced = trace()
    _keep(path, traced)
    return traced


def _digest(parts: tuple[bytes, ...]) -> str:
    digest = hashlib.sha256()
    for part in (Path(__file__).read_bytes(), *parts):
        digest.update(len(part).to_bytes(8, "little") + part)
    return digest.hexdigest()[:24]


def _read(path: Path, shape: tuple[int, ...]) -> Traced | None:
    try:
        picture = np.load(path, allow_pickle=False)
    except FileNotFoundError:
        return None
    except (OSError, ValueError, EOFError) as error:
        _log.warning("background %s cannot be read and is traced again: %s", path, error)
        return None
    fits = picture.shape == shape and picture.dtype == np.float32 and np.isfinite(picture).all()
    return picture if fits else None


def _keep(path: Path, picture: Traced) -> None:
    buffer = io.BytesIO()
    np.save(buffer, picture, allow_pickle=False)
    try:
        write_atomically(path, buffer.getvalue())
        files = sorted(path.parent.glob("*.npy"), key=lambda file: file.stat().st_mtime)
        for old in files[:-_KEPT]:
            old.unlink(missing_ok=True)
    except OSError as error:  # a read-only home: traced at every start
        _log.info("background %s is not kept: %s", path, error)


@dataclass(frozen=True, slots=True)
class HousingBox:
    """An axis-aligned block in world: two corners [m] and its colour (blue, green, red)."""

    low: tuple[float, float, float]
    high: tuple[float, float, float]
    colour: tuple[float, float, float]


_SKIN = (168.0, 186.0, 214.0)
_PLASTIC = (150.0, 146.0, 140.0)
_DARK = (74.0, 70.0, 66.0)
_PLATE = (128.0, 126.0, 122.0)

HOUSING = (
    HousingBox((-0.60, -0.30, -0.115), (0.60, 0.34, -0.105), _PLATE),  # ground plate
    HousingBox(
        (-0.125, -0.02, 0.086), (0.125, 0.118, 0.094), _SKIN
    ),  # fake skin, cut free round the needle
    HousingBox((-0.128, -0.022, 0.078), (0.128, 0.120, 0.086), _PLASTIC),  # its frame
    HousingBox((-0.128, 0.00, -0.105), (-0.112, 0.03, 0.078), _PLASTIC),  # posts
    HousingBox((0.112, 0.00, -0.105), (0.128, 0.03, 0.078), _PLASTIC),
    HousingBox((-0.062, -0.02, -0.105), (-0.023, 0.02, -0.010), _DARK),  # motors
    HousingBox((0.023, -0.02, -0.105), (0.062, 0.02, -0.010), _DARK),
    HousingBox((-0.082, -0.04, -0.010), (-0.003, 0.04, 0.004), _PLASTIC),  # capstan drums
    HousingBox((0.003, -0.04, -0.010), (0.082, 0.04, 0.004), _PLASTIC),
    HousingBox((-0.70, -0.36, -0.40), (0.70, -0.34, 0.60), (176.0, 178.0, 180.0)),  # wall behind
)

LIGHT_WORLD: FloatArray = np.array([*unit([0.35, 0.75, 0.85]), 0.45, 0.50])
"""Towards the lamp (above and behind the cameras), ambient and diffuse share."""


def paint_background(
    model: CameraModel,
    rays: FloatArray,
    blur_px: float,
    seed: int,
    boxes: tuple[HousingBox, ...] = HOUSING,
    light: bool = False,
) -> NDArray[Any]:
    """Picture of the housing, or of other `boxes`, with nothing before it: uint8 (H, W, 3).

    With `light` it is the light of the same things, uint16: sRGB makes their colours of it.
    """
    width, height = model.image_size
    if light:
        boxes = tuple(replace(box, colour=_triple(light_of(box.colour))) for box in boxes)
    pattern = sample_pattern(blur_px, COARSE)
    pose = model.T_world_camera
    known = rays, pattern, pose.rotation, pose.translation
    parts = tuple(array.tobytes() for array in known)
    if boxes != HOUSING:
        parts = (*parts, repr(boxes).encode())
    traced = kept_or_traced(
        parts, (height, width, 3), lambda: _traced(model, rays, pattern, boxes).astype(np.float32)
    )
    mottling = _mottling(width, height, seed)[..., None]
    if light:
        uneven = from_srgb(np.clip(srgb(traced / 255.0) + mottling / 255.0, 0.0, 1.0))
        return np.rint(WHITE * uneven).astype(np.uint16)
    return np.clip(traced + mottling + 0.5, 0.0, 255.0).astype(np.uint8)


def _triple(colour: FloatArray) -> tuple[float, float, float]:
    blue, green, red = colour.tolist()
    return blue, green, red


def _traced(
    model: CameraModel, rays: FloatArray, pattern: FloatArray, boxes: tuple[HousingBox, ...]
) -> FloatArray:
    """Boxes in their light, before the unevenness that differs from run to run."""
    width, height = model.image_size
    image = np.full((height, width, 3), 96.0)
    trace_boxes(
        image,
        rays,
        pattern,
        np.ascontiguousarray(model.T_world_camera.rotation),
        np.ascontiguousarray(model.centre),
        np.array([(*box.low, *box.high) for box in boxes]),
        np.array([box.colour for box in boxes]),
        LIGHT_WORLD,
    )
    return image * _vignette(width, height)[..., None]


def _vignette(width: int, height: int) -> FloatArray:
    """Fall-off of light towards the corners, one in the middle."""
    y, x = np.mgrid[:height, :width]
    r2 = ((x - width / 2) ** 2 + (y - height / 2) ** 2) / (width / 2) ** 2
    return np.asarray(1.0 - 0.10 * r2)


def _mottling(width: int, height: int, seed: int) -> FloatArray:
    """Slow unevenness of surfaces, a few grey levels."""
    coarse = np.random.default_rng(seed).normal(0.0, 1.0, (height // 24, width // 24))
    fine = cv2.resize(coarse.astype(np.float32), (width, height), interpolation=cv2.INTER_CUBIC)
    return np.asarray(fine, dtype=np.float64)
