"""What force laws, governor and safety compute, in many digits."""

from math import pi
from typing import Any

import mpmath  # type: ignore[import-untyped]
from mpmath import mpf

from tools.exact import exact


@exact(
    "part of the path across a needle 1e-9 rad from it",
    "p - (p·d) d, and atan2(|d × p|, d·p)",
    0.0,
    0.0,
    -1.0,
    1e-9,
    -2e-9,
    -1.0,
)
def _(*v: Any) -> Any:
    d, p = mpmath.matrix(v[:3]), mpmath.matrix(v[3:])
    across = p - d * mpmath.fdot(p, d)
    return [*across, mpmath.atan2(mpmath.norm(across), mpmath.fdot(p, d))]


for words, angle in (("1e-9 rad", 1e-9), ("90°", pi / 2), ("1e-9 rad short of 180°", pi - 1e-9)):

    @exact(
        f"energy of a saturated spring at {words}", "∫ f(ε) sin ε dε, two parts", angle, 28.6, 5.0
    )
    def _(angle: Any, k: Any, limit: Any) -> Any:
        half, bend = mpmath.pi / 2, limit / k
        stored = k * min(angle, bend) ** 2 / 2
        if angle > bend:
            stored += limit * (min(angle, half) - bend)
        if angle > half:
            stored += limit * (mpmath.cos(half) - mpmath.cos(angle))
        return [stored]


for words, rest in (("1e-6 of its reach", 1e-6), ("half its reach", 0.5)):

    @exact(f"hill {words} from its end", "slope ε (1 - ε/r)³ / sin ε, ∫ of it", 0.4, rest, 30.0)
    def _(reach: Any, rest: Any, slope: Any) -> Any:
        angle = mpf(float(mpf(0.4) * (1 - rest)))  # the double that the program is given
        share = angle / reach
        force = slope * angle * (1 - share) ** 3 / mpmath.sin(angle)
        stored = mpmath.quad(lambda e: slope * e * (1 - e / reach) ** 3, [angle, reach])
        return [force, stored]


@exact(
    "share of a damper against a force just within its limit",
    "positive root of |f + s b| = limit",
    4.9999999,
    1e-5,
    0.0,
    -1e6,
    2.0,
    3.0,
    5.0,
)
def _(*v: Any) -> Any:
    f, b, limit = mpmath.matrix(v[:3]), mpmath.matrix(v[3:6]), v[6]
    square, along = mpmath.fdot(b, b), mpmath.fdot(f, b)
    room = limit**2 - mpmath.fdot(f, f)
    return [(mpmath.sqrt(along**2 + square * room) - along) / square]


for words, room in (("plenty of", 2.0), ("hardly any", 1e-6)):

    @exact(
        f"acceleration that can be stopped in {words} room",
        "root of 2 √(δ a) + a T",
        room,
        6e-4,
        2e-3,
    )
    def _(room: Any, doubt: Any, step: Any) -> Any:
        root = (mpmath.sqrt(doubt + step * room) - mpmath.sqrt(doubt)) / step
        return [root**2]


@exact("length of a force of 1e200 N", "Pythagoras", 3e200, -4e200, 1.2e201)
def _(*v: Any) -> Any:
    return [mpmath.sqrt(mpmath.fsum(x**2 for x in v))]
