"""Marker extraction by the centroid of the band's outline (the default way).

The strength of the marker's colour (see `colour`) does not see grey and hardly skin: it says where
the band is. It does not weigh the pixels: one flank of a round band is darker than the other and
would count less. The weight of a pixel is the share of it that the band covers (see `rim`), one
inside, so that the centroid is that of the outline, whatever the light. The paint should be matt.
"""

from dataclasses import dataclass, field

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.tracking.cameras.camera import Image
from app.tracking.markers.colour import RED, ColourModel
from app.tracking.markers.extractor import Extractor, Hint, MarkerFix, Mask, Miss, MissReason
from app.tracking.markers.rim import outline_moments

_SQUARE3 = np.ones((3, 3), dtype=np.uint8)
_CANDIDATES = 6
_NEAR = 24
_PURITY = 0.3
"""Least strength over the brightest colour of a pixel: skin and wood have less."""


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
    """

    colour: ColourModel = field(default=RED)
    area_min: float = 40.0
    area_max: float = 6000.0
    region: int = 48
    noise_grey: float = 4.0
    overexposed: float = 0.25
    quality_min: float = 0.6
    rough: bool = False

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

    def _seeds(self, image: Image) -> list[FloatArray]:
        mask = _pure(image[::2, ::2], self.colour)
        mask = cv2.morphologyEx(mask, cv2.MORPH_CLOSE, _SQUARE3)
        count, _, statistics, centres = cv2.connectedComponentsWithStats(mask)
        areas = 4.0 * statistics[1:count, cv2.CC_STAT_AREA]
        fitting = np.flatnonzero((areas > 0.5 * self.area_min) & (areas < 1.5 * self.area_max))
        largest = fitting[np.argsort(-areas[fitting])][:_CANDIDATES]
        return [2.0 * centres[1 + i] for i in largest]

    def _in_region(self, image: Image, centre: FloatArray) -> MarkerFix | Miss:
        height, width = image.shape[:2]
        u, v = np.clip(np.rint(centre), -1e6, 1e6).astype(int)
        left, top = max(0, u - self.region), max(0, v - self.region)
        right, bottom = min(width, u + self.region + 1), min(height, v + self.region + 1)
        if right - left < 8 or bottom - top < 8:
            return Miss(MissReason.NOTHING_RED)
        patch = _tight(image, (left, top, right, bottom), centre, self.colour)
        if isinstance(patch, Miss):
            return patch
        blob, (left, top, right, bottom) = patch
        if left == 0 or top == 0 or right == width or bottom == height:
            return Miss(MissReason.AT_BORDER, centre)
        window = image[top:bottom, left:right]
        return self._measure(window, blob, np.array([left, top], dtype=np.float64))

    def _measure(self, window: Image, blob: Mask, origin: FloatArray) -> MarkerFix | Miss:
        middle = origin + 0.5 * np.array([blob.shape[1], blob.shape[0]])
        if _overexposed(window, blob, self.colour) > self.overexposed:
            return Miss(MissReason.SATURATED, middle)
        if not self.colour.is_marker(np.array(cv2.mean(window, blob)[:3])):
            return Miss(MissReason.NOTHING_RED, middle)
        area, u, v, uu, uv, vv, quality = outline_moments(window, blob, self.noise_grey, self.rough)
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


def _pure(image: Image, colour: ColourModel) -> Mask:
    """Mark where the colour is strong, and strong for its brightness: skin and wood are not."""
    purity = colour.weights - _PURITY * (colour.weights == 1.0)
    both = cv2.transform(np.ascontiguousarray(image), np.stack([colour.weights, purity]))
    strong = cv2.threshold(both[..., 0], colour.strength, 1.0, cv2.THRESH_BINARY)[1]
    pure = cv2.threshold(both[..., 1], 0.0, 1.0, cv2.THRESH_BINARY)[1]
    return np.asarray(cv2.bitwise_and(strong, pure), dtype=np.uint8)


def _threshold(redness: Mask, limit: float) -> Mask:
    return (redness > limit).astype(np.uint8)


def _tight(
    image: Image, region: tuple[int, int, int, int], centre: FloatArray, colour: ColourModel
) -> tuple[Mask, tuple[int, int, int, int]] | Miss:
    """Return the red patch nearest to `centre` in the region, and its box with room around it."""
    left, top, right, bottom = region
    strength = _strength(image[top:bottom, left:right], colour)
    y, x = np.rint(centre).astype(int) - [top, left]
    near = strength[max(0, y - _NEAR) : max(0, y + _NEAR), max(0, x - _NEAR) : max(0, x + _NEAR)]
    strongest = float(near.max(initial=0))
    if strongest < colour.strength:
        strongest = float(strength.max())
    mask = _threshold(strength, colour.threshold(strongest))
    mask &= _pure(image[top:bottom, left:right], colour)
    count, labels, statistics, centres = cv2.connectedComponentsWithStats(mask)
    if count < 2:
        return Miss(MissReason.NOTHING_RED)
    areas = statistics[1:, cv2.CC_STAT_AREA]
    distance = np.hypot(*(centres[1:] + np.array([left, top]) - centre).T)
    distance[areas < max(6.0, 0.2 * areas.max())] = np.inf  # specks
    which = 1 + int(np.argmin(distance))
    x, y, w, h = statistics[which, :4]
    room = 7
    box = (
        max(0, left + x - room),
        max(0, top + y - room),
        min(image.shape[1], left + x + w + room),
        min(image.shape[0], top + y + h + room),
    )
    blob = np.zeros((box[3] - box[1], box[2] - box[0]), dtype=np.uint8)
    rows, columns = top + y - box[1], left + x - box[0]
    blob[rows : rows + h, columns : columns + w] = labels[y : y + h, x : x + w] == which
    touches = (left + x == 0 or top + y == 0) or (
        left + x + w == image.shape[1] or top + y + h == image.shape[0]
    )
    return Miss(MissReason.AT_BORDER, centres[which] + [left, top]) if touches else (blob, box)


def _overexposed(window: Image, blob: Mask, colour: ColourModel) -> float:
    """Share of the patch in which the marker's strongest colour is at its end."""
    saturated = (window[..., int(np.argmax(colour.weights))] >= 254) & (blob > 0)
    return float(saturated.sum()) / max(1.0, float(blob.sum()))
