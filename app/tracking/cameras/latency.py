"""Latency of screen and camera together, from a patch that blinks at random.

The patch changes at random times, so that no latency looks like another one plus a period. A first
estimate is the shift at which the pictures' brightness correlates best with what was displayed.
Around it every picture near a change is a sample of one curve, the brightness over the time since
the change: the pictures come at another phase each time, so the curve is sampled far more finely
than their rate (as an edge is in the slanted-edge method of ISO 12233). A cumulative normal
distribution is fitted to it; its median is the latency, its width the spread.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ndtr

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.tracking.cameras.camera import Image
from app.tracking.errors import CameraError

LONGEST: Final = 0.5
"""Longest latency [s] that is looked for."""

FEWEST: Final = 10
"""Fewest changes that must have been seen."""

GRID: Final = (6, 8)
"""Rows and columns of the tiles in which the patch is looked for."""

_STEP: Final = 1e-3
_CONTRAST: Final = 8.0
_AGREEMENT: Final = 0.7
_PARTS: Final = 8


@dataclass(frozen=True, slots=True)
class CameraLatency:
    """What was measured.

    Attributes:
        median: from the change on the display to the time of the picture that shows it half [s].
        sd: spread of a single picture about it [s]: jitter, and the blur of the exposure.
        error: standard error of the median [s].
        n: number of changes seen.
    """

    median: float
    sd: float
    error: float
    n: int

    @property
    def text(self) -> str:
        """For people."""
        return sentence(
            "{median:.1f} ± {error:.1f} ms (spread of a single picture {sd:.1f} ms, {n} changes)",
            median=1e3 * self.median,
            error=1e3 * self.error,
            sd=1e3 * self.sd,
            n=self.n,
        )


def estimate_latency(blinks: ArrayLike, times: ArrayLike, brightness: ArrayLike) -> CameraLatency:
    """Estimate the latency between a display and the pictures of a camera.

    Args:
        blinks: times of the changes [s], increasing, shape (k,); the patch is dark before the
            first one, bright after it, and so on.
        times: of the pictures [s], delivery or capture as the latency is wanted for, shape (m,).
        brightness: of the patch in them [grey], shape (m,).

    Raises:
        CameraError: if the patch is not seen, blinks too slowly or too regularly, or too few
            changes were seen; says what to do.
    """
    edges, t, grey = (np.asarray(a, dtype=np.float64) for a in (blinks, times, brightness))
    good = np.isfinite(t) & np.isfinite(grey)
    t, grey = t[good], grey[good]
    _check(edges, t, grey)
    level = _levels(grey)
    coarse, agreement = _correlate(edges, t, level)
    if agreement < _AGREEMENT:
        raise CameraError(
            sentence(
                "the pictures do not follow the blinking (correlation {agreement:.2f}, at least "
                "{least_agreement} is needed); put the camera close to the patch, out of other "
                "light, and hold its exposure",
                agreement=agreement,
                least_agreement=_AGREEMENT,
            )
        )
    return _fit(edges, t, level, coarse)


def _check(edges: FloatArray, t: FloatArray, grey: FloatArray) -> None:
    if edges.ndim != 1 or edges.size < FEWEST or t.size < 2 * FEWEST:
        raise CameraError(
            sentence(
                "{changes} changes and {pictures} pictures are too few; at least "
                "{fewest_changes} and {fewest_pictures} are needed: let the test run to its end",
                changes=edges.size,
                pictures=t.size,
                fewest_changes=FEWEST,
                fewest_pictures=2 * FEWEST,
            )
        )
    if not np.isfinite(edges).all() or (np.diff(edges) <= 0.0).any():
        raise CameraError(sentence("the times of the changes must increase; repeat the test"))
    contrast = float(np.percentile(grey, 90) - np.percentile(grey, 10))
    if contrast < _CONTRAST:
        raise CameraError(
            sentence(
                "the patch changes the picture by {contrast:.1f} grey levels, at least "
                "{least_contrast:g} are needed; point the camera at the patch, and check its "
                "exposure",
                contrast=contrast,
                least_contrast=_CONTRAST,
            )
        )


def _levels(grey: FloatArray) -> FloatArray:
    """Brightness as 0 (dark) to 1 (bright), by the medians of both halves."""
    middle = 0.5 * (np.percentile(grey, 5) + np.percentile(grey, 95))
    dark, bright = np.median(grey[grey <= middle]), np.median(grey[grey > middle])
    return np.clip((grey - dark) / (bright - dark), -0.5, 1.5)


def _shown(edges: FloatArray, t: FloatArray) -> FloatArray:
    """Return what the display showed at times: 0 dark, 1 bright."""
    return (np.searchsorted(edges, t, side="right") % 2).astype(np.float64)


def _correlate(edges: FloatArray, t: FloatArray, level: FloatArray) -> tuple[float, float]:
    """Best shift [s], the middle of the plateau about it, and the correlation there."""
    shifts = np.arange(0.0, LONGEST + _STEP, _STEP)
    score = np.array([_correlation(_shown(edges, t - shift), level) for shift in shifts])
    best = float(score.max())
    plateau = shifts[score >= best - 1e-9]
    return float(plateau.mean()), best


def _correlation(shown: FloatArray, level: FloatArray) -> float:
    a, b = shown - shown.mean(), level - level.mean()
    norm = float(np.sqrt((a @ a) * (b @ b)))
    return float(a @ b) / norm if norm > 0.0 else 0.0


def _fit(edges: FloatArray, t: FloatArray, level: FloatArray, coarse: float) -> CameraLatency:
    """Fit the curve of the change to all pictures that lie nearer to it than to another one."""
    period = float(np.median(np.diff(t)))
    reach = 0.5 * float(np.diff(edges).min())
    after = t[:, None] - edges[None, :] - coarse
    sample, edge = np.nonzero(np.abs(after) < min(reach, 3.0 * period))
    delay = after[sample, edge]
    rising = np.where(edge % 2 == 0, level[sample], 1.0 - level[sample])
    seen = np.unique(edge).size
    if seen < FEWEST or delay.size < 2 * FEWEST:
        raise CameraError(
            sentence(
                "{seen} changes were seen, at least {fewest} are needed; the patch must stay "
                "longer between two changes than two pictures of the camera",
                seen=seen,
                fewest=FEWEST,
            )
        )
    medians = np.arange(-1.0, 1.0, 0.01) * min(reach, 2.0 * period)
    widths = np.geomspace(0.02, 1.0, 24) * period
    misfit = np.array([_misfit(delay, rising, edge, medians, width) for width in widths])
    chosen = int(np.argmin(misfit.sum(axis=2).min(axis=1)))
    parts = misfit[chosen]  # of the medians and parts
    median = _lowest(medians, parts.sum(axis=1))
    left_out = [_lowest(medians, np.delete(parts, k, axis=1).sum(axis=1)) for k in range(_PARTS)]
    spread = float(np.sqrt((_PARTS - 1) * np.var(left_out)))  # the jackknife
    # A curve that is steeper than the pictures are dense is known only to the gap they leave.
    gap = period / np.sqrt(12.0) / seen
    return CameraLatency(
        coarse + median, float(widths[chosen]), float(np.hypot(spread, gap)), int(seen)
    )


def _misfit(
    delay: FloatArray, rising: FloatArray, edge: NDArray[np.intp], medians: FloatArray, width: float
) -> FloatArray:
    """Sum of squares for each median and each part of the changes, shape (m, _PARTS)."""
    curve = ndtr((delay[None, :] - medians[:, None]) / width)
    squares = (curve - rising) ** 2
    return np.stack([squares[:, edge % _PARTS == k].sum(axis=1) for k in range(_PARTS)], axis=1)


def _lowest(x: FloatArray, y: FloatArray) -> float:
    """Return where y is lowest, by the parabola through three points."""
    i = int(np.clip(np.argmin(y), 1, y.size - 2))
    below, middle, above = y[i - 1 : i + 2]
    curvature = below - 2.0 * middle + above
    shift = 0.5 * (below - above) / curvature if curvature > 1e-12 else 0.0
    return float(x[i] + np.clip(shift, -1.0, 1.0) * (x[1] - x[0]))


def grid_means(image: Image) -> FloatArray:
    """Mean brightness of `GRID` tiles of a picture, flat."""
    rows, columns = GRID
    height, width = image.shape[:2]
    if height < rows or width < columns:
        raise CameraError(
            sentence(
                "a picture of {width}x{height} is too small for the test of latency",
                width=width,
                height=height,
            )
        )
    green = image[: height - height % rows, : width - width % columns, 1]
    tiles = green.reshape(rows, green.shape[0] // rows, columns, green.shape[1] // columns)
    return np.asarray(tiles.mean(axis=(1, 3)).ravel(), dtype=np.float64)


def liveliest(tiles: ArrayLike) -> FloatArray:
    """Brightness of the tile that changes most: where the patch is; (m, tiles) -> (m,)."""
    series = np.asarray(tiles, dtype=np.float64)
    if series.ndim != 2 or not series.size:
        raise CameraError(
            sentence("no picture came while the patch was blinking; is the camera running?")
        )
    low, high = np.percentile(series, [15.0, 85.0], axis=0)
    return np.asarray(series[:, int(np.argmax(high - low))])


def blink_times(seconds: float, rate_hz: float, rng: np.random.Generator) -> FloatArray:
    """Return random times of changes [s] from 0, for a display and a camera of a rate.

    The patch stays three to nine pictures of the camera, evenly distributed.
    """
    period = 1.0 / rate_hz
    gaps = rng.uniform(3.0 * period, 9.0 * period, size=int(seconds / (3.0 * period)) + 1)
    times = np.cumsum(gaps)
    return times[times < seconds]
