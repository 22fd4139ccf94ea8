"""The bare shaft beside a band (compiled).

A shaft tells the marker from every other red thing of its size. A fit of the band alone is
satisfied by a red ellipse, and in the middle of a red cloth by nothing at all. So a find needs the
bare shaft just beyond the band's ends. There a strip along the needle is cut into pieces, and
across it into five zones: beside the shaft, a third of the shaft, its middle, the other third,
beside it again. A shaft makes the same difference between neighbouring zones in every piece, for
its outline is straight and parallel to the needle and its shading does not change along it. Of what
stands behind, only an edge that runs along the needle, on one of four lines a pixel wide, does
that.

Of the eight differences the second largest decides. One edge of the background may lie along the
needle; two, on two of the lines and nowhere between, is rare (one place in ten before the housing,
one in a hundred in both pictures). A shaft has two outlines and a shading of its own, at two ends,
so a hand that hides one end, or a background as grey as the shaft on one side, leaves enough.
"""

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.compiled import njit
from app.tracking.band.fit import BandFit
from app.tracking.band.outline import Outline
from app.tracking.cameras.camera import Image
from app.tracking.optics.rig import NeedleShape

ENDS: Final = 2
PIECES: Final = 4
ZONES: Final = 5
STEPS: Final = ENDS * (ZONES - 1)

_LENGTH_PX: Final = 14.0
_BESIDE_PX: Final = 2.6
"""Length of a strip, and how far beside the shaft it reaches, for a shaft `_USUAL_PX` wide on
either side of its middle; a wider one has more of both."""

_USUAL_PX: Final = 5.3
_GAP: Final = 2.5
"""From the band's end to its strip [standard deviations of the blur]."""

_EDGE_PX: Final = 0.6
"""How near to the shaft's edge no zone comes."""

_THIRDS_PX: Final = 2.0
"""Half width from which the shaft has three zones; a thinner one counts as its middle."""

_THIN_PX: Final = 1.0
_RED: Final = 0.5
"""Strength of the colour, over that of the band, from which a piece is no bare shaft."""


@njit
def _zone(n: float, half: float, beside: float) -> int:
    """Zone of a pixel `n` px from the needle's middle; -1 between the zones."""
    away = abs(n)
    if away > half + _EDGE_PX:
        if away > half + beside:
            return -1
        return 0 if n < 0.0 else ZONES - 1
    if away > half - _EDGE_PX:
        return -1
    if half < _THIRDS_PX or 3.0 * away < half:
        return 2
    return 1 if n < 0.0 else 3


@njit
def gather_zones(
    image: Any, outline: Any, shape: Any, moved: Any, blur: float, sums: Any, counts: Any
) -> None:
    """Add up the colours of every zone of every piece.

    Args:
        image: uint8 (H, W, 3).
        outline: a `band.outline.Outline`.
        shape: a `rig.NeedleShape`.
        moved: shift u and v of the band from the outline's origin [px], its width and length over
            those of the outline.
        blur: standard deviation of the point spread [px].
        sums: out, (ENDS, PIECES, ZONES, 3).
        counts: out, pixels, (ENDS, PIECES, ZONES).
    """
    sums[:], counts[:] = 0.0, 0.0
    low, high = moved[3] * outline.arcs[:2].min(), moved[3] * outline.arcs[:2].max()
    wide = moved[2] * 0.5 * (outline.right - outline.left)
    scale = max(1.0, wide / _USUAL_PX)
    gap, length, beside = _GAP * blur, _LENGTH_PX * scale, _BESIDE_PX * scale
    u0, v0 = outline.u + moved[0], outline.v + moved[1]
    stride = max(1, int(0.7 * scale))
    along, across = max(high, -low) + gap + length, wide + beside + 2.0
    reach_u = along * abs(outline.eu) + across * abs(outline.ev)
    reach_v = along * abs(outline.ev) + across * abs(outline.eu)
    left, right = max(0, math.ceil(u0 - reach_u)), min(image.shape[1], math.floor(u0 + reach_u) + 1)
    top, bottom = max(0, math.ceil(v0 - reach_v)), min(image.shape[0], math.floor(v0 + reach_v) + 1)
    for v in range(top, bottom, stride):
        for u in range(left, right, stride):
            du, dv = u - u0, v - v0
            e = du * outline.eu + dv * outline.ev
            n = dv * outline.eu - du * outline.ev
            end = 1 if e > 0.0 else 0
            beyond = (e - high if end else low - e) - gap
            if not 0.0 <= beyond < length:
                continue
            first = outline.left + outline.left_slope * e
            last = outline.right + outline.right_slope * e
            middle = 0.5 * (first + last) + outline.bow * (e * e - outline.bow_zero)
            thick = shape.shaft / shape.radius
            if end:
                thick = min(thick, max(0.0, (outline.apex - e) / outline.taper))
            half = moved[2] * 0.5 * (last - first) * thick
            if half < _THIN_PX:
                continue
            zone = _zone(n - middle, half, beside)
            if zone < 0:
                continue
            piece = min(PIECES - 1, int(PIECES * beyond / length))
            counts[end, piece, zone] += 1.0
            for c in range(3):
                sums[end, piece, zone, c] += image[v, u, c]


@njit
def shaft_steps(sums: Any, counts: Any, noise: float, weights: Any, red: float, steps: Any) -> None:
    """Significance of the difference between neighbouring zones, pieces taken together.

    For each of both ends' four pairs of zones the square of the mean difference over its variance,
    mean of the colours: about 1 where there is nothing. The variance is the noise's, or the pieces'
    own if they differ more.

    Args:
        sums: see `gather_zones`.
        counts: likewise.
        noise: standard deviation of a grey value.
        weights: see `colour.ColourModel.weights`.
        red: strength of the band's colour [grey levels].
        steps: out, (STEPS,).
    """
    difference = np.empty((PIECES, 3))
    for end in range(ENDS):
        for pair in range(ZONES - 1):
            found, variance = 0, 0.0
            for piece in range(PIECES):
                inner, outer = counts[end, piece, pair], counts[end, piece, pair + 1]
                if inner < 2.0 or outer < 2.0:
                    continue
                if _is_red(sums[end, piece], counts[end, piece], weights, red):
                    continue
                for c in range(3):
                    difference[found, c] = (
                        sums[end, piece, pair, c] / inner - sums[end, piece, pair + 1, c] / outer
                    )
                variance += noise * noise * (1.0 / inner + 1.0 / outer)
                found += 1
            k = end * (ZONES - 1) + pair
            steps[k] = _significance(difference, found, variance / max(found, 1))


@njit
def _is_red(sums: Any, counts: Any, weights: Any, red: float) -> bool:
    """Return whether the shaft's zones of a piece have the band's colour."""
    strength, count = 0.0, 0.0
    for zone in range(1, ZONES - 1):
        count += counts[zone]
        for c in range(3):
            strength += weights[c] * sums[zone, c]
    return strength > _RED * red * count


@njit
def _significance(difference: Any, result: int, variance: float) -> float:
    if result < 2:
        return 0.0
    square, scatter = 0.0, 0.0
    for c in range(3):
        mean = 0.0
        for k in range(result):
            mean += difference[k, c] / result
        square += mean * mean / 3.0
        for k in range(result):
            scatter += (difference[k, c] - mean) ** 2 / (3.0 * (result - 1))
    return square * result / max(variance, scatter, 1e-9)


LEAST: Final = 6.0
"""Second largest difference [variances] from which there is a shaft."""

LEAST_ALONE: Final = 10.0
"""Third largest that a picture needs which no other one confirms."""


@dataclass(frozen=True, slots=True)
class ShaftEvidence:
    """Differences across the needle beyond the band's ends.

    Attributes:
        second, third: second and third largest of them, squared, over their variance; about 1
            where there is no shaft, some hundreds where there is one.
    """

    second: float
    third: float

    @property
    def found(self) -> bool:
        """Return whether the band is on a shaft."""
        return self.second >= LEAST

    @property
    def found_alone(self) -> bool:
        """Return whether one picture is enough to say so."""
        return self.third >= LEAST_ALONE


def shaft_evidence(
    image: Image, fit: BandFit, shape: NeedleShape, weights: FloatArray, blur: float, noise: float
) -> ShaftEvidence:
    """Look for the shaft that carries a band.

    Args:
        image: the picture.
        fit: of the band.
        shape: of the needle.
        weights: of the colours in the strength of the marker's, shape (3,).
        blur: standard deviation of the point spread [px].
        noise: standard deviation of a grey value.
    """
    moved = np.array([fit.uv[0] - fit.outline.u, fit.uv[1] - fit.outline.v, *fit.stretch])
    red = float(weights @ fit.paint)
    steps = np.sort(
        differences(image, fit.outline, moved, shape, weights, red, blur, noise).ravel()
    )
    return ShaftEvidence(float(steps[-2]), float(steps[-3]))


def differences(
    image: Image,
    outline: Outline,
    moved: FloatArray,
    shape: NeedleShape,
    weights: FloatArray,
    red: float,
    blur: float,
    noise: float,
) -> FloatArray:
    """Return the significance of each pair of neighbouring zones, shape (ENDS, ZONES - 1).

    The end towards the hub comes first, and zones from the left of the outline to its right.

    Args:
        image: see `shaft_evidence`.
        outline: of the band.
        moved: see `gather_zones`.
        shape: see `shaft_evidence`.
        weights: likewise.
        red: strength of the band's colour [grey levels].
        blur: see `shaft_evidence`.
        noise: likewise.
    """
    sums, counts = np.empty((ENDS, PIECES, ZONES, 3)), np.empty((ENDS, PIECES, ZONES))
    steps = np.empty(STEPS)
    gather_zones(read_only(image[:]), outline, shape, moved, blur, sums, counts)
    shaft_steps(sums, counts, max(noise, 1.0), weights, red, steps)
    return steps.reshape(ENDS, ZONES - 1)
