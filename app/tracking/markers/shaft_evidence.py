"""Whether a red band is on a shaft: what tells the marker from every other red thing of its size.

A fit of the band alone is satisfied by a red ellipse, and in the middle of a red cloth by nothing
at all. So a find needs the bare shaft just beyond the band's ends (see `shaft_kernels`).

Of the eight differences the second largest decides. One edge of the background may lie along the
needle; two, on two of the lines and nowhere between, is rare (one place in ten before the housing,
one in a hundred in both pictures). A shaft has two outlines and a shading of its own, at two ends,
so a hand that hides one end, or a background as grey as the shaft on one side, leaves enough.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.tracking.cameras.camera import Image
from app.tracking.markers.band_fit import Outline
from app.tracking.markers.shaft_kernels import (
    ENDS,
    PIECES,
    STEPS,
    ZONES,
    gather_zones,
    shaft_steps,
)
from app.tracking.optics.rig import NeedleShape

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
        """Whether the band is on a shaft."""
        return self.second >= LEAST

    @property
    def found_alone(self) -> bool:
        """Whether one picture is enough to say so."""
        return self.third >= LEAST_ALONE


def shaft_evidence(
    image: Image,
    outline: Outline,
    shape: NeedleShape,
    uv: FloatArray,
    stretch: FloatArray,
    paint: FloatArray,
    weights: FloatArray,
    blur: float,
    noise: float,
) -> ShaftEvidence:
    """Look for the shaft that carries a band.

    Args:
        image: the picture.
        outline: of the band where it is about.
        shape: of the needle.
        uv: picture of the band's centre as fitted [px], shape (2,).
        stretch: width and length as fitted, over the expected, shape (2,).
        paint: mean colour of the band, shape (3,).
        weights: of the colours in the strength of the marker's, shape (3,).
        blur: standard deviation of the point spread [px].
        noise: standard deviation of a grey value.
    """
    frame = outline.frame
    sums, counts = np.empty((ENDS, PIECES, ZONES, 3)), np.empty((ENDS, PIECES, ZONES))
    moved, steps = np.array([*(uv - frame[:2]), *stretch]), np.empty(STEPS)
    gather_zones(read_only(image[:]), frame, outline.arcs, shape, moved, blur, sums, counts)
    shaft_steps(sums, counts, max(noise, 1.0), weights, float(weights @ paint), steps)
    steps.sort()
    return ShaftEvidence(float(steps[-2]), float(steps[-3]))
