"""Friction and breathing in many digits."""

from typing import Any

import mpmath  # type: ignore[import-untyped]

from tools.exact import exact

for words, travel, stiffness in (
    ("1e-12 m", 1e-12, 1e5),
    ("0.3 mm", 3e-4, 1e6),
    ("0.3 mm, as stiff as 5e8 N/m", 3e-4, 5e8),
):

    @exact(f"Dahl friction after {words}", "g + (f - g) exp(-σ x / g)", 0.2, travel, 1.0, stiffness)
    def _(force: Any, travel: Any, level: Any, stiffness: Any) -> Any:
        return [level + (force - level) * mpmath.exp(-stiffness * travel / level)]


@exact(
    "tilt of a ball joint from one edge of its play against the other",
    "Dahl off one edge, 2 c free, Dahl from 0",
    0.01,
    0.03,
    0.0022,
    0.04,
    4.0,
)
def _(z: Any, way: Any, play: Any, level: Any, stiffness: Any) -> Any:
    reach = level / stiffness
    left = way - reach * mpmath.log(1 + (z - play) / reach) - 2 * play
    return [-level * (1 - mpmath.exp(-left / reach))]


@exact("breath after twelve days", "A sin⁴(π t / T)", 1_000_000.7, 4.0, 0.0119)
def _(time: Any, period: Any, amplitude: Any) -> Any:
    return [amplitude * mpmath.sin(mpmath.pi * time / period) ** 4]


@exact(
    "side force of tissue 120 mm deep, tilted by 1e-6 rad",
    "k d³/3 sin θ / L_out",
    2e4,
    0.12,
    1e-6,
    0.08,
)
def _(k: Any, depth: Any, tilt: Any, l_out: Any) -> Any:
    return [k * depth**3 / 3 * mpmath.sin(tilt) / l_out]


@exact(
    "dry friction of two coupled joints",
    "Cramer's rule, both sliding",
    2e-3,
    1.9e-3,
    2e-3,
    1e-3,
    2e-3,
    4e-6,
)
def _(a11: Any, a12: Any, a22: Any, b1: Any, b2: Any, most: Any) -> Any:
    s1, s2 = -most, most  # the signs in which they slide
    determinant = a11 * a22 - a12**2
    u1 = (a22 * (b1 - s1) - a12 * (b2 - s2)) / determinant
    return [u1, (a11 * (b2 - s2) - a12 * (b1 - s1)) / determinant]
