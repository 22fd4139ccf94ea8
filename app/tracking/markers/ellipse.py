"""Marker extraction by an ellipse through the edge of the band (contour and ellipse fit).

From the centroid of the outline rays go outwards; the edge lies on a ray where the strength of the
marker's colour (see `colour`) falls through half of what it is just inside, to a fraction of a
pixel. A conic goes through these points by least squares; its centre is the answer.

The band is no ellipse: its outline has two straight sides and two arcs, and a shaft leaves it at
both ends. The centre is that of an ellipse through such an outline, near the outline's centroid, so
`silhouette.centroid_shift` applies to it (with less right: see docs/tracking.md). For a flat round
marker the centre of its ellipse is not the picture of its centre either: perspective moves it
by about f·r²·tan(lean)/distance², 0.005 px for a radius of 1 mm at 0.4 m with f = 800 px: nothing.
"""

from dataclasses import dataclass, field
from typing import Any, Final

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.tracking.cameras.camera import Image
from app.tracking.markers.band_area import judged_by_area
from app.tracking.markers.extractor import (
    Extractor,
    ExtractorSetup,
    Hint,
    MarkerFix,
    Mask,
    Miss,
    MissReason,
)
from app.tracking.markers.outline_centroid import OutlineCentroid, outline_of

DECLARATION: Final[dict[str, Any]] = {"title": "Centre of an ellipse through the contour on rays"}


_RAYS = 36
_STEP = 0.5
_ANGLES = 2.0 * np.pi * np.arange(_RAYS) / _RAYS
_DIRECTIONS = np.column_stack([np.cos(_ANGLES), np.sin(_ANGLES)])

_INSIDE = (6, 3)
"""Steps before the edge over whose samples the strength inside is the mean."""

_SAMPLE_VARIANCE = 0.5
"""Variance of a half level's crossing over that of a pixel: interpolation between four pixels
leaves 4/9 on average, the mean level inside adds the rest."""


@dataclass(frozen=True)
class EllipseMarker(Extractor):
    """Edge points on rays from the outline's centroid, and the conic through them.

    Attributes:
        coarse: finds where to begin; its limits of the area hold for the ellipse too.
        flattest: least ratio of the axes.
        rough: largest RMS distance of the edge from the ellipse, over its mean radius.
        seen: least share of rays with an edge.
    """

    coarse: OutlineCentroid = field(default_factory=OutlineCentroid)
    flattest: float = 0.3
    rough: float = 0.16
    seen: float = 0.85
    region: int = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "region", self.coarse.region)

    def find(self, image: Image, hint: Hint) -> MarkerFix | Miss:
        """See `Extractor.find`."""
        outline = self.coarse.find(image, hint)
        if isinstance(outline, Miss) or self.coarse.model is None or self.coarse.shape is None:
            return outline if isinstance(outline, Miss) else self._fit(image, outline)
        shown = judged_by_area(outline, self.coarse.model, self.coarse.shape, hint)
        fit = shown if isinstance(shown, Miss) else self._fit(image, outline)
        if isinstance(shown, Miss) or isinstance(fit, Miss):
            return fit
        return fit.with_covariance(fit.covariance + shown.covariance - outline.covariance)

    def search(self, image: Image) -> tuple[MarkerFix | Miss, ...]:
        """Fit an ellipse to all that the coarse search finds."""
        found = [
            one if isinstance(one, Miss) else self._fit(image, one)
            for one in self.coarse.search(image)
        ]
        return tuple(sorted(found, key=lambda one: isinstance(one, Miss)))

    def mask(self, image: Image) -> Mask:
        """See `Extractor.mask`."""
        return self.coarse.mask(image)

    def _fit(self, image: Image, start: MarkerFix) -> MarkerFix | Miss:
        weights = self.coarse.colour.weights
        points, slopes = _edge(image, start, weights)
        if len(points) < self.seen * _RAYS:
            return Miss(MissReason.WRONG_SHAPE, start.uv)
        scale = float(np.sqrt(start.area / np.pi))
        conic = fit_conic(points / scale, _directions(points))
        if conic is None:
            return Miss(MissReason.WRONG_SHAPE, start.uv)
        area = scale**2 * conic.area
        if area < self.coarse.area_min:
            return Miss(MissReason.TOO_SMALL, start.uv)
        if area > self.coarse.area_max:
            return Miss(MissReason.TOO_LARGE, start.uv)
        if conic.ratio < self.flattest or conic.roughness > self.rough:
            return Miss(MissReason.WRONG_SHAPE, start.uv)
        strength = self.coarse.noise_grey**2 * float(weights @ weights)
        variances = _SAMPLE_VARIANCE * strength / slopes**2
        covariance = (conic.gain * variances) @ conic.gain.T  # the gain has no unit
        return MarkerFix(
            start.uv + scale * conic.centre,
            covariance + 1e-8 * np.eye(2),
            area,
            len(points) / _RAYS,
        )


@dataclass(frozen=True, slots=True, eq=False)
class Conic:
    """An ellipse through points.

    Attributes:
        centre: shape (2,).
        area: within it.
        ratio: of the shorter axis to the longer.
        roughness: RMS distance of the points from it along the rays, over their distance.
        gain: of the centre by the distance of each point along its direction, shape (2, n).
    """

    centre: FloatArray
    area: float
    ratio: float
    roughness: float
    gain: FloatArray


def fit_conic(points: FloatArray, directions: FloatArray) -> Conic | None:
    """Fit A x² + B xy + C y² + D x + E y = 1 by least squares; None if that is no ellipse.

    The gain is the derivative of the least squares themselves, residuals included: with rows m(p),
    N = MᵀM, residual r and g = ∂m/∂ε along the direction, ∂θ/∂ε = N⁻¹ (g·r - m·(gᵀθ)).

    Args:
        points: round the origin, at distances of about 1, shape (n, 2).
        directions: in which each point is uncertain, unit vectors, shape (n, 2).
    """
    if len(points) < 6:
        return None
    (x, y), (dx, dy) = points.T, directions.T
    rows = np.column_stack([x * x, x * y, y * y, x, y])
    moved = np.column_stack([2.0 * x * dx, x * dy + y * dx, 2.0 * y * dy, dx, dy])
    normal = rows.T @ rows
    if not np.linalg.cond(normal) < 1e10:
        return None
    theta = np.linalg.solve(normal, rows.sum(axis=0))
    form = np.array([[theta[0], 0.5 * theta[1]], [0.5 * theta[1], theta[2]]])
    sizes = np.linalg.eigvalsh(form)
    if not sizes[0] > 1e-6:
        return None
    centre = -0.5 * np.linalg.solve(form, theta[3:])
    level = 1.0 + float(centre @ form @ centre)
    residuals = 1.0 - rows @ theta
    by_point = np.linalg.solve(normal, moved.T * residuals - rows.T * (moved @ theta))
    # form·c = -½·(D, E): ∂c = -form⁻¹ (∂form·c + ½·∂(D, E))
    turned = np.array(
        [
            by_point[0] * centre[0] + 0.5 * by_point[1] * centre[1] + 0.5 * by_point[3],
            0.5 * by_point[1] * centre[0] + by_point[2] * centre[1] + 0.5 * by_point[4],
        ]
    )
    away = points - centre
    distance = np.sqrt(np.einsum("ij,jk,ik->i", away, form, away) / level)
    return Conic(
        centre,
        float(np.pi * level / np.sqrt(sizes[0] * sizes[1])),
        float(np.sqrt(sizes[0] / sizes[1])),
        float(np.sqrt(np.mean((distance - 1.0) ** 2))),
        -np.linalg.solve(form, turned),
    )


def _directions(points: FloatArray) -> FloatArray:
    return np.asarray(points / np.linalg.norm(points, axis=1, keepdims=True))


def _edge(image: Image, start: MarkerFix, weights: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Edge points relative to the start [px], (n, 2), and the strength's slope there [1/px], (n,).

    On each ray the first fall through half of the middle's strength is found, then that through
    half of the mean just before it, linear between two samples.
    """
    steps = int(np.ceil(1.6 * np.sqrt(start.area) / _STEP)) + _INSIDE[0]
    reach = _STEP * np.arange(steps)
    place = (start.uv + reach[:, None, None] * _DIRECTIONS).astype(np.float32)
    samples = cv2.remap(
        np.ascontiguousarray(image).astype(np.float32),
        place[..., 0],
        place[..., 1],
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REPLICATE,
    )
    strength = np.asarray(samples, dtype=np.float64) @ weights
    rays = np.arange(_RAYS)
    last, _ = _fall(strength, np.full(_RAYS, 0.5 * np.median(strength[:6])))
    inside = np.clip(last - np.arange(_INSIDE[1], _INSIDE[0] + 1)[:, None], 0, None)
    level = 0.5 * strength[inside, rays].mean(axis=0)
    last, found = _fall(strength, level)
    above, under = strength[last, rays], strength[last + 1, rays]
    fall = above - under
    found &= fall > 1.0
    fraction = (above - level) / np.where(found, fall, 1.0)
    distance = _STEP * (last + fraction)
    near = np.clip(last - 1, 0, None)
    far = np.clip(last + 2, None, steps - 1)
    slope = (strength[near, rays] - strength[far, rays]) / (_STEP * (far - near))
    found &= slope > 1.0
    return (distance[:, None] * _DIRECTIONS)[found], slope[found]


def _fall(strength: FloatArray, level: FloatArray) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
    """Last sample of each ray before the strength falls below a level, and whether it does."""
    below = strength < level
    last = np.argmax(below, axis=0) - 1
    found = below.any(axis=0) & (last >= 0)
    return np.clip(last, 0, len(strength) - 2), found


def extractor(setup: ExtractorSetup) -> Extractor:
    """Build the extractor of a camera."""
    return EllipseMarker(outline_of(setup, rough=True))
