"""From light to a delivered picture: photons, tone curve, 8 bits, JPEG (effects of a scene).

Light is uint16, 65535 where a pixel is white; a delivered picture is uint8. Effects of the light
(`picture_effects`: blur, lamps) come before, for they act on light.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.messages import sentence
from app.tracking.errors import TrackingError

WHITE: Final = 65535
"""Light of a white pixel."""

_SPARE: Final = 64
"""By how many pixels the noise tile exceeds the picture: 64 × 64 places to cut it out."""


def srgb(light: ArrayLike) -> FloatArray:
    """Return grey values, 0 to 1, of linear light, 0 to 1: IEC 61966-2-1."""
    x = np.asarray(light, dtype=np.float64)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.maximum(x, 0.0) ** (1.0 / 2.4) - 0.055)


def from_srgb(grey: ArrayLike) -> FloatArray:
    """Return linear light, 0 to 1, of grey values, 0 to 1: the inverse of `srgb`."""
    x = np.asarray(grey, dtype=np.float64)
    return np.where(x <= 0.04045, x / 12.92, ((np.maximum(x, 0.0) + 0.055) / 1.055) ** 2.4)


def light_of(grey: ArrayLike) -> FloatArray:
    """Return light on the scale of grey values, 0 to 255, that sRGB makes these grey values of."""
    return 255.0 * from_srgb(np.asarray(grey, dtype=np.float64) / 255.0)


@dataclass(eq=False)
class Tone:
    """Sensor and tone curve of a camera (`camera_tone`).

    Attributes:
        curve: grey value of every light, uint8 (65536,).
        spread: standard deviation of its noise, in light, float32 (65536,).
    """

    curve: NDArray[np.uint8]
    spread: NDArray[np.float32]
    _tile: NDArray[np.float32] | None = None

    @classmethod
    def of(cls, values: FloatArray) -> Tone:
        """Read number of the model (0 srgb, 1 linear), full well and read noise [electrons]."""
        model, full_well, read_noise = values.tolist()
        light = np.linspace(0.0, 1.0, WHITE + 1)
        grey = srgb(light) if model == 0.0 else light
        variance = (light * full_well + read_noise**2) / full_well**2
        return cls(
            np.rint(255.0 * grey).astype(np.uint8), (WHITE * np.sqrt(variance)).astype(np.float32)
        )

    def tile(self, size: tuple[int, int], rng: np.random.Generator) -> NDArray[np.float32]:
        """Return standard normal numbers for pictures of (height, width), drawn once."""
        shape = (size[0] + _SPARE, size[1] + _SPARE, 3)
        if self._tile is None or self._tile.shape != shape:
            self._tile = rng.standard_normal(shape, np.float32)
        return self._tile


def develop(light: NDArray[Any], parameters: Tone, rng: np.random.Generator) -> NDArray[np.uint8]:
    """Count the photons of a picture and apply the tone curve: light, uint16, to uint8.

    Raises:
        TrackingError: if the picture is not light.
    """
    if light.dtype != np.uint16:
        raise TrackingError(
            sentence(
                "a tone curve needs linear light (uint16), got a picture of {light_dtype}; build "
                "the renderer with light=True",
                light_dtype=light.dtype,
            )
        )
    tile = parameters.tile(light.shape[:2], rng)
    row, column = rng.integers(0, _SPARE, 2)
    out = np.empty(light.shape, np.uint8)
    _develop(light, tile, row, column, parameters.spread, parameters.curve, out)
    return out


@njit
def _develop(
    light: Any, tile: Any, row: int, column: int, spread: Any, curve: Any, out: Any
) -> None:
    """Write the grey value of every light with the noise of its photons into `out`."""
    for v in range(light.shape[0]):
        for u in range(light.shape[1]):
            for k in range(3):
                mean = light[v, u, k]
                noisy = mean + spread[mean] * tile[row + v, column + u, k]
                out[v, u, k] = curve[int(min(max(noisy + 0.5, 0.0), 65535.0))]


_CHROMA: Final = (
    cv2.IMWRITE_JPEG_SAMPLING_FACTOR_420,
    cv2.IMWRITE_JPEG_SAMPLING_FACTOR_422,
    cv2.IMWRITE_JPEG_SAMPLING_FACTOR_444,
)
"""In the order of the models of `camera_jpeg`."""


@dataclass(frozen=True, slots=True)
class Jpeg:
    """How pictures are coded (`camera_jpeg`): quality 0 to 100, OpenCV's number of the sampling."""

    quality: int
    chroma: int

    @classmethod
    def of(cls, values: FloatArray) -> Jpeg:
        """Read number of the model (0 4:2:0, 1 4:2:2, 2 4:4:4) and quality."""
        model, quality = values.tolist()
        return cls(round(quality), int(_CHROMA[int(model)]))


def compress(
    image: NDArray[np.uint8], parameters: Jpeg, rng: np.random.Generator
) -> NDArray[np.uint8]:
    """Code a picture as JPEG and decode it again.

    Raises:
        TrackingError: if the codec refuses it.
    """
    options = [
        *(cv2.IMWRITE_JPEG_QUALITY, parameters.quality),
        *(cv2.IMWRITE_JPEG_SAMPLING_FACTOR, parameters.chroma),
    ]
    coded, data = cv2.imencode(".jpg", image, options)
    if not coded:
        raise TrackingError(
            sentence(
                "OpenCV cannot code a picture of {image_shape} as JPEG", image_shape=image.shape
            )
        )
    return np.asarray(cv2.imdecode(data, cv2.IMREAD_COLOR), dtype=np.uint8)
