"""Marker extraction by the centroid of the band's outline (the default way).

The strength of the marker's colour (see `colour`) does not see grey and hardly skin: it says where
the band is. It does not weigh the pixels: one flank of a round band is darker than the other and
would count less. The weight of a pixel is the share of it that the band covers (see `rim`), one
inside, so that the centroid is that of the outline, whatever the light. The paint should be matt.
"""

from dataclasses import dataclass, field
from typing import Any, Final

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, read_only
from app.tracking.cameras.camera import Image
from app.tracking.markers.colour import RED, ColourModel, mark_half, nearest_patch
from app.tracking.markers.extractor import (
    Extractor,
    ExtractorSetup,
    Hint,
    MarkerFix,
    Mask,
    Miss,
    MissReason,
)
from app.tracking.markers.rim import outline_moments
from app.tracking.optics.rig import NeedleShape

DECLARATION: Final[dict[str, Any]] = {"title": "Mask, then the centroid of the covered shares"}


_SQUARE3 = np.ones((3, 3), dtype=np.uint8)
_CANDIDATES = 6
_ROOM = 7
"""What is looked at round a patch [px]."""


@dataclass(frozen=True, slots=True, eq=False)
class _Patch:
    """A patch of the marker's colour: its box with room, mean pixel, and where it has its number.

    Attributes:
        box: left, top, right, bottom [px], with room.
        centre: mean pixel, shape (2,).
        numbers: of the patches in the box without the room, shape (h, w).
        number: the patch's.
    """

    box: tuple[int, int, int, int]
    centre: FloatArray
    numbers: NDArray[np.int32]
    number: int

    @property
    def mask(self) -> Mask:
        """Where it is in its box."""
        height, width = self.numbers.shape
        mask = np.zeros((height + 2 * _ROOM, width + 2 * _ROOM), dtype=np.uint8)
        mask[_ROOM:-_ROOM, _ROOM:-_ROOM] = self.numbers == self.number
        return mask


@dataclass(frozen=True)
class OutlineCentroid(Extractor):
    """Red mask in a tracked region, then the centroid of the covered shares.

    Attributes:
        colour: of the marker.
        area_min, area_max: of the band [px²].
        region: half width of the tracked region [px].
        noise_grey: standard deviation of the picture's noise, for the covariance.
        overexposed: largest share of the band with a colour at its end, at which it is refused.
        quality_min: least share of outline pixels that are mixtures of band and background.
        rough: whether a place to begin a fit at will do: half the work, twice the error.
        blur_px: standard deviation of the point spread.
        focal_px: of the camera, for the band's perspective; without it there is none.
        shape: of the needle, for what its point looks like behind the band; None: a plain shaft.
        optics: of all these, see `rim.outline_moments`.
    """

    colour: ColourModel = field(default=RED)
    area_min: float = 40.0
    area_max: float = 6000.0
    region: int = 48
    noise_grey: float = 4.0
    overexposed: float = 0.25
    quality_min: float = 0.6
    rough: bool = False
    blur_px: float = 0.7
    focal_px: float = np.inf
    shape: NeedleShape | None = None
    optics: FloatArray = field(init=False, repr=False)

    def __post_init__(self) -> None:
        shape = self.shape
        needle = (
            (np.inf, np.inf, 1.0)
            if shape is None
            else (
                shape.tip / shape.half,
                (shape.tip - shape.point) / shape.half,
                shape.shaft / shape.radius,
            )
        )
        optics = np.array([self.blur_px, self.focal_px, *needle])
        object.__setattr__(self, "optics", read_only(optics))

    def find(self, image: Image, hint: Hint) -> MarkerFix | Miss:
        """See `Extractor.find`."""
        if not hint.finite:
            return Miss(MissReason.NOTHING_RED)
        return self._in_region(image, hint.uv)

    def search(self, image: Image) -> tuple[MarkerFix | Miss, ...]:
        """Look at every second pixel for red patches of the right size, then closely at each."""
        found = [self._in_region(image, seed) for seed in self._seeds(image)]
        distinct: list[MarkerFix] = []
        fixes = [one for one in found if isinstance(one, MarkerFix)]
        for fix in sorted(fixes, key=lambda fix: -fix.quality):
            if all(np.abs(fix.uv - other.uv).max() > 2.0 for other in distinct):
                distinct.append(fix)
        return *distinct, *(one for one in found if isinstance(one, Miss))

    def mask(self, image: Image) -> Mask:
        """See `Extractor.mask`."""
        strength = _strength(image, self.colour)
        return _threshold(strength, self.colour.threshold(float(np.percentile(strength, 99.9))))

    def patch_centre(self, image: Image, centre: FloatArray) -> FloatArray | None:
        """Mean pixel of the patch nearest to a pixel, shape (2,): the band's within 2 px or so.

        None if there is none, or it reaches the picture's border.
        """
        patch = self._patch(image, centre)
        return None if isinstance(patch, Miss) else patch.centre

    def _seeds(self, image: Image) -> list[FloatArray]:
        height, width = image.shape[:2]
        mask = np.empty(((height + 1) // 2, (width + 1) // 2), dtype=np.uint8)
        box = np.empty(4, dtype=np.int64)
        least = float(np.floor(self.colour.strength)) + 0.5
        if not mark_half(read_only(image[:]), self.colour.weights, least, mask, box):
            return []
        left, top = np.maximum(box[:2] - 2, 0)
        mask = mask[top : box[3] + 2, left : box[2] + 2]
        mask = cv2.morphologyEx(mask, cv2.MORPH_CLOSE, _SQUARE3)
        count, _, statistics, centres = cv2.connectedComponentsWithStats(mask)
        areas = 4.0 * statistics[1:count, cv2.CC_STAT_AREA]
        fitting = np.flatnonzero((areas > 0.5 * self.area_min) & (areas < 1.5 * self.area_max))
        largest = fitting[np.argsort(-areas[fitting])][:_CANDIDATES]
        return [2.0 * (centres[1 + i] + [left, top]) for i in largest]

    def _in_region(self, image: Image, centre: FloatArray) -> MarkerFix | Miss:
        patch = self._patch(image, centre)
        if isinstance(patch, Miss):
            return patch
        left, top, right, bottom = patch.box
        window = image[top:bottom, left:right]
        return self._measure(window, patch.mask, np.array([left, top], dtype=np.float64))

    def _patch(self, image: Image, centre: FloatArray) -> _Patch | Miss:
        """Patch nearest to `centre` in the region round it, with room."""
        height, width = image.shape[:2]
        at_u, at_v = centre.tolist()
        u, v = (round(min(1e6, max(-1e6, x))) for x in (at_u, at_v))
        left, top = max(0, u - self.region), max(0, v - self.region)
        right, bottom = min(width, u + self.region + 1), min(height, v + self.region + 1)
        if right - left < 8 or bottom - top < 8:
            return Miss(MissReason.NOTHING_RED)
        numbers, inner = np.empty((bottom - top, right - left), np.int32), np.empty(4, np.int64)
        middle = np.empty(2)
        number = nearest_patch(
            read_only(image[:]), np.array([left, top, right, bottom]), at_u, at_v,
            self.colour.weights, self.colour.strength, self.colour.share, numbers, inner, middle,
        )  # fmt: skip
        if number == 0:
            return Miss(MissReason.NOTHING_RED)
        x, y, w, h = inner.tolist()
        box = (left + x - _ROOM, top + y - _ROOM, left + x + w + _ROOM, top + y + h + _ROOM)
        if box[0] <= 0 or box[1] <= 0 or box[2] >= width or box[3] >= height:
            return Miss(MissReason.AT_BORDER, middle)
        return _Patch(box, middle, numbers[y : y + h, x : x + w], number)

    def _measure(self, window: Image, blob: Mask, origin: FloatArray) -> MarkerFix | Miss:
        middle = origin + 0.5 * np.array([blob.shape[1], blob.shape[0]])
        if _overexposed(window, blob, self.colour) > self.overexposed:
            return Miss(MissReason.SATURATED, middle)
        if not self.colour.is_marker(np.array(cv2.mean(window, blob)[:3])):
            return Miss(MissReason.NOTHING_RED, middle)
        area, u, v, uu, uv, vv, quality = outline_moments(
            window, blob, self.noise_grey, self.optics, self.rough
        )
        if area < self.area_min:
            return Miss(MissReason.TOO_SMALL, middle)
        if area > self.area_max:
            return Miss(MissReason.TOO_LARGE, middle)
        if quality < self.quality_min:
            return Miss(MissReason.WRONG_SHAPE, middle)
        covariance = np.array([[uu, uv], [uv, vv]]) + 1e-8 * np.eye(2)
        return MarkerFix(origin + np.array([u, v]), covariance, area, quality)


def _strength(image: Image, colour: ColourModel) -> Mask:
    """Strength of the marker's colour, at least 0 [grey levels]."""
    return np.asarray(cv2.transform(np.ascontiguousarray(image), colour.weights[None]), np.uint8)


def _threshold(redness: Mask, limit: float) -> Mask:
    return (redness > limit).astype(np.uint8)


def _overexposed(window: Image, blob: Mask, colour: ColourModel) -> float:
    """Share of the patch in which the marker's strongest colour is at its end."""
    saturated = (window[..., int(np.argmax(colour.weights))] >= 254) & (blob > 0)
    return float(saturated.sum()) / max(1.0, float(blob.sum()))


def outline_of(setup: ExtractorSetup, rough: bool = False) -> OutlineCentroid:
    """Return the outline's extractor for a camera; `rough` where another only begins with it."""
    return OutlineCentroid(
        colour=setup.colour,
        area_min=setup.area[0],
        area_max=setup.area[1],
        noise_grey=setup.noise_grey,
        blur_px=setup.blur_px,
        focal_px=float(np.sqrt(np.prod(setup.model.intrinsics[:2]))),
        shape=setup.shape,
        rough=rough,
    )


def extractor(setup: ExtractorSetup) -> Extractor:
    """Build the extractor of a camera."""
    return outline_of(setup)
