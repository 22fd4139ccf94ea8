"""Finds printed markers in a picture and measures their corners."""

from collections import Counter
from dataclasses import dataclass

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.tracking.cameras.camera import Image
from app.tracking.pen.board import aruco_dictionary
from app.tracking.pen.edges import Grey, measure_squares

Region = tuple[slice, slice]
"""Rows and columns of a picture."""

_HALVED_FROM = 960
"""Width [px] from which a whole picture is searched at half its resolution."""


@dataclass(frozen=True, slots=True, eq=False)
class MarkerSighting:
    """A marker in a picture.

    Attributes:
        id: its number.
        corners: outer corners of the black square [px], shape (4, 2), in the print's order.
        covariance: of them [px²], shape (8, 8); noise only.
    """

    id: int
    corners: FloatArray
    covariance: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class Sightings:
    """All markers of one picture.

    Attributes:
        markers: measured ones, each id once.
        doubles: ids that the picture shows more than once; none of these is among `markers`.
        unmeasured: ids that were read but whose edges could not be measured: at the border, too
            small, covered.
        mirrored: whether the picture shows markers only after mirroring it.
    """

    markers: tuple[MarkerSighting, ...]
    doubles: tuple[int, ...] = ()
    unmeasured: tuple[int, ...] = ()
    mirrored: bool = False


def grey_of(image: Image) -> Grey:
    """Brightness of a picture, uint8 (height, width); a grey one is handed back."""
    return image if image.ndim == 2 else cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)


class MarkerDetector:
    """Finds the markers of one dictionary; not for two threads at once.

    Args:
        dictionary: name of an ArUco dictionary.

    Raises:
        PenError: if OpenCV has no such dictionary.
    """

    def __init__(self, dictionary: str) -> None:
        parameters = cv2.aruco.DetectorParameters()
        parameters.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_NONE
        parameters.adaptiveThreshWinSizeMin = 9
        parameters.adaptiveThreshWinSizeMax = 23
        parameters.adaptiveThreshWinSizeStep = 14
        parameters.minMarkerPerimeterRate = 0.04
        self._detector = cv2.aruco.ArucoDetector(aruco_dictionary(dictionary), parameters)

    def find(
        self,
        image: Image,
        wanted: set[int],
        many: frozenset[int] = frozenset(),
        enough: int = 8,
        region: Region | None = None,
    ) -> Sightings:
        """Return the markers of the wanted ids; an empty result also says if mirroring helps.

        Args:
            image: blue, green, red, or grey.
            wanted: ids to look for.
            many: ids of which about `enough`, spread over their order, are measured: more of one
                sheet cost time and gain little.
            enough: see `many`.
            region: where to look; None looks everywhere.
        """
        grey = grey_of(image)
        squares = self._squares(grey, wanted, region)
        if not squares and region is not None:
            return Sightings(())
        if not squares:
            flipped = self._squares(np.ascontiguousarray(grey[:, ::-1]), wanted)
            return Sightings((), mirrored=len(flipped) >= 2)
        counts = Counter(number for number, _ in squares)
        doubles = tuple(sorted(number for number, count in counts.items() if count > 1))
        single = sorted(
            ((number, found) for number, found in squares if counts[number] == 1),
            key=lambda square: square[0],
        )
        spare = [number for number, _ in single if number in many]
        left_out = set(spare) - set(spare[:: max(1, len(spare) // enough)])
        single = [square for square in single if square[0] not in left_out]
        corners = np.array([found for _, found in single]).reshape(-1, 4, 2)
        markers, unmeasured = [], []
        for (number, _), square in zip(single, measure_squares(grey, corners), strict=True):
            if square is None:
                unmeasured.append(number)
            else:
                markers.append(MarkerSighting(number, square.corners, square.covariance))
        return Sightings(tuple(markers), doubles, tuple(sorted(unmeasured)))

    def _squares(
        self, grey: Grey, wanted: set[int], region: Region | None = None
    ) -> list[tuple[int, FloatArray]]:
        part, scale, shift = grey, 1.0, np.zeros(2)
        if region is not None:
            part = np.ascontiguousarray(grey[region])
            shift = np.array([region[1].start, region[0].start], dtype=np.float64)
        elif grey.shape[1] >= _HALVED_FROM:
            part = cv2.resize(grey, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)
            scale, shift = 2.0, np.full(2, 0.5)
        corners, ids, _ = self._detector.detectMarkers(part)
        if ids is None:
            return []
        return [
            (int(number), scale * np.asarray(found, dtype=np.float64).reshape(4, 2) + shift)
            for number, found in zip(np.ravel(ids), corners, strict=True)
            if int(number) in wanted
        ]
