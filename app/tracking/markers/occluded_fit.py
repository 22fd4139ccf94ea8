"""Fit of a band of which something in front hides a part (see `occlusion`).

What may stand before it is tried side by side; a fit counts if the bare shaft is seen where the
band's visible end or flank is, if it lies on the robot's line as well as that is known, and if no
other side says anything else.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.band.fit import MISFIT, MORE, BandFit, BandFitter, alternatives
from app.tracking.band.outline import Outline, strips, trace
from app.tracking.cameras.camera import Image
from app.tracking.markers.bare_shaft import differences
from app.tracking.markers.extractor import Centre, MarkerFix, Miss, MissReason, Nearest
from app.tracking.markers.occlusion import OccludedSide, Occlusion, occlusions, paint_patches
from app.tracking.markers.outline_centroid import OutlineCentroid
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleShape

_STRETCH_SD: Final = 0.01
"""How well width and length are known on the robot's line, relative."""

_STRETCHED: Final = 0.025
_BLURRED_PX: Final = 0.35
_OUTLIERS: Final = 0.06
"""Limits of a fit: of its width and length, its blur beyond the lens' own, its residual and what is
left out. What hides a moving band is not told from its blur."""

_PROOF: Final = 10.0
"""Second largest difference across the shaft [variances] beside what is seen of the band."""

_ACROSS_PX: Final = 1.5
"""How far beside the robot's line a band may be."""

_ALIKE_PX: Final = 0.5
"""By how much fits with something on one side or another may differ."""

_FLOOR_PX: Final = 0.2
"""Standard deviation beside that of the fit: the edge of what hides the band is no straight line,
and its blur reaches farther than is left out in some pictures."""

_FLANK_PX: Final = 0.2
"""What is added across where a flank is hidden: one edge alone says where the band lies."""

_BLURS: Final = 2.0
"""Standard deviation of the centre for each pixel by which the blur along differs from that across:
one lens blurs both, so an edge that is softer or sharper is not the band's alone."""

_APART: Final = 0.3
"""Largest such difference of a band [px]."""

_FLANKS: Final = (OccludedSide.LEFT, OccludedSide.RIGHT)
_QUALITY: Final = 0.5


@dataclass(frozen=True)
class OccludedBandFit:
    """Finds a partly hidden band in one camera's pictures.

    Attributes:
        model: the camera.
        shape: of the needle.
        fitter: of the band.
        coarse: what the marker looks like: colour, area, noise and blur.
    """

    model: CameraModel
    shape: NeedleShape
    fitter: BandFitter
    coarse: OutlineCentroid

    def find(
        self, image: Image, axis: FloatArray, nearest: Nearest, gammas: tuple[float, ...]
    ) -> MarkerFix | Miss:
        """Return the first thing in the marker's colour that is a band behind something.

        Args:
            image: the picture.
            axis: unit vector from hub to tip in the camera frame, shape (3,).
            nearest: see `Extractor.find_occluded`.
            gammas: tone curves that the picture may have, the likeliest first.
        """
        for uv in paint_patches(image, self.coarse.colour, self.coarse.area_max):
            p_world = nearest(uv)
            if p_world is None:
                continue
            fix = self._at(image, self.model.T_camera_world @ p_world, axis, gammas)
            if fix is not None:
                return fix
        return Miss(MissReason.PARTLY_HIDDEN)

    def _at(
        self, image: Image, p_camera: FloatArray, axis: FloatArray, gammas: tuple[float, ...]
    ) -> MarkerFix | None:
        """Fit with each thing that may stand before the band about a point [m], shape (3,)."""
        camera = self.model
        count = strips(p_camera, self.shape, camera.intrinsics, self.coarse.blur_px)
        seen, outline = trace(
            p_camera, axis, self.shape, camera.intrinsics, camera.distortion, count
        )
        if not seen:
            return None
        fits: list[MarkerFix] = []
        candidates = occlusions(image, outline, self.coarse.colour)
        for occlusion in sorted(candidates, key=lambda occlusion: occlusion.mixed):
            if not self._proves(image, outline, occlusion):
                continue
            fit = self._fit(image, outline, occlusion, float(p_camera[2]), axis, gammas)
            if fit is None and not fits:  # what parts the colours best is not before the band
                return None
            if fit is not None:
                fits.append(fit)
        if not fits or any(np.abs(fit.uv - fits[0].uv).max() > _ALIKE_PX for fit in fits):
            return None
        return fits[0]

    def _proves(self, image: Image, outline: Outline, occlusion: Occlusion) -> bool:
        """Tell whether the shaft is bare beyond the visible end, or along the visible flank."""
        steps = differences(
            image,
            outline,
            np.array([*occlusion.shift, 1.0, 1.0]),
            self.shape,
            self.coarse.colour.weights,
            occlusion.strength,
            self.coarse.blur_px,
            self.coarse.noise_grey,
        )
        ends = {OccludedSide.HUB: steps[1], OccludedSide.TIP: steps[0]}
        largest = np.sort(ends.get(occlusion.side, steps).ravel())
        return float(largest[-3 if occlusion.side is OccludedSide.NOWHERE else -2]) >= _PROOF

    def _fit(
        self,
        image: Image,
        outline: Outline,
        occlusion: Occlusion,
        depth: float,
        axis: FloatArray,
        gammas: tuple[float, ...],
    ) -> MarkerFix | None:
        """Fit what a thing leaves visible of the band; None where that is not what the band is."""
        seen = self.model.ray(np.array([outline.u, outline.v]) + occlusion.shift)
        if seen is None:
            return None
        start = depth * np.array([seen[0], seen[1], 1.0])
        fits = []
        for gamma in gammas:
            both = [
                self.fitter.fit_delivered(
                    image, start, axis, gamma, glossy, occlusion.pixels, _STRETCH_SD
                )
                for glossy in (False, True)
            ]
            bands = [fit for fit in both if fit is not None and self._is_band(fit, outline)]
            fits += sorted(bands, key=lambda fit: fit.cost)
            if not fits:
                return None
        fit = fits[0]
        apart_px = abs(fit.blur[0] - fit.blur[1])
        covariance = MORE * fit.covariance
        covariance = covariance + (_FLOOR_PX**2 + (_BLURS * apart_px) ** 2) * np.eye(2)
        if occlusion.side in _FLANKS:
            across = np.array([-outline.ev, outline.eu])
            covariance = covariance + _FLANK_PX**2 * np.outer(across, across)
        covariance = covariance + alternatives(fit, fits[1:])
        return MarkerFix(
            fit.uv, covariance, fit.area, _QUALITY, Centre.BAND, alone=False, occluded=True
        )

    def _is_band(self, fit: BandFit, outline: Outline) -> bool:
        du, dv = (fit.uv - [outline.u, outline.v]).tolist()
        across = dv * outline.eu - du * outline.ev
        return (
            self.coarse.colour.is_marker(fit.paint)
            and fit.misfit <= MISFIT
            and fit.outliers <= _OUTLIERS
            and float(np.abs(fit.stretch - 1.0).max()) <= _STRETCHED
            and abs(across) <= _ACROSS_PX
            and max(fit.blur) <= self.coarse.blur_px + _BLURRED_PX
            and abs(fit.blur[0] - fit.blur[1]) <= _APART
        )
