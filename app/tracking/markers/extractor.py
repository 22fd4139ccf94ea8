"""What an extractor finds in a picture, and what it has to be."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

from app.core.arrays import FloatArray, frozen
from app.tracking.cameras.camera import Image


@dataclass(frozen=True, slots=True, eq=False)
class MarkerFix:
    """The red band in one picture.

    Attributes:
        uv: centroid of its visible outline [px], shape (2,), sub-pixel; `silhouette` says how far
            that is from the picture of the band's centre.
        covariance: of uv from the noise of the picture [px²], shape (2, 2).
        area: of the band [px²].
        quality: 0 to 1; share of the outline that is as a band's should be.
    """

    uv: FloatArray
    covariance: FloatArray
    area: float
    quality: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "uv", frozen(self.uv, (2,), "marker pixel"))
        object.__setattr__(self, "covariance", frozen(self.covariance, (2, 2), "covariance"))


class Extractor(ABC):
    """Finds the marker in pictures; holds no memory of earlier ones."""

    @abstractmethod
    def find(self, image: Image, predicted: FloatArray | None) -> MarkerFix | None:
        """Marker near a predicted pixel, or the best in the whole picture without a prediction.

        None if there is none: too small, too large, cut by the border, or overexposed.
        """

    @abstractmethod
    def search(self, image: Image) -> tuple[MarkerFix, ...]:
        """All that may be the marker in the whole picture, the best first."""
