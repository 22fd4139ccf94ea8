"""Least squares of the band's picture: where it is, given its outline and the colours' model.

The colours are linear unknowns and are eliminated at every step (variable projection, Golub and
Pereyra 1973, with Kaufman's simplification of the Jacobian); the step in position, width and length
is Gauss-Newton's. Pixels that fit badly are left out. Derivation: docs/band-fit.md.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, read_only
from app.core.compiled import njit
from app.tracking.band.delivered_fit import GLOSSY, MATT, DeliveredMinimum, fit_delivered
from app.tracking.band.equations import (
    MOVES,
    REST,
    factorise,
    finish,
    halve,
    solve_colours,
    step_equations,
)
from app.tracking.band.model import design, no_rows
from app.tracking.band.outline import Outline, strips, trace
from app.tracking.band.pixels import CURVE, SIDE, gather
from app.tracking.cameras.camera import Image
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleShape

_RIDGE = 1e-4
"""Prior of the colours: standard deviation of 100 times the noise."""

SHADING_PRIOR = np.array([0.0, 1.0, 1.0, *[0.15**-2] * 2, *[0.03**-2] * 2])
"""Prior of the paint's shading, relative to its mean: inverse squares of standard deviations."""

NOWHERE: Final = read_only(np.zeros((0, 0), dtype=np.bool_))
"""No pixel of a picture hidden."""

MORE: Final = 2.2
"""By how much the covariance of a fit in a delivered picture is larger than what its left-over
noise makes: quantised blocks are alike beyond what is looked at."""

_OTHERWISE: Final = 0.25
"""Share of the squared difference to the place by a tone curve or a gloss that may be as well: an
edge that is hardly seen moves with them."""

MISFIT: Final = 2.6
"""Largest mean square residual of the band in a delivered picture [noise variances]: few photons
are noisy in a dark colour."""

STRETCH_SD = 0.03
"""How well width and length are known beforehand, relative."""

_STIFF, _SOFT = 2.0, 25.0
"""Standard deviation of the background curve's second differences [noise]: even, with edges."""

_STEPS: Final = 4
_DONE_PX: Final = 0.02
_NEAR_PX: Final = 0.15
"""A step this small ends at the least squares' minimum, to a thousandth of a pixel."""

_FARTHEST_PX: Final = 8.0
_STRETCHED: Final = 0.4
_FEW: Final = 0.01
"""Share of pixels that may be left out without another step."""

_OUTLIER: Final = 9.0
"""Mean square residual of a pixel's colours [noise variances] beyond which it does not count."""


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
        cost: what tone curves are compared by: less is better; 0 where there is one only.
        blur: fitted standard deviation across and along the needle [px]; 0 where it is given.
    """

    uv: FloatArray
    covariance: FloatArray
    stretch: FloatArray
    misfit: float
    outliers: float
    area: float
    paint: FloatArray
    outline: Outline
    cost: float = 0.0
    blur: tuple[float, float] = (0.0, 0.0)


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
        camera = self._model
        count = strips(p_camera, self._shape, camera.intrinsics, self._blur)
        seen, outline = trace(
            p_camera, axis_camera, self._shape, camera.intrinsics, camera.distortion, count
        )
        if not seen:
            return None
        found, best = minimise(
            read_only(image[:]),
            outline,
            self._shape,
            self._blur,
            self._noise,
            self._prior,
            _PRIORS,
            SHADING_PRIOR,
        )
        if not found:
            return None
        return BandFit(
            uv=np.array([outline.u, outline.v]) + best.shift,
            covariance=best.covariance,
            stretch=best.stretch,
            misfit=best.misfit,
            outliers=best.outliers,
            area=best.area,
            paint=best.paint,
            outline=outline,
        )

    def fit_delivered(
        self,
        image: Image,
        p_camera: FloatArray,
        axis_camera: FloatArray,
        gamma: float,
        glossy: bool = False,
        hidden: NDArray[np.bool_] = NOWHERE,
        stretch_sd: float | None = None,
    ) -> BandFit | None:
        """Like `fit`, in a picture as a camera delivers it.

        Args:
            image: see `fit`.
            p_camera: likewise.
            axis_camera: likewise.
            gamma: of the tone curve, see `tone`, about.
            glossy: whether highlights on the band are reckoned with.
            hidden: where something stands before the needle, shape (H, W).
            stretch_sd: see `BandFitter`, where the place is known better than usual.
        """
        prior = self._prior if stretch_sd is None else 1.0 / stretch_sd**2
        camera = self._model
        count = strips(p_camera, self._shape, camera.intrinsics, self._blur)
        seen, outline = trace(
            p_camera, axis_camera, self._shape, camera.intrinsics, camera.distortion, count
        )
        if not seen:
            return None
        found, best = fit_delivered(
            read_only(image[:]),
            outline,
            self._shape,
            self._blur,
            3.0,
            prior,
            gamma,
            GLOSSY if glossy else MATT,
            hidden,
        )
        if not found:
            return None
        return BandFit(
            uv=np.array([outline.u, outline.v]) + best.shift,
            covariance=best.covariance,
            stretch=best.stretch,
            misfit=max(1.0, best.misfit / best.noise[0] ** 2),
            outliers=best.outliers,
            area=best.area,
            paint=best.paint,
            outline=outline,
            cost=_cost(best, prior),
            blur=(float(best.blur[0]), float(best.blur[1])),
        )


def alternatives(fit: BandFit, others: Sequence[BandFit]) -> FloatArray:
    """Return what other fits that may be as well add to the covariance of one [px²], (2, 2)."""
    apart = np.array([other.uv - fit.uv for other in others]).reshape(-1, 2)
    covariance: FloatArray = _OTHERWISE * apart.T @ apart
    return covariance


_COMPARED: Final = 400.0
"""Pixels of brightness that count when tone curves are compared: those that see the needle."""


def _cost(best: DeliveredMinimum, prior: float) -> float:
    """Negative logarithm of the likelihood with noise of its own, but for a constant."""
    luma, chroma = np.log(best.noise).tolist()
    shared = float(best.sizes[2] * best.sizes[3])
    stretched = float(((best.stretch - 1.0) ** 2).sum())
    return _COMPARED * (luma + 2.0 * chroma / shared) + 0.5 * prior * stretched


def rest_prior(*uneven: int) -> FloatArray:
    """Prior of the rest's colours, (REST, REST), by whether each side's background has edges."""
    normal = _RIDGE * np.eye(REST)
    for side in range(2):
        start = REST - 2 * SIDE + side * SIDE
        second = np.diff(np.eye(CURVE), 2, axis=0) / (_SOFT if uneven[side] else _STIFF)
        normal[start : start + CURVE, start : start + CURVE] += second.T @ second
    return normal


_PRIORS = np.array([[rest_prior(a, b) for b in (False, True)] for a in (False, True)])


class BandMinimum(NamedTuple):
    """Where the least squares' minimum is."""

    shift: FloatArray
    """u, v of the band from the outline's origin [px], (2,)."""
    covariance: FloatArray
    """Of it [px²], (2, 2)."""
    stretch: FloatArray
    """Width and length over the expected, (2,)."""
    paint: FloatArray
    """Mean colour of the band [grey levels], (3,)."""
    misfit: float
    outliers: float
    area: float
    """See `BandFit`."""


@njit
def minimise(
    image: Any,
    outline: Any,
    shape: Any,
    blur: float,
    noise: float,
    stretch_prior: float,
    priors: Any,
    shading_prior: Any,
) -> Any:
    """Fit the band near its outline: whether there is one to fit, and the `BandMinimum`.

    Args:
        image: uint8 (H, W, 3).
        outline: an `Outline`.
        shape: a `rig.NeedleShape`.
        blur: standard deviation of the point spread [px].
        noise: standard deviation of a grey value.
        stretch_prior: of width and length, inverse square of the relative standard deviation.
        priors: of the rest's colours by whether either side's background has edges,
            (2, 2, REST, REST).
        shading_prior: see `equations.solve_colours`.
    """
    pixels = gather(image, outline, blur, noise)
    prior = priors[int(pixels.uneven[0]), int(pixels.uneven[1])]
    rows, good = no_rows(len(pixels.places)), pixels.usable.copy()
    shift, stretch, change = np.zeros(2), np.ones(2), np.zeros(MOVES)
    covariance, paint = np.zeros((2, 2)), np.zeros(3)
    squares, gain = np.zeros(len(good)), 0.0
    nothing = BandMinimum(shift, covariance, stretch, paint, 0.0, 0.0, 0.0)
    for step in range(_STEPS):
        design(pixels.places, outline, shape, blur, shift, stretch, rows)
        if not _mean_paint(pixels.colours, rows, good, paint):
            return False, nothing
        determined, colours = solve_colours(pixels, rows, good, paint, prior, shading_prior)
        if not determined:
            return False, nothing
        equations = step_equations(pixels, rows, good, paint, colours)
        squares = equations.squares
        gain = _advance(equations, outline, stretch_prior, shift, stretch, change, covariance)
        if not np.isfinite(gain):
            return False, nothing
        moved = max(abs(change[0]), abs(change[1]))
        if moved < _DONE_PX and step > 0:
            break
        if moved < _NEAR_PX:
            few = _leave_out(pixels.usable, squares, good)
            if few or step > 0:
                break
    enough, misfit, outliers, area = _quality(rows, squares, good, gain)
    return enough, BandMinimum(shift, covariance, stretch, paint * noise, misfit, outliers, area)


@njit
def _mean_paint(colours: Any, rows: Any, good: Any, paint: Any) -> bool:
    """Mean colour of the pixels that the band fills; False if there are hardly any."""
    count = 0
    paint[:] = 0.0
    for i in range(len(good)):
        if rows.seen[i] and good[i] and rows.values[i, 0, 0] > 0.97:
            count += 1
            for c in range(3):
                paint[c] += colours[i, c]
    paint /= max(count, 1)
    return count >= 6


@njit
def _advance(
    equations: Any,
    outline: Any,
    stretch_prior: float,
    shift: Any,
    stretch: Any,
    change: Any,
    covariance: Any,
) -> float:
    """Take the step, with its `change` and the position's covariance before it.

    Returns by how much it lessens the sum of squares; NaN where there is no step, or it leads too
    far away.
    """
    information, right = equations.information, equations.right
    # derivatives are by n and e of the pixel: the band moved by +u is the pixel moved by -u
    _turn(information, right, outline)
    for k in range(2):
        right[2 + k] -= stretch_prior * (stretch[k] - 1.0)
        information[2 + k, 2 + k] += stretch_prior
    if not _solve(information, right, change, covariance):
        return np.nan
    gain = 0.0
    for k in range(MOVES):
        gain += right[k] * change[k]
    farthest, stretched = 0.0, 0.0
    for k in range(2):
        shift[k] += change[k]
        stretch[k] += change[2 + k]
        farthest = max(farthest, abs(shift[k]))
        stretched = max(stretched, abs(stretch[k] - 1.0))
    return gain if farthest < _FARTHEST_PX and stretched < _STRETCHED else np.nan


@njit
def _turn(information: Any, right: Any, outline: Any) -> None:
    """From moves of the pixel by (n, e) to moves of the band by (u, v), in place."""
    size = information.shape[0]
    x, y = outline.ev, outline.eu
    for k in range(size):
        by_n, by_e = information[k, 0], information[k, 1]
        information[k, 0], information[k, 1] = x * by_n - y * by_e, -y * by_n - x * by_e
    for k in range(size):
        by_n, by_e = information[0, k], information[1, k]
        information[0, k], information[1, k] = x * by_n - y * by_e, -y * by_n - x * by_e
    by_n, by_e = right[0], right[1]
    right[0], right[1] = x * by_n - y * by_e, -y * by_n - x * by_e


@njit
def _solve(information: Any, right: Any, change: Any, covariance: Any) -> bool:
    """Step of the moves, and the covariance of the first two; overwrites `information`."""
    size = information.shape[0]
    inverse = np.zeros((size, MOVES))
    for k in range(MOVES):
        inverse[k, k] = 1.0
    if not factorise(information):
        return False
    halve(information, inverse)
    finish(information, inverse)
    for p in range(MOVES):
        change[p] = 0.0
        for q in range(MOVES):
            change[p] += inverse[p, q] * right[q]
    covariance[:] = inverse[:2, :2]
    return True


@njit
def _leave_out(usable: Any, squares: Any, good: Any) -> bool:
    """Mark the pixels that fit; returns whether hardly any is left out that was not before."""
    before, after = 0, 0
    for i in range(len(good)):
        before += good[i]
        good[i] = usable[i] and squares[i] < _OUTLIER
        after += good[i]
    return after > (1.0 - _FEW) * before


@njit
def _quality(rows: Any, squares: Any, good: Any, gain: float) -> Any:
    """Return whether enough of the band's pixels count, and misfit, outliers and area."""
    total, count, area, kept = 0.0, 0, 0.0, 0.0
    for i in range(len(good)):
        if not rows.seen[i]:
            continue
        share = rows.values[i, 0, 0]
        area += share
        if good[i]:
            kept += share
            if share > 0.05:
                count += 1
                total += squares[i]
    if count < 20:
        return False, 0.0, 0.0, 0.0
    misfit = (3.0 * total - gain) / (3.0 * count)  # the last step takes that much off
    return True, misfit, 1.0 - kept / area, area
