"""Gauge calibration: the board's measured force, by weights."""

from typing import TYPE_CHECKING, ClassVar, Final

import numpy as np
from numpy.typing import ArrayLike

from app.core import state_vector as sv
from app.device.commissioning.errors import CommissioningError
from app.device.commissioning.force_scale import GRAVITY
from app.device.commissioning.results import Gauge as Found
from app.device.commissioning.results import Step
from app.device.commissioning.routine import Routine, Script
from app.device.control.loop import Loop
from app.mechanisms.profile import DeviceProfile

if TYPE_CHECKING:
    from app.device.control.corrections import Corrections

WEIGHTS_G: Final = (0.0, 50.0, 100.0, 200.0)
"""Weights that are hung on the hub [g]."""

_LISTEN: Final = 0.5
_RESIDUAL: Final = 0.1  # [N]
_SCALES: Final = (0.1, 10.0)


class GaugeCalibration(Routine):
    """Hang known weights on the hub, motors off, and fit zero and scale.

    Args:
        loop, profile: as in `Routine`.
        corrections: in use; its gauge values are taken out of the readings.
        weights_g: at least two different weights [g].
    """

    NAME: ClassVar[Step] = Step.GAUGE
    TITLE: ClassVar[str] = "Gauge calibration"

    def __init__(
        self,
        loop: Loop,
        profile: DeviceProfile,
        corrections: "Corrections",
        weights_g: tuple[float, ...] = WEIGHTS_G,
    ) -> None:
        super().__init__(loop, profile)
        self._corrections, self._weights_g = corrections, weights_g

    def _script(self) -> Script:
        self._disarm()
        state = yield from self._say("looking for the gauge")
        if state.row[sv.GAUGE] != 1.0:
            raise CommissioningError(
                f"{self.TITLE}: the board measures no force; connect the gauge's amplifier, or"
                " leave this step out: forces are then shown as estimated"
            )
        readings = []
        for weight in self._weights_g:
            yield from self._ask(f"hang {weight:g} g on the hub, across the needle, and confirm")
            since = self._loop.latest().tick
            yield from self._wait(_LISTEN, f"reading the gauge under {weight:g} g")
            shown = float(np.mean(self._loop.rows(since)[:, sv.GAUGE_FORCE]))
            zero, scale = self._corrections.gauge
            readings.append(shown / scale + zero)
            self._progress += 1.0 / (len(self._weights_g) + 1)
        return fit(self._weights_g, readings)


def fit(weights_g: ArrayLike, readings: ArrayLike) -> Found:
    """Fit reading = zero + force / scale by least squares.

    Args:
        weights_g: shape (n,) [g], at least two different ones.
        readings: shape (n,), uncorrected [N].

    Raises:
        CommissioningError: if the readings do not determine a scale or are no line.
    """
    weights = np.atleast_1d(np.asarray(weights_g, dtype=np.float64))
    shown = np.atleast_1d(np.asarray(readings, dtype=np.float64))
    if len(weights) != len(shown) or not len(weights) or np.ptp(weights) <= 0.0:
        raise CommissioningError(
            "Gauge calibration: give one reading for each of at least two different weights"
        )
    if not (np.isfinite(weights).all() and np.isfinite(shown).all()):
        raise CommissioningError("Gauge calibration: a reading is not a number; read again")
    force = weights * 1e-3 * GRAVITY
    slope, zero = (float(value) for value in np.polyfit(force, shown, 1))
    if not _SCALES[0] <= slope <= _SCALES[1]:
        raise CommissioningError(
            f"Gauge calibration: the reading changes by {slope:.3f} N per newton (valid"
            f" {_SCALES[0]:g} to {_SCALES[1]:g}): check the amplifier's gain and polarity, and"
            " which way the weights pull"
        )
    residual = float(np.sqrt(np.mean(((shown - zero) / slope - force) ** 2)))
    if residual > _RESIDUAL:
        raise CommissioningError(
            f"Gauge calibration: the readings lie {residual:.2f} N off a line (at most"
            f" {_RESIDUAL:g} N): let the weights hang still and free"
        )
    return Found(zero=zero, scale=1.0 / slope, residual=residual, weights_g=tuple(weights.tolist()))
