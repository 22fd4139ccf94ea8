"""Tone curve of a camera: from light to grey levels and back, with one unknown (compiled).

    level = 255 ((1 + a) light^(1/γ) - a),   a = 0.055

With γ = 2.4 this is the curve of sRGB above its dark end (IEC 61966-2-1), which is a straight line
there; with γ = 1 it is linear, but for an offset of the light that no mixture of lights tells.
"""

import math
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
