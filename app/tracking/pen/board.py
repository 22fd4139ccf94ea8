"""A rigid thing with printed ArUco markers on it: where each marker's corners are."""

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
from app.tracking.pen.errors import PenError

CORNERS = np.array([(-0.5, 0.5), (0.5, 0.5), (0.5, -0.5), (-0.5, -0.5)])
"""Corners of a marker of side 1, x right and y up on the print, in the detector's order."""


@dataclass(frozen=True, slots=True, eq=False)
class Marker:
    """One printed marker.

    Attributes:
        id: its number in the dictionary.
        corners: outer corners of the black square [m], shape (4, 3), in the detector's order.
        normal: unit vector out of the print, shape (3,).
    """

    id: int
    corners: FloatArray
    normal: FloatArray

    @classmethod
    def at(
        cls, number: int, side: float, centre: FloatArray, up: FloatArray, normal: FloatArray
    ) -> "Marker":
        """Return a marker of a side [m] round a centre [m]; `up` is the top of the print."""
        right = np.cross(up, normal)
        corners = centre + side * (CORNERS[:, :1] * right + CORNERS[:, 1:] * up)
        return cls(number, frozen(corners, (4, 3), "corners"), frozen(normal, (3,), "normal"))

    @property
    def side(self) -> float:
        """Length of the black square [m]."""
        return float(np.linalg.norm(self.corners[1] - self.corners[0]))


@dataclass(frozen=True, slots=True, eq=False)
class MarkerBoard:
    """Markers that do not move against each other.

    Attributes:
        name: for messages, e.g. `cube`.
        dictionary: name of an ArUco dictionary, e.g. `DICT_4X4_50`.
        markers: of different ids.
        build_sd: how far a corner is from where it should be, per axis [m]: print, folds, glue.

    Raises:
        PenError: if two markers have one id, or the dictionary is unknown or too small.
    """

    name: str
    dictionary: str
    markers: tuple[Marker, ...]
    build_sd: float = 0.0

    def __post_init__(self) -> None:
        size = dictionary_size(self.dictionary)
        ids = [marker.id for marker in self.markers]
        if len(set(ids)) < len(ids) or not ids:
            raise PenError(
                sentence(
                    "the {name} has the marker ids {ids}; each must stand once",
                    name=self.name,
                    ids=ids,
                )
            )
        if min(ids) < 0 or max(ids) >= size:
            raise PenError(
                sentence(
                    "the {name} needs marker {marker_number}; {dictionary} has 0 to "
                    "{largest_number}",
                    name=self.name,
                    marker_number=max(ids),
                    dictionary=self.dictionary,
                    largest_number=size - 1,
                )
            )

    def find(self, number: int) -> Marker | None:
        """Return the marker of an id, or None."""
        return next((marker for marker in self.markers if marker.id == number), None)


def dictionary_size(name: str) -> int:
    """Return how many markers an ArUco dictionary has.

    Raises:
        PenError: if OpenCV has no dictionary of that name.
    """
    return int(aruco_dictionary(name).bytesList.shape[0])


def aruco_dictionary(name: str) -> cv2.aruco.Dictionary:
    """Return OpenCV's dictionary.

    Raises:
        PenError: if OpenCV has no dictionary of that name.
    """
    number = getattr(cv2.aruco, name, None) if name.startswith("DICT_") else None
    if not isinstance(number, int):
        raise PenError(
            sentence("no ArUco dictionary is called {name!r}; usual is DICT_4X4_50", name=name)
        )
    return cv2.aruco.getPredefinedDictionary(number)


def marker_cells(dictionary: str, number: int) -> np.ndarray:
    """Cells of a marker with its black border, True where white, shape (n + 2, n + 2)."""
    aruco = aruco_dictionary(dictionary)
    cells = int(aruco.markerSize) + 2
    picture = cv2.aruco.generateImageMarker(aruco, number, cells)
    return np.asarray(picture) > 127


def all_ids(boards: Sequence[MarkerBoard]) -> set[int]:
    """Return the ids on all boards.

    Raises:
        PenError: if one id stands on two of them.
    """
    ids = [marker.id for board in boards for marker in board.markers]
    if len(set(ids)) < len(ids):
        raise PenError(sentence("an id stands on cube and sheet; give the sheet another first_id"))
    return set(ids)
