"""Least squares of the band's picture: where it is, given its outline and the colours' model.

The colours are linear unknowns and are eliminated at every step (variable projection, Golub and
Pereyra 1973, with Kaufman's simplification of the Jacobian); the step in position, width and length
is Gauss-Newton's. Pixels that fit badly are left out.
"""

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.tracking.cameras.camera import Image
from app.tracking.markers.band_ground import CURVE, SIDE
from app.tracking.markers.band_minimum import RESULT, minimise
from app.tracking.markers.band_normal import REST
from app.tracking.markers.band_outline import ARCS, FRAME, outline, strips
from app.tracking.markers.band_pixels import surroundings
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleShape

_RIDGE = 1e-4
"""Prior of the colours: standard deviation of 100 times the noise."""

SHADING_PRIOR = np.array([0.0, 1.0, 1.0, *[0.15**-2] * 2, *[0.03**-2] * 2])
"""Prior of the paint's shading, relative to its mean: inverse squares of standard deviations."""

STRETCH_SD = 0.03
"""How well width and length are known beforehand, relative."""

_STIFF, _SOFT = 2.0, 25.0
"""Standard deviation of the background curve's second differences [noise]: even, with edges."""


@dataclass(frozen=True, slots=True, eq=False)
class Outline:
    """Where the band was taken to be, see `band_outline.outline`.

    Attributes:
        arcs: shape (ARCS, strips).
        frame: shape (FRAME,).
    """

    arcs: FloatArray
    frame: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class BandFit:
    """What the fit says.

    Attributes:
        uv: picture of the band's centre [px], shape (2,).
        covariance: of it if the model holds [px²], shape (2, 2).
        stretch: width and length over the expected, shape (2,).
        misfit: mean square residual over the noise's variance where the band is; 1 if it holds.
        outliers: share of the band's pixels that were left out.
        area: of the band [px²].
        paint: mean colour of the band [grey levels], blue, green, red, shape (3,).
        outline: the one that the fit began with.
    """

    uv: FloatArray
    covariance: FloatArray
    stretch: FloatArray
    misfit: float
    outliers: float
    area: float
    paint: FloatArray
    outline: Outline


class BandFitter:
    """Fits the band in one camera's pictures.

    Args:
        model: the camera.
        shape: of the needle.
        blur: standard deviation of the point spread [px].
        noise: standard deviation of a grey value.
        stretch_sd: how well width and length are known beforehand, relative.
    """

    def __init__(
        self,
        model: CameraModel,
        shape: NeedleShape,
        blur: float,
        noise: float,
        stretch_sd: float = STRETCH_SD,
    ) -> None:
        self._model = model
        self._shape = shape
        self._blur = blur
        self._noise = max(noise, 1.0)
        self._prior = 1.0 / stretch_sd**2

    def fit(self, image: Image, p_camera: FloatArray, axis_camera: FloatArray) -> BandFit | None:
        """Fit the band near where a point would be seen, or None if there is nothing to fit.

        Args:
            image: the picture.
            p_camera: the band's centre in the camera frame, about [m], shape (3,).
            axis_camera: unit vector from hub to tip, shape (3,).
        """
        count = strips(p_camera, self._shape, self._model.intrinsics, self._blur)
        arcs, frame = np.empty((ARCS, count)), np.empty(FRAME)
        if not outline(
            p_camera, axis_camera, self._shape, self._model.intrinsics, self._model.distortion,
            arcs, frame,
        ):  # fmt: skip
            return None
        box = np.empty(4, np.int64)
        height, width = image.shape[:2]
        if not surroundings(frame, arcs, height, width, box):
            return None
        result = np.empty(RESULT)
        if not minimise(
            read_only(image[:]), box, frame, arcs, self._shape, self._blur, self._noise,
            self._prior, _PRIORS, SHADING_PRIOR, result,
        ):  # fmt: skip
            return None
        return BandFit(
            uv=frame[:2] + result[:2],
            covariance=result[2:6].reshape(2, 2),
            stretch=result[6:8],
            misfit=float(result[8]),
            outliers=float(result[9]),
            area=float(result[10]),
            paint=result[11:14],
            outline=Outline(arcs, frame),
        )


def rest_prior(*uneven: int) -> FloatArray:
    """Prior of the rest's colours, (REST, REST), by whether each side's background has edges."""
    normal = _RIDGE * np.eye(REST)
    for side in range(2):
        start = REST - 2 * SIDE + side * SIDE
        second = np.diff(np.eye(CURVE), 2, axis=0) / (_SOFT if uneven[side] else _STIFF)
        normal[start : start + CURVE, start : start + CURVE] += second.T @ second
    return normal


_PRIORS = np.array([[rest_prior(a, b) for b in (False, True)] for a in (False, True)])
