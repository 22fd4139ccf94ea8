"""Marker extraction as the thesis has it: kept for comparison, not for use.

Inverted picture, HSV in-range, one 5×5 erosion and dilation, SimpleBlobDetector, largest
blob, its centre cut to whole pixels (which alone biases it by half a pixel in each direction).
"""

from dataclasses import dataclass
from typing import Any, Final

import cv2
import numpy as np

from app.tracking.cameras.camera import Image
from app.tracking.markers.extractor import (
    Extractor,
    ExtractorSetup,
    Hint,
    MarkerFix,
    Mask,
    Miss,
    MissReason,
)

DECLARATION: Final[dict[str, Any]] = {"title": "The laboratory's published detection"}


_LOW = np.array([70, 82, 100], dtype=np.uint8)
_HIGH = np.array([92, 255, 255], dtype=np.uint8)
_KERNEL = np.ones((5, 5), dtype=np.uint8)


@dataclass(frozen=True)
class ThesisMarker(Extractor):
    """The laboratory's published detection.

    Attributes:
        area_min, area_max: limits of the blob detector [px²]; 200 and 2000 in the thesis.
    """

    area_min: float = 200.0
    area_max: float = 2000.0

    def find(self, image: Image, hint: Hint) -> MarkerFix | Miss:
        """Largest blob of the whole picture; a hint is not used."""
        found = self.search(image)
        return found[0] if found else Miss(MissReason.NOTHING_RED)

    def search(self, image: Image) -> tuple[MarkerFix, ...]:
        """All blobs, the largest first."""
        keypoints = sorted(
            self._detector().detect(255 * self.mask(image)), key=lambda point: -point.size
        )
        return tuple(
            MarkerFix(
                np.array([int(point.pt[0]), int(point.pt[1])]),
                np.eye(2) * (0.5**2 + 1.0 / 12.0),  # bias of half a pixel and rounding
                0.25 * np.pi * point.size**2,
                1.0,
            )
            for point in keypoints
        )

    def mask(self, image: Image) -> Mask:
        """See `Extractor.mask`."""
        hsv = cv2.cvtColor(cv2.bitwise_not(image), cv2.COLOR_BGR2HSV)
        wide = cv2.dilate(cv2.erode(cv2.inRange(hsv, _LOW, _HIGH), _KERNEL), _KERNEL)
        return np.asarray(wide // 255, dtype=np.uint8)

    def _detector(self) -> Any:
        options: Any = cv2.SimpleBlobDetector_Params()  # type: ignore[attr-defined]
        options.filterByColor, options.blobColor = True, 255
        options.filterByArea = True
        options.minArea, options.maxArea = self.area_min, self.area_max
        options.filterByCircularity, options.minCircularity = True, 0.5
        options.filterByConvexity, options.minConvexity = True, 0.5
        options.filterByInertia = False
        return cv2.SimpleBlobDetector_create(options)  # type: ignore[attr-defined]


def extractor(setup: ExtractorSetup) -> Extractor:
    """Build the extractor of a camera; it knows its colour itself."""
    return ThesisMarker()
