"""Marker extraction by the centroid of the band's outline (the default way).

The strength of the marker's colour (see `colour`) does not see grey and hardly skin: it says where
the band is. It does not weigh the pixels: one flank of a round band is darker than the other and
would count less. The weight of a pixel is the share of it that the band covers (see `rim`), one
inside, so that the centroid is that of the outline, whatever the light. The paint should be matt.

A patch (compiled): a pixel is marked where the colour is strong, and strong for its brightness:
skin and wood are not. What is marked and touches, corners too, is one patch.
"""

import math
from dataclasses import dataclass, field
from typing import Any, Final

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, read_only
from app.core.compiled import REORDERED, njit
from app.tracking.cameras.camera import Image
from app.tracking.markers.band_area import judged_by_area
from app.tracking.markers.colour import RED, ColourModel
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
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleShape

DECLARATION: Final[dict[str, Any]] = {"title": "Mask, then the centroid of the covered shares"}


_SQUARE3 = np.ones((3, 3), dtype=np.uint8)
_CANDIDATES = 6
_ROOM = 7
"""What is looked at round a patch [px]."""

_NEAR: Final = 24
"""Where the strongest pixel is looked for that sets the threshold [px], half width."""

_PURITY: Final = 0.3
"""Least strength over the brightest colour of a pixel: skin and wood have less."""

_SINGLE: Final = 0.01
"""More than single precision is off in a strength [grey levels]."""

_SPECK: Final = 6.0
_SPECK_SHARE: Final = 0.2
"""Least area of a patch [px²], and over that of the largest."""


@njit
def _strength(image: Any, v: int, u: int, weights: Any) -> float:
    return weights[0] * image[v, u, 0] + weights[1] * image[v, u, 1] + weights[2] * image[v, u, 2]


@njit
def _is_pure(image: Any, v: int, u: int, weights: Any, strength: float) -> bool:
    """Return whether the strength is enough for the brightness of the marker's main colours."""
    bright = 0.0
    for k in range(3):
        if weights[k] == 1.0:
            bright += image[v, u, k]
    return strength - _PURITY * bright >= 0.5


@njit
def mark_half(image: Any, weights: Any, least: float, mask: Any, box: Any) -> bool:
    """Mark every second pixel of every second row; False if there is none to mark.

    Args:
        image: uint8 (H, W, 3).
        weights: see `colour.ColourModel.weights`.
        least: strength of a pixel [grey levels].
        mask: out, uint8 ((H + 1) // 2, (W + 1) // 2).
        box: out, left, top, right, bottom of what is marked [px of the mask], the last two
            exclusive.
    """
    height, width = mask.shape
    box[0], box[1], box[2], box[3] = width, height, 0, 0
    for v in range(height):
        mask[v] = 0
        if not _any_strong(image, 2 * v, weights, least):
            continue
        for u in range(width):
            strength = _strength(image, 2 * v, 2 * u, weights)
            if strength >= least and _is_pure(image, 2 * v, 2 * u, weights, strength):
                mask[v, u] = 1
                box[0], box[1] = min(box[0], u), min(box[1], v)
                box[2], box[3] = max(box[2], u + 1), max(box[3], v + 1)
    return box[2] > box[0]


@njit(fastmath=REORDERED, forceinline=True)
def _any_strong(image: Any, v: int, weights: Any, least: float) -> bool:
    """Return whether any second pixel of a row may be strong enough: without a branch, eight at a
    time.
    """
    blue, green, red = np.float32(weights[0]), np.float32(weights[1]), np.float32(weights[2])
    limit = np.float32(least - _SINGLE)
    some: Any = False
    for u in range((image.shape[1] + 1) // 2):
        strength = (
            blue * np.float32(image[v, 2 * u, 0])
            + green * np.float32(image[v, 2 * u, 1])
            + red * np.float32(image[v, 2 * u, 2])
        )
        some |= strength >= limit
    return some


@njit
def nearest_patch(
    image: Any,
    region: Any,
    u: float,
    v: float,
    weights: Any,
    least: float,
    share: float,
    labels: Any,
    box: Any,
    centre: Any,
) -> int:
    """Label of the patch nearest to a pixel in a region; 0 if there is none.

    Args:
        image: uint8 (H, W, 3).
        region: left, top, right, bottom [px]; the last two exclusive.
        u: column of the pixel, in the picture.
        v: its row.
        weights: see `colour.ColourModel.weights`.
        least: strength of a pixel [grey levels].
        share: of the strongest pixel nearby that a pixel must have.
        labels: out, int32, of the region's size: the patches' numbers, 0 outside them.
        box: out, left, top, width, height of the patch in the region [px].
        centre: out, mean pixel of the patch in the picture, (2,).
    """
    left, top = region[0], region[1]
    height, width = region[3] - top, region[2] - left
    strengths = np.empty((height, width), np.float32)
    _measure(image, top, left, weights, strengths)
    x, y = round(u) - left, round(v) - top
    rows = slice(max(0, y - _NEAR), max(0, y + _NEAR))
    near = strengths[rows, max(0, x - _NEAR) : max(0, x + _NEAR)]
    strongest = min(255.0, near.max()) if near.size else 0.0
    if strongest < least:
        strongest = min(255.0, strengths.max())
    limit = max(math.floor(least) + 0.5, share * strongest)
    for j in range(height):
        for i in range(width):
            pure = strengths[j, i] >= limit and _is_pure(
                image, top + j, left + i, weights, strengths[j, i]
            )
            labels[j, i] = -1 if pure else 0
    return _choose(labels, left, top, u, v, box, centre)


@njit(fastmath=REORDERED)
def _measure(image: Any, top: int, left: int, weights: Any, strengths: Any) -> None:
    """Strength of every pixel: without a branch, eight at a time."""
    blue, green, red = np.float32(weights[0]), np.float32(weights[1]), np.float32(weights[2])
    for j in range(strengths.shape[0]):
        for i in range(strengths.shape[1]):
            strengths[j, i] = (
                blue * np.float32(image[top + j, left + i, 0])
                + green * np.float32(image[top + j, left + i, 1])
                + red * np.float32(image[top + j, left + i, 2])
            )


@njit
def _choose(labels: Any, left: int, top: int, u: float, v: float, box: Any, centre: Any) -> int:
    """Fill box and centre of the nearest patch that is no speck beside the largest; its number.

    What is nearer than the largest so far may be a speck beside one that comes later: only then
    are the patches gone through once more.
    """
    stack = np.empty((labels.size, 2), np.int32)
    largest = 0
    for attempt in range(2):
        count, best, smallest, nearest = 0, 0, 0, np.inf
        for j in range(labels.shape[0]):
            for i in range(labels.shape[1]):
                if labels[j, i] != -1:
                    continue
                count += 1
                area, low, high, first, last, su, sv = _flood(labels, j, i, count, stack)
                largest = max(largest, area)
                mu, mv = left + su / area, top + sv / area
                distance = math.hypot(mu - u, mv - v)
                if area >= max(_SPECK, _SPECK_SHARE * largest) and distance < nearest:
                    best, nearest, smallest = count, distance, area
                    box[0], box[1], box[2], box[3] = first, low, last - first + 1, high - low + 1
                    centre[0], centre[1] = mu, mv
        if attempt or not best or smallest >= _SPECK_SHARE * largest:
            break
        for j in range(labels.shape[0]):
            for i in range(labels.shape[1]):
                labels[j, i] = -1 if labels[j, i] else 0
    return best


@njit
def _flood(labels: Any, j: int, i: int, label: int, stack: Any) -> Any:
    """Label a patch; returns its area, rows, columns, and the sums of columns and of rows."""
    height, width = labels.shape
    low, high, first, last = j, j, i, i
    area, su, sv, waiting = 0, 0.0, 0.0, 1
    stack[0, 0], stack[0, 1] = j, i
    labels[j, i] = label
    while waiting > 0:
        waiting -= 1
        b, a = stack[waiting, 0], stack[waiting, 1]
        area += 1
        su += a
        sv += b
        low, high, first, last = min(low, b), max(high, b), min(first, a), max(last, a)
        for q in range(max(0, b - 1), min(height, b + 2)):
            for p in range(max(0, a - 1), min(width, a + 2)):
                if labels[q, p] == -1:
                    labels[q, p] = label
                    stack[waiting, 0], stack[waiting, 1] = q, p
                    waiting += 1
    return area, low, high, first, last, su, sv


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
        """Return where it is in its box."""
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
        model: the camera, which tells how large a whole band is; None: any size is believed.
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
    model: CameraModel | None = None
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
        outline = self._in_region(image, hint.uv)
        if isinstance(outline, Miss) or self.rough or self.model is None or self.shape is None:
            return outline
        return judged_by_area(outline, self.model, self.shape, hint)

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
        strength = strengths(image, self.colour)
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
            read_only(image[:]),
            np.array([left, top, right, bottom]),
            at_u,
            at_v,
            self.colour.weights,
            self.colour.strength,
            self.colour.share,
            numbers,
            inner,
            middle,
        )
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


def strengths(image: Image, colour: ColourModel) -> Mask:
    """Strength of the marker's colour in every pixel, 0 to 255 [grey levels], (height, width)."""
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
        model=setup.model,
        rough=rough,
    )


def extractor(setup: ExtractorSetup) -> Extractor:
    """Build the extractor of a camera."""
    return outline_of(setup)
