"""Where pixels lie in the patient, in many digits."""

from math import cos, radians, sin
from typing import Any

import mpmath  # type: ignore[import-untyped]
from mpmath import matrix

from tools.exact import exact
from tools.exact.space import cross

ROW = (cos(radians(35.0)), sin(radians(35.0)), 0.0)
DOWN = (-sin(radians(35.0)) * 0.8, cos(radians(35.0)) * 0.8, 0.6)


@exact("normal of an oblique slice", "row × column direction, unit", *ROW, *DOWN)
def _(*v: Any) -> Any:
    n = cross(matrix(v[:3]), matrix(v[3:]))
    return list(n / mpmath.norm(n))


@exact(
    "corner of an oblique slice 90 km off",
    "IPP + c Δc row + r Δr column, C.7.6.2.1-1",
    *ROW,
    *DOWN,
    9e7,
    -9e7,
    9e7,
    0.7,
    0.9,
    511.0,
    511.0,
)
def _(*v: Any) -> Any:
    row, down, place = matrix(v[:3]), matrix(v[3:6]), matrix(v[6:9])
    rows_apart, columns_apart, column, line = v[9:]
    return list(place + row * (column * columns_apart) + down * (line * rows_apart))
