"""Things that spoil a marker's picture, with known truth: effects as in `picture_effects`.

A finger before the band, a highlight on it, red cloth and an orange thing in view. Edges are as
sharp as the lens makes them.
"""

from dataclasses import dataclass

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.tracking.cameras.camera import Image

SKIN = (140.0, 160.0, 205.0)
RED_CLOTH = (38.0, 30.0, 190.0)
ORANGE = (20.0, 125.0, 240.0)

_SOFT_PX = 0.7


@dataclass(frozen=True, slots=True, eq=False)
class Finger:
    """A fingertip: a disc and what lies behind it, away from the band.

    Attributes:
        uv: its tip [px], shape (2,).
        direction: from the hand to the tip, unit vector in the picture, shape (2,).
        radius: half width [px].
        colour: blue, green, red.
    """

    uv: FloatArray
    direction: FloatArray
    radius: float
    colour: tuple[float, float, float] = SKIN


@dataclass(frozen=True, slots=True, eq=False)
class Highlight:
    """A lamp's reflection.

    Attributes:
        uv: its middle [px], shape (2,).
        sd_px: standard deviation of its spread.
        strength: grey levels added in the middle.
    """

    uv: FloatArray
    sd_px: float
    strength: float


@dataclass(frozen=True, slots=True, eq=False)
class Patch:
    """A coloured thing: an ellipse, brighter on one side.

    Attributes:
        uv: its middle [px], shape (2,).
        half: half axes [px], shape (2,).
        angle_deg: of the first axis in the picture.
        colour: blue, green, red.
    """

    uv: FloatArray
    half: FloatArray
    angle_deg: float = 0.0
    colour: tuple[float, float, float] = RED_CLOTH


def finger(image: Image, parameters: Finger, rng: np.random.Generator) -> Image:
    """Cover with a fingertip."""
    cover = np.zeros(image.shape[:2], np.uint8)
    tip = parameters.uv - parameters.radius * parameters.direction
    back = tip - 400.0 * parameters.direction
    cv2.line(cover, _point(tip), _point(back), 255, round(2.0 * parameters.radius), cv2.LINE_AA)
    return _painted(image, cover, parameters.colour)


def highlight(image: Image, parameters: Highlight, rng: np.random.Generator) -> Image:
    """Add a highlight; saturates at 255."""
    height, width = image.shape[:2]
    spread = -0.5 / parameters.sd_px**2
    u = np.exp(spread * (np.arange(width) - parameters.uv[0]) ** 2)
    v = np.exp(spread * (np.arange(height) - parameters.uv[1]) ** 2)
    glow = parameters.strength * np.outer(v, u)
    return np.asarray(np.clip(image + glow[..., None] + 0.5, 0, 255), dtype=np.uint8)


def patch(image: Image, parameters: Patch, rng: np.random.Generator) -> Image:
    """Put a coloured thing into the picture."""
    cover = np.zeros(image.shape[:2], np.uint8)
    axes = (max(1, round(parameters.half[0])), max(1, round(parameters.half[1])))
    centre = (round(float(parameters.uv[0])), round(float(parameters.uv[1])))
    cv2.ellipse(cover, centre, axes, parameters.angle_deg, 0.0, 360.0, 255, -1, cv2.LINE_AA)
    return _painted(image, cover, parameters.colour)


def _point(uv: FloatArray) -> tuple[int, int]:
    return round(float(uv[0])), round(float(uv[1]))


def _painted(image: Image, cover: Image, colour: tuple[float, float, float]) -> Image:
    share = cv2.GaussianBlur(cover.astype(np.float32) / 255.0, (0, 0), _SOFT_PX)[..., None]
    shade = np.linspace(1.05, 0.85, image.shape[1], dtype=np.float32)[None, :, None]
    mixed = image + share * (np.array(colour, np.float32) * shade - image)
    return np.asarray(np.clip(mixed + 0.5, 0, 255), dtype=np.uint8)
