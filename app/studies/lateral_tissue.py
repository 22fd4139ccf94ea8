"""Study: how much of the needle's bending the lateral tissue force must know.

A needle inserted straight is turned by 5° at the fulcrum; compared is the force that the hand feels
at 100 mm above it. Rigid needle on springs against a beam on an elastic foundation.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import asin, cos, cosh, sin, sinh
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import STAGE_TYPE, njit
from app.core.messages import sentence
from app.simulation.consumers import DevicePort
from app.simulation.effects import lateral_tissue as effect
from app.simulation.errors import SimulationError
from app.simulation.needles import OUTER_DIAMETER, bending_stiffness
from app.simulation.plan import compile as compile_scene
from app.simulation.scene import EffectRequest, Scene
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

from numba import types  # isort: skip  (after core.compiled)

DECLARATION: Final[dict[str, Any]] = {
    "title": "Lateral tissue: rigid needle on springs against a beam on an elastic foundation",
    "question": "Must the side force know that the needle bends?",
    "reference": "closed form of the beam on an elastic foundation, relative error < 1e-12",
}


_SERIES_BELOW = 1.0


@njit
def rigid_moment(k: float, depth: float, turn: float) -> float:
    """Moment of a rigid needle, closed form; none for a depth of 0 or less."""
    return k * max(depth, 0.0) ** 3 / 3.0 * turn


@njit
def springs_moment(k: float, depth: float, turn: float, springs: int) -> float:
    """Moment of a rigid needle on `springs` equal springs in the middle of their intervals."""
    h = max(depth, 0.0) / springs
    total = 0.0
    for i in range(springs):
        x = (i + 0.5) * h
        total += k * h * x * x
    return total * turn


def beam_moment(k: float, ei: float, depth: float, turn: float) -> float:
    """Moment of an elastic needle of bending stiffness `ei` [N·m²], closed form.

    Relative error below 1e-13: for small z the difference of sinh z cosh z and sin z cos z is
    summed as the series ½ Σ 2 (2z)^(4m+3) / (4m+3)!, whose terms are all positive.

    Raises:
        SimulationError: if k or ei is not above 0, or the depth not finite and 0 or more.
    """
    if not (k > 0.0 and ei > 0.0 and 0.0 <= depth < np.inf):
        raise SimulationError(
            sentence(
                "a beam needs k > 0, EI > 0 and depth >= 0; given k = {k}, EI = {ei}, depth = "
                "{depth}",
                k=k,
                ei=ei,
                depth=depth,
            )
        )
    beta = (k / (4.0 * ei)) ** 0.25
    z = beta * depth
    if z > 300.0:  # cosh² overflows; the answer is that of an endless needle long before
        return 2.0 * ei * beta * turn
    difference = _series(2.0 * z) if z < _SERIES_BELOW else sinh(z) * cosh(z) - sin(z) * cos(z)
    return 2.0 * ei * beta * turn * difference / (cosh(z) ** 2 + cos(z) ** 2)


def _series(y: float) -> float:
    """½ (sinh y - sin y) without cancellation, for y up to 2."""
    term = y**3 / 6.0
    total = 0.0
    m = 3
    while term > 1e-18 * total:
        total += term
        term *= y**4 / ((m + 1) * (m + 2) * (m + 3) * (m + 4))
        m += 4
    return total


@njit
def solve_banded(band: FloatArray, right: FloatArray) -> None:
    """Solve A x = right in place, A symmetric positive definite with half bandwidth b.

    Args:
        band: band[i, d] = A[i, i - d], shape (n, b + 1); becomes its L D Lᵀ factors.
        right: shape (n,); becomes x.
    """
    n, b = band.shape[0], band.shape[1] - 1
    for i in range(n):
        first = max(0, i - b)
        for j in range(first, i):
            total = band[i, i - j]
            for m in range(max(first, j - b), j):
                total -= band[i, i - m] * band[j, j - m] * band[m, 0]
            band[i, i - j] = total / band[j, 0]
        for m in range(first, i):
            band[i, 0] -= band[i, i - m] ** 2 * band[m, 0]
            right[i] -= band[i, i - m] * right[m]
    for i in range(n - 1, -1, -1):
        right[i] /= band[i, 0]
        for m in range(i + 1, min(n, i + b + 1)):
            right[i] -= band[m, m - i] * right[m]


@njit
def difference_moment(
    k: float, ei: float, depth: float, turn: float, band: FloatArray, right: FloatArray
) -> float:
    """Moment of an elastic needle by finite differences on n intervals; depth above 0.

    `band` (n, 3) and `right` (n,) are work space; `right` receives the displacements of the nodes
    1 to n [m].
    """
    n = right.shape[0]
    h = depth / n
    c = ei / h**3
    band[:, :] = 0.0
    right[:] = 0.0
    for i in range(n):
        band[i, 0] = k * h if i < n - 1 else 0.5 * k * h
    for i in range(1, n):  # curvature at node i couples the nodes i - 1, i, i + 1
        band[i - 1, 0] += 4.0 * c
        band[i, 0] += c
        band[i, 1] -= 2.0 * c
        if i > 1:
            band[i - 2, 0] += c
            band[i - 1, 1] -= 2.0 * c
            band[i, 2] += c
    band[0, 0] += 2.0 * c  # half an interval at the fulcrum, whose slope is given
    right[0] = 2.0 * c * h * turn
    solve_banded(band, right)
    return 2.0 * ei * (h * turn - right[0]) / (h * h)


@njit
def _element(a: int, b: int, bending: float, mass: float) -> float:
    """Entry of the cubic element matrix in (w, h φ) of both ends: bending and foundation."""
    i, j = min(a, b), max(a, b)
    if i == 0:
        stiff = (12.0, 6.0, -12.0, 6.0)[j]
        load = (156.0, 22.0, 54.0, -13.0)[j]
    elif i == 1:
        stiff = (0.0, 4.0, -6.0, 2.0)[j]
        load = (0.0, 4.0, 13.0, -3.0)[j]
    elif i == 2:
        stiff = (0.0, 0.0, 12.0, -6.0)[j]
        load = (0.0, 0.0, 156.0, -22.0)[j]
    else:
        stiff, load = 4.0, 4.0
    return bending * stiff + mass * load


@njit
def hermite_moment(
    k: FloatArray, ei: float, depth: float, turn: float, band: FloatArray, right: FloatArray
) -> float:
    """Moment of an elastic needle by n cubic Hermite elements; depth above 0.

    `k` (n,) is the side stiffness of each element, so layers may differ; `band` (2n, 4) and `right`
    (2n,) are work space; `right` receives (w, h φ) of the nodes 1 to n.
    """
    n = right.shape[0] // 2
    h = depth / n
    bending, first = ei / h**3, k[0] * h / 420.0
    band[:, :] = 0.0
    right[:] = 0.0
    for e in range(n):
        mass = k[e] * h / 420.0
        for a in range(4):
            row = 2 * (e - 1) + a
            for b in range(a + 1):
                column = 2 * (e - 1) + b
                if column >= 0:
                    band[row, row - column] += _element(a, b, bending, mass)
    for a in range(2, 4):
        right[a - 2] = -_element(a, 1, bending, first) * h * turn
    solve_banded(band, right)
    reaction = _element(1, 1, bending, first) * h * turn
    for a in range(2, 4):
        reaction += _element(1, a, bending, first) * right[a - 2]
    return reaction * h


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


_PUSH: Final = 0.05e-3  # [m] a tick: 50 mm/s at 1 kHz


_ARRAY: Final = types.float64[::1]


@njit(types.float64(STAGE_TYPE, _ARRAY, _ARRAY, types.float64, types.float64, types.int64))
def _insert_and_turn(
    step: Any, state: FloatArray, parameters: FloatArray, depth: float, turn: float, ticks: int
) -> float:
    """Push in straight in equal steps, a tick each, turn in the last; moment then [N·m]."""
    for tick in range(1, ticks + 1):
        angle = turn if tick == ticks else 0.0
        state[sv.AXIS_X], state[sv.AXIS_Z] = sin(angle), -cos(angle)
        state[sv.DEPTH] = depth * min(1.0, tick / (ticks - 1))
        state[sv.FORCE_X] = state[sv.FORCE_Y] = state[sv.FORCE_Z] = 0.0
        step(state, parameters)
    force = (state[sv.FORCE_X] ** 2 + state[sv.FORCE_Y] ** 2 + state[sv.FORCE_Z] ** 2) ** 0.5
    return force * state[sv.L_OUT]


def _filter(case: Case) -> Prepared:
    depth, ei = case.data.depth, case.data.ei
    fresh = effect.empty(np.array([depth + 0.05]), np.array([_STIFFNESS]), 1.0 / ei, 1e-3)
    ticks, state = round(depth / _PUSH) + 1, sv.empty_state()
    state[sv.L_OUT], state[sv.DEPTH_SOURCE] = _LEVER, 1.0
    state[sv.KINEMATICS] = 0.0
    turn = asin(_TURN)  # the same displacement beside the channel as in the linear theory

    def run() -> float:
        found: float = _insert_and_turn(effect.step, state, fresh.copy(), depth, turn, ticks)
        return found

    return Prepared(run, ticks)


def _in_use() -> object:
    scene = Scene((EffectRequest("lateral_tissue"),))
    plan = compile_scene(scene, DevicePort("any"))
    return plan.stages()[1].function, plan.kept[0].model


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
    Way(
        "filter",
        "beam, filter from the fulcrum inwards",
        _filter,
        "exact between edges 1 mm apart, with what the tissue remembers: a tick of an insertion",
        used=(effect.step, "beam"),
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
    default="filter",
    because="model `beam`; a rigid needle feels wrong for every gauge from 60 mm",
    exception=(
        "Elements solve one straight insertion into one tissue; the filter has layers, tissue that "
        "was pierced along any path and remembers it, and the needle's shape in the same tick."
    ),
    in_use=_in_use,
)
