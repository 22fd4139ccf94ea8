"""Study: which integrator a stiff contact can be trusted to at the loop's own step.

A mass of 0.1 kg with 1 N·s/m of damping stands 1 mm deep in a spring and is let go, at 1 ms a tick,
for stiffnesses from a soft dimple to bone. Explicit Euler is there as the control that has to fail.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np
from scipy.linalg import expm

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.units import MILLIMETRE
from app.simulation.effects import declaration
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION: Final[dict[str, Any]] = {
    "title": "Contact: exact hold, midpoint, backward, symplectic, Runge-Kutta, explicit",
    "question": "Which integrator carries a stiff contact at 1 ms?",
    "reference": "closed form of the damped oscillator, relative error < 1e-12",
}

MASS: Final = 0.1  # [kg]
DAMPING: Final = 1.0  # [N·s/m]
BEGIN: Final = 1e-3  # [m]
STEP: Final = 1e-3  # [s]
STEPS: Final = 200
STIFFNESS: Final = (1.0, 100.0, 1e3, 1e4, 5e4, 5e5)  # [N/m]


def closed_form(stiffness: float, times: FloatArray) -> FloatArray:
    """Return the position of the mass [m], begun at `BEGIN` at rest, shape (n,) -> (n,)."""
    decay = DAMPING / (2.0 * MASS)
    turn = np.sqrt(complex(stiffness / MASS - decay**2))
    if turn == 0.0:
        return np.asarray(BEGIN * (1.0 + decay * times) * np.exp(-decay * times))
    wave = np.cos(turn * times) + decay / turn * np.sin(turn * times)
    return np.asarray(BEGIN * (np.exp(-decay * times) * wave).real)


@njit
def linear(m: FloatArray, x: float, n: int, out: FloatArray) -> None:
    """Apply one matrix of a step again and again: exact with the exponential, shape (2, 2)."""
    m11, m12, m21, m22, v = m[0, 0], m[0, 1], m[1, 0], m[1, 1], 0.0
    for i in range(n):
        x, v = m11 * x + m12 * v, m21 * x + m22 * v
        out[i] = x


@njit
def midpoint(k: float, b: float, m: float, h: float, x: float, n: int, out: FloatArray) -> None:
    """Implicit midpoint rule."""
    v = 0.0
    for i in range(n):
        mean = (v - 0.5 * h * k * x / m) / (1.0 + 0.5 * h * b / m + 0.25 * h * h * k / m)
        x, v = x + h * mean, 2.0 * mean - v
        out[i] = x


@njit
def backward(k: float, b: float, m: float, h: float, x: float, n: int, out: FloatArray) -> None:
    """Backward Euler."""
    v = 0.0
    for i in range(n):
        v = (v - h * k * x / m) / (1.0 + h * b / m + h * h * k / m)
        x += h * v
        out[i] = x


@njit
def symplectic(k: float, b: float, m: float, h: float, x: float, n: int, out: FloatArray) -> None:
    """Symplectic Euler."""
    v = 0.0
    for i in range(n):
        v -= h * (k * x + b * v) / m
        x += h * v
        out[i] = x


@njit
def explicit(k: float, b: float, m: float, h: float, x: float, n: int, out: FloatArray) -> None:
    """Explicit Euler: unstable for h > b / k."""
    v = 0.0
    for i in range(n):
        x, v = x + h * v, v - h * (k * x + b * v) / m
        out[i] = x


@njit
def runge_kutta(k: float, b: float, m: float, h: float, x: float, n: int, out: FloatArray) -> None:
    """Classical Runge-Kutta of order 4."""
    v = 0.0
    for i in range(n):
        a1 = -(k * x + b * v) / m
        x2, v2 = x + 0.5 * h * v, v + 0.5 * h * a1
        a2 = -(k * x2 + b * v2) / m
        x3, v3 = x + 0.5 * h * v2, v + 0.5 * h * a2
        a3 = -(k * x3 + b * v3) / m
        x4, v4 = x + h * v3, v + h * a3
        a4 = -(k * x4 + b * v4) / m
        x += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4)
        v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)
        out[i] = x


def exact_step(stiffness: float) -> FloatArray:
    """Return the matrix that carries (x, v) over one step exactly, shape (2, 2)."""
    system = np.array([[0.0, 1.0], [-stiffness / MASS, -DAMPING / MASS]])
    return np.ascontiguousarray(expm(system * STEP))


def _case(setting: Setting) -> Case:
    stiffness = setting.values["stiffness"]
    truth = closed_form(stiffness, np.asarray(STEP * np.arange(1, STEPS + 1), np.float64))
    return Case(
        data=stiffness,
        error=lambda found: float(np.abs(found - truth).max() / MILLIMETRE),
        perception=0.1,
    )


def _exact(case: Case) -> Prepared:
    matrix, out = exact_step(case.data), np.empty(STEPS)

    def run() -> FloatArray:
        linear(matrix, BEGIN, STEPS, out)
        return out

    return Prepared(run, STEPS)


def _rule(kernel: Callable[..., None]) -> Callable[[Case], Prepared]:
    def prepare(case: Case) -> Prepared:
        out = np.empty(STEPS)

        def run() -> FloatArray:
            kernel(case.data, DAMPING, MASS, STEP, BEGIN, STEPS, out)
            return out

        return Prepared(run, STEPS)

    return prepare


_WAYS: Final = (
    Way("exact hold", "exact", _exact, "matrix exponential, made once", ("relaxation", "exact")),
    Way("implicit midpoint", "implicit", _rule(midpoint), "order 2, stable at any step"),
    Way("backward Euler", "implicit", _rule(backward), "order 1, damps what it cannot follow"),
    Way("symplectic Euler", "explicit", _rule(symplectic), "order 1, stable below 2 / ω"),
    Way("Runge-Kutta 4", "explicit", _rule(runge_kutta), "order 4, stable below 2.8 / ω"),
    Way("explicit Euler", "control", _rule(explicit), "order 1, unstable beyond b / k"),
)

STUDY: Final = Study(
    error_label="largest error of the position within 0.2 s [mm]",
    ways=_WAYS,
    settings=tuple(Setting(f"{k:g} N/m", {"stiffness": k}) for k in STIFFNESS),
    case=_case,
    deadline=Limit(1e-6, "1 µs: 0.1 % of the 1 ms tick"),
    perception=Limit(0.1, "0.1 mm: seen on the screen"),
    default="exact hold",
    because=(
        "Its constants are made when the scene is compiled; every other way is off by more than "
        "0.1 mm in some setting."
    ),
    in_use=lambda: ("relaxation", declaration("relaxation").model("")),
)
