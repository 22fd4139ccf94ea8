"""Marker extraction by fitting the band's whole picture (see `band.fit`).

The centroid of the outline says where to begin; the fit then weighs every pixel as its noise
deserves. It needs the needle's axis: without one the centroid is handed out. A fit that leaves
pixels over, or finds another width or length than the band has, is a band partly hidden, lit by a
highlight, or none at all; one without the bare shaft beside it is another red thing. What little
misfit is let pass enlarges the covariance.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray, read_only, unit
from app.tracking.band.delivered_fit import keeps_all_colour
from app.tracking.band.fit import MISFIT, MORE, BandFit, BandFitter, alternatives
from app.tracking.band.tone import LINEAR, SRGB, ToneMemory
from app.tracking.cameras.camera import Image
from app.tracking.markers.bare_shaft import shaft_evidence
from app.tracking.markers.extractor import (
    Centre,
    Extractor,
    ExtractorSetup,
    Hint,
    MarkerFix,
    Mask,
    Miss,
    MissReason,
    Nearest,
)
from app.tracking.markers.occluded_fit import OccludedBandFit
from app.tracking.markers.outline_centroid import OutlineCentroid, outline_of
from app.tracking.markers.silhouette import centroid_shift
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleShape

DECLARATION: Final[dict[str, Any]] = {"title": "Least squares of the band's whole picture"}


_USUAL_MISFIT, _USUAL_OUTLIERS = 1.1, 0.005
_MISFIT_PX2, _OUTLIERS_PX2 = 0.008, 0.02
"""Variance [px²] per unit of misfit and of outliers beyond the usual."""

_STRETCH, _USUAL_STRETCH_PX = 0.27, 0.015
"""Variance per squared error of half the width and half the length, beyond what noise makes.

What hides one side of the band, or an edge behind it taken for its outline, moves the centre by as
much as it changes half the width or length. Both lines were chosen together, so that on
10 200 pairs over the workspace of rig `wide` (a third each clean, under fingers, under highlights)
the ellipsoid of 95 % held the truth in 95 % of each kind; tests/bench/bench_marker.py measures it
on other pairs."""

_AGREES_PX, _AGREES, _CLOSE_PX = 2.5, 0.3, 1.0
"""How far the prediction may be from the patch's mean pixel [px, or of half the band's length], and
from what the fit makes of it [px]. The mean pixel is off itself by 1.5 px on a band 16 px wide (the
darker flank is not strong enough), by 0.28 of half the length where an end faces the camera."""

_QUALITY_ALONE, _ALONE_PX = 0.85, 0.1
"""Least quality and largest standard deviation [px] of a find that no other picture confirms."""

CurveFit = Callable[[float, bool], BandFit | None]
"""Fits a delivered picture: with the exponent of a tone curve, and whether the paint is glossy."""

_ONE = np.eye(2)
_AS_NOISY: Final = 1.5
"""What a fit of light that adds up may leave, over the noise of the picture [variances]."""

_HALF: Final = 24
"""What is looked at about a band for its picture's noise and the colours' resolution [px]."""

_CLEARLY: Final = 30.0
"""Logarithm of the likelihoods' ratio from which a picture has no tone curve."""

_WIDER: Final = 0.06
_LONGER: Final = 0.04
"""By how much width and length may be off in a delivered picture, relative: its blur is free, so
that a straight edge over the band's side or end leaves hardly anything else."""

_FLOOR_PX: Final = 0.015
_STRETCH_SHARE, _STRETCH_BEYOND, _ORDINARY_STRETCH_PX = 0.03, 0.12, 0.2
"""Like `floor_px` and `_STRETCH`, in a delivered picture: width and length are off by so much in
ordinary ones without moving the centre; beyond, something hides a part of the band."""

_BLURRED: Final = 0.0006
"""Variance of the centre per variance of the blur beyond the rig's, in its direction: light and
speed are not the same throughout an exposure, so that its middle is not quite the motion's."""


@dataclass(frozen=True)
class ModelFit(Extractor):
    """Fit of the band's picture, begun at its centroid.

    Attributes:
        model: the camera.
        shape: of the needle.
        blur_px: standard deviation of the point spread.
        coarse: finds where to begin.
        outliers_max: share of the band that may be left out.
        misfit_max: largest mean square residual of the band [noise variances].
        stretch_max: relative difference of width or length from the band's.
        floor_px: standard deviation of what the model does not have and no misfit shows.
    """

    model: CameraModel
    shape: NeedleShape
    blur_px: float
    coarse: OutlineCentroid = field(default_factory=OutlineCentroid)
    outliers_max: float = 0.06
    misfit_max: float = 1.7
    stretch_max: float = 0.10
    floor_px: float = 0.004
    region: int = field(init=False)
    fitter: BandFitter = field(init=False)
    tone: ToneMemory = field(default_factory=ToneMemory, init=False, compare=False)

    def __post_init__(self) -> None:
        fitter = BandFitter(self.model, self.shape, self.blur_px, self.coarse.noise_grey)
        object.__setattr__(self, "fitter", fitter)
        object.__setattr__(self, "region", self.coarse.region)

    def find(self, image: Image, hint: Hint) -> MarkerFix | Miss:
        """See `Extractor.find`."""
        if (followed := self._followed(image, hint)) is not None:
            return followed
        found = self.coarse.find(image, hint)
        axis = self._axis(hint.axis_world)
        if isinstance(found, Miss) or axis is None:
            return found
        return self._fit(image, found, axis, hint.p_world)

    def search(self, image: Image) -> tuple[MarkerFix | Miss, ...]:
        """Outlines' centroids: the fit comes with the axis, in `find`."""
        return self.coarse.search(image)

    def find_occluded(
        self, image: Image, axis_world: FloatArray, nearest: Nearest
    ) -> MarkerFix | Miss:
        """See `Extractor.find_occluded`."""
        axis = self._axis(axis_world)
        if axis is None:
            return Miss(MissReason.PARTLY_HIDDEN)
        hidden = OccludedBandFit(self.model, self.shape, self.fitter, self.coarse)
        return hidden.find(image, axis, nearest, self.tone.likely)

    def mask(self, image: Image) -> Mask:
        """See `Extractor.mask`."""
        return self.coarse.mask(image)

    def _followed(self, image: Image, hint: Hint) -> MarkerFix | None:
        """Fit begun at the prediction; None if that is not known or gives no marker.

        The mean pixel of the patch only has to agree with the prediction. What a fit does not
        take, or moves far, is looked at again from the centroid.
        """
        axis = self._axis(hint.axis_world)
        if hint.p_world is None or axis is None or not hint.finite:
            return None
        middle = self.coarse.patch_centre(image, hint.uv)
        pose = self.model.T_camera_world
        depth = float(pose.rotation[2] @ hint.p_world + pose.translation[2])
        if middle is None or not depth > 4.0 * self.shape.half:
            return None
        start = self._at(hint.uv, depth)
        if start is None:
            return None
        room = max(_AGREES_PX, _AGREES * self._half_px(start, axis)[1])
        if not _farthest(middle, hint.uv) < room:
            return None
        fit = self._weighed(image, start, axis)
        if isinstance(fit, Miss):
            return None
        if not self.coarse.area_min <= fit.area <= self.coarse.area_max:
            return None
        return fit if _farthest(fit.uv, hint.uv) < _CLOSE_PX else None

    def _axis(self, axis_world: FloatArray | None) -> FloatArray | None:
        """Carry the axis into the camera frame, at length one; None where it is not known."""
        if axis_world is None:
            return None
        length = math.hypot(*axis_world.tolist())
        if not 0.0 < length < math.inf:
            return None
        return self.model.T_camera_world.rotation @ (axis_world / length)

    def _at(self, uv: FloatArray, depth: float) -> FloatArray | None:
        """Point of the camera frame that a pixel shows at a depth [m], shape (3,)."""
        ray = self.model.ray(uv)
        return None if ray is None else np.array([ray[0] * depth, ray[1] * depth, depth])

    def _fit(
        self, image: Image, result: MarkerFix, axis: FloatArray, p_world: FloatArray | None
    ) -> MarkerFix | Miss:
        start = self._start(result, axis, p_world)
        if start is None:
            return Miss(MissReason.WRONG_SHAPE, result.uv)
        return self._weighed(image, start, axis)

    def _weighed(self, image: Image, start: FloatArray, axis: FloatArray) -> MarkerFix | Miss:
        """Fit and judge: as light that adds up, unless the picture was delivered otherwise."""
        uv = self.model.pixel(self.model.T_world_camera @ start)
        if uv is None:
            return Miss(MissReason.WRONG_SHAPE)
        full = keeps_all_colour(read_only(image[:]), uv[0], uv[1], _HALF)
        light = self._as_light(image, uv, start, axis) if full else None
        if isinstance(light, MarkerFix):
            return light
        self.tone.age += 1
        delivered = self._delivered(image, start, axis)
        if isinstance(delivered, MarkerFix):
            return delivered
        if not full:  # smooth colours without noise look as if a decoder had filled them in
            light = self._as_light(image, uv, start, axis)
            if isinstance(light, MarkerFix):
                return light
        return (light if full else delivered) or Miss(MissReason.PARTLY_HIDDEN, uv)

    def _as_light(
        self, image: Image, uv: FloatArray, start: FloatArray, axis: FloatArray
    ) -> MarkerFix | Miss | None:
        """Fit as light that adds up; None where that leaves more than the picture's noise."""
        fit = self.fitter.fit(image, start, axis)
        if fit is None:
            return None
        judged = self._judged(image, fit, start, axis)
        left = fit.misfit * self.coarse.noise_grey**2
        least = (0.5 * self.coarse.noise_grey) ** 2
        if isinstance(judged, MarkerFix) and left > _AS_NOISY * max(
            least, noise_variance(image, uv, _HALF)
        ):
            return None
        return judged

    def _delivered(
        self, image: Image, start: FloatArray, axis: FloatArray
    ) -> MarkerFix | Miss | None:
        """Fit a delivered picture; state how far off the band is by a curve that may be as well."""
        fits: list[BandFit] = []

        def fit(gamma: float, glossy: bool) -> BandFit | None:
            result = self.fitter.fit_delivered(image, start, axis, gamma, glossy)
            fits.extend(() if result is None else (result,))
            return result

        judged = self._by_a_curve(fit, image, start, axis)
        return _with_alternatives(judged, fits) if isinstance(judged, MarkerFix) else judged

    def _by_a_curve(
        self, fit: CurveFit, image: Image, start: FloatArray, axis: FloatArray
    ) -> MarkerFix | Miss | None:
        """Fit with a camera's tone curve, or with none where that leaves clearly less."""
        memory = self.tone
        plain: BandFit | None = None
        if memory.known(LINEAR):
            plain = fit(LINEAR, False)
            judged = self._judged_delivered(image, plain, start, axis)
            if isinstance(judged, MarkerFix):
                return judged
        matt = fit(SRGB, False)
        first = self._judged_delivered(image, matt, start, axis)
        if isinstance(first, MarkerFix) and memory.known(SRGB):
            return first
        if plain is None and not memory.known(SRGB):
            plain = fit(LINEAR, False)
        shiny: BandFit | None = None
        if not isinstance(first, MarkerFix) or _clearly_less(plain, matt):
            shiny = fit(SRGB, True)
        curved = min((f for f in (matt, shiny) if f is not None), key=_cost_of, default=None)
        second = self._judged_delivered(image, shiny, start, axis)
        if plain is not None and curved is not None:
            straight = self._judged_delivered(image, plain, start, axis)
            if isinstance(straight, MarkerFix) or isinstance(first, MarkerFix):
                memory.learn(curved.cost - plain.cost)
            if _clearly_less(plain, curved):
                return straight
        if isinstance(first, MarkerFix) and not (
            isinstance(second, MarkerFix) and _clearly_less(shiny, matt)
        ):
            return first
        return first if second is None else second

    def _judged_delivered(
        self, image: Image, fit: BandFit | None, start: FloatArray, axis: FloatArray
    ) -> MarkerFix | Miss | None:
        return None if fit is None else self._judged(image, fit, start, axis, delivered=True)

    def _judged(
        self,
        image: Image,
        fit: BandFit,
        start: FloatArray,
        axis: FloatArray,
        delivered: bool = False,
    ) -> MarkerFix | Miss:
        """Return whether the fit is of the band, and the band on a shaft; if so, how far to trust
        it.
        """
        if (reason := self._refused(fit, delivered)) is not None:
            return Miss(reason, fit.uv)
        colour, noise = self.coarse.colour, self.coarse.noise_grey
        shaft = shaft_evidence(image, fit, self.shape, colour.weights, self.blur_px, noise)
        if not shaft.found:
            return Miss(MissReason.NO_SHAFT, fit.uv)
        inflation = max(1.0, fit.misfit)
        if delivered:
            covariance = MORE * fit.covariance + self._doubt_delivered(fit, start, axis)
        else:
            covariance = inflation * fit.covariance + self._doubt(fit, start, axis) * _ONE
        quality = (1.0 - fit.outliers) / inflation
        alone = shaft.found_alone and quality >= _QUALITY_ALONE
        alone = alone and float(covariance[0, 0] + covariance[1, 1]) <= _ALONE_PX**2
        return MarkerFix(fit.uv, covariance, fit.area, quality, Centre.BAND, alone)

    def _refused(self, fit: BandFit, delivered: bool) -> MissReason | None:
        if not self.coarse.colour.is_marker(fit.paint):
            return MissReason.NOTHING_RED
        if fit.outliers > self.outliers_max or fit.misfit > (
            MISFIT if delivered else self.misfit_max
        ):
            return MissReason.PARTLY_HIDDEN
        width, length = fit.stretch.tolist()
        if delivered and (abs(width - 1.0) > _WIDER or abs(length - 1.0) > _LONGER):
            return MissReason.PARTLY_HIDDEN
        if max(abs(width - 1.0), abs(length - 1.0)) > self.stretch_max:
            return MissReason.WRONG_SHAPE
        return None

    def _doubt(self, fit: BandFit, start: FloatArray, axis: FloatArray) -> float:
        """Variance of the centre beyond the fit's own, by what the model does not have [px²]."""
        return (
            self.floor_px**2
            + _MISFIT_PX2 * max(0.0, fit.misfit - _USUAL_MISFIT)
            + _OUTLIERS_PX2 * max(0.0, fit.outliers - _USUAL_OUTLIERS)
            + self._stretched(fit, start, axis)
        )

    def _doubt_delivered(self, fit: BandFit, start: FloatArray, axis: FloatArray) -> FloatArray:
        """Like `_doubt`, in a delivered picture, (2, 2): by stretch and blur [px²]."""
        (width, length), (wide, long) = fit.stretch.tolist(), self._half_px(start, axis)
        square = (wide * (width - 1.0)) ** 2 + (long * (length - 1.0)) ** 2
        beyond = max(0.0, square - _ORDINARY_STRETCH_PX**2)
        usual = _FLOOR_PX**2 + _STRETCH_SHARE * square + _STRETCH_BEYOND * beyond
        across, along = (_BLURRED * max(0.0, blur**2 - self.blur_px**2) for blur in fit.blur)
        eu, ev = fit.outline.eu, fit.outline.ev
        forward, aside = np.array([eu, ev]), np.array([-ev, eu])
        moved: FloatArray = along * np.outer(forward, forward) + across * np.outer(aside, aside)
        return usual * _ONE + moved

    def _stretched(self, fit: BandFit, start: FloatArray, axis: FloatArray) -> float:
        """Variance of the centre by what width and length are off [px²]."""
        (width, length), (wide, long) = fit.stretch.tolist(), self._half_px(start, axis)
        misfit = (wide * (width - 1.0)) ** 2 + (long * (length - 1.0)) ** 2
        return _STRETCH * max(0.0, misfit - _USUAL_STRETCH_PX**2)

    def _half_px(self, p_camera: FloatArray, axis: FloatArray) -> tuple[float, float]:
        """Half the width and half the length of the band's picture [px]."""
        fx, fy = self.model.intrinsics[:2].tolist()
        (x, y, z), (a, b, c) = p_camera.tolist(), axis.tolist()
        length = self.shape.half * math.hypot(fx * (a - c * x / z), fy * (b - c * y / z))
        return self.shape.radius * math.sqrt(fx * fy) / z, length / z

    def _start(
        self, result: MarkerFix, axis: FloatArray, p_world: FloatArray | None
    ) -> FloatArray | None:
        """Band's centre in the camera frame by the centroid and its distance [m], shape (3,)."""
        known = None if p_world is None else self.model.T_camera_world @ p_world
        direction = self._at(result.uv, 1.0)
        if direction is None:
            return None
        if known is not None and known[2] > 4.0 * self.shape.half:
            depth = float(known[2])
        else:
            sine = float(np.linalg.norm(np.cross(axis, unit(direction))))
            face = 4.0 * self.shape.radius * self.shape.half * max(sine, 0.2)
            focal = float(np.prod(self.model.intrinsics[:2]))
            depth = float(np.sqrt(focal * face / max(result.area, 1.0)))
        world = self.model.T_world_camera @ (depth * direction)
        shift = centroid_shift(
            self.model, self.shape, world, self.model.T_world_camera.rotate(axis)
        )
        return None if shift is None else self._at(result.uv - shift, depth)


def _cost_of(fit: BandFit) -> float:
    return fit.cost


def _with_alternatives(fix: MarkerFix, fits: list[BandFit]) -> MarkerFix:
    """Return the fix with what fits that are about as likely say otherwise in its covariance."""
    own = next(fit for fit in fits if np.array_equal(fit.uv, fix.uv))
    likely = [fit for fit in fits if fit.cost < own.cost + _CLEARLY]
    return fix.with_covariance(fix.covariance + alternatives(own, likely))


def _clearly_less(fit: BandFit | None, other: BandFit | None) -> bool:
    """Tell whether a fit is much likelier than another one."""
    return fit is not None and other is not None and fit.cost + _CLEARLY < other.cost


def noise_variance(image: Image, uv: FloatArray, half: int) -> float:
    """Variance of the grey values' noise about a pixel [levels²], by second differences."""
    u, v = (round(x) for x in uv.tolist())
    part = image[max(0, v - half) : v + half, max(0, u - half) : u + half].astype(np.float64)
    if min(part.shape[:2]) < 8:
        return 1.0
    second = np.abs(part[:, 2:] - 2.0 * part[:, 1:-1] + part[:, :-2]).reshape(-1, 3)
    middle = np.median(second, axis=0)  # whole numbers: the median lies somewhere in their bin
    below, at = (second < middle).mean(axis=0), (second == middle).mean(axis=0)
    middle = middle - 0.5 + (0.5 - below) / np.maximum(at, 1e-9)
    return max(1.0, float(np.mean((1.4826 * middle) ** 2)) / 6.0)


def _farthest(uv: FloatArray, other: FloatArray) -> float:
    """Larger of the distances of two pixels in u and v [px]."""
    (u, v), (a, b) = uv.tolist(), other.tolist()
    return max(abs(u - a), abs(v - b))


def extractor(setup: ExtractorSetup) -> Extractor:
    """Build the extractor of a camera."""
    return ModelFit(setup.model, setup.shape, setup.blur_px, outline_of(setup, rough=True))
