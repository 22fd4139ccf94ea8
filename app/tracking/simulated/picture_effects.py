"""Effects on simulated pictures: `(image, parameters, rng) -> image`, applied in order.

A picture is uint8, or uint16 while it is light (`delivery`). An effect may change the image in
place and hands back the one to go on with. Randomness comes from the generator it is given and from
tiles made beforehand, so that a run repeats itself.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import sqrt
from typing import Any, Final

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.tracking.cameras.camera import Image
from app.tracking.errors import TrackingError
from app.tracking.simulated.delivery import Jpeg, Tone, compress, develop

PictureEffect = Callable[[Any, Any, np.random.Generator], Any]
"""Signature of an effect on a picture."""

_SPARE = 64
"""By how many pixels the noise tile exceeds the picture: 64 × 64 places to cut it out."""


@dataclass(frozen=True, eq=False)
class NoiseTile:
    """Gaussian noise made beforehand, int16 (height + spare, width + spare, 3)."""

    values: NDArray[np.int16]

    @classmethod
    def make(cls, size: tuple[int, int], sd_grey: float, seed: int) -> "NoiseTile":
        """Tile for pictures of `size` (width, height) with standard deviation `sd_grey`."""
        rng = np.random.default_rng(seed)
        shape = (size[1] + _SPARE, size[0] + _SPARE, 3)
        return cls(np.rint(rng.normal(0.0, sd_grey, shape)).astype(np.int16))


def noise(image: Image, parameters: NoiseTile, rng: np.random.Generator) -> Image:
    """Add sensor noise, saturating at 0 and 255."""
    row, column = rng.integers(0, _SPARE, 2)
    height, width = image.shape[:2]
    tile = parameters.values[row : row + height, column : column + width]
    return np.asarray(cv2.add(image, tile, dtype=cv2.CV_8U))


def blur(image: NDArray[Any], parameters: float, rng: np.random.Generator) -> NDArray[Any]:
    """Blur further by a Gaussian of standard deviation `parameters` [px] (out of focus)."""
    return np.asarray(cv2.GaussianBlur(image, (0, 0), parameters)) if parameters > 0.0 else image


def lighting(image: NDArray[Any], parameters: float, rng: np.random.Generator) -> NDArray[Any]:
    """Scale the brightness by `parameters` (dimmer below 1), saturating at white."""
    return np.asarray(cv2.addWeighted(image, parameters, image, 0.0, 0.0))


# --- effects of a scene: declared in `simulation.effects`, found here by their names --------------
@dataclass(eq=False)
class Losses:
    """Which pictures of one camera are lost (`camera_dropout`).

    Attributes:
        share: of the pictures, in the long run.
        burst: pictures in a row, on average; None: each is lost by itself.
        lost: whether the last one was.
    """

    share: float
    burst: float | None
    lost: bool = False

    @classmethod
    def of(cls, values: FloatArray) -> "Losses":
        """Read number of the model (0 bursts, 1 single), share, burst."""
        model, share, burst = values.tolist()
        return cls(share, burst if model == 0.0 else None)

    def next(self, draw: float) -> bool:
        """Return whether the next picture is lost, by a number drawn from 0 to 1."""
        leaves = 1.0 / self.burst if self.burst is not None else 1.0
        if self.burst is None:
            self.lost = draw < self.share
        elif self.lost:
            self.lost = draw >= leaves
        else:
            self.lost = draw < leaves * self.share / (1.0 - self.share)
        return self.lost


def drop(image: NDArray[Any], parameters: Losses, rng: np.random.Generator) -> NDArray[Any]:
    """Hand on the picture, or a black one in its place."""
    return np.zeros_like(image) if parameters.next(rng.random()) else image


@dataclass(frozen=True, eq=False)
class Blur:
    """Defocus [px] as a Gaussian or over a square, and the kernel of a motion (`camera_blur`)."""

    defocus: float
    square: int
    motion: FloatArray | None

    @classmethod
    def of(cls, values: FloatArray) -> "Blur":
        """Read number of the model (0 gaussian, 1 box), defocus, motion, direction."""
        model, defocus, motion, direction = values.tolist()
        square = 2 * round(0.5 * (sqrt(12.0 * defocus * defocus + 1.0) - 1.0)) + 1
        kernel = line_kernel(motion, direction) if motion > 0.0 else None
        return cls(defocus if model == 0.0 else 0.0, square if model == 1.0 else 1, kernel)

    @property
    def spread(self) -> float:
        """Standard deviation of the point spread [px], along the motion if there is one."""
        square = self.defocus**2 + (self.square**2 - 1) / 12.0
        if self.motion is not None:
            reach = self.motion.shape[0] // 2
            y, x = np.mgrid[-reach : reach + 1, -reach : reach + 1]
            square += float((self.motion * (x * x + y * y)).sum())
        return sqrt(square)


def line_kernel(length: float, direction: float) -> FloatArray:
    """Weights of a line through the middle [px, rad], sum 1, shape (n, n), n odd."""
    reach = int(0.5 * length) + 1
    along = np.linspace(-0.5 * length, 0.5 * length, 16 * (reach + 1) + 1)
    kernel = np.zeros((2 * reach + 1, 2 * reach + 1))
    x, y = reach + along * np.cos(direction), reach + along * np.sin(direction)
    left, top = np.minimum(x.astype(int), 2 * reach - 1), np.minimum(y.astype(int), 2 * reach - 1)
    u, v = x - left, y - top
    for down, right, weight in (
        (0, 0, (1.0 - v) * (1.0 - u)),
        (0, 1, (1.0 - v) * u),
        (1, 0, v * (1.0 - u)),
        (1, 1, v * u),
    ):
        np.add.at(kernel, (top + down, left + right), weight)
    return np.asarray(kernel / kernel.sum())


def unfocus(image: NDArray[Any], parameters: Blur, rng: np.random.Generator) -> NDArray[Any]:
    """Blur a picture by defocus and motion."""
    image = blur(image, parameters.defocus, rng)
    if parameters.square > 1:
        image = np.asarray(cv2.blur(image, (parameters.square, parameters.square)))
    if parameters.motion is not None:
        image = np.asarray(cv2.filter2D(image, -1, parameters.motion))
    return image


@dataclass(eq=False)
class Light:
    """Brightness over that of the rig, from left to right, and from picture to picture."""

    level: float
    gradient: float
    flicker: float
    _gains: NDArray[np.float32] | None = None

    @classmethod
    def of(cls, values: FloatArray) -> "Light":
        """Read number of the model (0 flicker, 1 gradient), level, gradient, flicker."""
        model, level, gradient, flicker = values.tolist()
        return cls(level, gradient, flicker if model == 0.0 else 0.0)

    def gains(self, shape: tuple[int, ...]) -> NDArray[np.float32]:
        """Share of the brightness of every value of a picture of this shape."""
        if self._gains is None or self._gains.shape != shape:
            across = np.linspace(-1.0, 1.0, shape[1], dtype=np.float32)[None, :, None]
            self._gains = np.ascontiguousarray(
                np.broadcast_to(1.0 + np.float32(self.gradient) * across, shape)
            )
        return self._gains


def illuminate(image: NDArray[Any], parameters: Light, rng: np.random.Generator) -> NDArray[Any]:
    """Scale the brightness, saturating at white."""
    level = parameters.level
    if parameters.flicker > 0.0:
        level *= 1.0 + parameters.flicker * float(np.clip(rng.standard_normal(), -2.0, 2.0))
    if parameters.gradient == 0.0:
        return lighting(image, level, rng)
    gains = parameters.gains(image.shape)
    depth = cv2.CV_16U if image.dtype == np.uint16 else cv2.CV_8U
    return np.asarray(cv2.multiply(image, gains, scale=level, dtype=depth))


_BY_NAME: Final[dict[str, tuple[PictureEffect, Callable[[FloatArray], Any]]]] = {
    "camera_dropout": (drop, Losses.of),
    "camera_blur": (unfocus, Blur.of),
    "camera_light": (illuminate, Light.of),
    "camera_tone": (develop, Tone.of),
    "camera_jpeg": (compress, Jpeg.of),
}
_LAST: Final = ("camera_tone", "camera_jpeg")
"""What acts on the finished light and on the finished picture, in this order."""

Chain = Sequence[tuple[PictureEffect, Any]]
"""Effects with their parameters, in the order in which they act."""


def picture_effects(asked: Mapping[str, FloatArray]) -> tuple[tuple[PictureEffect, Any], ...]:
    """Return what acts on a picture, with fresh memory, as `in_order` has it.

    Args:
        asked: name -> number of its model, then its parameters as they are declared
            (`simulation.plan.SimulationPlan.pictures`).

    Raises:
        TrackingError: for a name that nothing here makes; names those that are known.
    """
    return tuple((_BY_NAME[n][0], _BY_NAME[n][1](asked[n])) for n in in_order(asked))


def in_order(asked: Iterable[str]) -> list[str]:
    """Return names of effects as they act: as asked for, but tone curve and JPEG at the end.

    Raises:
        TrackingError: for a name that nothing here makes; names those that are known.
    """
    names = list(asked)
    if unknown := sorted(set(names) - set(_BY_NAME)):
        raise TrackingError(
            sentence(
                "no effect on pictures is called {effect_name!r}; there are {by_name}",
                effect_name=unknown[0],
                by_name=", ".join(_BY_NAME),
            )
        )
    return [n for n in names if n not in _LAST] + [n for n in _LAST if n in names]


def with_noise(
    chain: Chain, size: tuple[int, int], sd_grey: float, seed: int
) -> tuple[tuple[PictureEffect, Any], ...]:
    """Return a chain with constant noise before JPEG; unchanged where photons are counted.

    Args:
        chain: as `picture_effects` returns it.
        size: width and height of the pictures [px].
        sd_grey: standard deviation of the noise [grey values]; 0 for none.
        seed: of the noise.
    """
    if draws_light(chain) or sd_grey <= 0.0:
        return tuple(chain)
    coded = [one for one in chain if isinstance(one[1], Jpeg)]
    before = [one for one in chain if not isinstance(one[1], Jpeg)]
    return (*before, (noise, NoiseTile.make(size, sd_grey, seed)), *coded)


def draws_light(chain: Chain) -> bool:
    """Return whether the first of these wants light, for one of them is a tone curve."""
    return any(isinstance(parameters, Tone) for _, parameters in chain)
