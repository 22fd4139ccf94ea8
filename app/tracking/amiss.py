"""Two certain finds that disagree: a camera that was moved, or two cables exchanged.

A thing that a fit with the robot's axis takes for the band, on a bare shaft, can be nothing but the
marker. Where either picture shows one such thing, and the two are not one point, the cameras are
not where they were; where each is what the other camera should see, they are exchanged.
"""

from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.agreement import EpipolarGate
from app.tracking.cameras.feed import Pair
from app.tracking.markers.extractor import Centre, Extractor, Hint, MarkerFix
from app.tracking.track import Found

_SAME_PX: Final = 2.0
"""Finds nearer to each other than this [px] are one thing."""

Extractors = tuple[Extractor, Extractor]


def certain_pair(
    extractors: Extractors, frames: Pair, candidates: list[list[Found]], axis: FloatArray
) -> tuple[MarkerFix, MarkerFix] | None:
    """Return what can be nothing but the marker, where either picture shows one such thing.

    Args:
        extractors: of both cameras.
        frames: their pictures.
        candidates: what a search found in either.
        axis: needle's direction by the robot, shape (3,).
    """
    first = _bands(extractors[0], frames, 0, candidates, axis)
    second = _bands(extractors[1], frames, 1, candidates, axis)
    return (first[0], second[0]) if len(first) == len(second) == 1 else None


def fits_exchanged(
    extractors: Extractors,
    gate: EpipolarGate,
    frames: Pair,
    candidates: list[list[Found]],
    axis: FloatArray,
) -> bool:
    """Whether both pictures show one marker if the left one is the right camera's.

    Args:
        extractors: see `certain_pair`.
        gate: of the rig.
        frames: as above.
        candidates: as above.
        axis: as above.
    """
    left, right = frames
    if left is None or right is None or left.image.shape != right.image.shape:
        return False
    first = _bands(extractors[0], frames, 1, candidates, axis)
    second = _bands(extractors[1], frames, 0, candidates, axis)
    if not len(first) == len(second) == 1:
        return False
    return gate.pairings(first, second, left.time - right.time)[0].agrees


def _bands(
    extractor: Extractor,
    frames: Pair,
    picture: int,
    candidates: list[list[Found]],
    axis: FloatArray,
) -> list[MarkerFix]:
    """Candidates in a picture that the extractor's camera would show as a band on its shaft."""
    frame, sure = frames[picture], list[MarkerFix]()
    if frame is None:
        return sure
    for one in candidates[picture]:
        if not isinstance(one, MarkerFix):
            continue
        found = extractor.find(frame.image, Hint(one.uv, None, axis))
        if not isinstance(found, MarkerFix) or found.centre is not Centre.BAND:
            continue
        if all(np.abs(other.uv - found.uv).max() >= _SAME_PX for other in sure):
            sure.append(found)
    return sure
