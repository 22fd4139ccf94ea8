"""Study: how much of the needle's bending the lateral tissue force must know.

A needle inserted straight is turned by 5° at the fulcrum; compared is the force that the hand feels
at 100 mm above it. Rigid needle on springs against a beam on an elastic foundation.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.simulation.needles import OUTER_DIAMETER, bending_stiffness
from app.studies.references.foundation import (
    beam_moment,
    difference_moment,
    hermite_moment,
    rigid_moment,
    springs_moment,
)
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION: Final[dict[str, Any]] = {
    "title": "Lateral tissue: rigid needle on springs against a beam on an elastic foundation",
    "question": "Must the side force know that the needle bends?",
    "reference": "closed form of the beam on an elastic foundation, relative error < 1e-12",
}

_STIFFNESS: Final = 20e3  # [N/m²] liver
_TURN: Final = float(np.deg2rad(5.0))
_LEVER: Final = 0.1  # [m]
_FELT: Final = 0.1  # [N]
_SHARE: Final = 0.1  # of the force
_CALLS: Final = 200
_CALLS_SHORT: Final = 5000  # of the ways that take nanoseconds


@dataclass(frozen=True, slots=True)
class _Needle:
    depth: float
    ei: float


def _case(setting: Setting) -> Case:
    diameter = OUTER_DIAMETER[int(setting.values["gauge"])]
    needle = _Needle(setting.values["depth"], bending_stiffness(diameter))
    exact = beam_moment(_STIFFNESS, needle.ei, needle.depth, _TURN) / _LEVER
    return Case(
        data=needle,
        error=lambda moment: abs(moment / _LEVER - exact),
        perception=max(_FELT, _SHARE * exact),
    )


# Loops that do the work many times, so that nanoseconds can be timed; the turn changes a little in
# each, so that nothing is computed once for all.
@njit
def _rigid_often(k: float, depth: float, turn: float, calls: int) -> float:
    total = 0.0
    for c in range(calls):
        total += rigid_moment(k, depth + 1e-18 * c, turn)
    return total / calls


@njit
def _springs_often(k: float, depth: float, turn: float, n: int, calls: int) -> float:
    total = 0.0
    for c in range(calls):
        total += springs_moment(k, depth + 1e-18 * c, turn, n)
    return total / calls


@njit
def _difference_often(
    k: float, ei: float, depth: float, turn: float, band: FloatArray, right: FloatArray, calls: int
) -> float:
    total = 0.0
    for _ in range(calls):
        total += difference_moment(k, ei, depth, turn, band, right)
    return total / calls


@njit
def _hermite_often(
    k: FloatArray,
    ei: float,
    depth: float,
    turn: float,
    band: FloatArray,
    right: FloatArray,
    calls: int,
) -> float:
    total = 0.0
    for _ in range(calls):
        total += hermite_moment(k, ei, depth, turn, band, right)
    return total / calls


def _rigid(case: Case) -> Prepared:
    depth = case.data.depth
    return Prepared(lambda: _rigid_often(_STIFFNESS, depth, _TURN, _CALLS_SHORT), _CALLS_SHORT)


def _springs(n: int) -> Callable[[Case], Prepared]:
    return lambda case: Prepared(
        lambda: _springs_often(_STIFFNESS, case.data.depth, _TURN, n, _CALLS_SHORT), _CALLS_SHORT
    )


def _difference(n: int) -> Callable[[Case], Prepared]:
    def prepare(case: Case) -> Prepared:
        needle, band, right = case.data, np.empty((n, 3)), np.empty(n)
        arguments = (_STIFFNESS, needle.ei, needle.depth, _TURN, band, right, _CALLS)
        return Prepared(lambda: _difference_often(*arguments), _CALLS)

    return prepare


def _hermite(n: int) -> Callable[[Case], Prepared]:
    def prepare(case: Case) -> Prepared:
        needle, band, right = case.data, np.empty((2 * n, 4)), np.empty(2 * n)
        arguments = (np.full(n, _STIFFNESS), needle.ei, needle.depth, _TURN, band, right, _CALLS)
        return Prepared(lambda: _hermite_often(*arguments), _CALLS)

    return prepare


_WAYS: Final = (
    Way("rigid", "rigid, closed form", _rigid, "k d³/3 · θ"),
    *(
        Way(f"springs {n}", "rigid, springs", _springs(n), f"{n} springs on a rigid needle")
        for n in (5, 20, 80)
    ),
    *(
        Way(f"differences {n}", "beam, differences", _difference(n), "pentadiagonal, order 2")
        for n in (15, 30, 60, 120, 480)
    ),
    *(
        Way(f"elements {n}", "beam, elements", _hermite(n), "cubic Hermite, order 4")
        for n in (2, 4, 8, 16, 32)
    ),
)

_SETTINGS: Final = tuple(
    Setting(f"{gauge} G, {depth} mm", {"gauge": gauge, "depth": depth * 1e-3})
    for gauge in (17, 18, 20, 22, 25)
    for depth in (30, 60, 120)
)

STUDY: Final = Study(
    error_label="error of the force at the hand [N], 5° turn, 20 kPa",
    ways=_WAYS,
    settings=_SETTINGS,
    case=_case,
    deadline=Limit(50e-6, "50 µs: 5 % of the 1 ms tick"),
    perception=Limit(_FELT, "0.1 N (or 10 % of the force, if more): felt"),
    default=(
        "model `beam`: elements of 1 mm, solved when the scene is compiled and looked up in the "
        "tick; a rigid needle feels wrong for every gauge from 60 mm"
    ),
)
