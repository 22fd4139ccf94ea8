"""Motions of the tool point as a hand makes them, exact in time, as an encoder shows them."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.core.units import MILLIMETRE
from app.mechanisms.pantograph import inverse, jacobian
from app.mechanisms.profile import DeviceProfile

_PHYSIOLOGICAL: Final = 2.0 * np.pi * 9.0  # [rad/s] tremor of a resting hand
_TREMOR: Final = 5e-6  # [m]
_LET_GO: Final = 0.25  # [m/s] the fastest that the governor allows
_RISE: Final = 0.020  # [s]

Path = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
"""Times (n,) -> displacement [m] and speed [m/s] of the tool along its line, each (n,)."""


def _rest(t: FloatArray) -> tuple[FloatArray, FloatArray]:
    return _TREMOR * np.sin(_PHYSIOLOGICAL * t), _TREMOR * _PHYSIOLOGICAL * np.cos(
        _PHYSIOLOGICAL * t
    )


def _sine(t: FloatArray) -> tuple[FloatArray, FloatArray]:
    w = np.pi  # 0.5 Hz
    return 5e-3 * np.sin(w * t), 5e-3 * w * np.cos(w * t)


def _correction(t: FloatArray) -> tuple[FloatArray, FloatArray]:
    # Minimum jerk over 10 mm in 0.5 s, from 0.5 s on (Flash and Hogan 1985).
    s = np.clip((t - 0.5) / 0.5, 0.0, 1.0)
    return 10e-3 * s**3 * (10.0 - 15.0 * s + 6.0 * s**2), 10e-3 / 0.5 * 30.0 * (s * (1.0 - s)) ** 2


def _let_go(t: FloatArray) -> tuple[FloatArray, FloatArray]:
    # Up to 0.25 m/s within 20 ms, 60 ms on, and down again within 20 ms.
    knots = np.array([0.5, 0.5 + _RISE, 0.58 + _RISE, 0.58 + 2.0 * _RISE])
    speed = np.interp(t, knots, [0.0, _LET_GO, _LET_GO, 0.0])
    place = np.zeros_like(t)
    for start, slope in zip(knots, np.array([1.0, -1.0, -1.0, 1.0]) * _LET_GO / _RISE, strict=True):
        place += 0.5 * slope * np.maximum(t - start, 0.0) ** 2
    return place, speed


MOTIONS: Final[dict[str, tuple[float, Path]]] = {
    "rest on an edge": (1.0, _rest),
    "slow sine": (2.0, _sine),
    "correction": (1.5, _correction),
    "let go": (0.8, _let_go),
}
"""Duration [s] and path of each motion."""


@dataclass(frozen=True, slots=True)
class HandMotion:
    """A motion sampled at a loop's rate.

    Attributes:
        times: of the ticks [s], shape (n,).
        readings: joint angles as encoders give them [rad], (n, 2).
        rates: true joint velocities [rad/s], (n, 2).
        speed: true speed of the tool along its line [m/s], (n,).
        lever: dP3/dq along that line [m/rad], (n, 2).
    """

    times: FloatArray
    readings: FloatArray
    rates: FloatArray
    speed: FloatArray
    lever: FloatArray


def motion(name: str, profile: DeviceProfile, rate_hz: float) -> HandMotion:
    """Sample a motion of `MOTIONS` on a device: along x through a point where its joints change
    counts, 10 mm off the middle of the workspace.
    """
    duration, path = MOTIONS[name]
    times = np.arange(1, round(duration * rate_hz) + 1) / rate_hz
    place, speed = path(times)
    geometry, count = profile.pantograph, 2.0 * np.pi / profile.encoder.counts_per_turn
    home = np.array(profile.encoder.home_offsets)
    middle = geometry.fulcrum[:2] + np.array([0.0, 10.0 * MILLIMETRE])
    p3 = middle + np.outer(place, [1.0, 0.0])
    q = np.array([inverse(geometry, point) for point in p3])
    maps = np.array([jacobian(geometry, row) for row in q])
    rates = np.linalg.solve(maps, np.outer(speed, [1.0, 0.0])[:, :, None])[:, :, 0]
    # Shift the encoders' zero so that the middle lies on the edge between two counts.
    zero = home + count * (((inverse(geometry, middle) - home) / count - 0.5) % 1.0)
    readings = zero + np.floor((q - zero) / count + 0.5) * count
    return HandMotion(
        frozen(times), frozen(readings), frozen(rates), frozen(speed), frozen(maps[:, 0])
    )
