"""Least squares of the band's picture: where it is, given its outline and the colours' model.

The colours are linear unknowns and are eliminated at every step (variable projection, Golub and
Pereyra 1973, with Kaufman's simplification of the Jacobian); the step in position, width and length
is Gauss-Newton's. Pixels that fit badly are left out.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.tracking.cameras.camera import Image
from app.tracking.markers.band_design import BAND, COLUMNS, PARTIALS, design
from app.tracking.markers.band_ground import CURVE, SIDE, directions, ground_columns
from app.tracking.markers.band_normal import MOVES, REST
from app.tracking.markers.band_outline import CELLS, FRAME, outline
from app.tracking.markers.band_step import solve_step
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleShape

_STEPS = 4
_DONE_PX = 0.02
_NEAR_PX = 0.15
"""A step this small ends at the least squares' minimum, to a thousandth of a pixel."""

_FARTHEST_PX = 8.0
_FEW = 0.01
"""Share of pixels that may be left out without another step."""

_OUTLIER = 9.0
"""Mean square residual of a pixel's colours [noise variances] beyond which it does not count."""

_RIDGE = 1e-4
"""Prior of the colours: standard deviation of 100 times the noise."""

_SHADING = np.array([0.0, 1.0, 1.0, *[0.15**-2] * 2, *[0.03**-2] * 2])
"""Prior of the paint's shading, relative to its mean: inverse squares of standard deviations."""

_STIFF, _SOFT = 2.0, 25.0
"""Standard deviation of the background curve's second differences [noise]: even, with edges."""

_SIDE_PX, _HUB_PX, _TIP_PX = 9.0, 6.0, 6.0
"""What is looked at beside the band and beyond its ends: a highlight moves along the shaft."""


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
    """

    uv: FloatArray
    covariance: FloatArray
    stretch: FloatArray
    misfit: float
    outliers: float
    area: float
    paint: FloatArray


@dataclass(slots=True, eq=False)
class _Patch:
    """Pixels round the band and what is known of each."""

    pixels: FloatArray
    colours: FloatArray
    usable: NDArray[np.bool_]
    first: NDArray[np.int64]
    weights: FloatArray
    prior: FloatArray


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
        stretch_sd: float = 0.03,
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
        arcs, frame = np.empty((2, CELLS)), np.empty(FRAME)
        if not outline(
            p_camera, axis_camera, self._shape, self._model.intrinsics, self._model.distortion,
            arcs, frame,
        ):  # fmt: skip
            return None
        box = _box(frame, arcs, image.shape[:2])
        if box is None:
            return None
        return self._iterate(self._patch(image, frame, arcs, box), frame, arcs)

    def _patch(
        self, image: Image, frame: FloatArray, arcs: FloatArray, box: tuple[int, int, int, int]
    ) -> _Patch:
        left, top, right, bottom = box
        window = image[top:bottom, left:right]
        v, u = np.mgrid[top:bottom, left:right]
        du, dv = u - frame[0], v - frame[1]
        e, n = du * frame[2] + dv * frame[3], dv * frame[2] - du * frame[3]
        near = (e > arcs.min() - _HUB_PX) & (e < arcs.max() + _TIP_PX)
        near &= (n > frame[4] - _SIDE_PX) & (n < frame[6] + _SIDE_PX)
        room = 4.0 * self._blur
        clear = near * ((n > frame[6] + room).astype(np.int8) * 2 + (n < frame[4] - room))
        found, uneven = np.empty((2, 2)), np.empty(2, np.bool_)
        directions(window, clear.astype(np.int8), self._noise, found, uneven)
        pixels = np.column_stack([du[near], dv[near]])
        sides = (n[near] > 0.5 * (frame[4] + frame[6])).astype(np.int64)
        first, weights = np.zeros(len(pixels), np.int64), np.empty((len(pixels), 4))
        ground_columns(pixels, sides, found, first, weights)
        colours = window[near]
        usable = (colours < 254).all(axis=1)
        prior = _smoothness(bool(uneven[0]), bool(uneven[1]))
        return _Patch(pixels, colours / self._noise, usable, first, weights, prior)

    def _iterate(self, patch: _Patch, frame: FloatArray, arcs: FloatArray) -> BandFit | None:
        shift, stretch, good = np.zeros(2), np.ones(2), patch.usable
        rows = np.empty((len(patch.pixels), PARTIALS, COLUMNS))
        for step in range(_STEPS):
            pixels = patch.pixels - shift
            design(pixels, frame, arcs, self._shape, self._blur, stretch, rows)
            solved = self._solve(rows, patch, good, stretch, frame)
            if solved is None:
                return None
            change, covariance, residual, paint, gain = solved
            shift, stretch = shift + change[:2], stretch + change[2:]
            if not (np.abs(shift).max() < _FARTHEST_PX and np.abs(stretch - 1.0).max() < 0.4):
                return None
            squares = np.einsum("ij,ij->i", residual, residual) / 3.0
            moved = np.abs(change[:2]).max()
            if moved < _DONE_PX and step > 0:
                break
            if moved < _NEAR_PX:
                fitting = patch.usable & (squares < _OUTLIER)
                same = step > 0 or int(fitting.sum()) > (1.0 - _FEW) * int(good.sum())
                good = fitting
                if same:
                    break
        share = rows[:, 0, 0]
        counted = good & (share > 0.05)
        if counted.sum() < 20:
            return None
        total = 3.0 * float(squares[counted].sum()) - gain  # the last step takes that much off
        return BandFit(
            frame[:2] + shift,
            covariance,
            stretch,
            total / (3.0 * float(counted.sum())),
            1.0 - float((share * good).sum() / share.sum()),
            float(share.sum()),
            paint * self._noise,
        )

    def _solve(
        self,
        rows: FloatArray,
        patch: _Patch,
        good: NDArray[np.bool_],
        stretch: FloatArray,
        frame: FloatArray,
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, float] | None:
        """Step (u, v, width, length), covariance of (u, v), residuals, paint, and what it gains."""
        inside = good & (rows[:, 0, 0] > 0.97)
        if inside.sum() < 6:
            return None
        paint = np.asarray(patch.colours[inside].mean(axis=0), dtype=np.float64)
        residual, right = np.empty_like(patch.colours), np.empty(MOVES)
        information = np.empty((MOVES + BAND, MOVES + BAND))
        if not solve_step(
            rows, patch.first, patch.weights, patch.colours, good, paint, patch.prior.copy(),
            _SHADING, information, right, residual,
        ):  # fmt: skip
            return None
        # derivatives are by n and e of the pixel: the band moved by +u is the pixel moved by -u
        to_image = np.eye(MOVES + BAND)
        to_image[:2, :2] = [[frame[3], -frame[2]], [-frame[2], -frame[3]]]
        information = to_image.T @ information @ to_image
        wanted = to_image[:MOVES, :MOVES].T @ right
        wanted[2:] -= self._prior * (stretch - 1.0)
        information[[2, 3], [2, 3]] += self._prior
        try:
            covariance = np.asarray(np.linalg.inv(information), dtype=np.float64)
        except np.linalg.LinAlgError:
            return None
        change = covariance[:MOVES, :MOVES] @ wanted
        return change, covariance[:2, :2], residual, paint, float(wanted @ change)


@cache
def _smoothness(*uneven: bool) -> FloatArray:
    """Prior of the rest's colours, (REST, REST), by whether each side's background has edges."""
    normal = _RIDGE * np.eye(REST)
    for side in range(2):
        start = REST - 2 * SIDE + side * SIDE
        second = np.diff(np.eye(CURVE), 2, axis=0) / (_SOFT if uneven[side] else _STIFF)
        normal[start : start + CURVE, start : start + CURVE] += second.T @ second
    normal.setflags(write=False)
    return normal


def _box(
    frame: FloatArray, arcs: FloatArray, size: tuple[int, ...]
) -> tuple[int, int, int, int] | None:
    """Box of the pixels to look at; None if the band's centre is outside the picture."""
    along = np.array([arcs.min() - _HUB_PX, arcs.max() + _TIP_PX])
    across = np.array([frame[4] - _SIDE_PX, frame[6] + _SIDE_PX])
    e, n = np.meshgrid(along, across)
    u = frame[0] + e * frame[2] - n * frame[3]
    v = frame[1] + e * frame[3] + n * frame[2]
    if not (0.0 <= frame[0] < size[1] and 0.0 <= frame[1] < size[0]):
        return None
    left, right = max(0, int(np.floor(u.min()))), min(size[1], int(np.ceil(u.max())) + 1)
    top, bottom = max(0, int(np.floor(v.min()))), min(size[0], int(np.ceil(v.max())) + 1)
    return left, top, right, bottom
