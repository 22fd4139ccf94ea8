"""The marker's colour: what counts as it, and how it is learned from a click.

A paint under more or less of the same light keeps the direction of its colour (blue, green, red as
a vector), whatever the exposure; grey things lie on the diagonal. So a pixel's *strength* is its
colour times weights that add up to zero (grey gives zero), and a patch has the marker's colour if
the angle of its mean colour to the learned one is small. The threshold of the strength follows the
strongest in view, so that less light needs no other setting.
"""

import math
from functools import cached_property

import numpy as np
from pydantic import Field

from app.core.arrays import FloatArray, read_only, unit
from app.core.configuration import Strict
from app.core.messages import sentence
from app.tracking.cameras.camera import Image
from app.tracking.errors import TrackingError

_CLICK = 2
_WINDOW = 24
_LEAST_STRENGTH = 25.0


class ColourModel(Strict):
    """The marker's colour as settings keep it.

    Attributes:
        bgr: its colour [grey levels]; only the direction counts.
        angle_deg: largest angle of a patch's mean colour to it.
        strength: least strength of a pixel [grey levels].
        share: of the strongest pixel nearby that a pixel must have.
    """

    bgr: tuple[float, float, float] = (44.0, 26.0, 205.0)
    angle_deg: float = Field(default=18.0, gt=0.0, le=45.0)
    strength: float = Field(default=_LEAST_STRENGTH, ge=5.0, le=200.0)
    share: float = Field(default=0.35, gt=0.0, lt=1.0)

    @cached_property
    def weights(self) -> FloatArray:
        """Of blue, green and red in the strength, shape (3,): they add up to 0, the largest is 1.

        Raises:
            TrackingError: if the colour is grey.
        """
        colour = np.array(self.bgr)
        free = colour - colour.mean()
        if not free.max() > 0.05 * max(colour.max(), 1.0):
            raise TrackingError(
                sentence(
                    "the marker's colour {bgr} (blue, green, red) is grey; a marker needs a "
                    "colour that nothing else has: click on its middle, not on the shaft",
                    bgr=self.bgr,
                )
            )
        return read_only(free / free.max())

    def angle(self, bgr: FloatArray) -> float:
        """Angle of a colour to the marker's [deg]; 90 for black."""
        colour = bgr.tolist()
        length = math.hypot(*colour)
        if length < 1.0:
            return 90.0
        cosine = sum(a * b for a, b in zip(self._direction, colour, strict=True)) / length
        return math.degrees(math.acos(min(1.0, cosine)))

    @cached_property
    def _direction(self) -> tuple[float, float, float]:
        blue, green, red = unit(np.array(self.bgr)).tolist()
        return blue, green, red

    def is_marker(self, bgr: FloatArray) -> bool:
        """Return whether a patch of this mean colour may be the marker."""
        return self.angle(bgr) <= self.angle_deg

    def threshold(self, strongest: float) -> float:
        """Least strength of a pixel where the strongest nearby is `strongest` [grey levels]."""
        return max(self.strength, self.share * strongest)


RED = ColourModel()
"""A matt red, as the shipped rigs have it."""


def learn(image: Image, uv: FloatArray) -> ColourModel:
    """Learn the colour from a click on the marker.

    The colour is the mean of what is like the clicked spot; the angle is half the way to the
    nearest colour of the surroundings that is strong enough to be taken for it, 8° to 25°.

    Args:
        image: the picture.
        uv: the click [px], shape (2,).

    Raises:
        TrackingError: if the click is outside the picture, on grey, or on something overexposed.
    """
    height, width = image.shape[:2]
    u, v = np.rint(np.asarray(uv, dtype=np.float64)).astype(int)
    if not (_CLICK <= u < width - _CLICK and _CLICK <= v < height - _CLICK):
        raise TrackingError(
            sentence(
                "the click at ({u}, {v}) is outside the picture of {width}x{height}",
                u=u,
                v=v,
                width=width,
                height=height,
            )
        )
    spot = image[v - _CLICK : v + _CLICK + 1, u - _CLICK : u + _CLICK + 1].reshape(-1, 3)
    if (spot >= 254).any(axis=1).mean() > 0.25:
        raise TrackingError(
            sentence("the marker is overexposed where you clicked; lower exposure or light")
        )
    window = image[max(0, v - _WINDOW) : v + _WINDOW + 1, max(0, u - _WINDOW) : u + _WINDOW + 1]
    colours = window.reshape(-1, 3).astype(np.float64)
    clicked = ColourModel(bgr=_triple(np.median(spot, axis=0)))
    strength = colours @ clicked.weights
    strongest = float(np.median(spot.astype(np.float64) @ clicked.weights))
    if strongest < _LEAST_STRENGTH:
        raise TrackingError(
            sentence(
                "the colour at ({u}, {v}) is nearly grey (strength {strongest:.0f}, at least "
                "{least_strength:.0f} is needed): click on the middle of the marker",
                u=u,
                v=v,
                strongest=strongest,
                least_strength=_LEAST_STRENGTH,
            )
        )
    angles = _angles(colours, np.array(clicked.bgr))
    strong = strength > 0.5 * strongest
    same = strong & (angles < 12.0)
    mean = colours[same].mean(axis=0)
    others = _angles(colours[strong & ~same], mean)
    limit = 0.5 * float(np.percentile(others, 5)) if others.size > 20 else 18.0
    return ColourModel(
        bgr=_triple(mean),
        angle_deg=float(np.clip(limit, 8.0, 25.0)),
        strength=float(np.clip(0.15 * strongest, 10.0, _LEAST_STRENGTH)),
    )


def _angles(colours: FloatArray, colour: FloatArray) -> FloatArray:
    lengths = np.maximum(np.linalg.norm(colours, axis=1), 1.0)
    cosine = colours @ unit(colour) / lengths
    return np.asarray(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))


def _triple(colour: FloatArray) -> tuple[float, float, float]:
    blue, green, red = (round(float(value), 1) for value in colour)
    return blue, green, red
