"""Tone curve of a camera: from light to grey levels and back, with one unknown (compiled).

    level = 255 ((1 + a) light^(1/γ) - a),   a = 0.055

With γ = 2.4 this is the curve of sRGB above its dark end (IEC 61966-2-1), which is a straight line
there; with γ = 1 it is linear, but for an offset of the light that no mixture of lights tells.
"""

import math
from dataclasses import dataclass
from typing import Any, Final

from app.core.compiled import njit

_A: Final = 0.055


@njit(forceinline=True)
def to_light(level: float, gamma: float) -> float:
    """Light of a grey level; below 0 carried on as a straight line."""
    x = (level / 255.0 + _A) / (1.0 + _A)
    zero = _A / (1.0 + _A)
    if x < zero:
        dark = zero**gamma
        return dark + (x - zero) * gamma * dark / zero
    return x**gamma


@njit(forceinline=True)
def to_level(light: float, gamma: float) -> Any:
    """Grey level of a light, its derivative by the light, and by γ."""
    zero = _A / (1.0 + _A)
    dark = zero**gamma
    if light < dark:
        slope = zero / (gamma * dark)
        level = 255.0 * ((1.0 + _A) * (zero + (light - dark) * slope) - _A)
        return level, 255.0 * (1.0 + _A) * slope, 0.0
    root = light ** (1.0 / gamma)
    return (
        255.0 * ((1.0 + _A) * root - _A),
        255.0 * (1.0 + _A) * root / (gamma * light),
        -255.0 * (1.0 + _A) * root * math.log(light) / (gamma * gamma),
    )


@njit(forceinline=True)
def about_level(level: float, gamma: float) -> Any:
    """Light of a grey level, and the level's derivative by the light and by γ there."""
    x = (level / 255.0 + _A) / (1.0 + _A)
    zero = _A / (1.0 + _A)
    if x <= zero:
        light = to_light(level, gamma)
        _, slope, by_gamma = to_level(light, gamma)
        return light, slope, by_gamma
    log = math.log(x)
    light = math.exp(gamma * log)
    return (
        light,
        255.0 * (1.0 + _A) * x / (gamma * light),
        -255.0 * (1.0 + _A) * x * log / gamma,
    )


SRGB: Final = 2.4
LINEAR: Final = 1.0
"""Tone curves that are tried, see `band.tone`: cameras', and none."""

_SURE, _MOST_SURE, _MOST_BY_ONE, _AGAIN = 60.0, 120.0, 40.0, 32
"""Logarithm of the likelihoods' ratio, summed over pictures, from which a camera's tone curve is
known; to which it is counted, and of one picture; and after how many pictures it is asked again."""


@dataclass(slots=True)
class ToneMemory:
    """Remembers what a camera's pictures have told of its tone curve.

    Attributes:
        evidence: log-likelihood of a linear curve over sRGB's, summed over pictures.
        age: pictures since the last that counted.
    """

    evidence: float = 0.0
    age: int = 0

    def known(self, gamma: float) -> bool:
        """Tell whether the curve is known to be this one, and need not be asked again yet."""
        sign = 1.0 if gamma == LINEAR else -1.0
        return sign * self.evidence >= _SURE and self.age < _AGAIN

    def learn(self, ratio: float) -> None:
        """Count a picture: log-likelihood of a linear curve over sRGB's."""
        ratio = min(_MOST_BY_ONE, max(-_MOST_BY_ONE, ratio))
        self.evidence = min(_MOST_SURE, max(-_MOST_SURE, self.evidence + ratio))
        self.age = 0

    @property
    def likely(self) -> tuple[float, ...]:
        """Tone curves that a picture may have, a camera's usual one first where none is known."""
        return next(((g,) for g in (SRGB, LINEAR) if self.known(g)), (SRGB, LINEAR))
