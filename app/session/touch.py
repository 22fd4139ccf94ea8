"""Touching a point with the needle's tip: the cameras' fixes averaged over a second."""

from dataclasses import dataclass, field

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.core.errors import AcusError
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.tracking.fix import FixStatus, NeedleFix

DURATION = 1.0
"""A touch lasts this long [s]."""
FEWEST = 8
"""Fewer usable fixes than this in that time are no touch."""
STILL = 0.5 * MILLIMETRE
"""The tip counts as still while its fixes spread less than this (root mean square [m]), or less
than three times what the fixes themselves say."""


class TouchError(AcusError, ValueError):
    """A touch that cannot be used: the tip moved, or the cameras lost it."""


@dataclass(frozen=True, slots=True, eq=False)
class Touch:
    """A point that the tip touched.

    Attributes:
        p_world: mean of the fixes [m], shape (3,).
        covariance: of the mean [m²], shape (3, 3): the scatter that was seen divided by the
            number of fixes, and the rest of what a fix says of itself, which does not average out.
        count: number of fixes.
        spread: of the single fixes, root mean square [m].
    """

    p_world: FloatArray
    covariance: FloatArray
    count: int
    spread: float


@dataclass
class TouchCollector:
    """Takes fixes until a second is full.

    Attributes:
        duration: how long [s].
    """

    duration: float = DURATION
    _fixes: list[NeedleFix] = field(default_factory=list)
    _refused: int = 0
    _newest: float = -np.inf
    _first: float | None = None

    def add(self, fix: NeedleFix) -> None:
        """Take a fix; one that was seen already is passed over.

        Only fixes of both cameras measure a touch; others are counted.
        """
        if not fix.time > self._newest:
            return
        self._newest = fix.time
        if self._first is None:
            self._first = fix.time
        if fix.status is FixStatus.VALID and fix.usable:
            self._fixes.append(fix)
        else:
            self._refused += 1

    @property
    def share(self) -> float:
        """Return how much of it is done, 0...1: of the time and of the fewest fixes."""
        if self._first is None:
            return 0.0
        time = (self._newest - self._first) / self.duration
        return float(np.clip(min(time, len(self._fixes) / FEWEST), 0.0, 1.0))

    def touch(self) -> Touch:
        """Return the mean.

        Raises:
            TouchError: if there are too few usable fixes, or the tip moved meanwhile.
        """
        count = len(self._fixes)
        if count < FEWEST:
            raise TouchError(
                sentence(
                    "only {usable} of {seen} fixes could be used, {fewest} are "
                    "needed: keep the marker in both pictures and hold still",
                    usable=count,
                    seen=count + self._refused,
                    fewest=FEWEST,
                )
            )
        points = np.array([fix.p_tip_world for fix in self._fixes])
        mean = points.mean(axis=0)
        noise = np.mean([_noise(fix) for fix in self._fixes], axis=0)
        spread = float(np.sqrt(np.mean(np.sum((points - mean) ** 2, axis=1))))
        if spread > max(STILL, 3.0 * float(np.sqrt(np.trace(noise)))):
            raise TouchError(
                sentence(
                    "the tip moved by {spread_mm:.1f} mm while it was measured: rest it in "
                    "the mark and hold still for a second",
                    spread_mm=spread / MILLIMETRE,
                )
            )
        whole = np.mean([fix.covariance for fix in self._fixes], axis=0)
        scatter = np.cov(points.T)
        return Touch(frozen(mean), frozen(_of_mean(whole, noise, scatter, count)), count, spread)


def _noise(fix: NeedleFix) -> FloatArray:
    return fix.covariance if fix.noise_covariance is None else fix.noise_covariance


def _of_mean(whole: FloatArray, noise: FloatArray, scatter: FloatArray, count: int) -> FloatArray:
    """Covariance of the mean of fixes of covariance `whole` that scatter by `scatter`.

    What a fix allows for and its fixes do not show is the same in all: calibration, and the
    background behind a marker that does not move.
    """
    values, axes = np.linalg.eigh(whole - scatter)
    constant = (axes * np.maximum(values, 0.0)) @ axes.T
    stated = whole - noise
    larger = constant if np.trace(constant) > np.trace(stated) else stated
    result: FloatArray = larger + scatter / count
    return result
