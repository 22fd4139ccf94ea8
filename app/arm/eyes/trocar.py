"""The trocar in two pictures: a flat ring of known colour whose centre is the fulcrum.

A circle's picture is an ellipse, but the ellipse's centre is not the picture of the circle's: the
nearer half takes more room. So the circle itself is fitted: centre p, normal n and radius r in the
robot's frame, to the points of both pictures' outer outline. The ray a of such a point, from the
camera's place o, meets the circle's plane at

    X = o + t a,   t = n·(p - o) / n·a,   and misses the circle by |X - p| - r,

weighted by what a pixel makes of that. The covariance is that of this least squares fit, inflated
where points miss the circle by more than they say.

Only points of the outline on its convex hull are taken: where a tool crosses the ring, the outline
turns inwards.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, cross, read_only, unit
from app.core.units import DEGREE
from app.tracking.cameras.camera import Image
from app.tracking.confidence import chi_square_quantile
from app.tracking.markers.colour import ColourModel
from app.tracking.markers.extractor import Mask
from app.tracking.markers.outline_centroid import strengths
from app.tracking.optics.camera_model import CameraModel
from app.tracking.stereo.calibration_uncertainty import CalibrationUncertainty
from app.tracking.stereo.epipolar import normalised
from app.tracking.stereo.triangulation import StereoStatus, triangulate

BLUE: Final = ColourModel(bgr=(205.0, 95.0, 30.0), angle_deg=20.0)
"""Colour of the trocar of the simulated cameras."""

GRAZING: Final = 80.0 * DEGREE
"""Angle between a camera's view and the ring's normal from which on it is seen edge on [rad]."""

_EDGE_PX: Final = 0.3
"""Standard deviation of a point of the outline: it lies on whole pixels [px]."""

_AREA_MIN: Final = 60
_FEWEST: Final = 16
_FLAT: Final = 3.0
"""Least width of a ring's picture [px]."""

_OUTSIDE: Final = 0.75
"""How far inside the hull a point of the outline may be [px]."""

_STEPS: Final = 20
_RADIUS_OFF: Final = 0.15
_BESIDE: Final = 0.3
"""Largest distance of the centre from where the middles of both pictures meet, in radii."""

_INCLINED: Final = 0.7
"""Tangent of the inclination of the normals to begin with."""

_FIT: Final = chi_square_quantile(1.0 - 1e-3, 1)
_HALF_OF_THEM: Final = chi_square_quantile(0.5, 1)
_GOOD_COST: Final = 2.0
_LARGEST_COST: Final = 5.0
"""Mean squared distance of all points from a circle, in variances and each at most `_FIT`: so good
that no other is looked for; more than which is no circle.
"""

_SQUARE3: Final = np.ones((3, 3), np.uint8)


class TrocarStatus(StrEnum):
    """What became of two pictures of the trocar."""

    FOUND = "found"
    NOTHING = "nothing in the trocar's colour"
    CUT = "the picture's edge cuts the trocar"
    GRAZING = "the trocar is seen edge on"
    NOT_A_RING = "what has the trocar's colour is no circle, or not of its size"
    DEGENERATE = "the two pictures show no common place"


@dataclass(frozen=True, slots=True, eq=False)
class TrocarFix:
    """The ring in the robot's frame; numbers mean something only for `found`.

    Attributes:
        status: see `TrocarStatus`.
        p_world: its centre, the fulcrum [m], shape (3,).
        covariance: of it [m²], shape (3, 3).
        normal_world: unit vector towards the cameras, shape (3,).
        radius: of the outer rim [m].
        rms_px: root mean square distance of the outline from the circle's picture.
    """

    status: TrocarStatus
    p_world: FloatArray
    covariance: FloatArray
    normal_world: FloatArray
    radius: float = 0.0
    rms_px: float = 0.0


def ring_outline(image: Image, colour: ColourModel = BLUE) -> FloatArray | TrocarStatus:
    """Return points of the ring's outer outline [px], shape (n, 2), or why there are none."""
    strength = strengths(image, colour)
    mask = np.asarray(strength > colour.strength, np.uint8)
    count, labels, statistics, _ = cv2.connectedComponentsWithStats(mask)
    kept = np.zeros(count, np.uint8)
    least = max(_AREA_MIN, int(0.2 * statistics[1:, cv2.CC_STAT_AREA].max(initial=0)))
    for k in range(1, count):
        x, y, w, h, area = statistics[k]
        box = slice(y, y + h), slice(x, x + w)
        inside = np.asarray(labels[box] == k, np.uint8)
        kept[k] = area >= least and colour.is_marker(np.array(cv2.mean(image[box], inside)[:3]))
    if not kept.any():
        return TrocarStatus.NOTHING
    ring = kept[labels]
    level = 0.5 * float(np.percentile(strength[ring > 0], 80))
    return _outer(np.asarray(ring & (strength > level), np.uint8))


def _outer(ring: Mask) -> FloatArray | TrocarStatus:
    height, width = ring.shape
    outlines = cv2.findContours(ring, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)[0]
    points = np.concatenate([outline[:, 0] for outline in outlines])
    x, y, w, h = cv2.boundingRect(points)
    if x <= 0 or y <= 0 or x + w >= width or y + h >= height:
        return TrocarStatus.CUT
    hull = cv2.convexHull(points)
    if min(cv2.minAreaRect(hull)[1]) < _FLAT:
        return TrocarStatus.GRAZING
    depths = [cv2.pointPolygonTest(hull, (float(u), float(v)), True) for u, v in points]
    found = points[np.array(depths) < _OUTSIDE].astype(np.float64)
    return found if len(found) >= _FEWEST else TrocarStatus.NOT_A_RING


def solve_trocar(
    models: tuple[CameraModel, CameraModel],
    outlines: tuple[FloatArray, FloatArray],
    radius: float | None = None,
    systematic_px: float = 0.05,
    uncertainty: CalibrationUncertainty | None = None,
) -> TrocarFix:
    """Fit the circle that both outlines show.

    Args:
        models: both cameras in the robot's frame.
        outlines: points of the outer outline in each picture [px], (n, 2).
        radius: of the outer rim as far as known [m]: another size is refused.
        systematic_px: what calibration and outline leave besides noise, of the centre [px].
        uncertainty: of a calibrated pair of cameras; adds what the calibration does not know.
    """
    pixels = [(m, *m.undistort(uv)) for m, uv in zip(models, outlines, strict=True)]
    if not all(found.all() for _, _, found in pixels):
        return no_trocar(TrocarStatus.DEGENERATE)
    start = _start(models, outlines, systematic_px)
    if start is None:
        return no_trocar(TrocarStatus.DEGENERATE)
    p_start, systematic, seen = start
    outline = _Rays.of([(model, rays) for model, rays, _ in pixels])
    best = outline.best(p_start, _normals(models, p_start))
    if best is None or not outline.faces(best.normal, GRAZING - 2.0 * DEGREE):
        return no_trocar(TrocarStatus.GRAZING)
    off = radius is not None and abs(best.radius - radius) > _RADIUS_OFF * radius
    beside = float(np.linalg.norm(best.p_world - p_start)) > _BESIDE * best.radius
    if off or beside or not best.cost < _LARGEST_COST:
        return no_trocar(TrocarStatus.NOT_A_RING)
    covariance = best.covariance + systematic
    if uncertainty is not None:
        covariance = covariance + uncertainty.covariance(best.p_world, seen)
    towards = np.mean([unit(m.centre - best.p_world) for m in models], axis=0)
    sign = 1.0 if float(towards @ best.normal) >= 0.0 else -1.0
    return TrocarFix(
        TrocarStatus.FOUND,
        read_only(best.p_world),
        read_only(covariance),
        read_only(sign * best.normal),
        best.radius,
        best.rms_px,
    )


def _start(
    models: tuple[CameraModel, CameraModel],
    outlines: tuple[FloatArray, FloatArray],
    systematic_px: float,
) -> tuple[FloatArray, FloatArray, FloatArray] | None:
    """Middle of both outlines as a point: where to begin; its covariance, and that of its rays."""
    middles = [0.5 * (uv.min(axis=0) + uv.max(axis=0)) for uv in outlines]
    noise = systematic_px**2 * np.eye(2)
    rays = [normalised(m, uv, noise) for m, uv in zip(models, middles, strict=True)]
    if rays[0] is None or rays[1] is None:
        return None
    observations = np.stack([rays[0][0], rays[1][0]])
    covariances = np.stack([rays[0][1], rays[1][1]])
    poses = models[0].T_camera_world, models[1].T_camera_world
    found = triangulate(poses, observations, covariances)
    if found.status is not StereoStatus.FOUND:
        return None
    return found.p_world, found.covariance, covariances


def _normals(models: tuple[CameraModel, CameraModel], p_world: FloatArray) -> list[FloatArray]:
    """Directions to begin with: between both cameras, and inclined to every side."""
    views = [unit(model.centre - p_world) for model in models]
    middle = unit(views[0] + views[1])
    side = unit(cross(middle, views[0] - views[1]))
    beside = cross(middle, side)
    return [middle] + [unit(middle + _INCLINED * way) for way in (side, -side, beside, -beside)]


@dataclass(frozen=True, slots=True, eq=False)
class _CircleFit:
    p_world: FloatArray
    normal: FloatArray
    radius: float
    covariance: FloatArray
    rms_px: float
    cost: float


@dataclass(frozen=True, slots=True, eq=False)
class _Rays:
    """Rays of an outline in world: directions a (n, 3), origins (n, 3), sizes of a pixel (n,), and
    the directions in which it moves a, (n, 2, 3).
    """

    rays: FloatArray
    origins: FloatArray
    sizes: FloatArray
    frames: FloatArray

    @classmethod
    def of(cls, seen: list[tuple[CameraModel, FloatArray]]) -> _Rays:
        """Take the normalised coordinates of each camera, (n, 2)."""
        turns = [model.T_world_camera.rotation for model, _ in seen]
        rays = [np.column_stack([xy, np.ones(len(xy))]) for _, xy in seen]
        return cls(
            np.concatenate([r @ turn.T for r, turn in zip(rays, turns, strict=True)]),
            np.concatenate([np.tile(model.centre, (len(xy), 1)) for model, xy in seen]),
            np.concatenate([np.sqrt(model.pixel_areas(xy)) for model, xy in seen]),
            np.concatenate(
                [
                    np.tile(turn[:, :2].T, (len(r), 1, 1))
                    for r, turn in zip(rays, turns, strict=True)
                ]
            ),
        )

    def best(self, p_world: FloatArray, normals: list[FloatArray]) -> _CircleFit | None:
        """Fit from several normals: one that is good ends it, for wrong ones do not fit both."""
        found: list[_CircleFit] = []
        for normal in normals:
            if self.faces(normal):
                found.append(self.fit(p_world, normal))
                if found[-1].cost < _GOOD_COST:
                    break
        return min(found, key=lambda fit: fit.cost, default=None)

    def faces(self, n: FloatArray, limit: float = GRAZING) -> bool:
        """Say whether both cameras see the plane no flatter than an angle from its normal [rad]."""
        facing = np.abs(self.rays @ n) / np.linalg.norm(self.rays, axis=1)
        return bool(facing.min() > np.cos(limit))

    def fit(self, p_world: FloatArray, normal: FloatArray) -> _CircleFit:
        """Gauss–Newton from a place and a normal; steps that do not help are halved."""
        p, n = p_world, normal
        radius = float(np.median(np.linalg.norm(self._points(p, n) - p, axis=1)))
        misses, by = self._residual(p, n, radius)
        keep = np.ones(len(misses), np.bool_)
        for number in range(_STEPS):
            cost = float(misses[keep] @ misses[keep])
            change = np.asarray(
                np.linalg.lstsq(by[keep], -misses[keep], rcond=1e-9)[0], dtype=np.float64
            )
            share, after = 1.0, np.inf
            while share > 1e-2 and not after <= cost:
                tried = self._moved(p, n, radius, share * change)
                share *= 0.5
                if self.faces(tried[1]):
                    tried_misses, tried_by = self._residual(*tried)
                    after = float(tried_misses[keep] @ tried_misses[keep])
            if not after <= cost:
                break
            (p, n, radius), misses, by = tried, tried_misses, tried_by
            if number >= 3:  # by then what does not fit the circle stands out
                keep = self._fitting(misses)
            if number > 5 and cost - after < 1e-4 * cost:
                break
        keep = self._fitting(misses)
        spread = np.asarray(
            np.linalg.pinv(by[keep].T @ by[keep], rcond=1e-12, hermitian=True), dtype=np.float64
        )
        square = float(misses[keep] @ misses[keep])
        factor = max(1.0, square / max(1, int(keep.sum()) - 6))
        rms_px = _EDGE_PX * float(np.sqrt(square / max(1, int(keep.sum()))))
        cost = float(np.minimum(misses**2, _FIT).mean())
        return _CircleFit(p, n, radius, factor * spread[:3, :3], rms_px, cost)

    @staticmethod
    def _fitting(misses: FloatArray) -> NDArray[np.bool_]:
        """Say which points fit; at least half of them, by their median."""
        scale = max(1.0, float(np.median(misses**2)) / _HALF_OF_THEM)
        return np.asarray(misses**2 < _FIT * scale)

    def _points(self, p: FloatArray, n: FloatArray) -> FloatArray:
        return np.asarray(self.origins + self._depths(p, n)[:, None] * self.rays)

    def _depths(self, p: FloatArray, n: FloatArray) -> FloatArray:
        facing = self.rays @ n
        facing = np.where(np.abs(facing) > 1e-6, facing, 1e-6)
        return np.asarray(((p - self.origins) @ n) / facing)

    def _residual(
        self, p: FloatArray, n: FloatArray, radius: float
    ) -> tuple[FloatArray, FloatArray]:
        """Distances from the circle over their deviations, (n,), by p, n's turn and r, (n, 6)."""
        facing = self.rays @ n
        facing = np.where(np.abs(facing) > 1e-6, facing, 1e-6)
        t = ((p - self.origins) @ n) / facing
        away = self.origins + t[:, None] * self.rays - p
        gaps = np.maximum(np.linalg.norm(away, axis=1), 1e-12)
        out = away / gaps[:, None]
        along = np.einsum("ni,ni->n", out, self.rays) / facing
        # t moves by (n·δp - δn·(X - p)) / n·a; a pixel moves a, and with it X.
        first, second = _two_across(n)
        by_p = along[:, None] * n - out
        by_n = -along[:, None] * np.column_stack([away @ first, away @ second])
        turned = np.einsum("nki,ni->nk", self.frames, out - along[:, None] * n)
        sds = np.maximum(_EDGE_PX * self.sizes * np.abs(t) * np.linalg.norm(turned, axis=1), 1e-9)
        by = np.column_stack([by_p, by_n, -np.ones(len(t))]) / sds[:, None]
        return (gaps - radius) / sds, by

    @staticmethod
    def _moved(
        p: FloatArray, n: FloatArray, radius: float, change: FloatArray
    ) -> tuple[FloatArray, FloatArray, float]:
        first, second = _two_across(n)
        return (
            p + change[:3],
            unit(n + change[3] * first + change[4] * second),
            radius + float(change[5]),
        )


def _two_across(n: FloatArray) -> tuple[FloatArray, FloatArray]:
    first = unit(cross(n, np.eye(3)[int(np.argmin(np.abs(n)))]))
    return first, cross(n, first)


def no_trocar(status: TrocarStatus) -> TrocarFix:
    """Return that there is none, and why."""
    zero = read_only(np.zeros(3))
    return TrocarFix(status, zero, read_only(np.zeros((3, 3))), zero)
