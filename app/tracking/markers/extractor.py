"""What an extractor finds in a picture, why it finds nothing, and what it has to be."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, frozen
from app.tracking.cameras.camera import Image
from app.tracking.markers.colour import RED, ColourModel
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleShape

Mask = NDArray[np.uint8]
"""One where a pixel counts as the marker's colour, zero elsewhere, shape (height, width)."""


class Centre(StrEnum):
    """Which point of the band a pixel is."""

    OUTLINE = "outline"  # centroid of its visible outline; `silhouette` says how far that is off
    BAND = "band"  # picture of the band's centre itself


class MissReason(StrEnum):
    """Why a picture, or a place in it, gives no marker."""

    NOTHING_RED = "nothing_red"
    TOO_SMALL = "too_small"
    TOO_LARGE = "too_large"
    WRONG_SHAPE = "wrong_shape"
    SATURATED = "saturated"
    AT_BORDER = "at_border"
    PARTLY_HIDDEN = "partly_hidden"
    NO_SHAFT = "no_shaft"
    OFF_EPIPOLAR = "off_epipolar"
    EXCHANGED = "exchanged"
    ONE_OF_TWO = "one_of_two"
    NOT_YET_VISIBLE = "not_yet_visible"

    @property
    def words(self) -> str:
        """One line for people."""
        return _WORDS[self]


_WORDS = {
    MissReason.NOTHING_RED: "nothing in the marker's colour",
    MissReason.TOO_SMALL: "too small for the marker",
    MissReason.TOO_LARGE: "too large for the marker",
    MissReason.WRONG_SHAPE: "not of the marker's shape",
    MissReason.SATURATED: "the marker is overexposed: less light or a shorter exposure",
    MissReason.AT_BORDER: "the marker is cut by the picture's border",
    MissReason.PARTLY_HIDDEN: "the marker is partly hidden",
    MissReason.NO_SHAFT: "no bare shaft beside it: another red thing",
    MissReason.OFF_EPIPOLAR: "the two pictures do not show the same point",
    MissReason.EXCHANGED: "it is where the other camera should show it: left and right exchanged",
    MissReason.ONE_OF_TWO: "one band alone: which of the two cannot be told; show both",
    MissReason.NOT_YET_VISIBLE: "the marker is still inside the tube",
}


@dataclass(frozen=True, slots=True, eq=False)
class Hint:
    """What is known before looking.

    Attributes:
        uv: pixel where the marker should be, shape (2,).
        p_world: the band's centre [m], shape (3,), as far as known.
        axis_world: unit vector from hub to tip, shape (3,), as far as known.
    """

    uv: FloatArray
    p_world: FloatArray | None = None
    axis_world: FloatArray | None = None

    @property
    def finite(self) -> bool:
        """Return whether the pixel can be looked at."""
        return bool(np.isfinite(self.uv).all())


@dataclass(frozen=True, slots=True, eq=False)
class MarkerFix:
    """The red band in one picture.

    Attributes:
        uv: where it is [px], shape (2,), sub-pixel.
        covariance: of uv from what the picture itself tells [px²], shape (2, 2).
        area: of the band [px²].
        quality: 0 to 1; share of the outline that is as a band's should be.
        centre: which point of the band `uv` is.
        alone: whether it can be nothing but the marker, so that it counts without another picture.
        occluded: whether something in front hides a part of it.
    """

    uv: FloatArray
    covariance: FloatArray
    area: float
    quality: float
    centre: Centre = Centre.OUTLINE
    alone: bool = True
    occluded: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "uv", frozen(self.uv, (2,), "marker pixel"))
        object.__setattr__(self, "covariance", frozen(self.covariance, (2, 2), "covariance"))

    def with_covariance(self, covariance: FloatArray) -> "MarkerFix":
        """Return the same find with another covariance [px²], shape (2, 2)."""
        return replace(self, covariance=covariance)


@dataclass(frozen=True, slots=True, eq=False)
class Miss:
    """No marker, and why.

    Attributes:
        reason: the first test that failed.
        uv: where the thing that was refused lies [px], shape (2,); None if there is no such thing.
    """

    reason: MissReason
    uv: FloatArray | None = None


@dataclass(frozen=True, slots=True, eq=False)
class ExtractorSetup:
    """What an extractor of one camera is built from.

    Attributes:
        model: the camera.
        shape: of the needle that it looks for.
        area: least and largest area of the band in a picture [px²].
        noise_grey: standard deviation of the pictures' noise [grey levels].
        blur_px: standard deviation of the picture of a point.
        colour: of the marker.
    """

    model: CameraModel
    shape: NeedleShape
    area: tuple[float, float]
    noise_grey: float
    blur_px: float
    colour: ColourModel = RED


Nearest = Callable[[FloatArray], FloatArray | None]
"""From a pixel, shape (2,), to the point of the needle's line that is nearest to its ray [m], shape
(3,); None where the ray runs along the line."""


class Extractor(ABC):
    """Finds the marker in one camera's pictures; holds no memory of earlier ones.

    Attributes:
        region: half width of the region that `find` looks at [px]; 0 for the whole picture.
    """

    region: int = 0

    @abstractmethod
    def find(self, image: Image, hint: Hint) -> MarkerFix | Miss:
        """Marker near a predicted pixel; a senseless hint is a miss, never an exception."""

    @abstractmethod
    def search(self, image: Image) -> tuple[MarkerFix | Miss, ...]:
        """All that may be the marker in the whole picture: finds, the best first, then misses."""

    def find_occluded(
        self, image: Image, axis_world: FloatArray, nearest: Nearest
    ) -> MarkerFix | Miss:
        """Marker of which something in front hides a part, where an extractor can tell its place.

        Args:
            image: the picture.
            axis_world: needle's direction by the robot, shape (3,).
            nearest: point of the robot's line that a pixel shows.
        """
        return Miss(MissReason.PARTLY_HIDDEN)

    @abstractmethod
    def mask(self, image: Image) -> Mask:
        """Mark what counts as the marker's colour, for people to look at."""
